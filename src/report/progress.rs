//! Progress of a report: a bar with the remaining time on a terminal, lines elsewhere.

use indicatif::{ProgressBar, ProgressStyle};
use std::time::{Duration, Instant};

/// The duration of other work, in steps.
const BUILDING: u64 = 2_000_000;
const WAY: u64 = 300_000;
const CASE: u64 = 50_000;

/// The work of a report, and the finished part.
pub struct Progress {
    bar: ProgressBar,
    began: Instant,
}

/// A kind of work.
#[derive(Clone, Copy)]
pub enum Work {
    /// An FMU to build.
    Building,
    /// Steps to make.
    Steps(u64),
    /// A stability limit to find.
    Way,
    /// A case to run.
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
    /// No work yet.
    pub fn new() -> Progress {
        let style = ProgressStyle::with_template("{elapsed:>4} {bar:30} {percent:>3} %, {eta:>3} left  {wide_msg}");
        let bar = ProgressBar::new(0).with_style(style.expect("a good template"));
        bar.enable_steady_tick(Duration::from_millis(200));
        Progress { bar, began: Instant::now() }
    }

    /// Adds `work` to the total.
    pub fn expect(&self, work: impl IntoIterator<Item = Work>) {
        self.bar.inc_length(work.into_iter().map(Work::steps).sum());
    }

    /// Shows the current activity.
    pub fn say(&self, what: &str) {
        self.bar.set_message(what.to_string());
        if self.bar.is_hidden() {
            crate::layout::tell(&format!("{:5.1} s  {what} ...", self.began.elapsed().as_secs_f64()));
        }
    }

    /// Shows a part of the current activity on a terminal.
    pub fn detail(&self, what: &str) {
        self.bar.set_message(what.to_string());
    }

    /// Adds finished `work`.
    pub fn done(&self, work: Work) {
        self.bar.inc(work.steps());
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
