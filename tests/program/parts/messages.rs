use brinell::parts::{held, wrapped};
use brinell_exporter::layout::WIDTH;

#[test]
fn a_message_is_wrapped_where_it_is_words() {
    let words = "word ".repeat(30) + "end";
    let shown = format!("12 | {}", "x ".repeat(60));
    let path = "y".repeat(120);
    let text = wrapped(&format!("brinell: {words}\n{shown}\n   | ^\n  {path} {words}\n"));
    let wide: Vec<_> = text.lines().filter(|line| line.len() > WIDTH).collect();
    assert_eq!(wide, [shown.as_str(), &format!("  {path}")]);
    assert!(text.starts_with("brinell: word") && text.contains("\n  word") && text.contains("\n    word"), "{text}");
    assert_eq!(text.matches("word").count(), 60);
    assert!(text.ends_with("end\n"));
}

#[test]
fn a_word_that_is_longer_than_any_path_is_cut() {
    let number = "1".repeat(3_000_000);
    assert_eq!(held(&number).len(), 305);
    let path = "y/".repeat(2000);
    assert_eq!(held(&path), path);
}
