//! The laws as text: tables, and a paragraph for each law.

use super::laws::{ASKED, LawList, Loads, Rated, Told};
use brinell_exporter::layout::{WIDTH, paragraph, table};
use brinell_exporter::numbers::significant;
use brinell_exporter::pairing;
use brinell_exporter::parameters::LawConstant;

/// Where the errors are compared.
const TABLES: &str = "tables of all laws: docs/guide/laws.md and docs/guide/validation.md of the project";

/// All laws.
pub fn list(list: &LawList) -> String {
    let mut text = paragraph(
        "",
        &"Loading laws. Error of the force against finite elements up to 1000 yield indentations d_y: the worst, and the root mean \
         square. Energy with the unloading law of scenes that name none, for all bodies that an FMU can have; the largest restitution is that of targets with a Poisson's ratio nu \
         from 0 on. A scene without law.loading has LAW. `brinell laws NAME` shows one law with its formulas."
            .replace("LAW", pairing::DEFAULT_LOADING),
    );
    text += &format!("\n{}", loading_table(&list.loading));
    text += "\nEach law with its reference constants; a scene changes them by law.loading_parameters.\n";
    for law in &list.loading {
        text += &format!("\n{}: {}\n", law.name, law.told.title);
        text += &entry("parameters", &values(&law.told.parameters));
        text += &entry("unloading", law.unloading);
        text += &remarks(&law.told);
    }
    text += "\nUnloading laws. A scene changes their constants by law.unloading_parameters.\n";
    for law in &list.unloading {
        text += &format!("\n{}: {}\n", law.name, law.told.title);
        text += &entry("parameters", &values(&law.told.parameters));
        text += &remarks(&law.told);
    }
    text.push('\n');
    text += &paragraph(
        "",
        "Rate-dependent laws, /DAMPING. All are passive and leave no dent (law.loading, law.damping, law.restitution).",
    );
    text += &format!("\n{}", damped_table(&list.damped));
    for law in list.damped.iter().filter(|law| is_first_of_its_kind(law)) {
        text += &format!("\n{}: {}\n", law.name.split('/').next().unwrap_or_default(), law.told.title);
        text += &entry("parameters", &values(&law.told.parameters));
        text += &remarks(&law.told);
    }
    text
}

/// The laws of one name, with formulas and constants.
pub fn one(list: &LawList) -> String {
    let mut parts = Vec::new();
    for law in &list.loading {
        let accuracy = format!("force against finite elements: {}; {TABLES}", law.accuracy);
        let more = entry("unloading", law.unloading) + &entry("accuracy", &accuracy) + &entry("energy", &energy(law));
        parts.push(format!("{}: {} (loading)\n{}{more}", law.name, law.told.title, whole(&law.told)));
    }
    for law in &list.unloading {
        parts.push(format!("{}: {} (unloading)\n{}", law.name, law.told.title, whole(&law.told)));
    }
    if let Some(law) = list.damped.first() {
        let name = law.name.split('/').next().unwrap_or_default();
        let rated = damped_table(&list.damped);
        parts.push(format!("{name}: {} (rate-dependent)\n{}\n{rated}", law.told.title, whole(&law.told)));
    }
    parts.join("\n")
}

/// A law with several damping variants is described once.
fn is_first_of_its_kind(law: &Rated) -> bool {
    !law.name.contains('/') || ["/exact", "/original"].iter().any(|first| law.name.ends_with(first))
}

fn energy(law: &Loads) -> String {
    let below = law.passive_from_poissons_ratio.map(|ratio| format!(" (nu < {ratio})")).unwrap_or_default();
    match law.largest_restitution {
        Some(restitution) if !law.passive => format!("e up to {restitution:.3}{below}"),
        _ => "passive".into(),
    }
}

fn loading_table(laws: &[Loads]) -> String {
    let mut rows = vec![["law", "error of the force", "jumps", "energy"].map(String::from).to_vec()];
    for law in laws {
        let jumps = if law.jumps { "yes" } else { "no" };
        rows.push(vec![law.name.into(), law.accuracy.into(), jumps.into(), energy(law)]);
    }
    table(&rows, 1, 0)
}

/// The properties of the rate-dependent laws.
fn damped_table(laws: &[Rated]) -> String {
    let asked = format!("restitution (for {ASKED})");
    let mut rows = vec![vec!["law".to_string(), asked, "force at first touch".into()]];
    for law in laws {
        // the fourth root of the smallest depth is not a jump
        let jump = match law.force_at_touch {
            part if part < 0.01 => "none".into(),
            part => format!("{:.0} % of the largest", 100.0 * part),
        };
        rows.push(vec![law.name.clone(), significant(law.restitution, 4), jump]);
    }
    table(&rows, 1, 0)
}

fn values(constants: &[LawConstant]) -> String {
    let value =
        |constant: &LawConstant| format!("{} = {} {}", constant.name, constant.value, constant.unit).trim_end().into();
    let all: Vec<String> = constants.iter().map(value).collect();
    if all.is_empty() { "none".into() } else { all.join(", ") }
}

/// Validity, notes and reference.
fn remarks(told: &Told) -> String {
    let validity = if told.validity.is_empty() { String::new() } else { entry("validity", &told.validity) };
    validity + &entry("notes", &told.notes) + &entry("reference", told.reference)
}

/// All texts about a law: a formula and a constant on each line, unless they are long.
fn whole(told: &Told) -> String {
    let heading = |index| if index == 0 { "formulas" } else { "" };
    let formulas = told.formulas.iter().enumerate().map(|(index, formula)| entry(heading(index), formula));
    formulas.collect::<String>() + &constants(&told.parameters) + &remarks(told)
}

/// The constants, with their ranges and meanings.
fn constants(constants: &[LawConstant]) -> String {
    if constants.is_empty() {
        return entry("constants", "none that a scene can change");
    }
    let row = |constant: &LawConstant| {
        let LawConstant { name, value, unit, minimum, maximum, .. } = constant;
        vec![(*name).to_string(), format!("{value} {unit}").trim_end().into(), format!("{minimum} to {maximum}")]
    };
    let rows: Vec<_> = constants.iter().map(row).collect();
    let mut text = String::from("  constants\n");
    for (line, constant) in table(&rows, 1, 4).lines().zip(constants) {
        let described = format!("{line}  {}", constant.description);
        if described.chars().count() <= WIDTH {
            text += &format!("{described}\n");
        } else {
            text += &format!("{line}\n{}", paragraph("        ", constant.description));
        }
    }
    text
}

/// `text` after its `heading`.
fn entry(heading: &str, text: &str) -> String {
    paragraph(&format!("  {heading:<12}"), text)
}
