//! Values before the first step: what they depend on, and their derivatives, compared with the values that the FMU shows.

use crate::checks::derivatives::directional;
use crate::checks::order::phase_of;
use crate::face::{Face, Variable};
use crate::importer::{Importer, OK, Phase};
use std::collections::BTreeSet;

/// Indentations at the start [m], before yield and beyond it; apart; and as the scene says.
const GAPS: [Option<f64>; 7] =
    [None, Some(3e-5), Some(-3e-9), Some(-2e-8), Some(-3.3e-7), Some(-1.7e-6), Some(-1.1e-5)];

/// The initial unknowns to try, with their dependencies: all, or some of a unit of many contacts.
fn unknowns(face: &Face) -> impl Iterator<Item = &(usize, Vec<usize>)> {
    let every = face.initial_unknowns.len().div_ceil(40).max(1);
    face.initial_unknowns.iter().step_by(every)
}

/// The places of variables that can be set: all that the unknowns depend on, and the first and last of the others.
fn knowns(face: &Face) -> BTreeSet<usize> {
    let is_known = |place: &usize| face.variables[*place].is_real && face.variables[*place].causality != "output";
    let all: Vec<_> = (0..face.variables.len()).filter(is_known).collect();
    let ends = all.iter().take(12).chain(all.iter().rev().take(12)).copied();
    unknowns(face).flat_map(|(_, dependencies)| dependencies).copied().chain(ends).collect()
}

/// Whether the contact of a unit of one can begin at any gap.
fn has_gap(face: &Face) -> bool {
    face.variables.iter().any(|variable| variable.name == "initial_gap")
}

/// An instance in Initialization Mode whose contacts have this gap [m], if it can be set, and close at `rate` [m/s].
fn begun(face: &Face, gap: Option<f64>, rate: f64) -> Importer<'_> {
    let i = Importer::at(face, Phase::Initialization);
    for variable in face.variables.iter().filter(|variable| variable.name.ends_with("initial_gap")) {
        if let Some(gap) = gap {
            assert_eq!(i.set(&[variable.reference], &[gap]), OK, "{:?}", i.log);
        }
    }
    i.set_rates(rate);
    i
}

fn value(i: &Importer, variable: &Variable) -> f64 {
    if variable.is_real {
        return i.real(variable.reference);
    }
    let mut value = [0];
    assert_eq!(i.get_integers(&[variable.reference], &mut value), OK);
    f64::from(value[0])
}

/// The size of a change of a variable that matters: its value; of one that may be zero, what it is compared with.
fn size(variable: &Variable, value: f64) -> f64 {
    let name = variable.name.rsplit('.').next().unwrap_or_default();
    match name {
        "poissons_ratio" | "coefficient" => 1.0,
        "hardening_modulus" => 1e11,
        "initial_gap" if value == 0.0 => 1e-6,
        _ if value == 0.0 => 1.0,
        _ => value.abs(),
    }
}

/// Whether a variable takes this value.
fn takes(variable: &Variable, value: f64) -> bool {
    variable.minimum.is_none_or(|minimum| value >= minimum) && variable.maximum.is_none_or(|maximum| value <= maximum)
}

/// A value before the first step changes with nothing but its declared dependencies, and the force with each of them somewhere.
pub fn dependencies(face: &Face) {
    // of other outputs, some are constant with some laws
    let is_force = |place: usize| face.variables[place].name == "force" && has_gap(face);
    let of_force = unknowns(face).find(|(unknown, _)| is_force(*unknown));
    let mut idle: BTreeSet<_> = of_force.map(|(_, all)| all.iter().copied().collect()).unwrap_or_default();
    for gap in GAPS {
        for rate in [0.0, 0.3] {
            let i = begun(face, gap, rate);
            for place in knowns(face) {
                let known = &face.variables[place];
                let before = i.real(known.reference);
                let values = || unknowns(face).map(|(unknown, _)| value(&i, &face.variables[*unknown])).collect();
                let old: Vec<f64> = values();
                for change in [1e-3, -1e-3, 0.4, -0.4] {
                    let changed = before + change * size(known, before);
                    if !takes(known, changed) {
                        continue;
                    }
                    assert_eq!(i.set(&[known.reference], &[changed]), OK, "{} = {changed}: {:?}", known.name, i.log);
                    let new: Vec<f64> = values();
                    for ((unknown, declared), (old, new)) in unknowns(face).zip(old.iter().zip(&new)) {
                        let what = format!("{} by {} at {gap:?}, {rate}", face.variables[*unknown].name, known.name);
                        assert!(declared.contains(&place) || old.to_bits() == new.to_bits(), "{what}: {old}, {new}");
                        if old != new && is_force(*unknown) {
                            idle.remove(&place);
                        }
                    }
                    assert_eq!(i.set(&[known.reference], &[before]), OK);
                }
                assert_eq!(values(), old, "after {} was set and set back", known.name);
            }
        }
    }
    let idle: Vec<_> = idle.iter().map(|place| &face.variables[*place].name).collect();
    assert!(idle.is_empty(), "the force is declared to depend on {idle:?}, and never does");
}

