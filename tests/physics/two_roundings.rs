//! The same expression in two places of a library may be rounded in two ways: the compiler computes a part of one of them in
//! advance, and the host has changed the direction of rounding. Every motion has to end all the same.
//!
//! The laws here are those of the project with a last digit that changes from call to call.

use crate::physics::{AnyModel, MASS, Random, TURNS, mild, on_grid, some_models};
use brinell_contact::history::momentum::impulse;
use brinell_contact::history::path::RatePolynomial;
use brinell_contact::loading::RecoveryOf;
use brinell_contact::losses::{self, AnyLoss, HalfSpaceRadiation, Plate, RestitutionFitted, Solid};
use brinell_contact::material::YieldPoint;
use brinell_contact::motion::{ExternalLoad, follow};
use brinell_contact::tangential::{Friction, FrictionalContact, FrictionalModel};
use brinell_contact::unloading::Recovery;
use brinell_contact::{Contact, History, Loading, Model, Pair, Peak, Segment, Surface, Unloading, loading, unloading};
use brinell_contact::{LARGEST_INDENTATION, Regime};
use brinell_testing::long::some;
use std::cell::{Cell, RefCell};

thread_local! {
    static RANDOM: RefCell<Random> = const { RefCell::new(Random(3)) };
    /// Every how many evaluations of an unloading path numbers are rounded up, otherwise down; and the number of
    /// evaluations. `None` rounds at random.
    static IN_TURN: Cell<Option<(u32, u32)>> = const { Cell::new(None) };
}

/// `number` or one of its neighbours; zero and the ends of the last segments stay.
fn rounded(number: f64) -> f64 {
    let draw = match IN_TURN.get() {
        Some((period, count)) => f64::from(u8::from(count.is_multiple_of(period))),
        None => RANDOM.with_borrow_mut(Random::next),
    };
    match number {
        0.0 | f64::INFINITY | LARGEST_INDENTATION => number,
        _ if draw < 0.3 => number.next_down(),
        _ if draw > 0.7 => number.next_up(),
        _ => number,
    }
}

/// A law whose results have another last digit whenever it is evaluated.
#[derive(Clone, Copy)]
struct Rounded<T>(T);

/// A segment with rounded coefficients; `upper` and `lower` are rounded by the caller.
fn coefficients(segment: Segment) -> Segment {
    let Segment { constant, linear, power, square, .. } = segment;
    let [constant, linear, power, square] = [constant, linear, power, square].map(rounded);
    Segment { constant, linear, power, square, ..segment }
}

impl<L: Loading> Loading for Rounded<L> {
    fn can_yield(&self) -> bool {
        self.0.can_yield()
    }

    fn yield_point(&self, pair: &Pair) -> YieldPoint {
        let point = self.0.yield_point(pair);
        YieldPoint { indentation: rounded(point.indentation), force: rounded(point.force) }
    }

    fn segment(&self, pair: &Pair, indentation: f64) -> Segment {
        let segment = coefficients(self.0.segment(pair, indentation));
        // it holds at `indentation`
        Segment { upper: rounded(segment.upper).max(indentation.next_up()), ..segment }
    }

    fn is_segmented(&self) -> bool {
        self.0.is_segmented()
    }

    fn has_squares() -> bool {
        L::has_squares()
    }

    fn has_chain() -> bool {
        L::has_chain()
    }

    fn next_corner(&self, pair: &Pair, indentation: f64) -> f64 {
        rounded(self.0.next_corner(pair, indentation)).max(indentation.next_up())
    }

    fn work(&self, pair: &Pair, indentation: f64) -> f64 {
        rounded(self.0.work(pair, indentation))
    }

    fn work_between(&self, pair: &Pair, low: f64, high: f64) -> Option<f64> {
        self.0.work_between(pair, low, high)
    }

    fn contact_radius(&self, pair: &Pair, indentation: f64) -> f64 {
        rounded(self.0.contact_radius(pair, indentation))
    }

    fn at_peak(
        &self,
        pair: &Pair,
        point: &YieldPoint,
        indentation: f64,
        force: f64,
        recovery: &RecoveryOf<'_>,
    ) -> (f64, Recovery) {
        let (radius, recovery) = self.0.at_peak(pair, point, indentation, force, recovery);
        (rounded(radius), recovery)
    }

    fn regime(&self, pair: &Pair, indentation: f64) -> Regime {
        self.0.regime(pair, indentation)
    }
}

impl<U: Unloading> Unloading for Rounded<U> {
    const SEGMENTED: bool = U::SEGMENTED;
    const MIXED: bool = U::MIXED;
    const SQUARES: bool = U::SQUARES;

    fn is_segmented(&self) -> bool {
        self.0.is_segmented()
    }

    fn needs_work(&self) -> bool {
        self.0.needs_work()
    }

