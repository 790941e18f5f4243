//! The bodies of each contact, which of the two yields, and values that follow from them alone.

use super::checked::{Group, Scene};
use super::ellipses::Elliptic;
use crate::body::{Body, Rod};
use crate::numbers::{cell, quantity};
use brinell_contact::loading::AnyLoading;
use brinell_contact::losses::Loss;
use brinell_contact::rate::Factors;
use brinell_contact::validity::size_of;
use brinell_contact::{Model, OtherBody, Pair, TwoBodies};
use std::collections::HashMap;
use std::f64::consts::PI;

impl Scene {
    /// The bodies of the contacts of `group`; `None` if they do not fit.
    pub(super) fn pair_of(&self, group: usize) -> Option<Pair> {
        let [impactor, target] = self.as_balls(group, self.bodies(group));
        let softer = self.softer(group);
        let factor = self.factors[group].softer;
        let own = self.group_value(group, softer.yield_strength()).map(|strength| strength * factor);
        let strength = own.unwrap_or(f64::INFINITY);
        let pair = Pair::new(&impactor, &target, strength)?;
        Some(if softer == Body::Impactor { pair.yielding_in(&impactor, strength) } else { pair })
    }

    /// What the law `brinell` needs to know of the bodies of `group` beside their pair.
    pub fn two_bodies(&self, group: usize) -> TwoBodies {
        let Factors { softer: factor, harder: others } = self.factors[group];
        let value =
            |name: &str, without: f64, factor: f64| self.group_value(group, name).map_or(without, |own| own * factor);
        let softer = self.softer(group);
        let [impactor, target] = self.as_balls(group, self.bodies(group));
        let harder = self.hardening_factor(group);
        let (soft, body) = if softer == Body::Impactor { (impactor, target) } else { (target, impactor) };
        TwoBodies {
            hardening_modulus: harder * value(softer.hardening_modulus(), 0.0, factor),
            curvature: soft.curvature(&body),
            other: OtherBody {
                modulus: body.plane_strain_modulus(),
                poissons_ratio: body.poissons_ratio,
                yield_strength: value(softer.other().yield_strength(), f64::INFINITY, others),
                hardening_modulus: harder * value(softer.other().hardening_modulus(), 0.0, others),
            },
        }
    }

    /// Impactor and target of `group`. An impactor without moduli is rigid, a target without a radius is flat.
    pub fn bodies(&self, group: usize) -> [brinell_contact::Body; 2] {
        let value = |name, without| self.group_value(group, name).unwrap_or(without);
        let of = |body: Body, [radius, youngs_modulus, poissons_ratio]: [f64; 3]| brinell_contact::Body {
            radius: value(body.radius(), radius),
            youngs_modulus: value(body.youngs_modulus(), youngs_modulus),
            poissons_ratio: value(body.poissons_ratio(), poissons_ratio),
        };
        [of(Body::Impactor, [f64::NAN, f64::INFINITY, 0.0]), of(Body::Target, [f64::INFINITY, f64::NAN, f64::NAN])]
    }

    /// The smaller radius of the bodies of `group` \[m\]: no contact is wider.
    pub fn smaller_radius(&self, group: usize) -> f64 {
        let balls = self.as_balls(group, self.bodies(group));
        let size = size_of(balls.map(|body| body.radius));
        let size = self.contacts[group].ellipse.as_ref().map_or(size, |elliptic| size.min(elliptic.size));
        self.line_size(group).map_or(size, |line| size.min(line))
    }

    /// The size of the smaller body of a line contact \[m\].
    pub fn line_size(&self, group: usize) -> Option<f64> {
        match self.model_of(group) {
            Model { loading: AnyLoading::Line(law), pair, .. } => Some(law.size(&pair)),
            _ => None,
        }
    }

    /// The size of the smaller body of `group` \[m\]: the same, or the radius of a rod, of which the FMU doesn't know.
    pub fn size(&self, group: usize) -> f64 {
        let size = self.smaller_radius(group);
        self.contacts[group].rod_radius().map_or(size, |radius| size.min(radius))
    }

    /// The result of `of` for each group. Ten thousand groups may have the same bodies. A result that follows only from the
    /// bodies, their mass and the laws of the scene is computed once for all of them.
    pub fn by_bodies<T: Clone>(&self, mut of: impl FnMut(usize) -> T) -> Vec<T> {
        let mut known: HashMap<_, T> = HashMap::new();
        let groups = 0..self.contacts.len();
        groups
            .map(|group| {
                let bodies = self.pair_of(group).map(|pair| {
                    let Pair { radius, modulus, yield_strength, youngs_modulus, poissons_ratio } = pair;
                    let restitution = self.group_value(group, "restitution").unwrap_or(f64::NAN);
                    // it follows from the density, which the pair doesn't know
                    let loss = self.loss_of(group).map_or(f64::NAN, |loss| loss.factor());
                    let TwoBodies { hardening_modulus, curvature, other } = self.two_bodies(group);
                    let softer = [yield_strength, youngs_modulus, poissons_ratio, hardening_modulus];
                    let harder = [other.yield_strength, other.modulus, other.poissons_ratio, other.hardening_modulus];
                    let rest = [radius, curvature, modulus, restitution, loss, self.impact_of(group).mass];
                    (softer.map(f64::to_bits), harder.map(f64::to_bits), rest.map(f64::to_bits))
                });
                known.entry(bodies).or_insert_with(|| of(group)).clone()
            })
            .collect()
    }

