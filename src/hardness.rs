//! `brinell hardness`: dent and hardness of a test, or the yield strength from a hardness.

use crate::messages::WrongCall;
use crate::scene_file;
use brinell_contact::validity::LARGEST_RADIUS_RATIO;
use brinell_exporter::hardness::{ADMITTED, Dent, load_ratio, run_test, strength_of};
use brinell_exporter::laws::{self, Choice};
use brinell_exporter::layout::{json_line, paragraph, table};
use brinell_exporter::measured::{self, Metal};
use brinell_exporter::numbers::{quantity, significant};
use brinell_exporter::predict::positive;
use brinell_exporter::regime;
use brinell_exporter::scene::{Body, Scene};
use brinell_exporter::table::Class;
use brinell_exporter::units;
use serde_json::{Value, json};
use std::error::Error;
use std::path::PathBuf;

/// The arguments of `brinell hardness`.
#[derive(clap::Args)]
#[command(next_line_help = true, group = clap::ArgGroup::new("size").required(true))]
pub struct Arguments {
    /// The scene file: ball and target, which must be flat
    pub scene: PathBuf,
    /// Test load with its unit, such as 29.4kN or 3000kgf
    #[arg(long, allow_hyphen_values = true, group = "size", value_parser = units::loads)]
    pub load: Option<f64>,
    /// Test load [N]
    #[arg(long, allow_hyphen_values = true, group = "size", value_parser = units::numbers_in("N"))]
    pub force: Option<f64>,
    /// A measured Brinell hardness (HBW): print the yield strength of the target instead
    #[arg(long, allow_hyphen_values = true, value_name = "HBW")]
    pub brinell: Option<f64>,
    /// Laws to compare: LOADING or LOADING/UNLOADING, or "all" [default: the scene's]
    #[arg(long, value_delimiter = ',')]
    pub laws: Vec<String>,
}

/// The result with one law.
struct HardnessAnswer {
    laws: String,
    /// Yield strength \[Pa\], if it was requested.
    yield_strength: Option<f64>,
    dent: Dent,
}

/// Runs the test for these arguments.
pub fn run(arguments: &Arguments, as_json: bool) -> Result<(), Box<dyn Error>> {
    let load = arguments.load.or(arguments.force).unwrap_or(f64::NAN);
    let load = positive("load", load).map_err(WrongCall::of)?;
    let hardness = arguments.brinell.map(|value| positive("brinell", value)).transpose().map_err(WrongCall::of)?;
    // the test is slow, whatever the scene's impact is
    let scene = scene_file::read_aloud(&arguments.scene)?.under_slow_load();
    let scene =
        scene.ok_or("the law can't be evaluated for the scene's impact, which gives the line of its power law")?;
    if let Some(radius) = scene.group_value(0, "target.radius") {
        let radius = quantity(radius, "m");
        return Err(format!("a Brinell test needs a flat target, and the scene has target.radius = {radius}").into());
    }
    if hardness.is_some() && scene.yield_strength.is_none() {
        let message =
            "the scene gives no target.yield_strength; give any, so that its law yields: --brinell replaces it";
        return Err(message.into());
    }
    let choices = laws::choose(&scene, &arguments.laws).map_err(WrongCall::of)?;
    // "all" includes Hertz's law, which leaves no dent
    let all = arguments.laws.iter().any(|name| name == "all");
    let choices: Vec<_> = choices.into_iter().filter(|choice| !all || choice.laws != "hertz").collect();
    let ball = 2.0 * scene.group_value(0, "impactor.radius").unwrap_or(f64::NAN);
    let measured = scene.measured(0, Body::Target).filter(|_| scene.softer(0) == Body::Target);
    let measured = measured.map(|measured| (measured, scene.two_bodies(0)));
    let answer = |choice: &Choice| -> Result<HardnessAnswer, String> {
        let (yield_strength, dent) = match hardness {
            Some(hardness) => {
                let (strength, dent) = strength_of(choice, load, ball, hardness)?;
                (Some(strength), dent)
            }
            None => (None, run_test(choice, load, ball, measured)?),
        };
        Ok(HardnessAnswer { laws: choice.laws.clone(), yield_strength, dent })
    };
    let mut answers = Vec::new();
    let mut left_out = Vec::new();
    for choice in &choices {
        match answer(choice) {
            Ok(answer) => answers.push(answer),
            // with several laws, one of them may have no result
            Err(reason) if choices.len() > 1 => left_out.push(reason),
            Err(reason) => return Err(reason.into()),
        }
    }
    let by_table = by_finite_elements(&scene, hardness, (ball, load));
    if as_json {
        let mut value = as_value(&answers, &left_out, load, ball, hardness);
        value["by_finite_elements"] = json!(by_table.map(|(number, stress, strain)| {
            json!({ "brinell_hardness": number, "flow_stress": stress, "strain": strain })
        }));
        print!("{}", json_line(&value));
        return Ok(());
    }
    print!("{}", text(&answers, &left_out, load, ball, hardness));
    // a given hardness replaces it
    if let Some((measured, _)) = measured.filter(|_| hardness.is_none()) {
        print!("\n{}", paragraph("note: ", &format!("target: {}.", measured.words())));
    }
    if let Some((number, stress, strain)) = by_table {
        let said = format!(
            "whatever the law, the mean pressure of finite elements with large deformation joins {} HBW with a flow stress of {} at a \
             plastic strain of {}, Tabor's 0.2 a/R of this dent. A scene with the hardness of its target takes its strength from there.",
            significant(number, 4),
            quantity(stress, "Pa"),
            significant(strain, 3)
        );
        print!("\n{}", paragraph("note: ", &said));
    }
    Ok(())
}

