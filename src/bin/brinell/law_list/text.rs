//! The laws as text: tables, then a paragraph for each law.

use super::{ASKED, List, Measured, Rated, Told, materials};
use crate::layout::{paragraph, table};
use crate::numbers::significant;
use crate::pairing;
use crate::parameters::Constant;

/// All laws.
pub fn list(list: &List) -> String {
    let mut text = paragraph(
        "",
        &"Loading laws. Error of the force against finite elements up to 1000 yield indentations d_y (truth/README.md), on the \
         bodies of the default scene. Energy for all bodies that an FMU can have; the largest restitution is that of targets with \
         a Poisson's ratio nu from 0 on. A scene without law.loading has LAW. `brinell laws NAME` shows one law with its \
         formulas and its curve."
            .replace("LAW", pairing::DEFAULT_LOADING),
    );
    text.push('\n');
    text += &measured(&list.loading);
    for law in list.loading.iter().filter(|law| !law.materials.is_empty()) {
        text += &format!("\n{}", materials::text(&law.materials));
    }
    text += "\nEach law with its reference constants; a scene changes them by law.loading_parameters.\n";
    for law in &list.loading {
        text += &loading(law);
    }
    text += "\nUnloading laws. A scene changes their constants by law.unloading_parameters.\n";
    for law in &list.unloading {
        text += &unloading(law);
    }
    text.push('\n');
    text += &paragraph(
        "",
        "Rate-dependent laws, /DAMPING. All are passive and leave no dent (law.loading, law.damping, law.restitution).",
    );
    text.push('\n');
    text += &rated(&list.damped);
    for law in list.damped.iter().filter(|law| is_first_of_its_kind(law)) {
        text += &damped(law);
    }
    text
}

/// A law with several damping variants is described once.
fn is_first_of_its_kind(law: &Rated) -> bool {
    !law.name.contains('/') || ["/exact", "/original"].iter().any(|first| law.name.ends_with(first))
}

/// The accuracy of the loading laws.
pub fn measured(laws: &[Measured]) -> String {
    let percent = |value: f64| format!("{:+.1} %", 100.0 * value);
    let mut rows = vec![["law/unloading", "worst error", "at d_y", "rms", "jump", "energy"].map(String::from).to_vec()];
    for law in laws {
        let below = law.passive_from_poissons_ratio.map(|ratio| format!(" (nu < {ratio})")).unwrap_or_default();
        rows.push(vec![
            format!("{}/{}", law.name, law.unloading),
            percent(law.worst_error),
            significant(law.worst_at, 3),
            format!("{:.1} %", 100.0 * law.rms_error),
            if law.continuous { "none".into() } else { percent(law.largest_jump) },
            match law.largest_restitution {
                _ if law.passive => "passive".into(),
                e => format!("e up to {e:.3}{below}"),
            },
        ]);
    }
    table(&rows, 1, 0)
}

/// The properties of the rate-dependent laws.
pub fn rated(laws: &[Rated]) -> String {
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

/// One loading law.
pub fn loading(law: &Measured) -> String {
    let mut text = format!("\n{}: {}\n", law.name, law.title);
    text += &entry("parameters", &values(&law.parameters));
    text += &entry("unloading", law.unloading);
    text += &entry("validity", &law.validity);
    text += &entry("notes", &law.notes);
    text + &entry("reference", law.reference)
}

/// One unloading law.
pub fn unloading(law: &Told) -> String {
    let mut text = format!("\n{}: {}\n", law.name, law.title);
    text += &entry("parameters", &values(&law.parameters));
    text += &entry("notes", &law.notes);
    text + &entry("reference", law.reference)
}

/// One rate-dependent law.
pub fn damped(law: &Rated) -> String {
    let mut text = format!("\n{}: {}\n", law.name.split('/').next().unwrap_or_default(), law.title);
    text += &entry("parameters", &values(&law.parameters));
    text += &entry("validity", &law.validity);
    text += &entry("notes", &law.notes);
    text + &entry("reference", law.reference)
}

fn values(constants: &[Constant]) -> String {
    let value =
        |constant: &Constant| format!("{} = {} {}", constant.name, constant.value, constant.unit).trim_end().into();
    let all: Vec<String> = constants.iter().map(value).collect();
    if all.is_empty() { "none".into() } else { all.join(", ") }
}

/// `text` after its `heading`.
pub fn entry(heading: &str, text: &str) -> String {
    paragraph(&format!("  {heading:<12}"), text)
}
