//! Tensile tests: the table that a testing machine writes, and the power law `sigma = K eps^n` through it, or through proof stress and
//! tensile strength.

use crate::layout::shortened;
use crate::nearest::one_of;
use crate::numbers::{cell, in_message, quantity};
use crate::units;
use brinell_contact::hardening::PowerLaw;

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

/// The measured slope over Young's modulus that is believed. A strain by the crosshead contains the machine.
const SLOPES: (f64, f64) = (0.3, 5.0);

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
    let (mut low, mut high) = (first, LARGEST_EXPONENT);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        *(if over(middle) > 0.0 { &mut low } else { &mut high }) = middle;
    }
    let n = high;
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

/// The power law closest to the `curve` of a metal with this Young's modulus \[Pa\], by least squares of the logarithms.
///
/// # Errors
/// A sentence about a curve that has no such law.
pub fn through_curve(curve: &Curve, youngs_modulus: f64) -> Result<Tension, String> {
    curve.check_slope(youngs_modulus)?;
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
        way: format!("power law through its {} points, rms {} %", used.len(), cell(100.0 * rms, 1.0)),
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

    /// Rejects a strain that has another elastic slope than Young's modulus \[Pa\], as far as the curve shows it.
    fn check_slope(&self, youngs_modulus: f64) -> Result<(), String> {
        let most = self.points.iter().fold(0.0, |most: f64, point| most.max(point.1));
        let elastic = self.points.iter().filter(|(_, stress)| (ELASTIC.0 * most..ELASTIC.1 * most).contains(stress));
        let elastic: Vec<_> = elastic.filter(|_| !self.is_plastic).collect();
        // the steepest part: before it the specimen settles, after it yields
        let slope = elastic.windows(4).map(slope_of).reduce(f64::max);
        let Some(slope) = slope.filter(|slope| !(SLOPES.0..=SLOPES.1).contains(&(slope / youngs_modulus))) else {
            return Ok(());
        };
        let why = if slope > youngs_modulus {
            "is the strain in %?"
        } else {
            "a strain by the crosshead contains the machine: give that of an extensometer, the plastic strain, or proof_stress and \
             tensile_strength"
        };
        let [slope, modulus] = [slope, youngs_modulus].map(|modulus| quantity(modulus, "Pa"));
        Err(format!("the curve begins with a slope of {slope}, and youngs_modulus is {modulus}; {why}"))
    }
}

