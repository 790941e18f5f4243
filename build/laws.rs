//! Generates the lists of laws in Rust from `modelDescription/laws.toml`. A law consists of its `.rs` file and its entry there.
//!
//! A small reader extracts only the lines `name`, `rust` and `guarded` of each entry, so that the physics alone depends on
//! nothing but `libm`. A test reads the same file with a complete TOML parser and compares.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Path of the table, relative to the root.
pub const TABLE: &str = "modelDescription/laws.toml";

/// The kinds of laws, named after their folders and their entries.
const KINDS: [Kind; 3] = [
    Kind { name: "loading", title: "A loading law", law: LAW_OF_LOADING, others: &["mod", "any", "strengthened"] },
    Kind {
        name: "unloading",
        title: "An unloading law",
        law: LAW_OF_UNLOADING,
        others: &["mod", "any", "guarded", "strengthened"],
    },
    Kind { name: "damped", title: "A rate-dependent law", law: LAW_OF_DAMPED, others: &[] },
];

const LAW_OF_LOADING: (&str, &str) = ("pub fn law(&self) -> &dyn Loading", "The law itself.");
const LAW_OF_UNLOADING: (&str, &str) = ("fn law(&self) -> &dyn DynUnloading", "The law itself.");
const LAW_OF_DAMPED: (&str, &str) = ("pub fn law(&self) -> &dyn Damped", "The law itself.");

struct Kind {
    name: &'static str,
    title: &'static str,
    /// Signature and description of the function that returns the law.
    law: (&'static str, &'static str),
    /// Files in the folder that are not laws. If empty, the folder is not checked.
    others: &'static [&'static str],
}

impl Kind {
    /// The file of the list in `OUT_DIR`, which the folder's `mod.rs` includes.
    fn file(&self) -> String {
        format!("{}_laws.rs", self.name)
    }

    fn folder(&self, root: &Path) -> PathBuf {
        root.join("src/contact").join(self.name)
    }

    /// The enum of all laws of the kind.
    fn any(&self) -> String {
        format!("Any{}{}", self.name[..1].to_uppercase(), &self.name[1..])
    }
}

/// A variant of the enum of all laws of a kind.
struct Variant {
    name: String,
    /// The type that it contains.
    holds: String,
    /// The type to which its documentation refers.
    see: String,
}

/// A law of the table.
struct Law {
    /// Name in scenes.
    name: String,
    /// The law with its reference constants as Rust code: "BigAlabo::REFERENCE".
    rust: String,
    /// Whether the unloading law exists with the passivity guard.
    guarded: bool,
    /// Whether the law has a form for targets that harden, and with any Poisson's ratio.
    strengthened: bool,
}

impl Law {
    /// Its type.
    fn type_name(&self) -> &str {
        self.rust.split("::").next().unwrap_or_default()
    }

    /// The module of the law: `Brake2012` is in `brake_2012.rs`.
    fn module(&self) -> String {
        let mut module = String::new();
        let mut before = '_';
        for letter in self.type_name().chars() {
            let begins_word = letter.is_uppercase() || letter.is_ascii_digit() && !before.is_ascii_digit();
            if begins_word && !module.is_empty() {
                module.push('_');
            }
            module.extend(letter.to_lowercase());
            before = letter;
        }
        module
    }
}

/// Writes the lists to `out` for the project itself at `root`.
pub fn write(root: &Path, out: &Path) {
    println!("cargo::rerun-if-changed={TABLE}");
    println!("cargo::rerun-if-changed=build");
    for kind in &KINDS {
        let laws = read(root, kind);
        check_files(root, kind, &laws);
        let folder = kind.folder(root);
        let mut text = modules(&laws, |module| format!("#[path = {:?}]\n", folder.join(format!("{module}.rs"))));
        text += &format!("#[path = {:?}]\nmod any;\npub use any::{};\n", folder.join("any.rs"), kind.any());
        write_file(&out.join(kind.file()), &text);
        write_file(&out.join(format!("any_{}.rs", kind.name)), &list(kind, &laws));
    }
}

