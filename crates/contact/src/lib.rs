//! The physics: a rigid or elastic sphere pressed into an elastoplastic half-space.
//!
//! ```
//! use brinell_contact::{Body, History, Model};
//! let (ball, block) = (Body::rigid(5e-3), Body::flat(206e9, 0.3)); // radius [m]; Young's modulus [Pa], Poisson's ratio
//! let model = Model::brinell(&ball, &block, 300e6).unwrap(); // yield strength [Pa]
//! let mut history = History::start(&model, 0.0).unwrap(); // in touch
//! history.advance(&model, 10e-6).unwrap(); // 10 um in
//! assert_eq!(format!("{:.1} N", history.force()), "254.4 N");
//! ```
//!
//! `f64` only; no allocation, no input or output, no panic, and no `unsafe`. A [`Model`] holds the bodies in contact
//! and their laws; a [`History`] holds the whole state of a contact. [`History::advance`] moves it along a path. Force,
//! stiffness, energies and dent are functions of the two. The trait [`Contact`] is the common interface of all contacts.
//!
//! # Model
//! A sphere of effective radius `R` is pressed into a half-space of effective modulus `E*` and yield strength `S`. The
//! normal force `F` is a function of the indentation and of the largest indentation so far:
//!
//! - *loading* follows the curve of a [loading law](loading): Hertz's until the mean pressure reaches 1.1 S, then
//!   the elastoplastic and the fully plastic branches of the law;
//! - *unloading* follows the curve of an [unloading law](unloading) down to the dent that remains; reloading
//!   follows it back up, and continues along the loading curve.
//!
//! Work, elastic and dissipated energy are functions of the state; nothing is accumulated. At a constant rate over a step, the
//! result does not depend on how the time is divided into steps.
//!
//! # Validity
//! The model is a quasi-static normal contact of a paraboloid, with friction on top: `a/R` up to about 0.3, and a contact time
//! that is long compared with the travel time of elastic waves. Hardening ([`material::strength`]), the strain rate ([`rate`]) and waves
//! ([`losses`]) are there for those who ask for them. [`validity`] gives the limits as numbers.
//!
//! # Units
//! SI throughout: m, kg, s, N, Pa, J. The documentation of each public item states its unit.
//!
//! # Laws by name, and a prediction
//! ```
//! use brinell_contact::{Body, History, Model, Pair, Surface, impact, loading::BigAlabo, unloading::ContactRadius};
//!
//! let ball = Body { radius: 5e-3, youngs_modulus: f64::INFINITY, poissons_ratio: 0.0 };
//! let block = Body { radius: f64::INFINITY, youngs_modulus: 206e9, poissons_ratio: 0.3 };
//! let pair = Pair::new(&ball, &block, 300e6).unwrap();
//! let model = Model { pair, loading: BigAlabo::REFERENCE, unloading: ContactRadius, surface: Surface::Dented };
//!
//! let mut history = History::start(&model, 0.0).unwrap();
//! history.advance(&model, 10e-6).unwrap(); // 10 um in
//! history.advance(&model, -1e-6).unwrap(); // 1 um back
//! assert!(history.force() > 0.0 && history.residual_indentation(&model) > 7e-6);
//!
//! let outcome = impact::predict(&model, &impact::Impact { mass: 4.11e-3, speed: 1.0 }).unwrap();
//! assert!((outcome.restitution - 0.4463).abs() < 1e-4);
//! ```
//!
//! # Modules
//! | module | content |
//! |---|---|
//! | [`material`] | bodies, effective radius and modulus, yield point; with hardening, large strain, ellipses and lines |
//! | [`loading`] | one file for each loading law, made of [segments](Segment); [two bodies](loading::two_bodies) pressed together |
//! | [`unloading`] | one file for each unloading law |
//! | [`history`] | the state of a contact, its path through the branches, and the integral of its force over time |
//! | [`behaviour`] | the trait [`Contact`] |
//! | [`impact`] | prediction of an impact from the energy balance |
//! | [`motion`] | the motion of bodies of known mass |
//! | [`shared`] | contacts that share bodies move together |
//! | [`tangential`] | friction: the tangential force of a contact |
//! | [`losses`] | losses below yield: damping, elastic waves, a plate that gives way |
//! | [`damped`] | rate-dependent laws: an elastic contact and its damping |
//! | [`rate`] | strain rate: the strength of an impact from its closing speed |
//! | [`validity`] | the range in which the laws are valid |
//! | [`numerics`] | arithmetic that raises no exceptions, quadrature, automatic differentiation, numbers as words of saved states |
//!
//! # References
//! - A. Big-Alabo, P. Harrison, M. P. Cartmell, "Contact model for elastoplastic analysis of half-space indentation by a
//!   spherical impactor", *Computers & Structures* 151 (2015) 20-29.
//! - K. L. Johnson, *Contact Mechanics*, Cambridge University Press, 1985.
#![cfg_attr(not(test), no_std)]
#![forbid(unsafe_code)]
#![deny(rustdoc::broken_intra_doc_links)]
#![warn(missing_docs)]

