//! The ranges in which the passivity guard of a scene acts, found by evaluation.

use crate::bisection::border;
use crate::scene::Scene;
use brinell_contact::Loading;

/// Largest evaluated indentation, in yield indentations: ten to the power of `DECADES`.
const DEEPEST: f64 = 1e6;
const DECADES: u32 = 6;

/// Number of evaluated depths per decade.
const DEPTHS_PER_DECADE: u32 = 200;

/// Ranges of the largest indentation, in yield indentations of the law.
pub type Ranges = Vec<(f64, f64)>;

/// The ranges in which the guard of a scene acts.
pub struct Guard {
    /// For the bodies of any contact.
    pub ranges: Ranges,
    /// For the bodies of each group.
    pub by_group: Vec<Ranges>,
}

impl Guard {
    /// `None` if the scene has no guard.
    pub fn of(scene: &Scene) -> Option<Guard> {
        if !scene.laws.is_guarded() {
            return None;
        }
        let by_group = scene.by_bodies(|group| ranges_of(scene, group));
        let mut ranges = by_group.concat();
        ranges.sort_by(|one, other| one.0.total_cmp(&other.0));
        ranges.dedup_by(|next, last| {
            let overlap = next.0 <= last.1;
            if overlap {
                last.1 = last.1.max(next.1);
            }
            overlap
        });
        Some(Guard { ranges, by_group })
    }

    /// The ranges in which the guard acts, in words.
    pub fn words(&self) -> String {
        let range = |&(from, to): &(f64, f64)| {
            // the last evaluated depth is not an end
            let end = if to >= DEEPEST { "on".into() } else { format!("to {to:.4}") };
            format!("from {from:.4} {end}")
        };
        let words = match self.ranges.as_slice() {
            [] => format!("nowhere up to {DEEPEST:e} yield indentations"),
            some => {
                let ranges = some.iter().map(range).collect::<Vec<_>>().join(" and ");
                format!("at largest indentations {ranges} yield indentations")
            }
        };
        format!("acts {words} (bodies of the scene)")
    }
}

/// The ranges in which the guard acts on the contacts of `group`.
fn ranges_of(scene: &Scene, group: usize) -> Ranges {
    let model = scene.model_of(group);
    let d_y = model.loading.yield_point(&model.pair).indentation;
    let acts = |x: f64| model.is_held_back_at(x * d_y);
    let steps = DEPTHS_PER_DECADE * DECADES;
    let depth = |step| libm::pow(DEEPEST, f64::from(step) / f64::from(steps));
    let mut ranges = Ranges::new();
    let mut before = (1.0, false);
    for step in 0..=steps {
        let now = (depth(step), acts(depth(step)));
        match (before.1, now.1) {
            (false, true) => ranges.push((border((before.0, now.0), acts), now.0)),
            (true, false) => ranges.last_mut().expect("a range has begun").1 = border((now.0, before.0), acts),
            (true, true) => ranges.last_mut().expect("a range has begun").1 = now.0,
            (false, false) => {}
        }
        before = now;
    }
    ranges
}
