//! `brinell laws`: the laws, each evaluated when the command runs.

mod chart;
pub mod experiment;
mod materials;
mod single;
mod text;

use crate::curve;
use crate::energy::{self, Balance};
use crate::files::{self, deliver, ending};
use crate::law_text::{self, LawText};
use crate::laws::{self, unloading_of};
use crate::model::{Dampings, strengthened};
use crate::parameters::{self, Constant};
use crate::scene::Scene;
use crate::table;
use crate::truth;
use crate::wrong_call::WrongCall;
use brinell::contact::damped::{self, AnyDamped};
use brinell::contact::impact::Impact;
use brinell::contact::loading::AnyLoading;
use brinell::contact::regime::LARGEST_INDENTATION;
use brinell::contact::unloading::AnyUnloading;
use brinell::contact::{Loading, Model};
use materials::Errors;
use serde::Serialize;
use std::error::Error;
use std::path::PathBuf;

/// The arguments of `brinell laws`.
#[derive(clap::Args)]
#[command(next_line_help = true)]
pub struct Arguments {
    /// A law to show with its formulas, constants, validity and curve [default: list all]
    pub name: Option<String>,
    /// Draw instead: the curve of the law, or the loading curves of all laws over Hertz's force
    #[arg(short, long, value_name = "FILE.svg")]
    pub output: Option<PathBuf>,
    /// Compare every law, or the named one, with measured rebounds and dents
    #[arg(long, conflicts_with = "output")]
    pub experiment: bool,
}

/// The command: lists the laws, shows one of them, or draws curves to a file.
pub fn run(arguments: &Arguments, as_json: bool) -> Result<(), Box<dyn Error>> {
    let Arguments { name, output, experiment } = arguments;
    let output = output.as_deref();
    if let Some(path) = output {
        ending(output, &["svg"]).map_err(WrongCall)?;
        files::check_goal(path)?;
    }
    if *experiment {
        return experiment::run(name.as_deref(), as_json);
    }
    let scene = Scene::default_scene()?;
    if let Some(name) = name {
        return single::run(&scene, name, output, as_json);
    }
    if output.is_some() {
        let choices = laws::choose(&scene, &["all".to_string()])?;
        return Ok(deliver(&curve::over_hertz(&choices), output)?);
    }
    let list = all(&scene);
    if as_json {
        println!("{}", serde_json::to_string(&list)?);
    } else {
        print!("{}", text::list(&list));
    }
    Ok(())
}

/// All laws.
#[derive(Debug, Serialize)]
pub struct List {
    pub loading: Vec<Measured>,
    pub unloading: Vec<Told>,
    pub damped: Vec<Rated>,
}

/// Measurements and description of a loading law.
#[derive(Debug, Serialize)]
pub struct Measured {
    pub name: &'static str,
    pub title: &'static str,
    /// Unloading law used for the energy.
    pub unloading: &'static str,
    pub continuous: bool,
    /// Largest jump of the force at a corner, relative to the force.
    pub largest_jump: f64,
    /// Whether the law is passive with that unloading law, for all bodies.
    pub passive: bool,
    /// The Poisson's ratio of the target from which it is passive, if it is not below.
    pub passive_from_poissons_ratio: Option<f64>,
    /// Largest restitution over all depths, for targets with a Poisson's ratio of at least 0.
    pub largest_restitution: f64,
    /// The same for targets with a Poisson's ratio below 0.
    pub largest_auxetic_restitution: f64,
    /// Largest error of the loading force relative to finite elements.
    pub worst_error: f64,
    /// Its position, in yield indentations.
    pub worst_at: f64,
    /// Root mean square of that error.
    pub rms_error: f64,
    /// Errors relative to finite elements of other materials, for a law that has a form for them.
    pub materials: Vec<Errors>,
    pub formulas: Vec<String>,
    pub parameters: Vec<Constant>,
    pub validity: String,
    pub notes: String,
    pub reference: &'static str,
}

/// Description of an unloading law.
#[derive(Debug, Serialize)]
pub struct Told {
    pub name: &'static str,
    pub title: &'static str,
    pub formulas: Vec<String>,
    pub parameters: Vec<Constant>,
    pub notes: String,
    pub reference: &'static str,
}

/// Measurements and description of a rate-dependent law with one of its damping variants.
#[derive(Clone, Debug, Serialize)]
pub struct Rated {
    pub name: String,
    pub title: &'static str,
    /// Force just after the first touch over the largest force; above 0, the force jumps.
    pub force_at_touch: f64,
    /// Restitution of an impact at 1 m/s if 0.5 is required. Laws that specify their damping directly have their own
    /// restitution.
    pub restitution: f64,
    pub formulas: Vec<String>,
    pub parameters: Vec<Constant>,
    pub validity: String,
    pub notes: String,
    pub reference: &'static str,
}

/// The required restitution of the rate-dependent laws.
const ASKED: f64 = 0.5;

/// All laws. The loading laws are evaluated on the bodies of `scene`.
pub fn all(scene: &Scene) -> List {
    those(scene, |_| true)
}

