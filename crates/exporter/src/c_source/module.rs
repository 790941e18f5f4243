//! Makes the C text of a library from what `wasm2c` makes of its module.
//!
//! Of that text stay the functions and the data, with short names. What they need is in `brinell_runtime.h`. Its preamble, tables,
//! memories and exports go. Indirect calls, which are calls of methods of laws, become a `switch` over all functions that can be meant:
//! no function is reached but by its name, so that the calls form a graph, whose deepest path bounds the stack.

use brinell_fmu::scene::library::block::Block;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::fmt::Write;

/// The first line of the text of a library: the other files don't fit a text of another version.
pub const FORMAT: &str = "/* brinell C source 1 */";

/// The functions of FMI: the only file to compile.
pub const FUNCTIONS: (&str, &str) = ("fmi2.c", include_str!("fmi2.c"));

/// The version of `wasm2c` whose text this module takes.
pub const WASM2C: &str = "1.0.32";

/// A text that no C source can be made of.
#[derive(Debug, thiserror::Error)]
pub enum ModuleError {
    #[error("it is not the text of wasm2c {WASM2C}: there is no {0}")]
    Missing(&'static str),
    #[error("it needs {0} (a panic path has survived, or a library function has crept in)")]
    Import(String),
    #[error("the depth of the stack has no bound, since {0} calls itself")]
    Recursion(String),
    #[error("its calls take a stack of {needed} bytes, and it is linked with one of {given}")]
    Stack { needed: u64, given: u32 },
    #[error("the block of the scene is not the last of the data")]
    Behind,
}

/// What the module may call: the functions of `fmi2.c` that stand for the importer.
const IMPORTS: [&str; 3] = ["calloc", "free", "brinell_log"];

/// The functions that call themselves, by a part of their name, and how deep at most.
const RECURSIONS: [(&str, u64); 3] = [
    // a contact without springs goes on as one that has some
    ("9mean_pull", 2),
    // a contact at rest goes on as one that has begun to move
    ("10pull_rates", 2),
    // each halves a part of a segment: HALVINGS times; the parameters of the type stand between its name and this
    ("_GT_4slip", 7),
];

/// What precedes the name of a thing in the text.
const PREFIX: &str = "w2c_";

/// A function of the module.
struct Function<'a> {
    result: &'a str,
    /// The types of its parameters.
    parameters: Vec<&'a str>,
    /// The lines of its body.
    body: Vec<&'a str>,
    /// Its name in C.
    name: String,
}

/// Which functions an indirect call can mean: its type, and the place in the tables of methods that it reads. A function that comes as
/// an argument has no such place.
type Site = (u32, Option<u32>);

/// The module.
struct Module<'a> {
    functions: BTreeMap<&'a str, Function<'a>>,
    /// The functions with an index, from 1 on.
    table: Vec<&'a str>,
    /// Addresses and contents of the data.
    data: Vec<(u32, Vec<u8>)>,
    stack: u32,
    block: u32,
}

/// The text between two others.
fn between<'a>(text: &'a str, begin: &str, end: &str) -> Option<&'a str> {
    let (_, rest) = text.split_once(begin)?;
    Some(rest.split_once(end)?.0)
}

/// The unsigned number at the beginning of a text.
fn leading(text: &str) -> Option<u32> {
    text.split(|letter: char| !letter.is_ascii_digit()).next()?.parse().ok()
}

