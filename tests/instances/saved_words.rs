//! Every word of a saved state matters: a restored instance shows what the saved one has shown, at once and later, and another
//! word in any place shows, or is refused.

use crate::physics::{Random, mild};
use crate::scenes::{
    Choice, Chosen, Damped, DampedMassive, Elastoplastic, Frictional, FrictionalPlane, Held, Lossy, LossyMassive,
    Massive, OUTPUTS, Rated, choose, frictions, outputs, ready, set_rate, words,
};
use crate::{LOSSES, some_pairings};
use brinell_contact::damped::{AnyDamped, Damped as _};
use brinell_contact::losses::{Form, Loss};
use brinell_contact::{Contact, Surface};
use brinell_fmu::instance::{Instance, Phase};
use brinell_fmu::scene::{Absent, Coupled, Coupling, Presence, Present, Real, Scene, Store};
use brinell_testing::long;

/// Sets all rates of a contact.
fn set<S: Scene>(instance: &mut Instance<S>, contact: usize, rate: f64, [one, two]: [f64; 2]) {
    set_rate(instance, contact, rate);
    let both = [(Real::TangentialRate, one), (Real::SecondTangentialRate, two)];
    for (input, rate) in both.into_iter().take(S::Contact::DIRECTIONS) {
        instance.set_real((input, contact), rate);
    }
}

/// A saved state, and what a test knows of its past.
struct State {
    words: Vec<u64>,
    /// What the instance shows.
    shown: Vec<u64>,
    /// The rates that an importer with the other order of execution, and one that applies no force, would give next, if the unit moves
    /// the bodies [m/s].
    wrong: [Vec<f64>; 2],
}

impl State {
    fn of<S: Scene>(instance: &Instance<S>) -> State {
        State {
            words: words(instance),
            shown: shown(instance),
            wrong: [vec![0.1; S::contacts()], vec![0.1; S::contacts()]],
        }
    }
}

/// Whether the unit moves the bodies.
fn moves<S: Scene>() -> bool {
    <S::Coupling as Coupling>::Ending::IS_PRESENT
}

/// States before the first step: of bodies that don't fit together, and in Initialization Mode.
fn first_states<S: Scene>() -> [State; 2] {
    let mut instance = Instance::<S>::new().expect("the bodies fit");
    let set = |instance: &mut Instance<S>, index: usize, value: f64| {
        instance.set_real((Real::Parameter(index), 0), value);
        instance.parameters_are_set();
    };
    set(&mut instance, 2, -1e-6);
    set(&mut instance, 0, 2e3);
    let unfit = State::of(&instance);
    set(&mut instance, 0, 5e-3);
    instance.set_experiment(0.0, None).expect("zero is a time");
    instance.enter_initialization().expect("there is a start time");
    [unfit, State::of(&instance)]
}

