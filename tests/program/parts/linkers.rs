use brinell::parts::how_to_install;

#[test]
fn what_to_install_is_named_on_every_system() {
    assert!(how_to_install("linux").contains("apt install gcc") && how_to_install("linux").contains("dnf install gcc"));
    assert!(how_to_install("macos").contains("xcode-select --install"));
    assert!(how_to_install("windows").contains("Build Tools for Visual Studio"));
}
