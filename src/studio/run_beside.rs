//! The run as it goes on at its former tick rate, beside the run at the new one.

use super::compared::{MAX_TICKS, placed_at};
use crate::run::race::{LaneBody, Race};
use crate::scene::LaneId;
use crate::sim::TickRate;

/// A run as it was before the tick rate changed, and as it goes on without the change.
pub struct RunBeside {
    from: Race,
    race: Race,
    at_s: f64,
}

impl RunBeside {
    /// Creates the run that goes on from here at its own tick rate.
    pub(super) fn new(from: Race) -> Self {
        Self { race: from.clone(), at_s: from.t(), from }
    }

    /// Returns the tick rate.
    pub fn tick_hz(&self) -> TickRate {
        self.race.tick_hz()
    }

    /// Returns the moment (s) at which it began.
    pub(super) fn begins_at_s(&self) -> f64 {
        self.from.t()
    }

    /// Returns a body of a lane, and its coordinates at the displayed moment of the run beside. Returns `None` before
    /// the moment at which it began, and for a body that has halted.
    pub fn body(&self, lane: LaneId, index: usize) -> Option<(&LaneBody, Vec<f64>)> {
        let body = self.race.entrant(lane)?.lane.bodies().get(index)?;
        let is_shown = self.at_s >= self.from.t() && body.halted().is_none();
        is_shown.then(|| (body, placed_at(&self.race, body, self.at_s)))
    }

    /// Moves to the first tick at or after the moment `at_s` (s).
    pub(super) fn go_to(&mut self, at_s: f64) {
        if at_s < self.race.t() - self.race.last_step_s() {
            self.race = self.from.clone();
        }
        self.at_s = at_s;
        for _ in 0..MAX_TICKS {
            if self.race.t() >= at_s {
                break;
            }
            self.race.step(&mut ());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Action, Scene};
    use crate::{RunCommand, StageCommand, Studio};

    fn ticked(ticks: u64) -> Studio {
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        (0..ticks).for_each(|_| studio.tick());
        studio
    }

    fn beside(studio: &Studio) -> Option<(TickRate, f64)> {
        let beside = studio.deck.run_beside()?;
        Some((beside.tick_hz(), beside.body(studio.selected().id, 0)?.1[0]))
    }

    fn place(studio: &Studio) -> f64 {
        studio.selected().lane.bodies()[0].stepper.q()[0]
    }

    #[test]
    fn the_run_at_the_former_rate_goes_on_beside_and_from_the_start_after_a_restart() {
        let mut studio = ticked(60);
        assert_eq!(beside(&studio), None);
        studio.apply(StageCommand::TickHz(40.into()));
        studio.apply(StageCommand::TickHz(30.into()));
        (0..30).for_each(|_| studio.tick());
        let at_two_s = Some((60.into(), place(&ticked(120))));
        assert_eq!(beside(&studio), at_two_s, "the first rate, not one on the way");
        studio.apply(RunCommand::Seek(45));
        assert_eq!(beside(&studio), None, "it was the same run");
        studio.apply(RunCommand::Seek(90));
        assert_eq!(beside(&studio), at_two_s);
        studio.apply(StageCommand::Restart);
        (0..30).for_each(|_| studio.tick());
        assert_eq!(beside(&studio), Some((60.into(), place(&ticked(60)))));
        studio.apply(StageCommand::TickHz(60.into()));
        assert_eq!(beside(&studio), None, "the run has this rate itself");
    }

    #[test]
    fn another_action_an_undo_and_another_scene_end_the_run_beside() {
        let ends: [fn(&mut Studio); 3] = [
            |studio| _ = studio.apply(RunCommand::Act(Action::Kick(1.0))),
            |studio| _ = studio.apply(RunCommand::Undo),
            |studio| _ = studio.apply(StageCommand::Scene(0)),
        ];
        for end in ends {
            let mut studio = ticked(60);
            studio.apply(StageCommand::TickHz(30.into()));
            assert!(beside(&studio).is_some());
            end(&mut studio);
            assert_eq!(beside(&studio), None);
        }
    }

    #[test]
    fn a_lane_says_for_a_moment_from_which_method_it_was_switched() {
        let mut studio = ticked(60);
        let from = |studio: &Studio| studio.deck.switched_from(studio.selected());
        assert_eq!(from(&studio), None);
        studio.apply(StageCommand::Pick(1));
        assert_eq!(from(&studio), Some(0));
        studio.apply(StageCommand::Pick(3));
        (0..60).for_each(|_| studio.tick());
        assert_eq!(from(&studio), Some(1));
        (0..60).for_each(|_| studio.tick());
        assert_eq!(from(&studio), None);
    }
}
