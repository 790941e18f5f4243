//! Checks of laws with constants from a scene on the scene's bodies.

use brinell_contact::LARGEST_INDENTATION;
use brinell_contact::loading::AnyLoading;
use brinell_contact::unloading::AnyUnloading;
use brinell_contact::{Loading, Model};

type AnyModel = Model<AnyLoading, AnyUnloading>;

/// Mean pressure over the yield strength at the depth that is the unit of the evaluated range.
const UNIT_PRESSURE_FACTOR: f64 = 1.1;

/// The evaluated range, in units of the yield indentation, and its number of depths.
const RANGE: (f64, f64) = (1e-3, 1e4);
const DEPTHS: u32 = 700;

/// More corners than any law has.
const MOST_CORNERS: usize = 64;

/// Forces with a smaller relative difference are considered equal: a few roundings.
const ROUNDING: f64 = 1e-12;

/// Rejects a loading curve that is not finite, that falls, or whose pieces are out of order. Upward jumps are allowed, because
/// some published laws have them. Some published laws fall at their boundaries for a Poisson's ratio near 0.5; `model` may fall
/// by as much as `published` does on these bodies.
///
/// # Errors
/// A sentence about the defect and its position.
pub fn check_loading(model: &AnyModel, published: AnyLoading) -> Result<(), String> {
    let unit = model.pair.yield_point(UNIT_PRESSURE_FACTOR).indentation;
    let said = |indentation: f64| format!("{:.4} yield indentations", indentation / unit);
    let points = looked_at(model, unit)
        .map_err(|place| format!("the pieces of the loading curve are out of order at {}", said(place)))?;
    for &indentation in &points {
        let segment = model.loading.segment(&model.pair, indentation);
        let numbers = [
            segment.force(indentation),
            segment.stiffness(indentation),
            model.loading.work(&model.pair, indentation),
            model.loading.contact_radius(&model.pair, indentation),
        ];
        if numbers.iter().any(|number| !(number.is_finite() && *number >= 0.0)) {
            return Err(format!("the loading curve has no finite, positive force at {}", said(indentation)));
        }
    }
    let published = AnyModel { loading: published, ..*model };
    let allowed = looked_at(&published, unit).map_or(0.0, |points| deepest_fall(&published, &points).part);
    let Fall { part, place, from, to } = deepest_fall(model, &points);
    if part > allowed + ROUNDING {
        return Err(format!("the loading force falls at {}, from {from:.6e} to {to:.6e} N", said(place)));
    }
    Ok(())
}

/// Increasing indentations \[m\] over the evaluated range and on both sides of every corner.
///
/// # Errors
/// A corner at which the next piece of the curve does not begin.
fn looked_at(model: &AnyModel, unit: f64) -> Result<Vec<f64>, f64> {
    let mut points: Vec<f64> = depths(unit).collect();
    let mut corner = 0.0;
    for _ in 0..MOST_CORNERS {
        let next = model.loading.next_corner(&model.pair, corner);
        if next >= LARGEST_INDENTATION {
            break;
        }
        let segment = model.loading.segment(&model.pair, next);
        // written positively to reject NaN
        let in_order = next > corner && segment.lower == next && segment.upper > next;
        if !in_order {
            return Err(next);
        }
        points.extend([next.next_down(), next]);
        corner = next;
    }
    points.sort_by(f64::total_cmp);
    Ok(points)
}

/// A decrease of the force: its relative size, the indentation \[m\], and the forces before and after \[N\].
struct Fall {
    part: f64,
    place: f64,
    from: f64,
    to: f64,
}

/// The largest decrease of the loading force between neighbouring `points` \[m\].
fn deepest_fall(model: &AnyModel, points: &[f64]) -> Fall {
    let force = |d: f64| model.loading.segment(&model.pair, d).force(d);
    let fall = |pair: &[f64]| {
        let (from, to) = (force(pair[0]), force(pair[1]));
        Fall { part: (from - to) / from, place: pair[1], from, to }
    };
    let none = Fall { part: 0.0, place: 0.0, from: 0.0, to: 0.0 };
    points.windows(2).map(fall).fold(none, |deepest, fall| if fall.part > deepest.part { fall } else { deepest })
}

/// Rejects an unloading that is not finite, that does not begin at the end of the loading, that pulls, or whose force rises
/// during unloading.
///
/// # Errors
/// A sentence about the defect and its position.
pub fn check_unloading(model: &AnyModel) -> Result<(), String> {
    const PARTS: u32 = 20;
    let unit = model.pair.yield_point(UNIT_PRESSURE_FACTOR).indentation;
    for largest in depths(unit).filter(|depth| !model.is_elastic_at(*depth)) {
        let place = format!("from {:.4} yield indentations", largest / unit);
        let dent = model.unloading_path(largest).lower;
        let recovered = model.recovered_work(largest, largest);
        if !(dent < largest && dent.is_finite() && recovered >= 0.0 && recovered.is_finite()) {
            return Err(format!("the unloading {place} has no finite end below it"));
        }
        let force = |indentation: f64| model.unloading_segment(largest, indentation).force(indentation);
        let peak = model.peak(largest).force;
        // Hertz's curve, lowered, is the difference of two forces; on a steep path, the indentation itself is rounded
        let size = peak.max(model.pair.hertz_stiffness() * libm::pow(largest, 1.5));
        let rounding = ROUNDING * size + 8.0 * f64::EPSILON * peak * largest / (largest - dent);
        let mut before = force(largest);
        let continues = (before - peak).abs() <= rounding;
        if !continues {
            return Err(format!("the unloading {place} begins with {before:.6e} N instead of {peak:.6e} N"));
        }
        for part in (0..PARTS).rev() {
            let force = force(dent + (largest - dent) * f64::from(part) / f64::from(PARTS));
            if !(force <= before + rounding && force >= -rounding) {
                return Err(format!("the force of the unloading {place} doesn't fall to zero"));
            }
            before = force;
        }
    }
    Ok(())
}

/// Depths over the evaluated range \[m\], evenly spaced on a logarithmic scale.
fn depths(unit: f64) -> impl Iterator<Item = f64> {
    let (low, high) = RANGE;
    (0..=DEPTHS).map(move |step| unit * low * libm::pow(high / low, f64::from(step) / f64::from(DEPTHS)))
}
