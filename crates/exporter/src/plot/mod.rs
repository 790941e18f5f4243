//! Pictures of lines and dots over two axes, as SVG, drawn by plotters.

use plotters::coord::Shift;
use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint, Ranged, ValueFormatter};
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

/// What a picture shows of its series.
#[derive(Default)]
pub struct View {
    /// The range of the values. A line is interrupted above it, and runs along its lower edge below it.
    pub values: Option<Range<f64>>,
    /// A value marked by a dashed line across the picture.
    pub mark: Option<f64>,
}

/// plotters rounds everything to whole pixels. Pictures are therefore drawn large and scaled down; curves are then
/// smooth.
const SCALE: i32 = 8;

/// Colours that most colour-blind readers can also distinguish (P. Green-Armytage; M. Okabe, K. Ito). The second dozen
/// is dashed.
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

/// The drawing area. Drawing to a String cannot fail.
type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
const IN_MEMORY: &str = "a drawing in memory";

impl Series {
    /// A line through these points.
    pub fn line(label: impl Into<String>, points: impl Iterator<Item = (f64, f64)>) -> Series {
        Series { label: label.into(), points: points.collect(), dots: false }
    }
}

impl Picture {
    /// A picture of these series, over x and y with these titles.
    pub fn new((x_title, y_title): (&str, &str), logarithmic: (bool, bool), series: Vec<Series>) -> Picture {
        Picture { x_title: x_title.into(), y_title: y_title.into(), logarithmic, series }
    }

    /// The picture as SVG of `width` by `height` pixels.
    pub fn svg(&self, width: u32, height: u32) -> String {
        self.seen(width, height, &View::default())
    }

    /// What a `view` shows of the picture, with a legend to the right of several series.
    pub fn seen(&self, width: u32, height: u32, view: &View) -> String {
        let mut svg = String::new();
        let (wide, high) = (SCALE * width as i32, SCALE * height as i32);
        let names = self.styles().into_iter().zip(&self.series).filter(|_| self.series.len() > 1);
        let names: Vec<_> = names.collect();
        // a letter is less than eight pixels wide; add the sample of the line
        let longest = names.iter().map(|(_, series)| series.label.chars().count() as i32).max();
        let legend = longest.map_or(0, |letters| SCALE * (8 * letters + 30));
        {
            let root = SVGBackend::with_string(&mut svg, (wide as u32, high as u32)).into_drawing_area();
            let (chart, beside) = root.split_horizontally(wide - legend);
            self.draw(&chart, view);
            let font = ("sans-serif", 13 * SCALE).into_font();
            for (index, (style, series)) in names.iter().enumerate() {
                let middle = SCALE * (24 + 19 * index as i32);
                let text = TextStyle::from(font.clone()).pos(Pos::new(HPos::Left, VPos::Center));
                beside.draw(&Text::new(series.label.clone(), (24 * SCALE, middle), text)).expect(IN_MEMORY);
                let pieces: &[(i32, i32)] = if style.dashed { &[(0, 7), (11, 18)] } else { &[(0, 18)] };
                for (from, to) in pieces.iter().filter(|_| !series.dots) {
                    let ends = [*from, *to].map(|x| (x * SCALE, middle));
                    beside.draw(&PathElement::new(ends, style.line)).expect(IN_MEMORY);
                }
                if series.dots {
                    beside.draw(&Circle::new((9 * SCALE, middle), 22, style.line.filled())).expect(IN_MEMORY);
                }
            }
            root.present().expect(IN_MEMORY);
        }
        let size = |width, height| format!("width=\"{width}\" height=\"{height}\"");
        let svg = svg.replacen(&size(wide as u32, high as u32), &size(width, height), 1);
        // attributes with their defaults
        svg.replace(" opacity=\"1\"", "").replace(" fill=\"#000000\"", "")
    }