impl<'a> Module<'a> {
    fn read(text: &'a str) -> Result<Module<'a>, ModuleError> {
        let global = |name: &str| leading(between(text, &format!("  instance->w2c_{name} = "), ";")?);
        let stack = global("__stack_pointer").ok_or(ModuleError::Missing("stack pointer"))?;
        let block = global("brinell_block").ok_or(ModuleError::Missing("block"))?;
        // an instance is behind it, and takes the room that a scene leaves
        if global("__data_end") != Some(block + size_of::<Block>() as u32) {
            return Err(ModuleError::Behind);
        }
        let functions = functions(text);
        let mut imports = text.match_indices("(*Z_envZ_").map(|(at, begin)| &text[at + begin.len()..]);
        let name = |rest: &'a str| rest.split(')').next().unwrap_or_default();
        if let Some(other) = imports.find(|rest| !IMPORTS.contains(&name(rest))) {
            return Err(ModuleError::Import(name(other).into()));
        }
        let elements =
            between(text, "wasm_elem_segment_expr_t elem_segment_exprs_w2c_e0[] = {", "};").unwrap_or_default();
        let table = elements.lines().filter_map(|line| between(line, "&", ",")).collect();
        Ok(Module { functions, table, data: data(text)?, stack, block })
    }

    /// The words of the data that begin at multiples of four, with their addresses.
    fn words(&self) -> impl Iterator<Item = (u32, Vec<u32>)> {
        self.data.iter().map(|(address, bytes)| {
            let (words, _) = bytes.as_chunks();
            (*address, words.iter().map(|word| u32::from_le_bytes(*word)).collect())
        })
    }

    /// The indices of functions at each place of the tables of methods. Such a table begins with no destructor, and with the size and the
    /// alignment of a type.
    fn methods(&self) -> BTreeMap<u32, BTreeSet<usize>> {
        let mut methods = BTreeMap::<u32, BTreeSet<usize>>::new();
        let is_function = |word: &u32| (1..=self.table.len()).contains(&(*word as usize));
        for (_, words) in self.words() {
            for (at, head) in words.windows(3).enumerate() {
                let is_head = head[0] == 0 && matches!(head[2], 1 | 2 | 4 | 8) && head[1] % head[2] == 0;
                if is_head {
                    for (index, word) in words[at + 3..].iter().take_while(|word| is_function(word)).enumerate() {
                        methods.entry(4 * (index as u32 + 3)).or_default().insert(*word as usize);
                    }
                }
            }
        }
        methods
    }
}

/// All functions.
fn functions(text: &str) -> BTreeMap<&str, Function<'_>> {
    let mut functions = BTreeMap::new();
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        let head = line
            .strip_prefix("static ")
            .and_then(|line| line.strip_suffix(") {")?.split_once("(Z_unit_instance_t* instance"));
        let Some((result, (name, parameters))) =
            head.and_then(|(head, rest)| Some((head.split_once(' ')?.0, (head.split_once(' ')?.1, rest))))
        else {
            continue;
        };
        if !name.starts_with(PREFIX) {
            continue;
        }
        let parameters = parameters.split(", ").filter_map(|one| one.split_once(' ')).map(|(kind, _)| kind).collect();
        let body = lines.by_ref().take_while(|line| *line != "}").collect();
        let plain = name.strip_prefix(PREFIX).filter(|name| name.starts_with("fmi2") || name.starts_with("brinell_"));
        // without `fmi2`, or the prefix of an FMU that is named `unit` would make an equal name
        let number = functions.len();
        let short =
            plain.map_or_else(|| format!("fn{number}"), |name| format!("unit_{}", name.trim_start_matches("fmi2")));
        functions.insert(name, Function { result, parameters, body, name: short });
    }
    functions
}

/// Addresses and contents of the data.
fn data(text: &str) -> Result<Vec<(u32, Vec<u8>)>, ModuleError> {
    let loads = between(text, "static void init_memories(", "\n}\n").ok_or(ModuleError::Missing("memory"))?;
    let segment = |line: &str| {
        let (address, rest) = between(line, "LOAD_DATA(instance->w2c_memory, ", ");")?.split_once("u, ")?;
        let array = between(text, &format!("static const u8 {}[] = {{", rest.split(',').next()?), "};")?;
        let bytes = array.split(',').filter_map(|byte| u8::from_str_radix(byte.trim().strip_prefix("0x")?, 16).ok());
        Some((address.parse().ok()?, bytes.collect()))
    };
    let loads = loads.lines().filter(|line| line.contains("LOAD_DATA("));
    loads.map(|line| segment(line).ok_or(ModuleError::Missing("data"))).collect()
}

