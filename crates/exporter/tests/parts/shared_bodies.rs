//! The matrix of inverse effective masses from the text of a scene, against formulas of usual arrangements, and against
//! `J M^-1 J^T` with full matrices for any arrangement.

use brinell_exporter::scene::{InverseMasses, Scene, place};
use fastrand::Rng;
use std::fmt::Write;
use std::path::Path;

/// What each scene begins with.
const BEGIN: &str = "name = \"shared\"\n[impactor]\nradius = 5e-3\n[target]\nmaterial = \"mild steel\"\n";

/// The scene with these tables.
fn scene(tables: &str) -> Scene {
    let text = format!("{BEGIN}{tables}");
    Scene::parse(text.clone(), Path::new("shared.toml")).unwrap_or_else(|error| panic!("{error} in\n{text}"))
}

/// The matrix of the scene with these tables, and the number of its contacts.
fn matrix(tables: &str) -> (Vec<f64>, usize) {
    let scene = scene(tables);
    let count = scene.contact_count();
    match scene.inverse_masses() {
        Some(InverseMasses::Constant { entries, .. }) => {
            assert_eq!(entries.len(), count * (count + 1) / 2);
            (entries.clone(), count)
        }
        other => panic!("no constant matrix: {other:?}"),
    }
}

/// Asserts that the matrix has this function of two contacts as its entries, to some units in the last place of the diagonal.
fn assert_entries((entries, count): &(Vec<f64>, usize), last_places: f64, expected: impl Fn(usize, usize) -> f64) {
    for row in 0..*count {
        for column in row..*count {
            let (found, expected) = (entries[place(*count, row, column)], expected(row, column));
            let size = (entries[place(*count, row, row)] * entries[place(*count, column, column)]).sqrt();
            let difference = (found - expected).abs();
            assert!(difference <= last_places * f64::EPSILON * size, "{row}, {column}: {found:e}, not {expected:e}");
        }
    }
}

fn body(name: &str, mass: f64) -> String {
    format!("[[body]]\nname = \"{name}\"\nmass = {mass:?}\n")
}

fn contact(name: &str, bodies: [&str; 2], more: &str) -> String {
    format!("[[contact]]\nname = \"{name}\"\nbetween = {bodies:?}\n{more}\n")
}

#[test]
fn the_triangle_is_read_row_by_row() {
    for count in 1..20 {
        let mut next = 0;
        for row in 0..count {
            for column in row..count {
                assert_eq!([place(count, row, column), place(count, column, row)], [next, next]);
                next += 1;
            }
        }
        assert_eq!(next, count * (count + 1) / 2);
    }
}

/// `W_ii = 1/m_i + 1/m_(i+1)` and `W_(i,i+1) = -1/m_(i+1)`, whichever body of a contact comes first. At a wall 1/m = 0.
#[test]
fn a_chain_has_the_masses_of_its_links_to_the_bit() {
    let masses = [0.033, 0.05, 1.7e-3, 2.5, 0.1, 7e4];
    for walls in [[false, false], [true, false], [false, true], [true, true]] {
        for turned in [false, true] {
            let mut names: Vec<String> = (0..masses.len()).map(|index| format!("ball_{index}")).collect();
            let mut tables: String = names.iter().zip(masses).map(|(name, mass)| body(name, mass)).collect();
            let mut inverse: Vec<f64> = masses.iter().map(|mass| 1.0 / mass).collect();
            if walls[0] {
                names.insert(0, "ground".into());
                inverse.insert(0, 0.0);
            }
            if walls[1] {
                names.push("ground".into());
                inverse.push(0.0);
            }
            for (index, pair) in names.windows(2).enumerate() {
                let (bodies, direction) = match turned && index % 2 == 1 {
                    true => ([pair[1].as_str(), &pair[0]], "direction = -1"),
                    false => ([pair[0].as_str(), &pair[1]], if turned { "direction = 1" } else { "" }),
                };
                tables += &contact(&format!("link_{index}"), bodies, direction);
            }
            assert_entries(&matrix(&tables), 0.0, |row, column| match column - row {
                0 => inverse[row] + inverse[row + 1],
                1 => -inverse[column],
                _ => 0.0,
            });
        }
    }
}

