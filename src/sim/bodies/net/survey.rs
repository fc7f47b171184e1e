//! How far the nodes of a net go, found by a short run.

use glam::DVec2;

use super::Net;
use crate::sim::body::Body;
use crate::sim::system::{System, Vector};

/// How long the motion is followed, in seconds: a hanging cloth has fallen by then, and swung back.
const SECONDS: f64 = 4.0;

/// The most evaluations of springs: some tens of milliseconds in an unoptimised build.
const MOST_SPRINGS: f64 = 3e6;

/// The longest step in units of the fastest motion: half of what semi-implicit Euler bears.
const STEP: f64 = 0.5;

/// The lower left and the upper right corner of the rectangle that holds all nodes in the first seconds.
pub(super) fn range(net: &Net) -> [DVec2; 2] {
    let mut state = net.start();
    let mut a = state.v.clone();
    let h = STEP / net.fastest_rate();
    let springs = net.springs.constants.len() as f64;
    let steps = (SECONDS / h).min(MOST_SPRINGS / springs) as u64;
    let mut range = [DVec2::INFINITY, DVec2::NEG_INFINITY];
    let fixed: Vec<DVec2> = net.fixed().collect();
    for step in 0..=steps {
        let nodes = state.q.pairs().iter().map(|&node| DVec2::from(node));
        range = nodes
            .chain(fixed.iter().copied())
            .fold(range, |[low, high], node| [low.min(node), high.max(node)]);
        net.acceleration(step as f64 * h, &state.q, &state.v, &mut a);
        Vector::kick_and_drift(h, &a, &mut state.v, h, &mut state.q);
    }
    range
}
