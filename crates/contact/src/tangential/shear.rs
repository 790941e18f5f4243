//! What a contact with friction asks of its springs, in any number of tangential directions.

use super::{Motion, Sliding, Stuck, Way, plane};
use crate::numbers::{root, smallest};
use crate::segment::Segment;

/// First and second time derivative of a force in `D` directions \[N/s, N/s^2\].
pub type Rates<const D: usize> = ([f64; D], [f64; D]);

/// The springs of a contact in `D` tangential directions. All forces are divided by the coefficient of friction, all
/// tangential lengths are [scaled](super::Friction::scale).
pub trait Shear<const D: usize>: Copy {
    /// Number of words in the saved springs.
    const WORDS: usize;

    /// A contact that is pressed in without tangential displacement, at `indentation` \[m\].
    fn pressed(curve: &Segment, indentation: f64) -> Self;

    /// Moves the contact on its way along `curve`.
    fn settle(&mut self, curve: &Segment, way: &Motion<D>);

    /// Moves the contact on its `way` along the loading curve, while its dent grows: from the end of the `old` path
    /// to the end of the `new` one.
    fn grow(&mut self, old: &Segment, new: &Segment, way: &Motion<D>);

    /// Whether the next step along the curve has an exact result: it merges no segments, and springs slip only from the edge.
    fn is_exact(&self) -> bool;

    /// Tangential force at the current `indentation` \[m\] \[N\].
    fn pull(&self, curve: &Segment, indentation: f64) -> [f64; D];

    /// Mean tangential force of a step on this `way` that is yet to come \[N\].
    fn mean_pull(&self, curve: &Segment, way: &Motion<D>) -> [f64; D];

    /// Whether that mean force has a closed form.
    fn has_closed_mean(&self) -> bool;

    /// First and second time derivative of the tangential force, for the rates of a `way` that begins at the current position
    /// and for these accelerations along the normal and in the tangential directions.
    fn pull_rates(&self, curve: &Segment, way: &Motion<D>, accelerations: (f64, [f64; D])) -> Rates<D>;

    /// Stored tangential energy at `indentation` \[m\], times `kappa/mu` \[J\].
    fn energy(&self, curve: &Segment, indentation: f64) -> f64;

    /// Slip state of the contact.
    fn sliding(&self) -> Sliding;

    /// Height \[m\] of the highest spring that sticks, for a contact at `indentation` \[m\].
    fn stick_height(&self, indentation: f64) -> f64;

    /// The slope of the offsets at the edge: a unit vector where springs slip there.
    fn edge(&self) -> [f64; D];

    /// Number of segments in the list.
    fn segments(&self) -> usize;

    /// Passes the words of the springs to `store`.
    fn save(&self, store: &mut impl FnMut(u64));

    /// The springs that [`Shear::save`] has stored; `None` if a word is not a finite number.
    fn load(words: &mut impl Iterator<Item = u64>, curve: &Segment) -> Option<Self>;
}

/// Error of the mean force on a growing dent that is accepted, relative to the normal force. Where the motion turns, the forces
/// themselves are off by more.
pub(super) const TOLERANCE: f64 = 1e-5;

/// The largest number of parts that are tried.
const MOST_TRIES: u32 = 400;

