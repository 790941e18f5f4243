//! Hosts of several kinds for an FMU's library: tests/platforms/host.c, compiled in different ways, and its output.

use super::face::attribute;
use super::python::site_packages_file;
use crate::places::{root, temporary};
use std::fs::File;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::{fs, io};

/// The most inputs, and the most outputs, that a host takes.
const MOST: usize = 60;

/// The parts of a model description that a host needs: of an FMU with many contacts, the first of them.
#[derive(Clone, Debug)]
pub struct Interface {
    pub guid: String,
    /// The references of the rates, with commas between them.
    pub inputs: String,
    /// The references of the Real outputs.
    pub outputs: Vec<String>,
}

impl Interface {
    /// The interface of the FMU whose model description is this `text`.
    pub fn of(text: &str) -> Interface {
        let variables: Vec<_> = text.split("<ScalarVariable").skip(1).collect();
        let reference =
            |element: &&str| attribute(element, "valueReference").expect("every variable has one").to_string();
        let is = |element: &&&str, causality| attribute(element, "causality") == Some(causality);
        let is_rate = |element: &&&str| attribute(element, "name").is_some_and(|name| name.contains("_rate"));
        let rates = variables.iter().filter(|element| is(element, "input") && is_rate(element));
        let rates: Vec<_> = rates.map(reference).take(MOST).collect();
        assert!(!rates.is_empty(), "a unit has an input");
        let outputs = variables.iter().filter(|element| is(element, "output") && element.contains("<Real"));
        Interface {
            guid: attribute(text, "guid").expect("a unit has a GUID").into(),
            inputs: rates.join(","),
            outputs: outputs.map(reference).take(MOST).collect(),
        }
    }

    /// The interface of the FMU from which `library` was unpacked.
    pub fn beside(library: &Path) -> Interface {
        let root = library.ancestors().nth(3).expect("binaries/PLATFORM/LIBRARY");
        Interface::of(&fs::read_to_string(root.join("modelDescription.xml")).expect("unpacked beside the library"))
    }
}

/// The output of a host.
#[derive(Clone, Debug, PartialEq)]
pub struct Said {
    /// The bits of the outputs after each step, one line each.
    pub bits: String,
    /// The system on which it runs.
    pub host: String,
    /// How often memory of the importer was allocated and freed.
    pub memory: (u32, u32),
    /// The message of a rejected call.
    pub message: String,
}

/// A host, ready to be run.
#[derive(Clone, Debug)]
pub struct Host {
    /// The program and its first arguments.
    pub command: Vec<PathBuf>,
    /// Environment variables that it needs.
    pub variables: Vec<(&'static str, PathBuf)>,
}

impl Host {
    pub fn program(program: PathBuf) -> Host {
        Host { command: vec![program], variables: Vec::new() }
    }

    /// An ordinary program, which loads libraries through the system.
    pub fn ordinary() -> Host {
        let program = compile("ordinary", "host.c", Loading::BySystem, &cc(), &["-ldl"]);
        Host::program(program.unwrap_or_else(|why| panic!("{why}")))
    }

    /// Runs the FMU in `library` on the file `history`.
    ///
    /// # Errors
    /// Its error message.
    pub fn run(&self, library: &Path, interface: &Interface, history: &Path) -> Result<Said, String> {
        let mut command = Command::new(&self.command[0]);
        command.args(&self.command[1..]).envs(self.variables.iter().map(|(name, value)| (name, value)));
        command.arg(library).arg(&interface.guid).arg(&interface.inputs).args(&interface.outputs);
        let output = command.stdin(File::open(history).expect("a history")).output();
        let output = output.map_err(|error| format!("{command:?}: {error}"))?;
        // a Windows program has other line ends
        let out = String::from_utf8_lossy(&output.stdout).replace('\r', "");
        if !output.status.success() {
            let said = out.lines().rfind(|line| line.starts_with("FAIL")).map(String::from);
            let err = String::from_utf8_lossy(&output.stderr).into_owned();
            return Err(said.unwrap_or_else(|| format!("{}: {err}", output.status)));
        }
        let (bits, rest) = out.split_once("end\n").ok_or_else(|| format!("no end of {out}"))?;
        let [host, memory, message] = rest.lines().collect::<Vec<_>>()[..] else { return Err(rest.into()) };
        let counts = memory.strip_prefix("memory ").and_then(|counts| counts.split_once(' '));
        let (taken, given) =
            counts.and_then(|(taken, given)| Some((taken.parse().ok()?, given.parse().ok()?))).unwrap();
        Ok(Said { bits: bits.into(), host: host.into(), memory: (taken, given), message: message.into() })
    }
}

/// The way in which a host loads libraries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Loading {
    BySystem,
    /// Through the system, into a separate namespace.
    IntoNamespace,
    /// By the host itself.
    ByHand,
    /// Not at all: its C source is compiled with the host.
    Linked,
}

/// The source files of a host.
fn sources(program: &str, loading: Loading) -> [PathBuf; 2] {
    let by = match loading {
        Loading::BySystem | Loading::IntoNamespace => "load_by_system.c",
        Loading::ByHand => "load_by_hand.c",
        Loading::Linked => "load_linked.c",
    };
    [program, by].map(|name| folder().join(name))
}

/// The folder of the programs.
pub fn folder() -> PathBuf {
    root().join("tests/platforms")
}

/// The folder of compiled hosts.
pub fn folder_of_hosts() -> PathBuf {
    let place = temporary().join("hosts");
    fs::create_dir_all(&place).expect("the target folder can be written to");
    place
}

/// Compiles `program`, a file of tests/platforms, as `name`.
///
/// # Errors
/// The compiler's error message.
pub fn compile(
    name: &str,
    program: &str,
    loading: Loading,
    compiler: &[PathBuf],
    options: &[&str],
) -> Result<PathBuf, String> {
    let result = folder_of_hosts().join(name);
    // another test may be running the same program: it is replaced atomically
    let draft = result.with_extension(format!("{:?}", std::thread::current().id()));
    let mut command = Command::new(&compiler[0]);
    command.args(&compiler[1..]).args(["-std=c11", "-O1", "-Wall", "-Wextra", "-Werror"]);
    command.arg("-I").arg(site_packages_file("fmpy/c-code"));
    command.arg("-I").arg(folder().with_file_name("c")).arg("-I").arg(folder());
    if loading == Loading::IntoNamespace {
        command.arg("-DNAMESPACE");
    }
    command.args(sources(program, loading)).args(options).arg("-o").arg(&draft);
    let output = command.stdin(Stdio::null()).output().map_err(|error| format!("{command:?}: {error}"))?;
    match output.status.success() {
        true => fs::rename(&draft, &result).map(|()| result).map_err(|error| error.to_string()),
        false => Err(String::from_utf8_lossy(&output.stderr).into_owned()),
    }
}

/// The compiler of this system.
pub fn cc() -> Vec<PathBuf> {
    vec!["cc".into()]
}

/// Writes a history: the value of the input and the step \[s\], for each step.
pub fn write_history(name: &str, steps: impl Iterator<Item = (f64, f64)>) -> PathBuf {
    let folder = temporary().join("histories");
    fs::create_dir_all(&folder).expect("the target folder can be written to");
    let path = folder.join(name);
    let mut file = io::BufWriter::new(File::create(&path).expect("the target folder can be written to"));
    for (input, step) in steps {
        writeln!(file, "{:016x} {:016x}", input.to_bits(), step.to_bits())
            .expect("the target folder can be written to");
    }
    path
}