    fn path(&self, pair: &Pair, peak: &Peak) -> Segment {
        IN_TURN.set(IN_TURN.get().map(|(period, count)| (period, count + 1)));
        let path = coefficients(self.0.path(pair, peak));
        let lower = rounded(path.lower).min(path.upper.next_down());
        Segment { lower, origin: if path.origin == path.lower { lower } else { rounded(path.origin) }, ..path }
    }

    fn tangent(&self, pair: &Pair, peak: &Peak, path: &Segment, indentation: f64) -> Segment {
        self.0.tangent(pair, peak, path, indentation)
    }

    fn contact_radius(&self, pair: &Pair, peak: &Peak, path: &Segment, indentation: f64) -> f64 {
        self.0.contact_radius(pair, peak, path, indentation)
    }

    fn work(&self, pair: &Pair, peak: &Peak, path: &Segment, indentation: f64) -> f64 {
        self.0.work(pair, peak, path, indentation)
    }
}

type Twice<L, U> = Model<Rounded<L>, Rounded<U>>;

fn with_roundings<L: Loading + Copy, U: Unloading + Copy>(model: &Model<L, U>) -> Twice<L, U> {
    let Model { pair, loading, unloading, surface } = *model;
    Model { pair, loading: Rounded(loading), unloading: Rounded(unloading), surface }
}

/// Something that is tried with a model of any type.
trait Trial {
    fn run<L: Loading + Copy, U: Unloading + Copy>(&self, name: &str, model: &Model<L, U>);
}

/// Tries all pairings, the most different ones with the types of an FMU, on both surfaces.
fn with_all(trial: &impl Trial) {
    fn of<L: Loading + Copy, U: Unloading + Copy>(trial: &impl Trial, name: &str, loading: L, unloading: U) {
        for surface in [Surface::Dented, Surface::Fresh] {
            for period in some([None, Some(2), Some(3), Some(4), Some(5)], 2) {
                IN_TURN.set(period.map(|period| (period, 0)));
                trial.run(&format!("{name}, {surface:?}"), &Model { pair: mild(), loading, unloading, surface });
            }
        }
    }
    for (name, AnyModel { loading, unloading, .. }) in some_models(mild()) {
        of(trial, &name, loading, unloading);
    }
    of(trial, "brinell", loading::Brinell::REFERENCE, unloading::Brinell::REFERENCE);
    of(trial, "thornton", loading::Thornton::REFERENCE, unloading::Thornton);
}

/// The steps of a path [m]: between turning points, each divided into `parts`.
fn steps(parts: u32) -> impl Iterator<Item = f64> {
    let mut from = 0.0;
    TURNS.into_iter().flat_map(move |turn| {
        let increment = (on_grid(turn) - from) / f64::from(parts);
        from = on_grid(turn);
        (0..parts).map(move |_| increment)
    })
}

/// Two numbers are close compared with a third.
fn assert_close(name: &str, one: f64, two: f64, size: f64, tolerance: f64) {
    assert!((one - two).abs() <= tolerance * size, "{name}: {one:e} instead of {two:e}");
}

/// A path of prescribed motion, with the impulse of every step at a constant and at a changing rate.
struct Prescribed;

impl Trial for Prescribed {
    fn run<L: Loading + Copy, U: Unloading + Copy>(&self, name: &str, model: &Model<L, U>) {
        let twice = with_roundings(model);
        for parts in [1, 7, 30] {
            let (mut usual, mut other) = (History::start(model, 0.0).unwrap(), History::start(&twice, 0.0).unwrap());
            let mut largest = 0.0_f64;
            for increment in steps(parts) {
                // forward, back, and forward again
                let turning =
                    RatePolynomial { rate: 3.0 * increment, slope: -12.0 * increment, bend: 24.0 * increment };
                for course in [RatePolynomial::held(increment), turning] {
                    let [one, two] = [impulse(&usual, model, &course, 1.0), impulse(&other, &twice, &course, 1.0)];
                    let (one, two) =
                        (one.expect("within range"), two.unwrap_or_else(|deep| panic!("{name}: {deep:?}")));
                    largest = largest.max(one);
                    assert_close(name, two, one, largest, 1e-9);
                }
                usual.advance(model, increment).expect("within range");
                other.advance(&twice, increment).unwrap_or_else(|deep| panic!("{name}: {deep:?}"));
                largest = largest.max(usual.force());
                assert_close(name, other.force(), usual.force(), largest, 1e-11);
            }
        }
    }
}

#[test]
fn a_prescribed_motion_goes_through_all_corners_and_its_impulse_is_the_same() {
    with_all(&Prescribed);
}

/// A body that is thrown onto the surface until it has bounced a few times, in one step or in many.
struct Thrown;

