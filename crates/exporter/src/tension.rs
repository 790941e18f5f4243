//! Tensile tests: the table that a testing machine writes, and the power law `sigma = K eps^n` through it, or through proof stress and
//! tensile strength.

use crate::bisection::border;
use crate::layout::shortened;
use crate::measurement::{self, Choices, MeasuredColumn, Measurement};
use crate::nearest::one_of;
use crate::numbers::{cell, in_message, quantity, significant};
use brinell_contact::material::hardening::PowerLaw;
use std::f64::consts::PI;

/// The relative uncertainty of a flow stress that a tensile test has at this very strain.
const OF_TEST: f64 = 0.03;

/// The relative uncertainty of the power law through proof stress and tensile strength, between the two.
const OF_TWO_NUMBERS: f64 = 0.05;

/// The largest exponent that is allowed \[-\]. Annealed brass has 0.5.
const LARGEST_EXPONENT: f64 = 0.6;

/// The plastic strains of impacts \[-\], for which the power law is taken.
const STRAINS: (f64, f64) = (0.002, 0.1);

/// The lower end of the strains, where the curve reaches ten times as far. Below it there are the knee, and the yield point of steel.
const FROM: f64 = 0.005;

/// Stress over largest stress where the elastic slope is looked for. Annealed metals yield at a quarter.
const ELASTIC: (f64, f64) = (0.02, 0.3);

/// The measured slope over Young's modulus that is believed, with a warning. A strain by the crosshead contains the machine.
const SLOPES: (f64, f64) = (0.3, 5.0);

/// How far a slope may be off Young's modulus, relatively, without a warning.
const OFF: f64 = 0.1;

/// How many points of a curve are kept in each decade of the strain.
const PER_DECADE: f64 = 12.0;

/// The power law of a tensile test.
#[derive(Clone, Debug)]
pub struct Tension {
    pub law: PowerLaw,
    /// The least and the largest plastic strain through which it goes \[-\].
    pub range: (f64, f64),
    /// Relative: one standard deviation \[-\].
    pub uncertainty: f64,
    /// What it goes through, in words.
    pub way: String,
    /// True plastic strain \[-\] and true stress \[Pa\] of the test.
    pub points: Vec<(f64, f64)>,
}

/// The power law through proof stress `Rp0.2` and tensile strength `Rm` \[Pa\] of a metal with this Young's modulus \[Pa\]: through the
/// proof stress at its whole strain, and with the largest load at the strain `n` (Considere).
///
/// # Errors
/// A sentence about numbers that no power law has.
pub fn through_two(proof_stress: f64, tensile_strength: f64, youngs_modulus: f64) -> Result<Tension, String> {
    let ratio = proof_stress / tensile_strength;
    let first = 0.002 + proof_stress / youngs_modulus;
    // it falls from its end at the strain `first` on
    let over = |n: f64| n * (1.0 + libm::log(first / n)) - libm::log(ratio);
    let least = libm::exp(LARGEST_EXPONENT * (1.0 + libm::log(first / LARGEST_EXPONENT)));
    if !(ratio <= 1.0 && ratio >= least && first < LARGEST_EXPONENT) {
        let [proof, strength] = [proof_stress, tensile_strength].map(|stress| quantity(stress, "Pa"));
        return Err(format!(
            "proof_stress = {proof} is {} of tensile_strength = {strength}: allowed is {} to 1",
            cell(ratio, 1.0),
            cell(least, 1.0)
        ));
    }
    let n = border((first, LARGEST_EXPONENT), |n| over(n) <= 0.0);
    let law = PowerLaw { coefficient: tensile_strength * libm::pow(std::f64::consts::E / n, n), exponent: n };
    let true_strength = tensile_strength * libm::exp(n);
    Ok(Tension {
        law,
        range: (0.002, n),
        uncertainty: OF_TWO_NUMBERS,
        way: "power law through proof stress and tensile strength".into(),
        points: vec![(0.002, proof_stress * (1.0 + first)), (n, true_strength)],
    })
}

