//! A loading curve of one's own: the rows of a file, and the law through them.
//!
//! The force is the chain of pieces that is closest to the rows by least squares, each by its noise, on as few knots as the noise asks
//! for. Where the file has no radius of the contact, it follows from the depth in contact, `a^2 = R (2 d - d_e)` (Field and Swain), and
//! the elastic recovery from it, `d_e = 3 F/(4 E* a)`; an unloading of the file gives its length at the largest depth.

use crate::measurement::{self, Choices, Measurement};
use crate::numbers::{cell, quantity};
use brinell_contact::loading::Tabulated;
use brinell_contact::loading::tabulated::{MOST, TableKnot};
use brinell_contact::{Loading, Model, Pair, Segment, Surface, unloading};
// the same digits on every machine, and in the page
use libm::{cbrt, hypot, log, pow};
use serde::{Deserialize, Serialize};

/// The least and the largest number of rows.
const ROWS: (usize, usize) = (8, 10_000);

/// How far a force may be below one at a smaller depth, over the largest force.
const FALL: f64 = 0.05;

/// How much forces may scatter, over the largest one: their standard deviation.
const SCATTER: f64 = 0.2;

/// How far the curve may be off Hertz's where it counts as elastic, relatively.
const ELASTIC: f64 = 0.005;

/// How much more than a passive contact the recovery may be, relatively; it is then shortened.
const LONGER: f64 = 0.1;

/// The rms deviation of the force, relatively, that needs no more knots.
const NEAR: f64 = 2e-4;

/// The curve begins in the row above which each force is its noise times this number at least.
const OF_NOISE: f64 = 8.0;

/// The largest power of the depth before the first row, where the contact has yielded: Hertz's is 1.5.
const STEEPEST: f64 = 1.4;

/// The number of knots there.
const BEFORE: usize = 4;

/// Forces below this part of the largest one count as that.
const LEAST: f64 = 0.01;

/// The least number of rows of a piece, and the least rise along it, in units of the noise over the root of the number of its rows: slopes
/// are then known within a tenth.
const OF_PIECE: (usize, f64) = (3, 35.0);

/// How much lines of `a^2` keep straight, over the weight of a row.
const SMOOTH: f64 = 1e-4;

/// The rows of a file in SI units, as a scene has them.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields, expecting = "the name of a file, or lists")]
pub struct Rows {
    pub depth: Vec<f64>,
    pub force: Vec<f64>,
    /// Of the contact; empty if the file has none.
    #[serde(default, rename = "contact_radius", skip_serializing_if = "Vec::is_empty")]
    pub radius: Vec<f64>,
    /// The line of each in the file.
    #[serde(default, rename = "line", skip_serializing_if = "Vec::is_empty")]
    pub lines: Vec<u64>,
}

/// The rows of a [table](measurement::read): the columns depth and force, and perhaps the contact radius.
///
/// # Errors
/// A sentence with the line, and what is expected.
pub fn read(bytes: &[u8]) -> Result<Rows, String> {
    let table = measurement::read(bytes, &Choices::default()).map_err(|wrong| wrong.to_string())?;
    let depth = column(&table, "depth")?.ok_or("no column is called depth; such as `depth [um]; force [N]`")?;
    let force = column(&table, "force")?.ok_or("no column is called force; such as `depth [um]; force [N]`")?;
    let radius = column(&table, "contact_radius")?.unwrap_or_default();
    let lines: Vec<_> = table.lines().map(|line| line as u64).collect();
    if !(ROWS.0..=ROWS.1).contains(&lines.len()) {
        return Err(format!("the file has {} rows: allowed is {} to {}", lines.len(), ROWS.0, ROWS.1));
    }
    Ok(Rows { lines, depth, force, radius })
}

/// The numbers of the only column of this kind, if there is one.
fn column(table: &Measurement, key: &str) -> Result<Option<Vec<f64>>, String> {
    let columns = table.of(key);
    let Some(column) = columns.first() else { return Ok(None) };
    if let Some(other) = columns.get(1) {
        return Err(format!(
            "`{}` and `{}` are both a {}; leave one out",
            column.name, other.name, column.kind.names[0]
        ));
    }
    if column.unit.is_none() {
        return Err(format!(
            "the column `{}` has no unit: write `{} [{}]`",
            column.name, column.name, column.kind.unit
        ));
    }
    table.numbers(column).map(Some).map_err(|wrong| wrong.to_string())
}

