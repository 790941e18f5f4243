//! The texts of an FMU in its model description and on its documentation page must be true for its kind.

use crate::loaded::{ERROR, Instance, Unit};
use crate::unit::{self, write_scene};
use std::fs;
use std::path::{Path, PathBuf};

/// A scene of a steel ball with these additional lines.
fn scene(name: &str, more: &str) -> PathBuf {
    let text =
        format!("name = \"{name}\"\nimpactor = {{ radius = 5e-3 }}\ntarget = {{ material = \"mild steel\" }}\n{more}");
    write_scene(name, &text)
}

/// The model description and the page of the FMU of `scene`.
fn texts(scene: &Path) -> (String, String) {
    let library = unit::library(&unit::export(scene));
    let root = library.ancestors().nth(3).expect("binaries/PLATFORM/LIBRARY");
    let read = |name| fs::read_to_string(root.join(name)).expect("unpacked beside the library");
    (read("modelDescription.xml"), read("documentation/index.html"))
}

/// The element of the variable `name` up to its end.
fn variable<'a>(xml: &'a str, name: &str) -> &'a str {
    let elements = xml.split("<ScalarVariable ").skip(1);
    let mut named = elements.filter(|element| element.starts_with(&format!("name=\"{name}\"")));
    named.next().unwrap_or_else(|| panic!("no {name} in {xml}")).split("</ScalarVariable>").next().unwrap()
}

/// The row of the variable `name` in the table of the page.
fn row<'a>(page: &'a str, name: &str) -> &'a str {
    let (_, row) = page.split_once(&format!("<tr><td><code>{name}</code>")).expect("a row for each variable");
    row.split("</tr>").next().unwrap()
}

const MASS_KNOWN: &str =
    "fmu = { outputs = [\"mean_force\", \"predicted_force\"] }\ncoupling = { effective_mass = 4e-3 }\n";

/// Whether both texts about a variable have these words.
fn say(scene: &Path, name: &str, words: &[&str], not: &[&str]) {
    let (xml, page) = texts(scene);
    for text in [variable(&xml, name), row(&page, name)] {
        assert!(words.iter().all(|words| text.contains(words)), "nothing of {words:?} in {text}");
        assert!(!not.iter().any(|words| text.contains(words)), "{not:?} in {text}");
    }
}

#[test]
fn each_kind_of_fmu_says_what_the_rate_is_and_what_to_do_with_the_force() {
    let plain = scene("plain_words", "");
    say(&plain, "indentation_rate", &["held over a step, or a polynomial in time"], &[]);
    let (_, page) = texts(&plain);
    assert!(page.contains("fmi2SetRealInputDerivatives") && !page.contains("mean_force"), "{page}");
    let massive = scene("mass_words", MASS_KNOWN);
    say(&massive, "indentation_rate", &["at the start of a step", "first input derivative"], &["held over a step"]);
    say(&massive, "mean_force", &["applied to the bodies over that step"], &[]);
    let (_, page) = texts(&massive);
    for part in ["fmi2SetRealInputDerivatives", "acceleration by all other forces", "apply <code>mean_force</code>"] {
        assert!(page.contains(part), "nothing of {part} in {page}");
    }
    let damped = scene("damped_words", "law = { loading = \"tsuji\", restitution = 0.5 }\n");
    say(&damped, "effective_mass", &["for which the damping of the law is designed"], &[]);
    let (xml, page) = texts(&damped);
    assert!(variable(&xml, "indentation_rate").contains("held over a step\"") && !xml.contains("derivative are set"));
    assert!(!page.contains("fmi2SetRealInputDerivatives") && page.contains("follows the rate at the same instant"));
}

