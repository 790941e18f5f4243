//! Measurements in tables, as laboratories have them: one reader for tensile tests, rebounds, records of indentations and hardness.
//!
//! | module | what it has |
//! |---|---|
//! | `dialect` | rows of cells, the separator, the decimal sign |
//! | `headings` | quantities and units of columns |

mod dialect;
mod headings;

pub use dialect::Wrong;
pub(crate) use dialect::{Separator, decimal_of, lines_of, number, text_of};
pub use headings::{ColumnKind, asked};

use crate::layout::shortened;
use crate::nearest::one_of;
use crate::numbers::{of_size, significant};
use crate::reading;
use dialect::{Body, Line, MOST_BEFORE, body_of, is_number};
use headings::{Heading, heading, is_known, is_unit, nearest_name, none_known, usual};
use serde_json::{Value, json};

/// The largest number of rows.
const MOST: usize = 1_000_000;

/// What is expected.
const EXAMPLES: &str = "a heading such as `speed [m/s], restitution`, `depth [um], force [N]` or `strain [%]; stress [MPa]`, and numbers \
                        below it";

/// A column that was recognised.
pub struct MeasuredColumn {
    /// Its place, from 0.
    pub index: usize,
    /// The heading, as it is written.
    pub name: String,
    pub kind: &'static ColumnKind,
    /// As it is written; `None` if the heading has none.
    pub unit: Option<String>,
    /// The unit in the SI unit.
    pub size: f64,
}

