use brinell_exporter::platform::{Platform, here, named};

#[test]
fn every_platform_is_found_by_its_folder() {
    for platform in Platform::ALL.into_iter().chain([Platform::C_CODE]) {
        assert_eq!(named(platform.folder), Ok(platform));
    }
    let refusal = named("linux32").unwrap_err();
    assert!(refusal.contains("`linux32`") && refusal.contains("aarch64-linux, win64"), "{refusal}");
    for (asked, meant) in [
        ("windows", Some("win64")),
        ("Win 64", Some("win64")),
        ("Linux", Some("linux64")),
        ("linux32", Some("linux64")),
        ("macos", Some("darwin64")),
        ("x86_64-linux", Some("linux64")),
        ("x86_64-pc-windows-msvc", Some("win64")),
        ("arm64", Some("aarch64-linux")),
        ("aarch64-drawin", Some("aarch64-darwin")),
        ("c code", Some("c-code")),
        ("commodore64", None),
    ] {
        let said = named(asked).unwrap_err();
        let question = meant.map(|meant| format!("did you mean {meant}?"));
        assert_eq!(said.contains("did you mean"), question.is_some(), "{said}");
        assert!(question.is_none_or(|question| said.contains(&question)), "{said}");
        assert!(said.contains("linux64, aarch64-linux, win64, darwin64, aarch64-darwin"), "{said}");
    }
}

#[test]
fn the_universal_library_alone_has_that_of_another_platform() {
    for one in Platform::ALL {
        for other in Platform::ALL {
            assert_eq!(one.has(&other), (one.folder, other.folder) == ("darwin64", "aarch64-darwin"));
        }
    }
}

#[test]
fn the_platform_of_this_machine_is_one_of_them() {
    let here = here().expect("tests run on a known platform");
    assert!(Platform::ALL.contains(&here) && here.targets[0].is_here());
    assert_eq!(
        brinell_exporter::platform::targets(&Platform::ALL).into_iter().filter(|target| target.is_here()).count(),
        1
    );
}
