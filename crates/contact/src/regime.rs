//! The part of the law that a contact is on, and the range of indentations.

/// The indentation up to which the laws are evaluated \[m\]. It is far beyond anything physical, and small enough that no force
/// or energy overflows.
pub const LARGEST_INDENTATION: f64 = 1e100;

/// The part of the law that a contact is on. The numbers are the values of the variable `regime`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Regime {
    /// No contact.
    Apart = 0,
    /// Hertzian: nothing has yielded.
    Elastic = 1,
    /// Elastoplastic loading, first region.
    ElastoplasticFirst = 2,
    /// Elastoplastic loading, second region.
    ElastoplasticSecond = 3,
    /// Fully plastic loading.
    FullyPlastic = 4,
    /// Below the largest indentation of a contact that has yielded: unloading or reloading.
    Unloaded = 5,
}

impl Regime {
    /// All regimes, in the order of their numbers.
    pub const ALL: [Regime; 6] = [
        Regime::Apart,
        Regime::Elastic,
        Regime::ElastoplasticFirst,
        Regime::ElastoplasticSecond,
        Regime::FullyPlastic,
        Regime::Unloaded,
    ];
}

/// Error: the indentation left the range in which the law can be evaluated, or is NaN.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TooDeep {
    /// The rejected indentation \[m\].
    pub indentation: f64,
}
