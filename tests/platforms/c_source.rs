//! C source as a platform: it gives the bits and messages of the native library, and compiles wherever it says so.
#![cfg(all(target_os = "linux", target_arch = "x86_64", target_env = "gnu"))]

use crate::unpacked::Unpacked;
use brinell_exporter::symbols::FUNCTIONS;
use brinell_testing::command::{self, empty_folder, output};
use brinell_testing::debian::{Packages, packages};
use brinell_testing::driver::{assert_never_trapped, compile_one};
use brinell_testing::histories::Both;
use brinell_testing::hosts::{Host, folder};
use brinell_testing::kinds::{is_rate_dependent, of_each_kind, of_every_law};
use brinell_testing::physics::Random;
use brinell_testing::prebuilt::without_compiler;
use brinell_testing::python::{keeping_modules, python, site_packages_file};
use brinell_testing::skips::skipped;
use brinell_testing::systems;
use brinell_testing::toolchain;
use brinell_testing::unit;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;

/// The FMU of the scene with this text, with a library for this system and C source; `None` without a toolchain to make it.
fn fmu_of(text: &str) -> Option<Unpacked> {
    made(text, without_compiler)
}

/// The FMU that `program` makes, in a folder and with the prebuilt libraries in another.
fn made(text: &str, program: impl Fn(&Path, &Path) -> Command) -> Option<Unpacked> {
    const PLATFORMS: &str = "linux64,c-code";
    let store = toolchain::store(PLATFORMS)?;
    Some(Unpacked::of(text, |folder| program(folder, &store), &["--platforms", PLATFORMS]))
}

/// The text of the scene of this kind.
fn of_kind(kind: &str) -> String {
    of_each_kind().into_iter().find(|(other, _)| *other == kind).expect("a scene of this kind").1
}

/// Compares the bits and the message of a host, in which the source runs, with those of the native library.
fn assert_same(fmu: &Unpacked, host: &Host, what: &str) {
    assert_eq!(fmu.difference(host, &fmu.library("linux64")), None, "{what}");
}

/// A call of `compiler` in the folder of the sources.
fn compiler(fmu: &Unpacked, compiler: &str, options: &[&str]) -> Command {
    let mut command = Command::new(compiler);
    command.current_dir(fmu.path().join("sources")).args(options).arg(format!("-I{}", headers().display()));
    command
}

/// The source compiled to a library.
fn compiled(fmu: &Unpacked, by: &str, options: &[&str]) -> PathBuf {
    let library = fmu.path().join(format!("{}.so", options.concat().replace(['/', '='], "")));
    let shared = ["-shared", "-fPIC", "-DFMI2_OVERRIDE_FUNCTION_PREFIX", "fmi2.c", "-o"];
    output(compiler(fmu, by, options).args(shared).arg(&library)).with_status(0);
    library
}

/// Compares random calls of this library with those of the native one; the number of messages.
fn compared(fmu: &Unpacked, library: &Path, seed: u64, rounds: usize) -> usize {
    let both = Both::between(&fmu.library("linux64"), library, &fmu.kind);
    let mut random = Random(seed);
    (0..rounds).map(|_| both.compare(100, &mut random)).sum()
}

/// The folder of the headers.
fn headers() -> &'static Path {
    static FOLDER: LazyLock<PathBuf> = LazyLock::new(|| site_packages_file("fmpy/c-code"));
    &FOLDER
}

/// Options with which nothing is warned of.
const STRICT: [&str; 5] = ["-std=c99", "-Wall", "-Wextra", "-pedantic", "-Werror"];

/// With a compiler the native library is compiled. It goes on from states of the C source, and the C source from its states.
#[test]
fn a_compiled_library_and_c_source_are_one_fmu() {
    let with_compiler = |folder: &Path, store: &Path| {
        let mut program = command::brinell(folder);
        program.env("BRINELL_PREBUILT", store);
        program
    };
    // a library that computes no mean tangential force, and one that makes no prediction
    for kind in ["friction", "moved"] {
        let text = of_kind(kind).replace("\"mean_tangential_force\", ", "").replace("\"friction_work\", ", "");
        let Some(fmu) = made(&text, with_compiler) else { return };
        assert_eq!(fmu.kind, "compiled");
        assert!(compared(&fmu, &compiled(&fmu, "gcc", &["-O1"]), 29, 5) > 0, "{kind}: nothing was refused");
    }
}

