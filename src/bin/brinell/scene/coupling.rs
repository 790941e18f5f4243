//! The table `[coupling]`: the mass that the FMU moves, and the co-simulation algorithm of its importer.

use super::Coupling;
use super::file::{CouplingTable, MasterName};
use crate::mistake::{Mistake, positive};
use crate::nearest::unknown;
use toml::Spanned;

/// Inputs that an FMU can have in addition to the rate.
const INPUTS: [&str; 2] = ["external_acceleration", "effective_mass"];

/// The coupling in this table, and the mass. `damps_by_mass` is the name of the law if its damping follows from the mass.
pub fn check(
    given: Option<&Spanned<CouplingTable>>,
    damps_by_mass: Option<&str>,
) -> Result<Option<(Coupling, Spanned<f64>)>, Mistake> {
    let Some(table) = given else { return Ok(None) };
    let CouplingTable { effective_mass, master, inputs } = table.get_ref();
    positive("coupling.effective_mass", effective_mass)?;
    for input in inputs {
        if !INPUTS.contains(&input.get_ref().as_str()) {
            return Err(Mistake(input.span(), unknown("input", input.get_ref(), INPUTS.into_iter())));
        }
    }
    let mass = inputs.iter().find(|input| input.get_ref() == "effective_mass");
    if let (Some(name), Some(mass)) = (damps_by_mass, mass) {
        let message = format!(
            "coupling.inputs = [\"effective_mass\"]: the damping of {name} is computed from the mass before the first step, so \
             the mass can't change; leave it a parameter"
        );
        return Err(Mistake(mass.span(), message));
    }
    let [acceleration_input, mass_input] = INPUTS.map(|name| inputs.iter().any(|input| input.get_ref() == name));
    let parallel = *master == Some(MasterName::Parallel);
    Ok(Some((Coupling { parallel, acceleration_input, mass_input }, effective_mass.clone())))
}
