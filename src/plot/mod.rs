//! Pictures: lines and dots over two axes, and maps, as SVG.

mod clip;
mod colours;
mod drawing;
mod lines;
mod map;
mod thin;

pub use colours::css_lines;
pub use map::{Class, Map, Row};

use colours::strokes;
use drawing::Drawing;

use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::ops::Range;

/// A line, or dots.
pub struct Series {
    pub label: String,
    pub points: Vec<(f64, f64)>,
    /// Dots instead of a line: data instead of a law.
    pub dots: bool,
}

/// A picture.
pub struct Picture {
    pub x_title: String,
    pub y_title: String,
    /// Logarithmic axes; they omit points at or below zero.
    pub logarithmic: (bool, bool),
    pub series: Vec<Series>,
}

/// Style of the pictures in a report: the names at the ends of the lines, and strong colours for what matters.
#[derive(Default)]
pub struct View {
    /// The range of the values. A line that leaves it ends at its edge. A line entirely below it runs along its lower
    /// edge.
    pub values: Option<Range<f64>>,
    /// Values marked by a line across the picture, with their names.
    pub marks: Vec<(f64, &'static str)>,
    /// The names of the series that stand out; the others are grey. `None`: all stand out.
    pub strong: Option<Vec<String>>,
    pub name_at: NameAt,
    /// Lines alone, without places that show their values.
    pub bare: bool,
}

/// Where the name of a line is placed.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
pub enum NameAt {
    #[default]
    End,
    /// At the highest point.
    Top,
    Nowhere,
}

impl View {
    /// All lines, without names.
    fn unnamed() -> View {
        View { name_at: NameAt::Nowhere, ..View::default() }
    }

    /// Whether the series with this name stands out.
    fn shows(&self, name: &str) -> bool {
        self.strong.as_ref().is_none_or(|strong| strong.iter().any(|other| other == name))
    }
}

/// plotters rounds everything to whole pixels. Pictures are therefore drawn large and scaled down; curves are then
/// smooth.
const SCALE: u32 = 8;

impl Picture {
    /// The picture as SVG of `width` by `height` pixels, with a legend.
    pub fn svg(&self, width: u32, height: u32) -> String {
        self.with_legend(width, height, &View::unnamed())
    }

    /// The same for a page whose size counts: no places of the lines show their values.
    pub fn small_svg(self, width: u32, height: u32) -> String {
        self.thinned().with_legend(width, height, &View { bare: true, ..View::unnamed() })
    }

    fn with_legend(&self, width: u32, height: u32, view: &View) -> String {
        // beside the curves, where the legend hides none of them
        let beside = self.series.len() > 2;
        svg(width, height, |root| {
            let curves = self.draw_into(root, SCALE * if beside { LEGEND } else { 0 }, view);
            self.draw_legend(root, if beside { width - LEGEND } else { 100 });
            curves
        })
    }

    /// The picture with the name of each line at its end.
    pub fn labelled(&self, width: u32, height: u32, view: &View) -> String {
        let names = self.series.iter().map(|series| series.label.as_str()).filter(|name| view.shows(name));
        let room = if view.name_at == NameAt::Nowhere { 0 } else { lines::room(names) };
        svg(width, height, |root| self.draw_into(root, room, view))
    }

    /// Axes, with `room` [1/8 pixel] to the right; returns the lines.
    fn draw_into(&self, root: &Area, room: u32, view: &View) -> String {
        let mut builder = ChartBuilder::on(root);
        builder
            .margin(12 * SCALE)
            .margin_right(12 * SCALE + room)
            .x_label_area_size(44 * SCALE)
            .y_label_area_size(68 * SCALE);
        let x = self.range(|point| point.0, self.logarithmic.0);
        let y = view.values.clone().unwrap_or_else(|| self.range(|point| point.1, self.logarithmic.1));
        let width = root.get_pixel_range().0.end;
        let drawing = Drawing { picture: self, view, range: y.clone(), width };
        match self.logarithmic {
            (false, false) => drawing.draw(builder.build_cartesian_2d(linear(x), linear(y))),
            (true, false) => drawing.draw(builder.build_cartesian_2d(x.log_scale(), linear(y))),
            (false, true) => drawing.draw(builder.build_cartesian_2d(linear(x), y.log_scale())),
            (true, true) => drawing.draw(builder.build_cartesian_2d(x.log_scale(), y.log_scale())),
        }
    }

    /// Whether the picture can show a point.
    fn fits(&self, &(x, y): &(f64, f64)) -> bool {
        let (x_log, y_log) = self.logarithmic;
        (x > 0.0 || !x_log) && (y > 0.0 || !y_log) && x.is_finite() && y.is_finite()
    }

    /// The pieces of a series between points that the picture can't show.
    fn pieces<'a>(&'a self, series: &'a Series) -> impl Iterator<Item = &'a [(f64, f64)]> {
        series.points.split(|point| !self.fits(point)).filter(|piece| !piece.is_empty())
    }