impl Rows {
    /// The rows as a table of a scene.
    pub fn in_toml(&self) -> String {
        toml::Value::try_from(self).expect("lists of numbers").to_string()
    }

    fn said(&self, row: usize) -> String {
        self.lines.get(row).map_or_else(|| format!("row {}", row + 1), |line| format!("line {line}"))
    }
}

/// A row of the loading \[m, N\].
#[derive(Clone, Copy)]
struct Point {
    row: usize,
    depth: f64,
    force: f64,
    radius: f64,
}

/// The law through the `rows` on the bodies of `pair`, and how near it is, in a sentence.
///
/// # Errors
/// A sentence with the place, the value and what is allowed.
pub fn law(rows: &Rows, pair: &Pair) -> Result<(Tabulated, String), String> {
    let deepest =
        (0..rows.depth.len()).fold(0, |best, row| if rows.depth[row] > rows.depth[best] { row } else { best });
    let mut points: Vec<Point> = (0..=deepest)
        .filter(|&row| rows.depth[row] > 0.0 && rows.force[row] > 0.0)
        .map(|row| {
            let radius = rows.radius.get(row).copied().unwrap_or(f64::NAN);
            Point { row, depth: rows.depth[row], force: rows.force[row], radius }
        })
        .collect();
    if let Some(point) = points.iter().find(|point| point.radius <= 0.0) {
        let said = rows.said(point.row);
        return Err(format!(
            "{said}: contact_radius = {} under a force: it must be above zero",
            quantity(point.radius, "m")
        ));
    }
    points.sort_by(|one, other| one.depth.total_cmp(&other.depth));
    points.dedup_by(|next, before| next.depth == before.depth);
    if points.len() < ROWS.0 {
        return Err(format!(
            "{} rows up to the largest depth have a depth and a force above zero: allowed is {} or more",
            points.len(),
            ROWS.0
        ));
    }
    let force = points.iter().fold(0.0, |most: f64, point| most.max(point.force));
    let noise = Noise::of(&points);
    let scatter = noise.at(force) / force;
    // NaN counts as too much
    if !(0.0..=SCATTER).contains(&scatter) {
        return Err(format!(
            "the forces scatter by {} % of the largest one from row to row: allowed is {} %",
            cell(100.0 * scatter, 1.0),
            100.0 * SCATTER
        ));
    }
    check_rise(rows, &points, FALL * force + 4.0 * noise.at(force))?;
    // a row below the noise says nothing
    let begin =
        points.iter().rposition(|point| point.force < OF_NOISE * noise.at(point.force)).map_or(0, |row| row + 1);
    let used = &points[begin.min(points.len() - ROWS.0)..];
    let elastic = elastic_rows(used, pair, &noise);
    let (plastic, first) = (&used[elastic.unwrap_or(0)..], elastic.map(|row| hertz(pair, used[row].depth)));
    let mut chain = Chain::near(plastic, &noise, first);
    let begins_elastic = elastic.is_some() || chain.begin_elastic(pair);
    chain.split();
    let squares = squares(&chain, plastic, pair);
    let bodies = CurveBodies { pair, rows, points: plastic, begins_elastic, noise };
    let (law, shortened) = bodies.law(&chain, &squares, unloading(rows, deepest, force))?;
    let words = words(&law, pair, used, used[0].force.max(LEAST * force), shortened);
    Ok((law, words))
}

fn hertz(pair: &Pair, depth: f64) -> f64 {
    pair.hertz_stiffness() * pow(depth, 1.5)
}

