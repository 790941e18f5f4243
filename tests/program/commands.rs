//! The commands that predict and show, as a user calls them.

mod hardness;
mod law_list;
mod oblique;
mod predictions;
mod sweeps;

use crate::command;
use crate::command::{empty_folder, run, scene};
use brinell_testing::places;
use serde_json::Value;
use std::fs;
use std::process::Command;

/// The JSON that `brinell` prints for these arguments and the default scene.
fn predicted(arguments: &[&str]) -> Value {
    let folder = empty_folder();
    let scene = scene("steel_ball").display().to_string();
    let mut all = vec!["predict", &scene, "--json"];
    all.extend(arguments);
    run(folder.path(), all).with_status(0).json()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

#[track_caller]
fn close(got: f64, expected: f64, tolerance: f64) {
    assert!((got / expected - 1.0).abs() < tolerance, "{got} instead of {expected}");
}

#[test]
fn predict_gives_the_impact_of_the_scene() {
    let law = &predicted(&[])["laws"][0];
    // the mass of the scene is 4.11e-3 kg, that of the reference tables 4.11025e-3 kg: 6e-5 in energy
    close(number(&law["largest_force"]), 330.6641, 1e-4);
    close(number(&law["dent"]), 9.4661023e-6, 1e-4);
    close(number(&law["restitution"]), 0.44629924, 1e-4);
    assert_eq!(law["regime"], 4);
    // the speeds at which the regimes begin, relative to the yield speed: 1.8737e-3, 25.189 and 201.19
    let onsets: Vec<f64> = law["onsets"].as_array().unwrap().iter().map(|onset| number(&onset["speed"])).collect();
    assert_eq!(onsets.len(), 3);
    close(onsets[1] / onsets[0], 25.1891570453553, 1e-12);
    close(onsets[2] / onsets[0], 201.188636084190, 1e-12);
}

/// In some laws a regime begins within a segment.
#[test]
fn each_regime_begins_at_its_onset() {
    for laws in ["brinell", "big-alabo", "kogut-etsion", "jackson-green", "stronge", "brake-2015"] {
        let onsets = predicted(&["--laws", laws])["laws"][0]["onsets"].clone();
        let onsets = onsets.as_array().unwrap();
        assert!(!onsets.is_empty(), "{laws}");
        for onset in onsets {
            let regime_at = |part: f64| {
                let speed = (part * number(&onset["speed"])).to_string();
                predicted(&["--laws", laws, "--speed", &speed])["laws"][0]["regime"].clone()
            };
            assert_eq!(regime_at(1.0 + 1e-9), onset["regime"], "{laws}");
            assert_ne!(regime_at(1.0 - 1e-9), onset["regime"], "{laws}");
        }
    }
}

#[test]
fn speed_energy_and_height_of_fall_say_the_same_impact() {
    let by_speed = predicted(&["--mass", "0.01", "--speed", "2"]);
    let by_energy = predicted(&["--mass", "0.01", "--energy", "0.02"]);
    // v^2/(2 g)
    let height = (4.0 / (2.0 * 9.80665)).to_string();
    let by_height = predicted(&["--mass", "0.01", "--drop-height", &height]);
    for other in [by_energy, by_height] {
        let force = |value: &Value| number(&value["laws"][0]["largest_force"]);
        close(force(&other), force(&by_speed), 1e-14);
    }
}

#[test]
fn several_laws_stand_side_by_side_and_hertz_loses_nothing() {
    let laws = predicted(&["--laws", "hertz,brinell,big-alabo/thornton"])["laws"].clone();
    let names: Vec<_> = laws.as_array().unwrap().iter().map(|law| law["law"].as_str().unwrap().to_string()).collect();
    assert_eq!(names, ["hertz", "brinell/brinell", "big-alabo/thornton"]);
    close(number(&laws[0]["restitution"]), 1.0, 1e-14);
    close(number(&laws[2]["restitution"]), 0.53041676, 1e-4);
    assert!(number(&laws[1]["restitution"]) < number(&laws[2]["restitution"]));
}

#[test]
fn a_dent_turned_round_gives_the_speed_and_the_strength_that_made_it() {
    for law in ["big-alabo", "brinell"] {
        let dent = number(&predicted(&["--laws", law])["laws"][0]["dent"]).to_string();
        let answer = predicted(&["--laws", law, "--dent", &dent])["laws"][0].clone();
        // the dent is proportional to the speed and to the inverse of the strength, and no digit is lost
        close(number(&answer["speed"]), 1.0, 1e-12);
        close(number(&answer["yield_strength"]), 300e6, 1e-12);
    }
}

#[test]
fn a_curve_goes_in_out_in_again_and_out_and_its_energies_add_up() {
    let folder = empty_folder();
    let scene = scene("steel_ball").display().to_string();
    run(folder.path(), ["curve", &scene, "--to", "1e-5", "-o", "curve.csv"]).with_status(0);
    let table = fs::read_to_string(folder.path().join("curve.csv")).unwrap();
    let rows: Vec<Vec<f64>> =
        table.lines().skip(1).map(|line| line.split(',').skip(1).map(|cell| cell.parse().unwrap()).collect()).collect();
    let indentation = |row: &Vec<f64>| row[0];
    let largest = rows.iter().map(indentation).fold(0.0, f64::max);
    close(largest, 1e-5, 1e-12);
    let turns = rows.windows(3).filter(|w| (w[1][0] - w[0][0]) * (w[2][0] - w[1][0]) < 0.0).count();
    assert_eq!(turns, 3, "in, out, in, out");
    for row in &rows {
        let [work, elastic, dissipated] = [row[5], row[6], row[7]];
        assert!((work - elastic - dissipated).abs() <= 1e-15 * work.abs(), "{work} is not {elastic} + {dissipated}");
    }
    assert!(rows.windows(2).all(|w| w[1][7] >= w[0][7] * (1.0 - 1e-13)), "dissipated energy never falls");
    run(folder.path(), ["curve", &scene, "--laws", "all", "-o", "curve.svg"]).with_status(0);
    let picture = fs::read_to_string(folder.path().join("curve.svg")).unwrap();
    assert!(picture.contains("thornton") && picture.contains("<polyline"));
}

/// It fails before the work, not after it.
#[test]
fn an_output_that_cannot_be_written_is_refused_before_the_work() {
    let folder = empty_folder();
    let scene = scene("steel_ball").display().to_string();
    fs::create_dir(folder.path().join("there.csv")).unwrap();
    fs::create_dir(folder.path().join("there.svg")).unwrap();
    fs::create_dir(folder.path().join("there.ssp")).unwrap();
    fs::write(folder.path().join("file"), "").unwrap();
    let cases: [&[&str]; 8] = [
        &["export", &scene, "-o", "there.csv"],
        &["export", &scene, "-o", "nowhere/unit.fmu"],
        &["export", &scene, "-o", "file/unit.fmu"],
        &["ssp", &scene, "-o", "there.ssp"],
        &["predict", &scene, "--sweep", "speed=1:2", "-o", "there.csv"],
        &["predict", &scene, "--time-history", "there.csv"],
        &["curve", &scene, "-o", "there.svg"],
        &["report", &scene, "-o", "file"],
    ];
    for arguments in cases {
        let failed = run(folder.path(), arguments).with_status(1);
        let goal = arguments.last().unwrap();
        assert!(failed.err.starts_with(&format!("brinell: {goal}: ")), "{failed:#?}");
        assert!(!failed.err.contains("building") && failed.out.is_empty(), "{failed:#?}");
    }
}

/// For every command, in every text format.
#[test]
fn every_output_fits_a_hundred_columns() {
    let folder = empty_folder();
    let scenes =
        ["steel_ball", "damped", "everything", "two_contacts", "elastic"].map(|name| scene(name).display().to_string());
    let [ball, damped, everything, two, elastic] = scenes.each_ref().map(String::as_str);
    let mut commands: Vec<Vec<&str>> = vec![
        vec!["laws"],
        vec!["materials"],
        vec!["--help"],
        vec!["check", "everything.fmu"],
        vec!["predict", ball, "--laws", "all,damped"],
        vec!["predict", ball, "--laws", "all,damped", "--drop-height", "0.05"],
        vec!["predict", ball, "--laws", "hunt-crossley/herbert-mcwhannell,zhao-maietta-chang"],
        vec!["predict", ball, "--speed", "30"],
        vec!["predict", ball, "--laws", "all", "--speed", "30"],
        vec!["predict", ball, "--dent", "1e-5", "--laws", "brinell,zhao-maietta-chang"],
        vec!["predict", ball, "--restitution", "0.5"],
        vec!["predict", ball, "--restitution", "1"],
        vec!["predict", ball, "--sweep", "speed=0.01:10"],
        vec!["predict", ball, "--laws", "all", "--sweep", "target.yield_strength=200e6:900e6:8"],
        vec!["predict", ball, "--sweep", "speed=0.01:10", "--sweep", "impactor.radius=1e-3:1e-2:5"],
        vec![
            "predict",
            ball,
            "--friction",
            "0.1",
            "--sweep",
            "angle=0:80:5",
            "--sweep",
            "target.youngs_modulus=1e11:2e11:5",
        ],
        vec!["curve", ball],
        vec!["curve", damped],
        vec!["hardness", ball, "--load", "5kN"],
        vec!["hardness", ball, "--load", "29.4kN", "--laws", "all"],
        vec!["translate", ball, "--for", "mujoco"],
        vec!["translate", ball, "--for", "adams", "--units", "mm-t-s", "--speed", "0.1:2"],
        vec!["translate", ball, "--for", "liggghts", "--step", "1ms"],
        vec!["new", "fresh"],
    ];
    commands.extend([ball, damped, everything, two, elastic].map(|scene| vec!["predict", scene]));
    commands.extend([everything, two, damped].map(|scene| vec!["export", scene]));
    // before it is checked
    let check = commands.remove(3);
    commands.push(check);
    for command in
        ["export", "ssp", "check", "predict", "translate", "hardness", "curve", "report", "laws", "materials", "new"]
    {
        commands.push(vec![command, "--help"]);
    }
    let laws =
        ["hertz", "big-alabo", "brinell", "thornton", "jackson-green", "etsion", "hunt-crossley", "tsuji", "ghaednia"];
    commands.extend(laws.map(|law| vec!["laws", law]));
    for command in commands {
        let run = run(folder.path(), &command).with_status(0);
        let wide = run.out.lines().find(|line| line.chars().count() > 100);
        assert_eq!(wide, None, "{command:?}");
        assert!(!run.out.contains("NaN") && !run.out.contains("-0 "), "{command:?}: {}", run.out);
        assert!(!run.out.trim().is_empty(), "{command:?} says nothing");
    }
}

#[test]
fn a_prediction_is_written_as_people_write_numbers() {
    let folder = empty_folder();
    let scene = scene("steel_ball").display().to_string();
    let text = run(folder.path(), ["predict", &scene]).with_status(0).out;
    for part in
        ["4.11 g", "1 m/s", "big-alabo/contact-radius", "330.7 N", "12.56 um", "29.85 us", "0.4463", "fully plastic"]
    {
        assert!(text.contains(part), "nothing of {part} in {text}");
    }
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("bounces to the same height for ever"), "{text}");
    assert!(words.contains("surface = \"fresh\""), "{text}");
    let other = command::scene("everything").display().to_string();
    assert!(!run(folder.path(), ["predict", &other]).with_status(0).out.contains("for ever"), "its surface is fresh");
    let dropped = predicted(&["--drop-height", "0.05"]);
    let law = &dropped["laws"][0];
    let restitution = number(&law["restitution"]);
    close(number(&law["rebound_height"]), 0.05 * restitution * restitution, 1e-14);
    close(number(&law["rebound_speed"]), number(&dropped["speed"]) * restitution, 1e-14);
    let text = run(folder.path(), ["predict", &scene, "--drop-height", "0.05"]).with_status(0).out;
    assert!(text.contains("rebound height") && text.contains("a fall of 50 mm"), "{text}");
}

