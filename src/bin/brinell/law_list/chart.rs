//! Curves drawn with characters.

/// Size of the field [characters].
const COLUMNS: usize = 64;
const ROWS: usize = 16;

/// Points with their characters; later points are drawn over earlier ones. Both axes begin at zero.
pub struct Chart {
    pub x_title: String,
    pub y_title: String,
    pub points: Vec<(f64, f64, char)>,
}

impl Chart {
    /// The chart as text.
    pub fn text(&self) -> String {
        let largest = |of: fn(&(f64, f64, char)) -> f64| self.points.iter().map(of).fold(0.0, f64::max);
        let (width, height) = (largest(|point| point.0), largest(|point| point.1));
        let mut field = [[' '; COLUMNS]; ROWS];
        let place = |value: f64, end: f64, count: usize| {
            let part = if end > 0.0 { value / end } else { 0.0 };
            (part * (count - 1) as f64).round().clamp(0.0, (count - 1) as f64) as usize
        };
        for (x, y, letter) in &self.points {
            field[ROWS - 1 - place(*y, height, ROWS)][place(*x, width, COLUMNS)] = *letter;
        }
        let number = |value: f64| crate::numbers::significant(value, 3);
        let mut text = format!("  {}\n", self.y_title);
        for (index, row) in field.iter().enumerate() {
            let label = match index {
                0 => number(height),
                index if index == ROWS - 1 => "0".into(),
                _ => String::new(),
            };
            let row: String = row.iter().collect();
            text += format!("  {label:>8} |{row}").trim_end();
            text.push('\n');
        }
        text += &format!("  {:>8} +{}\n", "", "-".repeat(COLUMNS));
        let end = number(width);
        let room = COLUMNS - 1 - end.len();
        text + &format!("  {:>8}  0{:^room$}{end}\n", "", self.x_title)
    }
}
