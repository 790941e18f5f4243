use brinell_exporter::measured::*;
use brinell_exporter::table::{Class, MATERIALS, Material};

const STEEL: Metal = Metal { youngs_modulus: 210e9, poissons_ratio: 0.3, class: Class::Steel, exponent: None };
const ALUMINIUM: Metal = Metal { youngs_modulus: 69e9, poissons_ratio: 0.33, class: Class::Aluminium, exponent: None };

fn of(text: &str, metal: &Metal) -> MeasuredStrength {
    of_hardness(text, metal).unwrap_or_else(|why| panic!("{text}: {why}"))
}

/// \[MPa\], by an independent computation.
#[test]
fn strengths_are_those_of_an_independent_computation() {
    let vickers =
        [(200, 700.0), (300, 1051.0), (400, 1401.0), (500, 1840.0), (600, 2305.0), (697, 2780.0), (800, 3307.0)];
    for (number, stress) in vickers {
        let found = of(&format!("{number} HV10"), &STEEL);
        assert!((1e-6 * found.stress / stress - 1.0).abs() < 1e-3 && found.strain == 0.08, "{number} HV: {found:?}");
    }
    for (number, stress, ratio) in
        [(190, 709.8, 0.437), (200, 742.1, 0.4265), (285, 1025.7, 0.36), (400, 1445.2, 0.305), (570, 2173.2, 0.257)]
    {
        let found = of(&format!("{number} HBW 10/3000"), &STEEL);
        assert!((1e-6 * found.stress / stress - 1.0).abs() < 1e-3, "{number} HBW: {found:?}");
        assert!((found.strain / (0.2 * ratio) - 1.0).abs() < 3e-3, "{number} HBW: {found:?}");
    }
}

#[test]
fn a_reading_may_be_written_as_people_do() {
    let same = |texts: &[&str]| {
        let first = of(texts[0], &STEEL);
        for text in texts {
            let found = of(text, &STEEL);
            assert_eq!((found.stress, found.strain), (first.stress, first.strain), "{text}");
        }
    };
    same(&[
        "200 HBW 10/3000",
        "200HBW10/3000",
        "200 HBW 10/3000/15",
        "200 HB",
        "HB 200",
        "HBW 200",
        "200.0 hbw",
        "200 BHN",
    ]);
    same(&["640 HV10", "HV10 640", "640 HV 30", "640HV", "hv 640"]);
    same(&["58 HRC", "HRC 58", "58HRC", " 58 hrc "]);
    same(&["700 HLD", "700 LD", "LD 700"]);
}

/// A range is its middle with the standard deviation of what is equally likely within, its half width over the root of three; both ends
/// are taken on the scale.
#[test]
fn a_range_is_its_middle_with_a_larger_uncertainty() {
    for (range, middle, relative) in [
        ("180-220 HBW", "200 HBW", 0.1 / 3.0_f64.sqrt()),
        ("180 \u{2013} 220 HBW 10/3000", "200 HBW", 0.1 / 3.0_f64.sqrt()),
        ("HBW 180 to 220", "200 HBW", 0.1 / 3.0_f64.sqrt()),
        ("190...210 HV10", "200 HV10", 0.05 / 3.0_f64.sqrt()),
        ("200 \u{b1} 10 HV10", "200 HV10", 0.05),
        ("200+/-10 HV10", "200 HV10", 0.05),
    ] {
        let [found, alone] = [range, middle].map(|text| of(text, &STEEL));
        assert_eq!(
            (found.stress, found.strain, found.exponent),
            (alone.stress, alone.strain, alone.exponent),
            "{range}"
        );
        assert_eq!(found.given, range);
        let expected = alone.uncertainty.hypot(relative);
        assert!((found.uncertainty / expected - 1.0).abs() < 0.02, "{range}: {}, not {expected}", found.uncertainty);
        assert!(found.words().contains("% of spread; standard deviation"), "{}", found.words());
    }
    // a scale whose steps grow
    let rockwell = of("58-62 HRC", &STEEL);
    let [low, high] = ["58 HRC", "62 HRC"].map(|text| of(text, &STEEL).at(IMPACT_STRAIN));
    let spread = (high - low) / (high + low) / 3.0_f64.sqrt();
    assert!((rockwell.uncertainty / of("60 HRC", &STEEL).uncertainty.hypot(spread) - 1.0).abs() < 1e-9);
    for (text, why) in [
        ("220-180 HBW", "a range goes from the least number to the largest, not from 220 to 180"),
        ("600-700 HBW", "700 HBW is out of range: allowed is 3 to 650"),
        ("18-22 HRC", "18 HRC is out of range: allowed is 20 to 68"),
        ("HV10-640", "a hardness is a number with its scale"),
        ("180- HBW", "a hardness is a number with its scale"),
    ] {
        let said = of_hardness(text, &STEEL).map(|found| found.stress).unwrap_err();
        assert!(said.contains(why), "{text}: {said}");
    }
}