/// The end of the impact agrees with the prediction, and the force follows the law.
#[test]
fn a_time_history_goes_from_first_contact_to_the_end_of_the_force() {
    // where the surface is slow, it rises long after the force has ended
    let waves = "name = \"waves\"\nimpactor = { radius = 26e-3 }\nlaw = { elastic_restitution = \"waves\" }\n\
                 target = { material = \"mild steel\", yield_strength = 100e6, surface = \"fresh\" }\n\
                 impact = { mass = 4.7e-4, speed = 0.8 }\n";
    for (name, laws) in [
        ("steel_ball", "big-alabo,brinell,jackson-green,hertz"),
        ("damped", "hunt-crossley,tsuji"),
        ("waves", "brinell,thornton"),
    ] {
        let folder = empty_folder();
        let own = folder.path().join("waves.toml");
        fs::write(&own, waves).unwrap();
        let scene = if name == "waves" { own } else { scene(name) }.display().to_string();
        let arguments = ["predict", &scene, "--laws", laws, "--json", "--time-history", "over_time.csv"];
        let answer = run(folder.path(), arguments).with_status(0).json();
        let table = fs::read_to_string(folder.path().join("over_time.csv")).unwrap();
        assert!(table.starts_with("law,time_s,indentation_m,force_N,speed_m_per_s\n"), "{table}");
        for law in answer["laws"].as_array().unwrap() {
            let prefix = format!("{},", law["law"].as_str().unwrap());
            let row = |line: &str| -> Vec<f64> { line.split(',').map(|cell| cell.parse().unwrap()).collect() };
            let rows: Vec<_> = table.lines().filter_map(|line| line.strip_prefix(&prefix)).map(row).collect();
            assert!(rows.len() > 300, "{prefix}");
            let (first, last) = (&rows[0], &rows[rows.len() - 1]);
            let (speed, restitution) = (number(&answer["speed"]), number(&law["restitution"]));
            assert_eq!(first[..2], [0.0, 0.0]);
            close(last[0], number(&law["loading_time"]) + number(&law["unloading_time"]), 1e-9);
            close(-last[3] / speed, restitution, 1e-6);
            let largest = |column: usize| rows.iter().map(|row| row[column]).fold(0.0, f64::max);
            close(largest(1), number(&law["largest_indentation"]), 1e-4);
            close(largest(2), number(&law["largest_force"]), 1e-3);
            // momentum: the integral of the force is the mass times the change of speed
            let impulse: f64 = rows.windows(2).map(|w| 0.5 * (w[1][0] - w[0][0]) * (w[0][2] + w[1][2])).sum();
            close(impulse, number(&answer["mass"]) * speed * (1.0 + restitution), 2e-3);
        }
    }
}

