//! The lines of a picture as SVG: one group for each series, with its name and with values to hover over.

use super::colours::Stroke;
use super::{NameAt, SCALE, label};
use crate::html::escape;
use std::fmt::Write;

/// A point of a line: its place in the drawing [1/8 pixel], and its values.
#[derive(Clone, Copy)]
pub struct Place {
    pub x: i32,
    pub y: i32,
    pub value: (f64, f64),
}

/// A series in the drawing.
pub struct Line {
    pub name: String,
    pub stroke: Stroke,
    /// Its pieces between points that the picture can't show.
    pub pieces: Vec<Vec<Place>>,
    /// Points of data instead of a line.
    pub dots: bool,
    /// Whether it stands out; the others are grey.
    pub strong: bool,
    /// Whether it is entirely below the picture, and drawn along the lower edge.
    pub below: bool,
    /// Whether none of its places shows its values.
    pub bare: bool,
}

/// The plotting area between the axes [1/8 pixel].
#[derive(Clone, Copy)]
pub struct Frame {
    pub left: i32,
    pub right: i32,
    pub bottom: i32,
    /// Size of the whole picture.
    pub width: i32,
}

/// Height of a line of text, and average width of a letter [1/8 pixel].
const TEXT: i32 = 15 * SCALE as i32;
const LETTER: i32 = 62;

/// Largest number of points of a line that show their values; longer lines show a selection.
const POINTERS: usize = 40;

/// All lines, the grey ones first, with the names of the strong ones at `name_at`; below them the `marks`, each with
/// height and name.
pub fn write(lines: &[Line], marks: &[(i32, &str)], frame: Frame, name_at: NameAt) -> String {
    let mut text = String::new();
    for (y, name) in marks {
        write_mark(&mut text, *y, name, frame).expect("a String takes everything");
    }
    for line in lines.iter().filter(|line| !line.strong).chain(lines.iter().filter(|line| line.strong)) {
        write_line(&mut text, line).expect("a String takes everything");
    }
    if name_at != NameAt::Nowhere {
        write_names(&mut text, lines, frame, name_at).expect("a String takes everything");
    }
    text
}

/// A dashed line across the picture with its name above.
fn write_mark(text: &mut String, y: i32, name: &str, Frame { left, right, .. }: Frame) -> std::fmt::Result {
    writeln!(
        text,
        "<path d=\"M{left} {y}H{right}\" stroke=\"#555\" stroke-width=\"{SCALE}\" stroke-dasharray=\"48 32\"/><text x=\"{}\" \
         y=\"{}\" font-family=\"sans-serif\" font-size=\"{}\" fill=\"#555\">{}</text>",
        left + 6 * SCALE as i32,
        y - 4 * SCALE as i32,
        12 * SCALE,
        escape(name)
    )
}

fn write_line(text: &mut String, line: &Line) -> std::fmt::Result {
    let weak = if line.strong { "" } else { " weak" };
    let Stroke { width, dashed, .. } = line.stroke;
    let colour = line.stroke.css();
    let dashes = if dashed { " stroke-dasharray=\"56 32\"" } else { "" };
    let name = escape(&line.name).replace('"', "&quot;");
    write!(
        text,
        "<g class=\"series{weak}\" data-series=\"{name}\" stroke=\"{colour}\" fill=\"{colour}\" stroke-width=\"{width}\">"
    )?;
    let (shown, has_markers) = (line.pieces.iter().map(Vec::len).sum::<usize>(), line.dots || is_short(line));
    if !line.dots {
        for piece in &line.pieces {
            let points = thinned(piece).map(|place| format!("{},{}", place.x, place.y)).collect::<Vec<_>>().join(" ");
            write!(text, "<polyline fill=\"none\" stroke-linejoin=\"round\"{dashes} points=\"{points}\"/>")?;
        }
    }
    let every = shown.div_ceil(if line.strong { POINTERS } else { POINTERS / 4 }).max(1);
    let showing = line.pieces.iter().flatten().filter(|_| !line.bare);
    for place in showing.step_by(if line.dots { 1 } else { every }) {
        // points without a marker also show their values
        let (radius, seen) = if has_markers { (22, "") } else { (48, " fill-opacity=\"0\"") };
        let (x, y) = (short(place.value.0), short(place.value.1));
        write!(
            text,
            "<circle cx=\"{}\" cy=\"{}\" r=\"{radius}\" stroke=\"none\"{seen}><title>{name}: {x}, {y}</title></circle>",
            place.x, place.y
        )?;
    }
    writeln!(text, "</g>")
}

/// A value to hover over, with four digits.
fn short(value: f64) -> String {
    label(&format!("{value:.3e}").parse().expect("a number"))
}

