use brinell::parts::{facts, readings};
use brinell_exporter::scene::Scene;
use std::path::Path;

#[test]
fn a_strength_from_a_reading_is_told_with_its_deviation() {
    for reading in ["180 HBW 10/3000", "60,5 HRC", "350 HV10", "700 HLD"] {
        let text = format!(
            "name = \"a\"\nimpactor = {{ radius = \"5 mm\" }}\ntarget = {{ material = \"mild steel\", hardness = \"{reading}\" }}\n"
        );
        let scene = Scene::parse(text, Path::new("a.toml")).expect("a scene");
        let told = facts(&scene).into_iter().find(|(name, _)| *name == "Target's strength from").expect("a fact").1;
        assert!(told.starts_with(reading) && told.contains('\u{b1}'), "{told}");
        let sentence = readings(&scene).concat();
        assert!(sentence.contains(&format!("{reading} is a flow stress of")), "{sentence}");
        let deviation = told.split_once("\u{b1} ").expect("a deviation").1;
        assert!(sentence.contains(&format!("standard deviation {deviation}")), "{sentence}");
    }
}
