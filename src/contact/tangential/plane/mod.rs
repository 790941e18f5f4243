//! Friction in two tangential directions, on one elastic curve. An approximation with a measured error.
//!
//! # Theory
//! As in [one direction](super), each spring touches at its height `h` and is relaxed at its stuck offset `o(h)`, which
//! is now a vector. Slip keeps `|sigma - o(h)| <= delta - h`: a circular cone. `o(h)` is kept as a polyline of vectors,
//! and with the slope `r` of each segment the force is `T = mu sum r [F(h_next) - F(h)]`. The vertices stay in the cone,
//! and so does a straight line between them. `|T| <= mu F` follows.
//!
//! A spring that leaves the cone of the end point moves exactly: it sticks up to its limit, and then slips on a
//! pursuit curve (see `pursuit`). Vertices follow these paths, segments between them stay straight.
//! A segment of which a middle spring ends off the straight line by more than [`BEND`] of the indentation gets a vertex
//! there.
//!
//! # Accuracy
//! Motion along one line has the result of one direction, to 2e-9 of `mu F`. If the direction of slip turns, sixteen segments
//! differ from many independent springs by 0.01 of `mu F` over random histories, and by 0.022 if each step is divided
//! into 64 parts. A rotated history changes the force by up to 3e-3: the choice of new vertices is discrete.
//!
//! # Limits
//! The dent must not grow: the curve of the normal force stays the same. Otherwise as in one direction.
//!
//! # References
//! - J. Jaeger, *Arch. Appl. Mech.* 63 (1993) 510-524; M. Ciavarella, *Int. J. Solids Struct.* 35 (1998) 2349-2362: the
//!   springs. The springs slip against their tension, as in Coulomb's law for a body on a moving plane.

mod cut;
mod list;
mod merge;
mod pursuit;
mod saved;
mod stuck;
mod vector;
mod way;

pub use list::{List, Vertex};
pub use stuck::Stuck;
pub use way::Way;

/// A distance smaller than this part of the indentation is zero.
const NEAR: f64 = 1e-15;

/// A segment gets a vertex in its middle if the springs there end off the straight line by more than this part of the
/// indentation.
///
/// Between 1.4e-3 and 1.5e-3 the lists have the lengths of the reference table.
pub const BEND: f64 = 1.5e-3;
