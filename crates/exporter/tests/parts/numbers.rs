use brinell_exporter::numbers::*;

#[test]
fn numbers_are_written_as_people_write_them() {
    for (value, unit, text) in [
        (330.664, "N", "330.7 N"),
        (1.256060e-5, "m", "12.56 um"),
        (2.984606e-5, "s", "29.85 us"),
        (4.11e-3, "kg", "4.11 g"),
        (2.5, "kg", "2.5 kg"),
        (0.99996, "kg", "1 kg"),
        (1.0, "m/s", "1 m/s"),
        (1.8737e-3, "m/s", "1.874 mm/s"),
        (5000.0, "m/s", "5000 m/s"),
        (206e9, "Pa", "206 GPa"),
        (999.96e6, "Pa", "1 GPa"),
        (7850.0, "kg/m^3", "7850 kg/m^3"),
        (0.44629924, "", "0.4463"),
        (-0.05, "m", "-50 mm"),
        (0.0, "J", "0 J"),
        (-0.0, "J", "0 J"),
        (2e-30, "m", "2e-15 fm"),
        (3e20, "N", "3e8 TN"),
    ] {
        assert_eq!(quantity(value, unit), text);
    }
}

#[test]
fn a_band_stands_behind_its_number_in_one_unit() {
    assert_eq!(with_band(344.6, Some([331.4, 357.5]), "N"), "344.6 N (331 to 358 N)");
    assert_eq!(with_band(0.569, Some([0.5512, 0.5871]), ""), "0.569 (0.551 to 0.587)");
    assert_eq!(with_band(9.9e-7, Some([0.0, 1.2e-6]), "m"), "990 nm (0 to 1.2 um)");
    assert_eq!(with_band(1.0, Some([1.0, 1.0]), ""), "1");
    assert_eq!(with_band(2.0, None, "J"), "2 J");
}

#[test]
fn differences_that_nobody_sees_are_called_so() {
    for (difference, text) in [
        (0.0, "0 %"),
        (-0.0, "0 %"),
        (-3e-9, "below 0.0001 %"),
        (1.234e-5, "+0.0012 %"),
        (-0.021, "-2.1 %"),
        (1e-6, "+0.0001 %"),
    ] {
        assert_eq!(percent(difference), text);
    }
}

#[test]
fn numbers_in_messages_have_no_rows_of_zeros() {
    for (value, text) in [
        (0.005, "0.005"),
        (-3e5, "-300000"),
        (0.0, "0"),
        (1e300, "1e300"),
        (-1e300, "-1e300"),
        (5e-324, "5e-324"),
        (1.5e-9, "1.5e-9"),
        (f64::INFINITY, "inf"),
        (f64::NAN, "NaN"),
    ] {
        assert_eq!(in_message(value), text);
    }
}

#[test]
fn a_range_has_one_form_of_numbers() {
    for (value, allowed, unit, text) in [
        (-0.005, 1e-12..=1e9, "m", "= -0.005 is out of range: allowed is 1e-12 to 1e9 m"),
        (1e10, 0.001..=1e6, "", "= 1e10 is out of range: allowed is 0.001 to 1000000"),
        (f64::NAN, -1e40..=1e40, "m/s", "= NaN is out of range: allowed is -1e40 to 1e40 m/s"),
        (1.0000000001, 0.0..=1.0, "", "= 1.0000000001 is out of range: allowed is 0 to 1"),
    ] {
        assert_eq!(out_of_range(value, &allowed, unit), text);
    }
}

/// Zeros, what is no number, the ends of all doubles, and numbers of all sizes.
fn any_numbers() -> impl Iterator<Item = f64> {
    let special = [0.0, f64::MIN_POSITIVE, f64::from_bits(1), f64::MAX, f64::INFINITY, f64::NAN, 1.0, 9.5, 999.9996];
    // every exponent, with a mantissa of all digits
    let sizes = (0..2047_u64)
        .map(|exponent| f64::from_bits(exponent << 52 | exponent.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 12));
    special.into_iter().chain(sizes).flat_map(|value| [value, -value])
}

#[test]
fn every_double_has_a_text_that_reads_back_as_it() {
    let near = |text: &str, value: f64, digits: i32| {
        let read: f64 = text.parse().unwrap_or_else(|_| panic!("{text:?} for {value:e}"));
        // a subnormal number has fewer digits than its text
        let allowed = 0.501 * 10f64.powi(1 - digits) * value.abs() + f64::from_bits(1);
        let is_near = if value.is_finite() { (read - value).abs() <= allowed } else { !read.is_finite() };
        assert!(is_near, "{text} for {value:e}");
    };
    for value in any_numbers() {
        near(&digits(value), value, 6);
        near(&plain(value), value, 12);
        near(&in_message(value), value, 17);
        near(&brinell_exporter::model_description::number(value), value, 17);
        for count in [1, 3, 17] {
            near(&significant(value, count), value, count as i32);
        }
        for unit in ["m", "s", "m/s", "kg", "N", "J", "Pa", "N/m", "N.s", "", "kg/m^3"] {
            let size = prefixed(value, unit).size;
            for (text, digits) in [(quantity(value, unit), DIGITS as i32), (precise(value, unit), 6)] {
                let number = text.split(' ').next().unwrap().parse::<f64>().unwrap();
                // the number may be beyond all doubles in the unit itself
                near(&format!("{number:e}"), value / size, digits);
            }
        }
        for round in [f64::round, f64::floor, f64::ceil] {
            let short = one_digit(value, round);
            assert!(
                (short - value).abs() <= value.abs() || !value.is_normal() || !short.is_finite(),
                "{value:e}: {short:e}"
            );
        }
        // a number that isn't finite is named as it is
        let _ = percent(value);
        let _ = cell(value, 1e-3);
        assert!(out_of_range(value, &(-1.0..=1.0), "m").starts_with(&format!("= {}", in_message(value))));
    }
}

#[test]
fn what_rust_says_about_a_text_that_is_no_number_is_in_words() {
    let of_real = ["", "abc", "1,5"].map(|text| text.parse::<f64>().unwrap_err().to_string());
    let of_whole = ["", "x", "-300", "300", "2.5"].map(|text| text.parse::<i8>().unwrap_err().to_string());
    for error in of_real.iter().chain(&of_whole) {
        assert!(in_words(error).contains("number is "), "{error}");
    }
}

#[test]
fn numbers_of_a_scene_keep_their_digits() {
    for (value, text) in [
        (5.0 * 1e-3, "5e-3"),
        (210e9, "210e9"),
        (7.85 * 1e3, "7850"),
        (0.3, "0.3"),
        (1.5e-6, "1.5e-6"),
        (0.0, "0"),
        (-0.005, "-5e-3"),
        (33e6, "33e6"),
    ] {
        assert_eq!(plain(value), text);
        assert_eq!(text.parse::<f64>().unwrap(), rounded(value, 12));
    }
}
