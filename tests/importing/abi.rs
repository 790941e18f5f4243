//! The C interface is that of the standard: a C compiler checks signatures, types, values and callbacks.
//!
//! A function of the wrong type would still link and load, but read its arguments from the wrong registers. The header
//! generated from the Rust source is therefore compiled together with the standard's own.

use brinell_testing::python;
use brinell_testing::skips;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::LazyLock;

const PROOF: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/c/abi.c");
const INTERFACE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/crates/unit/src/exports.rs");
const ABI: &str = include_str!("../../crates/fmu/src/fmi2/abi.rs");

/// The prototypes of the functions of an exported unit.
static HEADER: LazyLock<String> = LazyLock::new(|| {
    let config = cbindgen::Config {
        language: cbindgen::Language::C,
        style: cbindgen::Style::Type,
        cpp_compat: true,
        no_includes: true,
        usize_is_size_t: true,
        include_guard: Some("BRINELL_H".into()),
        export: cbindgen::ExportConfig { item_types: vec![cbindgen::ItemType::Functions], ..Default::default() },
        ..Default::default()
    };
    let bindings = cbindgen::Builder::new().with_config(config).with_src(INTERFACE).generate();
    let mut header = Vec::new();
    bindings.expect("the interface has a C header").write(&mut header);
    String::from_utf8(header).expect("a header is text")
});

/// The folder of the standard's headers, which are part of fmpy.
static STANDARD: LazyLock<PathBuf> = LazyLock::new(|| python::site_packages_file("fmpy/c-code"));

/// Compiles `source` with `compiler`, without output, with the strictest settings; brinell.h is in `folder`.
fn compile(compiler: &str, language: &str, source: &Path, folder: &Path) -> Output {
    Command::new(compiler)
        .args([language, "-Wall", "-Wextra", "-Werror", "-fsyntax-only", "-I"])
        .arg(&*STANDARD)
        .arg("-I")
        .arg(folder)
        .arg(source)
        .output()
        .unwrap_or_else(|error| panic!("{compiler}: {error}"))
}

/// Compiles the proof with `header`; returns the compiler's messages if it fails.
fn prove(compiler: &str, language: &str, header: &str) -> Result<(), String> {
    let folder = tempfile::tempdir().expect("a folder for temporary files");
    let path = folder.path().join("brinell.h");
    fs::write(&path, header).expect("a temporary file");
    let mut source = PathBuf::from(PROOF);
    if compiler == "c++" {
        // a C++ compiler chooses the language by the extension
        source = folder.path().join("abi.cpp");
        fs::copy(PROOF, &source).expect("a temporary file");
    }
    let output = compile(compiler, language, &source, folder.path());
    if output.status.success() { Ok(()) } else { Err(String::from_utf8_lossy(&output.stderr).into_owned()) }
}

/// The functions that a section of the standard's header declares: `FMI2_Export fmi2DoStepTYPE fmi2DoStep;`.
fn declared(section: &str) -> BTreeSet<&str> {
    let declarations = section.lines().filter(|line| line.trim_start().starts_with("FMI2_Export fmi2"));
    declarations.filter_map(|line| line.trim().trim_end_matches(';').rsplit(' ').next()).collect()
}

#[test]
fn every_signature_is_the_standards_in_c() {
    prove("cc", "-std=c99", &HEADER).unwrap();
}

#[test]
fn every_signature_is_the_standards_in_cpp() {
    if Command::new("c++").arg("--version").output().is_err() {
        return skips::skipped("signatures in C++", "there is no C++ compiler");
    }
    prove("c++", "-std=c++11", &HEADER).unwrap();
}

/// The proof above is meaningful only if it fails for a wrong header.
#[test]
fn a_header_with_one_wrong_signature_is_refused() {
    let alterations = [
        ("fmi2Real communicationStepSize", "float communicationStepSize", "fmi2DoStep"),
        ("const fmi2ValueReference *vUnknown_ref", "fmi2ValueReference *vUnknown_ref", "fmi2GetDirectionalDerivative"),
        ("size_t *size", "unsigned *size", "fmi2SerializedFMUstateSize"),
        ("void fmi2FreeInstance", "fmi2Status fmi2FreeInstance", "fmi2FreeInstance"),
        ("fmi2Status fmi2CancelStep(fmi2Component c)", "fmi2Status fmi2CancelStep(void)", "fmi2CancelStep"),
        ("fmi2EventInfo *fmi2eventInfo", "fmi2Real *fmi2eventInfo", "fmi2NewDiscreteStates"),
    ];
    for (from, to, function) in alterations {
        assert!(HEADER.contains(from), "the header has no {from:?} to alter");
        let error = prove("cc", "-std=c99", &HEADER.replacen(from, to, 1)).expect_err(to);
        assert!(
            error.contains("conflicting types") && error.contains(function),
            "{to}: refused for another reason: {error}"
        );
    }
}

