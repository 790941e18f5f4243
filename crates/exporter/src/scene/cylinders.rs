//! Cylinders: contacts along a line, and the sizes of their bodies, on which the depth depends.

use super::checked::{Scene, SceneLaws};
use super::contacts::Contacts;
use super::file::{BaseName, BodyTable, SceneFile};
use super::fmu;
use crate::body::{Body, Both};
use crate::mistake::{Mistake, Spanned};
use crate::numbers::{quantity, significant};
use crate::pairing::LINE;
use brinell_contact::loading::{AnyLoading, Line, line::ROLLER};
use brinell_contact::unloading::{self, AnyUnloading};
use std::f64::consts::PI;
use std::ops::Range;

/// The sideways tension of a solid roller, `c` of `c F'/(pi R)`.
const ROLLER_TENSION: f64 = 1.0;

/// `k` and `c` of a plate on a smooth rigid base: compression `F'/(pi E*) (2 ln(2t/a) + k)`, tension `c F'/(pi t)` under the contact. Exact
/// integrals of an elastic layer; they do not depend on Poisson's ratio.
const SMOOTH: [f64; 2] = [0.29665, 1.53715];

/// The same of a plate bonded to a rigid base, over Poisson's ratio less 0.3: within 0.003 of the integrals for ratios from 0 to 0.5.
const BONDED: [[f64; 5]; 2] =
    [[-0.05256, -2.24200, -7.04025, -16.61958, -22.27661], [1.29976, -0.54232, 1.03687, 4.00917, 6.26566]];

/// The least `C` at first yield: the half-width is then a quarter of half the reach.
const LEAST: f64 = 2.8;

/// What a scene says of its cylinders.
pub struct Cylinders<'a> {
    bodies: Both<&'a BodyTable>,
    constant: Option<&'a Spanned<f64>>,
    span: Range<usize>,
}

/// Reach and sideways tension of a body \[m, 1/m\], and what it is in words.
struct Size {
    reach: f64,
    tension: f64,
    words: String,
}