/// The points of a line without redundant ones: those closer than a pixel and a half to the one before, except ends
/// and extrema.
fn thinned(piece: &[Place]) -> impl Iterator<Item = &Place> {
    const NEAR: i32 = 12;
    let mut last: Option<&Place> = None;
    piece.iter().enumerate().filter_map(move |(index, place)| {
        let turns = |before: &Place, after: &Place| {
            (before.x - place.x).signum() == (after.x - place.x).signum()
                || (before.y - place.y).signum() == (after.y - place.y).signum()
        };
        let inner = index > 0 && index + 1 < piece.len() && !turns(&piece[index - 1], &piece[index + 1]);
        let near = last.is_some_and(|last| (last.x - place.x).abs().max((last.y - place.y).abs()) < NEAR);
        if inner && near {
            return None;
        }
        last = Some(place);
        last
    })
}

/// Whether a line has few enough points for markers.
fn is_short(line: &Line) -> bool {
    line.strong && line.pieces.iter().map(Vec::len).sum::<usize>() <= 16
}

/// A rectangle [1/8 pixel].
#[derive(Clone, Copy)]
struct Rectangle {
    left: i32,
    top: i32,
    right: i32,
    bottom: i32,
}

impl Rectangle {
    fn overlaps(&self, other: &Rectangle) -> bool {
        self.left < other.right && other.left < self.right && self.top < other.bottom && other.top < self.bottom
    }
}

/// The names of the strong lines, each beside its place on the line, without overlap.
fn write_names(text: &mut String, lines: &[Line], frame: Frame, name_at: NameAt) -> std::fmt::Result {
    let mut taken: Vec<Rectangle> = Vec::new();
    let (below, others): (Vec<_>, Vec<_>) = lines.iter().filter(|line| line.strong).partition(|line| line.below);
    for line in below.into_iter().chain(others) {
        let places = || line.pieces.iter().flatten();
        let end = match name_at {
            NameAt::Top => places().min_by_key(|place| place.y),
            // at the left, where other lines rarely end
            _ if line.below => places().min_by_key(|place| place.x),
            _ => places().last(),
        };
        let Some(end) = end else { continue };
        let words = format!("{}{}", line.name, if line.below { ": below" } else { "" });
        let width = LETTER * words.chars().count() as i32;
        let (place, rectangle) = free_place(end, width, frame, &taken);
        taken.push(rectangle);
        let middle = (rectangle.top + rectangle.bottom) / 2;
        if (middle - end.y).abs() > TEXT {
            let (x, colour) = (if place.1 == "start" { rectangle.left } else { rectangle.right }, line.stroke.css());
            write!(text, "<path d=\"M{} {}L{x} {middle}\" stroke=\"{colour}\" stroke-width=\"6\"/>", end.x, end.y)?;
        }
        writeln!(
            text,
            "<text class=\"name\" x=\"{}\" y=\"{}\" text-anchor=\"{}\" font-family=\"sans-serif\" font-size=\"{}\" \
             fill=\"{}\" stroke=\"#fff\" stroke-width=\"32\" stroke-linejoin=\"round\" paint-order=\"stroke\">{}</text>",
            place.0,
            middle + 4 * SCALE as i32,
            place.1,
            13 * SCALE,
            line.stroke.css(),
            escape(&words)
        )?;
    }
    Ok(())
}

/// Position of a name of this `width` for a line with this `end`: its anchor and its rectangle. It is to the right of
/// the end if it fits, otherwise to the left, and moved up or down as little as possible.
fn free_place(end: &Place, width: i32, frame: Frame, taken: &[Rectangle]) -> ((i32, &'static str), Rectangle) {
    let gap = 7 * SCALE as i32;
    let candidate = |side: usize, shift: i32| {
        let top = end.y + shift - TEXT / 2;
        let (anchor, left) = match side {
            0 => ((end.x + gap, "start"), end.x + gap),
            _ => ((end.x - gap, "end"), end.x - gap - width),
        };
        (anchor, Rectangle { left, top, right: left + width, bottom: top + TEXT })
    };
    let fits = |rectangle: &Rectangle| {
        rectangle.left > frame.left
            && rectangle.right <= frame.width
            && rectangle.top >= 0
            && rectangle.bottom <= frame.bottom - SCALE as i32
            && !taken.iter().any(|other| other.overlaps(rectangle))
    };
    // to the left of its end the name would cover its own line: move it above or below
    let tries = (0..40).flat_map(|step: i32| {
        let shift = TEXT / 2 * step;
        [(0, shift), (0, -shift), (1, shift + TEXT), (1, -shift - TEXT)]
    });
    let mut places = tries.map(|(side, shift)| candidate(side, shift));
    places.find(|(_, rectangle)| fits(rectangle)).unwrap_or_else(|| candidate(0, 0))
}

/// The width that the names of the `lines` take behind them [1/8 pixel].
pub fn room<'a>(names: impl Iterator<Item = &'a str>) -> u32 {
    let longest = names.map(|name| name.chars().count()).max().unwrap_or(0) as u32;
    LETTER as u32 * longest + 4 * SCALE
}