/// The power law closest to the `curve` of a metal with this Young's modulus \[Pa\], by least squares of the logarithms. If it `corrects`, the
/// compliance of the machine is taken off before.
///
/// # Errors
/// A sentence about a curve that has no such law.
pub fn through_curve(curve: &Curve, youngs_modulus: f64, corrects: bool) -> Result<Tension, String> {
    let corrected = if corrects { Some(curve.corrected(youngs_modulus)?) } else { None };
    let taken_off = corrected.as_ref().map_or(String::new(), |(_, slope)| {
        format!("; the machine's compliance taken off, slope {}", quantity(*slope, "Pa"))
    });
    let curve = corrected.as_ref().map_or(curve, |(curve, _)| curve);
    if let Some(why) = curve.slope_off(youngs_modulus).filter(|(slope, _)| !(SLOPES.0..=SLOPES.1).contains(slope)) {
        return Err(why.1);
    }
    let plastic = |strain: f64, stress: f64| if curve.is_plastic { strain } else { strain - stress / youngs_modulus };
    let all = curve.points.iter().map(|(strain, stress)| (plastic(*strain, *stress), *stress));
    let all: Vec<_> = all.filter(|(strain, _)| *strain > 0.0).collect();
    let last = all.iter().fold(0.0, |most: f64, point| most.max(point.0)).min(STRAINS.1);
    let first = (0.1 * last).clamp(STRAINS.0, FROM);
    let used: Vec<_> = all.iter().copied().filter(|(strain, _)| (first..=last).contains(strain)).collect();
    let least = used.iter().fold(f64::INFINITY, |least, point| least.min(point.0));
    if used.len() < 3 || last < 2.0 * least {
        return Err(format!(
            "the curve has {} points with plastic strains from {} to {}: a power law needs three, over twice the least strain; or give \
             proof_stress and tensile_strength",
            used.len(),
            cell(first, 1.0),
            cell(STRAINS.1, 1.0)
        ));
    }
    let count = used.len() as f64;
    let mean = |of: &dyn Fn(f64, f64) -> f64| {
        used.iter().map(|(strain, stress)| of(libm::log(*strain), libm::log(*stress))).sum::<f64>() / count
    };
    let (x, y) = (mean(&|x, _| x), mean(&|_, y| y));
    let exponent = mean(&|one, other| (one - x) * (other - y)) / mean(&|one, _| (one - x) * (one - x));
    if !(0.0..=LARGEST_EXPONENT).contains(&exponent) {
        let exponent = cell(exponent, 1.0);
        return Err(format!(
            "the curve hardens with an exponent of {exponent} from {} to {} plastic strain: allowed is 0 to {LARGEST_EXPONENT}",
            cell(least, 1.0),
            cell(last, 1.0)
        ));
    }
    let law = PowerLaw { coefficient: libm::exp(y - exponent * x), exponent };
    let rms = mean(&|one, other| {
        let off = other - y - exponent * (one - x);
        off * off
    });
    let rms = libm::sqrt(rms);
    Ok(Tension {
        law,
        range: (least, last),
        uncertainty: rms.hypot(OF_TEST),
        way: format!("power law through its {} points, rms {} %{taken_off}", used.len(), cell(100.0 * rms, 1.0)),
        points: all,
    })
}

/// True stress over true strain.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// True strain \[-\] and true stress \[Pa\].
    pub points: Vec<(f64, f64)>,
    /// Whether it is the plastic part of the strain, rather than the whole.
    pub is_plastic: bool,
}

impl Curve {
    /// The curve as a table of a scene.
    pub fn in_toml(&self) -> String {
        let list = |of: fn(&(f64, f64)) -> f64| {
            self.points.iter().map(|point| format!("{:e}", of(point))).collect::<Vec<_>>().join(", ")
        };
        let strain = if self.is_plastic { "plastic_strain" } else { "true_strain" };
        format!("{{ {strain} = [{}], true_stress = [{}] }}", list(|point| point.0), list(|point| point.1))
    }

