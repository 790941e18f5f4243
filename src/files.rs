//! Reading and writing of files for the user.

pub use crate::temporary::FileError;
use crate::temporary::draft_in;
use brinell_exporter::layout::shown;
use brinell_exporter::nearest::nearest;
use std::ffi::OsString;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// Writes a temporary file and renames it. The target is never incomplete. A symbolic link is kept, and the file it points to is
/// written. A device or a pipe is written to, not replaced. A new file gets the permissions of the umask.
///
/// # Errors
/// [`FileError`]; the target is then unchanged.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    let file_error = FileError::at(path);
    let goal = goal_of(path).map_err(&file_error)?;
    match &goal {
        Goal::Stream => fs::OpenOptions::new().write(true).open(path).and_then(|mut stream| stream.write_all(bytes)),
        Goal::File(file) => check_writable(file)
            .and_then(|()| draft_in(folder_of(file)))
            .and_then(|draft| fill_and_rename(draft, file, bytes)),
    }
    .map_err(&file_error)
}

fn fill_and_rename(mut draft: NamedTempFile, goal: &Path, bytes: &[u8]) -> io::Result<()> {
    draft.write_all(bytes)?;
    // a replaced file keeps its permissions
    if let Ok(before) = fs::metadata(goal) {
        fs::set_permissions(draft.path(), before.permissions())?;
    }
    draft.persist(goal)?;
    Ok(())
}

/// The largest number of symbolic links in a chain, as on Linux.
const LINKS: u32 = 40;

/// The target of a write.
enum Goal {
    /// A device, a pipe or a socket.
    Stream,
    /// An existing file or a new one, without symbolic links.
    File(PathBuf),
}

/// The target of a write to `path`.
fn goal_of(path: &Path) -> io::Result<Goal> {
    if fs::metadata(path).is_ok_and(|there| !there.is_file() && !there.is_dir()) {
        return Ok(Goal::Stream);
    }
    let mut goal = path.to_path_buf();
    for _ in 0..LINKS {
        let Ok(target) = fs::read_link(&goal) else { return Ok(Goal::File(goal)) };
        goal = folder_of(&goal).join(target);
    }
    Err(io::Error::other("too many symbolic links lead from here"))
}

/// Whether `path` is a device or a pipe, which is written to and not replaced.
pub fn is_stream(path: &Path) -> bool {
    matches!(goal_of(path), Ok(Goal::Stream))
}

/// Rejects a file that its owner has protected. Renaming would replace it all the same, but not on Windows.
fn check_writable(file: &Path) -> io::Result<()> {
    if fs::metadata(file).is_ok_and(|there| there.permissions().readonly()) {
        return Err(io::Error::new(io::ErrorKind::PermissionDenied, "this file is read-only, and isn't replaced"));
    }
    Ok(())
}

