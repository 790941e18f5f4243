//! `documentation/index.html` of an FMU: overview, law with a picture, variables.

use crate::accuracy::accuracy;
use crate::bodies;
use crate::energy;
use crate::first_lines;
use crate::friction_text;
use crate::html::{TEXT_STYLE, begin, escape, number, prose, quantity, unit};
use crate::interface::Entry;
use crate::law_text::{self, LawText};
use crate::numbers::{self, digits};
use crate::parameters::{self, LawConstant};
use crate::plan::{self, Plan};
use crate::plot::{Picture, Series};
use crate::scene::{Coupling, InverseMasses, Loss, Masses, Parameter, Scene, SceneLaws};
use crate::strength_text;
use crate::table::{self, Causality};
use brinell_contact::impact::Prediction;
use std::collections::BTreeSet;
use std::fmt::Write;

/// The page of the planned FMU.
pub fn write(plan: &Plan) -> String {
    let mut page = String::new();
    body(&mut page, plan).expect("a String takes everything");
    page
}

fn body(page: &mut String, plan: &Plan) -> std::fmt::Result {
    let scene = plan.scene;
    let (name, description) = (escape(&scene.name), escape(&scene.description));
    begin(page, &name, TEXT_STYLE)?;
    writeln!(page, "<h1>{name}</h1>\n<p>{description}</p>")?;
    first_lines::section(page, plan)?;
    writeln!(
        page,
        "<h2>Coupling</h2>\n<p>FMU (FMI 2.0 co-simulation) of the {} contact of {}. {}</p>",
        if scene.has_friction() { "normal and tangential" } else { "normal" },
        contact(scene),
        coupling(scene)
    )?;
    contacts(page, scene)?;
    writeln!(page, "<h2>The scene&#8217;s impact</h2>")?;
    impact(page, plan)?;
    writeln!(page, "<figure>\n{}</figure>", curve(plan))?;
    writeln!(page, "<h2>Law</h2>")?;
    if let SceneLaws::Damped(name, damped) = scene.laws {
        let text = law_text::damped(name, &damped);
        law(page, "Rate-dependent", &text)?;
        law_constants(page, &text, &parameters::constants(&damped, text.law))?;
    } else {
        let (name, loading) = scene.laws.loading();
        let text = law_text::loading(name, &loading);
        law(page, "Loading", &text)?;
        law_constants(page, &text, &parameters::constants(&loading, text.law))?;
    }
    if let Some((name, unloading)) = scene.laws.unloading() {
        let text = law_text::unloading(name, &unloading);
        law(page, "Unloading and reloading", &text)?;
        law_constants(page, &text, &parameters::constants(&unloading, text.law))?;
    }
    if let Some(loss) = scene.laws.loss() {
        writeln!(page, "<h3>Loss below yield</h3>\n<p>{}</p>", prose(&loss.words()))?;
    }
    strength_text::section(page, scene)?;
    if scene.laws.unloading().is_some() {
        writeln!(page, "<p>{}</p>", prose(&energy::words(scene)))?;
    }
    if let Some(guard) = &plan.guard {
        writeln!(
            page,
            "<h3>Passivity guard</h3>\n<ul>\n<li><code>d_e &lt;= 2.5 W/F_m</code></li>\n</ul>\n<p>Unloading returns no \
             more energy than loading took: where it would, the elastic recovery is shortened, and the dent is deeper than \
             the law says. The guard {}. The FMU logs when it first acts (category logStatusWarning).</p>",
            prose(&guard.words())
        )?;
    }
    friction_text::section(page, scene)?;
    writeln!(page, "<h2>Variables</h2>")?;
    variables(page, &plan.variables)?;
    constants(page, &plan.constants)?;
    if scene.standalone {
        writeln!(
            page,
            "<p>The library is standalone: it needs no library and no function of its process. Its memory comes from \
             <code>allocateMemory</code> and <code>freeMemory</code> of the importer.</p>"
        )?;
    }
    writeln!(
        page,
        "<p>Brinell {}. Licenses: <a href=\"licenses/license.txt\">license.txt</a></p>",
        env!("CARGO_PKG_VERSION")
    )?;
    writeln!(page, "</body>\n</html>")
}

