//! Contacts that share bodies: the whole event of a cradle of balls that touch, in one step.

use brinell_contact::loading::{self, Hertz};
use brinell_contact::shared::{InverseMasses, SharedContact, Work, follow};
use brinell_contact::tangential::{Friction, PlaneContact, FrictionalContact, FrictionalModel};
use brinell_contact::unloading::{self, ContactRadius};
use brinell_contact::{Body, Contact, History, Loading, Model, Pair, Surface, Unloading};
use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use std::time::Duration;

/// Mass of a ball [kg].
const MASS: f64 = 0.033;

/// Inverse masses of `count` contacts between balls in a row.
fn row_of_balls(count: usize) -> Vec<f64> {
    let entry = |row: usize, column: usize| match column - row {
        0 => 2.0 / MASS,
        1 => -1.0 / MASS,
        _ => 0.0,
    };
    (0..count).flat_map(|row| (row..count).map(move |column| entry(row, column))).collect()
}

/// Times the event of a cradle with this model for several numbers of contacts, and prints how many evaluations it takes.
fn cradles<L: Loading, U: Unloading>(criterion: &mut Criterion, name: &str, model: &Model<L, U>, counts: &[usize]) {
    let mut group = criterion.benchmark_group(format!("cradle, {name}"));
    for &count in counts {
        let entries = row_of_balls(count);
        let masses = InverseMasses::new(count, &entries).expect("a triangle");
        let start = vec![History::start(model, 0.0).expect("no gap is in range"); count];
        let mut work: Vec<Work<History>> = start.iter().map(|&contact| Work::new(contact)).collect();
        let accelerations = vec![0.0; count];
        // the wave needs about 11 us from ball to ball
        let step = 1e-4 + 12e-6 * count as f64;
        let mut event = || {
            let (mut contacts, mut rates) = (start.clone(), vec![0.0; count]);
            rates[0] = 1.0;
            let masses = black_box(&masses);
            follow(&mut contacts, |_| model, masses, &accelerations, &mut rates, &mut work, step).expect("a motion")
        };
        println!("{name}, {count} contacts: {} evaluations", event().evaluations);
        group.bench_function(format!("{count} contacts"), |bencher| bencher.iter(&mut event));
    }
    group.finish();
}

/// Times a box that hits the ground with four feet at once, sliding, in so many directions.
fn feet<C, L, U>(criterion: &mut Criterion, name: &str, model: &FrictionalModel<L, U>)
where
    L: Loading + Copy,
    U: Unloading + Copy,
    C: Contact<FrictionalModel<L, U>> + SharedContact<FrictionalModel<L, U>>,
{
    let (mass, rows) = (0.3, 4 * (1 + <C as Contact<FrictionalModel<L, U>>>::DIRECTIONS));
    // the box does not turn, but its feet are apart
    let entry = |row: usize, column: usize| match (row / 4 == column / 4, row == column) {
        (true, true) => 3.0 / mass,
        (true, false) => 1.0 / mass,
        _ => 0.0,
    };
    let entries: Vec<f64> = (0..rows).flat_map(|row| (row..rows).map(move |column| entry(row, column))).collect();
    let masses = InverseMasses::new(rows, &entries).expect("a triangle");
    let start = vec![C::start(model, 0.0).expect("no gap is in range"); 4];
    let mut work: Vec<Work<C>> = start.iter().map(|&contact| Work::new(contact)).collect();
    let accelerations = vec![0.0; rows];
    let mut event = || {
        let (mut contacts, mut rates) = (start.clone(), vec![0.2; rows]);
        rates[..4].copy_from_slice(&[0.3, 0.29, 0.28, 0.27]);
        let masses = black_box(&masses);
        follow(&mut contacts, |_| model, masses, &accelerations, &mut rates, &mut work, 1e-3).expect("a motion")
    };
    println!("{name}: {} evaluations", event().evaluations);
    criterion.bench_function(&format!("four feet, {name}"), |bencher| bencher.iter(&mut event));
}

fn shared(criterion: &mut Criterion) {
    let ball = Body { radius: 1e-2, youngs_modulus: 206e9, poissons_ratio: 0.3 };
    let pair = Pair::new(&ball, &ball, 300e6).expect("two balls touch in one point");
    let surface = Surface::Dented;
    let hertz = Model { pair, loading: Hertz, unloading: ContactRadius, surface };
    cradles(criterion, "hertz", &hertz, &[1, 2, 4, 16, 64]);
    let (loading, unloading) = (loading::Brinell::REFERENCE, unloading::Brinell::REFERENCE);
    // more contacts would take more evaluations than a step may
    let brinell = Model { pair, loading, unloading, surface };
    cradles(criterion, "brinell", &brinell, &[1, 2, 4, 16]);
    let friction = Friction::between(&ball, &ball, pair.modulus, 0.3);
    let frictional = FrictionalModel { normal: hertz, friction, loss: () };
    feet::<FrictionalContact<16>, _, _>(criterion, "hertz, one direction", &frictional);
    feet::<PlaneContact<16>, _, _>(criterion, "hertz, two directions", &frictional);
    let frictional = FrictionalModel { normal: brinell, friction, loss: () };
    feet::<FrictionalContact<16>, _, _>(criterion, "brinell, one direction", &frictional);
    feet::<PlaneContact<16>, _, _>(criterion, "brinell, two directions", &frictional);
}

criterion_group! {
    name = benches;
    config = Criterion::default().warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_millis(700));
    targets = shared
}
criterion_main!(benches);
