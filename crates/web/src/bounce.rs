//! Bodies that fall on the contacts of a scene, in the hands of a master that may be the wrong one.
//!
//! The FMU is that of the scene with the lines that the way to couple needs. Contacts of their own have a body each. Contacts that share
//! bodies move with the inverse masses of the scene; what stands on the ground is accelerated by gravity.

use crate::Refused;
use crate::text::{self, Edit};
use crate::unit::{self, Unit};
use brinell_exporter::master::{
    Body, COUPLING_METHODS, Coupled, CouplingMethod, JACOBI_MASS, MASS_KNOWN, Requirements,
};
use brinell_exporter::numbers::quantity;
use brinell_exporter::plan::Plan;
use brinell_exporter::prebuilt::{Library, PrebuiltUnit};
use brinell_exporter::scene::{InverseMasses, Scene, place};
use brinell_fmu::instance::{Cause, Fault, Warning};
use brinell_fmu::scene::Real;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::mem::{Discriminant, discriminant};

/// Largest number of steps, each with all contacts of all instances.
const MOST: f64 = 2e6;

/// Number of moments in an answer.
const MOMENTS: usize = 1200;

/// Largest number of rebounds in an answer.
const REBOUNDS: usize = 40;

/// The way whose FMU has the lines, the way of the master, and the words.
struct Choice {
    name: &'static str,
    what: &'static str,
    unit: &'static CouplingMethod,
    master: &'static CouplingMethod,
}

/// The wrong ways: the FMU expects another master.
const WRONG: [Choice; 2] = [
    Choice {
        name: "serial FMU, parallel master",
        what: "the FMU expects that its force acts in the same step; the master is one step late",
        unit: &MASS_KNOWN,
        master: &JACOBI_MASS,
    },
    Choice {
        name: "parallel FMU, serial master",
        what: "the FMU expects that its force acts one step late; the master applies it at once",
        unit: &JACOBI_MASS,
        master: &MASS_KNOWN,
    },
];

impl Choice {
    fn is_right(&self) -> bool {
        self.unit.name == self.master.name
    }
}

fn choices() -> impl Iterator<Item = Choice> {
    let right = COUPLING_METHODS.iter().map(|way| Choice { name: way.name, what: way.what, unit: way, master: way });
    right.chain(WRONG)
}

/// The ways to couple.
pub fn ways() -> Value {
    let way = |choice: Choice| {
        json!({
            "name": choice.name, "what": choice.what, "master": choice.master.master.name(), "right": choice.is_right(),
            "knows_mass": choice.unit.needs.knows_mass(),
        })
    };
    choices().map(way).collect()
}

/// Bodies that fall.
#[derive(Deserialize)]
pub struct Asked {
    text: String,
    way: String,
    /// \[s\]
    step: f64,
    time: f64,
    /// Height of fall \[m\].
    height: f64,
    #[serde(default = "gravity")]
    gravity: f64,
}

fn gravity() -> f64 {
    9.806_65
}

/// A contact of the instance.
struct At<'a> {
    unit: &'a mut dyn Unit,
    contact: usize,
    time: f64,
    /// Whether the acceleration is an input.
    has_input: bool,
}

impl Coupled for At<'_> {
    type Error = Fault;

    fn set_rate(&mut self, rate: f64) -> Result<(), Fault> {
        self.unit.set(Real::IndentationRate, self.contact, rate)
    }

    fn set_derivatives(&mut self, derivatives: &[f64]) -> Result<(), Fault> {
        if self.has_input {
            let first = derivatives.first().copied().unwrap_or(0.0);
            return self.unit.set(Real::ExternalAcceleration, self.contact, first);
        }
        let mut orders = (1..).zip(derivatives);
        orders.try_for_each(|(order, value)| self.unit.set_derivative(self.contact, order, *value))
    }

    fn step(&mut self, step: f64) -> Result<(), Fault> {
        self.unit.step(self.time, step)
    }

    fn force(&mut self) -> Result<f64, Fault> {
        Ok(self.unit.get(Real::Force, self.contact))
    }

    fn force_slope(&mut self) -> Result<f64, Fault> {
        self.unit.slope(self.contact)
    }

    fn mean_force(&mut self) -> Result<f64, Fault> {
        Ok(self.unit.get(Real::MeanForce, self.contact))
    }

    fn predicted_force(&mut self) -> Result<f64, Fault> {
        Ok(self.unit.get(Real::PredictedForce, self.contact))
    }
}