/// The slope of the straight line through these points by least squares \[Pa\].
fn slope_of(points: &[&(f64, f64)]) -> f64 {
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

/// A column with strains or stresses.
#[derive(Clone, Copy)]
struct Column {
    place: usize,
    kind: Option<Kind>,
    is_plastic: bool,
    /// Numbers of the file times this are SI; `None` if the header doesn't say it.
    factor: Option<f64>,
}

/// How columns of strains, of stresses, of true and of engineering values are called in English and German.
const STRAIN_WORDS: [&str; 6] = ["strain", "dehnung", "elongation", "epsilon", "eps", "\u{3b5}"];
const STRESS_WORDS: [&str; 4] = ["stress", "spannung", "sigma", "\u{3c3}"];
const TRUE_WORDS: [&str; 4] = ["true", "wahr", "logarithm", "hencky"];
const ENGINEERING_WORDS: [&str; 3] = ["engineering", "nominal", "techni"];
const PLASTIC_WORDS: [&str; 2] = ["plastic", "plastisch"];

/// The curve in the `bytes` of a table with a header: the columns strain and stress with their units, true or engineering (without a
/// word: engineering), with any of the separators `;`, tab and `,`, and decimal points or commas. It ends at the largest load.
///
/// # Errors
/// A sentence with the line, and what is expected.
pub fn read(bytes: &[u8]) -> Result<Curve, String> {
    let text = text_of(bytes);
    let text = text.trim_start_matches('\u{feff}');
    let (own, text) = match text.strip_prefix("sep=").and_then(|rest| rest.split_once('\n')) {
        Some((separator, rest)) => (separator.trim_end_matches('\r').bytes().next(), rest),
        None => (None, text),
    };
    let separator = own.unwrap_or_else(|| separator_of(text));
    let rows: Vec<(u64, Vec<String>)> = rows_of(text, separator, u64::from(own.is_some()))?;
    let header = rows.iter().position(|(_, row)| {
        let has = |words: &[&str]| row.iter().any(|cell| has_word(cell, words));
        has(&STRAIN_WORDS) && has(&STRESS_WORDS)
    });
    let header = header.ok_or("no line has the names of the columns, such as `strain [%];stress [MPa]`")?;
    let units = rows.get(header + 1).filter(|(_, row)| row.iter().all(|cell| number_in(cell, separator).is_none()));
    let cells = |place: usize| (rows[header].1[place].as_str(), units.and_then(|(_, row)| row.get(place)));
    let strain = column(&rows[header].1, cells, &STRAIN_WORDS, strain_unit)?;
    let stress = column(&rows[header].1, cells, &STRESS_WORDS, stress_unit)?;
    let stress_name = &rows[header].1[stress.place];
    let factor = stress
        .factor
        .ok_or_else(|| format!("the column `{}` has no unit: write `stress [MPa]`", shortened(stress_name)))?;
    let body = &rows[header + 1 + usize::from(units.is_some())..];
    let mut raw = Vec::new();
    for (line, row) in body {
        let number = |column: &Column| {
            let cell = row.get(column.place).map_or("", String::as_str);
            number_in(cell, separator).ok_or_else(|| format!("line {line}: `{}` is no number", shortened(cell)))
        };
        raw.push((strain.factor.unwrap_or(1.0) * number(&strain)?, factor * number(&stress)?));
    }
    let most = raw.iter().fold(0.0, |most: f64, point| most.max(point.0));
    if most > 2.0 && strain.factor.is_none() {
        return Err(format!("the strain reaches {}: if that is in %, write `strain [%]`", in_message(most)));
    }
    let points = until_largest_load(&true_of(raw, &strain, &stress)?, strain.is_plastic);
    Ok(Curve { points: thinned(&points), is_plastic: strain.is_plastic })
}

/// The text of a file as spreadsheets write it: UTF-8, UTF-16 with its mark, or else one byte for each letter.
fn text_of(bytes: &[u8]) -> String {
    let wide = |of: fn([u8; 2]) -> u16| {
        let words: Vec<u16> = bytes[2..].chunks_exact(2).map(|pair| of([pair[0], pair[1]])).collect();
        String::from_utf16_lossy(&words)
    };
    match bytes {
        [0xff, 0xfe, ..] => wide(u16::from_le_bytes),
        [0xfe, 0xff, ..] => wide(u16::from_be_bytes),
        _ => std::str::from_utf8(bytes)
            .map_or_else(|_| bytes.iter().map(|byte| char::from(*byte)).collect(), String::from),
    }
}

/// The separator that most lines have: of several, a comma may be the decimal one.
fn separator_of(text: &str) -> u8 {
    let lines = || text.lines().filter(|line| !line.trim().is_empty());
    let has =
        |separator: &u8| 2 * lines().filter(|line| line.contains(char::from(*separator))).count() > lines().count();
    [b';', b'\t', b','].into_iter().find(has).unwrap_or(b',')
}

/// The rows that aren't empty, each with its line.
fn rows_of(text: &str, separator: u8, before: u64) -> Result<Vec<(u64, Vec<String>)>, String> {
    let mut reader = csv::ReaderBuilder::new();
    let reader = reader.delimiter(separator).has_headers(false).flexible(true).trim(csv::Trim::All);
    let mut rows = Vec::new();
    for row in reader.from_reader(text.as_bytes()).records() {
        let row = row.map_err(|error| format!("this is no table: {error}"))?;
        let line = before + row.position().map_or(0, csv::Position::line);
        if row.iter().any(|cell| !cell.is_empty()) {
            rows.push((line, row.iter().map(String::from).collect()));
        }
    }
    Ok(rows)
}

fn has_word(cell: &str, words: &[&str]) -> bool {
    let cell = cell.to_lowercase();
    words.iter().any(|word| cell.contains(word))
}

/// The one column with these `words`; of several, that of true values.
fn column<'a>(
    header: &'a [String],
    cells: impl Fn(usize) -> (&'a str, Option<&'a String>),
    words: &[&str],
    unit: fn(&str) -> Option<f64>,
) -> Result<Column, String> {
    let all: Vec<usize> = (0..header.len()).filter(|place| has_word(&header[*place], words)).collect();
    let of_true: Vec<usize> = all.iter().copied().filter(|place| has_word(&header[*place], &TRUE_WORDS)).collect();
    let place = match (&all[..], &of_true[..]) {
        ([place], _) | (_, [place]) => *place,
        ([], _) => return Err(format!("no column is called {}", one_of(&words[..2]))),
        _ => {
            let names: Vec<_> = all.iter().map(|place| header[*place].as_str()).collect();
            return Err(format!("which column is the {}: {}? Leave one of them", words[0], one_of(&names)));
        }
    };
    let (name, below) = cells(place);
    let kind = if has_word(name, &TRUE_WORDS) {
        Some(Kind::True)
    } else {
        has_word(name, &ENGINEERING_WORDS).then_some(Kind::Engineering)
    };
    let factor = below.and_then(|below| unit(below)).or_else(|| of_header(name, unit));
    Ok(Column { place, kind, is_plastic: has_word(name, &PLASTIC_WORDS), factor })
}

