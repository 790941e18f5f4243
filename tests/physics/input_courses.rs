//! Steps along a course: exactness, and independence of the division into steps.

use crate::physics::{Random, mild, model, unit};
use brinell_contact::history::momentum::impulse;
use brinell_contact::history::path::RatePolynomial;
use brinell_contact::{Contact, History, Loading, Model, Surface, Unloading, loading, unloading};
use brinell_fmu::instance::Instance;
use brinell_fmu::scene::Real;
use brinell_unit::known::Exported;

/// A claim about every law made of segments.
trait Claim {
    /// Checks a law with these names. A model whose laws are known at compile time follows its branches; one whose laws are not
    /// is processed piece by piece.
    fn check<L: Loading, U: Unloading>(&self, names: [&str; 2], model: &Model<L, U>);

    fn check_all(&self) {
        self.check_one(["hertz", "hertz"], loading::Hertz, unloading::OriginalRadius);
        self.check_one(["big-alabo", "contact-radius"], loading::BigAlabo::REFERENCE, unloading::ContactRadius);
        self.check_one(["big-alabo", "hertz-shift"], loading::BigAlabo::REFERENCE, unloading::HertzShift);
        self.check_one(["brinell", "brinell"], loading::Brinell::REFERENCE, unloading::Brinell::REFERENCE);
        self.check_one(["thornton", "thornton"], loading::Thornton::REFERENCE, unloading::Thornton);
        let walton_braun = (loading::WaltonBraun::REFERENCE, unloading::WaltonBraun::REFERENCE);
        self.check_one(["walton-braun", "walton-braun"], walton_braun.0, walton_braun.1);
        self.check_one(["luding", "luding"], loading::Luding::REFERENCE, unloading::Luding::REFERENCE);
    }

    fn check_one<L: Loading, U: Unloading>(&self, names: [&str; 2], loading: L, unloading: U) {
        let mut model = Model { pair: mild(), loading, unloading, surface: Surface::Dented };
        assert!(model.is_segmented(), "{names:?}");
        self.check(names, &model);
        model.surface = Surface::Fresh;
        self.check(names, &model);
    }
}

/// A course of any size, which turns in half of the cases.
fn any_course(random: &mut Random) -> RatePolynomial {
    let d_y = unit(&mild()).indentation;
    let mut size = || (random.next() - 0.45) * 10f64.powf(3.0 * random.next() - 0.5) * d_y;
    RatePolynomial { rate: size(), slope: 4.0 * size(), bend: 12.0 * size() }
}

/// The part of a course from `time` on.
fn part_of(course: &RatePolynomial, time: f64) -> RatePolynomial {
    RatePolynomial { rate: course.rate_after(time), slope: course.slope + course.bend * time, bend: course.bend }
}

/// A step along `course` by `contact`, and its mean force.
fn stepped<L: Loading, U: Unloading>(
    contact: &mut History,
    model: &Model<L, U>,
    course: &RatePolynomial,
    step: f64,
) -> f64 {
    contact.step_with_mean_force(course, step, || model).expect("within range").1
}

#[test]
fn a_course_that_keeps_its_direction_has_one_motion() {
    let mut random = Random(21);
    let mut kept = 0;
    for _ in 0..20_000 {
        let mut number = || (random.next() - 0.5) * 10f64.powf(4.0 * random.next() - 2.0);
        let (course, step) = (RatePolynomial { rate: number(), slope: number(), bend: number() }, number().abs());
        let [first, second, third] = course.motions(step);
        assert!(((first + second + third) - course.way(step)).abs() <= 1e-13 * (first.abs() + course.way(step).abs()));
        let rates = (0..=64).map(|place| course.rate_after(f64::from(place) / 64.0 * step));
        let (lowest, highest) = rates.fold((0.0, 0.0), |(low, high), rate| (rate.min(low), rate.max(high)));
        if course.keeps_direction(step) {
            kept += 1;
            assert_eq!((second, third), (0.0, 0.0), "{course:?} over {step}");
            // the end of a course that just comes to rest may be rounded to the other side
            let rounding =
                1e-14 * (course.rate.abs() + (course.slope * step).abs() + (course.bend * step * step).abs());
            assert!(lowest >= -rounding || highest <= rounding, "{course:?} over {step}");
        }
    }
    assert!(kept > 5000, "{kept} only");
}