/// What the page draws.
#[derive(Default, Serialize)]
struct Seen {
    time: Vec<f64>,
    /// Gap of each contact \[m\]; negative where the bodies press.
    gaps: Vec<Vec<f64>>,
    /// Largest force since the last moment \[N\], of all contacts.
    force: Vec<f64>,
    rebounds: Vec<Rebound>,
    messages: Vec<String>,
}

/// A contact that came to an end.
#[derive(Serialize)]
struct Rebound {
    contact: usize,
    /// End of the contact \[s\].
    time: f64,
    /// Speeds before and after \[m/s\].
    speed_in: f64,
    speed_out: f64,
    restitution: f64,
    /// Number of steps in which there was a force.
    steps: u32,
    /// \[N\]
    largest_force: f64,
}

/// The scene with the lines that `way` needs, and the height of fall as a gap. Nothing moves along the surface, so friction is left out
/// where the FMU would have to know more of the bodies for it.
fn edited(asked: &Asked, scene: &Scene, way: &CouplingMethod) -> Result<String, Refused> {
    let mut edits = vec![Edit::of(&["fmu", "standalone"], Value::Null)];
    let tables = scene.contacts.len();
    let is_listed = scene.contacts[0].name.is_some();
    if scene.inverse_masses().is_none() {
        edits.extend([Edit::of(&["coupling"], Value::Null), Edit::of(&["friction"], Value::Null)]);
        if is_listed {
            edits.extend((0..tables).map(|index| Edit::of_contact(index, "friction", Value::Null)));
        }
        let outputs: &[&str] = match way.needs {
            Requirements::PredictedForce => &["predicted_force"],
            Requirements::MeanForce | Requirements::Mass | Requirements::JacobiMass => &["mean_force"],
            Requirements::Force => &[],
        };
        edits.extend([Edit::of(&["fmu", "outputs"], json!(outputs)), Edit::of(&["fmu", "parameters"], Value::Null)]);
        if way.needs.knows_mass() {
            edits.push(Edit::of(&["coupling", "effective_mass"], json!(scene.impact.mass)));
        } else if is_listed {
            edits.extend((0..tables).map(|index| Edit::of_contact(index, "effective_mass", Value::Null)));
        }
        if way.needs == Requirements::JacobiMass {
            edits.push(Edit::of(&["coupling", "master"], json!("parallel")));
        }
    }
    let stand = stand(scene);
    let hits = |index: usize| if in_the_air(&stand) { index == 0 } else { stand[index] };
    let falls = |index: &usize| scene.inverse_masses().is_none() || hits(*index);
    let gap = json!(asked.height);
    match is_listed {
        false => edits.push(Edit::of(&["fmu", "initial_gap"], gap)),
        true => {
            edits.extend((0..tables).filter(falls).map(|index| Edit::of_contact(index, "initial_gap", gap.clone())))
        }
    }
    text::edited(&asked.text, &edits)
}

/// Of each contact that shares bodies, whether one of them is the ground.
fn stand(scene: &Scene) -> Vec<bool> {
    let table: toml::Table = scene.text.parse().unwrap_or_default();
    let contacts = table.get("contact").and_then(toml::Value::as_array);
    let stands = |contact: &toml::Value| {
        let between = contact.get("between").and_then(toml::Value::as_array);
        between.is_some_and(|names| names.iter().any(|name| name.as_str() == Some("ground")))
    };
    contacts.into_iter().flatten().map(stands).collect()
}

