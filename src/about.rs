//! Information about the program itself: versions, shell completions, manual pages.

use crate::arguments::Arguments;
use crate::files::FileError;
use crate::prebuilt::{self, PrebuiltFolder};
use crate::sources;
use brinell_exporter::layout::{json_line, shown};
use brinell_exporter::platform;
use clap::CommandFactory;
use clap_complete::Shell;
use serde_json::json;
use std::fs;
use std::path::Path;

/// Version of the program, which is that of the package.
const VERSION: &str = env!("CARGO_PKG_VERSION");

/// `brinell --version`: program, library, platform, and the prebuilt libraries that an export would use.
pub fn version(as_json: bool) {
    let library = sources::library_identity();
    let platform = platform::here().ok().map(|platform| (platform.folder, platform.targets[0].triple));
    let prebuilt = prebuilt::find();
    if as_json {
        let platform = platform.map(|(folder, target)| json!({ "folder": folder, "target": target }));
        let prebuilt = prebuilt.map(|it| json!({ "platforms": folders(&it), "folder": it.path.to_string_lossy() }));
        let all = json!({ "version": VERSION, "library": library, "platform": platform, "prebuilt": prebuilt });
        print!("{}", json_line(&all));
        return;
    }
    println!("brinell {VERSION}");
    println!("FMU library: sources {library}");
    match platform {
        Some((folder, target)) => println!("platform: {folder} ({target})"),
        None => println!("platform: {} {}, without FMUs", std::env::consts::OS, std::env::consts::ARCH),
    }
    match prebuilt {
        Some(folder) => {
            println!("prebuilt libraries: {} in {}", folders(&folder).join(", "), shown(&folder.path));
        }
        None => println!("prebuilt libraries: none"),
    }
}

/// The platforms that there are prebuilt libraries for, as FMI calls them.
fn folders(prebuilt: &PrebuiltFolder) -> Vec<&'static str> {
    prebuilt.platforms().iter().map(|platform| platform.folder).collect()
}

/// `brinell completions`: the script that completes the program's arguments in `shell`, on standard output.
pub fn completions(shell: Shell) {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), "brinell", &mut script);
    print!("{}", String::from_utf8_lossy(&script));
}

/// `brinell man`: writes the manual pages of the program and of each command to `folder`: `brinell.1`, `brinell-export.1` and
/// so on.
///
/// # Errors
/// [`FileError`]
pub fn manual(folder: &Path) -> Result<(), FileError> {
    let error = FileError::at(folder);
    fs::create_dir_all(folder).map_err(&error)?;
    clap_mangen::generate_to(Arguments::command(), folder).map_err(&error)
}
