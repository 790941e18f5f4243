//! Elliptic contacts, compared with sums of point forces, with the limits of a ball and of a line, and with the law of lines.

use brinell_contact::loading::{AnyLoading, Line};
use brinell_contact::material::ellipse::Ellipse;
use brinell_contact::material::strength::Strength;
use brinell_contact::{Body, Loading, Numbered, Pair, TwoBodies};
use std::f64::consts::PI;

/// The ellipse whose gap has the radii 1 and so many times that.
fn ellipse(ratio: f64) -> Ellipse {
    Ellipse::of([1.0, ratio]).unwrap_or_else(|| panic!("an ellipse of {ratio}"))
}

const STEEL: Body = Body { radius: f64::INFINITY, youngs_modulus: 206e9, poissons_ratio: 0.3 };

#[test]
fn equal_radii_are_a_ball_to_rounding() {
    for radius in [1e-9, 5e-3, 1.0, 1e6] {
        let found = Ellipse::of([radius, radius]).expect("an ellipse");
        for (value, expected) in [(found.ratio, 1.0), (found.radius, radius), (found.stiffness, 1.0)] {
            assert!((value / expected - 1.0).abs() < 4.0 * f64::EPSILON, "{radius}: {value}, not {expected}");
        }
        let ball = found.ball(&STEEL, radius);
        assert_eq!(ball.poissons_ratio, STEEL.poissons_ratio);
        assert!((ball.youngs_modulus / STEEL.youngs_modulus - 1.0).abs() < 4.0 * f64::EPSILON);
    }
}

#[test]
fn the_order_of_the_radii_and_their_size_have_no_effect() {
    for ratio in [1.3, 7.0, 900.0] {
        let (one, other) = (ellipse(ratio), Ellipse::of([2e-3 * ratio, 2e-3]).expect("an ellipse"));
        for (one, other) in
            [(one.ratio, other.ratio), (2e-3 * one.radius, other.radius), (one.stiffness, other.stiffness)]
        {
            assert!((one / other - 1.0).abs() < 1e-13, "{ratio}: {one} and {other}");
        }
    }
}

/// The displacement of a half-space under Hertz's pressure is the sum of those of point forces, `p/(pi E* r)`. From a place inside, each line
/// through it adds half an ellipse of pressure; equal steps of the angle are exact to rounding.
#[test]
fn the_pressure_of_the_ball_presses_in_the_paraboloid_of_the_gap() {
    const LINES: u32 = 20_000;
    for ratio in [1.0, 1.1, 2.0, 5.0, 25.0, 300.0, 1e4] {
        let found = ellipse(ratio);
        // of a contact radius and an effective modulus of one
        let [a, b] = found.half_axes(1.0);
        let (depth, pressure) = (1.0 / found.radius, 2.0 * found.stiffness / (PI * found.radius));
        let displacement = |x: f64, y: f64| {
            let inside = 1.0 - (x / a).powi(2) - (y / b).powi(2);
            let line = |step: u32| {
                let (sin, cos) = (PI * f64::from(step) / f64::from(LINES)).sin_cos();
                let (curvature, slope) = ((cos / a).powi(2) + (sin / b).powi(2), x * cos / (a * a) + y * sin / (b * b));
                0.5 * PI * (inside + slope * slope / curvature) / curvature.sqrt()
            };
            pressure * (0..LINES).map(line).sum::<f64>() / f64::from(LINES)
        };
        for part in [0.0, 0.3, 0.7, 1.0] {
            // the longer half-axis lies along the larger radius
            let (x, y) = (0.6 * part * a, 0.8 * part * b);
            let expected = depth - x * x / (2.0 * ratio) - y * y / 2.0;
            let off = displacement(x, y) - expected;
            assert!(off.abs() < 1e-11 * depth, "{ratio}, {part}: {off:e} of {depth}");
        }
    }
}