/// Rows of ASTM E140 (HRC with HBW, HRB with HB) and of ISO 18265 (HV with tensile strength): whichever column one reads, the flow
/// stress of an impact is the same within what is said of the uncertainty of both.
#[test]
fn all_columns_of_the_tables_for_steel_give_one_strength_within_its_uncertainty() {
    let agree = |one: &MeasuredStrength, other: &MeasuredStrength| {
        let error = one.at(0.03) / other.at(0.03) - 1.0;
        let allowed = one.uncertainty.hypot(other.uncertainty);
        assert!(error.abs() < allowed, "{} and {}: {error}", one.given, other.given);
    };
    let hrc = [(20, 226), (25, 253), (30, 286), (35, 327), (40, 371), (45, 421), (50, 481), (55, 560), (59, 634)];
    for (rockwell, brinell) in hrc {
        agree(&of(&format!("{rockwell} HRC"), &STEEL), &of(&format!("{brinell} HBW 10/3000"), &STEEL));
    }
    for (rockwell, brinell) in [(55, 100), (60, 107), (70, 125), (80, 150), (90, 185), (100, 240)] {
        agree(&of(&format!("{rockwell} HRB"), &STEEL), &of(&format!("{brinell} HBW 10/3000"), &STEEL));
    }
    let tension = [
        (80, 255.0),
        (100, 320.0),
        (150, 480.0),
        (200, 640.0),
        (250, 800.0),
        (300, 965.0),
        (350, 1125.0),
        (400, 1290.0),
    ];
    let hard = [(450, 1455.0), (500, 1630.0), (550, 1810.0), (600, 1995.0), (650, 2180.0)];
    for (vickers, strength) in tension.into_iter().chain(hard) {
        agree(&of(&format!("{vickers} HV"), &STEEL), &of_tensile_strength(1e6 * strength, &STEEL).unwrap());
    }
}

#[test]
fn every_material_with_a_strength_has_one_at_the_strain_of_an_impact() {
    let mut count = 0;
    for material in MATERIALS.iter() {
        let Material { youngs_modulus, poissons_ratio, class, .. } = *material;
        let class = class.unwrap_or(Class::of_modulus(youngs_modulus));
        let found = of_material(material, &Metal { youngs_modulus, poissons_ratio, class, exponent: None });
        let given = [material.yield_strength.is_some(), material.tension.is_some(), material.hardness.is_some()];
        let ways = given.into_iter().filter(|given| *given).count();
        // a brittle one says so, and two have a strength only by their condition
        let may_have_none = material.warning.is_some() || ["steel", "aluminium"].contains(&&*material.name);
        assert!(ways == 1 || (ways == 0 && may_have_none), "{}", material.name);
        assert_eq!(found.is_some(), material.yield_strength.is_none() && ways == 1, "{}", material.name);
        let strength = found.map(|found| found.at(0.02)).or(material.yield_strength).unwrap_or(1e9);
        assert!((5e6..3.5e9).contains(&strength), "{}: {strength}", material.name);
        count += 1;
    }
    assert!(count > 30, "{count}");
}

/// `n` solves `ln(Rp/Rm) = n (1 + ln((0.002 + Rp/E)/n))`, and `K = Rm (e/n)^n`: yield and tensile strength are those of the source.
#[test]
fn the_tension_of_a_material_goes_through_its_yield_and_its_tensile_strength() {
    let mut count = 0;
    for material in MATERIALS.iter() {
        let Some(brinell_exporter::table::Tension { coefficient, exponent: n }) = material.tension else { continue };
        let numbers = material.source.split(" MPa").filter_map(|part| part.rsplit(' ').next()?.parse::<f64>().ok());
        let [yielding, tensile] = numbers.collect::<Vec<_>>()[..] else { panic!("{}", material.source) };
        let ratio = n * (1.0 + ((0.002 + 1e6 * yielding / material.youngs_modulus) / n).ln());
        assert!((ratio.exp() * tensile / yielding - 1.0).abs() < 5e-3, "{}: yield", material.name);
        let found = 1e-6 * coefficient * (n / std::f64::consts::E).powf(n);
        assert!((found / tensile - 1.0).abs() < 5e-3, "{}: {found}, not {tensile}", material.name);
        count += 1;
    }
    assert_eq!(count, 18);
}