#[test]
fn rate_dependent_laws_stand_beside_the_others_and_are_asked_for_the_same_restitution() {
    let both = predicted(&["--laws", "big-alabo,hunt-crossley,hunt-crossley/lee-wang"]);
    let restitution = |law: usize| number(&both["laws"][law]["restitution"]);
    close(restitution(1), restitution(0), 1e-9);
    assert!(restitution(2) > restitution(0) + 0.1, "lee-wang gives more than it is asked for: {both}");
    assert_eq!(number(&both["laws"][1]["dent"]), 0.0);
}

#[test]
fn the_curve_of_a_rate_dependent_law_is_the_course_of_the_impact() {
    let folder = empty_folder();
    let scene = scene("damped");
    let arguments = ["curve", scene.to_str().unwrap(), "-o", "curve.csv"];
    run(folder.path(), arguments).with_status(0);
    let text = std::fs::read_to_string(folder.path().join("curve.csv")).unwrap();
    let rows: Vec<Vec<f64>> =
        text.lines().skip(1).map(|line| line.split(',').skip(1).map(|word| word.parse().unwrap()).collect()).collect();
    let impact = 0.5 * 5.4e-3 * 0.8 * 0.8;
    let (mut heat, mut deepest) = (0.0, 0.0f64);
    for row in &rows {
        let [indentation, force, _, _, _, work, elastic, dissipated, _] = row[..] else { panic!("{row:?}") };
        assert!(force >= 0.0 && dissipated >= heat - 1e-12 * impact, "{row:?}");
        assert!((work - elastic - dissipated).abs() <= 1e-12 * impact, "{row:?}");
        (heat, deepest) = (dissipated, deepest.max(indentation));
    }
    close(heat / impact, 1.0 - 0.9 * 0.9, 1e-3);
    close(deepest, 1.323_578e-5, 1e-4);
}