/// Whether no contact is on the ground: the first one is then hit as fast as a fall would be.
fn in_the_air(stand: &[bool]) -> bool {
    !stand.contains(&true)
}

/// Lets the bodies fall.
pub fn bounce(asked: &Asked) -> Result<Value, Refused> {
    let Asked { step, time, height, gravity, .. } = *asked;
    for (name, value) in [("step", step), ("time", time), ("height", height)] {
        if !(value > 0.0 && value.is_finite()) {
            return Err(format!("{name} = {value} must be positive and finite").into());
        }
    }
    let choice = choices().find(|choice| choice.name == asked.way);
    let choice = choice.ok_or_else(|| format!("there is no way to couple `{}`", asked.way))?;
    let (given, _) = text::scene(&asked.text)?;
    let (scene, _) = text::scene(&edited(asked, &given, choice.unit)?)?;
    let contacts = scene.contact_count();
    // each body has an instance of its own, with all contacts
    let updates = time / step * (contacts * contacts) as f64;
    if updates > MOST {
        let most = MOST / (contacts * contacts) as f64;
        return Err(format!(
            "{:.0} steps of {contacts} contacts are too many for a page: allowed are {most:.0}",
            time / step
        )
        .into());
    }
    let shared = Shared::of(&scene, gravity)?;
    let count = if shared.is_some() { 1 } else { contacts };
    let mut units = unit::instances(&PrebuiltUnit::of(&Plan::of(&scene), "")?, count)?;
    units.iter_mut().try_for_each(|unit| unit.start()).map_err(|fault| refusal(&fault))?;
    let groups = scene.contacts.iter().enumerate().flat_map(|(index, group)| std::iter::repeat_n(index, group.size()));
    let body = |group: usize| {
        let mass = given.impact_of(group).mass;
        let mut body = Body::flying(mass, 0.0);
        body.load = mass * gravity;
        body
    };
    let mut bodies: Vec<Body> = groups.map(body).collect();
    if shared.is_some() && in_the_air(&stand(&scene)) {
        bodies[0].speed = (2.0 * gravity * height).sqrt();
    }
    let run = Run {
        units,
        bodies,
        shared,
        has_input: scene.has_input("external_acceleration"),
        going: vec![None; contacts],
        warned: Vec::new(),
        seen: Seen { gaps: vec![Vec::new(); contacts], ..Seen::default() },
    };
    let seen = run.follow(choice.master, (step, time));
    Ok(json!({ "scene": scene.text, "library": Library::of(&scene).name, "seen": seen }))
}

/// Bodies that contacts share: the inverse masses, the accelerations of their rates by gravity, and whether the forces act a step late.
struct Shared {
    entries: Vec<f64>,
    accelerations: Vec<f64>,
    rows: usize,
    is_late: bool,
}

impl Shared {
    /// Those of the scene, if its contacts share bodies. Gravity accelerates what stands on the ground.
    fn of(scene: &Scene, gravity: f64) -> Result<Option<Shared>, Refused> {
        let entries = match scene.inverse_masses() {
            None => return Ok(None),
            Some(InverseMasses::Inputs) => {
                return Err("the inverse masses are inputs, which the page does not know".into());
            }
            Some(InverseMasses::Constant { entries, .. }) => entries.clone(),
        };
        let accelerations = stand(scene).into_iter().map(|stands| if stands { gravity } else { 0.0 }).collect();
        let is_late = scene.is_parallel();
        Ok(Some(Shared { entries, accelerations, rows: scene.rows(), is_late }))
    }