/// Mean of a tangential force over a way, from its values at the `start` and at the `end`, and `at` a part of the way. An error of
/// `tolerance` is accepted in each part \[N\].
///
/// By Boole's rule over parts of the way, which become shorter where springs begin or cease to slip. There the force has a kink. Its
/// third differences in both halves of a part bound the error, wherever the kink is. The fourth difference, by which Simpson's rule
/// over the part and over its halves differ, vanishes for some places of a kink. The sizes of vectors don't depend on the
/// directions in which they are counted, so motion along one line has the same parts in two directions as in one.
pub(super) fn mean_over<const D: usize>(
    start: [f64; D],
    end: [f64; D],
    tolerance: f64,
    at: impl Fn(f64) -> [f64; D],
) -> [f64; D] {
    let (mut sum, mut from, mut here, mut width) = ([0.0; D], 0.0, start, 1.0);
    // the middle and the end of a part that is half of one before
    let mut known = None;
    for turn in 1..=MOST_TRIES {
        let left = 1.0 - from;
        // the last part is all that is left, however rough the force is there
        let is_last = turn == MOST_TRIES;
        let part = if is_last { left } else { smallest(width, left) };
        let (middle, next) = known.take().filter(|_| !is_last).unwrap_or_else(|| {
            let next = if part < left { at(from + part) } else { end };
            (at(from + 0.5 * part), next)
        });
        let [first, third] = [0.25, 0.75].map(|place| at(from + place * part));
        let forces = [here, first, middle, third, next];
        let error = (size(weighted([-1.0, 3.0, -3.0, 1.0, 0.0], forces))
            + size(weighted([0.0, -1.0, 3.0, -3.0, 1.0], forces)))
            / 12.0;
        if part * error > tolerance && !is_last {
            known = Some((first, middle));
            width = 0.5 * part;
            continue;
        }
        let mean = weighted([7.0, 32.0, 12.0, 32.0, 7.0], forces);
        for (sum, mean) in sum.iter_mut().zip(mean) {
            *sum += part * mean / 90.0;
        }
        if part >= left {
            return sum;
        }
        (from, here, width) = (from + part, next, 2.0 * part);
    }
    sum
}

/// The sum of `forces` with these weights.
fn weighted<const D: usize>(weights: [f64; 5], forces: [[f64; D]; 5]) -> [f64; D] {
    let mut sum = [0.0; D];
    for (weight, force) in weights.into_iter().zip(forces) {
        for (sum, force) in sum.iter_mut().zip(force) {
            *sum += weight * force;
        }
    }
    sum
}

/// Length of a vector.
fn size<const D: usize>(vector: [f64; D]) -> f64 {
    root(vector.iter().fold(0.0, |sum, part| sum + part * part))
}

impl Motion<1> {
    /// The way in the only direction.
    #[inline(always)]
    fn way(&self) -> Way {
        let ([shift], [tangential]) = (self.shift, self.tangential);
        Way { from: self.from, to: self.to, shift, normal: self.normal, tangential }
    }
}

impl<const N: usize, const PARTS: u32> Shear<1> for Stuck<N, PARTS> {
    const WORDS: usize = Stuck::<N, PARTS>::WORDS;

    fn pressed(curve: &Segment, indentation: f64) -> Self {
        Stuck::pressed(curve, indentation)
    }

    #[inline]
    fn settle(&mut self, curve: &Segment, way: &Motion<1>) {
        Stuck::settle(self, curve, &way.way());
    }

    fn grow(&mut self, old: &Segment, new: &Segment, way: &Motion<1>) {
        Stuck::grow(self, old, new, &way.way());
    }

    #[inline]
    fn is_exact(&self) -> bool {
        Stuck::segments(self) < N && self.is_within_cones()
    }

    #[inline]
    fn pull(&self, curve: &Segment, indentation: f64) -> [f64; 1] {
        [Stuck::pull(self, curve, indentation)]
    }

    #[inline]
    fn mean_pull(&self, curve: &Segment, way: &Motion<1>) -> [f64; 1] {
        if self.is_within_cones() {
            return [Stuck::mean_pull(self, curve, &way.way())];
        }
        // springs may slip anywhere, not from the edge only
        let ([shift], [tangential]) = (way.shift, way.tangential);
        let &Motion { from, to, normal, .. } = way;
        let way = Motion { from, to, shift: [shift, 0.0], normal, tangential: [tangential, 0.0] };
        let [mean, _] = plane::Stuck::on_a_line(self).mean_pull(curve, &way);
        [mean]
    }

    fn has_closed_mean(&self) -> bool {
        self.is_within_cones()
    }

    fn pull_rates(&self, curve: &Segment, way: &Motion<1>, (normal, [tangential]): (f64, [f64; 1])) -> Rates<1> {
        let (first, second) = Stuck::pull_rates(self, curve, &way.way(), (normal, tangential));
        ([first], [second])
    }

