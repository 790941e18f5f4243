//! Friction makes no force and no energy, whatever the history: every pairing of laws that has friction, growing dents, rates
//! over ten decades.

use crate::physics::{AnyModel, Random, is_passive, model, some_models, unit};
use brinell_contact::tangential::{Friction, FrictionalContact, FrictionalModel};
use brinell_contact::{Body, Contact, Pair, loading::AnyLoading, unloading::AnyUnloading};
use brinell_testing::laws;

type Model = FrictionalModel<AnyLoading, AnyUnloading>;
type Frictional = FrictionalContact<12>;

const STEP: f64 = 1e-6;

/// A ball of 5 mm on mild steel: of steel, or rigid.
fn bodies(is_rigid: bool) -> [Body; 2] {
    let steel = Body { radius: 5e-3, youngs_modulus: 206e9, poissons_ratio: 0.3 };
    let ball = Body { youngs_modulus: if is_rigid { f64::INFINITY } else { steel.youngs_modulus }, ..steel };
    [ball, Body { radius: f64::INFINITY, ..steel }]
}

fn frictional(normal: AnyModel, coefficient: f64, is_rigid: bool) -> Model {
    let [ball, target] = bodies(is_rigid);
    FrictionalModel { normal, friction: Friction::between(&ball, &target, normal.pair.modulus, coefficient), loss: () }
}

/// Every pairing of laws that has friction and makes no energy along the normal.
fn pairings(is_rigid: bool) -> Vec<(String, AnyModel)> {
    let [ball, target] = bodies(is_rigid);
    let pair = Pair::new(&ball, &target, 300e6).expect("two bodies");
    let models = some_models(pair).into_iter().filter(|(name, model)| {
        let unloading = name.rsplit(' ').next().expect("a law's name");
        is_passive(model) && laws::entry("unloading", unloading).get("no_friction").is_none()
    });
    models.collect()
}

/// How far a history has broken the bounds.
#[derive(Default, Debug)]
struct Broken {
    /// Tangential force above `mu F`, relative to it.
    coulomb: f64,
    /// Fall of the friction work, relative to the largest energy that has been stored.
    fall: f64,
    /// Friction work of a step above `mu F` times its way and the stored energy, relative to them.
    excess: f64,
    /// Friction work and stored energy above the work of the tangential force, relative to the largest energy that has been
    /// stored: what the approximate springs of a growing dent store too much for a while.
    made: f64,
}

impl Broken {
    fn or(self, other: Broken) -> Broken {
        Broken {
            coulomb: self.coulomb.max(other.coulomb),
            fall: self.fall.max(other.fall),
            excess: self.excess.max(other.excess),
            made: self.made.max(other.made),
        }
    }
}

struct Run {
    contact: Frictional,
    model: Model,
    /// Largest energy so far [J]: stored, or `mu F` times a way.
    scale: f64,
    /// Work of the tangential force so far [J].
    work: f64,
}

impl Run {
    fn new(model: Model) -> Run {
        Run { contact: Frictional::start(&model, 0.0).expect("within range"), model, scale: 0.0, work: 0.0 }
    }

    /// One step with these rates [m/s]; `None` beyond the range of the law.
    fn step(&mut self, (rate, slip): (f64, f64), step: f64) -> Option<Broken> {
        let Run { contact, model, scale, work: total } = self;
        let mu = model.friction.coefficient;
        let before = (contact.friction_work(model), contact.tangential_energy(model), contact.normal().force());
        contact.set_tangential_rate(slip);
        let kept = <Frictional as Contact<Model>>::kept(model);
        contact.step_held(rate, step, &kept, || *model).ok()?;
        let (force, energy) = (contact.normal().force(), contact.tangential_energy(model));
        assert!(energy >= 0.0, "{energy:e}");
        let most = mu * before.2.max(force) * slip.abs() * step + before.1;
        // the elastic energy of the normal motion bounds what tangential springs can store
        let normal = mu / model.friction.scale() * contact.normal().elastic_energy(&model.normal);
        *scale = scale.max(most).max(normal);
        let work = contact.friction_work(model) - before.0;
        *total += contact.mean_tangential_force() * slip * step;
        let relative = |excess: f64, size: f64| if excess > 0.0 { excess / size.max(f64::MIN_POSITIVE) } else { 0.0 };
        Some(Broken {
            coulomb: relative(contact.tangential_force(model).abs() - mu * force, mu * force),
            fall: relative(-work, *scale),
            excess: relative(work - most, *scale),
            made: relative(before.0 + work + energy - *total, *scale),
        })
    }
}