    /// A step of all contacts, and what it does to their rates.
    fn step(
        &self,
        unit: &mut dyn Unit,
        bodies: &mut [Body],
        has_input: bool,
        (time, step): (f64, f64),
    ) -> Result<(), Fault> {
        for (contact, (body, acceleration)) in bodies.iter().zip(&self.accelerations).enumerate() {
            unit.set(Real::IndentationRate, contact, body.speed)?;
            let mut at = At { unit: &mut *unit, contact, time, has_input };
            at.set_derivatives(&[*acceleration])?;
        }
        unit.step(time, step)?;
        let means: Vec<f64> = (0..bodies.len()).map(|contact| unit.get(Real::MeanForce, contact)).collect();
        let forces: Vec<f64> = match self.is_late {
            true => {
                bodies.iter_mut().zip(&means).map(|(body, mean)| std::mem::replace(&mut body.owed, *mean)).collect()
            }
            false => means,
        };
        for (row, body) in bodies.iter_mut().enumerate() {
            let entry = |column: usize| self.entries[place(self.rows, row, column)];
            let by_forces: f64 = forces.iter().enumerate().map(|(column, force)| entry(column) * force).sum();
            body.speed += step * (self.accelerations[row] - by_forces);
            body.force = unit.get(Real::Force, row);
        }
        Ok(())
    }
}

/// A contact that goes on.
#[derive(Clone, Copy)]
struct Going {
    speed_in: f64,
    steps: u32,
    largest_force: f64,
}

/// The bodies, one for each contact, and what was seen.
struct Run<'a> {
    /// One instance for all contacts that share bodies, otherwise one for each contact.
    units: Vec<&'a mut dyn Unit>,
    bodies: Vec<Body>,
    shared: Option<Shared>,
    /// Whether accelerations are an input.
    has_input: bool,
    going: Vec<Option<Going>>,
    warned: Vec<Discriminant<Warning>>,
    seen: Seen,
}

impl Run<'_> {
    fn follow(mut self, way: &CouplingMethod, (step, end): (f64, f64)) -> Seen {
        let steps = (end / step).ceil() as usize;
        let every = steps.div_ceil(MOMENTS).max(1);
        let mut largest: f64 = 0.0;
        for done in 0..steps {
            let time = done as f64 * step;
            let before: Vec<f64> = (0..self.bodies.len()).map(|contact| self.speed(contact, step)).collect();
            if let Err(fault) = self.step(way, time, step) {
                self.seen.messages.push(format!("at {}: {}", quantity(time, "s"), refusal(&fault)));
                break;
            }
            for warning in self.units.iter_mut().filter_map(|unit| unit.warning()) {
                // an FMU warns once of each
                if !self.warned.contains(&discriminant(&warning)) {
                    self.warned.push(discriminant(&warning));
                    self.seen.messages.push(format!("at {}: {}", quantity(time, "s"), words(&warning)));
                }
            }
            self.note(&before, time + step, step);
            largest = self.bodies.iter().fold(largest, |largest, body| largest.max(body.force));
            if done % every == 0 || done + 1 == steps {
                self.seen.time.push(time + step);
                self.seen.force.push(std::mem::take(&mut largest));
                for contact in 0..self.bodies.len() {
                    let gap = self.gap(contact);
                    self.seen.gaps[contact].push(gap);
                }
            }
        }
        self.seen
    }

    /// The gap of a contact \[m\].
    fn gap(&self, contact: usize) -> f64 {
        -self.units[contact.min(self.units.len() - 1)].get(Real::Indentation, contact)
    }

    /// The speed with which a body will close its gap, or opened it \[m/s\]: gravity is not a loss.
    fn speed(&self, contact: usize, step: f64) -> f64 {
        let body = &self.bodies[contact];
        let acceleration = self.shared.as_ref().map_or(body.load / body.mass, |shared| shared.accelerations[contact]);
        let speed = body.settled_speed(step);
        (speed * speed + 2.0 * acceleration * self.gap(contact).max(0.0)).sqrt().copysign(speed)
    }

    /// A step of all contacts and their bodies.
    fn step(&mut self, way: &CouplingMethod, time: f64, step: f64) -> Result<(), Fault> {
        if let Some(shared) = &self.shared {
            return shared.step(self.units[0], &mut self.bodies, self.has_input, (time, step));
        }
        for (contact, (body, unit)) in self.bodies.iter_mut().zip(&mut self.units).enumerate() {
            let mut at = At { unit: &mut **unit, contact, time, has_input: self.has_input };
            way.advance(&mut at, body, step)?;
        }
        Ok(())
    }

    /// Notes contacts that begin and end. The bodies had the speeds `before`.
    fn note(&mut self, before: &[f64], time: f64, step: f64) {
        for (contact, before) in before.iter().enumerate() {
            let speed = self.speed(contact, step);
            let (body, going) = (&self.bodies[contact], &mut self.going[contact]);
            // one that is shorter than a step shows in its momentum only
            let passed = body.force <= 0.0 && going.is_none() && *before > 0.0 && speed < 0.0;
            if body.force > 0.0 || passed {
                let Going { speed_in, steps, largest_force } =
                    going.unwrap_or(Going { speed_in: *before, steps: 0, largest_force: 0.0 });
                *going = Some(Going { speed_in, steps: steps + 1, largest_force: largest_force.max(body.force) });
            }
            if let (Some(Going { speed_in, steps, largest_force }), true) = (*going, body.force <= 0.0) {
                *going = None;
                let speed_out = -speed;
                // bodies at rest that part don't rebound
                if self.seen.rebounds.len() < REBOUNDS && speed_in > 0.0 {
                    let restitution = speed_out / speed_in;
                    let rebound = Rebound { contact, time, speed_in, speed_out, restitution, steps, largest_force };
                    self.seen.rebounds.push(rebound);
                }
            }
        }
    }
}

