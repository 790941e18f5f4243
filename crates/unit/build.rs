//! Tells the program where the sources of this crate are: it carries them, since FMUs are compiled from them.

fn main() {
    let folder = std::env::var("CARGO_MANIFEST_DIR").expect("cargo sets it");
    // by its whole path: after a folder was moved with what is built in it, the place is told anew
    println!("cargo::rerun-if-changed={folder}/build.rs");
    println!("cargo::metadata=sources={folder}/src");
}
