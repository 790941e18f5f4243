//! The branch that one contact is on: apart, on the path of its dent, or on a piece of the loading curve. Each is smooth,
//! and goes on beyond its ends for the trials of the integration.

use crate::history::History;
use crate::history::piece::{Numbers, Piece};
use crate::loading::Loading;
use crate::loading::hertz::EXPONENT as HERTZ;
use crate::numerics::{largest, smallest};
use crate::segment::Segment;
use crate::unloading::Unloading;
use crate::{Model, Surface};
use core::hint::black_box;
use libm::{fabs, sqrt};

/// A height \[m\] that counts as none. In a row of balls that touch, the far ones are pressed by numbers so small that a
/// processor takes long for them.
const LEAST_HEIGHT: f64 = 1e-100;

/// The part of its length for which a segment of a chain goes on beyond its joint.
const BEYOND_JOINT: f64 = 0.1;

/// The kind of a branch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// No force.
    Apart,
    /// The path between the surface and the largest indentation, in both directions; without yield, the elastic curve.
    Path,
    /// A piece of the loading curve beyond yield.
    Loading,
}

/// An event of one contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// It leaves the surface.
    Part,
    /// It reaches the surface.
    Touch,
    /// It turns on the loading curve.
    Turn,
    /// It reaches the end of a piece of the loading curve.
    Corner,
    /// It reaches the largest indentation on its path.
    End,
    /// It reaches the end of a segment of a chain.
    Joint,
    /// A fresh surface forgets the dent.
    Forget,
    /// The rate exceeds the largest one since the touch.
    Lead,
    /// A rate that leads is at its largest.
    Peak,
    /// The surface would have to pull: the force ends.
    Slack,
    /// The force comes back.
    Grip,
    /// A damping passes from one of its forms to another.
    Border,
}

/// An event with the number of the motion that falls through zero there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Watched {
    /// `sign (threshold - indentation)` \[m\].
    Indentation {
        /// The event.
        event: Event,
        /// \[m\]
        threshold: f64,
        /// 1 for a contact that comes deeper to the threshold, -1 for one that comes back to it.
        sign: f64,
    },
    /// `sign (threshold - rate of indentation)` \[m/s\].
    Rate {
        /// The event.
        event: Event,
        /// \[m/s\]
        threshold: f64,
        /// 1 for a rate that rises to the threshold, -1 for one that falls to it.
        sign: f64,
    },
    /// The derivative of the rate of indentation \[m/s^2\] with this sign, at [`Event::Peak`].
    Bend {
        /// The direction in which the rate leads.
        sign: f64,
    },
    /// The [pull](super::loss::Loss::pull) of the surface with this sign \[m/s\].
    Pull {
        /// The event.
        event: Event,
        /// 1 for a surface that comes to pull, -1 for one that ceases to.
        sign: f64,
    },
}

impl Watched {
    /// The rate at a turn.
    pub const TURN: Watched = Watched::Rate { event: Event::Turn, threshold: 0.0, sign: -1.0 };

    /// The event.
    pub fn event(&self) -> Event {
        match *self {
            Watched::Indentation { event, .. } | Watched::Rate { event, .. } | Watched::Pull { event, .. } => event,
            Watched::Bend { .. } => Event::Peak,
        }
    }
}

/// The branch of a contact.
#[derive(Clone, Copy)]
pub struct Branch {
    pub kind: Kind,
    /// The piece, of a chain one of its segments; of a contact that is apart, the path that it would meet.
    numbers: Numbers,
    /// Where the piece, of a chain the whole one, begins and ends \[m\].
    ends: [f64; 2],
    /// The largest indentation of the dent \[m\].
    pub largest: f64,
    /// Whether a fresh surface forgets the dent.
    pub forgets: bool,
    /// A segment that tells how stiff the contact can become: that of its path, else the elastic one. Its power has this exponent.
    pub stiffest: Segment,
    exponent: f64,
}

impl Branch {
    /// No branch of any law.
    pub const NOTHING: Branch = Branch {
        kind: Kind::Apart,
        numbers: Numbers::NOTHING,
        ends: [0.0; 2],
        largest: 0.0,
        forgets: false,
        stiffest: Segment::NOTHING,
        exponent: HERTZ,
    };