/// The forces of two walls on a ball are opposite: W = (1/m) [[1, -1], [-1, 1]].
#[test]
fn a_ball_between_two_walls_moves_to_one_as_it_leaves_the_other() {
    let mass = 0.033;
    let ball = body("ball", mass);
    let (left, right) = (contact("left", ["ground", "ball"], ""), contact("right", ["ball", "ground"], ""));
    assert_eq!(matrix(&format!("{ball}{left}{right}")).0, [1.0 / mass, -1.0 / mass, 1.0 / mass]);
    // the same with normals, the arms along them
    let left = contact("left", ["ground", "ball"], "normal = [0, 3, 0]\narms = [[], [0, -5e-3, 0]]");
    let right = contact("right", ["ground", "ball"], "normal = [0, -0.1, 0]\narms = [[0, 0, 0], [0, 5e-3, 0]]");
    assert_eq!(matrix(&format!("{ball}{left}{right}")).0, [1.0 / mass, -1.0 / mass, 1.0 / mass]);
}

/// W_ij = 1/m + (r_i x n).I^-1 (r_j x n): with the normal along z that is 1/m + y_i y_j/I_xx + x_i x_j/I_yy, of rank 3.
#[test]
fn a_box_on_four_feet_has_a_matrix_of_rank_three() {
    let (mass, inertia) = (0.3, [1.2e-4, 2.6e-4, 3.5e-4]);
    let feet = [[0.04, 0.03], [0.04, -0.03], [-0.04, 0.03], [-0.04, -0.03]];
    let on_feet = |inertia: &str, bodies: [&str; 2], normal: &str, first: bool| {
        let mut tables = format!("{}inertia = {inertia}\n", body("box", mass));
        for (index, [x, y]) in feet.into_iter().enumerate() {
            let arm = format!("[{x}, {y}, -0.025]");
            let arms = if first { format!("[{arm}, []]") } else { format!("[[], {arm}]") };
            tables += &contact(&format!("foot_{index}"), bodies, &format!("normal = {normal}\narms = {arms}"));
        }
        matrix(&tables)
    };
    let principal = format!("{inertia:?}");
    let found = on_feet(&principal, ["box", "ground"], "[0, 0, -1]", true);
    assert_entries(&found, 4.0, |row, column| {
        let ([xi, yi], [xj, yj]) = (feet[row], feet[column]);
        1.0 / mass + yi * yj / inertia[0] + xi * xj / inertia[1]
    });
    // the force on the box is the same from whichever side the contact is told
    assert_eq!(on_feet(&principal, ["ground", "box"], "[0, 0, 20]", false), found);
    let [xx, yy, zz] = inertia;
    let tensor = format!("[{xx}, {yy}, {zz}, 0, 0, 0]");
    assert_eq!(on_feet(&tensor, ["box", "ground"], "[0, 0, -1]", true), found);
    assert_eq!(rank(&found), 3);
}

/// The number of pivots of a symmetric elimination that aren't rounding.
fn rank((entries, count): &(Vec<f64>, usize)) -> usize {
    let mut all: Vec<Vec<f64>> =
        (0..*count).map(|row| (0..*count).map(|column| entries[place(*count, row, column)]).collect()).collect();
    let largest = (0..*count).map(|row| all[row][row]).fold(0.0, f64::max);
    let mut left: Vec<usize> = (0..*count).collect();
    while let Some(place) = (0..left.len()).max_by(|one, other| {
        let [one, other] = [one, other].map(|index| all[left[*index]][left[*index]]);
        one.total_cmp(&other)
    }) {
        let pivot = left[place];
        if all[pivot][pivot] < 1e-12 * largest {
            break;
        }
        left.remove(place);
        let row = all[pivot].clone();
        for &other in &left {
            let factor = all[other][pivot] / row[pivot];
            all[other].iter_mut().zip(&row).for_each(|(element, pivot)| *element -= factor * pivot);
        }
    }
    count - left.len()
}

