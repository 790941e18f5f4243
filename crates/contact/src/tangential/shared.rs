//! A contact with friction that shares bodies with others.

use super::contact::share_of;
use super::normal::Straight;
use super::vector::{add, direction, length, times, within};
use super::{Friction, Frictional, FrictionalModel, Mean, Normal};
use crate::behaviour::Contact;
use crate::history::History;
use crate::loading::Loading;
use crate::losses::Damping;
use crate::motion::PlasticContact;
use crate::numerics::{largest, quotient};
use crate::regime::TooDeep;
use crate::segment::Segment;
use crate::shared::{Row, SharedContact};
use crate::unloading::Unloading;
use crate::{Model, Surface};
use libm::fabs;

impl<L: Loading + Copy, U: Unloading + Copy, const D: usize, const M: usize, const MEAN: bool, N: Normal>
    PlasticContact<FrictionalModel<L, U, N::Loss>> for Frictional<D, M, MEAN, N>
{
    type Loading = L;
    type Unloading = U;
    type PlasticModel<'a>
        = &'a Model<L, U>
    where
        FrictionalModel<L, U, N::Loss>: 'a;

    fn plastic_model<'a>(&self, model: &'a FrictionalModel<L, U, N::Loss>) -> &'a Model<L, U> {
        &model.normal
    }

    fn plastic(&self) -> &History {
        self.normal()
    }

    fn plastic_mut(&mut self) -> &mut History {
        self.normal.plastic_mut()
    }
}

impl<L: Loading + Copy, U: Unloading + Copy, const D: usize, const M: usize, const MEAN: bool, N: Normal>
    SharedContact<FrictionalModel<L, U, N::Loss>> for Frictional<D, M, MEAN, N>
{
    const DIRECTIONS: usize = D;

    fn damping(&self) -> Option<Damping> {
        self.normal.loss()
    }

    fn lose(&mut self, model: &FrictionalModel<L, U, N::Loss>, swiftest: f64, heat: f64) -> Result<(), TooDeep> {
        self.normal.lose(&model.normal, &model.loss, swiftest, heat)
    }

    fn path(&self) -> Segment {
        self.springs.curve()
    }

    fn stiffness_ratio(model: &FrictionalModel<L, U, N::Loss>) -> f64 {
        model.friction.stiffness_ratio
    }

    fn slip_scale(&self, model: &FrictionalModel<L, U, N::Loss>) -> Option<f64> {
        self.springs.slips_from_edge().then(|| self.friction(model).scale())
    }

    fn set_forces(&self, model: &FrictionalModel<L, U, N::Loss>, rows: &mut [Row; 3]) {
        let [normal, ..] = *rows;
        let tangential = self.springs.forces(&self.friction(model), self.normal().indentation());
        for (row, force) in rows.iter_mut().zip([self.normal.force(normal.rate())].into_iter().chain(tangential)) {
            row.start = force;
        }
    }

    fn stiffnesses(&self, model: &FrictionalModel<L, U, N::Loss>) -> [[f64; 2]; 3] {
        let normal = self.normal();
        let (stick, edge) = self.springs.stiffnesses(normal.indentation());
        let mut rows = [[normal.stiffness(), 0.0], [0.0; 2], [0.0; 2]];
        let Friction { coefficient, stiffness_ratio } = self.friction(model);
        for (row, edge) in rows.iter_mut().skip(1).zip(edge) {
            *row = [stiffness_ratio * stick, coefficient * edge];
        }
        rows
    }

    fn go_straight(
        &mut self,
        model: &FrictionalModel<L, U, N::Loss>,
        rows: &mut [Row; 3],
        time: f64,
    ) -> Result<(), TooDeep> {
        let [normal, tangents @ ..] = rows;
        let (before, surface) = (self.normal().indentation(), self.springs.curve().lower);
        let is_apart = self.normal().force() == 0.0 && before < surface && before + normal.way < surface;
        // a fresh surface may forget its dent
        if is_apart && (before < 0.0 || model.normal.surface == Surface::Dented) {
            normal.share = self.share;
            return self.normal.plastic_mut().advance(&model.normal, normal.way).map(drop);
        }
        let (mut slip, mut changes) = ([0.0; D], [0.0; D]);
        for ((slip, change), row) in slip.iter_mut().zip(&mut changes).zip(&*tangents) {
            (*slip, *change) = (row.way, time * row.net);
        }
        let share = if normal.knows_share { Some(normal.share) } else { None };
        let Gone { normal: mean, mut tangential, slopes: [slope, along], gives } =
            self.go_with_loss(model, (normal.way, slip), (time * normal.net, changes), (normal.force(), time), share)?;
        normal.share = self.share;
        (normal.found, normal.slope, normal.gives) = (mean, slope, gives);
        tangential.iter_mut().zip(&*tangents).for_each(|(mean, row)| *mean -= row.beside);
        // with the normal force on the curved way
        let most = largest(model.friction.coefficient * normal.force(), 0.0);
        let is_bound = length(tangential) >= (1.0 - BOUND) * most;
        let edge = direction(tangential);
        for (((row, mean), slip), edge) in tangents.iter_mut().zip(within(tangential, most)).zip(slip).zip(edge) {
            (row.found, row.most) = (mean, most);
            (row.slope, row.slope_beside) =
                if is_bound { (0.0, model.friction.coefficient * slope * edge) } else { (along, 0.0) };
            self.work = self.work.plus(mean * slip);
        }
        Ok(())
    }

    fn take_up(&mut self, work: f64) {
        self.work = self.work.plus(work);
    }

    fn end_step(&mut self, model: &FrictionalModel<L, U, N::Loss>, rows: &[Row; 3], step: f64) {
        if MEAN {
            self.lost = self.friction_work(model);
        }
        let tangents = rows.iter().skip(1);
        for (row, (impulse, mean)) in tangents.zip(self.impulse.iter_mut().zip(&mut self.mean_force)) {
            *impulse = impulse.plus(row.impulse());
            *mean = row.impulse() / step;
        }
    }
}

