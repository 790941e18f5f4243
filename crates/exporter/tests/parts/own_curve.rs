//! Tables of known laws give the motion of these laws; what is not passive is refused; a scene takes its file in.

use brinell_contact::impact::{Impact, predict};
use brinell_contact::loading::AnyLoading;
use brinell_contact::unloading::{self, AnyUnloading};
use brinell_contact::{Body, Loading, Model, Numbered, OtherBody, Pair, Surface, TwoBodies};
use brinell_exporter::own_curve::*;
use brinell_exporter::scene::{ReferencedFiles, Scene};
use brinell_testing::physics::Random;
use std::collections::BTreeMap;
use std::path::Path;

type AnyModel = Model<AnyLoading, AnyUnloading>;

fn pair() -> Pair {
    Pair::new(&Body::rigid(5e-3), &Body::flat(206e9, 0.3), 300e6).unwrap()
}

fn model(loading: AnyLoading, unloading: AnyUnloading) -> AnyModel {
    Model { pair: pair(), loading, unloading, surface: Surface::Dented }.prepared()
}

/// The law of this name with an unloading by its contact radius.
fn of(name: &str) -> AnyModel {
    let (_, loading) = AnyLoading::ALL.into_iter().find(|(known, _)| *known == name).unwrap();
    model(loading, AnyUnloading::ContactRadius(unloading::ContactRadius))
}

/// Three hundred yield depths \[m\].
fn deepest() -> f64 {
    300.0 * pair().yield_point(1.1).indentation
}

/// Rows of the law, in equal steps of the depth to some power.
fn sampled(model: &AnyModel, count: usize, power: f64) -> Rows {
    let depth: Vec<_> = (1..=count).map(|row| deepest() * (row as f64 / count as f64).powf(power)).collect();
    let force = depth.iter().map(|d| model.loading.segment(&model.pair, *d).force(*d)).collect();
    let radius = depth.iter().map(|d| model.loading.contact_radius(&model.pair, *d)).collect();
    Rows { lines: (2..).take(count).collect(), depth, force, radius }
}

fn own(rows: &Rows) -> (AnyModel, String) {
    let (law, words) = law(rows, &pair()).unwrap_or_else(|why| panic!("{why}"));
    (model(AnyLoading::Tabulated(law), AnyUnloading::Tabulated(unloading::Tabulated)), words)
}

/// By how much restitution, force, depth and time of an impact differ, whose energy is this part of the work of the known law down to the
/// deepest row.
fn differences(known: &AnyModel, table: &AnyModel, part: f64) -> [f64; 4] {
    let (mass, energy) = (4e-3, known.loading.work(&known.pair, part * deepest()));
    let impact = Impact { mass, speed: (2.0 * energy / mass).sqrt() };
    let [one, other] = [known, table].map(|model| predict(model, &impact).unwrap());
    [
        other.restitution / one.restitution - 1.0,
        other.max_force / one.max_force - 1.0,
        other.max_indentation / one.max_indentation - 1.0,
        other.loading_time / one.loading_time - 1.0,
    ]
}

#[test]
fn a_table_of_a_known_law_gives_its_motion() {
    for name in ["hertz", "brinell", "power", "thornton", "big-alabo", "ma-liu", "yigit-christoforou"] {
        let known = of(name);
        for (count, power) in [(20_u32, 1.0), (20, 2.0), (100, 1.0), (100, 2.0), (500, 2.0), (2000, 1.0)] {
            let (table, words) = own(&sampled(&known, count as usize, power));
            assert!(words.contains("rows, force within"), "{words}");
            let from = (1.0 / f64::from(count)).powf(power);
            for part in [0.03, 0.1, 0.3, 0.9].into_iter().filter(|part| *part > 4.0 * from) {
                let found = differences(&known, &table, part);
                // twenty rows say little of the beginning
                let allowed = if count == 20 && part < 0.1 { 0.06 } else { 0.003 };
                let is_near = found.iter().all(|difference| difference.abs() < allowed);
                assert!(is_near, "{name}, {count} rows, energy {part}: {found:?}; {words}");
            }
        }
    }
}

