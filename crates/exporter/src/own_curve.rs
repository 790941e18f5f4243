//! A loading curve of one's own: the rows of a file, and the law through them.
//!
//! The force is the chain of pieces that is closest to the rows by least squares of the relative deviation, on as few knots as are as near as
//! many. Where the file has no radius of the contact, it follows from the depth in contact, `a^2 = R (2 d - d_e)` (Field and Swain), and the
//! elastic recovery from it, `d_e = 3 F/(4 E* a)`; an unloading of the file gives its length at the largest depth.

use crate::measurement::{self, Choices, Measurement};
use crate::numbers::{cell, quantity};
use brinell_contact::loading::Tabulated;
use brinell_contact::loading::tabulated::{MOST, TableKnot};
use brinell_contact::{Loading, Model, Pair, Segment, Surface, unloading};

/// The least and the largest number of rows.
const ROWS: (usize, usize) = (8, 10_000);

/// How far a force may be below one at a smaller depth, over the largest force.
const FALL: f64 = 0.05;

/// How far the curve may be off Hertz's where it counts as elastic, relatively.
const ELASTIC: f64 = 0.005;

/// How much more than a passive contact the recovery may be, relatively; it is then shortened.
const LONGER: f64 = 0.1;

/// The rms deviation of the force that needs no more knots.
const NEAR: f64 = 2e-4;

/// How far Hertz's curve may pass from the tangent at the first row, over the force there, where the contact yields before that row.
const TOUCHES: f64 = 0.02;

/// A force is known within its rms noise times this number.
const OF_NOISE: f64 = 20.0;

/// Forces below this part of the largest one count as that.
const LEAST: f64 = 0.01;

/// Rows of a piece.
const OF_PIECE: usize = 3;

/// The rows of a file in SI units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rows {
    /// The line of each in the file.
    pub lines: Vec<f64>,
    pub depth: Vec<f64>,
    pub force: Vec<f64>,
    /// Of the contact; empty if the file has none.
    pub radius: Vec<f64>,
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
    let lines: Vec<_> = table.lines().map(|line| line as f64).collect();
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
        let list = |name: &str, numbers: &[f64]| match numbers {
            [] => String::new(),
            _ => {
                let numbers: Vec<_> = numbers.iter().map(|number| format!("{number:e}")).collect();
                format!("{name} = [{}], ", numbers.join(", "))
            }
        };
        let lines: Vec<_> = self.lines.iter().map(|line| format!("{line:.0}")).collect();
        let lists = [("depth", &self.depth), ("force", &self.force), ("contact_radius", &self.radius)];
        let lists: String = lists.iter().map(|(name, numbers)| list(name, numbers)).collect();
        format!("{{ {lists}line = [{}] }}", lines.join(", "))
    }

    fn said(&self, row: usize) -> String {
        self.lines.get(row).map_or_else(|| format!("row {}", row + 1), |line| format!("line {line:.0}"))
    }
}

/// A row of the loading, in units of the largest depth and force.
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
    let (depth, force) =
        (points[points.len() - 1].depth, points.iter().fold(0.0, |most: f64, point| most.max(point.force)));
    let mut noise = noise(rows, &points, force)?;
    let mut fit = Fit::of(&points, pair, (depth, force), noise);
    // what the chain leaves is noise, too
    let left = fit.left(force);
    if left > noise && OF_NOISE * left > LEAST * force {
        noise = left;
        fit = Fit::of(&points, pair, (depth, force), noise);
    }
    let Fit { used, points, chain, begins, floor } = &fit;
    let bodies = Bodies { pair, rows, scale: (depth, force), points, begins: *begins, noise };
    let (law, shortened) = bodies.law(chain, unloading(rows, deepest, force))?;
    let words = words(&law, pair, used, floor * force, shortened);
    Ok((law, words))
}

/// The chain through the points of a loading.
struct Fit<'a> {
    /// Those that are not below the noise.
    used: &'a [Point],
    /// Those beyond the elastic part, in units of the largest depth and force and of the radius.
    points: Vec<Point>,
    chain: Chain,
    begins: Begins,
    /// The part of the largest force below which deviations are relative to it.
    floor: f64,
}