    /// The branch of a contact at `indentation` \[m\], `rising` or falling, on this piece, beyond yield or below `largest` \[m\].
    fn on<L: Loading, U: Unloading>(piece: Piece<'_, L, U>, indentation: f64, rising: bool, largest: f64) -> Branch {
        let (model, ends) = (piece.model, [piece.lower, piece.upper]);
        let numbers = piece.part(indentation, rising).numbers();
        let kind = if numbers.is_loading() { Kind::Loading } else { Kind::Path };
        let stiffest = match (kind, numbers.whole()) {
            (Kind::Path, Some(&segment)) if ends == [numbers.lower, numbers.upper] => segment,
            _ => model.loading.scale(&model.pair),
        };
        let exponent = model.loading.elastic_exponent();
        Branch { kind, numbers, ends, largest, forgets: model.surface == Surface::Fresh, stiffest, exponent }
    }

    /// The branch of a contact with this `history` that closes at `rate` \[m/s\].
    pub fn of<L: Loading, U: Unloading>(history: &History, model: &Model<L, U>, rate: f64) -> Branch {
        let (indentation, largest) = (history.indentation(), history.max_indentation());
        let known = if model.unloading.is_segmented() { history.path_of_dent() } else { None };
        let path = match known {
            Some(path) => Piece::on_path(model, path),
            None => Piece::at(model, indentation, largest, false),
        };
        let branch = Branch::on(path, indentation, rate > 0.0, largest);
        let surface = branch.surface();
        let is_apart = indentation < surface || (indentation == surface && rate < 0.0);
        if is_apart {
            Branch { kind: Kind::Apart, ..branch }
        } else if rate > 0.0 && indentation >= largest && indentation > surface {
            Branch::loading(model, indentation, largest)
        } else {
            branch
        }
    }

    /// The piece of the loading curve from `indentation` \[m\] on, or the elastic curve.
    fn loading<L: Loading, U: Unloading>(model: &Model<L, U>, indentation: f64, largest: f64) -> Branch {
        Branch::on(Piece::at(model, indentation, largest, true), indentation, true, largest)
    }

    /// The scale of the contact's motion: its stiffest segment, and the exponent of the power in it.
    pub fn scale(&self) -> (&Segment, f64) {
        (&self.stiffest, self.exponent)
    }

    /// The indentation of the surface \[m\]: on the loading curve, that of the piece.
    pub fn surface(&self) -> f64 {
        let [surface, _] = self.ends;
        surface
    }

    /// The ways from `indentation` down and up to where a segment of a chain has gone on for a tenth of its length beyond its joint, and with
    /// its square would leave the curve; infinite where the piece ends \[m\].
    pub fn ways(&self, indentation: f64) -> [f64; 2] {
        let (Numbers { lower, upper, .. }, [surface, end]) = (self.numbers, self.ends);
        let beyond = BEYOND_JOINT * (upper - lower);
        let way =
            |is_joint: bool, distance: f64| if is_joint { largest(distance, 0.0) + beyond } else { f64::INFINITY };
        let is_pressed = self.kind == Kind::Path;
        [way(is_pressed && lower > surface, indentation - lower), way(is_pressed && upper < end, upper - indentation)]
    }

    /// Number of evaluations that one evaluation counts for.
    pub fn cost(&self, costly: u32) -> u32 {
        match self.kind {
            Kind::Apart => 0,
            _ if self.numbers.whole().is_some() => 1,
            _ => costly,
        }
    }

    /// What the contact waits for on its branch.
    pub fn watched(&self, indentation: f64) -> [Option<Watched>; 2] {
        let (Numbers { lower, upper, .. }, [surface, end]) = (self.numbers, self.ends);
        let at = |event, threshold: f64, sign| {
            threshold.is_finite().then_some(Watched::Indentation { event, threshold, sign })
        };
        match self.kind {
            Kind::Apart => {
                let forgets = self.forgets && indentation > 0.0 && self.largest > 0.0;
                [at(Event::Touch, lower, 1.0), if forgets { at(Event::Forget, 0.0, -1.0) } else { None }]
            }
            Kind::Path => {
                let below = if lower > surface { Event::Joint } else { Event::Part };
                let above = if upper < end { Event::Joint } else { Event::End };
                [at(below, lower, -1.0), at(above, upper, 1.0)]
            }
            Kind::Loading => [at(Event::Corner, upper, 1.0), Some(Watched::TURN)],
        }
    }

