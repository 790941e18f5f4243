//! What the program says of calls that it refuses, warns of or asks about: `calls.txt` has them all. What is in its answers to others:
//! `answers.txt`.

use crate::command::missing;
use brinell_testing::folder::{Folder, at, words};
use brinell_testing::table::{Table, altered, plain};
use serde_json::Value;
use std::collections::HashMap;

/// The folder of a case, `FOLDER: CALL`, with these edits of its files; and the call.
fn folder_of<'a>(files: &HashMap<&str, String>, case: &'a str, edits: &[&str]) -> (Folder, &'a str) {
    let (place, call) = case.split_once(": ").expect("a folder");
    let of_folder = files.iter().filter_map(|(path, text)| Some((path.strip_prefix(place)?.strip_prefix('/')?, text)));
    let mut own: Vec<(&str, String)> = of_folder.map(|(name, text)| (name, text.clone())).collect();
    for edit in edits.chunks(2) {
        let part = plain(edit[0].trim());
        let mut with = own.iter_mut().filter(|(_, text)| text.contains(&part));
        let (_, text) = with.next().unwrap_or_else(|| panic!("no file with {part}"));
        *text = altered(text, edit);
        assert!(with.next().is_none(), "two files with {part}");
    }
    let own: Vec<_> = own.iter().map(|(name, text)| (*name, text.as_str())).collect();
    (Folder::with(&own), call)
}

#[test]
fn every_call_of_the_table_is_answered_with_these_words() {
    let table = Table::read("tests/program/calls.txt");
    let files = table.files();
    table.check(|case, _| {
        let (folder, call) = folder_of(&files, case[0], &case[1..]);
        let before = folder.names();
        let answer = folder.call(call);
        assert_eq!(folder.names(), before, "{call} has written a file");
        let status = answer.status.expect("a status");
        assert!(status == 0 || answer.out.is_empty() && answer.err.starts_with("brinell: "), "{answer:#?}");
        let said = answer.err.replace("brinell: ", "").replace("brinell.exe", "brinell");
        format!("{status} {}", said.replace(&missing(), "NO SUCH FILE"))
    });
}

/// What is wrong with the answer to a call, of which this is claimed.
fn wrong(folder: &Folder, call: &str, claim: &str) -> Option<String> {
    for (begin, says) in [("says ", true), ("never says ", false)] {
        if let Some(part) = claim.strip_prefix(begin) {
            let said = folder.words(call);
            return (said.contains(part) != says).then_some(said);
        }
    }
    let answer = folder.json(call);
    let [path, verb, rest] = claim.splitn(3, ' ').collect::<Vec<_>>()[..] else { panic!("no claim: {claim}") };
    let found = at(&answer, path);
    let is_right = match verb {
        "has" => words(&found.to_string()).contains(rest),
        "lacks" => !words(&found.to_string()).contains(rest),
        "in" => {
            let ends = rest.split_once(" to ").expect("a range");
            let [from, to] = [ends.0, ends.1].map(|end| end.parse::<f64>().expect("the end of a range"));
            found.as_f64().is_some_and(|number| (from..=to).contains(&number))
        }
        "=" => {
            let (other, tolerance) = rest.rsplit_once(" +- ").unwrap_or((rest, "0"));
            let expected = match (serde_json::from_str(other), other.split_once(" of ")) {
                (Ok(value), _) => value,
                (Err(_), Some((path, call))) => at(&folder.json(call), path).clone(),
                (Err(_), None) => at(&answer, other).clone(),
            };
            is_equal(found, &expected, tolerance.parse().expect("a tolerance"))
        }
        _ => panic!("no claim: {claim}"),
    };
    (!is_right).then(|| found.to_string())
}

/// Whether two values are the same; numbers may differ by this part.
fn is_equal(one: &Value, other: &Value, tolerance: f64) -> bool {
    match (one.as_f64(), other.as_f64()) {
        (Some(one), Some(other)) => (one - other).abs() <= tolerance * other.abs(),
        _ => one == other,
    }
}

#[test]
fn every_answer_of_the_table_is_as_it_is_told_below_its_call() {
    let [calls, table] = ["calls", "answers"].map(|name| Table::read(&format!("tests/program/{name}.txt")));
    let files: HashMap<_, _> = calls.files().into_iter().chain(table.files()).collect();
    let mut case: Option<(Folder, &str)> = None;
    let (mut mistakes, mut count) = (Vec::new(), 0);
    for line in table.claims().lines().filter(|line| !line.starts_with("-- ")) {
        match (line.strip_prefix("  "), &case) {
            (Some(claim), Some((folder, call))) => {
                let found = wrong(folder, call, claim).map(|found| format!("{call}\n  {claim}\nbut {found}"));
                mistakes.extend(found);
                count += 1;
            }
            _ => {
                let parts: Vec<&str> = line.split(" =>").collect();
                case = Some(folder_of(&files, parts[0], &parts[1..]));
            }
        }
    }
    assert!(mistakes.is_empty() && count > 50, "{count}: {}", mistakes.join("\n"));
}
