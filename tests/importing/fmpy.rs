//! FMUs in fmpy, the importer of most Python users: the files of tests/fmpy/, each a topic.
//!
//! The program exports the FMUs like for a user. The files can also be run alone: see [`pytest::with_units`].

use crate::pytest;
use crate::unit::{plain_scenes, scene, scenes, write_scene};
use brinell_testing::long;
use std::fs;
use std::path::PathBuf;

/// Runs these topics of tests/fmpy/ with the FMUs of `scenes`.
fn pytest(topics: &[&str], scenes: impl IntoIterator<Item = PathBuf>) {
    let files: Vec<String> = topics.iter().map(|topic| format!("test_{topic}.py")).collect();
    pytest::pytest(&mut pytest::with_units(scenes), "fmpy", &files);
}

/// A scene of a ball of 5 mm with these lines.
fn ball(name: &str, lines: &str) -> PathBuf {
    let impactor = if lines.contains("impactor = ") { "" } else { "impactor = { radius = 5e-3 }\n" };
    write_scene(name, &format!("name = \"{name}\"\n{impactor}{lines}\n"))
}

const STEEL: &str = "target = { material = \"mild steel\" }\n";
/// A target of unknown density.
const BARE: &str = "youngs_modulus = 206e9, poissons_ratio = 0.3, yield_strength = 300e6";
const IMPACT: &str = "impact = { mass = 4e-3, speed = 1.0 }\n";
const KNOWN: &str = "coupling = { effective_mass = 4e-3 }\n";

/// The contact of scenes/mass_known.toml for this kind of importer, with these inputs and more outputs.
fn for_master(name: &str, master: &str, inputs: &[&str]) -> PathBuf {
    let text = fs::read_to_string(scene("mass_known")).expect("a scene file");
    let text = text.replacen("\"mass_known\"", &format!("\"{name}\""), 1);
    let text = text.replacen("outputs = [", "outputs = [\"elastic_energy\", \"work\", \"closing_speed\", ", 1);
    write_scene(name, &format!("{text}master = \"{master}\"\ninputs = {inputs:?}\n"))
}

/// The possible additional inputs of an FMU that knows the mass.
const BOTH_INPUTS: [&str; 2] = ["external_acceleration", "effective_mass"];

/// A steel ball of 5 mm on mild steel, with each loss below yield: moved by the FMU, and with a held rate.
fn with_losses() -> Vec<PathBuf> {
    let losses = [
        ("fitted", "", ", elastic_restitution = 0.98"),
        ("waves", "", ", elastic_restitution = \"waves\""),
        ("plate", ", plate_thickness = 0.01", ""),
    ];
    let moved = "[coupling]\neffective_mass = 4.1e-3";
    let kinds = [("moved", ", \"closing_speed\", \"mean_force\"", moved), ("held", "", "")];
    let scene = |(name, target, law): (&str, &str, &str), (kind, outputs, coupling): (&str, &str, &str)| {
        let text = format!(
            "impactor = {{ material = \"steel AISI 1018\", radius = 5e-3 }}\n\
             target = {{ material = \"mild steel\"{target} }}\nlaw = {{ loading = \"brinell\"{law} }}\n\
             fmu = {{ outputs = [\"indentation\", \"residual_indentation\", \"dissipated_energy\", \"elastic_energy\", \
             \"work\"{outputs}] }}\nimpact = {{ mass = 4.1e-3, speed = 3.13 }}\n{coupling}"
        );
        ball(&format!("{name}_{kind}"), &text)
    };
    losses.iter().flat_map(|loss| kinds.iter().map(|kind| scene(*loss, *kind))).collect()
}

/// A ball that the FMU moves, with a rate-dependent law, for each kind of importer.
fn damped_and_moved() -> [PathBuf; 2] {
    let outputs = ["indentation", "work", "elastic_energy", "dissipated_energy", "closing_speed", "mean_force"];
    let inputs = "master = \"parallel\"\ninputs = [\"external_acceleration\"]";
    let kinds = [("hunt_moved", "hunt-crossley", 0.7, ""), ("kelvin_moved", "kelvin-voigt", 0.5, inputs)];
    kinds.map(|(name, law, restitution, more)| {
        let text = format!(
            "{STEEL}law = {{ loading = \"{law}\", restitution = {restitution} }}\nimpact = {{ mass = 4.1e-3, speed = 2.0 }}\n\
             fmu = {{ outputs = {outputs:?} }}\n[coupling]\neffective_mass = 4.1e-3\n{more}"
        );
        ball(name, &text)
    })
}

/// Each rate-dependent law with a held rate.
fn damped() -> [PathBuf; 5] {
    let asked = ", restitution = 0.6";
    let outputs = ["indentation", "mean_pressure", "stiffness", "work", "elastic_energy", "dissipated_energy"];
    let laws = [
        ("hunt-crossley", asked),
        ("kelvin-voigt", asked),
        ("tsuji", asked),
        ("kuwabara-kono", ""),
        ("adams-impact", ""),
    ];
    laws.map(|(law, more)| {
        let text = format!("{STEEL}law = {{ loading = \"{law}\"{more} }}\nfmu = {{ outputs = {outputs:?} }}");
        ball(&law.replace('-', "_"), &text)
    })
}