#[test]
fn an_oblique_ball_that_touches_at_its_surface_needs_no_inertia() {
    let mut random = Rng::with_seed(5);
    for _ in 0..200 {
        let mut part = || random.f64() - 0.5;
        let normal = [part(), part(), part()];
        let radius = 10f64.powf(6.0 * part());
        let arm = normal.map(|part| radius * part);
        let ball = body("ball", 0.25);
        let with_arm = contact("floor", ["ball", "ground"], &format!("normal = {normal:?}\narms = [{arm:?}, []]"));
        let (entries, _) = matrix(&format!("{ball}{with_arm}"));
        assert!((entries[0] * 0.25 - 1.0).abs() < 4.0 * f64::EPSILON, "{entries:?}");
    }
}

/// A body of a random scene: its mass, its tensor of inertia, and the text of that.
struct Rigid {
    mass: f64,
    inertia: [[f64; 3]; 3],
    text: String,
}

/// A body whose moments of inertia are those of the squares of random lengths.
fn rigid(random: &mut Rng) -> Rigid {
    let mass = 10f64.powf(4.0 * random.f64() - 3.0);
    let size = mass * 10f64.powf(4.0 * random.f64() - 4.0);
    let zero = [[0.0; 3]; 3];
    let (inertia, text) = match random.usize(..3) {
        0 => {
            let inertia = [0, 1, 2].map(|row| [0, 1, 2].map(|column| if row == column { size } else { 0.0 }));
            (inertia, format!("{size:e}"))
        }
        1 => {
            let mut inertia = zero;
            (0..3).for_each(|axis| inertia[axis][axis] = size * (0.1 + random.f64()));
            (inertia, format!("[{:e}, {:e}, {:e}]", inertia[0][0], inertia[1][1], inertia[2][2]))
        }
        _ => {
            // B B^T and something on the diagonal is positive definite
            let root: [[f64; 3]; 3] = [0, 1, 2].map(|_| [0, 1, 2].map(|_| random.f64() - 0.5));
            let mut inertia = zero;
            for row in 0..3 {
                for column in 0..3 {
                    let square: f64 = (0..3).map(|k| root[row][k] * root[column][k]).sum();
                    inertia[row][column] = size * (square + if row == column { 0.05 } else { 0.0 });
                }
            }
            let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = inertia;
            (inertia, format!("[{xx:e}, {yy:e}, {zz:e}, {xy:e}, {xz:e}, {yz:e}]"))
        }
    };
    Rigid { mass, inertia, text }
}

/// The solution of `matrix x = right`, by elimination with pivots.
fn solved(mut matrix: Vec<Vec<f64>>, mut right: Vec<f64>) -> Vec<f64> {
    let count = right.len();
    for column in 0..count {
        let best =
            (column..count).max_by(|one, other| matrix[*one][column].abs().total_cmp(&matrix[*other][column].abs()));
        let best = best.expect("a row is left");
        matrix.swap(column, best);
        right.swap(column, best);
        let pivot = matrix[column].clone();
        for row in column + 1..count {
            let factor = matrix[row][column] / pivot[column];
            matrix[row].iter_mut().zip(&pivot).for_each(|(element, pivot)| *element -= factor * pivot);
            right[row] -= factor * right[column];
        }
    }
    for row in (0..count).rev() {
        let known: f64 = (row + 1..count).map(|k| matrix[row][k] * right[k]).sum();
        right[row] = (right[row] - known) / matrix[row][row];
    }
    right
}

/// The closing rate of a contact of two bodies with the velocities (v, omega) of all bodies: the velocity of the first minus that
/// of the second, where they touch, along the normal.
fn closing_rate(velocities: &[f64], ends: [Option<usize>; 2], normal: [f64; 3], arms: [[f64; 3]; 2]) -> f64 {
    let at = |body: Option<usize>, [x, y, z]: [f64; 3]| {
        let Some(body) = body else { return 0.0 };
        let [vx, vy, vz, wx, wy, wz] = velocities[6 * body..6 * body + 6].try_into().expect("six numbers of a body");
        let velocity: [f64; 3] = [vx + wy * z - wz * y, vy + wz * x - wx * z, vz + wx * y - wy * x];
        (0..3).map(|k| velocity[k] * normal[k]).sum()
    };
    at(ends[0], arms[0]) - at(ends[1], arms[1])
}

