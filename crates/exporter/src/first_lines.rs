//! The beginning of an FMU's own page: its impact in a sentence, and a few lines of Python that run it.

use crate::html::{escape, prose};
use crate::numbers;
use crate::plan::Plan;
use brinell_contact::impact::Impact;
use std::fmt::Write;

/// Steps of the lines in a contact.
const STEPS: f64 = 200.0;

/// The impact in a sentence, and the lines that run it.
pub fn section(page: &mut String, plan: &Plan) -> std::fmt::Result {
    let prediction = plan.prediction();
    let Impact { mass, speed } = plan.scene.impact_of(0);
    let said = |value: f64, unit| prose(&numbers::quantity(value, unit));
    let dent = match prediction.residual_indentation {
        dent if dent > 0.0 => format!("a dent of {} remains", said(dent, "m")),
        _ => "no dent remains".into(),
    };
    writeln!(
        page,
        "<p>A closing speed goes in, a contact force comes out. A body of {} at {} raises the force to {}; {dent}, and {} of the speed \
         comes back after {}. In Python (<code>pip install fmpy</code>):</p>\n<pre><code>{}</code></pre>",
        said(mass, "kg"),
        said(speed, "m/s"),
        said(prediction.max_force, "N"),
        said(prediction.restitution, ""),
        said(prediction.contact_time(), "s"),
        escape(&lines(plan))
    )
}

/// Lines for fmpy: the impact of the scene, in the order of the FMU's master. Contacts that share bodies have one long step.
fn lines(plan: &Plan) -> String {
    let scene = plan.scene;
    let named = |name: &str| plan.variables.iter().find(|entry| entry.variable.name == name).map(|entry| entry.name(0));
    let rate = named("indentation_rate").expect("every FMU has this input");
    let force = named("mean_force").filter(|_| scene.coupling.is_some()).or_else(|| named("force")).expect("an output");
    let Impact { mass, speed } = scene.impact_of(0);
    let gap = scene.group_value(0, "initial_gap").unwrap_or(0.0).max(0.0);
    let contact_time = plan.prediction().contact_time();
    let step = numbers::significant(contact_time / STEPS, 2);
    let end = numbers::significant(gap / speed + 1.5 * contact_time, 3);
    let head = format!(
        "from fmpy import extract, read_model_description\n\
         from fmpy.simulation import instantiate_fmu\n\
         description = read_model_description(\"{name}.fmu\")\n\
         unit = instantiate_fmu(extract(\"{name}.fmu\"), description, \"CoSimulation\")\n\
         at = {{variable.name: variable.valueReference for variable in description.modelVariables}}\n\
         unit.setupExperiment(), unit.enterInitializationMode(), unit.exitInitializationMode()\n",
        name = scene.name
    );
    let set = |speed: &str| format!("unit.setReal([at[\"{rate}\"]], [{speed}])\n");
    let get = format!("[force] = unit.getReal([at[\"{force}\"]])\n");
    if scene.inverse_masses().is_some() {
        let set = set(&speed.to_string());
        return format!(
            "{head}{set}unit.doStep(0.0, {end})  # s\n{get}print(f\"mean force {{force:.4g}} N over {{{end}}} s\")\n"
        );
    }
    let moved = "speed, time, largest = speed - force / mass * step, time + step, max(largest, force)\n";
    let parallel = scene.is_parallel();
    // a master that steps all at once applies the force a step later
    let [first, second] = if parallel { [moved, &get] } else { [&get, moved] };
    format!(
        "{head}mass, speed, step, time, force, largest = {mass}, {speed}, {step}, 0.0, 0.0, 0.0  # kg, m/s, s\n\
         while time < {end}:\n    {}    unit.doStep(time, step)\n    {first}    {second}\
         print(f\"largest force {{largest:.4g}} N, restitution {{-speed / {speed}:.4g}}\")\n",
        set("speed")
    )
}
