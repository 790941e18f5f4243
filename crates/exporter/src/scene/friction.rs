//! The table `[friction]`: its directions, and whether the law of a scene supports it.

use super::file::FrictionTable;
use crate::mistake::Mistake;
use crate::mistake::Spanned;
use crate::table;

/// The number of tangential directions of the scene, zero without friction. Some unloading laws have none.
pub fn check(table: Option<&Spanned<FrictionTable>>, unloading: Option<&str>) -> Result<usize, Mistake> {
    let Some(table) = table else { return Ok(0) };
    if let Some(name) = unloading
        && let Some(reason) = &table::unloading_law(name).no_friction
    {
        let others = table::unloading_laws().into_iter().filter(|law| law.no_friction.is_none());
        let others = others.map(|law| law.name.as_str()).collect::<Vec<_>>().join("`, `");
        let message =
            format!("[friction] doesn't go with law.unloading = \"{name}\": {reason}; it goes with `{others}`");
        return Err(Mistake(table.span(), message));
    }
    let Some(directions) = &table.get_ref().directions else { return Ok(1) };
    match *directions.get_ref() {
        number @ (1 | 2) => Ok(number as usize),
        number => {
            let message = format!(
                "friction.directions = {number} is out of range: allowed are 1, one tangential direction along which the \
                 bodies move to and fro, and 2, two directions across each other"
            );
            Err(Mistake(directions.span(), message))
        }
    }
}
