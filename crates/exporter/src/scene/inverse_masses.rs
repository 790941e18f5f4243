//! The matrix of inverse effective masses: how a force at one contact accelerates the others, through the bodies that they share.

/// The matrix `W` \[1/kg\] of contacts that share bodies. With the forces `F` and the accelerations `a` by all that the unit
/// doesn't know, the closing rates follow `dv/dt = a - W F`. It is symmetric and positive semidefinite, and singular for redundant
/// contacts such as four feet on a plane.
#[derive(Clone, Debug, PartialEq)]
pub enum InverseMasses {
    /// From the bodies of the scene: the upper triangle, row by row, of `n (n + 1)/2` numbers; see [`place`]. Every entry on the
    /// diagonal is positive. With friction, beside them the two bodies of the first contact.
    Constant { entries: Vec<f64>, meeting: Option<[Meeting; 2]> },
    /// The entries of the same triangle are inputs of the unit.
    Inputs,
}

impl InverseMasses {
    /// The mass that the force of this `row` of `count` accelerates by itself, `1/W_ii` \[kg\]; `None` if the entries are inputs.
    /// The rows of the normals are the first ones, in the order of the contacts.
    pub fn effective_mass(&self, row: usize, count: usize) -> Option<f64> {
        match self {
            InverseMasses::Constant { entries, .. } => Some(1.0 / entries[place(count, row, row)]),
            InverseMasses::Inputs => None,
        }
    }
}

/// A body of the first contact, in an impact on it.
#[derive(Clone, Debug, PartialEq)]
pub struct Meeting {
    /// Its name.
    pub name: String,
    /// \[kg\]; infinite for the ground.
    pub mass: f64,
    /// How the force along the normal, and that along the first tangent, turn it about the axis across both: the change of the spin
    /// \[rad/s\] by an impulse \[N.s\].
    pub turns: [f64; 2],
    /// How a spin about that axis moves its contact point along the normal, and along the tangent \[m\].
    pub arms: [f64; 2],
}

/// The place of the entry of two rows, counted from 0, in the upper triangle of a matrix of `count` rows: those of the normals, in
/// the order of the contacts, then those of the tangents in each direction.
pub fn place(count: usize, one: usize, other: usize) -> usize {
    let (row, column) = (one.min(other), one.max(other));
    debug_assert!(column < count, "there are {count} rows");
    // above it are the rows of count, count - 1, ... entries
    row * (2 * count - row + 1) / 2 + (column - row)
}

/// A vector in the directions x, y, z of the scene.
pub(super) type Vector = [f64; 3];

/// The tensor of inertia of a body about its centre of mass as `L D L^T`, with ones on the diagonal of the lower triangle `L`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Inertia {
    /// The diagonal of `D` \[kg m^2\].
    pivots: Vector,
    /// The elements yx, zx and zy of `L`.
    lower: Vector,
}

impl Inertia {
    /// The inertia with the elements xx, yy, zz, xy, xz, yz of its tensor \[kg m^2\]; `None` unless that is positive definite,
    /// and by more than the rounding of its elements.
    pub(super) fn of([xx, yy, zz, xy, xz, yz]: [f64; 6]) -> Option<Inertia> {
        let (yx, zx) = (xy / xx, xz / xx);
        let second = yy - yx * xy;
        let rest = yz - zx * xy;
        let zy = rest / second;
        let pivots = [xx, second, zz - zx * xz - zy * rest];
        let definite = pivots.iter().zip([xx, yy, zz]).all(|(pivot, element)| *pivot > ROUNDING * element.abs());
        definite.then_some(Inertia { pivots, lower: [yx, zx, zy] })
    }

    /// The part along a unit vector `axis` of the spin that a `moment` gives the body \[1/(kg.m^2)\].
    pub(super) fn turn(&self, axis: Vector, moment: Vector) -> f64 {
        let [one, other] = [axis, moment].map(|vector| self.solved(vector));
        (0..3).fold(0.0, |sum, k| sum + one[k] * other[k] / self.pivots[k])
    }

    /// `L^-1` times a vector.
    fn solved(&self, [x, y, z]: Vector) -> Vector {
        let [yx, zx, zy] = self.lower;
        let y = y - yx * x;
        [x, y, z - zx * x - zy * y]
    }
}

