//! Tables of the guide generated from `modelDescription/`, and the keys of a scene.

use crate::{is_writing, read, root};
use brinell_exporter::scene::rules;
use brinell_testing::command;
use serde_json::Value as Json;
use std::fs;
use std::path::Path;
use toml::{Table, Value};

/// The entries of `kind` in a table of `modelDescription/`.
pub fn entries(file: &str, kind: &str) -> Vec<Table> {
    let text = read(&Path::new("modelDescription").join(file));
    let mut table: Table = toml::from_str(&text).unwrap_or_else(|error| panic!("{file}: {error}"));
    let Some(Value::Array(entries)) = table.remove(kind) else { panic!("{file} has no {kind}") };
    entries.into_iter().map(|entry| entry.try_into().expect("entries are tables")).collect()
}

pub fn text<'a>(entry: &'a Table, key: &str) -> &'a str {
    entry.get(key).and_then(Value::as_str).unwrap_or_default()
}

fn number(entry: &Table, key: &str) -> Option<f64> {
    entry.get(key).and_then(Value::as_float)
}

/// `value` in short form: 0.5, 1e18.
fn short(value: f64) -> String {
    let [plain, exponent] = [format!("{value}"), format!("{value:e}")];
    if plain.len() <= exponent.len() + 1 { plain } else { exponent }
}

/// The allowed values, if there are limits.
pub fn allowed(entry: &Table) -> String {
    match (number(entry, "minimum"), number(entry, "maximum")) {
        (Some(least), Some(most)) => format!("{} to {}", short(least), short(most)),
        _ => String::new(),
    }
}

/// A row of a table.
pub fn row(cells: &[&str]) -> String {
    format!("| {} |\n", cells.join(" | ")).replace("|  |", "| |").replace("|  |", "| |")
}

/// The head of a table.
pub fn heading(cells: &[&str]) -> String {
    row(cells) + &"|---".repeat(cells.len()) + "|\n"
}

fn variables(causality: &str) -> String {
    let is_output = causality == "output";
    let mut table =
        heading(if is_output { &["name", "unit", "meaning"] } else { &["name", "unit", "allowed", "meaning"] });
    for variable in entries("variables.toml", "variable") {
        // those of the second direction are like those of the first
        if text(&variable, "causality") != causality || text(&variable, "name").ends_with("[2]") {
            continue;
        }
        let (name, unit) = (format!("`{}`", text(&variable, "name")), text(&variable, "unit"));
        let (allowed, meaning) = (allowed(&variable), text(&variable, "description"));
        table += &if is_output { row(&[&name, unit, meaning]) } else { row(&[&name, unit, &allowed, meaning]) };
    }
    table
}

fn regimes() -> String {
    let variables = entries("variables.toml", "variable");
    let regime = variables.iter().find(|variable| text(variable, "name") == "regime").expect("a variable of the table");
    let items = regime["items"].as_array().expect("an enumeration has items").iter().enumerate();
    let line = |(value, item): (usize, &Value)| {
        let item = item.as_table().expect("an item is a table");
        row(&[&value.to_string(), &format!("`{}`", text(item, "name")), text(item, "description")])
    };
    heading(&["value", "name", "meaning"]) + &items.map(line).collect::<String>()
}

/// The names of the built-in materials.
fn materials() -> String {
    let names: Vec<_> =
        entries("materials.toml", "material").iter().map(|it| format!("`{}`", text(it, "name"))).collect();
    format!("{}.\n", names.join(", "))
}

/// Each law of `kind`, with the texts of `brinell laws`.
fn laws(kind: &str) -> String {
    let list = command::run(root(), ["laws", "--json"]).with_status(0).json();
    let (mut page, mut shown) = (String::new(), Vec::new());
    for law in list[kind].as_array().expect("a list of laws") {
        let text = |key: &str| law[key].as_str().unwrap_or_default();
        // a law with several damping factors is listed once for each
        let name = text("name").split('/').next().unwrap_or_default();
        if shown.contains(&name) {
            continue;
        }
        shown.push(name);
        page += &format!("### `{name}`\n\n{}.\n\n", text("title"));
        for formula in law["formulas"].as_array().expect("a law has formulas") {
            page += &format!("- `{}`\n", formula.as_str().expect("a formula is text"));
        }
        page += &format!("\n{}\n\n", text("notes"));
        for (key, label) in [("validity", "Validity"), ("reference", "Reference")] {
            if !text(key).is_empty() {
                page += &format!("{label}: {}.\n\n", text(key).trim_end_matches('.'));
            }
        }
    }
    page
}

