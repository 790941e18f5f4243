//! Claims about all tools and their laws.

use brinell_exporter::layout::WIDTH;
use brinell_exporter::scene::Scene;
use brinell_exporter::translate::law::Law;
use brinell_exporter::translate::motion::{Outcome, Promise, Stepping, exact, in_steps};
use brinell_exporter::translate::tools::{TOOLS, named};
use brinell_exporter::translate::{Request, TranslateError, Translation, numbers, speeds, text, translate};
use std::path::Path;
use std::sync::LazyLock;

fn scene(more: &str) -> Scene {
    let text = format!("name = \"ball\"\nimpactor = {{ radius = 5e-3 }}\n{more}");
    Scene::parse(text, Path::new("ball.toml")).unwrap()
}

const STEEL: &str = "target = { material = \"mild steel\" }\nimpact = { mass = 4e-3, speed = 1.0 }\n";

fn asked(tool: &str) -> Request<'_> {
    Request { tool, speeds: None, step: None, millimetres: false }
}

/// Steel in every tool, at the step of each tool and at this one, in which a ball is too soft [s].
const LONG: f64 = 1e-3;
static OF_STEEL: LazyLock<Vec<(Option<f64>, Translation)>> = LazyLock::new(|| {
    let scene = scene(STEEL);
    let of = |step| TOOLS.iter().map(move |tool| (step, Request { step, ..asked(&tool.name) }));
    let all = of(None).chain(of(Some(LONG)));
    all.map(|(step, request)| (step, translate(&scene, &request).unwrap())).collect()
});

fn spring(ratio: f64) -> Law {
    Law::Spring { stiffness: 1e7, damping: 2.0 * ratio * (1e7_f64 * 4e-3).sqrt(), pulls: false }
}

fn restitution(law: &Law) -> f64 {
    exact(law, 4e-3, 1.7).unwrap().restitution
}

/// The closed form of a spring and a damper that never pulls.
#[test]
fn a_spring_and_a_damper_rebound_as_their_closed_form_says() {
    for (wanted, ratio) in [(0.9, 0.03427), (0.7, 0.12221), (0.5, 0.25528), (0.3, 0.49724), (0.2, 0.73125)] {
        assert!((restitution(&spring(ratio)) - wanted).abs() < 2e-5, "{wanted}");
    }
    let s = (1.0_f64 - 0.25528 * 0.25528).sqrt();
    let phase = (2.0 * 0.25528 * s).atan2(2.0 * 0.25528 * 0.25528 - 1.0);
    let outcome = exact(&spring(0.25528), 4e-3, 1.7).unwrap();
    let frequency = (1e7_f64 / 4e-3).sqrt();
    assert!((outcome.contact_time * s * frequency / phase - 1.0).abs() < 1e-8);
    let turning = (-0.25528 * 0.25528_f64.acos() / s).exp();
    assert!((outcome.depth * frequency / 1.7 / turning - 1.0).abs() < 1e-8);
    let peak =
        (-0.25528 / s * (s * (1.0 - 4.0 * 0.25528 * 0.25528)).atan2(0.25528 * (3.0 - 4.0 * 0.25528 * 0.25528))).exp();
    assert!((outcome.largest_force / (1.7 * (4e-3 * 1e7_f64).sqrt() * peak) - 1.0).abs() < 1e-6);
}

/// Hunt and Crossley: `a - ln(1 + a) = -e a - ln(1 - e a)` with `a = d v`, for every stiffness and exponent.
#[test]
fn a_hunt_crossley_contact_rebounds_as_its_first_integral_says() {
    for exponent in [1.0, 1.5, 2.3] {
        for factor in [0.1665, 1.4328, 4.9192] {
            let law = Law::HuntCrossley { stiffness: 1e9, exponent, dissipation: factor / 1.7 };
            let e = restitution(&law);
            let balance = factor - factor.ln_1p() + e * factor + (-e * factor).ln_1p();
            assert!(balance.abs() < 1e-8, "{exponent} {factor}: {e}");
        }
    }
}

