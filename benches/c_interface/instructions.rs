//! Number of instructions of the calls. This program runs itself under callgrind, which counts only inside the calls.

use super::exchange::exchange;
use super::unit::{Unit, ok};
use serde_json::{Value, json};
use std::ffi::CString;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::ptr::null_mut;

/// The first argument of a counted run.
const COUNTED: &str = "--counted";

/// The calls of an exchange.
pub const EXCHANGE: &[&str] = &["fmi2SetReal", "fmi2DoStep", "fmi2GetReal"];

/// The step alone.
pub const STEP: &[&str] = &["fmi2DoStep"];

/// The work of an instance in a counted run.
pub struct Work {
    /// Rates that lead to a position [m/s]. They are also counted.
    pub before: Vec<f64>,
    /// Rates from that position [m/s].
    pub rates: Vec<f64>,
    /// Length of each step [s].
    pub step: f64,
    /// Number of starts from that position.
    pub times: usize,
}

impl Work {
    /// `rates` [m/s] in steps of `step` [s], once.
    pub fn along(rates: &[f64], step: f64) -> Work {
        Work { before: Vec::new(), rates: rates.to_vec(), step, times: 1 }
    }

    fn to_json(&self) -> Value {
        json!([self.before, self.rates, self.step, self.times])
    }

    fn from_json(value: Value) -> Work {
        let (before, rates, step, times) = serde_json::from_value(value).expect("what was written");
        Work { before, rates, step, times }
    }

    fn run(&self, unit: &Unit) {
        let instance = unit.instance();
        let mut place = null_mut();
        ok(exchange(&instance, &self.before, self.step, 0));
        ok(instance.save(&mut place));
        for _ in 0..self.times {
            ok(instance.restore(place));
            ok(exchange(&instance, &self.rates, self.step, self.before.len()));
        }
        instance.free(&mut place);
    }
}

/// Whether this process is a counted run. The work is then already done.
pub fn was_counted() -> bool {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [first, library, guid, work] = arguments.as_slice() else { return false };
    if first != COUNTED {
        return false;
    }
    let guid = CString::new(guid.as_str()).expect("a GUID is plain text");
    let work = fs::read_to_string(work).expect("the work was written down");
    Work::from_json(serde_json::from_str(&work).expect("as JSON")).run(&Unit::open(Path::new(library), &guid));
    true
}

/// Whether valgrind is installed.
pub fn can_be_counted() -> bool {
    Command::new("valgrind").arg("--version").stdout(Stdio::null()).status().is_ok_and(|status| status.success())
}

/// Number of instructions of `functions` during all of `work`.
pub fn count(work: &Work, functions: &[&str], library: &Path, guid: &str, folder: &Path) -> f64 {
    let [counts, task] = ["callgrind.out", "work.json"].map(|name| folder.join(name));
    fs::write(&task, work.to_json().to_string()).expect("the folder can be written to");
    let mut valgrind = Command::new("valgrind");
    valgrind.arg("--tool=callgrind").arg(format!("--callgrind-out-file={}", counts.display()));
    valgrind.args(functions.iter().map(|function| format!("--toggle-collect={function}")));
    valgrind.arg(std::env::current_exe().expect("this program has a path"));
    valgrind.arg(COUNTED).arg(library).arg(guid).arg(task);
    let output = valgrind.output().expect("valgrind was found");
    assert!(output.status.success(), "{valgrind:?}:\n{}", String::from_utf8_lossy(&output.stderr));
    let text = fs::read_to_string(&counts).expect("callgrind has written its counts");
    let total = text.lines().find_map(|line| line.strip_prefix("totals: ")).expect("callgrind writes a total");
    total.trim().parse().expect("a number")
}
