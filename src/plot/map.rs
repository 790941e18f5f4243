//! Maps: rows of cells, coloured by the class of their numbers.

use super::{Area, IN_MEMORY, SCALE, label, svg};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// A map.
pub struct Map {
    pub x_title: String,
    /// Title of the columns, which are spaced logarithmically.
    pub columns: Vec<f64>,
    pub rows: Vec<Row>,
    /// Title of the numbers in the cells.
    pub legend: String,
    /// The classes in ascending order.
    pub classes: Vec<Class>,
    /// Meaning of the bars in the rows.
    pub bar_legend: String,
}

/// A row of cells.
pub struct Row {
    pub name: String,
    /// One number for each column.
    pub values: Vec<f64>,
    /// Place of the bar, in the numbers of the columns.
    pub bar: Option<f64>,
}

/// A class of numbers with one colour.
pub struct Class {
    /// The largest number of the class.
    pub upto: f64,
    pub colour: (u8, u8, u8),
    /// Its meaning; neighbouring classes may share it.
    pub meaning: &'static str,
    /// Whether its cells have a cross, for readers who can't distinguish the colour.
    pub crossed: bool,
}

/// Sizes [pixels].
const WIDTH: i32 = 570;
const LEFT: i32 = 124;
const MARGIN: i32 = 14;
const ROW: i32 = 30;
const CLASS: i32 = 54;
const STRIP: i32 = 18;
/// Height below the cells: numbers and title of the columns, the bar, and the classes.
const BELOW: i32 = 172;

impl Map {
    /// The map as SVG.
    pub fn svg(&self) -> String {
        let bottom = MARGIN + ROW * self.rows.len() as i32;
        let picture = svg(WIDTH as u32, (bottom + BELOW) as u32, |root| {
            self.draw_cells(root);
            self.draw_columns(root, bottom);
            write(root, &self.bar_legend, (LEFT + 12, bottom + 66), HPos::Left);
            draw_bar(root, LEFT + 4, (bottom + 58, bottom + 74));
            self.draw_classes(root, bottom + 96);
            String::new()
        });
        picture.replacen("<svg ", "<svg class=\"map\" ", 1)
    }

    /// The position of a column's number [pixels].
    fn place(&self, number: f64) -> i32 {
        let last = self.columns.len() - 1;
        let (first, range) = (self.columns[0].ln(), self.columns[last].ln() - self.columns[0].ln());
        self.edge((number.ln() - first) / range * last as f64 + 0.5)
    }

    /// The right edge of this number of columns [pixels].
    fn edge(&self, columns: f64) -> i32 {
        LEFT + (f64::from(WIDTH - LEFT - MARGIN) * columns / self.columns.len() as f64).round() as i32
    }

    /// The class of a number.
    fn class(&self, value: f64) -> Option<&Class> {
        self.classes.iter().find(|class| value <= class.upto)
    }

    fn draw_cells(&self, root: &Area) {
        for (index, row) in self.rows.iter().enumerate() {
            let top = MARGIN + ROW * index as i32;
            write(root, &row.name, (LEFT - 8, top + ROW / 2), HPos::Right);
            let classes = || row.values.iter().map(|value| self.class(*value)).enumerate();
            for (column, class) in classes() {
                // up to the end of the row, without gaps between neighbours
                let (left, right) = (self.edge(column as f64), self.edge(self.columns.len() as f64));
                fill(root, (left, top), (right, top + ROW), class.map_or(WHITE, Class::fill));
            }
            for (column, _) in classes().filter(|(_, class)| class.is_some_and(|class| class.crossed)) {
                cross(root, self.edge(column as f64 + 0.5), top + ROW / 2);
            }
            if let Some(number) = row.bar {
                draw_bar(root, self.place(number), (top, top + ROW));
            }
            frame(root, (self.edge(0.0), top), (self.edge(self.columns.len() as f64), top + ROW));
        }
    }

