//! FMUs for several platforms. Other systems are tested if their toolchain is available; BRINELL_PLATFORMS=all downloads it.

use brinell_testing::archive;
use brinell_testing::command::{Run, assert_same, brinell, contents, empty_folder, output, run, scene};
use brinell_testing::toolchain;
use brinell_testing::unit;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// All folders, in their order in the archive.
const ALL: [&str; 5] = ["linux64", "aarch64-linux", "win64", "darwin64", "aarch64-darwin"];

/// The files of an FMU by name.
fn files(fmu: &Path) -> BTreeMap<String, Vec<u8>> {
    archive::files(fmu).into_iter().collect()
}

/// The library of a platform.
#[track_caller]
fn library<'a>(files: &'a BTreeMap<String, Vec<u8>>, platform: &str) -> &'a [u8] {
    let folder = format!("binaries/{platform}/");
    let mut found = files.iter().filter(|(name, _)| name.starts_with(&folder));
    let (_, bytes) = found.next().unwrap_or_else(|| panic!("no {folder} in {:?}", files.keys()));
    assert!(found.next().is_none(), "one library in {folder}");
    bytes
}

fn number(bytes: &[u8], at: usize) -> u32 {
    u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap())
}

/// The format and the processor of a library, from its first bytes.
fn kind(library: &[u8]) -> String {
    match number(library, 0) {
        0x464C_457F => format!("ELF {}", number(library, 18) & 0xFFFF),
        0xFEED_FACF => format!("Mach-O {:#x}", number(library, 4)),
        0xBEBA_FECA => format!("universal {}", number(library, 4).swap_bytes()),
        mark if mark & 0xFFFF == 0x5A4D => {
            let header = number(library, 0x3C) as usize;
            format!("PE {:#x}", number(library, header + 4) & 0xFFFF)
        }
        mark => panic!("a file that begins with {mark:#x}"),
    }
}

fn contains(bytes: &[u8], text: &[u8]) -> bool {
    bytes.windows(text.len()).any(|window| window == text)
}

/// An export of the default scene in `folder` for these platforms, with this toolchain.
fn export(folder: &Path, toolchain: &Path, scene_name: &str, arguments: &[&str]) -> Run {
    let mut command = brinell(folder);
    command.env("BRINELL_TOOLCHAIN", toolchain).arg("export").arg(scene(scene_name)).args(arguments);
    output(&mut command).with_status(0)
}

#[test]
fn the_platform_of_this_machine_is_the_default() {
    let folder = empty_folder();
    let scene = scene("steel_ball").display().to_string();
    run(folder.path(), ["export", &scene, "-o", "default.fmu"]).with_status(0);
    let json = run(folder.path(), ["export", &scene, "-o", "default.fmu", "--json"]).with_status(0).json();
    let platforms: Vec<_> = json["libraries"].as_object().unwrap().keys().cloned().collect();
    let [here] = &platforms[..] else { panic!("one platform: {json}") };
    assert!(ALL.contains(&here.as_str()), "{json}");
    run(folder.path(), ["export", &scene, "-o", "named.fmu", "--platforms", here]).with_status(0);
    let read = |name: &str| fs::read(folder.path().join(name)).unwrap();
    assert_same(&read("default.fmu"), &read("named.fmu"));
    let library = library(&files(&folder.path().join("named.fmu")), here).len();
    assert_eq!(json["libraries"][here]["size"], library);
}

#[test]
fn an_unknown_platform_is_reported_with_the_known_ones() {
    let folder = empty_folder();
    for platforms in ["win32", "linux64,win32", ""] {
        let said = run(folder.path(), ["export", scene("steel_ball").to_str().unwrap(), "--platforms", platforms]);
        let said = said.with_status(1);
        let name = platforms.rsplit(',').next().unwrap();
        let meant = if name.is_empty() { ", only" } else { "; did you mean win64? There are" };
        let message = format!(
            "there is no platform `{name}`{meant} linux64, aarch64-linux, win64, darwin64, aarch64-darwin, `all` for all of these, and c-code for C source"
        );
        assert!(said.err.contains(&message), "{said:#?}");
        assert!(contents(folder.path()).is_empty(), "files were left");
    }
}

