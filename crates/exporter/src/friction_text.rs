//! What the page in an FMU says about its friction.

use crate::html::prose;
use crate::scene::Scene;
use crate::table;
use brinell_contact::Body;
use brinell_contact::tangential::Friction;
use std::fmt::Write;

/// Writes the section about the friction of `scene`, if it has any.
pub fn section(page: &mut String, scene: &Scene) -> std::fmt::Result {
    if !scene.has_friction() {
        return Ok(());
    }
    let directions = if scene.directions > 1 { TWO } else { ONE };
    writeln!(page, "<h2>Friction</h2>\n<p>{} {}</p>\n<p>{}</p>\n<ul>", prose(SIGNS), prose(directions), prose(THEORY))?;
    for item in accuracy(scene) {
        writeln!(page, "<li>{}</li>", prose(&item))?;
    }
    writeln!(page, "</ul>")
}

const SIGNS: &str = "tangential_rate is the speed of the impactor's contact point relative to that of the target, along the \
                     surface: of a ball v + omega R. tangential_force is positive against a positive rate. The importer \
                     applies -tangential_force to the impactor at the contact point, which also turns it (torque \
                     -tangential_force R), and the opposite to the target.";

const ONE: &str = "There is one tangential direction.";

const TWO: &str = "There are two tangential directions across each other, which lie still in the contact area: tangential_rate[1] \
                   and [2] are the components of the rate, tangential_force[1] and [2] those of the force.";

const THEORY: &str = "Coulomb friction with partial slip according to Cattaneo, Mindlin, Jaeger and Ciavarella: the contact \
                      area sticks in the middle and slips at the edge. The energy balance has a part for each direction: \
                      work = elastic_energy + dissipated_energy along the normal, and the work of the tangential force is \
                      tangential_energy + friction_work. While a dent grows, the stored part is approximate: friction_work \
                      then stays where it would fall, and the sum may be above the work for a while.";

/// The accuracy on a dent that doesn't grow, in one direction.
const IN_ONE: [&str; 2] = [
    "With both rates held over each step, on a dent that doesn't grow: exact for any history and any step size, as long as the \
     past fits into sixteen segments. Beyond that, the largest measured error of the tangential force is 5e-3 of Coulomb's limit; \
     in an impact, 5e-6 of the tangential restitution.",
    "With input derivatives: slip is exact at the end of each step, stick has an error of second order in the step.",
];

/// The same in two directions.
const IN_TWO: [&str; 2] = [
    "With the rates held over each step, on a dent that doesn't grow: motion along one line is exact as in one direction, as long as \
     the past fits into sixteen segments. If the direction turns, the tangential force is an approximation. Against many \
     independent springs, its largest measured error over random histories is 1.1e-3 of Coulomb's limit, over circles \
     2.2e-3, and if each step is divided into 512 parts, 5.4e-3.",
    "The mean tangential force over a step is a sum over springs that move exactly. With input derivatives, the way of a step is \
     divided into eight straight parts.",
];

/// How much the stable step shrinks.
fn stability(scene: &Scene) -> String {
    let body = |name: &str| Body {
        radius: f64::INFINITY,
        youngs_modulus: scene.group_value(0, &format!("{name}.youngs_modulus")).unwrap_or(f64::INFINITY),
        poissons_ratio: scene.group_value(0, &format!("{name}.poissons_ratio")).unwrap_or(0.0),
    };
    let friction = Friction::between(&body("impactor"), &body("target"), scene.model().pair.modulus, 1.0);
    // v + omega R of a solid ball has the inertia 2/7 m
    let ratio = (3.5 * friction.stiffness_ratio).sqrt();
    format!(
        "A solid ball that the importer moves and turns freely has a tangential frequency of {ratio:.2} times the normal one. Its \
         longest stable step is shorter by this factor; the warning of unstable steps looks at the normal motion only."
    )
}

/// The accuracy of the tangential force, in sentences.
fn accuracy(scene: &Scene) -> Vec<String> {
    let mut items: Vec<String> = if scene.directions > 1 { &IN_TWO } else { &IN_ONE }.map(Into::into).into();
    items.push(stability(scene));
    if let Some((name, _)) = scene.laws.unloading() {
        let error = table::unloading_law(name).friction_error_after(scene.laws.loading().0);
        if let Some(error) = error {
            let turning = if scene.directions > 1 { "; where the motion turns, up to 3e-3" } else { "" };
            items.push(format!(
                "In a step in which the dent grows, one step instead of many has an error of up to {error:e} of Coulomb's \
                 limit with these laws, over random histories along a line{turning}."
            ));
        }
        items.push(
            "No measurement was available for friction on contacts that have yielded. The model for them keeps Coulomb's \
             bound, its friction work never falls, and it equals the elastic theory before yield."
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
