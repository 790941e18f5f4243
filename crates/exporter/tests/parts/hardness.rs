use brinell_exporter::hardness::*;

/// Dent diameters [mm] and hardness from the table for HBW 10/3000 in ISO 6506-4.
#[test]
fn the_brinell_number_is_that_of_the_standard() {
    for (diameter, hardness) in [(2.40, 653.0), (3.00, 415.0), (4.00, 229.0), (5.00, 143.0), (6.00, 95.5)] {
        let number = brinell_number(29_420.0, 10e-3, 1e-3 * diameter).expect("a dent");
        assert!((number / hardness - 1.0).abs() < 4e-3, "{diameter} mm: {number}, not {hardness}");
    }
    assert_eq!(brinell_number(1.0, 1e-2, 1.01e-2), None);
    assert!((load_ratio(29_420.0, 10e-3) - 30.0).abs() < 0.01);
}