    /// Axes and series.
    fn draw(&self, area: &Area, view: &View) {
        let mut builder = ChartBuilder::on(area);
        builder.margin(12 * SCALE).x_label_area_size(44 * SCALE).y_label_area_size(68 * SCALE);
        let x = self.range(|point| point.0, self.logarithmic.0);
        let y = view.values.clone().unwrap_or_else(|| self.range(|point| point.1, self.logarithmic.1));
        let linear = RangedCoordf64::from;
        match self.logarithmic {
            (false, false) => self.fill(builder.build_cartesian_2d(linear(x), linear(y.clone())), y, view),
            (true, false) => {
                self.fill(builder.build_cartesian_2d(Logarithmic::of(x, ACROSS), linear(y.clone())), y, view)
            }
            (false, true) => {
                self.fill(builder.build_cartesian_2d(linear(x), Logarithmic::of(y.clone(), UPWARDS)), y, view);
            }
            (true, true) => {
                let axes = (Logarithmic::of(x, ACROSS), Logarithmic::of(y.clone(), UPWARDS));
                self.fill(builder.build_cartesian_2d(axes.0, axes.1), y, view);
            }
        }
    }

    fn fill<'a, X, Y, E: std::fmt::Debug>(
        &self,
        chart: Result<ChartContext<'a, SVGBackend<'a>, Cartesian2d<X, Y>>, E>,
        range: Range<f64>,
        view: &View,
    ) where
        X: Ranged<ValueType = f64> + ValueFormatter<f64>,
        Y: Ranged<ValueType = f64> + ValueFormatter<f64>,
    {
        let mut chart = chart.expect(IN_MEMORY);
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(RGBColor(221, 221, 221).stroke_width(SCALE as u32))
            .axis_style(BLACK.stroke_width(SCALE as u32))
            .set_all_tick_mark_size(5 * SCALE)
            .x_label_formatter(&label)
            .y_label_formatter(&label)
            .x_desc(&self.x_title)
            .y_desc(&self.y_title)
            .axis_desc_style(("sans-serif", 15 * SCALE))
            .label_style(("sans-serif", 13 * SCALE))
            .draw()
            .expect(IN_MEMORY);
        if let Some(mark) = view.mark {
            let ends = [chart.x_range().start, chart.x_range().end].map(|x| (x, mark));
            let style = RGBColor(85, 85, 85).stroke_width(SCALE as u32);
            chart.draw_series(DashedLineSeries::new(ends, 6 * SCALE as u32, 4 * SCALE as u32, style)).expect(IN_MEMORY);
        }
        let (x_log, y_log) = self.logarithmic;
        let fits = |&(x, y): &(f64, f64)| (x > 0.0 || !x_log) && (y > 0.0 || !y_log) && x.is_finite() && y <= range.end;
        for (series, style) in self.series.iter().zip(self.styles()) {
            let pieces = series.points.split(|point| !fits(point)).filter(|piece| !piece.is_empty());
            for piece in pieces.map(|piece| piece.iter().map(|(x, y)| (*x, y.max(range.start)))) {
                let drawn = match series.dots {
                    true => chart.draw_series(piece.map(|point| Circle::new(point, 22, style.line.filled()))).map(drop),
                    false if style.dashed => {
                        let (size, gap) = (7 * SCALE as u32, 4 * SCALE as u32);
                        chart.draw_series(DashedLineSeries::new(piece, size, gap, style.line)).map(drop)
                    }
                    false => chart.draw_series(LineSeries::new(piece, style.line)).map(drop),
                };
                drawn.expect(IN_MEMORY);
            }
        }
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

    /// How the series are drawn, each in a colour of its own. A line that a later one covers is wider, so that both are visible.
    fn styles(&self) -> Vec<Style> {
        let style = |(index, series): (usize, &Series)| {
            let covers = |other: &Series| !other.dots && coincide(&other.points, &series.points);
            let width = if self.series[index + 1..].iter().any(covers) { 4 * SCALE } else { 2 * SCALE };
            let colour = if series.dots { BLACK } else { COLOURS[index % COLOURS.len()] };
            let dashed = index >= COLOURS.len() && !series.dots;
            Style { line: colour.stroke_width(width as u32), dashed }
        };
        self.series.iter().enumerate().map(style).collect()
    }
}