#[test]
fn a_hertz_contact_with_damping_in_proportion_rebounds_alike_at_every_speed() {
    let law =
        Law::Proportional { stiffness: 1e9, exponent: 1.5, factor: 0.25528 * 5.0_f64.sqrt(), mass: 4e-3, pulls: false };
    for speed in [0.01, 1.0, 30.0] {
        assert!((exact(&law, 4e-3, speed).unwrap().restitution - 0.5).abs() < 2e-5);
    }
    let pulling =
        Law::Proportional { stiffness: 1e9, exponent: 1.5, factor: 0.21545 * 5.0_f64.sqrt(), mass: 4e-3, pulls: true };
    assert!((restitution(&pulling) - 0.5).abs() < 2e-5);
}

/// Below the limit `1/sqrt(1 + (k2/k1 - 1) v/vl)`, above `sqrt(1 - (vl/v)^2 (1 - k1/k2))`.
#[test]
fn ludings_contact_rebounds_as_its_closed_form_says() {
    let (loading, unloading, limit) = (1e7, 5e7, 2e-5);
    let law = Law::Luding { loading, unloading, limit, late: None };
    let fastest = limit * (loading / 4e-3_f64).sqrt();
    for part in [0.01, 0.5, 0.99] {
        let e = exact(&law, 4e-3, part * fastest).unwrap().restitution;
        assert!((e * (1.0 + 4.0 * part).sqrt() - 1.0).abs() < 1e-7, "{part}: {e}");
    }
    let e = exact(&law, 4e-3, 2.0 * fastest).unwrap().restitution;
    assert!((e - (1.0 - 0.25 * 0.8_f64).sqrt()).abs() < 1e-7, "{e}");
}

/// `e^2 = (1 - p^(1 + 1/n) - (n + 1) p (1 - p^(1/n)))/(1 - p)`; `sqrt(1 - p)` for n = 1.
#[test]
fn a_contact_that_unloads_steeper_rebounds_as_its_closed_form_says() {
    for (exponent, ratio) in [(1.0, 0.3), (1.5, 0.5), (2.3, 0.9_f64)] {
        let left = ratio.powf(1.0 / exponent);
        let square = (1.0 - ratio * left - (exponent + 1.0) * ratio * (1.0 - left)) / (1.0 - ratio);
        for speed in [0.1, 3.0] {
            let outcome = exact(&Law::Steeper { stiffness: 1e8, exponent, ratio }, 4e-3, speed).unwrap();
            assert!((outcome.restitution - square.sqrt()).abs() < 1e-7, "{exponent} {ratio}: {outcome:?}");
        }
    }
}

#[test]
fn steps_that_grow_shorter_come_to_the_exact_impact() {
    for (law, stepping) in [
        (spring(0.2), Stepping::Explicit),
        (spring(0.2), Stepping::Implicit),
        (spring(0.2), Stepping::Predicted),
        (spring(0.2), Stepping::Stretched),
        (Law::HuntCrossley { stiffness: 1e7, exponent: 1.0, dissipation: 0.8 }, Stepping::Lagged),
    ] {
        let exact = exact(&law, 4e-3, 1.0).unwrap();
        let error = |count: f64| {
            let step = exact.contact_time / count;
            let Outcome { restitution, .. } = in_steps(&law, stepping, 4e-3, 1.0, step, 0.5);
            (restitution - exact.restitution).abs()
        };
        assert!(error(8000.0) < 1.2e-3 && error(8000.0) < 0.3 * error(1000.0) + 1e-5, "{stepping:?} {}", error(8000.0));
    }
}