/// States of many kinds: before the first step, touched, dented, with long lists of springs, with derivatives of the inputs,
/// apart again.
fn states<S: Scene>() -> Vec<State> {
    let mut states = Vec::from(first_states::<S>());
    for (seed, (decay, alternates)) in
        [(0.8, false), (0.8, false), (0.8, false), (0.9, true), (0.95, true)].into_iter().enumerate()
    {
        let (mut random, mut instance) = (Random(seed as u64), ready::<S>());
        let mut step = |instance: &mut Instance<S>, size: f64, curved: bool| {
            for contact in 0..S::contacts() {
                let mut any = || size.abs() * (2.0 * random.next() - 1.0);
                match alternates {
                    true => set(instance, contact, 0.001 * any(), [size, 0.5 * size]),
                    false => set(instance, contact, 0.1 * any(), [any(), any()]),
                }
                if S::has_input(Real::ExternalAcceleration) {
                    instance.set_real((Real::ExternalAcceleration, contact), any());
                }
                let inputs = [Real::IndentationRate, Real::TangentialRate, Real::SecondTangentialRate];
                for input in inputs.into_iter().take(1 + S::Contact::DIRECTIONS).filter(|_| curved) {
                    for order in 1..=Instance::<S>::input_order() {
                        if instance.check_input_derivative((input, contact), order, 1.0).is_ok() {
                            instance.set_input_derivative((input, contact), order, 1e5 * any());
                        }
                    }
                }
            }
            let (time, length) = (instance.time(), 1e-7);
            let force = |instance: &Instance<S>, contact| instance.real((Real::MeanForce, contact));
            let before: Vec<f64> = (0..S::contacts()).map(|contact| force(instance, contact)).collect();
            instance.do_step(time, length).expect("within the range of the law");
            let is_parallel = <S::Coupling as Coupling>::Account::IS_PRESENT;
            let speeds = before.into_iter().enumerate().filter(|_| moves::<S>()).map(|(contact, before)| {
                let [rate, mass, acceleration] =
                    [Real::IndentationRate, Real::EffectiveMass, Real::ExternalAcceleration]
                        .map(|input| instance.real((input, contact)));
                let mass = if mass.is_nan() { S::impact_mass() } else { mass };
                let acceleration = if acceleration.is_nan() { 0.0 } else { acceleration };
                let applied = if is_parallel { force(instance, contact) } else { before };
                (rate + (acceleration - applied / mass) * length, rate + acceleration * length)
            });
            let (other_order, unmoved): (Vec<f64>, Vec<f64>) = speeds.unzip();
            let state = State::of(instance);
            if moves::<S>() { State { wrong: [other_order, unmoved], ..state } } else { state }
        };
        (0..S::contacts()).for_each(|contact| set(&mut instance, contact, 1.0 + 0.1 * contact as f64, [0.3, -0.2]));
        instance.do_step(0.0, 2e-6).expect("within the range of the law");
        states.push(State::of(&instance));
        // a vibration that dies away leaves a long list of springs
        for turn in 0..40 {
            let state = step(&mut instance, 0.5 * f64::powi(-decay, turn), false);
            if matches!(turn, 0 | 20 | 39) {
                states.push(state);
            }
        }
        states.push(step(&mut instance, 0.1, true));
    }
    states
}

/// Everything that an instance shows.
fn shown<S: Scene>(instance: &Instance<S>) -> Vec<u64> {
    let mut all: Vec<u64> = outputs(instance).iter().map(|number| number.to_bits()).collect();
    for contact in 0..S::contacts() {
        let shown = OUTPUTS.into_iter().filter(|output| {
            S::Momentum::IS_PRESENT || !matches!(output, Real::Impulse | Real::MeanForce | Real::PredictedForce)
        });
        let speed = moves::<S>().then_some(Real::ClosingSpeed);
        all.extend(speed.map(|output| instance.real((output, contact)).to_bits()));
        for output in shown.chain(frictions::<S>()).chain(speed) {
            for order in [1, 2] {
                let derivative = instance.output_derivative((output, contact), order);
                all.push(derivative.map_or(1, f64::to_bits));
            }
        }
    }
    all.push(instance.time().to_bits());
    all
}

/// An instance with these `words`; `None` if it refuses them.
fn loaded<S: Scene>(words: &[u64]) -> Option<Instance<S>> {
    let mut instance = ready::<S>();
    let bytes: Vec<[u8; 8]> = words.iter().map(|word| word.to_le_bytes()).collect();
    instance.load(&bytes).then_some(instance)
}

/// A step at these rates, or those that the instance has, and what it shows then, with its warnings.
fn step<S: Scene>(instance: &mut Instance<S>, rates: Option<&[f64]>, length: f64, all: &mut Vec<u64>) {
    for (contact, &rate) in rates.into_iter().flatten().enumerate() {
        set(instance, contact, rate, [-rate, 0.5 * rate]);
    }
    let time = instance.time();
    all.push(u64::from(instance.do_step(time, length).is_ok()));
    let warned = instance.take_miswired().map(|warning| format!("{warning:?}"));
    all.extend(warned.into_iter().flat_map(String::into_bytes).map(u64::from));
    all.extend(shown(instance));
}

