//! Laws, couplings and constants that can't be used.

use super::{refused, refused_with};

#[test]
fn laws_that_do_not_go_together_are_refused_with_the_reason() {
    let cases = [
        ("walton-braun", "contact-radius", "no elastic part"),
        ("stronge", "hertz-shift", "above Hertz's"),
        ("luding", "contact-radius", "elastic again"),
        ("big-alabo", "luding", "the loading law \"luding\""),
        ("johnson", "hertz-shift", "above Hertz's"),
        ("big-alabo", "etsion", "fitted to the loading law \"kogut-etsion\""),
    ];
    for (loading, unloading, reason) in cases {
        let law = format!("yield_strength = 300e6\n[law]\nloading = \"{loading}\"\nunloading = §\"{unloading}\"\n");
        refused("yield_strength = 300e6\n", &law, &[loading, unloading, reason]);
    }
}

#[test]
fn a_restitution_that_is_missing_wrong_or_of_no_use_is_refused() {
    let damped = "[law]\nloading = \"tsuji\"\n";
    refused_with("[law]\nloading = §\"tsuji\"\n", &["needs law.restitution"]);
    refused_with(&format!("{damped}restitution = §0.0\n"), &["restitution = 0 ", "0.001 to 1"]);
    refused_with(&format!("{damped}restitution = §1.5\n"), &["restitution = 1.5", "0.001 to 1"]);
    refused_with("[law]\nrestitution = §0.5\n", &["law.restitution belongs to", "hunt-crossley", "tsuji"]);
    let own = "[law]\nloading = \"kuwabara-kono\"\nrestitution = §0.5\n";
    refused_with(own, &["law.restitution belongs to"]);
}

#[test]
fn numbers_of_adams_with_a_wrong_unit_or_twice_are_refused() {
    let adams = |constants: &str| format!("[law]\nloading = \"adams-impact\"\nloading_parameters = {{ {constants} }}");
    refused_with(&adams("stiffness = §\"1e5 N/mm^2\""), &["the unit has the power 2, but exponent = 1.5"]);
    refused_with(
        &adams("stiffness = §\"1e5 N/mm\", exponent = 2.2"),
        &["the unit has the power 1, but exponent = 2.2"],
    );
    for wrong in ["1e5 N", "1e5 N.s/mm^1.5", "1e5 N/in^1.5", "x N/mm^1.5", "1e5 N/mm^x"] {
        refused_with(
            &adams(&format!("stiffness = §\"{wrong}\"")),
            &[wrong, "a stiffness has a unit like `N/m^1.5` or `N/mm^1.5`"],
        );
    }
    refused_with(&adams("full_damping = §\"10 N/mm\""), &["a damping has a unit like `N.s/m` or `N.s/mm`"]);
    refused_with(
        &adams("stiffness = 1e9, stiffness_factor = §2.0"),
        &["stiffness_factor has no effect beside stiffness"],
    );
    refused_with(&adams("stiffness = §-1.0"), &["stiffness = -1 ", "allowed is 0 to 1e40"]);
}

#[test]
fn input_derivatives_where_the_fmu_cannot_choose_are_refused_with_the_reason() {
    let coupled = "[coupling]\neffective_mass = 4e-3\n[fmu]\ninput_derivatives = §false\n";
    refused_with(coupled, &["fmu.input_derivatives = false", "[coupling] needs them", "leave this key out"]);
    let damped = "[law]\nloading = \"tsuji\"\nrestitution = 0.5\n[fmu]\ninput_derivatives = §true\n";
    refused_with(damped, &["fmu.input_derivatives = true", "depends on the rate", "leave this key out"]);
    refused_with("[fmu]\ninput_derivatives = §\"no\"\n", &["true or false"]);
}

