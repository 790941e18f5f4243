//! What a version promises: the names that users write, as lists in `tests/surface/`, and files of earlier versions, which this
//! one still reads. A change of a list is a change for users, and belongs into CHANGELOG.md; BRINELL_WRITE=1 writes the lists.

use super::{is_writing, python, read, root};
use crate::tables;
use brinell_testing::command::{brinell, empty_folder, output, scene};
use brinell_testing::places::temporary;
use serde_json::Value;
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

/// Compares the list `name` with `text`, or writes it.
#[track_caller]
fn promises(name: &str, text: &str) {
    let path = Path::new("tests/surface").join(name).with_extension("txt");
    if is_writing() {
        return fs::write(root().join(&path), text).expect("the list can be written");
    }
    let known = read(&path);
    let (before, now): (BTreeSet<_>, BTreeSet<_>) = (known.lines().collect(), text.lines().collect());
    let (gone, new): (Vec<_>, Vec<_>) = (before.difference(&now).collect(), now.difference(&before).collect());
    assert!(
        known == text,
        "what users rely on has changed ({}).\ngone: {gone:#?}\nnew: {new:#?}\nSay it in CHANGELOG.md; BRINELL_WRITE=1 writes the list",
        path.display()
    );
}

/// What the program prints, in a terminal of a fixed width.
fn printed(arguments: &[&str]) -> String {
    let mut command = brinell(root());
    command.args(arguments).env("COLUMNS", "100").stdin(Stdio::null());
    // its name on Windows
    output(&mut command).with_status(0).out.replace("brinell.exe", "brinell")
}

/// A line for each key below `path` in a schema: its type, its range, and the values that it takes.
fn lines_of(schema: &Value, path: &str, text: &mut String) {
    let Some(keys) = schema["properties"].as_object() else { return };
    for (key, value) in keys {
        let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
        let of = |name: &str| if value[name].is_null() { String::new() } else { format!(" {name} {}", value[name]) };
        let ranges = ["type", "minimum", "exclusiveMinimum", "maximum", "exclusiveMaximum", "enum"].map(of).concat();
        writeln!(text, "{path}:{ranges}").unwrap();
        lines_of(value, &path, text);
        lines_of(&value["items"], &format!("{path}[]"), text);
    }
}

#[test]
fn the_keys_of_a_scene_are_those_of_the_list() {
    let mut text = String::new();
    lines_of(&brinell_exporter::schema::documented(), "", &mut text);
    let names = |file, kind| {
        let entries = tables::entries(file, kind);
        entries.iter().map(|entry| tables::text(entry, "name").to_string()).collect::<Vec<_>>().join(", ")
    };
    for kind in ["loading", "unloading", "damped"] {
        writeln!(text, "{kind} laws: {}", names("laws.toml", kind)).unwrap();
    }
    writeln!(text, "materials: {}", names("materials.toml", "material")).unwrap();
    promises("scene", &text);
}

#[test]
fn the_variables_of_fmus_are_those_of_the_list() {
    let mut text = String::new();
    for variable in tables::entries("variables.toml", "variable") {
        let of = |key| tables::text(&variable, key);
        let (kind, allowed) = (if of("type").is_empty() { "Real" } else { of("type") }, tables::allowed(&variable));
        writeln!(text, "{}: {} {kind} [{}] {allowed}", of("name"), of("causality"), of("unit")).unwrap();
    }
    let constant = |file: &str, begin: &str| {
        let source = read(Path::new(file));
        let line = source.lines().find(|line| line.contains(begin)).unwrap_or_else(|| panic!("{file} has no {begin}"));
        line.trim_end_matches(';').rsplit(" = ").next().unwrap().to_string()
    };
    writeln!(text, "first bytes of a saved state: {}", constant("crates/fmu/src/c/state.rs", "const MAGIC: ")).unwrap();
    promises("variables", &text.replace(" \n", "\n"));
}

