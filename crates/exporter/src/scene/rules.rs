//! What keys of a scene forbid or need of others: the list `rules.txt`, read once, and the check of a scene by it. The schema has its rules
//! from the same list.

use super::quantities::{Quantity, quantity_of};
use crate::layout::shortened;
use crate::mistake::{Mistake, Spanned, check_range};
use crate::model::Dampings;
use crate::numbers::in_message;
use crate::pairing::{self, TABLE};
use crate::table::{self, Causality, Variable};
use brinell_contact::damped::{AnyDamped, Damped};
use brinell_contact::loading::AnyLoading;
use brinell_contact::unloading::AnyUnloading;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::LazyLock;
use toml::de::{DeTable, DeValue};

/// The rules in the order in which they are told.
pub static RULES: LazyLock<Vec<Rule>> = LazyLock::new(read);

/// The bodies of a contact, as tables of a scene.
pub const BODIES: [&str; 2] = ["impactor", "target"];

/// The keys of bodies that no contact has for itself.
pub const OF_ALL_CONTACTS: [&str; 5] = ["rate", "plate_thickness", "shape", "thickness", "base"];

/// The lists of names in the rules.
pub fn list(name: &str) -> Vec<&'static str> {
    let damped = |is: fn(&AnyDamped) -> bool| {
        AnyDamped::ALL.iter().filter(move |(_, law)| is(law)).map(|(name, _)| *name).collect::<Vec<_>>()
    };
    let plastic = |is: fn(&AnyLoading) -> bool| {
        let laws = AnyLoading::ALL.iter().filter(move |(name, law)| *name != "hertz" && is(law));
        laws.map(|(name, _)| *name).collect::<Vec<_>>()
    };
    let unloading = |is: fn(&(&'static str, AnyUnloading)) -> bool| {
        AnyUnloading::ALL.iter().filter(move |law| is(law)).map(|(name, _)| *name).collect::<Vec<_>>()
    };
    let outputs = |is: fn(&Variable) -> bool| {
        let outputs =
            table::VARIABLES.iter().filter(|variable| variable.causality == Causality::Output && is(variable));
        outputs.map(|output| output.name.as_str()).collect()
    };
    match name {
        "OF_ALL_CONTACTS" => OF_ALL_CONTACTS.into(),
        "ENDS" => vec!["between", "direction", "normal", "arms", "tangent"],
        "HARDENING" => vec!["hardening_modulus", "tangent_modulus", "power_law"],
        "STRENGTHS" => vec!["yield_strength", "hardness", "tensile_strength", "tensile_test", "power_law"],
        "DAMPED" => damped(|_| true),
        "ELLIPTIC" => [damped(|_| true), vec!["brinell", "hertz"]].concat(),
        "OF_MASS" => damped(|law| law.needs_mass()),
        "OF_RESTITUTION" => damped(|law| law.needs_restitution()),
        "OF_DAMPINGS" => damped(|law| !law.dampings().is_empty()),
        "PLASTIC" => plastic(|_| true),
        "SOFTENING" => [plastic(|law| !law.takes_both_bodies()), vec!["hertz"], damped(|_| true)].concat(),
        "STRENGTHLESS" => [vec!["hertz", TABLE], damped(|_| true)].concat(),
        "HARDENED" => plastic(|law| law.takes_both_bodies()),
        "GUARDED" => unloading(|(_, law)| law.guarded().is_some()),
        "UNGUARDED" => unloading(|(_, law)| law.guarded().is_none()),
        "FRICTIONAL" => unloading(|(name, _)| table::unloading_law(name).no_friction.is_none()),
        "FRICTIONLESS" => unloading(|(name, _)| table::unloading_law(name).no_friction.is_some()),
        "OF_SHARED" => outputs(|output| table::OF_SHARED.contains(&output.name.as_str())),
        "OF_FRICTION" => outputs(|output| output.friction),
        other => panic!("{other} is no list of names"),
    }
}

