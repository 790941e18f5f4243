//! The meaning of value references, as functions.

use super::File;
use crate::interface::Entry;
use crate::table::{Causality, Type, Variable};

/// The number of kinds of variables of a contact, and those of type `kind` as arms of a match.
fn arms(entries: &[Entry], kind: Type) -> (usize, String) {
    let mut kinds: Vec<&Variable> = entries.iter().map(|entry| entry.variable).collect();
    kinds.retain(|variable| variable.causality != Causality::Parameter);
    kinds.dedup_by_key(|variable| variable.name.as_str());
    let arm = |(place, variable): (usize, &&Variable)| {
        (variable.r#type == kind).then(|| format!("    {place} => {}::{},\n", rust_name(kind), variable.rust))
    };
    (kinds.len(), kinds.iter().enumerate().filter_map(arm).collect())
}

/// The library's enum of the variables of this type.
fn rust_name(kind: Type) -> &'static str {
    match kind {
        Type::Real => "Real",
        Type::Enumeration => "Integer",
    }
}

pub fn add_reals(file: &mut File, entries: &[Entry]) {
    let (kinds, arms) = arms(entries, Type::Real);
    let settable = entries.iter().any(|entry| entry.variable.causality == Causality::Parameter);
    if settable {
        file.add_item(&format!(
            "/// Number of variables of a contact, without parameters.\nconst KINDS: u32 = {kinds};\n"
        ));
    }
    let parameter = format!(
        "    KINDS.. => {{
        let index = (kind - KINDS) as usize * CONTACTS + contact;
        return (index < {}).then_some((Real::Parameter(index), 0));
    }}
",
        super::value_count(&file.items)
    );
    let parameter = if settable { parameter.as_str() } else { "" };
    // if all kinds are Real and all other references are parameters, no reference remains
    let nothing = if settable && arms.lines().count() == kinds { "" } else { "    _ => return None,\n" };
    file.methods.push_str("\n    #[inline]");
    file.add_method(
        "real(value_reference: u32) -> Option<(Real, usize)>",
        &format!(
            "let (kind, contact) = kind_and_contact(value_reference, CONTACTS);\n\
             let variable = match kind {{\n{arms}{parameter}{nothing}}};\nSome((variable, contact))"
        ),
    );
}

pub fn add_integers(file: &mut File, entries: &[Entry]) {
    let (_, arms) = arms(entries, Type::Enumeration);
    let (argument, body) = if arms.is_empty() {
        ("_value_reference", "None".to_string())
    } else {
        (
            "value_reference",
            format!(
                "let (kind, contact) = kind_and_contact(value_reference, CONTACTS);\n\
                 let variable = match kind {{\n{arms}    _ => return None,\n}};\nSome((variable, contact))"
            ),
        )
    };
    file.add_method(&format!("integer({argument}: u32) -> Option<(Integer, usize)>"), &body);
}

#[cfg(test)]
mod tests {
    use crate::table::{Causality, Type, VARIABLES, Variable};
    use brinell::scene::{Integer, Parameter, Real};

    /// The names of the variables in the table that satisfy `wanted`, in its order.
    fn listed(wanted: impl Fn(&Variable) -> bool) -> Vec<&'static str> {
        VARIABLES.iter().filter(|variable| wanted(variable)).map(|variable| variable.rust.as_str()).collect()
    }

    /// Every variant of `Real` except `Parameter`. The match fails to compile if a variant is added.
    fn reals() -> Vec<String> {
        use Real::*;
        let all = [
            IndentationRate,
            Force,
            Indentation,
            MaxIndentation,
            ResidualIndentation,
            ContactRadius,
            MeanPressure,
            Stiffness,
            Work,
            ElasticEnergy,
            DissipatedEnergy,
            Impulse,
            MeanForce,
            PredictedForce,
            ClosingSpeed,
            ExternalAcceleration,
            RegimeNumber,
            TangentialRate,
            SecondTangentialRate,
            TangentialForce,
            SecondTangentialForce,
            MeanTangentialForce,
            SecondMeanTangentialForce,
            TangentialImpulse,
            SecondTangentialImpulse,
            PredictedTangentialForce,
            SecondPredictedTangentialForce,
            TangentialEnergy,
            FrictionWork,
            StickRadius,
            SlidingNumber,
            EffectiveMass,
        ];
        match all[0] {
            IndentationRate
            | Force
            | Indentation
            | MaxIndentation
            | ResidualIndentation
            | ContactRadius
            | MeanPressure
            | Stiffness
            | Work
            | ElasticEnergy
            | DissipatedEnergy
            | Impulse
            | MeanForce
            | PredictedForce
            | ClosingSpeed
            | ExternalAcceleration
            | RegimeNumber
            | TangentialRate
            | SecondTangentialRate
            | TangentialForce
            | SecondTangentialForce
            | MeanTangentialForce
            | SecondMeanTangentialForce
            | TangentialImpulse
            | SecondTangentialImpulse
            | PredictedTangentialForce
            | SecondPredictedTangentialForce
            | TangentialEnergy
            | FrictionWork
            | StickRadius
            | SlidingNumber
            | EffectiveMass
            | Parameter(_) => {}
        }
        all.iter().map(|variable| format!("{variable:?}")).collect()
    }

    #[test]
    fn the_library_and_the_table_have_the_same_variables_in_the_same_order() {
        let is_real = |variable: &Variable| variable.r#type == Type::Real && variable.causality != Causality::Parameter;
        assert_eq!(listed(is_real), reals());
        assert_eq!(
            listed(|variable| variable.r#type == Type::Enumeration),
            [Integer::Regime, Integer::Sliding].map(|variable| format!("{variable:?}"))
        );
    }

    #[test]
    fn the_library_and_the_table_have_the_same_parameters_in_the_same_order() {
        use Parameter::*;
        let all = [
            ImpactorRadius,
            ImpactorYoungsModulus,
            ImpactorPoissonsRatio,
            ImpactorYieldStrength,
            ImpactorHardeningModulus,
            TargetRadius,
            TargetYoungsModulus,
            TargetPoissonsRatio,
            TargetYieldStrength,
            TargetHardeningModulus,
            Restitution,
            EffectiveMass,
            InitialGap,
            ElasticRestitution,
            TargetPlateThickness,
            FrictionCoefficient,
        ];
        match all[0] {
            ImpactorRadius
            | ImpactorYoungsModulus
            | ImpactorPoissonsRatio
            | ImpactorYieldStrength
            | ImpactorHardeningModulus
            | TargetRadius
            | TargetYoungsModulus
            | TargetPoissonsRatio
            | TargetYieldStrength
            | TargetHardeningModulus
            | Restitution
            | EffectiveMass
            | InitialGap
            | ElasticRestitution
            | TargetPlateThickness
            | FrictionCoefficient => {}
        }
        let names: Vec<_> = all.iter().map(|parameter| format!("{parameter:?}")).collect();
        assert_eq!(listed(|variable| variable.causality == Causality::Parameter), names);
    }

    /// The C functions expect the input and the force at the first two positions.
    #[test]
    fn the_input_comes_first_and_the_force_second() {
        assert_eq!([VARIABLES[0].name.as_str(), VARIABLES[1].name.as_str()], ["indentation_rate", "force"]);
    }
}