/// A compiler for its own target only: each message says what to install, and nothing is written.
#[test]
#[cfg(target_os = "linux")]
fn a_platform_that_cannot_be_built_is_reported_with_how_to_get_it() {
    let folder = empty_folder();
    let compiler = folder.path().join("bin");
    let script = "#!/bin/sh\ncase $1 in --print) echo /no/sysroot;; *) echo 'release: 1.99.0';; esac\n";
    fs::create_dir(&compiler).unwrap();
    fs::write(compiler.join("rustc"), script).unwrap();
    output(std::process::Command::new("chmod").arg("+x").arg(compiler.join("rustc"))).with_status(0);
    let path = format!("{}:{}", compiler.display(), std::env::var("PATH").unwrap());
    for (platform, triple) in [("win64", "x86_64-pc-windows-msvc"), ("darwin64", "x86_64-apple-darwin")] {
        let mut command = brinell(folder.path());
        command.arg("export").arg(scene("steel_ball")).args(["--platforms", platform, "-o", "x.fmu"]);
        command.env_remove("CARGO").env("PATH", &path).env("BRINELL_TOOLCHAIN", folder.path().join("none"));
        let said = output(&mut command).with_status(1);
        for part in [
            &format!("no library can be built for {triple}: the Rust toolchain has no target {triple}"),
            &format!("`rustup target add {triple}`"),
        ] {
            assert!(said.err.contains(part), "{part}: {said:#?}");
        }
        assert_eq!(contents(folder.path()), ["bin"], "files were left");
    }
}

#[test]
fn every_platform_has_a_library_of_its_kind_with_the_same_guid() {
    let Some(toolchain) = toolchain::toolchain() else { return };
    let folder = empty_folder();
    for name in ["steel_ball", "everything", "mass_known"] {
        let fmu = format!("{name}.fmu");
        let said = export(folder.path(), &toolchain, name, &["--platforms", "all", "--json", "-o", &fmu]).json();
        let files = files(&folder.path().join(&fmu));
        let guid = said["guid"].as_str().unwrap();
        assert!(contains(&files["modelDescription.xml"], guid.as_bytes()), "{name}: {guid}");
        let kinds = ["ELF 62", "ELF 183", "PE 0x8664", "universal 2", "Mach-O 0x100000c"];
        for (platform, expected) in ALL.iter().zip(kinds) {
            let library = library(&files, platform);
            assert_eq!(kind(library), expected, "{name}, {platform}");
            assert!(contains(library, guid.as_bytes()), "{name}, {platform}: no GUID {guid}");
            assert_eq!(said["libraries"][platform]["size"], library.len(), "{name}, {platform}");
            for path in [env!("CARGO_MANIFEST_DIR"), toolchain.to_str().unwrap(), "rustc-", "/home/", "/root/"] {
                assert!(!contains(library, path.as_bytes()), "{name}, {platform}: {path}");
            }
        }
        let universal = library(&files, "darwin64");
        assert!(contains(universal, library(&files, "aarch64-darwin")), "{name}: the same library for arm64");
        let wide: Vec<u8> = format!("{name}.dll").encode_utf16().flat_map(u16::to_le_bytes).collect();
        assert!(contains(library(&files, "win64"), &wide), "{name}: the version resource has the name");
    }
}

/// Compilers translate loops over memory to other functions on each system; a standalone library has all of them.
#[test]
fn a_standalone_library_needs_nothing_on_any_platform() {
    let Some(toolchain) = toolchain::toolchain() else { return };
    for name in ["steel_ball", "everything"] {
        let folder = empty_folder();
        let text = fs::read_to_string(scene(name)).unwrap();
        assert!(text.contains("\n[fmu]\n"), "{name}");
        let path = folder.path().join("scene.toml");
        fs::write(&path, text.replacen("\n[fmu]\n", "\n[fmu]\nstandalone = true\n", 1)).unwrap();
        let path = path.to_str().unwrap();
        let said = export(folder.path(), &toolchain, path, &["--platforms", "all", "--json"]).json();
        assert_eq!(said["imports"], serde_json::json!([]), "{name}");
        assert_eq!(said["libraries"].as_object().unwrap().len(), ALL.len(), "{name}");
    }
}