/// What the error of a value is compared with: the value. An energy may be a small difference of others.
fn magnitude(i: &Importer, variable: &Variable) -> f64 {
    let is_energy = |variable: &Variable| variable.name.ends_with("energy");
    let others = i.face.variables.iter().filter(|other| is_energy(variable) && is_energy(other));
    value(i, variable).abs() + others.map(|other| value(i, other).abs()).sum::<f64>()
}

/// A difference of the values that the FMU shows, by Richardson's extrapolation of central differences; to one side at a limit.
fn difference(i: &Importer, unknown: &Variable, known: &Variable) -> f64 {
    let before = i.real(known.reference);
    let width = 2e-4 * size(known, before);
    let at = |places: f64| {
        assert_eq!(i.set(&[known.reference], &[before + places * width]), OK, "{:?}", i.log);
        value(i, unknown)
    };
    let (up, down) = (takes(known, before + 2.0 * width), takes(known, before - 2.0 * width));
    let is_gap = known.name.ends_with("initial_gap");
    let points: &[(f64, f64)] = match (up, down) {
        // bodies that just touch: towards the gap
        _ if is_gap && before == 0.0 => &[(0.0, -1.5), (1.0, 2.0), (2.0, -0.5)],
        (true, true) => &[(-2.0, 1.0 / 12.0), (-1.0, -2.0 / 3.0), (1.0, 2.0 / 3.0), (2.0, -1.0 / 12.0)],
        (true, false) => &[(0.0, -11.0 / 6.0), (1.0, 3.0), (2.0, -1.5), (3.0, 1.0 / 3.0)],
        (false, _) => &[(0.0, 11.0 / 6.0), (-1.0, -3.0), (-2.0, 1.5), (-3.0, -1.0 / 3.0)],
    };
    let sum: f64 = points.iter().map(|(places, weight)| weight * at(*places)).sum();
    assert_eq!(i.set(&[known.reference], &[before]), OK);
    sum / width
}

/// In Initialization Mode, every initial unknown has a derivative by each of its dependencies: that of the values that the FMU
/// shows. The instance is as before afterwards.
pub fn derivatives(face: &Face) {
    for gap in GAPS {
        let mut i = begun(face, gap, 0.3);
        for variable in face.variables.iter().filter(|variable| variable.name.ends_with("poissons_ratio")) {
            // the law `brinell` has a corner at 0.3, and where both bodies yield at once
            let ratio = if variable.name.ends_with("impactor.poissons_ratio") { 0.24 } else { 0.27 };
            assert_eq!(i.set(&[variable.reference], &[ratio]), OK);
        }
        for end in [false, true] {
            // also where parameters are at their limits
            for variable in face.variables.iter().filter(|_| end) {
                let limit = match variable.name.rsplit('.').next().unwrap_or_default() {
                    "poissons_ratio" if variable.name.ends_with("impactor.poissons_ratio") => None,
                    "poissons_ratio" | "elastic_restitution" => variable.maximum,
                    "hardening_modulus" | "coefficient" => variable.minimum,
                    _ => None,
                };
                if let Some(limit) = limit {
                    assert_eq!(i.set(&[variable.reference], &[limit]), OK, "{:?}", i.log);
                }
            }
            let bits = i.bits();
            for (place, dependencies) in unknowns(face) {
                let unknown = &face.variables[*place];
                let mut sum = 0.0;
                for known in dependencies.iter().map(|known| &face.variables[*known]) {
                    let what = format!("{} by {} at {gap:?}", unknown.name, known.name);
                    let (status, twice) = directional(&i, unknown.reference, known.reference, 2.0);
                    assert_eq!(status, OK, "{what}: {:?}", i.log);
                    assert_eq!(i.bits(), bits, "after {what}");
                    let expected = if unknown.is_real { 2.0 * difference(&i, unknown, known) } else { 0.0 };
                    let shown = i.real(known.reference);
                    let scale = magnitude(&i, unknown) / size(known, shown);
                    let error = (twice - expected).abs();
                    assert!(error <= 1e-6 * (expected.abs() + scale), "{what}: {twice} instead of {expected}");
                    sum += -1.5 * twice;
                }
                let references: Vec<_> = dependencies.iter().map(|known| face.variables[*known].reference).collect();
                let (directions, mut all) = (vec![-3.0; references.len()], f64::NAN);
                // SAFETY: arrays as long as announced
                let status = unsafe {
                    (i.f().get_directional_derivative)(
                        i.c,
                        &unknown.reference,
                        1,
                        references.as_ptr(),
                        references.len(),
                        directions.as_ptr(),
                        &raw mut all,
                    )
                };
                assert_eq!((status, all), (OK, sum), "{} in all directions", unknown.name);
            }
        }
        assert_eq!(phase_of(&i), Phase::Initialization);
        let bits = i.bits();
        assert_eq!((i.exit(), i.bits()), (OK, bits), "values before the first step");
        i.press(0.1);
    }
}
