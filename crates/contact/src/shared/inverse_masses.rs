//! The matrix of inverse effective masses: how a force at one contact accelerates the others.

use crate::numerics::largest;
use core::iter;
use libm::fabs;

/// The smallest pivot, relative to the largest, that rounding of a singular matrix can leave; with a negative sign.
const ROUNDING: f64 = 1e-12;

/// The matrix `W = J M^-1 J^T` \[1/kg\] of some contacts: a force `F` at contact `j` changes the closing rate of contact `i`
/// by `-W_ij F` \[m/s^2\]. It is symmetric and positive semidefinite; with more contacts than the bodies have freedom it is
/// singular.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InverseMasses<'a> {
    count: usize,
    /// The upper triangle, row by row.
    entries: &'a [f64],
}

/// The reason why numbers are no inverse masses of bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NotInverseMasses {
    /// The number of entries is not `n (n + 1)/2`.
    Count {
        /// The number of entries that is needed.
        needed: usize,
        /// The number that was given.
        given: usize,
    },
    /// An entry is not a finite number, or on the diagonal not positive.
    Entry {
        /// Its row, from 0 on.
        row: usize,
        /// Its column.
        column: usize,
        /// The entry \[1/kg\].
        value: f64,
    },
    /// With the contacts before it in the elimination, this contact would have a negative inverse mass: the matrix is not
    /// positive semidefinite.
    Indefinite {
        /// The contact, from 0 on.
        contact: usize,
        /// The contact to which it is coupled most strongly for the inverse masses of the two.
        with: usize,
        /// The pivot \[1/kg\].
        pivot: f64,
    },
}

/// Number of entries of the upper triangle for `count` contacts.
pub const fn entries(count: usize) -> usize {
    count * (count + 1) / 2
}

impl<'a> InverseMasses<'a> {
    /// That of no contact.
    pub const NONE: InverseMasses<'a> = InverseMasses { count: 0, entries: &[] };