    /// The range of one coordinate of the points, with a margin; from zero if nothing is below it. Pictures over the
    /// same arguments have the same range, whichever values they can show.
    fn range(&self, value: impl Fn(&(f64, f64)) -> f64, logarithmic: bool) -> Range<f64> {
        let points = || self.series.iter().flat_map(|series| &series.points);
        let values = || points().map(&value).filter(|&value| value.is_finite() && (value > 0.0 || !logarithmic));
        let (low, high) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
        match logarithmic {
            // no points, or only zeros
            true if high <= 0.0 => 0.1..1.0,
            false if high <= low.min(0.0) => 0.0..1.0,
            // a margin: no line is hidden by an axis, and a power of ten at the end has its label
            true => low / 1.3..high * 1.1,
            false => low.min(0.0)..high + 0.06 * (high - low.min(0.0)),
        }
    }

    /// The strokes of the lines.
    fn strokes(&self) -> Vec<colours::Stroke> {
        let mut strokes = strokes(self.series.iter().map(|series| series.label.as_str()));
        for (index, stroke) in strokes.iter_mut().enumerate() {
            stroke.width *= self.width(index);
        }
        strokes
    }

    /// Width factor of the line at `index`: two if another line covers it, so both are visible.
    fn width(&self, index: usize) -> u32 {
        let points = &self.series[index].points;
        let covers =
            |other: &Series| !other.dots && other.points.len() == points.len() && coincide(&other.points, points);
        if self.series[index + 1..].iter().any(covers) { 2 } else { 1 }
    }

    /// The names of the series, each after a sample of its line: beside the curves, or above them if there are few.
    fn draw_legend(&self, root: &Area, left: u32) {
        for index in 0..self.series.len() {
            self.draw_name(root, index, (left, 24 + LINE * index as u32));
        }
    }

    /// The name of the series at `index` after a sample of its line, from the point `left`, `middle` [pixels].
    fn draw_name(&self, root: &Area, index: usize, (left, middle): (u32, u32)) {
        let style = TextStyle::from(("sans-serif", SCALE * 13).into_font()).pos(Pos::new(HPos::Left, VPos::Center));
        let (x, y) = ((SCALE * left) as i32, (SCALE * middle) as i32);
        let length = 18 * SCALE as i32;
        let series = &self.series[index];
        let stroke = &self.strokes()[index];
        let line = RGBColor(stroke.rgb.0, stroke.rgb.1, stroke.rgb.2).stroke_width(stroke.width);
        let pieces: &[(i32, i32)] = if stroke.dashed { &[(0, 7), (11, 18)] } else { &[(0, 18)] };
        let drawn = match series.dots {
            true => {
                let (red, green, blue) = colours::data(&series.label).rgb;
                root.draw(&Circle::new((x + length / 2, y), 5 * SCALE / 2, RGBColor(red, green, blue).filled()))
            }
            false => pieces.iter().try_for_each(|(from, to)| {
                let ends = [from, to].map(|pixels| (x + pixels * SCALE as i32, y));
                root.draw(&PathElement::new(ends, line))
            }),
        };
        drawn.expect(IN_MEMORY);
        root.draw(&Text::new(series.label.clone(), (x + length + 6 * SCALE as i32, y), style)).expect(IN_MEMORY);
    }
}

/// An argument and a value.
type Point = (f64, f64);

/// Whether two lines look the same.
fn coincide(one: &[(f64, f64)], other: &[(f64, f64)]) -> bool {
    let near = |one: f64, other: f64| (one - other).abs() <= 0.01 * one.abs().max(other.abs());
    one.iter().zip(other).all(|(one, other)| near(one.0, other.0) && near(one.1, other.1))
}

/// The drawing of `draw` with the returned elements on top, as SVG of `width` by `height` pixels.
fn svg(width: u32, height: u32, draw: impl FnOnce(&Area) -> String) -> String {
    let mut svg = String::new();
    let lines = {
        let root = SVGBackend::with_string(&mut svg, (SCALE * width, SCALE * height)).into_drawing_area();
        let lines = draw(&root);
        root.present().expect(IN_MEMORY);
        lines
    };
    let drawn = format!("width=\"{}\" height=\"{}\"", SCALE * width, SCALE * height);
    let svg = svg.replacen(&drawn, &format!("width=\"{width}\" height=\"{height}\""), 1);
    // attributes with their defaults
    let svg = svg.replace(" opacity=\"1\"", "").replace(" fill=\"#000000\"", "");
    svg.replacen("</svg>", &format!("{lines}</svg>"), 1)
}

/// Width of a legend beside the curves.
const LEGEND: u32 = 170;

/// Height of a line of a legend.
const LINE: u32 = 19;

/// The drawing area.
type Area<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;

/// Drawing to a String cannot fail.
const IN_MEMORY: &str = "a drawing in memory";

fn linear(range: Range<f64>) -> RangedCoordf64 {
    range.into()
}

/// A tick label; without an exponent if that is short.
fn label(value: &f64) -> String {
    let rounded: f64 = format!("{value:.6e}").parse().expect("a number");
    match rounded.abs() {
        0.0 => "0".into(),
        size if (1e-3..1e5).contains(&size) => format!("{rounded}"),
        _ => format!("{rounded:e}"),
    }
}