/// Refuses forces that are more than `allowed` \[N\] off the closest ones that don't fall.
fn check_rise(rows: &Rows, points: &[Point], allowed: f64) -> Result<(), String> {
    // pools of neighbours with one mean
    let mut pools: Vec<(f64, usize)> = Vec::new();
    for point in points {
        let mut pool = (point.force, 1);
        while let Some(&(mean, count)) = pools.last().filter(|(mean, _)| *mean > pool.0) {
            let total = (count + pool.1) as f64;
            pool = ((mean * count as f64 + pool.0 * pool.1 as f64) / total, count + pool.1);
            pools.pop();
        }
        pools.push(pool);
    }
    let rising = pools.iter().flat_map(|&(mean, count)| std::iter::repeat_n(mean, count));
    let falls = points.iter().zip(rising).map(|(point, mean)| (mean - point.force, point));
    match falls.max_by(|one, other| one.0.total_cmp(&other.0)) {
        Some((fall, point)) if fall > allowed => Err(format!(
            "{}: the force {} at a depth of {} is {} below that of its neighbours: a loading curve rises; allowed is {}",
            rows.said(point.row),
            quantity(point.force, "N"),
            quantity(point.depth, "m"),
            quantity(fall, "N"),
            quantity(allowed, "N")
        )),
        _ => Ok(()),
    }
}

/// The standard deviation of a force: a constant \[N\], and a part of it.
struct Noise {
    constant: f64,
    part: f64,
}

impl Noise {
    /// From how far each force is off the cubic through two rows before and two behind, at smaller and at larger forces.
    ///
    /// Reference: T. Gasser, L. Sroka, C. Jennen-Steinmetz, *Biometrika* 73 (1986) 625-633.
    fn of(points: &[Point]) -> Noise {
        let off = |five: &[Point]| {
            let others = [0, 1, 3, 4];
            let weight = |one: usize| {
                let of = |other: usize| (five[2].depth - five[other].depth) / (five[one].depth - five[other].depth);
                others.into_iter().filter(|other| *other != one).map(of).product::<f64>()
            };
            let weights = others.map(weight);
            let cubic: f64 = others.iter().zip(weights).map(|(one, weight)| weight * five[*one].force).sum();
            (five[2].force - cubic).abs() / (1.0 + weights.iter().map(|weight| weight * weight).sum::<f64>()).sqrt()
        };
        let off: Vec<_> = points.windows(5).map(|five| (off(five), five[2].force)).collect();
        // the median of the size of normal numbers of deviation one is 0.6745
        let halves = [&off[..off.len() / 2], &off[off.len() / 2..]].map(|half| {
            let median = |of: &dyn Fn(&(f64, f64)) -> f64| {
                let mut numbers: Vec<_> = half.iter().map(of).collect();
                numbers.sort_by(f64::total_cmp);
                numbers[numbers.len() / 2]
            };
            [(median(&|(off, _)| *off) / 0.6745).powi(2), median(&|(_, force)| *force).powi(2)]
        });
        let [[low, small], [high, large]] = halves;
        let part = ((high - low) / (large - small)).max(0.0);
        let constant = if part > 0.0 { (low - part * small).max(0.0) } else { 0.5 * (low + high) };
        Noise { constant: constant.sqrt(), part: part.sqrt() }
    }

    fn at(&self, force: f64) -> f64 {
        hypot(self.constant, self.part * force)
    }

    /// What the deviation of a curve counts by.
    fn weight(&self, force: f64) -> f64 {
        let size = hypot(self.at(force), NEAR * force);
        1.0 / (size * size)
    }
}

/// The place of the last point up to which the curve is Hertz's, if it begins so: by means over as many rows as are known well enough.
fn elastic_rows(points: &[Point], pair: &Pair, noise: &Noise) -> Option<usize> {
    let (mut count, mut sums) = (0, [0.0; 2]);
    for (place, point) in points.iter().enumerate() {
        let hertz = hertz(pair, point.depth);
        let weight = noise.weight(hertz) * hertz;
        sums[0] += weight * (point.force - hertz);
        sums[1] += weight * hertz;
        let (off, error) = (sums[0] / sums[1], 1.0 / sums[1].sqrt());
        let is_last = place + 1 == points.len() && error < 8.0 * ELASTIC;
        if error <= 0.5 * ELASTIC || is_last {
            if off.abs() > ELASTIC + 2.0 * error {
                break;
            }
            (count, sums) = (place + 1, [0.0; 2]);
        }
    }
    count.checked_sub(1)
}

/// Depth, force and stiffness at some knots \[m, N, N/m\].
struct Chain {
    knots: Vec<[f64; 3]>,
}

