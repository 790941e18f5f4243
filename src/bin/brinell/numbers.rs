//! Numbers for people.

/// Six significant digits at most.
pub fn digits(value: f64) -> String {
    significant(value, 6)
}

/// So many significant digits at most.
pub fn significant(value: f64, count: usize) -> String {
    let rounded: f64 = format!("{value:.*e}", count - 1).parse().expect("a number");
    if rounded == 0.0 || (1e-3..1e6).contains(&rounded.abs()) { format!("{rounded}") } else { format!("{rounded:e}") }
}