/// The bodies in contact.
fn contact(scene: &Scene) -> String {
    let pairs: BTreeSet<_> = (0..scene.contacts.len()).map(|group| bodies::words(scene, group)).collect();
    match pairs.first() {
        Some((impactor, target)) if pairs.len() == 1 => format!("{impactor} and {target}"),
        _ => "two bodies".into(),
    }
}

/// The bodies of each group of contacts.
fn contacts(page: &mut String, scene: &Scene) -> std::fmt::Result {
    if scene.contacts[0].name.is_none() {
        return Ok(());
    }
    writeln!(page, "<h2>Contacts</h2>\n<table>\n<tr><th>Name</th><th>Bodies</th><th>Own values</th></tr>")?;
    for (index, group) in scene.contacts.iter().enumerate() {
        let (impactor, target) = bodies::words(scene, index);
        let unit = |name: &str| table::variable(name).unit.as_deref().unwrap_or("");
        let each = |own: &Parameter| if own.per_contact { " for each" } else { "" };
        let own =
            group.own.iter().map(|own| format!("{} = {}{}", own.name, quantity(own.value, unit(own.name)), each(own)));
        let own = own.collect::<Vec<_>>().join(", ");
        writeln!(
            page,
            "<tr><td><code>{}</code></td><td>{impactor} and {target}</td><td>{own}</td></tr>",
            group.label()
        )?;
    }
    writeln!(page, "</table>")
}

/// The coupling of the FMU with its importer.
fn coupling(scene: &Scene) -> String {
    if let Some(coupling) = &scene.coupling {
        if let Masses::Shared(masses) = &coupling.masses {
            return together(scene, coupling, masses);
        }
        let mass = if scene.mass_is_input() {
            "the input <code>effective_mass</code>"
        } else if scene.damps_by_mass() {
            "the parameter <code>effective_mass</code>"
        } else {
            "the parameter <code>effective_mass</code>, which may be set between steps"
        };
        let acceleration = if coupling.acceleration_input {
            "<code>external_acceleration</code> to the acceleration by all other forces, such as gravity"
        } else {
            "its first input derivative to the acceleration by all other forces, such as gravity \
             (<code>fmi2SetRealInputDerivatives</code>, again for every step; without it, no other force acts during the step)"
        };
        let force = if coupling.parallel {
            "The importer steps all FMUs at once (Jacobi): it applies the <code>mean_force</code> of one step over the next, held \
             constant. The FMU keeps an account of the momentum in transit, so that it is right at any step. An importer that \
             steps the contact first and applies its force over the same step (Gauss-Seidel) needs a scene without \
             <code>master = \"parallel\"</code>"
        } else {
            "After the step, apply <code>mean_force</code> to the bodies over that step: they end it with the speed that the FMU \
             has computed, however short an impact was within it (Gauss-Seidel). An importer that steps all FMUs at once \
             (Jacobi), and so applies it over the next step, needs a scene with <code>master = \"parallel\"</code>"
        };
        format!(
            "The FMU knows the mass that the contact force accelerates, {mass}, and moves the bodies through each step itself. \
             Before a step, set <code>indentation_rate</code> to the closing speed of the bodies at its start, and {acceleration}. \
             {force}. The FMU warns once in the log if the importer works in the other order. <code>force</code> and the other \
             outputs are those at the end of the step."
        )
    } else if let Some(Loss::Plate(_)) = scene.laws.loss() {
        "The closing speed is held over a step. The plate gives way to the force, so the indentation grows more slowly than the \
         bodies close; the motion of the plate is integrated within the step."
            .into()
    } else if scene.follows_rate() {
        "The rate is held over a step, and the law is followed exactly: the result does not depend on how time is divided. The \
         force follows the rate at the same instant: set the rate again before you read the force, or solve that loop."
            .into()
    } else if !scene.input_derivatives {
        "The rate is held over a step. The law is followed exactly: the result does not depend on how time is divided."
            .into()
    } else {
        "The rate is held over a step, or is a polynomial in time if its first and second derivative are set \
         (<code>fmi2SetRealInputDerivatives</code>, for one step). The law is followed exactly: the result does not depend on how \
         time is divided."
            .into()
    }
}

