//! Colours and strokes of lines. A law has the same colour in every picture.

use super::SCALE;
use brinell_contact::damped::AnyDamped;
use brinell_contact::loading::AnyLoading;

/// Colours that most colour-blind readers can also distinguish (P. Green-Armytage; M. Okabe, K. Ito).
const COLOURS: [(u8, u8, u8); 12] = [
    (0, 90, 160),
    (213, 94, 0),
    (0, 140, 100),
    (180, 80, 140),
    (150, 110, 0),
    (86, 160, 220),
    (120, 60, 20),
    (110, 110, 110),
    (220, 50, 60),
    (90, 60, 170),
    (60, 150, 30),
    (230, 150, 0),
];

/// How a line is drawn.
#[derive(Clone, Copy)]
pub struct Stroke {
    /// Red, green and blue.
    pub rgb: (u8, u8, u8),
    /// [1/8 pixel]
    pub width: u32,
    /// Dashed, for the second dozen of colours.
    pub dashed: bool,
}

impl Stroke {
    /// The colour, as CSS has it.
    pub fn css(self) -> String {
        let (red, green, blue) = self.rgb;
        format!("#{red:02x}{green:02x}{blue:02x}")
    }
}

/// The strokes of series with these names, in the same order.
pub fn strokes<'a>(names: impl Iterator<Item = &'a str>) -> Vec<Stroke> {
    let mut taken: Vec<usize> = Vec::new();
    for name in names {
        let own = place(name).filter(|place| !taken.contains(place));
        let free = || (0..).find(|place| !taken.contains(place));
        taken.push(own.or_else(free).unwrap_or(0));
    }
    taken.into_iter().map(stroke).collect()
}

/// The position of a law in the list of all laws; `LOADING/UNLOADING` has that of its loading law. The first two laws
/// of the list are used most and have the most different colours.
fn place(name: &str) -> Option<usize> {
    let law = name.split('/').next().unwrap_or(name);
    let laws = AnyLoading::ALL.iter().map(|(name, _)| *name).chain(AnyDamped::ALL.iter().map(|(name, _)| *name));
    laws.into_iter().position(|known| known == law)
}

fn stroke(place: usize) -> Stroke {
    Stroke { rgb: COLOURS[place % COLOURS.len()], width: 2 * SCALE, dashed: place >= COLOURS.len() }
}

/// The colour of lines in the background.
pub fn grey() -> Stroke {
    Stroke { rgb: (181, 181, 181), width: SCALE, dashed: false }
}

/// The beginning of the names of measured data.
const MEASURED: &str = "measured";

/// The colour of data with this name: red for measured data, otherwise black.
pub fn data(name: &str) -> Stroke {
    let rgb = if name.starts_with(MEASURED) { (200, 20, 30) } else { (0, 0, 0) };
    Stroke { rgb, width: SCALE, dashed: false }
}

/// The strokes of lines with these names, for CSS.
pub fn css_lines<'a>(names: impl Iterator<Item = &'a str>) -> Vec<String> {
    let css = |stroke: Stroke| {
        let kind = if stroke.dashed { "dashed" } else { "solid" };
        format!("{}px {kind} {}", stroke.width / SCALE, stroke.css())
    };
    strokes(names).into_iter().map(css).collect()
}
