//! A motion over time.

/// An instant of a motion, on a time scale from zero to one.
#[derive(Clone, Copy)]
pub struct Point {
    pub time: f64,
    /// Distance since the start.
    pub way: f64,
    /// Change of the speed since the start.
    pub gain: f64,
    /// The acceleration, and its decrease per distance.
    pub net: f64,
    pub stiffness: f64,
}

/// A motion that is known at any time from zero to one.
pub trait Moments {
    /// The point at `time`.
    fn at(&self, time: f64) -> Point;
}