/// What some keys of a scene forbid or need of others.
pub struct Rule {
    /// The body in whose tables its keys are.
    pub body: Option<String>,
    /// Whether it is about the laws that the scene has, be they named or chosen by what yields.
    chosen: bool,
    /// Each of them holds, which is one of several keys.
    pub when: Vec<Vec<Key>>,
    /// Whether `what` is forbidden; otherwise one of it is needed.
    pub forbids: bool,
    pub what: Vec<Key>,
    at: Option<Key>,
    message: String,
}

/// A key of a scene, and what it has to be.
#[derive(Clone, Debug)]
pub struct Key {
    /// Whether it must not be so.
    pub no: bool,
    pub path: Vec<String>,
    pub is: Is,
}

/// What a key may have to be.
#[derive(Clone, Debug)]
pub enum Is {
    There,
    In(Vec<String>),
    NotIn(Vec<String>),
    /// A list with one of these.
    With(Vec<String>),
    /// A list.
    Two,
}

/// Where a scene has a key.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Level {
    /// Once.
    Scene,
    /// In each contact, or for all.
    Body,
    /// In each contact.
    Contact,
}

/// The rules as they are written: those with the same message, and the message.
pub fn written_rules() -> Vec<(Vec<&'static str>, String)> {
    let (mut all, mut heads, mut message) = (Vec::new(), Vec::new(), String::new());
    for line in include_str!("rules.txt").lines().filter(|line| !line.starts_with('#')).chain(["end"]) {
        if let Some(words) = line.strip_prefix("    ") {
            message = format!("{message} {words}").trim().into();
            continue;
        }
        if !message.is_empty() || line == "end" {
            all.push((std::mem::take(&mut heads), std::mem::take(&mut message)));
        }
        heads.extend(Some(line).filter(|line| !line.is_empty()));
    }
    all
}

fn read() -> Vec<Rule> {
    let of = |(head, message): (&str, &String)| {
        let bodies: &[&str] = if head.contains('*') { &BODIES } else { &[""] };
        bodies.iter().map(|body| Rule::read(&head.replace('*', body), &message.replace('*', body))).collect::<Vec<_>>()
    };
    let written = written_rules();
    written.iter().flat_map(|(heads, message)| heads.iter().map(move |head| (*head, message))).flat_map(of).collect()
}

impl Rule {
    fn read(head: &str, message: &str) -> Rule {
        let (chosen, head) = head.strip_prefix("chosen: ").map_or((false, head), |head| (true, head));
        let (body, head) = head.split_once(": ").map_or((None, head), |(body, head)| (Some(body.to_string()), head));
        let (head, at) = head.split_once(", at ").map_or((head, None), |(head, at)| (head, Key::read(at).pop()));
        let (when, what, forbids) = match (head.split_once(" forbids "), head.split_once(" needs ")) {
            (Some((when, what)), _) => (when, what, true),
            (None, Some((when, what))) => (when, what, false),
            (None, None) => panic!("`{head}` is no rule"),
        };
        let any = |text: &str| text.split(" or ").flat_map(Key::read).collect::<Vec<_>>();
        let when = when.split(" and ").map(any).flat_map(|keys| match keys.iter().any(|key| key.no) {
            // none of several
            true => keys.into_iter().map(|key| vec![key]).collect(),
            false => vec![keys],
        });
        Rule { body, chosen, when: when.collect(), forbids, what: any(what), at, message: message.into() }
    }

    fn keys(&self) -> impl Iterator<Item = &Key> {
        self.when.iter().flatten().chain(&self.what)
    }

    /// The mistake of what is seen, if it is against the rule.
    fn broken(&self, seen: &Seen) -> Option<Mistake> {
        let mut last = None;
        for any in &self.when {
            let found = seen.find_any(any);
            match (found, any[0].no) {
                (Some(found), false) => last = Some(found),
                (None, true) => {}
                _ => return None,
            }
        }
        let found = seen.find_any(&self.what);
        let told = match (self.forbids, found.is_some()) {
            (true, true) => found,
            (false, false) => last,
            _ => return None,
        };
        let place = self
            .at
            .as_ref()
            .map_or(told.as_ref().map(|(_, found)| found.span.clone()), |at| seen.find(at).map(|found| found.span));
        let is_own = match self.forbids {
            true => told.as_ref().is_some_and(|(_, found)| found.is_own),
            false => self.body.is_some() || self.what.iter().any(|key| key.level() != Level::Scene),
        };
        let owner =
            seen.contact.filter(|_| is_own).and_then(|contact| contact.get_ref().get("name")?.get_ref().as_str());
        let owner = owner.map_or(String::new(), |name| format!("contact `{}`: ", shortened(name)));
        Some(Mistake(place.unwrap_or(0..0), owner + &self.filled(seen, told.as_ref(), None)))
    }

