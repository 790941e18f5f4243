//! Reading a measurement: a CSV file with two columns.

use crate::layout::{shortened, shown};
use crate::nearest::one_of;
use crate::units;
use csv::{ReaderBuilder, StringRecord, Trim};
use std::path::{Path, PathBuf};

/// Largest number of rows.
const MOST: usize = 10_000;

/// What was measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Restitution over the closing speed [m/s].
    Restitution,
    /// Force [N] over the indentation [m] of a first loading.
    Force,
}

/// A measurement.
#[derive(Clone, Debug)]
pub struct Measured {
    pub kind: Kind,
    /// In SI units, in ascending order of the first number.
    pub points: Vec<(f64, f64)>,
    /// Number of points that the file has besides: they belong to no first loading.
    pub unloaded: usize,
}

/// Force below that of the first loading at the same depth, as a part of it, that tells an unloading from scatter.
const UNLOADED: f64 = 0.9;

impl Measured {
    /// The number of different points.
    pub fn different(&self) -> usize {
        let mut points = self.points.clone();
        points.sort_by(|one, other| one.0.total_cmp(&other.0).then(one.1.total_cmp(&other.1)));
        points.dedup();
        points.len()
    }

    /// A remark on the points that were left out.
    pub fn left_out(&self) -> Option<String> {
        (self.unloaded > 0).then(|| {
            format!(
                "The record has unloadings: {} points without a greater depth and force than all before them were left \
                 out, since they belong to no first loading.",
                self.unloaded
            )
        })
    }
}

/// The points of a first loading among those of a record of depth and force, in the order of the file: each is deeper than
/// all before it, under a larger force. All points, if none shows an unloading: tests of several specimens may follow each other.
fn first_loading(points: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    let mut loading: Vec<(f64, f64)> = Vec::new();
    let mut has_unloading = false;
    for &(depth, force) in &points {
        let deeper = loading.partition_point(|point| point.0 < depth);
        match (deeper.checked_sub(1).and_then(|below| loading.get(below)), loading.get(deeper)) {
            (_, None) => loading.push((depth, force)),
            (Some(below), Some(above)) => {
                let part = (depth - below.0) / (above.0 - below.0);
                has_unloading |= force < UNLOADED * (below.1 + part * (above.1 - below.1));
            }
            (None, Some(_)) => {}
        }
    }
    if !has_unloading {
        return points;
    }
    // where an unloading begins, creep makes the contact deeper while its force falls
    let mut largest = 0.0;
    loading.retain(|(_, force)| {
        let is_larger = *force > largest;
        largest = force.max(largest);
        is_larger
    });
    loading
}

/// A file that is no measurement.
#[derive(Debug, thiserror::Error)]
pub enum MeasuredError {
    #[error("{}: {source}", shown(path))]
    Unreadable { path: PathBuf, source: std::io::Error },
    #[error("{}: {message}; expected {EXPECTED}", shown(path))]
    Empty { path: PathBuf, message: &'static str },
    #[error("{}:{line}: {message}", shown(path))]
    Line { path: PathBuf, line: u64, message: String },
    #[error("{}:{line}, column {column}: {message}", shown(path))]
    Cell { path: PathBuf, line: u64, column: usize, message: String },
}

const EXPECTED: &str =
    "a first line such as `speed [m/s], restitution` or `depth [um], force [N]`, and numbers below it";

/// A quantity that a column can have.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Quantity {
    Speed,
    Restitution,
    Depth,
    Force,
}

impl Quantity {
    const ALL: [(&'static str, Quantity); 5] = [
        ("speed", Quantity::Speed),
        ("restitution", Quantity::Restitution),
        ("depth", Quantity::Depth),
        ("indentation", Quantity::Depth),
        ("force", Quantity::Force),
    ];

    fn unit(self) -> &'static str {
        match self {
            Quantity::Speed => "m/s",
            Quantity::Restitution => "",
            Quantity::Depth => "m",
            Quantity::Force => "N",
        }
    }
}

/// A column of the file.
#[derive(Clone, Copy)]
struct Column {
    quantity: Quantity,
    name: &'static str,
    /// Its unit in SI units.
    size: f64,
}

