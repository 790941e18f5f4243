//! `brinell laws`: what laws there are, and how good each is, measured when it is asked for. Choosing laws by name.

use crate::scene::Scene;
use crate::table;
use crate::truth;
use brinell::contact::history::LARGEST_INDENTATION;
use brinell::contact::loading::AnyLoading;
use brinell::contact::unloading::AnyUnloading;
use brinell::contact::{Loading, Model};
use serde::Serialize;

/// A model of the scene with laws that may be others than the scene's.
pub struct Choice {
    /// The laws' names.
    pub name: String,
    pub model: Model<AnyLoading, AnyUnloading>,
}

/// Laws that can't be had.
#[derive(Debug, thiserror::Error)]
pub enum UnknownLaw {
    #[error("unknown {kind} law `{name}`, expected one of `{known}`")]
    Name { kind: &'static str, name: String, known: String },
    #[error("{0}")]
    Pairing(String),
}

/// Unloading laws that were fitted to one loading law, in its units.
const FITTED_TO: [(&str, &str); 3] =
    [("etsion", "kogut-etsion"), ("jackson", "jackson-green"), ("vu-quoc-zhang", "vu-quoc-zhang")];

/// Loading laws that are above Hertz's curve in places, so that Hertz's curve can't be lowered to them.
const ABOVE_HERTZ: [&str; 7] =
    ["stronge", "kogut-etsion", "jackson-green", "ghaednia", "brake-2012-tangent", "brake-2012-line", "brake-2015"];

/// Refuses two laws that don't make sense together.
///
/// # Errors
/// Why they don't, and what does.
pub fn check_pairing(loading: &str, unloading: &str) -> Result<(), String> {
    let pair = format!("law.loading = \"{loading}\" doesn't go with law.unloading = \"{unloading}\"");
    if loading == "walton-braun" && unloading != "walton-braun" {
        return Err(format!("{pair}: it has no elastic part, and unloads by \"walton-braun\""));
    }
    if unloading == "hertz-shift" && ABOVE_HERTZ.contains(&loading) {
        return Err(format!("{pair}: its curve is above Hertz's in places, which can't be lowered to it"));
    }
    match FITTED_TO.iter().find(|(name, fitted)| *name == unloading && *fitted != loading) {
        Some((_, fitted)) => Err(format!("{pair}: that was fitted to the loading law \"{fitted}\"")),
        None => Ok(()),
    }
}

/// The unloading law of a scene that names none: "contact-radius", where it can be.
pub fn default_unloading(loading: &str) -> &'static str {
    if loading == "walton-braun" { "walton-braun" } else { "contact-radius" }
}

/// Loading laws that were published with an unloading law of another name.
const OWN_UNLOADING: [(&str, &str); 8] = [
    ("yigit-christoforou", "hertz-shift"),
    ("brake-2012-tangent", "thornton"),
    ("brake-2012-line", "thornton"),
    ("brake-2015", "thornton"),
    ("ghaednia", "thornton"),
    ("kogut-etsion", "etsion"),
    ("jackson-green", "jackson"),
    ("ma-liu", "thornton"),
];

/// The unloading that belongs to a loading law: the one it was published with, or the scene's.
fn unloading_of(loading: &str, scene: &Scene) -> (&'static str, AnyUnloading) {
    let published = OWN_UNLOADING.iter().find(|(name, _)| *name == loading).map_or(loading, |(_, own)| own);
    let own = AnyUnloading::ALL.into_iter().find(|(name, _)| *name == published);
    own.or(scene.unloading).unwrap_or(AnyUnloading::ALL[0])
}

/// The models that `names` mean: `LOADING` or `LOADING/UNLOADING`, or the scene's own if there are none; "all" is every law.
///
/// # Errors
/// [`UnknownLaw`]
pub fn choose(scene: &Scene, names: &[String]) -> Result<Vec<Choice>, UnknownLaw> {
    if names.is_empty() {
        let guard = if scene.passivity_guard { " guarded" } else { "" };
        return Ok(vec![Choice { name: format!("{}{guard}", scene.loading.0), model: scene.model() }]);
    }
    let all: Vec<String> = AnyLoading::ALL.iter().map(|(name, _)| (*name).to_string()).collect();
    let names = if names == ["all"] { &all } else { names };
    names.iter().map(|name| choose_one(scene, name)).collect()
}

