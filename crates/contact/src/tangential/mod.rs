//! Friction: the tangential force of a contact, for any history of normal and tangential motion.
//!
//! # Theory
//! According to Cattaneo, Mindlin, Jaeger and Ciavarella, a contact with partial slip is equivalent to many
//! independent springs. Each spring touches at its own indentation, its *height* `h`. Its tangential force is at most
//! the coefficient of friction times its normal force. Lengths are scaled by `kappa = 4 G*/(mu E*)`,
//! `sigma = kappa s`. A spring of height `h` is relaxed at its *stuck offset* `o(h)`. Slip keeps
//! `|sigma - o(h)| <= delta - h`: the point `(sigma, delta)` stays in the upward cone of 45 degrees with its apex at
//! `(o(h), h)`.
//!
//! If the rates are held over each step, `o(h)` is a polyline. Its slope is `r = +-1` where springs have slipped, and
//! between these values where the contact has grown without slip. With the normal force `F(h)`, the tangential force
//! is `T = mu sum r [F(h_next) - F(h)]` over the segments. The stored energy is
//! `E = (mu/kappa) sum r { [w F] + r [int F dh] }` with `w = sigma - o`. `|T| <= mu F` follows from `|r| <= 1`.
//!
//! On one elastic curve `F` the result is exact for any history in one direction and any division into steps, as long as the
//! [`List`] of segments is not full.
//!
//! # One direction and two
//! The number `D` of directions is a constant of one source. Displacements, offsets and slopes are vectors, and the cone is
//! `|sigma - o(h)| <= delta - h`. A spring moves exactly on a straight way: it sticks up to its limit, and then slips on a pursuit
//! curve (see `pursuit`). A spring that is inside the cone of the end point has not slipped on the way, because the cone is
//! convex. The vertices of the polyline move like this; between them it stays straight (see `cut`). Where springs turn, a part of
//! a segment is halved until it is short and almost straight. A vertex on a straight segment costs no accuracy, and without it
//! the many small turns of a slow rotation would never be noticed. A full list merges vertices that matter least, and keeps the
//! force.
//!
//! Along a line nothing turns. As long as no segment is steeper than the cones, springs slip from the edge inwards only, and the
//! polyline, the mean force and the rates of the force have a closed form (see `edge`).
//!
//! # Accuracy in two directions
//! Motion along one line has the result of one direction, to rounding. If the direction of slip turns, sixteen segments
//! differ from many independent springs, over random histories, by at most 1.1e-3 of `mu F` if a step is taken at once or in
//! eight parts, and by 2.9e-3 in 512 parts; over circles by 2.2e-3 and 5.4e-3. The root mean square is a fifth of this. With an
//! unbounded list the error is below 1e-3 and does not grow with the parts. Coulomb's bound holds to rounding, and friction
//! seems to do work of at most 2e-5 of the normal energy, from the integration of the test.
//!
//! # Limits
//! Quasi-static. No coupling of normal and tangential displacements: exact for equal bodies, an approximation
//! otherwise. One coefficient of friction. A circular contact area whose springs belong to the area: steady rolling
//! has no creep. The directions lie still in the area, which does not spin. The normal force does not depend on the tangential
//! force.
//!
//! # References
//! - R. D. Mindlin, H. Deresiewicz, *J. Appl. Mech.* 20 (1953) 327-344.
//! - J. Jaeger, *Arch. Appl. Mech.* 63 (1993) 510-524; M. Ciavarella, *Int. J. Solids Struct.* 35 (1998) 2349-2362: the
//!   springs. They slip against their tension, as in Coulomb's law for a body on a moving plane.
//! - V. L. Popov, M. Hess, *Facta Univ. Mech. Eng.* 12 (2014) 1-18.
//! - M. A. Krasnosel'skii, A. V. Pokrovskii, *Systems with Hysteresis*, 1989: the play operator.

mod behaviour;
mod contact;
mod cut;
mod edge;
mod frictional;
mod growth;
mod growth_steps;
pub mod impact;
mod list;
mod mean;
mod merge;
mod motion;
mod normal;
mod outputs;
mod parts;
mod play_operator;
mod pursuit;
mod rates;
mod saved;
mod shared;
mod trial;
mod vector;
mod vertex;

pub use contact::{Frictional, FrictionalContact, PlaneContact};
pub use frictional::{FrictionalModel, Mean, PlaneSprings, Springs, SpringsOf};
pub use list::List;
pub use motion::Motion;
pub use normal::Normal;
pub use outputs::{Quantity, Sliding};
pub use play_operator::PlayOperator;
pub use vertex::Vertex;

use super::material::Body;
use crate::numerics::{largest, quotient};

/// Slopes whose difference is smaller are equal. Distances smaller than this part of the indentation are zero.
/// Otherwise rounding would leave an extra vertex at each reversal of a vibration.
const SAME: f64 = 1e-13;

/// A way shorter than this part of the indentation takes no place in a full list of segments, which would have to forget more than
/// the way changes.
const TINY: f64 = 1e-10;

/// The smallest coefficient of friction that determines the [scale](Friction::scale) of the displacements.
const SMALLEST: f64 = 1e-100;

/// The friction parameters of a pair of bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Friction {
    /// Coefficient of friction `mu` >= 0.
    pub coefficient: f64,
    /// Ratio of the tangential to the normal stiffness, `4 G*/E*`.
    pub stiffness_ratio: f64,
}

impl Friction {
    /// Friction between two bodies with a contact of effective modulus `modulus` = `E*` \[Pa\].
    ///
    /// `1/G* = (2 - nu1)/G1 + (2 - nu2)/G2` with `G = E/(2 (1 + nu))`; a rigid body contributes nothing. For one
    /// material, also against a rigid body, `4 G*/E* = 2 (1 - nu)/(2 - nu)`.
    ///
    /// Reference: R. D. Mindlin, *J. Appl. Mech.* 16 (1949) 259-268.
    pub fn between(impactor: &Body, target: &Body, modulus: f64, coefficient: f64) -> Friction {
        let compliance =
            |body: &Body| 2.0 * (1.0 + body.poissons_ratio) * (2.0 - body.poissons_ratio) / body.youngs_modulus;
        Friction { coefficient, stiffness_ratio: 4.0 / ((compliance(impactor) + compliance(target)) * modulus) }
    }

    /// Scale of the tangential displacements: `kappa = 4 G*/(mu E*)`.
    ///
    /// It is that of a coefficient of 1e-100 for all smaller ones. Their tangential force is below 1e-100 of the normal
    /// force; without friction it is zero.
    pub fn scale(&self) -> f64 {
        let coefficient = largest(self.coefficient, SMALLEST);
        quotient(self.stiffness_ratio, coefficient, coefficient > 0.0, 0.0)
    }
}
