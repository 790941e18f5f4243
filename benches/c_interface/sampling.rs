//! Samples in turns, so that whatever else the machine does hits all alike.

pub fn median(mut samples: Vec<f64>) -> f64 {
    samples.sort_by(f64::total_cmp);
    samples[samples.len() / 2]
}

/// Medians of `rounds` samples of each of three, taken in turns. `sample` has the number of the one and of the round.
pub fn interleaved(rounds: usize, mut sample: impl FnMut(usize, usize) -> f64) -> [f64; 3] {
    let mut samples = [const { Vec::new() }; 3];
    for round in 0..rounds {
        for turn in 0..3 {
            // whoever is first differs from round to round
            let number = (round + turn) % 3;
            samples[number].push(sample(number, round));
        }
    }
    samples.map(median)
}