impl Chain {
    /// The chain near the `points` with as many knots as they ask for. The force at the first one may be known.
    ///
    /// Reference: G. Schwarz, *Ann. Stat.* 6 (1978) 461-464, for the number of knots.
    fn near(points: &[Point], noise: &Noise, first: Option<f64>) -> Chain {
        let chains = [2, 3, 4, 6, 8, 12, 16, 24, MOST - BEFORE]
            .map(|most| Chain::through(points, &knots(points, noise, most), noise, first));
        let count = points.len() as f64;
        let mean = |chain: &Chain, weight: &dyn Fn(f64) -> f64| {
            let square = |point: &Point| weight(point.force) * (chain.force(point.depth) - point.force).powi(2);
            points.iter().map(square).sum::<f64>() / count
        };
        let is_near = |chain: &Chain| mean(chain, &|force| 1.0 / (force * force)) < NEAR * NEAR;
        let cost = |chain: &Chain| {
            count * log(mean(chain, &|force| noise.weight(force)).max(1e-30))
                + 2.0 * chain.knots.len() as f64 * log(count)
        };
        let place = chains.iter().position(is_near).unwrap_or_else(|| {
            (0..chains.len())
                .fold(0, |best, place| if cost(&chains[place]) < cost(&chains[best]) { place } else { best })
        });
        chains.into_iter().nth(place).expect("one of them")
    }

    /// Goes on to smaller depths as a power of the depth up to Hertz's curve, if that meets it.
    fn begin_elastic(&mut self, pair: &Pair) -> bool {
        let [depth, force, stiffness] = self.knots[0];
        let above = hertz(pair, depth) / force;
        if above <= 1.0 + ELASTIC {
            return false;
        }
        // a slope is known roughly only
        let power = (stiffness * depth / force).min(STEEPEST);
        let begin = depth * pow(above, -1.0 / (1.5 - power));
        let knot = |step: usize| {
            let part = pow(depth / begin, step as f64 / BEFORE as f64 - 1.0);
            let (depth, force) = (depth * part, force * pow(part, power));
            [depth, force, power * force / depth]
        };
        self.knots.splice(0..0, (0..BEFORE).map(knot));
        true
    }

    /// Puts knots between others, the widest steps first: lines between them are then as near as the curve.
    fn split(&mut self) {
        while (2..MOST).contains(&self.knots.len()) {
            let step = |place: usize| self.knots[place][0] / self.knots[place - 1][0];
            let place =
                (1..self.knots.len()).fold(1, |best, place| if step(place) > step(best) { place } else { best });
            if step(place) < 1.2 {
                break;
            }
            let depth = (self.knots[place][0] * self.knots[place - 1][0]).sqrt();
            let piece = Segment::between(self.knots[place - 1], self.knots[place]);
            self.knots.insert(place, [depth, piece.force(depth), piece.stiffness(depth)]);
        }
    }

    /// The closest chain on these `knots`.
    fn through(points: &[Point], knots: &[f64], noise: &Noise, first: Option<f64>) -> Chain {
        let unit = |place: usize, begin: usize| {
            let ends = [0, 2].map(|end| {
                let of = |kind: usize| if place == end + kind { 1.0 } else { 0.0 };
                [knots[begin + end / 2] / knots[0], of(0), of(1)]
            });
            Segment::between(ends[0], ends[1])
        };
        let units: Vec<[Segment; 4]> =
            (1..knots.len()).map(|end| std::array::from_fn(|place| unit(place, end - 1))).collect();
        let mut equations = Equations::of(2 * knots.len());
        // few rows leave the slopes open
        let between =
            knots.windows(2).flat_map(|ends| [0.25, 0.5, 0.75].map(|part| ends[0] + part * (ends[1] - ends[0])));
        let between: Vec<_> = between.map(|depth| interpolated(points, depth)).collect();
        for (point, trust) in points.iter().map(|point| (point, 1.0)).chain(between.iter().map(|point| (point, 1e-4))) {
            let piece = knots.partition_point(|knot| *knot <= point.depth).clamp(1, (knots.len() - 1).max(1)) - 1;
            let Some(units) = units.get(piece) else { continue };
            let weight = trust * noise.weight(point.force) * points[0].force * points[0].force;
            let part = |place: usize| (2 * piece + place, units[place].force(point.depth / knots[0]));
            equations.ask(&[0, 1, 2, 3].map(part), point.force / points[0].force, weight);
        }
        if let Some(first) = first {
            equations.ask(&[(0, 1.0)], first / points[0].force, 1e15);
        }
        let solved = equations.solved();
        let knot = |(k, knot): (usize, &f64)| {
            [*knot, solved[2 * k] * points[0].force, solved[2 * k + 1] * points[0].force / knots[0]]
        };
        let mut knots: Vec<_> = knots.iter().enumerate().map(knot).collect();
        if let [only] = &mut knots[..] {
            only[1] = first.unwrap_or(points[0].force);
        }
        rise(&mut knots);
        Chain { knots }
    }