/// The `coupling` of contacts that share bodies, with the inverse `masses` of these.
fn together(scene: &Scene, coupling: &Coupling, masses: &InverseMasses) -> String {
    let masses = match masses {
        InverseMasses::Inputs => {
            "the entries of the matrix of inverse effective masses (<code>inverse_mass[i,j]</code>, upper triangle) if they have \
             changed, "
        }
        InverseMasses::Constant { .. } => "",
    };
    let acceleration = if coupling.acceleration_input && scene.has_friction() {
        "<code>external_acceleration</code> and <code>external_tangential_acceleration</code> of each contact"
    } else if coupling.acceleration_input {
        "<code>external_acceleration</code> of each contact"
    } else {
        "as the first input derivative of each rate (<code>fmi2SetRealInputDerivatives</code>, again for every step),"
    };
    let friction = scene.has_friction();
    let [rates, forces, moments] = match friction {
        true => [
            "<code>indentation_rate</code> and <code>tangential_rate</code> of each contact to the rates of its bodies",
            "<code>mean_force</code> and <code>mean_tangential_force</code>",
            "<code>impulse_moment</code>/m, across by <code>tangential_impulse_moment</code>/m",
        ],
        false => [
            "<code>indentation_rate</code> of each contact to the closing rate of its bodies",
            "<code>mean_force</code>",
            "<code>impulse_moment</code>/m",
        ],
    };
    let force =
        if coupling.parallel { "over the next step, held constant (Jacobi)" } else { "over that step (Gauss-Seidel)" };
    format!(
        "The contacts share bodies, and the FMU moves all of them together through each step. Before a step, set {masses}\
         {rates}, and {acceleration} to the acceleration by all forces but those of these contacts. After the step, apply {forces} \
         of each contact to both of its bodies {force}: they get the speeds that the FMU has computed. A body of mass m is \
         displaced by {moments}. The FMU warns once in the log if the importer works in the other order. The inverse masses \
         are constant within a step."
    )
}

/// The impact from the energy balance, and a suitable step size.
fn impact(page: &mut String, plan: &Plan) -> std::fmt::Result {
    let Plan { scene, experiment, .. } = plan;
    let prediction = plan.prediction();
    let assumption = format!(" (the scene gives none; {})", scene.assumption());
    let assumed = if scene.impact_is_assumed { assumption.as_str() } else { "" };
    writeln!(
        page,
        "<p>{} at {}{}{}; {}:</p>\n<table>",
        quantity(scene.impact_of(0).mass, "kg"),
        quantity(scene.impact.speed, "m/s"),
        prose(assumed),
        bodies::first_contact(scene).map(|contact| format!(" on {contact}")).unwrap_or_default(),
        scene.any_model().method()
    )?;
    let mut rows = vec![
        ("Largest force", prediction.max_force, "N"),
        ("Largest indentation", prediction.max_indentation, "m"),
        ("Dent", prediction.residual_indentation, "m"),
        (
            match scene.contacts[0].ellipse {
                Some(_) => "Largest contact radius, &radic;(a b)",
                None if scene.is_line() => "Largest half-width",
                None => "Largest contact radius",
            },
            prediction.max_contact_radius,
            "m",
        ),
        ("Coefficient of restitution", prediction.restitution, ""),
        ("Contact time", prediction.contact_time(), "s"),
    ];
    if scene.coupling.is_some() {
        rows.push(("Suggested step; the contact is right at any", experiment.step, "s"));
    } else {
        let stiffness = scene.any_model().stiffness(prediction.max_indentation);
        let stable = 2.0 * (scene.impact_of(0).mass / stiffness).sqrt();
        rows.push(("Suggested step, explicit coupling", experiment.step, "s"));
        rows.push(("Largest stable step, 2 &radic;(m/K)", stable, "s"));
    }
    for (name, value, unit) in rows {
        let value = prose(&numbers::quantity(value, unit));
        writeln!(page, "<tr><td>{name}</td><td class=\"n\">{value}</td></tr>")?;
    }
    writeln!(page, "</table>")?;
    for warning in &plan.warnings {
        writeln!(page, "<p><strong>Beyond the validity of the law:</strong> {}.</p>", prose(warning))?;
    }
    if let Some(accuracy) = accuracy(scene, prediction) {
        writeln!(page, "<p>{}</p>", prose(&accuracy))?;
    }
    if let Some(note) = plan.waves_note() {
        writeln!(page, "<p>{}</p>", prose(&note))?;
    }
    if let Some(shared) = plan.shared_bodies {
        writeln!(page, "<p><strong>Bodies:</strong> {shared}.</p>")?;
    }
    writeln!(
        page,
        "<p>The law is valid {}. Leaving the valid range logs one warning (category logStatusWarning); the simulation continues.</p>",
        prose(&plan.valid)
    )
}

