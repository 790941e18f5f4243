/// The C functions expect the input and the force at the first two positions.
#[test]
fn the_input_comes_first_and_the_force_second() {
    assert_eq!(
        [0, 1].map(|place| brinell_exporter::table::VARIABLES[place].name.as_str()),
        ["indentation_rate", "force"]
    );
}
