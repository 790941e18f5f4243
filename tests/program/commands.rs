//! The commands that predict and show, as a user calls them; what is in one answer stands in `answers.txt`.

mod hardness;
mod law_list;
mod oblique;
mod predictions;
mod sweeps;

use crate::command::{self, scene};
use brinell_testing::folder::{Folder, close, column, number, words};
use brinell_testing::places;
use std::fs;
use std::process::Command;

/// In some laws a regime begins within a segment.
#[test]
fn each_regime_begins_at_its_onset() {
    let folder = Folder::of_scene("steel_ball");
    for laws in ["brinell", "big-alabo", "kogut-etsion", "jackson-green", "stronge", "brake-2015"] {
        let law = |more: &str| folder.json(&format!("predict scene.toml --laws {laws} {more}"))["laws"][0].clone();
        let onsets = law("")["onsets"].as_array().unwrap().clone();
        assert!(!onsets.is_empty(), "{laws}");
        for onset in onsets {
            let at = |part: f64| law(&format!("--speed {}", part * number(&onset, "speed")))["regime"].clone();
            assert_eq!(at(1.0 + 1e-9), onset["regime"], "{laws}");
            assert_ne!(at(1.0 - 1e-9), onset["regime"], "{laws}");
        }
    }
}

#[test]
fn a_dent_turned_round_gives_the_speed_and_the_strength_that_made_it() {
    let folder = Folder::of_scene("steel_ball");
    for law in ["big-alabo", "brinell"] {
        let predict = format!("predict scene.toml --laws {law}");
        let dent = number(&folder.json(&predict), "laws/0/dent");
        let answer = folder.json(&format!("{predict} --dent {dent}"));
        // the dent is proportional to the speed and to the inverse of the strength, and no digit is lost
        close(number(&answer, "laws/0/speed"), 1.0, 1e-12);
        close(number(&answer, "laws/0/yield_strength"), 300e6, 1e-12);
    }
}

#[test]
fn a_curve_goes_in_out_in_again_and_out_and_its_energies_add_up() {
    let folder = Folder::of_scene("steel_ball");
    folder.call("curve scene.toml --to 1e-5 -o curve.csv").with_status(0);
    let table = folder.read("curve.csv");
    let names = ["indentation_m", "work_J", "elastic_energy_J", "dissipated_energy_J"];
    let [depth, work, elastic, dissipated] = names.map(|name| column(&table, name));
    close(depth.iter().copied().fold(0.0, f64::max), 1e-5, 1e-12);
    let turns = depth.windows(3).filter(|w| (w[1] - w[0]) * (w[2] - w[1]) < 0.0).count();
    assert_eq!(turns, 3, "in, out, in, out");
    for ((work, elastic), dissipated) in work.iter().zip(&elastic).zip(&dissipated) {
        assert!((work - elastic - dissipated).abs() <= 1e-15 * work.abs(), "{work} is not {elastic} + {dissipated}");
    }
    assert!(dissipated.windows(2).all(|w| w[1] >= w[0] * (1.0 - 1e-13)), "dissipated energy never falls");
    folder.call("curve scene.toml --laws all -o curve.svg").with_status(0);
    let picture = folder.read("curve.svg");
    assert!(picture.contains("thornton") && picture.contains("<polyline"));
}

/// It fails before the work, not after it.
#[test]
fn an_output_that_cannot_be_written_is_refused_before_the_work() {
    let folder = Folder::of_scene("steel_ball");
    ["there.csv", "there.svg", "there.ssp"].iter().for_each(|name| fs::create_dir(folder.at(name)).unwrap());
    folder.write("file", "");
    for call in [
        "export scene.toml -o there.csv",
        "export scene.toml -o nowhere/unit.fmu",
        "export scene.toml -o file/unit.fmu",
        "ssp scene.toml -o there.ssp",
        "predict scene.toml --sweep speed=1:2 -o there.csv",
        "predict scene.toml --time-history there.csv",
        "curve scene.toml -o there.svg",
        "report scene.toml -o file",
    ] {
        let failed = folder.call(call).with_status(1);
        let goal = call.rsplit(' ').next().unwrap();
        assert!(failed.err.starts_with(&format!("brinell: {goal}: ")), "{failed:#?}");
        assert!(!failed.err.contains("building") && failed.out.is_empty(), "{failed:#?}");
    }
}