fn masters() -> [PathBuf; 4] {
    [
        for_master("serial", "serial", &[]),
        for_master("parallel", "parallel", &[]),
        for_master("serial_wired", "serial", &BOTH_INPUTS),
        for_master("parallel_wired", "parallel", &BOTH_INPUTS),
    ]
}

#[test]
fn the_model_description_is_valid() {
    let one = fs::read_to_string(scene("steel_ball")).expect("a scene file");
    let several = fs::read_to_string(scene("two_contacts")).expect("a scene file");
    let named = |text: &str, names: &str| text.replacen("[fmu]", &format!("[fmu]\nnames = \"{names}\""), 1);
    let more = [("several", "big-alabo"), ("several_damped", "adams-impact")].map(|(name, law)| {
        let contacts = "contact = [ { name = \"left\" }, { name = \"row\", count = 20 }, \
                        { name = \"right\", target = { youngs_modulus = 70e9 }, initial_gap = 1e-6 } ]";
        let law = format!("law = {{ loading = \"{law}\" }}\nfmu = {{ outputs = [\"indentation\"] }}\n");
        ball(name, &format!("{STEEL}{law}{contacts}"))
    });
    let written = [
        write_scene("structured_names", &named(&one, "structured")),
        write_scene("flat_names", &named(&several, "flat")),
        for_master("both_inputs", "parallel", &BOTH_INPUTS),
        for_master("parallel", "parallel", &[]),
    ];
    // fmpy takes half a minute for the names of thousands of contacts
    let own = scenes().into_iter().filter(|scene| long::is_asked() || !scene.ends_with("many_contacts.toml"));
    pytest(&["model_description_is_valid"], own.chain(written).chain(more));
}

#[test]
fn the_first_lines_and_systems_of_every_scene_run() {
    pytest(&["first_lines", "ssp"], scenes());
}

#[test]
fn plain_scenes_are_simulated_by_one_call() {
    pytest(&["simulate_fmu"], plain_scenes());
}

#[test]
fn losses_and_dampings_follow_the_rate_as_declared_and_come_to_rest() {
    let moved = with_losses().into_iter().chain(damped_and_moved());
    pytest(&["follows_the_rate", "comes_to_rest"], moved.chain(damped()));
}

#[test]
fn couplings_have_their_errors_and_derivatives_are_those_of_the_force() {
    pytest(&["coupling", "derivatives"], [scene("coupled")]);
}

#[test]
fn a_master_that_moves_a_falling_ball_wrongly_is_told_so_in_words() {
    let watched = ball("watched", &format!("{STEEL}{IMPACT}fmu = {{ outputs = [\"predicted_force\"] }}"));
    pytest(&["wrong_masters"], masters().into_iter().chain([watched]));
}

#[test]
fn leaving_the_validity_of_the_law_is_told_in_whole_sentences() {
    let shown = ["indentation", "max_indentation", "contact_radius"];
    let momentum = ["indentation", "max_indentation", "contact_radius", "impulse", "mean_force"];
    let with = |name: &str, law: &str, surface: &str, outputs: &[&str], more: &str| {
        let target = format!("target = {{ {BARE}, surface = \"{surface}\" }}\nlaw = {{ {law} }}\n");
        ball(name, &format!("{IMPACT}{more}{target}fmu = {{ outputs = {outputs:?} }}"))
    };
    let law = "loading = \"big-alabo\"";
    let guarded = "loading = \"stronge\", unloading = \"thornton\", passivity_guard = true";
    let groups = format!(
        r#"{IMPACT}law = {{ {law} }}
contact = [
    {{ name = "left", target = {{ {BARE}, density = 5e3 }} }},
    {{ name = "row", count = 20, target = {{ material = "aluminium 6061-T6" }} }},
    {{ name = "right", target = {{ youngs_modulus = 70e9, poissons_ratio = 0.3, yield_strength = 300e6 }} }},
]
fmu = {{ outputs = ["indentation", "max_indentation"] }}
"#
    );
    let units = [
        scene("steel_ball"),
        with("plain", law, "dented", &shown, ""),
        with("tangents", "loading = \"jackson-green\"", "dented", &shown, ""),
        with("damped_and_deep", "loading = \"adams-impact\"", "dented", &shown, ""),
        with("momentum", law, "dented", &momentum, ""),
        with("known_dented", law, "dented", &shown, KNOWN),
        with("known_fresh", law, "fresh", &shown, KNOWN),
        ball("own_densities", &groups),
        with("guarded", guarded, "dented", &["work", "dissipated_energy"], ""),
    ];
    pytest(&["messages"], units);
}