fn choose_one(scene: &Scene, name: &str) -> Result<Choice, UnknownLaw> {
    let (loading_name, unloading_name) = name.split_once('/').map_or((name, None), |(one, other)| (one, Some(other)));
    let unknown = |kind, name: &str, known: Vec<&str>| {
        let (name, known) = (name.into(), known.join("`, `"));
        UnknownLaw::Name { kind, name, known }
    };
    let loading = AnyLoading::ALL.into_iter().find(|(known, _)| *known == loading_name);
    let known = || AnyLoading::ALL.iter().map(|(name, _)| *name).collect();
    let (_, loading) = loading.ok_or_else(|| unknown("loading", loading_name, known()))?;
    let unloading = match unloading_name {
        None => Some(unloading_of(loading_name, scene)),
        Some(asked) => AnyUnloading::ALL.into_iter().find(|(known, _)| *known == asked),
    };
    let known = || AnyUnloading::ALL.iter().map(|(name, _)| *name).collect();
    let asked = unloading_name.unwrap_or_default();
    let (chosen, unloading) = unloading.ok_or_else(|| unknown("unloading", asked, known()))?;
    if loading_name != "hertz" {
        check_pairing(loading_name, chosen).map_err(UnknownLaw::Pairing)?;
    }
    Ok(Choice { name: name.into(), model: Model { loading, unloading, ..scene.model() } })
}

/// What was measured of a loading law.
#[derive(Debug, Serialize)]
pub struct Measured {
    pub name: &'static str,
    pub title: String,
    /// Unloading law with which the energy was measured.
    pub unloading: &'static str,
    /// Largest jump of the force at a corner, relative to the force.
    pub largest_jump: f64,
    /// Largest restitution over all depths: above 1 the law makes energy.
    pub largest_restitution: f64,
    /// Largest error of the loading force against the truth.
    pub worst_error: f64,
    /// Where, in yield indentations.
    pub worst_at: f64,
    /// Root mean square of that error.
    pub rms_error: f64,
    pub validity: String,
    pub reference: String,
}

/// Measures every loading law on the bodies of `scene`.
pub fn measure_all(scene: &Scene) -> Vec<Measured> {
    AnyLoading::ALL.into_iter().map(|(name, loading)| measure(scene, name, loading)).collect()
}

fn measure(scene: &Scene, name: &'static str, loading: AnyLoading) -> Measured {
    let (unloading_name, unloading) = unloading_of(name, scene);
    let model = Model { loading, unloading, ..scene.model() };
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
    // fine enough to see the narrow range just above yield where some laws make energy
    let depths = (0..=2000).map(|step| unit.indentation * 10f64.powf(f64::from(step) / 500.0 - 1.0));
    let returned = |d: f64| (model.recovered_work(d, d) / loading.work(&model.pair, d)).sqrt();
    let largest_restitution = depths.map(returned).fold(0.0, f64::max);
    let law = table::loading_law(name);
    Measured {
        name,
        title: law.title.clone(),
        unloading: unloading_name,
        // a few units in the last place are no jump
        largest_jump: if largest_jump.abs() < 1e-12 { 0.0 } else { largest_jump },
        largest_restitution,
        worst_error,
        worst_at,
        rms_error: (squares / points.len() as f64).sqrt(),
        validity: law.notes.clone(),
        reference: law.reference.clone(),
    }
}

/// The table for people.
pub fn print(measured: &[Measured]) {
    println!(
        "loading laws; error of the force against finite elements up to 1000 yield indentations (truth/README.md)\n"
    );
    println!("{:<22}{:>16}{:>9}{:>10}   energy", "law", "worst error", "rms", "jump");
    for law in measured {
        let percent = |value: f64| format!("{:+.1} %", 100.0 * value);
        let jump = if law.largest_jump == 0.0 { "none".into() } else { percent(law.largest_jump) };
        let energy = match law.largest_restitution {
            e if e <= 1.0 + 1e-12 => format!("passive (with {})", law.unloading),
            e => format!("makes energy: restitution up to {e:.4} (with {})", law.unloading),
        };
        let worst = format!("{} at {:.4}", percent(law.worst_error), law.worst_at);
        let rms = format!("{:.1} %", 100.0 * law.rms_error);
        println!("{:<22}{worst:>16}{rms:>9}{jump:>10}   {energy}", law.name);
    }
    println!("\nvalidity and reference");
    for law in measured {
        println!("{:<22}{} {}.", law.name, law.validity, law.reference);
    }
    println!("\nunloading laws");
    for (name, _) in AnyUnloading::ALL {
        let law = table::unloading_law(name);
        println!("{name:<22}{} {}.", law.notes, law.reference);
    }
}
