use brinell::parts::LIBM;
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

/// The output of `command`.
fn printed(command: &mut Command) -> String {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("UTF-8")
}

/// A new version of `libm` may need other options.
#[test]
fn libm_is_compiled_as_its_own_build_script_says() {
    let mut cargo = Command::new(env!("CARGO"));
    cargo.current_dir(env!("CARGO_MANIFEST_DIR")).args(["metadata", "--format-version=1", "--locked", "--offline"]);
    // the dependencies of other systems are not downloaded
    cargo.args(["--filter-platform", brinell_exporter::platform::here().expect("a known system").targets[0].triple]);
    let metadata: Value = serde_json::from_str(&printed(&mut cargo)).expect("JSON");
    let libm = metadata["packages"].as_array().unwrap().iter().find(|package| package["name"] == "libm").unwrap();
    let folder = Path::new(libm["manifest_path"].as_str().unwrap()).parent().unwrap();
    let new = tempfile::tempdir().unwrap();
    let script = new.path().join("build");
    let mut rustc = Command::new(Path::new(env!("CARGO")).with_file_name("rustc"));
    rustc.args(["--cfg=feature=\"arch\"", "--cap-lints=allow", "--edition=2021"]).arg(folder.join("build.rs"));
    printed(rustc.arg("-o").arg(&script));
    let mut script = Command::new(script);
    script.env("CARGO_MANIFEST_DIR", folder).env("OUT_DIR", new.path()).env("OPT_LEVEL", "s").env("TARGET", "any");
    for name in ["ARCH", "ENV", "OS", "VENDOR"] {
        script.env(format!("CARGO_CFG_TARGET_{name}"), "any");
    }
    let said = printed(script.env("CARGO_FEATURE_ARCH", "1"));
    let said: BTreeSet<_> = said.lines().filter_map(|line| line.strip_prefix("cargo:rustc-cfg=")).collect();
    let ours =
        LIBM.iter().filter_map(|argument| argument.strip_prefix("--cfg=")).filter(|cfg| !cfg.contains("feature"));
    assert_eq!(ours.collect::<BTreeSet<_>>(), said);
    assert!(LIBM.contains(&format!("--edition={}", libm["edition"].as_str().unwrap()).as_str()));
}
