//! The limits of validity of the laws, in words.

use crate::numbers::{quantity, significant};
use crate::rods::{self, Waves};
use crate::scene::Scene;
use brinell_contact::Pair;
use brinell_contact::impact::Prediction;
use brinell_contact::loading::line::LARGEST_PART;
use brinell_contact::validity::{LARGEST_RADIUS_RATIO, LARGEST_SPEED_RATIO, wave_speed};

/// Fraction of the energy of an elastic impact that waves take, for this ratio of speed to wave speed.
///
/// Reference: as for [`LARGEST_SPEED_RATIO`].
fn wave_energy(speed_ratio: f64) -> f64 {
    1.04 * libm::pow(speed_ratio, 0.6)
}

/// A limit of validity that is exceeded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Beyond {
    /// Ratio of contact radius to effective radius.
    Width(f64),
    /// Ratio of contact radius to the radius \[m\] of the smaller body, where that is smaller than the effective radius.
    Size { ratio: f64, size: f64 },
    /// Largest ratio of a half-axis of an ellipse to the smallest radius in its direction.
    HalfAxis(f64),
    /// Ratio of the half-width of a line contact to the size \[m\] of the smaller body.
    Line { ratio: f64, size: f64 },
    /// Ratio of speed to wave speed, and the fraction of energy that waves take.
    Speed { ratio: f64, waves: f64 },
    /// The waves in rods, and the ratio of the predicted force to their largest.
    Waves { waves: Waves, excess: f64 },
    /// The plate of a loss bends for good: its thickness \[m\], the force \[N\] from which it does, and that of the impact over it.
    Bends { thickness: f64, collapse: f64, excess: f64 },
    /// Ratio of the contact time to the time \[s\] in which a wave runs through a rod and back.
    Short { travels: f64, last_return: f64 },
}

impl Beyond {
    /// Number of kinds.
    pub const KINDS: usize = 8;

    /// The number of its kind, and a measure of how far it is exceeded.
    pub fn rank(&self) -> (usize, f64) {
        match *self {
            Beyond::Width(ratio) => (0, ratio),
            Beyond::Size { ratio, .. } => (1, ratio),
            Beyond::Speed { ratio, .. } => (2, ratio),
            Beyond::Waves { excess, .. } => (3, excess),
            Beyond::Short { travels, .. } => (4, -travels),
            Beyond::Bends { excess, .. } => (5, excess),
            Beyond::Line { ratio, .. } => (6, ratio),
            Beyond::HalfAxis(ratio) => (7, ratio),
        }
    }

    /// Whether the contact is too wide.
    pub fn is_wide(&self) -> bool {
        matches!(self, Beyond::Width(_) | Beyond::Size { .. } | Beyond::Line { .. } | Beyond::HalfAxis(_))
    }
}

/// The limits known to the FMU that a contact of the bodies `pair`, of which the smaller one has this `size` \[m\], exceeds at this contact
/// `radius` \[m\] and this closing `speed` \[m/s\]; the `density` \[kg/m^3\] of the target may be unknown. A contact along a `line` has another size
/// \[m\].
pub fn beyond(
    (pair, size): (&Pair, f64),
    line: Option<f64>,
    density: Option<f64>,
    radius: f64,
    speed: f64,
) -> Vec<Beyond> {
    let along = line.map(|size| Beyond::Line { ratio: radius / size, size });
    let along = along.filter(|along| along.rank().1 > LARGEST_PART);
    let ratio = radius / pair.radius.min(size);
    let width = if size < pair.radius { Beyond::Size { ratio, size } } else { Beyond::Width(ratio) };
    let width = (ratio > LARGEST_RADIUS_RATIO).then_some(width);
    let waves = density.map_or(f64::INFINITY, |density| wave_speed(pair.youngs_modulus, density));
    let ratio = speed / waves;
    let speed = (ratio > LARGEST_SPEED_RATIO).then_some(Beyond::Speed { ratio, waves });
    along.or(width).into_iter().chain(speed).collect()
}

