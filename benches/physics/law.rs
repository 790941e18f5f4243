//! The physics in Rust, without FMI: a step on a branch, a change of branch, every output, the prediction of an impact.

use brinell_contact::impact::{Impact, predict};
use brinell_contact::loading::BigAlabo;
use brinell_contact::unloading::ContactRadius;
use brinell_contact::{Body, History, Loading, Model, Pair, Surface};
use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use std::time::Duration;

type Steel = Model<BigAlabo, ContactRadius>;
type Output = (&'static str, fn(&History, &Steel) -> f64);

/// A step [m] so small that no number of samples leaves the branch, but larger than the rounding error of the sum.
const TINY: f64 = 1e-18;

/// The end of the loading, in yield indentations: beyond `x_p`, so that all four regimes have been passed.
const PEAK: f64 = 200.0;

/// A rigid ball on steel.
fn model() -> Steel {
    let ball = Body { radius: 5e-3, youngs_modulus: f64::INFINITY, poissons_ratio: 0.0 };
    let steel = Body { radius: f64::INFINITY, youngs_modulus: 206e9, poissons_ratio: 0.3 };
    Model {
        pair: Pair::new(&ball, &steel, 300e6).expect("a ball touches a plane in one point"),
        loading: BigAlabo::REFERENCE,
        unloading: ContactRadius,
        surface: Surface::Dented,
    }
}

/// A contact that has followed `increments`, in yield indentations.
fn history(model: &Steel, increments: &[f64]) -> History {
    let unit = model.loading.yield_point(&model.pair).indentation;
    let mut history = History::start(model, 0.0).expect("no gap is in range");
    for increment in increments {
        history.advance(model, increment * unit).expect("the path is in range");
    }
    history
}

/// One contact of each kind.
struct Contacts {
    loading: History,
    unloading: History,
    apart: History,
}

fn contacts(model: &Steel) -> Contacts {
    Contacts {
        loading: history(model, &[PEAK]),
        unloading: history(model, &[PEAK, -10.0]),
        apart: history(model, &[PEAK, -PEAK]),
    }
}

fn step_on_a_branch(criterion: &mut Criterion) {
    let model = model();
    let Contacts { loading, unloading, apart } = contacts(&model);
    let mut group = criterion.benchmark_group("step on a branch");
    for (name, start, increment) in
        [("loading", loading, TINY), ("unloading", unloading, -TINY), ("apart", apart, -TINY)]
    {
        let mut history = start;
        group.bench_function(name, |bencher| {
            bencher.iter(|| {
                history.advance(&model, black_box(increment)).expect("the step is in range");
                history.force()
            });
        });
        assert_eq!(history.regime(), start.regime(), "{name}: the path has left its branch");
    }
}

fn change_of_branch(criterion: &mut Criterion) {
    let model = model();
    let unit = model.loading.yield_point(&model.pair).indentation;
    let Contacts { loading, unloading, apart } = contacts(&model);
    let changes = [
        ("reversal", loading, -unit),
        ("reloading to the loading curve", unloading, PEAK * unit),
        ("separation", unloading, -PEAK * unit),
        ("touch again", apart, (PEAK - 10.0) * unit),
    ];
    let mut group = criterion.benchmark_group("change of branch");
    for (name, start, increment) in changes {
        group.bench_function(name, |bencher| {
            bencher.iter(|| {
                let mut history = black_box(start);
                history.advance(&model, black_box(increment)).expect("the step is in range");
                history
            });
        });
    }
}

fn outputs(criterion: &mut Criterion) {
    const OUTPUTS: [Output; 8] = [
        ("force", |history, _| history.force()),
        ("stiffness", |history, _| history.stiffness()),
        ("residual_indentation", History::residual_indentation),
        ("contact_radius", History::contact_radius),
        ("mean_pressure", History::mean_pressure),
        ("elastic_energy", History::elastic_energy),
        ("dissipated_energy", History::dissipated_energy),
        ("work", History::work),
    ];
    let model = model();
    let Contacts { loading, unloading, .. } = contacts(&model);
    for (name, history) in [("outputs while loading", loading), ("outputs while unloading", unloading)] {
        let mut group = criterion.benchmark_group(name);
        for (name, output) in OUTPUTS {
            group.bench_function(name, |bencher| bencher.iter(|| output(black_box(&history), black_box(&model))));
        }
    }
}

fn prediction(criterion: &mut Criterion) {
    let model = model();
    let impact = Impact { mass: 4.1e-3, speed: 1.0 };
    criterion.bench_function("impact::predict", |bencher| {
        bencher.iter(|| predict(black_box(&model), black_box(&impact)).expect("the impact is in range"));
    });
}

criterion_group! {
    name = law;
    config = Criterion::default().warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_millis(700));
    targets = step_on_a_branch, change_of_branch, outputs, prediction
}
criterion_main!(law);