/// Materials with both: hardness and the power law through yield and tensile strength, its exponent and its stress at 8 % \[MPa\]. The
/// uncertainty that is printed is one standard deviation: the root mean square of the errors is within it, at the strain of the
/// test with the exponent known, and at that of an impact with the exponent of the class; and no error is beyond two (95 % are
/// expected within). Tension itself is uncertain by 3 %.
#[test]
fn the_uncertainty_of_a_hardness_is_the_standard_deviation_of_its_error_against_tension() {
    let rows = [
        ("228 HBW 10/3000", STEEL, 0.103, 782.0),
        ("280 HBW 10/3000", STEEL, 0.078, 1045.0),
        ("520 HBW 10/3000", STEEL, 0.093, 2029.0),
        ("126 HBW 10/3000", STEEL, 0.083, 477.0),
        ("163 HBW 10/3000", STEEL, 0.2, 580.0),
        ("179 HBW 10/3000", STEEL, 0.088, 682.0),
        ("420 HBW 10/3000", STEEL, 0.068, 1552.0),
        ("544 HV", STEEL, 0.117, 1957.0),
        ("577 HV", Metal { youngs_modulus: 190e9, ..STEEL }, 0.054, 2210.0),
        ("150 HBW 10/3000", Metal { youngs_modulus: 193e9, class: Class::Austenitic, ..STEEL }, 0.262, 558.0),
        ("145 HBW 10/3000", Metal { youngs_modulus: 193e9, class: Class::Austenitic, ..STEEL }, 0.274, 505.0),
        ("95 HBW 10/500", ALUMINIUM, 0.076, 336.0),
        ("150 HBW 10/500", ALUMINIUM, 0.095, 619.0),
        ("120 HBW 10/500", ALUMINIUM, 0.157, 508.0),
        ("70 HBW 10/500", ALUMINIUM, 0.14, 249.0),
    ];
    for (strain, known) in [(0.08, true), (0.03, false)] {
        let errors = rows.map(|(hardness, metal, exponent, tension)| {
            let found = of(hardness, &Metal { exponent: known.then_some(exponent), ..metal });
            let error = found.at(strain) / (1e6 * tension * libm::pow(strain / 0.08, exponent)) - 1.0;
            let deviations = error / found.uncertainty.hypot(0.03);
            assert!(deviations.abs() < 2.0, "{hardness} at {strain}: {error}, {}", found.uncertainty);
            deviations
        });
        let rms = (errors.iter().map(|error| error * error).sum::<f64>() / errors.len() as f64).sqrt();
        assert!(rms < 1.0, "{rms} standard deviations at {strain}: {errors:?}");
    }
}

/// AISI 1095, quenched in oil and tempered at 205 to 650 C (as handbooks of ASM print it): HBW, Rp0.2 and Rm \[MPa\]. It hardens as soft steel
/// does, whatever its hardness: with the exponent of its class it is beyond what is stated, as the guide says, and with its own it
/// is within.
#[test]
fn tempered_high_carbon_steel_needs_its_own_exponent() {
    let tempers = [
        (401.0, 827.0, 1289.0),
        (375.0, 813.0, 1262.0),
        (363.0, 772.0, 1213.0),
        (321.0, 676.0, 1089.0),
        (269.0, 552.0, 896.0),
    ];
    let range = |errors: &[f64]| {
        let [least, most] = [f64::min, f64::max].map(|of| errors.iter().copied().fold(errors[0], of));
        [least, most].map(|error| (100.0 * error).round())
    };
    let (mut errors, mut own) = ([[0.0; 5]; 3], [[0.0; 5]; 3]);
    for (row, (hardness, proof, tensile)) in tempers.into_iter().enumerate() {
        let excess = |n: f64| n * (1.0 + ((0.002 + proof / 206e3) / n).ln()) - f64::ln(proof / tensile);
        let (mut low, mut high) = (0.05, 0.5);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            *(if excess(middle) > 0.0 { &mut low } else { &mut high }) = middle;
        }
        assert!((0.17..0.2).contains(&low), "{low}");
        let tension = |strain: f64| 1e6 * tensile * (std::f64::consts::E * strain / low).powf(low);
        let text = format!("{hardness} HBW 10/3000");
        let [assumed, known] = [None, Some(low)].map(|exponent| of(&text, &Metal { exponent, ..STEEL }));
        for (at, strain) in [0.08, 0.03, 0.01].into_iter().enumerate() {
            errors[at][row] = assumed.at(strain) / tension(strain) - 1.0;
            own[at][row] = known.at(strain) / tension(strain) - 1.0;
        }
    }
    // in percent, as docs/guide/hardness.md says
    assert_eq!(errors.each_ref().map(|one| range(one)), [[5.0, 11.0], [12.0, 24.0], [20.0, 41.0]]);
    assert_eq!(own.each_ref().map(|one| range(one)), [[6.0, 15.0]; 3]);
    assert!(own.iter().flatten().all(|error| error.abs() < 2.0 * 0.08_f64.hypot(0.03)), "{own:?}");
}

#[test]
fn a_higher_number_is_a_higher_strength_on_every_scale() {
    let scales: [(&str, f64, f64, f64); 6] = [
        (" HRC", 20.0, 68.0, 0.1),
        (" HRB", 55.0, 100.0, 0.1),
        (" HV", 5.0, 1000.0, 1.0),
        (" HBW 10/3000", 96.0, 650.0, 1.0),
        (" HBW 10/500", 17.0, 200.0, 1.0),
        (" HLD", 170.0, 900.0, 10.0),
    ];
    for (scale, first, last, step) in scales {
        let count = ((last - first) / step) as u32;
        let stresses =
            (0..=count).map(|index| of(&format!("{:.1}{scale}", first + step * f64::from(index)), &STEEL).stress);
        assert!(stresses.collect::<Vec<_>>().is_sorted_by(|one, other| one < other), "{scale}");
    }
}
