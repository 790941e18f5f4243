//! The wheel and the archive made by packaging/release.py from the program of the tests: installed, and used without cargo and
//! rustc.

use brinell_testing::command::{Run, brinell, contents, empty_folder, output, scene};
use brinell_testing::places::temporary;
use brinell_testing::prebuilt;
use brinell_testing::python;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;
use std::thread;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Makes wheel and archive in `folder`.
fn release(folder: &Path) {
    let mut command = Command::new(python::INSTALLED);
    command.arg(root().join("packaging/release.py")).args(["--program", env!("CARGO_BIN_EXE_brinell")]);
    command.arg("--scratch").arg(python::target_folder().join("packaging")).arg("-o").arg(folder);
    command.arg("--prebuilt").arg(prebuilt::store());
    // nothing is left behind in the source tree
    output(command.env("PYTHONDONTWRITEBYTECODE", "1")).with_status(0);
}

/// The single file in `folder` whose name has this ending.
fn file(folder: &Path, ending: &str) -> PathBuf {
    let names = contents(folder);
    let found: Vec<_> = names.iter().filter(|name| name.ends_with(ending)).collect();
    assert!(found.len() == 1, "not one file with the ending {ending} in {names:?}");
    folder.join(found[0])
}

/// The folder of programs in a virtual environment.
const PROGRAMS: &str = if cfg!(windows) { "Scripts" } else { "bin" };

/// The files made and installed once for all tests.
struct Installed {
    folder: PathBuf,
    /// Programs of the virtual environment.
    programs: PathBuf,
}

impl Installed {
    /// A call of `program` of the environment, with an empty PATH and an empty home folder.
    fn command(&self, program: &str) -> Command {
        let mut command = Command::new(self.programs.join(program));
        command.env("PATH", &self.folder).env("HOME", &self.folder).current_dir(&self.folder);
        for variable in ["CARGO", "BRINELL", "BRINELL_PREBUILT", "BRINELL_CACHE", "PYTHONPATH"] {
            command.env_remove(variable);
        }
        for variable in ["XDG_CACHE_HOME", "XDG_CONFIG_HOME"] {
            command.env_remove(variable);
        }
        command
    }

    /// The output of a line of Python.
    fn python(&self, line: &str) -> String {
        output(self.command("python").args(["-c", line])).with_status(0).out.trim().into()
    }
}

/// The wheel, installed with its dependencies in an empty environment.
static INSTALLED: LazyLock<Installed> = LazyLock::new(|| {
    let folder = temporary().join("wheel");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    let environment = folder.join("environment");
    // the tests wait for both
    thread::scope(|scope| {
        let made = scope.spawn(|| output(Command::new(python::INSTALLED).args(["-m", "venv"]).arg(&environment)));
        release(&folder);
        made.join().expect("a command that can be started").with_status(0);
    });
    let programs = environment.join(PROGRAMS);
    let mut pip = Command::new(programs.join("python"));
    pip.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-compile", "--constraint"]);
    output(pip.arg(root().join("tests/requirements.txt")).arg(file(&folder, ".whl"))).with_status(0);
    Installed { folder, programs }
});

#[test]
#[ignore = "makes and installs a wheel: cargo test --release --test platforms wheel -- --ignored"]
fn the_installed_program_answers_as_the_one_it_was_made_of() {
    let answers = |mut command: Command| output(command.arg("predict").arg(scene("mass_known"))).with_status(0).out;
    let built = answers(brinell(root()));
    assert!(built.contains("restitution"), "{built}");
    assert_eq!(answers(INSTALLED.command("brinell")), built);
    // if the folder of programs is not on PATH
    let mut module = INSTALLED.command("python");
    module.args(["-m", "brinell"]);
    assert_eq!(answers(module), built);
}

