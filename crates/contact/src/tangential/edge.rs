//! Slip from the edge of the contact inwards, in closed form: every motion along a line on one elastic curve.
//!
//! The slip front moves linearly between events. At an event it passes a vertex, or the annulus of slip closes and opens in the
//! other direction.

use super::list::Apex;
use super::vector::{add, difference, direction, dot, length, times};
use super::{Motion, PlayOperator, SAME, TINY, Vertex};
use crate::history::path::Sum;
use crate::numerics::{quotient, smallest};
use crate::segment::Segment;

impl<const D: usize> Vertex<D> {
    /// Distance \[m\] of the vertex from the side of the cone of `apex` that slips in this `direction`; positive inside.
    fn distance(&self, direction: [f64; D], apex: &Apex<D>) -> f64 {
        dot(direction, difference(self.offset, apex.displacement)) + apex.indentation - self.height
    }

    /// Whether the segment has the slope of springs that slip in this `direction`.
    fn slips(&self, direction: [f64; D]) -> bool {
        length(difference(self.slope, direction)) <= SAME
    }

    /// Height \[m\] of the slip front in this `direction` on the segment, at this `distance` \[m\] of the vertex from the side of
    /// the cone. The segment has another slope.
    fn front(&self, direction: [f64; D], distance: f64) -> f64 {
        self.height + distance / (1.0 - dot(direction, self.slope))
    }
}

impl<const D: usize, const N: usize> PlayOperator<D, N> {
    /// Cuts the polyline with the cone of the current point.
    ///
    /// Only the end point matters: on a straight way its cone cuts off as much of the polyline as the cones of all
    /// points on the way together.
    pub(super) fn cut_edge(&mut self, curve: &Segment, way: &Motion<D>, is_fresh: bool) {
        let apex = Apex { displacement: self.displaced(), indentation: way.to };
        let mut left = self.list.vertices();
        let slip = way.slip().unwrap_or_else(|| {
            while let Some((last, below)) = left.split_last()
                && !below.is_empty()
                && last.height >= way.to
            {
                left = below;
            }
            let line = left.last().map_or([0.0; D], |last| last.offset_at(way.to));
            direction(difference(apex.displacement, line))
        });
        while let Some((last, below)) = left.split_last()
            && last.distance(slip, &apex) <= SAME * way.to
        {
            left = below;
        }
        let count = if is_fresh { 0 } else { left.len() };
        self.list.truncate(count);
        let Some(last) = self.list.last() else {
            // from here on only the direction of sliding matters
            self.displacement = [Sum::new(0.0); D];
            let offset = times(curve.lower - way.to, slip);
            return self.list.add(Vertex::new(curve, curve.lower, offset, slip));
        };
        if !last.slips(slip) {
            let front = last.front(slip, last.distance(slip, &apex));
            // an annulus that is too thin to matter takes no place in a full list
            let is_kept = self.segments() < N || way.to - front > TINY * way.to;
            if front < way.to && is_kept {
                let offset = last.offset_at(front);
                self.list.push(curve, Vertex::new(curve, front, offset, slip));
            }
        }
    }

    /// The direction in which springs begin to slip on a `way` without stick.
    fn slip_of(&self, way: &Motion<D>) -> [f64; D] {
        way.slip().unwrap_or_else(|| direction(add(way.tangential, -way.normal, self.edge())))
    }

    /// Mean tangential force of a step with slip on this `way` that is yet to come, divided by the coefficient of friction
    /// \[N\]; exact.
    pub(super) fn mean_pull_from_edge(&self, curve: &Segment, way: &Motion<D>) -> [f64; D] {
        let (start, rise) = (self.displaced(), way.rise());
        let at = |time: f64| Apex { displacement: add(start, time, way.shift), indentation: way.from + time * rise };
        let end = way.part_above(curve.lower);
        let mut left = self.list.vertices();
        let mut slip = self.slip_of(way);
        let (mut time, mut sum) = (0.0, [0.0; D]);
        // the front passes each vertex once, and changes direction once between two of them
        for _ in 0..2 * N + 3 {
            let apex = at(time);
            let here = apex.indentation;
            let Some((last, below)) = left.split_last() else { break };
            let distance = last.distance(slip, &apex);
            if distance <= SAME * here || last.slips(slip) {
                left = below;
                continue;
            }
            let approach = dot(slip, way.shift) - rise;
            let from = smallest(last.front(slip, distance), here);
            let speed = -approach / (1.0 - dot(slip, last.slope));
            let passes = time + quotient(distance, approach, approach > 0.0, f64::INFINITY);
            let closing = speed - rise;
            let closes = time + quotient(here - from, closing, rise < 0.0 && closing > 0.0, f64::INFINITY);
            let next = smallest(smallest(closes, passes), end);
            let to = if passes <= next { last.height } else { from + (next - time) * speed };
            let stuck = curve.mean_force(from, to);
            let whole = curve.mean_force(here, at(next).indentation);
            let mean = add(super::play_operator::pull(left, stuck), whole - stuck, slip);
            sum = add(sum, next - time, mean);
            time = next;
            if next >= end {
                return sum;
            }
            if closes < passes {
                slip = times(-1.0, slip);
            } else {
                left = below;
            }
        }
        // all springs slide
        add(sum, (end - time) * curve.mean_force(at(time).indentation, at(end).indentation), slip)
    }

    /// First and second time derivative of the tangential force, for the rates of a `way` that begins at the current position and
    /// for its `accelerations` along the normal and in the (scaled) tangential directions, divided by the coefficient of friction
    /// \[N/s, N/s^2\].
    ///
    /// Springs above the front move with the edge, those below it with the tangential motion: with the stiffness `K` at the
    /// indentation `d` and at the front `c`, in the direction `s`, the first one is `s K(d) d' + K(c) (sigma' - s d')`.
    pub(super) fn pull_rates_from_edge(
        &self,
        curve: &Segment,
        way: &Motion<D>,
        (normal, tangential): (f64, [f64; D]),
    ) -> [[f64; D]; 2] {
        let apex = Apex { displacement: self.displaced(), indentation: way.from };
        let (slip, front) = if way.sticks() {
            ([0.0; D], Some((way.from, way.normal)))
        } else {
            let slip = self.slip_of(way);
            let mut distances = self.list.vertices().iter().rev().map(|last| (last, last.distance(slip, &apex)));
            let found = distances.find(|(last, distance)| *distance > SAME * way.from && !last.slips(slip));
            let front = found.map(|(last, distance)| {
                let speed = (way.normal - dot(slip, way.tangential)) / (1.0 - dot(slip, last.slope));
                (smallest(last.front(slip, distance), way.from), speed)
            });
            (slip, front)
        };
        // of the force of a curve up to a height that moves with this speed, in the direction that moves with these rates
        let rates = |height: f64, speed: f64, rate: [f64; D], change: [f64; D]| {
            let stiffness = curve.stiffness(height);
            let stiffening = if speed == 0.0 { 0.0 } else { curve.curvature(height) * speed };
            [times(stiffness, rate), add(times(stiffness, change), stiffening, rate)]
        };
        let whole = rates(way.from, way.normal, times(way.normal, slip), times(normal, slip));
        let Some((height, speed)) = front else { return whole };
        let [rate, change] = [add(way.tangential, -way.normal, slip), add(tangential, -normal, slip)];
        let [first, second] = rates(height, speed, rate, change);
        [add(whole[0], 1.0, first), add(whole[1], 1.0, second)]
    }
}