/// The tools of `brinell translate`.
fn tools() -> String {
    let mut table = heading(&["tool", "`--for`", "contact models", "true for"]);
    for tool in brinell_exporter::translate::tools::TOOLS.iter() {
        let ways: Vec<_> = tool.ways.iter().map(|way| way.title.as_str()).collect();
        table += &row(&[&tool.title, &format!("`{}`", tool.name), &ways.join("; "), &tool.versions]);
    }
    table
}

/// What keys of a scene forbid and need of others, and what is said of it.
fn rules() -> String {
    let mut table = heading(&["rule", "message"]);
    for (heads, message) in rules::written_rules().iter().filter(|(_, message)| !message.is_empty()) {
        let is_list = |word: &str| word.len() > 2 && word.chars().all(|c| c.is_ascii_uppercase() || c == '_');
        let names =
            |word: &str, between: &str| if is_list(word) { rules::list(word).join(between) } else { word.into() };
        let of_word = |word: &str| word.split('.').map(|part| names(part, " or ")).collect::<Vec<_>>().join(".");
        let of_head = |head: &str| head.split(' ').map(of_word).collect::<Vec<_>>().join(" ");
        let code = |head: &&str| format!("`{}`", of_head(head.split(", at ").next().unwrap_or_default()));
        let filled = message.split(['{', '}']).enumerate().map(|(place, part)| match place % 2 {
            0 => part.to_string(),
            _ if ["MATERIALS", "NO_FRICTION"].contains(&part) || !is_list(part) => "…".into(),
            _ => names(part, "\", \""),
        });
        let message = format!("`` {} ``", filled.collect::<String>());
        table += &row(&[&heads.iter().map(code).collect::<Vec<_>>().join("<br>"), &message]);
    }
    table
}

/// Compares the text between the comments of the table `name` in `page` with `table`, or writes it.
pub fn shows(page: &str, name: &str, table: &str) {
    let path = Path::new("docs/guide").join(page);
    let whole = read(&path);
    let [begin, end] = ["begin", "end"].map(|place| format!("<!-- table of {name}: {place} -->"));
    let (before, rest) = whole.split_once(&begin).unwrap_or_else(|| panic!("{page} has no {begin}"));
    let (shown, after) = rest.split_once(&end).unwrap_or_else(|| panic!("{page} has no {end}"));
    let table = format!("\n\n{}\n\n", table.trim());
    if is_writing() {
        fs::write(root().join(&path), format!("{before}{begin}{table}{end}{after}")).expect("the page can be written");
    } else {
        assert!(shown == table, "{page}: the table of {name} isn't what it should be; BRINELL_WRITE=1 writes it");
    }
}

#[test]
fn tables_are_those_of_the_model_description() {
    shows("variables.md", "inputs", &variables("input"));
    shows("variables.md", "outputs", &variables("output"));
    shows("variables.md", "regimes", &regimes());
    shows("variables.md", "parameters", &variables("parameter"));
    shows("scenes.md", "materials", &materials());
    shows("scene-rules.md", "rules of scenes", &rules());
    shows("translate.md", "tools", &tools());
    shows("all-laws.md", "loading laws", &laws("loading"));
    shows("all-laws.md", "unloading laws", &laws("unloading"));
    shows("all-laws.md", "rate-dependent laws", &laws("damped"));
}

/// The keys of a table in a scene file, in their order: the public fields of this struct of the exporter.
fn fields(file: &str, structure: &str) -> Vec<String> {
    let source = read(Path::new(file));
    let (_, rest) = source.split_once(&format!("struct {structure} {{")).unwrap_or_else(|| panic!("no {structure}"));
    let fields = rest.split("\n}").next().unwrap().lines().filter_map(|line| line.trim().strip_prefix("pub "));
    fields.map(|field| field.split(':').next().unwrap().to_string()).filter(|field| !field.starts_with('(')).collect()
}

