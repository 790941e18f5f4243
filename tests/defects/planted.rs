//! Mistakes that are switched on while the tests run, so that one build has nearly all of them.
//!
//! The function with a mistake gets a second body: `if planted(7) { the body with the mistake } else { the body }`. A program reads
//! the number of its mistake from its environment as it is loaded, and so does the library of an FMU. A mistake in a constant has
//! no function; the sources are built for it alone.

use super::Defect;
use brinell_testing::rebuilt::Sources;
use std::collections::{BTreeMap, HashSet};

/// The variable of the environment with the number of a mistake.
pub const VARIABLE: &str = "BRINELL_MISTAKE";

/// What the physics gets, on which all others depend. It calls nothing: a library of an FMU may be alone in its process.
const SWITCH: &str = r#"
/// The mistake of this process.
#[allow(unsafe_code, missing_docs)]
pub mod planted {
    use core::sync::atomic::{AtomicU32, Ordering::Relaxed};

    static NUMBER: AtomicU32 = AtomicU32::new(0);

    pub fn planted(number: u32) -> bool {
        NUMBER.load(Relaxed) == number
    }

    #[used]
    #[unsafe(link_section = ".init_array")]
    static READ: extern "C" fn(i32, *const *const u8, *const *const u8) = read;

    extern "C" fn read(_: i32, _: *const *const u8, mut environment: *const *const u8) {
        let mut number = 0_u32;
        // SAFETY: the C library gives a list of texts with a null pointer at its end.
        unsafe {
            while !(*environment).is_null() {
                let (mut text, mut name) = (*environment, b"BRINELL_MISTAKE=".iter());
                while name.as_slice().first().is_some_and(|byte| *byte == *text) {
                    name.next();
                    text = text.add(1);
                }
                while name.as_slice().is_empty() && *text != 0 {
                    number = number.wrapping_mul(10).wrapping_add(u32::from(*text)).wrapping_sub(48);
                    text = text.add(1);
                }
                environment = environment.add(1);
            }
        }
        NUMBER.store(number, Relaxed);
    }

    /// A mistake may have a panic; then the process ends.
    #[unsafe(no_mangle)]
    extern "C" fn brinell_a_panic_path_survived() -> ! {
        // SAFETY: there is no safety to keep.
        unsafe { core::ptr::null_mut::<u8>().write_volatile(0) };
        loop {}
    }
}
"#;

/// Plants all of these mistakes in the `sources` that a function has; returns their numbers.
pub fn plant(sources: &Sources, defects: &[&Defect]) -> HashSet<u32> {
    let mut by_file: BTreeMap<&str, Vec<&Defect>> = BTreeMap::new();
    for defect in defects {
        by_file.entry(&defect.file).or_default().push(defect);
    }
    let mut all = HashSet::new();
    for (file, defects) in by_file {
        let text = sources.read(file);
        let switch = if file.contains("crates/contact/") { "crate" } else { "brinell_contact" };
        let (text, planted) = with_switches(&text, &defects, switch);
        sources.write(file, &text);
        all.extend(planted);
    }
    let file = "crates/contact/src/lib.rs";
    sources.write(file, &(sources.read(file).replace("#![forbid(unsafe_code)]", "") + SWITCH));
    all
}

/// The `text` of a file with a second body for each of these mistakes that is in a function, and their numbers.
fn with_switches(text: &str, defects: &[&Defect], switch: &str) -> (String, Vec<u32>) {
    let mut bodies: BTreeMap<(usize, usize), Vec<&Defect>> = BTreeMap::new();
    for defect in defects {
        if let Some(body) = body_around(text, defect) {
            bodies.entry(body).or_default().push(defect);
        }
    }
    let (mut planted, mut text) = (Vec::new(), text.to_string());
    // the last one first: places before it stay
    for ((from, to), defects) in bodies.into_iter().rev() {
        let body = text[from..to].to_string();
        let mut all = String::new();
        for defect in defects {
            let wrong = body.replacen(&defect.old, &defect.new, 1);
            all += &format!("if {switch}::planted::planted({}) {{\n{wrong}}} else ", defect.number);
            planted.push(defect.number);
        }
        text.replace_range(from..to, &format!("{all}{{\n{body}}}\n"));
    }
    (text, planted)
}

/// From where to where the body of the function around a mistake goes, in sources that are formatted; `None` for a constant, for what
/// is computed when it is compiled, where the two bodies would be of two types, and where a mistake has to be alone.
pub fn body_around(text: &str, defect: &Defect) -> Option<(usize, usize)> {
    let found = text.find(&defect.old)?;
    let from = found + defect.old.len() - defect.old.trim_start().len();
    let (mut end, mut lines) = (0, Vec::new());
    for line in text.split_inclusive('\n') {
        lines.push((end, line));
        end += line.len();
    }
    let indent = |line: &str| line.len() - line.trim_start().len();
    let place = lines.iter().rposition(|(start, _)| *start <= from)?;
    let depth = indent(lines[place].1);
    let first = lines[..place].iter().rposition(|(_, line)| indent(line) < depth && is_function(line))?;
    let margin = indent(lines[first].1);
    let open = first + lines[first..].iter().position(|(_, line)| line.ends_with("{\n"))?;
    let is_end = |(_, line): &&(usize, &str)| line.trim_end() == format!("{}}}", " ".repeat(margin));
    let close = lines[open..].iter().find(is_end)?.0;
    let head = &text[lines[first].0..lines[open].0 + lines[open].1.len()];
    let is_usual = !defect.alone && !head.contains("const fn") && !head.contains("-> impl ");
    let body = (lines[open + 1].0, close);
    (is_usual && body.0 <= found && found + defect.old.len() <= close).then_some(body)
}

fn is_function(line: &str) -> bool {
    let words = ["pub", "pub(crate)", "pub(super)", "const", "unsafe", "extern", "\"C\""];
    line.split_whitespace().find(|word| !words.contains(word)) == Some("fn")
}
