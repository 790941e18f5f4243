//! Pictures: lines and dots over two axes, and maps, as SVG.

mod map;

pub use map::{Class, Map, Row};

use plotters::coord::ranged1d::{Ranged, ValueFormatter};
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::ops::Range;

/// A line, or dots.
pub struct Series {
    pub label: String,
    pub points: Vec<(f64, f64)>,
    /// Dots instead of a line: data, not a law.
    pub dots: bool,
}

/// A picture.
pub struct Picture {
    pub x_title: String,
    pub y_title: String,
    /// Logarithmic axes; points at or below zero are then left out.
    pub logarithmic: (bool, bool),
    pub series: Vec<Series>,
}

/// plotters puts everything on whole pixels: pictures are drawn large and shown small, so that curves are smooth.
const SCALE: u32 = 8;

/// Colours that can be told apart, also by most of the colour-blind (P. Green-Armytage; M. Okabe, K. Ito).
const COLOURS: [RGBColor; 12] = [
    RGBColor(0, 90, 160),
    RGBColor(213, 94, 0),
    RGBColor(0, 140, 100),
    RGBColor(180, 80, 140),
    RGBColor(150, 110, 0),
    RGBColor(86, 160, 220),
    RGBColor(120, 60, 20),
    RGBColor(110, 110, 110),
    RGBColor(220, 50, 60),
    RGBColor(90, 60, 170),
    RGBColor(60, 150, 30),
    RGBColor(230, 150, 0),
];

impl Picture {
    /// The picture as SVG of `width` by `height` pixels.
    pub fn svg(&self, width: u32, height: u32) -> String {
        // beside the curves, where no legend hides any
        let beside = self.series.len() > 2;
        svg(width, height, |root| {
            self.draw_into(root, if beside { LEGEND } else { 0 });
            self.draw_legend(root, if beside { width - LEGEND } else { 100 });
        })
    }

    /// The picture without the names of its series.
    pub fn svg_without_legend(&self, width: u32, height: u32) -> String {
        svg(width, height, |root| self.draw_into(root, 0))
    }

    /// Axes and curves, with `room` [pixels] to the right of them.
    fn draw_into(&self, root: &Area, room: u32) {
        let mut builder = ChartBuilder::on(root);
        builder
            .margin(12 * SCALE)
            .margin_right((12 + room) * SCALE)
            .x_label_area_size(44 * SCALE)
            .y_label_area_size(68 * SCALE);
        let (x, y) = (self.range(|point| point.0, self.logarithmic.0), self.range(|point| point.1, self.logarithmic.1));
        match self.logarithmic {
            (false, false) => self.draw(builder.build_cartesian_2d(linear(x), linear(y))),
            (true, false) => self.draw(builder.build_cartesian_2d(x.log_scale(), linear(y))),
            (false, true) => self.draw(builder.build_cartesian_2d(linear(x), y.log_scale())),
            (true, true) => self.draw(builder.build_cartesian_2d(x.log_scale(), y.log_scale())),
        }
    }

    /// Whether a point can be shown.
    fn fits(&self, &(x, y): &(f64, f64)) -> bool {
        let (x_log, y_log) = self.logarithmic;
        (x > 0.0 || !x_log) && (y > 0.0 || !y_log) && x.is_finite() && y.is_finite()
    }

    /// The pieces of a series between points that can't be shown.
    fn pieces<'a>(&'a self, series: &'a Series) -> impl Iterator<Item = &'a [(f64, f64)]> {
        series.points.split(|point| !self.fits(point)).filter(|piece| !piece.is_empty())
    }

    /// The range of one coordinate of the points, with a little room; from zero where nothing is below it. Pictures over the
    /// same arguments have the same range of them, whatever of their values can be shown.
    fn range(&self, value: impl Fn(&(f64, f64)) -> f64, logarithmic: bool) -> Range<f64> {
        let points = || self.series.iter().flat_map(|series| &series.points);
        let values = || points().map(&value).filter(|&value| value.is_finite() && (value > 0.0 || !logarithmic));
        let (low, high) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
        match logarithmic {
            // nothing to show, or nothing but zeros
            true if high <= 0.0 => 0.1..1.0,
            false if high <= low.min(0.0) => 0.0..1.0,
            // a little room, so that no line hides under an axis, and a power of ten at the end has its label
            true => low / 1.3..high * 1.1,
            false => low.min(0.0)..high + 0.06 * (high - low.min(0.0)),
        }
    }