/// Rejects a name that no file can have, such as one that is too long.
fn check_name(path: &Path) -> io::Result<()> {
    match fs::symlink_metadata(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// Rejects the device that is always full. Any other one would have to be written to.
fn check_stream(path: &Path) -> io::Result<()> {
    #[cfg(target_os = "linux")]
    {
        /// Its number, 1:7 (Linux, Documentation/admin-guide/devices.txt).
        const FULL: u64 = 0x107;
        if fs::metadata(path).is_ok_and(|there| std::os::unix::fs::MetadataExt::rdev(&there) == FULL) {
            return Err(io::Error::new(io::ErrorKind::StorageFull, "there is no space left on this device"));
        }
    }
    #[cfg(not(target_os = "linux"))]
    let _ = path;
    Ok(())
}

/// Rejects a target that cannot be written, before any work is done: a folder, or a file in a folder that does not exist or
/// cannot be written to.
///
/// # Errors
/// [`FileError`]
pub fn check_goal(path: &Path) -> Result<(), FileError> {
    if path.is_dir() {
        let error = io::Error::new(io::ErrorKind::IsADirectory, "this is a folder; a file is written here");
        return Err(FileError::at(path)(error));
    }
    let Goal::File(file) = goal_of(path).map_err(FileError::at(path))? else {
        return check_stream(path).map_err(FileError::at(path));
    };
    check_writable(&file).map_err(FileError::at(path))?;
    let folder = folder_of(&file);
    if !folder.is_dir() {
        let error = io::Error::new(io::ErrorKind::NotFound, format!("there is no folder {}", shown(folder)));
        return Err(FileError::at(path)(error));
    }
    check_name(&file).map_err(FileError::at(path))?;
    // only creating a file shows whether it is possible; the file is deleted immediately
    draft_in(folder).map(drop).map_err(FileError::at(path))
}

/// What a command reads, by the ending of its files.
pub struct Kind {
    ending: &'static str,
    name: &'static str,
    /// How one is made.
    made: &'static str,
}

pub const SCENE: Kind = Kind { ending: "toml", name: "scene", made: "`brinell new NAME` writes one" };
pub const FMU: Kind = Kind { ending: "fmu", name: "FMU", made: "`brinell export` makes the FMU of a scene" };

/// Files that end like scenes and are none.
const NO_SCENES: [&str; 3] = ["materials.toml", "Cargo.toml", "pyproject.toml"];

/// Rejects a folder, with the files of the `kind` that are in it, and a missing file, with one beside it that has a similar name.
///
/// # Errors
/// [`io::Error`]
pub fn check_readable(path: &Path, kind: &Kind) -> io::Result<()> {
    let names = |folder: &Path| {
        let entries = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
        let is_it = |path: &PathBuf| path.extension().is_some_and(|ending| ending == kind.ending) && path.is_file();
        let files = entries.filter(is_it).filter_map(|path| Some(path.file_name()?.to_str()?.to_string()));
        let mut names: Vec<_> = files.filter(|name| !NO_SCENES.contains(&name.as_str())).collect();
        names.sort();
        names
    };
    match fs::metadata(path) {
        Ok(there) if there.is_dir() => {
            let in_it = |name: &String| shown(&path.join(name));
            let found = names(path);
            let Kind { ending, name, made } = kind;
            let said = match found.as_slice() {
                [] => format!("this is a folder, and no {name} (.{ending}) is in it; {made}"),
                [only] => format!("this is a folder; the {name} in it is {}", in_it(only)),
                all => {
                    const NAMED: usize = 5;
                    let more =
                        if all.len() > NAMED { format!(" and {} more", all.len() - NAMED) } else { String::new() };
                    let named = all.iter().take(NAMED).map(in_it).collect::<Vec<_>>().join(", ");
                    format!("this is a folder; name one of the files (.{ending}) in it: {named}{more}")
                }
            };
            Err(io::Error::new(io::ErrorKind::IsADirectory, said))
        }
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            let (folder, names) = (folder_of(path), names(folder_of(path)));
            let asked = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
            let Some(near) = nearest(&asked, names.iter().map(String::as_str)) else { return Err(error) };
            let near = if folder == Path::new(".") { shown(Path::new(near)) } else { shown(&folder.join(near)) };
            Err(io::Error::new(error.kind(), format!("{error}; did you mean {near}?")))
        }
        other => other.map(drop),
    }
}

/// Rejects a target that is the file `input` of the command: the user's scene would be lost.
///
/// # Errors
/// [`FileError`]
pub fn check_kept(path: &Path, input: &Path) -> Result<(), FileError> {
    let real = |path: &Path| fs::canonicalize(path).ok().filter(|path| path.is_file());
    if real(path).is_some_and(|path| Some(path) == real(input)) {
        let error = io::Error::new(io::ErrorKind::AlreadyExists, "this is the scene itself, which isn't overwritten");
        return Err(FileError::at(path)(error));
    }
    Ok(())
}

/// Rejects a folder that cannot be written to or created.
///
/// # Errors
/// [`FileError`]
pub fn check_folder(path: &Path) -> Result<(), FileError> {
    if path.exists() && !path.is_dir() {
        let error = io::Error::new(io::ErrorKind::NotADirectory, "this is a file; a folder is written here");
        return Err(FileError::at(path)(error));
    }
    check_name(path).map_err(FileError::at(path))?;
    // a missing folder is created in its nearest existing ancestor
    let there = path.ancestors().find(|folder| folder.is_dir()).unwrap_or(Path::new("."));
    draft_in(there).map(drop).map_err(FileError::at(path))
}

/// A kind of folder of the user's: the variable that has it on Windows; its place below `HOME` on macOS; the variable that has it on
/// other systems, and without it the place below `HOME`.
pub struct UserFolder {
    windows: &'static str,
    macos: &'static str,
    variable: &'static str,
    home: &'static str,
}

pub const CACHE: UserFolder =
    UserFolder { windows: "LOCALAPPDATA", macos: "Library/Caches", variable: "XDG_CACHE_HOME", home: ".cache" };
pub const CONFIGURATION: UserFolder = UserFolder {
    windows: "APPDATA",
    macos: "Library/Application Support",
    variable: "XDG_CONFIG_HOME",
    home: ".config",
};

/// The folder `brinell` in a folder of the user's on the operating system `os`; `variable` gives the environment.
///
/// # Errors
/// The name of the variable that it needs.
pub fn user_folder(
    variable: impl Fn(&str) -> Option<OsString>,
    os: &str,
    kind: &UserFolder,
) -> Result<PathBuf, &'static str> {
    // the XDG Base Directory Specification ignores relative paths
    let absolute = |name: &str| variable(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let base = match os {
        "windows" => absolute(kind.windows).ok_or(kind.windows)?,
        _ => {
            let below = if os == "macos" { kind.macos } else { kind.home };
            let home = || absolute("HOME").map(|home| home.join(below));
            absolute(kind.variable).or_else(home).ok_or("HOME")?
        }
    };
    Ok(base.join("brinell"))
}

/// Path of what is installed with the program, relative to its installation folder.
const INSTALLED: [&str; 2] = ["share", "brinell"];

/// Number of folders above the program that are searched. A wheel puts programs into `bin` or `Scripts`; on Windows, the
/// programs of a single user are in `Python311\Scripts`. `share` is beside `bin`, `Scripts` or `Python311`.
const LEVELS: usize = 3;

/// The file or folder `name` that was installed with this program; `None` if there is none.
pub fn installed(name: &str) -> Option<PathBuf> {
    let program = std::env::current_exe().ok()?;
    // a symbolic link to the program, such as that of pipx, has no `share` beside it; on Windows pipx copies the program, and a
    // canonical path begins with `\\?\`
    let program = if cfg!(windows) { program } else { fs::canonicalize(program).ok()? };
    installed_with(&program, name)
}

/// The same for the program at `program`.
pub fn installed_with(program: &Path, name: &str) -> Option<PathBuf> {
    let above = program.ancestors().skip(1).take(LEVELS);
    let below: PathBuf = INSTALLED.into_iter().chain([name]).collect();
    above.map(|folder| folder.join(&below)).find(|path| path.exists())
}

/// The folder that contains `path`.
pub fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
}

