//! Which method and tick rate to take for a scene: every method judged, and the slowest rates at which
//! it holds.

use super::judge::Judge;
use super::scene::{LaneSpec, Scene};
use super::verdict::Verdict;
use crate::sim::stability::RateSearch;

/// What is known of one method on a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Advised {
    /// The method.
    pub spec: LaneSpec,
    /// At the rate that was asked about.
    pub verdict: Verdict,
    /// The slowest rate in Hz at which no deviation grows; `None` where none was found.
    pub stable_hz: Option<u32>,
    /// The slowest rate in Hz at which the error stays within the tolerance over the horizon; `None`
    /// where none was found.
    pub accurate_hz: Option<u32>,
    /// The slowest rate that is both, and what it costs.
    pub good: Option<Good>,
}

/// A rate at which a method is both stable and accurate.
#[derive(Clone, Debug, PartialEq)]
pub struct Good {
    /// The rate in Hz.
    pub tick_hz: u32,
    /// Evaluations of all bodies' accelerations in a simulated second.
    pub evaluations_per_s: f64,
    /// What is to be said of the method at this rate.
    pub verdict: Verdict,
}

/// Judges methods one after the other, a rate at a time.
pub struct Adviser {
    judge: Judge,
    tick_hz: u32,
    specs: Vec<LaneSpec>,
    advised: Vec<Advised>,
    /// The searches for the method under way, the first for stability.
    searches: [RateSearch; 2],
}

impl Adviser {
    /// For `scene` under this throttle at this rate, and these methods.
    pub fn new(scene: &Scene, throttle: f64, tick_hz: u32, specs: Vec<LaneSpec>) -> Self {
        let judge = Judge::new(scene, throttle);
        Self { judge, tick_hz, specs, advised: Vec::new(), searches: Default::default() }
    }

    /// What methods are held against.
    pub fn judge(&self) -> &Judge {
        &self.judge
    }

    /// The rate that was asked about, in Hz.
    pub fn tick_hz(&self) -> u32 {
        self.tick_hz
    }

    /// How many methods there are to judge.
    pub fn wanted(&self) -> usize {
        self.specs.len()
    }

    /// What is known by now.
    pub fn advised(&self) -> &[Advised] {
        &self.advised
    }

    /// Whether all methods are judged.
    pub(super) fn is_done(&self) -> bool {
        self.advised.len() == self.specs.len()
    }

    /// Tries one rate for one method. Returns whether there is more to do.
    pub fn advance(&mut self) -> bool {
        let Self { judge, searches: [stable, accurate], .. } = self;
        let Some(&spec) = self.specs.get(self.advised.len()) else { return false };
        if stable.found().is_none() {
            stable.advance(|hz| judge.is_stable(spec, hz));
        } else if accurate.found().is_none() {
            accurate.advance(|hz| judge.outcome_while_accurate(spec, hz).is_accurate());
        } else {
            let (stable_hz, accurate_hz) = (stable.found().flatten(), accurate.found().flatten());
            let verdict = judge.verdict(spec, self.tick_hz);
            let both = stable_hz.zip(accurate_hz).map(|(a, b)| a.max(b));
            let good = both.and_then(|hz| good(judge, spec, hz));
            self.advised.push(Advised { spec, verdict, stable_hz, accurate_hz, good });
            self.searches = Default::default();
        }
        !self.is_done()
    }
}

/// What the rate costs, if it is as good as the searches make hope.
fn good(judge: &Judge, spec: LaneSpec, tick_hz: u32) -> Option<Good> {
    let verdict = judge.verdict(spec, tick_hz);
    let evaluations_per_s = verdict.outcome.evaluations as f64 / verdict.outcome.seconds;
    (verdict.is_stable() && verdict.is_accurate()).then_some(Good {
        tick_hz,
        evaluations_per_s,
        verdict,
    })
}

/// The one of those that are good at some rate that costs least, the listings as printed left out.
pub fn cheapest(advised: &[Advised], cost: impl Fn(&Advised, &Good) -> f64) -> Option<usize> {
    let good = advised.iter().enumerate().filter_map(|(i, advised)| {
        let good = advised.good.as_ref().filter(|_| !advised.spec.method.as_printed)?;
        Some((i, cost(advised, good)))
    });
    good.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(i, _)| i)
}