    /// What it closes in a scene, if no more than one of its keys is missing for a mistake.
    fn closes(&self, seen: &Seen) -> Vec<(String, Closed)> {
        let all = self.when.iter().chain([&self.what]);
        let (held, missing): (Vec<&Vec<Key>>, Vec<&Vec<Key>>) =
            all.partition(|keys| seen.find_any(keys).is_some() != keys[0].no);
        let [missing] = missing.as_slice() else { return Vec::new() };
        if !self.forbids || missing[0].no || missing[0].level() == Level::Contact {
            return Vec::new();
        }
        // the default of another law is that of this one, and follows it
        let is_default = |keys: &&Vec<Key>| seen.find_any(keys).is_some_and(|(_, found)| found.span == (0..0));
        if missing[0].path == ["law", "loading"] && held.iter().any(is_default) {
            return Vec::new();
        }
        let name = |key: &Key| self.body.iter().chain(&key.path).map(String::as_str).collect::<Vec<_>>().join(".");
        let by: Vec<_> = held.iter().filter_map(|keys| seen.find_any(keys)).map(|(key, _)| name(key)).collect();
        let of_key = |key| {
            let of_value = |value: Option<String>| {
                let name = name(key) + &value.as_ref().map_or(String::new(), |value| format!("={value}"));
                let value = DeValue::String(value.unwrap_or_default().into());
                let supposed = (key, Found { span: 0..0, value: &value, is_own: false });
                let why = self.filled(seen, seen.find_any(&self.what).as_ref().or(Some(&supposed)), Some(&supposed));
                (name, Closed { why, by: by.clone() })
            };
            Key::values(key).into_iter().map(of_value).collect::<Vec<_>>()
        };
        missing.iter().flat_map(of_key).collect()
    }

    /// Its message with the names and values of what is `told`, and of what is `supposed` to be there.
    fn filled(&self, seen: &Seen, told: Option<&(&Key, Found)>, supposed: Option<&(&Key, Found)>) -> String {
        let mut parts = self.message.split(['{', '}']);
        let mut text = parts.next().unwrap_or_default().to_string();
        while let (Some(name), Some(rest)) = (parts.next(), parts.next()) {
            text += &match (name, told) {
                ("MATERIALS", _) => seen.materials.join("`, `"),
                ("NO_FRICTION", Some((_, found))) => {
                    table::unloading_law(&written(found.value)).no_friction.clone().unwrap_or_default()
                }
                ("key", Some((key, _))) => key.path[usize::from(key.path[0] == "contact")..].join("."),
                ("value", Some((_, found))) => written(found.value),
                (name, _) if is_list(name) => list(name).join("\", \""),
                (name, _) => {
                    let keys = Key::read(name);
                    let found = keys.iter().find_map(|key| seen.find(key)).map(|found| written(found.value));
                    let supposed = supposed.filter(|(key, _)| key.path.join(".") == name);
                    found.or_else(|| supposed.map(|(_, supposed)| written(supposed.value))).unwrap_or_default()
                }
            };
            text += rest;
        }
        text
    }
}

fn is_list(word: &str) -> bool {
    word.chars().all(|c| c.is_ascii_uppercase() || c == '_')
}

/// A word of a rule, or the words for which it stands.
fn words(word: &str) -> Vec<String> {
    if is_list(word) { list(word).into_iter().map(String::from).collect() } else { vec![word.into()] }
}

