//! A motion on a straight line: a sine and a cosine, by powers of the phase.

use super::short::{Moments, Point};
use libm::fabs;

/// Powers of the square of the phase.
pub const POWERS: usize = 12;

/// `1/(2 k + 1)!` and `1/(2 k + 2)!`, from `k = 0` on.
const WAVE: [[f64; 2]; POWERS] = {
    let mut wave = [[1.0, 0.5]; POWERS];
    let mut index = 1;
    while index < wave.len() {
        let order = (2 * index) as f64;
        let [sine, cosine] = wave[index - 1];
        wave[index] = [sine / (order * (order + 1.0)), cosine / ((order + 1.0) * (order + 2.0))];
        index += 1;
    }
    wave
};

/// The square of the phase \[rad\] up to which they are enough.
pub const LONGEST: f64 = 3.0;

/// The square of a phase for which the first half of them is.
const SMALL: f64 = 0.06;

/// Bodies that are slowed down in proportion to the way.
pub struct Line {
    /// The way in the time at the speed of the start, and by the acceleration there \[m\].
    pub first: f64,
    pub second: f64,
    /// The square of the phase at the end \[rad\], up to [`LONGEST`].
    pub phase: f64,
}

impl Moments for Line {
    fn at(&self, time: f64) -> Point {
        let Line { first, second, phase } = *self;
        let square = phase * time * time;
        let powers = WAVE.get(..if fabs(square) < SMALL { POWERS / 2 } else { POWERS }).unwrap_or_default();
        // sin(x)/x and (1 - cos(x))/x^2
        let (mut sine, mut cosine) = (0.0, 0.0);
        for [odd, even] in powers.iter().rev() {
            (sine, cosine) = (odd - square * sine, even - square * cosine);
        }
        let pull = 2.0 * second * time;
        let way = time * (first * sine + pull * cosine);
        let (gain, net) = (pull * sine - first * square * cosine, 2.0 * second - phase * way);
        Point { time, way, gain, net, stiffness: phase }
    }
}
