//! The law `brinell` against finite elements: the curves of `data/truth/` that `finite_elements.csv` names, with the largest errors.

use crate::law_materials::{WEAK, force, read};
use crate::physics::{self, AnyModel, advance, brinell, pressed, unit};
use brinell_contact::impact::{Impact, predict};
use brinell_contact::{Body, Loading, OtherBody, Pair, TwoBodies};

/// The numbers in the columns of these names of a table in `data/truth/`; `None` if it has no such columns.
pub fn columns<const N: usize>(file: &str, names: [&str; N]) -> Option<Vec<[f64; N]>> {
    let text = read(&format!("data/truth/{file}.csv"));
    // of an unloading only the way out
    let is_left_out = |line: &&str| ["#", "virgin", "reload"].iter().any(|start| line.starts_with(start));
    let mut lines = text.lines().filter(|line| !is_left_out(line));
    let head: Vec<_> = lines.next().expect("a head").split(',').collect();
    let places = names.map(|name| head.iter().position(|column| *column == name));
    let places: Vec<usize> = places.into_iter().collect::<Option<_>>()?;
    let row = |line: &str| -> Option<[f64; N]> {
        let cells: Vec<_> = line.split(',').collect();
        let numbers: Option<Vec<f64>> = places.iter().map(|&place| cells[place].parse().ok()).collect();
        numbers?.try_into().ok()
    };
    Some(lines.filter_map(row).collect())
}

/// Two bodies of steel, of which the flat one is weaker, or a sphere that yields under a rigid flat.
struct Bodies {
    is_sphere: bool,
    poissons_ratio: f64,
    /// `H/E`.
    hardening: f64,
    /// Modulus of the flat over that of the sphere; zero if that is rigid.
    moduli: f64,
    /// Strength of the sphere over that of the flat.
    strengths: f64,
    /// `E*/S`; zero if the strain stays small.
    ratio: f64,
}

impl Bodies {
    fn model(&self) -> AnyModel {
        let steel = |radius| Body { radius, youngs_modulus: 206e9, poissons_ratio: self.poissons_ratio };
        let (one, other) = match self.is_sphere {
            true => (steel(5e-3), Body { youngs_modulus: f64::INFINITY, ..steel(f64::INFINITY) }),
            false => {
                (steel(f64::INFINITY), Body { youngs_modulus: 206e9 / self.moduli, poissons_ratio: 0.3, radius: 5e-3 })
            }
        };
        let strength = if self.ratio > 0.0 { one.plane_strain_modulus() / self.ratio } else { WEAK };
        let (impactor, target) = if self.is_sphere { (&one, &other) } else { (&other, &one) };
        let pair = Pair::new(impactor, target, strength).expect("they touch").yielding_in(&one, strength);
        let harder = OtherBody {
            modulus: other.plane_strain_modulus(),
            poissons_ratio: 0.3,
            yield_strength: self.strengths * strength,
            hardening_modulus: self.hardening * other.youngs_modulus,
        };
        let other_body = if self.moduli > 0.0 { harder } else { OtherBody::RIGID };
        let hardening_modulus = self.hardening * one.youngs_modulus;
        brinell(pair, TwoBodies { hardening_modulus, curvature: one.curvature(&other), other: other_body })
    }
}

/// A line of the table: a quantity of a curve in a range of indentations, or on the way out from some, and the largest error \[%\].
struct Claim {
    curve: &'static str,
    model: AnyModel,
    quantity: &'static str,
    range: &'static str,
    allowed: f64,
}

fn claims() -> impl Iterator<Item = Claim> {
    let lines = include_str!("finite_elements.csv").lines().filter(|line| !line.starts_with('#')).skip(1);
    lines.map(|line| {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |place: usize| -> f64 { cells[place].parse().unwrap_or_else(|_| panic!("{line}")) };
        let [poissons_ratio, hardening, moduli, strengths, ratio] = [2, 3, 4, 5, 6].map(number);
        let is_sphere = cells[1] == "sphere";
        let bodies = Bodies { is_sphere, poissons_ratio, hardening, moduli, strengths, ratio };
        // the law itself, and the construction of two bodies
        let model = if cells[1] == "law" { physics::model("brinell", "brinell") } else { bodies.model() };
        Claim { curve: cells[0], model, quantity: cells[7], range: cells[8], allowed: number(9) }
    })
}

impl Claim {
    /// Indentation, force and contact radius of the loading, in units of first yield; no radius is zero.
    fn loading(&self) -> Vec<[f64; 3]> {
        let Pair { radius, yield_strength, .. } = self.model.pair;
        let unit = unit(&self.model.pair);
        let in_yield = columns(self.curve, ["delta_over_dy", "F_over_Fy", "a_over_ay"]).or_else(|| {
            Some(columns(self.curve, ["delta_over_dy", "F_over_Fy"])?.iter().map(|[x, f]| [*x, *f, 0.0]).collect())
        });
        in_yield.unwrap_or_else(|| {
            let rows = columns(self.curve, ["d_over_R", "F_over_R2S", "a_over_R"]).expect("a curve");
            let in_yield = |[d, f, a]: [f64; 3]| {
                let size = radius / unit.indentation;
                [d * size, f * radius * radius * yield_strength / unit.force, a * size.sqrt()]
            };
            rows.into_iter().map(in_yield).collect()
        })
    }