/// They are a twentieth of the library.
#[test]
fn an_fmu_without_input_derivatives_is_smaller_and_names_the_key() {
    let with = unit::scene("steel_ball");
    let text = fs::read_to_string(&with).expect("a scene file");
    let without = write_scene("steel_ball", &text.replacen("[fmu]", "[fmu]\ninput_derivatives = false", 1));
    let (xml, page) = texts(&without);
    assert!(
        xml.contains(" canInterpolateInputs=\"false\"") && xml.contains(" maxOutputDerivativeOrder=\"2\""),
        "{xml}"
    );
    for text in [variable(&xml, "indentation_rate"), &page] {
        assert!(text.contains("held over a step") && !text.contains("olynomial in time"), "{text}");
    }
    assert!(!page.contains("fmi2SetRealInputDerivatives"), "{page}");
    let size = |scene: &Path| fs::metadata(unit::library(&unit::compiled(scene))).unwrap().len();
    assert!(size(&without) + 2500 < size(&with), "{} and {}", size(&without), size(&with));
    let unit = Unit::load(&without);
    let mut instance = unit.ready();
    let rate = instance.real_of("indentation_rate");
    assert_eq!(instance.set_derivatives(&[rate], 1, &[1.0]), ERROR);
    let said = instance.message();
    assert!(said.ends_with("have no derivatives: its scene has input_derivatives = false"), "{said}");
}

/// A call of a unit that is refused: `1`, `2`, `3` and `by` set derivatives of this order of a variable, or ask for one by it.
const REFUSED: &str = "\
oblique set tangential_rate nan: tangential_rate = NaN is not finite
oblique set indentation_rate inf: indentation_rate = infinity is not finite
oblique set tangential_rate -2e40: tangential_rate = -2e40 is out of range: allowed is -1e40 to 1e40 m/s
oblique parameter friction.coefficient 10.1: friction.coefficient = 10.1 is out of range: allowed is 0 to 10
oblique parameter friction.coefficient -1e-3: friction.coefficient = -0.001 is out of range: allowed is 0 to 10
oblique set tangential_force 1: an output can't be set
oblique 3 tangential_rate 1: there is no derivative of order 3: allowed is 1 or 2
oblique 1 tangential_rate nan: a derivative of tangential_rate = NaN is not finite
oblique 1 tangential_rate 1e50: a derivative of tangential_rate = 1e50 is out of range: allowed is -1e40 to 1e40 m/s^2
oblique 1 tangential_force 1: only derivatives of indentation_rate and tangential_rate exist
oblique by tangential_force 1: only derivatives by indentation_rate and tangential_rate exist
steel_ball 2 indentation_rate -1e41: a derivative of indentation_rate = -1e41 is out of range: allowed is -1e40 to 1e40 m/s^3
steel_ball 1 force 1: only derivatives of indentation_rate exist
steel_ball by target.yield_strength 1: only derivatives by indentation_rate exist
mass_known 2 indentation_rate 1: there is no derivative of order 2: allowed is 1
wired set external_acceleration nan: external_acceleration = NaN is not finite
wired set external_acceleration 1e305: external_acceleration = 1e305 is out of range: allowed is -1e40 to 1e40 m/s^2
wired 1 indentation_rate 9.81: inputs of this FMU have no derivatives: external_acceleration is the input for the acceleration
damped 1 indentation_rate 9.81: inputs of this FMU have no derivatives: its law depends on the rate
";

#[test]
fn a_refused_call_is_told_with_the_variable_its_value_and_what_is_allowed() {
    for line in REFUSED.lines() {
        let (call, words) = line.split_once(": ").expect("a call and what is said");
        let [scene, what, name, value] = call.split(' ').collect::<Vec<_>>()[..] else { panic!("{call}") };
        let unit = Unit::load(&unit::scene(scene));
        let mut instance: Instance = if what == "parameter" { unit.instantiate() } else { unit.ready() };
        let (variable, value) = ([instance.real_of(name)], [value.parse().expect("a number")]);
        let status = match what {
            "set" | "parameter" => instance.set(&variable, &value),
            "by" => instance.directional(&[instance.real_of("force")], variable[0], &mut [0.0]),
            order => instance.set_derivatives(&variable, order.parse().expect("an order"), &value),
        };
        let said = instance.take_message();
        assert!(status == ERROR && said.contains(words), "{call}: {said}");
    }
}