#[test]
fn the_command_line_is_that_of_the_list() {
    let whole = printed(&["--help"]);
    let (_, rest) = whole.split_once("Commands:\n").expect("a list of commands");
    let lines = rest.lines().take_while(|line| !line.is_empty());
    // a long description goes on in a second line, further in
    let commands = lines.filter_map(|line| line.strip_prefix("  ")?.split(' ').next().filter(|name| !name.is_empty()));
    let mut text = format!("$ brinell --help\n{whole}");
    let (_, rest) = whole.split_once("For packagers and editors: ").expect("the other commands");
    let (others, _) = rest.split_once(';').expect("their end");
    for command in commands.filter(|name| *name != "help").chain(others.split(", ")) {
        write!(text, "\n$ brinell {command} --help\n{}", printed(&[command, "--help"])).unwrap();
    }
    promises("command-line", &text);
}

/// The keys of a JSON document, with their types: of a list, those of all its items.
fn keys(value: &Value, path: &str, found: &mut BTreeSet<String>) {
    let kind = match value {
        Value::Object(members) => {
            return members.iter().for_each(|(name, member)| keys(member, &format!("{path}.{name}"), found));
        }
        Value::Array(items) => return items.iter().for_each(|item| keys(item, &format!("{path}[]"), found)),
        Value::Null => "null",
        Value::Bool(_) => "boolean",
        Value::Number(_) => "number",
        Value::String(_) => "text",
    };
    found.insert(format!("{path}: {kind}"));
}

#[test]
fn the_json_of_every_command_has_the_keys_of_the_list() {
    let folder = empty_folder();
    let scene = scene("steel_ball").display().to_string();
    let calls: [&[&str]; 9] = [
        &["--version"],
        &["export", &scene],
        &["check", "steel_ball.fmu"],
        &["predict", &scene],
        &["predict", &scene, "--sweep", "speed=0.1:1"],
        &["translate", &scene, "--for", "mujoco"],
        &["hardness", &scene, "--load", "1kN"],
        &["laws"],
        &["materials"],
    ];
    let (mut text, mut platform) = (String::new(), String::new());
    for call in calls {
        let answer = output(brinell(folder.path()).args(call).arg("--json")).with_status(0).json();
        if call == ["--version"] {
            platform = answer["platform"]["folder"].as_str().expect("a folder of FMUs").to_string();
        }
        let mut found = BTreeSet::new();
        keys(&answer, "", &mut found);
        let shown: Vec<_> = call.iter().map(|word| if *word == scene { "SCENE" } else { word }).collect();
        writeln!(text, "$ brinell {} --json", shown.join(" ")).unwrap();
        found.iter().for_each(|key| writeln!(text, "{}", key.trim_start_matches('.')).unwrap());
        text.push('\n');
    }
    promises("json", &text.replace(&format!(".{platform}."), ".PLATFORM."));
}

/// Prints the public names of the Python module: functions with their parameters, classes with their methods.
const NAMES: &str = "
import ast, brinell, inspect
def shown(name, thing):
    try:
        found = inspect.signature(thing)
    except (TypeError, ValueError):
        return name
    plain = [it.replace(annotation=inspect.Parameter.empty) for it in found.parameters.values()]
    return name + str(found.replace(parameters=plain, return_annotation=inspect.Signature.empty))
def module(prefix, names, it):
    for name in names:
        thing = getattr(it, name)
        if inspect.isclass(thing) or inspect.isfunction(thing):
            print(shown(prefix + name, thing))
        else:
            print(prefix + name)
        if inspect.isclass(thing) and not issubclass(thing, Exception):
            for own in sorted(own for own in vars(thing) if not own.startswith('_')):
                method = inspect.getattr_static(thing, own)
                method = getattr(method, '__func__', method)
                print('  ' + (shown(own, method) if inspect.isfunction(method) else own))
module('brinell.', brinell.__all__, brinell)
# these import engines, which aren't everywhere
for name in ('mujoco', 'drake'):
    with open(f'{brinell.__path__[0]}/{name}.py', encoding='utf-8') as text:
        parsed = ast.parse(text.read())
    for node in parsed.body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)) and not node.name.startswith('_'):
            parameters = [it.arg for it in node.args.args + node.args.kwonlyargs] if isinstance(node, ast.FunctionDef) else []
            print(f'brinell.{name}.{node.name}', *parameters)
