//! The numbers of a tool's law for which an impact ends as it should.

use super::law::{Form, Law, Scales};
use super::motion::{Outcome, Promise, Stepping, exact};

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
/// Largest difference of a restitution that counts as met.
const MET: f64 = 1e-3;
/// The exponents from which one is chosen.
const EXPONENTS: (f64, f64) = (1.0, 3.0);

/// The numbers of `form` for an impact that ends as `wanted`, in a tool with this `stepping`, at the user's `step` \[s\] if given.
/// Restitution and contact time are met; the largest force too, as far as the form has an exponent to choose.
///
/// # Errors
/// In words, if no numbers lead there.
pub fn fit(
    form: Form,
    stepping: Stepping,
    wanted: &Outcome,
    scales: &Scales,
    step: Option<f64>,
) -> Result<Fitted, String> {
    let search = Search { form, stepping, wanted, scales };
    let time = wanted.contact_time;
    if stepping == Stepping::Own {
        let exponent = if form.has_exponent() { search.exponent()? } else { form.exponent() };
        return search.law(exponent, time, None).map(|law| Fitted { law, step: None, is_fine: false, softening: 1.0 });
    }
    let exponent = form.exponent();
    match step {
        Some(step) => {
            let mut softening = (FEWEST * step / time).max(1.0);
            loop {
                let used = Some(step).filter(|step| *step > softening * time / MOST);
                match search.law(exponent, softening * time, used) {
                    Ok(law) => return Ok(Fitted { law, step: Some(step), is_fine: used.is_none(), softening }),
                    // an implicit solver damps by itself, the less the more steps there are
                    Err(_) if used.is_some() => softening *= 1.25,
                    Err(why) => return Err(why),
                }
            }
        }
        None => {
            let mut count = USUAL;
            loop {
                let step = rounded_down(time / count);
                match search.law(exponent, time, Some(step)) {
                    Ok(law) => return Ok(Fitted { law, step: Some(step), is_fine: false, softening: 1.0 }),
                    Err(_) if count < 0.5 * MOST => count *= 2.0,
                    Err(why) => return Err(why),
                }
            }
        }
    }
}

/// The number of one digit that is just below.
fn rounded_down(value: f64) -> f64 {
    let power = value.log10().floor() as i32;
    let digit = (value / 10f64.powi(power)).floor().clamp(1.0, 9.0);
    // through text: the number that a person would write
    format!("{digit}e{power}").parse().expect("a number")
}

struct Search<'a> {
    form: Form,
    stepping: Stepping,
    wanted: &'a Outcome,
    scales: &'a Scales,
}

impl Search<'_> {
    /// The law with these `losses` whose contact lasts `time` \[s\], and the outcome of its exact impact.
    fn with(&self, exponent: f64, time: f64, losses: f64) -> Result<(Law, Outcome), String> {
        let Scales { mass, speed, .. } = *self.scales;
        let first = self.form.law(speed * time, exponent, losses, self.scales);
        let ends = |law: &Law| exact(law, mass, speed).ok_or("its contact does not end");
        let law = self.form.law(speed * time * time / ends(&first)?.contact_time, exponent, losses, self.scales);
        Ok((law, ends(&law)?))
    }

    /// The law whose contact lasts `time` \[s\] and has the wanted restitution: the exact one, or the mean at this `step` \[s\].
    fn law(&self, exponent: f64, time: f64, step: Option<f64>) -> Result<Law, String> {
        let restitution = |losses: f64| -> Result<f64, String> {
            let (law, exact) = self.with(exponent, time, losses)?;
            let Some(step) = step else { return Ok(exact.restitution) };
            let promise = Promise::at(&law, self.stepping, self.scales.mass, self.scales.speed, step);
            Ok(promise.ok_or("its contact does not end")?.mean.restitution)
        };
        let wanted = self.wanted.restitution;
        let most = restitution(0.0)?;
        if most <= wanted {
            return match most >= wanted - MET {
                true => Ok(self.with(exponent, time, 0.0)?.0),
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
        Ok(self.with(exponent, time, losses)?.0)
    }

    /// The exponent, with two decimals, whose largest force is nearest to the wanted one.
    fn exponent(&self) -> Result<f64, String> {
        let Scales { mass, speed, .. } = *self.scales;
        let excess = |exponent: f64| -> Result<f64, String> {
            let law = self.law(exponent, self.wanted.contact_time, None)?;
            let outcome = exact(&law, mass, speed).ok_or("its contact does not end")?;
            Ok(outcome.largest_force / self.wanted.largest_force - 1.0)
        };
        let (low, high) = (excess(EXPONENTS.0)?, excess(EXPONENTS.1)?);
        let exponent = match (low < 0.0, high < 0.0) {
            (true, false) | (false, true) => root(EXPONENTS, excess)?,
            _ if low.abs() <= high.abs() => EXPONENTS.0,
            _ => EXPONENTS.1,
        };
        Ok((100.0 * exponent).round() / 100.0)
    }
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
