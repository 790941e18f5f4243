//! Tells the program where the sources of this crate are: it carries them, since FMUs are compiled from them.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::metadata=sources={}/src", std::env::var("CARGO_MANIFEST_DIR").expect("cargo sets it"));
}