impl Trial for Thrown {
    fn run<L: Loading + Copy, U: Unloading + Copy>(&self, name: &str, model: &Model<L, U>) {
        let twice = with_roundings(model);
        // a dent above the original surface may or may not be left where the bodies part
        let rises = (1..40).any(|count| model.unloading_path(on_grid(f64::from(count))).lower < 0.0);
        if rises && model.surface == Surface::Fresh {
            return;
        }
        for (speed, acceleration) in [(0.01, 0.0), (1.0, 0.0), (0.05, 9.81), (20.0, -1e5), (0.0, 1e3)] {
            let drive = ExternalLoad { mass: MASS, acceleration };
            let mut time = 1e-3_f64;
            for parts in [1, 10, 300] {
                time *= 0.9;
                let (mut usual, mut other) =
                    (History::start(model, 1e-9).unwrap(), History::start(&twice, 1e-9).unwrap());
                let [mut one, mut two] = [speed; 2];
                let step = time / f64::from(parts);
                for _ in 0..parts {
                    one = follow(&mut usual, model, &drive, one, step).expect("a motion").speed;
                    let outcome = follow(&mut other, &twice, &drive, two, step);
                    two = outcome.unwrap_or_else(|reason| panic!("{name}, {speed} m/s: {reason:?}")).speed;
                }
                let size = speed + acceleration.abs() * time;
                let name = format!("{name}, {speed} m/s, {acceleration} m/s^2, {parts} steps");
                assert_close(&name, two, one, size, 1e-6);
            }
        }
    }
}

#[test]
fn a_thrown_body_bounces_alike() {
    with_all(&Thrown);
}

/// A path with each loss below yield.
struct Lossy;

impl Trial for Lossy {
    fn run<L: Loading + Copy, U: Unloading + Copy>(&self, name: &str, model: &Model<L, U>) {
        let target = Solid { density: 7850.0, youngs_modulus: 2.1e11, poissons_ratio: 0.3 };
        for loss in [
            AnyLoss::RestitutionFitted(RestitutionFitted { restitution: 0.9 }),
            AnyLoss::HalfSpaceRadiation(HalfSpaceRadiation { target }),
            AnyLoss::Plate(Plate { target, thickness: 0.01 }),
        ] {
            let (usual_model, twice) =
                (losses::Model { plastic: *model, loss }, losses::Model { plastic: with_roundings(model), loss });
            for parts in [1, 7] {
                let mut usual = losses::History::start(&usual_model, 0.0).unwrap();
                let mut other = losses::History::start(&twice, 0.0).unwrap();
                let (step, mut largest) = (1e-5 / f64::from(parts), 0.0_f64);
                for increment in steps(parts) {
                    usual.advance(&usual_model, increment / step, step).expect("within range");
                    let result = other.advance(&twice, increment / step, step);
                    result.unwrap_or_else(|deep| panic!("{name}, {loss:?}: {deep:?}"));
                    largest = largest.max(usual.heat());
                    assert_close(&format!("{name}, {loss:?}"), other.heat(), usual.heat(), largest, 1e-8);
                }
            }
        }
    }
}

#[test]
fn losses_of_a_prescribed_motion_are_the_same() {
    with_all(&Lossy);
}

/// A path with tangential motion. Where a dent begins to grow, the tangential force depends on the division of the motion, so
/// it is not compared.
struct Oblique;

impl Trial for Oblique {
    fn run<L: Loading + Copy, U: Unloading + Copy>(&self, name: &str, model: &Model<L, U>) {
        // these unloading laws do not support friction
        if ["hertz-shift", "etsion,", "vu-quoc-zhang", "line with"].iter().any(|law| name.contains(law)) {
            return;
        }
        let friction = Friction { coefficient: 0.3, stiffness_ratio: 1.4 / 1.7 };
        let twice = FrictionalModel { normal: with_roundings(model), friction, loss: () };
        for parts in [1, 7, 50] {
            let mut contact = FrictionalContact::<12>::start(&twice, 0.0).unwrap();
            let mut largest = 0.0_f64;
            for (number, increment) in steps(parts).enumerate() {
                contact.set_tangential_rate(0.05 * increment.abs() * if number % 5 < 2 { -1.0 } else { 1.0 });
                let result = contact.step(&RatePolynomial::held(increment), 1.0, || twice);
                result.unwrap_or_else(|deep| panic!("{name}: {deep:?}"));
                let (force, limit) = (contact.tangential_force(&twice), 0.3 * contact.normal().force());
                largest = largest.max(limit);
                assert!(force.abs() <= limit + 1e-12 * largest, "{name}: {force:e} of {limit:e}");
                let energy = contact.tangential_energy(&twice);
                assert!(energy >= 0.0 && contact.friction_work(&twice).is_finite(), "{name}: {energy:e}");
            }
        }
    }
}

#[test]
fn the_tangential_force_stays_within_coulombs_bound() {
    with_all(&Oblique);
}