impl Key {
    /// The keys that this text of a rule names.
    fn read(text: &str) -> Vec<Key> {
        let (no, text) = text.strip_prefix("no ").map_or((false, text), |rest| (true, rest));
        let of =
            |sign: &str, is: fn(Vec<String>) -> Is| text.split_once(sign).map(|(path, word)| (path, is(words(word))));
        let two = || text.strip_suffix(" of two").map(|path| (path, Is::Two));
        let said = of(" != ", Is::NotIn).or_else(|| of(" = ", Is::In)).or_else(|| of(" has ", Is::With)).or_else(two);
        let (path, is) = said.unwrap_or((text, Is::There));
        let (table, last) = path.rsplit_once('.').map_or((None, path), |(table, last)| (Some(table), last));
        let tables: Vec<_> = table.into_iter().flat_map(|table| table.split('.')).map(String::from).collect();
        let path = |last| tables.iter().cloned().chain([last]).collect();
        words(last).into_iter().map(|last| Key { no, path: path(last), is: is.clone() }).collect()
    }

    /// The values of which a scene can't have one where it can't have this; `None` where it can't have the key.
    fn values(&self) -> Vec<Option<String>> {
        match &self.is {
            Is::There => vec![None],
            Is::In(names) | Is::With(names) => names.iter().cloned().map(Some).collect(),
            Is::NotIn(names) => {
                let laws =
                    AnyLoading::ALL.iter().map(|(name, _)| *name).chain(AnyDamped::ALL.iter().map(|(name, _)| *name));
                laws.map(String::from).filter(|law| !names.contains(law)).map(Some).collect()
            }
            Is::Two => Vec::new(),
        }
    }

    pub fn level(&self) -> Level {
        let is_of_all = |key: &String| OF_ALL_CONTACTS.contains(&key.as_str());
        match self.path.as_slice() {
            [first, _, ..] if first == "contact" => Level::Contact,
            [first, key, ..] if BODIES.contains(&first.as_str()) && !is_of_all(key) => Level::Body,
            _ => Level::Scene,
        }
    }

    /// The part of the `value` that is as it has to be.
    fn part<'a>(&self, value: &'a toml::Spanned<DeValue<'a>>) -> Option<&'a toml::Spanned<DeValue<'a>>> {
        let one_of = |names: &[String], value: &toml::Spanned<DeValue>| names.contains(&written(value.get_ref()));
        match &self.is {
            Is::There => Some(value),
            Is::In(names) => Some(value).filter(|value| one_of(names, value)),
            Is::NotIn(names) => Some(value).filter(|value| !one_of(names, value)),
            Is::Two => value.get_ref().as_array().map(|_| value),
            Is::With(names) => value.get_ref().as_array()?.iter().find(|value| one_of(names, value)),
        }
    }
}

/// A value in a message.
fn written(value: &DeValue) -> String {
    match value {
        DeValue::String(text) => shortened(text),
        DeValue::Boolean(value) => value.to_string(),
        value => number(value).map_or(String::new(), in_message),
    }
}

/// The number that a value is.
fn number(value: &DeValue) -> Option<f64> {
    match value {
        DeValue::Float(number) => number.as_str().replace('_', "").parse().ok(),
        DeValue::Integer(number) => {
            i64::from_str_radix(&number.as_str().replace('_', ""), number.radix()).ok().map(|number| number as f64)
        }
        _ => None,
    }
}

/// The tables in which a rule looks for its keys.
struct Seen<'a> {
    scene: &'a DeTable<'a>,
    /// The table of the laws that are chosen, in place of that of the scene.
    law: Option<&'a DeTable<'a>>,
    contact: Option<&'a toml::Spanned<DeValue<'a>>>,
    /// The table of a body that is looked at for itself.
    body: Option<&'a DeTable<'a>>,
    /// The names of all materials.
    materials: &'a [&'a str],
}

/// What a scene has.
struct Found<'a> {
    span: Range<usize>,
    value: &'a DeValue<'a>,
    /// Whether a contact has it for itself.
    is_own: bool,
}

/// The value at this `path` below a table.
fn below<'a>(table: &'a DeTable<'a>, path: &[String]) -> Option<&'a toml::Spanned<DeValue<'a>>> {
    let (first, rest) = path.split_first()?;
    let value = table.get(first.as_str())?;
    if rest.is_empty() { Some(value) } else { below(value.get_ref().as_table()?, rest) }
}