#[test]
fn a_strength_of_the_impactor_that_cannot_act_is_refused() {
    // softer than the target, as strong, and stronger
    for (strength, said) in [("200e6", "200000000"), ("300e6", "300000000"), ("7e9", "7e9")] {
        refused(
            "radius = 5e-3",
            &format!("radius = 5e-3\nyield_strength = §{strength}"),
            &[
                &format!("impactor.yield_strength = {said}: "),
                "rigid impactor cannot yield",
                "give impactor.youngs_modulus",
            ],
        );
    }
    refused(
        "radius = 5e-3",
        "radius = 5e-3\nhardening_modulus = §1e9",
        &["the hardening of the impactor needs impactor.yield_strength"],
    );
    refused(
        "[impactor]\nradius = 5e-3",
        "[law]\nloading = \"big-alabo\"\n[impactor]\nradius = 5e-3\nmaterial = \"mild steel\"\nyield_strength = 2e8\n\
         hardening_modulus = §1e9",
        &["the hardening of the impactor has no effect on law.loading = \"big-alabo\"", "it belongs to \"brinell\""],
    );
    refused(
        "radius = 5e-3",
        "radius = 5e-3\npower_law = { coefficient = §-1.0, exponent = 0.2 }",
        &["impactor.power_law.coefficient = -1 ", "1e-6", "Pa"],
    );
    refused(
        "radius = 5e-3",
        "radius = 5e-3\nrate = { model = §\"norton\", c = 0.1 }",
        &["impactor.rate.model", "johnson-cook"],
    );
    refused("radius = 5e-3", "radius = 5e-3\nyield_strength = §-1.0", &["impactor.yield_strength = -1 ", "1e-9", "Pa"]);
}

#[test]
fn losses_below_yield_that_cannot_be_are_refused() {
    for (number, said) in [("0.0", "0"), ("1.5", "1.5"), ("2", "2"), ("nan", "NaN")] {
        let law = format!("[law]\nelastic_restitution = §{number}\n");
        refused_with(&law, &[&format!("law.elastic_restitution = {said}"), "0.001 to 1", "waves"]);
    }
    refused_with("[law]\nelastic_restitution = §\"wave\"\n", &["wave", "0.001 to 1", "\"waves\""]);
    let own = "[law]\nloading = \"tsuji\"\nrestitution = 0.5\nelastic_restitution = §0.9\n";
    refused_with(own, &["law.elastic_restitution has no effect", "tsuji", "damping of its own"]);
    // the target of these scenes has no density
    refused_with("[law]\nelastic_restitution = §\"waves\"\n", &["waves", "needs target.density, or a material"]);
    let plate = |more: &str| format!("yield_strength = 300e6\n{more}\n");
    refused("yield_strength = 300e6\n", &plate("plate_thickness = §0.0"), &["target.plate_thickness = 0 ", "1e-9"]);
    refused("yield_strength = 300e6\n", &plate("plate_thickness = §0.01"), &["plate_thickness needs target.density"]);
    let curved = plate("density = 7850.0\nradius = §0.1\nplate_thickness = 0.01");
    refused("yield_strength = 300e6\n", &curved, &["target.radius = 0.1", "a plate is flat"]);
    let rod = plate("density = 7850.0\nlength = §0.1\narea = 1e-4\nplate_thickness = 0.01");
    refused("yield_strength = 300e6\n", &rod, &["target.length = 0.1 and target.plate_thickness", "a plate is no rod"]);
    let both = plate("density = 7850.0\nplate_thickness = §0.01\n[law]\nelastic_restitution = 0.9");
    refused("yield_strength = 300e6\n", &both, &["plate_thickness", "elastic_restitution", "one of them"]);
}

#[test]
fn half_a_rod_and_a_rod_without_a_wave_are_refused() {
    let steel = "5e-3\nmaterial = \"mild steel\"\n";
    for (key, other) in [("length", "area"), ("area", "length")] {
        let needs = [&*format!("impactor.{key} = 0.1 needs impactor.{other}"), "a rod has both"];
        refused("5e-3", &format!("{steel}{key} = §0.1"), &needs);
        let needs = [&*format!("target.{key} = 0.1 needs target.{other}"), "a rod has both"];
        refused("[target]", &format!("[target]\ndensity = 7850\n{key} = §0.1"), &needs);
    }
    let rod = "length = §0.1\narea = 1e-4\n";
    let needs = ["impactor.length = 0.1 needs impactor.youngs_modulus and poissons_ratio, or a material"];
    refused("5e-3", &format!("5e-3\ndensity = 7850\n{rod}"), &needs);
    let needs = ["target.length = 0.1 needs target.density, or a material"];
    refused("[target]", &format!("[target]\n{rod}"), &needs);
    for (value, said) in [("0", "0"), ("-0.1", "-0.1"), ("nan", "NaN"), ("inf", "inf"), ("1e7", "10000000")] {
        let key = format!("impactor.length = {said} ");
        refused("5e-3", &format!("{steel}length = §{value}\narea = 1e-4"), &[&key, "allowed is 1e-9 to 1000000 m"]);
    }
    for (value, said) in [("0", "0"), ("-1e-4", "-0.0001"), ("nan", "NaN"), ("inf", "inf"), ("1e13", "1e13")] {
        let key = format!("impactor.area = {said} ");
        refused("5e-3", &format!("{steel}length = 0.1\narea = §{value}"), &[&key, "allowed is 1e-18 to 1e12 m^2"]);
    }
    refused("5e-3", &format!("{steel}area = §\"5 mm\""), &["area", "mm is a length; an area has a unit like"]);
    refused("5e-3", &format!("{steel}length = §5mm"), &["length = 5mm: a number with a unit is in quotes: \"5 mm\""]);
}

