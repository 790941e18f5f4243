//! The judge: many independent springs that move exactly. It shares no code with the library.

use super::histories::{DEEPEST, MODULUS, RADIUS, Step, length};

/// Springs at even distances from the centre of a contact on Hertz's curve.
pub struct Springs {
    indentation: f64,
    /// Height, and tension if the spring touches [m].
    springs: Vec<(f64, Option<[f64; 2]>)>,
    width: f64,
}

impl Springs {
    pub fn new(count: u32) -> Springs {
        let width = (RADIUS * 1.2 * DEEPEST).sqrt() / f64::from(count);
        let height = |index: u32| ((f64::from(index) + 0.5) * width).powi(2) / RADIUS;
        Springs { indentation: 0.0, springs: (0..count).map(|index| (height(index), None)).collect(), width }
    }

    /// Moves all springs by a step, whose tangential displacement is `shift` for springs that touch during all of it.
    fn each(&mut self, (rise, shift): Step, moved: impl Fn([f64; 2], [f64; 2], [f64; 2]) -> [f64; 2]) {
        let before = self.indentation;
        self.indentation += rise;
        for (height, tension) in &mut self.springs {
            let limit = self.indentation - *height;
            if limit <= 0.0 {
                *tension = None;
                continue;
            }
            let part = if tension.is_none() && rise > 0.0 { limit / rise } else { 1.0 };
            let limits = [(before - *height).max(0.0), limit];
            *tension = Some(moved(tension.unwrap_or_default(), limits, shift.map(|shift| part * shift)));
        }
    }

    pub fn step(&mut self, step: Step) {
        self.each(step, exact);
    }

    /// The same in many small `parts`, in each of which a spring beyond its limit goes straight back to it.
    pub fn step_in_small_parts(&mut self, (rise, shift): Step, parts: u32) {
        let share = 1.0 / f64::from(parts);
        for _ in 0..parts {
            self.each((share * rise, shift.map(|shift| share * shift)), |[x, y], [_, limit], [dx, dy]| {
                let tension = [x + dx, y + dy];
                let back = (limit / length(tension)).min(1.0);
                if back < 1.0 { tension.map(|part| back * part) } else { tension }
            });
        }
    }

    /// Tangential force divided by the coefficient of friction [N].
    pub fn pull(&self) -> [f64; 2] {
        let tensions = self.springs.iter().filter_map(|(_, tension)| *tension);
        let sum = tensions.fold([0.0; 2], |sum, [x, y]| [sum[0] + x, sum[1] + y]);
        sum.map(|sum| 2.0 * MODULUS * self.width * sum)
    }
}

/// The tension of a spring after a straight way, whose limit changes evenly: it sticks up to its limit, and then slips
/// along its tension, whose angle to the way obeys `p d(angle) = -sin(angle) ds`.
fn exact(tension: [f64; 2], [limit, end]: [f64; 2], shift: [f64; 2]) -> [f64; 2] {
    let after = |part: f64| [tension[0] + part * shift[0], tension[1] + part * shift[1]];
    if length(after(1.0)) <= end {
        return after(1.0);
    }
    let way = length(shift);
    if way == 0.0 {
        return tension.map(|part| part * end / length(tension));
    }
    // the excess is convex, so bisection from its minimum finds where the spring begins to slip
    let change = end - limit;
    let along = tension[0] * shift[0] + tension[1] * shift[1] - limit * change;
    let square = way * way - change * change;
    let excess = |part: f64| square * part * part + 2.0 * along * part + length(tension).powi(2) - limit * limit;
    let mut from = if along < 0.0 && square > 0.0 { (-along / square).min(1.0) } else { 0.0 };
    let mut to = if along >= 0.0 && excess(0.0) >= 0.0 { from } else { 1.0 };
    for _ in 0..60 {
        let middle = 0.5 * (from + to);
        *(if excess(middle) > 0.0 { &mut to } else { &mut from }) = middle;
    }
    let (here, start) = (limit + to * change, after(to));
    let [cosine, sine] = shift.map(|part| part / way);
    if here <= 0.0 {
        return [end * cosine, end * sine];
    }
    let angle = (cosine * start[1] - sine * start[0]).atan2(cosine * start[0] + sine * start[1]);
    let rate = if (end / here - 1.0).abs() < 1e-9 { 1.0 / here } else { (end / here).ln() / (end - here) };
    let turned = 2.0 * ((0.5 * angle).tan() * (-(1.0 - to) * way * rate).exp()).atan();
    let (across, ahead) = turned.sin_cos();
    [end * (ahead * cosine - across * sine), end * (ahead * sine + across * cosine)]
}
