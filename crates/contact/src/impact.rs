//! Prediction of an impact from the energy balance, without time stepping.

use super::loading::Loading;
use super::regime::LARGEST_INDENTATION;
use super::unloading::Unloading;
use super::{Model, Regime};
use crate::numerics::quadrature::{gauss, graded_integral};
use core::cell::Cell;
use libm::{pow, sqrt};

/// A body of `mass` that hits the other one at `speed`, with no other force acting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact {
    /// Effective mass \[kg\] > 0: `1/m = 1/m1 + 1/m2`.
    pub mass: f64,
    /// Closing speed at first contact \[m/s\] > 0.
    pub speed: f64,
}

impl Impact {
    /// Kinetic energy `m v^2/2` \[J\], in the frame of the common centre of mass.
    pub fn energy(&self) -> f64 {
        0.5 * self.mass * self.speed * self.speed
    }
}

/// Result of an impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prediction {
    /// Largest indentation \[m\].
    pub max_indentation: f64,
    /// Largest force \[N\].
    pub max_force: f64,
    /// Contact radius at the largest indentation \[m\].
    pub max_contact_radius: f64,
    /// Regime reached at the largest indentation.
    pub regime: Regime,
    /// Depth of the dent \[m\].
    pub residual_indentation: f64,
    /// Kinetic energy before the impact \[J\].
    pub energy: f64,
    /// Kinetic energy after the impact \[J\].
    pub rebound_energy: f64,
    /// Coefficient of restitution: rebound speed over incoming speed.
    pub restitution: f64,
    /// Time from first contact to the largest indentation \[s\].
    pub loading_time: f64,
    /// Time from the largest indentation to the end of the force \[s\]. With losses and rate-dependent laws this may be before the
    /// bodies leave the surface, which lags behind them.
    pub unloading_time: f64,
}

impl Prediction {
    /// Duration of the contact \[s\]: from first touch to the end of the force.
    pub fn contact_time(&self) -> f64 {
        self.loading_time + self.unloading_time
    }
}

/// The impact `impact` on an untouched contact. The largest indentation `d_m` follows from `W(d_m) = m v^2/2`; the rebound
/// energy is the work returned by unloading.
///
/// `None` if the mass or the speed is not positive and finite, if the energy is below the smallest normal number, or if the
/// indentation would exceed the range in which the law can be evaluated ([`LARGEST_INDENTATION`] at most).
///
/// Reference: K. L. Johnson, *Contact Mechanics*, 1985, section 11.5. The energy balance is that of section 4 of A. Big-Alabo
/// et al., *Computers & Structures* 151 (2015) 20-29; the root is found to rounding.
pub fn predict<L: Loading, U: Unloading>(model: &Model<L, U>, impact: &Impact) -> Option<Prediction> {
    let (energy, max_indentation) = turning_point(model, impact)?;
    let unloading = model.unloading_path(max_indentation);
    let peak = model.peak(max_indentation);
    // a path that is not a segment has a different tangent at every point, or segments of a chain
    let part = |d: f64| model.unloading_segment(max_indentation, d);
    let middle = part(0.5 * (unloading.lower + max_indentation));
    let is_elastic = model.is_elastic_at(max_indentation);
    let follows_path = middle.upper >= max_indentation && middle.lower <= unloading.lower;
    let is_chain = !follows_path && middle.upper > middle.lower.next_up();
    // `Model::recovered_work`, but with path and peak computed once
    let recovered = |d: f64| match () {
        () if is_chain && is_elastic => model.loading.work(&model.pair, d),
        () if follows_path => unloading.work(d),
        () => model.unloading.work(&model.pair, &peak, &unloading, d),
    };
    let rebound_energy = recovered(max_indentation);
    // the energy for which the computed works balance, so that the speed at the turning point is exactly zero
    let work = model.loading.work(&model.pair, max_indentation);
    let loading_time = travel_time(
        impact.mass,
        0.0,
        max_indentation,
        |start, end| falling_energy(model, (start, end), work - model.loading.work(&model.pair, end), work),
        |d| model.loading.next_corner(&model.pair, d),
    );
    let unloading_time = travel_time(
        impact.mass,
        unloading.lower,
        max_indentation,
        |start, end| {
            let segment = if follows_path { unloading } else { part(start) };
            let at_end = rebound_energy - recovered(end);
            move |d, way| match follows_path || is_chain {
                true if end == max_indentation => segment.mean_force(d, end) * way,
                true => at_end + segment.mean_force(d, end) * way,
                false => rebound_energy - recovered(d),
            }
        },
        |d| if is_chain { part(d).upper } else { max_indentation },
    );
    Some(Prediction {
        max_indentation,
        max_force: peak.force,
        max_contact_radius: peak.contact_radius,
        regime: model.loading.regime(&model.pair, max_indentation),
        residual_indentation: unloading.lower,
        energy,
        rebound_energy,
        restitution: sqrt(rebound_energy / energy),
        loading_time,
        unloading_time,
    })
}

/// Coefficient of restitution as in [`predict`], without the times, which are the most expensive part.
pub fn restitution<L: Loading, U: Unloading>(model: &Model<L, U>, impact: &Impact) -> Option<f64> {
    let (energy, max_indentation) = turning_point(model, impact)?;
    Some(sqrt(model.recovered_work(max_indentation, max_indentation) / energy))
}

