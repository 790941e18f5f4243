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

    fn has_chain() -> bool {
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

    fn area(&self, pair: &Pair, radius: f64) -> f64 {
        self.law().area(pair, radius)
    }

    fn has_own_widths() -> bool {
        true
    }

    fn widths(&self, pair: &Pair, size: f64) -> [f64; 2] {
        self.law().widths(pair, size)
    }

    fn along_line(self, bodies: TwoBodies, is_impactor: bool) -> AnyLoading {
        match self {
            AnyLoading::Line(law) => AnyLoading::Line(law.along_line(bodies, is_impactor)),
            law => law,
        }
    }

    fn through(self, list: &[f64]) -> AnyLoading {
        match self {
            AnyLoading::Tabulated(law) => AnyLoading::Tabulated(law.through(list)),
            law => law,
        }
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
        if let AnyLoading::Line(law) = self {
            let before = before.and_then(|before| if let AnyLoading::Line(law) = before { Some(law) } else { None });
            return AnyLoading::Line(law.prepared(pair, recovery, before));
        }
        let before = before.and_then(AnyLoading::form);
        self.with_form(|form| form.prepared(pair, recovery, before))
    }

    fn prepared_for(self, pair: &Pair, energy: f64) -> AnyLoading {
        if let AnyLoading::Line(law) = self {
            return AnyLoading::Line(law.prepared_for(pair, energy));
        }
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
        if let AnyLoading::Line(law) = self {
            return AnyLoading::Line(law.strengthened_by(factor, others));
        }
        self.with_form(|form| form.strengthened_by(factor, others))
    }
}

impl AnyLoading {
    /// All published laws of contacts at a point, with their names: every scene of balls can have each of them.
    pub fn of_balls() -> impl Iterator<Item = (&'static str, AnyLoading)> {
        AnyLoading::ALL.into_iter().filter(|(_, law)| !law.is_line() && law.table().is_none())
    }

    /// The curve of one's own, if it is one.
    pub fn table(&self) -> Option<&Tabulated> {
        if let AnyLoading::Tabulated(law) = self { Some(law) } else { None }
    }

    /// Whether it is the law of a line contact.
    pub fn is_line(&self) -> bool {
        matches!(self, AnyLoading::Line(_))
    }
}