/// The laws whose names are `wanted`; measuring a law takes a while.
pub fn those(scene: &Scene, wanted: impl Fn(&str) -> bool) -> List {
    let loading = AnyLoading::ALL.into_iter().filter(|(name, _)| wanted(name));
    let loading = loading.map(|(name, loading)| measure(scene, name, loading)).collect();
    let unloading = AnyUnloading::ALL.into_iter().filter(|(name, _)| wanted(name));
    let unloading = unloading.map(|(name, law)| tell(name, &law)).collect();
    let damped = AnyDamped::ALL.into_iter().filter(|(name, _)| wanted(name)).flat_map(|(name, law)| {
        let dampings = law.dampings();
        let named = |damping: &&str| (format!("{name}/{damping}"), law.with_damping(damping).expect("one of its own"));
        let variants: Vec<_> = dampings.iter().map(named).collect();
        let variants = if variants.is_empty() { vec![(name.to_string(), law)] } else { variants };
        variants.into_iter().map(move |(variant, law)| rate(scene, name, variant, law))
    });
    List { loading, unloading, damped: damped.collect() }
}

/// The measurements of a law with the scene's bodies and mass.
fn rate(scene: &Scene, name: &str, variant: String, law: AnyDamped) -> Rated {
    let impact = Impact { mass: scene.impact.mass, speed: 1.0 };
    let model = damped::Model { pair: scene.model().pair, law, restitution: ASKED, mass: impact.mass };
    let prediction = damped::impact::predict(&model, &impact).expect("an impact within range");
    let mut touched = damped::History::start(&model, 0.0).expect("zero is within range");
    let hardly = 1e-12 * prediction.max_indentation;
    touched.advance(impact.speed, hardly / impact.speed).expect("within range");
    let LawText { law: told, formulas, notes, validity, .. } = law_text::damped(name, &law);
    Rated {
        name: variant,
        title: &told.title,
        force_at_touch: touched.force(impact.speed) / prediction.max_force,
        restitution: prediction.restitution,
        formulas,
        parameters: parameters::constants(&law, told),
        validity,
        notes,
        reference: &told.reference,
    }
}

fn tell(name: &'static str, law: &AnyUnloading) -> Told {
    let LawText { law: told, formulas, notes, .. } = law_text::unloading(name, law);
    let parameters = parameters::constants(law, told);
    Told { name, title: &told.title, formulas, parameters, notes, reference: &told.reference }
}

/// Smaller jumps are rounding.
const ROUNDING: f64 = 1e-12;

/// The energy balance of a law on all bodies: those with a Poisson's ratio of at least 0, and the others.
fn balances(name: &str, model: &Model<AnyLoading, AnyUnloading>) -> [Balance; 2] {
    let depends = table::loading_law(name).depends_on_modulus_ratio;
    let one = (energy::ANY_MODULUS_RATIO, energy::ANY_MODULUS_RATIO);
    let modulus_ratio = if depends { energy::MODULUS_RATIO } else { one };
    let (low, high) = energy::POISSONS_RATIO;
    [(0.0, high), (low, 0.0_f64.next_down())].map(|poissons_ratio| {
        let bodies = energy::bodies(&model.pair, poissons_ratio, modulus_ratio);
        bodies.map(|pair| energy::balance(&Model { pair, ..*model })).fold(Balance::default(), Balance::and)
    })
}

fn measure(scene: &Scene, name: &'static str, loading: AnyLoading) -> Measured {
    let (unloading_name, unloading) = unloading_of(name);
    let model = Model { loading, unloading, ..scene.model() };
    let model = strengthened(&model, 0.0);
    let unit = model.pair.yield_point(truth::YIELD_PRESSURE_FACTOR);
    let force = |d: f64| loading.segment(&model.pair, d).force(d);
    let (mut worst_error, mut worst_at, mut squares) = (0.0f64, 0.0, 0.0);
    let points = truth::loading();
    for point in &points {
        let error = force(point.x * unit.indentation) / (point.f * unit.force) - 1.0;
        squares += error * error;
        if error.abs() > worst_error.abs() {
            (worst_error, worst_at) = (error, point.x);
        }
    }
    let mut largest_jump = 0.0f64;
    let mut corner = loading.next_corner(&model.pair, 0.0);
    while corner < 1e4 * unit.indentation && corner < LARGEST_INDENTATION {
        let (below, above) = (force(corner.next_down()), force(corner));
        let jump = (above - below) / above;
        largest_jump = if jump.abs() > largest_jump.abs() { jump } else { largest_jump };
        corner = loading.next_corner(&model.pair, corner);
    }
    let continuous = largest_jump.abs() < ROUNDING;
    let [metals, auxetic] = balances(name, &model);
    let LawText { law: told, formulas, notes, validity, .. } = law_text::loading(name, &loading);
    Measured {
        name,
        title: &told.title,
        unloading: unloading_name,
        continuous,
        largest_jump: if continuous { 0.0 } else { largest_jump },
        passive: !metals.and(auxetic).falls,
        passive_from_poissons_ratio: energy::passive_from(name, unloading_name),
        largest_restitution: metals.largest_restitution,
        largest_auxetic_restitution: auxetic.largest_restitution,
        worst_error,
        worst_at,
        rms_error: (squares / points.len() as f64).sqrt(),
        materials: if loading.strengthened(0.0).is_some() { materials::errors(&model) } else { Vec::new() },
        formulas,
        parameters: parameters::constants(&loading, told),
        validity,
        notes,
        reference: &told.reference,
    }
}