    /// The elastic slope of engineering stress over strain \[Pa\], as far as the curve shows it: the steepest part, since before it the specimen
    /// settles, and after it yields.
    fn slope(&self) -> Option<f64> {
        let most = self.points.iter().fold(0.0, |most: f64, point| most.max(point.1));
        let elastic = self.points.iter().filter(|(_, stress)| (ELASTIC.0 * most..ELASTIC.1 * most).contains(stress));
        let elastic: Vec<_> = elastic.filter(|_| !self.is_plastic).map(engineering).collect();
        elastic.windows(4).map(slope_of).reduce(f64::max)
    }

    /// An elastic slope that is off Young's modulus \[Pa\]: what it is of it, and a sentence.
    pub fn slope_off(&self, youngs_modulus: f64) -> Option<(f64, String)> {
        let slope = self.slope()?;
        let part = slope / youngs_modulus;
        let why = match part {
            part if (part - 1.0).abs() <= OFF => return None,
            part if part > SLOPES.1 => "is the strain in %?",
            part if part > 1.0 => "is it that of this metal, and the strain that of the specimen?",
            _ => {
                "a strain by the crosshead contains the machine: give that of an extensometer, take the record's own slope off with \
                 compliance_correction = true, or give proof_stress and tensile_strength"
            }
        };
        let [slope, modulus] = [slope, youngs_modulus].map(|modulus| quantity(modulus, "Pa"));
        let part_said = significant(part, 2);
        Some((
            part,
            format!("the curve begins with a slope of {slope}, {part_said} of youngs_modulus = {modulus}; {why}"),
        ))
    }

    /// The curve without what the machine adds to the strain, so that it begins with Young's modulus \[Pa\], and the slope that it had \[Pa\].
    fn corrected(&self, youngs_modulus: f64) -> Result<(Curve, f64), String> {
        let slope = self.slope().ok_or_else(|| {
            let [first, last] = [ELASTIC.0, ELASTIC.1].map(|part| cell(100.0 * part, 1.0));
            format!("compliance_correction needs an elastic part: four points of a whole strain from {first} to {last} % of the largest stress")
        })?;
        if slope > (1.0 + OFF) * youngs_modulus {
            return Err(self.slope_off(youngs_modulus).map_or(String::new(), |(_, why)| why));
        }
        let compliance = 1.0 / slope - 1.0 / youngs_modulus;
        let points = self.points.iter().map(|point| {
            let (strain, stress) = engineering(point);
            let strain = strain - compliance * stress;
            (libm::log1p(strain), stress * (1.0 + strain))
        });
        Ok((Curve { points: points.collect(), is_plastic: false }, slope))
    }
}

/// Engineering strain and stress of a true point.
fn engineering((strain, stress): &(f64, f64)) -> (f64, f64) {
    (libm::expm1(*strain), stress * libm::exp(-strain))
}

/// The slope of the straight line through these points by least squares \[Pa\].
fn slope_of(points: &[(f64, f64)]) -> f64 {
    let mean = |of: fn(f64, f64) -> f64| points.iter().map(|(x, y)| of(*x, *y)).sum::<f64>() / points.len() as f64;
    let (x, y) = (mean(|x, _| x), mean(|_, y| y));
    points.iter().map(|point| (point.0 - x) * (point.1 - y)).sum::<f64>()
        / points.iter().map(|point| (point.0 - x) * (point.0 - x)).sum::<f64>()
}

/// What a column says of its numbers.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    True,
    Engineering,
}

