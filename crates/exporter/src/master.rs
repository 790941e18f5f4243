//! Masters: they move the bodies against one contact of an FMU, as a user's importer would. The ways to couple a contact with a mass;
//! and a ball on a contact with friction.

use brinell_contact::tangential::impact::Ball;

/// Number of iterations between a force that follows the rate and the speed that it causes.
const ITERATIONS: u32 = 3;

/// One contact of an FMU, as a master uses it.
pub trait Coupled {
    /// Why a call fails.
    type Error;

    /// Sets the closing speed \[m/s\].
    fn set_rate(&mut self, rate: f64) -> Result<(), Self::Error>;

    /// Sets the derivatives of the closing speed for the next step: \[m/s^2\], \[m/s^3\].
    fn set_derivatives(&mut self, derivatives: &[f64]) -> Result<(), Self::Error>;

    /// Makes a step \[s\].
    fn step(&mut self, step: f64) -> Result<(), Self::Error>;

    /// The force at the end of the step \[N\].
    fn force(&mut self) -> Result<f64, Self::Error>;

    /// The time derivative of the force at the end of the step \[N/s\].
    fn force_slope(&mut self) -> Result<f64, Self::Error>;

    /// The mean force over the step \[N\].
    fn mean_force(&mut self) -> Result<f64, Self::Error>;

    /// The force that the FMU predicts for the end of the next step \[N\].
    fn predicted_force(&mut self) -> Result<f64, Self::Error>;
}

/// The result of an impact for the importer.
pub struct Rebound {
    /// Rebound speed away from the surface \[m/s\]; NaN if the impact was not over after an excessive number of steps.
    pub speed: f64,
    /// At the ends of steps \[N\].
    pub max_force: f64,
}

/// The mass that the importer moves.
#[derive(Clone, Copy)]
pub struct Body {
    /// \[kg\]
    pub mass: f64,
    /// A constant force towards the surface \[N\].
    pub load: f64,
    /// Towards the surface \[m/s\].
    pub speed: f64,
    /// Contact force at the end of the last step \[N\].
    pub force: f64,
    /// Its time derivative \[N/s\], for the way that needs it.
    slope: f64,
    /// The force for the next step \[N\], for the way that applies it one step late.
    pub owed: f64,
}

/// How a step of contact and mass is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Scheme {
    Jacobi,
    Predicted,
    LeapFrog,
    LeapFrogFollowed,
    Derivatives,
    MassKnown,
    JacobiMass,
}

/// The features of the FMU that a way to couple needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Requirements {
    /// The force.
    Force,
    /// The predicted force at the end of the next step.
    PredictedForce,
    /// Input derivatives, and the mean force over the step.
    MeanForce,
    /// The mass as a parameter.
    Mass,
    /// The mass as a parameter, with the force applied one step late.
    JacobiMass,
}

/// Co-simulation algorithms.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Master {
    /// Steps the contact first and applies its force over the same step: the user's own loop, Gauss-Seidel.
    Serial,
    /// Steps all FMUs at once and exchanges values between steps: Jacobi.
    Parallel,
}

impl Requirements {
    /// Whether the FMU moves the mass itself.
    pub fn knows_mass(self) -> bool {
        matches!(self, Requirements::Mass | Requirements::JacobiMass)
    }
}

impl Master {
    /// The name of the algorithm.
    pub fn name(self) -> &'static str {
        match self {
            Master::Serial => "serial (Gauss-Seidel)",
            Master::Parallel => "parallel (Jacobi)",
        }
    }
}

/// A way to couple.
pub struct CouplingMethod {
    pub name: &'static str,
    /// Description in words.
    pub what: &'static str,
    scheme: Scheme,
    pub needs: Requirements,
    pub master: Master,
    /// The largest stable step for a linear spring, as `h sqrt(K/m)`: 0 for a way that is never stable, infinity for
    /// one that is always stable. Below, `z = h^2 K/m`, `x` is the indentation and `u = h v`.
    pub stable: f64,
}

/// The user's own loop.
pub const LEAP_FROG: CouplingMethod = CouplingMethod {
    name: "leap-frog",
    what: "step the contact, then the bodies with its new force",
    scheme: Scheme::LeapFrog,
    needs: Requirements::Force,
    master: Master::Serial,
    stable: 2.0,
};

/// The same for a force that follows the rate: it is that of the speed in the middle of the change that it causes.
pub const LEAP_FROG_FOLLOWED: CouplingMethod =
    CouplingMethod { name: "leap-frog, iterated", scheme: Scheme::LeapFrogFollowed, ..LEAP_FROG };

/// The FMU moves the mass: exact.
pub const MASS_KNOWN: CouplingMethod = CouplingMethod {
    name: "mass known",
    what: "the FMU moves the mass within the step; apply mean_force",
    scheme: Scheme::MassKnown,
    needs: Requirements::Mass,
    master: Master::Serial,
    stable: f64::INFINITY,
};

