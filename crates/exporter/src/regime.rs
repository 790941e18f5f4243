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

/// A short name for a narrow column.
pub fn short(regime: Regime) -> &'static str {
    words(regime).split(" (").next().unwrap_or_default()
}
