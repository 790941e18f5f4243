//! C source as one more prebuilt library, for every processor that has a C compiler.
//!
//! A release compiles each kind of library for WebAssembly, and `wasm2c` makes C of the module ([`c_text`]). An export adds the scene
//! ([`with_scene`]), and what is the same in all units: the functions of FMI (`fmi2.c`), and what WebAssembly's instructions are in C
//! (`brinell_runtime.h`). Nothing of the physics is written twice.

pub mod module;

pub use module::{FORMAT, FUNCTIONS, ModuleError, WASM2C, c_text};

use brinell_fmu::scene::library::block::Block;
use std::fmt::Write;

/// What the instructions of WebAssembly are in C.
pub const RUNTIME: (&str, &str) = ("brinell_runtime.h", include_str!("brinell_runtime.h"));

/// The name of the file of the library and its scene.
const UNIT: &str = "brinell_unit.h";

/// The file that the model description lists: it includes the others.
pub const LISTED: &str = FUNCTIONS.0;

/// What the source needs from the C library.
pub const NEEDED: [&str; 7] = ["calloc", "free", "memcpy", "memmove", "memset", "realloc", "strlen"];

/// The names and contents of the files in the folder `sources`, for a library with its scene.
pub fn files(library: &[u8]) -> [(&'static str, &[u8]); 3] {
    [(FUNCTIONS.0, FUNCTIONS.1.as_bytes()), (RUNTIME.0, RUNTIME.1.as_bytes()), (UNIT, library)]
}

/// The text of a `library` with the scene in `block`, for an FMU with this `name` and number of variables. `None` for a text that was
/// made by another version.
pub fn with_scene(library: &[u8], block: &Block, name: &str, variables: usize) -> Option<Vec<u8>> {
    if !library.starts_with(FORMAT.as_bytes()) {
        return None;
    }
    let words: Vec<_> = block.used_words().flat_map(|word| [word as u32, (word >> 32) as u32]).collect();
    let mut text = format!(
        "/* The scene of `{name}`, and the library that it is for. */\n\
         #ifndef FMI2_FUNCTION_PREFIX\n#define FMI2_FUNCTION_PREFIX {name}_\n#endif\n#ifndef SCENE_SIZE\n#include <stdint.h>\n\
         #define SCENE_SIZE {}u\n#define VARIABLES {variables}u\nstatic const uint32_t brinell_scene[{}] = {{\n",
        4 * words.len(),
        words.len()
    );
    for row in words.chunks(10) {
        row.iter().for_each(|word| write!(text, "0x{word:x}u,").expect("a String takes everything"));
        text.push('\n');
    }
    text.push_str("};\n#endif\n");
    Some([text.as_bytes(), library].concat())
}
