//! What is worked out beside the race, a little at a time: verdicts and advice. It takes long, and so it may be done on
//! another thread than the race: a [`Question`] goes there, [`Findings`] come back.

use std::sync::Arc;

use super::advice::{Advised, Adviser, CRITERIA, Meets};
use super::judge::Judge;
use super::verdict::Verdict;
use crate::lab::lane_spec::LaneSpec;
use crate::lab::scene::Scene;
use crate::sim::integrators::METHODS;

/// What is to be worked out. Two questions of one [`Lab`](crate::lab::Lab) are equal if they have the same answer.
#[derive(Clone, Debug)]
pub struct Question {
    pub(in crate::lab) scene: Arc<Scene>,
    /// The lanes that verdicts are wanted on.
    pub(in crate::lab) entries: Vec<LaneSpec>,
    pub(in crate::lab) tick_hz: u32,
    pub(in crate::lab) throttle: f64,
    /// Whether advice is wanted too.
    pub(in crate::lab) advice: bool,
}

impl PartialEq for Question {
    fn eq(&self, other: &Self) -> bool {
        self.is_of(&other.scene)
            && self.entries == other.entries
            && self.tick_hz == other.tick_hz
            && self.throttle == other.throttle
            && self.advice == other.advice
    }
}

impl Question {
    /// Whether it is about this scene, as it was opened and not only as it is written.
    pub(in crate::lab) fn is_of(&self, scene: &Arc<Scene>) -> bool {
        Arc::ptr_eq(&self.scene, scene)
    }
}

/// What was found by now.
#[derive(Clone, Debug)]
pub struct Findings {
    pub(in crate::lab) question: Question,
    /// For each method of the list what was last found of it, though it were at another tick rate.
    pub(in crate::lab) verdicts: Vec<Option<Verdict>>,
    pub(in crate::lab) advice: Option<Advice>,
    /// Whether there is no more to find.
    pub(in crate::lab) complete: bool,
}

impl Findings {
    /// Whether they are all that there is to be found.
    pub(in crate::lab) fn answer(&self, question: &Question) -> bool {
        self.complete && self.question == *question
    }
}

/// What is known of every method on a scene.
#[derive(Clone, Debug)]
pub struct Advice {
    /// The rate that was asked about, in Hz.
    pub tick_hz: u32,
    /// The simulated seconds that methods are held against the truth.
    pub horizon_s: f64,
    /// How many methods there are to judge.
    pub wanted: usize,
    /// Those judged by now.
    pub advised: Vec<Advised>,
}

/// Works on one question at a time.
pub struct Thinker {
    question: Question,
    judge: Option<Judge>,
    verdicts: Vec<Option<Verdict>>,
    /// How many of the verdicts, from the first, answer the question.
    judged: usize,
    advising: Option<Advising>,
}

/// Advice on the way: method after method, criterion after criterion.
struct Advising {
    adviser: Adviser,
    advised: Vec<Advised>,
    /// What is known of the method under way.
    met: Vec<Meets>,
}

impl Advising {
    /// Looks into one more criterion.
    fn advance(&mut self) {
        let Some(method) = METHODS.get(self.advised.len()) else { return };
        let spec = LaneSpec::plain(method);
        if let Some(&criterion) = CRITERIA.get(self.met.len()) {
            self.met.push(self.adviser.meets(spec, criterion));
        } else {
            let met =
                std::mem::take(&mut self.met).try_into().expect("each criterion was looked into");
            self.advised.push(Advised { spec, verdict: self.adviser.verdict(spec), met });
        }
    }

    fn is_done(&self) -> bool {
        self.advised.len() == METHODS.len()
    }
}

impl Thinker {
    /// Sets out to answer `question`.
    pub fn new(question: Question) -> Self {
        let verdicts = vec![None; question.entries.len()];
        Self { question, judge: None, verdicts, judged: 0, advising: None }
    }

    /// Sets out to answer another question. What is found already and answers it too is kept.
    pub fn ask(&mut self, question: Question) {
        if !question.is_of(&self.question.scene) {
            *self = Self::new(question);
            return;
        }
        let same_throttle = question.throttle == self.question.throttle;
        if !same_throttle {
            self.judge = None;
        }
        if !same_throttle || question.tick_hz != self.question.tick_hz {
            self.judged = 0;
            self.advising = None;
        }
        if question.entries != self.question.entries {
            self.judged = 0;
        }
        self.question = question;
    }

    /// Finds one verdict that is missing or, where none is, looks into one more criterion for the advice that is asked
    /// for. Returns whether there is more to do.
    pub fn go_on(&mut self) -> bool {
        let Question { scene, entries, tick_hz, throttle, advice } = &self.question;
        if let Some(&spec) = entries.get(self.judged) {
            let judge = self.judge.get_or_insert_with(|| Judge::new(scene, *throttle));
            self.verdicts[self.judged] = Some(judge.verdict(spec, *tick_hz));
            self.judged += 1;
        } else if *advice {
            let advising = self.advising.get_or_insert_with(|| Advising {
                adviser: Adviser::new(scene, *throttle, *tick_hz),
                advised: Vec::new(),
                met: Vec::new(),
            });
            advising.advance();
        }
        !self.is_done()
    }