fn contacts<'a>(scene: &'a DeTable<'a>) -> impl Iterator<Item = &'a toml::Spanned<DeValue<'a>>> {
    scene.get("contact").and_then(|contacts| contacts.get_ref().as_array()).into_iter().flatten()
}

impl<'a> Seen<'a> {
    /// The first of the keys that it has as wanted, and what it has.
    fn find_any<'b>(&self, keys: &'b [Key]) -> Option<(&'b Key, Found<'a>)> {
        keys.iter().find_map(|key| self.find(key).map(|found| (key, found)))
    }

    /// What is as the `key` wants it, whether or not that is negated.
    fn find(&self, key: &Key) -> Option<Found<'a>> {
        let path = key.path.as_slice();
        let own = |path: &[String]| below(self.contact?.get_ref().as_table()?, path);
        let of_scene = |path: &[String]| match (self.law, path) {
            (Some(law), [first, rest @ ..]) if first == "law" && !rest.is_empty() => below(law, rest),
            _ => below(self.scene, path),
        };
        let part = |value: &'a toml::Spanned<DeValue<'a>>| key.part(value);
        let (value, is_own) = match (self.body, path[0].as_str(), &path[1..]) {
            (Some(table), ..) => (below(table, path).and_then(part), self.contact.is_some()),
            (_, "contact", []) => (self.contact, true),
            (_, "contact", path) => (own(path).and_then(part), true),
            (_, "contacts", path) => {
                let mut all = contacts(self.scene).filter_map(|contact| below(contact.get_ref().as_table()?, path));
                (all.find_map(part), false)
            }
            _ if key.level() == Level::Body => match own(path) {
                Some(value) => (part(value), true),
                None => (of_scene(path).and_then(part), false),
            },
            _ => (of_scene(path).and_then(part), false),
        };
        let value = value?;
        // the first of several tables stands for all
        let first = value.get_ref().as_array().and_then(|list| list.first()).filter(|first| first.get_ref().is_table());
        Some(Found { span: first.unwrap_or(value).span(), value: value.get_ref(), is_own })
    }
}

/// The first number of a `scene` out of its range, otherwise the first rule that it breaks. `materials` are the names of all materials.
pub fn check(scene: &DeTable<'_>, materials: &[&str]) -> Result<(), Mistake> {
    check_ranges(scene, "", "")?;
    check_rules(scene, None, materials)
}

/// The first rule about its laws that a `scene` breaks if, where it names none, it has the `loading` law.
pub fn check_chosen(scene: &DeTable<'_>, loading: &str) -> Result<(), Mistake> {
    check_rules(scene, Some(&chosen(scene, loading)), &[])
}

/// The table of the laws of a `scene` whose loading law, if it names none, is `loading`, with the unloading law that goes with it.
fn chosen<'a>(scene: &DeTable<'a>, loading: &str) -> DeTable<'a> {
    let mut law = scene.get("law").and_then(|law| law.get_ref().as_table()).cloned().unwrap_or_default();
    let mut add = |key: &'static str, name: String| {
        if !law.contains_key(key) {
            law.insert(toml::Spanned::new(0..0, key.into()), toml::Spanned::new(0..0, DeValue::String(name.into())));
        }
        law.get(key).map_or(String::new(), |name| written(name.get_ref()))
    };
    let loading = add("loading", loading.into());
    if list("PLASTIC").contains(&loading.as_str()) {
        add("unloading", pairing::default_unloading(&loading).into());
    }
    law
}

/// The first rule that a `scene` breaks: of those about the laws that are chosen, in this table, or of the others.
fn check_rules(scene: &DeTable<'_>, law: Option<&DeTable<'_>>, materials: &[&str]) -> Result<(), Mistake> {
    for rule in RULES.iter().filter(|rule| !rule.message.is_empty() && rule.chosen == law.is_some()) {
        let looks_at = |contact| {
            let seen = Seen { scene, law, contact, body: None, materials };
            let Some(body) = &rule.body else { return rule.broken(&seen) };
            let table = match contact {
                Some(contact) => below(contact.get_ref().as_table()?, std::slice::from_ref(body)),
                None => scene.get(body.as_str()),
            };
            rule.broken(&Seen { body: Some(table?.get_ref().as_table()?), ..seen })
        };
        let is_of_contacts = |key: &Key| key.level() != Level::Scene || key.path == ["contact"];
        let each = || contacts(scene).map(Some).find_map(looks_at);
        let broken = match &rule.body {
            Some(_) => looks_at(None).or_else(each),
            None if rule.keys().any(is_of_contacts) && scene.contains_key("contact") => each(),
            None => looks_at(None),
        };
        if let Some(mistake) = broken {
            return Err(mistake);
        }
    }
    Ok(())
}

