use brinell_contact::material::hardening::PowerLaw;
use brinell_exporter::tension::*;

const STEEL: f64 = 206e9;

/// A power law with its elastic part, as a machine writes it: engineering strain and stress \[MPa\] up to the largest load and beyond.
fn machine(law: PowerLaw) -> Vec<(f64, f64)> {
    let stress_at = |strain: f64| {
        // the whole strain is given
        let (mut low, mut high) = (0.0, strain);
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            let over = law.coefficient * libm::pow(middle, law.exponent) / STEEL + middle > strain;
            *(if over { &mut high } else { &mut low }) = middle;
        }
        law.coefficient * libm::pow(low, law.exponent)
    };
    // none at the end of a part of a decade
    let strains = (1..=4000).map(|step| 0.97e-4 * f64::from(step));
    strains.map(|strain| (libm::expm1(strain), 1e-6 * stress_at(strain) * libm::exp(-strain))).collect()
}

fn curve(bytes: &[u8]) -> Curve {
    read(bytes, &Specimen::default()).unwrap_or_else(|why| panic!("{why}"))
}

fn csv(rows: &[(f64, f64)], header: &str, row: impl Fn(f64, f64) -> String) -> Vec<u8> {
    let rows = rows.iter().map(|(strain, stress)| row(*strain, *stress) + "\r\n").collect::<String>();
    format!("{header}\r\n{rows}").into_bytes()
}

#[test]
fn the_power_law_of_a_test_is_found_again_from_what_a_machine_writes() {
    for (coefficient, exponent) in [(1000e6, 0.2), (1500e6, 0.1), (600e6, 0.3), (900e6, 0.05)] {
        let law = PowerLaw { coefficient, exponent };
        let file = csv(&machine(law), "Dehnung [%];Spannung [MPa]", |strain, stress| {
            format!("{:.5};{stress:.3}", 100.0 * strain).replace('.', ",")
        });
        let found = through_curve(&curve(&file), STEEL, false).unwrap();
        for strain in [0.01, 0.03] {
            let stress = |law: PowerLaw| law.coefficient * libm::pow(strain, law.exponent);
            let error = stress(found.law) / stress(law) - 1.0;
            assert!(error.abs() < 2e-3, "{law:?} at {strain}: {error}");
        }
        assert!((found.law.exponent - exponent).abs() < 3e-3 && found.uncertainty < 0.032, "{found:?}");
        assert!(found.range.1 <= 0.1 && found.range.1 <= 1.05 * exponent, "until the largest load: {:?}", found.range);
    }
}

/// Dialects of tables are in `measurement.rs`; here are the names and units of tensile tests.
#[test]
fn engineering_and_true_strain_in_every_unit_make_one_curve() {
    let rows = machine(PowerLaw { coefficient: 1000e6, exponent: 0.2 });
    let expected = curve(&csv(&rows, "strain,stress [MPa]", |strain, stress| format!("{strain:.9},{stress:.6}")));
    let german = |strain: f64, stress: f64| format!("{:.7};{stress:.6}", 100.0 * strain).replace('.', ",");
    let true_of =
        |strain: f64, stress: f64| format!("{:.12}\t{:.9}", libm::log1p(strain), 1e-3 * stress * (1.0 + strain));
    let mut latin = csv(&rows, "Dehnung [%];Spannung [N/mm#]", german);
    let place = latin.iter().position(|byte| *byte == b'#').unwrap();
    latin[place] = 0xb2;
    for file in [
        csv(&rows, "Engineering strain (%);Engineering stress (N/mm2)", german),
        csv(&rows, "Pr\u{fc}fung 7\r\n\r\nDehnung;Spannung\r\n%;MPa", german),
        csv(&rows, "strain_%;stress_MPa", german),
        csv(&rows, "true strain\ttrue stress in GPa", true_of),
        csv(&rows, "nominal strain;nominal stress / MPa", |strain, stress| format!("{strain:.9};{stress:.6}")),
        latin,
    ] {
        let found = curve(&file);
        let heading = String::from_utf8_lossy(&file[..40]).into_owned();
        assert_eq!(found.points.len(), expected.points.len(), "{heading}");
        for (one, other) in found.points.iter().zip(&expected.points) {
            let is_near = (one.0 / other.0 - 1.0).abs() < 1e-4 && (one.1 / other.1 - 1.0).abs() < 1e-6;
            assert!(is_near, "{heading}: {one:?}");
        }
    }
}

