//! Questions of the page and their answers, without a browser.

use brinell_exporter::own_curve;
use brinell_web::answer;
use serde_json::{Value, json};

/// A steel ball on mild steel.
const BALL: &str = r#"
name = "ball" # the name
[impactor]
radius = "5 mm" # a radius
[target]
material = "mild steel"
[impact]
mass = 4.11e-3
speed = 1.0
"#;

/// The answer to a question, and what is wrong with it.
fn ask(question: &Value) -> Result<Value, Value> {
    let mut said: Value = serde_json::from_str(&answer(question.to_string().as_bytes()).0).expect("answers are JSON");
    if said["error"].is_null() { Ok(said["ok"].take()) } else { Err(said["error"].take()) }
}

fn edited(text: &str, path: &Value, value: &Value) -> String {
    let said = ask(&json!({ "method": "edit", "text": text, "edits": [{ "path": path, "value": value }] })).unwrap();
    said["text"].as_str().unwrap().into()
}

#[test]
fn a_mistake_has_its_place_in_utf_16() {
    let said = ask(&json!({ "method": "check", "text": BALL.replace("a radius", "\u{1f600}").replace("1.0", "-1.0") }))
        .unwrap();
    let mistake = &said["mistakes"][0];
    assert_eq!((&mistake["line"], &mistake["column"]), (&json!(9), &json!(9)), "{said}");
    let text: Vec<u16> = BALL.replace("a radius", "\u{1f600}").replace("1.0", "-1.0").encode_utf16().collect();
    let [from, to] = ["from", "to"].map(|key| mistake[key].as_u64().unwrap() as usize);
    assert_eq!(String::from_utf16_lossy(&text[from..to]), "-1.0", "{said}");
    let refused = ask(&json!({ "method": "predict", "text": BALL.replace("1.0", "-1.0") })).unwrap_err();
    assert_eq!(refused["mistakes"][0]["line"], 9, "{refused}");
}

/// A text typed in a field, and what the scene gets for it: with the unit beside the field, or its own.
#[test]
fn what_is_typed_is_read_by_the_exporter() {
    let typed = |path: Value, text: &str, unit: &str, bare: bool| {
        let typed = json!({ "text": text, "unit": unit, "bare": bare });
        let edits = json!([{ "path": path, "typed": typed }]);
        let said = ask(&json!({ "method": "edit", "text": BALL, "edits": edits })).unwrap();
        let check = ask(&json!({ "method": "check", "text": said["text"] })).unwrap();
        let pointer =
            path.as_array().unwrap().iter().map(|key| format!("/{}", key.as_str().unwrap())).collect::<String>();
        (check["values"].pointer(&pointer).cloned().unwrap_or_default(), check)
    };
    let radius = || json!(["impactor", "radius"]);
    for (text, unit, bare, value) in [
        ("6,5", "mm", false, json!("6.5 mm")),
        ("6,", "mm", false, json!("6 mm")),
        ("1_000", "um", false, json!("1000 um")),
        (" 6.50 ", "um", false, json!("6.50 um")),
        ("0,25 in", "mm", false, json!("0.25 in")),
        ("6,5", "mm", true, json!(6.5e-3)),
        ("0,7", "in", true, json!("0.7 in")),
        ("6,5 ,5", "mm", false, json!("6,5 ,5")),
        ("6.5 furlong", "mm", true, json!("6.5 furlong")),
        ("1,234", "mm", false, json!("1,234")),
        ("", "mm", false, Value::Null),
    ] {
        assert_eq!(typed(radius(), text, unit, bare).0, value, "{text} {unit}");
    }
    let (_, check) = typed(radius(), "6,5", "mm", false);
    let written = json!({ "digits": "6.5", "unit": "mm", "size": 1e-3, "number": 6.5e-3 });
    assert_eq!(check["quantities"], json!({ "impactor.radius": written }));
    let (_, check) = typed(radius(), "6.5 ,5", "mm", false);
    assert_eq!(check["quantities"], json!({}), "what is no unit never becomes one");
    let hardness = || json!(["target", "hardness"]);
    for (text, value) in [("182,5", "182.5 HBW 2.5/187.5"), ("58,5 HRC", "58.5 HRC"), ("hard", "hard")] {
        let (found, check) = typed(hardness(), text, "HBW 2,5/187,5", false);
        assert_eq!(found, value);
        assert_eq!(check["quantities"].get("target.hardness").is_some(), text != "hard");
    }
    assert_eq!(typed(json!(["target", "poissons_ratio"]), "0,3", "", false).0, json!(0.3));
}

