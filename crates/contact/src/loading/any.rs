//! Every loading law in one type.

use super::*;

impl Loading for AnyLoading {
    fn yield_point(&self, pair: &Pair) -> YieldPoint {
        self.law().yield_point(pair)
    }

    fn can_yield(&self) -> bool {
        self.law().can_yield()
    }

    fn segment(&self, pair: &Pair, indentation: f64) -> Segment {
        self.law().segment(pair, indentation)
    }

    fn is_segmented(&self) -> bool {
        self.law().is_segmented()
    }

    fn scale(&self, pair: &Pair) -> Segment {
        self.law().scale(pair)
    }

    fn elastic_exponent(&self) -> f64 {
        self.law().elastic_exponent()
    }

    fn has_squares() -> bool {
        true
    }

    fn next_corner(&self, pair: &Pair, indentation: f64) -> f64 {
        self.law().next_corner(pair, indentation)
    }

    fn work(&self, pair: &Pair, indentation: f64) -> f64 {
        self.law().work(pair, indentation)
    }

    fn work_between(&self, pair: &Pair, low: f64, high: f64) -> Option<f64> {
        self.law().work_between(pair, low, high)
    }

    fn contact_radius(&self, pair: &Pair, indentation: f64) -> f64 {
        self.law().contact_radius(pair, indentation)
    }

    fn regime(&self, pair: &Pair, indentation: f64) -> Regime {
        self.law().regime(pair, indentation)
    }

    fn branch(&self, pair: &Pair, point: &YieldPoint, indentation: f64) -> (Segment, Regime) {
        self.law().branch(pair, point, indentation)
    }

    fn radius_at(&self, pair: &Pair, point: &YieldPoint, indentation: f64, force: f64) -> f64 {
        self.law().radius_at(pair, point, indentation, force)
    }

    fn at_peak(
        &self,
        pair: &Pair,
        point: &YieldPoint,
        indentation: f64,
        force: f64,
        recovery: &RecoveryOf<'_>,
    ) -> (f64, Recovery) {
        self.law().at_peak(pair, point, indentation, force, recovery)
    }

    fn prepared(self, pair: &Pair, recovery: &RecoveryOf<'_>, before: Option<&AnyLoading>) -> AnyLoading {
        let before = before.and_then(AnyLoading::form);
        self.with_form(|form| form.prepared(pair, recovery, before))
    }

    fn prepared_for(self, pair: &Pair, energy: f64) -> AnyLoading {
        self.with_form(|form| form.prepared_for(pair, energy))
    }

    fn width(&self, pair: &Pair, indentation: f64) -> (f64, f64) {
        self.law().width(pair, indentation)
    }

    fn share(&self, pair: &Pair, indentation: f64) -> f64 {
        self.law().share(pair, indentation)
    }

    fn derived(&self, name: &str) -> Option<f64> {
        self.law().derived(name)
    }

    fn strengthened_by(self, factor: f64, others: f64) -> AnyLoading {
        self.with_form(|form| form.strengthened_by(factor, others))
    }
}
