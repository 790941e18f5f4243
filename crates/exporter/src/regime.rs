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

/// The names of all regimes, in the order of their numbers.
pub fn names() -> [&'static str; 6] {
    use Regime::{Apart, Elastic, ElastoplasticFirst, ElastoplasticSecond, FullyPlastic, Unloaded};
    [Apart, Elastic, ElastoplasticFirst, ElastoplasticSecond, FullyPlastic, Unloaded].map(words)
}

/// A short name for a narrow column.
pub fn short(regime: Regime) -> &'static str {
    words(regime).split(" (").next().unwrap_or_default()
}
