//! The table `[coupling]`: the mass that the FMU moves, and the co-simulation algorithm of its importer.

use super::checks::positive;
use super::file::{CouplingTable, MasterName};
use super::{Coupling, Mistake};
use crate::nearest::unknown;
use toml::Spanned;

/// Inputs that an FMU can have in addition to the rate.
const INPUTS: [&str; 2] = ["external_acceleration", "effective_mass"];

/// The coupling in this table, and the mass. `damped` is the name of the law if its force depends on the rate.
pub fn check(
    given: Option<&Spanned<CouplingTable>>,
    damped: Option<&str>,
) -> Result<Option<(Coupling, Spanned<f64>)>, Mistake> {
    let Some(table) = given else { return Ok(None) };
    if let Some(name) = damped {
        let message = format!("[coupling] needs a law whose force doesn't depend on the rate; that of {name} does");
        return Err(Mistake(table.span(), message));
    }
    let CouplingTable { effective_mass, master, inputs } = table.get_ref();
    positive("coupling.effective_mass", effective_mass)?;
    for input in inputs {
        if !INPUTS.contains(&input.get_ref().as_str()) {
            return Err(Mistake(input.span(), unknown("input", input.get_ref(), INPUTS.into_iter())));
        }
    }
    let [acceleration_input, mass_input] = INPUTS.map(|name| inputs.iter().any(|input| input.get_ref() == name));
    let parallel = *master == Some(MasterName::Parallel);
    Ok(Some((Coupling { parallel, acceleration_input, mass_input }, effective_mass.clone())))
}