#[test]
fn a_table_that_is_no_tensile_test_is_told_why() {
    let table = |text: &str| {
        let curve = read(text.as_bytes(), &Specimen::default());
        curve.and_then(|curve| through_curve(&curve, STEEL, false).map(|_| ())).unwrap_err()
    };
    for (text, why) in [
        ("", "the file is empty; expected a heading such as"),
        ("time;force [N]\n1;2\n", "no column is called strain, nor travel; such as `strain [%];stress [MPa]`"),
        (
            "Elongaton [%];stress [MPa]\n1;2\n",
            "no column is called strain, nor travel; unknown: `Elongaton [%]` (elongation?)",
        ),
        (
            "travel [mm];force [N]\n1;2\n",
            "`travel [mm]` becomes a strain by the gauge length of the specimen: give gauge_length",
        ),
        ("travel;force [N]\n1;2\n", "the column `travel` has no unit: write `travel [m]`"),
        ("strain;stress\n1;2\n", "the column `stress` has no unit: write `stress [MPa]`"),
        ("strain;stress [mm]\n1;2\n", "line 1, column 2: `mm` is no unit of stress; expected one of `Pa`"),
        ("strain [%];stress [MPa]\n1;200\n2;soft\n", "line 3, column 2: stress [MPa] = `soft` is no number"),
        ("strain;stress [MPa]\n1;200\n5;300\n9;400\n", "the strain reaches 9: if that is in %, write `strain [%]`"),
        ("strain [%];stress [MPa]\n1;200\n", "the curve has 1 points with plastic strains from"),
        ("plastic strain;engineering stress [MPa]\n1;200\n", "a plastic strain goes with true stress"),
        ("strain a;strain b;stress [MPa]\n1;2;200\n", "which column is the strain: `strain a` or `strain b`?"),
        (
            "plastic strain;true stress [MPa]\n0.01;200\n0.02;400\n0.04;800\n",
            "the curve hardens with an exponent of 1 from 0.01 to 0.04 plastic strain: allowed is 0 to 0.6",
        ),
    ] {
        let said = table(text);
        assert!(said.contains(why), "{text:?}: {said}");
    }
}

/// A machine that gives way with the specimen's engineering stress, from a stiff one to a tenth of Young's modulus; 1 % of noise in the
/// strain. From 10 % off, the slope is told; taken off, the power law is that of the specimen, whatever the machine.
#[test]
fn the_compliance_of_a_machine_is_told_from_a_tenth_on_and_can_be_taken_off() {
    let law = PowerLaw { coefficient: 1000e6, exponent: 0.12 };
    let rows = machine(law);
    let mut random = fastrand::Rng::with_seed(7);
    for (part, noise) in
        [1.0, 0.97, 0.85, 0.6, 0.4, 0.31, 0.2, 0.1].into_iter().flat_map(|part| [(part, 0.0), (part, 0.01)])
    {
        let mut row = |strain: f64, stress: f64| {
            let off = 1.0 + noise * (2.0 * random.f64() - 1.0);
            format!("{};{stress}", off * (strain + 1e6 * stress / STEEL * (1.0 / part - 1.0)))
        };
        let rows = rows.iter().map(|(strain, stress)| row(*strain, *stress) + "\n").collect::<String>();
        let curve = curve(format!("strain;stress [MPa]\n{rows}").as_bytes());
        let said = curve.slope_off(STEEL);
        assert_eq!(said.is_some(), part < 0.9, "{part}: {said:?}");
        if let Some((found, said)) = said {
            assert!((found / part - 1.0).abs() < 0.03, "{part}: {found}");
            assert!(
                said.contains("of youngs_modulus = 206 GPa; a strain by the crosshead contains the machine"),
                "{said}"
            );
        }
        assert_eq!(through_curve(&curve, STEEL, false).is_err(), part < 0.3, "{part}");
        let found = through_curve(&curve, STEEL, true).unwrap();
        let error = found.law.coefficient * libm::pow(0.03, found.law.exponent)
            / (law.coefficient * libm::pow(0.03, law.exponent))
            - 1.0;
        assert!(error.abs() < 0.01 && (found.law.exponent - law.exponent).abs() < 0.01, "{part}: {found:?}");
        assert!(found.way.contains("the machine's compliance taken off, slope "), "{}", found.way);
    }
    let percent = csv(&rows, "strain [%];stress [MPa]", |strain, stress| format!("{strain};{stress}"));
    let said = through_curve(&curve(&percent), STEEL, false).unwrap_err();
    assert!(said.contains("is the strain in %?"), "{said}");
}

