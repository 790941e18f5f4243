//! What a usual run leaves out, and a long one has: `BRINELL_LONG=1 cargo test --release`.

/// Whether a long run is asked for.
pub fn is_asked() -> bool {
    std::env::var("BRINELL_LONG").is_ok_and(|value| value == "1")
}

/// In a long run all of them; in a usual one each `every`-th, so that the first is there.
pub fn some<T>(all: impl IntoIterator<Item = T>, every: usize) -> impl Iterator<Item = T> {
    all.into_iter().step_by(if is_asked() { 1 } else { every })
}