/// Normal noise, of one size or of a part of each force. The guide has this table.
#[test]
fn noise_is_smoothed() {
    let mut random = Random(42);
    let mut normal = move || (-2.0 * (1.0 - random.next()).ln()).sqrt() * (std::f64::consts::TAU * random.next()).cos();
    let mut wrong: Vec<String> = Vec::new();
    // how far an impact down to a tenth, to three and to nine tenths of the deepest row may be off
    const PARTS: [f64; 3] = [0.1, 0.3, 0.9];
    for (count, size, allowed) in [
        (200, 0.001, [0.03, 0.01, 0.005]),
        (2000, 0.001, [0.01, 0.005, 0.005]),
        (200, 0.01, [f64::INFINITY, 0.05, 0.01]),
        (2000, 0.01, [0.05, 0.02, 0.005]),
    ] {
        for name in ["hertz", "brinell", "thornton", "big-alabo", "ma-liu"] {
            let known = of(name);
            for is_part in [false, true].into_iter().cycle().take(8) {
                let mut rows = sampled(&known, count, 1.0);
                let largest = rows.force[count - 1];
                let what = format!("{name}, {count} rows, {size} of {}", if is_part { "each" } else { "the largest" });
                for force in &mut rows.force {
                    *force += size * normal() * if is_part { *force } else { largest };
                }
                let law = law(&rows, &pair()).map(|(law, _)| law);
                let Ok(law) = law.map_err(|why| wrong.push(format!("{what}: {why}"))) else { continue };
                let table = model(AnyLoading::Tabulated(law), AnyUnloading::Tabulated(unloading::Tabulated));
                for (part, allowed) in PARTS.into_iter().zip(allowed) {
                    let found = differences(&known, &table, part);
                    if !found.iter().all(|difference| difference.abs() < allowed) {
                        wrong.push(format!("{what}, {part}: {found:.4?}"));
                    }
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Without the radius of the contact it follows from the depth in contact.
#[test]
fn without_a_radius_the_recovery_follows_from_the_depth_in_contact() {
    let known = of("brinell");
    let rows = Rows { radius: Vec::new(), ..sampled(&known, 500, 2.0) };
    let (table, words) = own(&rows);
    assert!(words.contains("knots through 500 rows"), "{words}");
    for part in [0.01, 0.1, 0.3, 0.9] {
        let [restitution, others @ ..] = differences(&known, &table, part);
        // the contact of finite elements is wider by the pile-up around it
        assert!(restitution.abs() < 0.035, "{part}: {restitution}");
        assert!(others.iter().all(|difference| difference.abs() < 1e-3), "{part}: {others:?}");
    }
}

#[test]
fn an_unloading_of_the_file_is_that_of_the_law() {
    let other = OtherBody { modulus: f64::INFINITY, ..OtherBody::RIGID };
    let bodies = TwoBodies { hardening_modulus: 0.0, curvature: 0.0, other };
    for unloading in ["brinell", "contact-radius", "etsion"] {
        let (_, law) = AnyUnloading::ALL.into_iter().find(|(name, _)| *name == unloading).unwrap();
        let plain = of("brinell");
        let known = model(plain.loading.of_bodies(bodies), law);
        let mut rows = Rows { radius: Vec::new(), ..sampled(&known, 300, 2.0) };
        let end = known.residual_indentation(deepest());
        for step in 1..60 {
            let depth = deepest() + (end - deepest()) * f64::from(step) / 60.0;
            rows.depth.push(depth);
            rows.force.push(known.unloading_segment(deepest(), depth).force(depth));
        }
        rows.lines = (2..).take(rows.depth.len()).collect();
        let (table, words) = own(&rows);
        let at = |part: f64| differences(&known, &table, part);
        assert!(at(0.99).iter().all(|difference| difference.abs() < 1e-3), "{unloading}: {:?}; {words}", at(0.99));
        // what is not in the file follows from it roughly
        assert!([0.1, 0.3].iter().all(|part| at(*part)[0].abs() < 0.06), "{unloading}: {:?}", at(0.1));
    }
}

/// The mistake about these rows.
fn refused(rows: &Rows, pair: &Pair, words: &[&str]) {
    let said = law(rows, pair).map(|(_, words)| words).unwrap_err();
    assert!(words.iter().all(|word| said.contains(word)), "{said}");
}

#[test]
fn what_is_not_passive_is_refused_with_its_place() {
    let rows = sampled(&of("brinell"), 200, 2.0);
    let mut falling = rows.clone();
    falling.force[150..].iter_mut().for_each(|force| *force *= 0.8);
    refused(
        &falling,
        &pair(),
        &["line 1", "is ", " N below that of its neighbours: a loading curve rises; allowed is"],
    );
    let stiff =
        Rows { radius: Vec::new(), force: rows.force.iter().map(|force| 4.0 * force).collect(), ..rows.clone() };
    refused(
        &stiff,
        &pair(),
        &["line 2: ", "would give back", "allowed is", "stiffer than that of a ball of 5 mm radius"],
    );
    let soft = Pair { modulus: 0.1 * pair().modulus, ..pair() };
    refused(&rows, &soft, &["line 2: ", "effective modulus of 22.6"]);
    let narrow = Rows { radius: rows.radius.iter().map(|radius| 0.05 * radius).collect(), ..rows.clone() };
    refused(&narrow, &pair(), &["line ", "would give back"]);
    let mut without = rows.clone();
    without.radius[30] = 0.0;
    refused(&without, &pair(), &["line 32: contact_radius = 0 m under a force: it must be above zero"]);
    let huge = Rows { force: rows.force.iter().map(|force| 1e300 * force).collect(), ..rows.clone() };
    assert!(law(&huge, &pair()).is_err());
    // no curve at all
    let scattered = Rows { force: (0..200).map(|row| if row % 3 == 0 { 90.0 } else { 5.0 }).collect(), ..rows.clone() };
    refused(&scattered, &pair(), &["the forces scatter by ", " % of the largest one from row to row: allowed is 20 %"]);
    // as published it makes energy
    refused(&sampled(&of("johnson"), 100, 2.0), &pair(), &["line ", "would give back", "allowed is"]);
    refused(&sampled(&of("stronge"), 200, 2.0), &pair(), &["line ", "would give back", "allowed is"]);
    refused(&sampled(&of("brinell"), 7, 1.0), &pair(), &["7 rows", "allowed is 8 or more"]);
}

fn scene(file: &str, more: &str) -> Result<Scene, String> {
    let text = format!(
        "name = \"own\"\nimpactor = {{ radius = \"5 mm\" }}\n\
         target = {{ youngs_modulus = \"206 GPa\", poissons_ratio = 0.3 }}\nimpact = {{ mass = 4e-3, speed = 1.0 }}\n\
         law = {{ loading = {{ table = \"fe.csv\" }} }}\n{more}"
    );
    let files = BTreeMap::from([("fe.csv".to_string(), Ok(file.as_bytes().to_vec()))]);
    let beside = ReferencedFiles { files, ..ReferencedFiles::default() };
    Scene::parse_with_files(&text, Path::new("own.toml"), &beside)
        .map(|(scene, _)| scene)
        .map_err(|why| why.to_string())
}

fn csv(heading: &str, rows: &Rows, units: [f64; 3]) -> String {
    let row = |row: usize| {
        let number = |list: &[f64], unit: f64| format!("{:e}", list[row] / unit);
        let [depth, force, radius] = units;
        [number(&rows.depth, depth), number(&rows.force, force), number(&rows.radius, radius)].join(";")
    };
    format!("{heading}\n{}\n", (0..rows.depth.len()).map(row).collect::<Vec<_>>().join("\n"))
}

#[test]
fn a_scene_takes_its_file_in_and_is_then_the_same_without_it() {
    let rows = sampled(&of("brinell"), 200, 2.0);
    let heading = "depth [um];force [kN];contact radius [mm]";
    let found = scene(&csv(heading, &rows, [1e-6, 1e3, 1e-3]), "").unwrap();
    let alone = Scene::parse(found.text.clone(), Path::new("own.toml")).unwrap();
    assert_eq!(alone.laws.loading(), found.laws.loading());
    assert_eq!(alone.predictions, found.predictions);
    let speed = found.predictions[0];
    let known = predict(&of("brinell"), &Impact { mass: 4e-3, speed: 1.0 }).unwrap();
    assert!((speed.max_force / known.max_force - 1.0).abs() < 1e-3, "{speed:?}");
    assert!(found.law_words.as_ref().is_some_and(|words| words.contains("knots through 200 rows")));
    assert!(found.settable().all(|parameter| parameter.name == "initial_gap"), "the bodies are those of the file");
}

#[test]
fn a_scene_whose_file_does_not_fit_says_what_is_missing() {
    let rows = sampled(&of("brinell"), 200, 2.0);
    let with = |heading: &str, more: &str| scene(&csv(heading, &rows, [1.0; 3]), more).map(|_| ()).unwrap_err();
    let heading = "depth [m];force [N];contact radius [m]";
    for (heading, more, words) in [
        ("depth;force [N];contact radius [m]", "", "has no unit: write `depth [m]`"),
        ("depth [m];colour;contact radius [m]", "", "no column is called force"),
        (
            heading,
            "fmu = { parameters = [\"impactor.radius\"] }\n",
            "impactor.radius is no parameter of a curve of one's own",
        ),
        (heading, "friction = { coefficient = 0.3 }\n", "has not been compared with anything"),
        (
            heading,
            "[[contact]]\nname = \"a\"\n[[contact]]\nname = \"b\"\nimpactor.radius = 0.01\n",
            "no copies of those of the first contact",
        ),
    ] {
        let said = with(heading, more);
        assert!(said.contains(words), "{said}");
    }
    let plain = "name = \"own\"\nimpactor = { radius = 5e-3 }\ntarget = { material = \"mild steel\" }\nlaw = { loading = \"table\" }\n";
    let said = Scene::parse(plain.into(), Path::new("own.toml")).unwrap_err().to_string();
    assert!(said.contains("needs the file, as in law.loading.table = \"file.csv\""), "{said}");
}

#[test]
fn numbers_of_a_file_have_the_same_digits_in_a_scene() {
    let depths: Vec<String> = (1..=200).map(|row| format!("{}.{:04}", row / 7, (row * 7919) % 10_000)).collect();
    for (unit, power) in [("nm", -9), ("um", -6), ("mm", -3), ("cm", -2), ("m", 0)] {
        let rows: String = depths.iter().map(|depth| format!("{depth};1.5\n")).collect();
        let found = read(format!("depth [{unit}];force [N]\n{rows}").as_bytes()).expect("a table");
        for (written, number) in depths.iter().zip(&found.depth) {
            let expected: f64 = format!("{written}e{power}").parse().unwrap();
            assert_eq!(*number, expected, "{written} {unit}");
        }
    }
}
