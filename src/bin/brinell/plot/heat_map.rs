//! Maps of one number over two quantities, as SVG. Each cell shows its numbers on hover, which plotters does not support.

use super::colours::viridis;
use crate::html::escape;
use crate::numbers::significant;
use std::fmt::Write;

/// An axis of a map.
pub struct Quantity<'a> {
    pub name: &'a str,
    /// The name with its unit.
    pub title: String,
    pub values: &'a [f64],
}

/// A number over two quantities.
pub struct HeatMap<'a> {
    pub title: String,
    pub columns: Quantity<'a>,
    pub rows: Quantity<'a>,
    /// Rows of columns.
    pub values: Vec<Vec<f64>>,
}

/// Sizes [pixels].
const MAP: f64 = 260.0;
const LEFT: f64 = 86.0;
const TOP: f64 = 44.0;
const WIDTH: f64 = 450.0;
const HEIGHT: f64 = 366.0;
const BAR: f64 = 14.0;

/// Numbers along an axis.
const TICKS: usize = 5;

/// The range of the colours.
struct Scale {
    low: f64,
    high: f64,
    logarithmic: bool,
}

impl Scale {
    fn of(values: &[Vec<f64>]) -> Scale {
        let all = || values.iter().flatten().copied().filter(|value| value.is_finite());
        let (low, high) = (all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max));
        // zeros have no place on a logarithmic scale
        let logarithmic = low > 0.0 && high > 100.0 * low;
        Scale { low, high, logarithmic }
    }

    fn part(&self, value: f64) -> f64 {
        let Scale { low, high, .. } = *self;
        match self.logarithmic {
            _ if high <= low => 0.5,
            true => (value / low).ln() / (high / low).ln(),
            false => (value - low) / (high - low),
        }
    }

    fn value(&self, part: f64) -> f64 {
        match self.logarithmic {
            true => self.low * libm::pow(self.high / self.low, part),
            false => self.low + (self.high - self.low) * part,
        }
    }
}

/// Pictures in rows: each with a heading, three maps beside each other.
pub fn heat_maps(rows: &[(&str, [HeatMap; 3])]) -> String {
    let mut svg = String::new();
    draw(&mut svg, rows).expect("a String takes everything");
    svg
}

fn draw(svg: &mut String, rows: &[(&str, [HeatMap; 3])]) -> std::fmt::Result {
    let (width, height) = (3.0 * WIDTH, HEIGHT * rows.len() as f64);
    writeln!(
        svg,
        "<svg class=\"map\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" xmlns=\"http://www.w3.org/2000/svg\" \
         font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>"
    )?;
    for (index, (law, maps)) in rows.iter().enumerate() {
        let top = HEIGHT * index as f64;
        for (place, map) in maps.iter().enumerate() {
            writeln!(svg, "<g transform=\"translate({} {top})\">", WIDTH * place as f64)?;
            map.draw(svg, law)?;
            writeln!(svg, "</g>")?;
        }
    }
    writeln!(svg, "</svg>")
}

impl HeatMap<'_> {
    fn draw(&self, svg: &mut String, law: &str) -> std::fmt::Result {
        let scale = Scale::of(&self.values);
        let middle = LEFT + MAP / 2.0;
        writeln!(svg, "<text x=\"{middle}\" y=\"30\" text-anchor=\"middle\">{}, {}</text>", self.title, escape(law))?;
        let (wide, high) = (MAP / self.columns.values.len() as f64, MAP / self.rows.values.len() as f64);
        for (row, values) in self.values.iter().enumerate() {
            for (column, value) in values.iter().enumerate() {
                let (x, y) = (LEFT + wide * column as f64, TOP + MAP - high * (row + 1) as f64);
                // slightly larger, to avoid gaps between neighbours
                let (width, height) = (wide + 0.5, high + 0.5);
                let fill = if value.is_finite() { viridis(scale.part(*value)) } else { "#ccc".into() };
                writeln!(
                    svg,
                    "<rect x=\"{x:.2}\" y=\"{y:.2}\" width=\"{width:.2}\" height=\"{height:.2}\" fill=\"{fill}\">\
                     <title>{} = {}, {} = {}: {}</title></rect>",
                    self.columns.name,
                    significant(self.columns.values[column], 4),
                    self.rows.name,
                    significant(self.rows.values[row], 4),
                    significant(*value, 4)
                )?;
            }
        }
        self.draw_axes(svg)?;
        draw_scale(svg, &scale)
    }

    /// Numbers and titles of both axes.
    fn draw_axes(&self, svg: &mut String) -> std::fmt::Result {
        for tick in 0..TICKS {
            let part = tick as f64 / (TICKS - 1) as f64;
            let place = |values: &[f64]| significant(values[((values.len() - 1) as f64 * part).round() as usize], 3);
            let (x, y) = (LEFT + MAP * part, TOP + MAP * (1.0 - part));
            let anchor = match tick {
                0 => "start",
                tick if tick == TICKS - 1 => "end",
                _ => "middle",
            };
            let below = TOP + MAP + 18.0;
            writeln!(
                svg,
                "<text x=\"{x}\" y=\"{below}\" text-anchor=\"{anchor}\">{}</text>",
                place(self.columns.values)
            )?;
            let (x, y) = (LEFT - 6.0, y + 4.0);
            writeln!(svg, "<text x=\"{x}\" y=\"{y}\" text-anchor=\"end\">{}</text>", place(self.rows.values))?;
        }
        let (x, y) = (LEFT + MAP / 2.0, TOP + MAP + 42.0);
        writeln!(svg, "<text x=\"{x}\" y=\"{y}\" text-anchor=\"middle\">{}</text>", self.columns.title)?;
        let y = TOP + MAP / 2.0;
        writeln!(
            svg,
            "<text x=\"16\" y=\"{y}\" text-anchor=\"middle\" transform=\"rotate(-90 16 {y})\">{}</text>",
            self.rows.title
        )
    }
}

/// The colours with their numbers.
fn draw_scale(svg: &mut String, scale: &Scale) -> std::fmt::Result {
    const STRIPES: usize = 64;
    let left = LEFT + MAP + 12.0;
    for stripe in 0..STRIPES {
        let part = (stripe as f64 + 0.5) / STRIPES as f64;
        let height = MAP / STRIPES as f64;
        let y = TOP + MAP - height * (stripe + 1) as f64;
        let (height, fill) = (height + 0.5, viridis(part));
        writeln!(svg, "<rect x=\"{left}\" y=\"{y:.2}\" width=\"{BAR}\" height=\"{height:.2}\" fill=\"{fill}\"/>")?;
    }
    for tick in 0..TICKS {
        let part = tick as f64 / (TICKS - 1) as f64;
        let (x, y) = (left + BAR + 4.0, TOP + MAP * (1.0 - part) + 4.0);
        writeln!(svg, "<text x=\"{x}\" y=\"{y}\">{}</text>", significant(scale.value(part), 3))?;
    }
    Ok(())
}
