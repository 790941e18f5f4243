//! The laws beside measurements: the tables of the page, and independent numbers.

use crate::comparisons::{numbers, yielding};
use crate::devices::{self, Device, SCENE, SLOW, Stress, THIRD, Way, measured, rebounds};
use crate::read;
use crate::record::{Fit, least, rms};
use crate::tables::{heading, row, shows};
use brinell_contact::impact::Impact;
use brinell_contact::rate::Rate;
use brinell_exporter::measured::STEEL_RATE;
use brinell_exporter::predict::oblique::{self, Outcome, Setting};
use brinell_exporter::scene::Scene;
use brinell_exporter::{laws, predict};
use std::path::Path;

/// The least and the largest of some relative errors.
fn range(errors: &[f64]) -> String {
    let least = errors.iter().copied().fold(f64::INFINITY, f64::min);
    let most = errors.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    format!("{:+.1} to {:+.1} %", 100.0 * least, 100.0 * most)
}

/// A dent that makers print.
struct Dent {
    device: String,
    vickers: f64,
    by: Device,
    /// \[m\].
    depth: f64,
    diameter: f64,
}

fn dents() -> Vec<Dent> {
    let file = "data/experiment/leeb_dents.csv";
    let text = read(Path::new(file));
    let names = text.lines().skip(1).map(|line| line.split(',').next().unwrap_or_default().to_string());
    let dent = |(device, row): (String, Vec<f64>)| Dent {
        device,
        vickers: row[5],
        by: Device { radius: 0.5e-3 * row[1], impact: Impact { mass: 1e-3 * row[2], speed: row[4] } },
        depth: 1e-6 * row[6],
        diameter: 1e-3 * row[7],
    };
    names.zip(numbers(file, "")).map(dent).collect()
}

/// Relative errors of depths and of diameters by a law with the strength that a scene makes of the hardness.
fn errors_of_dents(law: &str) -> [Vec<f64>; 2] {
    let errors = dents().into_iter().map(|dent| {
        let said = dent.by.on(law, SCENE.strength(dent.vickers, &dent.by).strength);
        (said.residual_indentation / dent.depth - 1.0, 2.0 * said.max_contact_radius / dent.diameter - 1.0)
    });
    let (depths, diameters) = errors.unzip();
    [depths, diameters]
}

/// Every law on every set with which laws differ.
fn errors_of_all() -> String {
    let mut table =
        heading(&["law", "rebounds", "depth of dents", "diameter of dents", "record: rms", "its S", "its compliance"]);
    for law in yielding() {
        let [depth, diameter] = errors_of_dents(law).map(|errors| range(&errors));
        let fit = Fit::by(law);
        let mut cells = vec![format!("`{law}`"), range(&devices::errors(law, &SCENE)), depth, diameter];
        cells.push(format!("{:.2} um", 1e6 * fit.rms));
        // the end of the search
        let is_found = fit.strength < 4.3e9;
        cells.push(if is_found { format!("{:.0} MPa", 1e-6 * fit.strength) } else { "above 4300 MPa".into() });
        cells.push(format!("{:+.1} um/kN", 1e9 * fit.compliance));
        table += &row(&cells.iter().map(String::as_str).collect::<Vec<_>>());
    }
    table
}

/// The constant of a rate model with the least squares of the errors of the restitution, over a logarithm of it.
fn fitted(rate: impl Fn(f64) -> Rate, ends: (f64, f64)) -> Rate {
    let squares = |logarithm: f64| {
        rms(&devices::errors("brinell", &Way { stress: Stress::OfImpact, rate: rate(logarithm.exp()) }))
    };
    rate(least(squares, ends).exp())
}

const JOHNSON_COOK: fn(f64) -> Rate = |c| Rate::JohnsonCook { c, reference_rate: 1e-3 };
const COWPER_SYMONDS: fn(f64) -> Rate = |d| Rate::CowperSymonds { d, q: 5.0 };