/// What an instance with these `words` shows: at once; in two steps with the inputs that it has and in others, the last of them
/// too long for a stop time; told by importers that apply the force otherwise; and when the bodies part and meet again at
/// the speed of the first impact. `None` if it refuses them.
fn course<S: Scene>(words: &[u64], wrong: &[Vec<f64>; 2]) -> Option<Vec<u64>> {
    let mut instance = loaded::<S>(words)?;
    let mut all = shown(&instance);
    if instance.phase() != Phase::StepComplete {
        if instance.phase() == Phase::Initialization {
            all.push(u64::from(instance.exit_initialization().is_ok()));
        }
        all.extend(shown(&instance));
        return Some(all);
    }
    step(&mut instance, None, 1e-7, &mut all);
    step(&mut instance, None, 1e-7, &mut all);
    let ways = [(-0.2, 2e-7), (0.3, 3e-7), (-2.0, 1e-5), (0.1, 1.0)];
    let slowly = [(-0.7, 1e-6), (-0.7, 1e-6), (-0.7, 1e-6), (0.7, 5e-6)];
    for (mut instance, ways) in [(instance, ways), (loaded::<S>(words)?, slowly)] {
        for (rate, length) in ways {
            step(&mut instance, Some(&vec![rate; S::contacts()]), length, &mut all);
        }
    }
    for contact in (0..S::contacts()).filter(|_| moves::<S>()) {
        for wrong in wrong {
            let mut rates = vec![0.1; S::contacts()];
            rates[contact] = wrong[contact];
            step(&mut loaded::<S>(words)?, Some(&rates), 1e-7, &mut all);
        }
    }
    let mut again = loaded::<S>(words)?;
    if S::has_input(Real::ExternalAcceleration) {
        for contact in 0..S::contacts() {
            again.set_real((Real::ExternalAcceleration, contact), 0.0);
        }
    }
    // not the same to the last bit: a strength that is found anew shows
    let first: Vec<f64> = (0..S::contacts()).map(|contact| (1.0 + 0.1 * contact as f64) * (1.0 + 5e-13)).collect();
    let away = vec![-1.0; S::contacts()];
    // in three flights, a parallel importer pays its debt
    for (rates, length) in [(&away, 1e-4), (&away, 1e-4), (&away, 1e-4), (&first, 3.1e-4)] {
        step(&mut again, Some(rates), length, &mut all);
    }
    Some(all)
}

/// The words of an instance of `S` that don't matter in any state, although they are not the same in all.
fn idle<S: Scene>() -> Vec<usize> {
    let states = states::<S>();
    let course = |words: &[u64], state: &State| course::<S>(words, &state.wrong);
    let expected: Vec<Option<Vec<u64>>> = states.iter().map(|state| course(&state.words, state)).collect();
    let matters = |place: usize| {
        // those first in which the word is in use
        let used = states.iter().zip(&expected).filter(|(state, _)| state.words[place] != 0);
        let unused = states.iter().zip(&expected).filter(|(state, _)| state.words[place] == 0);
        used.chain(unused).any(|(state, expected)| {
            let word = state.words[place];
            let number = f64::from_bits(word);
            let others = [
                0,
                (1.01 * number).to_bits(),
                (-number).to_bits(),
                1e-9f64.to_bits(),
                1.0f64.to_bits(),
                (-1e-6f64).to_bits(),
                word ^ 1,
                word ^ 2,
            ];
            others.into_iter().filter(|&other| other != word).any(|other| {
                let mut changed = state.words.clone();
                changed[place] = other;
                course(&changed, state).is_none_or(|found| Some(&found) != expected.as_ref())
            })
        })
    };
    (0..Instance::<S>::words()).filter(|&place| !matters(place)).collect()
}

/// Runs on from the saved state and from its words: everything shown is the same to the bit, at once and later.
fn comes_back<S: Scene>(name: &str) {
    for State { words, shown: expected, .. } in states::<S>() {
        let found = loaded::<S>(&words).map(|instance| shown(&instance));
        assert_eq!(found, Some(expected), "{name}: at once");
    }
    let mut instance = ready::<S>();
    let mut random = Random(5);
    for step in 0..60 {
        for contact in 0..S::contacts() {
            let mut any = || 2.0 * random.next() - 0.95;
            set(&mut instance, contact, any(), [any(), any()]);
        }
        let time = instance.time();
        instance.do_step(time, 1e-6).expect("within the range of the law");
        let bytes: Vec<[u8; 8]> = words(&instance).iter().map(|word| word.to_le_bytes()).collect();
        let before = shown(&instance);
        let mut other = ready::<S>();
        other.copy(&instance);
        // a step that the saved instance has not made
        let _ = other.do_step(time + 1e-6, 3e-6);
        assert!(other.load(&bytes), "{name}: its own words are refused");
        assert_eq!(shown(&other), before, "{name}: at once, in step {step}");
        if step % 2 == 0 {
            instance = other;
        }
    }
}

