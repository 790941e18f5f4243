//! Contacts that share bodies: the tables `[[body]]`, and what each contact says of its two bodies.

use super::file::{ContactTable, SceneFile, SharedBodyTable};
use super::inverse_masses::{self, End, FreeBody, Inertia, InverseMasses, Meeting, Vector};
use super::names::check_identifier;
use super::quantities::{PRODUCT, quantity_of};
use crate::layout::shortened;
use crate::mistake::{Mistake, Spanned};
use crate::nearest::unknown;
use crate::numbers::{in_message, out_of_range};
use std::collections::{HashMap, HashSet};
use std::ops::Range;
use toml::Value;

/// The body that never moves. Every scene has it.
pub const GROUND: &str = "ground";

/// Largest number of contacts of a unit whose bodies are shared. The matrix of the inverse masses grows with its square.
const MOST_SHARING: usize = 256;

/// The inverse effective masses of the scene `file` with friction in so many `directions`, if its contacts share bodies.
///
/// # Errors
/// The first mistake in the bodies.
pub fn check(file: &SceneFile, directions: usize) -> Result<Option<InverseMasses>, Mistake> {
    let inputs = file.coupling.as_ref().and_then(|coupling| coupling.get_ref().inverse_masses.as_ref());
    let Some(bodies) = &file.body else {
        inputs.map(|inputs| check_count(inputs.span(), file)).transpose()?;
        return Ok(inputs.map(|_| InverseMasses::Inputs));
    };
    let Some(first) = bodies.get_ref().first() else {
        let message = "the list of bodies is empty; leave it out, or give tables [[body]] with name and mass";
        return Err(Mistake(bodies.span(), message.into()));
    };
    check_count(first.span(), file)?;
    of_bodies(bodies.get_ref(), contacts_of(file).unwrap_or_default(), directions).map(Some)
}

fn contacts_of(file: &SceneFile) -> Option<&[Spanned<ContactTable>]> {
    file.contact.as_ref().map(|contacts| contacts.get_ref().as_slice())
}

/// A mistake in a contact.
fn wrong(contact: &ContactTable, span: Range<usize>, message: &str) -> Mistake {
    Mistake(span, format!("contact `{}`: {message}", contact.name.get_ref()))
}

/// Rejects more contacts than the matrix is made for. `place` is where the scene says that they share bodies.
fn check_count(place: Range<usize>, file: &SceneFile) -> Result<(), Mistake> {
    let count_of = |contact: &Spanned<ContactTable>| match &contact.get_ref().count {
        Some(count) => usize::try_from(*count.get_ref()).unwrap_or(0),
        None => 1,
    };
    let count: usize = contacts_of(file).unwrap_or_default().iter().map(count_of).sum();
    if count <= MOST_SHARING {
        return Ok(());
    }
    Err(Mistake(place, format!("there are {count} contacts: allowed are {MOST_SHARING} that share bodies")))
}

/// The bodies of a scene.
struct Bodies<'a> {
    /// The names of those that are free to move.
    names: Vec<&'a str>,
    free: Vec<FreeBody>,
    /// The index of each name; `None` is the ground.
    index: HashMap<&'a str, Option<usize>>,
}

