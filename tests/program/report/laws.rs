//! The laws in a report, beside each other.

use super::{DEFAULT, rows};

#[test]
fn restitution_over_speed_has_every_law() {
    for law in rows(&DEFAULT.1, "laws").iter().map(|row| &row["law"]).filter(|law| *law != "finite elements") {
        let speeds = rows(&DEFAULT.1, "restitution").iter().filter(|row| row["law"] == *law);
        assert_eq!(speeds.count(), 41, "{law}");
    }
    let truth = rows(&DEFAULT.1, "restitution").iter().filter(|row| row["law"] == "finite elements");
    let truth: Vec<f64> = truth.map(|row| row["restitution"].as_f64().expect("a number")).collect();
    // from data/truth/README.md; its slowest impact is slower than a hundredth of the scene's speed
    let printed = [0.777, 0.645, 0.536, 0.450];
    assert_eq!(truth.len(), printed.len(), "{truth:?}");
    assert!(truth.iter().zip(printed).all(|(one, other)| (one - other).abs() < 6e-4), "{truth:?}");
}

#[test]
fn the_spread_has_the_extremes_of_the_laws() {
    let laws = rows(&DEFAULT.1, "laws").iter();
    let laws: Vec<_> = laws.filter(|row| row["law"] != "hertz" && row["law"] != "finite elements").collect();
    for row in rows(&DEFAULT.1, "spread") {
        let key = match row["quantity"].as_str().expect("a name") {
            "restitution" => "restitution",
            "largest force" => "largest_force_N",
            "dent" => "dent_m",
            "contact time" => "contact_time_s",
            other => panic!("a quantity {other}"),
        };
        let values = || laws.iter().map(|law| law[key].as_f64().expect("a number"));
        assert_eq!(row["lowest"].as_f64(), Some(values().fold(f64::INFINITY, f64::min)), "{row}");
        assert_eq!(row["highest"].as_f64(), Some(values().fold(f64::NEG_INFINITY, f64::max)), "{row}");
        for (by, value) in [("lowest_by", "lowest"), ("highest_by", "highest")] {
            let law = laws.iter().find(|law| law["law"] == row[by]).expect("a law of the table");
            assert_eq!(law[key], row[value], "{row}");
        }
    }
    assert_eq!(rows(&DEFAULT.1, "spread").len(), 4);
}