";

#[test]
fn the_names_of_the_python_module_are_those_of_the_list() {
    let mut command = Command::new(python::python());
    python::keeping_modules(&mut command).env("PYTHONPATH", root().join("python")).args(["-c", NAMES]);
    promises("python", &output(&mut command).with_status(0).out);
}

/// The names in a page of rustdoc: methods, fields and variants of the item, without those of traits that it implements.
fn members(page: &str) -> BTreeSet<&str> {
    let others = ["trait-implementations", "synthetic-implementations", "blanket-implementations", "implementors"];
    let end = others.iter().filter_map(|id| page.find(&format!("id=\"{id}\""))).min().unwrap_or(page.len());
    let kinds = ["method.", "tymethod.", "structfield.", "variant.", "associatedconstant.", "associatedtype."];
    let ids = page[..end].split(" id=\"").skip(1).filter_map(|rest| rest.split('"').next());
    let names = ids.filter_map(|id| kinds.iter().find_map(|kind| id.strip_prefix(kind)));
    // fields of variants, and second places of one name
    names.filter_map(|name| name.split(['.', '-']).next()).collect()
}

#[test]
fn the_names_of_the_rust_library_are_those_of_the_list() {
    let target = temporary().join("documentation");
    let mut cargo = Command::new(env!("CARGO"));
    cargo
        .args(["doc", "--quiet", "--no-deps", "--locked", "--package", "brinell-contact", "--target-dir"])
        .arg(&target);
    cargo.current_dir(root()).env("RUSTDOCFLAGS", "-D warnings").env_remove("CARGO_BUILD_TARGET");
    output(&mut cargo).with_status(0);
    let folder = target.join("doc/brinell_contact");
    let all = fs::read_to_string(folder.join("all.html")).expect("rustdoc lists everything");
    let links = all.split("<li><a href=\"").skip(1).filter_map(|rest| rest.split('"').next());
    let mut items: Vec<_> = links.filter(|link| !link.starts_with('#')).collect();
    items.sort_unstable();
    assert!(items.len() > 100, "rustdoc lists {items:?}");
    let mut text = String::new();
    for item in items {
        let page = fs::read_to_string(folder.join(item)).expect("a page of each item");
        let (path, name) = item.rsplit_once('/').unwrap_or(("", item));
        let [kind, name, ..] = name.split('.').collect::<Vec<_>>()[..] else { panic!("{item}") };
        let whole: Vec<_> = path.split('/').chain([name]).filter(|part| !part.is_empty()).collect();
        let members: Vec<_> = members(&page).into_iter().collect();
        writeln!(text, "{kind} {}: {}", whole.join("::"), members.join(" ")).unwrap();
    }
    promises("rust", &text.replace(": \n", "\n"));
}

/// `tests/surface/VERSION` has an FMU and its scene of each version. Those of this version are written until it is released.
#[test]
fn scenes_are_read_and_fmus_are_checked_of_every_version() {
    let surface = root().join("tests/surface");
    let own = surface.join(env!("CARGO_PKG_VERSION"));
    if is_writing() {
        fs::create_dir_all(&own).expect("the folder can be written");
        fs::copy(scene("everything"), own.join("everything.toml")).expect("a scene");
        output(brinell(&own).args(["export", "everything.toml"])).with_status(0);
    }
    let folders = fs::read_dir(&surface).expect("the lists").map(|entry| entry.expect("a readable folder").path());
    let versions: Vec<_> = folders.filter(|path| path.is_dir()).collect();
    assert!(versions.contains(&own), "no files of this version; BRINELL_WRITE=1 writes them");
    for version in versions {
        let [scene, fmu] = ["everything.toml", "everything.fmu"].map(|name| version.join(name).display().to_string());
        let folder = empty_folder();
        output(brinell(folder.path()).args(["predict", &scene])).with_status(0);
        output(brinell(folder.path()).args(["export", &scene])).with_status(0);
        if cfg!(all(target_os = "linux", target_arch = "x86_64")) {
            output(brinell(folder.path()).args(["check", &fmu])).with_status(0);
        }
    }
}
