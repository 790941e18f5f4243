//! The work of a step, measured without a clock as the number of evaluations of the law. It reveals a slowdown on any machine.

use crate::physics::{Random, all_models, mild, on_grid, random_bodies, unit};
use brinell_contact::loading::{self, BigAlabo};
use brinell_contact::material::YieldPoint;
use brinell_contact::unloading::{self, ContactRadius, Guarded};
use brinell_contact::{Contact, History, Loading, Model, Pair, Peak, Regime, Segment, Surface, Unloading};
use std::cell::Cell;
use std::f64::consts::TAU;

/// Numbers of evaluations of a law.
#[derive(Debug, Default)]
struct Counters {
    yield_points: Cell<u32>,
    /// Of the loading curve.
    branches: Cell<u32>,
    radii: Cell<u32>,
    /// From the loading curve back.
    paths: Cell<u32>,
}

impl Counters {
    fn add(counter: &Cell<u32>) {
        counter.set(counter.get() + 1);
    }

    /// Yield points, branches, radii and paths since the last call.
    fn take(&self) -> [u32; 4] {
        [self.yield_points.take(), self.branches.take(), self.radii.take(), self.paths.take()]
    }
}

/// The laws of the default scene, with counters.
#[derive(Clone, Copy)]
struct Counted<'a, Law> {
    law: Law,
    counters: &'a Counters,
}

impl<Law: Loading> Loading for Counted<'_, Law> {
    fn yield_point(&self, pair: &Pair) -> YieldPoint {
        Counters::add(&self.counters.yield_points);
        self.law.yield_point(pair)
    }

    fn segment(&self, pair: &Pair, indentation: f64) -> Segment {
        Counters::add(&self.counters.branches);
        self.law.segment(pair, indentation)
    }

    fn work(&self, pair: &Pair, indentation: f64) -> f64 {
        self.law.work(pair, indentation)
    }

    fn contact_radius(&self, pair: &Pair, indentation: f64) -> f64 {
        Counters::add(&self.counters.radii);
        self.law.contact_radius(pair, indentation)
    }

    fn regime(&self, pair: &Pair, indentation: f64) -> Regime {
        self.law.regime(pair, indentation)
    }

    fn branch(&self, pair: &Pair, point: &YieldPoint, indentation: f64) -> (Segment, Regime) {
        Counters::add(&self.counters.branches);
        self.law.branch(pair, point, indentation)
    }

    fn radius_at(&self, pair: &Pair, point: &YieldPoint, indentation: f64, force: f64) -> f64 {
        Counters::add(&self.counters.radii);
        self.law.radius_at(pair, point, indentation, force)
    }
}

impl<Law: Unloading> Unloading for Counted<'_, Law> {
    fn path(&self, pair: &Pair, peak: &Peak) -> Segment {
        Counters::add(&self.counters.paths);
        self.law.path(pair, peak)
    }
}

type CountedModel<'a> = Model<Counted<'a, BigAlabo>, Counted<'a, ContactRadius>>;

fn counted(counters: &Counters) -> CountedModel<'_> {
    Model {
        pair: mild(),
        loading: Counted { law: BigAlabo::REFERENCE, counters },
        unloading: Counted { law: ContactRadius, counters },
        surface: Surface::Dented,
    }
}

/// Moves `history` by `increment` [m] like an FMU: on its branch if possible, otherwise to the next one. Returns whether it
/// stayed.
fn step<L: Loading + Copy, U: Unloading + Copy>(
    history: &mut History,
    model: &Model<L, U>,
    point: &YieldPoint,
    increment: f64,
) -> bool {
    let short = Contact::<Model<L, U>>::short_step(history, increment);
    if !short {
        history.step_held(increment, 1.0, point, || *model).expect("within range");
    }
    short
}

#[test]
fn a_change_of_branch_asks_the_law_no_more_than_it_must() {
    let counters = Counters::default();
    let model = counted(&counters);
    let point = model.yield_point();
    let mut history = History::start(&model, 0.0).expect("within range");
    counters.take();
    // in yield indentations, with the numbers of evaluations of yield point, branch, radius and path
    let turns: [(&str, f64, [u32; 4]); 12] = [
        ("first touch", 0.5, [0, 1, 0, 0]),
        ("back before yield", 0.4, [0, 0, 0, 0]),
        ("apart before yield", -0.1, [0, 0, 0, 0]),
        ("touch before yield", 0.3, [0, 1, 0, 0]),
        ("yield", 2.0, [0, 1, 0, 0]),
        ("second region", 20.0, [0, 1, 0, 0]),
        ("fully plastic", 150.0, [0, 1, 0, 0]),
        ("on the same branch", 151.0, [0, 0, 0, 0]),
        ("reversal", 149.0, [0, 0, 1, 1]),
        ("separation", 1.0, [0, 0, 0, 0]),
        ("touch again", 148.0, [0, 0, 0, 0]),
        ("to the loading curve", 160.0, [0, 1, 0, 0]),
    ];
    for (name, turn, expected) in turns {
        let increment = on_grid(turn) - history.indentation();
        step(&mut history, &model, &point, increment);
        assert_eq!(counters.take(), expected, "{name}");
    }
}

