//! A loading curve of one's own in a scene: the law of its bodies, and of no others.

use super::checked::{Scene, SceneLaws};
use super::contacts::Contacts;
use super::file::SceneFile;
use super::fmu;
use crate::mistake::Mistake;
use crate::own_curve;
use brinell_contact::loading::AnyLoading;

/// Puts the curve of the file into the laws of the `scene`. The numbers of the bodies that it belongs to are then constants of the FMU.
pub fn settle(scene: &mut Scene, file: &SceneFile, contacts: &Contacts) -> Result<(), Mistake> {
    let Some(curve) = &file.law.own_curve else { return Ok(()) };
    let table = &curve.get_ref().table;
    let span = table.span();
    let rows = table.get_ref();
    let wrong = |why: String| Mistake(span.clone(), format!("law.loading.table: {why}"));
    let count = rows.depth.len();
    let lists = [("force", rows.force.len()), ("contact_radius", rows.radius.len()), ("line", rows.lines.len())];
    let is_optional = |name: &str| name != "force";
    if let Some((name, other)) =
        lists.iter().find(|(name, other)| *other != count && !(is_optional(name) && *other == 0))
    {
        return Err(wrong(format!("{name} has {other} numbers, and depth {count}: they must be as many")));
    }
    let pair = scene.pair_of(0).expect("bodies that fit");
    let is_alike = |one: f64, other: f64| (one - other).abs() <= 1e-12 * one.abs();
    for group in 1..scene.contacts.len() {
        let other = scene.pair_of(group).expect("bodies that fit");
        if !is_alike(pair.radius, other.radius) || !is_alike(pair.modulus, other.modulus) {
            let message = "its bodies are no copies of those of the first contact, to which the curve of the file belongs; export a unit for each";
            return Err(wrong(contacts.said(group, message)));
        }
    }
    let (law, words) = own_curve::law(rows, &pair).map_err(wrong)?;
    let is_of_body = |name: &str| name.contains("impactor.") || name.contains("target.");
    fmu::fix(scene, file, &span, is_of_body, "a curve of one's own: the file belongs to these bodies")?;
    if let SceneLaws::Plastic { loading, .. } = &mut scene.laws {
        loading.1 = AnyLoading::Tabulated(law);
    }
    scene.law_words = Some(words);
    Ok(())
}
