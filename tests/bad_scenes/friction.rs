//! Friction that can't be used.

use super::refused_with;

#[test]
fn a_coefficient_of_friction_out_of_range_is_refused() {
    for (value, said) in [("-0.1", "-0.1"), ("10.5", "10.5"), ("nan", "NaN"), ("inf", "inf"), ("1e300", "1e300")] {
        let said = format!("friction.coefficient = {said} is out of range: allowed is 0 to 10");
        refused_with(&format!("[friction]\ncoefficient = §{value}"), &[&said]);
    }
    refused_with("[friction]\ncoefficient = §\"rough\"", &["coefficient", "\"rough\"", "number"]);
    refused_with("§[friction]\n", &["missing", "`coefficient`"]);
    refused_with("[friction]\ncoefficient = 0.3\n§angle = 30", &["`angle`", "`coefficient`", "`directions`"]);
}

#[test]
fn a_number_of_tangential_directions_other_than_one_and_two_is_refused() {
    for number in ["0", "-1", "3", "1000000"] {
        refused_with(
            &format!("[friction]\ncoefficient = 0.3\ndirections = §{number}"),
            &[&format!("friction.directions = {number} is out of range"), "allowed are 1", "and 2"],
        );
    }
    refused_with("[friction]\ncoefficient = 0.3\ndirections = §1.5", &["directions", "1.5", "whole number"]);
}

#[test]
fn outputs_are_named_without_their_component() {
    for output in ["tangential_force[1]", "mean_tangential_force[2]"] {
        let text = format!("[friction]\ncoefficient = 0.3\ndirections = 2\n[fmu]\noutputs = [§\"{output}\"]");
        let name = &output[..output.len() - 3];
        refused_with(&text, &[&format!("the output {output} has no index here"), &format!("`{name}` is enough")]);
    }
}

#[test]
fn laws_without_a_tangential_force_are_refused_with_the_reason() {
    let friction = "§[friction]\ncoefficient = 0.3\n";
    for (law, parts) in [
        ("loading = \"tsuji\"\nrestitution = 0.5", ["depends on the rate", "tsuji"]),
        ("loading = \"kuwabara-kono\"", ["depends on the rate", "kuwabara-kono"]),
        ("unloading = \"hertz-shift\"", ["hertz-shift", "would have to join"]),
        ("loading = \"kogut-etsion\"\nunloading = \"etsion\"", ["etsion", "no segment"]),
        ("loading = \"vu-quoc-zhang\"\nunloading = \"vu-quoc-zhang\"", ["vu-quoc-zhang", "no segment"]),
    ] {
        refused_with(&format!("[law]\n{law}\n{friction}"), &parts);
    }
    // the message names the others
    let law = "[law]\nunloading = \"hertz-shift\"\n";
    refused_with(&format!("{law}{friction}"), &["`contact-radius`", "`thornton`", "`brinell`", "`luding`"]);
}

#[test]
fn the_passivity_guard_and_a_known_mass_are_refused_with_friction() {
    let friction = "§[friction]\ncoefficient = 0.3\n";
    refused_with(
        &format!("[law]\nunloading = \"thornton\"\npassivity_guard = true\n{friction}"),
        &["law.passivity_guard", "wasn't measured"],
    );
    for more in ["", "master = \"parallel\"\n", "inputs = [\"external_acceleration\"]\n"] {
        refused_with(
            &format!("[coupling]\neffective_mass = 4e-3\n{more}{friction}"),
            &["[coupling] effective_mass", "tangential motion within a step"],
        );
    }
}

#[test]
fn outputs_of_friction_need_friction() {
    for output in ["tangential_force", "mean_tangential_force", "friction_work", "stick_radius", "sliding"] {
        let text = format!("[fmu]\noutputs = [§\"{output}\"]");
        refused_with(&text, &[&format!("the output {output} needs friction"), "[friction] coefficient"]);
    }
    // an input is no output
    refused_with("[friction]\ncoefficient = 0.3\n[fmu]\noutputs = [§\"tangential_rate\"]", &["`tangential_rate`"]);
}

#[test]
fn friction_of_a_single_contact_is_refused() {
    refused_with(
        "[[contact]]\nname = \"left\"\nfriction = { coefficient = §0.3 }\n[[contact]]\nname = \"right\"\n",
        &["contact `left`", "needs [friction] coefficient for all", "0 is a contact without friction"],
    );
    refused_with(
        "[friction]\ncoefficient = 0.3\n[[contact]]\nname = \"left\"\nfriction = { coefficient = §11.0 }\n",
        &["left.friction.coefficient = 11 ", "0 to 10"],
    );
    refused_with(
        "[friction]\ncoefficient = 0.3\n[[contact]]\nname = \"left\"\nfriction = { §directions = 1 }\n",
        &["`directions`", "`coefficient`"],
    );
}

#[test]
fn friction_with_a_loss_below_yield_is_refused() {
    let said = ["[friction]", "law.elastic_restitution", "target.plate_thickness"];
    refused_with("§[friction]\ncoefficient = 0.3\n[law]\nelastic_restitution = 0.98", &said);
}