/// Stronge's law is above Hertz's just after yield, and returns more energy than it took; its dents may be above the surface.
#[test]
fn the_claim_that_dissipated_energy_never_falls_is_made_only_where_it_holds() {
    let outputs = "fmu = { outputs = [\"dissipated_energy\", \"residual_indentation\"] }\n";
    let more = "return more energy than they took";
    let makes = scene("energy_made", &format!("{outputs}law = {{ loading = \"stronge\" }}\n"));
    say(&makes, "dissipated_energy", &["may be negative"], &["never falls"]);
    let (xml, page) = texts(&makes);
    let dent = variable(&xml, "residual_indentation");
    assert!(!dent.contains(" min=") && dent.contains("above the original surface") && page.contains(more), "{dent}");
    let passive = scene("energy_kept", &format!("{outputs}law = {{ loading = \"big-alabo\" }}\n"));
    assert!(variable(&texts(&passive).0, "residual_indentation").contains(" min=\"0"), "no dent above the surface");
    let outputs = "fmu = { outputs = [\"dissipated_energy\"] }\n";
    let heats = scene("heat", &format!("{outputs}law = {{ loading = \"tsuji\", restitution = 0.5 }}\n"));
    for scene in [passive, heats] {
        say(&scene, "dissipated_energy", &["never falls"], &[]);
        assert!(!texts(&scene).1.contains(more));
    }
}

#[test]
fn an_elastic_fmu_has_no_yield_strength_in_its_description() {
    let (xml, _) = texts(&unit::scene("elastic"));
    assert!(texts(&unit::scene("steel_ball")).0.contains("yield_strength") && !xml.contains("yield"), "{xml}");
}

/// Bodies given only by a contact were described as a rigid sphere and a half-space, and their constants were missing.
#[test]
fn the_page_of_an_fmu_knows_the_bodies_and_constants_of_each_contact() {
    let text = "name = \"own_bodies\"\ntarget = { material = \"mild steel\" }\nfmu = { parameters = [] }\n\
                [[contact]]\nname = \"left\"\nimpactor = { radius = 4e-3, youngs_modulus = 7e10, poissons_ratio = 0.22 }\n\
                [[contact]]\nname = \"bead\"\ncount = 3\nimpactor = { radius = 2e-3 }\ntarget = { radius = -0.5 }\n";
    let (_, page) = texts(&write_scene("own_bodies", text));
    let rows = [
        "<code>left</code></td><td>an elastic sphere and a half-space</td><td>impactor.radius = 4 mm",
        "<code>bead[1..3]</code></td><td>a rigid sphere and a spherical socket</td><td>impactor.radius = 2 mm",
        "<code>left.impactor.youngs_modulus</code></td><td class=\"n\">70 GPa</td>",
        "<code>bead.target.radius</code></td><td class=\"n\">-500 mm</td>",
        "on the first contact, <code>left</code>",
    ];
    for row in rows {
        assert!(page.contains(row), "nothing of {row} in {page}");
    }
    let (_, page) = texts(&unit::scene("everything"));
    assert!(page.contains("contact of an elastic sphere and a spherical socket"), "{page}");
}

#[test]
fn the_author_of_a_scene_is_that_of_its_fmu_and_without_one_there_is_none() {
    let author = |scene: &Path| {
        let xml = texts(scene).0;
        let (head, _) = xml.split_once("<CoSimulation").expect("an FMU for co-simulation");
        head.split_once(" author=\"").map(|(_, rest)| rest.split('"').next().unwrap_or_default().to_string())
    };
    let text = "author = \"Zoë & Co.\"\nname = \"with_author\"\nimpactor = { radius = 5e-3 }\ntarget = { material = \"mild steel\" }\n";
    assert_eq!(author(&write_scene("with_author", text)).as_deref(), Some("Zoë &amp; Co."));
    assert_eq!(author(&scene("without_author", "")), None);
}

