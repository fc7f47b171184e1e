//! How far the nodes of a net go, found by a short run.

use glam::DVec2;

use super::Net;
use crate::sim::body::Body;
use crate::sim::state::{Elementwise, Vector};
use crate::sim::system::System;

/// How long the motion is followed, in seconds: a hanging cloth has fallen by then, and swung back.
const SECONDS: f64 = 4.0;

/// The most evaluations of springs: some tens of milliseconds in an unoptimised build.
const MAX_SPRINGS: f64 = 3e6;

/// The longest step in units of the fastest motion: half of what semi-implicit Euler bears.
const STEP: f64 = 0.5;

/// A coordinate has moved farther than another if by more than this part: nodes that mirror each other differ by
/// rounding.
const FARTHER: f64 = 1e-6;

/// How far the nodes go in the first seconds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Survey {
    /// The lower left and the upper right corner of the rectangle that holds all nodes.
    pub(super) range: [DVec2; 2],
    /// The index of the coordinate that moves farthest.
    pub(super) farthest: usize,
}

impl Survey {
    pub(super) fn of(net: &Net) -> Self {
        let mut state = net.start();
        let mut a = state.v.clone();
        let h = STEP / net.fastest_rate();
        let springs = net.springs.constants.len() as f64;
        let steps = (SECONDS / h).min(MAX_SPRINGS / springs) as u64;
        let mut range = [DVec2::INFINITY, DVec2::NEG_INFINITY];
        let mut reach = vec![[f64::INFINITY, f64::NEG_INFINITY]; state.q.components().len()];
        let fixed: Vec<DVec2> = net.fixed().collect();
        for step in 0..=steps {
            let nodes = Net::nodes(&state.q).iter().map(|&node| DVec2::from(node));
            range = nodes
                .chain(fixed.iter().copied())
                .fold(range, |[low, high], node| [low.min(node), high.max(node)]);
            for ([low, high], &q) in reach.iter_mut().zip(state.q.components()) {
                (*low, *high) = (low.min(q), high.max(q));
            }
            net.acceleration(step as f64 * h, &state.q, &state.v, &mut a);
            Elementwise::kick_and_drift(h, &a, &mut state.v, h, &mut state.q);
        }
        let far = |&[low, high]: &[f64; 2]| high - low;
        let farther = |best: usize, next: usize| {
            let is_farther = far(&reach[next]) > (1.0 + FARTHER) * far(&reach[best]);
            if is_farther { next } else { best }
        };
        let farthest = (0..reach.len()).fold(0, farther);
        Self { range, farthest }
    }
}