#[test]
fn an_impact_without_an_answer_is_refused() {
    let deep = "[law]\nloading = \"jackson-green\"\n§[impact]\nmass = 1e250\nspeed = 1e9\n";
    refused_with(deep, &["mass = 1e250 kg", "speed = 1e9 m/s", "deeper than the law can be evaluated"]);
    // so light that the damper alone decides
    let endless = "[law]\nloading = \"kuwabara-kono\"\n§[impact]\nmass = 1e-30\nspeed = 1.0\n";
    refused_with(endless, &["mass = 1e-30 kg", "speed = 1 m/s", "damped so strongly that it never ends"]);
}

#[test]
fn an_unloading_law_for_a_contact_that_leaves_no_dent_is_refused() {
    let scene = "[law]\nloading = \"hunt-crossley\"\nrestitution = 0.5\nunloading = §\"thornton\"\n";
    refused_with(scene, &["law.unloading = \"thornton\"", "hunt-crossley leaves no dent"]);
}

#[test]
fn a_constant_that_a_law_has_not_got_is_refused_with_those_that_it_has() {
    refused_with(
        "[law]\nloading = \"power\"\nloading_parameters = { coefficient = 2.0, §exponnet = 1.15 }",
        &["unknown parameter of law.loading = \"power\" `exponnet`", "`coefficient`", "`exponent`"],
    );
    refused_with(
        "[law]\nunloading = \"contact-radius\"\nunloading_parameters = { §factor = 1.0 }",
        &["`factor`", "\"contact-radius\", which has none"],
    );
    refused_with(
        "[law]\nloading = \"hertz\"\nloading_parameters = { §exponent = 1.6 }",
        &["\"hertz\", which has none"],
    );
}

#[test]
fn a_constant_of_a_law_out_of_range_is_refused_with_the_range() {
    let law = |value: &str| format!("[law]\nloading = \"power\"\nloading_parameters = {{ exponent = §{value} }}");
    for (value, said) in [("0.9", "0.9"), ("2", "2"), ("nan", "NaN"), ("inf", "inf"), ("-1.2", "-1.2")] {
        let said = format!("law.loading_parameters.exponent = {said} is out of range: allowed is 1 to 1.8");
        refused_with(&law(value), &[&said]);
    }
    refused_with(&law("\"high\""), &["law.loading_parameters.exponent = \"high\" is not a number"]);
    refused_with(
        "[law]\nunloading = \"walton-braun\"\n[law.unloading_parameters]\nstiffness_ratio = §0.5",
        &["law.unloading_parameters.stiffness_ratio = 0.5", "allowed is 1 to 1000000"],
    );
    refused_with(
        "[law]\nloading = \"big-alabo\"\nloading_parameters = { second_region = §0.5 }",
        &["law.loading_parameters.second_region = 0.5", "allowed is 1 to 1000000 d_y"],
    );
}

#[test]
fn constants_that_belong_to_a_fit_as_a_whole_are_refused() {
    refused_with(
        "[law]\nloading = \"brinell\"\nloading_parameters = { §knots = [1.0, 2.0] }",
        &["knots", "fit", "brinell"],
    );
    refused_with(
        "[law]\nloading = \"brinell\"\nloading_parameters = { §fully_plastic = 80 }",
        &["fully_plastic", "fit"],
    );
}

