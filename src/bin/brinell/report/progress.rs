//! How far a report has come, for those who wait for it: a bar with the time left on a terminal, lines elsewhere.

use indicatif::{ProgressBar, ProgressStyle};
use std::time::{Duration, Instant};

/// What other work is about as long as, in steps.
const BUILDING: u64 = 2_000_000;
const WAY: u64 = 300_000;
const CASE: u64 = 50_000;

/// What a report has to do, and how much of it is done.
pub struct Progress {
    bar: ProgressBar,
    began: Instant,
}

/// A kind of work.
#[derive(Clone, Copy)]
pub enum Work {
    /// A unit to be built.
    Building,
    /// Steps to be made.
    Steps(u64),
    /// A way to couple, tried for stability.
    Way,
    /// A case to be run.
    Case,
}

impl Work {
    fn steps(self) -> u64 {
        match self {
            Work::Building => BUILDING,
            Work::Steps(steps) => steps,
            Work::Way => WAY,
            Work::Case => CASE,
        }
    }
}

impl Progress {
    /// Nothing done yet, and nothing known.
    pub fn new() -> Progress {
        let style = ProgressStyle::with_template("{elapsed:>4} {bar:30} {percent:>3} %, {eta:>3} left  {wide_msg}");
        let bar = ProgressBar::new(0).with_style(style.expect("a good template"));
        bar.enable_steady_tick(Duration::from_millis(200));
        Progress { bar, began: Instant::now() }
    }

    /// There will be so much `work`.
    pub fn expect(&self, work: impl IntoIterator<Item = Work>) {
        self.bar.inc_length(work.into_iter().map(Work::steps).sum());
    }

    /// Says what is being done from now on.
    pub fn say(&self, what: &str) {
        self.bar.set_message(what.to_string());
        if self.bar.is_hidden() {
            crate::layout::tell(&format!("{:5.1} s  {what} ...", self.began.elapsed().as_secs_f64()));
        }
    }

    /// Says a part of that, to those who watch.
    pub fn detail(&self, what: &str) {
        self.bar.set_message(what.to_string());
    }

    /// So much is done.
    pub fn done(&self, work: Work) {
        self.bar.inc(work.steps());
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
