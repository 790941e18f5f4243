//! A call of the C interface, and random ones.

use crate::arithmetic::MODES;
use crate::face::Face;
use fastrand::Rng;

/// Number of instances and states that a script uses at the same time.
pub const INSTANCES: usize = 2;
pub const STATES: usize = 3;

/// A call in a script. Instances and states are indices; calls on an empty index are skipped.
#[derive(Clone, Debug)]
pub enum Call {
    Instantiate {
        at: usize,
        wrong: Option<Wrong>,
        logging: bool,
    },
    Free {
        at: usize,
    },
    Setup {
        at: usize,
        start: f64,
        stop: Option<f64>,
        tolerance: Option<f64>,
    },
    Simple {
        at: usize,
        which: Simple,
    },
    Get {
        at: usize,
        kind: Kind,
        references: Vec<u32>,
        null: bool,
    },
    Set {
        at: usize,
        kind: Kind,
        references: Vec<u32>,
        values: Vec<f64>,
        null: bool,
    },
    InputDerivatives {
        at: usize,
        references: Vec<u32>,
        orders: Vec<i32>,
        values: Vec<f64>,
    },
    OutputDerivatives {
        at: usize,
        references: Vec<u32>,
        orders: Vec<i32>,
    },
    Directional {
        at: usize,
        unknowns: Vec<u32>,
        knowns: Vec<u32>,
        direction: f64,
    },
    Step {
        at: usize,
        late: f64,
        step: f64,
    },
    Save {
        at: usize,
        state: usize,
    },
    Restore {
        at: usize,
        state: usize,
    },
    FreeState {
        at: usize,
        state: usize,
    },
    Serialize {
        at: usize,
        state: usize,
        short_by: usize,
    },
    /// The bytes of the last serialized state; `flip` is a bit to change.
    Deserialize {
        at: usize,
        state: usize,
        flip: Option<usize>,
        length: Option<usize>,
    },
    Status {
        at: usize,
        which: u8,
        kind: i32,
    },
    Log {
        at: usize,
        on: bool,
        categories: Vec<&'static str>,
    },
    /// Not a call of the standard: the host changes the mode of its arithmetic, or back to that of a new process.
    Arithmetic {
        mode: u32,
    },
    /// Not a call of the standard: a step, made whole and in parts from the same state, which must end at the same
    /// values.
    Split {
        at: usize,
        step: f64,
        parts: u32,
    },
}

