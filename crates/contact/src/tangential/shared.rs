//! A contact with friction that shares bodies with others.

use super::normal::Straight;
use super::{Mean, Normal, Rough, RoughModel, Shear};
use crate::Model;
use crate::behaviour::Contact;
use crate::history::History;
use crate::loading::Loading;
use crate::losses::Damping;
use crate::numbers::{quotient, root};
use crate::path::Course;
use crate::regime::TooDeep;
use crate::segment::Segment;
use crate::shared::{Row, SharedContact};
use crate::unloading::Unloading;

impl<L: Loading + Copy, U: Unloading + Copy, K: Shear<D>, const D: usize, const MEAN: bool, N: Normal>
    SharedContact<RoughModel<L, U, N::Loss>> for Rough<K, D, MEAN, N>
{
    type Loading = L;
    type Unloading = U;

    const DIRECTIONS: usize = D;

    fn plastic_model(model: &RoughModel<L, U, N::Loss>) -> &Model<L, U> {
        &model.normal
    }

    fn plastic(&self) -> &History {
        self.normal()
    }

    fn plastic_mut(&mut self) -> &mut History {
        self.normal.plastic_mut()
    }

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

    /// With a fitted loss the tangential motion is damped as much as the normal one, within Coulomb's bound.
    fn go_straight(
        &mut self,
        model: &RoughModel<L, U, N::Loss>,
        rows: &mut [Row; 3],
        time: f64,
    ) -> Result<(), TooDeep> {
        let [normal, tangents @ ..] = rows;
        let mut slip = [0.0; D];
        slip.iter_mut().zip(&*tangents).for_each(|(slip, row)| *slip = row.way);
        let before = *self.normal();
        let is_new = before.force() == 0.0;
        let straight = self.normal.loss().map(|loss| Straight::new(&loss, normal.way, normal.force(), time, is_new));
        let increment = straight.as_ref().map_or(normal.way, |straight| straight.increment);
        let elastic = Contact::mean_force(&before, &model.normal, increment / time, time)?;
        let way = (increment, slip);
        let contact = self.normal.plastic_mut();
        let mut mean = self.springs.advance_along(contact, model, way, way, Mean::OfEnds)?;
        normal.found = elastic;
        if let Some(straight) = straight {
            normal.found = straight.force(elastic, [before.stiffness(), self.normal().stiffness()]);
            let (swiftest, heat) = straight.lost(normal.found, elastic);
            self.normal.lose(&model.normal, &model.loss, swiftest, heat)?;
            let damping = model.friction.stiffness_ratio * straight.tangential(elastic);
            mean.iter_mut().zip(slip).for_each(|(mean, slip)| *mean += damping * (slip / time));
        }
        // the mean of both ends may be beyond the bound
        let (limit, size) = (model.friction.coefficient * elastic, root(mean.iter().map(|part| part * part).sum()));
        let part = quotient(limit, size, size > limit, 1.0);
        mean.iter_mut().for_each(|mean| *mean *= part);
        for ((row, mean), slip) in tangents.iter_mut().zip(mean).zip(slip) {
            row.found = mean;
            self.work = self.work.plus(mean * slip);
        }
        Ok(())
    }

    fn end_step(&mut self, rows: &[Row; 3], step: f64) {
        let tangents = rows.iter().skip(1);
        let sums = self.impulse.iter_mut().zip(&mut self.mean_force).zip(&mut self.ends);
        for (row, ((impulse, mean), end)) in tangents.zip(sums) {
            *impulse = impulse.plus(row.impulse());
            *mean = row.impulse() / step;
            *end = Course::held(row.rate());
        }
    }
}
