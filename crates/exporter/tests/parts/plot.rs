use brinell_exporter::plot::*;

/// Ranges of all lengths and places: ticks within them, in order, with room for their labels, and at least two of them.
#[test]
fn ticks_of_a_logarithmic_axis_have_room_and_are_round() {
    for least in [ACROSS, UPWARDS] {
        for place in -30..30 {
            for length in 1..=100 {
                let start = 10_f64.powf(0.37 * f64::from(place));
                // from 0.1 to 20 decades
                let range = start..start * 10_f64.powf(0.1 * 1.0545_f64.powi(length));
                let found = ticks(&range, least);
                assert!(found.len() >= 2, "{range:?}: {found:?}");
                assert!(
                    found.iter().all(|tick| range.contains(tick) && label(tick).len() <= 8),
                    "{range:?}: {found:?}"
                );
                let room = (range.end / range.start).ln() * least;
                assert!(found.windows(2).all(|two| (two[1] / two[0]).ln() >= room), "{range:?}: {found:?}");
            }
        }
    }
}
