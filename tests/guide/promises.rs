//! The tests that the page of promises names.

use super::root;
use std::fs;

/// File and name of each test in the table: `file.rs` `name`.
fn named(page: &str) -> Vec<(&str, &str)> {
    let is_test_file = |text: &str| text.ends_with(".rs") || text.ends_with(".py");
    let pieces: Vec<_> = page.split('`').collect();
    pieces.windows(3).filter(|three| is_test_file(three[0])).map(|three| (three[0], three[2])).collect()
}

#[test]
fn every_test_on_the_page_of_promises_exists() {
    let page = fs::read_to_string(root().join("docs/project/promises.md")).expect("the page is there");
    let rows = page.lines().filter(|line| line.starts_with("| ")).count() - 1;
    let tests = named(&page);
    assert_eq!(tests.len(), rows, "each promise has a test");
    for (file, name) in tests {
        let text =
            fs::read_to_string(root().join("tests").join(file)).unwrap_or_else(|error| panic!("{file}: {error}"));
        let defined = [format!("\nfn {name}("), format!("\npub fn {name}("), format!("\ndef {name}(")];
        assert!(defined.iter().any(|text_of| text.contains(text_of)), "{file} has no test {name}");
    }
}
