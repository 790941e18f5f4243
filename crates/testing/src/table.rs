//! Tables of what the program says: good files, and cases with the message word for word.

use crate::places::root;
use std::collections::HashMap;
use std::env;
use std::fs;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// A table in a file: `== NAME` begins a good file, `-- ` a claim, and every other line is a case: its parts, and what the program says,
/// with ` => ` between them.
pub struct Table {
    path: String,
    text: String,
}

impl Table {
    /// Reads the table at `path` below the project.
    pub fn read(path: &str) -> Table {
        let text = fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"));
        Table { path: path.into(), text: text.replace("\r\n", "\n") }
    }

    /// The claims with their cases.
    pub fn claims(&self) -> &str {
        &self.text[self.begin()..]
    }

    fn begin(&self) -> usize {
        self.text.find("\n-- ").expect("claims") + 1
    }

    /// The good files by their names.
    pub fn files(&self) -> HashMap<&str, String> {
        let files = self.text.split("\n== ").skip(1).map(|part| part.split("\n-- ").next().expect("a first part"));
        let named = files.map(|part| part.split_once('\n').expect("a name in a line of its own"));
        named.map(|(name, text)| (name, format!("{}\n", text.trim_end()))).collect()
    }

    /// Whether the program says in each case what the table has; `said` gives that from the parts of a case and the words of the table. With
    /// `BRINELL_WRITE`, it is written.
    pub fn check(&self, said: impl Fn(&[&str], &str) -> String + Sync) {
        let (next, wrong) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
        let mut lines: Vec<String> = self.claims().lines().map(String::from).collect();
        let told = |line: &str| {
            // an empty text may be at the end of an edit
            let parts: Vec<&str> = line.split(" =>").collect();
            let (words, case) = parts.split_last().expect("words");
            let said = said(case, words.trim_start()).trim_end().replace('\\', "\\\\").replace('\n', "\\n");
            format!("{} => {said}", case.join(" =>"))
        };
        let work = || {
            while let Some((place, line)) =
                Some(next.fetch_add(1, Ordering::Relaxed)).and_then(|at| Some((at, lines.get(at)?)))
            {
                let told = if line.starts_with("-- ") { line.clone() } else { told(line) };
                if told != *line {
                    wrong.lock().unwrap().push((place, told));
                }
            }
        };
        thread::scope(|scope| {
            (0..thread::available_parallelism().map_or(1, usize::from)).for_each(|_| drop(scope.spawn(work)))
        });
        let wrong = wrong.into_inner().unwrap();
        if env::var_os("BRINELL_WRITE").is_some() {
            wrong.into_iter().for_each(|(place, line)| lines[place] = line);
            let text = format!("{}{}\n", &self.text[..self.begin()], lines.join("\n"));
            return fs::write(root().join(&self.path), text).unwrap();
        }
        let shown = wrong.iter().map(|(place, line)| format!("not {}\nbut {line}", lines[*place]));
        assert!(wrong.is_empty(), "{}", shown.collect::<Vec<_>>().join("\n"));
    }
}

/// `text` with its line breaks and special characters.
pub fn plain(text: &str) -> String {
    let (mut all, mut rest) = (String::new(), text);
    while let Some((before, behind)) = rest.split_once('\\') {
        all += before;
        rest = match behind.strip_prefix("u{").and_then(|code| code.split_once('}')) {
            Some((code, rest)) => {
                all.push(u32::from_str_radix(code, 16).ok().and_then(char::from_u32).expect("the code of a character"));
                rest
            }
            None => {
                all.push(if behind.starts_with('n') { '\n' } else { '\\' });
                &behind[1..]
            }
        };
    }
    all + rest
}

/// `text` after edits: pairs of a text that is in it and what stands there instead, behind the end if the first is empty.
#[track_caller]
pub fn altered(text: &str, edits: &[&str]) -> String {
    let edits: Vec<String> = edits.iter().map(|part| plain(part.trim())).collect();
    edits.chunks(2).fold(text.to_string(), |text, edit| {
        assert!(text.contains(&edit[0]), "nothing of {:?} to alter in {text}", edit[0]);
        if edit[0].is_empty() { text + &edit[1] } else { text.replacen(&edit[0], &edit[1], 1) }
    })
}
