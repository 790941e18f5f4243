//! The last test program, because cargo runs them in alphabetical order: prints what the run has skipped, and why.

use brinell_testing::skips;
use std::io::{Write as _, stderr};

#[test]
fn what_was_skipped_is_said_at_the_end() {
    let lines = skips::all();
    let said = if lines.is_empty() { String::from("nothing was skipped") } else { lines.join("\n") };
    let minutes =
        skips::elapsed().map(|time| format!("; {:.0} minutes since the first test", time.as_secs_f64() / 60.0));
    let said = said + &minutes.unwrap_or_default();
    // past the harness, which hides the output of a test that passes
    let _ = stderr().write_all(format!("\n{said}\n").as_bytes());
}