#[test]
fn a_step_of_a_tenth_spreads_the_rebound_as_far_as_was_measured() {
    let law = spring(0.25528);
    let step = exact(&law, 4e-3, 1.0).unwrap().contact_time / 10.0;
    for (stepping, least, most) in [(Stepping::Explicit, 0.459, 0.531), (Stepping::Implicit, 0.352, 0.424)] {
        let promise = Promise::at(&law, stepping, 4e-3, 1.0, step).unwrap();
        assert!((promise.least_restitution - least).abs() < 4e-3, "{promise:?}");
        assert!((promise.most_restitution - most).abs() < 4e-3, "{promise:?}");
    }
}

#[test]
fn every_tool_has_every_number_of_its_block() {
    for (step, translation) in OF_STEEL.iter() {
        // a softened ball sinks in too deep for a plastic sphere; Hunt and Crossley's restitution is for less loss
        let whole = |why: &&String| {
            let deep = step.is_some() && why.contains("is not computed for overlaps beyond");
            !deep && !why.contains("impactModel 1: no restitutionCoefficient leads to a restitution of 0.440")
        };
        assert_eq!(translation.left_out.iter().find(whole), None);
        for way in &translation.ways {
            let rest = way.block.split('{').skip(1).filter(|rest| rest.starts_with(|c: char| c.is_ascii_lowercase()));
            assert_eq!(rest.count(), 0, "{}", way.block);
            assert!(way.numbers.iter().all(|number| number.value.is_finite() && number.value > 0.0), "{way:?}");
            assert!(way.notes.iter().all(|note| !note.contains('{')), "{:?}", way.notes);
        }
    }
}

#[test]
fn every_number_of_a_tool_with_millimetres_has_a_unit_for_them() {
    for tool in TOOLS.iter().filter(|tool| tool.units.is_some()) {
        let all = tool.ways.iter().flat_map(|way| &way.numbers);
        all.for_each(|number| assert!(numbers::in_millimetres(&number.unit, 1.5).is_some(), "{}", number.unit));
    }
}

#[test]
fn a_tool_is_found_in_every_spelling() {
    for (asked, meant) in
        [("MuJoCo", "mujoco"), ("PyBullet", "bullet"), ("MSC Adams", "adams"), ("gazebo_classic", "gazebo")]
    {
        assert_eq!(named(asked).unwrap().name, meant);
    }
    let mut names: Vec<&str> =
        TOOLS.iter().flat_map(|tool| tool.aliases.iter().chain([&tool.name])).map(String::as_str).collect();
    let count = names.len();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), count, "a name has two tools");
    let refused = named("abaqus").unwrap_err();
    assert!(TOOLS.iter().all(|tool| refused.contains(&tool.name)), "{refused}");
}

#[test]
fn elastic_and_very_plastic_scenes_have_numbers_or_a_reason() {
    let elastic = format!("{STEEL}law = {{ loading = \"hertz\" }}\n");
    let soft = "target = { youngs_modulus = 200e9, poissons_ratio = 0.3, yield_strength = 20e6 }\nimpact = { mass = 4e-3, speed = 1.0 }\n";
    for text in [elastic.as_str(), soft] {
        let scene = scene(text);
        for tool in TOOLS.iter() {
            let request = Request { speeds: Some((0.5, 2.0)), ..asked(&tool.name) };
            match translate(&scene, &request) {
                Ok(translation) => assert_eq!(translation.ways.len() + translation.left_out.len(), tool.ways.len()),
                Err(TranslateError::NoNumbers { why, .. }) => assert!(why.contains("restitution"), "{why}"),
                Err(other) => panic!("{}: {other}", tool.name),
            }
        }
    }
}

#[test]
fn no_line_is_too_wide_for_a_terminal_but_those_to_be_pasted() {
    for (_, translation) in OF_STEEL.iter() {
        for line in text::of(translation).lines().filter(|line| !line.starts_with("    ") && !line.contains("https:")) {
            assert!(line.chars().count() <= WIDTH, "{line}");
        }
    }
}