/// A table with the columns that were recognised.
pub struct Measurement {
    /// The line of the heading.
    pub heading: usize,
    pub columns: Vec<MeasuredColumn>,
    /// The headings of other columns.
    pub unknown: Vec<String>,
    /// The line of each row, and its cells.
    rows: Vec<(usize, Vec<String>)>,
    decimal: char,
    /// Numbers that stand above the heading with their names, such as the section of a specimen, in SI units.
    above: Vec<(&'static ColumnKind, f64)>,
    /// What was read how, in sentences.
    pub notes: Vec<String>,
}

/// The choices of a person.
#[derive(Default)]
pub struct Choices {
    /// The decimal sign, where the file leaves it open.
    pub decimal: Option<char>,
    /// What stands between cells, where it is known.
    pub separator: Option<char>,
    /// Headings of the file, with those that stand for them.
    pub renamed: Vec<(String, String)>,
}

/// Reads a table.
///
/// # Errors
/// The first mistake with its place, and what is expected there.
pub fn read(bytes: &[u8], choices: &Choices) -> Result<Measurement, Wrong> {
    let (said, lines) = lines_of(&text_of(bytes)?)?;
    let said = choices.separator.map(Separator::Sign).or(said);
    if lines.is_empty() {
        return Err(Wrong::whole(format!("the file is empty; expected {EXAMPLES}")));
    }
    let renamed =
        |name: &str| choices.renamed.iter().find(|(from, _)| from == name).map_or(name.into(), |(_, to)| to.clone());
    let names = |cells: &[String]| cells.iter().filter(|cell| is_known(&renamed(cell))).count();
    let body = body_of(&lines, said, names);
    let (at, headings) = heading_of(&lines, &body, names)?;
    let place = lines[at].number;
    if let Some((from, _)) = choices.renamed.iter().find(|(from, _)| !headings.contains(from)) {
        let all: Vec<&str> = headings.iter().map(String::as_str).collect();
        return Err(Wrong::whole(format!("columns names `{from}`, which is no heading; there is {}", one_of(&all))));
    }
    // a name without any likeness takes a column out
    for (from, to) in choices.renamed.iter().filter(|(_, to)| !is_known(to)) {
        if let Some(near) = nearest_name(to) {
            let what = format!("columns calls `{from}` `{to}`, which is no quantity; did you mean `{near}`?");
            return Err(Wrong::whole(format!("{what} Expected {EXAMPLES}")));
        }
    }
    let cells = |line: &Line| body.separator.cells(&line.text);
    let is_units = |cells: &[String]| {
        cells.iter().any(|cell| is_unit(cell)) && cells.iter().all(|cell| cell.is_empty() || is_unit(cell))
    };
    let units = lines.get(at + 1).map(cells).filter(|cells| is_units(cells));
    let (mut columns, mut unknown) = (Vec::new(), Vec::new());
    for (index, name) in headings.iter().enumerate() {
        let below =
            units.as_ref().and_then(|units| units.get(index)).map(|unit| unit.trim_matches(['[', ']', '(', ')']));
        let found =
            heading(&renamed(name), below).map_err(|why| Wrong { line: Some(place), column: Some(index + 1), why })?;
        match found {
            Some(Heading { kind, unit, size }) => {
                columns.push(MeasuredColumn { index, name: name.clone(), kind, unit, size })
            }
            None if !name.is_empty() => unknown.push(name.clone()),
            None => {}
        }
    }
    if columns.is_empty() {
        let scale = lines[at..].iter().take(MOST_BEFORE).flat_map(cells).find_map(|cell| scale_within(&cell));
        return Err(Wrong { line: Some(place), ..none_known(&headings, scale, EXAMPLES) });
    }
    let mut rows = Vec::new();
    let below = &lines[at + 1 + usize::from(units.is_some())..];
    for line in below.iter().filter(|line| !line.is_comment) {
        let row = row_of(cells(line), headings.len(), line.number, body.separator)?;
        if rows.len() == MOST {
            return Err(Wrong::in_line(line.number, format!("there are more than {MOST} rows")));
        }
        if row.iter().any(|cell| !cell.is_empty()) {
            rows.push((line.number, row));
        }
    }
    let used: Vec<Vec<&str>> =
        columns.iter().map(|column| rows.iter().map(|(_, row)| row[column.index].as_str()).collect()).collect();
    let decimal = choices.decimal.map_or_else(|| decimal_of(&used, body.separator), Ok).map_err(Wrong::whole)?;
    let above = lines[..at].iter().filter_map(|line| value_above(line, body.separator, decimal)).collect();
    let passed = lines[..at].iter().filter(|line| !line.is_comment).count();
    let mut notes = Vec::new();
    if passed > 0 {
        let lines = if passed == 1 { "1 line was".into() } else { format!("{passed} lines were") };
        notes.push(format!("Before the heading in line {place}, {lines} passed over."));
    }
    if said.is_none() && body.separator != Separator::None && (body.separator != Separator::Sign(',') || decimal == ',')
    {
        let sign = if decimal == ',' { "comma" } else { "point" };
        notes.push(format!("Cells are separated by {}, with a decimal {sign}.", body.separator.name()));
    }
    let is: Vec<String> = columns.iter().map(MeasuredColumn::words).collect();
    notes.push(format!("Columns: {}.", is.join("; ")));
    let not_used = |name: &String| format!("The column {} is unknown and was not used.", asked(name));
    notes.extend(unknown.iter().map(not_used));
    Ok(Measurement { heading: place, columns, unknown, rows, decimal, above, notes })
}

/// The scale of hardness that ends a text: `ASTM E10 HBW 10/3000`.
fn scale_within(text: &str) -> Option<String> {
    text.match_indices(' ').find_map(|(place, _)| reading::scale_in(&text[place..]))
}

/// The index of the heading in the lines, and its cells: the line above the body with the most names that are known, in the separator of the
/// body or another one; if none is known, the last one before the numbers.
fn heading_of(lines: &[Line], body: &Body, names: impl Fn(&[String]) -> usize) -> Result<(usize, Vec<String>), Wrong> {
    let above = &lines[..body.first.min(MOST_BEFORE)];
    let others = || Separator::ALL.into_iter().filter(|other| *other != body.separator);
    let mut best: Option<(usize, usize, Vec<String>)> = None;
    for (index, line) in above.iter().enumerate().rev() {
        for separator in std::iter::once(body.separator).chain(others()) {
            let cells = separator.cells(&line.text);
            // a table without numbers has any width, and the last cells of its rows may be empty
            let fits = cells.len() == body.width || cells.len() + 1 == body.width || body.width == 0;
            let is_prose = !fits && (line.is_comment || separator != body.separator);
            let is_units = cells.iter().all(|cell| cell.is_empty() || is_unit(cell));
            if is_prose || is_units || cells.iter().any(|cell| is_number(cell)) {
                continue;
            }
            // a known name is worth more than the number of cells
            let score = 3 * names(&cells) + usize::from(fits && (separator == body.separator || body.width > 1));
            if score > best.as_ref().map_or(0, |(other, ..)| *other) {
                best = Some((score, index, cells));
            }
        }
    }
    best.map(|(_, index, cells)| (index, cells))
        .ok_or_else(|| Wrong::whole(format!("the file has no heading; expected {EXAMPLES}")))
}

/// A row with as many cells as the heading.
fn row_of(mut row: Vec<String>, width: usize, line: usize, separator: Separator) -> Result<Vec<String>, Wrong> {
    while row.len() > width && row.last().is_some_and(String::is_empty) {
        row.pop();
    }
    if row.len() != width && row.iter().any(|cell| !cell.is_empty()) {
        let why = if separator == Separator::Sign(',') {
            "; a decimal comma needs another separator than commas"
        } else {
            ""
        };
        let counted = if row.len() == 1 { "1 cell".into() } else { format!("{} cells", row.len()) };
        return Err(Wrong::in_line(
            line,
            format!("{counted}, and the heading has {width}, separated by {}{why}", separator.name()),
        ));
    }
    row.resize(width, String::new());
    Ok(row)
}

/// A number of a specimen in a line such as `"Cross-section",7.5,"mm2"` or `Gauge length [mm]: 30`.
fn value_above(line: &Line, separator: Separator, decimal: char) -> Option<(&'static ColumnKind, f64)> {
    let cells = |separator: Separator| -> Vec<String> {
        separator.cells(&line.text).into_iter().filter(|cell| !cell.is_empty()).collect()
    };
    let ways = [separator, Separator::Sign(':'), Separator::Sign('='), Separator::Sign('\t')].map(cells);
    ways.iter().find_map(|cells| {
        let [name, value, more @ ..] = &cells[..] else { return None };
        // `30 mm` in one cell
        let (digits, unit) = value
            .split_once(' ')
            .map_or((value.as_str(), more.first().map(String::as_str)), |(digits, unit)| (digits, Some(unit)));
        let Heading { kind, size, unit } = heading(name, unit).ok()??;
        let number = number(digits, decimal).filter(|number| *number > 0.0 && unit.is_some())?;
        Some((kind, of_size(number, size)))
    })
}

impl MeasuredColumn {
    /// What the column is, in words.
    fn words(&self) -> String {
        let (name, kind) = (shortened(&self.name), self.kind.names[0]);
        let unit = match &self.unit {
            Some(unit) if unit == "HLD" && !name.to_uppercase().contains("LD") => " in HLD, that of device D".into(),
            Some(unit) => format!(" in {unit}"),
            None if self.kind.unit.is_empty() => String::new(),
            None => format!(" in {} (no unit is given)", self.kind.unit),
        };
        format!("`{name}` is {kind}{unit}")
    }
}

impl Measurement {
    /// The columns of a kind.
    pub fn of(&self, key: &str) -> Vec<&MeasuredColumn> {
        self.columns.iter().filter(|column| column.kind.key == key).collect()
    }