/// The force \[N\] at one point from which a plate with this `thickness` \[m\] and `strength` \[Pa\] bends for good: `2 pi M` with the
/// yield moment `M = sigma_y h^2/4` per length, whatever the size of the plate, if its edge is supported; twice that if it is clamped.
///
/// Reference: H. G. Hopkins, W. Prager, *J. Mech. Phys. Solids* 2 (1953) 1-13, in the limit of a load on a small area.
fn collapse(thickness: f64, strength: f64) -> f64 {
    0.5 * std::f64::consts::PI * strength * thickness * thickness
}

/// Whether a `force` \[N\] bends a plate for good.
pub fn bends(thickness: f64, strength: f64, force: f64) -> Option<Beyond> {
    let collapse = collapse(thickness, strength);
    (force > collapse).then_some(Beyond::Bends { thickness, collapse, excess: force / collapse })
}

/// The limits that each impact of a sweep or a table exceeds, with the values of the varied quantities.
#[derive(Default)]
pub struct SweepLimits {
    /// Name and unit of each varied quantity.
    pub names: Vec<(&'static str, &'static str)>,
    pub impacts: Vec<(Vec<f64>, Vec<Beyond>)>,
}

impl SweepLimits {
    /// A warning for each limit that some impacts exceed: how many, in which range, and the worst in words.
    pub fn warnings(&self) -> Vec<String> {
        (0..Beyond::KINDS).filter_map(|kind| self.warning(kind)).collect()
    }

    fn warning(&self, kind: usize) -> Option<String> {
        let sized = |(values, all): &'_ (Vec<f64>, Vec<Beyond>)| {
            let of_kind = all.iter().find(|beyond| beyond.rank().0 == kind)?;
            Some((values.clone(), of_kind.rank().1, *of_kind))
        };
        let found: Vec<_> = self.impacts.iter().filter_map(sized).collect();
        let (.., worst) = found.iter().max_by(|one, other| one.1.total_cmp(&other.1))?;
        let range = |(index, (name, unit)): (usize, &(&str, &'static str))| {
            let values = || found.iter().filter_map(|(values, ..)| values.get(index).copied());
            let (low, high) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
            format!("{name} from {} to {}", quantity(low, unit), quantity(high, unit))
        };
        let ranges: Vec<_> = self.names.iter().enumerate().map(range).collect();
        Some(format!(
            "{} of {} impacts are outside the law's validity ({}); at the worst, {}",
            found.len(),
            self.impacts.len(),
            ranges.join(", "),
            words(*worst)
        ))
    }
}

/// A warning that the first contact of a scene is too wide for these `laws`.
pub fn too_wide(scene: &Scene, laws: &[&str]) -> String {
    let size = scene.size(0);
    let (what, of) = if scene.contacts[0].ellipse.is_some() {
        ("a half-axis of the contact", SMALLEST.into())
    } else if size < scene.model().pair.radius {
        ("the contact radius", format!("of the smaller body's radius of {}", quantity(size, "m")))
    } else {
        ("the contact radius", "effective radii".into())
    };
    format!("{what} exceeds {LARGEST_RADIUS_RATIO} {of}, where no law is valid, with {}", laws.join(", "))
}

/// What the half-axes of an ellipse are compared with.
const SMALLEST: &str = "of the smallest radius in its direction";

