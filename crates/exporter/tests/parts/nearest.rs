use brinell_contact::loading::AnyLoading;
use brinell_exporter::nearest::*;
use brinell_exporter::table::MATERIALS;

#[test]
fn a_mistyped_name_finds_the_one_that_is_meant() {
    let materials = || MATERIALS.iter().map(|material| material.name.as_str());
    for (asked, meant) in [
        ("Mild Steel", Some("mild steel")),
        ("aluminum 6061", Some("aluminium 6061-T6")),
        ("AISI 1018", Some("steel AISI 1018")),
        ("Ti-6Al-4V", Some("titanium Ti-6Al-4V")),
        ("mild_steel", Some("mild steel")),
        ("stainless steel 316", Some("stainless steel 316L, annealed")),
        ("stainless steel 321", None),
        ("steel 1.2379", None),
        ("cheese", None),
        ("", None),
    ] {
        assert_eq!(nearest(asked, materials()), meant, "{asked}");
    }
    let laws = || AnyLoading::ALL.iter().map(|(name, _)| *name);
    for (asked, meant) in
        [("brinel", "brinell"), ("Big-Alabo", "big-alabo"), ("jackson_green", "jackson-green"), ("herz", "hertz")]
    {
        assert_eq!(nearest(asked, laws()), Some(meant));
    }
    assert_eq!(nearest("rubber", laws()), None);
}

#[test]
fn of_many_names_the_nearest_are_listed() {
    let names: Vec<String> = (1..=2000).map(|index| format!("bead_{index}.initial_gap")).collect();
    let said = unknown("parameter", "bead_777.intial_gap", names.iter().map(String::as_str));
    assert!(said.contains("did you mean `bead_777.initial_gap`?") && said.contains("(the nearest of 2000)"), "{said}");
    assert!(said.len() < 500, "{} bytes: {said}", said.len());
    let said = unknown("parameter", &"x".repeat(100_000), names.iter().map(String::as_str));
    assert!(said.len() < 500, "{} bytes: {said}", said.len());
}

#[test]
fn a_name_that_is_there_twice_is_listed_once() {
    assert_eq!(unknown("law", "foo", ["a", "b", "a"].into_iter()), "unknown law `foo`, expected `a` or `b`");
}

/// A wrong letter, one too many or too few, or two swapped: the suggestion is no farther away than the name that was meant.
#[test]
fn any_single_mistyped_letter_finds_a_name_that_is_as_near_as_what_was_meant() {
    let keys = ["impactor", "impact", "target", "law", "fmu", "friction", "coupling", "body", "contact", "material"];
    let keys = keys.into_iter().chain(["youngs_modulus", "yield_strength", "drop_height", "plate_thickness", "mass"]);
    // a wrong digit isn't taken for a mistyped letter
    let laws =
        AnyLoading::ALL.iter().map(|(name, _)| *name).filter(|name| !name.contains(|c: char| c.is_ascii_digit()));
    let keys: Vec<&str> = keys.chain(laws).collect();
    let mut tried = 0;
    for meant in &keys {
        let letters: Vec<char> = meant.chars().collect();
        // the first letter is seldom wrong, and short words have many neighbours
        for place in 1..letters.len() {
            let (before, after) = (&letters[..place], &letters[place + 1..]);
            let spelt = |middle: &[char], after: &[char]| [before, middle, after].concat().iter().collect::<String>();
            let mut wrong = vec![spelt(&[], after), spelt(&['e'], after), spelt(&[letters[place]; 2], after)];
            wrong.extend(after.split_first().map(|(next, after)| spelt(&[*next, letters[place]], after)));
            for asked in wrong.into_iter().filter(|asked| asked != meant && asked.len() > 3) {
                let found = nearest(&asked, keys.iter().copied()).unwrap_or_else(|| panic!("nothing near {asked}"));
                let distance = strsim::osa_distance(&normal(&asked), &normal(found));
                assert!(distance <= 1, "{asked}: {found} for {meant}");
                tried += 1;
            }
        }
    }
    assert!(tried > 500, "{tried}");
    assert_eq!(nearest("impacter", keys.iter().copied()), Some("impactor"));
    assert_eq!(nearest("impac", keys.iter().copied()), Some("impact"));
}

#[test]
fn of_equally_near_names_the_first_is_suggested() {
    assert_eq!(nearest("bearing steel", ["bearing steel, aaaa", "bearing steel, bbbb"]), Some("bearing steel, aaaa"));
}

#[test]
fn every_name_is_nearest_to_itself() {
    for (name, _) in AnyLoading::ALL {
        assert_eq!(nearest(name, AnyLoading::ALL.iter().map(|(name, _)| *name)), Some(name));
    }
}
