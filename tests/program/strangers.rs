//! FMUs that harm the process that loads them, and FMUs that are enormous.
#![cfg(target_os = "linux")]

use crate::command::{Run, brinell, contents, empty_folder, output, run};
use brinell_testing::unit;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Copies an FMU with another library.
const REPLACE: &str = "
import sys, zipfile
source, goal, library = sys.argv[1:]
with zipfile.ZipFile(source) as old, zipfile.ZipFile(goal, 'w') as new:
    for name in old.namelist():
        new.writestr(name, open(library, 'rb').read() if name.endswith('.so') else old.read(name))
";

/// The default scene's FMU with a harmful library, as `unit.fmu`.
fn stranger(option: &str) -> TempDir {
    let folder = empty_folder();
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/c/stranger.c");
    let library = folder.path().join("stranger.so");
    let mut compiler = Command::new("cc");
    compiler.args(["-shared", "-fPIC", "-O1", "-Wall", "-Wextra", "-Werror", option, "-o"]).arg(&library).arg(source);
    output(&mut compiler).with_status(0);
    let mut python = Command::new("python3");
    python.args(["-c", REPLACE]).arg(unit::export(&unit::scene("steel_ball")));
    output(python.arg(folder.path().join("unit.fmu")).arg(&library)).with_status(0);
    folder
}

/// The output of `check` for such an FMU; its temporary files are removed.
#[track_caller]
fn said_of(option: &str) -> Run {
    let (folder, temporary) = (stranger(option), empty_folder());
    let mut command = brinell(folder.path());
    let run = output(command.env("TMPDIR", temporary.path()).args(["check", "unit.fmu", "--time-limit", "2"]));
    assert_eq!(contents(temporary.path()), [""; 0], "{option}");
    run.with_status(1)
}

#[test]
fn a_library_that_ends_the_process_that_loads_it_is_a_failed_check() {
    for (option, said) in [("-DEND", "exit status: 0"), ("-DCRASH", "signal: 6")] {
        let run = said_of(option);
        assert!(run.err.contains("ended the process") && run.err.contains(said), "{option}: {}", run.err);
        assert_eq!(run.out, "", "{option}");
    }
}

/// Compiles a library that crashes when its process ends, and has the functions of the FMU's own one.
const LATE: &str = "
import subprocess, sys, zipfile
source, goal = sys.argv[1:]
open('late.c', 'w').write('#include <stdlib.h>\\n__attribute__((destructor)) static void late(void) { abort(); }')
with zipfile.ZipFile(source) as old, zipfile.ZipFile(goal, 'w') as new:
    own = next(name for name in old.namelist() if name.endswith('.so'))
    open('own.so', 'wb').write(old.read(own))
    link = ['-L.', '-Wl,--no-as-needed', '-l:own.so', '-Wl,-rpath,$ORIGIN', '-Wl,-z,nodelete']
    subprocess.run(['cc', '-shared', '-fPIC', 'late.c', '-o', 'late.so', *link], check=True)
    for name in old.namelist():
        new.writestr(name, open('late.so', 'rb').read() if name == own else old.read(name))
    new.writestr(own.rsplit('/', 1)[0] + '/own.so', old.read(own))
";

/// A library that stays loaded can crash after all has been found.
#[test]
fn a_library_that_crashes_at_the_very_end_is_a_failed_check() {
    let folder = empty_folder();
    let mut python = Command::new("python3");
    python.current_dir(folder.path()).args(["-c", LATE]).arg(unit::export(&unit::scene("steel_ball"))).arg("unit.fmu");
    output(&mut python).with_status(0);
    let run = run(folder.path(), ["check", "unit.fmu"]).with_status(1);
    assert!(run.err.contains("ended the process") && run.err.contains("signal: 6"), "{run:#?}");
    assert_eq!(run.out, "");
}

#[test]
fn a_library_that_never_returns_is_a_failed_check() {
    let run = said_of("-DHANG");
    assert!(run.err.contains("unit.fmu") && run.err.contains("2 s"), "{}", run.err);
}