#[test]
fn c_source_of_every_kind_gives_the_bits_and_messages_of_the_native_library() {
    let (mut kinds, mut messages) = (BTreeSet::new(), 0);
    for (seed, (kind, text)) in (28..).zip(of_each_kind()) {
        let Some(fmu) = fmu_of(&text) else { return };
        assert_eq!(fmu.kind, kind);
        messages += compared(&fmu, &compiled(&fmu, "gcc", &[&STRICT[..], &["-O1"]].concat()), seed, 10);
        kinds.insert(kind);
    }
    assert!(kinds.len() == 10 && messages > 500, "{messages} messages of {kinds:?} were compared");
}

/// WebAssembly, from which the source is made, computes both sides of a choice between two numbers. Every law, alone, with known
/// mass and with a loss, and every scene of the repository. C's comparisons of NaN trap, too.
#[test]
fn c_source_of_every_law_never_triggers_a_trap() {
    let host = compile_one("exceptions");
    let outlives = |law: &str, way: &str, scene: &str| {
        let Some(fmu) = fmu_of(scene) else { return };
        let description = fs::read_to_string(fmu.path().join("modelDescription.xml")).unwrap();
        assert_never_trapped(&host, &compiled(&fmu, "gcc", &["-O1"]), &description, &format!("{law}, {way}"));
    };
    for (law, alone) in of_every_law() {
        let moved = format!("{alone}[coupling]\neffective_mass = 4e-3\n");
        let lossy = alone.replace("[law]", "[law]\nelastic_restitution = 0.9").replace("\"unit\"", "\"lossy\"");
        std::thread::scope(|scope| {
            scope.spawn(|| outlives(law, "alone", &alone));
            scope.spawn(|| outlives(law, "with known mass", &moved));
            if !is_rate_dependent(law) {
                scope.spawn(|| outlives(law, "with a loss", &lossy));
            }
        });
    }
    for scene in unit::scenes() {
        outlives(&scene.display().to_string(), "of the repository", &fs::read_to_string(&scene).unwrap());
    }
}

/// gcc's own C joins products and sums where the processor can.
#[test]
fn c_source_forbids_to_join_products_and_sums() {
    let Some(fmu) = fmu_of(&of_kind("moved")) else { return };
    if !fs::read_to_string("/proc/cpuinfo").unwrap().contains(" fma ") {
        return skipped("C source for processors that join products and sums", "this one doesn't");
    }
    let library = compiled(&fmu, "gcc", &["-O2", "-march=haswell", "-Wall", "-Werror"]);
    assert!(compared(&fmu, &library, 3, 20) > 0);
}

#[test]
fn c_source_compiles_in_other_languages_without_a_warning() {
    let Some(fmu) = fmu_of(&of_kind("state")) else { return };
    let warnings = ["-Wall", "-Wextra", "-pedantic", "-Werror", "-c", "fmi2.c", "-o", "other.o"];
    let c90 = ["-std=c90", "-Dinline=", "-Wno-long-long"];
    for (compiler, options) in
        [("gcc", &c90[..]), ("g++", &["-x", "c++", "-std=c++11"]), ("g++", &["-x", "c++", "-std=c++17"])]
    {
        output(self::compiler(&fmu, compiler, options).args(warnings)).with_status(0);
    }
}

#[test]
fn c_source_is_refused_where_numbers_would_differ() {
    let Some(fmu) = fmu_of(&of_kind("state")) else { return };
    for (options, message) in [
        (&["-ffast-math"][..], "compile without -ffast-math"),
        (&["-Ofast"], "compile without -ffast-math"),
        (&["-ffinite-math-only"], "compile without -ffast-math"),
        (&["-mfpmath=387"], "doubles are computed in another precision"),
        (&["-mfpmath=387", "-std=c90", "-Dinline="], "doubles are computed in another precision"),
    ] {
        let said = output(compiler(&fmu, "gcc", options).args(["-fsyntax-only", "fmi2.c"])).with_status(1);
        assert!(said.err.contains(message), "{options:?}: {}", said.err);
    }
}