/// For every command, in every text format.
#[test]
fn every_output_fits_a_hundred_columns() {
    const CALLS: &str = "laws
materials
--help
predict steel_ball.toml --laws all,damped
predict steel_ball.toml --laws all,damped --drop-height 0.05
predict steel_ball.toml --laws hunt-crossley/herbert-mcwhannell,zhao-maietta-chang
predict steel_ball.toml --speed 30
predict steel_ball.toml --laws all --speed 30
predict steel_ball.toml --dent 1e-5 --laws brinell,zhao-maietta-chang
predict steel_ball.toml --restitution 0.5
predict steel_ball.toml --restitution 1
predict steel_ball.toml --sweep speed=0.01:10
predict steel_ball.toml --laws all --sweep target.yield_strength=200e6:900e6:8
predict steel_ball.toml --sweep speed=0.01:10 --sweep impactor.radius=1e-3:1e-2:5
predict steel_ball.toml --friction 0.1 --sweep angle=0:80:5 --sweep target.youngs_modulus=1e11:2e11:5
curve steel_ball.toml
curve damped.toml
hardness steel_ball.toml --load 5kN
hardness steel_ball.toml --load 5kN --laws all --brinell 90
hardness steel_ball.toml --load 29.4kN --laws all
translate steel_ball.toml --for mujoco
translate steel_ball.toml --for adams --units mm-t-s --speed 0.1:2
translate steel_ball.toml --for liggghts --step 1ms
new fresh";
    let scenes = ["steel_ball", "damped", "everything", "two_contacts", "elastic"];
    let texts = scenes.map(|name| (format!("{name}.toml"), fs::read_to_string(scene(name)).unwrap()));
    let folder = Folder::with(&texts.each_ref().map(|(name, text)| (name.as_str(), text.as_str())));
    let mut calls: Vec<String> = CALLS.lines().map(String::from).collect();
    calls.extend(scenes.map(|scene| format!("predict {scene}.toml")));
    calls.extend(["everything", "two_contacts", "damped"].map(|scene| format!("export {scene}.toml")));
    calls.push("check everything.fmu".into());
    let commands = "export ssp check predict translate hardness curve report laws materials new";
    calls.extend(commands.split(' ').map(|command| format!("{command} --help")));
    let laws = "hertz big-alabo brinell thornton jackson-green etsion hunt-crossley tsuji ghaednia";
    calls.extend(laws.split(' ').map(|law| format!("laws {law}")));
    for call in calls {
        let run = folder.call(&call).with_status(0);
        let wide = run.out.lines().find(|line| line.chars().count() > 100);
        assert_eq!(wide, None, "{call}");
        assert!(!run.out.contains("NaN") && !run.out.contains("-0 "), "{call}: {}", run.out);
        assert!(!run.out.trim().is_empty(), "{call} says nothing");
    }
}

#[test]
fn a_dropped_ball_rebounds_to_the_height_of_its_restitution() {
    let answer = Folder::of_scene("steel_ball").json("predict scene.toml --drop-height 0.05");
    let of = |name: &str| number(&answer["laws"][0], name);
    close(of("rebound_height"), 0.05 * of("restitution").powi(2), 1e-14);
    close(of("rebound_speed"), number(&answer, "speed") * of("restitution"), 1e-14);
}