pub mod behaviour;
pub mod damped;
pub mod history;
pub mod impact;
mod laws;
pub mod loading;
pub mod losses;
pub mod material;
pub mod motion;
pub mod numerics;
pub mod rate;
mod regime;
mod segment;
pub mod shared;
pub mod tangential;
pub mod unloading;
pub mod validity;

pub use behaviour::Contact;
pub use history::History;
pub use laws::{LawNumbers, Numbered};
pub use loading::Loading;
use loading::two_bodies::{Construction, Together};
pub use loading::two_bodies::{OtherBody, TwoBodies};
pub use material::{Body, Pair, YieldPoint};
use numerics::smallest;
pub use regime::{LARGEST_INDENTATION, Regime, TooDeep};
pub use segment::Segment;
pub use unloading::{Peak, Unloading};

/// The surface that a new contact meets after the bodies have separated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Surface {
    /// The dent that the last contact left: the force begins again at the residual indentation.
    #[default]
    Dented,
    /// An untouched spot. Once the bodies have separated beyond the original surface, the dent is forgotten, but its energy
    /// still counts.
    Fresh,
}

/// The bodies in contact and their laws.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Model<L, U> {
    /// The two bodies.
    pub pair: Pair,
    /// The loading curve.
    pub loading: L,
    /// The unloading law.
    pub unloading: U,
    /// The surface that a new contact meets.
    pub surface: Surface,
}

impl Model<loading::Paired, unloading::Brinell> {
    /// An `impactor` that stays elastic on a `target` that yields at `yield_strength` \[Pa\], with the laws `brinell` as FMUs have
    /// them: fitted to finite elements, with large strain. For two [bodies](Pair::new) that can touch at one point.
    pub fn brinell(impactor: &Body, target: &Body, yield_strength: f64) -> Option<Self> {
        let other = OtherBody {
            modulus: impactor.plane_strain_modulus(),
            poissons_ratio: impactor.poissons_ratio,
            ..OtherBody::RIGID
        };
        let bodies = TwoBodies { hardening_modulus: 0.0, curvature: target.curvature(impactor), other };
        let model = Model {
            pair: Pair::new(impactor, target, yield_strength)?,
            loading: loading::Paired::new(loading::Brinell::REFERENCE, bodies),
            unloading: unloading::Brinell::REFERENCE,
            surface: Surface::Dented,
        };
        Some(model.prepared())
    }
}

impl<L: Loading, U: Unloading> Model<L, U> {
    /// The model with all that depends on the bodies alone computed in advance, where that is slow: [`Loading::prepared`]. It holds as
    /// long as nothing of the model changes.
    pub fn prepared(self) -> Self {
        self.prepared_after(None)
    }

    /// The same after a change of parameters. What is known of the bodies is taken from the model `before` if they are the same.
    pub fn prepared_after(self, before: Option<&Self>) -> Self {
        let recovery = |bodies: &Construction<'_>, from: &Together| self.unloading.recovery(bodies, from);
        let loading = self.loading.prepared(&self.pair, &recovery, before.map(|before| &before.loading));
        Model { loading, ..self }
    }

    /// The same for the motion of bodies of this kinetic `energy` \[J\]: [`Loading::prepared_for`].
    pub fn prepared_for(self, energy: f64) -> Self {
        let loading = self.loading.prepared_for(&self.pair, energy);
        Model { loading, ..self }
    }

    /// The point where the contact begins to yield.
    pub fn yield_point(&self) -> YieldPoint {
        self.loading.yield_point(&self.pair)
    }

    /// Whether a contact that yields at `point` yields before it reaches `indentation` \[m\].
    #[inline(always)]
    fn yields_before(&self, point: &YieldPoint, indentation: f64) -> bool {
        self.loading.can_yield() && indentation > point.indentation
    }

    /// Whether every branch is a segment, and none a tangent.
    #[inline(always)]
    pub fn is_segmented(&self) -> bool {
        self.unloading.is_segmented() && self.loading.is_segmented()
    }

    /// Whether the elastic part is one segment: no chain, nor a power other than Hertz's.
    #[inline(always)]
    pub(crate) fn has_elastic_segment(&self) -> bool {
        !L::has_chain() && (self.loading.can_yield() || self.loading.is_segmented())
    }

    /// The elastic part: its segment, or that of a chain or the tangent at `indentation` \[m\], up to first yield.
    #[inline(always)]
    pub(crate) fn elastic_segment(&self, indentation: f64) -> Segment {
        let at = match () {
            () if self.has_elastic_segment() => 0.0,
            () if L::has_chain() => smallest(indentation, self.yield_point().indentation.next_down()),
            () => indentation,
        };
        self.loading.segment(&self.pair, at)
    }

    /// Whether the elastic part may be more than one segment, so that the work on it is not that of a path.
    #[inline(always)]
    fn has_chain(&self) -> bool {
        L::has_chain()
    }

    /// The point of the loading curve at `indentation` \[m\], as the start of an unloading.
    pub fn peak(&self, indentation: f64) -> Peak {
        Peak { work: self.work_for_unloading(indentation), ..self.point_of_loading(indentation) }
    }

