use brinell::parts::impacts;

#[test]
fn the_restitutions_are_those_of_the_table() {
    let known = impacts().into_iter().filter_map(|impact| impact.rebound).map(|rebound| rebound.restitution);
    let known: Vec<f64> = known.collect();
    // from data/truth/README.md
    let printed = [0.921, 0.777, 0.645, 0.536, 0.450];
    assert_eq!(known.len(), printed.len(), "{known:?}");
    assert!(known.iter().zip(printed).all(|(one, other)| (one - other).abs() < 6e-4), "{known:?}");
}
