//! What a usual run leaves out, and a long one has: `BRINELL_LONG=1 cargo test --release`.

use crate::skips::skipped;

/// Whether a long run is asked for.
pub fn is_asked() -> bool {
    std::env::var("BRINELL_LONG").is_ok_and(|value| value == "1")
}

/// Whether a usual run leaves `what` out, which says little beyond quicker tests; the end of the run tells it.
pub fn leaves_out(what: &str) -> bool {
    if !is_asked() {
        skipped(what, "a usual run leaves it out; BRINELL_LONG=1 adds it");
    }
    !is_asked()
}

/// The number of random cases: in a long run all of them, in a usual one a quarter.
pub fn cases(all: u64) -> u64 {
    if is_asked() { all } else { all / 4 }
}

/// In a long run all of them; in a usual one each `every`-th, so that the first is there.
pub fn some<T>(all: impl IntoIterator<Item = T>, every: usize) -> impl Iterator<Item = T> {
    all.into_iter().step_by(if is_asked() { 1 } else { every })
}