/// The FMU moves the mass, and tracks the momentum that has not reached the importer's mass yet: exact.
pub const JACOBI_MASS: CouplingMethod = CouplingMethod {
    name: "mass known, parallel",
    what: "the FMU moves the mass; apply the mean_force of the previous step",
    scheme: Scheme::JacobiMass,
    needs: Requirements::JacobiMass,
    master: Master::Parallel,
    stable: f64::INFINITY,
};

/// All ways in a report.
pub static COUPLING_METHODS: [CouplingMethod; 6] = [
    // `x' = x + u`, `u' = u - z x`: both eigenvalues have the modulus `sqrt(1 + z)`
    CouplingMethod {
        name: "late force",
        what: "apply the force of the previous step",
        scheme: Scheme::Jacobi,
        needs: Requirements::Force,
        master: Master::Parallel,
        stable: 0.0,
    },
    // the same as leap-frog for a spring
    CouplingMethod {
        name: "predicted_force",
        what: "apply predicted_force, read before the step",
        scheme: Scheme::Predicted,
        needs: Requirements::PredictedForce,
        master: Master::Parallel,
        stable: 2.0,
    },
    // `x' = x + u`, `u' = u - z x'`: stable up to `z = 4`
    // (E. Hairer, C. Lubich, G. Wanner, Acta Numerica 12 (2003) 399-450, section 1)
    LEAP_FROG,
    // The step also uses the jerk `j` [times `h^3`]. The FMU returns the slope of the force at the end of a step, which
    // includes its own rate. With `a = -z x`: `x' = x + u + a/2 + j/6`, `u' = u - z (x + u/2 + a/6 + j/24)` with the
    // mean force, and `j' = -z (u + a + j/2)`. The first eigenvalue to leave the unit circle does so at -1, where the
    // determinant of the step's matrix plus one is zero. The determinant is `(576 - 432 z + 48 z^2 - z^3) / 144`: the
    // limit is the square root of the smallest root of `z^3 - 48 z^2 + 432 z - 576`.
    CouplingMethod {
        name: "input derivatives",
        what: "set acceleration and jerk with the rate, apply mean_force",
        scheme: Scheme::Derivatives,
        needs: Requirements::MeanForce,
        master: Master::Serial,
        stable: 1.269_862_885_454_414,
    },
    MASS_KNOWN,
    JACOBI_MASS,
];

/// Number of steps after which an impact is given up. The longest impact of a report has sixteen million.
const LONGEST: u64 = 20_000_000;

/// Gaps \[m\] for which bodies that close at `speed` \[m/s\] touch at this number of evenly spaced places within a `step`
/// \[s\]. It is the second step, since a prediction needs a step before.
pub fn gaps(speed: f64, step: f64, places: u32) -> impl Iterator<Item = f64> {
    (0..places).map(move |place| (1.0 + (f64::from(place) + 0.5) / f64::from(places)) * speed * step)
}

impl Body {
    /// A body that flies at `speed` \[m/s\].
    pub fn flying(mass: f64, speed: f64) -> Body {
        Body { mass, load: 0.0, speed, force: 0.0, slope: 0.0, owed: 0.0 }
    }

    /// A body at rest, pressed into the surface to a contact force of this load \[N\].
    pub fn pressed(mass: f64, load: f64) -> Body {
        Body { mass, load, speed: 0.0, force: load, slope: 0.0, owed: 0.0 }
    }

    /// Acceleration towards the surface \[m/s^2\] for the contact `force` \[N\].
    fn acceleration(&self, force: f64) -> f64 {
        (self.load - force) / self.mass
    }

    /// Its speed once it has got all that the contact gave it in the last `step` \[s\], in m/s.
    pub fn settled_speed(&self, step: f64) -> f64 {
        self.speed - step * self.owed / self.mass
    }

    /// Applies `force` \[N\] over `step` \[s\].
    fn feel(&mut self, force: f64, step: f64) {
        self.speed += step * self.acceleration(force);
    }
}

impl CouplingMethod {
    /// Makes one step \[s\] of contact and mass.
    ///
    /// # Errors
    /// The first call that fails.
    pub fn advance<C: Coupled>(&self, contact: &mut C, body: &mut Body, step: f64) -> Result<(), C::Error> {
        match self.scheme {
            Scheme::Jacobi => jacobi(contact, body, step),
            Scheme::Predicted => predicted(contact, body, step),
            Scheme::LeapFrog => leap_frog(contact, body, step),
            Scheme::LeapFrogFollowed => leap_frog_followed(contact, body, step),
            Scheme::Derivatives => derivatives(contact, body, step),
            Scheme::MassKnown => mass_known(contact, body, step),
            Scheme::JacobiMass => jacobi_mass(contact, body, step),
        }
    }

