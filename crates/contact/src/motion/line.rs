//! Motion on a straight line of the force: sine and cosine, as powers of the phase.

use super::moments::{Moments, Point};
use libm::fabs;

/// Number of powers of the square of the phase.
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

/// The largest square of the phase \[rad^2\] for which these powers are enough.
pub const LONGEST: f64 = 3.0;

/// The largest square of the phase for which half of them are enough.
const SMALL: f64 = 0.06;

/// Bodies whose acceleration changes in proportion to the distance.
pub struct Line {
    /// The distance covered at the initial speed, and by the initial acceleration \[m\].
    pub first: f64,
    pub second: f64,
    /// The square of the phase at the end \[rad^2\], up to [`LONGEST`].
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
