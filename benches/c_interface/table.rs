//! Tables in Markdown, as they stand in the README.

/// The head of a table with `columns`.
pub fn head(columns: &[&str]) {
    println!("\n| {} |\n|{}", columns.join(" | "), "---|".repeat(columns.len()));
}

/// A row of `cells`.
pub fn row(cells: &[String]) {
    println!("| {} |", cells.join(" | "));
}

/// What stands where there is nothing.
pub const NOTHING: &str = "-";

/// `value` with separated thousands.
pub fn number(value: f64, decimals: usize) -> String {
    let plain = format!("{value:.decimals$}");
    let (whole, fraction) = plain.split_at(plain.find('.').unwrap_or(plain.len()));
    let mut text = String::new();
    for (index, digit) in whole.chars().enumerate() {
        if index > 0 && (whole.len() - index).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text + fraction
}

/// A figure of the three units, beside what it shall be.
pub struct Row<'text> {
    pub name: &'text str,
    pub unit: &'text str,
    pub decimals: usize,
    pub must: &'text str,
    pub aim: &'text str,
}

impl Row<'_> {
    pub fn print(&self, [brinell, c, empty]: [Option<f64>; 3]) {
        let cell = |value: Option<f64>| {
            value.map_or(NOTHING.to_owned(), |value| format!("{} {}", number(value, self.decimals), self.unit))
        };
        let ratio = |other: Option<f64>| {
            brinell.zip(other).map_or(NOTHING.to_owned(), |(brinell, other)| format!("{:.2}", brinell / other))
        };
        let limits = [self.must, self.aim].map(str::to_owned);
        let measured = [cell(brinell), cell(c), cell(empty), ratio(c), ratio(empty)].map(|cell| cell.trim().to_owned());
        row(&[&[self.name.to_owned()], &measured[..], &limits[..]].concat());
    }
}