#[test]
fn edits_keep_comments_and_make_and_remove_tables() {
    let text = edited(BALL, &json!(["impactor", "radius"]), &json!("6 mm"));
    assert_eq!(text, BALL.replace("5 mm", "6 mm"));
    let text = edited(&text, &json!(["friction", "coefficient"]), &json!(0.25));
    assert!(text.ends_with("[friction]\ncoefficient = 0.25\n"), "{text}");
    assert_eq!(edited(&text, &json!(["friction"]), &Value::Null), BALL.replace("5 mm", "6 mm"));
    assert_eq!(
        edited(BALL, &json!(["law", "loading"]), &Value::Null),
        BALL,
        "what is not there is not made to be removed"
    );
    let text = edited(BALL, &json!(["contact", 0, "name"]), &json!("left"));
    let text = edited(&text, &json!(["contact", 1]), &json!({ "name": "right", "initial_gap": 1e-4 }));
    let said = ask(&json!({ "method": "check", "text": text })).unwrap();
    assert_eq!(
        said["values"]["contact"],
        json!([{ "name": "left" }, { "name": "right", "initial_gap": 1e-4 }]),
        "{text}"
    );
    assert_eq!(said["mistakes"], json!([]), "{text}");
    let inline = "impactor = { radius = 1e-3 } # inline\n";
    assert_eq!(
        edited(inline, &json!(["impactor", "density"]), &json!(7850.0)),
        "impactor = { radius = 1e-3, density = 7850.0 } # inline\n"
    );
}

#[test]
fn the_texts_of_laws_have_numbers_in_place_of_names_in_braces() {
    let said = ask(&json!({ "method": "about" })).unwrap();
    let laws = &said["laws"];
    for kind in ["loading", "unloading", "damped"] {
        let all = laws[kind].as_array().unwrap();
        assert!(all.len() > 2, "{kind}");
        for law in all {
            let texts = format!("{} {}", law["says"], law["validity"]);
            assert!(!texts.contains('{'), "{law}");
        }
    }
}

#[test]
fn an_unknown_method_or_argument_is_named() {
    let refused = ask(&json!({ "method": "fly" })).unwrap_err();
    assert_eq!(refused["message"], "there is no method `fly`");
    let refused = ask(&json!({ "method": "predict" })).unwrap_err();
    assert!(refused["message"].as_str().unwrap().contains("text"), "{refused}");
    let refused = ask(&json!({ "method": "export", "text": BALL, "platforms": ["win32"] })).unwrap_err();
    assert_eq!(refused["message"], "there is no platform `win32`");
}

/// The rebounds of a fall from 5 cm.
fn rebounds(text: &str, way: &str, step: f64) -> (Vec<f64>, Vec<Value>) {
    let question = json!({ "method": "bounce", "text": text, "way": way, "step": step, "time": 0.3, "height": 0.05 });
    let said = ask(&question).unwrap_or_else(|refused| panic!("{way}: {refused}"));
    let all = said["seen"]["rebounds"].as_array().unwrap();
    let messages = said["seen"]["messages"].as_array().unwrap().clone();
    (all.iter().map(|rebound| rebound["restitution"].as_f64().unwrap()).collect(), messages)
}

#[test]
fn a_ball_rebounds_as_predicted_at_any_step_where_the_unit_knows_the_mass() {
    let speed = (2.0 * 9.806_65 * 0.05_f64).sqrt();
    let said = ask(&json!({ "method": "predict", "text": BALL, "speed": speed })).unwrap();
    let wanted = said["laws"][0]["restitution"].as_f64().unwrap();
    for way in ["mass known", "mass known, parallel"] {
        for step in [1e-6, 1e-5, 1e-4, 1e-3] {
            let (found, messages) = rebounds(BALL, way, step);
            // weight acts during the contact
            assert!((found[0] - wanted).abs() < 1e-3, "{way}, {step} s: {} for {wanted}", found[0]);
            assert_eq!(messages, Vec::<Value>::new(), "{way}, {step} s");
        }
    }
    let (coarse, _) = rebounds(BALL, "leap-frog", 1e-5);
    assert!((coarse[0] - wanted).abs() > 1e-3, "ten steps in a contact show: {}", coarse[0]);
}