/// What is asked of every kind of instance.
trait Claim {
    /// Of a kind whose first contact has these idle words, counted from its state.
    fn of<S: Scene>(&self, name: &str, idle: &[usize]);
}

/// A saved state comes back.
struct ComesBack;

impl Claim for ComesBack {
    fn of<S: Scene>(&self, name: &str, _idle: &[usize]) {
        comes_back::<S>(name);
    }
}

/// Every word matters but the known ones.
struct Matters;

impl Claim for Matters {
    fn of<S: Scene>(&self, name: &str, known: &[usize]) {
        // phase, flags, time, stop time; last step; parameters, radii and moduli, the rate of the first contact
        let first =
            4 + usize::from(S::Prediction::IS_PRESENT) + <S::Values as Store<f64>>::LENGTH + 2 * S::groups() + 1;
        let mut found = idle::<S>();
        found.retain(|place| !ENDS.iter().any(|end| first + end == *place && known.contains(end)));
        let known: Vec<usize> = known.iter().filter(|place| !ENDS.contains(place)).map(|place| first + place).collect();
        assert_eq!(found, known, "{name}: of {} words", Instance::<S>::words());
    }
}

/// With one direction and two of friction: the rates and slopes at the end of a step, which differ from those of the next step
/// only after a step with derivatives, and here there is none.
const ENDS_OF_ONE: [usize; 2] = [67, 68];
const ENDS_OF_TWO: [usize; 4] = [102, 103, 107, 108];

/// The ends of the branch may be idle: a motion that is integrated finds its piece of the law anew.
const ENDS: [usize; 2] = [3, 4];

/// The largest speed since the touch is the scale of a fitted loss, and of nothing else.
fn idle_of(loss: impl Loss) -> Option<usize> {
    (loss.form() != Form::Proportional).then_some(14)
}

/// Two of the pairings in a usual run.
fn pairings() -> impl Iterator<Item = (String, Choice)> {
    let usual = ["brinell with brinell", "luding with luding"];
    some_pairings().into_iter().filter(move |(name, _)| long::is_asked() || usual.contains(&name.as_str()))
}

fn every_elastoplastic_kind(claim: &impl Claim) {
    for (name, choice) in pairings() {
        choose(choice);
        claim.of::<Chosen<Elastoplastic, 1, Absent>>(&name, &[]);
        claim.of::<Chosen<Held<Elastoplastic>, 1, Absent>>(&format!("{name}, held"), &[]);
        claim.of::<Chosen<Elastoplastic, 1, Present>>(&format!("{name}, with momentum"), &[]);
        claim.of::<Chosen<Held<Elastoplastic>, 1, Present>>(&format!("{name}, held, with momentum"), &[]);
        claim.of::<Chosen<Elastoplastic, 2, Present>>(&format!("{name}, two contacts"), &[]);
        claim.of::<Chosen<Massive, 1, Absent>>(&format!("{name}, moved"), &[]);
        claim.of::<Chosen<Massive, 1, Present>>(&format!("{name}, moved, with momentum"), &[]);
        claim.of::<Chosen<Massive<Coupled<Present>>, 1, Present>>(&format!("{name}, parallel"), &[]);
        claim.of::<Chosen<Massive<Coupled<Absent, Present>>, 1, Present>>(&format!("{name}, accelerated"), &[]);
        claim.of::<Chosen<Massive<Coupled<Present, Present, Present>>, 2, Present>>(&format!("{name}, wired"), &[]);
        choose(Choice { surface: Surface::Fresh, ..choice });
        claim.of::<Chosen<Elastoplastic, 1, Present>>(&format!("{name}, fresh"), &[]);
        claim.of::<Chosen<Rated, 1, Present>>(&format!("{name}, rated"), &[]);
        claim
            .of::<Chosen<Rated<Coupled<Present, Present, Present>>, 1, Present>>(&format!("{name}, rated, wired"), &[]);
    }
}