    fn energy(&self, curve: &Segment, indentation: f64) -> f64 {
        Stuck::energy(self, curve, indentation)
    }

    fn sliding(&self) -> Sliding {
        Stuck::sliding(self)
    }

    fn stick_height(&self, indentation: f64) -> f64 {
        Stuck::stick_height(self, indentation)
    }

    fn edge(&self) -> [f64; 1] {
        [self.list.last().map_or(0.0, |last| last.slope)]
    }

    fn segments(&self) -> usize {
        Stuck::segments(self)
    }

    fn save(&self, store: &mut impl FnMut(u64)) {
        Stuck::save(self, store);
    }

    fn load(words: &mut impl Iterator<Item = u64>, curve: &Segment) -> Option<Self> {
        Stuck::load(words, curve)
    }
}

impl<const N: usize> Shear<2> for plane::Stuck<N> {
    const WORDS: usize = plane::Stuck::<N>::WORDS;

    fn pressed(curve: &Segment, indentation: f64) -> Self {
        plane::Stuck::pressed(curve, indentation)
    }

    fn settle(&mut self, curve: &Segment, way: &Motion<2>) {
        self.advance(curve, way);
    }

    fn grow(&mut self, old: &Segment, new: &Segment, way: &Motion<2>) {
        plane::Stuck::grow(self, old, new, way);
    }

    fn is_exact(&self) -> bool {
        false
    }

    fn pull(&self, curve: &Segment, indentation: f64) -> [f64; 2] {
        plane::Stuck::pull(self, curve, indentation)
    }

    fn mean_pull(&self, curve: &Segment, way: &Motion<2>) -> [f64; 2] {
        plane::Stuck::mean_pull(self, curve, way)
    }

    fn has_closed_mean(&self) -> bool {
        false
    }

    fn pull_rates(&self, curve: &Segment, way: &Motion<2>, accelerations: (f64, [f64; 2])) -> Rates<2> {
        plane::Stuck::pull_rates(self, curve, way, accelerations)
    }

    fn energy(&self, curve: &Segment, indentation: f64) -> f64 {
        plane::Stuck::energy(self, curve, indentation)
    }

    fn sliding(&self) -> Sliding {
        plane::Stuck::sliding(self)
    }

    fn stick_height(&self, indentation: f64) -> f64 {
        plane::Stuck::stick_height(self, indentation)
    }

    fn edge(&self) -> [f64; 2] {
        plane::Stuck::edge(self)
    }

    fn segments(&self) -> usize {
        plane::Stuck::segments(self)
    }

    fn save(&self, store: &mut impl FnMut(u64)) {
        plane::Stuck::save(self, store);
    }

    fn load(words: &mut impl Iterator<Item = u64>, curve: &Segment) -> Option<Self> {
        plane::Stuck::load(words, curve)
    }
}

#[cfg(test)]
mod tests {
    use super::{MOST_TRIES, mean_over};
    use core::cell::Cell;

    /// The mean of a force that jumps at each of `jumps` places between 1 and 3, and the number of trial steps.
    fn mean_of_jumps(jumps: f64) -> (f64, u32) {
        let tries = Cell::new(0);
        let force = |place: f64| [if ((jumps * place) as u64).is_multiple_of(2) { 1.0 } else { 3.0 }];
        let counted = |place| {
            tries.set(tries.get() + 1);
            force(place)
        };
        let [mean] = mean_over(force(0.0), force(1.0), 1e-9, counted);
        (mean, tries.get())
    }

    #[test]
    fn a_force_that_is_too_rough_for_all_tries_has_the_mean_of_the_whole_way() {
        for jumps in [1.5, 7.3, 40.1, 333.7, 1e4, 1e9] {
            let (mean, tries) = mean_of_jumps(jumps);
            // within the values of the force, which no mean over a part of the way would be
            assert!((1.0..=3.0).contains(&mean), "{jumps} jumps: {mean}");
            assert!(tries <= 4 * MOST_TRIES, "{jumps} jumps: {tries} trial steps");
        }
    }
}