#[test]
fn the_wrong_master_is_warned_of() {
    for way in ["serial FMU, parallel master", "parallel FMU, serial master"] {
        let (_, messages) = rebounds(BALL, way, 1e-5);
        assert!(messages.iter().any(|it| it.as_str().unwrap().contains("made for a master")), "{way}: {messages:?}");
    }
}

#[test]
fn a_step_that_throws_a_ball_deeper_than_its_radius_is_refused_in_words() {
    let (_, messages) = rebounds(BALL, "leap-frog", 9e-3);
    let refused = "a contact is as wide as the smaller body, whose radius is 5 mm, and no law holds";
    assert!(messages.iter().any(|it| it.as_str().unwrap().contains(refused)), "{messages:?}");
}

/// The scenes of the repository, with those by trade and of other shapes.
fn scenes() -> Vec<std::path::PathBuf> {
    let files =
        ["scenes", "scenes/trades", "scenes/shapes"].map(|name| std::fs::read_dir(format!("{ROOT}/{name}")).unwrap());
    let paths = files.into_iter().flatten().map(|entry| entry.unwrap().path());
    paths.filter(|path| path.extension().is_some_and(|is| is == "toml")).collect()
}

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

#[test]
fn every_scene_of_the_repository_bounces() {
    let mut count = 0;
    for path in scenes() {
        let mut text = std::fs::read_to_string(&path).unwrap();
        // no file lies beside the text of the page, which takes the rows themselves
        for name in brinell_exporter::scene::files_named(&text) {
            let rows = own_curve::read(&std::fs::read(path.with_file_name(&name)).unwrap()).unwrap();
            text = text.replace(&format!("\"{name}\""), &rows.in_toml());
        }
        let question =
            json!({ "method": "bounce", "text": text, "way": "mass known", "step": 1e-4, "time": 0.2, "height": 0.02 });
        match ask(&question) {
            Ok(said) => assert!(!said["seen"]["rebounds"].as_array().unwrap().is_empty(), "{}", path.display()),
            Err(refused) => {
                let is_known = text.contains("inverse_masses = \"input\"") || text.contains("count = ");
                assert!(is_known, "{}: {refused}", path.display());
            }
        }
        count += 1;
    }
    assert!(count > 20);
}

/// A quantity of the impact of a scene, and the ends of its band.
fn predicted(text: &str, more: &Value, name: &str) -> (f64, Option<[f64; 2]>) {
    let mut question = json!({ "method": "predict", "text": text });
    question.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
    let said = ask(&question).unwrap_or_else(|refused| panic!("{refused}\n{text}"));
    let law = &said["laws"][0];
    (law[name].as_f64().unwrap(), serde_json::from_value(law["spread"][name].clone()).unwrap())
}

/// Each strength, however it is given, is scaled to the ends of its band: the scene with that strength has the same impact.
#[test]
fn a_deviation_that_is_given_spreads_every_kind_of_strength() {
    let scaled = |text: &str, factor: f64| {
        let number = |text: &str| format!("{:e}", factor * text.parse::<f64>().unwrap());
        text.split('#')
            .map(|part| if part.parse::<f64>().is_ok() { number(part) } else { part.into() })
            .collect::<String>()
    };
    let rate = "rate = { model = \"johnson-cook\", c = 0.02, reference_rate = 1.0 }\n";
    for (strength, more, spread) in [
        ("yield_strength = #300e6#", "", "target"),
        ("yield_strength = #300e6#\nhardening_modulus = #3e9#", "", "target"),
        ("yield_strength = #300e6#", rate, "target"),
        ("power_law = { coefficient = #600e6#, exponent = 0.2 }", "", "target"),
        (
            "tensile_test = { plastic_strain = [0.005, 0.02, 0.1], true_stress = [#240e6#, #300e6#, #480e6#] }",
            "",
            "target",
        ),
    ] {
        let text = format!(
            "name = \"a\"\n[impactor]\nradius = \"5 mm\"\n[{spread}]\nyoungs_modulus = 206e9\npoissons_ratio = 0.3\n{strength}\n{more}\
             [impact]\nmass = 4e-3\nspeed = 1.0\n"
        );
        const DEVIATION: f64 = 0.1;
        let (_, band) = predicted(&scaled(&text, 1.0), &json!({ "deviation": DEVIATION }), "dent");
        let at = |way: f64| predicted(&scaled(&text, 1.0 + way * 1.959_963_985 * DEVIATION), &json!({}), "dent").0;
        let [low, high] = band.unwrap_or_else(|| panic!("no band: {text}"));
        for (found, wanted) in [(low, at(1.0)), (high, at(-1.0))] {
            assert!((found / wanted - 1.0).abs() < 1e-6, "{found} for {wanted}: {text}");
        }
    }
    let refused = ask(&json!({ "method": "predict", "text": BALL, "deviation": 0.5 })).unwrap_err();
    assert_eq!(refused["message"], "the uncertainty of the strength must be from 0 to 40 %");
}