#[test]
#[ignore = "makes and installs a wheel: cargo test --release --test platforms wheel -- --ignored"]
fn the_module_hands_on_the_status_of_the_program() {
    let mut module = INSTALLED.command("python");
    let Run { err, .. } = output(module.args(["-m", "brinell", "predict", "nowhere.toml"])).with_status(1);
    assert!(err.contains("nowhere.toml"), "{err}");
}

#[test]
#[ignore = "makes and installs a wheel: cargo test --release --test platforms wheel -- --ignored"]
fn the_module_finds_the_program_of_its_wheel_without_activation() {
    let found = INSTALLED.python("import brinell; print(brinell.program())");
    let program = format!("brinell{}", std::env::consts::EXE_SUFFIX);
    assert_eq!(Path::new(&found), fs::canonicalize(INSTALLED.programs.join(program)).unwrap());
    let scene = scene("mass_known");
    let law = INSTALLED.python(&format!("import brinell; print(brinell.predict({scene:?}).law)"));
    assert_eq!(law, "brinell/brinell");
}

/// Such an environment has another layout, and its list of files names a wrong place of the program.
#[test]
#[ignore = "makes and installs a wheel: cargo test --release --test platforms wheel -- --ignored"]
fn the_module_finds_the_program_of_a_wheel_in_a_folder_of_its_own() {
    let folder = empty_folder();
    let mut pip = Command::new(INSTALLED.programs.join("python"));
    pip.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-deps", "--target"]);
    output(pip.arg(folder.path()).arg(file(&INSTALLED.folder, ".whl"))).with_status(0);
    let mut python = INSTALLED.command("python");
    python.env("PYTHONPATH", folder.path()).args(["-c", "import brinell; print(brinell.program())"]);
    let found = output(&mut python).with_status(0).out;
    assert!(Path::new(found.trim()).starts_with(fs::canonicalize(folder.path()).unwrap()), "{found}");
    assert!(folder.path().join("brinell/py.typed").is_file(), "the module says that it is typed");
}

