//! Bodies with two principal radii: the contact is an ellipse, and its law that of a [ball](brinell_contact::material::ellipse) with other numbers.

use super::file::FLAT;
use crate::body::{Body, Both};
use crate::numbers::{out_of_range, quantity, significant};
use brinell_contact::material::SMALLEST_RADIUS;
use brinell_contact::material::ellipse::{Ellipse, LARGEST_RATIO};
use std::ops::RangeInclusive;

/// Sizes of radii of curvature \[m\].
const RADII: RangeInclusive<f64> = SMALLEST_RADIUS..=1e9;

/// The contact of a group as an ellipse.
#[derive(Clone, Copy, Debug)]
pub struct Elliptic {
    /// Radii of the bodies along x and y \[m\].
    radii: Both<[f64; 2]>,
    pub ellipse: Ellipse,
    /// Whether the longer half-axis is along y.
    is_along_y: bool,
    /// Radii of the balls \[m\]. Each has the part of the gap's curvature that its body has.
    pub(super) balls: Both<f64>,
    /// The contact radius `sqrt(a b)` \[m\] at which a half-axis is as long as the smallest radius in its direction.
    pub size: f64,
}

impl Elliptic {
    /// The ellipse of bodies with these radii \[m\].
    ///
    /// # Errors
    /// Why there is none, in words.
    pub(super) fn of(radii: Both<[f64; 2]>) -> Result<Elliptic, String> {
        let axes = ["x", "y"];
        for (body, axis) in Body::ALL.iter().flat_map(|body| [(*body, 0), (*body, 1)]) {
            let radius = radii.of(body)[axis];
            if radius.abs() < f64::INFINITY && !RADII.contains(&radius.abs()) || radius.is_nan() {
                let size = out_of_range(radius, &RADII, "m");
                return Err(format!("{}.radius along {} {size}, or negative, or \"{FLAT}\"", body.name(), axes[axis]));
            }
        }
        let own = |body: Body| radii.of(body).map(|radius| 1.0 / radius);
        let [impactor, target] = Body::ALL.map(own);
        let curvatures = [impactor[0] + target[0], impactor[1] + target[1]];
        if let Some(axis) = (0..2).find(|axis| curvatures[*axis] < 0.0) {
            let bodies = Body::ALL.map(|body| in_words(radii.of(body)[axis]));
            let (axis, [one, other]) = (axes[axis], bodies);
            return Err(format!(
                "impactor and target with {one} and {other} along {axis} don't touch in one point: a hollow is wider than what is in it"
            ));
        }
        if impactor[0] + impactor[1] <= 0.0 {
            return Err("impactor.radius is that of a hollow: the impactor has to bulge; exchange the two".into());
        }
        let gap = curvatures.map(|curvature| 1.0 / curvature);
        let ellipse = Ellipse::of(gap).ok_or_else(|| {
            let ratio = significant(gap[0].max(gap[1]) / gap[0].min(gap[1]), 3);
            format!(
                "the radii of the gap along x and y are {ratio} times apart: allowed is {LARGEST_RATIO}; a longer contact is a line: \
                 impactor.shape = \"cylinder\""
            )
        })?;
        let is_along_y = gap[1] > gap[0];
        let (long, short) = if is_along_y { (1, 0) } else { (0, 1) };
        let smallest = |axis: usize| radii.impactor[axis].abs().min(radii.target[axis].abs());
        let root = ellipse.ratio.sqrt();
        let share = (impactor[0] + impactor[1]) / (curvatures[0] + curvatures[1]);
        Ok(Elliptic {
            radii,
            ellipse,
            is_along_y,
            balls: Both { impactor: ellipse.radius / share, target: ellipse.radius / (1.0 - share) },
            size: (smallest(long) / root).min(smallest(short).min(gap[short]) * root),
        })
    }

    /// The radii of a `body`.
    pub fn radii_of(&self, body: Body) -> String {
        let [x, y] = self.radii.of(body).map(in_words);
        format!("{x} along x and {y} along y")
    }

    /// The half-axes \[m\] along x and y of a contact with this contact radius \[m\].
    pub fn along_axes(&self, radius: f64) -> [f64; 2] {
        let [long, short] = self.ellipse.half_axes(radius);
        if self.is_along_y { [short, long] } else { [long, short] }
    }

    /// The same in words.
    pub fn half_axes(&self, radius: f64) -> String {
        let [x, y] = self.along_axes(radius).map(|axis| quantity(axis, "m"));
        format!("{x} along x, {y} along y")
    }

    /// The radius of a `body` along the shorter half-axis \[m\].
    pub fn across(&self, body: Body) -> f64 {
        self.radii.of(body)[usize::from(!self.is_along_y)]
    }

    /// What is known of the contact, whose yielding body has this Poisson's ratio, if one yields.
    pub fn words(&self, poissons_ratio: Option<f64>) -> String {
        let [long, short] = if self.is_along_y { ["y", "x"] } else { ["x", "y"] };
        let ratio = significant(self.ellipse.ratio, 3);
        let shape = format!(
            "Elliptic contact: its half-axis along {long} is {ratio} times that along {short}, and its contact radius is the root of their \
             product. The elastic part is Hertz's."
        );
        let Some(poissons_ratio) = poissons_ratio else { return shape };
        let [own, ball] = [self.ellipse, Ellipse::BALL].map(|of| significant(of.pressure_at_yield(poissons_ratio), 4));
        format!(
            "{shape} First yield is at a largest pressure of {own} times the strength, beside {ball} of a ball (von Mises), and as exact as \
             the law is for balls. The plastic part lies between those of a ball and of a line, and has not been compared with anything; the half-axes keep \
             their ratio, where those of a real dent grow rounder."
        )
    }
}

fn in_words(radius: f64) -> String {
    if radius.is_infinite() { FLAT.into() } else { quantity(radius, "m") }
}
