//! Where the prebuilt FMU libraries are.

use std::path::{Path, PathBuf};
use std::{env, fs};

/// Names the folder instead of the installed one.
const VARIABLE: &str = "BRINELL_PREBUILT";

/// Below the folder that the program was installed to.
const INSTALLED: &str = "share/brinell/prebuilt";

/// How many folders above the program are searched. A wheel puts programs into `bin` or `Scripts`, and on Windows the
/// programs of one user into `Python311\Scripts`; `share` is beside `bin`, `Scripts` or `Python311`.
const LEVELS: usize = 3;

/// The endings of libraries.
const ENDINGS: [&str; 3] = ["so", "dll", "dylib"];

/// A folder with prebuilt libraries.
#[derive(Debug, PartialEq)]
pub struct PrebuiltFolder {
    pub path: PathBuf,
}

/// The folder that the variable `BRINELL_PREBUILT` names, or else the one that was installed with the program; none if there is
/// no such folder.
pub fn find() -> Option<PrebuiltFolder> {
    if let Some(named) = env::var_os(VARIABLE) {
        let path = PathBuf::from(named);
        return path.is_dir().then_some(PrebuiltFolder { path });
    }
    // a link to the program, as pipx makes one, has nothing beside it
    installed(&env::current_exe().and_then(fs::canonicalize).ok()?)
}

/// The folder that was installed with the program at `program`.
fn installed(program: &Path) -> Option<PrebuiltFolder> {
    let above = program.ancestors().skip(1).take(LEVELS);
    above.map(|folder| folder.join(INSTALLED)).find(|path| path.is_dir()).map(|path| PrebuiltFolder { path })
}

impl PrebuiltFolder {
    /// How many libraries there are, for all platforms together.
    pub fn library_count(&self) -> usize {
        count(&self.path)
    }
}

/// The libraries in `folder` and below.
fn count(folder: &Path) -> usize {
    let Ok(entries) = fs::read_dir(folder) else { return 0 };
    let paths = entries.flatten().map(|entry| entry.path());
    let is_library = |path: &Path| path.extension().is_some_and(|ending| ENDINGS.iter().any(|known| ending == *known));
    paths.map(|path| if path.is_dir() { count(&path) } else { usize::from(is_library(&path)) }).sum()
}

#[cfg(test)]
mod tests {
    use super::{INSTALLED, PrebuiltFolder, installed};
    use std::fs;

    #[test]
    fn the_folder_is_beside_the_program_or_beside_one_of_two_folders_above() {
        let root = tempfile::tempdir().unwrap();
        let there = root.path().join(INSTALLED);
        fs::create_dir_all(there.join("linux64")).unwrap();
        for program in ["brinell", "bin/brinell", "Python311/Scripts/brinell.exe"] {
            let found = installed(&root.path().join(program)).unwrap_or_else(|| panic!("nothing for {program}"));
            assert_eq!(found, PrebuiltFolder { path: there.clone() });
        }
        assert_eq!(installed(&root.path().join("usr/lib/other/brinell")), None, "nothing of another installation");
    }

    #[test]
    fn the_libraries_of_all_platforms_are_counted_and_nothing_else() {
        let root = tempfile::tempdir().unwrap();
        for file in ["list.json", "linux64/hertz.so", "win64/hertz.dll", "win64/brinell.dll", "darwin64/a.dylib"] {
            let path = root.path().join(file);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, "").unwrap();
        }
        assert_eq!(PrebuiltFolder { path: root.path().into() }.library_count(), 4);
    }
}
