//! Results as columns of numbers for each law: as CSV and JSON with all digits, and as a short table.

use crate::layout;
use crate::numbers::{Prefixed, cell, prefixed};
use crate::regime;
use serde_json::{Map, Value, json};
use std::fmt::Write;

/// A column: a quantity in SI units.
#[derive(Clone, Debug)]
pub struct Column {
    /// Name in words: "largest force".
    pub name: String,
    /// Unit; empty for a dimensionless number.
    pub unit: &'static str,
}

/// Rows of numbers for each law.
pub struct Columns {
    pub columns: Vec<Column>,
    /// The names of the laws, each with its rows.
    pub laws: Vec<(String, Vec<Vec<f64>>)>,
}

impl Column {
    /// A column with this name and unit.
    pub fn new(name: impl Into<String>, unit: &'static str) -> Column {
        Column { name: name.into(), unit }
    }

    /// The name as a key: `largest_force`.
    pub fn key(&self) -> String {
        self.name.replace(' ', "_")
    }

    /// The name with its unit as a key: `largest_force_N`, `speed_m_per_s`.
    pub fn key_with_unit(&self) -> String {
        let unit = self.unit.replace('/', "_per_").replace('^', "");
        if unit.is_empty() { self.key() } else { format!("{}_{unit}", self.key()) }
    }
}

impl Columns {
    /// The same with the column `valid`, whose numbers follow the rows of all laws.
    pub fn with_valid(mut self, mut valid: impl Iterator<Item = f64>) -> Columns {
        self.columns.push(Column::new("valid", ""));
        self.laws.iter_mut().flat_map(|(_, rows)| rows).for_each(|row| row.extend(valid.next()));
        self
    }

    /// CSV with one line for each row and all digits.
    pub fn csv(&self) -> String {
        let mut text = String::from("law");
        for column in &self.columns {
            write!(text, ",{}", column.key_with_unit()).expect("a String takes everything");
        }
        text.push('\n');
        for (law, rows) in &self.laws {
            for row in rows {
                text += law;
                for value in row {
                    write!(text, ",{value:e}").expect("a String takes everything");
                }
                text.push('\n');
            }
        }
        text
    }

    /// `columns` in their order, each with its unit, which is empty for a dimensionless number; `regimes`, the names of the numbers in
    /// a column of that name; and `laws`, each with a list of numbers for every column. A number that is not finite becomes null.
    pub fn json(&self) -> Value {
        let head = |column: &Column| json!({ "name": column.key(), "unit": column.unit });
        let law = |(law, rows): &(String, Vec<Vec<f64>>)| {
            let mut object = Map::new();
            object.insert("law".into(), json!(law));
            for (index, column) in self.columns.iter().enumerate() {
                object.insert(column.key(), rows.iter().map(|row| json!(row[index])).collect());
            }
            Value::Object(object)
        };
        let heads: Vec<_> = self.columns.iter().map(head).collect();
        json!({ "columns": heads, "regimes": regime::names(), "laws": self.laws.iter().map(law).collect::<Vec<_>>() })
    }

    /// A table with at most `most` rows of each law, with the columns of these `names` and four digits.
    pub fn text(&self, names: &[&str], most: usize) -> String {
        let shown = names.iter().filter_map(|name| self.columns.iter().position(|column| column.name == *name));
        let shown: Vec<usize> = shown.collect();
        let mut text = String::new();
        for (law, rows) in &self.laws {
            if !text.is_empty() {
                text.push('\n');
            }
            text += law;
            text.push('\n');
            let some = some(rows.len(), most);
            let units = shown.iter().map(|column| {
                let sizes = some.iter().map(|row| rows[*row][*column].abs()).filter(|size| size.is_finite());
                prefixed(sizes.fold(0.0, f64::max), self.columns[*column].unit)
            });
            let units: Vec<_> = units.collect();
            let heading = shown.iter().map(|column| self.columns[*column].name.clone()).collect();
            let mut lines = vec![heading, units.iter().map(Prefixed::heading).collect()];
            lines.extend(some.iter().map(|row| {
                let cells = shown.iter().zip(&units);
                cells.map(|(column, unit)| cell(rows[*row][*column], unit.size)).collect()
            }));
            text += &layout::table(&lines, 0, 2);
        }
        text
    }
}

/// At most `most` of `count` indices, evenly spaced, including the first and the last.
pub fn some(count: usize, most: usize) -> Vec<usize> {
    match count {
        count if count <= most => (0..count).collect(),
        count => (0..most).map(|place| (count - 1) * place / (most - 1)).collect(),
    }
}