/// The unit in a header: in brackets, or after `in`, `/`, a blank or `_`.
fn of_header(name: &str, unit: fn(&str) -> Option<f64>) -> Option<f64> {
    let inside = name.find(['[', '(']).map(|start| name[start + 1..].trim_end_matches([']', ')', ' ']));
    let after = [" in ", "/", " ", "_"].into_iter().filter_map(|before| Some(name.split_once(before)?.1));
    let last = [' ', '_', ','].into_iter().filter_map(|before| Some(name.rsplit_once(before)?.1));
    inside.into_iter().chain(after).chain(last).find_map(|text| unit(text.trim()))
}

fn strain_unit(text: &str) -> Option<f64> {
    match text.trim_matches(['[', ']', '(', ')']) {
        "%" | "percent" | "pct" | "Prozent" => Some(0.01),
        "-" | "1" | "mm/mm" | "m/m" | "in/in" => Some(1.0),
        _ => None,
    }
}

fn stress_unit(text: &str) -> Option<f64> {
    units::with_unit(&format!("1 {}", text.trim_matches(['[', ']', '(', ')'])), "Pa")?.ok()
}

/// The number in a `cell`, with a decimal point or, where it doesn't separate the cells, a decimal comma.
fn number_in(cell: &str, separator: u8) -> Option<f64> {
    let cell = cell.trim().replace(['\u{a0}', '\u{202f}'], "");
    let plain = match (cell.rfind(','), cell.rfind('.')) {
        // 1.234,5
        (Some(comma), point) if separator != b',' || point.is_none() => match point {
            Some(point) if point > comma => cell.replace(',', ""),
            _ => cell.replace('.', "").replace(',', "."),
        },
        _ => cell,
    };
    plain.parse().ok().filter(|number: &f64| number.is_finite())
}