/// How the law `brinell` rebounds with strengths from the hardness by several ways.
fn strengths() -> String {
    let [c, d] =
        [(JOHNSON_COOK, (-6.0f64, -3.0f64)), (COWPER_SYMONDS, (10.0, 22.0))].map(|(rate, ends)| fitted(rate, ends));
    let fit = match (c, d) {
        (Rate::JohnsonCook { c, .. }, Rate::CowperSymonds { d, .. }) => [
            format!("fitted: `johnson-cook`, c = {c:.4} from 1e-3 1/s"),
            format!("fitted: `cowper-symonds`, d = {d:.1e} 1/s, q = 5"),
        ],
        _ => unreachable!("these were fitted"),
    };
    let of = |stress, rate| Way { stress, rate };
    let ways = [
        ("HV g/3", THIRD),
        ("HV g/C, at the strain of the test", of(Stress::OfTest, Rate::NONE)),
        ("the same at the strain of the impact", SLOW),
        ("**with c = 0.014 from 1e-3 1/s: what a scene takes**", SCENE),
        ("with c = 0.014 from 1e-3 1/s, at the strain of the test", of(Stress::OfTest, STEEL_RATE)),
        ("with c = 0.014 from 1 1/s", of(Stress::OfImpact, Rate::JohnsonCook { c: 0.014, reference_rate: 1.0 })),
        ("with `cowper-symonds`, d = 40.4 1/s, q = 5", of(Stress::OfImpact, COWPER_SYMONDS(40.4))),
        (&fit[0], of(Stress::OfImpact, c)),
        (&fit[1], of(Stress::OfImpact, d)),
    ];
    let hardnesses = [300.0, 600.0, 800.0];
    let mut table = heading(&[
        "strength",
        "300 HV",
        "600 HV",
        "800 HV",
        "errors, 230 to 813 HV",
        "S at 300 HV",
        "factor of the rate",
    ]);
    let [low, middle, high] = hardnesses.map(|vickers| format!("{:.3}", measured(vickers)));
    table += &row(&["measured", &low, &middle, &high, "", "", ""]);
    for (name, way) in ways {
        let found = hardnesses.map(|vickers| way.strength(vickers, &Device::D));
        let restitutions = found.map(|found| Device::D.on("brinell", found.strength).restitution);
        let [low, middle, high] = restitutions.map(|restitution| format!("{restitution:.3}"));
        let errors = range(&devices::errors("brinell", &way));
        let strength = format!("{:.0} MPa", 1e-6 * found[0].strength);
        table += &row(&[name, &low, &middle, &high, &errors, &strength, &format!("{:.2}", found[0].factor)]);
    }
    table
}

/// A scene that this text is.
fn parsed(text: &str) -> Scene {
    Scene::parse(text.into(), Path::new("scene.toml")).unwrap_or_else(|mistake| panic!("{mistake}"))
}

/// The law that this scene has.
fn own(scene: &Scene) -> laws::Choice {
    laws::choose(scene, &[]).expect("the law of a scene").remove(0)
}

/// Speed and restitution of a steel ball on metallic glass, and the restitution by elastic waves alone. Its radius is not known and
/// makes no difference.
fn metallic_glass() -> Vec<[f64; 3]> {
    let scene = parsed(
        "name = \"ball\"\nimpactor = { radius = 2e-3, youngs_modulus = 208e9, poissons_ratio = 0.3 }\n\
         target = { youngs_modulus = 96e9, poissons_ratio = 0.36, density = 6100, yield_strength = 1.9e9 }\n\
         law = { loading = \"brinell\", elastic_restitution = \"waves\" }\nimpact = { mass = 2.614e-4, speed = 1.0 }\n",
    );
    let points = numbers("data/experiment/rebounds_on_metallic_glass.csv", "");
    let points = points.iter().filter(|row| row.len() == 2 && row[1] < 1.0);
    let said = |row: &Vec<f64>| {
        let impact = Impact { speed: row[0], ..scene.impact_of(0) };
        [row[0], row[1], predict::one(&own(&scene), &impact).expect("an elastic impact").restitution]
    };
    points.map(said).collect()
}

/// Differences between computed and measured oblique rebounds, for a quantity.
fn oblique_errors(quantity: &str, of: impl Fn(&Outcome) -> f64) -> Vec<f64> {
    let scene = parsed(
        "name = \"ball\"\nimpactor = { radius = 2.5e-3, youngs_modulus = 380e9, poissons_ratio = 0.23 }\n\
         target = { youngs_modulus = 70e9, poissons_ratio = 0.25 }\nlaw = { loading = \"hertz\" }\n\
         friction = { coefficient = 0.092 }\nimpact = { mass = 2.617993877991494e-4, speed = 3.9 }\n",
    );
    let text = read(Path::new("data/experiment/oblique_elastic.csv"));
    let rows = text.lines().skip(1).map(|line| line.split(',').collect::<Vec<_>>());
    let error = |row: Vec<&str>| {
        let [angle, value] = [row[2], row[3]].map(|cell| cell.parse::<f64>().expect("a number"));
        let setting = Setting { angle, spin: 0.0, coefficient: 0.092, inertia: None };
        let outcome = oblique::one(&scene, &own(&scene), (scene.impact_of(0), setting), &[]);
        of(&outcome.expect("a rebound")) - value
    };
    rows.filter(|row| row[1] == quantity).map(error).collect()
}