/// The stresses on the axis at the depth `z` under the point forces of Hertz's pressure, added up.
///
/// Reference: J. Boussinesq, *Application des potentiels*, Paris 1885.
fn sum_of_point_forces(ratio: f64, nu: f64, z: f64) -> [f64; 3] {
    const STEPS: [u32; 2] = [300, 600];
    let mut sum = [0.0; 3];
    for step in 0..STEPS[0] {
        let (sin, cos) = (PI * f64::from(step) / f64::from(STEPS[0])).sin_cos();
        let end = 1.0 / (cos * cos / ratio + sin * sin * ratio);
        // Gauss's two points of each step
        for (step, side) in (0..STEPS[1]).flat_map(|step| [(step, -1.0), (step, 1.0)]) {
            let place = 0.5 * PI * (f64::from(step) + 0.5 + side / 12.0f64.sqrt()) / f64::from(STEPS[1]);
            let square = end * place.sin().powi(2);
            let far = (square + z * z).sqrt();
            let common = (1.0 - 2.0 * nu) / (far * (far + z));
            let along = common - 3.0 * square * z / far.powi(5);
            let around = (1.0 - 2.0 * nu) * z / far.powi(3) - common;
            let force = end * place.cos().powi(2) * place.sin();
            sum[0] += force * (along * cos * cos + around * sin * sin);
            sum[1] += force * (along * sin * sin + around * cos * cos);
            sum[2] -= force * 3.0 * z.powi(3) / far.powi(5);
        }
    }
    sum.map(|sum| 0.5 * PI * sum / f64::from(2 * STEPS[0] * STEPS[1]))
}

#[test]
fn the_stresses_on_the_axis_are_the_sum_of_those_of_point_forces() {
    for (ratio, nu) in [(1.0, 0.3), (1.5, 0.2), (4.0, 0.0), (4.0, 0.49), (12.0, 0.3)] {
        let found = Ellipse { ratio, radius: 1.0, stiffness: 1.0 };
        for part in [0.2, 0.5, 1.0, 2.0] {
            let z = part / f64::sqrt(ratio);
            let (found, expected) = (found.stresses(nu, z), sum_of_point_forces(ratio, nu, z));
            for (found, expected) in found.into_iter().zip(expected) {
                assert!((found - expected).abs() < 1e-6, "{ratio}, {nu}, {part}: {found}, not {expected}");
            }
        }
    }
}

#[test]
fn first_yield_goes_from_that_of_a_ball_to_that_of_a_line() {
    for (nu, ball, line) in [(0.2, 1.4986, 1.6439), (0.3, 1.6128, 1.7937), (0.4, 1.7385, 1.8895)] {
        let at = |ratio: f64| ellipse(ratio).pressure_at_yield(nu);
        assert!((at(1.0) / ball - 1.0).abs() < 1e-4, "{nu}: {}", at(1.0));
        assert!((at(1e4) / line - 1.0).abs() < 2e-3, "{nu}: {}", at(1e4));
        // the ball yields at that much more than the ball of equal radii
        let plane = ellipse(10.0).ball(&Body { poissons_ratio: nu, ..STEEL }, 1.0);
        let yields = |nu: f64| Strength::of(1.0, nu, 0.0).map_or(1.0, |strength| strength.at_yield());
        let ratio = yields(plane.poissons_ratio) / yields(nu);
        assert!((ratio / (at(10.0) / at(1.0)) - 1.0).abs() < 1e-12, "{nu}: {ratio}");
    }
}

/// The table of docs/guide/ellipse.md: ratio of the radii, of the half-axes, stiffness over that of a ball with the radius `sqrt(R' R'')`, and the
/// largest pressure at first yield over the strength.
const GUIDE: [[f64; 4]; 6] = [
    [1.0, 1.0, 1.0, 1.613],
    [2.0, 1.586, 1.010, 1.624],
    [5.0, 2.890, 1.054, 1.664],
    [10.0, 4.499, 1.109, 1.698],
    [25.0, 7.944, 1.212, 1.736],
    [100.0, 18.19, 1.435, 1.770],
];