/// The numbers of a card have the band that its curves have, and a strength that is certain has none.
#[test]
fn bands_of_curves_are_those_of_the_numbers() {
    let question =
        |of: &str| json!({ "method": "bands", "text": BALL, "of": of, "deviation": 0.1, "sweep": ["speed=0.5:1.5:3"] });
    let [low, high] = predicted(BALL, &json!({ "deviation": 0.1 }), "largest_force").1.unwrap();
    let history = ask(&question("history")).unwrap();
    let [family] = history["families"].as_array().unwrap().as_slice() else { panic!("{history}") };
    let largest =
        |law: &Value| law["force"].as_array().unwrap().iter().map(|it| it.as_f64().unwrap()).fold(0.0, f64::max);
    let forces: Vec<f64> = family["laws"].as_array().unwrap().iter().map(largest).collect();
    let ends = [forces.iter().copied().fold(f64::INFINITY, f64::min), forces.iter().copied().fold(0.0, f64::max)];
    for (found, wanted) in ends.into_iter().zip([low, high]) {
        assert!((found / wanted - 1.0).abs() < 1e-3, "{found} for {wanted}");
    }
    let sweep = ask(&question("sweep")).unwrap();
    let bands: [f64; 2] = serde_json::from_value(sweep["bands"][1]["largest_force"].clone()).unwrap();
    assert_eq!(sweep["speed"], json!([0.5, 1.0, 1.5]));
    assert_eq!(bands, [low, high]);
    let certain = ask(&json!({ "method": "bands", "text": BALL, "of": "curve" })).unwrap();
    assert_eq!(certain["families"], json!([]));
}

/// The examples of the page by their names.
fn example(name: &str) -> String {
    std::fs::read_to_string(format!("{ROOT}/scenes/trades/{name}.toml")).unwrap()
}

#[test]
fn each_example_has_a_title_of_a_line_and_a_few_words_on_what_to_look_at() {
    let about = ask(&json!({ "method": "about" })).unwrap();
    let examples = about["examples"].as_array().unwrap();
    let files = std::fs::read_dir(format!("{ROOT}/scenes/trades")).unwrap().count();
    assert_eq!(examples.len(), files);
    for example in examples {
        let [title, look] = ["title", "look"].map(|key| example[key].as_str().unwrap());
        assert!((8..50).contains(&title.len()), "{title}");
        assert!((40..300).contains(&look.len()) && look.ends_with('.'), "{look}");
        let check = ask(&json!({ "method": "check", "text": example["text"] })).unwrap();
        assert_eq!(check["mistakes"], json!([]), "{title}");
    }
}