#[test]
#[cfg(unix)]
fn a_reader_that_leaves_early_is_no_fault() {
    let folder = empty_folder();
    let mut child = command::brinell(folder.path());
    child.arg("laws").stdout(std::process::Stdio::piped()).stderr(std::process::Stdio::piped());
    let mut child = child.spawn().unwrap();
    // closed before anything is printed
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!((output.status.code(), String::from_utf8_lossy(&output.stderr).as_ref()), (Some(0), ""));
}

/// Masses of solid balls of 5 and 10 mm radius: 4.11 and 32.9 g; the effective mass of two equal ones is half of one.
#[test]
fn a_mass_that_holds_a_ball_which_may_be_free_is_called_so() {
    let steel = "material = \"mild steel\"\n";
    let notes = |impactor: &str, target: &str, more: &str| {
        let folder = empty_folder();
        let text = format!(
            "name = \"unit\"\n[impactor]\nradius = 5e-3\n{impactor}[target]\n{target}[impact]\nspeed = 1.0\n{more}"
        );
        fs::write(folder.path().join("scene.toml"), text).unwrap();
        run(folder.path(), ["predict", "scene.toml", "--json"]).with_status(0).json()["notes"].to_string()
    };
    let ball = |radius: &str| format!("radius = {radius}\n{steel}");
    let numbers = "radius = 5e-3\nyoungs_modulus = 206e9\npoissons_ratio = 0.3\n";
    let rod = "length = 0.1\narea = 1e-4\n";
    for (impactor, target, more, instead) in [
        (steel, &*ball("5e-3"), "", "give the effective mass, for solid bodies of this size and density 2.055 g."),
        (steel, &ball("5e-3"), "mass = 4.11e-3\n", "this size and density 2.055 g."),
        (steel, &ball("10e-3"), "mass = 4.11e-3\n", "this size and density 3.654 g."),
        // of the same density, as far as the scene says
        (steel, numbers, "", "this size and density 2.055 g."),
        ("", numbers, "mass = 4.11e-3\n", "this size and equal density 0.5 times the impactor's mass."),
        (&format!("{steel}{rod}"), &format!("{steel}{rod}"), "", "this size and density 39.25 g."),
    ] {
        let notes = notes(impactor, target, more);
        assert!(notes.contains("only if the target is held") && notes.contains(instead), "{instead}: {notes}");
    }
    for (target, more) in [
        (steel.to_string(), ""),
        (ball("-20e-3"), ""),
        (ball("20e-3"), ""),
        (ball("5e-3"), "mass = 2.055e-3\n"),
        (ball("5e-3"), "[coupling]\neffective_mass = 4.11e-3\n"),
    ] {
        let notes = notes(steel, &target, more);
        assert!(!notes.contains("effective mass"), "{target}{more}: {notes}");
    }
}

