//! The normal part of a contact with friction: an elastoplastic contact, or one with a loss.

use crate::Model;
use crate::behaviour::Contact;
use crate::history::History;
use crate::loading::Loading;
use crate::losses::{self, Damping, Form, Loss};
use crate::numerics::{largest, quotient};
use crate::regime::TooDeep;
use crate::unloading::Unloading;
use libm::fabs;

/// The normal part of a contact with friction.
pub trait Normal: Copy {
    /// The loss in the model of the contact; `()` without one.
    type Loss: Copy;

    /// Whether there is a loss: the force then differs from the elastic one, by which the springs of friction are made.
    const LOSES: bool;

    /// Whether the force depends on the rate at the same instant.
    const FOLLOWS_RATE: bool;

    /// The highest order of the time derivative of the force.
    const DERIVATIVES: i32;

    /// Number of words in a saved normal part.
    const WORDS: usize;

    /// A contact at `gap` \[m\] before any motion.
    ///
    /// # Errors
    /// As for [`History::start`].
    fn start<L: Loading + Copy, U: Unloading + Copy>(
        model: &Model<L, U>,
        loss: &Self::Loss,
        gap: f64,
    ) -> Result<Self, TooDeep>;

    /// The elastoplastic contact.
    fn plastic(&self) -> &History;

    /// The same to change.
    fn plastic_mut(&mut self) -> &mut History;

    /// Force at `rate` \[m/s\], in N.
    fn force(&self, rate: f64) -> f64;

    /// dF/d(rate) \[N.s/m\].
    fn damping(&self, rate: f64) -> f64;

    /// dF/d(indentation) at constant `rate` \[N/m\].
    fn stiffness(&self, rate: f64) -> f64;

    /// The loss of a contact that is pressed, with its largest speed.
    fn loss(&self) -> Option<Damping>;

    /// Sets the largest speed since the contact began \[m/s\], and adds `heat` \[J\].
    ///
    /// # Errors
    /// [`TooDeep`] for a heat that overflows.
    fn lose<L: Loading + Copy, U: Unloading + Copy>(
        &mut self,
        model: &Model<L, U>,
        loss: &Self::Loss,
        swiftest: f64,
        heat: f64,
    ) -> Result<(), TooDeep>;

    /// Energy lost without yield \[J\].
    fn heat(&self) -> f64;

    /// The contact at another `indentation` \[m\] on its smooth piece.
    fn moved_to<L: Loading + Copy, U: Unloading + Copy>(
        &self,
        model: &Model<L, U>,
        loss: &Self::Loss,
        indentation: f64,
    ) -> Self;

    /// Passes [`Normal::WORDS`] words to `store`.
    fn save(&self, store: &mut impl FnMut(u64));

    /// The normal part that [`Normal::save`] has stored; `None` if a number is not finite.
    fn load<L: Loading + Copy, U: Unloading + Copy>(
        words: &mut impl Iterator<Item = u64>,
        model: &Model<L, U>,
        loss: &Self::Loss,
    ) -> Option<Self>;
}

/// Any laws: the words of a history do not depend on them.
type AnyModel = Model<crate::loading::Hertz, crate::unloading::ContactRadius>;

impl Normal for History {
    type Loss = ();

    const LOSES: bool = false;
    const FOLLOWS_RATE: bool = false;
    const DERIVATIVES: i32 = 2;
    const WORDS: usize = <History as Contact<AnyModel>>::WORDS;

    fn start<L: Loading + Copy, U: Unloading + Copy>(
        model: &Model<L, U>,
        (): &(),
        gap: f64,
    ) -> Result<History, TooDeep> {
        History::start(model, gap)
    }

    #[inline(always)]
    fn plastic(&self) -> &History {
        self
    }

    #[inline(always)]
    fn plastic_mut(&mut self) -> &mut History {
        self
    }

    #[inline(always)]
    fn force(&self, _rate: f64) -> f64 {
        History::force(self)
    }

    fn damping(&self, _rate: f64) -> f64 {
        0.0
    }

    fn stiffness(&self, _rate: f64) -> f64 {
        History::stiffness(self)
    }

    #[inline(always)]
    fn loss(&self) -> Option<Damping> {
        None
    }

    fn lose<L: Loading + Copy, U: Unloading + Copy>(
        &mut self,
        _model: &Model<L, U>,
        (): &(),
        _swiftest: f64,
        _heat: f64,
    ) -> Result<(), TooDeep> {
        Ok(())
    }

    fn heat(&self) -> f64 {
        0.0
    }

    fn moved_to<L: Loading + Copy, U: Unloading + Copy>(
        &self,
        model: &Model<L, U>,
        (): &(),
        indentation: f64,
    ) -> History {
        Contact::moved_to(self, model, indentation)
    }

    fn save(&self, store: &mut impl FnMut(u64)) {
        Contact::<AnyModel>::save(self, store);
    }

    fn load<L: Loading + Copy, U: Unloading + Copy>(
        words: &mut impl Iterator<Item = u64>,
        model: &Model<L, U>,
        (): &(),
    ) -> Option<History> {
        Contact::load(words, model)
    }
}

/// The model of a contact with this loss.
fn with<L: Copy, U: Copy, X: Copy>(model: &Model<L, U>, loss: &X) -> losses::Model<L, U, X> {
    losses::Model { plastic: *model, loss: *loss }
}

impl<X: Loss> Normal for losses::History<X> {
    type Loss = X;

    const LOSES: bool = true;
    const FOLLOWS_RATE: bool = X::FOLLOWS_RATE;
    const DERIVATIVES: i32 = if X::FOLLOWS_RATE { 1 } else { 0 };
    const WORDS: usize = <History as Normal>::WORDS + 4;

