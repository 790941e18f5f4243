//! FMUs in fmpy, the importer of most Python users: one test for each file in tests/fmpy/.
//!
//! The program exports the FMUs like for a user. The files can also be run alone: see [`pytest::pytest`].

use crate::pytest;
use crate::unit::{export, plain_scenes, scene, scenes, steel_ball_with_regime, write_scene};
use std::fs;
use std::path::PathBuf;

/// Runs tests/fmpy/`file` with the FMUs of `scenes`.
fn pytest(file: &str, scenes: &[PathBuf]) {
    let name = |scene: &PathBuf| scene.file_stem().unwrap().to_string_lossy().into_owned();
    pytest::pytest(file, &scenes.iter().map(|scene| (name(scene), export(scene))).collect());
}

fn steel_ball() -> [PathBuf; 1] {
    [scene("steel_ball")]
}

/// The case of the reference tables: a rigid sphere of 5 mm on E = 206 GPa, nu = 0.3, S = 300 MPa.
fn reference_case(name: &str, unloading: &str, surface: &str) -> PathBuf {
    let text = format!(
        r#"
name = "{name}"
impactor = {{ radius = 5e-3 }}
target = {{ youngs_modulus = 206e9, poissons_ratio = 0.3, yield_strength = 300e6, surface = "{surface}" }}
law = {{ loading = "big-alabo", unloading = "{unloading}" }}
fmu = {{ outputs = ["indentation", "max_indentation", "residual_indentation", "dissipated_energy", "work", "regime"] }}
"#
    );
    write_scene(name, &text)
}

#[test]
fn the_model_description_is_valid() {
    let one = fs::read_to_string(scene("steel_ball")).expect("a scene file");
    let several = fs::read_to_string(scene("two_contacts")).expect("a scene file");
    let named = |text: &str, names: &str| text.replacen("[fmu]", &format!("[fmu]\nnames = \"{names}\""), 1);
    let mut all = scenes();
    all.push(write_scene("structured_names", &named(&one, "structured")));
    all.push(write_scene("flat_names", &named(&several, "flat")));
    all.push(for_master("both_inputs", "parallel", &BOTH_INPUTS));
    all.push(for_master("parallel", "parallel", &[]));
    pytest("test_model_description_is_valid.py", &all);
}

#[test]
fn the_page_of_an_fmu_begins_with_lines_that_run_as_printed() {
    pytest("test_first_lines.py", &scenes());
}

/// A steel ball of 5 mm that the FMU moves, on mild steel, with this loss.
fn with_loss(name: &str, target: &str, law: &str, coupling: &str) -> PathBuf {
    let text = format!(
        r#"
name = "{name}"
impactor = {{ material = "steel AISI 1018", radius = 5e-3 }}
target = {{ material = "mild steel"{target} }}
law = {{ loading = "brinell"{law} }}
fmu = {{ outputs = ["indentation", "residual_indentation", "dissipated_energy", "elastic_energy", "work"{}], initial_gap = {} }}
impact = {{ mass = 4.1e-3, speed = 3.13 }}
{coupling}
"#,
        if coupling.is_empty() { "" } else { ", \"closing_speed\"" },
        if coupling.is_empty() { 0.0 } else { 0.5 },
    );
    write_scene(name, &text)
}

#[test]
fn a_dropped_ball_comes_to_rest_with_each_loss() {
    let mass = "coupling = { effective_mass = 4.1e-3 }";
    let losses = [
        ("fitted", "", ", elastic_restitution = 0.98"),
        ("waves", "", ", elastic_restitution = \"waves\""),
        ("plate", ", plate_thickness = 0.01", ""),
    ];
    let units = losses.iter().flat_map(|(name, target, law)| {
        [with_loss(&format!("{name}_moved"), target, law, mass), with_loss(&format!("{name}_held"), target, law, "")]
    });
    let units: Vec<_> = units.collect();
    pytest("test_comes_to_rest.py", &units);
    for file in ["test_initial_values.py", "test_state_is_restored.py"] {
        pytest(file, &units);
    }
}

/// A ball that the FMU moves, on a target with this strain rate.
fn with_rate(name: &str, target: &str, law: &str, more: &str) -> PathBuf {
    let text = format!(
        r#"
name = "{name}"
impactor = {{ radius = 5e-3 }}
law = {{ loading = "{law}" }}
impact = {{ mass = 4.11e-3, speed = 2.0 }}
[target]
material = "mild steel"
{target}
[fmu]
outputs = ["max_indentation", "residual_indentation", "dissipated_energy", "closing_speed", "predicted_force"]
[coupling]
effective_mass = 4.11e-3
{more}
"#
    );
    write_scene(name, &text)
}

