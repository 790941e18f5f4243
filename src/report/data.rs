//! Tables with a unit for every column: the source of the page, the CSV files and the JSON.

use crate::html::escape;
use crate::numbers::digits;
use serde_json::{Map, Value, json};

/// A column.
pub struct Column {
    pub name: &'static str,
    /// "" for ratios, counts and words.
    pub unit: &'static str,
}

/// A cell of a row.
pub enum Cell {
    Text(String),
    Number(f64),
    /// No value.
    Empty,
}

/// A table.
pub struct Table {
    /// Name of its file.
    pub name: &'static str,
    pub columns: Vec<Column>,
    pub rows: Vec<Vec<Cell>>,
    /// Whether the page shows the rows; otherwise it only names the file.
    pub on_page: bool,
}

/// A number, or an empty cell for NaN and infinity.
pub fn number(value: f64) -> Cell {
    if value.is_finite() { Cell::Number(value) } else { Cell::Empty }
}

/// Words.
pub fn text(words: impl Into<String>) -> Cell {
    Cell::Text(words.into())
}

impl Column {
    /// The name as a key: `contact_time_s`.
    fn key(&self) -> String {
        let unit = self.unit.replace('/', "_per_");
        format!("{} {unit}", self.name).trim_end().replace([' ', '-'], "_")
    }
}

impl Table {
    /// An empty table; each column has a name and a unit.
    pub fn new<const N: usize>(name: &'static str, columns: [(&'static str, &'static str); N]) -> Table {
        let columns = columns.into_iter().map(|(name, unit)| Column { name, unit }).collect();
        Table { name, columns, rows: Vec::new(), on_page: true }
    }

    /// CSV with all digits; words are quoted.
    pub fn csv(&self) -> String {
        let keys: Vec<_> = self.columns.iter().map(Column::key).collect();
        let cell = |cell: &Cell| match cell {
            Cell::Text(text) => format!("\"{}\"", text.replace('"', "\"\"")),
            Cell::Number(value) => format!("{value:e}"),
            Cell::Empty => String::new(),
        };
        let rows = self.rows.iter().map(|row| row.iter().map(cell).collect::<Vec<_>>().join(",") + "\n");
        format!("{}\n{}", keys.join(","), rows.collect::<String>())
    }

    /// JSON: the rows as objects.
    pub fn json(&self) -> Value {
        let cell = |cell: &Cell| match cell {
            Cell::Text(text) => json!(text),
            Cell::Number(value) => json!(value),
            Cell::Empty => Value::Null,
        };
        let object = |row: &Vec<Cell>| {
            let pairs = self.columns.iter().zip(row).map(|(column, value)| (column.key(), cell(value)));
            Value::Object(pairs.collect::<Map<_, _>>())
        };
        self.rows.iter().map(object).collect()
    }

    /// HTML for people; sorting and copying use the number with all its digits.
    pub fn html(&self) -> String {
        let head = |(index, column): (usize, &Column)| {
            let has_words = self.rows.iter().any(|row| matches!(row[index], Cell::Text(_)));
            let class = if has_words { " class=\"words\"" } else { "" };
            match column.unit {
                "" => format!("<th{class}>{}</th>", column.name),
                unit => format!("<th{class}>{} [{unit}]</th>", column.name),
            }
        };
        let cell = |cell: &Cell| match cell {
            Cell::Text(text) => format!("<td class=\"words\">{}</td>", escape(text)),
            Cell::Number(value) => format!("<td data-value=\"{value:e}\">{}</td>", digits(*value)),
            Cell::Empty => "<td>-</td>".into(),
        };
        let row = |row: &Vec<Cell>| format!("<tr>{}</tr>\n", row.iter().map(cell).collect::<String>());
        format!(
            "<div class=\"table\">\n<table>\n<thead><tr>{}</tr></thead>\n<tbody>\n{}</tbody>\n</table>\n</div>\n",
            self.columns.iter().enumerate().map(head).collect::<String>(),
            self.rows.iter().map(row).collect::<String>()
        )
    }
}
