//! `brinell predict --angle`: oblique impacts. Beside the measurement they stand in `guide/measurements.rs`.

use brinell_testing::folder::{Folder, close, number, numbers};
use serde_json::Value;

/// The aluminium oxide ball on glass of Kharaz, Gorham and Salman.
const KHARAZ: &str = "name = \"kharaz\"\nimpactor = { radius = 2.5e-3, youngs_modulus = 380e9, poissons_ratio = 0.23 }\n\
                      target = { youngs_modulus = 70e9, poissons_ratio = 0.25 }\nlaw = { loading = \"hertz\" }\n\
                      friction = { coefficient = 0.092 }\nimpact = { mass = 2.617993877991494e-4, speed = 3.9 }\n";

/// The prediction for the scene `text` with these arguments.
fn predicted(text: &str, arguments: &str) -> Value {
    Folder::of(text).json(&format!("predict scene.toml {arguments}"))
}

#[test]
fn the_scenes_friction_is_the_default_and_both_signs_and_spins_are_accepted() {
    let own = predicted(KHARAZ, "--angle 20");
    assert_eq!(number(&own, "friction"), 0.092);
    assert_eq!(own["laws"], predicted(KHARAZ, "--angle 20 --friction 0.092")["laws"]);
    let law = |arguments: &str, name: &str| number(&predicted(KHARAZ, arguments)["laws"][0], name);
    assert_ne!(law("--angle 20", "rebound_spin"), law("--angle 20 --friction 0.3", "rebound_spin"));
    for name in ["rebound_spin", "rebound_angle", "tangential_rebound_speed"] {
        let one = law("--angle 20 --spin -300", name);
        assert_eq!(one, -law("--angle -20 --spin 300", name), "{name}");
        assert_ne!(one, law("--angle 20 --spin 300", name), "{name}");
    }
    // a ball that only spins rolls away
    assert!(law("--spin 300", "tangential_rebound_speed") < 0.0);
    // without friction nothing tangential changes
    close(law("--angle 20 --friction 0", "tangential_restitution"), 1.0, 1e-14);
    // a ball with all its mass in the middle takes up more spin
    let light = law("--angle 60 --inertia 1e-10", "rebound_spin");
    assert!(light.abs() > 2.0 * law("--angle 60", "rebound_spin").abs(), "{light}");
}

#[test]
fn full_sliding_is_coulombs_law() {
    let answer = Folder::of_scene("steel_ball").json("predict scene.toml --friction 0.1 --angle 60");
    let expected = 1.0 - 0.1 * (1.0 + number(&answer, "laws/0/normal_restitution")) / 60f64.to_radians().tan();
    close(number(&answer, "laws/0/tangential_restitution"), expected, 1e-6);
}

#[test]
fn an_oblique_sweep_is_a_table() {
    let folder = Folder::of_scene("steel_ball");
    let sweep = "predict scene.toml --laws brinell,thornton --friction 0.2 --sweep angle=0:85:5";
    let table = folder.words(sweep);
    assert!(table.contains("tangential restitution") && table.contains("[deg]") && !table.contains("NaN"), "{table}");
    folder.call(&format!("{sweep} -o x.csv")).with_status(0);
    let csv = folder.read("x.csv");
    assert_eq!(csv.lines().count(), 11);
    assert!(csv.starts_with("law,angle_deg,rebound_angle_deg,rebound_speed_m_per_s"), "{csv}");
    // a parameter of the scene, with the bodies that go with it
    for range in
        ["target.poissons_ratio=0.1:0.45:3", "friction.coefficient=0.1:0.5:3", "speed=0.1:10:3", "spin=-10:10:3"]
    {
        let answer = folder.json(&format!("predict scene.toml --friction 0.2 --angle 20 --sweep {range}"));
        let values = numbers(&answer, "laws/0/tangential_restitution");
        assert!(values.len() == 3 && values[0] != values[2], "{range}: {values:?}");
    }
}

