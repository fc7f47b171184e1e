//! What a lab wants to know of its methods, and what it learns.

use std::sync::Arc;

use super::Lab;
use crate::lab::action::Action;
use crate::lab::analysis::{Findings, Question, Thinker};
use crate::lab::display::Instrument;
use crate::lab::journal::{JournalRow, Source};

impl Lab {
    /// What there is to be found out: a verdict on each method of the list at the present tick rate and
    /// throttle, and advice while it is shown. For a [`Thinker`].
    pub fn question(&self) -> Question {
        Question {
            scene: Arc::clone(&self.start.scene),
            entries: self.entries().to_vec(),
            tick_hz: self.clock.tick_hz(),
            throttle: self.throttle_by_hand(),
            advice: self.display().instrument == Instrument::Advice,
        }
    }

    /// The throttle that a person has set since the start, or else that of the start: what the script sets is in the
    /// scene that is judged.
    fn throttle_by_hand(&self) -> f64 {
        let race = self.race();
        let done = race.journal().rows()[..race.done()].iter();
        let set = done.filter(|row| row.source == Source::Hand).rev();
        let throttle = |row: &JournalRow| match row.action {
            Action::Throttle(part) => Some(part.clamp(-1.0, 1.0)),
            _ => None,
        };
        set.into_iter().find_map(throttle).unwrap_or(1.0)
    }

    /// Takes in what was found out, unless it is of another scene.
    pub fn learn(&mut self, findings: Findings) {
        if findings.question.is_of(&self.start.scene) {
            self.viewer.findings = Some(findings);
        }
    }

    /// Finds out here and now whatever there is to be.
    pub fn think(&mut self) {
        let question = self.question();
        let known = &self.viewer.findings;
        if !known.as_ref().is_some_and(|known| known.answer(&question)) {
            self.learn(Thinker::new(question).finish());
        }
    }
}