/// A process that the library has left behind keeps the pipes open.
#[test]
fn a_library_that_leaves_a_process_behind_does_not_delay_the_answer() {
    let begin = Instant::now();
    let run = said_of("-DFORK");
    assert!(run.err.contains("ended the process"), "{}", run.err);
    assert!(begin.elapsed() < Duration::from_secs(50), "after {:?}", begin.elapsed());
}

#[test]
fn a_library_that_prints_gigabytes_is_told_in_little_memory_and_few_words() {
    let (folder, temporary) = (stranger("-DTALK"), empty_folder());
    let mut command = Command::new("sh");
    command.args(["-c", "ulimit -v 600000; exec \"$@\"", "sh", env!("CARGO_BIN_EXE_brinell"), "check", "unit.fmu"]);
    let run = output(command.current_dir(folder.path()).env("TMPDIR", temporary.path())).with_status(1);
    assert!(run.err.contains("ended the process") && run.err.contains("xxx ... xxx"), "{}", run.err.len());
    assert!(run.err.len() < 1000, "{} bytes", run.err.len());
}

#[test]
fn a_nan_force_and_an_endless_impact_are_failed_checks() {
    for (option, said) in [
        ("-DFORCE=NAN", "the force is NaN"),
        ("-DFORCE=INFINITY", "the force is inf"),
        ("-DFORCE=0.0", "hasn't ended after"),
    ] {
        let run = said_of(option);
        assert!(run.err.contains(said), "{option}: {}{}", run.out, run.err);
    }
}

/// An archive that contains gigabytes, and declares them.
#[test]
fn an_archive_that_unpacks_to_gigabytes_is_rejected() {
    let folder = empty_folder();
    let make = "
import sys, zipfile
with zipfile.ZipFile(sys.argv[1], 'w', zipfile.ZIP_DEFLATED, compresslevel=1) as new:
    new.writestr('modelDescription.xml', '<fmiModelDescription/>')
    with new.open('resources/zeros', 'w', force_zip64=True) as zeros:
        for _ in range(int(sys.argv[2])):
            zeros.write(bytes(1 << 24))
";
    let bomb = folder.path().join("bomb.fmu");
    output(Command::new("python3").args(["-c", make]).arg(&bomb).arg("129")).with_status(0);
    assert!(fs::metadata(&bomb).unwrap().len() < 20_000_000, "a bomb is small");
    let said = run(folder.path(), ["check", "bomb.fmu"]).with_status(1).err;
    assert!(said.contains("\"resources/zeros\" in it has 2164 MB when unpacked; allowed is "), "{said}");
    assert!(said.contains("bomb.fmu"), "{said}");
    assert_eq!(contents(folder.path()), ["bomb.fmu"]);
}

/// A check of 100,000 contacts, with a model description of 600 MB, in little memory.
#[test]
#[ignore = "it takes half a minute"]
fn a_hundred_thousand_contacts_are_checked_in_little_memory() {
    let folder = empty_folder();
    let outputs = "[\"indentation\", \"max_indentation\", \"residual_indentation\", \"contact_radius\", \"mean_pressure\", \
                   \"stiffness\", \"work\", \"elastic_energy\", \"dissipated_energy\", \"impulse\", \"regime\"]";
    let text = format!(
        "name = \"big\"\nimpactor = {{ radius = 2e-3 }}\ntarget = {{ material = \"mild steel\" }}\n[fmu]\n\
         outputs = {outputs}\n[[contact]]\nname = \"bead\"\ncount = 100000\n"
    );
    fs::write(folder.path().join("big.toml"), text).unwrap();
    run(folder.path(), ["export", "big.toml"]).with_status(0);
    // address space, of which a quarter is used
    let mut command = Command::new("sh");
    command.current_dir(folder.path()).args([
        "-c",
        "ulimit -v 600000; exec \"$@\"",
        "sh",
        env!("CARGO_BIN_EXE_brinell"),
    ]);
    output(command.args(["check", "big.fmu"])).with_status(0);
}