#[test]
fn a_unit_that_knows_the_mass_finds_the_strength_of_each_impact() {
    let johnson_cook = "rate = { model = \"johnson-cook\", c = 0.014, reference_rate = 1.0 }";
    let cowper_symonds = "rate = { model = \"cowper-symonds\", d = 40.4, q = 5 }";
    let inputs = "master = \"parallel\"\ninputs = [\"external_acceleration\", \"effective_mass\"]";
    let two = "[[contact]]\nname = \"hard\"\ntarget = { yield_strength = 900e6 }\n[[contact]]\nname = \"soft\"\n";
    let units = [
        with_rate("parallel", cowper_symonds, "brinell", inputs),
        with_rate("fresh", &format!("{cowper_symonds}\nhardening_modulus = 2e9\nsurface = \"fresh\""), "brinell", ""),
        with_rate("two", johnson_cook, "big-alabo", two),
    ];
    pytest("test_strength_of_each_impact.py", &units);
    for file in ["test_initial_values.py", "test_state_is_restored.py"] {
        pytest(file, &units[..2]);
    }
}

#[test]
fn a_unit_with_a_rate_dependent_law_moves_its_bodies() {
    let outputs = ["indentation", "work", "elastic_energy", "dissipated_energy", "closing_speed"];
    let units = [
        ("hunt", "loading = \"hunt-crossley\"\nrestitution = 0.7", ""),
        (
            "kelvin",
            "loading = \"kelvin-voigt\"\nrestitution = 0.5",
            "master = \"parallel\"\ninputs = [\"external_acceleration\"]",
        ),
    ];
    let units = units.map(|(name, law, more)| {
        let text = format!(
            "name = \"{name}\"\nimpactor = {{ radius = 5e-3 }}\ntarget = {{ material = \"mild steel\" }}\n[law]\n{law}\n\
             [impact]\nmass = 4.11e-3\nspeed = 2.0\n[fmu]\noutputs = {outputs:?}\n[coupling]\neffective_mass = 4.11e-3\n{more}\n"
        );
        write_scene(name, &text)
    });
    for file in ["test_damped_bodies_move.py", "test_initial_values.py", "test_state_is_restored.py"] {
        pytest(file, &units);
    }
}

#[test]
fn values_before_the_first_step_are_those_of_the_model_description() {
    pytest("test_initial_values.py", &plain_scenes());
}

#[test]
fn parameters_are_taken_within_their_limits_and_nowhere_else() {
    pytest("test_parameter_limits.py", &plain_scenes());
}

#[test]
fn parameters_take_effect_whenever_they_may_be_set() {
    pytest("test_parameters_take_effect.py", &steel_ball());
}

#[test]
fn a_prescribed_history_gives_the_tabulated_forces() {
    let closures = ["contact-radius", "thornton", "original-radius"];
    let scenes = closures.map(|closure| reference_case(&closure.replace('-', "_"), closure, "dented"));
    pytest("test_prescribed_history.py", &scenes);
}

#[test]
fn a_contact_that_has_opened_closes_again_according_to_its_surface() {
    let scenes =
        [reference_case("dented", "contact-radius", "dented"), reference_case("fresh", "contact-radius", "fresh")];
    pytest("test_contact_closes_again.py", &scenes);
}

#[test]
fn a_restored_state_continues_with_the_same_bits() {
    pytest("test_state_is_restored.py", &plain_scenes());
}

#[test]
fn damaged_and_foreign_states_are_refused() {
    pytest("test_damaged_state_is_refused.py", &[scene("steel_ball"), scene("everything")]);
}

#[test]
fn a_free_ball_rebounds_obliquely_as_in_the_table() {
    pytest("test_friction.py", &[scene("oblique"), scene("steel_ball")]);
    pytest("test_friction_in_two_directions.py", &[scene("two_directions")]);
}

#[test]
fn steps_are_checked_without_pedantry() {
    pytest("test_steps.py", &[scene("steel_ball"), scene("everything")]);
}

#[test]
fn inputs_are_finite_and_so_are_outputs() {
    pytest("test_inputs.py", &plain_scenes());
}