/// How columns of true, engineering and plastic values are called in English and German.
const TRUE_WORDS: [&str; 4] = ["true", "wahr", "logarithm", "hencky"];
const ENGINEERING_WORDS: [&str; 3] = ["engineering", "nominal", "techni"];
const PLASTIC_WORDS: [&str; 2] = ["plastic", "plastisch"];

fn has_word(name: &str, words: &[&str]) -> bool {
    let name = name.to_lowercase();
    words.iter().any(|word| name.contains(word))
}

impl Kind {
    fn of(column: &MeasuredColumn) -> Option<Kind> {
        if has_word(&column.name, &TRUE_WORDS) {
            return Some(Kind::True);
        }
        has_word(&column.name, &ENGINEERING_WORDS).then_some(Kind::Engineering)
    }
}

/// What a scene says of the specimen, where the file doesn't.
#[derive(Default)]
pub struct Specimen {
    /// Initial cross section \[m^2\].
    pub section: Option<f64>,
    /// Initial gauge length \[m\].
    pub gauge_length: Option<f64>,
}

/// Strains or stresses of a test.
struct Values {
    kind: Option<Kind>,
    is_plastic: bool,
    numbers: Vec<f64>,
}

/// The curve in the `bytes` of a [table](measurement::read): the columns strain and stress, true or engineering (without a word: engineering), or
/// the travel and the force of a `specimen`. It ends at the largest load.
///
/// # Errors
/// A sentence with the line, and what is expected.
pub fn read(bytes: &[u8], specimen: &Specimen) -> Result<Curve, String> {
    let table = measurement::read(bytes, &Choices::default()).map_err(|wrong| wrong.to_string())?;
    let section = table.above("section").or_else(|| {
        let circle = table.above("diameter").map(|diameter| 0.25 * PI * diameter * diameter);
        circle.or_else(|| Some(table.above("thickness")? * table.above("width")?))
    });
    let strain =
        values(&table, "strain", "depth", ("gauge_length", specimen.gauge_length, table.above("gauge_length")))?;
    let stress = values(&table, "stress", "force", ("section", specimen.section, section))?;
    let raw = strain.numbers.iter().copied().zip(stress.numbers.iter().copied()).collect();
    let points = until_largest_load(&true_of(raw, &strain, &stress)?, strain.is_plastic);
    Ok(Curve { points: thinned(&points), is_plastic: strain.is_plastic })
}

/// The numbers of the column `key`, or those of the column `other` over a length or an area of the specimen: its name, that of the scene and
/// that of the file.
fn values(
    table: &Measurement,
    key: &str,
    other: &str,
    (name, of_scene, of_file): (&str, Option<f64>, Option<f64>),
) -> Result<Values, String> {
    let numbers = |column| table.numbers(column).map_err(|wrong| wrong.to_string());
    let Some(column) = one_column(table, key)? else {
        let Some(column) = one_column(table, other)? else {
            let others = table.unknown.iter().map(|name| measurement::asked(name)).collect::<Vec<_>>().join(", ");
            let unknown = if others.is_empty() { others } else { format!("; unknown: {others}") };
            let raw = if other == "depth" { "travel" } else { other };
            return Err(format!("no column is called {key}, nor {raw}{unknown}; such as `strain [%];stress [MPa]`"));
        };
        let (said, unit) = (shortened(&column.name), column.kind.unit);
        if column.unit.is_none() {
            return Err(format!("the column `{said}` has no unit: write `{said} [{unit}]`"));
        }
        let size = of_scene.or(of_file).ok_or_else(|| {
            format!(
                "`{said}` becomes a {key} by the {} of the specimen: give {name}, as in tensile_test = {{ curve = \"test.csv\", section = \
                 \"7.5 mm^2\", gauge_length = \"30 mm\" }}, or in a line above the names of the columns",
                name.replace('_', " ")
            )
        })?;
        let numbers = numbers(column)?.into_iter().map(|number| number / size).collect();
        return Ok(Values { kind: Some(Kind::Engineering), is_plastic: false, numbers });
    };
    if of_scene.is_some() {
        return Err(format!("{name} has no effect: the file has the column `{}`", shortened(&column.name)));
    }
    let numbers = numbers(column)?;
    let said = shortened(&column.name);
    if column.unit.is_none() && key == "stress" {
        return Err(format!("the column `{said}` has no unit: write `stress [MPa]`"));
    }
    let most = numbers.iter().copied().fold(0.0, f64::max);
    if column.unit.is_none() && most > 2.0 {
        return Err(format!("the strain reaches {}: if that is in %, write `strain [%]`", in_message(most)));
    }
    Ok(Values { kind: Kind::of(column), is_plastic: has_word(&column.name, &PLASTIC_WORDS), numbers })
}

