//! A contact with friction that shares bodies with others.

use super::normal::Straight;
use super::vector::{add, length, times};
use super::{Mean, Normal, Rough, RoughModel};
use crate::Model;
use crate::behaviour::Contact;
use crate::history::History;
use crate::loading::Loading;
use crate::losses::Damping;
use crate::motion::PlasticContact;
use crate::numbers::{largest, quotient};
use crate::regime::TooDeep;
use crate::segment::Segment;
use crate::shared::{Row, SharedContact};
use crate::unloading::Unloading;

impl<L: Loading + Copy, U: Unloading + Copy, const D: usize, const M: usize, const MEAN: bool, N: Normal>
    PlasticContact<RoughModel<L, U, N::Loss>> for Rough<D, M, MEAN, N>
{
    type Loading = L;
    type Unloading = U;
    type PlasticModel<'a>
        = &'a Model<L, U>
    where
        RoughModel<L, U, N::Loss>: 'a;

    fn plastic_model<'a>(&self, model: &'a RoughModel<L, U, N::Loss>) -> &'a Model<L, U> {
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
    SharedContact<RoughModel<L, U, N::Loss>> for Rough<D, M, MEAN, N>
{
    const DIRECTIONS: usize = D;

    fn damping(&self) -> Option<Damping> {
        self.normal.loss()
    }

    fn lose(&mut self, model: &RoughModel<L, U, N::Loss>, swiftest: f64, heat: f64) -> Result<(), TooDeep> {
        self.normal.lose(&model.normal, &model.loss, swiftest, heat)
    }

    fn path(&self) -> Segment {
        self.springs.curve()
    }

    fn stiffness_ratio(model: &RoughModel<L, U, N::Loss>) -> f64 {
        model.friction.stiffness_ratio
    }

    fn set_forces(&self, model: &RoughModel<L, U, N::Loss>, rows: &mut [Row; 3]) {
        let [normal, ..] = *rows;
        let tangential = self.tangential_forces(model);
        for (row, force) in rows.iter_mut().zip([self.normal.force(normal.rate())].into_iter().chain(tangential)) {
            row.start = force;
        }
    }

    fn stiffnesses(&self, model: &RoughModel<L, U, N::Loss>) -> [[f64; 2]; 3] {
        let normal = self.normal();
        let (stick, edge) = self.springs.stiffnesses(normal.indentation());
        let mut rows = [[normal.stiffness(), 0.0], [0.0; 2], [0.0; 2]];
        for (row, edge) in rows.iter_mut().skip(1).zip(edge) {
            *row = [model.friction.stiffness_ratio * stick, model.friction.coefficient * edge];
        }
        rows
    }

    fn go_straight(
        &mut self,
        model: &RoughModel<L, U, N::Loss>,
        rows: &mut [Row; 3],
        time: f64,
    ) -> Result<(), TooDeep> {
        let [normal, tangents @ ..] = rows;
        let mut slip = [0.0; D];
        slip.iter_mut().zip(&*tangents).for_each(|(slip, row)| *slip = row.way);
        let (mean, elastic, mut tangential) = self.go_with_loss(model, (normal.way, slip), (normal.force(), time))?;
        normal.found = mean;
        tangential.iter_mut().zip(&*tangents).for_each(|(mean, row)| *mean -= row.beside);
        // on the curved way the normal force differs as much
        let most = largest(model.friction.coefficient * (elastic + (normal.force() - mean)), 0.0);
        for ((row, mean), slip) in tangents.iter_mut().zip(within(tangential, most)).zip(slip) {
            (row.found, row.most) = (mean, most);
            self.work = self.work.plus(mean * slip);
        }
        Ok(())
    }

    fn end_step(&mut self, rows: &[Row; 3], step: f64) {
        let tangents = rows.iter().skip(1);
        for (row, (impulse, mean)) in tangents.zip(self.impulse.iter_mut().zip(&mut self.mean_force)) {
            *impulse = impulse.plus(row.impulse());
            *mean = row.impulse() / step;
        }
    }
}

impl<const D: usize, const M: usize, const MEAN: bool, N: Normal> Rough<D, M, MEAN, N> {
    /// Moves the contact on a short straight way: the bodies close by the first length and slip by the others \[m\], in a
    /// `time` \[s\] and under a mean normal `force` \[N\] that matters to a target that gives way. Returns the mean normal force,
    /// its part without a loss, and the mean tangential forces \[N\].
    ///
    /// With a fitted loss the tangential motion is damped as much as the normal one, within Coulomb's bound.
    pub(super) fn go_with_loss<L: Loading + Copy, U: Unloading + Copy>(
        &mut self,
        model: &RoughModel<L, U, N::Loss>,
        (way, slip): (f64, [f64; D]),
        (force, time): (f64, f64),
    ) -> Result<(f64, f64, [f64; D]), TooDeep> {
        let before = *self.normal();
        let straight = self.normal.loss().map(|loss| Straight::new(&loss, way, force, time, before.force() == 0.0));
        let increment = straight.as_ref().map_or(way, |straight| straight.increment);
        let elastic = Contact::mean_force(&before, &model.normal, increment / time, time)?;
        let ways = (increment, slip);
        let contact = self.normal.plastic_mut();
        let mut mean = self.springs.advance_along(contact, model, ways, ways, Mean::OfEnds)?;
        let mut normal = elastic;
        if let Some(straight) = straight {
            normal = straight.force(elastic, [&before, self.normal()].map(|it| (it.indentation(), it.stiffness())));
            let (swiftest, heat) = straight.lost(normal, elastic);
            self.normal.lose(&model.normal, &model.loss, swiftest, heat)?;
            let damping = model.friction.stiffness_ratio * straight.tangential(elastic);
            mean = add(mean, damping, slip.map(|slip| slip / time));
        }
        // the mean of both ends may be beyond the bound
        Ok((normal, elastic, within(mean, model.friction.coefficient * elastic)))
    }
}

/// `vector`, shortened to this `limit` if it is longer.
fn within<const D: usize>(vector: [f64; D], limit: f64) -> [f64; D] {
    let (limit, size) = (largest(limit, 0.0), length(vector));
    times(quotient(limit, size, size > limit, 1.0), vector)
}