/// Powers of time and of `1 + time`, whose integrals are known: the force begins, ends, or is far from its start.
#[test]
fn the_impulse_of_a_power_is_exact() {
    let (loading, unloading) = (loading::Hertz, unloading::OriginalRadius);
    let model = Model { pair: mild(), loading, unloading, surface: Surface::Dented };
    let d_y = unit(&mild()).indentation;
    let check = |depth: f64, course: RatePolynomial, mean: f64, what: &str| {
        let history = History::start(&model, -depth).unwrap();
        let found = impulse(&history, &model, &course, 1.0).unwrap();
        let mean = model.pair.hertz_stiffness() * mean;
        assert!((found / mean - 1.0).abs() < 3e-14, "{what}: {found:e} for {mean:e}");
    };
    for size in [1e-12, 1e-6, 1e-3, 1.0, 30.0].map(|size| size * d_y) {
        let power = size.powf(1.5);
        check(0.0, RatePolynomial { rate: size, slope: 0.0, bend: 1e-300 }, power / 2.5, "t");
        check(0.0, RatePolynomial { rate: 0.0, slope: 2.0 * size, bend: 0.0 }, power / 4.0, "t^2");
        check(0.0, RatePolynomial { rate: 0.0, slope: 0.0, bend: 6.0 * size }, power / 5.5, "t^3");
        check(size, RatePolynomial { rate: -2.0 * size, slope: 2.0 * size, bend: 0.0 }, power / 4.0, "(1 - t)^2");
        for part in [-1.0, -1.0 + 1e-9, -0.9, -0.3, -1e-3, -1e-9, 1e-9, 1e-3, 0.3, 3.0, 1e3, 1e9] {
            // without cancellation
            let mean = |power: f64| f64::exp_m1((power + 1.0) * f64::ln_1p(part)) / ((power + 1.0) * part);
            let what = format!("{size:e} m, {part}");
            let (one, two) = (part * size, part * part * size);
            let square = RatePolynomial { rate: 2.0 * one, slope: 2.0 * two, bend: 0.0 };
            check(size, square, power * mean(3.0), &format!("square, {what}"));
            let cube = RatePolynomial { rate: 3.0 * one, slope: 6.0 * two, bend: 6.0 * two * part };
            check(size, cube, power * mean(4.5), &format!("cube, {what}"));
        }
    }
}

/// Compares the impulse along the branches with that of the pieces of the law.
struct AsByPieces;

impl Claim for AsByPieces {
    fn check<L: Loading, U: Unloading>(&self, [loading, unloading]: [&str; 2], segmented: &Model<L, U>) {
        let mut pieces = match loading {
            "hertz" => model(loading, "original-radius"),
            _ => model(loading, unloading),
        };
        pieces.surface = segmented.surface;
        let mut random = Random(33);
        let (mut one, mut largest) = (History::start(segmented, 0.0).unwrap(), 0.0);
        for case in 0..2000 {
            let course = any_course(&mut random);
            let mut other = one;
            let mean = stepped(&mut one, segmented, &course, 1.0);
            let expected = stepped(&mut other, &pieces, &course, 1.0);
            largest = [one.force().abs(), expected.abs(), largest].into_iter().fold(0.0, f64::max);
            let what = format!("{loading}, {unloading}, {:?}, {course:?}", segmented.surface);
            assert!((mean - expected).abs() <= 1e-13 * largest, "{what}: {mean:e} for {expected:e}");
            assert_eq!((one.indentation(), one.regime()), (other.indentation(), other.regime()), "{what}");
            assert!((one.force() - other.force()).abs() <= 1e-13 * largest, "{what}");
            if case % 50 == 0 {
                (one, largest) = (History::start(segmented, 0.0).unwrap(), 0.0);
            }
        }
    }
}

#[test]
fn the_impulse_along_branches_is_that_of_the_pieces_of_the_law() {
    AsByPieces.check_all();
}

/// Compares one step with many.
struct AsItsParts;

impl Claim for AsItsParts {
    fn check<L: Loading, U: Unloading>(&self, names: [&str; 2], model: &Model<L, U>) {
        let d_y = unit(&mild()).indentation;
        let mut random = Random(17);
        for (case, parts) in [2, 3, 17, 1000, 2, 5, 40, 200].into_iter().enumerate() {
            let course = any_course(&mut random);
            let mut whole = History::start(model, -10f64.powf(case as f64 / 3.0) * d_y).unwrap();
            let mut cut = whole;
            let mean = stepped(&mut whole, model, &course, 1.0);
            let (mut sum, mut largest) = (0.0, whole.force().abs());
            for index in 0..parts {
                let [from, to] = [index, index + 1].map(|place| f64::from(place) / f64::from(parts));
                let mean = stepped(&mut cut, model, &part_of(&course, from), to - from);
                sum += mean * (to - from);
                largest = f64::max(largest, mean.abs());
            }
            let what = format!("{names:?}, {:?}, {course:?} in {parts} parts", model.surface);
            // the ends of the parts have rounding errors relative to the largest distance
            let ways = course.rate.abs() + course.slope.abs() + course.bend.abs();
            let reached = 1e-14 * ways + 1e-15 * whole.max_indentation();
            assert!((whole.indentation() - cut.indentation()).abs() <= reached, "{what}");
            assert!((sum - mean).abs() <= 2e-13 * largest, "{what}: {mean:e} in one, {sum:e}");
        }
    }
}

