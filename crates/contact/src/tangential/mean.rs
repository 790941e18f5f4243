//! The mean tangential force over a step and its time derivatives, as sums over the springs.
//!
//! Springs between the heights `h` and `h + dh` have the stiffness `F''(h) dh`, and those below the lowest vertex together
//! `F'(h)`. Each spring moves exactly. On a [`Segment`], `F''(h) dh` is a polynomial of `q = sqrt(z)` times `dq`. Along one line the
//! mean tension is a polynomial of the height between the places of [`breaks`], and Gauss's rule is exact.

use super::pursuit::{FARTHEST, GAUSS, Spring};
use super::vector::{add, difference, direction, dot, length, times};
use super::{Motion, PlayOperator, Vertex};
use crate::numerics::{largest, quotient, root};
use crate::segment::Segment;

/// How far inside its limit a spring may be that slips, as a part of the indentation: vertices have errors from merging and
/// rounding.
const AT_LIMIT: f64 = 1e-9;

/// Part of the indentation over which the first derivative is compared for the second one.
const WIDTH: f64 = 1.0 / 256.0;

/// The longest trial step \[s\], for motions that are slower than any physical one.
const LONGEST: f64 = 1e50;

/// Integral of `of`, a function of the height, times the stiffness of the springs between two heights \[m\].
fn over_springs<const D: usize>(curve: &Segment, from: f64, to: f64, of: impl Fn(f64) -> [f64; D]) -> [f64; D] {
    let [low, high] = [from, to].map(|height| root(height - curve.origin));
    let sum = low + high;
    let length = quotient(to - largest(from, curve.origin), sum, sum > 0.0, 0.0);
    GAUSS.iter().fold([0.0; D], |sum, &(node, weight)| {
        let place = low + node * length;
        let stiffness = (1.5 * curve.power + 4.0 * curve.square * place) * (weight * length);
        add(sum, stiffness, of(curve.origin + place * place))
    })
}

/// The mean tension \[m\] of the spring at this height and offset \[m\] over a `way` that begins at the displacement `start` \[m\].
fn mean_tension<const D: usize>(way: &Motion<D>, start: [f64; D], height: f64, offset: [f64; D]) -> [f64; D] {
    let (limit, end_limit) = (way.from - height, way.to - height);
    if limit <= 0.0 {
        // touches on the way, and slips
        let part = quotient(end_limit, way.rise(), end_limit > 0.0, 0.0);
        return times(0.5 * part * end_limit, way.direction());
    }
    let part = if end_limit < 0.0 { limit / (limit - end_limit) } else { 1.0 };
    let spring = Spring { tension: difference(start, offset), limit, end_limit: largest(end_limit, 0.0) };
    times(part, spring.mean(times(part, way.shift), way.direction()))
}

/// Places on the segment from `vertex` to `end`, as parts of it, between which the springs move alike on a `way` from the
/// displacement `start` \[m\]: where they separate, where they just reach their limit, and where they would separate without
/// tension. The last place is the end.
fn breaks<const D: usize>(vertex: &Vertex<D>, end: (f64, [f64; D]), way: &Motion<D>, start: [f64; D]) -> [f64; 5] {
    let (rise, chord) = (end.0 - vertex.height, difference(end.1, vertex.offset));
    let fall = -way.rise();
    let separation = quotient(way.to - vertex.height, rise, rise > 0.0, 1.0);
    // |tension - part chord| = limit - part rise at the end of the way
    let tension = difference(add(start, 1.0, way.shift), vertex.offset);
    let limit = way.to - vertex.height;
    let square = dot(chord, chord) - rise * rise;
    let half = limit * rise - dot(tension, chord);
    let constant = dot(tension, tension) - limit * limit;
    let discriminant = root(half * half - square * constant);
    let sum = -(half + if half >= 0.0 { discriminant } else { -discriminant });
    let inside = |dividend: f64, divisor: f64| {
        let is_inside = dividend * divisor > 0.0 && dividend * dividend < divisor * divisor;
        quotient(dividend, divisor, is_inside, 1.0)
    };
    // tension at the separation of the vertex, and its change over the segment
    let share = quotient(way.from - vertex.height, fall, fall > 0.0, 0.0);
    let at_vertex = difference(add(start, share, way.shift), vertex.offset);
    let change = add(times(-1.0, chord), -quotient(rise, fall, fall > 0.0, 0.0), way.shift);
    let relaxed = if fall > 0.0 { inside(-dot(at_vertex, change), dot(change, change)) } else { 1.0 };
    [separation, inside(sum, square), inside(constant, sum), relaxed, 1.0]
}