    /// The same without the work. It is not inlined, to keep the code small where speed does not matter.
    #[inline(never)]
    fn point_of_loading(&self, indentation: f64) -> Peak {
        let point = self.yield_point();
        let force = self.loading.segment(&self.pair, indentation).force(indentation);
        self.peak_without_work(&point, indentation, force)
    }

    #[inline(always)]
    fn peak_without_work(&self, point: &YieldPoint, indentation: f64, force: f64) -> Peak {
        let (contact_radius, recovery) =
            self.loading
                .at_peak(&self.pair, point, indentation, force, &|bodies, from| self.unloading.recovery(bodies, from));
        Peak { indentation, force, contact_radius, yield_force: point.force, work: f64::NAN, recovery }
    }

    /// [`Model::peak`] of a contact that yields at `point` and has this `force` \[N\] at `indentation` \[m\].
    #[inline(always)]
    fn peak_at(&self, point: &YieldPoint, indentation: f64, force: f64) -> Peak {
        Peak { work: self.work_for_unloading(indentation), ..self.peak_without_work(point, indentation, force) }
    }

    /// Work of loading up to `indentation` \[J\]; NaN if the unloading law does not need it.
    #[inline(always)]
    fn work_for_unloading(&self, indentation: f64) -> f64 {
        if self.unloading.needs_work() { self.loading.work(&self.pair, indentation) } else { f64::NAN }
    }

    /// The unloading path from `max_indentation` \[m\] > 0: its lower end is the residual indentation, its upper end
    /// `max_indentation`. Up to the yield point it is the loading curve itself.
    #[inline(always)]
    pub fn unloading_path(&self, max_indentation: f64) -> Segment {
        // for a law that never yields, the plastic code is compiled out
        match self.loading.can_yield() {
            true => self.path_of_dent(max_indentation),
            false => self.elastic_path(max_indentation),
        }
    }

    /// The same for a law that yields.
    #[inline(never)]
    fn path_of_dent(&self, max_indentation: f64) -> Segment {
        if self.is_elastic_at(max_indentation) {
            self.elastic_path(max_indentation)
        } else {
            self.path_from(&self.peak(max_indentation))
        }
    }

    /// The same before yield.
    fn elastic_path(&self, max_indentation: f64) -> Segment {
        let at = if L::has_chain() { max_indentation } else { 0.0 };
        Segment { lower: 0.0, upper: max_indentation, ..self.elastic_segment(at) }
    }

    /// The same from a `peak` beyond the yield point.
    #[inline(never)]
    fn path_from(&self, peak: &Peak) -> Segment {
        self.unloading.path(&self.pair, peak)
    }

    /// Depth of the dent that unloading from `max_indentation` \[m\] leaves \[m\].
    pub fn residual_indentation(&self, max_indentation: f64) -> f64 {
        if self.is_elastic_at(max_indentation) { 0.0 } else { self.unloading_path(max_indentation).lower }
    }

    /// The segment of the unloading path at `indentation` \[m\].
    pub fn unloading_segment(&self, max_indentation: f64, indentation: f64) -> Segment {
        if !self.has_elastic_segment() && self.is_elastic_at(max_indentation) {
            return self.elastic_segment(indentation);
        }
        let path = self.unloading_path(max_indentation);
        if self.unloading.is_segmented() || self.is_elastic_at(max_indentation) {
            return path;
        }
        self.unloading.tangent(&self.pair, &self.peak(max_indentation), &path, indentation)
    }

    /// Work returned on the unloading path from `indentation` \[m\] down to the residual indentation \[J\].
    pub fn recovered_work(&self, max_indentation: f64, indentation: f64) -> f64 {
        if !self.has_elastic_segment() && self.is_elastic_at(max_indentation) {
            return self.loading.work(&self.pair, indentation);
        }
        let path = self.unloading_path(max_indentation);
        if self.unloading.is_segmented() || self.is_elastic_at(max_indentation) {
            return path.work(indentation);
        }
        self.unloading.work(&self.pair, &self.peak(max_indentation), &path, indentation)
    }

    /// The indentation up to which the loading law is valid \[m\] for bodies of which the smaller one has this `size` \[m\].
    pub fn valid_depth(&self, size: f64) -> f64 {
        let [valid, _] = self.loading.widths(&self.pair, size);
        self.depth_of(valid)
    }

    /// The indentation at which the loading law has this `contact_radius` \[m\].
    pub fn depth_of(&self, contact_radius: f64) -> f64 {
        validity::depth_of(contact_radius, self.pair.radius, |depth| self.point_of_loading(depth).contact_radius)
    }

    /// Whether the passivity guard shortens the path from `max_indentation` \[m\].
    pub fn is_held_back_at(&self, max_indentation: f64) -> bool {
        !self.is_elastic_at(max_indentation) && self.unloading.holds_back(&self.pair, &self.peak(max_indentation))
    }

    /// Whether a contact that was never deeper than `max_indentation` \[m\] has not yielded.
    #[inline(never)]
    pub fn is_elastic_at(&self, max_indentation: f64) -> bool {
        !self.yields_before(&self.yield_point(), max_indentation)
    }
}
