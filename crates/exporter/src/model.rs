//! The physical model of the contact of a scene.

use crate::body::Body;
use crate::numbers::significant;
use brinell_contact::damped::hunt_crossley::DampingFactor;
use brinell_contact::damped::tsuji::TsujiDamping;
use brinell_contact::damped::{AnyDamped, Damped, HuntCrossley, Tsuji};
use brinell_contact::impact::{self, Impact, Prediction};
use brinell_contact::loading::AnyLoading;
use brinell_contact::losses::{self, AnyLoss};
use brinell_contact::unloading::AnyUnloading;
use brinell_contact::{Loading, Model, Numbered, Pair, TwoBodies};

/// A kinetic energy that is too small for its full precision.
#[derive(Debug, thiserror::Error)]
#[error(
    "the kinetic energy of mass = {} kg at speed = {} m/s is {} J: below {} J it can't be computed with",
    significant(.0.mass, 6), significant(.0.speed, 6), significant(.0.energy(), 6), significant(f64::MIN_POSITIVE, 6)
)]
pub struct NoEnergy(Impact);

/// Rejects an impact that fails with every law: its energy is too small a number.
///
/// # Errors
/// [`NoEnergy`]
pub fn check_energy(impact: &Impact) -> Result<(), NoEnergy> {
    if impact.energy() < f64::MIN_POSITIVE { Err(NoEnergy(*impact)) } else { Ok(()) }
}

/// Standard gravity \[m/s^2\].
pub const GRAVITY: f64 = 9.80665;

/// The speed \[m/s\] after a fall from `height` \[m\].
pub fn speed_of_height(height: f64) -> f64 {
    (2.0 * GRAVITY * height).sqrt()
}

/// Bodies and laws of either kind.
#[derive(Clone, Copy, Debug)]
pub enum AnyModel {
    /// The force depends on the indentation and the largest indentation.
    Elastoplastic(Model<AnyLoading, AnyUnloading>),
    /// The same with a loss below yield; or a rate-dependent law, which is given.
    Lossy(losses::Model<AnyLoading, AnyUnloading, AnyLoss>, Option<RateLaw>),
}

/// A rate-dependent law with what its damping is for.
#[derive(Clone, Copy, Debug)]
pub struct RateLaw {
    pub law: AnyDamped,
    /// Coefficient of restitution; ignored by laws that need none.
    pub restitution: f64,
    /// Effective mass \[kg\]; ignored by laws that need none.
    pub mass: f64,
}

impl RateLaw {
    /// The law on the bodies `pair`.
    pub fn on(self, pair: Pair) -> AnyModel {
        let losses::Model { plastic, loss } = self.law.model(pair, self.restitution, self.mass);
        let Model { loading, unloading, surface, .. } = plastic;
        let (loading, unloading) = (AnyLoading::Elastic(loading), AnyUnloading::ContactRadius(unloading));
        let plastic = Model { pair, loading, unloading, surface };
        AnyModel::Lossy(losses::Model { plastic, loss: AnyLoss::Damper(loss) }, Some(self))
    }
}

impl AnyModel {
    /// The prediction of an impact; `None` where the law cannot be evaluated.
    pub fn predict(&self, impact: &Impact) -> Option<Prediction> {
        match self {
            AnyModel::Elastoplastic(model) => impact::predict(model, impact),
            AnyModel::Lossy(model, _) => losses::impact::predict(model, impact),
        }
    }

    /// Coefficient of restitution; `None` where the law cannot be evaluated.
    pub fn restitution(&self, impact: &Impact) -> Option<f64> {
        match self {
            AnyModel::Elastoplastic(model) => impact::restitution(model, impact),
            AnyModel::Lossy(model, _) => {
                losses::impact::predict(model, impact).map(|prediction| prediction.restitution)
            }
        }
    }

    /// The model without its loss, if it has no law whose force depends on the rate.
    pub fn elastoplastic(&self) -> Option<&Model<AnyLoading, AnyUnloading>> {
        match self {
            AnyModel::Elastoplastic(model) => Some(model),
            AnyModel::Lossy(model, None) => Some(&model.plastic),
            AnyModel::Lossy(_, Some(_)) => None,
        }
    }

    /// The rate-dependent law, if it has one.
    pub fn rate_law(&self) -> Option<RateLaw> {
        if let AnyModel::Lossy(_, law) = self { *law } else { None }
    }

    /// The same contact by another elastoplastic `model`, with the same loss.
    pub fn with_plastic(&self, plastic: Model<AnyLoading, AnyUnloading>) -> AnyModel {
        match self {
            AnyModel::Lossy(model, None) => AnyModel::Lossy(losses::Model { plastic, ..*model }, None),
            _ => AnyModel::Elastoplastic(plastic),
        }
    }

    /// The bodies.
    pub fn pair(&self) -> Pair {
        match self {
            AnyModel::Elastoplastic(model) => model.pair,
            AnyModel::Lossy(model, _) => model.plastic.pair,
        }
    }

    /// Area of a contact with this contact radius, or half-width of a line \[m^2\].
    pub fn area(&self, radius: f64) -> f64 {
        match self.elastoplastic() {
            Some(model) => model.loading.area(&model.pair, radius),
            None => std::f64::consts::PI * radius * radius,
        }
    }

    /// The indentation up to which the law is valid \[m\] for bodies of which the smaller one has this `size` \[m\].
    pub fn valid_depth(&self, size: f64) -> f64 {
        match self {
            AnyModel::Elastoplastic(model) => model.valid_depth(size),
            AnyModel::Lossy(model, _) => model.plastic.valid_depth(size),
        }
    }

