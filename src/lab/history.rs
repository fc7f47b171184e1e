//! The recent past of one body in one lane: what trails and plots are drawn from. Bounded, and
//! allocated once.

use std::collections::VecDeque;

use glam::DVec2;

use super::lane::LaneBody;
use super::metrics::METRICS;

/// Samples kept: enough for every tick of 30 s at 60 Hz, and more than a plot has pixels.
pub const CAPACITY: usize = 2048;

/// One moment of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// Time in seconds.
    pub t: f64,
    /// The first coordinate.
    pub q: f64,
    /// Its velocity.
    pub v: f64,
    /// Where the body was, in metres.
    pub at: DVec2,
    /// The lane's place on the list of methods at that moment: a trail changes colour at a switch.
    pub entry: usize,
    /// One value for each of [`METRICS`]; NaN where it has no meaning.
    pub metrics: [f64; METRICS.len()],
}

/// The recent past of one body in one lane, oldest first.
#[derive(Debug)]
pub struct History {
    samples: VecDeque<Sample>,
}

impl History {
    /// An empty history with room for [`CAPACITY`] samples.
    pub fn new() -> Self {
        Self { samples: VecDeque::with_capacity(CAPACITY) }
    }

    /// The samples, oldest first.
    pub fn samples(&self) -> impl DoubleEndedIterator<Item = &Sample> + ExactSizeIterator + Clone {
        self.samples.iter()
    }

    /// Adds the present of `lane`, whose method has place `entry`, and forgets the oldest if full.
    pub fn record(&mut self, t: f64, entry: usize, lane: &LaneBody, truth: &LaneBody) {
        if self.samples.len() == CAPACITY {
            self.samples.pop_front();
        }
        let (q, v) = (lane.stepper.q()[0], lane.stepper.v()[0]);
        let metrics =
            std::array::from_fn(|i| (METRICS[i].measure)(lane, truth).unwrap_or(f64::NAN));
        self.samples.push_back(Sample { t, q, v, at: lane.stepper.place(), entry, metrics });
    }
}

impl Default for History {
    fn default() -> Self {
        Self::new()
    }
}
