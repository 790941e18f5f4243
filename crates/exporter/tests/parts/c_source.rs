use brinell_exporter::c_source::{FORMAT, FUNCTIONS, RUNTIME, with_scene};
use brinell_exporter::platform::Platform;
use brinell_fmu::scene::library::block::Block;

#[test]
fn a_text_of_another_version_takes_no_scene() {
    let block = Block::unfilled(1);
    assert_eq!(with_scene(b"/* brinell C source 0 */\n", &block, "ball", 10), None);
    let text = String::from_utf8(with_scene(FORMAT.as_bytes(), &block, "ball", 10).unwrap()).unwrap();
    assert!(text.contains("#define FMI2_FUNCTION_PREFIX ball_\n") && text.ends_with(FORMAT), "{text}");
}

#[test]
fn the_files_are_plain_text_with_short_lines() {
    for (name, text) in [FUNCTIONS, RUNTIME] {
        assert!(text.is_ascii(), "{name}");
        assert!(text.lines().all(|line| line.len() <= 120), "{name}");
    }
    assert!(Platform::C_CODE.is_source());
}