/// Each row equals the impact with these numbers.
#[test]
fn oblique_sweeps_over_several_quantities_are_their_impacts() {
    let answer = predicted(KHARAZ, "--sweep angle=10:60:3 --sweep target.poissons_ratio=0.2:0.3:2");
    let sweep = &answer["laws"][0];
    for (row, angle) in [10.0, 35.0, 60.0].into_iter().enumerate() {
        for (column, ratio) in [0.2, 0.3].into_iter().enumerate() {
            let scene = KHARAZ.replace("poissons_ratio = 0.25", &format!("poissons_ratio = {ratio}"));
            let one = predicted(&scene, &format!("--angle {angle}"))["laws"][0].clone();
            let place = 2 * row + column;
            for name in ["rebound_angle", "rebound_spin", "tangential_restitution", "friction_work"] {
                assert_eq!(sweep[name][place], one[name], "{name} at {angle} degrees and nu = {ratio}");
            }
            assert_eq!(numbers(sweep, "angle")[place], angle);
            assert_eq!(numbers(sweep, "target.poissons_ratio")[column], ratio);
        }
    }
}

#[test]
fn every_law_with_friction_has_oblique_impacts_and_the_others_are_left_out() {
    let answer = Folder::of_scene("steel_ball").json("predict scene.toml --laws all --friction 0.2 --angle 15");
    let laws = answer["laws"].as_array().unwrap();
    let names: Vec<&str> = laws.iter().map(|law| law["law"].as_str().unwrap()).collect();
    assert!(names.len() >= 15 && !names.iter().any(|name| name.ends_with("/etsion")), "{names:?}");
    for law in laws {
        assert!(number(law, "friction_work") > 0.0 && number(law, "sliding_part") <= 1.0, "{law}");
        assert!(number(law, "energy_lost") >= number(law, "friction_work") * (1.0 - 1e-9), "{law}");
    }
}

/// Two pool balls, or one on the ground, with `law` and `friction`.
fn balls(law: &str, friction: f64, is_free: bool) -> String {
    let body = |name: &str| format!("[[body]]\nname = {name:?}\nmass = 0.17\ninertia = 5.552e-5\n");
    let (other, bodies) = if is_free { ("object", body("object")) } else { ("ground", String::new()) };
    let arms = if is_free { "[-28.575e-3, 0, 0]" } else { "[]" };
    format!(
        "name = \"pool\"\nimpactor = {{ radius = 28.575e-3, youngs_modulus = 5.84e9, poissons_ratio = 0.34 }}\n\
         target = {{ radius = 28.575e-3, youngs_modulus = 5.84e9, poissons_ratio = 0.34, density = 1740.0, yield_strength = 60e6 }}\n\
         law = {{ {law} }}\nfriction = {{ coefficient = {friction} }}\nimpact = {{ speed = 2.0 }}\n{bodies}{}\
         [[contact]]\nname = \"hit\"\nbetween = [\"cue\", {other:?}]\nnormal = [1, 0, 0]\ntangent = [0, 1, 0]\n\
         arms = [[28.575e-3, 0, 0], {arms}]\n",
        body("cue")
    )
}

/// Gross slip of equal balls: the normal impulse is `(1 + e) m v cos/2`, the tangential one mu times it, and the ball is thrown by atan mu.
#[test]
fn a_struck_ball_is_thrown_by_the_angle_of_friction_also_with_a_loss() {
    for (law, restitution) in [("loading = \"hertz\", elastic_restitution = 0.95", 0.95), ("loading = \"hertz\"", 1.0)]
    {
        for angle in [30.0_f64, 45.0, 70.0] {
            let answer = predicted(&balls(law, 0.06, true), &format!("--angle {angle}"));
            assert_eq!(answer["bodies"], serde_json::json!(["cue", "object"]));
            let of = |name: &str| number(&answer["laws"][0], name);
            let normal = 0.5 * (1.0 + restitution) * 2.0 * angle.to_radians().cos();
            close(of("normal_restitution"), restitution, 1e-4);
            close(of("struck_normal_speed"), normal, 1e-4);
            close(of("struck_tangential_speed"), 0.06 * normal, 1e-4);
            close(of("struck_angle"), 0.06_f64.atan().to_degrees(), 1e-3);
            assert_eq!(answer["laws"][0]["slides_throughout"], true, "{answer}");
        }
    }
}