/// Kinetic energy \[J\] and largest indentation \[m\] of an impact.
pub(crate) fn turning_point<L: Loading, U: Unloading>(model: &Model<L, U>, impact: &Impact) -> Option<(f64, f64)> {
    let positive = |value: f64| value > 0.0 && value < f64::INFINITY;
    if !positive(impact.mass) || !positive(impact.speed) {
        return None;
    }
    let energy = impact.energy();
    // a subnormal energy has already lost digits
    if energy < f64::MIN_POSITIVE {
        return None;
    }
    let indentation = indentation_of_work(model, energy)?;
    // a fitted law may end earlier
    let end = model.loading.segment(&model.pair, indentation);
    let is_finite = end.force(indentation).is_finite() && end.stiffness(indentation).is_finite();
    is_finite.then_some((energy, indentation))
}

/// Number of Newton steps before the remaining bracket is bisected. A smooth law needs about five.
const NEWTON_STEPS: u32 = 24;

/// The indentation \[m\] whose loading work exceeds `energy` \[J\] while that of the next smaller number does not: the root to
/// rounding.
///
/// Newton's method works on the logarithms, in which a power law is a straight line, and starts from the indentation of Hertz's
/// law. It ends within rounding of the root. Steps of 1, 4, 16 ... units in the last place then close the bracket from the
/// other side. If a step would leave the bracket, or if Newton's method does not suit the law, the bracket is bisected.
fn indentation_of_work<L: Loading, U: Unloading>(model: &Model<L, U>, energy: f64) -> Option<f64> {
    // the bits of positive f64 numbers, read as integers, keep their order: 64 bisections find the neighbours
    let deepest = LARGEST_INDENTATION.to_bits();
    let (mut low, mut high) = (0, deepest);
    let mut guess = pow(energy / (0.4 * model.pair.hertz_stiffness()), 0.4).to_bits();
    let mut reach = 1;
    let mut from_below = true;
    let mut steps = 0;
    while high - low > 1 {
        let beyond = if from_below { low + reach } else { high - high.min(reach) };
        let inside = |bits: u64| bits > low && bits < high;
        let bits = if steps > NEWTON_STEPS {
            low + (high - low) / 2
        } else if inside(guess) {
            guess
        } else if steps > 0 && inside(beyond) {
            reach *= 4;
            beyond
        } else {
            low + (high - low) / 2
        };
        let indentation = f64::from_bits(bits);
        let work = model.loading.work(&model.pair, indentation);
        from_below = work <= energy;
        *(if from_below { &mut low } else { &mut high }) = bits;
        let force = model.loading.segment(&model.pair, indentation).force(indentation);
        guess = (indentation * pow(energy / work, work / (force * indentation))).to_bits();
        steps += 1;
    }
    let found = high < deepest || model.loading.work(&model.pair, LARGEST_INDENTATION) > energy;
    found.then(|| f64::from_bits(high))
}

/// A distance over which Gauss's rule integrates any law to rounding, as a fraction of the indentation.
const SHORT: f64 = 1.0 / 64.0;

/// The kinetic energy \[J\] on a smooth piece of the loading curve from `start` to `end` \[m\], where `energy` \[J\] is left at
/// the end. It is returned as a function of the indentation and of the distance to the end \[m\]. `whole` \[J\] is the work
/// over the whole piece.
///
/// The difference of two works loses digits near the turning point. The mean force over the remaining distance does not, on a
/// segment and, over a short distance, for any law. Where the work is an integral, each energy farther away is computed from
/// the previous one, because the integral between neighbours is short.
fn falling_energy<L: Loading, U: Unloading>(
    model: &Model<L, U>,
    (start, end): (f64, f64),
    energy: f64,
    whole: f64,
) -> impl Fn(f64, f64) -> f64 {
    let segment = model.loading.segment(&model.pair, start);
    let is_whole = segment.upper >= end;
    let last = Cell::new((end, energy));
    move |d, way| {
        if is_whole {
            return energy + segment.mean_force(d, end) * way;
        }
        if way < SHORT * end {
            return energy + gauss(d, end, &|at| model.loading.segment(&model.pair, at).force(at));
        }
        let (at, energy) = last.get();
        let between = |low, high| model.loading.work_between(&model.pair, low, high);
        let step = if d < at { between(d, at) } else { between(at, d).map(|work| -work) };
        let Some(step) = step else { return whole - model.loading.work(&model.pair, d) };
        last.set((d, energy + step));
        energy + step
    }
}

/// Time \[s\] between `from` and the turning point `to` \[m\] of a `mass` \[kg\]. On the smooth piece from `start` to `end`,
/// its kinetic energy at `d` is `kinetic_energy(start, end)(d, end - d)` \[J\]; it is zero at `to`.
///
/// `t = integral dd / sqrt(2 T(d)/m)`. The substitution `d = to - (to - from) s^2` removes the singularity at the end where the
/// speed vanishes. The integral is split at the corners of the law, because Gauss's rule needs a smooth integrand;
/// `next_corner(d)` is the first corner above `d`.
fn travel_time<E: Fn(f64, f64) -> f64>(
    mass: f64,
    from: f64,
    to: f64,
    kinetic_energy: impl Fn(f64, f64) -> E,
    next_corner: impl Fn(f64) -> f64,
) -> f64 {
    let length = to - from;
    let mut time = 0.0;
    let mut start = from;
    while start < to {
        let corner = next_corner(start);
        let end = if corner < to { corner } else { to };
        let kinetic_energy = kinetic_energy(start, end);
        let integrand = |s: f64| {
            let way = length * (s * s);
            let energy = kinetic_energy(to - way, way - (to - end));
            if energy > 0.0 { 2.0 * length * s / sqrt(2.0 * energy / mass) } else { 0.0 }
        };
        time += graded_integral(sqrt((to - end) / length), sqrt((to - start) / length), &integrand);
        start = end;
    }
    time
}