#[test]
fn constants_out_of_order_are_refused() {
    refused_with(
        "[law]\nloading = \"big-alabo\"\nloading_parameters = { second_region = §90.0 }",
        &["law.loading_parameters.second_region = 90 must be below fully_plastic = 82.5"],
    );
    refused_with(
        "[law]\nloading = \"johnson\"\nloading_parameters = { plastic_pressure_factor = §1.0 }",
        &["yield_pressure_factor = 1.1 must be below plastic_pressure_factor = 1"],
    );
}

#[test]
fn constants_that_leave_no_law_are_refused_with_the_place_on_the_curve() {
    // each within its limits; the second region begins below the first one's end
    refused_with(
        "[law]\nloading = \"kogut-etsion\"\nunloading = \"contact-radius\"\n\
         loading_parameters = §{ second_factor = 0.5 }",
        &["with these parameters the loading force falls at", "yield indentations"],
    );
    refused_with(
        "[law]\nloading = \"ghaednia\"\nloading_parameters = §{ hardness_factor = 1.5, hardness_loss = 1.4 }",
        &["with these parameters the loading"],
    );
    // above Hertz's curve, which can't be lowered to it
    refused_with(
        "[law]\nloading = \"power\"\nunloading = \"hertz-shift\"\nloading_parameters = §{ coefficient = 9.0 }",
        &["with these parameters the unloading from", "yield indentations begins with", "instead of"],
    );
}

#[test]
fn constants_of_two_laws_that_contradict_each_other_are_refused() {
    refused_with(
        "[law]\nloading = \"luding\"\nloading_parameters = §{ stiffness_ratio = 5 }",
        &["`stiffness_ratio` must be the same", "law.loading_parameters (5)", "law.unloading_parameters (4)"],
    );
    refused_with(
        "[law]\nloading = \"kogut-etsion\"\nunloading = \"etsion\"\nloading_parameters = §{ hardness_factor = 3.0 }",
        &["\"etsion\" takes its units from \"kogut-etsion\" as published", "`hardness_factor` must be 2.8"],
    );
    refused_with("[law]\nloading = \"hertz\"\nunloading_parameters = §{}", &["unloading_parameters", "hertz unloads"]);
}

#[test]
fn a_mass_to_be_known_that_is_none_is_refused() {
    let mass = |value: &str| format!("[coupling]\neffective_mass = §{value}");
    for (value, said) in [("0.0", "0"), ("-0.0", "-0"), ("-4e-3", "-0.004"), ("nan", "NaN"), ("inf", "inf")] {
        refused_with(&mass(value), &[&format!("coupling.effective_mass = {said}")]);
    }
    refused_with("§[coupling]\n", &["effective_mass"]);
    refused_with("[coupling]\neffective_mass = 1.0\n§mass = 1.0", &["`mass`", "`effective_mass`"]);
}

#[test]
fn a_mass_from_which_the_damping_follows_is_no_input() {
    let law = "[law]\nloading = \"hunt-crossley\"\nrestitution = 0.5\n";
    let law = law.replace("hunt-crossley", "kelvin-voigt");
    let with_input = format!("{law}[coupling]\neffective_mass = 1.0\ninputs = [§\"effective_mass\"]");
    refused_with(&with_input, &["damping of kelvin-voigt", "before the first step", "leave it a parameter"]);
}

#[test]
fn a_coupling_that_there_is_not_is_refused() {
    let with = |more: &str| format!("[coupling]\neffective_mass = 1e-3\n{more}");
    refused_with(&with("§colour = 1"), &["`colour`", "`effective_mass`", "`master`", "`inputs`"]);
    refused_with(&with("master = §\"jacobi\""), &["`jacobi`", "`serial`", "`parallel`"]);
    refused_with(
        &with("inputs = [\"effective_mass\", §\"gravity\"]"),
        &["input", "`gravity`", "`external_acceleration`", "`effective_mass`"],
    );
    // an input is no parameter
    let both =
        "[fmu]\nparameters = [§\"effective_mass\"]\n[coupling]\neffective_mass = 1e-3\ninputs = [\"effective_mass\"]";
    refused_with(both, &["parameter", "`effective_mass`", "`target.yield_strength`"]);
}

#[test]
fn a_closing_speed_needs_a_mass_and_names_are_of_two_kinds() {
    refused_with("[fmu]\noutputs = [§\"closing_speed\"]", &["closing_speed", "[coupling] effective_mass"]);
    refused_with("[fmu]\nnames = §\"round\"", &["`round`", "`flat`", "`structured`"]);
}
