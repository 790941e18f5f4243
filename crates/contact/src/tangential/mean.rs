//! The mean tangential force over a step, and its time derivative.

use super::stuck::{distance, front};
use super::{SAME, Stuck, Vertex, Way};
use crate::numbers::quotient;
use crate::segment::Segment;
use libm::fabs;

impl<const N: usize, const PARTS: u32> Stuck<N, PARTS> {
    /// Mean tangential force of a step on this `way` that is yet to come, divided by the coefficient of friction
    /// \[N\]; exact.
    pub fn mean_pull(&self, curve: &Segment, way: &Way) -> f64 {
        let surface = curve.lower;
        if way.from <= surface && way.to <= surface || !way.moves() {
            return self.pull(curve, way.from);
        }
        if self.list.is_empty() && way.from > surface {
            return Stuck::<N>::pressed(curve, way.from).mean_pull(curve, way);
        }
        if self.list.is_empty() {
            // all springs are new and either stick or slip
            let slope = if way.sticks() { way.slope() } else { way.slip().unwrap_or(0.0) };
            let above = way.above(surface);
            return way.part_above(surface) * slope * curve.mean_force(above.from, above.to);
        }
        if way.sticks() {
            let gain = curve.mean_force(way.from, way.to) - curve.force(way.from);
            return self.pull(curve, way.from) + way.slope() * gain;
        }
        self.mean_pull_of_slip(curve, way)
    }

    /// The same for a step with slip. The slip front moves linearly in time between events. At an event the front
    /// passes a vertex, or the annulus of slip closes and opens in the other direction.
    fn mean_pull_of_slip(&self, curve: &Segment, way: &Way) -> f64 {
        let (start, rise) = (self.displacement.total(), way.rise());
        let displacement = |time: f64| start + time * way.shift;
        let indentation = |time: f64| way.from + time * rise;
        let end = way.part_above(curve.lower);
        let mut left = self.list.vertices();
        let mut sign = self.direction(way);
        let (mut time, mut sum) = (0.0, 0.0);
        // the front passes each vertex once, and changes direction once between two of them
        for _ in 0..2 * N + 3 {
            let here = indentation(time);
            let Some((last, below)) = left.split_last() else { break };
            let distance = distance(last, sign, displacement(time), here);
            let approach = sign * way.shift - rise;
            if distance <= SAME * here || fabs(last.slope - sign) <= SAME {
                left = below;
                continue;
            }
            let lowest = front(last, sign, distance);
            let from = if lowest < here { lowest } else { here };
            let speed = -approach / (1.0 - sign * last.slope);
            let passes = time + quotient(distance, approach, approach > 0.0, f64::INFINITY);
            let closing = speed - rise;
            let closes = time + quotient(here - from, closing, rise < 0.0 && closing > 0.0, f64::INFINITY);
            let first = if closes < passes { closes } else { passes };
            let next = if first < end { first } else { end };
            let to = from + (next - time) * speed;
            let to = if passes <= next { last.height } else { to };
            let stuck = curve.mean_force(from, to);
            let whole = curve.mean_force(here, indentation(next));
            sum += (next - time) * (last.pull_up_to(stuck) + sign * (whole - stuck));
            time = next;
            if next >= end {
                return sum;
            }
            if closes < passes {
                sign = -sign;
            } else {
                left = below;
            }
        }
        // all springs slide
        sum + (end - time) * sign * curve.mean_force(indentation(time), indentation(end))
    }

    /// The direction in which springs begin to slip on a `way` without stick.
    fn direction(&self, way: &Way) -> f64 {
        way.slip().unwrap_or_else(|| {
            let slope = self.list.last().map_or(0.0, |last: &Vertex| last.slope);
            if way.tangential > slope * way.normal { 1.0 } else { -1.0 }
        })
    }

    /// First and second time derivative of the tangential force in the direction of the motion, for the rates of a `way`
    /// that begins at the current position and for its `accelerations` along the normal and in the (scaled) tangential
    /// direction, divided by the coefficient of friction \[N/s, N/s^2\].
    pub fn pull_rates(&self, curve: &Segment, way: &Way, accelerations: (f64, f64)) -> (f64, f64) {
        let (indentation, displacement) = (way.from, self.displacement.total());
        let (normal, tangential) = accelerations;
        if self.list.is_empty() {
            return (0.0, 0.0);
        }
        if !way.moves() {
            // the motion begins in the direction of the accelerations
            let begun = Way { normal, tangential, ..*way };
            return (0.0, if begun.moves() { self.pull_rates(curve, &begun, (0.0, 0.0)).0 } else { 0.0 });
        }
        let stiffness = curve.stiffness(indentation);
        let (speed, change) = (way.normal, normal);
        if way.sticks() {
            let stiffening = product(curve.curvature(indentation), speed);
            return (stiffness * way.tangential, stiffening * way.tangential + stiffness * tangential);
        }
        let sign = self.direction(way);
        // of a part of the curve whose end moves with this speed and acceleration
        let rates = |height: f64, speed: f64, change: f64| {
            let stiffness = curve.stiffness(height);
            (stiffness * speed, product(curve.curvature(height), speed * speed) + stiffness * change)
        };
        let whole = rates(indentation, speed, change);
        let mut left = self.list.vertices();
        while let Some((last, below)) = left.split_last() {
            let distance = distance(last, sign, displacement, indentation);
            if distance > SAME * indentation && fabs(last.slope - sign) > SAME {
                let front = front(last, sign, distance);
                let divisor = 1.0 - sign * last.slope;
                let front = if front < indentation { front } else { indentation };
                let of_front = |normal: f64, tangential: f64| (normal - sign * tangential) / divisor;
                let stuck = rates(front, of_front(speed, way.tangential), of_front(normal, tangential));
                let less = last.slope - sign;
                return (sign * whole.0 + less * stuck.0, sign * whole.1 + less * stuck.1);
            }
            left = below;
        }
        (sign * whole.0, sign * whole.1)
    }
}

/// The product of a curvature, which may be infinite at the surface, and a rate.
fn product(curvature: f64, rate: f64) -> f64 {
    if rate == 0.0 { 0.0 } else { curvature * rate }
}
