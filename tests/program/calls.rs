//! What the program says of calls that it refuses, warns of or asks about: `calls.txt` has them all.

use crate::command::{contents, empty_folder, missing, run};
use brinell_testing::table::{Table, altered, plain};
use std::fs;

/// The arguments of a call, of which those with spaces are in quotes.
fn arguments(call: &str) -> Vec<&str> {
    let parts = call.split('"').enumerate();
    parts
        .flat_map(|(place, part)| if place % 2 == 1 { vec![part] } else { part.split_whitespace().collect() })
        .collect()
}

#[test]
fn every_call_of_the_table_is_answered_with_these_words() {
    let table = Table::read("tests/program/calls.txt");
    let files = table.files();
    table.check(|case, _| {
        let (place, call) = case[0].split_once(": ").expect("a folder");
        let mut own: Vec<(&str, String)> = Vec::new();
        for (path, text) in &files {
            own.extend(path.strip_prefix(&format!("{place}/")).map(|name| (name, text.clone())));
        }
        for edit in case[1..].chunks(2) {
            let part = plain(edit[0].trim());
            let mut with = own.iter_mut().filter(|(_, text)| text.contains(&part));
            let (_, text) = with.next().unwrap_or_else(|| panic!("no file with {part}"));
            *text = altered(text, edit);
            assert!(with.next().is_none(), "two files with {part}");
        }
        let folder = empty_folder();
        own.iter().for_each(|(name, text)| fs::write(folder.path().join(name), text).unwrap());
        let answer = run(folder.path(), arguments(call));
        assert_eq!(contents(folder.path()).len(), own.len(), "{call} has written a file");
        let status = answer.status.expect("a status");
        assert!(status == 0 || answer.out.is_empty() && answer.err.starts_with("brinell: "), "{answer:#?}");
        let said = answer.err.replace("brinell: ", "").replace("brinell.exe", "brinell");
        format!("{status} {}", said.replace(&missing(), "NO SUCH FILE"))
    });
}
