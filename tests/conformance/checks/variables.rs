//! Every variable: read and set in every state, at its limits and beyond them.

use crate::checks::order::phase_of;
use crate::face::{Face, Variable};
use crate::importer::{ERROR, Importer, OK, Phase, STEP};

/// The variables to try: all, or some of a unit of many contacts.
pub fn some(face: &Face) -> Vec<&Variable> {
    let most = 48;
    let every = face.variables.len().div_ceil(most).max(1);
    // the last ones are those of the last contact, and the parameters
    let last = face.variables.len().saturating_sub(4);
    face.variables
        .iter()
        .enumerate()
        .filter(|(place, _)| place % every == 0 || *place >= last)
        .map(|(_, v)| v)
        .collect()
}

/// Whether the standard lets this variable be set in this state.
fn may_be_set(variable: &Variable, phase: Phase) -> bool {
    match (&*variable.causality, &*variable.variability, phase) {
        (_, _, Phase::Terminated | Phase::Error) => false,
        ("input", ..) => true,
        ("parameter", "tunable", _) => true,
        ("parameter", "fixed", Phase::Instantiated | Phase::Initialization) => true,
        _ => false,
    }
}

/// A value that the variable may have, other than its start.
fn good(variable: &Variable) -> f64 {
    let start = variable.start.unwrap_or(0.0);
    if start == 0.0 { 1e-9 } else { 1.001 * start }
}

/// Each variable can be set where the standard says so, and nowhere else; what is set is read back.
pub fn setting_in_every_state(face: &Face) {
    for variable in some(face).into_iter().filter(|variable| variable.is_real) {
        for phase in Phase::ALL {
            let i = Importer::at(face, phase);
            let readable = phase != Phase::Instantiated;
            let before = readable.then(|| i.bits());
            let value = good(variable);
            let status = i.set(&[variable.reference], &[value]);
            let what = format!("{} in the state {phase:?}: {:?}", variable.name, i.log);
            if may_be_set(variable, phase) {
                assert_eq!(status, OK, "{what}");
                assert_eq!(phase_of(&i), phase, "{what}");
                if phase == Phase::Instantiated {
                    assert_eq!((i.setup(0.0, None), i.enter()), (OK, OK), "{what}");
                }
                assert_eq!(i.real(variable.reference), value, "{what}");
                // it outlives a parameter that makes the contacts anew
                let parameter =
                    face.variables.iter().find(|other| other.variability == "fixed" && other.name != variable.name);
                if let Some(parameter) = parameter.filter(|_| phase_of(&i) == Phase::Initialization) {
                    assert_eq!(i.set(&[parameter.reference], &[good(parameter)]), OK, "{what}");
                    assert_eq!(i.real(variable.reference), value, "{what}, {}", parameter.name);
                }
            } else {
                assert_eq!((status, i.messages().len()), (ERROR, 1), "{what}");
                assert_eq!(phase_of(&i), Phase::Error, "{what}");
                assert!(before.is_none_or(|before| i.bits() == before), "{what}");
            }
        }
    }
}

/// Values at the limits are accepted; the next number beyond, NaN and infinity are refused and change nothing.
pub fn limits(face: &Face) {
    let settable = |variable: &&Variable| may_be_set(variable, Phase::Initialization);
    for variable in some(face).into_iter().filter(settable) {
        let (low, high) = (variable.minimum, variable.maximum);
        for edge in [low, high].into_iter().flatten() {
            let i = Importer::at(face, Phase::Initialization);
            assert_eq!(i.set(&[variable.reference], &[edge]), OK, "{} = {edge}: {:?}", variable.name, i.log);
            assert_eq!(i.real(variable.reference), edge, "{}", variable.name);
            goes_on(i, &format!("{} = {edge}", variable.name));
        }
        let beyond = [low.map(f64::next_down), high.map(f64::next_up), Some(f64::NAN)];
        let infinite = [Some(f64::INFINITY), Some(f64::NEG_INFINITY)];
        for value in beyond.into_iter().chain(infinite).flatten() {
            let i = Importer::at(face, Phase::Initialization);
            let before = i.bits();
            assert_eq!(i.set(&[variable.reference], &[value]), ERROR, "{} = {value}", variable.name);
            let messages = i.messages();
            let last = variable.name.rsplit(['.', ']']).next().expect("text has a last part");
            let named = messages.len() == 1 && messages[0].text.contains(last.trim_start_matches('.'));
            assert!(named, "{} = {value}: {messages:?}", variable.name);
            assert_eq!(i.bits(), before, "{} = {value}", variable.name);
        }
        // inverse masses must fit together
        if variable.name.starts_with("inverse_mass") {
            continue;
        }
        // numbers that are odd and harmless
        for value in [0.0, -0.0, 5e-324, -5e-324, f64::MIN_POSITIVE] {
            let in_range = low.is_none_or(|low| value >= low) && high.is_none_or(|high| value <= high);
            if in_range {
                let mut i = Importer::at(face, Phase::Initialization);
                assert_eq!(i.set(&[variable.reference], &[value]), OK, "{} = {value}: {:?}", variable.name, i.log);
                if i.exit() == OK {
                    assert_eq!(i.step(0.0, STEP), OK, "{} = {value}: {:?}", variable.name, i.log);
                    i.time = STEP;
                    i.bits();
                }
            }
        }
    }
}