/// The keys of a table of a scene as the schema describes them, in the order of the struct; those that are as in `others` share a row.
fn keys(schema: &Json, order: &[String], others: Option<&Json>) -> String {
    let keys = schema["properties"].as_object().expect("a table has keys");
    assert!(order.iter().all(|key| keys.contains_key(key)) && order.len() == keys.len(), "{order:?}, and {keys:?}");
    let mut table = heading(&["key", "unit", "allowed", "default", "meaning"]);
    let required: Vec<_> =
        schema["required"].as_array().into_iter().flatten().filter_map(Json::as_str).map(String::from).collect();
    let is_same = |key: &String| {
        others.is_some_and(|others| others["properties"][key]["description"] == keys[key]["description"])
    };
    for key in order.iter().filter(|key| !is_same(key)) {
        let schema = &keys[key];
        let text = |key: &str| schema[key].as_str().unwrap_or_default();
        let number = |key: &str| schema[key].as_f64().map(short);
        let values = schema["enum"].as_array().or(schema["items"]["enum"].as_array()).filter(|values| values.len() < 5);
        let of_texts = schema["examples"].as_array().filter(|_| text("type") == "string");
        let code = |values: &Vec<Json>| values.iter().map(|value| format!("`{value}`")).collect::<Vec<_>>().join(", ");
        let allowed = match (number("minimum"), number("maximum"), number("exclusiveMinimum")) {
            (Some(least), Some(most), _) => format!("{least} to {most}"),
            (Some(least), None, _) => format!("from {least}"),
            (.., Some(_)) => "positive".into(),
            _ => values.or(of_texts).map(code).unwrap_or_default(),
        };
        let is_required = required.contains(key);
        let default = match &schema["default"] {
            _ if is_required => "required".into(),
            Json::Null if text("x-default").is_empty() => "none".to_string(),
            Json::Null => text("x-default").into(),
            value => format!("`{value}`"),
        };
        let lines =
            schema["x-taplo"]["docs"]["enumValues"].as_array().zip(values).map_or(String::new(), |(lines, values)| {
                let line = |(value, line): (&Json, &Json)| format!(" `{value}`: {}", line.as_str().expect("a line"));
                values.iter().zip(lines).map(line).collect()
            });
        let meaning = format!("{}{lines}", text("description"));
        table += &row(&[&format!("`{key}`"), text("x-unit"), &allowed, &default, &meaning]);
    }
    let same: Vec<_> = order.iter().filter(|key| is_same(key)).map(|key| format!("`{key}`")).collect();
    if same.is_empty() { table } else { table + &row(&[&same.join(", "), "", "", "", "as for the [target](#target)"]) }
}

#[test]
fn the_keys_of_scenes_are_those_of_the_schema() {
    const FILE: &str = "crates/exporter/src/scene/file.rs";
    let schema = brinell_exporter::schema::documented();
    let of = &schema["properties"];
    let show = |name: &str, schema: &Json, structure: &str| {
        let others = (name == "impactor").then_some(&of["target"]);
        shows("scenes.md", &format!("keys of {name}"), &keys(schema, &fields(FILE, structure), others));
    };
    show("a scene", &schema, "SceneFile");
    show("impactor", &of["impactor"], "ImpactorKeys");
    show("target", &of["target"], "BodyTable");
    show("law", &of["law"], "LawTable");
    show("fmu", &of["fmu"], "Fmu");
    show("impact", &of["impact"], "ImpactTable");
    show("friction", &of["friction"], "FrictionTable");
    show("coupling", &of["coupling"], "CouplingTable");
    show("body", &of["body"]["items"], "SharedBodyTable");
    show("contact", &of["contact"]["items"], "ContactTable");
    let materials = keys(&of["material"]["items"], &fields("crates/exporter/src/table.rs", "Material"), None);
    shows("scenes.md", "keys of material", &materials);
}