#[test]
fn all_platforms_at_once_are_those_made_apart_bit_for_bit() {
    let Some(toolchain) = toolchain::toolchain() else { return };
    let folder = empty_folder();
    export(folder.path(), &toolchain, "steel_ball", &["--platforms", "all", "-o", "all.fmu"]);
    // another cache, so that nothing of the first export is reused
    let cache = empty_folder();
    let mut apart = BTreeMap::new();
    for platforms in ["darwin64", "win64,linux64", "aarch64-darwin,aarch64-linux"] {
        let name = format!("{platforms}.fmu");
        let mut command = brinell(folder.path());
        command.env("BRINELL_TOOLCHAIN", &toolchain).env("BRINELL_CACHE", cache.path());
        command.arg("export").arg(scene("steel_ball")).args(["--platforms", platforms, "-o", &name]);
        output(&mut command).with_status(0);
        apart.extend(files(&folder.path().join(name)));
    }
    let together = files(&folder.path().join("all.fmu"));
    assert_eq!(apart.keys().collect::<Vec<_>>(), together.keys().collect::<Vec<_>>());
    assert!(apart == together, "a file differs");
}

#[test]
fn an_option_puts_the_arm64_library_into_linux64() {
    let Some(toolchain) = toolchain::toolchain() else { return };
    let folder = empty_folder();
    let arguments = ["--platforms", "linux64,aarch64-linux", "--arm64-in-linux64", "-o", "arm.fmu"];
    export(folder.path(), &toolchain, "steel_ball", &arguments);
    let files = files(&folder.path().join("arm.fmu"));
    assert_eq!(kind(library(&files, "linux64")), "ELF 183");
    assert_same(library(&files, "linux64"), library(&files, "aarch64-linux"));
}

/// Without a compiler the default is an FMU for every machine.
#[test]
fn an_fmu_from_prebuilt_libraries_is_for_every_machine_and_small() {
    let Some(toolchain) = toolchain::toolchain() else { return };
    let folder = empty_folder();
    let store = folder.path().join("store");
    let mut prebuild = brinell(folder.path());
    prebuild.env("BRINELL_TOOLCHAIN", &toolchain).args(["prebuild", "--kinds", "state,moved"]);
    output(prebuild.args(["--platforms", "all", "-o"]).arg(&store)).with_status(0);
    let export_scene = |scene: &Path, name: &str, arguments: &[&str]| {
        let mut command = brinell(folder.path());
        command.env_remove("CARGO").env("PATH", "/no/path").env("BRINELL_PREBUILT", &store);
        let said = output(command.arg("export").arg(scene).args(["--json", "-o", name]).args(arguments));
        let platforms =
            said.with_status(0).json()["libraries"].as_object().unwrap().keys().cloned().collect::<Vec<_>>();
        (files(&folder.path().join(name)), platforms)
    };
    let export = |name: &str, arguments: &[&str]| export_scene(&scene("steel_ball"), name, arguments);
    let (every_machine, platforms) = export("default.fmu", &[]);
    assert_eq!(platforms, ["aarch64-linux", "darwin64", "linux64", "win64"]);
    let size = fs::metadata(folder.path().join("default.fmu")).unwrap().len();
    assert!(size < 500_000, "{size} bytes");
    let (every_folder, platforms) = export("all.fmu", &["--platforms", "all"]);
    assert_eq!(platforms.len(), 5);
    for platform in ["linux64", "aarch64-linux", "win64", "darwin64"] {
        assert_same(library(&every_machine, platform), library(&every_folder, platform));
    }
    assert!(contains(library(&every_machine, "darwin64"), library(&every_folder, "aarch64-darwin")));
    let (arm, _) = export("arm.fmu", &["--platforms", "linux64", "--arm64-in-linux64"]);
    assert_same(library(&arm, "linux64"), library(&every_machine, "aarch64-linux"));
    // the scenes of other shapes differ in their data alone
    for scene in unit::scenes_in("scenes/shapes").into_iter().chain(["roller", "two_rollers"].map(scene)) {
        let (_, platforms) = export_scene(&scene, "shape.fmu", &["--platforms", "all"]);
        assert_eq!(platforms.len(), 5, "{}", scene.display());
    }
}