    fn force(&self, depth: f64) -> f64 {
        let place = self.knots.partition_point(|knot| knot[0] <= depth).clamp(1, (self.knots.len() - 1).max(1));
        match self.knots.get(place) {
            Some(end) => Segment::between(self.knots[place - 1], *end).force(depth),
            None => self.knots[0][1],
        }
    }
}

/// `a^2` at the knots of the chain \[m^2\]: the lines between which are closest to the points, or by the depth in contact.
fn squares(chain: &Chain, points: &[Point], pair: &Pair) -> Vec<f64> {
    if points[0].radius.is_nan() {
        return chain.knots.iter().map(|[depth, force, _]| of_contact_depth(*depth, *force, pair)).collect();
    }
    let depths: Vec<_> = chain.knots.iter().map(|knot| knot[0]).collect();
    let mut equations = Equations::of(depths.len());
    for point in points {
        let square = point.radius * point.radius;
        let end = depths.partition_point(|knot| *knot <= point.depth).clamp(1, (depths.len() - 1).max(1));
        match depths.get(end) {
            None => equations.ask(&[(0, 1.0)], square, 1.0 / (square * square)),
            Some(upper) => {
                let part = (point.depth - depths[end - 1]) / (upper - depths[end - 1]);
                equations.ask(&[(end - 1, 1.0 - part), (end, part)], square, 1.0 / (square * square));
            }
        }
    }
    // where there are few rows, the lines bend little
    for (place, three) in depths.windows(3).enumerate() {
        let part = (three[1] - three[0]) / (three[2] - three[0]);
        let size = pair.radius * three[1];
        equations.ask(&[(place, 1.0 - part), (place + 1, -1.0), (place + 2, part)], 0.0, SMOOTH / (size * size));
    }
    if chain.knots[0][0] < points[0].depth {
        let square = pair.radius * depths[0];
        equations.ask(&[(0, 1.0)], square, points.len() as f64 / (square * square));
    }
    let mut squares = equations.solved();
    (1..squares.len()).for_each(|place| squares[place] = squares[place].max(squares[place - 1]));
    squares
}

/// The point at this depth on the straight line between two of the points.
fn interpolated(points: &[Point], depth: f64) -> Point {
    let place = points.partition_point(|point| point.depth <= depth).clamp(1, (points.len() - 1).max(1));
    let (one, other) = (points[place - 1], points[place.min(points.len() - 1)]);
    let part = if other.depth > one.depth { (depth - one.depth) / (other.depth - one.depth) } else { 0.0 };
    Point { depth, force: one.force + part * (other.force - one.force), ..one }
}

/// Depths of at most so many knots in rows, the first and the last of which are those of the points, in geometric steps, with enough rows and
/// enough of a rise between two.
fn knots(points: &[Point], noise: &Noise, most: usize) -> Vec<f64> {
    let last = points.len() - 1;
    let step = pow(points[last].depth / points[0].depth, 1.0 / (most - 1) as f64);
    let is_piece = |begin: usize, end: usize| {
        let (rows, rise) = (end - begin, points[end].force - points[begin].force);
        rows >= OF_PIECE.0 && rise * (rows as f64).sqrt() >= OF_PIECE.1 * noise.at(points[end].force)
    };
    let mut places = vec![0];
    let mut next = points[0].depth * step;
    for (place, point) in points.iter().enumerate().take(last).skip(1) {
        if point.depth >= next * (1.0 - 1e-9) && is_piece(places[places.len() - 1], place) && is_piece(place, last) {
            places.push(place);
            // depths may be so close that a step is none
            for _ in 0..most {
                next *= if next <= point.depth * (1.0 + 1e-9) { step } else { 1.0 };
            }
        }
    }
    if last > 0 {
        places.push(last);
    }
    places.into_iter().map(|place| points[place].depth).collect()
}

