use brinell::parts::PrebuiltFolder;
use std::fs;

#[test]
fn a_platform_takes_a_list_for_each_of_its_targets() {
    let root = tempfile::tempdir().unwrap();
    let found = |target: &str| {
        fs::write(root.path().join(target).with_extension("json"), "").unwrap();
        let folder = PrebuiltFolder { path: root.path().into() };
        folder.platforms().iter().map(|platform| platform.folder).collect::<Vec<_>>()
    };
    assert_eq!(found("x86_64-unknown-linux-gnu"), ["linux64"]);
    assert_eq!(found("x86_64-apple-darwin"), ["linux64"], "the library for macOS is universal");
    assert_eq!(found("aarch64-apple-darwin"), ["linux64", "darwin64", "aarch64-darwin"]);
}
