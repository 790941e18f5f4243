//! The tangential force of yielding contacts, compared with tables from another program.

use crate::friction::{Ball, Rebound, Row, assert_close, table};
use crate::physics;
use brinell_contact::loading::AnyLoading;
use brinell_contact::tangential::{Friction, FrictionalModel, Mean, Springs};
use brinell_contact::unloading::AnyUnloading;
use brinell_contact::{Body, History, Loading, Pair};

const FRICTION: Friction = Friction { coefficient: 0.3, stiffness_ratio: 1.4 / 1.7 };

type Model = FrictionalModel<AnyLoading, AnyUnloading>;

/// The model of a case of the table, `loading/unloading`.
fn model(case: &str) -> Model {
    let (loading, unloading) = case.split_once('/').expect("two laws");
    FrictionalModel { normal: physics::model(loading, unloading), friction: FRICTION, loss: () }
}

/// A contact with its springs.
struct Run<const N: usize, const LATTICE: bool> {
    model: Model,
    contact: History,
    springs: Springs<N, LATTICE>,
    /// Depths at which steps are divided [m].
    cuts: Vec<f64>,
}

impl<const N: usize, const LATTICE: bool> Run<N, LATTICE> {
    fn new(case: &str) -> Self {
        let model = model(case);
        let contact = History::start(&model.normal, 0.0).expect("within range");
        // the paths of thornton don't depend on the contact radius
        let cuts = if case == "big-alabo/contact-radius" { vec![radius_corner(&model)] } else { Vec::new() };
        Run { springs: Springs::start(&model, &contact), model, contact, cuts }
    }

    fn step(&mut self, rise: f64, slip: f64) {
        let from = self.contact.indentation();
        let mut parts: Vec<f64> = self.cuts.iter().map(|cut| (cut - from) / rise).collect();
        parts.retain(|&part| rise > 0.0 && part > 0.0 && part < 1.0);
        parts.push(1.0);
        let mut done = 0.0;
        for part in parts {
            let way = ((part - done) * rise, (part - done) * slip);
            let Run { springs, contact, model, .. } = self;
            springs.advance(contact, model, way, (rise, slip), Mean::Skipped).expect("within range");
            done = part;
        }
    }

    fn pull(&self) -> f64 {
        self.springs.force(&FRICTION, self.contact.indentation())
    }
}

/// The corner of the contact radius of big-alabo [m], at which the table also divides its steps. The radius stays that
/// of yield until force over pressure is a larger area.
fn radius_corner(model: &Model) -> f64 {
    let law = &model.normal;
    let unit = law.yield_point().indentation;
    let at_yield = law.loading.contact_radius(&law.pair, unit);
    let (mut low, mut high) = (unit, 10.0 * unit);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        let grows = law.loading.contact_radius(&law.pair, middle) > at_yield * (1.0 + 1e-15);
        *(if grows { &mut high } else { &mut low }) = middle;
    }
    low
}

/// The rows of the histories of one case.
fn rows(case: &str) -> Vec<Row> {
    table("plastic").into_iter().filter(|row| row.case == case).collect()
}

#[test]
fn histories_through_yield_agree_with_the_forces_and_energies_of_the_table() {
    // the table moves the segments of `brinell` to a new path without dividing them
    for case in ["thornton/thornton", "big-alabo/contact-radius"] {
        let mut run = Run::<512, false>::new(case);
        for row in rows(case) {
            run.step(row.get("d_delta"), row.get("d_s"));
            let what = format!("{case}, row {}", row.get("row"));
            let force = run.contact.force();
            assert_close(&format!("{what}, force"), force, row.get("F"), row.get("F").max(1e-9), 1e-9);
            let size = (FRICTION.coefficient * force).max(1e-9);
            assert_close(&format!("{what}, tangential force"), run.pull(), row.get("T"), size, 1e-9);
            let energy = run.springs.energy(&FRICTION, run.contact.indentation());
            assert_close(&format!("{what}, energy"), energy, row.get("energy"), row.get("energy").max(1e-15), 1e-9);
            assert_eq!(run.springs.segments(), row.get("segments").max(0.0) as usize, "{what}");
        }
    }
}

#[test]
fn growth_in_steps_over_fixed_depths_comes_close_to_the_full_model() {
    for (case, allowed) in [("thornton/thornton", 1e-12), ("big-alabo/contact-radius", 1e-2), ("brinell/brinell", 1e-2)]
    {
        let mut run = Run::<512, true>::new(case);
        let mut worst = 0.0_f64;
        for row in rows(case) {
            run.step(row.get("d_delta"), row.get("d_s"));
            let size = (FRICTION.coefficient * run.contact.force()).max(1e-9);
            worst = worst.max((run.pull() - row.get("T_full_model")).abs() / size);
        }
        println!("{case}: {worst:.1e} of Coulomb's limit");
        assert!(worst <= allowed, "{case}: {worst:e}");
    }
}

/// The impact of a `ball` in steps of `step` \[s\], in each of which the contact moves in so many `parts`.
fn impact<const N: usize>(case: &str, ball: Ball, step: f64, parts: u32) -> Rebound {
    let mut run = Run::<N, false>::new(case);
    let part = 1.0 / f64::from(parts);
    ball.impact(step, |rise, slip| {
        (0..parts).for_each(|_| run.step(rise * part, slip * part));
        let force = run.contact.force();
        (force > 0.0).then(|| (force, run.pull()))
    })
}