/// Part of an element that is rounding: what is smaller after a subtraction is taken for zero.
const ROUNDING: f64 = 1e-12;

/// A body that is free to move.
#[derive(Clone, Copy, Debug)]
pub(super) struct FreeBody {
    /// Its mass \[kg\].
    pub mass: f64,
    pub inertia: Option<Inertia>,
}

/// One of the two ends of a contact: the columns of a free body in the contact's row of the Jacobian.
#[derive(Clone, Copy, Debug)]
pub(super) struct End {
    /// The index of its body.
    body: usize,
    /// The direction in which the closing rate counts the body's velocity.
    direction: Vector,
    /// `L^-1 (r x direction)` \[m\]: how the closing rate counts its rotation.
    turn: Vector,
}

impl End {
    /// The end at the body with this index. The closing rate counts its velocity along the unit vector `direction` at `arm` \[m\]
    /// from its centre of mass; an arm along the direction doesn't turn the body. `None` if it does, and the body has no inertia.
    pub(super) fn of(bodies: &[FreeBody], body: usize, direction: Vector, arm: Vector) -> Option<End> {
        let moment = cross(arm, direction);
        if dot(moment, moment) <= PARALLEL * PARALLEL * dot(arm, arm) {
            return Some(End { body, direction, turn: [0.0; 3] });
        }
        Some(End { body, direction, turn: bodies[body].inertia?.solved(moment) })
    }
}

/// Sine of the angle up to which two directions are parallel. It changes an effective mass by the square of that.
const PARALLEL: f64 = 1e-9;

pub(super) fn dot(one: Vector, other: Vector) -> f64 {
    one[0] * other[0] + one[1] * other[1] + one[2] * other[2]
}

/// The vector across two others.
pub(super) fn cross([ax, ay, az]: Vector, [bx, by, bz]: Vector) -> Vector {
    [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx]
}

/// The direction of a vector, whose size may be any; `None` if it has no direction.
pub(super) fn direction(vector: Vector) -> Option<Vector> {
    let size = vector.iter().fold(0.0, |size: f64, part| size.max(part.abs()));
    if !(size > 0.0 && vector.iter().all(|part| part.is_finite())) {
        return None;
    }
    // the squares of the scaled parts neither overflow nor vanish
    let scaled = vector.map(|part| part / size);
    let length = dot(scaled, scaled).sqrt();
    Some(scaled.map(|part| part / length))
}

/// The part of the unit vector `tangent` across the unit vector `normal`, as a unit vector; `None` unless they are at right angles
/// within 1e-6.
pub(super) fn across(normal: Vector, tangent: Vector) -> Option<Vector> {
    let along = dot(normal, tangent);
    if along.abs() > SQUARE {
        return None;
    }
    direction([0, 1, 2].map(|k| tangent[k] - along * normal[k]))
}

/// Cosine of the angle up to which two directions are at right angles.
const SQUARE: f64 = 1e-6;

/// The upper triangle, row by row, of `W = J M^-1 J^T` for contacts with these ends: the sum over the ends that two contacts have
/// at the same body of `n.n'/m + (r x n).I^-1 (r' x n')`. Contacts without a common body have an exact zero.
pub(super) fn triangle(bodies: &[FreeBody], contacts: &[Vec<End>]) -> Vec<f64> {
    let response = |one: &End, other: &End| {
        let FreeBody { mass, inertia } = bodies[one.body];
        let shift = dot(one.direction, other.direction) / mass;
        let turn = |Inertia { pivots, .. }| (0..3).fold(0.0, |sum, k| sum + one.turn[k] * other.turn[k] / pivots[k]);
        shift + inertia.map_or(0.0, turn)
    };
    let entry = |row: &Vec<End>, column: &Vec<End>| {
        let pairs = row.iter().flat_map(|one| column.iter().map(move |other| (one, other)));
        let shared = pairs.filter(|(one, other)| one.body == other.body);
        shared.fold(0.0, |sum, (one, other)| sum + response(one, other))
    };
    let rows = contacts.iter().enumerate();
    rows.flat_map(|(index, row)| contacts[index..].iter().map(move |column| entry(row, column))).collect()
}