#[test]
fn the_force_of_rate_dependent_laws_follows_the_input() {
    let laws = [
        ("hunt-crossley", "restitution = 0.6"),
        ("kelvin-voigt", "restitution = 0.6"),
        ("tsuji", "restitution = 0.6"),
        ("kuwabara-kono", ""),
        ("adams-impact", ""),
    ];
    let scenes = laws.map(|(law, more)| {
        let name = law.replace('-', "_");
        let outputs = r#"["indentation", "mean_pressure", "stiffness", "work", "elastic_energy", "dissipated_energy"]"#;
        let text = format!(
            "name = \"{name}\"\n[impactor]\nradius = 5e-3\n[target]\nmaterial = \"mild steel\"\n\
             [law]\nloading = \"{law}\"\n{more}\n[fmu]\noutputs = {outputs}\n"
        );
        write_scene(&name, &text)
    });
    for file in ["test_force_follows_the_rate.py", "test_initial_values.py"] {
        pytest(file, &scenes);
    }
}

/// The bodies of scenes/coupled.toml with these lines of `[fmu]` and what follows it.
fn with_bodies_of_coupled(name: &str, more: &str) -> PathBuf {
    let bodies = "[impactor]\nradius = 5e-3\n[target]\nmaterial = \"mild steel\"\n";
    write_scene(name, &format!("name = \"{name}\"\n{bodies}[impact]\nmass = 4e-3\nspeed = 1.0\n{more}\n"))
}

/// The possible additional inputs of an FMU that knows the mass.
const BOTH_INPUTS: [&str; 2] = ["external_acceleration", "effective_mass"];

/// The contact of scenes/mass_known.toml for this kind of importer, with these inputs and more outputs.
fn for_master(name: &str, master: &str, inputs: &[&str]) -> PathBuf {
    let text = fs::read_to_string(scene("mass_known")).expect("a scene file");
    let text = text.replacen("\"mass_known\"", &format!("\"{name}\""), 1);
    let text = text.replacen("outputs = [", "outputs = [\"elastic_energy\", \"work\", \"closing_speed\", ", 1);
    write_scene(name, &format!("{text}master = \"{master}\"\ninputs = {inputs:?}\n"))
}

#[test]
fn masters_of_both_orders_of_execution_find_the_predicted_rebound() {
    let scenes = [
        for_master("serial", "serial", &[]),
        for_master("parallel", "parallel", &[]),
        for_master("serial_wired", "serial", &BOTH_INPUTS),
        for_master("parallel_wired", "parallel", &BOTH_INPUTS),
        with_bodies_of_coupled("energies", ENERGIES),
        scene("coupled"),
        scene("mass_known"),
    ];
    pytest("test_masters.py", &scenes);
}

const ENERGIES: &str = r#"[fmu]
outputs = ["residual_indentation", "work", "elastic_energy", "mean_force"]"#;

#[test]
fn each_way_of_coupling_has_its_error_and_order() {
    let energies = with_bodies_of_coupled("energies", ENERGIES);
    pytest("test_coupling.py", &[scene("coupled"), scene("mass_known"), energies]);
}

#[test]
fn derivatives_and_momentum_have_the_meaning_of_the_standard() {
    let all_outputs = r#"
name = "all_outputs"
impactor = { radius = 10e-3, youngs_modulus = 210e9, poissons_ratio = 0.3 }
target = { material = "aluminium 6061-T6", radius = -50e-3, surface = "fresh" }
law = { loading = "jackson-green", unloading = "jackson" }
fmu = { outputs = [
    "indentation", "max_indentation", "residual_indentation", "contact_radius", "contact_area", "mean_pressure", "stiffness", "work",
    "elastic_energy", "dissipated_energy", "impulse", "mean_force", "predicted_force", "regime"] }
"#;
    let rate_dependent = "[law]\nloading = \"hunt-crossley\"\nrestitution = 0.6\n\
        [fmu]\noutputs = [\"impulse\", \"mean_force\", \"predicted_force\"]";
    let two = "[[contact]]\nname = \"left\"\n[[contact]]\nname = \"right\"\n";
    let outputs = "[fmu]\noutputs = [\"indentation\", \"max_indentation\", \"impulse\", \"mean_force\"]\n";
    let known = "impactor = { radius = 8e-3 }\n[coupling]\neffective_mass = 4e-3";
    let scenes = [
        scene("coupled"),
        scene("mass_known"),
        scene("steel_ball"),
        write_scene("all_outputs", all_outputs),
        with_bodies_of_coupled("energies", ENERGIES),
        with_bodies_of_coupled("rate_dependent", rate_dependent),
        with_bodies_of_coupled("two_plain", &format!("{outputs}{two}")),
        with_bodies_of_coupled("two_known", &format!("{outputs}{two}{known}")),
    ];
    pytest("test_derivatives.py", &scenes);
    pytest("test_momentum.py", &scenes);
}

#[test]
fn calls_out_of_order_and_wrong_references_are_refused() {
    pytest("test_call_order.py", &[steel_ball_with_regime()]);
}

