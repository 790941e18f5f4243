//! A history of rates through all states: small and large steps in both directions, through yield, separation and deeper
//! indentation.

use super::hosts::write_history;
use crate::physics::Random;
use crate::places::test_name;
use std::collections::HashSet;
use std::path::PathBuf;
use std::sync::LazyLock;

/// Steps of the history.
const STEPS: usize = 2000;

/// The file of the history, written once.
pub fn history() -> PathBuf {
    static HISTORY: LazyLock<PathBuf> = LazyLock::new(|| {
        let mut random = Random(14);
        let (mut steps, mut depth) = (Vec::new(), 0.0);
        while steps.len() < STEPS {
            // a depth to reach in some steps; one in five is out of contact
            let size = random.log_uniform(1e-9, 3e-5);
            let target = if random.next() < 0.2 { -size } else { size };
            let parts = (1.0 + 20.0 * random.next()).floor();
            for _ in 0..parts as usize {
                let step = random.log_uniform(1e-8, 1e-6);
                steps.push(((target - depth) / parts / step, step));
            }
            depth = target;
        }
        steps.truncate(STEPS);
        write_history(&format!("{}.txt", test_name()), steps.into_iter())
    });
    HISTORY.clone()
}

/// Checks that the outputs are worth comparing: one line for each step, most of them different.
#[track_caller]
pub fn assert_rich(bits: &str) {
    assert_different(bits, STEPS / 2);
}

/// The same for any scene: bodies that the FMU moves, and contacts far from each other, touch seldom in this history.
#[track_caller]
pub fn assert_moving(bits: &str) {
    assert_different(bits, 15);
}

#[track_caller]
fn assert_different(bits: &str, least: usize) {
    let lines: Vec<_> = bits.lines().collect();
    let different: HashSet<_> = lines.iter().collect();
    assert!(lines.len() == STEPS && different.len() > least, "{} lines, {} different", lines.len(), different.len());
}