#[test]
#[ignore = "makes and installs a wheel: cargo test --release --test platforms wheel -- --ignored"]
fn the_versions_of_program_module_and_wheel_are_one() {
    let version = output(INSTALLED.command("brinell").args(["--version", "--json"])).with_status(0).json();
    assert_eq!(version["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(version["library"].as_str().map(str::len), Some(16), "{version}");
    let wheel = INSTALLED.python("import importlib.metadata as m; print(m.version('brinell'))");
    assert_eq!(wheel, env!("CARGO_PKG_VERSION"));
    let folder = version["prebuilt"]["folder"].as_str().expect("prebuilt libraries");
    assert!(Path::new(folder).starts_with(fs::canonicalize(&INSTALLED.folder).unwrap()), "{version}");
}

#[test]
#[ignore = "makes and installs a wheel: cargo test --release --test platforms wheel -- --ignored"]
fn manual_and_completions_are_installed_and_name_every_command() {
    let share = INSTALLED.programs.parent().unwrap().join("share");
    for command in ["export", "check", "predict", "curve", "laws", "report", "ssp"] {
        let page = fs::read_to_string(share.join(format!("man/man1/brinell-{command}.1"))).expect("a manual page");
        assert!(page.starts_with(".ie") && page.contains(".SH SYNOPSIS"), "{page}");
        for script in ["bash-completion/completions/brinell", "zsh/site-functions/_brinell", "brinell/brinell.ps1"] {
            let script = fs::read_to_string(share.join(script)).expect("a script");
            assert!(script.contains(command), "no {command} in\n{script}");
        }
    }
}

#[test]
#[ignore = "makes and installs a wheel: cargo test --release --test platforms wheel -- --ignored"]
fn the_same_program_makes_the_same_wheel_and_archive() {
    let again = empty_folder();
    release(again.path());
    for name in contents(again.path()) {
        let [one, other] = [&INSTALLED.folder, again.path()].map(|folder| fs::read(folder.join(&name)).unwrap());
        assert!(one == other, "{name} is another file each time");
    }
}

#[test]
#[ignore = "makes and installs a wheel: cargo test --release --test platforms wheel -- --ignored"]
#[cfg(unix)]
fn the_archive_contains_the_program_and_its_files() {
    let folder = empty_folder();
    let mut tar = Command::new("tar");
    output(tar.arg("-xzf").arg(file(&INSTALLED.folder, ".tar.gz")).arg("-C").arg(folder.path())).with_status(0);
    let top = folder.path().join(&contents(folder.path())[0]);
    assert_eq!(contents(&top), ["LICENSE", "THIRD-PARTY-LICENSES", "bin", "brinell.cdx.json", "share"]);
    let licenses = fs::read_to_string(top.join("THIRD-PARTY-LICENSES")).unwrap();
    for crate_and_license in
        ["\n- brotli ", ": BSD-3-Clause AND MIT\n", "\n- clap ", "Dropbox", "Permission is hereby granted"]
    {
        assert!(licenses.contains(crate_and_license), "no {crate_and_license:?} in\n{licenses}");
    }
    let version = output(Command::new(top.join("bin/brinell")).arg("--version")).with_status(0).out;
    assert!(version.starts_with(concat!("brinell ", env!("CARGO_PKG_VERSION"), "\n")), "{version}");
}

/// The bill of materials lists exactly the crates whose licenses are packed, each with the hash in Cargo.lock.
#[test]
#[ignore = "makes and installs a wheel: cargo test --release --test platforms wheel -- --ignored"]
fn the_wheel_has_a_bill_of_materials() {
    let info = INSTALLED.python("import importlib.metadata as m; print(m.distribution('brinell')._path)");
    let read = |path: &str| fs::read_to_string(Path::new(&info).join(path)).expect("installed with the wheel");
    let bill: serde_json::Value = serde_json::from_str(&read("sboms/brinell.cdx.json")).expect("JSON");
    assert_eq!((&bill["bomFormat"], &bill["specVersion"]), (&"CycloneDX".into(), &"1.6".into()));
    let text = |value: &serde_json::Value| value.as_str().expect("a text").to_string();
    let lock = fs::read_to_string(root().join("Cargo.lock")).expect("a lock file");
    let components = bill["components"].as_array().expect("a list");
    let mut listed = Vec::new();
    for component in components {
        let [name, version] = ["name", "version"].map(|key| text(&component[key]));
        let hash = text(&component["hashes"][0]["content"]);
        let locked = format!("name = \"{name}\"\nversion = \"{version}\"\n");
        assert!(
            lock.split("[[package]]\n").any(|it| it.starts_with(&locked) && it.contains(&hash)),
            "{name} {version}"
        );
        assert!(!text(&component["licenses"][0]["expression"]).contains('/'), "{component}");
        assert_eq!(text(&component["purl"]), format!("pkg:cargo/{name}@{version}"));
        listed.push(format!("{name} {version}"));
    }
    let licenses = read("licenses/THIRD-PARTY-LICENSES");
    let licensed: Vec<_> = licenses
        .lines()
        .take_while(|line| !line.starts_with("-----"))
        .filter_map(|line| line.strip_prefix("- ")?.split_once(": "))
        .map(|(name, _)| name.to_string())
        .collect();
    assert!(listed.len() > 60 && listed == licensed, "{listed:?}\n{licensed:?}");
}

/// It compiles the program once more.
#[test]
#[ignore = "takes minutes: cargo test --release --test platforms wheel -- --ignored"]
fn cargo_installs_the_program() {
    let folder = empty_folder();
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["install", "--quiet", "--locked", "--path"]).arg(root()).arg("--root").arg(folder.path());
    output(cargo.env("CARGO_TARGET_DIR", python::target_folder())).with_status(0);
    let mut program = Command::new(folder.path().join("bin/brinell"));
    let version = output(program.arg("--version")).with_status(0).out;
    assert!(version.starts_with(concat!("brinell ", env!("CARGO_PKG_VERSION"), "\n")), "{version}");
}
