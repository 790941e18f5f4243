//! Clips lines at the edge of the range of their picture.

use super::Picture;
use std::ops::Range;

/// A point of a line in the drawing, and its values.
pub type Shown = ((f64, f64), (f64, f64));

/// The pieces of a line with these `points` inside the `range` of values. A line entirely below it runs along its
/// lower edge, and so does a single point.
pub fn inside(picture: &Picture, points: &[(f64, f64)], range: &Range<f64>) -> Vec<Vec<Shown>> {
    if is_below(points, range) {
        return vec![points.iter().map(|&point| ((point.0, range.start), point)).collect()];
    }
    let within = |point: &(f64, f64)| (range.start..=range.end).contains(&point.1);
    let mut pieces = vec![Vec::new()];
    for (index, point) in points.iter().enumerate() {
        if let Some(before) = index.checked_sub(1).map(|before| &points[before])
            && within(before) != within(point)
        {
            let edge = if before.1.min(point.1) < range.start { range.start } else { range.end };
            let crossing = crossing(picture, *before, *point, edge);
            pieces.last_mut().expect("there is always one").push((crossing, crossing));
            if within(before) {
                pieces.push(Vec::new());
            }
        }
        if within(point) {
            pieces.last_mut().expect("there is always one").push((*point, *point));
        }
    }
    pieces.retain(|piece| !piece.is_empty());
    pieces
}

/// Whether all points are below the `range`.
pub fn is_below(points: &[(f64, f64)], range: &Range<f64>) -> bool {
    points.iter().all(|point| point.1 < range.start)
}

/// The intersection of the line between two points, straight in the picture, with the value `edge`.
fn crossing(picture: &Picture, from: (f64, f64), to: (f64, f64), edge: f64) -> (f64, f64) {
    let (x_log, y_log) = picture.logarithmic;
    let scaled = |value: f64| if y_log { value.ln() } else { value };
    let part = (scaled(edge) - scaled(from.1)) / (scaled(to.1) - scaled(from.1));
    let x = if x_log { from.0 * (to.0 / from.0).powf(part) } else { from.0 + part * (to.0 - from.0) };
    (x, edge)
}