impl<'a> Bodies<'a> {
    fn of(tables: &'a [Spanned<SharedBodyTable>]) -> Result<Bodies<'a>, Mistake> {
        let mut bodies = Bodies { names: Vec::new(), free: Vec::new(), index: HashMap::from([(GROUND, None)]) };
        for table in tables {
            let SharedBodyTable { name, mass, inertia } = table.get_ref();
            check_identifier(name)?;
            let text = name.get_ref().as_str();
            if text == GROUND {
                let message =
                    "name = \"ground\" is the body that never moves, and is always there: call this one otherwise";
                return Err(Mistake(name.span(), message.into()));
            }
            if bodies.index.insert(text, Some(bodies.free.len())).is_some() {
                return Err(Mistake(name.span(), format!("name = {text:?} is taken by another body")));
            }
            let inertia = inertia.as_ref().map(|inertia| check_inertia(text, inertia)).transpose()?;
            bodies.names.push(text);
            bodies.free.push(FreeBody { mass: *mass.get_ref(), inertia });
        }
        Ok(bodies)
    }

    /// A body in an impact on a contact with these `axes`, the normal and a tangent, at this `arm`.
    fn meeting(&self, body: Option<usize>, axes: [Vector; 2], arm: Vector) -> Meeting {
        let Some(body) = body else {
            return Meeting { name: GROUND.into(), mass: f64::INFINITY, turns: [0.0; 2], arms: [0.0; 2] };
        };
        let FreeBody { mass, inertia } = self.free[body];
        let across = inverse_masses::cross(axes[0], axes[1]);
        let arms = axes.map(|axis| inverse_masses::dot(across, inverse_masses::cross(arm, axis)));
        let turns =
            axes.map(|axis| inertia.map_or(0.0, |inertia| inertia.turn(across, inverse_masses::cross(arm, axis))));
        Meeting { name: self.names[body].into(), mass, turns, arms }
    }

    /// The two bodies of a `contact`, which the rules ask for.
    fn between(&self, contact: &Spanned<ContactTable>) -> Result<[Option<usize>; 2], Mistake> {
        let table = contact.get_ref();
        let Some(between) = &table.between else { return Ok([None; 2]) };
        let list = || names_in_message(between.get_ref());
        let [one, other] = between.get_ref().as_slice() else {
            let message = format!("between = {} must name two bodies", list());
            return Err(wrong(table, between.span(), &message));
        };
        let find = |name: &Spanned<String>| {
            self.index.get(name.get_ref().as_str()).copied().ok_or_else(|| {
                let known = [GROUND].into_iter().chain(self.names.iter().copied());
                wrong(table, name.span(), &unknown("body", name.get_ref(), known))
            })
        };
        let ends = [find(one)?, find(other)?];
        if ends[0] == ends[1] {
            let message = format!("between = {} must name two different bodies", list());
            return Err(wrong(table, between.span(), &message));
        }
        Ok(ends)
    }
}

fn names_in_message(names: &[Spanned<String>]) -> String {
    let names = names.iter().map(|name| format!("{:?}", name.get_ref())).collect::<Vec<_>>();
    shortened(&format!("[{}]", names.join(", ")))
}

fn numbers_in_message(numbers: &[f64]) -> String {
    let numbers = numbers.iter().map(|number| in_message(*number)).collect::<Vec<_>>();
    shortened(&format!("[{}]", numbers.join(", ")))
}

/// The forms of an inertia, for messages.
const FORMS: &str =
    "allowed are one number (a ball), three (principal, along x, y, z) or six (xx, yy, zz, xy, xz, yz) [kg m^2]";

/// The number that a value is; what it is if it is none.
pub fn number_in(value: &Value) -> Result<f64, String> {
    match value {
        Value::Float(number) => Ok(*number),
        Value::Integer(number) => Ok(*number as f64),
        Value::String(text) => Err(format!("= {:?}", shortened(text))),
        Value::Boolean(value) => Err(format!("= {value}")),
        Value::Datetime(_) => Err("as a date".into()),
        Value::Array(_) => Err("as a list".into()),
        Value::Table(_) => Err("as a table".into()),
    }
}

/// The inertia of the body `name`.
fn check_inertia(name: &str, given: &Spanned<Value>) -> Result<Inertia, Mistake> {
    let no = |message: String| Mistake(given.span(), format!("body `{name}`: inertia{message}"));
    let (values, is_list) = match given.get_ref() {
        Value::Array(values) => (values.as_slice(), true),
        value => (std::slice::from_ref(value), false),
    };
    let place = |index: usize| if is_list { format!("[{}]", index + 1) } else { String::new() };
    let number =
        |(index, value)| number_in(value).map_err(|what| no(format!("{} {what} is no number: {FORMS}", place(index))));
    let numbers = values.iter().enumerate().map(number).collect::<Result<Vec<f64>, Mistake>>()?;
    let elements = match *numbers {
        [ball] => [ball, ball, ball, 0.0, 0.0, 0.0],
        [x, y, z] => [x, y, z, 0.0, 0.0, 0.0],
        [xx, yy, zz, xy, xz, yz] => [xx, yy, zz, xy, xz, yz],
        _ => return Err(no(format!(" = {} has {} numbers: {FORMS}", numbers_in_message(&numbers), numbers.len()))),
    };
    for (index, number) in numbers.iter().enumerate() {
        let allowed = quantity_of("body", if index < 3 { "inertia" } else { PRODUCT }).allowed;
        if !allowed.contains(number) {
            return Err(no(format!("{} {}", place(index), out_of_range(*number, &allowed, "kg m^2"))));
        }
    }
    Inertia::of(elements).ok_or_else(|| {
        no(format!(
            " = {} is not positive definite: about some axis the moment isn't positive; allowed are products xy, xz, yz that are \
             small enough beside xx, yy, zz, such as xy^2 < xx yy",
            numbers_in_message(&numbers)
        ))
    })
}

/// The matrix for these `contacts` of the bodies in `tables`, with friction in so many `directions`.
fn of_bodies(
    tables: &[Spanned<SharedBodyTable>],
    contacts: &[Spanned<ContactTable>],
    directions: usize,
) -> Result<InverseMasses, Mistake> {
    let bodies = Bodies::of(tables)?;
    let mut meeting = None;
    let (mut all, mut touched) = (vec![Vec::new(); 1 + directions], HashSet::new());
    for contact in contacts {
        let table = contact.get_ref();
        let between = bodies.between(contact)?;
        touched.extend(between);
        let normal = table.normal.as_ref().map_or_else(|| line_of(table), |normal| normal_of(table, normal))?;
        let tangents: Vec<_> = tangents_of(table, normal, directions)?.collect();
        let arms = arms_of(table, between)?;
        if let (None, Some(tangent)) = (&meeting, tangents.first()) {
            meeting = Some([0, 1].map(|place| bodies.meeting(between[place], [normal, *tangent], arms[place])));
        }
        for (rows, axis) in all.iter_mut().zip([normal].into_iter().chain(tangents)) {
            rows.push(ends_of(table, &bodies, between, (axis, arms))?);
        }
    }
    if let Some(index) = (0..tables.len()).find(|index| !touched.contains(&Some(*index))) {
        let message = format!("body `{}` is in no contact: name it in `between`, or leave it out", bodies.names[index]);
        return Err(Mistake(tables[index].span(), message));
    }
    let rows = all.concat();
    let matrix = InverseMasses::Constant { entries: inverse_masses::triangle(&bodies.free, &rows), meeting };
    let allowed = quantity_of("body", "mass").allowed;
    for row in 0..rows.len() {
        let contact = &contacts[row % contacts.len()];
        let mass = matrix.effective_mass(row, rows.len()).expect("the matrix is constant");
        if !allowed.contains(&mass) {
            let message = format!("the effective mass of its bodies {}", out_of_range(mass, &allowed, "kg"));
            return Err(wrong(contact.get_ref(), contact.span(), &message));
        }
    }
    Ok(matrix)
}

/// The ends of a `contact` along an `axis`, its normal or a tangent, at the bodies `between` which it is and at these `arms`.
fn ends_of(
    contact: &ContactTable,
    bodies: &Bodies<'_>,
    between: [Option<usize>; 2],
    (axis, arms): (Vector, [Vector; 2]),
) -> Result<Vec<End>, Mistake> {
    let mut ends = Vec::new();
    for (place, (body, sign)) in between.into_iter().zip([1.0, -1.0]).enumerate() {
        let Some(body) = body else { continue };
        let end = End::of(&bodies.free, body, axis.map(|part| sign * part), arms[place]);
        ends.push(end.ok_or_else(|| {
            let name = bodies.names[body];
            let what = if contact.tangent.is_some() { "the normal or the tangent" } else { "the normal" };
            let message = format!(
                "arms[{}] = {} isn't parallel to {what}, so that the force turns the body `{name}`: give its inertia",
                place + 1,
                numbers_in_message(&arms[place])
            );
            wrong(contact, contact.arms.as_ref().map_or(0..0, |arms| arms.get_ref()[place].span()), &message)
        })?);
    }
    Ok(ends)
}

/// The tangents of a contact with this `normal`, in so many `directions`: the given one as far as it is across the normal, and the one
/// across both.
fn tangents_of(
    table: &ContactTable,
    normal: Vector,
    directions: usize,
) -> Result<impl Iterator<Item = Vector> + use<>, Mistake> {
    let Some(given) = &table.tangent else { return Ok([[0.0; 3]; 2].into_iter().take(0)) };
    let numbers = given.get_ref();
    let tangent = <[f64; 3]>::try_from(numbers.as_slice()).ok().and_then(inverse_masses::direction);
    let across = tangent.and_then(|tangent| inverse_masses::across(normal, tangent));
    let Some(first) = across else {
        let message = format!(
            "tangent = {} is no direction along the surface: allowed are three finite numbers x, y, z at right angles to the \
             normal, within 1e-6",
            numbers_in_message(numbers)
        );
        return Err(wrong(table, given.span(), &message));
    };
    Ok([first, inverse_masses::cross(normal, first)].into_iter().take(directions))
}

/// The normal of a `contact` on a line, from its first body to its second. The line is the axis x.
fn line_of(contact: &ContactTable) -> Result<Vector, Mistake> {
    match contact.direction.as_ref().map(Spanned::get_ref) {
        None | Some(1) => Ok([1.0, 0.0, 0.0]),
        Some(-1) => Ok([-1.0, 0.0, 0.0]),
        Some(other) => {
            let message = format!(
                "direction = {other} is out of range: allowed are 1, the second body is on the positive side of the line, and -1"
            );
            Err(wrong(contact, contact.direction.as_ref().map_or(0..0, Spanned::span), &message))
        }
    }
}

/// The normal of a contact in space, from its first body to its second.
fn normal_of(table: &ContactTable, normal: &Spanned<Vec<f64>>) -> Result<Vector, Mistake> {
    let numbers = normal.get_ref();
    let vector = <[f64; 3]>::try_from(numbers.as_slice()).ok().and_then(inverse_masses::direction);
    vector.ok_or_else(|| {
        let message = format!(
            "normal = {} is no direction: allowed are three finite numbers x, y, z that are not all zero",
            numbers_in_message(numbers)
        );
        wrong(table, normal.span(), &message)
    })
}

/// The place of a `contact` relative to the centre of mass of each of its two bodies \[m\].
fn arms_of(contact: &ContactTable, between: [Option<usize>; 2]) -> Result<[Vector; 2], Mistake> {
    let Some(arms) = &contact.arms else { return Ok([[0.0; 3]; 2]) };
    let given = arms.get_ref();
    if given.len() != 2 {
        let message = format!("arms has {} vectors: allowed are two, one for each body in `between`", given.len());
        return Err(wrong(contact, arms.span(), &message));
    }
    let mut vectors = [[0.0; 3]; 2];
    for (place, (arm, vector)) in given.iter().zip(&mut vectors).enumerate() {
        let numbers = arm.get_ref();
        let said = || format!("arms[{}] = {}", place + 1, numbers_in_message(numbers));
        *vector = match numbers.as_slice() {
            [] => [0.0; 3],
            &[x, y, z] if [x, y, z].iter().all(|part| quantity_of("contact", "arms").allowed.contains(part)) => {
                [x, y, z]
            }
            _ => {
                let message = format!("{} is no arm: allowed are three numbers from -1e6 to 1e6 m, or none", said());
                return Err(wrong(contact, arm.span(), &message));
            }
        };
        if between[place].is_none() && *vector != [0.0; 3] {
            let message = format!("{}: \"{GROUND}\" never moves and takes no arm: allowed is []", said());
            return Err(wrong(contact, arm.span(), &message));
        }
    }
    Ok(vectors)
}