/// Momentum, and the energy of both bodies, for every kind of loss and also where the contact sticks.
#[test]
fn two_bodies_keep_their_momentum_and_lose_what_is_said() {
    for (loss, angle, friction) in [
        ("", 20.0_f64, 0.06),
        (", elastic_restitution = 0.9", 55.0, 0.5),
        (", elastic_restitution = \"waves\"", 5.0, 0.2),
    ] {
        for law in ["hertz", "big-alabo", "brinell"] {
            let law = format!("loading = {law:?}{loss}");
            let answer = predicted(&balls(&law, friction, true), &format!("--angle {angle} --spin -10"));
            let of = |name: &str| number(&answer["laws"][0], name);
            let angle = angle.to_radians();
            close(of("struck_normal_speed") - of("normal_rebound_speed"), 2.0 * angle.cos(), 1e-9);
            close(of("struck_tangential_speed") + of("tangential_rebound_speed"), 2.0 * angle.sin(), 1e-9);
            // a tangential impulse turns both balls the same way
            close(of("struck_spin"), of("rebound_spin") + 10.0, 1e-6);
            let energy = |normal: f64, tangential: f64, spin: f64| {
                0.5 * (0.17 * (normal * normal + tangential * tangential) + 5.552e-5 * spin * spin)
            };
            let before = energy(2.0 * angle.cos(), 2.0 * angle.sin(), -10.0);
            let cue = energy(of("normal_rebound_speed"), of("tangential_rebound_speed"), of("rebound_spin"));
            let object = energy(of("struck_normal_speed"), of("struck_tangential_speed"), of("struck_spin"));
            assert!((before - cue - object - of("energy_lost")).abs() < 1e-9 * before, "{law}: {answer}");
        }
    }
}

/// One body on the ground is the free ball of a scene without bodies, whose springs are followed in another way.
#[test]
fn a_body_on_the_ground_rebounds_as_a_free_ball() {
    for law in ["hertz", "big-alabo", "brinell"] {
        let text = balls(&format!("loading = {law:?}"), 0.3, false);
        let alone = text.split("[[body]]").next().unwrap().replace("speed = 2.0", "speed = 2.0, mass = 0.17");
        for angle in ["10", "40", "75"] {
            let body = predicted(&text, &format!("--angle {angle}"));
            let ball = predicted(&alone, &format!("--angle {angle} --inertia 5.552e-5"));
            for name in ["rebound_angle", "tangential_rebound_speed", "rebound_spin", "contact_time"] {
                let [one, other] = [&body, &ball].map(|answer| number(&answer["laws"][0], name));
                assert!(
                    (one - other).abs() < 2e-3 * other.abs().max(0.1),
                    "{law} at {angle}: {name} {one} and {other}"
                );
            }
        }
    }
}

#[test]
fn a_loss_below_yield_takes_its_part_of_an_oblique_impact() {
    let text = KHARAZ.replace("friction = { coefficient = 0.092 }\n", "");
    let text = text.replace("poissons_ratio = 0.25 }", "poissons_ratio = 0.25, yield_strength = 3e9 }");
    let text = text.replace("loading = \"hertz\"", "loading = \"brinell\", elastic_restitution = 0.98");
    for angle in [10.0_f64, 50.0] {
        let oblique = predicted(&text, &format!("--friction 0.1 --angle {angle}"));
        let normal = predicted(&text, &format!("--speed {}", 3.9 * angle.to_radians().cos()));
        let normal = number(&normal, "laws/0/restitution");
        assert!(normal < 0.981, "{normal}");
        close(number(&oblique, "laws/0/normal_restitution"), normal, 1e-4);
    }
}