/// The equations of the numbers that are closest to what is asked of them by least squares, each with its right-hand side at its end.
struct Equations(Vec<Vec<f64>>);

impl Equations {
    fn of(count: usize) -> Equations {
        Equations(vec![vec![0.0; count + 1]; count])
    }

    /// Asks that the sum of these parts of some numbers is `value`.
    fn ask(&mut self, parts: &[(usize, f64)], value: f64, weight: f64) {
        let size = self.0.len();
        for (row, one) in parts {
            parts.iter().for_each(|(column, other)| self.0[*row][*column] += weight * one * other);
            self.0[*row][size] += weight * one * value;
        }
    }

    fn solved(self) -> Vec<f64> {
        let size = self.0.len();
        let mut equations = self.0;
        for pivot in 0..size {
            // a number that no point asks for is zero
            equations[pivot][pivot] = equations[pivot][pivot] * (1.0 + 1e-13) + f64::MIN_POSITIVE;
            let row = equations[pivot].clone();
            for below in equations.iter_mut().skip(pivot + 1) {
                let factor = below[pivot] / row[pivot];
                if factor != 0.0 {
                    below.iter_mut().zip(&row).skip(pivot).for_each(|(one, other)| *one -= factor * other);
                }
            }
        }
        let mut solution = vec![0.0; size];
        for place in (0..size).rev() {
            let known: f64 = (place + 1..size).map(|other| equations[place][other] * solution[other]).sum();
            solution[place] = (equations[place][size] - known) / equations[place][place];
        }
        solution
    }
}

/// Makes the force rise everywhere: over the root of the depth a piece is a cubic, which rises if its slopes at the ends are at most three times
/// the mean one.
///
/// Reference: F. N. Fritsch, R. E. Carlson, *SIAM J. Numer. Anal.* 17 (1980) 238-246.
fn rise(knots: &mut [[f64; 3]]) {
    for place in 1..knots.len() {
        knots[place][1] = knots[place][1].max(knots[place - 1][1]);
    }
    let mean = |one: &[f64; 3], other: &[f64; 3]| (other[1] - one[1]) / (other[0].sqrt() - one[0].sqrt());
    let means: Vec<_> = knots.windows(2).map(|pair| mean(&pair[0], &pair[1])).collect();
    for (place, knot) in knots.iter_mut().enumerate() {
        let before = place.checked_sub(1).and_then(|before| means.get(before));
        let most = before.into_iter().chain(means.get(place)).fold(f64::INFINITY, |least, mean| least.min(3.0 * mean));
        let steepest = if most.is_finite() { most / (2.0 * knot[0].sqrt()) } else { 1.5 * knot[1] / knot[0] };
        knot[2] = if most.is_finite() { knot[2].clamp(0.0, steepest) } else { steepest };
    }
    // the elastic part before the first knot is as stiff at least
    knots[0][2] = knots[0][2].min(1.5 * knots[0][1] / knots[0][0]);
}

/// What an unloading of the file says: the elastic recovery \[m\], and the shape of the path.
type FromFile = Option<(f64, f64)>;