/// A path in JSON, which has no others than those in Unicode: a replacement character stands for what isn't.
///
/// # Errors
/// Those of the serializer.
pub fn path_in_json<S: serde::Serializer>(path: &Path, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(&path.display())
}

/// Prints `text`, or writes it to the user's file.
///
/// # Errors
/// [`FileError`]
pub fn deliver(text: &str, output: Option<&Path>) -> Result<(), FileError> {
    match output {
        None => {
            print!("{text}");
            Ok(())
        }
        Some(path) => write_whole(path, text.as_bytes()),
    }
}

/// The extension of the file `output`, which must be one of `allowed`; without a file, the first of them.
///
/// # Errors
/// A sentence with the allowed extensions.
pub fn ending(output: Option<&Path>, allowed: &[&'static str]) -> Result<&'static str, String> {
    let Some(path) = output else { return Ok(allowed[0]) };
    let given = path.extension().and_then(|extension| extension.to_str());
    allowed.iter().copied().find(|&ending| given == Some(ending)).ok_or_else(|| {
        let (last, others) = allowed.split_last().expect("something is allowed");
        let others = others.iter().map(|ending| format!(".{ending}")).collect::<Vec<_>>().join(", ");
        let or = if others.is_empty() { "" } else { " or " };
        format!("{}: the name must end in {others}{or}.{last}", shown(path))
    })
}