/// A sum of tangential forces that is at Coulomb's bound, as a part of it.
const BOUND: f64 = 1e-9;

/// An increment that is no rounding, as a part of the indentation.
const FAR: f64 = 1e-6;

/// What a short straight way has found.
pub(super) struct Gone<const D: usize> {
    /// Mean normal force \[N\].
    normal: f64,
    /// Mean tangential forces \[N\].
    pub tangential: [f64; D],
    /// How both grow with their ways \[N/m\].
    slopes: [f64; 2],
    /// How the normal force of a target that gives way falls with the one that it gives way to.
    gives: f64,
}

impl<const D: usize, const M: usize, const MEAN: bool, N: Normal> Frictional<D, M, MEAN, N> {
    /// Moves the contact on a short straight way: the bodies close by the first length and slip by the others \[m\], in a
    /// `time` \[s\] and under a mean normal `force` \[N\] that matters to a target that gives way. Returns the mean normal
    /// force and the mean tangential forces \[N\]. The rates change evenly by `changes` \[m/s\].
    ///
    /// The limits of the springs add up to the normal force with its loss. With a fitted loss the tangential motion is damped as
    /// much as the normal one, within Coulomb's bound.
    pub(super) fn go_with_loss<L: Loading + Copy, U: Unloading + Copy>(
        &mut self,
        model: &FrictionalModel<L, U, N::Loss>,
        (way, slip): (f64, [f64; D]),
        (change, changes): (f64, [f64; D]),
        (force, time): (f64, f64),
        share: Option<f64>,
    ) -> Result<Gone<D>, TooDeep> {
        let before = *self.normal();
        let straight = self.normal.loss().map(|loss| Straight::new(&loss, way, force, time, before.force() == 0.0));
        let increment = straight.as_ref().map_or(way, |straight| straight.increment);
        let elastic = Contact::mean_force(&before, &model.normal, increment / time, time)?;
        let from = before.indentation();
        self.normal.plastic_mut().advance(&model.normal, increment)?;
        let (mut normal, mut damping, mut rise) = (elastic, 0.0, 0.0);
        let after = *self.normal();
        let stiffness = 0.5 * (before.stiffness() + after.stiffness());
        let is_far = fabs(increment) > FAR * fabs(after.indentation());
        let mut slope = quotient(after.force() - elastic, increment, is_far, 0.5 * stiffness);
        let mut gives = 0.0;
        if let Some(straight) = &straight {
            normal = straight.force(elastic, [&before, self.normal()], change);
            gives = time * slope * straight.giving();
            slope = straight.slope(slope, elastic, [&before, self.normal()], normal);
            let (swiftest, heat) = straight.lost(normal, elastic);
            self.normal.lose(&model.normal, &model.loss, swiftest, heat)?;
            [damping, rise] = [elastic, (self.normal().force() - before.force()) / 12.0]
                .map(|force| model.friction.stiffness_ratio * straight.tangential(force));
            self.share_limits(from, share.unwrap_or_else(|| share_of(normal, elastic)));
        }
        let stick = self.springs.stiffnesses(from).0;
        let springs_model = FrictionalModel { friction: self.friction(model), ..*model };
        let to = self.normal().indentation();
        // at half of the time, both ways are behind by an eighth of what the rates change; half of the indentation is done later
        let steepness = slip.map(|slip| quotient(slip, increment, increment > 1e-100 * fabs(slip), 0.0));
        let bend = times(-0.125 * time, add(changes, -change, steepness));
        let mut mean = self.springs.follow(&springs_model, (from, to), (slip, bend), (increment, slip), Mean::OfEnds);
        if straight.is_some() {
            mean = add(add(mean, damping, slip.map(|slip| slip / time)), rise, changes);
        }
        let along = 0.5 * model.friction.stiffness_ratio * stick + damping / time;
        // the mean of both ends may be beyond the bound
        let tangential = within(mean, model.friction.coefficient * normal);
        Ok(Gone { normal, tangential, slopes: [slope, along], gives })
    }
}