impl Fit<'_> {
    fn of<'a>(points: &'a [Point], pair: &Pair, (depth, force): (f64, f64), noise: f64) -> Fit<'a> {
        // a row below the noise says nothing
        let begin = points.iter().position(|point| point.force > OF_NOISE * noise).unwrap_or(0);
        let used = &points[begin.min(points.len() - ROWS.0)..];
        let elastic = elastic_rows(used, pair, noise);
        let scaled = |point: &Point| {
            let radius = if point.radius.is_nan() { of_contact_depth(point, pair).sqrt() } else { point.radius };
            Point { depth: point.depth / depth, force: point.force / force, radius: radius / pair.radius, ..*point }
        };
        let points: Vec<_> = used[elastic.unwrap_or(0)..].iter().map(scaled).collect();
        let hertz = |at: f64| pair.hertz_stiffness() * (at * depth).powf(1.5) / force;
        let floor = LEAST.max(OF_NOISE * noise / force);
        let mut chain = Chain::near(&points, floor, elastic.map(|_| hertz(points[0].depth)));
        let begins = match elastic {
            Some(_) => Begins::Elastic,
            None => chain.begin_elastic(&hertz, pair.radius / depth),
        };
        Fit { used, points, chain, begins, floor }
    }

    /// The rms distance of the forces from the chain \[N\].
    fn left(&self, force: f64) -> f64 {
        let off = |point: &Point| force * (self.chain.force(point.depth) - point.force);
        (self.points.iter().map(|point| off(point) * off(point)).sum::<f64>() / self.points.len() as f64).sqrt()
    }
}

/// The rms distance of the forces from the closest ones that don't fall \[N\].
fn noise(rows: &Rows, points: &[Point], largest: f64) -> Result<f64, String> {
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
    let off: Vec<_> = points.iter().zip(rising).map(|(point, mean)| (point, mean - point.force)).collect();
    let (worst, fall) = off.iter().fold(
        (points[0].row, 0.0),
        |worst, (point, off)| {
            if *off > worst.1 { (point.row, *off) } else { worst }
        },
    );
    if fall > FALL * largest {
        return Err(format!(
            "{}: the force {} at a depth of {} is {} below that of its neighbours: a loading curve rises; allowed is {}",
            rows.said(worst),
            quantity(rows.force[worst], "N"),
            quantity(rows.depth[worst], "m"),
            quantity(fall, "N"),
            quantity(FALL * largest, "N")
        ));
    }
    Ok((off.iter().map(|(_, off)| off * off).sum::<f64>() / off.len() as f64).sqrt())
}

/// The place of the last point up to which the curve is Hertz's, if it begins so.
fn elastic_rows(points: &[Point], pair: &Pair, noise: f64) -> Option<usize> {
    let is_hertz = |point: &&Point| {
        let hertz = pair.hertz_stiffness() * point.depth.powf(1.5);
        (point.force / hertz - 1.0).abs() <= (ELASTIC + 3.0 * noise / point.force).min(4.0 * ELASTIC)
    };
    points.iter().take_while(is_hertz).count().checked_sub(1)
}

/// Where the elastic part ends.
#[derive(Clone, Copy, PartialEq)]
enum Begins {
    /// In a row, up to which the curve is Hertz's.
    Elastic,
    /// Before the first row, where Hertz's curve meets the tangent there.
    Before,
    /// In the first row, whatever the curve is before.
    AtOnce,
}

/// Depth, force and stiffness at some knots, and `a^2` there, in units of the largest depth and force and of the radius.
struct Chain {
    knots: Vec<[f64; 3]>,
    squares: Vec<f64>,
    /// Relative rms deviations from the points of force and `a^2`.
    rms: [f64; 2],
}

impl Chain {
    /// The chain near the `points` with the fewest knots that is about as near as with the most. The force at the first one may be known.
    fn near(points: &[Point], floor: f64, first: Option<f64>) -> Chain {
        let all = [2, 3, 4, 6, 8, 12, 16, 24, MOST - 1];
        let mut chains: Vec<_> =
            all.iter().map(|&most| Chain::through(points, &knots(points, most), floor, first)).collect();
        let least =
            [0, 1].map(|place| chains.iter().fold(f64::INFINITY, |least: f64, chain| least.min(chain.rms[place])));
        // where the force has noise, the radius need not be much nearer
        let near = |chain: &Chain| [NEAR, NEAR.max(0.3 * chain.rms[0])];
        let is_near =
            |chain: &Chain| (0..2).all(|place| chain.rms[place] <= near(chain)[place].max(1.1 * least[place]));
        let place = chains.iter().position(is_near).unwrap_or(all.len() - 1);
        chains.swap_remove(place)
    }

