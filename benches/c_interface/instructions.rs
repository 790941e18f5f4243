//! How many instructions the calls have: this program runs itself under callgrind, which counts inside of them only.

use super::figure::{Figure, STEPS, rates};
use super::unit::{Fleet, Unit};
use std::ffi::CString;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

/// The first argument of a run that is counted.
const COUNTED: &str = "--counted";

/// Impacts in a run.
const IMPACTS: u64 = 10;

/// Whether this process is one to be counted; if so the work is done already.
pub fn was_counted() -> bool {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [first, library, guid, figure] = arguments.as_slice() else { return false };
    if first != COUNTED {
        return false;
    }
    let figure = Figure::ALL.into_iter().find(|candidate| candidate.name() == figure).expect("a figure by its name");
    let guid = CString::new(guid.as_str()).expect("a GUID is plain text");
    let unit = Unit::open(Path::new(library), &guid);
    let fleet = Fleet::of(&unit, 1);
    figure.measure(&fleet, &rates(), IMPACTS);
    true
}

/// Whether there is a valgrind.
pub fn can_be_counted() -> bool {
    Command::new("valgrind").arg("--version").stdout(Stdio::null()).status().is_ok_and(|status| status.success())
}

/// Instructions of `functions` for each step of `figure`, on average over whole impacts.
pub fn count(figure: Figure, functions: &[&str], library: &Path, guid: &str, folder: &Path) -> f64 {
    let counts = folder.join("callgrind.out");
    let mut valgrind = Command::new("valgrind");
    valgrind.arg("--tool=callgrind").arg(format!("--callgrind-out-file={}", counts.display()));
    valgrind.args(functions.iter().map(|function| format!("--toggle-collect={function}")));
    valgrind.arg(std::env::current_exe().expect("this program has a path"));
    valgrind.arg(COUNTED).arg(library).args([guid, figure.name()]);
    let output = valgrind.output().expect("valgrind was found");
    assert!(output.status.success(), "{valgrind:?}:\n{}", String::from_utf8_lossy(&output.stderr));
    let text = fs::read_to_string(&counts).expect("callgrind has written its counts");
    let total = text.lines().find_map(|line| line.strip_prefix("totals: ")).expect("callgrind writes a total");
    total.trim().parse::<f64>().expect("a number") / (IMPACTS * STEPS as u64) as f64
}