/// True strains and stresses of numbers that these columns have.
fn true_of(raw: Vec<(f64, f64)>, strain: &Column, stress: &Column) -> Result<Vec<(f64, f64)>, String> {
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

#[cfg(test)]
mod tests {
    use super::*;

    const STEEL: f64 = 206e9;

    /// A power law with its elastic part, as a machine writes it: engineering strain and stress \[MPa\] up to the largest load and beyond.
    fn machine(law: PowerLaw) -> Vec<(f64, f64)> {
        let stress_at = |strain: f64| {
            // the whole strain is given
            let (mut low, mut high) = (0.0, strain);
            for _ in 0..80 {
                let middle = 0.5 * (low + high);
                let over = law.coefficient * libm::pow(middle, law.exponent) / STEEL + middle > strain;
                *(if over { &mut high } else { &mut low }) = middle;
            }
            law.coefficient * libm::pow(low, law.exponent)
        };
        // none at the end of a part of a decade
        let strains = (1..=4000).map(|step| 0.97e-4 * f64::from(step));
        strains.map(|strain| (libm::expm1(strain), 1e-6 * stress_at(strain) * libm::exp(-strain))).collect()
    }

    fn csv(rows: &[(f64, f64)], header: &str, row: impl Fn(f64, f64) -> String) -> Vec<u8> {
        let rows = rows.iter().map(|(strain, stress)| row(*strain, *stress) + "\r\n").collect::<String>();
        format!("{header}\r\n{rows}").into_bytes()
    }

    #[test]
    fn the_power_law_of_a_test_is_found_again_from_what_a_machine_writes() {
        for (coefficient, exponent) in [(1000e6, 0.2), (1500e6, 0.1), (600e6, 0.3), (900e6, 0.05)] {
            let law = PowerLaw { coefficient, exponent };
            let file = csv(&machine(law), "Dehnung [%];Spannung [MPa]", |strain, stress| {
                format!("{:.5};{stress:.3}", 100.0 * strain).replace('.', ",")
            });
            let found = through_curve(&read(&file).unwrap(), STEEL).unwrap();
            for strain in [0.01, 0.03] {
                let stress = |law: PowerLaw| law.coefficient * libm::pow(strain, law.exponent);
                let error = stress(found.law) / stress(law) - 1.0;
                assert!(error.abs() < 2e-3, "{law:?} at {strain}: {error}");
            }
            assert!((found.law.exponent - exponent).abs() < 3e-3 && found.uncertainty < 0.032, "{found:?}");
            assert!(
                found.range.1 <= 0.1 && found.range.1 <= 1.05 * exponent,
                "until the largest load: {:?}",
                found.range
            );
        }
    }

    #[test]
    fn separators_commas_units_and_words_of_spreadsheets_make_one_curve() {
        let rows = machine(PowerLaw { coefficient: 1000e6, exponent: 0.2 });
        let plain = csv(&rows, "strain,stress [MPa]", |strain, stress| format!("{strain:.9},{stress:.6}"));
        let expected = read(&plain).unwrap();
        let german = |strain: f64, stress: f64| format!("{:.7};{stress:.6}", 100.0 * strain).replace('.', ",");
        let true_of =
            |strain: f64, stress: f64| format!("{:.12}\t{:.9}", libm::log1p(strain), 1e-3 * stress * (1.0 + strain));
        let utf16 = |text: Vec<u8>| {
            let text = String::from_utf8(text).unwrap();
            [0xff, 0xfe].into_iter().chain(text.encode_utf16().flat_map(u16::to_le_bytes)).collect::<Vec<u8>>()
        };
        let quoted = |strain: f64, stress: f64| format!("7,\"{:.9}\",\"{stress:.6}\"", strain).replace('.', ",");
        let mut latin = csv(&rows, "Dehnung [%];Spannung [N/mm#]", german);
        let place = latin.iter().position(|byte| *byte == b'#').unwrap();
        latin[place] = 0xb2;
        let others = [
            csv(&rows, "sep=;\r\nEngineering strain (%);Engineering stress (N/mm2)", german),
            csv(&rows, "Pr\u{fc}fung 7\r\n\r\nDehnung;Spannung\r\n%;MPa", german),
            csv(&rows, "\u{feff}strain_%;stress_MPa", german),
            utf16(csv(&rows, "true strain\ttrue stress in GPa", true_of)),
            csv(&rows, "no,nominal strain,nominal stress / MPa", quoted),
            latin,
        ];
        for (index, file) in others.iter().enumerate() {
            let found = read(file).unwrap_or_else(|why| panic!("{index}: {why}"));
            assert_eq!(found.points.len(), expected.points.len(), "{index}");
            for (one, other) in found.points.iter().zip(&expected.points) {
                assert!(
                    (one.0 / other.0 - 1.0).abs() < 1e-4 && (one.1 / other.1 - 1.0).abs() < 1e-6,
                    "{index}: {one:?}"
                );
            }
        }
    }

    #[test]
    fn a_table_that_is_no_tensile_test_is_told_why() {
        let table =
            |text: &str| read(text.as_bytes()).and_then(|curve| through_curve(&curve, STEEL).map(|_| ())).unwrap_err();
        for (text, why) in [
            ("", "no line has the names of the columns"),
            ("time;force\n1;2\n", "no line has the names of the columns"),
            ("strain;stress\n1;2\n", "the column `stress` has no unit: write `stress [MPa]`"),
            ("strain;stress [mm]\n1;2\n", "the column `stress [mm]` has no unit"),
            ("strain [%];stress [MPa]\n1;200\n2;soft\n", "line 3: `soft` is no number"),
            ("strain;stress [MPa]\n1;200\n5;300\n9;400\n", "the strain reaches 9: if that is in %, write `strain [%]`"),
            ("strain [%];stress [MPa]\n1;200\n", "the curve has 1 points with plastic strains from"),
            ("plastic strain;engineering stress [MPa]\n1;200\n", "a plastic strain goes with true stress"),
            ("strain a;strain b;stress [MPa]\n1;2;200\n", "which column is the strain: `strain a` or `strain b`?"),
            (
                "plastic strain;true stress [MPa]\n0.01;200\n0.02;400\n0.04;800\n",
                "the curve hardens with an exponent of 1 from 0.01 to 0.04 plastic strain: allowed is 0 to 0.6",
            ),
        ] {
            let said = table(text);
            assert!(said.contains(why), "{text:?}: {said}");
        }
    }

    /// A crosshead that gives way by five times the specimen's own elastic strain.
    #[test]
    fn a_strain_that_contains_the_machine_is_refused() {
        let rows = machine(PowerLaw { coefficient: 1000e6, exponent: 0.2 });
        let soft =
            csv(&rows, "strain;stress [MPa]", |strain, stress| format!("{};{stress}", strain + 5e6 * stress / STEEL));
        let said = through_curve(&read(&soft).unwrap(), STEEL).unwrap_err();
        assert!(
            said.contains("and youngs_modulus is 206 GPa; a strain by the crosshead contains the machine"),
            "{said}"
        );
        let percent = csv(&rows, "strain [%];stress [MPa]", |strain, stress| format!("{strain};{stress}"));
        let said = through_curve(&read(&percent).unwrap(), STEEL).unwrap_err();
        assert!(said.contains("is the strain in %?"), "{said}");
    }

    /// Rp0.2 is the stress at the whole strain of 0.2 % and `Rp/E`, and the load has its maximum Rm at the strain n.
    #[test]
    fn the_power_law_of_two_numbers_has_both() {
        for (proof, strength) in [(240e6, 480e6), (241e6, 586e6), (950e6, 1000e6), (1675e6, 1875e6), (30e6, 90e6)] {
            let PowerLaw { coefficient, exponent } = through_two(proof, strength, STEEL).unwrap().law;
            let stress = |strain: f64| coefficient * libm::pow(strain, exponent);
            assert!((stress(0.002 + proof / STEEL) / proof - 1.0).abs() < 1e-9);
            let load = |strain: f64| stress(strain) * libm::exp(-strain);
            assert!((load(exponent) / strength - 1.0).abs() < 1e-9);
            assert!(load(0.99 * exponent) < strength && load(1.01 * exponent) < strength);
        }
        for (proof, strength) in [(500e6, 400e6), (10e6, 400e6)] {
            let said = through_two(proof, strength, STEEL).unwrap_err();
            assert!(said.contains("of tensile_strength = 400 MPa: allowed is"), "{said}");
        }
    }
}