#[test]
fn the_header_has_all_functions_of_the_standard() {
    let standard = fs::read_to_string(STANDARD.join("fmi2Functions.h")).expect("the standard's header");
    // the declarations come last, in sections: common, Model Exchange, Co-Simulation
    let sections: Vec<_> = standard.split("Functions for FMI2 for ").collect();
    let [.., common, model_exchange, co_simulation] = sections[..] else { panic!("the header has other sections") };
    let exchange = declared(model_exchange);
    let own: BTreeSet<_> = declared(common).union(&declared(co_simulation)).copied().collect();
    assert_eq!((own.len(), exchange.len()), (34, 10), "{own:?} {exchange:?}");
    let wanted: BTreeSet<_> = own.union(&exchange).copied().collect();
    // a declaration starts at the beginning of its line; comments and further arguments do not
    let declarations = HEADER.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_alphabetic()));
    let heads = declarations.filter_map(|line| line.split_once('(')).map(|(head, _)| head);
    let found: Vec<_> = heads.filter_map(|head| head.rsplit([' ', '*']).next()).collect();
    assert_eq!(found.len(), 44, "{found:?}");
    assert_eq!(BTreeSet::from_iter(found), wanted);
}

/// The header uses types such as `fmi2Real` but does not define them. The definitions of Rust are repeated here in C: a second
/// `typedef` must agree with the first, and a value with the standard's.
#[test]
fn types_values_and_callbacks_of_the_abi_module_are_the_standards() {
    let proof = proof_of_types(ABI);
    assert!(proof.matches("typedef").count() >= 9 && proof.matches("sizeof(enum").count() >= 3, "{proof}");
    assert!(proof.matches("value_").count() >= 8 && proof.matches("offsetof").count() == 5, "{proof}");
    compile_types(&proof).unwrap();
}

#[test]
fn an_abi_module_with_one_wrong_type_or_value_is_refused() {
    for (from, to) in [
        ("fmi2Real = f64", "fmi2Real = f32"),
        ("fmi2ValueReference = c_uint", "fmi2ValueReference = c_int"),
        ("fmi2Discard: fmi2Status = 2", "fmi2Discard: fmi2Status = 1"),
        ("pub allocateMemory", "pub freeMemory"),
    ] {
        assert!(ABI.contains(from), "the module has no {from:?} to alter");
        compile_types(&proof_of_types(&ABI.replacen(from, to, 1))).expect_err(to);
    }
}

fn compile_types(proof: &str) -> Result<(), String> {
    let folder = tempfile::tempdir().expect("a folder for temporary files");
    let source = folder.path().join("types.c");
    fs::write(&source, proof).expect("a temporary file");
    // C11 allows a typedef to be repeated
    let output = compile("cc", "-std=c11", &source, folder.path());
    if output.status.success() { Ok(()) } else { Err(String::from_utf8_lossy(&output.stderr).into_owned()) }
}

/// A C program with the definitions of the Rust module `abi`.
fn proof_of_types(abi: &str) -> String {
    let mut proof = String::from("#include <stddef.h>\n#include \"fmi2Functions.h\"\n");
    let mut place = 0;
    for line in abi.lines() {
        let line = line.trim();
        if let Some((name, rust)) = line.strip_prefix("pub type ").and_then(|rest| rest.split_once(" = ")) {
            proof += &type_line(name, rust.trim_end_matches(';'));
        } else if let Some((name, rest)) = line.strip_prefix("pub const ").and_then(|rest| rest.split_once(": ")) {
            let value = rest.split_once(" = ").expect("a constant has a value").1;
            proof += &format!("_Static_assert({name} == {}, \"value_{name}\");\n", value.trim_end_matches(';'));
        } else if let Some((name, _)) = line.strip_prefix("pub ").and_then(|rest| rest.split_once(": ")) {
            // a field of the callbacks, the only structure: five pointers
            proof += &format!(
                "_Static_assert(offsetof(fmi2CallbackFunctions, {name}) == {place} * sizeof(void *), \"{name}\");\n"
            );
            place += 1;
        }
    }
    proof + "_Static_assert(sizeof(fmi2CallbackFunctions) == 5 * sizeof(void *), \"callbacks\");\n"
}

fn type_line(name: &str, rust: &str) -> String {
    let c = match rust {
        "*mut c_void" => "void *",
        "c_uint" => "unsigned int",
        "c_int" => "int",
        "c_char" => "char",
        "f64" => "double",
        "f32" => "float",
        "*const fmi2Char" => "const fmi2Char *",
        // the C driver of the interface tests compiles and calls the logger's type
        function if function.is_empty() || function.contains("fn(") => return String::new(),
        other => panic!("{name} = {other}: no C type is known for it"),
    };
    if ["fmi2Status", "fmi2Type", "fmi2StatusKind"].contains(&name) {
        // an enumeration in C is an `int` in Rust, because C may pass any value
        return format!("_Static_assert(sizeof({name}) == sizeof({c}), \"sizeof(enum {name})\");\n");
    }
    format!("typedef {c} {name};\n")
}
