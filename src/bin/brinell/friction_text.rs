//! What the page in an FMU says about its friction.

use crate::html::escape;
use crate::scene::Scene;
use crate::table;
use std::fmt::Write;

/// Writes the section about the friction of `scene`, if it has any.
pub fn section(page: &mut String, scene: &Scene) -> std::fmt::Result {
    if !scene.friction {
        return Ok(());
    }
    writeln!(page, "<h2>Friction</h2>\n<p>{}</p>\n<p>{}</p>\n<ul>", escape(SIGNS), escape(THEORY))?;
    for item in accuracy(scene) {
        writeln!(page, "<li>{}</li>", escape(&item))?;
    }
    writeln!(page, "</ul>")
}

const SIGNS: &str = "tangential_rate is the speed of the impactor's contact point relative to that of the target, along the \
                     surface: of a ball v + omega R. tangential_force is positive against a positive rate. The importer \
                     applies -tangential_force to the impactor at the contact point, which also turns it (torque \
                     -tangential_force R), and the opposite to the target. There is one tangential direction.";

const THEORY: &str = "Coulomb friction with partial slip according to Cattaneo, Mindlin, Jaeger and Ciavarella: the contact \
                      area sticks in the middle and slips at the edge. The energy balance has a part for each direction: \
                      work = elastic_energy + dissipated_energy along the normal, and the work of the tangential force is \
                      tangential_energy + friction_work.";

/// The accuracy of the tangential force, in sentences.
fn accuracy(scene: &Scene) -> Vec<String> {
    let mut items = vec![
        "With both rates held over each step, on a dent that doesn't grow: exact for any history and any step size, as long \
         as the past fits into twelve segments. Beyond that, the largest measured error of the tangential force is 5e-3 of \
         Coulomb's limit; in an impact, 3e-5 of the tangential restitution."
            .to_string(),
        "With input derivatives: slip is exact at the end of each step, stick has an error of second order in the step.".into(),
    ];
    if let Some((name, _)) = scene.unloading {
        let error = table::unloading_law(name).friction_error_after(scene.loading.0);
        if let Some(error) = error {
            items.push(format!(
                "In a step in which the dent grows, one step instead of many has an error of up to {error:e} of Coulomb's \
                 limit with these laws."
            ));
        }
        items.push(
            "No measurement was available for friction on contacts that have yielded. The model for them keeps Coulomb's \
             bound, makes no energy and equals the elastic theory before yield."
                .into(),
        );
    }
    items.push(
        "Normal force and dent don't depend on the friction. Normal and tangential displacements aren't coupled, which is \
         exact for equal bodies only. Steady rolling has no creep."
            .into(),
    );
    items
}