impl<const D: usize, const N: usize> PlayOperator<D, N> {
    /// Mean tangential force of a step on this `way` that is yet to come, divided by the coefficient of friction \[N\]; exact
    /// along one line.
    pub fn mean_pull(&self, curve: &Segment, way: &Motion<D>) -> [f64; D] {
        let surface = curve.lower;
        if way.from <= surface && way.to <= surface || !way.moves() {
            return self.pull(curve, way.from);
        }
        let is_new = self.list.vertices().is_empty();
        if is_new && way.from > surface {
            return PlayOperator::<D, N>::pressed(curve, way.from).mean_pull(curve, way);
        }
        if is_new || length(way.shift) > FARTHEST {
            // all springs either stick or slip: they are new, or the way is longer than any tension
            let slope = if way.sticks() { way.slope() } else { way.direction() };
            let above = way.above(surface);
            return times(way.part_above(surface) * curve.mean_force(above.from, above.to), slope);
        }
        if way.sticks() {
            let gain = curve.mean_force(way.from, way.to) - curve.force(way.from);
            return add(self.pull(curve, way.from), gain, way.slope());
        }
        if self.slips_from_edge() {
            return self.mean_pull_from_edge(curve, way);
        }
        let start = self.displaced();
        let of_spring = |height, offset| mean_tension(way, start, height, offset);
        let mut sum = [0.0; D];
        if let Some(lowest) = self.list.vertices().first() {
            sum = times(curve.stiffness(lowest.height), of_spring(lowest.height, lowest.offset));
        }
        for (vertex, end) in self.segments_up_to((way.from, start)) {
            let (rise, breaks) = (end.0 - vertex.height, breaks(vertex, end, way, start));
            let mut part = 0.0;
            for _ in 0..breaks.len() {
                let next =
                    breaks.iter().fold(1.0, |next, &place| if place > part && place < next { place } else { next });
                let [from, to] = [part, next].map(|part| vertex.height + part * rise);
                let mean = over_springs(curve, from, to, |height| of_spring(height, vertex.offset_at(height)));
                sum = add(sum, 1.0, mean);
                part = next;
                if part >= 1.0 {
                    break;
                }
            }
        }
        if way.to > way.from {
            let touching = over_springs(curve, way.from, way.to, |height| of_spring(height, start));
            sum = add(sum, 1.0, touching);
        }
        sum
    }

    /// First and second time derivative of the tangential force, for the rates of a `way` that begins at the current position
    /// and for its `accelerations` along the normal and in the (scaled) tangential directions, divided by the coefficient of
    /// friction \[N/s, N/s^2\]. The second one is a difference of first ones.
    pub fn pull_rates(&self, curve: &Segment, way: &Motion<D>, accelerations: (f64, [f64; D])) -> [[f64; D]; 2] {
        let (normal, tangential) = accelerations;
        if self.list.vertices().is_empty() {
            return [[0.0; D]; 2];
        }
        if !way.moves() {
            // the motion begins in the direction of the accelerations
            let begun = Motion { normal, tangential, ..*way };
            return [[0.0; D], if begun.moves() { self.pull_rate(curve, &begun) } else { [0.0; D] }];
        }
        if self.slips_from_edge() {
            return self.pull_rates_from_edge(curve, way, accelerations);
        }
        let first = self.pull_rate(curve, way);
        let speed = length(way.tangential) + largest(way.normal, -way.normal);
        let path = WIDTH * way.from;
        let width = quotient(path, speed, path < LONGEST * speed, LONGEST);
        let after = |time: f64| {
            let of = |rate: f64, acceleration: f64| time * (rate + 0.5 * time * acceleration);
            let to = way.from + of(way.normal, normal);
            let shift = add(times(time, way.tangential), 0.5 * time * time, tangential);
            let mut moved = *self;
            moved.advance(curve, &Motion::straight(way.from, to, shift));
            let tangential = add(way.tangential, time, tangential);
            moved.pull_rate(curve, &Motion { from: to, to, normal: way.normal + time * normal, tangential, ..*way })
        };
        let rise = add(times(4.0, difference(after(width), first)), -1.0, difference(after(2.0 * width), first));
        [first, rise.map(|rise| quotient(rise, 2.0 * width, width > 0.0, f64::NAN))]
    }

    /// Time derivative of the tangential force for these rates, divided by the coefficient of friction \[N/s\].
    fn pull_rate(&self, curve: &Segment, way: &Motion<D>) -> [f64; D] {
        if self.slips_from_edge() {
            let [rate, _] = self.pull_rates_from_edge(curve, way, (0.0, [0.0; D]));
            return rate;
        }
        let displacement = self.displaced();
        // a spring on its limit slips along its tension, if it would else exceed the limit
        let of_slipping = |offset: [f64; D]| {
            let tension = difference(displacement, offset);
            let unit = if tension == [0.0; D] { tension } else { direction(tension) };
            let excess = dot(unit, way.tangential) - way.normal;
            add(way.tangential, -largest(excess, 0.0), unit)
        };
        let slips = |height: f64, offset: [f64; D]| {
            way.from - height - length(difference(displacement, offset)) <= AT_LIMIT * way.from
        };
        let mut sum = [0.0; D];
        if let Some(lowest) = self.list.vertices().first() {
            let is_slipping = slips(lowest.height, lowest.offset);
            let rate = if is_slipping { of_slipping(lowest.offset) } else { way.tangential };
            sum = times(curve.stiffness(lowest.height), rate);
        }
        for (vertex, end) in self.segments_up_to((way.from, displacement)) {
            let is_top = end.0 >= way.from;
            let is_slipping = slips(vertex.height, vertex.offset)
                && if is_top { length(vertex.slope) >= 1.0 - AT_LIMIT } else { slips(end.0, end.1) };
            let rate = if is_slipping {
                over_springs(curve, vertex.height, end.0, |height| of_slipping(vertex.offset_at(height)))
            } else {
                times(curve.stiffness(end.0) - curve.stiffness(vertex.height), way.tangential)
            };
            sum = add(sum, 1.0, rate);
        }
        sum
    }
}