    /// The number above the heading of a kind, in the SI unit.
    pub fn above(&self, key: &str) -> Option<f64> {
        self.above.iter().find(|(kind, _)| kind.key == key).map(|(_, value)| *value)
    }

    /// The line of each row.
    pub fn lines(&self) -> impl Iterator<Item = usize> {
        self.rows.iter().map(|(line, _)| *line)
    }

    /// The numbers of a column in the SI unit.
    ///
    /// # Errors
    /// The first cell that is no number.
    pub fn numbers(&self, column: &MeasuredColumn) -> Result<Vec<f64>, Wrong> {
        let number = |(line, row): &(usize, Vec<String>)| {
            let cell = &row[column.index];
            let found = number(cell, self.decimal).filter(|number| number.is_finite());
            found.map(|number| of_size(number, column.size)).ok_or_else(|| Wrong {
                line: Some(*line),
                column: Some(column.index + 1),
                why: format!("{} = `{}` is no number", column.name, shortened(cell)),
            })
        };
        self.rows.iter().map(number).collect()
    }

    /// The reading of a hardness in each row, `200 HBW 10/3000`. Of several numbers of one scale it is their mean with their standard
    /// deviation, `212 ± 3 HV10`.
    ///
    /// # Errors
    /// The first one that is none.
    pub fn readings(&self) -> Result<Vec<String>, Wrong> {
        let columns = self.of("hardness");
        let scale = columns[0].unit.as_deref();
        if let Some(other) = columns.iter().find(|other| other.unit.as_deref() != scale) {
            let why = format!("`{}` and `{}` are of two scales; leave one out", columns[0].name, other.name);
            return Err(Wrong { line: Some(self.heading), column: Some(other.index + 1), why });
        }
        self.rows.iter().map(|(line, row)| self.reading((*line, row), &columns, scale)).collect()
    }