    /// The errors on the loading curve \[%\] and their places.
    fn on_the_way_in(&self) -> Vec<(f64, f64)> {
        let (from, to) = self.range.split_once(" to ").expect("a range");
        let range = from.parse::<f64>().expect("a number")..=to.parse::<f64>().expect("a number");
        let (pair, unit) = (&self.model.pair, unit(&self.model.pair));
        let points = self.loading().into_iter().filter(|[x, ..]| range.contains(x));
        let errors: Vec<_> = points
            .map(|[x, f, a]| {
                let depth = x * unit.indentation;
                let force = force(&self.model, depth) / unit.force;
                let radius = self.model.loading.contact_radius(pair, depth) / (pair.radius * unit.indentation).sqrt();
                let (found, expected) = match self.quantity {
                    "force" => (force, f),
                    "radius" => (radius, a),
                    // the mean pressure over 1.1 S
                    _ => (force / radius.powi(2), f / a.powi(2)),
                };
                (100.0 * (found / expected - 1.0), x)
            })
            .collect();
        let last = errors.last().expect("points").1;
        assert!(errors.len() > 20 && last > 0.9 * range.end(), "{}: {} points to {last}", self.curve, errors.len());
        errors
    }

    /// The errors on the way out from the depths of the range \[%\], each with the depth.
    fn on_the_way_out(&self) -> Vec<(f64, f64)> {
        let depths = self.range.split(' ');
        depths
            .flat_map(|depth| {
                self.from(depth).into_iter().map(|error| (100.0 * error, depth.parse().expect("a depth")))
            })
            .collect()
    }

    /// The error of an impact with the energy of the finite elements up to this depth.
    fn of_impact(&self, depth: &str, column: &str) -> f64 {
        let text = read("data/truth/pairs/summary_unloading.csv");
        let mut lines =
            text.lines().filter(|line| !line.starts_with('#')).map(|line| line.split(',').collect::<Vec<_>>());
        let head = lines.next().expect("a head");
        let place = |name: &str| head.iter().position(|column| *column == name).unwrap_or_else(|| panic!("no {name}"));
        let case = self.curve.strip_prefix("pairs/loading_").expect("a pair");
        let row = lines.find(|row| row[0] == case && row[place("x_m")] == depth).expect("its row");
        let number = |name: &str| -> f64 { row[place(name)].parse().expect("a number") };
        let unit = unit(&self.model.pair);
        let energy = number("W_load_smoothed") * unit.force * unit.indentation;
        let impact = Impact { mass: 1.0, speed: (2.0 * energy).sqrt() };
        let prediction = predict(&self.model, &impact).expect("within range");
        let found = match column {
            "e" => prediction.restitution,
            "F_m" => prediction.max_force / unit.force,
            "x_f" => prediction.residual_indentation / unit.indentation,
            other => panic!("no {other}"),
        };
        found / number(column) - 1.0
    }

    fn from(&self, depth: &str) -> Vec<f64> {
        if let Some(column) = self.quantity.strip_prefix("impact ") {
            return vec![self.of_impact(depth, column)];
        }
        let (model, unit) = (&self.model, unit(&self.model.pair));
        let curve = format!("{}_from_{depth}", self.curve.replace("loading", "unloading"));
        let back = columns(&curve, ["delta_over_dy", "F_over_Fy"]).expect("an unloading");
        let [x_m, f_m] = back[0];
        if self.quantity == "path" {
            let mut history = pressed(model, x_m * unit.indentation);
            let errors = back.into_iter().map(|[x, f]| {
                let step = x * unit.indentation - history.indentation();
                advance(&mut history, model, step);
                (history.force() / unit.force - f) / f_m
            });
            return errors.collect();
        }
        let before = self.loading().into_iter().map(|[x, f, _]| [x, f]).filter(|[x, _]| *x < x_m);
        let way: Vec<_> = before.chain([[x_m, f_m]]).collect();
        // Hertz's law at the start, then trapezoids between the points
        let work = |points: &[[f64; 2]]| -> f64 {
            points.windows(2).map(|pair| 0.5 * (pair[1][0] - pair[0][0]) * (pair[0][1] + pair[1][1])).sum::<f64>().abs()
        };
        let returned = work(&back) / (work(&way) + 0.4 * way[0][0] * way[0][1]);
        let largest = x_m * unit.indentation;
        let own = model.recovered_work(largest, largest) / model.loading.work(&model.pair, largest);
        let (dent, end) = (model.unloading_path(largest).lower / unit.indentation, back[back.len() - 1][0]);
        vec![match self.quantity {
            "restitution" => (own / returned).sqrt() - 1.0,
            "dissipation" => (1.0 - own) / (1.0 - returned) - 1.0,
            "recovery" => (x_m - dent) / (x_m - end) - 1.0,
            _ => dent / end - 1.0,
        }]
    }
}

#[test]
fn every_curve_is_followed_within_the_errors_of_the_table() {
    let (mut wrong, mut count) = (Vec::new(), 0);
    for claim in claims() {
        let is_loading = claim.range.contains(" to ");
        let errors = if is_loading { claim.on_the_way_in() } else { claim.on_the_way_out() };
        let worst = errors.into_iter().max_by(|one, other| one.0.abs().total_cmp(&other.0.abs())).expect("points");
        let said = format!(
            "{}, {}: {:+.2} % at {}, allowed {} %",
            claim.curve, claim.quantity, worst.0, worst.1, claim.allowed
        );
        println!("{said}");
        if worst.0.abs() > claim.allowed {
            wrong.push(said);
        }
        count += 1;
    }
    assert!(wrong.is_empty() && count > 100, "{count} lines: {wrong:#?}");
}