    /// Puts a knot before the first one, where Hertz's curve meets the tangent there. The `radius` is in units of the largest depth.
    fn begin_elastic(&mut self, hertz: &dyn Fn(f64) -> f64, radius: f64) -> Begins {
        let [depth, force, stiffness] = self.knots[0];
        let tangent = |at: f64| force - stiffness * (depth - at);
        // Hertz's curve is as steep as the tangent there
        let steep = depth * (stiffness * depth / (1.5 * hertz(depth))).powi(2);
        if steep >= depth || hertz(depth) <= (1.0 + ELASTIC) * force {
            return Begins::AtOnce;
        }
        // from there on it rises above the tangent, or is above it already
        let (mut low, mut high) = (steep, depth);
        if hertz(steep) > tangent(steep) {
            if hertz(steep) - tangent(steep) > TOUCHES * force {
                return Begins::AtOnce;
            }
            high = steep;
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            *(if hertz(middle) < tangent(middle) { &mut low } else { &mut high }) = middle;
        }
        self.knots.insert(0, [high, hertz(high), stiffness.min(1.5 * hertz(high) / high)]);
        self.squares.insert(0, high / radius);
        Begins::Before
    }

    /// The closest chain on these `knots`, by the deviation relative to the force, or to the `floor` below that.
    fn through(points: &[Point], knots: &[f64], floor: f64, first: Option<f64>) -> Chain {
        let size = 2 * knots.len();
        let unit = |place: usize, begin: usize| {
            let ends = [0, 2].map(|end| {
                let of = |kind: usize| if place == end + kind { 1.0 } else { 0.0 };
                [knots[begin + end / 2], of(0), of(1)]
            });
            Segment::between(ends[0], ends[1])
        };
        let units: Vec<[Segment; 4]> =
            (1..knots.len()).map(|end| std::array::from_fn(|place| unit(place, end - 1))).collect();
        let mut equations = vec![vec![0.0; size + 1]; size];
        // few rows leave the slopes open
        let between =
            knots.windows(2).flat_map(|ends| [0.25, 0.5, 0.75].map(|part| ends[0] + part * (ends[1] - ends[0])));
        let between: Vec<_> = between.map(|depth| interpolated(points, depth)).collect();
        for (point, trust) in points.iter().map(|point| (point, 1.0)).chain(between.iter().map(|point| (point, 1e-4))) {
            let piece = knots.partition_point(|knot| *knot <= point.depth).clamp(1, (knots.len() - 1).max(1)) - 1;
            let Some(units) = units.get(piece) else { continue };
            let weight = trust / (point.force.max(floor) * point.force.max(floor));
            let parts = units.map(|unit| unit.force(point.depth));
            for (row, part) in parts.iter().enumerate() {
                for (column, other) in parts.iter().enumerate() {
                    equations[2 * piece + row][2 * piece + column] += weight * part * other;
                }
                equations[2 * piece + row][size] += weight * part * point.force;
            }
        }
        if let Some(first) = first {
            equations[0][0] += 1e12;
            equations[0][size] += 1e12 * first;
        }
        let solved = solved(equations);
        let mut found: Vec<_> =
            knots.iter().enumerate().map(|(k, knot)| [*knot, solved[2 * k], solved[2 * k + 1]]).collect();
        if let [only] = &mut found[..] {
            only[1] = first.unwrap_or(points[0].force);
        }
        rise(&mut found);
        let mut chain = Chain { squares: squares(points, knots), knots: found, rms: [0.0; 2] };
        let rms = |off: &dyn Fn(&Point) -> f64| {
            (points.iter().map(|point| off(point) * off(point)).sum::<f64>() / points.len() as f64).sqrt()
        };
        // a chain of many knots is near the noise, too
        let free = points.len().saturating_sub(2 * knots.len()).max(1) as f64;
        chain.rms = [
            (points.len() as f64 / free).sqrt()
                * rms(&|point| (chain.force(point.depth) - point.force) / point.force.max(floor)),
            rms(&|point| chain.square(point.depth) / (point.radius * point.radius) - 1.0),
        ];
        chain
    }

    /// The places of the knots around a depth, and the part of the way between them.
    fn around(knots: &[f64], depth: f64) -> [(usize, f64); 2] {
        let end = knots.partition_point(|knot| *knot <= depth).clamp(1, (knots.len() - 1).max(1));
        let part = knots.get(end).map_or(0.0, |upper| (depth - knots[end - 1]) / (upper - knots[end - 1]));
        [(end - 1, 1.0 - part), (end, part)]
    }

    fn square(&self, depth: f64) -> f64 {
        let knots: Vec<_> = self.knots.iter().map(|knot| knot[0]).collect();
        let parts = Chain::around(&knots, depth);
        parts.iter().map(|(place, part)| part * self.squares.get(*place).copied().unwrap_or(0.0)).sum()
    }

