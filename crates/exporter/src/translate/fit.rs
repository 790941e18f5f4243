//! The numbers of a tool's law for which an impact ends as it should.

use super::law::{Form, Law, Scales, Shape};
use super::motion::{Outcome, Promise, Stepping, exact};
use crate::numbers::one_digit;
use libm::{log, pow};

/// A law with its numbers.
#[derive(Clone, Copy, Debug)]
pub struct Fitted {
    pub law: Law,
    /// The step \[s\]; `None` where the tool chooses its steps.
    pub step: Option<f64>,
    /// Whether the steps are so short that the exact motion stands for them.
    pub is_fine: bool,
    /// How many times longer than the scene's the contact lasts, because the step is too long for that of the scene.
    pub softening: f64,
}

/// Steps in a contact below which a rebound is an accident of the phase.
const FEWEST: f64 = 30.0;
/// Steps in a contact if the user gives no step.
const USUAL: f64 = 100.0;
/// Steps in a contact beyond which those of the tool are not followed, but the exact motion.
const MOST: f64 = 20_000.0;
/// How near to a restitution a solver that damps by itself must come.
pub const NEAR: f64 = 5e-3;
/// The exponents from which one is chosen, and the ramps in scales of the overlap.
const EXPONENTS: (f64, f64) = (1.0, 2.5);
const RAMPS: (f64, f64) = (0.02, 10.0);
/// The largest scale of the overlap of a plastic sphere, in radii: in deeper ones LAMMPS differs from this law.
const DEEPEST: f64 = 0.05;
/// More steps than a softened contact is given.
const SOFTEST: f64 = 1000.0;

/// What the numbers are for.
pub struct Question<'a> {
    pub form: Form,
    pub stepping: Stepping,
    /// Whether the tool scales the damping by the speed at touch.
    pub at_touch: bool,
    pub scales: Scales,
    /// How the impact ends at the speed of the scales.
    pub goal: &'a Outcome,
    /// How it ends at each speed \[m/s\] of the range.
    pub speeds: &'a [f64],
    pub wanted: &'a [Outcome],
}

impl Question<'_> {
    /// The numbers for an impact that ends as wanted, at the user's `step` \[s\] if given. Restitution and contact time are met; what
    /// else a form has to choose is chosen for the least error over the range.
    ///
    /// # Errors
    /// In words, if no numbers lead there.
    pub fn answer(&self, step: Option<f64>) -> Result<Fitted, String> {
        let time = self.goal.contact_time;
        if self.stepping == Stepping::Own {
            let law = self.law(self.shape()?, time, None)?;
            return Ok(Fitted { law, step: None, is_fine: false, softening: 1.0 });
        }
        let shape = self.form.shape();
        let Some(step) = step else {
            let mut count = USUAL;
            loop {
                let step = rounded_down(time / count);
                match self.law(shape, time, Some(step)) {
                    Ok(law) => return Ok(Fitted { law, step: Some(step), is_fine: false, softening: 1.0 }),
                    Err(_) if count < SOFTEST => count *= 2.0,
                    Err(why) => return Err(why),
                }
            }
        };
        let mut softening = (FEWEST * step / time).max(1.0);
        loop {
            let used = Some(step).filter(|step| *step > time / MOST);
            match self.law(shape, softening * time, used) {
                Ok(law) => return Ok(Fitted { law, step: Some(step), is_fine: used.is_none(), softening }),
                // an implicit solver damps by itself, the less the more steps there are
                Err(_) if used.is_some() && softening * time < SOFTEST * step => softening *= 1.25,
                Err(why) => return Err(why),
            }
        }
    }

    /// The law as it is at another `speed` \[m/s\].
    pub fn at(&self, law: &Law, speed: f64) -> Law {
        match *law {
            Law::HuntCrossley { stiffness, exponent, dissipation } if self.at_touch => {
                Law::HuntCrossley { stiffness, exponent, dissipation: dissipation * self.scales.speed / speed }
            }
            law => law,
        }
    }

    /// The law with these `losses` whose contact lasts `time` \[s\], and its restitution.
    fn with(&self, shape: Shape, time: f64, losses: f64) -> Result<(Law, f64), String> {
        let Scales { mass, speed, radius, .. } = self.scales;
        let is_plastic = self.form == Form::Plastic;
        let (mut scale, mut restitution) = (speed * time, f64::NAN);
        // the size of a plastic sphere changes the course a little
        for _ in 0..if is_plastic { 4 } else { 1 } {
            if is_plastic && scale > DEEPEST * radius {
                return Err(format!(
                    "its law is not computed for overlaps beyond {DEEPEST} radii, and this one is deeper"
                ));
            }
            let ended = exact(&self.form.law(scale, shape, losses, &self.scales), mass, speed);
            let ended = ended.ok_or("its contact does not end")?;
            scale *= time / ended.contact_time;
            restitution = ended.restitution;
        }
        Ok((self.form.law(scale, shape, losses, &self.scales), restitution))
    }

    /// The law whose contact lasts `time` \[s\] and has the wanted restitution: the exact one, or the mean at this `step` \[s\].
    fn law(&self, shape: Shape, time: f64, step: Option<f64>) -> Result<Law, String> {
        let restitution = |losses: f64| -> Result<f64, String> {
            let (law, exact) = self.with(shape, time, losses)?;
            let Some(step) = step else { return Ok(exact) };
            let promise = Promise::at(&law, self.stepping, self.scales.mass, self.scales.speed, step);
            Ok(promise.ok_or("its contact does not end")?.mean.restitution)
        };
        let wanted = self.goal.restitution;
        let most = restitution(0.0)?;
        if most <= wanted {
            return match most >= wanted - NEAR {
                true => Ok(self.with(shape, time, 0.0)?.0),
                false => Err(format!("its restitution is {most:.3} at most, not {wanted:.3}")),
            };
        }
        let (mut low, mut high) = (0.0, 0.05);
        loop {
            let reached = restitution(high)?;
            if reached <= wanted {
                break;
            }
            if high > 1e4 {
                return Err(format!("its restitution is {reached:.3} at least, not {wanted:.3}"));
            }
            (low, high) = (high, 1.5 * high);
        }
        let losses = root((low, high), |losses| Ok(restitution(losses)? - wanted))?;
        Ok(self.with(shape, time, losses)?.0)
    }

    /// The shape with the least error over the range, on a lattice of round exponents.
    fn shape(&self) -> Result<Shape, String> {
        let (has_exponent, has_ramp) = self.form.chooses();
        let start = self.form.shape();
        if !has_exponent {
            return Ok(start);
        }
        let at = |exponent: f64, ramp: f64| Shape {
            exponent: (100.0 * exponent.clamp(EXPONENTS.0, EXPONENTS.1)).round() / 100.0,
            ramp: if has_ramp { ramp.clamp(RAMPS.0, RAMPS.1) } else { start.ramp },
        };
        let ramps = if has_ramp { 8 } else { 1 };
        let all =
            (0..6).flat_map(|n| (0..ramps).map(move |r| at(1.0 + 0.3 * f64::from(n), 0.02 * pow(2.4, f64::from(r)))));
        let mut best = (start, f64::INFINITY);
        let mut try_one = |shape: Shape| {
            let error = self.error(shape);
            let better = error < best.1;
            best = if better { (shape, error) } else { best };
            (better, best)
        };
        for shape in all {
            try_one(shape);
        }
        // a step in each direction, as long as one helps; then shorter ones
        let (mut further, mut wider) = (0.16, 1.6_f64);
        while further > 0.005 {
            let Shape { exponent, ramp } = try_one(start).1.0;
            let around = [(further, 1.0), (-further, 1.0), (0.0, wider), (0.0, 1.0 / wider)];
            let around = &around[..if has_ramp { 4 } else { 2 }];
            let helped = around.iter().any(|(more, times)| try_one(at(exponent + more, ramp * times)).0);
            if !helped {
                (further, wider) = (0.5 * further, wider.sqrt());
            }
        }
        if best.1.is_finite() { Ok(best.0) } else { self.law(start, self.goal.contact_time, None).map(|_| start) }
    }

    /// The sum of squares over the range of the errors of restitution, largest force and contact time.
    fn error(&self, shape: Shape) -> f64 {
        let Ok(law) = self.law(shape, self.goal.contact_time, None) else { return f64::INFINITY };
        let one = |(speed, wanted): (&f64, &Outcome)| {
            let Some(outcome) = exact(&self.at(&law, *speed), self.scales.mass, *speed) else { return f64::INFINITY };
            let force = log(outcome.largest_force / wanted.largest_force);
            let time = log(outcome.contact_time / wanted.contact_time);
            let restitution = outcome.restitution - wanted.restitution;
            restitution * restitution + force * force + time * time
        };
        self.speeds.iter().zip(self.wanted).map(one).sum()
    }
}