fn every_rough_kind(claim: &impl Claim) {
    // the springs, which have most of the words, are those of any pairing
    for (name, choice) in long::some(pairings(), 2) {
        choose(choice);
        let (one, two) = (format!("{name}, friction"), format!("{name}, friction in two directions"));
        claim.of::<Chosen<Frictional, 1, Present>>(&format!("{one} with momentum"), &[]);
        claim.of::<Chosen<Held<Frictional>, 1, Absent>>(&format!("{one}, held"), &ENDS_OF_ONE);
        claim.of::<Chosen<FrictionalPlane, 1, Present>>(&format!("{two} with momentum"), &[]);
        claim.of::<Chosen<Held<FrictionalPlane>, 1, Absent>>(&format!("{two}, held"), &ENDS_OF_TWO);
        // their words are among those above
        if long::is_asked() {
            claim.of::<Chosen<Frictional<false>, 1, Absent>>(&one, &[]);
            claim.of::<Chosen<FrictionalPlane<false>, 1, Absent>>(&two, &[]);
        }
    }
}

fn every_lossy_kind(claim: &impl Claim) {
    for (name, choice) in pairings() {
        for loss in LOSSES.into_iter().take(3) {
            choose(Choice { loss, ..choice });
            let name = format!("{name}, {loss:?}");
            let ends = ENDS.into_iter().filter(|_| loss.form() == Form::Mobility);
            let own: Vec<usize> = ends.chain(idle_of(loss)).collect();
            let moved: Vec<usize> = ENDS.into_iter().chain(idle_of(loss)).collect();
            claim.of::<Chosen<Lossy, 1, Absent>>(&name, &own);
            claim.of::<Chosen<Lossy, 1, Present>>(&format!("{name}, with momentum"), &own);
            claim.of::<Chosen<LossyMassive, 1, Present>>(&format!("{name}, moved"), &moved);
            claim.of::<Chosen<LossyMassive<Coupled<Present>>, 1, Present>>(&format!("{name}, parallel"), &moved);
        }
    }
}

fn every_damped_kind(claim: &impl Claim) {
    for (name, damped) in AnyDamped::ALL {
        choose(Choice { damped, ..some_pairings()[0].1 });
        let own: Vec<usize> = idle_of(damped.model(mild(), 0.5, 1.0).loss).into_iter().collect();
        let moved: Vec<usize> = ENDS.into_iter().chain(own.clone()).collect();
        claim.of::<Chosen<Damped, 1, Absent>>(name, &own);
        claim.of::<Chosen<Damped, 1, Present>>(&format!("{name}, with momentum"), &own);
        claim.of::<Chosen<DampedMassive, 1, Present>>(&format!("{name}, moved"), &moved);
        claim.of::<Chosen<DampedMassive<Coupled<Present>>, 1, Present>>(&format!("{name}, parallel"), &moved);
    }
}

#[test]
fn a_saved_state_comes_back_to_the_bit() {
    every_elastoplastic_kind(&ComesBack);
    every_rough_kind(&ComesBack);
    every_lossy_kind(&ComesBack);
    every_damped_kind(&ComesBack);
    for (name, choice) in pairings() {
        choose(choice);
        ComesBack.of::<Chosen<Rated, 1, Present>>(&format!("{name}, dented, rated"), &[]);
    }
}

#[test]
fn each_word_of_an_elastoplastic_contact_matters() {
    every_elastoplastic_kind(&Matters);
}

#[test]
fn each_word_of_a_contact_with_friction_matters() {
    every_rough_kind(&Matters);
}

#[test]
fn each_word_of_a_contact_with_a_loss_matters() {
    every_lossy_kind(&Matters);
}

#[test]
fn each_word_of_a_rate_dependent_contact_matters() {
    every_damped_kind(&Matters);
}