/// Just after yield, the springs on the edge of the old contact end on that of the new one, but for rounding.
#[test]
fn a_dent_that_grows_a_little_while_the_ball_slides_keeps_coulombs_bound() {
    let [ball, target] = bodies(false);
    let pair = Pair::new(&ball, &target, 300e6).expect("two bodies");
    let normal = AnyModel { pair, ..model("big-alabo", "contact-radius") }.prepared();
    let three = [
        (0.08994791085892065, 0.040061415831334234),
        (0.19297829140824185, 0.0013460357514612518),
        (0.0005693733771485078, 8.155375791118345),
    ];
    for history in [three.as_slice(), &[(0.265, 0.0), (0.006, 4.0)]] {
        let mut run = Run::new(frictional(normal, 0.3, false));
        for &step in history {
            let broken = run.step(step, STEP).expect("within range");
            broken.assert_bounds(&format!("{step:?}"));
        }
        let limit = 0.3 * run.contact.normal().force();
        assert!((run.contact.tangential_force(&run.model) / limit - 1.0).abs() < 1e-12, "the ball slides");
    }
}

/// Random histories of `model`: the worst of each bound, with the seeds of the worst ones.
fn worst_of(normal: &AnyModel, is_rigid: bool, seeds: std::ops::Range<u64>) -> Broken {
    let mut worst = Broken::default();
    let size = unit(&normal.pair).indentation / STEP;
    for seed in seeds {
        let mut random = Random(seed);
        let mut decades = |low: f64, high: f64| 10f64.powf(low + (high - low) * random.next());
        let coefficient = decades(-2.0, 1.0);
        let length = decades(2f64.log10(), 50f64.log10()) as usize;
        let top = size * decades(-1.0, 3.0);
        let mut run = Run::new(frictional(*normal, coefficient, is_rigid));
        let mut random = Random(seed + 1_000_000);
        for _ in 0..length {
            let mut rate = || {
                let sign = if random.next() < 0.4 { -1.0 } else { 1.0 };
                sign * top * 10f64.powf(-10.0 * random.next())
            };
            let (mut normal, slip) = (rate(), rate());
            if run.contact.normal().indentation() + normal * STEP < -0.1 * top * STEP {
                normal = -normal;
            }
            let Some(broken) = run.step((normal, slip), STEP) else { break };
            worst = worst.or(broken);
        }
    }
    worst
}

impl Broken {
    /// The bounds hold to rounding. What approximate springs store too much is the error of their energy.
    fn assert_bounds(&self, what: &str) {
        let keeps = self.coulomb <= 1e-12 && self.fall <= 1e-14 && self.excess <= 1e-14;
        let errors = [("with luding", 0.1), ("with brinell", 1e-2), ("with walton-braun", 1e-5)];
        let error = errors.iter().find(|(law, _)| what.contains(law)).map_or(1e-3, |(_, error)| *error);
        assert!(keeps && self.made <= error, "{what}: {self:?}");
    }
}

#[test]
fn no_history_of_any_pairing_breaks_coulombs_bound_or_makes_energy() {
    for is_rigid in [false, true] {
        for (name, model) in pairings(is_rigid) {
            worst_of(&model, is_rigid, 0..150).assert_bounds(&format!("{name}, rigid: {is_rigid}"));
            // dents that hardly recover, and dents that mostly do
            for yield_strength in [3e4, 30e9] {
                let model = AnyModel { pair: Pair { yield_strength, ..model.pair }, ..model };
                worst_of(&model, is_rigid, 200..230).assert_bounds(&format!("{name}, {yield_strength:e} Pa"));
            }
        }
    }
}
