//! The Rust examples run to their end. Each checks its own results.

use std::process::Command;

#[test]
fn the_row_of_balls_keeps_its_energy() {
    // cargo has built it beside this test
    let tests = std::env::current_exe().expect("a test knows where it is");
    let program = tests.ancestors().nth(2).expect("target/PROFILE/deps/TEST").join("examples/chain");
    let output = Command::new(&program).output().unwrap_or_else(|error| panic!("{}: {error}", program.display()));
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(String::from_utf8_lossy(&output.stdout).contains("balance of energies"));
}