impl Kind {
    /// The names of the two columns with their SI units.
    pub fn titles(self) -> [&'static str; 2] {
        match self {
            Kind::Restitution => ["speed [m/s]", "restitution"],
            Kind::Force => ["depth [m]", "force [N]"],
        }
    }
}

/// Reads the measurement at `path`.
///
/// # Errors
/// [`MeasuredError`] with the place of the first error, and what is expected there.
pub fn read(path: &Path) -> Result<Measured, MeasuredError> {
    let unreadable = |source| MeasuredError::Unreadable { path: path.into(), source };
    let bytes = std::fs::read(path).map_err(unreadable)?;
    let text = String::from_utf8(bytes).map_err(|_| {
        unreadable(std::io::Error::new(std::io::ErrorKind::InvalidData, "the file is no text in UTF-8"))
    })?;
    parse(text.trim_start_matches('\u{feff}'), path)
}

/// Reads the measurement in `text`; `path` is for messages.
fn parse(text: &str, path: &Path) -> Result<Measured, MeasuredError> {
    let mut reader = ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .trim(Trim::All)
        .comment(Some(b'#'))
        .from_reader(text.as_bytes());
    let empty = |message| MeasuredError::Empty { path: path.into(), message };
    let (mut columns, mut points) = (None, Vec::new());
    for (index, record) in reader.records().enumerate() {
        let line = |record: &StringRecord| record.position().map_or(index as u64 + 1, |start| line_of(text, start));
        let record = record.map_err(|error| MeasuredError::Line {
            path: path.into(),
            line: error.position().map_or(index as u64 + 1, csv::Position::line),
            message: "a quotation mark is not closed".into(),
        })?;
        let place = Place { path, line: line(&record) };
        match columns {
            None => columns = Some(heading(&record, place)?),
            Some(_) if points.len() == MOST => return Err(place.line(format!("there are more than {MOST} rows"))),
            Some(columns) => points.push(row(&record, columns, place)?),
        }
    }
    let columns = columns.ok_or_else(|| empty("the file is empty"))?;
    if points.is_empty() {
        return Err(empty("there are no numbers"));
    }
    let [first, _] = columns;
    if matches!(first.quantity, Quantity::Restitution | Quantity::Force) {
        points.iter_mut().for_each(|(one, other)| std::mem::swap(one, other));
    }
    let kind = match first.quantity {
        Quantity::Speed | Quantity::Restitution => Kind::Restitution,
        Quantity::Depth | Quantity::Force => Kind::Force,
    };
    let count = points.len();
    let mut points = if kind == Kind::Force { first_loading(points) } else { points };
    points.sort_by(|one, other| one.0.total_cmp(&other.0));
    Ok(Measured { kind, unloaded: count - points.len(), points })
}

/// The number of the line of a record that was read from this `start` on: blank lines and comments may precede it.
fn line_of(text: &str, start: &csv::Position) -> u64 {
    let start = start.byte() as usize;
    let before = text.get(..start).unwrap_or_default().matches('\n').count();
    let skipped = text.get(start..).unwrap_or_default().lines().take_while(|line| {
        let line = line.trim();
        line.is_empty() || line.starts_with('#')
    });
    (before + skipped.count() + 1) as u64
}

/// A line of the file.
#[derive(Clone, Copy)]
struct Place<'a> {
    path: &'a Path,
    line: u64,
}

impl Place<'_> {
    fn line(self, message: String) -> MeasuredError {
        MeasuredError::Line { path: self.path.into(), line: self.line, message }
    }

    /// An error in the cell at `index`.
    fn cell(self, index: usize, message: String) -> MeasuredError {
        MeasuredError::Cell { path: self.path.into(), line: self.line, column: index + 1, message }
    }
}