/// A steel ball that hits at this angle from the normal \[degrees\].
fn ball_at(degrees: f64) -> Ball {
    Ball { mass: 4.11e-3, radius: 5e-3, normal: 1.0, tangential: degrees.to_radians().tan(), spin: 0.0 }
}

#[test]
fn impacts_on_brinell_are_nearer_to_their_parts_than_the_table() {
    let rows = table("impact").into_iter().filter(|row| row.case == "brinell/brinell" && row.get("limit") == 0.0);
    let (mut worst, mut worst_of_table) = (0.0_f64, 0.0_f64);
    for row in rows {
        let of =
            |parts| impact::<512>(&row.case, ball_at(row.get("angle_deg_or_psi1")), row.get("h"), parts).restitution.1;
        let divided = of(16);
        worst = worst.max((of(1) - divided).abs());
        worst_of_table = worst_of_table.max((row.get("e_t") - divided).abs());
    }
    // its new springs touch evenly over the height
    println!("from sixteen parts: {worst:.1e}, the table {worst_of_table:.1e}");
    assert!(worst < 3e-5 && worst_of_table > 4.0 * worst);
}

#[test]
fn impacts_through_yield_agree_with_the_rebounds_of_the_table() {
    let rows = table("impact");
    let mut worst = 0.0_f64;
    for row in rows.iter().filter(|row| row.case.contains('/')) {
        let (degrees, limit) = (row.get("angle_deg_or_psi1"), row.get("limit"));
        let ball = ball_at(degrees);
        let found = match limit {
            0.0 => impact::<512>(&row.case, ball, row.get("h"), 1),
            _ => impact::<12>(&row.case, ball, row.get("h"), 1),
        };
        let what = format!("{}, {degrees} degrees, limit {limit}", row.case);
        assert_eq!(found.steps, row.get("steps") as u32, "{what}");
        assert_close(&format!("{what}, e_n"), found.restitution.0, row.get("e_n"), 1.0, 1e-12);
        // for `brinell` the table's steps have an error, as above, and its short lists merge otherwise: compared with full ones
        let is_full = |other: &&Row| {
            other.case == row.case && other.get("limit") == 0.0 && other.get("angle_deg_or_psi1") == degrees
        };
        let (other, exact) = match (row.case.as_str(), limit) {
            ("brinell/brinell", 0.0) => (row, 1e-4),
            ("brinell/brinell", _) => (rows.iter().find(is_full).expect("an impact with a full list"), 8e-4),
            _ => (row, 1e-12),
        };
        worst = worst.max((found.restitution.1 - other.get("e_t")).abs());
        assert_close(&format!("{what}, e_t"), found.restitution.1, other.get("e_t"), 1.0, exact);
        let spin = other.get("omega");
        assert_close(&format!("{what}, spin"), found.ball.spin, spin, spin, 10.0 * exact);
    }
    println!("worst difference of e_t: {worst:.1e}");
}

/// Tangential restitution of a steel ball on steel, with `steps` in some 40 us.
fn restitution_on_steel<const N: usize>(laws: (&str, &str), degrees: f64, steps: f64) -> f64 {
    let ball = Body { radius: 5e-3, youngs_modulus: 206e9, poissons_ratio: 0.3 };
    let block = Body { radius: f64::INFINITY, ..ball };
    let pair = Pair::new(&ball, &block, 300e6).expect("two bodies");
    let normal = brinell_contact::Model { pair, ..physics::model(laws.0, laws.1) };
    let model = FrictionalModel { normal, friction: Friction::between(&ball, &block, pair.modulus, 0.4), loss: () };
    let mut contact = History::start(&model.normal, 0.0).expect("within range");
    let mut springs: Springs<N> = Springs::start(&model, &contact);
    let rebound = ball_at(degrees).impact(4e-5 / steps, |rise, slip| {
        springs.advance(&mut contact, &model, (rise, slip), (rise, slip), Mean::Skipped).expect("within range");
        let force = contact.force();
        (force > 0.0).then(|| (force, springs.force(&model.friction, contact.indentation())))
    });
    rebound.restitution.1
}

#[test]
fn a_list_of_sixteen_changes_rebounds_by_as_much_as_the_guide_says() {
    let allowed = [
        (("hertz", "contact-radius"), 5e-6),
        (("big-alabo", "thornton"), 2e-5),
        (("big-alabo", "contact-radius"), 6e-5),
        (("brinell", "brinell"), 4e-4),
    ];
    for (laws, allowed) in allowed {
        let mut worst = 0.0_f64;
        for steps in [300.0, 1000.0, 4096.0] {
            for degrees in [1.0, 3.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 40.0] {
                let [bounded, unbounded] = [
                    restitution_on_steel::<16>(laws, degrees, steps),
                    restitution_on_steel::<512>(laws, degrees, steps),
                ];
                worst = worst.max((bounded - unbounded).abs());
            }
        }
        println!("{laws:?}: {worst:.1e}");
        assert!(worst < allowed, "{laws:?}: {worst:e}");
    }
}
