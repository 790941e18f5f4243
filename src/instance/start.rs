//! An instance before any motion: the bodies that its parameters describe, and where they are.

use super::*;

/// The start values of the settable parameters.
pub(super) const START: Values = {
    let mut values = [0.0; scene::SETTABLE.len()];
    let mut index = 0;
    while index < values.len() {
        values[index] = scene::SETTABLE[index].start;
        index += 1;
    }
    values
};

/// What of a pair is worth keeping; the rest are parameters.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bodies {
    /// Effective radius [m].
    pub radius: f64,
    /// Effective modulus [Pa].
    pub modulus: f64,
    /// Indentation up to which the law is valid [m].
    pub depth: f64,
}

impl Bodies {
    /// Takes what is kept of `pair`; the depth is found when all parameters are known.
    pub fn take(&mut self, pair: &Pair) {
        (self.radius, self.modulus) = (pair.radius, pair.modulus);
    }
}

/// What stands where there is no group.
pub(super) const NO_BODIES: Bodies = Bodies { radius: f64::NAN, modulus: f64::NAN, depth: f64::NAN };

/// 2^64 over the golden ratio, odd: what hashes are mixed with.
const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

/// The pair of bodies of `group` that `values` describe.
pub(super) fn pair_of(group: usize, values: &Values) -> Result<Pair, Fault> {
    let value = |parameter| scene::parameter(parameter, group, values);
    let impactor = Body {
        radius: value(Parameter::ImpactorRadius),
        youngs_modulus: value(Parameter::ImpactorYoungsModulus),
        poissons_ratio: value(Parameter::ImpactorPoissonsRatio),
    };
    let target = Body {
        radius: value(Parameter::TargetRadius),
        youngs_modulus: value(Parameter::TargetYoungsModulus),
        poissons_ratio: value(Parameter::TargetPoissonsRatio),
    };
    Pair::new(&impactor, &target, value(Parameter::TargetYieldStrength))
        .ok_or(Fault::NoPointContact { impactor: impactor.radius, target: target.radius })
}

/// What is in contact in `group`, whose `bodies` are those of `values`.
pub(super) fn model_of(group: usize, bodies: Bodies, values: &Values) -> Model {
    let value = |parameter| scene::parameter(parameter, group, values);
    let pair = Pair {
        radius: bodies.radius,
        modulus: bodies.modulus,
        yield_strength: value(Parameter::TargetYieldStrength),
        youngs_modulus: value(Parameter::TargetYoungsModulus),
        poissons_ratio: value(Parameter::TargetPoissonsRatio),
    };
    scene::model(pair, group, values)
}

/// A contact of `group` before any motion.
#[inline(never)]
fn start_of(group: usize, values: &Values) -> Result<(Pair, History), Fault> {
    let model = scene::model(pair_of(group, values)?, group, values);
    let history = History::start(&model, scene::parameter(Parameter::InitialGap, group, values));
    Ok((model.pair, history.map_err(|deep| too_deep(0, deep))?))
}

impl Instance {
    /// Makes the instance as it is before anything is set, the same bit for bit each time.
    ///
    /// # Errors
    /// [`Fault::NoPointContact`] if the start values of the scene don't fit together.
    pub fn reset(&mut self) -> Result<(), Fault> {
        self.values = START;
        self.rates.fill(0.0);
        self.time = 0.0;
        self.stop = f64::MAX;
        self.experiment_defined = false;
        self.fast = false;
        self.last_step.fill(0.0);
        self.deep = 0;
        self.straighten();
        self.set_phase(Phase::Instantiated);
        self.start()
    }

    /// Puts all contacts where they are before any motion; if one can't be there nothing is done.
    pub(super) fn start(&mut self) -> Result<(), Fault> {
        let started = self.start_contacts();
        self.stamp_parameters();
        started
    }

    /// Makes the [`Instance::stamp`] that of the parameters and of the bodies that follow from them, and finds what else does.
    #[cold]
    #[inline(never)]
    pub(super) fn stamp_parameters(&mut self) {
        let bodies = self.pairs.iter().flat_map(|bodies| [bodies.radius, bodies.modulus]);
        let mix = |sum: u64, value: f64| {
            let mixed = (sum ^ value.to_bits()).wrapping_mul(GOLDEN);
            mixed ^ mixed >> 32
        };
        // blank memory has the stamp zero
        let stamp = self.values.iter().copied().chain(bodies).fold(GOLDEN, mix) | 1;
        if stamp != self.stamp {
            self.stamp = stamp;
            self.lowest_rate = validity::lowest_rate(&self.values);
            for (group, bodies) in self.pairs.iter_mut().enumerate() {
                bodies.depth = model_of(group, *bodies, &self.values).valid_depth();
            }
        }
    }

    fn start_contacts(&mut self) -> Result<(), Fault> {
        if scene::GROUPS > 1 {
            for group in 0..scene::GROUPS {
                start_of(group, &self.values)?;
            }
        }
        let mut histories = self.histories.iter_mut();
        let mut first = 0;
        for (group, bodies) in self.pairs.iter_mut().enumerate() {
            let (pair, history) = start_of(group, &self.values)?;
            bodies.take(&pair);
            let end = scene::end(group);
            for slot in histories.by_ref().take(end - first) {
                *slot = history;
            }
            first = end;
        }
        for (momentum, history) in self.momenta.iter_mut().zip(&self.histories) {
            *momentum = Momentum::start(history.force_at_rate(0.0));
        }
        self.note_forces();
        Ok(())
    }
}
