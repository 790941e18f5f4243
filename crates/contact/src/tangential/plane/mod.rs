//! Friction in two tangential directions. An approximation with a measured error.
//!
//! # Theory
//! As in [one direction](super), each spring touches at its height `h` and is relaxed at its stuck offset `o(h)`, which
//! is now a vector. Slip keeps `|sigma - o(h)| <= delta - h`: a circular cone. `o(h)` is kept as a polyline of vectors,
//! and with the slope `r` of each segment the force is `T = mu sum r [F(h_next) - F(h)]`.
//!
//! A spring moves exactly on a straight way: it sticks up to its limit, and then slips on a pursuit curve (see
//! `pursuit`). A spring that is inside the cone of the end point has not slipped on the way, because the cone is convex. The
//! vertices of the polyline move like this; between them it stays straight. Where springs turn, a part of a segment is halved
//! until it is short (`SPACING`) and almost straight (`BEND`). A vertex on a straight segment costs no accuracy, and
//! without it the many small turns of a slow rotation would never be noticed. A full list merges vertices that
//! matter least, and keeps the force.
//!
//! # Accuracy
//! Motion along one line has the result of one direction, to rounding. If the direction of slip turns, sixteen segments
//! differ from many independent springs, over random histories, by at most 1.1e-3 of `mu F` if a step is taken at once or in
//! eight parts, and by 2.9e-3 in 512 parts; over circles by 2.2e-3 and 5.4e-3. The root mean square is a fifth of this. With an
//! unbounded list the error is below 1e-3 and does not grow with the parts. Coulomb's bound holds to rounding, and friction
//! seems to do work of at most 2e-5 of the normal energy, from the integration of the test.
//!
//! # Limits
//! As in one direction. The directions lie still in the contact area, which does not spin.
//!
//! # References
//! - J. Jaeger, *Arch. Appl. Mech.* 63 (1993) 510-524; M. Ciavarella, *Int. J. Solids Struct.* 35 (1998) 2349-2362: the
//!   springs. The springs slip against their tension, as in Coulomb's law for a body on a moving plane.

mod cut;
mod growth;
mod list;
mod mean;
mod merge;
mod pursuit;
mod saved;
mod stuck;
mod vector;
mod vertex;
mod way;

pub use list::List;
pub use stuck::Stuck;
pub use vertex::Vertex;
pub use way::Way;

/// A distance smaller than this part of another one is zero.
const NEAR: f64 = 1e-12;

/// A part of a segment whose springs slip gets a vertex in its middle if the tangential force would else be off by about more
/// than this part of Coulomb's limit.
const BEND: f64 = 1e-4;

/// Such a part also gets one if its springs turn, and its length times the difference of its stiffnesses is more than this
/// part of the force. Springs are then close enough whenever they turn, in however small steps.
const SPACING: f64 = 1e-2;
