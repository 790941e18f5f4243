//! Questions of the page and their answers, without a browser.

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

#[test]
fn every_scene_of_the_repository_bounces() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let text = std::fs::read_to_string(&path).unwrap();
        let question =
            json!({ "method": "bounce", "text": text, "way": "mass known", "step": 1e-4, "time": 0.2, "height": 0.02 });
        match ask(&question) {
            Ok(said) => assert!(!said["seen"]["rebounds"].as_array().unwrap().is_empty(), "{}: {said}", path.display()),
            Err(refused) => {
                let is_known = text.contains("inverse_masses = \"input\"") || text.contains("count = ");
                assert!(is_known, "{}: {refused}", path.display());
            }
        }
        count += 1;
    }
    assert!(count > 10);
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