/// Random bodies with random contacts in space: the matrix of the scene is `J M^-1 J^T`, where J is the change of the closing
/// rates with each velocity, and M the matrix of all masses and inertias.
#[test]
fn rigid_bodies_in_space_have_the_matrix_of_their_jacobian() {
    let random = &mut Rng::with_seed(44);
    for case in 0..300 {
        let bodies: Vec<Rigid> = (0..random.usize(1..6)).map(|_| rigid(random)).collect();
        let (mut tables, mut jacobian, mut contacts) = (String::new(), Vec::new(), Vec::new());
        for (index, Rigid { mass, text, .. }) in bodies.iter().enumerate() {
            let _ = write!(tables, "[[body]]\nname = \"body_{index}\"\nmass = {mass:e}\ninertia = {text}\n");
        }
        let count = bodies.len() + random.usize(..9);
        for index in 0..count {
            // each body is in a contact
            let one = if index < bodies.len() { Some(index) } else { Some(random.usize(..bodies.len())) };
            let mut others: Vec<Option<usize>> = (0..bodies.len()).map(Some).chain([None]).collect();
            others.retain(|other| *other != one);
            let other = random.choice(others).expect("the ground is left");
            let ends = if random.bool() { [one, other] } else { [other, one] };
            let mut vector = |size: f64| [0, 1, 2].map(|_| size * (random.f64() - 0.5));
            let (normal, mut arms) = (vector(3.0), [vector(0.2), vector(0.2)]);
            for (end, arm) in ends.iter().zip(&mut arms) {
                *arm = if end.is_none() { [0.0; 3] } else { *arm };
            }
            let name = |end: Option<usize>| end.map_or("ground".into(), |index| format!("body_{index}"));
            let (first, second) = (name(ends[0]), name(ends[1]));
            let more = format!("normal = {normal:?}\narms = {arms:?}");
            contacts.push(contact(&format!("contact_{index}"), [&first, &second], &more));
            let length = normal.iter().map(|part| part * part).sum::<f64>().sqrt();
            let unit = normal.map(|part| part / length);
            let axis = |axis: usize| (0..6 * bodies.len()).map(|other| f64::from(other == axis)).collect::<Vec<_>>();
            let row = (0..6 * bodies.len()).map(|coordinate| closing_rate(&axis(coordinate), ends, unit, arms));
            jacobian.push(row.collect::<Vec<_>>());
        }
        let mut masses = vec![vec![0.0; 6 * bodies.len()]; 6 * bodies.len()];
        for (index, Rigid { mass, inertia, .. }) in bodies.iter().enumerate() {
            for row in 0..3 {
                masses[6 * index + row][6 * index + row] = *mass;
                (0..3).for_each(|column| masses[6 * index + 3 + row][6 * index + 3 + column] = inertia[row][column]);
            }
        }
        let answers: Vec<Vec<f64>> = jacobian.iter().map(|row| solved(masses.clone(), row.clone())).collect();
        let found = matrix(&format!("{tables}{}", contacts.concat()));
        // rounding grows with the ratio of the moments of inertia, below 100
        assert_entries(&found, 2000.0, |row, column| {
            jacobian[row].iter().zip(&answers[column]).map(|(one, other)| one * other).sum()
        });
        assert!(rank(&found) <= 6 * bodies.len(), "case {case}");
        // in another order the entries are the same, to the bit
        let mut order: Vec<usize> = (0..count).collect();
        random.shuffle(&mut order);
        let others: String = order.iter().map(|index| contacts[*index].as_str()).collect();
        let (other, _) = matrix(&format!("{tables}{others}"));
        for row in 0..count {
            for column in 0..count {
                let [here, there] =
                    [other[place(count, row, column)], found.0[place(count, order[row], order[column])]];
                assert_eq!(here.to_bits(), there.to_bits(), "case {case}: {row}, {column}");
            }
        }
    }
}

#[test]
fn contacts_without_a_common_body_have_an_exact_zero() {
    let tables = body("one", 0.1) + &body("other", 3.0);
    let left = contact("left", ["one", "ground"], "normal = [0.3, 0.2, 0.1]");
    let right = contact("right", ["ground", "other"], "normal = [0.1, 0.2, 0.3]");
    assert_eq!(matrix(&format!("{tables}{left}{right}")).0[1].to_bits(), 0.0f64.to_bits());
}