    /// Round numbers for the columns, and their title.
    fn draw_columns(&self, root: &Area, bottom: i32) {
        let (first, last) = (self.columns[0], self.columns[self.columns.len() - 1]);
        let decades = first.log10().floor() as i32..=last.log10().floor() as i32;
        let round = decades.flat_map(|decade| [1.0, 2.0, 5.0].map(|digit| digit * 10f64.powi(decade)));
        // an end with rounding errors still counts
        for number in round.filter(|number| (first * (1.0 - 1e-9)..last * (1.0 + 1e-9)).contains(number)) {
            let x = self.place(number);
            line(root, (x, bottom), (x, bottom + 5), BLACK, 1);
            write(root, &label(&number), (x, bottom + 15), HPos::Center);
        }
        write(root, &self.x_title, ((LEFT + WIDTH - MARGIN) / 2, bottom + 38), HPos::Center);
    }

    /// The classes with the limits between them, and their meanings.
    fn draw_classes(&self, root: &Area, top: i32) {
        let left = (WIDTH - CLASS * self.classes.len() as i32) / 2;
        write(root, &self.legend, (WIDTH / 2, top), HPos::Center);
        let strip = top + 31;
        for (index, class) in self.classes.iter().enumerate() {
            let start = left + CLASS * index as i32;
            fill(root, (start, strip), (start + CLASS, strip + STRIP), class.fill());
            if class.crossed {
                cross(root, start + CLASS / 2, strip + STRIP / 2);
            }
            if index + 1 < self.classes.len() {
                write(root, &short(class.upto), (start + CLASS, strip + STRIP + 10), HPos::Center);
            }
        }
        let right = left + CLASS * self.classes.len() as i32;
        frame(root, (left, strip), (right, strip + STRIP));
        let mut start = left;
        for group in self.classes.chunk_by(|one, other| one.meaning == other.meaning) {
            let end = start + CLASS * group.len() as i32;
            write(root, group[0].meaning, ((start + end) / 2, strip - 10), HPos::Center);
            start = end;
        }
    }
}

/// Three digits.
fn short(value: f64) -> String {
    label(&format!("{value:.2e}").parse().expect("a number"))
}

impl Class {
    fn fill(&self) -> RGBColor {
        let (red, green, blue) = self.colour;
        RGBColor(red, green, blue)
    }
}

/// A rectangle between two corners [pixels].
fn fill(root: &Area, from: (i32, i32), to: (i32, i32), colour: RGBColor) {
    root.draw(&Rectangle::new([from, to].map(scaled), colour.filled())).expect(IN_MEMORY);
}

/// The border of a rectangle between two corners [pixels].
fn frame(root: &Area, from: (i32, i32), to: (i32, i32)) {
    root.draw(&Rectangle::new([from, to].map(scaled), BLACK.stroke_width(SCALE))).expect(IN_MEMORY);
}

/// A white cross around a point [pixels].
fn cross(root: &Area, x: i32, y: i32) {
    line(root, (x - 3, y), (x + 3, y), WHITE, 2);
    line(root, (x, y - 3), (x, y + 3), WHITE, 2);
}

/// The bar of a row, from top to bottom [pixels], with a border that makes it visible on every colour.
fn draw_bar(root: &Area, x: i32, (top, bottom): (i32, i32)) {
    line(root, (x, top), (x, bottom), WHITE, 6);
    line(root, (x, top), (x, bottom), BLACK, 3);
}

/// Coordinates for plotters.
fn scaled((x, y): (i32, i32)) -> (i32, i32) {
    (SCALE as i32 * x, SCALE as i32 * y)
}

fn line(root: &Area, from: (i32, i32), to: (i32, i32), colour: RGBColor, width: u32) {
    root.draw(&PathElement::new([from, to].map(scaled), colour.stroke_width(SCALE * width))).expect(IN_MEMORY);
}

/// Words at a point [pixels], vertically centred.
fn write(root: &Area, words: &str, at: (i32, i32), side: HPos) {
    let style = TextStyle::from(("sans-serif", SCALE * 13).into_font()).pos(Pos::new(side, VPos::Center));
    root.draw(&Text::new(words.to_string(), scaled(at), style)).expect(IN_MEMORY);
}
