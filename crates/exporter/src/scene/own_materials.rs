//! What lies beside a scene: tables of materials of one's own, and files that the scene names. The scene's text takes in what it uses, so
//! that an FMU has the numbers and no file.

use super::quantities::check_quantity;
use crate::layout::shortened;
use crate::measured::{self, Metal};
use crate::mistake::{Mistake, Spanned};
use crate::nearest::{one_of, unknown};
use crate::table::{Class, MATERIALS, Material};
use std::collections::{BTreeMap, HashSet};
use std::fmt::Write;

/// The files that a scene refers to: those that it names, and tables of materials.
#[derive(Default)]
pub struct ReferencedFiles {
    /// The bytes of the files that the scene [names](super::files_named), or why they can't be read.
    pub files: BTreeMap<String, Result<Vec<u8>, String>>,
    /// Tables of materials; the first one that has a name is asked.
    pub materials: Vec<MaterialTable>,
}

/// A table of materials of one's own.
pub struct MaterialTable {
    /// Where it lies, in words without a path: `materials.toml beside the scene`.
    pub place: &'static str,
    pub materials: Vec<Material>,
}

/// A material that isn't built in, and where it is from.
#[derive(Clone, Debug)]
pub struct OwnMaterial {
    pub material: Material,
    place: &'static str,
}

impl OwnMaterial {
    /// A material of the scene's own.
    pub fn of_scene(material: Material) -> OwnMaterial {
        OwnMaterial { material, place: "the scene" }
    }

    /// Where it is from, in a sentence.
    pub fn words(&self) -> String {
        let name = shortened(&self.material.name);
        let built_in = MATERIALS.iter().any(|material| material.is_called(&self.material.name));
        let not = if built_in { ", not the built-in one of this name" } else { "" };
        format!("Material `{name}` is that of {}{not}.", self.place)
    }
}

/// Most materials of one's own that are told one by one.
const TOLD: usize = 8;

/// Where the materials come from that are the scene's `own`, in sentences: of each one that it has `used`, and of the others together.
pub fn words<'a>(used: impl Iterator<Item = &'a Spanned<String>>, own: &[OwnMaterial]) -> Vec<String> {
    // each name once: there may be a hundred thousand contacts, and as many materials
    let asked: BTreeMap<&str, &Spanned<String>> = used.map(|name| (name.get_ref().as_str(), name)).collect();
    let found = asked.into_values().filter_map(|name| find(name, own).ok());
    let found: HashSet<*const Material> = found.map(std::ptr::from_ref).collect();
    let (used, unused): (Vec<_>, Vec<_>) =
        own.iter().partition(|own| found.contains(&std::ptr::from_ref(&own.material)));
    let mut words: Vec<String> = used.iter().take(TOLD).map(|own| own.words()).collect();
    let more = |all: &[&OwnMaterial], count: usize| format!("{count} more materials are of {}.", all[0].place);
    words.extend((used.len() > TOLD).then(|| more(&used[TOLD..], used.len() - TOLD)));
    let name = |own: &OwnMaterial| format!("`{}`", shortened(&own.material.name));
    words.extend(match unused.as_slice() {
        [] => None,
        [only] => Some(format!("Material {} of the scene is used by no body.", name(only))),
        [first, .., last] => Some(format!(
            "{} materials of the scene are used by no body: {} to {}.",
            unused.len(),
            name(first),
            name(last)
        )),
    });
    words
}

/// The materials of these tables, each of which is complete and has a name of its own.
pub fn check(tables: Vec<Spanned<Material>>) -> Result<Vec<Material>, Mistake> {
    let mut names = HashSet::new();
    for table in &tables {
        let material = table.get_ref();
        check_material(table)
            .map_err(|Mistake(span, why)| Mistake(span, format!("material `{}`: {why}", shortened(&material.name))))?;
        if !names.insert(material.name.to_lowercase()) {
            let message = format!("name = \"{}\" is taken by another material", shortened(&material.name));
            return Err(Mistake(table.span(), message));
        }
    }
    Ok(tables.into_iter().map(Spanned::into_inner).collect())
}

fn check_material(table: &Spanned<Material>) -> Result<(), Mistake> {
    let material = table.get_ref();
    let at = |value: f64| Spanned::new(table.span(), value);
    let wrong = |why: String| Err(Mistake(table.span(), why));
    if material.name.trim().is_empty() {
        return wrong("it needs a name".into());
    }
    let numbers = [
        ("youngs_modulus", Some(material.youngs_modulus)),
        ("poissons_ratio", Some(material.poissons_ratio)),
        ("yield_strength", material.yield_strength),
        ("density", Some(material.density)),
        ("tension.coefficient", material.tension.map(|tension| tension.coefficient)),
        ("tension.exponent", material.tension.map(|tension| tension.exponent)),
        ("hardening_exponent", material.hardening_exponent),
    ];
    for (name, value) in numbers {
        value.map(|value| check_quantity(name, "", &at(value))).transpose()?;
    }
    let ways = [material.yield_strength.is_some(), material.tension.is_some(), material.hardness.is_some()];
    if ways.into_iter().filter(|given| *given).count() > 1 {
        return wrong("yield_strength, tension and hardness say the same: give one of them".into());
    }
    let Material { youngs_modulus, poissons_ratio, class, hardening_exponent: exponent, .. } = *material;
    let class = class.unwrap_or(Class::of_modulus(youngs_modulus));
    let metal = Metal { youngs_modulus, poissons_ratio, class, exponent };
    if let Some(Err(why)) = material.hardness.as_ref().map(|hardness| measured::of_hardness(hardness, &metal)) {
        return wrong(format!("hardness: {why}"));
    }
    Ok(())
}