const SPHERES: &str =
    "target = { material = \"stainless steel 304\", radius = 5e-3 }\nimpact = { mass = 2e-3, speed = 1.0 }\n";

#[test]
fn between_two_spheres_no_block_has_a_wall_and_on_a_flat_every_block_with_walls_has_one() {
    for (text, walls) in [(STEEL, true), (SPHERES, false)] {
        for tool in ["lammps", "liggghts"] {
            for way in translate(&scene(text), &asked(tool)).unwrap().ways {
                assert_eq!(way.block.contains("wall/gran"), walls, "{}", way.block);
                assert!(way.block.contains("pair_style") && way.block.contains("pair_coeff"), "{}", way.block);
            }
        }
    }
    let left_out = translate(&scene(SPHERES), &asked("lammps")).unwrap().left_out;
    assert!(left_out[0].starts_with("mdr") && left_out[0].contains("two spheres"), "{left_out:?}");
}

#[test]
fn a_hollow_target_is_a_flat_for_tools_which_have_no_hollows() {
    let socket = STEEL.replace("\"mild steel\"", "\"mild steel\", radius = -0.05");
    let [hollow, flat] = [socket.as_str(), STEEL].map(|text| translate(&scene(text), &asked("lammps")).unwrap());
    assert!(hollow.notes.iter().any(|note| note.contains("hollow")), "{:?}", hollow.notes);
    // Hertz's stiffness of the ball on the wall, which has no other radius
    let stiffness = |translation: &Translation| {
        let way = &translation.ways[1];
        way.numbers[0].value * way.promised[2].mean.contact_time.powf(2.5)
    };
    assert!((stiffness(&hollow) / stiffness(&flat) - 1.0).abs() < 0.02);
}

#[test]
fn every_number_that_is_printed_into_a_block_is_a_float() {
    for value in [0.0, 1.0, -3.0, 2e6, 1e15, 1e30, 0.44, 1.0 / 3.0, 5e-324, f64::MAX] {
        let text = brinell_exporter::translate::printed(value);
        assert!(text.contains(['.', 'e']), "{text}");
        assert!((text.parse::<f64>().unwrap() - value).abs() <= 1e-6 * value.abs(), "{text}");
    }
}

#[test]
fn a_number_for_one_mass_says_so_and_one_for_every_mass_does_not() {
    let says = |tool: &str, way: &str| {
        let place = TOOLS.iter().position(|one| one.name == tool).expect("a tool of this name");
        let way = OF_STEEL[place].1.ways.iter().find(|one| one.name == way).expect("a way of this name");
        way.notes.iter().any(|note| note.starts_with("The numbers hold for one effective mass"))
    };
    let of_one = "lammps hooke, mercurydpm linear, bullet stiffness, drake sap, newton semi-implicit, chrono hooke, adams impact, \
                  modelica elastogap, simscape smooth-spring-damper, ode spring, exudyn damping";
    let of_every = "mujoco pair, newton mujoco-solver, lammps hertz, liggghts hertz, liggghts hooke, yade mindlin, chrono hertz, \
                    exudyn sphere, recurdyn contact, jolt restitution";
    for (ways, expected) in [(of_one, true), (of_every, false)] {
        for way in ways.split(", ") {
            let (tool, name) = way.split_once(' ').expect("a tool and a way");
            assert_eq!(says(tool, name), expected, "{way}");
        }
    }
}

#[test]
fn a_range_of_speeds_has_units_and_limits() {
    assert_eq!(speeds("10 cm/s:3 m/s").unwrap(), (0.1, 3.0));
    assert_eq!(speeds("2").unwrap(), (2.0, 2.0));
    for (text, said) in
        [("3:1", "above"), ("0:1", "out of range"), ("1:nan", "range"), ("", "number"), ("1:2:3", "2:3")]
    {
        let why = speeds(text).unwrap_err();
        assert!(why.contains(said), "{text}: {why}");
    }
}
