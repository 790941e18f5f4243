//! The cost of a step through the C interface: for Brinell's library, for the same contact written by hand in C, and for an FMU
//! without physics, which is the lower limit of FMI itself. Also the cost of all other calls of an importer.
//!
//! All libraries are loaded like in an importer. Samples are taken in turn, so that other load on the machine affects all
//! alike. The tables contain medians, in Markdown. `cargo bench --bench c_interface -- NAME...` prints only these [`PARTS`].

mod build;
mod changes;
mod corners;
mod crowds;
mod cycles;
mod derivatives;
mod exchange;
mod fleet;
mod heap;
mod instructions;
mod life;
mod many;
mod mass;
mod paths;
mod phases;
mod sampling;
mod states;
mod table;
mod trio;
mod unit;

use table::Row;
use trio::Trio;

/// A kind of figure.
struct Part {
    name: &'static str,
    /// Whether it contributes rows to the common table; otherwise it has tables of its own.
    is_rows: bool,
    print: fn(&Trio),
}

/// All parts, in the order of the output.
const PARTS: [Part; 11] = [
    Part { name: "cycles", is_rows: false, print: cycles::print },
    Part { name: "impact", is_rows: true, print: crowds::print },
    Part { name: "instructions", is_rows: true, print: crowds::print_instructions },
    Part { name: "branch", is_rows: true, print: changes::print },
    Part { name: "derivatives", is_rows: true, print: derivatives::print },
    Part { name: "mass", is_rows: true, print: mass::print },
    Part { name: "phases", is_rows: true, print: phases::print },
    Part { name: "states", is_rows: true, print: states::print },
    Part { name: "life", is_rows: true, print: life::print },
    Part { name: "contacts", is_rows: true, print: many::print },
    Part { name: "growth", is_rows: false, print: many::print_growth },
];

/// The requested parts.
///
/// # Errors
/// A name that no part has.
fn wanted(names: &[String]) -> Result<Vec<&'static Part>, String> {
    if let Some(unknown) = names.iter().find(|name| PARTS.iter().all(|part| part.name != name.as_str())) {
        return Err(format!("there is no {unknown}, but {}", PARTS.map(|part| part.name).join(", ")));
    }
    Ok(PARTS.iter().filter(|part| names.is_empty() || names.iter().any(|name| name == part.name)).collect())
}

fn main() {
    if instructions::was_counted() {
        return;
    }
    let (options, names): (Vec<String>, Vec<String>) = std::env::args().skip(1).partition(|word| word.starts_with('-'));
    let parts = wanted(&names).unwrap_or_else(|unknown| panic!("{unknown}"));
    let folder = tempfile::tempdir().expect("there is room for temporary files");
    let trio = Trio::build(folder.path());
    trio.check();
    many::check(&trio);
    // `cargo test` runs this program without the option, to check that it works
    if !options.iter().any(|option| option == "--bench") {
        return;
    }
    let mut is_in_rows = false;
    for part in parts {
        if part.is_rows && !is_in_rows {
            Row::head();
        }
        is_in_rows = part.is_rows;
        (part.print)(&trio);
    }
}