    /// The branch after `event` at `indentation` \[m\]; for [`Event::Forget`] the one with the history that has forgotten.
    pub fn after<L: Loading, U: Unloading>(&self, event: Event, model: &Model<L, U>, indentation: f64) -> Branch {
        let Branch { numbers, largest: before, .. } = *self;
        match event {
            Event::Part => Branch { kind: Kind::Apart, ..*self },
            Event::Touch => Branch { kind: Kind::Path, ..*self },
            Event::Corner => Branch::loading(model, numbers.upper, largest(numbers.upper, before)),
            Event::End => Branch::loading(model, numbers.upper, largest(numbers.upper, before)),
            Event::Joint => {
                let rising = indentation - numbers.lower > numbers.upper - indentation;
                let at = if rising { numbers.upper } else { numbers.lower };
                Branch::on(Piece::at(model, at, before, false), at, rising, before)
            }
            Event::Lead | Event::Peak | Event::Slack | Event::Grip | Event::Border => *self,
            Event::Turn | Event::Forget => {
                let largest = largest(indentation, before);
                Branch::on(Piece::at(model, largest, largest, false), largest, false, largest)
            }
        }
    }

    /// Notes the `indentation` \[m\] that the contact has reached on its branch.
    pub fn note(&mut self, indentation: f64) {
        if self.kind != Kind::Apart {
            self.largest = largest(indentation, self.largest);
        }
    }

    /// Whether the force grows as a fractional power from the surface, so that it is smooth in the root of the height but
    /// not in time.
    pub fn begins_rough(&self) -> bool {
        let begins = |segment: &Segment| segment.power != 0.0 && segment.origin == self.numbers.lower;
        self.kind == Kind::Path && self.numbers.whole().is_none_or(begins)
    }

    /// Force \[N\] at `indentation` \[m\]; `None` for a [law without segments](Branch::force_without_segments).
    #[inline(always)]
    pub fn force(&self, indentation: f64) -> Option<f64> {
        if self.kind == Kind::Apart {
            return Some(0.0);
        }
        self.numbers.whole().map(|segment| {
            let height = indentation - segment.origin;
            let z = if fabs(height) > LEAST_HEIGHT { height } else { 0.0 };
            // below the origin the power has ended; the rest goes on
            let rise = if z > 0.0 { segment.power * sqrt(black_box(z)) } else { 0.0 };
            segment.constant + z * (segment.linear + rise + segment.square * z)
        })
    }

    /// Force \[N\] where the height above the surface is the square of `w` \[m^0.5\]. It goes on smoothly below zero. `None`
    /// for a [law without segments](Branch::force_without_segments), whose force is odd in `w`.
    #[inline(always)]
    pub fn force_of_root(&self, w: f64) -> Option<f64> {
        let z = w * w;
        let segment = self.numbers.whole()?;
        Some(segment.constant + z * (segment.linear + segment.power * w + segment.square * z))
    }

    /// The force of a law without segments \[N\]. Beyond the end of a piece it goes on along the tangent.
    #[inline(never)]
    pub fn force_without_segments<L: Loading, U: Unloading>(&self, indentation: f64, model: &Model<L, U>) -> f64 {
        let piece = Piece::of_numbers(model, &self.numbers);
        let end = piece.upper.next_down();
        if indentation < end {
            return piece.force(largest(indentation, smallest(0.0, piece.lower)));
        }
        piece.force(end) + piece.stiffness(end) * (indentation - end)
    }

    /// Stiffness \[N/m\] at `indentation` \[m\]; `None` for a [law without segments](Branch::stiffness_without_segments).
    pub fn stiffness(&self, indentation: f64) -> Option<f64> {
        match self.kind {
            Kind::Apart => Some(0.0),
            _ => self.numbers.whole().map(|segment| segment.stiffness(indentation)),
        }
    }

    /// The same where the height above the surface is the square of `w` \[m^0.5\].
    pub fn stiffness_of_root(&self, w: f64) -> Option<f64> {
        let segment = self.numbers.whole()?;
        Some(segment.linear + w * (1.5 * segment.power + 2.0 * segment.square * w))
    }

    /// The stiffness of a law without segments \[N/m\].
    #[inline(never)]
    pub fn stiffness_without_segments<L: Loading, U: Unloading>(&self, indentation: f64, model: &Model<L, U>) -> f64 {
        Piece::of_numbers(model, &self.numbers).stiffness(smallest(indentation, self.numbers.upper.next_down()))
    }
}