    fn draw<'a, X, Y>(
        &self,
        chart: Result<ChartContext<'a, SVGBackend<'a>, Cartesian2d<X, Y>>, DrawingAreaErrorKind<std::io::Error>>,
    ) where
        X: Ranged<ValueType = f64> + ValueFormatter<f64>,
        Y: Ranged<ValueType = f64> + ValueFormatter<f64>,
    {
        let mut chart = chart.expect(IN_MEMORY);
        let font = |size: u32| ("sans-serif", SCALE * size);
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(RGBColor(221, 221, 221).stroke_width(SCALE))
            .axis_style(BLACK.stroke_width(SCALE))
            .set_all_tick_mark_size(5 * SCALE)
            .x_label_formatter(&label)
            .y_label_formatter(&label)
            .x_desc(&self.x_title)
            .y_desc(&self.y_title)
            .axis_desc_style(font(15))
            .label_style(font(13))
            .draw()
            .expect(IN_MEMORY);
        for (index, series) in self.series.iter().enumerate() {
            if series.dots {
                chart.draw_series(self.pieces(series).flatten().map(|&point| dot(point))).expect(IN_MEMORY);
                continue;
            }
            for piece in self.pieces(series) {
                chart.draw_series(LineSeries::new(piece.iter().copied(), self.stroke(index))).expect(IN_MEMORY);
            }
        }
    }

    /// The line of the series at `index`: wider where another one will cover it, so that both can be seen.
    fn stroke(&self, index: usize) -> ShapeStyle {
        let style = stroke(index);
        let points = &self.series[index].points;
        let covers =
            |other: &Series| !other.dots && other.points.len() == points.len() && coincide(&other.points, points);
        let wider = if self.series[index + 1..].iter().any(covers) { 2 } else { 1 };
        ShapeStyle { stroke_width: wider * style.stroke_width, ..style }
    }

    /// The names of the series, each behind a piece of its line: beside the curves, or above them if there are few.
    fn draw_legend(&self, root: &Area, left: u32) {
        for index in 0..self.series.len() {
            self.draw_name(root, index, (left, 24 + LINE * index as u32));
        }
    }

    /// The name of the series at `index` behind a piece of its line, from the point `left`, `middle` [pixels] on.
    fn draw_name(&self, root: &Area, index: usize, (left, middle): (u32, u32)) {
        let style = TextStyle::from(("sans-serif", SCALE * 13).into_font()).pos(Pos::new(HPos::Left, VPos::Center));
        let (x, y) = ((SCALE * left) as i32, (SCALE * middle) as i32);
        let length = 18 * SCALE as i32;
        let series = &self.series[index];
        let drawn = match series.dots {
            true => root.draw(&dot((x + length / 2, y))),
            false => root.draw(&PathElement::new([(x, y), (x + length, y)], self.stroke(index))),
        };
        drawn.expect(IN_MEMORY);
        root.draw(&Text::new(series.label.clone(), (x + length + 6 * SCALE as i32, y), style)).expect(IN_MEMORY);
    }
}

/// Pictures of the same series beside each other, as one SVG of `width` pixels, each `height` pixels high, with one legend
/// below them in as many columns as there is room for.
pub fn side_by_side(pictures: &[Picture], width: u32, height: u32) -> String {
    const MARGIN: u32 = 24;
    let Some(first) = pictures.first() else { return String::new() };
    let longest = first.series.iter().map(|series| series.label.chars().count() as u32).max().unwrap_or(0);
    // a letter is some seven pixels wide; the line and the space between columns stand beside it
    let column = 7 * longest + 52;
    let columns = ((width - 2 * MARGIN) / column).max(1);
    let rows = (first.series.len() as u32).div_ceil(columns);
    svg(width, height + rows * LINE + MARGIN, |root| {
        let (upper, lower) = root.split_vertically(SCALE * height);
        for (picture, area) in pictures.iter().zip(upper.split_evenly((1, pictures.len()))) {
            picture.draw_into(&area, 0);
        }
        for index in 0..first.series.len() {
            let (row, place) = (index as u32 / columns, index as u32 % columns);
            first.draw_name(&lower, index, (MARGIN + place * column, MARGIN / 2 + row * LINE));
        }
    })
}

/// Whether two lines can't be told apart.
fn coincide(one: &[(f64, f64)], other: &[(f64, f64)]) -> bool {
    let near = |one: f64, other: f64| (one - other).abs() <= 0.01 * one.abs().max(other.abs());
    one.iter().zip(other).all(|(one, other)| near(one.0, other.0) && near(one.1, other.1))
}

/// What `draw` draws, as SVG of `width` by `height` pixels.
fn svg(width: u32, height: u32, draw: impl FnOnce(&Area)) -> String {
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (SCALE * width, SCALE * height)).into_drawing_area();
        draw(&root);
        root.present().expect(IN_MEMORY);
    }
    let drawn = format!("width=\"{}\" height=\"{}\"", SCALE * width, SCALE * height);
    svg.replacen(&drawn, &format!("width=\"{width}\" height=\"{height}\""), 1)
}

/// The line of the series at `index`, as CSS has it.
pub fn css_line(index: usize) -> String {
    let ShapeStyle { stroke_width, .. } = stroke(index);
    let RGBColor(red, green, blue) = COLOURS[index % COLOURS.len()];
    format!("{}px solid rgb({red} {green} {blue})", stroke_width / SCALE)
}

/// A dot of data.
fn dot<C>(at: C) -> Circle<C, u32> {
    Circle::new(at, 5 * SCALE / 2, BLACK.filled())
}

/// The line of the series at `index`; the second round of colours is thinner.
fn stroke(index: usize) -> ShapeStyle {
    let width = if index < COLOURS.len() { 2 * SCALE } else { SCALE };
    COLOURS[index % COLOURS.len()].stroke_width(width)
}

/// Room for a legend beside the curves.
const LEGEND: u32 = 170;

/// Height of a line of a legend.
const LINE: u32 = 19;

/// Where pictures are drawn.
type Area<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;

/// Drawing writes to a String, which takes everything.
const IN_MEMORY: &str = "a drawing in memory";

fn linear(range: Range<f64>) -> RangedCoordf64 {
    range.into()
}

/// A tick label: plain where that is short.
fn label(value: &f64) -> String {
    let rounded: f64 = format!("{value:.6e}").parse().expect("a number");
    match rounded.abs() {
        0.0 => "0".into(),
        size if (1e-3..1e5).contains(&size) => format!("{rounded}"),
        _ => format!("{rounded:e}"),
    }
}