/// The `mod.rs` of each folder for an FMU, with paths relative to the root. The laws are plain modules without the enums: an
/// FMU is compiled without this program, and its scene names the law.
#[cfg(feature = "exporter")]
pub fn write_for_units(root: &Path, out: &Path) -> Vec<(String, PathBuf)> {
    let write = |kind: &Kind| {
        let name = format!("src/contact/{}/mod.rs", kind.name);
        let text = fs::read_to_string(root.join(&name)).expect("the source is readable");
        let line = format!("include!(concat!(env!(\"OUT_DIR\"), \"/{}\"));", kind.file());
        assert_eq!(text.matches(&line).count(), 1, "{name} has the line {line}");
        let path = out.join(format!("{}_mod.rs", kind.name));
        write_file(&path, &text.replace(&line, modules(&read(root, kind), |_| String::new()).trim_end()));
        (name, path)
    };
    KINDS.iter().map(write).collect()
}

/// Whether a file, given by its path relative to the root, is not needed in an FMU.
#[cfg(feature = "exporter")]
pub fn is_left_out_of_units(name: &str) -> bool {
    KINDS.iter().any(|kind| name == format!("src/contact/{}/any.rs", kind.name))
}

/// The laws of a kind, in the order of the table.
fn read(root: &Path, kind: &Kind) -> Vec<Law> {
    let table = fs::read_to_string(root.join(TABLE)).expect("the table of laws is readable");
    let mut laws: Vec<Law> = Vec::new();
    let mut inside = false;
    for line in table.lines() {
        if line.starts_with('[') {
            inside = line == format!("[[{}]]", kind.name);
            if inside {
                laws.push(Law { name: String::new(), rust: String::new(), guarded: false, strengthened: false });
            }
        }
        let (Some((key, value)), Some(law)) = (line.split_once(" = "), laws.last_mut().filter(|_| inside)) else {
            continue;
        };
        match key {
            "name" => law.name = value.trim_matches('"').into(),
            "rust" => law.rust = value.trim_matches('"').into(),
            "guarded" => law.guarded = value == "true",
            "strengthened" => law.strengthened = value == "true",
            _ => {}
        }
    }
    for law in &laws {
        assert!(!law.name.is_empty(), "{TABLE}: a law of the kind {} has no name = \"...\"", kind.name);
        assert!(!law.rust.is_empty(), "{TABLE}: the law {:?} has no rust = \"...\"", law.name);
    }
    laws
}

/// Fails if a law has a file but no entry; it would be ignored silently.
fn check_files(root: &Path, kind: &Kind, laws: &[Law]) {
    let modules: BTreeSet<_> = laws.iter().map(Law::module).collect();
    if kind.others.is_empty() {
        return;
    }
    for entry in fs::read_dir(kind.folder(root)).expect("the folder of the laws is readable") {
        let path = entry.expect("the folder of the laws is readable").path();
        let module = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let known = modules.contains(&module) || kind.others.contains(&module.as_str());
        assert!(known, "{} has no entry in {TABLE}", path.display());
    }
}

/// The modules of the laws, each made public with its law, and with the `attributes` of each module.
fn modules(laws: &[Law], attributes: impl Fn(&str) -> String) -> String {
    let both: BTreeSet<_> = laws.iter().map(|law| (law.module(), law.type_name())).collect();
    let module =
        |(module, law): (String, &str)| format!("{}pub mod {module};\npub use {module}::{law};\n", attributes(&module));
    both.into_iter().map(module).collect()
}