/// Values are finite until a step is refused, because the contact is as wide as its body.
fn goes_on(mut i: Importer, what: &str) {
    if i.exit() != OK {
        return;
    }
    for rate in [1e-3, -2e-3, 1.0] {
        let rates = vec![rate; i.face.rates.len()];
        if i.set(&i.face.rates, &rates) != OK || i.step(i.time, STEP) != OK {
            return assert!(!i.messages().is_empty(), "{what}: refused without a word");
        }
        i.time += STEP;
        i.bits();
    }
}

/// The start values of the model description are those of the library, to the last bit.
pub fn start_values(face: &Face) {
    let i = Importer::at(face, Phase::Initialization);
    for variable in &face.variables {
        let Some(start) = variable.start else { continue };
        if variable.is_real {
            assert_eq!(i.real(variable.reference).to_bits(), start.to_bits(), "{}", variable.name);
        }
    }
    for (place, output) in face.outputs.iter().enumerate() {
        assert!(i.real(*output).is_finite(), "output {place}");
    }
}

/// Enormous but allowed inputs give finite outputs, or are refused: all over the shortest steps, which cost little, of the others one of
/// `every`, with the one at `first`. With friction in two directions, some take a second.
pub fn enormous_inputs(face: &Face, first: usize, every: usize) {
    const RATES: [f64; 11] = [1e3, 1e9, 1e30, 1e40, -1e9, -1e40, 1e200, f64::MAX, f64::MIN, 1e-300, -5e-324];
    const STEPS: [f64; 8] = [5e-324, 1e-310, 1e-300, 1e-50, 1e-15, 1e-6, 1.0, 1e6];
    let all = RATES.into_iter().flat_map(|rate| STEPS.map(|step| (rate, step)));
    let is_chosen = |(place, (_, step)): &(usize, (f64, f64))| *step <= 1e-50 || place % every == first;
    for (_, (rate, step)) in all.enumerate().filter(is_chosen) {
        let i = Importer::at(face, Phase::StepComplete);
        let input = face.inputs[0];
        if i.set(&[input], &[rate]) == OK && i.step(i.time, step) == OK {
            assert_eq!(i.real_status(2).1, i.time + step, "{rate} for {step}");
        }
        // refused or not, every value is finite
        i.bits();
    }
}

/// Inverse masses of no bodies are refused: with one coupling larger than the inverse masses of the two contacts allow.
pub fn inverse_masses(face: &Face) {
    let input = |row: usize, column: usize| {
        let name = format!("inverse_mass[{row},{column}]");
        face.variables.iter().find(|variable| variable.name == name).map(|variable| variable.reference)
    };
    let diagonal: Vec<u32> = (1..).map_while(|row| input(row, row)).collect();
    for row in 1..diagonal.len() {
        let coupling = input(row, row + 1).expect("a matrix has its entries");
        let mut i = Importer::at(face, Phase::StepComplete);
        let most = (i.real(diagonal[row - 1]) * i.real(diagonal[row])).sqrt();
        for (factor, status) in [(0.99, OK), (-0.99, OK), (1.01, ERROR)] {
            assert_eq!(i.set(&[coupling], &[factor * most]), OK, "{:?}", i.log);
            assert_eq!(i.step(i.time, STEP), status, "{factor} of the most: {:?}", i.log);
            i.time += STEP;
        }
    }
}