/// Brinell hardness, flow stress \[Pa\] of the scene's target and its strain by the table that readings in scenes use: of this `hardness`,
/// or of the scene's strength. `None` outside that table.
fn by_finite_elements(scene: &Scene, hardness: Option<f64>, test: (f64, f64)) -> Option<(f64, f64, f64)> {
    let [_, target] = scene.bodies(0);
    let brinell_contact::Body { youngs_modulus, poissons_ratio, .. } = target;
    let metal = Metal { youngs_modulus, poissons_ratio, class: Class::of_modulus(youngs_modulus), exponent: None };
    let strength = scene.group_value(0, Body::Target.yield_strength());
    let flow_stress = |strain: f64| match scene.measured(0, Body::Target) {
        Some(measured) => measured.at(strain),
        None => strength.unwrap_or(f64::INFINITY),
    };
    let number = hardness.or_else(|| measured::brinell_of(flow_stress, test, &metal))?;
    let (stress, strain) = measured::by_brinell(number, Some(test), &metal).ok()?;
    Some((number, stress, strain))
}

/// A warning about a dent.
#[derive(Clone, Copy, Debug, PartialEq)]
enum DentWarning {
    NoDent,
    WiderThanBall,
    BeyondLaw,
    Small,
}

impl DentWarning {
    const ALL: [DentWarning; 4] =
        [DentWarning::NoDent, DentWarning::WiderThanBall, DentWarning::BeyondLaw, DentWarning::Small];

    fn is_about(self, dent: &Dent) -> bool {
        let dented = dent.meyer.is_some();
        match self {
            DentWarning::NoDent => !dented,
            DentWarning::WiderThanBall => dented && dent.brinell.is_none(),
            DentWarning::BeyondLaw => dent.is_beyond_law(),
            DentWarning::Small => dented && dent.radius_ratio < ADMITTED.0,
        }
    }

    /// The warning in words. `ratio` is the `a/R` of one dent; `None` for several dents.
    fn words(self, ratio: Option<f64>) -> String {
        let ratio = ratio.map_or(String::new(), |ratio| format!(" = {}", significant(ratio, 3)));
        let (least, most) = ADMITTED;
        match self {
            DentWarning::NoDent => {
                "the load doesn't reach the yield point: it leaves no dent, and there is no hardness".into()
            }
            DentWarning::WiderThanBall => "the dent is wider than the ball: there is no Brinell hardness".into(),
            DentWarning::BeyondLaw => format!(
                "a/R{ratio} is beyond the validity of the laws, which ends at {LARGEST_RADIUS_RATIO}: a sphere is no longer a \
                 paraboloid there, and strains are large. Standard Brinell tests, with dents of {least} to {most} ball diameters, \
                 are mostly beyond it. Only brinell is corrected for large strain: up to 0.36 its hardness is within 1.5 % of finite \
                 elements with large deformation, up to 0.5 if E*/S is 100"
            ),
            DentWarning::Small => format!(
                "a/R{ratio}: the dent is smaller than ISO 6506-1 admits, which is {least} to {most} ball diameters"
            ),
        }
    }
}

/// The warnings about the dent with one law.
fn warnings(answer: &HardnessAnswer) -> Vec<String> {
    let dent = &answer.dent;
    let warnings = DentWarning::ALL.into_iter().filter(|warning| warning.is_about(dent));
    warnings.map(|warning| warning.words(Some(dent.radius_ratio))).collect()
}

/// The warnings about the dents with several laws. Each names its laws.
fn warnings_of_all(answers: &[HardnessAnswer]) -> Vec<String> {
    let of_all = |warning: DentWarning| {
        let laws = answers.iter().filter(|answer| warning.is_about(&answer.dent)).map(|answer| answer.laws.as_str());
        let laws: Vec<_> = laws.collect();
        (!laws.is_empty()).then(|| format!("{}. Laws: {}", warning.words(None), laws.join(", ")))
    };
    DentWarning::ALL.into_iter().filter_map(of_all).collect()
}