/// The end of the impact agrees with the prediction, and the force follows the law.
#[test]
fn a_time_history_goes_from_first_contact_to_the_end_of_the_force() {
    // where the surface is slow, it rises long after the force has ended
    let waves = "name = \"waves\"\nimpactor = { radius = 26e-3 }\nlaw = { elastic_restitution = \"waves\" }\n\
                 target = { material = \"mild steel\", yield_strength = 100e6, surface = \"fresh\" }\n\
                 impact = { mass = 4.7e-4, speed = 0.8 }\n";
    for (folder, laws) in [
        (Folder::of_scene("steel_ball"), "big-alabo,brinell,jackson-green,hertz"),
        (Folder::of_scene("damped"), "hunt-crossley,tsuji"),
        (Folder::of(waves), "brinell,thornton"),
    ] {
        let answer = folder.json(&format!("predict scene.toml --laws {laws} --time-history over_time.csv"));
        let table = folder.read("over_time.csv");
        assert!(table.starts_with("law,time_s,indentation_m,force_N,speed_m_per_s\n"), "{table}");
        for law in answer["laws"].as_array().unwrap() {
            let prefix = format!("{},", law["law"].as_str().unwrap());
            let row = |line: &str| -> Vec<f64> { line.split(',').map(|cell| cell.parse().unwrap()).collect() };
            let rows: Vec<_> = table.lines().filter_map(|line| line.strip_prefix(&prefix)).map(row).collect();
            assert!(rows.len() > 300, "{prefix}");
            let (first, last) = (&rows[0], &rows[rows.len() - 1]);
            let (speed, restitution) = (number(&answer, "speed"), number(law, "restitution"));
            assert_eq!(first[..2], [0.0, 0.0]);
            close(last[0], number(law, "loading_time") + number(law, "unloading_time"), 1e-9);
            close(-last[3] / speed, restitution, 1e-6);
            let largest = |column: usize| rows.iter().map(|row| row[column]).fold(0.0, f64::max);
            close(largest(1), number(law, "largest_indentation"), 1e-4);
            close(largest(2), number(law, "largest_force"), 1e-3);
            // momentum: the integral of the force is the mass times the change of speed
            let impulse: f64 = rows.windows(2).map(|w| 0.5 * (w[1][0] - w[0][0]) * (w[0][2] + w[1][2])).sum();
            close(impulse, number(&answer, "mass") * speed * (1.0 + restitution), 2e-3);
        }
    }
}

#[test]
fn the_curve_of_a_rate_dependent_law_is_the_course_of_the_impact() {
    let folder = Folder::of_scene("damped");
    folder.call("curve scene.toml -o curve.csv").with_status(0);
    let table = folder.read("curve.csv");
    let names = ["indentation_m", "force_N", "work_J", "elastic_energy_J", "dissipated_energy_J"];
    let [depth, force, work, elastic, heat] = names.map(|name| column(&table, name));
    let impact = 0.5 * 5.4e-3 * 0.8 * 0.8;
    assert!(force.iter().all(|force| *force >= 0.0), "{force:?}");
    assert!(heat.windows(2).all(|w| w[1] >= w[0] - 1e-12 * impact), "{heat:?}");
    for ((work, elastic), heat) in work.iter().zip(&elastic).zip(&heat) {
        assert!((work - elastic - heat).abs() <= 1e-12 * impact, "{work} is not {elastic} + {heat}");
    }
    close(heat[heat.len() - 1] / impact, 1.0 - 0.9 * 0.9, 1e-3);
    close(depth.iter().copied().fold(0.0, f64::max), 1.323_578e-5, 1e-4);
}

/// What is printed for readers that know no units is the scene in SI, and both make the same library.
#[test]
fn a_scene_with_units_is_the_scene_in_si_to_the_last_bit() {
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
    let folder = Folder::with(&[("with.toml", with), ("plain.toml", plain)]);
    assert_eq!(folder.call("si with.toml").with_status(0).out, plain);
    assert_eq!(folder.words("constants with.toml"), folder.words("constants plain.toml"));
}

#[test]
fn the_page_is_the_one_that_is_named_or_it_is_said_where_one_comes_from() {
    let folder = Folder::with(&[("my page.html", "<!doctype html>")]);
    let page = folder.at("my page.html");
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
    assert!(words(&none.err).contains("`cargo run --release -- app`"), "{}", none.err);
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