/// The two columns that the first line names.
fn heading(record: &StringRecord, place: Place) -> Result<[Column; 2], MeasuredError> {
    if record.len() != 2 {
        let cells = shortened(&record.iter().collect::<Vec<_>>().join(","));
        let problem = match record.len() {
            1 => "has no comma; columns are separated by commas, and decimals have a point".into(),
            count => format!("has {count} columns, separated by commas"),
        };
        return Err(place.line(format!("`{cells}` {problem}; expected {EXPECTED}")));
    }
    let [one, other] = [0, 1].map(|index| column(&record[index]).map_err(|message| place.cell(index, message)));
    let (one, other) = (one?, other?);
    let is = |first, second| {
        (one.quantity, other.quantity) == (first, second) || (other.quantity, one.quantity) == (first, second)
    };
    if is(Quantity::Speed, Quantity::Restitution) || is(Quantity::Depth, Quantity::Force) {
        return Ok([one, other]);
    }
    Err(place.line(format!("{} and {} don't belong together; expected {EXPECTED}", one.name, other.name)))
}

/// The column with this heading: `depth`, `depth [um]` or `depth_um`.
fn column(heading: &str) -> Result<Column, String> {
    let (name, unit) = match heading.split_once('[') {
        Some((name, unit)) => (name.trim(), unit.trim_end().strip_suffix(']').map(str::trim)),
        None => match heading.split_once('_') {
            Some((name, unit)) => (name, Some(unit)),
            None => (heading, Some("")),
        },
    };
    let unit = unit.ok_or_else(|| format!("`{heading}` has no closing bracket"))?.replace("_per_", "/");
    let lower = name.to_lowercase();
    let Some((name, quantity)) = Quantity::ALL.into_iter().find(|(known, _)| *known == lower) else {
        let names = Quantity::ALL.map(|(name, _)| name);
        return Err(format!("no quantity is called `{name}`; expected {}", one_of(&names)));
    };
    let size = match (unit.as_str(), quantity.unit()) {
        ("", _) => Some(1.0),
        (_, "") => None,
        (unit, base) => units::size(unit, base),
    };
    let size = size.ok_or_else(|| match quantity.unit() {
        "" => format!("{name} has no unit, not `{unit}`"),
        base => format!("`{unit}` is no unit of {name}; expected {}", one_of(&units::names(base))),
    })?;
    Ok(Column { quantity, name, size })
}

