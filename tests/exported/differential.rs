//! Random scenes of all features, each played as random histories of calls in every way that there is: the library of the FMU through C, its
//! instance in Rust, a compiled library, and one that is restored again and again. All answers are the same to the bit.
//!
//! `BRINELL_LONG=1` takes four times as many scenes, and a hundred compiled ones. C source: `tests/platforms/c_source.rs`.

mod in_rust;

use crate::histories::{Both, ByC, Tally, play};
use crate::kinds::{any_scene, of_each_kind};
use crate::loaded::Unit;
use crate::physics::Random;
use crate::prebuilt::{self, export_by_kind, store};
use crate::unit;
use brinell_exporter::scene::Scene;
use brinell_testing::long;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// So many random scenes that are right.
pub fn scenes(seed: u64, count: usize) -> impl Iterator<Item = (String, Scene)> {
    let mut random = Random(seed);
    let right = std::iter::from_fn(move || Some(any_scene(&mut random)));
    right.filter_map(|text| Some((text.clone(), Scene::parse(text, Path::new("any.toml")).ok()?))).take(count)
}

#[test]
fn any_scene_gives_the_same_bits_by_c_in_rust_and_after_any_detour() {
    let (mut kinds, mut tally) = (BTreeMap::new(), Tally::default());
    let chosen = of_each_kind().into_iter().map(|(_, text)| {
        let scene = Scene::parse(text.clone(), Path::new("chosen.toml")).expect("it is right");
        (text, scene)
    });
    for (place, (text, scene)) in chosen.chain(scenes(2026, long::cases(240) as usize)).enumerate() {
        println!("{place}:\n{text}");
        let (fmu, kind) = export_by_kind(&text, store());
        let unit = Unit::open(&fmu);
        for history in 0..2 {
            let (in_rust, own_kind) = in_rust::of(&scene);
            assert_eq!(own_kind, kind);
            let ways: Vec<Box<dyn crate::histories::Way>> =
                vec![Box::new(ByC::new(&unit, false)), Box::new(ByC::new(&unit, true)), in_rust];
            play(&unit.face, ways, 60, &mut Random((2 * place + history) as u64), &mut tally);
        }
        *kinds.entry(kind).or_insert(0) += 1;
    }
    println!("{kinds:?}, {tally:?}");
    assert_eq!(kinds.keys().cloned().collect::<BTreeSet<_>>(), prebuilt::names(store()));
    assert!(tally.messages > 100 && tally.pushed > 1000, "{tally:?}: little was compared");
}

/// Scenes of the repository, whose libraries other tests compile, too; in a usual run chosen ones of the kinds that are left, and random ones.
#[test]
fn a_compiled_library_gives_the_same_bits_and_messages_as_a_prebuilt_one() {
    let (mut random, mut kinds, mut messages) = (Random(14), BTreeSet::new(), 0);
    let mut compare = |text: &str, kinds: &mut BTreeSet<String>| {
        let both = Both::of(text, store());
        messages += (0..if long::is_asked() { 10 } else { 3 }).map(|_| both.compare(100, &mut random)).sum::<usize>();
        kinds.insert(both.kind);
    };
    for scene in unit::scenes_to_compile() {
        compare(&fs::read_to_string(scene).expect("a scene file"), &mut kinds);
    }
    for (expected, text) in of_each_kind() {
        if !kinds.contains(expected) || long::is_asked() {
            compare(&text, &mut kinds);
        }
    }
    for (text, _) in scenes(31, if long::is_asked() { 100 } else { 2 }) {
        println!("{text}");
        compare(&text, &mut kinds);
    }
    assert_eq!(kinds, prebuilt::names(store()));
    assert!(messages > 150, "{messages} messages were compared");
}