    fn reading(
        &self,
        (line, row): (usize, &[String]),
        columns: &[&MeasuredColumn],
        scale: Option<&str>,
    ) -> Result<String, Wrong> {
        let given: Vec<_> = columns.iter().copied().filter(|column| !row[column.index].is_empty()).collect();
        let column = given.first().copied().unwrap_or(columns[0]);
        let cell = &row[column.index];
        let wrong = |why: &str| Wrong {
            line: Some(line),
            column: Some(column.index + 1),
            why: format!("{} = `{}` {why}", column.name, shortened(cell)),
        };
        let numbers: Vec<f64> = given.iter().filter_map(|column| number(&row[column.index], self.decimal)).collect();
        let has_letters = cell.contains(|c: char| c.is_alphabetic());
        let text = match (numbers.len(), scale) {
            // a range, or a reading with its own scale
            (0, Some(scale)) if !has_letters => format!("{} {scale}", cell.replace(self.decimal, ".")),
            (0, _) if has_letters => cell.replace(self.decimal, "."),
            (_, None) => return Err(wrong("has no scale; expected a heading such as `HV10` or `HBW 10/3000`")),
            (1, Some(scale)) => format!("{} {scale}", significant(numbers[0], 6)),
            (count, Some(scale)) if count == given.len() && count > 0 => {
                let mean = numbers.iter().sum::<f64>() / count as f64;
                let squares: f64 = numbers.iter().map(|number| (number - mean) * (number - mean)).sum();
                let spread = (squares / (count as f64 - 1.0)).sqrt();
                let spread = if spread > 0.0 { format!(" \u{b1} {}", significant(spread, 3)) } else { String::new() };
                format!("{}{spread} {scale}", significant(mean, 6))
            }
            _ => return Err(wrong("is no number")),
        };
        reading::check_reading(&text).map_err(|why| wrong(&format!("is no reading: {why}")))?;
        Ok(text)
    }

    /// All of it for programs: `columns`, each with its `quantity`, `unit`, `size` in the SI unit and `cells`, which are numbers, texts that
    /// are none, or null where a cell is empty; the `lines` of the rows; `readings` of hardness, if there are any.
    ///
    /// # Errors
    /// Two columns with one quantity.
    pub fn json(&self) -> Result<Value, Wrong> {
        for (index, column) in self.columns.iter().enumerate() {
            let twice = self.columns[..index].iter().find(|other| other.kind.key == column.kind.key);
            let may_be = ["hardness", "strain", "stress", "time"].contains(&column.kind.key);
            if let Some(other) = twice.filter(|_| !may_be) {
                let why = format!(
                    "`{}` and `{}` are both {}; give one another name, or pass columns=",
                    other.name, column.name, column.kind.names[0]
                );
                return Err(Wrong::in_line(self.heading, why));
            }
        }
        let cell = |cell: &String| match number(cell, self.decimal).filter(|number| number.is_finite()) {
            Some(number) => json!(number),
            None if cell.is_empty() => Value::Null,
            None => json!(cell),
        };
        let column = |column: &MeasuredColumn| {
            let MeasuredColumn { index, name, kind, unit, size } = column;
            let largest = Some(kind.largest).filter(|largest| largest.is_finite());
            json!({
                "index": index, "heading": name, "quantity": kind.key, "name": kind.names[0], "unit": unit, "size": size, "si": kind.unit,
                "usual": usual(kind), "largest": largest,
                "cells": self.rows.iter().map(|(_, row)| cell(&row[*index])).collect::<Value>(),
            })
        };
        let readings = if self.of("hardness").is_empty() { Ok(Vec::new()) } else { self.readings() };
        Ok(json!({
            "heading": self.heading,
            "columns": self.columns.iter().map(column).collect::<Value>(),
            "unknown": self.unknown.iter().map(|name| asked(name)).collect::<Value>(),
            "lines": self.lines().collect::<Value>(),
            "notes": self.notes,
            "readings": readings.as_ref().ok(),
            "wrong_reading": readings.as_ref().err(),
            "examples": EXAMPLES,
        }))
    }
}
