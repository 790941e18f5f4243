//! The names of the regimes of a law.

use brinell_contact::Regime;

/// The name of a regime.
pub fn words(regime: Regime) -> &'static str {
    match regime {
        Regime::Apart => "apart",
        Regime::Elastic => "elastic",
        Regime::ElastoplasticFirst => "elastoplastic (first region)",
        Regime::ElastoplasticSecond => "elastoplastic (second region)",
        Regime::FullyPlastic => "fully plastic",
        Regime::Unloaded => "below the largest indentation",
    }
}

/// What happens in a regime, for who doesn't know its name.
pub fn means(regime: Regime) -> &'static str {
    match regime {
        Regime::Apart => "The bodies do not touch.",
        Regime::Elastic => "Nothing yields: all energy comes back, as in Hertz's contact.",
        Regime::ElastoplasticFirst => {
            "Metal yields below the surface, held in by elastic metal around it. The dent is shallow, and the force is still close to \
             Hertz's."
        }
        Regime::ElastoplasticSecond => {
            "The yielding zone has reached the surface and grows. The mean pressure rises further, more slowly than Hertz's."
        }
        Regime::FullyPlastic => {
            "All metal below the contact flows. The mean pressure hardly rises any more: it is about three times the yield strength, as \
             in a hardness test."
        }
        Regime::Unloaded => "The contact unloads, or loads again, below its largest indentation.",
    }
}

/// The names of all regimes, in the order of their numbers.
pub fn names() -> [&'static str; 6] {
    use Regime::{Apart, Elastic, ElastoplasticFirst, ElastoplasticSecond, FullyPlastic, Unloaded};
    [Apart, Elastic, ElastoplasticFirst, ElastoplasticSecond, FullyPlastic, Unloaded].map(words)
}

/// A short name for a narrow column.
pub fn short(regime: Regime) -> &'static str {
    words(regime).split(" (").next().unwrap_or_default()
}