    fn start<L: Loading + Copy, U: Unloading + Copy>(model: &Model<L, U>, loss: &X, gap: f64) -> Result<Self, TooDeep> {
        losses::History::start(&with(model, loss), gap)
    }

    fn plastic(&self) -> &History {
        losses::History::plastic(self)
    }

    fn plastic_mut(&mut self) -> &mut History {
        self.elastoplastic_mut()
    }

    fn force(&self, rate: f64) -> f64 {
        losses::History::force(self, rate)
    }

    fn damping(&self, rate: f64) -> f64 {
        losses::History::damping(self, rate)
    }

    fn stiffness(&self, rate: f64) -> f64 {
        losses::History::stiffness(self, rate)
    }

    fn loss(&self) -> Option<Damping> {
        Some(self.loss_at_present())
    }

    fn lose<L: Loading + Copy, U: Unloading + Copy>(
        &mut self,
        model: &Model<L, U>,
        loss: &X,
        swiftest: f64,
        heat: f64,
    ) -> Result<(), TooDeep> {
        self.add_heat(&with(model, loss), swiftest, heat)
    }

    fn heat(&self) -> f64 {
        losses::History::heat(self)
    }

    fn moved_to<L: Loading + Copy, U: Unloading + Copy>(
        &self,
        model: &Model<L, U>,
        loss: &X,
        indentation: f64,
    ) -> Self {
        Contact::moved_to(self, &with(model, loss), indentation)
    }

    fn save(&self, store: &mut impl FnMut(u64)) {
        Contact::<losses::Model<crate::loading::Hertz, crate::unloading::ContactRadius, X>>::save(self, store);
    }

    fn load<L: Loading + Copy, U: Unloading + Copy>(
        words: &mut impl Iterator<Item = u64>,
        model: &Model<L, U>,
        loss: &X,
    ) -> Option<Self> {
        Contact::load(words, &with(model, loss))
    }
}

/// What a loss does on a short straight way.
pub(super) struct Straight {
    /// The loss with the largest speed of this way too.
    damping: Damping,
    /// The way that the closing bodies move \[m\].
    way: f64,
    /// The way of the indentation, which a target that gives way shortens \[m\].
    pub increment: f64,
    /// \[s\]
    time: f64,
}

impl Straight {
    /// The way of a contact with this `loss` over which the bodies close by `way` \[m\] in this `time` \[s\], under a mean `force`
    /// \[N\]. `is_new` for a contact that is apart at its start.
    pub fn new(loss: &Damping, way: f64, force: f64, time: f64, is_new: bool) -> Straight {
        let increment = way - time * loss.retreat(force);
        let rate = fabs(increment / time);
        let swiftest = if is_new { rate } else { largest(rate, loss.swiftest) };
        Straight { damping: Damping { swiftest, ..*loss }, way, increment, time }
    }

    /// The mean force \[N\] for the mean `elastic` force \[N\], and the contact at both `ends`, if the rate changes evenly by `change`
    /// \[m/s\]. The mean of a product of two numbers that change evenly differs from that of their means by a twelfth of the product
    /// of their changes.
    pub fn force(&self, elastic: f64, ends: [&History; 2], change: f64) -> f64 {
        let rate = self.increment / self.time;
        match self.damping.form {
            Form::Viscous(growth) => {
                // the square of the stiffness of Hertz's contact is linear
                let [start, end] =
                    ends.map(|it| growth.times(self.damping.factor, it.indentation(), || it.stiffness()));
                largest(elastic + 0.5 * (start + end) * rate + (end - start) * change / 12.0, 0.0)
            }
            Form::Proportional => {
                let [start, end] = ends.map(History::force);
                let [slow, swift] = [-0.5, 0.5].map(|part| self.damping.gain(rate + part * change));
                largest(elastic * self.damping.gain(rate) + (end - start) * (swift - slow) / 12.0, 0.0)
            }
            Form::Mobility => elastic,
        }
    }

    /// The rate at which a target gives way per force \[m/(N.s)\].
    pub fn giving(&self) -> f64 {
        self.damping.retreat(1.0)
    }

    /// How the mean `force` \[N\] grows with the way of the bodies, if its `elastic` part \[N\] grows by `slope` \[N/m\].
    pub fn slope(&self, slope: f64, elastic: f64, ends: [&History; 2], force: f64) -> f64 {
        let Straight { damping, increment, time, .. } = *self;
        let rate = increment / time;
        match damping.form {
            _ if force <= 0.0 => 0.0,
            Form::Viscous(growth) => {
                let [start, end] = ends.map(|it| growth.times(damping.factor, it.indentation(), || it.stiffness()));
                slope + 0.5 * (start + end) / time
            }
            // the fastest motion determines its own scale
            Form::Proportional if fabs(rate) >= damping.swiftest => slope * damping.gain(rate),
            Form::Proportional => slope * damping.gain(rate) + self.tangential(elastic) / time,
            Form::Mobility => slope,
        }
    }

    /// The largest speed since the contact began \[m/s\], and the heat \[J\] for the mean force and its `elastic` part \[N\].
    pub fn lost(&self, force: f64, elastic: f64) -> (f64, f64) {
        (self.damping.swiftest, force * self.way - elastic * self.increment)
    }

    /// The damping of a tangential motion \[N.s/m\] for the mean `elastic` force \[N\], with as much loss as that of the normal motion:
    /// only a [fitted](losses::RestitutionFitted) loss has one.
    pub fn tangential(&self, elastic: f64) -> f64 {
        let Damping { form, factor, swiftest } = self.damping;
        let damping = factor * elastic;
        quotient(damping, swiftest, form == Form::Proportional && swiftest > 1e-100 * damping, 0.0)
    }
}
