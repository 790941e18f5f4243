//! The softer body of a scene with another strength, hardening or rate constant.

use super::Kind;
use crate::scene::{Body, QuasiStatic, Rate, Scene};
use brinell::contact::Loading;
use brinell::contact::impact::Impact;

/// The flow stress of the softer body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flow {
    pub body: Body,
    pub hardening: QuasiStatic,
    pub rate: Option<Rate>,
}

impl Flow {
    /// That of the first contact of `scene`; `None` if its law doesn't yield.
    pub fn of(scene: &Scene) -> Option<Flow> {
        let yields = scene.damped.is_none() && scene.loading.0 != "hertz";
        yields.then(|| Flow { body: scene.softer(0), hardening: scene.quasi_static(0), rate: scene.rate(0) })
    }

    /// Restitution of the first contact of `scene` at a closing speed [m/s]; `None` beyond the range of the law.
    pub fn restitution(&self, scene: &Scene, speed: f64) -> Option<f64> {
        let impact = Impact { mass: scene.impact_of(0).mass, speed };
        scene.model_in_impact(self.hardening, self.rate, &impact)?.restitution(&impact)
    }

    /// Largest contact radius of an impact at a speed [m/s], or of a slow first loading to an indentation [m], over the
    /// effective radius; `None` beyond the range of the law.
    pub fn width(&self, scene: &Scene, kind: Kind, at: f64) -> Option<f64> {
        let radius = match kind {
            Kind::Restitution => {
                let impact = Impact { mass: scene.impact_of(0).mass, speed: at };
                scene.model_in_impact(self.hardening, self.rate, &impact)?.predict(&impact)?.max_contact_radius
            }
            Kind::Force => {
                let model = scene.model_with(self.hardening);
                let model = model.elastoplastic()?;
                model.loading.contact_radius(&model.pair, at)
            }
        };
        Some(radius / scene.any_model().pair().radius)
    }

    /// Force [N] of a slow first loading of the first contact of `scene` to an indentation [m]; `None` beyond the range of the
    /// law.
    pub fn force(&self, scene: &Scene, indentation: f64) -> Option<f64> {
        let model = scene.model_with(self.hardening);
        let model = model.elastoplastic()?;
        let force = model.loading.segment(&model.pair, indentation).force(indentation);
        force.is_finite().then_some(force)
    }
}
