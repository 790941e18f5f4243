//! What keys of a scene forbid or need of others: the list `rules.txt`, read once, and the check of a scene by it. The schema has its rules
//! from the same list.

use super::quantities::{Quantity, quantity_of};
use crate::layout::shortened;
use crate::mistake::{Mistake, Spanned, check_range};
use crate::model::Dampings;
use crate::numbers::in_message;
use crate::table::{self, Causality, Variable};
use brinell_contact::damped::{AnyDamped, Damped};
use brinell_contact::loading::AnyLoading;
use brinell_contact::unloading::AnyUnloading;
use std::ops::Range;
use std::sync::LazyLock;
use toml::de::{DeTable, DeValue};

/// The rules in the order in which they are told.
pub static RULES: LazyLock<Vec<Rule>> = LazyLock::new(|| read(include_str!("rules.txt")));

/// The bodies of a contact, as tables of a scene.
pub const BODIES: [&str; 2] = ["impactor", "target"];

/// The keys of bodies that no contact has for itself.
pub const OF_ALL_CONTACTS: [&str; 5] = ["rate", "plate_thickness", "shape", "thickness", "base"];

/// The lists of names in the rules.
fn list(name: &str) -> Vec<&'static str> {
    let damped = |is: fn(&AnyDamped) -> bool| {
        AnyDamped::ALL.iter().filter(move |(_, law)| is(law)).map(|(name, _)| *name).collect::<Vec<_>>()
    };
    let plastic = |is: fn(&AnyLoading) -> bool| {
        let laws = AnyLoading::ALL.iter().filter(move |(name, law)| *name != "hertz" && is(law));
        laws.map(|(name, _)| *name).collect::<Vec<_>>()
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
        "UNGUARDED" => {
            AnyUnloading::ALL.iter().filter(|(_, law)| law.guarded().is_none()).map(|(name, _)| *name).collect()
        }
        "FRICTIONLESS" => {
            let laws = table::unloading_laws().into_iter().filter(|law| law.no_friction.is_some());
            laws.map(|law| law.name.as_str()).collect()
        }
        "OF_SHARED" => outputs(|output| table::OF_SHARED.contains(&output.name.as_str())),
        "OF_FRICTION" => outputs(|output| output.friction),
        other => panic!("{other} is no list of names"),
    }
}

/// What some keys of a scene forbid or need of others.
pub struct Rule {
    /// The body in whose tables its keys are.
    pub body: Option<String>,
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

fn read(text: &str) -> Vec<Rule> {
    let (mut rules, mut heads, mut message) = (Vec::new(), Vec::new(), String::new());
    for line in text.lines().filter(|line| !line.starts_with('#')).chain(["end"]) {
        if let Some(words) = line.strip_prefix("    ") {
            message = format!("{message} {words}").trim().into();
            continue;
        }
        if !message.is_empty() || line == "end" {
            for head in heads.drain(..) {
                let message = &message;
                let of = |body: &str| Rule::read(&str::replace(head, "*", body), &message.replace('*', body));
                let bodies: &[&str] = if head.contains('*') { &BODIES } else { &[""] };
                rules.extend(bodies.iter().map(|body| of(body)));
            }
            message.clear();
        }
        heads.extend(Some(line).filter(|line| !line.is_empty()));
    }
    rules
}

impl Rule {
    fn read(head: &str, message: &str) -> Rule {
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
        Rule { body, when: when.collect(), forbids, what: any(what), at, message: message.into() }
    }

    fn keys(&self) -> impl Iterator<Item = &Key> {
        self.when.iter().flatten().chain(&self.what)
    }

    /// The mistake of what is seen, if it is against the rule.
    fn broken(&self, seen: &Seen) -> Option<Mistake> {
        let mut last = None;
        for any in &self.when {
            let found = any.iter().find_map(|key| seen.find(key).map(|found| (key, found)));
            match (found, any[0].no) {
                (Some(found), false) => last = Some(found),
                (None, true) => {}
                _ => return None,
            }
        }
        let found = self.what.iter().find_map(|key| seen.find(key).map(|found| (key, found)));
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
        Some(Mistake(place.unwrap_or(0..0), owner + &self.filled(seen, told.as_ref())))
    }

    /// Its message with the names and values of what is `told`.
    fn filled(&self, seen: &Seen, told: Option<&(&Key, Found)>) -> String {
        let mut parts = self.message.split(['{', '}']);
        let mut text = parts.next().unwrap_or_default().to_string();
        while let (Some(name), Some(rest)) = (parts.next(), parts.next()) {
            text += &match (name, told) {
                ("MATERIALS", _) => seen.materials.join("`, `"),
                ("key", Some((key, _))) => key.path[usize::from(key.path[0] == "contact")..].join("."),
                ("value", Some((_, found))) => written(found.value),
                (name, _) if is_list(name) => list(name).join("\", \""),
                (name, _) => Key::read(name)
                    .iter()
                    .find_map(|key| seen.find(key))
                    .map_or(String::new(), |found| written(found.value)),
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
    /// What is as the `key` wants it, whether or not that is negated.
    fn find(&self, key: &Key) -> Option<Found<'a>> {
        let path = key.path.as_slice();
        let own = |path: &[String]| below(self.contact?.get_ref().as_table()?, path);
        let of_scene = |path: &[String]| below(self.scene, path);
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
    for rule in RULES.iter().filter(|rule| !rule.message.is_empty()) {
        let looks_at = |contact| {
            let seen = Seen { scene, contact, body: None, materials };
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
