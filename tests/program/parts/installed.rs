use brinell::parts::installed_with;
use std::fs;

#[test]
fn what_is_installed_is_beside_the_program_or_beside_one_of_two_folders_above() {
    let root = tempfile::tempdir().unwrap();
    let there = root.path().join("share/brinell/prebuilt");
    fs::create_dir_all(&there).unwrap();
    for program in ["brinell", "bin/brinell", "Python311/Scripts/brinell.exe"] {
        let found = installed_with(&root.path().join(program), "prebuilt");
        assert_eq!(found.as_ref(), Some(&there), "{program}");
    }
    let other = installed_with(&root.path().join("usr/lib/other/brinell"), "prebuilt");
    assert_eq!(other, None, "nothing of another installation");
}
