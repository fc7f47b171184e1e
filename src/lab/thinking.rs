//! What the lab works out beside the race, a little in every frame, and keeps: verdicts and advice.

use super::advice::Adviser;
use super::judge::Judge;
use super::scene::{LaneSpec, Scene};
use super::verdict::Verdict;
use crate::sim::integrators::METHODS;

/// What a verdict depends on beside scene and lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Moment {
    pub(super) tick_hz: u32,
    pub(super) throttle: f64,
}

/// The verdicts and the advice on one scene.
#[derive(Default)]
pub(super) struct Thinking {
    judge: Option<Judge>,
    verdicts: Vec<Option<(Moment, Verdict)>>,
    adviser: Option<(Moment, Adviser)>,
    more: bool,
}

/// Steps of one coordinate that a verdict may take: some hundredth of a second's work. Faster rates and
/// larger bodies are judged over a shorter stretch, which the verdict names.
const MOST_STEPS: f64 = 5e5;

/// What advice may take in a frame, in evaluations of one coordinate's acceleration: a few hundredths of
/// a second where they are slow.
const WORK: u64 = 100_000;

impl Thinking {
    /// Whether there was more to do after the last time.
    pub(super) fn more(&self) -> bool {
        self.more
    }

    /// What was last found of the lane on this place.
    pub(super) fn verdict(&self, entry: usize) -> Option<&Verdict> {
        Some(&self.verdicts.get(entry)?.as_ref()?.1)
    }

    pub(super) fn advice(&self) -> Option<&Adviser> {
        Some(&self.adviser.as_ref()?.1)
    }

    /// Finds one verdict that is missing or out of date or, where none is, goes on with the advice that
    /// is asked for. Returns whether there is more to do.
    pub(super) fn go_on(
        &mut self,
        scene: &Scene,
        entries: &[LaneSpec],
        now: Moment,
        advice: bool,
    ) -> bool {
        self.more = self.one(scene, entries, now, advice);
        self.more
    }

    fn one(&mut self, scene: &Scene, entries: &[LaneSpec], now: Moment, advice: bool) -> bool {
        self.verdicts.resize(entries.len(), None);
        let is_new = |(at, _): &(Moment, Verdict)| *at == now;
        let old = self.verdicts.iter().position(|known| !known.as_ref().is_some_and(is_new));
        if let Some(old) = old {
            let judge = match self.judge.take().filter(|judge| judge.throttle() == now.throttle) {
                Some(judge) => self.judge.insert(judge),
                None => self.judge.insert(Judge::new(scene, now.throttle)),
            };
            let spec = entries[old];
            let steps_per_s = f64::from(now.tick_hz) * f64::from(spec.substeps);
            let most_s = MOST_STEPS / (steps_per_s * judge.coordinates() as f64);
            self.verdicts[old] = Some((now, judge.verdict_within(spec, now.tick_hz, most_s)));
            return true;
        }
        if !advice {
            return false;
        }
        let specs = || METHODS.iter().map(LaneSpec::plain).collect();
        let (_, adviser) = match self.adviser.take().filter(|(at, _)| *at == now) {
            Some(known) => self.adviser.insert(known),
            None => {
                let adviser = Adviser::new(scene, now.throttle, now.tick_hz, specs());
                self.adviser.insert((now, adviser))
            }
        };
        let before = adviser.work();
        while adviser.work() - before < WORK {
            if !adviser.advance() {
                return false;
            }
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_verdict_is_found_once_until_the_rate_or_the_throttle_changes() {
        let scene = Scene::built_in("harbour").unwrap();
        let lanes = &scene.lanes;
        let mut thinking = Thinking::default();
        let mut thoughts = |tick_hz, throttle| {
            let now = Moment { tick_hz, throttle };
            let count = (0..).take_while(|_| thinking.go_on(&scene, lanes, now, false)).count();
            let verdicts: Vec<String> =
                (0..lanes.len()).map(|i| thinking.verdict(i).unwrap().to_string()).collect();
            (count, verdicts)
        };
        let (count, first) = thoughts(60, 1.0);
        assert_eq!(count, lanes.len());
        assert_eq!(thoughts(60, 1.0), (0, first.clone()));
        let (count, coarse) = thoughts(20, 1.0);
        assert_eq!(count, lanes.len());
        assert!(coarse != first);
        assert_eq!(thoughts(20, 0.5).0, lanes.len());
    }

    #[test]
    fn advice_is_thought_of_bit_by_bit_and_only_when_asked_for() {
        let scene = Scene::built_in("spring").unwrap();
        let now = Moment { tick_hz: 60, throttle: 1.0 };
        let mut thinking = Thinking::default();
        while thinking.go_on(&scene, &scene.lanes, now, false) {}
        assert!(thinking.advice().is_none());
        let bits = (0..).take_while(|_| thinking.go_on(&scene, &scene.lanes, now, true)).count();
        assert!((3..2000).contains(&bits), "{bits} frames");
        let advised = thinking.advice().unwrap().advised();
        assert_eq!(advised.len(), METHODS.len());
        assert!(!thinking.more());
    }
}