/// The number of one digit that is just below.
fn rounded_down(value: f64) -> f64 {
    one_digit(value, |mantissa| mantissa.floor().clamp(1.0, 9.0))
}

/// A root of `f`, which has different signs at the two ends.
fn root((mut low, mut high): (f64, f64), f: impl Fn(f64) -> Result<f64, String>) -> Result<f64, String> {
    let (mut at_low, mut at_high) = (f(low)?, f(high)?);
    let mut moved_high = None;
    for _ in 0..60 {
        if at_low == 0.0 || high - low <= 1e-12 * high.abs() {
            return Ok(low);
        }
        // the Illinois method: an end that stays twice loses half its weight
        let middle = (low * at_high - high * at_low) / (at_high - at_low);
        let middle = if middle > low && middle < high { middle } else { 0.5 * (low + high) };
        let at_middle = f(middle)?;
        if at_middle.abs() < 1e-13 {
            return Ok(middle);
        }
        let moves_high = (at_middle < 0.0) == (at_high < 0.0);
        let weight = if moved_high == Some(moves_high) { 0.5 } else { 1.0 };
        if moves_high {
            (high, at_high, at_low) = (middle, at_middle, weight * at_low);
        } else {
            (low, at_low, at_high) = (middle, at_middle, weight * at_high);
        }
        moved_high = Some(moves_high);
    }
    Ok(0.5 * (low + high))
}

/// The largest step \[s\] at which no phase of the touch gains energy, nor at any smaller one; `None` if some phase does at every
/// step, as without damping.
pub fn largest_passive_step(law: &Law, stepping: Stepping, mass: f64, speed: f64) -> Option<f64> {
    /// Rounding is no gain.
    const GAIN: f64 = 1e-9;
    let time = exact(law, mass, speed)?.contact_time;
    let (mut passive, mut count) = (None, 400.0);
    while count > 1.5 {
        let promise = Promise::at(law, stepping, mass, speed, time / count)?;
        if promise.most_restitution > 1.0 + GAIN {
            break;
        }
        passive = Some(time / count);
        count /= 1.04;
    }
    passive
}