/// The headers as the standard has them: with the prefix, if it isn't switched off. Those of fmpy have none.
fn prefixing_headers(folder: &Path) -> PathBuf {
    let mut text = String::from("#include_next <fmi2Functions.h>\n#ifndef FMI2_OVERRIDE_FUNCTION_PREFIX\n");
    text += "#define PASTE(a, b) a##b\n#define PASTED(a, b) PASTE(a, b)\n";
    for name in FUNCTIONS {
        text += &format!("#undef {name}\n#define {name} PASTED(FMI2_FUNCTION_PREFIX, {name})\n");
    }
    text += "#endif\n";
    let place = folder.join("prefixing");
    fs::create_dir(&place).unwrap();
    fs::write(place.join("fmi2Functions.h"), text).unwrap();
    place
}

#[test]
fn two_units_are_linked_into_one_program_and_need_only_memory_functions() {
    let Some(one) = fmu_of(&of_kind("state")) else { return };
    let other = fmu_of(&of_kind("momentum")).unwrap();
    let headers = format!("-I{}", prefixing_headers(one.path()).display());
    let one_name = one.library("linux64").file_stem().unwrap().to_string_lossy().into_owned();
    // modelIdentifiers may be equal: then the importer chooses the prefix
    for (fmu, prefix) in [(&one, format!("{one_name}_")), (&other, "other_".into())] {
        let defined = format!("-DFMI2_FUNCTION_PREFIX={prefix}");
        let options = if prefix == "other_" { vec![headers.as_str(), &defined] } else { vec![headers.as_str()] };
        output(compiler(fmu, "gcc", &options).args(["-c", "fmi2.c", "-o", "unit.o"])).with_status(0);
        let symbols = output(Command::new("nm").args(["-g"]).arg(fmu.path().join("sources/unit.o"))).with_status(0).out;
        let of = |kind: &str| {
            symbols
                .lines()
                .filter_map(|line| line.split_once(&format!(" {kind} ")))
                .map(|(_, name)| name)
                .collect::<Vec<_>>()
        };
        assert!(of("T").iter().all(|name| name.starts_with(&format!("{prefix}fmi2"))), "{symbols}");
        assert_eq!(of("T").len(), FUNCTIONS.len(), "{symbols}");
        assert_eq!(of("U"), ["calloc", "free", "memcpy", "memmove", "memset", "realloc", "strlen"], "{symbols}");
    }
    let declared = |prefix: &str| format!("const char *{prefix}fmi2GetVersion(void);\n");
    let compared = format!("return {one_name}_fmi2GetVersion()[0] != other_fmi2GetVersion()[0];");
    let text = format!("{}{}int main(void) {{ {compared} }}\n", declared(&format!("{one_name}_")), declared("other_"));
    let [program, main] = ["two", "two.c"].map(|name| one.path().join(name));
    fs::write(&main, text).unwrap();
    let units = [&one, &other].map(|fmu| fmu.path().join("sources/unit.o"));
    output(Command::new("gcc").arg(&main).args(units).arg("-o").arg(&program)).with_status(0);
    output(&mut Command::new(program)).with_status(0);
}

/// A command with CMake on its path.
fn with_cmake(program: &str) -> Command {
    let tools = systems::tools().unwrap_or_else(|why| panic!("{why}"));
    let mut command = Command::new(program);
    let path = format!("{}:{}", tools.parent().unwrap().display(), std::env::var("PATH").unwrap());
    keeping_modules(&mut command).env("PATH", path);
    command
}

#[test]
fn fmpy_compiles_the_source() {
    let Some(fmu) = fmu_of(&of_kind("moved")) else { return };
    let (place, native) = (fmu.library("linux64"), fmu.path().join("native.so"));
    fs::rename(&place, &native).unwrap();
    let script =
        "import sys, fmpy.build, fmpy.validation\nfmpy.build.build_platform_binary(sys.argv[1], all_warnings=True)\n";
    output(with_cmake(python().to_str().unwrap()).args(["-c", script]).arg(fmu.path())).with_status(0);
    let built = fmu.path().join("built.so");
    fs::rename(&place, &built).unwrap();
    fs::rename(&native, &place).unwrap();
    assert!(compared(&fmu, &built, 4, 10) > 0);
}

