//! The FMUs to compare: exported by the program, and compiled from C.

use std::ffi::CString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// An FMU exported by the program.
pub struct Exported {
    pub library: PathBuf,
    pub guid: CString,
    /// Names of the variables, in the order of their references.
    variables: Vec<String>,
    /// Size of the archive [bytes].
    pub archive: u64,
    /// Size of the model description [bytes].
    pub xml: u64,
    /// Duration of the program, including compilation.
    pub time: Duration,
}

impl Exported {
    /// The reference of a variable.
    pub fn reference(&self, name: &str) -> u32 {
        let place = self.variables.iter().position(|variable| variable == name);
        u32::try_from(place.unwrap_or_else(|| panic!("the unit has no {name}"))).expect("a number of variables")
    }
}

/// Exports `scene` and unpacks it.
pub fn export(scene: &Path, folder: &Path) -> Exported {
    let name = scene.file_stem().expect("a scene has a name");
    let folder = folder.join(name);
    fs::create_dir_all(&folder).expect("the folder can be written to");
    let unit = folder.join(name).with_extension("fmu");
    let mut brinell = Command::new(env!("CARGO_BIN_EXE_brinell"));
    brinell.arg("export").arg(scene).arg("-o").arg(&unit).arg("--json");
    brinell.env("BRINELL_CACHE", Path::new(env!("CARGO_TARGET_TMPDIR")).join("cache"));
    let start = Instant::now();
    let output = brinell.output().unwrap_or_else(|error| panic!("{brinell:?}: {error}"));
    let time = start.elapsed();
    assert!(output.status.success(), "{brinell:?}: {}", String::from_utf8_lossy(&output.stderr));
    let exported: serde_json::Value = serde_json::from_slice(&output.stdout).expect("the program prints JSON");
    let guid = CString::new(exported["guid"].as_str().expect("a unit has a GUID")).expect("a GUID is plain text");
    let archive = fs::File::open(&unit).expect("the unit was written");
    zip::ZipArchive::new(archive).expect("it is a zip").extract(&folder).expect("it can be unpacked");
    let platform = only_one_in(&folder.join("binaries"));
    Exported {
        library: only_one_in(&platform),
        guid,
        variables: serde_json::from_value(exported["variables"].clone()).expect("a list of names"),
        archive: size(&unit),
        xml: size(&folder.join("modelDescription.xml")),
        time,
    }
}

fn only_one_in(folder: &Path) -> PathBuf {
    fs::read_dir(folder).expect("a unit has a binary").next().expect("of one platform").expect("to be read").path()
}

/// Exports the scene `text`, in a file of this `name`.
pub fn export_text(name: &str, text: &str, folder: &Path) -> Exported {
    export(&write_text(name, text, folder), folder)
}

/// Writes the scene `text` to a file of this `name`, and returns its path.
pub fn write_text(name: &str, text: &str, folder: &Path) -> PathBuf {
    let path = folder.join(name).with_extension("toml");
    fs::write(&path, text).expect("the folder can be written to");
    path
}

/// Compiles `units/<name>.c` for this number of contacts with the GUID of `exported`; returns the path of the library.
pub fn compile(name: &str, contacts: usize, exported: &Exported, folder: &Path) -> PathBuf {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/units").join(name).with_extension("c");
    let library = folder.join(format!("{name}_{contacts}.so"));
    let mut cc = Command::new("cc");
    // square roots need no errno: without this option each has a branch to the library function
    cc.arg(format!("-DUNIT_GUID=\"{}\"", exported.guid.to_str().expect("a GUID is plain text")));
    cc.arg(format!("-DCONTACTS={contacts}"));
    cc.args(["-O3", "-shared", "-fPIC", "-fno-math-errno", "-o"]).arg(&library).arg(source).arg("-lm");
    let output = cc.stderr(Stdio::inherit()).output().unwrap_or_else(|error| panic!("{cc:?}: {error}"));
    assert!(output.status.success(), "{cc:?} failed");
    library
}

/// Size of a file [bytes].
pub fn size(file: &Path) -> u64 {
    fs::metadata(file).expect("the file was written").len()
}

/// Size of a library without its symbol table [bytes]; `None` where there is no `strip`.
pub fn stripped_size(library: &Path, folder: &Path) -> Option<u64> {
    let stripped = folder.join("stripped");
    let mut strip = Command::new("strip");
    let done = strip.arg("-o").arg(&stripped).arg(library).status().is_ok_and(|status| status.success());
    done.then(|| size(&stripped))
}
