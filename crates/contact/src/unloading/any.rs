//! Every unloading law in one type.

use super::*;

/// [`Unloading`] without its constants, because a trait object cannot have any.
pub trait DynUnloading {
    fn is_segmented(&self) -> bool;
    fn needs_work(&self) -> bool;
    fn holds_back(&self, pair: &Pair, peak: &Peak) -> bool;
    fn path(&self, pair: &Pair, peak: &Peak) -> Segment;
    fn tangent(&self, pair: &Pair, peak: &Peak, path: &Segment, indentation: f64) -> Segment;
    fn contact_radius(&self, pair: &Pair, peak: &Peak, path: &Segment, indentation: f64) -> f64;
    fn work(&self, pair: &Pair, peak: &Peak, path: &Segment, indentation: f64) -> f64;
    fn recovery(&self, bodies: &Construction<'_>, from: &Together) -> Recovery;
}

impl<U: Unloading> DynUnloading for U {
    fn is_segmented(&self) -> bool {
        Unloading::is_segmented(self)
    }

    fn needs_work(&self) -> bool {
        Unloading::needs_work(self)
    }

    fn holds_back(&self, pair: &Pair, peak: &Peak) -> bool {
        Unloading::holds_back(self, pair, peak)
    }

    fn path(&self, pair: &Pair, peak: &Peak) -> Segment {
        Unloading::path(self, pair, peak)
    }

    fn tangent(&self, pair: &Pair, peak: &Peak, path: &Segment, indentation: f64) -> Segment {
        Unloading::tangent(self, pair, peak, path, indentation)
    }

    fn contact_radius(&self, pair: &Pair, peak: &Peak, path: &Segment, indentation: f64) -> f64 {
        Unloading::contact_radius(self, pair, peak, path, indentation)
    }

    fn work(&self, pair: &Pair, peak: &Peak, path: &Segment, indentation: f64) -> f64 {
        Unloading::work(self, pair, peak, path, indentation)
    }

    fn recovery(&self, bodies: &Construction<'_>, from: &Together) -> Recovery {
        Unloading::recovery(self, bodies, from)
    }
}

impl Unloading for AnyUnloading {
    const MIXED: bool = true;
    const SQUARES: bool = true;

    fn is_segmented(&self) -> bool {
        self.law().is_segmented()
    }

    fn needs_work(&self) -> bool {
        self.law().needs_work()
    }

    fn holds_back(&self, pair: &Pair, peak: &Peak) -> bool {
        self.law().holds_back(pair, peak)
    }

    fn path(&self, pair: &Pair, peak: &Peak) -> Segment {
        self.law().path(pair, peak)
    }

    fn tangent(&self, pair: &Pair, peak: &Peak, path: &Segment, indentation: f64) -> Segment {
        self.law().tangent(pair, peak, path, indentation)
    }

    fn contact_radius(&self, pair: &Pair, peak: &Peak, path: &Segment, indentation: f64) -> f64 {
        self.law().contact_radius(pair, peak, path, indentation)
    }

    fn work(&self, pair: &Pair, peak: &Peak, path: &Segment, indentation: f64) -> f64 {
        self.law().work(pair, peak, path, indentation)
    }

    fn recovery(&self, bodies: &Construction<'_>, from: &Together) -> Recovery {
        self.law().recovery(bodies, from)
    }
}