/// Increments of cycles of increasing amplitude, from elastic to 200 yield indentations, each with partial unloading and
/// reloading [m].
fn cycles(steps_per_cycle: u32) -> impl Iterator<Item = f64> {
    const STEPS: u32 = 8192;
    let cycles = STEPS / steps_per_cycle;
    let unit = unit(&mild()).indentation;
    (0..STEPS).map(move |step| {
        let cycle = f64::from(step / steps_per_cycle);
        let peak = 0.5 * 400f64.powf(cycle / f64::from(cycles - 1));
        let phase = TAU * (f64::from(step % steps_per_cycle) + 0.5) / f64::from(steps_per_cycle);
        peak * unit / 3.0 * (phase.sin() + 1.5 * (3.0 * phase).sin()) * TAU / f64::from(steps_per_cycle)
    })
}

#[test]
fn few_steps_of_a_cycle_ask_the_law() {
    // steps that leave their branch, and the numbers of evaluations of yield point, branch, radius and path
    let asked = [1024, 128, 64, 32].map(|steps_per_cycle| {
        let counters = Counters::default();
        let model = counted(&counters);
        let point = model.yield_point();
        let mut history = History::start(&model, 0.0).expect("within range");
        counters.take();
        let left = cycles(steps_per_cycle).filter(|&increment| !step(&mut history, &model, &point, increment)).count();
        let [yield_points, branches, radii, paths] = counters.take();
        [left as u32, yield_points, branches, radii, paths]
    });
    assert_eq!(asked, [[48, 0, 19, 13, 13], [274, 0, 75, 56, 56], [517, 0, 131, 113, 113], [1027, 0, 260, 226, 226]]);
}

/// The next branch found from the present branch equals the one found from scratch, bit for bit.
fn check_next_branches<L: Loading + Copy, U: Unloading + Copy>(name: &str, dented: Model<L, U>) {
    let mut random = Random(12);
    for model in [dented, Model { surface: Surface::Fresh, ..dented }] {
        let (point, unit) = (model.yield_point(), unit(&model.pair).indentation);
        for _ in 0..40 {
            let mut known = History::start(&model, 0.0).expect("within range");
            let mut searched = known;
            let scale = unit * libm::pow(10.0, 4.0 * random.next() - 2.0);
            for number in 0..60 {
                // sometimes to a corner, to the surface, and to the end of the dent
                let part = libm::pow(10.0, -4.0 * random.next());
                let increment = match number % 7 {
                    3 => known.max_indentation() - known.indentation(),
                    4 => known.residual_indentation(&model) - known.indentation(),
                    5 => -known.indentation(),
                    _ => scale * part * (2.0 * random.next() - 1.0),
                };
                if number % 3 == 0 {
                    // a step that may stay on its branch
                    known.step_held(increment, 1.0, &point, || model).expect("within range");
                    searched.advance(&model, increment).expect("within range");
                    assert_eq!(known, searched, "{name}, {:?}: {increment:e}", model.surface);
                    continue;
                }
                step(&mut known, &model, &point, increment);
                searched.advance(&model, increment).expect("within range");
                assert_eq!(known, searched, "{name}, {:?}: {increment:e}", model.surface);
            }
        }
    }
}

#[test]
fn the_next_branch_is_the_one_that_the_law_has() {
    for (name, model) in all_models(mild()) {
        check_next_branches(&name, model);
    }
}

/// As compiled for FMUs: the compiler then knows that paths are segments.
#[test]
fn the_next_branch_of_laws_with_segments_is_the_one_that_the_law_has() {
    fn check<L: Loading + Copy, U: Unloading + Copy>(name: &str, loading: L, unloading: U) {
        let mut random = Random(3);
        for pair in [mild(), random_bodies(&mut random), random_bodies(&mut random)] {
            check_next_branches(name, Model { pair, loading, unloading, surface: Surface::Dented });
        }
    }
    check("default scene", loading::BigAlabo::REFERENCE, unloading::ContactRadius);
    check("deformed radius", loading::BigAlabo::REFERENCE, unloading::DeformedRadius::REFERENCE);
    check("guarded", loading::BigAlabo::REFERENCE, Guarded(unloading::DeformedRadius::REFERENCE));
    check("brinell", loading::Brinell::REFERENCE, unloading::Brinell::REFERENCE);
    check("hertz", loading::Hertz, unloading::ContactRadius);
    check("stronge", loading::Stronge::REFERENCE, unloading::OriginalRadius);
    check("thornton", loading::Thornton::REFERENCE, unloading::Thornton);
    check("johnson", loading::Johnson::REFERENCE, unloading::ContactRadius);
    check("yigit-christoforou", loading::YigitChristoforou::REFERENCE, unloading::HertzShift);
    check("walton-braun", loading::WaltonBraun::REFERENCE, unloading::WaltonBraun::REFERENCE);
    check("luding", loading::Luding::REFERENCE, unloading::Luding::REFERENCE);
    check("power", loading::Power::REFERENCE, unloading::ContactRadius);
    check("kogut-etsion", loading::KogutEtsion::REFERENCE, unloading::Etsion::REFERENCE);
}