#[test]
fn a_cmake_project_has_the_source_as_a_library() {
    let Some(fmu) = fmu_of(&of_kind("lossy")) else { return };
    let text = format!(
        "cmake_minimum_required(VERSION 3.10)\nproject(contact C)\nadd_library(unit STATIC {source})\n\
         target_compile_options(unit PRIVATE -Wall -Wextra -Werror)\nadd_executable(host {host}/host.c {host}/load_linked.c)\n\
         include_directories({headers} {host} {host}/../c)\nadd_definitions(-DFMI2_OVERRIDE_FUNCTION_PREFIX)\n\
         target_link_libraries(host unit)\n",
        source = fmu.source().display(),
        host = folder().display(),
        headers = headers().display(),
    );
    let project = empty_folder();
    fs::write(project.path().join("CMakeLists.txt"), text).unwrap();
    let cmake = |arguments: &[&str]| {
        output(with_cmake("cmake").current_dir(project.path()).args(arguments)).with_status(0);
    };
    cmake(&["-DCMAKE_BUILD_TYPE=Release", "-B", "build"]);
    cmake(&["--build", "build"]);
    assert_same(&fmu, &Host::program(project.path().join("build/host")), "CMake");
}

/// Every kind on a big-endian processor and on one without floating-point instructions, two on the others.
#[test]
fn c_source_gives_the_same_bits_on_other_processors() {
    let targets = [
        ("s390x-linux-musl", "s390x", &[][..]),
        ("arm-linux-musleabi", "arm", &[]),
        ("x86-linux-musl", "i386", &["-mcpu=pentium4"]),
        ("aarch64-linux-musl", "aarch64", &[]),
        ("arm-linux-musleabihf", "arm", &["-mcpu=cortex_a15"]),
        ("powerpc-linux-musleabihf", "ppc", &[]),
    ];
    // the last scene of each kind, some of which begin above the surface
    let kinds: BTreeMap<_, _> = of_each_kind().into_iter().collect();
    assert_eq!(kinds.len(), 10);
    for (kind, text) in kinds {
        let Some(fmu) = fmu_of(&text.replace("initial_gap = 1e-6", "initial_gap = 0.0")) else { return };
        let count = if ["rate", "lossy"].contains(&kind) { targets.len() } else { 2 };
        for (target, processor, options) in &targets[..count] {
            match systems::linked(&format!("linked-{kind}"), &fmu.source(), (target, processor), options) {
                Err(why) => skipped(target, &why),
                Ok(host) => assert_same(&fmu, &host, &format!("{kind} on {target}")),
            }
        }
    }
}

#[test]
fn c_source_gives_the_same_bits_by_the_rules_of_microsofts_compiler() {
    for kind in ["state", "moved"] {
        let Some(fmu) = fmu_of(&of_kind(kind)) else { return };
        match systems::linked_by_microsofts_rules(&format!("linked-{kind}"), &fmu.source()) {
            Err(why) => skipped("C source by the rules of Microsoft's compiler", &why),
            Ok(host) => assert_same(&fmu, &host, kind),
        }
    }
}

/// tcc has neither optimization nor vector instructions: square roots are computed in integers.
#[test]
fn c_source_gives_the_same_bits_by_tcc() {
    let Some(fmu) = fmu_of(&of_kind("moved")) else { return };
    let Packages { folder, .. } = match packages("tcc", "bookworm", &["tcc", "libtcc-dev"], false) {
        Ok(packages) => packages,
        Err(why) => return skipped("C source by tcc", &why),
    };
    let parts = format!("-B{}", folder.join("usr/lib/x86_64-linux-gnu/tcc").display());
    let library = compiled(&fmu, &folder.join("usr/bin/tcc").to_string_lossy(), &[&parts]);
    assert!(compared(&fmu, &library, 5, 10) > 0);
}
