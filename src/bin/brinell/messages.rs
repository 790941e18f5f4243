//! Messages for the user on standard error.

use std::fmt::Arguments;
use std::io::{self, Write};

/// Writes a line. A reader that has gone is no reason to stop the work.
pub fn say(line: Arguments<'_>) {
    let _ = writeln!(io::stderr(), "{line}");
}