/// What is printed for readers that know no units is the scene in SI, and both make the same library.
#[test]
fn a_scene_with_units_is_the_scene_in_si_to_the_last_bit() {
    let folder = empty_folder();
    let with = "name = \"box\"  # 5 mm\n[impactor]\nradius = \"5 mm\"\n[target]\nyoungs_modulus = \"206 GPa\"\npoissons_ratio = 0.3\n\
                yield_strength = \"40.8 kgf/mm2\"\ndensity = \"7.85 g/cm3\"\n\
                [fmu]\nstep_size = \"0.5 ms\"\nstop_time = \"12 min\"\n[impact]\nspeed = \"36 km/h\"\n\
                [[body]]\nname = \"box\"\nmass = \"300 g\"\ninertia = [\"1.2 kg cm^2\", 2.6e-4, \"350 kg mm^2\"]\n\
                [[contact]]\nname = \"left\"\nbetween = [\"box\", \"ground\"]\nnormal = [0, 0, -1]\n\
                arms = [[\"-40 mm\", 0, \"-25 mm\"], []]\ninitial_gap = \"30 um\"\n";
    let plain = "name = \"box\"  # 5 mm\n[impactor]\nradius = 5e-3\n[target]\nyoungs_modulus = 2.06e11\npoissons_ratio = 0.3\n\
                 yield_strength = 4.0011132e8\ndensity = 7.85e3\n\
                 [fmu]\nstep_size = 5e-4\nstop_time = 7.2e2\n[impact]\nspeed = 1e1\n\
                 [[body]]\nname = \"box\"\nmass = 3e-1\ninertia = [1.2e-4, 2.6e-4, 3.5e-4]\n\
                 [[contact]]\nname = \"left\"\nbetween = [\"box\", \"ground\"]\nnormal = [0, 0, -1]\n\
                 arms = [[-4e-2, 0, -2.5e-2], []]\ninitial_gap = 3e-5\n";
    fs::write(folder.path().join("with.toml"), with).unwrap();
    fs::write(folder.path().join("plain.toml"), plain).unwrap();
    assert_eq!(run(folder.path(), ["si", "with.toml"]).with_status(0).out, plain);
    let constants = |name: &str| run(folder.path(), ["constants", name]).with_status(0).out;
    assert_eq!(constants("with.toml"), constants("plain.toml"));
}