    /// Goes on to the end.
    pub fn finish(mut self) -> Findings {
        while self.go_on() {}
        self.findings()
    }

    fn is_done(&self) -> bool {
        let advised = self.advising.as_ref().is_some_and(Advising::is_done);
        self.judged == self.question.entries.len() && (advised || !self.question.advice)
    }

    /// What is found by now.
    pub fn findings(&self) -> Findings {
        let advice = self.advising.as_ref().filter(|_| self.question.advice);
        let advice = advice.map(|Advising { adviser, advised, .. }| Advice {
            tick_hz: adviser.tick_hz(),
            horizon_s: adviser.judge().horizon_s(),
            wanted: METHODS.len(),
            advised: advised.clone(),
        });
        Findings {
            question: self.question.clone(),
            verdicts: self.verdicts.clone(),
            advice,
            complete: self.is_done(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn question(name: &str) -> Question {
        let scene = Arc::new(Scene::built_in(name).unwrap());
        let entries = scene.method_list();
        Question { scene, entries, tick_hz: 60, throttle: 1.0, advice: false }
    }

    /// Thinks to the end. Returns how often it had to go on, and what the verdicts say.
    fn answer(thinker: &mut Thinker, question: &Question) -> (usize, Vec<String>) {
        thinker.ask(question.clone());
        let before = thinker.judged;
        while thinker.go_on() {}
        let findings = thinker.findings();
        assert!(findings.complete && findings.question == *question);
        let verdicts = findings.verdicts.iter().map(|found| found.as_ref().unwrap().to_string());
        (findings.verdicts.len() - before, verdicts.collect())
    }

    #[test]
    fn each_verdict_is_found_once_until_the_rate_the_throttle_or_the_scene_changes() {
        let first = question("harbour");
        let mut thinker = Thinker::new(first.clone());
        let (count, fine) = answer(&mut thinker, &first);
        assert_eq!(count, METHODS.len());
        assert_eq!(answer(&mut thinker, &first), (0, fine.clone()));
        let (count, coarse) = answer(&mut thinker, &Question { tick_hz: 20, ..first.clone() });
        assert_eq!(count, METHODS.len());
        assert!(coarse != fine);
        let slower = Question { tick_hz: 20, throttle: 0.5, ..first.clone() };
        assert_eq!(answer(&mut thinker, &slower).0, METHODS.len());
        assert_eq!(answer(&mut thinker, &first), (METHODS.len(), fine));
        assert_eq!(answer(&mut thinker, &question("spring")).0, METHODS.len());
    }

    #[test]
    fn a_verdict_is_of_the_substeps_that_are_flown() {
        let plain = question("stiff");
        let mut thinker = Thinker::new(plain.clone());
        let (_, once) = answer(&mut thinker, &plain);
        let mut finer = plain.clone();
        let lane = finer.entries.iter_mut().find(|spec| spec.method.id == "rk4").unwrap();
        lane.substeps = 8;
        let (count, finer) = answer(&mut thinker, &finer);
        assert_eq!(count, METHODS.len());
        let changed: Vec<_> = (0..once.len()).filter(|&i| once[i] != finer[i]).collect();
        let rk4 = plain.entries.iter().position(|spec| spec.method.id == "rk4").unwrap();
        assert_eq!(changed, [rk4]);
        assert!(finer[rk4].starts_with("accurate"), "{}", finer[rk4]);
    }

    #[test]
    fn what_was_found_at_another_rate_stands_until_it_is_found_anew() {
        let first = question("spring");
        let mut thinker = Thinker::new(first.clone());
        answer(&mut thinker, &first);
        thinker.ask(Question { tick_hz: 20, ..first });
        assert!(thinker.findings().verdicts.iter().all(Option::is_some));
        assert!(!thinker.findings().complete);
    }

    #[test]
    fn advice_is_thought_of_bit_by_bit_and_only_when_asked_for() {
        let unasked = question("spring");
        let mut thinker = Thinker::new(unasked.clone());
        answer(&mut thinker, &unasked);
        assert!(thinker.findings().advice.is_none());
        thinker.ask(Question { advice: true, ..unasked });
        let bits = 1 + (0..).take_while(|_| thinker.go_on()).count();
        assert!((3..2000).contains(&bits), "{bits} times");
        let advice = thinker.findings().advice.unwrap();
        assert_eq!([advice.advised.len(), advice.wanted], [METHODS.len(); 2]);
        assert!(thinker.findings().complete);
    }
}