#[test]
fn stiffness_and_first_yield_are_those_that_the_guide_says() {
    for [ratio, axes, stiffness, pressure] in GUIDE {
        let found = ellipse(ratio);
        let stiffer = found.stiffness * (found.radius / ratio.sqrt()).sqrt();
        for (value, said) in [(found.ratio, axes), (stiffer, stiffness), (found.pressure_at_yield(0.3), pressure)] {
            assert!((value / said - 1.0).abs() < 6e-4, "{ratio}: {value}, not {said}");
        }
    }
}

#[test]
fn the_pressure_of_a_slender_ellipse_is_that_of_a_line_across() {
    // p_0 = E* b/(2 R''), with p_0 of the ball in its place
    for (ratio, within) in [(25.0, 0.02), (1e3, 1e-3), (1e4, 1e-4)] {
        let found = ellipse(ratio);
        let [_, across] = found.half_axes(1.0);
        let pressure = 2.0 * found.stiffness / (PI * found.radius);
        assert!((pressure / (0.5 * across) - 1.0).abs() < within, "{ratio}: {pressure}, {across}");
    }
}

/// Each section of a slender ellipse is a line contact. So the mean pressure of the ellipse follows from that of lines, at the same half-width over
/// that at first yield.
#[test]
fn plastic_slender_ellipses_have_the_mean_pressure_of_line_contacts_within_six_percent() {
    let strength = 1e5;
    let found = ellipse(1e4);
    let ball = found.ball(&STEEL, found.radius);
    let rigid = Body::rigid(found.radius);
    let plane = Body { radius: f64::INFINITY, ..ball };
    let pair = Pair::new(&rigid, &plane, strength).expect("bodies that fit");
    let (_, law) = AnyLoading::ALL.into_iter().find(|(name, _)| *name == "brinell").expect("the law");
    let law = law.of_bodies(TwoBodies::under_rigid(0.0));
    let across = Pair::new(&Body::rigid(1.0), &STEEL, strength).expect("bodies that fit");
    let line = Line::of_constant(1.0, 11.0, &across, TwoBodies::under_rigid(0.0), false);
    let first = [law.yield_point(&pair).indentation, line.yield_point(&across).indentation];
    let [width, half_width] = [law.contact_radius(&pair, first[0]), line.contact_radius(&across, first[1])];
    // the depth at which a contact radius is so many times that at first yield
    let deep = |of: &dyn Fn(f64) -> f64, first: f64, wanted: f64| {
        let (mut low, mut high) = (1e-3 * first, 1e5 * first);
        for _ in 0..100 {
            let middle = (low * high).sqrt();
            *(if of(middle) < wanted { &mut low } else { &mut high }) = middle;
        }
        low
    };
    let of_line = |part: f64| {
        let radius = part * half_width;
        let depth = deep(&|depth| line.contact_radius(&across, depth), first[1], radius);
        line.segment(&across, depth).force(depth) / (2.0 * radius)
    };
    let mut largest = [0.0f64; 2];
    for part in [1.2, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 20.0, 30.0] {
        let radius = part * width;
        let depth = deep(&|depth| law.contact_radius(&pair, depth), first[0], radius);
        let own = law.segment(&pair, depth).force(depth) / (PI * radius * radius);
        let angles = (0..400).map(|count| (f64::from(count) + 0.5) / 400.0 * 0.5 * PI);
        let sections = angles.map(|angle| angle.cos().powi(2) * of_line(part * angle.cos())).sum::<f64>() / 400.0;
        let away = own / (2.0 * sections) - 1.0;
        println!("{part}: {:.4} S beside {:.4} S, {:.1} %", own / strength, 2.0 * sections / strength, 100.0 * away);
        largest = [largest[0].min(away), largest[1].max(away)];
    }
    assert!(largest[0] > -0.012 && largest[1] < 0.065, "{largest:?}");
}