/// What a scene can't have as it is.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Closed {
    pub why: String,
    /// The keys that it has against it.
    pub by: Vec<String>,
}

/// What a `scene` can't have beside what it has, by key or `key=value`. Its loading law is `loading` if it names none.
pub fn closed(scene: &DeTable<'_>, loading: &str) -> BTreeMap<String, Closed> {
    let chosen = chosen(scene, loading);
    let mut closed = BTreeMap::new();
    for rule in RULES.iter().filter(|rule| !rule.message.is_empty()) {
        let law = Some(&chosen).filter(|_| rule.chosen);
        let body = rule.body.as_ref().map(|body| scene.get(body.as_str()).and_then(|body| body.get_ref().as_table()));
        let contact = contacts(scene).next().filter(|_| body.is_none());
        if let Some(None) = body {
            continue;
        }
        for (key, why) in rule.closes(&Seen { scene, law, contact, body: body.flatten(), materials: &[] }) {
            closed.entry(key).or_insert(why);
        }
    }
    closed
}

/// The keys of the table of laws that don't go with a loading law, and those that it needs.
pub fn of_law(name: &str) -> [Vec<String>; 2] {
    let text = format!("law.loading = {name:?}");
    let tree = DeTable::parse(&text).expect("a name is a text");
    let closed = closed(tree.get_ref(), name).into_keys();
    let closed = closed.map(|key| key.split('=').next().unwrap_or_default().to_string());
    let is_of_it =
        |key: &Key| key.path == ["law", "loading"] && matches!(&key.is, Is::In(names) if names.contains(&name.into()));
    let needing = RULES.iter().filter(|rule| !rule.forbids && rule.when.iter().all(|keys| keys.iter().any(is_of_it)));
    let needed = needing.flat_map(|rule| &rule.what).map(|key| key.path.join("."));
    let of_laws = |keys: &mut dyn Iterator<Item = String>| {
        keys.filter_map(|key| key.strip_prefix("law.").map(String::from)).filter(|key| key != "loading").collect()
    };
    [of_laws(&mut closed.into_iter()), of_laws(&mut needed.into_iter())]
}

/// Numbers whose range depends on more than their key.
const RANGED_ELSEWHERE: [&str; 3] = ["elastic_restitution", "inertia", "tangent_modulus"];

/// Rejects a number out of its range in the table `name` of a scene, whose keys have `owner` before them.
fn check_ranges(table: &DeTable, name: &str, owner: &str) -> Result<(), Mistake> {
    table.iter().try_for_each(|(key, value)| {
        let key: &str = key.get_ref();
        match value.get_ref() {
            DeValue::Table(_) if key.ends_with("_parameters") => Ok(()),
            DeValue::Table(table) => check_ranges(table, key, &format!("{owner}{key}.")),
            DeValue::Array(list) => list.iter().filter_map(|item| item.get_ref().as_table()).try_for_each(|table| {
                let own = table.get("name").and_then(|own| own.get_ref().as_str()).unwrap_or_default();
                match key {
                    "contact" => check_ranges(table, key, &format!("{}.", shortened(own))),
                    "body" => check_ranges(table, key, &format!("body `{}`: ", shortened(own))),
                    // materials are checked where they are read
                    _ => Ok(()),
                }
            }),
            number_or_text => match number(number_or_text).filter(|_| !RANGED_ELSEWHERE.contains(&key)) {
                Some(number) => {
                    let Quantity { unit, allowed } = quantity_of(name, key);
                    check_range((key, unit.unwrap_or("")), owner, &Spanned::new(value.span(), number), allowed)
                }
                None => Ok(()),
            },
        }
    })
}