    /// An impact of `mass` \[kg\] at `speed` \[m/s\] with steps of `step` \[s\], until the bodies separate.
    ///
    /// # Errors
    /// The first call that fails.
    pub fn impact<C: Coupled>(&self, contact: &mut C, mass: f64, speed: f64, step: f64) -> Result<Rebound, C::Error> {
        let mut body = Body::flying(mass, speed);
        let mut max_force = 0.0;
        for _ in 0..LONGEST {
            if body.force <= 0.0 && body.owed == 0.0 && body.speed <= 0.0 {
                return Ok(Rebound { speed: -body.speed, max_force });
            }
            self.advance(contact, &mut body, step)?;
            max_force = f64::max(max_force, body.force);
        }
        Ok(Rebound { speed: f64::NAN, max_force })
    }
}

/// All FMUs step at once: the bodies get the force at the beginning of the step. First order.
fn jacobi<C: Coupled>(contact: &mut C, body: &mut Body, step: f64) -> Result<(), C::Error> {
    contact.set_rate(body.speed)?;
    contact.step(step)?;
    body.feel(body.force, step);
    body.force = contact.force()?;
    Ok(())
}

/// All FMUs step at once, with the force that the contact predicts for the end of the step. Second order.
fn predicted<C: Coupled>(contact: &mut C, body: &mut Body, step: f64) -> Result<(), C::Error> {
    contact.set_rate(body.speed)?;
    let expected = contact.predicted_force()?;
    contact.step(step)?;
    body.feel(expected, step);
    body.force = contact.force()?;
    Ok(())
}

/// First the contact, then the bodies with its new force. Second order.
fn leap_frog<C: Coupled>(contact: &mut C, body: &mut Body, step: f64) -> Result<(), C::Error> {
    contact.set_rate(body.speed)?;
    contact.step(step)?;
    body.force = contact.force()?;
    body.feel(body.force, step);
    Ok(())
}

/// The same with a force that depends on the speed after it.
fn leap_frog_followed<C: Coupled>(contact: &mut C, body: &mut Body, step: f64) -> Result<(), C::Error> {
    contact.set_rate(body.speed)?;
    contact.step(step)?;
    body.force = contact.force()?;
    for _ in 0..ITERATIONS {
        contact.set_rate(body.speed + 0.5 * step * body.acceleration(body.force))?;
        body.force = contact.force()?;
    }
    body.feel(body.force, step);
    Ok(())
}

/// Acceleration and jerk as input derivatives; the mean force over the step as output. Third order.
fn derivatives<C: Coupled>(contact: &mut C, body: &mut Body, step: f64) -> Result<(), C::Error> {
    contact.set_rate(body.speed)?;
    contact.set_derivatives(&[body.acceleration(body.force), -body.slope / body.mass])?;
    contact.step(step)?;
    body.feel(contact.mean_force()?, step);
    (body.slope, body.force) = (contact.force_slope()?, contact.force()?);
    Ok(())
}

/// The FMU moves the mass itself within the step: exact to rounding.
fn mass_known<C: Coupled>(contact: &mut C, body: &mut Body, step: f64) -> Result<(), C::Error> {
    step_with_mass(contact, body, step)?;
    body.feel(contact.mean_force()?, step);
    body.force = contact.force()?;
    Ok(())
}

/// The same, with the mean force of each step applied over the next one.
fn jacobi_mass<C: Coupled>(contact: &mut C, body: &mut Body, step: f64) -> Result<(), C::Error> {
    step_with_mass(contact, body, step)?;
    body.feel(body.owed, step);
    (body.owed, body.force) = (contact.mean_force()?, contact.force()?);
    Ok(())
}

/// A step of an FMU that moves the mass; a load is an acceleration for it.
fn step_with_mass<C: Coupled>(contact: &mut C, body: &Body, step: f64) -> Result<(), C::Error> {
    contact.set_rate(body.speed)?;
    if body.load != 0.0 {
        contact.set_derivatives(&[body.load / body.mass])?;
    }
    contact.step(step)
}

/// Moves `ball` until it leaves a contact with friction, in at most `most` steps of `step` \[s\]; `None` if it doesn't. `contact`
/// makes a step at the two rates \[m/s\], and gives the normal and the tangential force \[N\].
pub fn bounce<E>(
    mut ball: Ball,
    step: f64,
    most: u32,
    mut contact: impl FnMut((f64, f64)) -> Result<(f64, f64), E>,
) -> Result<Option<Ball>, E> {
    for _ in 0..most {
        let (force, pull) = contact((ball.normal, ball.slip()))?;
        ball.normal -= step * force / ball.mass;
        ball.tangential -= step * pull / ball.mass;
        ball.spin -= step * pull * ball.radius / ball.inertia;
        if force <= 0.0 && ball.normal <= 0.0 {
            return Ok(Some(ball));
        }
    }
    Ok(None)
}
