//! The sources of the crates that FMUs are compiled from: `contact`, `fmu`, `unit`, and `libm`.

use brinell_exporter::package::Hash;
use std::sync::LazyLock;

include!(concat!(env!("OUT_DIR"), "/sources.rs"));

/// The hash of the common input of all libraries: names and texts of the files.
pub fn hash() -> &'static str {
    static HASH: LazyLock<String> = LazyLock::new(|| {
        let all = [CONTACT_SOURCE, FMU_SOURCE, UNIT_SOURCE, LIBM_SOURCE].into_iter().flatten();
        Hash::default().with_all(all.flat_map(|&(name, text)| [name, text])).digits()
    });
    &HASH
}

/// Identifier of the library: 16 digits of the hash of its sources and those of `libm`.
pub fn library_identity() -> &'static str {
    &hash()[..16]
}