/// Why the FMU refuses a step, in words.
fn refusal(fault: &Fault) -> String {
    match fault {
        Fault::TooDeep { indentation, .. } => {
            format!("the FMU refuses a step: at {} the law can't be evaluated", quantity(*indentation, "m"))
        }
        Fault::TooWide { size, .. } => format!(
            "the FMU refuses a step: a contact is as wide as the smaller body, whose radius is {}, and no law holds",
            quantity(*size, "m")
        ),
        Fault::NoInputDerivatives => "the FMU takes no input derivatives: its law depends on the rate".into(),
        other => format!("the FMU refuses a step: {other:?}"),
    }
}

/// A warning in words.
fn words(warning: &Warning) -> String {
    match warning {
        Warning::Miswired { rate, expected, cause: Cause::Order { parallel }, .. } => {
            let [is, should] = if *parallel { ["at once", "one step late"] } else { ["one step late", "at once"] };
            format!(
                "the FMU warns: it was made for a master that applies its force {should}, and this one applies it {is} \
                 (rate {}, expected {})",
                quantity(*rate, "m/s"),
                quantity(*expected, "m/s")
            )
        }
        Warning::Miswired { rate, expected, .. } => format!(
            "the FMU warns: the bodies don't move as it expects (rate {}, expected {})",
            quantity(*rate, "m/s"),
            quantity(*expected, "m/s")
        ),
        Warning::Deep { indentation, allowed, .. } => format!(
            "the FMU warns: the contact is wider than its law allows ({}, allowed {})",
            quantity(*indentation, "m"),
            quantity(*allowed, "m")
        ),
        Warning::Unstable { step, .. } => {
            format!("the FMU warns: steps of {} are too long for this way to couple", quantity(*step, "s"))
        }
        Warning::Late => "the FMU warns: the master applies the force one step late".into(),
        Warning::Fast { rate, allowed, .. } => format!(
            "the FMU warns: {} is fast, and elastic waves count above {}",
            quantity(*rate, "m/s"),
            quantity(*allowed, "m/s")
        ),
        Warning::Guarded => "the passivity guard acts".into(),
    }
}
