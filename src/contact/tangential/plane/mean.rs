//! The mean tangential force over a step.

use super::vector::{Vector, add, cross, difference, dot, length, times};
use super::{Stuck, Way};
use crate::contact::numbers::{largest, quotient, smallest};
use crate::contact::segment::Segment;
use crate::contact::tangential;
use crate::contact::tangential::shear::mean_by_trials;
use libm::fabs;

/// Springs this near to a line, relative to their limits, are on it.
const ALONG: f64 = 1e-9;

/// The springs in one direction, which never move to another path.
type Line<const N: usize> = tangential::Stuck<N, 0>;

impl<const N: usize> Stuck<N> {
    /// Mean tangential force over a `way` that is yet to come, divided by the coefficient of friction \[N\]: exact where all
    /// springs stick, and where their tensions and the way lie on one line; otherwise from trial steps.
    pub fn mean_pull(&self, curve: &Segment, way: &Way) -> [f64; 2] {
        if way.from <= curve.lower && way.to <= curve.lower || !way.moves() {
            return self.pull(curve, way.from);
        }
        if way.sticks() && way.from > curve.lower {
            let gain = curve.mean_force(way.from, way.to) - curve.force(way.from);
            return add(self.pull(curve, way.from), gain, way.slope());
        }
        let direction = self.direction(way);
        match self.on_line(curve, direction, way.from) {
            Some(line) => {
                let along = |vector: Vector| dot(vector, direction);
                let way = tangential::Way {
                    from: way.from,
                    to: way.to,
                    shift: along(way.shift),
                    normal: way.normal,
                    tangential: along(way.tangential),
                };
                times(line.mean_pull(curve, &way), direction)
            }
            None => mean_by_trials(self, curve, way),
        }
    }

    /// The direction of the way; without one, that of the springs.
    fn direction(&self, way: &Way) -> Vector {
        if length(way.tangential) > 0.0 {
            return way.direction();
        }
        let slope = self.list.vertices().iter().map(|vertex| vertex.slope).find(|slope| length(*slope) > ALONG);
        let slope = slope.unwrap_or([1.0, 0.0]);
        slope.map(|part| quotient(part, length(slope), length(slope) > 0.0, 0.0))
    }

    /// The springs in one direction, if all their tensions have it at this `indentation` \[m\], and none is beyond its limit.
    fn on_line(&self, curve: &Segment, direction: Vector, indentation: f64) -> Option<Line<N>> {
        let displacement = self.displaced();
        // what a large displacement has lost of a small tension counts as rounding
        let size = largest(indentation, length(displacement));
        let mut line = Line::<N>::APART;
        for (vertex, (end, _)) in self.segments_up_to((indentation, displacement)) {
            let tension = difference(displacement, vertex.offset);
            let slope = dot(vertex.slope, direction);
            let beyond = (fabs(slope) - 1.0) * (end - vertex.height);
            if largest(beyond, fabs(cross(tension, direction))) > ALONG * size {
                return None;
            }
            let slope = largest(smallest(slope, 1.0), -1.0);
            line.list.push(curve, tangential::Vertex::new(curve, vertex.height, -dot(tension, direction), slope));
        }
        Some(line)
    }
}
