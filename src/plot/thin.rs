//! Fewer points for a line that looks the same.

use super::Picture;

/// How far a line may move, as a part of the picture: less than the width of a drawn line.
const NEAR: f64 = 1e-3;

impl Picture {
    /// The same picture with the points that its lines need. Dots stay, and so do the ends of each line.
    pub(super) fn thinned(mut self) -> Picture {
        debug_assert_eq!(self.logarithmic, (false, false), "distances are those of linear axes");
        let points = || self.series.iter().flat_map(|series| &series.points);
        let size = |of: fn(&(f64, f64)) -> f64| points().map(of).fold(0.0, |size: f64, value| size.max(value.abs()));
        let size = (size(|point| point.0), size(|point| point.1));
        for series in self.series.iter_mut().filter(|series| !series.dots) {
            let mut kept = vec![false; series.points.len()];
            keep(&series.points, size, &mut kept);
            let mut kept = kept.into_iter();
            series.points.retain(|_| kept.next().unwrap_or(true));
        }
        self
    }
}

/// Marks the points of a line that it needs: both ends, and the one that is farthest from the straight line between them.
///
/// Reference: D. H. Douglas, T. K. Peucker, Cartographica 10 (1973) 112-122.
fn keep(points: &[(f64, f64)], size: (f64, f64), kept: &mut [bool]) {
    let [first, .., last] = points else { return kept.fill(true) };
    let end = points.len() - 1;
    (kept[0], kept[end]) = (true, true);
    let placed = |(x, y): (f64, f64)| (x / size.0, y / size.1);
    let (from, to) = (placed(*first), placed(*last));
    let (along, length) = ((to.0 - from.0, to.1 - from.1), (to.0 - from.0).hypot(to.1 - from.1));
    let distance = |point: &(f64, f64)| {
        let way = placed(*point);
        let way = (way.0 - from.0, way.1 - from.1);
        if length > 0.0 { (along.0 * way.1 - along.1 * way.0).abs() / length } else { way.0.hypot(way.1) }
    };
    let farthest = (1..end).max_by(|&one, &other| distance(&points[one]).total_cmp(&distance(&points[other])));
    if let Some(farthest) = farthest.filter(|&place| distance(&points[place]) > NEAR) {
        keep(&points[..=farthest], size, &mut kept[..=farthest]);
        keep(&points[farthest..], size, &mut kept[farthest..]);
    }
}

#[cfg(test)]
mod tests {
    use crate::plot::{Picture, Series};

    fn picture(points: Vec<(f64, f64)>) -> Picture {
        let series = vec![Series { label: "line".into(), points, dots: false }];
        Picture { x_title: "x".into(), y_title: "y".into(), logarithmic: (false, false), series }
    }

    #[test]
    fn a_thinned_line_stays_within_a_thousandth_of_the_picture() {
        let curve: Vec<_> =
            (0..=100).map(|place| f64::from(place) / 100.0).map(|x| (3.0 * x, 700.0 * x.powf(1.5))).collect();
        let thinned = picture(curve.clone()).thinned().series.remove(0).points;
        assert!(thinned.len() < 20, "{} points", thinned.len());
        assert_eq!((thinned.first(), thinned.last()), (curve.first(), curve.last()));
        for (x, y) in curve {
            let after = thinned.partition_point(|point| point.0 < x).max(1);
            let [(x0, y0), (x1, y1)] = [thinned[after - 1], thinned[after]];
            let line = y0 + (y1 - y0) * (x - x0) / (x1 - x0);
            assert!((line - y).abs() < 2e-3 * 700.0, "{line} instead of {y} at {x}");
        }
    }

    #[test]
    fn corners_and_lines_of_two_points_stay() {
        for points in [vec![(0.0, 0.0), (1.0, 1.0)], vec![(0.0, 0.0), (1.0, 5.0), (2.0, 0.0)], vec![(1.0, 1.0)], vec![]]
        {
            assert_eq!(picture(points.clone()).thinned().series[0].points, points);
        }
    }
}