#[test]
fn messages_are_complete_and_only_where_something_is_wrong() {
    pytest("test_messages.py", &steel_ball());
}

#[test]
fn the_passivity_guard_is_logged_when_it_first_acts() {
    let text = r#"
name = "guarded"
impactor = { radius = 5e-3 }
target = { youngs_modulus = 206e9, poissons_ratio = 0.3, yield_strength = 300e6 }
law = { loading = "stronge", unloading = "thornton", passivity_guard = true }
fmu = { outputs = ["work", "dissipated_energy"] }
"#;
    pytest("test_passivity_guard.py", &[write_scene("guarded", text)]);
}

/// A scene of a rigid sphere of 5 mm on a target of unknown density.
fn with_unknown_density(name: &str, law: &str, more: &str) -> PathBuf {
    let text = format!(
        "name = \"{name}\"\nimpactor = {{ radius = 5e-3 }}\nlaw = {{ {law} }}\n\
         impact = {{ mass = 4e-3, speed = 1.0 }}\n{more}\n"
    );
    write_scene(name, &text)
}

#[test]
fn leaving_the_validity_of_the_law_is_logged_once() {
    let target = |surface: &str| {
        let numbers = "youngs_modulus = 206e9, poissons_ratio = 0.3, yield_strength = 300e6";
        format!("target = {{ {numbers}, surface = \"{surface}\" }}\n")
    };
    let with = |surface: &str, outputs: &str| format!("{}fmu = {{ outputs = [{outputs}] }}\n", target(surface));
    let shown = r#""indentation", "max_indentation", "contact_radius""#;
    let momentum = format!(r#"{shown}, "impulse", "mean_force""#);
    let known = "coupling = { effective_mass = 4e-3 }\n";
    let law = "loading = \"big-alabo\"";
    let groups = r#"
contact = [
    { name = "left", target = { youngs_modulus = 206e9, poissons_ratio = 0.3, yield_strength = 300e6, density = 5e3 } },
    { name = "row", count = 20, target = { material = "aluminium 6061-T6" } },
    { name = "right", target = { youngs_modulus = 70e9, poissons_ratio = 0.3, yield_strength = 300e6 } },
]
fmu = { outputs = ["indentation", "max_indentation"] }
"#;
    let scenes = [
        scene("steel_ball"),
        with_unknown_density("plain", law, &with("dented", shown)),
        with_unknown_density("fresh_and_deep", law, &with("fresh", shown)),
        with_unknown_density("tangents", "loading = \"jackson-green\"", &with("dented", shown)),
        with_unknown_density("damped_and_deep", "loading = \"adams-impact\"", &with("dented", shown)),
        with_unknown_density("momentum", law, &with("dented", &momentum)),
        with_unknown_density("known_dented", law, &(with("dented", shown) + known)),
        with_unknown_density("known_fresh", law, &(with("fresh", shown) + known)),
        with_unknown_density("own_densities", law, groups),
    ];
    pytest("test_validity_warnings.py", &scenes);
}

#[test]
fn many_instances_and_threads_do_not_disturb_each_other() {
    pytest("test_many_instances.py", &steel_ball());
}

#[test]
fn a_stack_moves_together_keeps_its_energy_and_comes_to_rest() {
    pytest("test_shared_bodies.py", &[scene("stack")]);
}

#[test]
fn a_crate_on_a_slope_keeps_its_energy_and_comes_to_rest() {
    pytest("test_shared_friction.py", &[scene("slope")]);
}

#[test]
fn several_contacts_are_described_as_they_are() {
    let scenes =
        [("several", "law = { loading = \"big-alabo\" }"), ("several_damped", "law = { loading = \"adams-impact\" }")];
    let scenes = scenes.map(|(name, law)| {
        let text = format!(
            r#"
name = "{name}"
{law}
impactor = {{ radius = 5e-3 }}
target = {{ material = "mild steel" }}
fmu = {{ outputs = ["indentation"] }}
contact = [
    {{ name = "left" }},
    {{ name = "row", count = 100 }},
    {{ name = "right", target = {{ youngs_modulus = 70e9 }}, initial_gap = 1e-6 }},
]
"#
        );
        write_scene(name, &text)
    });
    pytest("test_several_contacts.py", &scenes);
}

#[test]
fn simulate_fmu_runs_with_its_defaults() {
    pytest("test_simulate_fmu.py", &plain_scenes());
}

#[test]
fn systems_are_valid_and_run_like_their_fmu() {
    pytest("test_ssp.py", &scenes());
}