/// The unloading after the row `deepest`, if there are enough rows, down to half of the largest `force` \[N\] at least.
fn unloading(rows: &Rows, deepest: usize, force: f64) -> FromFile {
    let mut back: Vec<_> = (deepest..rows.depth.len()).map(|row| (rows.depth[row], rows.force[row])).collect();
    back.retain(|(_, force)| *force > 0.0);
    back.sort_by(|one, other| one.0.total_cmp(&other.0));
    let low: Vec<_> =
        back.iter().filter(|(_, at)| *at < 0.5 * force).map(|(depth, force)| (*depth, cbrt(*force).powi(2))).collect();
    if back.len() < ROWS.0 || low.len() < OF_PIECE.0 {
        return None;
    }
    // near its end the path has Hertz's exponent
    let mean = |of: &dyn Fn(&(f64, f64)) -> f64| low.iter().map(of).sum::<f64>() / low.len() as f64;
    let (x, y) = (mean(&|point| point.0), mean(&|point| point.1));
    let slope = mean(&|point| (point.0 - x) * (point.1 - y)) / mean(&|point| (point.0 - x) * (point.0 - x));
    let end = (x - y / slope).min(back[0].0);
    let recovery = rows.depth[deepest] - end;
    let (first, last) = (back[0], back[back.len() - 1]);
    let work = 0.4 * first.1 * (first.0 - end)
        + back.windows(2).map(|pair| 0.5 * (pair[0].1 + pair[1].1) * (pair[1].0 - pair[0].0)).sum::<f64>();
    let shape = 15.0 * (work / (last.1 * recovery) - 0.4);
    (slope > 0.0 && recovery > 0.0).then_some((recovery, shape.clamp(0.0, 1.0)))
}

/// What the recovery follows from.
struct CurveBodies<'a> {
    pair: &'a Pair,
    rows: &'a Rows,
    points: &'a [Point],
    begins_elastic: bool,
    noise: Noise,
}

impl CurveBodies<'_> {
    /// The law, and how much its recovery was shortened, relatively.
    fn law(&self, chain: &Chain, squares: &[f64], file: FromFile) -> Result<(Tabulated, f64), String> {
        let radius = self.pair.radius;
        let unit = self.pair.modulus * radius * radius;
        let knot = |([depth, force, stiffness], square): (&[f64; 3], &f64)| TableKnot {
            depth: depth / radius,
            force: force / unit,
            stiffness: stiffness * radius / unit,
            factor: 1.0,
            square: square / (radius * radius),
        };
        let mut knots: Vec<TableKnot> = chain.knots.iter().zip(squares).map(knot).collect();
        let is_finite = |knot: &TableKnot| {
            [knot.depth, knot.force, knot.stiffness, knot.square].iter().all(|number| number.is_finite())
        };
        if !(knots.iter().all(|knot| is_finite(knot) && knot.force > 0.0 && knot.square > 0.0)
            && knots.windows(2).all(|pair| pair[1].depth > pair[0].depth))
        {
            return Err("no curve goes through the rows: look at their units".into());
        }
        let last = knots[knots.len() - 1];
        let part = 1.0 - recovery_of(&last) / last.depth;
        let mut shape = 0.0;
        if let Some((recovery, of_path)) = file.filter(|_| part > 0.0) {
            let longer = recovery / radius / recovery_of(&last) - 1.0;
            for knot in &mut knots {
                knot.factor += longer * ((1.0 - recovery_of(knot) / knot.depth) / part).clamp(0.0, 1.0);
            }
            let last = knots[knots.len() - 1];
            shape = (of_path / (1.0 - recovery_of(&last) / last.depth)).clamp(0.0, 1.0);
        }
        // below the first knot nothing has yielded
        let first = &mut knots[0];
        if self.begins_elastic {
            first.square = first.depth;
        } else {
            self.check(first, first.depth)?;
        }
        first.factor *= first.depth / recovery_of(first);
        let mut shortened: f64 = 0.0;
        for place in 1..knots.len() {
            let whole = knots[place].factor;
            self.check(&knots[place], knots[place].depth)?;
            let knot = &mut knots[place];
            let least = knot.depth.min((1.5 - 0.5 * shape) * knot.force / knot.stiffness.max(f64::MIN_POSITIVE));
            knot.factor *= (least / recovery_of(knot)).min(1.0);
            while self.falls(&knots, shape, place) {
                knots[place].factor *= 0.995;
                let most = recovery_of(&knots[place]);
                self.check(&TableKnot { factor: whole, ..knots[place] }, most)?;
            }
            shortened = shortened.max(whole / knots[place].factor - 1.0);
        }
        Ok((Tabulated::new(knots.into_iter(), shape), shortened))
    }

    /// Whether the dissipated energy or the dent falls anywhere up to the knot of this place from the one before.
    fn falls(&self, knots: &[TableKnot], shape: f64, place: usize) -> bool {
        const STEPS: u32 = 24;
        let loading = Tabulated::new(knots.iter().copied().take(place + 1), shape);
        let model = Model { pair: *self.pair, loading, unloading: unloading::Tabulated, surface: Surface::Dented };
        let mut most = [0.0; 2];
        (0..=STEPS).any(|step| {
            let part = f64::from(step) / f64::from(STEPS);
            let depth =
                self.pair.radius * (knots[place - 1].depth + part * (knots[place].depth - knots[place - 1].depth));
            let work = model.loading.work(self.pair, depth);
            let now = [work - model.recovered_work(depth, depth), model.residual_indentation(depth)];
            let falls = (0..2).any(|kind| now[kind] < most[kind] - 1e-12 * [work, depth][kind]);
            most = now;
            falls
        })
    }

    /// Rejects a recovery that is longer than a passive contact has, with the place.
    fn check(&self, knot: &TableKnot, most: f64) -> Result<(), String> {
        let depth = knot.depth * self.pair.radius;
        let force = knot.force * self.pair.modulus * self.pair.radius * self.pair.radius;
        if recovery_of(knot) <= (1.0 + LONGER + 20.0 * self.noise.at(force) / force) * most {
            return Ok(());
        }
        let distance = |point: &&Point| (point.depth - depth).abs();
        let nearest = self.points.iter().min_by(|one, other| distance(one).total_cmp(&distance(other)));
        Err(format!(
            "{}: from a depth of {} under {} an unloading would give back {}, and so more energy than the loading took: allowed is {}. The \
             curve is stiffer than that of a ball of {} radius with an effective modulus of {}; look at the units, at the zero of the depth, \
             and at radius and youngs_modulus",
            nearest.map_or(String::new(), |point| self.rows.said(point.row)),
            quantity(depth, "m"),
            quantity(force, "N"),
            quantity(recovery_of(knot) * self.pair.radius, "m"),
            quantity(most * self.pair.radius, "m"),
            quantity(self.pair.radius, "m"),
            quantity(self.pair.modulus, "Pa")
        ))
    }
}