    /// That of one contact; zero for bodies that close at a given rate, whatever the force.
    pub(crate) fn single(entry: &'a [f64; 1]) -> InverseMasses<'a> {
        InverseMasses { count: 1, entries: entry }
    }

    /// The matrix of `count` contacts from its upper triangle, row by row \[1/kg\].
    ///
    /// # Errors
    /// [`NotInverseMasses::Count`] for another number of entries.
    pub fn new(count: usize, upper: &'a [f64]) -> Result<InverseMasses<'a>, NotInverseMasses> {
        let needed = entries(count);
        let given = upper.len();
        if needed == given {
            Ok(InverseMasses { count, entries: upper })
        } else {
            Err(NotInverseMasses::Count { needed, given })
        }
    }

    /// Number of contacts.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The rows from `first` on, each from its diagonal on.
    #[inline]
    pub fn rows(&self, first: usize) -> impl Iterator<Item = &'a [f64]> + use<'a> {
        let before = entries(self.count) - entries(self.count.saturating_sub(first));
        let mut rest = self.entries.get(before..).unwrap_or_default();
        let mut length = self.count.saturating_sub(first);
        iter::from_fn(move || {
            let (row, others) = rest.split_at_checked(length)?;
            length = length.checked_sub(1)?;
            rest = others;
            Some(row)
        })
    }

    /// Row and column of the entry with this `place` in the upper triangle; those after the last one outside the matrix.
    pub fn row_and_column(&self, place: usize) -> (usize, usize) {
        let mut left = place;
        for (row, entries) in self.rows(0).enumerate() {
            if left < entries.len() {
                return (row, row + left);
            }
            left -= entries.len();
        }
        (self.count, self.count)
    }

    /// The entry of two contacts \[1/kg\]; zero outside the matrix.
    pub fn of(&self, one: usize, other: usize) -> f64 {
        let (row, column) = if one < other { (one, other) } else { (other, one) };
        let found = self.rows(row).next().and_then(|row_from_diagonal| row_from_diagonal.get(column - row));
        found.copied().unwrap_or(0.0)
    }

    /// Whether the numbers can be inverse masses: finite, positive on the diagonal, and positive semidefinite to rounding.
    /// `scratch` needs as many numbers as the upper triangle.
    ///
    /// The matrix is decomposed as `L D L^T` with the largest pivot first. A pivot below zero by more than rounding, 1e-12
    /// of the largest, is refused.
    ///
    /// # Errors
    /// [`NotInverseMasses`].
    pub fn check(&self, scratch: &mut [f64]) -> Result<(), NotInverseMasses> {
        for (row, entries) in self.rows(0).enumerate() {
            for (offset, &value) in entries.iter().enumerate() {
                let is_one = value.is_finite() && (offset > 0 || value > 0.0);
                if !is_one {
                    return Err(NotInverseMasses::Entry { row, column: row + offset, value });
                }
            }
        }
        let given = scratch.len();
        let needed = self.entries.len();
        let Some(left) = scratch.get_mut(..needed) else { return Err(NotInverseMasses::Count { needed, given }) };
        left.iter_mut().zip(self.entries).for_each(|(left, entry)| *left = *entry);
        let mut left = Left { count: self.count, entries: left };
        let size = (0..self.count).fold(0.0, |size, contact| largest(self.of(contact, contact), size));
        for _ in 0..self.count {
            let Some((contact, pivot)) = left.largest_pivot() else { break };
            if pivot <= ROUNDING * size {
                // nothing but rounding may be left
                return left.is_nothing(ROUNDING * size).map_err(|(contact, pivot)| NotInverseMasses::Indefinite {
                    contact,
                    with: self.strongest(contact),
                    pivot,
                });
            }
            left.eliminate(contact, pivot);
        }
        Ok(())
    }

    /// The contact to which `contact` is coupled most strongly for the inverse masses of the two.
    fn strongest(&self, contact: usize) -> usize {
        let strength = |other: &usize| {
            let entry = self.of(contact, *other);
            entry / self.of(contact, contact) * (entry / self.of(*other, *other))
        };
        let others = (0..self.count).filter(|&other| other != contact);
        let strongest = others.fold(None, |best: Option<(usize, f64)>, other| {
            let strength = strength(&other);
            if best.is_none_or(|(_, most)| strength > most) { Some((other, strength)) } else { best }
        });
        strongest.map_or(contact, |(other, _)| other)
    }
}

/// What an elimination has left of a matrix. The pivot of a contact that is done is zero, and so are its other entries.
struct Left<'a> {
    count: usize,
    entries: &'a mut [f64],
}

impl Left<'_> {
    fn place(&self, one: usize, other: usize) -> usize {
        let (row, column) = if one < other { (one, other) } else { (other, one) };
        entries(self.count) - entries(self.count.saturating_sub(row)) + (column - row)
    }

    fn of(&self, one: usize, other: usize) -> f64 {
        self.entries.get(self.place(one, other)).copied().unwrap_or(0.0)
    }

    fn set(&mut self, one: usize, other: usize, value: f64) {
        let place = self.place(one, other);
        if let Some(entry) = self.entries.get_mut(place) {
            *entry = value;
        }
    }

    fn largest_pivot(&self) -> Option<(usize, f64)> {
        (0..self.count)
            .map(|contact| (contact, self.of(contact, contact)))
            .reduce(|best, next| if next.1 > best.1 { next } else { best })
    }

    /// Takes `contact` out of the matrix.
    fn eliminate(&mut self, contact: usize, pivot: f64) {
        for one in (0..self.count).filter(|&one| one != contact) {
            let part = self.of(contact, one) / pivot;
            for other in (one..self.count).filter(|&other| other != contact) {
                let change = part * self.of(contact, other);
                self.set(one, other, self.of(one, other) - change);
            }
        }
        for other in 0..self.count {
            self.set(contact, other, 0.0);
        }
    }

    /// `Err` with a contact and its pivot if an entry is larger than `rounding`. A coupling without inverse masses makes a
    /// negative pivot of its own size.
    fn is_nothing(&self, rounding: f64) -> Result<(), (usize, f64)> {
        for one in 0..self.count {
            for other in one..self.count {
                let entry = self.of(one, other);
                if fabs(entry) > rounding {
                    return Err((one, -fabs(entry)));
                }
            }
        }
        Ok(())
    }
}