    /// The body of `group` that yields.
    pub fn softer(&self, group: usize) -> Body {
        let strength = |body: Body| self.group_value(group, body.yield_strength()).unwrap_or(f64::INFINITY);
        if strength(Body::Impactor) < strength(Body::Target) { Body::Impactor } else { Body::Target }
    }

    /// The strength of the harder body of `group` \[Pa\], if it is known.
    pub fn harder_strength(&self, group: usize) -> Option<f64> {
        match self.softer(group) {
            Body::Impactor => self.group_value(group, Body::Target.yield_strength()),
            Body::Target => self.contacts[group].impactor_strength,
        }
    }

    /// Impactor and target of `group` as its laws take them.
    pub(super) fn as_balls(&self, group: usize, bodies: [brinell_contact::Body; 2]) -> [brinell_contact::Body; 2] {
        let Some(Elliptic { ellipse, balls, .. }) = &self.contacts[group].ellipse else { return bodies };
        let [impactor, target] = bodies;
        [ellipse.ball(&impactor, balls.impactor), ellipse.ball(&target, balls.target)]
    }

    /// The same factor of the hardening moduli as of the others.
    pub(super) fn hardening_factor(&self, group: usize) -> f64 {
        self.contacts[group].ellipse.as_ref().map_or(1.0, |elliptic| elliptic.ellipse.stiffness)
    }

    /// The constant in place of the parameter `name` in the library, if the contacts of `group` are ellipses.
    pub fn constant_of_ball(&self, group: usize, name: &str) -> Option<f64> {
        self.contacts[group].ellipse.as_ref()?;
        let balls = self.as_balls(group, self.bodies(group));
        Body::ALL.iter().zip(balls).find_map(|(body, ball)| match name {
            name if name == body.radius() => Some(ball.radius),
            name if name == body.youngs_modulus() => Some(ball.youngs_modulus),
            name if name == body.poissons_ratio() => Some(ball.poissons_ratio),
            name if name == body.hardening_modulus() => {
                self.group_value(group, name).map(|modulus| modulus * self.hardening_factor(group))
            }
            _ => None,
        })
    }
}

/// The message about bodies of which `softer` is the softer one under a slow load, and not in the scene's impact.
pub fn exchanged(softer: Body) -> String {
    let (name, other) = (softer.name(), softer.other().name());
    format!(
        "under a slow load the {name} is the softer body, and in the scene's impact the {other}: give the strengths of the impact \
         (yield_strength) instead of a rate or a power law"
    )
}

/// A note on an impact of this `mass` \[kg\] whose target is a ball or a rod that may be free to move, unless the mass is the
/// effective one, or the target is so heavy that this is the impactor's own. The mass of a `[coupling]` is called effective
/// there.
pub fn held(scene: &Scene, mass: f64) -> Option<String> {
    let Group { density, impactor_density, rods, .. } = &scene.contacts[0];
    let volume = |rod: Option<Rod>, radius: f64| match rod {
        Some(rod) => rod.length * rod.area,
        None => 4.0 / 3.0 * PI * radius * radius * radius,
    };
    let [impactor, target] = scene.bodies(0);
    let volumes = [volume(rods.impactor, impactor.radius), volume(rods.target, target.radius)];
    // a half-space and a socket have no volume
    let is_ball = !scene.is_line() && scene.contacts[0].ellipse.is_none();
    if scene.coupling.is_some() || !is_ball || !(volumes[1] > 0.0 && volumes[1] < f64::INFINITY) {
        return None;
    }
    let known = impactor_density.or(*density);
    let densities = [*impactor_density, *density].map(|density| density.or(known).unwrap_or(1.0));
    let [own, other] = [0, 1].map(|body| densities[body] * volumes[body]);
    let (effective, part) = (own * other / (own + other), other / (own + other));
    if part > HEAVY || known.is_some_and(|_| mass * HEAVY < effective) {
        return None;
    }
    let instead = match known {
        Some(_) => format!("for solid bodies of this size and density {}", quantity(effective, "kg")),
        None => {
            format!("for solid bodies of this size and equal density {} times the impactor's mass", cell(part, 1.0))
        }
    };
    Some(format!(
        "The mass of {} is taken as the effective mass m1 m2/(m1 + m2) of both bodies: it is that of the impactor only if the \
         target is held. If the target is free to move, give the effective mass, {instead}.",
        quantity(mass, "kg")
    ))
}

/// Part of the impactor's mass in the effective mass from which on the target counts as held.
const HEAVY: f64 = 0.95;
