//! Samples in turn, so that other load on the machine affects all alike.

fn median(mut samples: Vec<f64>) -> f64 {
    samples.sort_by(f64::total_cmp);
    samples[samples.len() / 2]
}

/// Medians of `rounds` samples of each of `N`, taken in turn. `sample` gets the index and the round.
pub fn interleaved<const N: usize>(rounds: usize, mut sample: impl FnMut(usize, usize) -> f64) -> [f64; N] {
    let mut samples = [const { Vec::new() }; N];
    for round in 0..rounds {
        for turn in 0..N {
            // the order changes from round to round
            let number = (round + turn) % N;
            samples[number].push(sample(number, round));
        }
    }
    samples.map(median)
}