/// Adds to the scene's `all` those materials of the `tables` that it has `used`, and returns them as tables of a scene.
pub fn take_in(used: &[Spanned<String>], all: &mut Vec<OwnMaterial>, tables: &[MaterialTable]) -> String {
    let mut added = String::new();
    for name in used {
        if all.iter().any(|own| own.material.is_called(name.get_ref())) {
            continue;
        }
        let of = |table: &MaterialTable| {
            let mut found = table.materials.iter().filter(|material| material.is_called(name.get_ref()));
            // an exact name first
            let exact = table.materials.iter().find(|material| material.name == *name.get_ref());
            let material = exact.or_else(|| found.next())?.clone();
            Some(OwnMaterial { material, place: table.place })
        };
        let Some(found) = tables.iter().find_map(of) else { continue };
        let table = toml::to_string(&found.material).expect("a table of text and numbers");
        // a table in it has a name of its own
        let table = table.replace("\n[tension]", "\n[material.tension]");
        write!(added, "\n[[material]]\n{table}").expect("a String takes everything");
        all.push(found);
    }
    added
}

/// The material of this name or with this alias: of the scene's `own`, then built in.
pub fn find<'a>(name: &Spanned<String>, own: &'a [OwnMaterial]) -> Result<&'a Material, Mistake> {
    let asked = name.get_ref();
    let exact = own.iter().find(|own| own.material.name == *asked);
    match exact.or_else(|| own.iter().find(|own| own.material.is_called(asked))) {
        Some(found) => Ok(&found.material),
        None => find_built_in(name, own),
    }
}

/// That no material is called `asked`, with the nearest name of all there are.
pub fn no_material(asked: &str, own: &[OwnMaterial]) -> String {
    let own = own.iter().map(|own| own.material.name.as_str());
    unknown("material", asked, own.chain(MATERIALS.iter().map(|material| material.name.as_str())))
}

/// The built-in material of this name, or of an alias that no other has. Messages also name those of one's `own`.
fn find_built_in(name: &Spanned<String>, own: &[OwnMaterial]) -> Result<&'static Material, Mistake> {
    let asked = name.get_ref();
    if let Some(material) = MATERIALS.iter().find(|material| material.name == *asked) {
        return Ok(material);
    }
    let is_it = |alias: &String| alias.eq_ignore_ascii_case(asked.trim());
    let with_alias: Vec<_> = MATERIALS.iter().filter(|material| material.aliases.iter().any(is_it)).collect();
    let message = match with_alias.as_slice() {
        [material] => return Ok(material),
        [] => {
            // a number that is a word of what was asked
            let has = |alias: &String| {
                alias.contains(|c: char| c.is_ascii_digit()) && asked.split(' ').any(|word| word == alias)
            };
            let names = MATERIALS.iter().filter(|material| material.aliases.iter().any(has));
            let names: Vec<_> = names.map(|material| material.name.as_str()).collect();
            match names.as_slice() {
                [] => match with_words(asked).as_slice() {
                    [] | [_] => no_material(asked, own),
                    several => {
                        format!("`{}` may be several materials: say which, {}", shortened(asked), one_of(several))
                    }
                },
                names => format!("unknown material `{}`; its name here is {}", shortened(asked), one_of(names)),
            }
        }
        several => {
            let names: Vec<_> = several.iter().map(|material| material.name.as_str()).collect();
            format!(
                "`{}` has several conditions, whose strengths differ: say which, {}",
                shortened(asked),
                one_of(&names)
            )
        }
    };
    Err(Mistake(name.span(), message))
}

/// The materials with these words in their names, such as `bearing steel`, one behind the other.
fn with_words(asked: &str) -> Vec<&'static str> {
    let words = |name: &str| {
        let words = name.split([' ', ',', '-', '_']).filter(|word| !word.is_empty());
        words.map(str::to_lowercase).collect::<Vec<_>>()
    };
    let asked = words(asked);
    let has = |name: &&str| !asked.is_empty() && words(name).windows(asked.len()).any(|part| part == asked);
    MATERIALS.iter().map(|material| material.name.as_str()).filter(has).collect()
}