/// The elastic recovery from a knot `[R]`.
fn recovery_of(knot: &TableKnot) -> f64 {
    knot.factor * 0.75 * knot.force / knot.square.sqrt()
}

/// `a^2` \[m^2\] by the depth in contact: `a^2 = R (2 d - d_e)`, and `d_e = 3 F/(4 E* a)`.
///
/// Reference: J. S. Field, M. V. Swain, *J. Mater. Res.* 8 (1993) 297-306.
fn of_contact_depth(depth: f64, force: f64, pair: &Pair) -> f64 {
    // beyond Hertz's force it would be less than his
    let square = |recovery: f64| pair.radius * (2.0 * depth - recovery).max(depth);
    let mut recovery: f64 = 0.0;
    for _ in 0..60 {
        recovery = 0.5 * (recovery + 0.75 * force / (pair.modulus * square(recovery).sqrt()));
    }
    square(recovery)
}

/// How near the law is to the points, in a sentence: relative to the force, or to the `floor` \[N\] below that.
fn words(law: &Tabulated, pair: &Pair, points: &[Point], floor: f64, shortened: f64) -> String {
    let off =
        |point: &Point| (law.segment(pair, point.depth).force(point.depth) - point.force) / point.force.max(floor);
    let worst = points.iter().fold(0.0, |worst: f64, point| worst.max(off(point).abs()));
    let rms = (points.iter().map(|point| off(point) * off(point)).sum::<f64>() / points.len() as f64).sqrt();
    let last = law.knots().last().map_or(0.0, |knot| knot.depth * pair.radius);
    let short = if shortened > 1e-3 {
        format!(
            " The elastic recovery is up to {} % shorter than by the moduli, so that it gives back no more than was put in.",
            cell(100.0 * shortened, 1.0)
        )
    } else {
        String::new()
    };
    format!(
        "The loading curve of the file: {} knots through {} rows, force within {} % of them (rms {} %; below {} of that \
         force), elastic up to {}; beyond {} it goes on in a straight line.{short}",
        law.knots().len(),
        points.len(),
        cell(100.0 * worst.max(1e-6), 1.0),
        cell(100.0 * rms.max(1e-6), 1.0),
        quantity(floor, "N"),
        quantity(law.yield_point(pair).indentation, "m"),
        quantity(last, "m")
    )
}