impl<'a> Cylinders<'a> {
    /// The cylinders of the scene `file`; `None` for balls.
    pub fn of(file: &'a SceneFile, none: &'a BodyTable, contacts: &Contacts) -> Result<Option<Cylinders<'a>>, Mistake> {
        let impactor = file.impactor.as_ref().map_or(none, |impactor| &impactor.get_ref().0);
        let target = file.target.as_ref().map_or(none, Spanned::get_ref);
        let Some(shape) = impactor.shape.as_ref().filter(|_| file.is_line()) else { return Ok(None) };
        if !contacts.any_yields() {
            let message = "a cylinder needs the yield strength of a body: target.yield_strength, or a material";
            return Err(Mistake(shape.span(), message.into()));
        }
        let (bodies, constant) = (Both { impactor, target }, file.law.size_constant.as_ref());
        Ok(Some(Cylinders { bodies, constant, span: shape.span() }))
    }

    /// The size of a plate.
    fn plate(&self, thickness: f64, poissons_ratio: f64) -> Size {
        let base = self.bodies.target.base.as_ref().map_or(BaseName::Smooth, |base| *base.get_ref());
        let bonded = || {
            let of = |list: [f64; 5]| list.iter().rev().fold(0.0, |sum, factor| sum * (poissons_ratio - 0.3) + factor);
            BONDED.map(of)
        };
        let ([k, c], on) = match base {
            BaseName::Smooth => (SMOOTH, "on a smooth rigid base"),
            BaseName::Bonded => (bonded(), "bonded to a rigid base"),
        };
        let reach = 2.0 * thickness * libm::exp(0.5 * k);
        Size { reach, tension: c / thickness, words: format!("a plate of {} {on}", quantity(thickness, "m")) }
    }

    fn roller(radius: f64) -> Size {
        let words = format!("a solid roller of {} radius", quantity(radius, "m"));
        Size { reach: ROLLER * radius, tension: ROLLER_TENSION / radius, words }
    }

    /// The sizes of impactor and target of a group; that of a rigid impactor has no effect.
    fn sizes(&self, scene: &Scene, group: usize) -> Result<[Size; 2], Mistake> {
        let [impactor, target] = scene.bodies(group);
        let own = match impactor.youngs_modulus < f64::INFINITY {
            true => Cylinders::roller(impactor.radius),
            false => Size { reach: impactor.radius, tension: 0.0, words: "a rigid cylinder".into() },
        };
        let other = match &self.bodies.target.thickness {
            Some(thickness) => self.plate(*thickness.get_ref(), target.poissons_ratio),
            None if target.radius > 0.0 && target.radius < f64::INFINITY => Cylinders::roller(target.radius),
            None => {
                let what = if target.radius < 0.0 { "the wall around the bore" } else { "the plate" };
                let message = format!(
                    "target.thickness is missing: the elastic depth of a line contact grows with the logarithm of the size of the bodies. \
                     Give the thickness of {what}, or C itself, law.size_constant"
                );
                return Err(Mistake(self.span.clone(), message));
            }
        };
        Ok([own, other])
    }

    /// The law of a group, with the sizes in words.
    fn law(&self, scene: &Scene, group: usize) -> Result<(Line, String), Mistake> {
        let pair = scene.pair_of(group).expect("bodies that fit");
        let radius = pair.radius;
        let length = scene.contacts[group].line_length.expect("a cylinder has a length") / radius;
        let (bodies, is_impactor) = (scene.two_bodies(group), scene.softer(group) == Body::Impactor);
        if let Some(constant) = self.constant {
            let constant = *constant.get_ref();
            let line = Line::of_constant(length, constant, &pair, bodies, is_impactor);
            return Ok((line, format!("C = {}, as the scene gives it", significant(constant, 4))));
        }
        let [own, other] = self.sizes(scene, group)?;
        let of = |size: &Size| [size.reach / radius, size.tension * radius];
        let line = Line::new(length, of(&own), of(&other));
        let constant = line.along(bodies, is_impactor).constant(&pair);
        if constant < LEAST {
            let message = format!(
                "C = {} of {} on {}: at first yield the contact is about as wide as the bodies are thick, where no law holds",
                significant(constant, 3),
                own.words,
                other.words
            );
            return Err(Mistake(self.span.clone(), message));
        }
        Ok((line, format!("C = {} at first yield, from {} on {}", significant(constant, 4), own.words, other.words)))
    }

    /// Puts the sizes into the laws of the `scene`. What they follow from is then a constant of the FMU.
    pub fn settle(&self, scene: &mut Scene, file: &SceneFile, contacts: &Contacts) -> Result<(), Mistake> {
        let of_contact = |group: usize| move |Mistake(span, message)| Mistake(span, contacts.said(group, &message));
        let (line, words) = self.law(scene, 0).map_err(of_contact(0))?;
        for group in 1..scene.contacts.len() {
            let (other, _) = self.law(scene, group).map_err(of_contact(group))?;
            if !is_alike(&line, &other) {
                let message = "its cylinder is no copy of that of the first contact: radius, length and sizes of both bodies are those of \
                               the law, which all contacts have; export a unit for each";
                return Err(of_contact(group)(Mistake(self.span.clone(), message.into())));
            }
        }
        let fixed = Body::ALL.map(|body| [body.radius(), body.poissons_ratio()]);
        let is_fixed =
            |name: &str| fixed.iter().flatten().any(|fixed| name == *fixed || name.ends_with(&format!(".{fixed}")));
        fmu::fix(scene, file, &self.span, is_fixed, "a cylinder: the constant C of its depth follows from it")?;
        if let SceneLaws::Plastic { loading, unloading, .. } = &mut scene.laws {
            loading.1 = AnyLoading::Line(line);
            *unloading = (LINE, AnyUnloading::Line(unloading::line::Line { length: line.length }));
        }
        scene.law_words = Some(words);
        Ok(())
    }
}

/// Whether two laws are the same but for rounding.
fn is_alike(one: &Line, other: &Line) -> bool {
    let numbers =
        |line: &Line| [line.length, line.impactor_reach, line.impactor_tension, line.target_reach, line.target_tension];
    numbers(one).iter().zip(numbers(other)).all(|(one, other)| (one - other).abs() <= 1e-12 * one.abs())
}

/// Mass of a solid cylinder \[kg\] of this density \[kg/m^3\], radius and length \[m\].
pub fn mass(density: f64, radius: f64, length: f64) -> f64 {
    density * PI * radius * radius * length
}