/// The numbers of a line, in SI units.
fn row(record: &StringRecord, columns: [Column; 2], place: Place) -> Result<(f64, f64), MeasuredError> {
    if record.len() != 2 {
        return Err(place.line(format!("{} numbers instead of two", record.len())));
    }
    let number = |index: usize| {
        let Column { quantity, name, size } = columns[index];
        let value: f64 = record[index]
            .parse()
            .map_err(|_| place.cell(index, format!("{name} = `{}` is no number", shortened(&record[index]))))?;
        let value = size * value;
        if quantity == Quantity::Restitution && !(value > 0.0 && value <= 1.0) {
            return Err(place.cell(index, format!("restitution = {value} must be above 0 and at most 1")));
        }
        if !(value > 0.0 && value.is_finite()) {
            return Err(
                place.cell(index, format!("{name} = {} must be positive and finite", shortened(&record[index])))
            );
        }
        Ok(value)
    };
    Ok((number(0)?, number(1)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(text: &str) -> Result<Measured, String> {
        parse(text, Path::new("m.csv")).map_err(|error| error.to_string())
    }

    #[test]
    fn a_measurement_is_read_with_its_units_in_either_order() {
        let files = [
            "speed,restitution\n2,0.5\n1,0.6\n",
            "# a drop test\nrestitution , speed [m/s]\r\n0.5, 2\n\n0.6, 1\n",
            "Speed [mm/s],restitution\n2000,0.5\n1e3,0.6",
            "speed_m_per_s,restitution\n2,0.5\n1,0.6\n",
        ];
        for text in files {
            let measured = parsed(text).expect(text);
            assert_eq!((measured.kind, measured.points), (Kind::Restitution, vec![(1.0, 0.6), (2.0, 0.5)]), "{text}");
        }
        let measured = parsed("depth [um],force [kN]\n12,0.3\n").expect("a measurement");
        assert_eq!(measured.kind, Kind::Force);
        assert!((measured.points[0].0 - 12e-6).abs() < 1e-20 && measured.points[0].1 == 300.0);
        assert_eq!(
            parsed("indentation_m,force_N\n1e-6,2\n").expect("as `brinell curve` writes it").points,
            [(1e-6, 2.0)]
        );
    }

    /// A ball of tungsten carbide on steel, every 20th point of a machine's record (see experiment/README.md): unloadings were
    /// once fitted as a first loading.
    #[test]
    fn unloadings_of_a_record_are_left_out_and_counted() {
        let measured = read(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/experiment/indentation_record.csv")));
        let measured = measured.expect("a measurement");
        assert!(measured.unloaded > 20 && measured.points.len() > 10, "{measured:?}");
        assert!(measured.points.is_sorted_by(|one, other| one.0 < other.0 && one.1 < other.1), "{measured:?}");
        assert!(measured.left_out().is_some_and(|remark| remark.contains("unloadings")));
    }

    #[test]
    fn a_first_loading_in_any_order_and_of_several_specimens_is_kept() {
        for text in [
            "depth [um],force\n1,2\n2,5\n3,9\n",
            "depth [um],force\n3,9\n2,5\n1,2\n",
            "depth [um],force\n2,5\n1,2\n3,9\n",
            "depth [um],force\n1,2\n2,5\n3,9\n1,2.1\n2,4.8\n3,8.9\n",
        ] {
            let measured = parsed(text).expect(text);
            assert_eq!((measured.unloaded, measured.left_out()), (0, None), "{text}");
        }
        let unloaded = parsed("depth [um],force\n1,2\n2,5\n3,9\n2.5,4\n2.9,8\n4,14\n").expect("a record");
        assert_eq!((unloaded.unloaded, unloaded.points.len()), (2, 4));
    }

    #[test]
    fn errors_name_the_line_and_the_column() {
        for (text, words) in [
            ("", "m.csv: the file is empty; expected a first line such as `speed [m/s], restitution`"),
            ("speed,restitution\n", "m.csv: there are no numbers"),
            (
                "speed;restitution\n1;0.5\n",
                "m.csv:1: `speed;restitution` has no comma; columns are separated by commas",
            ),
            ("speed,restitution,mass\n", "m.csv:1: `speed,restitution,mass` has 3 columns"),
            ("velocity,restitution\n", "m.csv:1, column 1: no quantity is called `velocity`; expected"),
            ("1.0,0.5\n", "m.csv:1, column 1: no quantity is called `1.0`"),
            ("speed [mph],restitution\n", "m.csv:1, column 1: `mph` is no unit of speed; expected"),
            ("speed [m/s,restitution\n", "m.csv:1, column 1: `speed [m/s` has no closing bracket"),
            ("speed,restitution [%]\n", "m.csv:1, column 2: restitution has no unit, not `%`"),
            ("speed,force\n", "m.csv:1: speed and force don't belong together"),
            ("speed,speed\n", "m.csv:1: speed and speed don't belong together"),
            ("speed,restitution\n1,0.5\n2,half\n", "m.csv:3, column 2: restitution = `half` is no number"),
            (
                "speed,restitution\n1,0.5\n\n2,1.2\n",
                "m.csv:4, column 2: restitution = 1.2 must be above 0 and at most 1",
            ),
            ("# one\r\nspeed,restitution\r\n\r\n# two\r\n1,0.5\r\n\r\n2,2\r\n", "m.csv:7, column 2: restitution = 2"),
            ("speed,restitution\n0,0.5\n", "m.csv:2, column 1: speed = 0 must be positive and finite"),
            ("speed,restitution\nNaN,0.5\n", "m.csv:2, column 1: speed = NaN must be positive"),
            ("speed,restitution\ninf,0.5\n", "m.csv:2, column 1: speed = inf must be positive"),
            ("speed,restitution\n1\n", "m.csv:2: 1 numbers instead of two"),
            ("depth,force\n1e-6,-3\n", "m.csv:2, column 2: force = -3 must be positive"),
            ("depth,force\n,3\n", "m.csv:2, column 1: depth = `` is no number"),
        ] {
            let error = parsed(text).expect_err(text);
            assert!(error.starts_with(words), "{text:?}: {error}, not {words}");
        }
    }
}
