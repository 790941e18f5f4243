//! The bodies of each contact, and values that follow from them alone.

use super::{Scene, softer};
use brinell_contact::losses::Loss;
use brinell_contact::{Body, Pair};
use std::collections::HashMap;

impl Scene {
    /// The bodies of the contacts of `group`; `None` if they do not fit.
    pub(super) fn pair_of(&self, group: usize) -> Option<Pair> {
        self.pair_with(group, &[])
    }

    /// The same bodies with other values for some of their parameters.
    pub fn pair_with(&self, group: usize, values: &[(&str, f64)]) -> Option<Pair> {
        let [impactor, target] = self.bodies_with(group, values);
        let softer = self.softer_with(group, values);
        let other = values.iter().find(|(known, _)| *known == softer.yield_strength()).map(|(_, value)| *value);
        let own = || self.group_value(group, softer.yield_strength()).map(|strength| strength * self.factors[group]);
        let strength = other.or_else(own).unwrap_or(f64::INFINITY);
        let pair = Pair::new(&impactor, &target, strength)?;
        Some(if softer == softer::Body::Impactor { pair.yielding_in(&impactor, strength) } else { pair })
    }

    /// Impactor and target of `group`, with other values for some of their parameters.
    pub fn bodies_with(&self, group: usize, values: &[(&str, f64)]) -> [Body; 2] {
        let value = |name| {
            let other = values.iter().find(|(known, _)| *known == name).map(|(_, value)| *value);
            other.or_else(|| self.group_value(group, name))
        };
        let impactor = Body {
            radius: value("impactor.radius").unwrap_or(f64::NAN),
            youngs_modulus: value("impactor.youngs_modulus").unwrap_or(f64::INFINITY),
            poissons_ratio: value("impactor.poissons_ratio").unwrap_or(0.0),
        };
        let target = Body {
            radius: value("target.radius").unwrap_or(f64::INFINITY),
            youngs_modulus: value("target.youngs_modulus").unwrap_or(f64::NAN),
            poissons_ratio: value("target.poissons_ratio").unwrap_or(f64::NAN),
        };
        [impactor, target]
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
                    let loss = self.loss_with(group, &[]).map_or(f64::NAN, |loss| loss.factor());
                    let [mass, hardening] = [self.impact_of(group).mass, self.hardening_modulus(group)];
                    let pair = [radius, modulus, yield_strength, youngs_modulus, poissons_ratio];
                    (pair.map(f64::to_bits), [hardening, restitution, loss, mass].map(f64::to_bits))
                });
                known.entry(bodies).or_insert_with(|| of(group)).clone()
            })
            .collect()
    }
}