/// An exceeded limit, in words.
pub fn words(beyond: Beyond) -> String {
    match beyond {
        Beyond::Width(ratio) => format!(
            "the contact radius reaches {} effective radii; above {LARGEST_RADIUS_RATIO} a sphere is no longer a paraboloid, \
             and the law isn't valid",
            significant(ratio, 3)
        ),
        Beyond::Size { ratio, size } if ratio >= 1.0 => format!(
            "the contact radius would be {} times the radius of the smaller body, {}: no contact is wider than its body",
            significant(ratio, 3),
            quantity(size, "m")
        ),
        Beyond::Size { ratio, size } => format!(
            "the contact radius reaches {} of the radius of the smaller body, {}; above {LARGEST_RADIUS_RATIO} that body is no \
             half-space beside the contact, and the law isn't valid",
            significant(ratio, 3),
            quantity(size, "m")
        ),
        Beyond::HalfAxis(ratio) => format!(
            "a half-axis of the contact reaches {} of the smallest radius in its direction; above {LARGEST_RADIUS_RATIO} a body is no \
             paraboloid beside the contact, and the law isn't valid",
            significant(ratio, 3)
        ),
        Beyond::Line { ratio, size } => format!(
            "the half-width reaches {} of the size of the smaller body, {}; above {LARGEST_PART} the depth isn't that of a small contact, and the \
             law isn't valid",
            significant(ratio, 3),
            quantity(size, "m")
        ),
        Beyond::Speed { ratio, waves } => format!(
            "the speed is {} of the wave speed of {waves:.0} m/s; above {LARGEST_SPEED_RATIO} elastic waves take energy \
             that the law neglects, here {} of that of an elastic impact",
            significant(ratio, 3),
            match wave_energy(ratio) {
                // a series in the ratio, which must be small
                part if part < 0.5 => format!("{:.0} %", 100.0 * part),
                _ => "most".into(),
            }
        ),
        Beyond::Waves { waves, .. } => rods::too_strong(&waves),
        Beyond::Bends { thickness, collapse, excess } => format!(
            "the plate of {} itself bends for good from {}, and the force reaches {} times that: the dent is then mainly one of \
             the bent sheet, which isn't predicted, and it takes energy",
            quantity(thickness, "m"),
            quantity(collapse, "N"),
            significant(excess, 3)
        ),
        Beyond::Short { travels, last_return } => rods::too_short(travels, last_return),
    }
}

/// The limits of validity of the first contact of an FMU, in words. Beyond them, the FMU logs a warning.
pub fn limits(scene: &Scene) -> String {
    let (model, size) = (scene.any_model(), scene.smaller_radius(0));
    let (pair, depth, density) = (model.pair(), model.valid_depth(size), scene.contacts[0].density);
    let (what, of) = match &scene.contacts[0].ellipse {
        Some(_) => ("half-axis", SMALLEST),
        None if size < pair.radius => ("contact radius", "of the radius of the smaller body"),
        None => ("contact radius", "effective radii"),
    };
    let radius =
        format!("up to a {what} of {LARGEST_RADIUS_RATIO} {of}, here an indentation of {}", quantity(depth, "m"));
    let radius = match scene.line_size(0) {
        Some(size) => format!(
            "up to a half-width of {LARGEST_PART} of the size of the smaller body, {}, and of {LARGEST_RADIUS_RATIO} effective radii, here an \
             indentation of {}",
            quantity(size, "m"),
            quantity(depth, "m")
        ),
        None => radius,
    };
    match density {
        Some(density) => format!(
            "{radius}, and up to a closing speed of {LARGEST_SPEED_RATIO} of the wave speed, here {}",
            quantity(LARGEST_SPEED_RATIO * wave_speed(pair.youngs_modulus, density), "m/s")
        ),
        None => format!("{radius}, and slow against elastic waves (the scene gives no density of the target)"),
    }
}

impl Waves {
    /// What makes the rods other than the compact bodies of this `prediction`.
    pub fn beyond(&self, prediction: &Prediction) -> Option<Beyond> {
        let travels = prediction.contact_time() / self.last_return;
        if prediction.max_force > self.largest_force {
            return Some(Beyond::Waves { waves: *self, excess: prediction.max_force / self.largest_force });
        }
        (travels < rods::COMPACT).then_some(Beyond::Short { travels, last_return: self.last_return })
    }
}
