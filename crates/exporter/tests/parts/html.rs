use brinell_exporter::html::*;

#[test]
fn numbers_and_units_have_the_signs_of_print_and_words_stay() {
    for (text, printed) in [
        ("here an indentation of 225 um, and", "here an indentation of 225 \u{b5}m, and"),
        ("a contact of 2e-15 s (3 us).", "a contact of 2\u{b7}10<sup>\u{2212}15</sup> s (3 \u{b5}s)."),
        ("a radius of 1e0 m", "a radius of 1 m"),
        ("-1e6 N & 7850 kg/m^3", "-10<sup>6</sup> N &amp; 7850 kg/m\u{b3}"),
        ("the 2 use a ball of us, 1 use", "the 2 use a ball of us, 1 use"),
        ("a factor of 0.3 effective radii", "a factor of 0.3 effective radii"),
    ] {
        assert_eq!(prose(text), printed);
    }
    for (value, unit, printed) in [
        (1.25606e-5, "m", "12.5606 \u{b5}m"),
        (206e9, "Pa", "206 GPa"),
        (9.81, "m/s2", "9.81 m/s\u{b2}"),
        (1e-40, "N.s2", "10<sup>\u{2212}40</sup> N\u{b7}s\u{b2}"),
        (0.3, "", "0.3"),
    ] {
        assert_eq!(quantity(value, unit), printed);
    }
}
