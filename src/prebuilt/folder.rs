//! The location of the prebuilt FMU libraries.

use brinell_exporter::platform::{Platform, Target};
use brinell_exporter::prebuilt::archive::LIST;
use std::path::{Path, PathBuf};
use std::{env, fs};

/// Environment variable that overrides the installed folder.
const VARIABLE: &str = "BRINELL_PREBUILT";

/// Path relative to the installation folder of the program.
const INSTALLED: &str = "share/brinell/prebuilt";

/// Number of folders above the program that are searched. A wheel puts programs into `bin` or `Scripts`; on Windows, the
/// programs of a single user are in `Python311\Scripts`. `share` is beside `bin`, `Scripts` or `Python311`.
const LEVELS: usize = 3;

/// A folder with prebuilt libraries.
#[derive(Debug, PartialEq)]
pub struct PrebuiltFolder {
    pub path: PathBuf,
}

/// The folder named by `BRINELL_PREBUILT`, otherwise the one that was installed with the program; `None` if there is no such
/// folder.
pub fn find() -> Option<PrebuiltFolder> {
    if let Some(named) = env::var_os(VARIABLE).filter(|named| !named.is_empty()) {
        let path = PathBuf::from(named);
        return path.is_dir().then_some(PrebuiltFolder { path });
    }
    // a symbolic link to the program, such as that of pipx, has no `share` beside it
    installed(&env::current_exe().and_then(fs::canonicalize).ok()?)
}

/// The folder that was installed with the program at `program`.
fn installed(program: &Path) -> Option<PrebuiltFolder> {
    let above = program.ancestors().skip(1).take(LEVELS);
    above.map(|folder| folder.join(INSTALLED)).find(|path| path.is_dir()).map(|path| PrebuiltFolder { path })
}

impl PrebuiltFolder {
    /// The file with this `ending` for `target`.
    pub fn file(&self, target: &Target, ending: &str) -> PathBuf {
        self.path.join(target.triple).with_extension(ending)
    }

    /// The platforms with libraries.
    pub fn platforms(&self) -> Vec<Platform> {
        let is_there = |target: &Target| self.file(target, LIST).is_file();
        let all = Platform::ALL.into_iter().chain([Platform::C_CODE]);
        all.filter(|platform| platform.targets.iter().all(is_there)).collect()
    }
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
    fn a_platform_takes_a_list_for_each_of_its_targets() {
        let root = tempfile::tempdir().unwrap();
        let found = |target: &str| {
            fs::write(root.path().join(target).with_extension("json"), "").unwrap();
            let folder = PrebuiltFolder { path: root.path().into() };
            folder.platforms().iter().map(|platform| platform.folder).collect::<Vec<_>>()
        };
        assert_eq!(found("x86_64-unknown-linux-gnu"), ["linux64"]);
        assert_eq!(found("x86_64-apple-darwin"), ["linux64"], "the library for macOS is universal");
        assert_eq!(found("aarch64-apple-darwin"), ["linux64", "darwin64", "aarch64-darwin"]);
    }
}