#[test]
fn the_page_is_the_one_that_is_named_or_it_is_said_where_one_comes_from() {
    let folder = empty_folder();
    let page = folder.path().join("my page.html");
    fs::write(&page, "<!doctype html>").unwrap();
    let app = |named: &str| {
        let mut command = command::brinell(folder.path());
        command::output(command.args(["app", "--path"]).env("BRINELL_PAGE", named))
    };
    let path = page.display().to_string();
    assert_eq!(app(&path).with_status(0).out.trim(), path);
    let missing = app("not here.html").with_status(1);
    assert!(missing.err.contains("BRINELL_PAGE = not here.html is no file"), "{}", missing.err);
    let (_folder, elsewhere) = program_in("a/b/c");
    let none =
        command::output(Command::new(&elsewhere).args(["app", "--path"]).env_remove("BRINELL_PAGE")).with_status(1);
    let words: Vec<_> = none.err.split_whitespace().collect();
    assert!(words.join(" ").contains("`cargo run --release -- app`"), "{}", none.err);
}

/// The program under another path, below a new folder.
fn program_in(below: &str) -> (tempfile::TempDir, std::path::PathBuf) {
    let folder = tempfile::tempdir_in(places::temporary()).unwrap();
    fs::create_dir_all(folder.path().join(below)).unwrap();
    let program = folder.path().join(below).join("brinell").with_extension(std::env::consts::EXE_EXTENSION);
    // a copy may still be open for writing in a process that another test has just started
    fs::hard_link(places::program(), &program).unwrap();
    (folder, program)
}

/// Writes the page that it is asked for, and counts how often.
const MAKE: &str = "import sys\nfrom pathlib import Path\nargs = sys.argv\nout = Path(args[args.index('-o') + 1])\n\
                    assert Path(args[args.index('--program') + 1]).is_file()\nout.parent.mkdir(parents=True, exist_ok=True)\n\
                    out.write_text(out.read_text() + 'x' if out.exists() else 'x')\n";

#[test]
fn a_program_that_was_built_in_a_clone_makes_its_page_when_something_has_changed() {
    let (clone, program) = program_in("target/quick");
    let at = |name: &str| clone.path().join(name);
    for folder in ["packaging", "crates/web/page/src"] {
        fs::create_dir_all(at(folder)).unwrap();
    }
    fs::write(at("crates/web/page/src/main.ts"), "").unwrap();
    fs::write(at("packaging/page.py"), MAKE).unwrap();
    let app = || command::output(Command::new(&program).args(["app", "--path"]).env_remove("BRINELL_PAGE"));
    let made = || fs::read_to_string(at("target/page/brinell.html")).unwrap().len();
    let first = app().with_status(0);
    assert!(first.out.trim().ends_with("brinell.html") && first.err.contains("making the page"), "{}", first.err);
    assert!(app().with_status(0).err.is_empty());
    assert_eq!(made(), 1);
    let later = std::time::SystemTime::now() + std::time::Duration::from_secs(5);
    fs::File::options().write(true).open(at("crates/web/page/src/main.ts")).unwrap().set_modified(later).unwrap();
    app().with_status(0);
    assert_eq!(made(), 2);
    fs::write(at("packaging/page.py"), "raise SystemExit('no node')").unwrap();
    let failed = app().with_status(1);
    assert!(failed.err.contains("no node") && failed.err.contains("has made no page"), "{}", failed.err);
}
