//! Friction in two directions on an elastic curve: many exact springs as the judge, and properties of every history.

mod histories;
mod springs;

use crate::friction::{hertz, table};
use crate::physics::Random;
use brinell_contact::tangential::{Friction, Motion, PlayOperator};
use brinell_testing::long;
use histories::{MODULUS, RADIUS, Run, Step, any_sizes, circles, distance, length, like_the_table};
use springs::Springs;

const FRICTION: Friction = Friction { coefficient: 0.3, stiffness_ratio: 1.4 / 1.7 };

/// A list that is hardly ever full.
const UNBOUNDED: usize = 512;

/// Makes the steps of a history from its seed and length.
type History = fn(u64, usize) -> Vec<Step>;

/// The kinds of histories.
const KINDS: [(&str, History); 3] =
    [("like the table", like_the_table), ("any sizes", any_sizes), ("circles", circles)];

#[test]
fn a_history_that_turns_has_the_forces_of_the_table_and_of_springs() {
    let kappa = FRICTION.scale();
    let (mut run, mut springs, mut worst) = (Run::<16>::new(), Springs::new(2000), [0.0_f64; 3]);
    for row in table("two") {
        let step = (row.get("d_delta"), [kappa * row.get("d_s1"), kappa * row.get("d_s2")]);
        run.step(step);
        springs.step(step);
        let size = run.force();
        let expected = [row.get("T1"), row.get("T2")].map(|force| force / FRICTION.coefficient);
        let energy = FRICTION.coefficient / kappa * run.energy();
        worst[0] = worst[0].max(distance(run.pull(), expected) / size);
        worst[1] = worst[1].max(distance(run.pull(), springs.pull()) / size);
        worst[2] = worst[2].max((energy / row.get("energy") - 1.0).abs());
    }
    println!("worst of T: {:.1e} from the table, {:.1e} from the springs; energy {:.1e}", worst[0], worst[1], worst[2]);
    // the table itself is from an approximation, which in one row is farther from the springs
    assert!(worst[0] < 6e-3 && worst[1] < 1e-3 && worst[2] < 5e-3, "{worst:?}");
}

#[test]
fn the_springs_agree_with_more_springs_and_with_small_parts() {
    for (name, history) in KINDS {
        let (mut few, mut many, mut fine) = (Springs::new(500), Springs::new(2000), Springs::new(500));
        let (mut worst, mut worst_of_fine, mut indentation) = (0.0_f64, 0.0_f64, 0.0);
        for step in history(77, 15) {
            few.step(step);
            many.step(step);
            fine.step_in_small_parts(step, 1000);
            indentation += step.0;
            let size = hertz(MODULUS, RADIUS).force(indentation);
            if indentation > 1e-6 {
                worst = worst.max(distance(few.pull(), many.pull()) / size);
                worst_of_fine = worst_of_fine.max(distance(few.pull(), fine.pull()) / size);
            }
        }
        println!("{name}: {worst:.1e} with more springs, {worst_of_fine:.1e} with small parts");
        assert!(worst < 2e-5 && worst_of_fine < 1e-3, "{name}: {worst:e} {worst_of_fine:e}");
    }
}

/// The largest and the root mean square difference between lists and springs over these `seeds`, relative to the force, with
/// steps in each of these `parts`. Contacts shallower than 1e-6 m, with few springs, are left out.
fn errors<const N: usize, const P: usize>(
    history: History,
    seeds: std::ops::Range<u64>,
    parts: [u32; P],
) -> [(f64, f64); P] {
    let (mut worst, mut squares, mut count) = ([0.0_f64; P], [0.0; P], 0.0);
    for seed in seeds {
        let mut runs = parts.map(|_| Run::<N>::new());
        let mut springs = Springs::new(500);
        for step in history(seed, 25) {
            springs.step(step);
            let expected = springs.pull();
            let found = std::array::from_fn::<_, P, _>(|index| {
                runs[index].in_parts(step, parts[index]);
                distance(runs[index].pull(), expected) / runs[index].force()
            });
            if runs[0].indentation > 1e-6 {
                worst = std::array::from_fn(|index| worst[index].max(found[index]));
                squares = std::array::from_fn(|index| squares[index] + found[index] * found[index]);
                count += 1.0;
            }
        }
    }
    std::array::from_fn(|index| (worst[index], (squares[index] / count).sqrt()))
}

#[test]
fn sixteen_segments_are_near_the_springs_however_a_step_is_divided() {
    for (name, history) in KINDS {
        let errors = errors::<16, 3>(history, 1000..1015, [1, 8, 64]);
        println!("{name}: 1, 8 and 64 parts, worst and mean square {errors:?}");
        let (worst, worst_mean) = if name == "circles" { (5e-3, 1e-3) } else { (2e-3, 5e-4) };
        assert!(errors.iter().all(|&(largest, mean)| largest < worst && mean < worst_mean), "{name}: {errors:?}");
    }
}

/// The figures of the guide.
#[test]
#[ignore = "takes a minute"]
fn sixteen_segments_over_many_histories_and_parts() {
    for (name, history) in KINDS {
        let errors = errors::<16, 4>(history, 0..60, [1, 8, 64, 512]);
        println!("{name}: 1, 8, 64 and 512 parts, worst and mean square {errors:?}");
        assert!(errors.iter().all(|&(largest, mean)| largest < 1e-2 && mean < 1.2e-3), "{name}: {errors:?}");
    }
}

#[test]
fn a_list_that_is_not_full_misses_the_springs_by_less_than_a_thousandth() {
    for (name, history) in KINDS {
        let errors = errors::<UNBOUNDED, 2>(history, 1000..1004, [1, 8]);
        println!("{name}: 1 and 8 parts, worst and mean square {errors:?}");
        assert!(errors.iter().all(|&(largest, mean)| largest < 1e-3 && mean < 6e-4), "{name}: {errors:?}");
    }
}