/// What the remarks of the examples say.
#[test]
fn the_examples_do_what_their_remarks_say() {
    let number = |text: &str, name| predicted(text, &json!({}), name).0;
    let none = json!({});
    let drop = example("drop_test");
    assert!((number(&drop, "restitution") - 0.5).abs() < 0.03, "half of the speed");
    let with_loss = format!("{drop}\n[law]\nelastic_restitution = 0.98\n");
    let slow = |text: &str| predicted(text, &json!({ "speed": 1e-3 }), "restitution").0;
    assert!(slow(&drop) > 1.0 - 1e-12 && slow(&with_loss) < 0.981, "only with a loss the ball comes to rest");
    let slider = example("end_stop");
    let force = |speed: f64| predicted(&slider, &json!({ "speed": speed }), "largest_force").0;
    let growth = f64::log2(force(0.8) / force(0.4));
    assert!((1.0..1.15).contains(&growth), "a little faster than the speed: {growth}");
    let hammer = example("hammer_blow");
    let lost = number(&hammer, "energy_lost") / number(&hammer, "kinetic_energy");
    assert!((0.45..0.55).contains(&lost), "half of the energy: {lost}");
    let harder = hammer.replace("200 HBW", "400 HBW");
    assert_ne!(harder, hammer);
    for (name, sign) in [("largest_force", 1.0), ("dent", -1.0), ("rebound_speed", 1.0)] {
        assert!(sign * (number(&harder, name) - number(&hammer, name)) > 0.0, "{name}");
    }
    let shot = example("shot_peening");
    assert!(number(&shot, "loading_time") + number(&shot, "unloading_time") < 1e-6);
    let cradle = example("newtons_cradle");
    let hardened = cradle.replace("annealed", "hardened");
    assert!(number(&cradle, "dent") > 0.0 && number(&hardened, "dent") < 0.5 * number(&cradle, "dent"));
    assert!(predicted(&example("valve_seat"), &none, "dent").1.is_some());
}

/// `F / (pi D/2 (D - sqrt(D^2 - d^2)))`, with the force in kgf and lengths in mm, is the hardness that the scene says, within what the
/// measurements say of its conversion.
#[test]
fn the_hardness_test_measures_the_hardness_that_it_is_given() {
    let text = example("hardness_test");
    let number = |name| predicted(&text, &json!({}), name).0;
    let (force, radius) = (number("largest_force") / 9.806_65, 1e3 * number("largest_contact_radius"));
    assert!((force / 1000.0 - 1.0).abs() < 0.02, "{force} kgf");
    let (ball, dent) = (10.0, 2.0 * radius);
    let hardness = force / (std::f64::consts::PI * ball / 2.0 * (ball - f64::sqrt(ball * ball - dent * dent)));
    assert!((hardness / 200.0 - 1.0).abs() < 0.05, "{hardness} HBW");
}

#[test]
fn contacts_with_masses_of_their_own_rebound_as_predicted_in_every_right_way() {
    let text = format!(
        "{BALL}\n[coupling]\neffective_mass = 4.11e-3\n[[contact]]\nname = \"a\"\neffective_mass = 2e-3\n[[contact]]\nname = \"b\"\n"
    );
    let speed = (2.0 * 9.806_65 * 0.05_f64).sqrt();
    let wanted = [2e-3, 4.11e-3].map(|mass| {
        let said = ask(&json!({ "method": "predict", "text": BALL, "speed": speed, "mass": mass })).unwrap();
        said["laws"][0]["restitution"].as_f64().unwrap()
    });
    for (way, step) in [("leap-frog", 2.5e-7), ("predicted_force", 2.5e-7), ("mass known", 1e-5)] {
        let question =
            json!({ "method": "bounce", "text": text, "way": way, "step": step, "time": 0.102, "height": 0.05 });
        let said = ask(&question).unwrap_or_else(|refused| panic!("{way}: {refused}"));
        for (contact, wanted) in wanted.iter().enumerate() {
            let rebounds = said["seen"]["rebounds"].as_array().unwrap();
            let rebound = rebounds.iter().find(|rebound| rebound["contact"] == contact).expect("it touches");
            let found = rebound["restitution"].as_f64().unwrap();
            assert!((found - wanted).abs() < 2e-3, "{way}, contact {contact}: {found} for {wanted}");
        }
    }
}