    fn force(&self, depth: f64) -> f64 {
        let place = self.knots.partition_point(|knot| knot[0] <= depth).clamp(1, (self.knots.len() - 1).max(1));
        match self.knots.get(place) {
            Some(end) => Segment::between(self.knots[place - 1], *end).force(depth),
            None => self.knots[0][1],
        }
    }
}

/// `a^2` at the knots, the straight lines between which are closest to the points.
fn squares(points: &[Point], knots: &[f64]) -> Vec<f64> {
    let mut equations = vec![vec![0.0; knots.len() + 1]; knots.len()];
    for point in points {
        let square = point.radius * point.radius;
        let parts = Chain::around(knots, point.depth).into_iter().filter(|(place, _)| *place < knots.len());
        for (row, one) in parts.clone() {
            parts.clone().for_each(|(column, other)| equations[row][column] += one * other / (square * square));
            equations[row][knots.len()] += one / square;
        }
    }
    let mut squares = solved(equations);
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

/// Depths of at most so many knots, the first and the last of which are those of the points, in geometric steps, with some points between two.
fn knots(points: &[Point], most: usize) -> Vec<f64> {
    let (first, last) = (points[0].depth, points[points.len() - 1].depth);
    let mut knots = vec![first];
    let (mut taken, mut count) = (1, points.len());
    for step in 1..most.max(2) {
        let depth = first * (last / first).powf(step as f64 / (most.max(2) - 1) as f64);
        let below = points.partition_point(|point| point.depth < depth);
        if below >= taken + OF_PIECE && count >= below + OF_PIECE && step + 1 < most {
            knots.push(depth);
            taken = below;
        }
    }
    count -= 1;
    if count > 0 {
        knots.push(last);
    }
    knots
}

/// The solution of symmetric equations, each with its right-hand side at its end.
fn solved(mut equations: Vec<Vec<f64>>) -> Vec<f64> {
    let size = equations.len();
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
        back.iter().filter(|(_, at)| *at < 0.5 * force).map(|(depth, force)| (*depth, force.cbrt().powi(2))).collect();
    if back.len() < ROWS.0 || low.len() < OF_PIECE {
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
struct Bodies<'a> {
    pair: &'a Pair,
    rows: &'a Rows,
    /// The largest depth \[m\] and force \[N\].
    scale: (f64, f64),
    points: &'a [Point],
    begins: Begins,
    /// Of the force \[N\].
    noise: f64,
}

impl Bodies<'_> {
    /// The law, and how much its recovery was shortened, relatively.
    fn law(&self, chain: &Chain, file: FromFile) -> Result<(Tabulated, f64), String> {
        let (radius, (depth, force)) = (self.pair.radius, self.scale);
        let unit = self.pair.modulus * radius * radius;
        let knot = |([d, f, k], square): (&[f64; 3], &f64)| TableKnot {
            depth: d * depth / radius,
            force: f * force / unit,
            stiffness: k * force / depth * radius / unit,
            factor: 1.0,
            square: *square,
        };
        let mut knots: Vec<TableKnot> = chain.knots.iter().zip(&chain.squares).map(knot).collect();
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
        match self.begins {
            Begins::AtOnce => self.check(first, first.depth)?,
            _ => first.square = first.depth,
        }
        first.factor *= first.depth / recovery_of(first);
        let mut shortened: f64 = 0.0;
        for place in 1..knots.len() {
            let whole = knots[place].factor;
            self.check(&knots[place], knots[place].depth)?;
            while self.falls(&knots, shape, place) {
                knots[place].factor *= 0.995;
                let most = recovery_of(&knots[place]);
                self.check(&TableKnot { factor: whole, ..knots[place] }, most)?;
            }
            let knot = &knots[place];
            let least = knot.depth.min((1.5 - 0.5 * shape) * knot.force / knot.stiffness.max(f64::MIN_POSITIVE));
            shortened = shortened.max(whole / knot.factor - 1.0).max(recovery_of(knot) / least - 1.0);
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
        if recovery_of(knot) <= (1.0 + LONGER + OF_NOISE * self.noise / force) * most {
            return Ok(());
        }
        let distance = |point: &&Point| (point.depth * self.scale.0 - depth).abs();
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
fn of_contact_depth(point: &Point, pair: &Pair) -> f64 {
    // beyond Hertz's force it would be less than his
    let square = |recovery: f64| pair.radius * (2.0 * point.depth - recovery).max(point.depth);
    let mut recovery: f64 = 0.0;
    for _ in 0..60 {
        recovery = 0.5 * (recovery + 0.75 * point.force / (pair.modulus * square(recovery).sqrt()));
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

#[cfg(test)]
mod tests;