/// A factor of two in masses and inertias, or in lengths, moves the exponents only.
#[test]
fn the_matrix_scales_with_mass_and_length_to_the_bit() {
    let at = |mass: f64, length: f64| {
        let inertia = [2.1e-4, 3.3e-4, 2.7e-4, 0.4e-4, -0.2e-4, 0.7e-4].map(|element| element * mass * length * length);
        let arm = [0.04, -0.01, 0.03].map(|part| part * length);
        let tables = format!("{}inertia = {inertia:?}\n{}", body("box", 0.3 * mass), body("ball", 0.02 * mass));
        let left = contact("left", ["box", "ground"], &format!("normal = [1, 2, 3]\narms = [{arm:?}, []]"));
        let right = contact("right", ["ball", "box"], &format!("normal = [3, -1, 2]\narms = [[], {arm:?}]"));
        matrix(&format!("{tables}{left}{right}")).0
    };
    let reference = at(1.0, 1.0);
    for (mass, length) in [(2.0, 1.0), (1.0, 0.25), (1024.0, 8.0)] {
        assert_eq!(at(mass, length), reference.iter().map(|entry| entry / mass).collect::<Vec<_>>());
    }
}

/// Each contact's impact is predicted with its effective mass, as in a unit that knows only that.
#[test]
fn the_prediction_of_each_contact_is_that_of_its_effective_mass() {
    let law = "[impact]\nspeed = 2.0\n[fmu]\noutputs = [\"closing_speed\"]\n";
    let tables = format!("{law}{}{}", body("one", 0.5), body("other", 1.0));
    let left = contact("left", ["ground", "one"], "");
    let right = contact("right", ["one", "other"], "target = { yield_strength = 5e8 }");
    let shared = scene(&format!("{tables}{left}{right}"));
    assert_eq!(shared.contacts.iter().map(|group| group.own.len()).collect::<Vec<_>>(), [0, 1]);
    for (group, mass) in [0.5, 1.0 / 3.0].into_iter().enumerate() {
        let own = if group == 1 { "target = { yield_strength = 5e8 }" } else { "" };
        let single = format!("{law}[coupling]\neffective_mass = {mass:?}\n[[contact]]\nname = \"only\"\n{own}\n");
        let single = scene(&single);
        assert_eq!(shared.impact_of(group), single.impact_of(0));
        assert_eq!(format!("{:?}", shared.predictions[group]), format!("{:?}", single.predictions[0]));
    }
}

#[test]
fn a_scene_with_inputs_has_no_matrix_and_one_mass_for_its_predictions() {
    for (contacts, count) in [("", 1), ("[[contact]]\nname = \"left\"\n[[contact]]\nname = \"right\"\ncount = 3\n", 4)]
    {
        let text = format!(
            "[coupling]\ninverse_masses = \"input\"\nmaster = \"parallel\"\n[impact]\nmass = 0.02\nspeed = 1\n{contacts}"
        );
        let scene = scene(&text);
        assert_eq!(scene.inverse_masses(), Some(&InverseMasses::Inputs));
        assert_eq!(scene.contact_count(), count);
        assert_eq!(scene.impact_of(0).mass, 0.02);
        let coupling = scene.coupling.as_ref().expect("the unit moves the bodies");
        assert!(coupling.parallel && !scene.mass_is_input() && scene.value("effective_mass").is_none());
    }
}

/// The unit moves the bodies, with or without a table `[coupling]`.
#[test]
fn bodies_are_coupled_as_the_scene_says() {
    let bodies = format!("{}{}", body("ball", 0.1), contact("floor", ["ball", "ground"], ""));
    let coupling = |table: &str| scene(&format!("{table}{bodies}")).coupling.expect("the unit moves the bodies");
    assert!(!coupling("").parallel && !coupling("").acceleration_input);
    assert!(coupling("[coupling]\nmaster = \"parallel\"\n").parallel);
    assert!(coupling("[coupling]\ninputs = [\"external_acceleration\"]\n").acceleration_input);
    let scene = scene(&bodies);
    assert!(scene.outputs.iter().any(|output| output == "mean_force"));
    assert!(scene.value("effective_mass").is_none() && !scene.has_input("effective_mass") && !scene.watches);
}
