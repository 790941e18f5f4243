//! The impulse of a rate-dependent contact over a step.

use super::History;
use crate::damped::Damped;
use crate::numbers::largest;
use crate::quadrature::graded_integral;

impl<D: Damped + Copy> History<D> {
    /// Mean force \[N\] of a step of `step` \[s\] at `rate` \[m/s\] that has not been taken yet.
    pub fn mean_force(&self, rate: f64, step: f64) -> f64 {
        if rate == 0.0 {
            return self.force(rate);
        }
        let from = self.indentation.total();
        let mut moved = *self;
        moved.touch(from + rate * step, rate);
        let force = |time: f64| {
            let indentation = from + rate * time;
            let force = if indentation > 0.0 { moved.sum_of_forces(indentation, rate) } else { 0.0 };
            if force > 0.0 { force } else { 0.0 }
        };
        // the positions where the force begins, ends or has a corner
        let when = |indentation: f64| (indentation - from) / rate;
        let [first, second] = self.law.borders();
        let within = |border: f64| if border < from { border } else { largest(from, 0.0) };
        let change = |low, high| when(moved.sign_change(within(low), within(high), rate));
        let changes = [change(0.0, first), change(first, second), change(second, from)];
        let [lowest, middle, highest] = changes;
        let times = [when(0.0), when(first), when(second), lowest, middle, highest, step];
        let (mut start, mut impulse) = (0.0, 0.0);
        for _ in times {
            let next = times
                .into_iter()
                .filter(|&time| time > start)
                .fold(step, |next, time| if time < next { time } else { next });
            impulse += graded_integral(start, next, &force);
            start = next;
        }
        impulse / step
    }
}