/// Scenes that close something, and a part of what each closes.
const CLOSING: [(&str, &[&str]); 5] = [
    ("[friction]\ncoefficient = 0.3", &["coupling.effective_mass", "law.loading=tsuji", "law.passivity_guard=true"]),
    (
        "[law]\nloading = \"tsuji\"\nrestitution = 0.7",
        &["law.unloading", "law.elastic_restitution", "friction", "fmu.input_derivatives=true"],
    ),
    ("[law]\nloading = \"hertz\"", &["law.unloading", "law.restitution", "target.hardening_modulus", "target.rate"]),
    ("[coupling]\neffective_mass = \"4.11 g\"", &["friction", "fmu.input_derivatives=false"]),
    (
        "",
        &[
            "fmu.outputs=closing_speed",
            "fmu.outputs=impulse_moment",
            "target.thickness",
            "law.loading=line",
            "law.damping",
        ],
    ),
];

/// A value of a key that is right by itself.
fn right_value(key: &str) -> Value {
    match key.rsplit('.').next().unwrap() {
        "friction" => json!({ "coefficient": 0.3 }),
        "coupling" => json!({ "effective_mass": "4.11 g" }),
        "rate" => json!({ "model": "cowper-symonds", "d": 40.4, "q": 5 }),
        "power_law" => json!({ "coefficient": "600 MPa", "exponent": 0.2 }),
        "tensile_test" => json!({ "proof_stress": "240 MPa", "tensile_strength": "480 MPa" }),
        "unloading_parameters" | "loading_parameters" => json!({}),
        "hardness" => json!("200 HBW 10/3000"),
        "unloading" => json!("thornton"),
        "damping" => json!("viscous"),
        "shape" => json!("ball"),
        "base" => json!("bonded"),
        "inverse_masses" => json!("input"),
        "body" => json!([{ "name": "a", "mass": 1.0 }]),
        "contact" => json!([{ "name": "a" }]),
        "tangent_modulus" | "hardening_modulus" => json!("2 GPa"),
        "tensile_strength" | "yield_strength" => json!("500 MPa"),
        "size_constant" => json!(10),
        _ => json!(0.3),
    }
}

#[test]
fn what_the_page_closes_is_refused_for_the_reason_that_it_gives() {
    for (more, named) in CLOSING {
        let text = format!("{BALL}{more}\n");
        let check = ask(&json!({ "method": "check", "text": text })).unwrap();
        assert_eq!(check["mistakes"], json!([]), "{text}");
        let closed = check["closed"].as_object().unwrap();
        for name in named {
            assert!(closed.contains_key(*name), "{text}: {name} isn't among {:?}", closed.keys());
        }
        for (name, why) in closed {
            let (key, value) = name.split_once('=').map_or((name.as_str(), None), |(key, value)| (key, Some(value)));
            let value = match (key, value) {
                (_, None) => right_value(key),
                ("fmu.outputs" | "coupling.inputs", Some(value)) => json!([value]),
                (_, Some(value)) => value.parse().map_or(json!(value), Value::Bool),
            };
            let wrong = edited(&text, &json!(key.split('.').collect::<Vec<_>>()), &value);
            let said = ask(&json!({ "method": "check", "text": wrong })).unwrap();
            let message = said["mistakes"][0]["message"].as_str().unwrap_or_default();
            // behind the colon is the reason, before it are values; or the key needs another one first
            let why = why["why"].as_str().unwrap();
            let reason = why.rsplit(": ").next().unwrap();
            let asks_first = ["needs", "missing", "cannot yield"].iter().any(|word| message.contains(word));
            assert!(message.contains(reason) || asks_first, "{wrong}{name} is closed, since {why}, but: {message}");
        }
    }
}

#[test]
fn what_a_law_closes_and_needs_is_that_of_the_rules() {
    let about = ask(&json!({ "method": "about" })).unwrap();
    let law = |kind: &str, name: &str| {
        let laws = about["laws"][kind].as_array().unwrap();
        laws.iter().find(|law| law["name"] == name).unwrap_or_else(|| panic!("no {name}")).clone()
    };
    let has = |list: &Value, name: &str| list.as_array().unwrap().iter().any(|one| one == name);
    let (damped, own) = (law("damped", "tsuji"), law("damped", "kuwabara-kono"));
    assert!(has(&damped["needs"], "restitution") && has(&damped["closes"], "unloading"), "{damped}");
    assert!(has(&own["closes"], "restitution") && !has(&own["needs"], "restitution"), "{own}");
    let plastic = law("loading", "brinell");
    assert!(has(&plastic["closes"], "damping") && !has(&plastic["closes"], "unloading"), "{plastic}");
}
