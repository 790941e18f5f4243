//! The table `[friction]`: whether the law of a scene supports it.

use super::Scene;
use super::file::FrictionTable;
use crate::mistake::Mistake;
use crate::mistake::Spanned;
use crate::table;

/// What a scene has beside its friction.
pub struct BesideFriction<'a> {
    /// The name of a law whose force depends on the rate.
    pub damped: Option<&'a str>,
    /// The name of the unloading law.
    pub unloading: Option<&'a str>,
    pub passivity_guard: bool,
    /// Whether the law has a loss below yield.
    pub has_loss: bool,
    /// Whether the FMU moves the bodies itself, each contact alone.
    pub knows_mass: bool,
    /// Whether contacts share bodies, which the FMU moves together.
    pub shares_bodies: bool,
}

impl Scene {
    /// Whether its contacts have friction.
    pub fn has_friction(&self) -> bool {
        self.directions > 0
    }
}

/// The number of tangential directions of the scene, zero without friction.
pub fn check(table: Option<&Spanned<FrictionTable>>, beside: &BesideFriction) -> Result<usize, Mistake> {
    let Some(table) = table else { return Ok(0) };
    let no = |message: String| Err(Mistake(table.span(), message));
    let directions = match &table.get_ref().directions {
        None => 1,
        Some(directions) => match *directions.get_ref() {
            1 => 1,
            2 => 2,
            number => {
                let message = format!(
                    "friction.directions = {number} is out of range: allowed are 1, one tangential direction along which the \
                     bodies move to and fro, and 2, two directions across each other"
                );
                return Err(Mistake(directions.span(), message));
            }
        },
    };
    if let Some(name) = beside.damped {
        return no(format!(
            "[friction] doesn't go with law.loading = \"{name}\": how exact it is with a force that depends on the rate wasn't measured; \
             a plastic law or \"hertz\" goes with it, in tables [[body]] also with law.elastic_restitution"
        ));
    }
    if let Some(name) = beside.unloading
        && let Some(reason) = &table::unloading_law(name).no_friction
    {
        let others = table::unloading_laws().into_iter().filter(|law| law.no_friction.is_none());
        let others = others.map(|law| law.name.as_str()).collect::<Vec<_>>().join("`, `");
        return no(format!("[friction] doesn't go with law.unloading = \"{name}\": {reason}; it goes with `{others}`"));
    }
    if beside.passivity_guard {
        return no(
            "[friction] doesn't go with law.passivity_guard: how exact it is on guarded paths wasn't measured".into()
        );
    }
    if beside.has_loss && !beside.shares_bodies {
        return no("[friction] doesn't go with law.elastic_restitution or target.plate_thickness: the springs of the contact follow \
                   a force without such losses; leave one of them out, or give tables [[body]], with which both go"
            .into());
    }
    if beside.knows_mass {
        return no("[friction] doesn't go with [coupling] effective_mass: the tangential motion within a step has to be moved, too; \
                   give tables [[body]] instead of the effective mass, or coupling.inverse_masses"
            .into());
    }
    Ok(directions)
}
