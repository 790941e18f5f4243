//! Tables in Markdown, as in the chapter on figures of the guide.

/// The head of a table with `columns`.
pub fn head(columns: &[&str]) {
    println!("\n| {} |\n|{}", columns.join(" | "), "---|".repeat(columns.len()));
}

/// A row of `cells`.
pub fn row(cells: &[String]) {
    println!("| {} |", cells.join(" | "));
}

/// Placeholder for a missing value.
pub const NOTHING: &str = "-";

/// `value` with thousands separators.
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

/// `value` in the format of [`number`], if there is one.
pub fn cell(value: Option<f64>, decimals: usize) -> String {
    value.map_or(NOTHING.to_owned(), |value| number(value, decimals))
}

/// The goal of a figure: a limit that it must not exceed, and a target.
#[derive(Clone, Copy, PartialEq)]
pub enum Goal {
    /// No goal.
    None,
    /// In the unit of the figure.
    Value(f64, f64),
    /// Relative to the same figure of the empty FMU.
    OverEmpty(f64, f64),
    /// Relative to the same figure of the FMU in C.
    OverC(f64, f64),
}

/// The columns of goals.
pub const GOALS: [&str; 3] = ["must", "aim", "met"];

impl Goal {
    /// The limit, the target, and which of them `brinell` meets compared with the other two FMUs.
    pub fn cells(self, [brinell, c, empty]: [Option<f64>; 3], unit: &str, decimals: usize) -> [String; 3] {
        let over = |other: Option<f64>| brinell.zip(other).map(|(brinell, other)| brinell / other);
        let (value, must, aim, write): (_, _, _, &dyn Fn(f64) -> String) = match self {
            Goal::None => return [NOTHING; 3].map(str::to_owned),
            Goal::Value(must, aim) => {
                (brinell, must, aim, &|limit| format!("{} {unit}", number(limit, decimals)).trim().to_owned())
            }
            Goal::OverEmpty(must, aim) => (over(empty), must, aim, &|limit| format!("{limit} x empty")),
            Goal::OverC(must, aim) => (over(c), must, aim, &|limit| format!("{limit} x C")),
        };
        let limit = |limit: f64| if limit.is_finite() { write(limit) } else { NOTHING.to_owned() };
        let met = match value {
            None => NOTHING,
            Some(value) if value <= aim => "aim",
            Some(value) if value <= must => "must",
            Some(_) => "no",
        };
        [limit(must), limit(aim), met.to_owned()]
    }
}

/// A figure of the three FMUs, with its goal.
pub struct Row<'text> {
    pub name: &'text str,
    pub unit: &'text str,
    pub decimals: usize,
    pub goal: Goal,
}

impl Row<'_> {
    /// The head of a table of such rows.
    pub fn head() {
        let columns = ["figure", "Brinell", "C", "empty", "Brinell / C", "Brinell / empty"];
        head(&[&columns[..], &GOALS].concat());
    }

    pub fn print(&self, values: [Option<f64>; 3]) {
        let [brinell, c, empty] = values;
        let measured = |value: Option<f64>| match value {
            Some(_) => format!("{} {}", cell(value, self.decimals), self.unit).trim().to_owned(),
            None => NOTHING.to_owned(),
        };
        let ratio = |other: Option<f64>| cell(brinell.zip(other).map(|(brinell, other)| brinell / other), 2);
        let measured = [measured(brinell), measured(c), measured(empty), ratio(c), ratio(empty)];
        row(&[&[self.name.to_owned()], &measured[..], &self.goal.cells(values, self.unit, self.decimals)].concat());
    }
}