/// The parts of an indirect call: what takes its result, its site, the index, the arguments.
struct Indirect<'a> {
    result: &'a str,
    kind: u32,
    index: &'a str,
    arguments: &'a str,
}

impl<'a> Indirect<'a> {
    fn of(line: &'a str) -> Option<Indirect<'a>> {
        let (result, rest) = line.split_once("CALL_INDIRECT(instance->w2c_T0, ")?;
        let (_, rest) = rest.split_once("), ")?;
        let (kind, rest) = rest.split_once(", ")?;
        let (index, rest) = rest.split_once(", ")?;
        let (_, arguments) = rest.split_once("].module_instance")?;
        Some(Indirect { result, kind: kind.parse().ok()?, index, arguments })
    }
}

/// The place in the table of methods that the line before an indirect call reads: `i4 = i32_load(memory, (u64)(i4) + 20u);`. The index
/// may have been kept in a local variable before.
fn places(body: &[&str], at: usize, index: &str) -> Option<BTreeSet<u32>> {
    let loaded = |line: &str| {
        let place = line.split_once(" = i32_load(&instance->w2c_memory, (u64)(")?.1.split_once(')')?.1;
        leading(place.strip_prefix(" + ").unwrap_or("0"))
    };
    let before = body.get(at.checked_sub(1)?)?.trim();
    let from = before.strip_prefix(index)?.strip_prefix(" = ")?;
    if from.starts_with("i32_load") {
        return loaded(before).map(|place| BTreeSet::from([place]));
    }
    let kept = format!("{} = ", from.strip_suffix(';').filter(|name| name.starts_with("w2c_l"))?);
    let sets = body.iter().enumerate().filter(|(_, line)| line.trim().starts_with(&kept));
    sets.map(|(at, _)| loaded(body.get(at.checked_sub(1)?)?))
        .collect::<Option<BTreeSet<_>>>()
        .filter(|all| !all.is_empty())
}

/// The functions that a line names.
fn called(line: &str) -> impl Iterator<Item = &str> {
    line.match_indices("(instance").filter_map(move |(at, _)| line[..at].rsplit([' ', '(']).next())
}

/// What a function does with the stack \[bytes\].
fn frame(body: &[&str]) -> u64 {
    let frame = body.windows(3).find_map(|lines| {
        let is_taken = lines[0].ends_with(" = instance->w2c___stack_pointer;") && lines[2].contains(" -= ");
        if is_taken { leading(lines[1].split_once(" = ")?.1) } else { None }
    });
    frame.unwrap_or(0).into()
}

/// The calls in a module.
struct Calls<'a> {
    /// The functions that each one calls.
    of: HashMap<&'a str, BTreeSet<&'a str>>,
    /// The site of each line with an indirect call.
    sites: HashMap<(&'a str, usize), Site>,
    /// The types of the result and the parameters, and the indices of the functions that may be meant at each site.
    meant: BTreeMap<Site, (&'a str, Vec<&'a str>, BTreeSet<usize>)>,
}

impl<'a> Calls<'a> {
    fn of(module: &Module<'a>) -> Calls<'a> {
        let methods = module.methods();
        let mut calls = Calls { of: HashMap::new(), sites: HashMap::new(), meant: BTreeMap::new() };
        for (name, function) in &module.functions {
            let mut all = BTreeSet::new();
            for (at, line) in function.body.iter().enumerate() {
                all.extend(
                    called(line).filter_map(|called| module.functions.get_key_value(called)).map(|(name, _)| *name),
                );
                let Some(indirect) = Indirect::of(line) else { continue };
                let types =
                    line.split_once("(void*").and_then(|(_, rest)| rest.split_once(')')).map_or("", |(types, _)| types);
                let types: Vec<_> = types.split(", ").filter(|name| !name.is_empty()).collect();
                let result = between(line, "w2c_T0, ", " (*)").unwrap_or_default();
                let fits = |index: &usize| {
                    let function = module.table.get(*index - 1).and_then(|name| module.functions.get(name));
                    function.is_some_and(|function| function.parameters == types && function.result == result)
                };
                let places = places(&function.body, at, indirect.index);
                // a call that reads one of several places has the functions of all
                let site = (
                    indirect.kind,
                    places.as_ref().filter(|places| places.len() == 1).and_then(|places| places.first().copied()),
                );
                let all_indices = 1..=module.table.len();
                let meant: BTreeSet<usize> = match &places {
                    Some(places) => places
                        .iter()
                        .flat_map(|place| methods.get(place).into_iter().flatten().copied())
                        .filter(fits)
                        .collect(),
                    None => all_indices.filter(fits).collect(),
                };
                all.extend(meant.iter().map(|index| module.table[*index - 1]));
                calls.meant.entry(site).or_insert((result, types, BTreeSet::new())).2.extend(meant);
                calls.sites.insert((name, at), site);
            }
            calls.of.insert(name, all);
        }
        // what is meant at one line with a site is meant at all
        for ((name, _), site) in &calls.sites {
            let meant = calls.meant[site].2.iter().map(|index| module.table[*index - 1]);
            calls.of.entry(name).or_default().extend(meant);
        }
        calls
    }

    /// All functions that can be reached from `roots`.
    fn reached(&self, roots: impl Iterator<Item = &'a str>) -> BTreeSet<&'a str> {
        let (mut reached, mut next) = (BTreeSet::new(), roots.collect::<Vec<_>>());
        while let Some(name) = next.pop() {
            if reached.insert(name) {
                next.extend(self.of.get(name).into_iter().flatten());
            }
        }
        reached
    }

    /// The stack that a function needs with all that it calls \[bytes\].
    fn depth(
        &self,
        module: &Module<'a>,
        name: &'a str,
        path: &mut Vec<&'a str>,
        known: &mut HashMap<&'a str, u64>,
    ) -> Result<u64, ModuleError> {
        if let Some(depth) = known.get(name) {
            return Ok(*depth);
        }
        if path.contains(&name) {
            return Err(ModuleError::Recursion(name.into()));
        }
        path.push(name);
        let (mut own, mut deepest) = (frame(&module.functions[name].body), 0);
        for other in self.of.get(name).into_iter().flatten() {
            if *other == name {
                let times = RECURSIONS.iter().find(|(part, _)| name.contains(part)).map(|(_, times)| times);
                own *= times.ok_or_else(|| ModuleError::Recursion(name.into()))?;
            } else {
                deepest = deepest.max(self.depth(module, other, path, known)?);
            }
        }
        path.pop();
        known.insert(name, own + deepest);
        Ok(own + deepest)
    }
}

/// The C text of a library of this `kind`, from the `text` that `wasm2c` makes of its module.
///
/// # Errors
/// [`ModuleError`]
pub fn c_text(text: &str, kind: &str) -> Result<String, ModuleError> {
    // long lists of parameters take two lines
    let text = &text.replace(", \n    ", ", ");
    let module = Module::read(text)?;
    let calls = Calls::of(&module);
    let words: BTreeSet<_> = FUNCTIONS.1.split(|letter: char| !is_letter(letter)).collect();
    let is_called = |(_, function): &(&&str, &Function)| words.contains(function.name.as_str());
    let roots: Vec<_> = module.functions.iter().filter(is_called).map(|(name, _)| *name).collect();
    let reached = calls.reached(roots.iter().copied());
    let (mut deepest, mut known) = (0, HashMap::new());
    for root in &roots {
        deepest = deepest.max(calls.depth(&module, root, &mut Vec::new(), &mut known)?);
    }
    if deepest > module.stack.into() {
        return Err(ModuleError::Stack { needed: deepest, given: module.stack });
    }
    let fixed = module.functions.get("w2c_brinell_fixed_size").map(|function| function.body.as_slice());
    let fixed = fixed.and_then(|body| body.iter().find_map(|line| leading(line.split_once(" = ")?.1)));
    let fixed = fixed.ok_or(ModuleError::Missing("size of an instance"))?;
    let is_root = |name: &str| name.contains("4libm4math") && name.contains("4sqrt4sqrt");
    if !module.functions.keys().any(|name| is_root(name)) {
        return Err(ModuleError::Missing("square root"));
    }
    let mut out = format!(
        "{FORMAT}\n/* The library `{kind}`: made by wasm2c {WASM2C} and Brinell from a module for WebAssembly. */\n"
    );
    for (name, value) in [
        ("STACK_TOP", module.stack.into()),
        ("STACK_SIZE", deepest.next_multiple_of(16)),
        ("BLOCK_AT", module.block.into()),
        ("FIXED_SIZE", fixed.into()),
    ] {
        writeln!(out, "#define {name} {value}u").expect("a String takes everything");
    }
    out.push_str("#ifdef BRINELL_FUNCTIONS\n");
    write_data(&mut out, &module);
    let prototype = |function: &Function, names: bool| {
        let mut text = format!("static {} {}(Unit *{}", function.result, function.name, if names { "m" } else { "" });
        for (index, kind) in function.parameters.iter().enumerate() {
            let name = if names { format!(" p{index}") } else { String::new() };
            write!(text, ", {kind}{name}").expect("a String takes everything");
        }
        text + ")"
    };
    for name in &reached {
        wrap(&mut out, &(prototype(&module.functions[name], false) + ";"));
    }
    let used: BTreeSet<Site> =
        calls.sites.iter().filter(|((name, _), _)| reached.contains(name)).map(|(_, site)| *site).collect();
    for site in used {
        write_dispatcher(&mut out, &module, &calls, site);
    }
    for name in &reached {
        let function = &module.functions[name];
        out.push('\n');
        wrap(&mut out, &(prototype(function, true) + " {"));
        let arguments: Vec<_> = (0..function.parameters.len()).map(|index| format!("p{index}")).collect();
        if is_root(name) {
            writeln!(out, "#ifdef HARDWARE_SQRT\n  (void)m;\n  return HARDWARE_SQRT({});\n#else", arguments.join(", "))
                .expect("a String");
        }
        write_body(&mut out, &module, &calls, name);
        out.push_str(if is_root(name) { "#endif\n}\n" } else { "}\n" });
    }
    out.push_str("#endif\n");
    match out.contains("_ZN") {
        // the name of a function that was not found
        true => Err(ModuleError::Missing("function that is called")),
        false => Ok(out),
    }
}

/// The longest line of the text: far below what compilers must take.
const LONGEST: usize = 120;

/// Adds a line, in several if it is long.
fn wrap(out: &mut String, line: &str) {
    let mut rest = line;
    while rest.len() > LONGEST {
        let Some(end) = rest[..LONGEST].rfind(", ") else { break };
        out.push_str(&rest[..=end]);
        out.push_str("\n    ");
        rest = &rest[end + 2..];
    }
    out.push_str(rest);
    out.push('\n');
}

fn write_data(out: &mut String, module: &Module<'_>) {
    for (index, (_, bytes)) in module.data.iter().enumerate() {
        writeln!(out, "static const u8 data_{index}[{}] = {{", bytes.len()).expect("a String takes everything");
        for row in bytes.chunks(24) {
            let row: Vec<_> = row.iter().map(u8::to_string).collect();
            writeln!(out, "{},", row.join(",")).expect("a String takes everything");
        }
        out.push_str("};\n");
    }
    out.push_str("static void load_data(Unit *m) {\n  m->stack = STACK_TOP;\n");
    for (index, (address, bytes)) in module.data.iter().enumerate() {
        writeln!(out, "  memcpy(PLACE(m, {address}u), data_{index}, {});", bytes.len())
            .expect("a String takes everything");
    }
    out.push_str("}\n");
}

/// The name of the function that stands for the indirect calls of a site.
fn dispatcher((kind, place): Site) -> String {
    place.map_or_else(|| format!("any_{kind}"), |place| format!("method_{kind}_{place}"))
}

fn write_dispatcher(out: &mut String, module: &Module<'_>, calls: &Calls<'_>, site: Site) {
    let (result, parameters, meant) = &calls.meant[&site];
    let (mut head, mut passed) = (format!("static {result} {}(Unit *m, u32 which", dispatcher(site)), String::new());
    for (index, kind) in parameters.iter().enumerate() {
        write!(head, ", {kind} p{index}").expect("a String takes everything");
        write!(passed, ", p{index}").expect("a String takes everything");
    }
    wrap(out, &(head + ") {"));
    out.push_str("  switch (which) {\n");
    let is_void = *result == "void";
    for index in meant {
        let call = format!("{}(m{passed});", module.functions[module.table[*index - 1]].name);
        let line =
            if is_void { format!("  case {index}: {call} return;") } else { format!("  case {index}: return {call}") };
        wrap(out, &line);
    }
    let nothing = if is_void { "" } else { " return 0;" };
    writeln!(out, "  default: m->failed = 1;{nothing}\n  }}\n}}").expect("a String takes everything");
}

fn write_body(out: &mut String, module: &Module<'_>, calls: &Calls<'_>, name: &str) {
    let function = &module.functions[name];
    let targets: BTreeSet<_> = function
        .body
        .iter()
        .flat_map(|line| line.split("goto ").skip(1))
        .filter_map(|rest| rest.split(';').next())
        .collect();
    for (at, line) in function.body.iter().enumerate() {
        let plain = line.trim();
        let label = plain.strip_suffix(":;").or(plain.strip_suffix(':'));
        let is_unused = label.is_some_and(|label| label.starts_with(PREFIX) && !targets.contains(label));
        if is_unused || plain == "FUNC_PROLOGUE;" || plain == "FUNC_EPILOGUE;" {
            continue;
        }
        let line = match (Indirect::of(line), calls.sites.get(&(name, at))) {
            (Some(Indirect { result, index, arguments, .. }), Some(site)) => {
                format!("{result}{}(instance, {index}{arguments}", dispatcher(*site))
            }
            _ => (*line).to_string(),
        };
        let mut line = renamed(&line, module);
        // no compiler can join a product with the sum that uses it
        if let Some((product, _)) = plain.split_once(" *= ").filter(|(product, _)| product.starts_with("w2c_d")) {
            write!(line, " OPAQUE({});", &product[PREFIX.len()..]).expect("a String takes everything");
        }
        wrap(out, line.trim());
    }
}

/// Whether it may be part of a name.
fn is_letter(letter: char) -> bool {
    letter.is_ascii_alphanumeric() || letter == '_'
}

/// A line with the names of C.
fn renamed(line: &str, module: &Module<'_>) -> String {
    let line = line.replace("&instance->w2c_memory", "m").replace("instance->w2c___stack_pointer", "m->stack");
    let line = line.replace("(*Z_envZ_", "import_").replace(")(instance->Z_env_instance", "(m");
    let mut renamed = String::new();
    let mut rest = line.as_str();
    while let Some(letter) = rest.chars().next() {
        let end = rest.find(|other| is_letter(other) != is_letter(letter)).unwrap_or(rest.len());
        let (word, behind) = rest.split_at(end);
        renamed.push_str(match (word, word.strip_prefix(PREFIX), module.functions.get(word)) {
            (_, _, Some(function)) => &function.name,
            (_, Some(short), None) => short,
            ("instance", ..) => "m",
            ("INFINITY", ..) => "HUGE_VAL",
            _ => word,
        });
        rest = behind;
    }
    renamed
}