/// The section and the gauge length stand in the file, in one of the ways of machines, or in the scene.
#[test]
fn a_force_over_travel_is_a_stress_over_strain_by_the_specimen() {
    let rows = machine(PowerLaw { coefficient: 1000e6, exponent: 0.2 });
    let expected = curve(&csv(&rows, "strain,stress [MPa]", |strain, stress| format!("{strain},{stress}")));
    let raw = |strain: f64, stress: f64| format!("1,{},{}", 30.0 * strain, 7.5 * stress);
    let names = "time [s],Standard travel [mm],Standard force [N]";
    let in_file = [
        "\"Specimen thickness\",1.5,\"mm\"\n\"Specimen width\",5,\"mm\"\n\"Gage length, standard travel\",30,\"mm\"",
        "Cross-section [mm2]: 7.5\nGauge length: 30 mm",
        "# area = 0.075 cm2\n# initial length = 3 cm",
        "S0,7.5,mm2\nDiameter,99,mm\nL0,30,mm",
    ];
    let of_scene = Specimen { section: Some(7.5e-6), gauge_length: Some(0.03) };
    let found = in_file.iter().map(|lines| (curve(&csv(&rows, &format!("{lines}\n{names}"), raw)), *lines));
    let found = found.chain([(read(&csv(&rows, names, raw), &of_scene).unwrap(), "scene")]);
    for (found, way) in found {
        assert_eq!(found.points.len(), expected.points.len(), "{way}");
        for (one, other) in found.points.iter().zip(&expected.points) {
            let errors = [one.0 / other.0 - 1.0, one.1 / other.1 - 1.0];
            assert!(errors.iter().all(|error| error.abs() < 1e-9), "{way}: {errors:?}");
        }
    }
    let said = read(&csv(&rows, "strain,stress [MPa]", |strain, stress| format!("{strain},{stress}")), &of_scene);
    assert!(said.unwrap_err().contains("gauge_length has no effect: the file has the column `strain`"));
}

/// Rp0.2 is the stress at the whole strain of 0.2 % and `Rp/E`, and the load has its maximum Rm at the strain n.
#[test]
fn the_power_law_of_two_numbers_has_both() {
    for (proof, strength) in [(240e6, 480e6), (241e6, 586e6), (950e6, 1000e6), (1675e6, 1875e6), (30e6, 90e6)] {
        let PowerLaw { coefficient, exponent } = through_two(proof, strength, STEEL).unwrap().law;
        let stress = |strain: f64| coefficient * libm::pow(strain, exponent);
        assert!((stress(0.002 + proof / STEEL) / proof - 1.0).abs() < 1e-9);
        let load = |strain: f64| stress(strain) * libm::exp(-strain);
        assert!((load(exponent) / strength - 1.0).abs() < 1e-9);
        assert!(load(0.99 * exponent) < strength && load(1.01 * exponent) < strength);
    }
    for (proof, strength) in [(500e6, 400e6), (10e6, 400e6)] {
        let said = through_two(proof, strength, STEEL).unwrap_err();
        assert!(said.contains("of tensile_strength = 400 MPa: allowed is"), "{said}");
    }
}