/// The enum of all laws of a kind.
fn list(kind: &Kind, laws: &[Law]) -> String {
    let any = kind.any();
    let mut variants: Vec<Variant> = Vec::new();
    for law in laws {
        // one type may implement two laws
        if variants.iter().all(|variant| variant.name != law.type_name()) {
            variants.push(Variant {
                name: law.type_name().into(),
                holds: law.type_name().into(),
                see: law.type_name().into(),
            });
        }
    }
    let guarded: Vec<&str> = laws.iter().filter(|law| law.guarded).map(Law::type_name).collect();
    variants.extend(guarded.iter().map(|law| Variant {
        name: format!("Guarded{law}"),
        holds: format!("Guarded<{law}>"),
        see: "Guarded".into(),
    }));
    let strengthened: Vec<&str> = laws.iter().filter(|law| law.strengthened).map(Law::type_name).collect();
    variants.extend(strengthened.iter().map(|law| Variant {
        name: format!("Strengthened{law}"),
        holds: "Strengthened".into(),
        see: "Strengthened".into(),
    }));
    let declared = |Variant { name, holds, see }: &Variant| format!("    /// See [`{see}`].\n    {name}({holds}),\n");
    let arm = |variant: &Variant| format!("            {any}::{}(law) => law,\n", variant.name);
    let named = |law: &Law| format!("        ({:?}, {any}::{}({})),\n", law.name, law.type_name(), law.rust);
    let (signature, description) = kind.law;
    let text = format!(
        "/// {} chosen while the program runs. An FMU does not contain it: its scene names the law.\n\
         #[derive(Clone, Copy, Debug, PartialEq)]\n\
         #[cfg_attr(feature = \"exporter\", derive(serde::Serialize, serde::Deserialize))]\n\
         pub enum {any} {{\n{}}}\n\nimpl {any} {{\n    \
         /// All laws with their names in a scene and their reference constants.\n    \
         pub const ALL: [(&'static str, {any}); {}] = [\n{}    ];\n\n    \
         /// {description}\n    {signature} {{\n        match self {{\n{}        }}\n    }}\n}}\n",
        kind.title,
        variants.iter().map(declared).collect::<String>(),
        laws.len(),
        laws.iter().map(named).collect::<String>(),
        variants.iter().map(arm).collect::<String>(),
    );
    text + &guarding(&any, &guarded) + &strengthening(&any, &strengthened)
}

/// The way from a law to its form for other materials, where a kind has some.
fn strengthening(any: &str, strengthened: &[&str]) -> String {
    if strengthened.is_empty() {
        return String::new();
    }
    let arm = |law: &&str| {
        let form = "Strengthened { law, hardening_modulus }";
        let again = "Strengthened { hardening_modulus, ..form }";
        format!(
            "            {any}::{law}(law) => Some({any}::Strengthened{law}({form})),\n            \
             {any}::Strengthened{law}(form) => Some({any}::Strengthened{law}({again})),\n"
        )
    };
    format!(
        "\nimpl {any} {{\n    /// The law with the Poisson's ratio of the target and this hardening modulus \\[Pa\\]; none for a \
         law that has no such form.\n    \
         pub fn strengthened(self, hardening_modulus: f64) -> Option<{any}> {{\n        match self {{\n{}            \
         _ => None,\n        }}\n    }}\n}}\n",
        strengthened.iter().map(arm).collect::<String>()
    )
}

/// The function from a law to its guarded form, for a kind that has guarded laws.
fn guarding(any: &str, guarded: &[&str]) -> String {
    if guarded.is_empty() {
        return String::new();
    }
    let arm = |law: &&str| format!("            {any}::{law}(law) => Some({any}::Guarded{law}(Guarded(law))),\n");
    format!(
        "\nimpl {any} {{\n    /// The law with the passivity guard; `None` for a law that has no guarded form.\n    \
         pub fn guarded(self) -> Option<{any}> {{\n        match self {{\n{}            _ => None,\n        }}\n    }}\n}}\n",
        guarded.iter().map(arm).collect::<String>()
    )
}

/// Writes a file only if it has changed, to avoid unnecessary compilation.
fn write_file(path: &Path, text: &str) {
    if fs::read_to_string(path).is_ok_and(|old| old == text) {
        return;
    }
    fs::write(path, text).expect("OUT_DIR can be written");
}