/// The results as text.
fn text(answers: &[HardnessAnswer], left_out: &[String], load: f64, ball: f64, hardness: Option<f64>) -> String {
    let ratio = significant(load_ratio(load, ball), 3);
    let ball_words = quantity(ball, "m");
    let load_words = quantity(load, "N");
    let heading = match hardness {
        Some(hardness) => format!("which yield strength gives HBW {hardness}"),
        None => "dent and hardness".into(),
    };
    let heading =
        format!("{heading}: ball of {ball_words}, load {load_words} (0.102 F/D^2 = {ratio} N/mm^2), quasi-static");
    let mut text = paragraph("", &heading);
    text.push('\n');
    if let [answer] = answers {
        text += &single(answer);
    } else {
        text += &rows(answers, hardness.is_some());
    }
    let warnings = match answers {
        [answer] => warnings(answer),
        answers => warnings_of_all(answers),
    };
    let lines = warnings.iter().map(|warning| ("warning: ", warning));
    for (heading, words) in lines.chain(left_out.iter().map(|reason| ("left out: ", reason))) {
        text.push('\n');
        text += &paragraph(heading, words);
    }
    text
}

/// All results with one law.
fn single(answer: &HardnessAnswer) -> String {
    let HardnessAnswer { laws, yield_strength, dent } = answer;
    let number = |value: Option<f64>| value.map_or("none".into(), |value| format!("{} HBW", significant(value, 4)));
    let meyer = dent.meyer.map_or("none".into(), |value| quantity(value, "Pa"));
    let diameter = format!("{} ({} of the ball's)", quantity(dent.diameter, "m"), significant(dent.radius_ratio, 3));
    let mut rows = vec![("law", laws.clone())];
    if let Some(strength) = yield_strength {
        rows.push(("yield strength", quantity(*strength, "Pa")));
    }
    rows.extend([
        ("Brinell hardness", number(dent.brinell)),
        ("Meyer hardness", meyer),
        ("diameter of the dent", if dent.meyer.is_some() { diameter } else { "none".into() }),
        ("depth after unloading", quantity(dent.depth, "m")),
        ("depth under the load", quantity(dent.max_indentation, "m")),
        ("mean pressure under the load", quantity(dent.mean_pressure, "Pa")),
        ("regime", regime::words(dent.regime).into()),
    ]);
    let rows: Vec<_> = rows.into_iter().map(|(name, value)| vec![name.to_string(), value]).collect();
    table(&rows, 2, 2)
}

/// A row for each law.
fn rows(answers: &[HardnessAnswer], turned_round: bool) -> String {
    let mut lines = vec![["law", "HBW", "Meyer", "diameter", "depth", "a/R"].map(String::from).to_vec()];
    if turned_round {
        lines[0].push("yield strength".into());
    }
    for HardnessAnswer { laws, yield_strength, dent } in answers {
        let mut line = vec![
            laws.clone(),
            dent.brinell.map_or("none".into(), |value| significant(value, 4)),
            dent.meyer.map_or("none".into(), |value| quantity(value, "Pa")),
            quantity(dent.diameter, "m"),
            quantity(dent.depth, "m"),
            significant(dent.radius_ratio, 3),
        ];
        line.extend(yield_strength.map(|strength| quantity(strength, "Pa")));
        lines.push(line);
    }
    table(&lines, 1, 0)
}

/// The results as JSON: all digits, SI units.
fn as_value(answers: &[HardnessAnswer], left_out: &[String], load: f64, ball: f64, hardness: Option<f64>) -> Value {
    let law = |answer: &HardnessAnswer| {
        let HardnessAnswer { laws, yield_strength, dent } = answer;
        let mut law = json!({
            "law": laws, "brinell_hardness": dent.brinell, "meyer_hardness": dent.meyer, "dent_diameter": dent.diameter,
            "dent_depth": dent.depth, "max_indentation": dent.max_indentation, "mean_pressure": dent.mean_pressure,
            "contact_radius_ratio": dent.radius_ratio, "regime": dent.regime as i32, "regime_name": regime::words(dent.regime),
            "warnings": warnings(answer),
        });
        if let Some(strength) = yield_strength {
            law["yield_strength"] = json!(strength);
        }
        law
    };
    let laws: Vec<_> = answers.iter().map(law).collect();
    json!({
        "load": load, "ball_diameter": ball, "load_ratio": load_ratio(load, ball), "asked_brinell_hardness": hardness,
        "laws": laws, "left_out": left_out,
    })
}