/// The sets with which laws don't differ, since nothing yields.
fn elastic() -> String {
    let mut table = heading(&["set", "quantity", "points", "difference: rms", "range"]);
    let mut add = |set: &str, quantity: &str, errors: &[f64], digits: usize, unit: &str| {
        let ends = [f64::min as fn(f64, f64) -> f64, f64::max].map(|end| errors.iter().copied().reduce(end).unwrap());
        let ends = format!("{:+.digits$} to {:+.digits$}{unit}", ends[0], ends[1]);
        let count = errors.len().to_string();
        table += &row(&[set, quantity, &count, &format!("{:.digits$}{unit}", rms(errors)), &ends]);
    };
    let ball = "aluminium oxide on glass";
    add(ball, "tangential restitution", &oblique_errors("e_t", Outcome::tangential_restitution), 3, "");
    add(ball, "spin", &oblique_errors("omega", |outcome| -outcome.rebound.ball.spin), 0, " rad/s");
    add(ball, "rebound angle", &oblique_errors("rebound_angle_centre", Outcome::angle), 2, " degrees");
    let waves: Vec<f64> = metallic_glass().iter().map(|[_, measured, said]| said - measured).collect();
    add("steel on metallic glass", "restitution, by elastic waves", &waves, 4, "");
    table
}

#[test]
fn the_tables_of_measurements_are_those_that_are_computed() {
    shows("measurements.md", "errors", &errors_of_all());
    shows("measurements.md", "strengths", &strengths());
    shows("measurements.md", "elastic impacts", &elastic());
}

/// Computed by finite elements of small strain and formulas alone: `data/experiment/rebounds_by_formulas.py`. Large strain matters at
/// 300 HV, where the contact is widest.
#[test]
fn restitutions_are_those_of_an_independent_computation_but_for_large_strain() {
    let computed =
        [(THIRD, [0.5277, 0.6969, 0.7717]), (SLOW, [0.5248, 0.7244, 0.8168]), (SCENE, [0.5664, 0.7712, 0.8617])];
    for (way, expected) in computed {
        for ((vickers, tolerance), expected) in
            [(300.0, 0.018), (600.0, 0.004), (800.0, 0.004)].into_iter().zip(expected)
        {
            let found = Device::D.on("brinell", way.strength(vickers, &Device::D).strength).restitution;
            assert!((found / expected - 1.0).abs() < tolerance, "{vickers} HV: {found}, not {expected}");
        }
    }
}

#[test]
fn the_strength_of_the_tables_is_that_of_a_scene() {
    for (vickers, _) in rebounds() {
        let scene = parsed(&format!(
            "name = \"device\"\nimpactor = {{ radius = \"1.5 mm\", youngs_modulus = \"620 GPa\", poissons_ratio = 0.22 }}\n\
             impact = {{ mass = \"5.45 g\", speed = 2.05 }}\n\
             target = {{ youngs_modulus = \"210 GPa\", poissons_ratio = 0.3, hardness = \"{vickers} HV10\" }}\n"
        ));
        let said = scene.in_impact(0, &scene.impact_of(0)).expect("an impact");
        let found = SCENE.strength(vickers, &Device::D);
        assert!((found.strength / said.yield_strength - 1.0).abs() < 1e-8, "{vickers} HV");
        assert!((found.strain_rate / said.strain_rate - 1.0).abs() < 1e-6, "{vickers} HV");
    }
}

/// From the device C to D, which throws the same ball with 4.1 times the energy, a dent grows by 1.4: printed and computed at 300 and
/// 600 HV, but not printed at 800 HV.
#[test]
fn the_printed_dents_of_two_devices_agree_but_at_800_hv() {
    let dents = dents();
    let of = |device: &str, vickers: f64| {
        let mut found = dents.iter().filter(|dent| dent.device == device && dent.vickers == vickers);
        found.next().expect("it is printed")
    };
    let width = |dent: &Dent| dent.by.on("brinell", SCENE.strength(dent.vickers, &dent.by).strength).max_contact_radius;
    for (vickers, least, most) in [(300.0, -0.01, 0.01), (600.0, -0.01, 0.05), (800.0, -0.16, -0.12)] {
        let (small, large) = (of("C", vickers), of("D", vickers));
        let growth = width(large) / width(small);
        assert!((1.38..1.43).contains(&growth), "{growth}");
        let error = large.diameter / small.diameter / growth - 1.0;
        assert!((least..most).contains(&error), "{vickers} HV: {error}");
    }
}