#[test]
fn the_mean_force_of_a_step_at_once_is_that_of_its_parts() {
    for (name, history) in KINDS {
        let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
        for seed in 0..long::cases(30) {
            let mut run = Run::<16>::new();
            for step in history(seed, 40) {
                let way = Motion::straight(run.indentation, run.indentation + step.0, step.1);
                let mean = run.stuck.mean_pull(&run.curve, &way);
                // the same steps on the way as that of one step, in many short ones
                let (mut sum, parts) = ([0.0; 2], 400);
                for part in 0..parts {
                    let mut moved = run.stuck;
                    let begun = way.first_part((f64::from(part) + 0.5) / f64::from(parts));
                    moved.advance(&run.curve, &begun);
                    let pull = moved.pull(&run.curve, begun.to);
                    sum = [0, 1].map(|axis| sum[axis] + pull[axis] / f64::from(parts));
                }
                run.step(step);
                largest = largest.max(run.force());
                worst = worst.max(distance(mean, sum) / largest.max(1e-30));
            }
        }
        println!("{name}: {worst:.1e}");
        // the mean is that of exact springs, the forces are those of a polyline
        assert!(worst <= 3e-3, "{name}: {worst:e}");
    }
}

/// A polyline has a vertex where the way turns, and nowhere else.
#[test]
fn a_way_that_sticks_has_a_segment_for_each_direction_however_it_is_divided() {
    for parts in [1, 2, 7, 100, 1000] {
        for angle in [0.0, 0.3, 2.0, 4.0] {
            let mut run = Run::<16>::new();
            for (index, slope) in [0.0, 1e-6, 0.3, 0.999, 0.5].into_iter().enumerate() {
                let shift = 2e-6 * slope;
                let turn: f64 = angle + index as f64;
                run.in_parts((2e-6, [shift * turn.cos(), shift * turn.sin()]), parts);
                assert_eq!(run.stuck.segments(), index + 1, "slope {slope} in {parts} parts at {angle}");
            }
        }
    }
}

/// From the last slide on, only the tension of the springs matters: a large displacement would hide small ones.
#[test]
fn a_contact_that_has_slid_a_kilometre_goes_on_like_one_that_has_slid_a_millimetre() {
    for seed in 0..30 {
        let angle = 0.7 * seed as f64;
        let direction = [angle.cos(), angle.sin()];
        let [mut near, mut far] = [1e-6, 1.0].map(|part| {
            let mut run = Run::<16>::new();
            run.step((1e-5, [0.0; 2]));
            (0..1000).for_each(|_| run.step((0.0, direction.map(|along| along * part))));
            run
        });
        for step in like_the_table(seed, 25).into_iter().skip(1) {
            near.step(step);
            far.step(step);
            let error = distance(near.pull(), far.pull()) / near.force();
            assert!(error <= 1e-9, "seed {seed}: {error:e}");
        }
    }
}

#[test]
fn a_rotated_history_has_the_rotated_force() {
    let mut worst = 0.0_f64;
    for (seed, (_, history)) in (500..560).zip(KINDS.into_iter().cycle()) {
        let (sine, cosine) = (0.1 * seed as f64).sin_cos();
        let rotated = |[x, y]: [f64; 2]| [cosine * x - sine * y, sine * x + cosine * y];
        let (mut run, mut other) = (Run::<16>::new(), Run::<16>::new());
        for (rise, shift) in history(seed, 60) {
            run.step((rise, shift));
            other.step((rise, rotated(shift)));
            if run.indentation > 0.0 {
                worst = worst.max(distance(rotated(run.pull()), other.pull()) / run.force());
            }
        }
    }
    println!("worst difference: {worst:.1e}");
    assert!(worst < 1e-8, "{worst:e}");
}

#[test]
fn damaged_words_are_rejected() {
    let mut run = Run::<16>::new();
    run.step((1e-6, [1e-7, 2e-7]));
    let mut words = Vec::new();
    run.stuck.save(&mut |word| words.push(word));
    let load = |words: &[u64]| PlayOperator::<2, 16>::load(&mut words.iter().copied(), &run.curve);
    assert!(load(&words).is_some());
    assert!(load(&words[1..]).is_none(), "a word is missing");
    for (place, word) in [(0, f64::NAN.to_bits()), (5, 17), (7, f64::INFINITY.to_bits())] {
        let mut damaged = words.clone();
        damaged[place] = word;
        assert!(load(&damaged).is_none(), "word {place}");
    }
}

/// Words that no contact has saved, but whose numbers are finite.
#[test]
fn forged_springs_end_their_steps() {
    let mut random = Random(31);
    for _ in 0..2000 {
        let mut any = || {
            let size = 10f64.powf(40.0 * random.next() - 30.0);
            if random.next() < 0.5 { size } else { -size }
        };
        let mut words: Vec<u64> = (0..PlayOperator::<2, 16>::WORDS).map(|_| any().to_bits()).collect();
        words[5] = (any().abs().to_bits() >> 7) % 17;
        let mut run = Run::<16>::new();
        run.indentation = 1e-5;
        run.stuck = PlayOperator::load(&mut words.into_iter(), &run.curve).expect("finite numbers");
        for step in any_sizes(5, 6) {
            run.divided(step, 2, |run| assert!(run.stuck.segments() <= 16));
        }
        // a new contact has forgotten it
        run.step((-1e-4, [0.0; 2]));
        run.indentation = -1e-6;
        run.step((2e-6, [1e-6, 0.0]));
        assert!(length(run.pull()) <= run.force() * (1.0 + 1e-12));
    }
}