/// The one column of this kind; of several, that of true values.
fn one_column<'a>(table: &'a Measurement, key: &str) -> Result<Option<&'a MeasuredColumn>, String> {
    let all = table.of(key);
    let of_true = all.iter().copied().filter(|column| has_word(&column.name, &TRUE_WORDS));
    match (&all[..], &of_true.collect::<Vec<_>>()[..]) {
        ([], _) => Ok(None),
        ([column], _) | (_, [column]) => Ok(Some(*column)),
        _ => {
            let names: Vec<_> = all.iter().map(|column| column.name.as_str()).collect();
            Err(format!("which column is the {}: {}? Leave one of them", all[0].kind.names[0], one_of(&names)))
        }
    }
}

/// True strains and stresses of numbers that these columns have.
fn true_of(raw: Vec<(f64, f64)>, strain: &Values, stress: &Values) -> Result<Vec<(f64, f64)>, String> {
    let without = if strain.is_plastic { Kind::True } else { Kind::Engineering };
    let of_strain = strain.kind.or(stress.kind).unwrap_or(without);
    let of_stress = stress.kind.or(strain.kind).unwrap_or(without);
    if strain.is_plastic && (of_strain, of_stress) != (Kind::True, Kind::True) {
        return Err("a plastic strain goes with true stress and strain".into());
    }
    let point = |(strain, stress): (f64, f64)| {
        let engineering = if of_strain == Kind::True { libm::expm1(strain) } else { strain };
        let factor = if of_stress == Kind::True { 1.0 } else { 1.0 + engineering };
        (if of_strain == Kind::True { strain } else { libm::log1p(strain) }, factor * stress)
    };
    let is_one = |(strain, stress): &(f64, f64)| *strain > 0.0 && *stress > 0.0;
    Ok(raw.into_iter().map(point).filter(is_one).collect())
}

/// The `points` with strains that were not reached before, up to the largest load: beyond it, the specimen necks. A curve over the plastic
/// strain is one that somebody has already made.
fn until_largest_load(points: &[(f64, f64)], is_plastic: bool) -> Vec<(f64, f64)> {
    let load = |point: &(f64, f64)| point.1 * libm::exp(-point.0);
    let most = points.iter().map(load).fold(0.0, f64::max);
    let end = points.iter().position(|point| load(point) == most).filter(|_| !is_plastic);
    let mut reached = 0.0;
    let points = points.iter().take(end.map_or(points.len(), |end| end + 1)).copied();
    let is_new = |(strain, _): &(f64, f64)| {
        let is_new = *strain > reached;
        reached = strain.max(reached);
        is_new
    };
    points.filter(is_new).collect()
}

/// The means of the `points` in equal parts of each decade of strain, where there are many.
fn thinned(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let part = |point: &(f64, f64)| libm::floor(PER_DECADE * libm::log10(point.0));
    let mean = |part: &[(f64, f64)]| {
        let count = part.len() as f64;
        (part.iter().map(|point| point.0).sum::<f64>() / count, part.iter().map(|point| point.1).sum::<f64>() / count)
    };
    points.chunk_by(|one, other| part(one) == part(other)).map(mean).collect()
}