fn law(page: &mut String, heading: &str, text: &LawText) -> std::fmt::Result {
    writeln!(page, "<h3>{heading}: {}</h3>\n<ul>", escape(&text.law.title))?;
    for formula in &text.formulas {
        writeln!(page, "<li><code>{}</code></li>", escape(formula))?;
    }
    writeln!(page, "</ul>\n<p>{} Reference: {}.</p>", prose(&text.notes), escape(&text.law.reference))
}

/// The constants of a law in this FMU.
fn law_constants(page: &mut String, text: &LawText, constants: &[LawConstant]) -> std::fmt::Result {
    if constants.is_empty() {
        return Ok(());
    }
    let others = if text.is_published { "" } else { " (the text above describes those of the reference)" };
    writeln!(page, "<p>Its constants in this FMU{others}:</p>\n<table>")?;
    for LawConstant { name, value, unit, description, .. } in constants {
        writeln!(
            page,
            "<tr><td><code>{name}</code></td><td class=\"n\">{}</td><td>{unit}</td><td>{}</td></tr>",
            number(&digits(*value)),
            escape(description)
        )?;
    }
    writeln!(page, "</table>")
}

fn variables(page: &mut String, entries: &[Entry]) -> std::fmt::Result {
    writeln!(
        page,
        "<table>\n<tr><th>Name</th><th></th><th>Start</th><th>Allowed</th><th>Unit</th><th>Meaning</th></tr>"
    )?;
    for entry in entries {
        let Entry { variable, description, start, .. } = entry;
        let causality = match variable.causality {
            Causality::Input => "input",
            Causality::Output => "output",
            Causality::Parameter => "parameter",
        };
        let measured = variable.unit.as_deref().unwrap_or("");
        let start = start.map(|start| quantity(start, measured)).unwrap_or_default();
        let allowed = match (variable.causality, variable.minimum, variable.maximum) {
            (Causality::Parameter | Causality::Input, Some(low), Some(high)) => {
                format!("{} to {}", number(&digits(low)), number(&digits(high)))
            }
            _ => String::new(),
        };
        writeln!(
            page,
            "<tr><td><code>{}</code></td><td>{causality}</td><td class=\"n\">{start}</td><td class=\"n\">{allowed}</td>\
             <td>{}</td><td>{}</td></tr>",
            entry.label(),
            unit(measured),
            escape(description)
        )?;
    }
    writeln!(page, "</table>")
}

/// The parameters that cannot be set in this FMU.
fn constants(page: &mut String, constants: &[plan::FixedParameter]) -> std::fmt::Result {
    if constants.is_empty() {
        return Ok(());
    }
    writeln!(page, "<p>Constants of this FMU:</p>\n<table>")?;
    for plan::FixedParameter { name, value, unit, .. } in constants {
        let value = quantity(*value, unit);
        writeln!(page, "<tr><td><code>{name}</code></td><td class=\"n\">{value}</td></tr>")?;
    }
    writeln!(page, "</table>")
}

/// Force against indentation over the scene's impact.
fn curve(plan: &Plan) -> String {
    let picture = force_over_indentation(plan.scene, plan.prediction());
    picture.svg(480, 340)
}

/// Force over indentation in the impact of `scene`, with this `prediction`.
pub fn force_over_indentation(scene: &Scene, prediction: &Prediction) -> Picture {
    let micrometres = |points: Vec<(f64, f64)>| points.into_iter().map(|(d, force)| (1e6 * d, force)).collect();
    let branches =
        scene.any_model().branches(&scene.impact_of(0), prediction).expect("a checked scene has a prediction");
    let named = branches.into_iter().zip(["loading", "unloading"]);
    let series = named.map(|(points, label)| Series { label: label.into(), points: micrometres(points), dots: false });
    Picture {
        x_title: "indentation [\u{b5}m]".into(),
        y_title: "force [N]".into(),
        logarithmic: (false, false),
        series: series.collect(),
    }
}