/// The errors in the arguments of fmi2Instantiate.
#[derive(Clone, Copy, Debug)]
pub enum Wrong {
    NoName,
    EmptyName,
    NoGuid,
    Guid,
    Type,
    NoCallbacks,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Simple {
    Enter,
    Exit,
    Terminate,
    Reset,
    Cancel,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    Real,
    Integer,
    Boolean,
    String,
}

/// A random one of `items`.
fn one<T: Copy>(random: &mut Rng, items: &[T]) -> T {
    items[random.usize(..items.len())]
}

/// A number between `low` and `high` with a uniform logarithm.
fn logarithmic(random: &mut Rng, low: f64, high: f64) -> f64 {
    low * (high / low).powf(random.f64())
}

/// A number that no importer should pass.
fn hostile(random: &mut Rng) -> f64 {
    match random.u8(..8) {
        0 => f64::NAN,
        1 => f64::INFINITY,
        2 => f64::NEG_INFINITY,
        3 => one(random, &[0.0, -0.0, f64::MIN_POSITIVE, 5e-324, -5e-324, f64::EPSILON]),
        4 => one(random, &[1e300, -1e300, f64::MAX, f64::MIN]),
        _ => {
            // to the ends of the numbers
            let size = 2f64.powf(2098.0 * random.f64() - 1074.0);
            if random.bool() { size } else { -size }
        }
    }
}

/// A plausible rate of indentation [m/s].
fn rate(random: &mut Rng) -> f64 {
    let size = logarithmic(random, 1e-6, 1e2);
    match random.u8(..10) {
        0 => 0.0,
        1..6 => size,
        _ => -size,
    }
}

/// A plausible step [s].
fn step(random: &mut Rng) -> f64 {
    logarithmic(random, 1e-12, 1e-2)
}

/// Value references: mostly of the requested kind, sometimes of others or unknown, and sometimes repeated.
fn references(random: &mut Rng, face: &Face, known: &[u32], most: usize) -> Vec<u32> {
    let count = random.usize(..=most);
    let any = |random: &mut Rng| match random.u8(..20) {
        0 => random.u32(..),
        1 => random.u32(..2 * face.largest_reference() + 4),
        _ if known.is_empty() => 0,
        _ => one(random, known),
    };
    (0..count).map(|_| any(random)).collect()
}

/// A random call. Most calls are valid, so scripts get far.
pub fn random_call(random: &mut Rng, face: &Face) -> Call {
    let at = usize::from(random.u8(..8) == 0);
    let state = random.usize(..STATES);
    let kind = one(random, &[Kind::Real, Kind::Real, Kind::Real, Kind::Integer, Kind::Boolean, Kind::String]);
    match random.u8(..100) {
        0 => Call::Free { at },
        1..4 => instantiate(random, at),
        4..6 => Call::Setup {
            at,
            start: if random.bool() { 0.0 } else { hostile(random) },
            stop: random.bool().then(|| hostile(random)),
            tolerance: random.bool().then(|| hostile(random)),
        },
        6..10 => Call::Simple { at, which: one(random, &[Simple::Enter, Simple::Exit]) },
        10..13 => {
            Call::Simple { at, which: one(random, &[Simple::Terminate, Simple::Reset, Simple::Reset, Simple::Cancel]) }
        }
        13..20 => {
            let known = if kind == Kind::Real { &face.reals } else { &face.integers };
            Call::Get { at, kind, references: references(random, face, known, 6), null: random.u8(..20) == 0 }
        }
        20..40 => set(random, face, at, kind),
        40..44 => {
            let references = references(random, face, &face.inputs, 3);
            let orders = references.iter().map(|_| one(random, &[1, 1, 1, 2, 0, 3, -1, i32::MAX])).collect();
            let values = references.iter().map(|_| if random.bool() { 1e4 * rate(random) } else { hostile(random) });
            Call::InputDerivatives { at, orders, values: values.collect(), references }
        }
        44..48 => {
            let references = references(random, face, &face.outputs, 4);
            let orders = references.iter().map(|_| one(random, &[1, 1, 1, 2, 0, -1])).collect();
            Call::OutputDerivatives { at, references, orders }
        }
        48..51 => Call::Directional {
            at,
            unknowns: references(random, face, &face.outputs, 3),
            knowns: references(random, face, &face.inputs, 2),
            direction: if random.bool() { 1.0 } else { hostile(random) },
        },
        51..75 => Call::Step {
            at,
            late: if random.u8(..10) == 0 { hostile(random) } else { 0.0 },
            step: if random.u8(..10) == 0 { hostile(random) } else { step(random) },
        },
        75..79 => Call::Save { at, state },
        79..83 => Call::Restore { at, state },
        83..85 => Call::FreeState { at, state },
        85..88 => Call::Serialize { at, state, short_by: if random.bool() { 0 } else { random.usize(1..9) } },
        88..91 => Call::Deserialize {
            at,
            state,
            flip: random.bool().then(|| random.usize(..)),
            length: (random.u8(..4) == 0).then(|| random.usize(..600)),
        },
        91..93 => Call::Status { at, which: random.u8(..5), kind: one(random, &[0, 1, 2, 3, 4, -1, i32::MIN]) },
        93..95 => Call::Log {
            at,
            on: random.bool(),
            categories: (0..random.usize(..3)).map(|_| one(random, CATEGORIES)).collect(),
        },
        _ => Call::Split { at, step: step(random), parts: one(random, &[2, 3, 7, 50]) },
    }
}

/// Valid and unknown log categories.
const CATEGORIES: &[&str] =
    &["logStatusWarning", "logStatusError", "logStatusDiscard", "logAll", "", "%s%n", "Größe", "# %d #"];

fn instantiate(random: &mut Rng, at: usize) -> Call {
    let wrongs = [Wrong::NoName, Wrong::EmptyName, Wrong::NoGuid, Wrong::Guid, Wrong::Type, Wrong::NoCallbacks];
    let wrong = (random.u8(..3) == 0).then(|| one(random, &wrongs));
    Call::Instantiate { at, wrong, logging: random.bool() }
}

fn set(random: &mut Rng, face: &Face, at: usize, kind: Kind) -> Call {
    let any = random.u8(..8);
    let references = match any {
        0 => references(random, face, &face.reals, 4),
        1 | 2 => references(random, face, &face.parameters, 2),
        _ => vec![one(random, &face.inputs)],
    };
    let values = references.iter().map(|reference| match random.u8(..10) {
        0 => hostile(random),
        _ => match face.starts.get(reference) {
            Some(start) if *start != 0.0 => start * logarithmic(random, 0.5, 2.0),
            _ => rate(random),
        },
    });
    let values = values.collect();
    let kind = if any == 0 { kind } else { Kind::Real };
    Call::Set { at, kind, references, values, null: random.u8(..30) == 0 }
}

/// The script with this number; it begins with an instance that is ready to step.
pub fn script(seed: u64, face: &Face, length: usize) -> Vec<Call> {
    let mut random = Rng::with_seed(seed);
    let begin = [
        Call::Instantiate { at: 0, wrong: None, logging: random.bool() },
        Call::Setup { at: 0, start: 0.0, stop: None, tolerance: None },
        Call::Simple { at: 0, which: Simple::Enter },
        Call::Simple { at: 0, which: Simple::Exit },
    ];
    let begin = begin.into_iter().take(random.usize(1..12));
    let changes_arithmetic = random.u8(..4) == 0;
    let any = |_| match changes_arithmetic && random.u8(..8) == 0 {
        true => Call::Arithmetic { mode: random.choice(MODES).copied().filter(|_| random.u8(..4) > 0).unwrap_or(0) },
        false => random_call(&mut random, face),
    };
    begin.chain((0..length).map(any)).collect()
}