/// Pages had 1.25606e-5 m, a white picture in the dark, corners in the curves, and names of files of the sources.
#[test]
fn the_page_of_an_fmu_is_written_for_readers() {
    for name in ["steel_ball", "mass_known", "damped", "slope", "everything"] {
        let (_, page) = texts(&unit::scene(name));
        // the lines of Python have the numbers of Python
        let (before, code) = page.split_once("<pre>").expect("lines that run the FMU");
        let page = format!("{before}{}", code.split_once("</pre>").expect("their end").1);
        let (text, style) = (page.split("<svg").next().unwrap(), page.split("</style>").next().unwrap());
        let (_, rest) = page.split_once("</svg>").expect("a picture");
        for numbers in [text, rest] {
            let exponent = |word: &str| word.contains('e') && word.parse::<f64>().is_ok();
            let plain = numbers.replace(['<', '>', '(', ')'], " ");
            assert_eq!(
                plain.split_whitespace().find(|word| exponent(word.trim_end_matches([',', '.']))),
                None,
                "{name}"
            );
            for path in ["crates/", "data/", ".rs", ".toml"] {
                assert!(!numbers.contains(path), "{name}: {path} in {numbers}");
            }
        }
        assert!(style.contains("prefers-color-scheme: dark") && !page.contains("[um]") && page.contains("[\u{b5}m]"));
        for line in page.split(" points=\"").skip(1).map(|rest| rest.split('"').next().unwrap()) {
            let number = |text: &str| text.parse::<f64>().expect("a number");
            let points = line.split_whitespace().map(|point| point.split_once(',').expect("x and y"));
            let points: Vec<_> = points.map(|(x, y)| (number(x), number(y))).collect();
            for [a, b, c] in points.array_windows() {
                let (x, y) = (c.0 - a.0, c.1 - a.1);
                // the picture is drawn eight times as large
                let corner = (x * (b.1 - a.1) - y * (b.0 - a.0)).abs() / x.hypot(y).max(1.0) / 8.0;
                assert!(corner < 0.5, "{name}: a corner of {corner} pixels");
            }
        }
    }
    let (_, page) = texts(&unit::scene("steel_ball"));
    for cell in [
        "330.7 N",
        "12.56 \u{b5}m",
        "29.85 \u{b5}s",
        "0.4463",
        "206 GPa",
        "5 mm",
        "10<sup>\u{2212}12</sup> to 10<sup>9</sup>",
    ] {
        assert!(page.contains(&format!("<td class=\"n\">{cell}</td>")), "nothing of {cell} in {page}");
    }
    assert!(page.contains("<p>4.11 g at 1 m/s;"), "{page}");
}

/// Step size and stop time \[s\] that the model description of the FMU of `scene` suggests.
fn experiment(scene: &Path) -> (f64, f64) {
    let xml = texts(scene).0;
    let (_, element) = xml.split_once("<DefaultExperiment").expect("each FMU suggests times");
    let value = |name: &str| {
        let (_, rest) = element.split_once(&format!(" {name}=\"")).expect(name);
        rest.split('"').next().unwrap().parse().expect("a number")
    };
    assert_eq!(value("startTime"), 0.0);
    (value("stepSize"), value("stopTime"))
}

/// A unit that is right at any step suggested 1e-7 s, too.
#[test]
fn the_suggested_step_divides_the_contact_unless_the_fmu_knows_the_mass() {
    assert_eq!(experiment(&scene("plain_words", "")), (1e-7, 6e-5));
    // 5 mm at 1 m/s: a tenth of the radius
    assert_eq!(experiment(&scene("mass_words", MASS_KNOWN)), (5e-4, 0.3));
    let impact = "impact = { mass = 4e-3, speed = SPEED }\ncoupling = { effective_mass = 4e-3 }\n";
    assert_eq!(experiment(&scene("mass_fast", &impact.replace("SPEED", "20"))), (2e-5, 1e-2));
    assert_eq!(experiment(&scene("mass_slow", &impact.replace("SPEED", "1e-3"))), (1e-3, 0.5));
    assert_eq!(experiment(&unit::scene("stack")), (1e-3, 0.5));
}

#[test]
fn the_scene_may_give_the_suggested_step_and_stop_time() {
    let mass = "coupling = { effective_mass = 4e-3 }\n";
    for (name, keys, coupling, expected) in [
        ("both_times", "step_size = 2e-3, stop_time = 10", mass, (2e-3, 10.0)),
        ("one_step", "step_size = 0.25, stop_time = 0.25", "", (0.25, 0.25)),
        ("own_step", "step_size = 3e-6", "", (3e-6, 2e-3)),
        ("own_stop", "stop_time = 0.7", "", (1e-7, 0.7)),
        // not more than a five-hundredth
        ("short_stop", "stop_time = 1e-3", mass, (2e-6, 1e-3)),
    ] {
        assert_eq!(experiment(&scene(name, &format!("fmu = {{ {keys} }}\n{coupling}"))), expected, "{name}");
    }
}
