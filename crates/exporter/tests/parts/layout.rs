use brinell_exporter::layout::*;

#[test]
fn no_line_of_a_paragraph_is_too_wide() {
    let text = "word ".repeat(60) + &"x".repeat(120);
    let lines: Vec<_> = paragraph("  heading  ", &text).lines().map(str::to_string).collect();
    assert!(lines[0].starts_with("  heading  word word") && lines[1].starts_with("           word"));
    assert!(lines.iter().all(|line| line.len() <= WIDTH || line.trim() == "x".repeat(120)), "{lines:?}");
    assert!(
        lines.iter().rev().skip(2).all(|line| line.len() > 90),
        "a line is filled before the next begins: {lines:?}"
    );
}

#[test]
fn json_gives_no_commands_to_the_terminal_and_is_read_back_as_it_was() {
    let all: String = ('\0'..='\u{2100}').chain(['\u{feff}', char::MAX]).collect();
    let line = json_line(&serde_json::json!({ &all: [&all] }));
    let inside = line.strip_suffix('\n').expect("a line");
    assert!(!inside.contains(char::is_control), "{inside:?}");
    let read: serde_json::Value = serde_json::from_str(&line).expect("JSON");
    assert_eq!(read[&all][0], all);
}

#[test]
fn columns_are_in_line() {
    let rows = [["law", "force"], ["hertz", "1"]].map(|row| row.map(String::from).to_vec());
    assert_eq!(table(&rows, 1, 2), "  law    force\n  hertz      1\n");
}
