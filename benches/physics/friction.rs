//! Oblique impacts of a ball, compared with a normal impact: the cost of a step in sliding, in partial slip, in stick
//! with growth, and with merging of segments in each step. The same in two directions, along one line and while the motion turns.

use brinell_contact::Segment;
use brinell_contact::tangential::{Motion, PlayOperator};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use std::time::Duration;

/// Number of steps in a normalised impact: a mass of 1 at a speed of 1 with `F = 4/3 d^1.5`.
const STEPS: u32 = 500;
/// Duration of that impact divided by the number of steps.
const STEP: f64 = 2.8683 / STEPS as f64;
const SCALE: f64 = 1.4 / 1.7 / 0.1;

fn curve() -> Segment {
    Segment { upper: 1e100, power: 4.0 / 3.0, ..Segment::NOTHING }
}

/// The impact of a ball with the tangential speed `slip`; returns the final speeds.
#[inline(always)]
fn impact<const N: usize>(curve: &Segment, slip: Option<f64>) -> (f64, f64) {
    let mut stuck = PlayOperator::<1, N>::APART;
    let (mut indentation, mut normal, mut tangential) = (0.0, 1.0, slip.unwrap_or(0.0));
    for _ in 0..STEPS {
        let to = indentation + STEP * normal;
        if slip.is_some() {
            stuck.advance(curve, &Motion::straight(indentation, to, [SCALE * STEP * tangential]));
            // the effective tangential mass at the contact point of a solid ball is two sevenths of its mass
            tangential -= 3.5 * STEP * 0.1 * stuck.pull(curve, to)[0];
        }
        indentation = to;
        normal -= STEP * curve.force(indentation);
    }
    (normal, tangential)
}

/// The same in two directions. The ball has this speed along a line, and one across that turns the slip.
#[inline(always)]
fn impact_in_a_plane(curve: &Segment, slip: [f64; 2]) -> [f64; 2] {
    let mut stuck = PlayOperator::<2, 16>::APART;
    let (mut indentation, mut normal, mut tangential) = (0.0, 1.0, slip);
    for step in 0..STEPS {
        let to = indentation + STEP * normal;
        // a ball that is driven around while it turns
        let turn = if slip[1] == 0.0 { 0.0 } else { 0.01 * f64::from(step) };
        let [along, across] = tangential;
        let shift = [along * turn.cos() - across * turn.sin(), along * turn.sin() + across * turn.cos()];
        stuck.advance(curve, &Motion::straight(indentation, to, shift.map(|speed| SCALE * STEP * speed)));
        let pull = stuck.pull(curve, to);
        tangential = [along - 3.5 * STEP * 0.1 * pull[0], across - 3.5 * STEP * 0.1 * pull[1]];
        indentation = to;
        normal -= STEP * curve.force(indentation);
    }
    tangential
}

fn friction(criterion: &mut Criterion) {
    let curve = curve();
    let mut group = criterion.benchmark_group("step of an impact");
    group.throughput(Throughput::Elements(u64::from(STEPS)));
    group.bench_function("normal", |bencher| bencher.iter(|| impact::<16>(black_box(&curve), None)));
    for (name, slip) in [("sliding", 3.0), ("partial slip", 0.4), ("stick and merges", 0.02)] {
        group.bench_function(name, |bencher| bencher.iter(|| impact::<16>(black_box(&curve), Some(black_box(slip)))));
    }
    group.bench_function("stick without merges", |bencher| {
        bencher.iter(|| impact::<512>(black_box(&curve), Some(black_box(0.02))));
    });
    for (name, slip) in [
        ("two directions, sliding along a line", [3.0, 0.0]),
        ("two directions, partial slip along a line", [0.4, 0.0]),
        ("two directions, sliding and turning", [3.0, 1.0]),
        ("two directions, partial slip and turning", [0.4, 0.1]),
    ] {
        group.bench_function(name, |bencher| bencher.iter(|| impact_in_a_plane(black_box(&curve), black_box(slip))));
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default().warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_millis(700));
    targets = friction
}
criterion_main!(benches);