/// The least distance of ticks, as part of their axis: labels beside each other need more room than those below each other.
pub const ACROSS: f64 = 1.0 / 8.0;
pub const UPWARDS: f64 = 1.0 / 14.0;

/// A logarithmic axis, with ticks that leave room for their labels.
struct Logarithmic {
    range: Range<f64>,
    logarithms: RangedCoordf64,
    ticks: Vec<f64>,
}

impl Logarithmic {
    fn of(range: Range<f64>, least: f64) -> Logarithmic {
        let ticks = ticks(&range, least);
        Logarithmic { logarithms: (range.start.ln()..range.end.ln()).into(), range, ticks }
    }
}

impl Ranged for Logarithmic {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        self.logarithms.map(&value.ln(), limit)
    }

    fn key_points<Hint: KeyPointHint>(&self, _: Hint) -> Vec<f64> {
        self.ticks.clone()
    }

    fn range(&self) -> Range<f64> {
        self.range.clone()
    }
}

/// The ticks of a logarithmic axis over this `range`, no two nearer than the part `least` of it: powers of ten if three of them fit,
/// else as many as there is room for, in steps of 1, 2 and 5 that are nearly even on a short axis.
pub fn ticks(range: &Range<f64>, least: f64) -> Vec<f64> {
    let decades = range.start.log10().floor() as i32..=range.end.log10().ceil() as i32;
    // as a person writes them: no dust of powers
    let number = |digit: u32, power: i32| format!("{digit}e{power}").parse::<f64>().expect("a number");
    let inside = |ticks: Vec<f64>| ticks.into_iter().filter(|tick| range.contains(tick)).collect::<Vec<_>>();
    let room = (range.end / range.start).ln() * least;
    let fits = |ticks: &Vec<f64>| ticks.windows(2).all(|pair| (pair[1] / pair[0]).ln() >= room);
    let powers = |stride: i32| {
        let kept = decades.clone().filter(move |power| power.rem_euclid(stride) == 0);
        inside(kept.map(|power| number(1, power)).collect())
    };
    let tens = (1..=128).map(powers).find(fits).unwrap_or_default();
    if tens.len() >= 3 {
        return tens;
    }
    let digits = |digits: &[u32]| {
        inside(decades.clone().flat_map(|power| digits.iter().map(move |digit| number(*digit, power))).collect())
    };
    let even = decades.clone().rev().flat_map(|power| [5, 2, 1].map(|digit| (digit, power - 1)));
    let even = even.map(|(digit, power)| {
        let step = number(digit, power);
        let (first, last) = ((range.start / step).ceil() as u32, (range.end / step).floor().min(99.0) as u32);
        // a multiple of the step has its digits
        inside((first..=last).map(|count| number(count * digit, power)).collect())
    });
    let all = [tens, digits(&[1, 3]), digits(&[1, 2, 5])].into_iter().chain(even);
    all.filter(fits).max_by_key(Vec::len).unwrap_or_default()
}

/// How a series is drawn.
struct Style {
    line: ShapeStyle,
    dashed: bool,
}

/// Whether two lines look the same.
fn coincide(one: &[(f64, f64)], other: &[(f64, f64)]) -> bool {
    let near = |one: f64, other: f64| (one - other).abs() <= 0.01 * one.abs().max(other.abs());
    one.len() == other.len() && one.iter().zip(other).all(|(one, other)| near(one.0, other.0) && near(one.1, other.1))
}

/// A tick label; without an exponent if that is short.
pub fn label(value: &f64) -> String {
    let rounded: f64 = format!("{value:.6e}").parse().expect("a number");
    match rounded.abs() {
        0.0 => "0".into(),
        size if (1e-3..1e5).contains(&size) => format!("{rounded}"),
        _ => format!("{rounded:e}"),
    }
}