    /// The model with a loss below yield, or with the damping of a rate-dependent law, if it is one.
    pub fn lossy(&self) -> Option<&losses::Model<AnyLoading, AnyUnloading, AnyLoss>> {
        match self {
            AnyModel::Lossy(model, _) => Some(model),
            AnyModel::Elastoplastic(_) => None,
        }
    }

    /// The model with this yield strength of the target \[Pa\], if its law has one.
    pub fn with_yield_strength(&self, yield_strength: f64) -> Option<AnyModel> {
        let model = self.elastoplastic()?;
        Some(self.with_plastic(Model { pair: Pair { yield_strength, ..model.pair }, ..*model }.prepared()))
    }

    /// The model with what its law needs to know of these bodies; `None` if it needs nothing beside their pair.
    pub fn with_bodies(&self, bodies: TwoBodies, softer: Body) -> Option<AnyModel> {
        let model = self.elastoplastic().filter(|model| model.loading.takes_both_bodies())?;
        Some(self.with_plastic(paired(model, bodies, softer).prepared()))
    }

    /// The stiffness of the way back from `indentation` \[m\]; of a rate-dependent law that of its elastic part \[N/m\].
    pub fn stiffness(&self, indentation: f64) -> f64 {
        let (AnyModel::Elastoplastic(model) | AnyModel::Lossy(losses::Model { plastic: model, .. }, _)) = self;
        model.unloading_segment(indentation, indentation).stiffness(indentation)
    }

    /// The method of a prediction, in words.
    pub fn method(&self) -> &'static str {
        match self {
            AnyModel::Elastoplastic(_) => "by energy balance",
            AnyModel::Lossy(..) => "by integrating the motion",
        }
    }

    /// Indentation \[m\] and force \[N\] during an impact with its `prediction`: up to the largest indentation, and back if
    /// unloading follows another path.
    pub fn branches(&self, impact: &Impact, prediction: &Prediction) -> Option<Vec<Vec<(f64, f64)>>> {
        match self {
            AnyModel::Elastoplastic(model) => {
                let (dent, largest) = (prediction.residual_indentation, prediction.max_indentation);
                let way = |from: f64, to: f64| {
                    (0..=POINTS).map(move |point| from + (to - from) * f64::from(point) / f64::from(POINTS))
                };
                let force = |d: f64| model.loading.segment(&model.pair, d).force(d);
                let back = |d: f64| model.unloading_segment(largest, d).force(d);
                let loading = way(0.0, largest).map(|d| (d, force(d))).collect();
                let unloading = way(largest, dent).map(|d| (d, back(d))).collect();
                Some(if model.is_elastic_at(largest) { vec![loading] } else { vec![loading, unloading] })
            }
            AnyModel::Lossy(model, _) => {
                let (mut all, mut deepest) = (Vec::new(), 0);
                losses::impact::follow(model, impact, |state, force| {
                    all.push((state.indentation, force));
                    deepest = if state.indentation >= all[deepest].0 { all.len() - 1 } else { deepest };
                })?;
                let back = all.split_off(deepest + 1);
                Some(joined(all, back))
            }
        }
    }
}

/// The model with the form of its loading law for these two bodies, of which the pair describes the `softer` one, if it has one.
pub fn paired(
    model: &Model<AnyLoading, AnyUnloading>,
    bodies: TwoBodies,
    softer: Body,
) -> Model<AnyLoading, AnyUnloading> {
    let loading = model.loading.of_bodies(bodies).along_line(bodies, softer == Body::Impactor);
    Model { loading, ..*model }
}

/// The two branches of an impact, which meet.
fn joined(there: Vec<(f64, f64)>, mut back: Vec<(f64, f64)>) -> Vec<Vec<(f64, f64)>> {
    back.splice(0..0, there.last().copied());
    vec![thinned(&there), thinned(&back)]
}

/// Some of the `points`, with the first and the last.
fn thinned(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let last = points.len() - 1;
    (0..=POINTS).map(|point| points[last * point as usize / POINTS as usize]).collect()
}

/// Number of points of a branch: a picture of some hundred pixels shows a smooth curve.
const POINTS: u32 = 120;

/// The damping variants of a rate-dependent law, by name.
pub trait Dampings: Sized {
    /// Their names; empty if there is only one.
    fn dampings(&self) -> Vec<&'static str>;

    /// The law with the damping of this name; `None` if there is none.
    fn with_damping(self, name: &str) -> Option<Self>;
}

impl Dampings for AnyDamped {
    fn dampings(&self) -> Vec<&'static str> {
        match self {
            AnyDamped::HuntCrossley(_) => DampingFactor::ALL.iter().map(|(name, _)| *name).collect(),
            AnyDamped::Tsuji(_) => TsujiDamping::ALL.iter().map(|(name, _)| *name).collect(),
            _ => Vec::new(),
        }
    }

    fn with_damping(self, name: &str) -> Option<AnyDamped> {
        match self {
            AnyDamped::HuntCrossley(_) => {
                let (_, damping_factor) = DampingFactor::ALL.into_iter().find(|(known, _)| *known == name)?;
                Some(AnyDamped::HuntCrossley(HuntCrossley { damping_factor }))
            }
            AnyDamped::Tsuji(_) => {
                let (_, damping_factor) = TsujiDamping::ALL.into_iter().find(|(known, _)| *known == name)?;
                Some(AnyDamped::Tsuji(Tsuji { damping_factor }))
            }
            _ => None,
        }
    }
}