#[test]
fn a_step_along_a_course_is_that_of_its_parts_however_it_is_cut() {
    AsItsParts.check_all();
}

fn ready() -> Instance<Exported> {
    let mut instance = Instance::new().unwrap();
    instance.set_experiment(0.0, None).unwrap();
    instance.enter_initialization().unwrap();
    instance.exit_initialization().unwrap();
    instance
}

/// A derivative that was set before an instance was restored once reappeared in a later step.
#[test]
fn a_derivative_of_a_state_that_was_left_is_forgotten() {
    for plainly in [false, true] {
        let (plain, mut instance, mut expected) = (ready(), ready(), ready());
        instance.set_input_derivative((Real::IndentationRate, 0), 1, 3e4);
        instance.copy(&plain);
        for instance in [&mut instance, &mut expected] {
            instance.set_real((Real::IndentationRate, 0), 0.1);
            match plainly {
                true => assert!(instance.set_plain_derivatives([(2, 5e9)].into_iter())),
                false => instance.set_input_derivative((Real::IndentationRate, 0), 2, 5e9),
            }
            instance.do_step(0.0, 1e-6).unwrap();
        }
        let [one, other] = [&instance, &expected].map(|instance| instance.real((Real::Indentation, 0)));
        assert_eq!(one, other);
    }
}

/// The fast function for derivatives sets and rejects the same as the others.
#[test]
fn derivatives_that_are_set_quickly_are_those_that_are_not() {
    let mut random = Random(8);
    let (mut quick, mut slow) = (ready(), ready());
    for _ in 0..4000 {
        let mut size = || (random.next() - 0.5) * 10f64.powf(4.0 * random.next() - 3.0);
        let (rate, first, second) = (size(), size() * 1e6, size() * 1e13);
        for instance in [&mut quick, &mut slow] {
            instance.set_real((Real::IndentationRate, 0), rate);
        }
        assert!(quick.set_plain_derivatives([(1, first), (2, second)].into_iter()));
        for (order, value) in [(1, first), (2, second)] {
            slow.check_input_derivative((Real::IndentationRate, 0), order, value).unwrap();
            slow.set_input_derivative((Real::IndentationRate, 0), order, value);
        }
        let time = quick.time();
        slow.do_step(time, 1e-6).unwrap();
        quick.do_step(time, 1e-6).unwrap();
        let words = |instance: &Instance<Exported>| {
            let mut words = Vec::new();
            instance.save(|word| words.push(word));
            words
        };
        assert_eq!(words(&quick), words(&slow));
        assert_eq!((quick.take_deep().is_some(), quick.is_deep()), (slow.take_deep().is_some(), slow.is_deep()));
    }
    for refused in [(0, 1.0), (3, 1.0), (-1, 1.0), (i32::MIN, 1.0), (1, f64::NAN), (2, f64::INFINITY)] {
        let before = quick.real((Real::Indentation, 0));
        assert!(!quick.set_plain_derivatives([(1, 7.0), refused].into_iter()), "{refused:?}");
        quick.set_real((Real::IndentationRate, 0), 0.0);
        let time = quick.time();
        quick.do_step(time, 1e-6).unwrap();
        assert_eq!(quick.real((Real::Indentation, 0)), before, "{refused:?}: none is set");
    }
}

/// Otherwise its warning would come with a later step, or never.
#[test]
fn a_step_with_derivatives_that_leads_too_deep_says_so() {
    let step = 1e-6;
    let valid = model("big-alabo", "contact-radius").valid_depth(f64::INFINITY);
    for start in [0.0, 0.5] {
        for end in [0.6, 0.999, 1.001, 2.0] {
            for bend in [false, true] {
                let mut instance = ready();
                instance.set_real((Real::IndentationRate, 0), start * valid / step);
                instance.do_step(0.0, step).unwrap();
                instance.set_real((Real::IndentationRate, 0), 0.0);
                // the way is half of the slope times the square of the time, or a sixth of the bend times its cube
                let way = (end - start) * valid;
                let derivative =
                    if bend { (2, 6.0 * way / (step * step * step)) } else { (1, 2.0 * way / (step * step)) };
                assert!(instance.set_plain_derivatives([derivative].into_iter()));
                instance.do_step(step, step).unwrap();
                assert_eq!(instance.is_deep(), end > 1.0, "from {start} to {end}, {derivative:?}");
                assert!((instance.real((Real::Indentation, 0)) / (end * valid) - 1.0).abs() < 1e-12);
            }
        }
    }
}
