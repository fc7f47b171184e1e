//! A run that is watched comes to rest at its scene's length, and when all its bodies have blown up. The blow-up can be
//! watched again.
//!
//! A scene makes its point within its length, and after a blow-up the stage is empty. If the run went on by itself, a
//! person who looks away would miss both. Only a watched run rests: a capture or a test gets every tick that it asks
//! for.

use super::Studio;
use super::acting::seek;
use super::deck::Deck;
use super::display::Motion;
use crate::run::race::{Halt, Mode};
use crate::sim::number::{round, significant};

/// Time before a blow-up at which watching it again starts, in seconds, and its minimum in ticks.
const LEAD_S: f64 = 1.0;
const MIN_LEAD: u64 = 24;

impl Deck {
    /// Whether the run comes to rest at this tick.
    pub(super) fn comes_to_rest(&self, motion: Motion) -> bool {
        self.is_at_its_end(motion) || self.just_lost(motion).is_some()
    }

    /// Whether the run is at the end of the scene's length.
    fn is_at_its_end(&self, motion: Motion) -> bool {
        let race = self.race();
        let (late_s, half_s) = (race.t() - self.scene().seconds, race.last_step_s() / 2.0);
        late_s > -half_s && late_s <= half_s && motion == Motion::Live
    }

    /// Whether the run is not paused. A run that has come to rest by itself counts as not paused.
    pub fn runs_or_rests(&self, motion: Motion) -> bool {
        self.running || self.comes_to_rest(motion)
    }

    /// Returns the halt of the last body in the only lane, if that body has just halted.
    fn just_lost(&self, motion: Motion) -> Option<&Halt> {
        let are_lost = motion == Motion::Live
            && self.mode() == Mode::Solo
            && self.selected().lane.bodies().iter().all(|body| body.halted().is_some());
        self.last_halt().filter(|halt| are_lost && halt.tick + 1 == self.race().tick())
    }

    /// Returns the latest halt in the selected lane.
    fn last_halt(&self) -> Option<&Halt> {
        let bodies = self.selected().lane.bodies().iter();
        bodies.filter_map(|body| body.halted()).max_by_key(|halt| halt.tick)
    }

    /// Returns the tick of the latest halt in the selected lane.
    pub fn lost_at(&self) -> Option<u64> {
        self.last_halt().map(|halt| halt.tick)
    }
}

/// Returns the hint for a run at rest. Keys stand between backticks.
pub(super) fn rest_hint(studio: &Studio) -> Option<String> {
    if studio.deck.running || !studio.deck.comes_to_rest(studio.viewer.motion()) {
        return None;
    }
    if let Some(halt) = studio.deck.just_lost(studio.viewer.motion()) {
        let (name, how) = (studio.lane_name(studio.active()), halt.ending());
        let t = significant(halt.t, 3);
        return Some(format!(
            "{name} {how} at {t} s. `W` shows it again, `Home` starts over, `Space` goes on."
        ));
    }
    let seconds = round(studio.scene().seconds, 4);
    Some(format!("The {seconds} s of this scene are over. `Home` starts again, `Space` goes on."))
}

/// Rewinds to some time before the latest halt in the selected lane, and runs.
pub(super) fn watch_again(studio: &mut Studio) {
    let Some(tick) = studio.deck.lost_at() else {
        return studio.viewer.set_notice("nothing has halted in this lane");
    };
    let lead = ((LEAD_S * f64::from(studio.race().tick_hz())) as u64).max(MIN_LEAD);
    seek(studio, tick.saturating_sub(lead));
    studio.viewer.notice = None;
    studio.deck.running = true;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::driving::slow_motion;
    use crate::scene::{Action, Scene};
    use crate::{Command, RunCommand, StageCommand, Step, Studio, ViewCommand};

    /// Returns a studio that a person watches.
    fn watched(scene: &str) -> Studio {
        let mut studio = Studio::new(Scene::built_in(scene).unwrap());
        studio.viewer.preferences.display.motion = Motion::Live;
        studio
    }

    /// Lets time run for at most this number of seconds of real time.
    fn watch(studio: &mut Studio, seconds: u32) {
        for _ in 0..60 * seconds {
            if studio.running() {
                studio.advance(16_666_667);
            }
        }
    }

    #[test]
    fn a_watched_run_rests_once_at_the_length_of_its_scene() {
        let mut studio = watched("spring");
        // The time covers the scene's length, because nothing is slowed down.
        watch(&mut studio, 21);
        assert_eq!((studio.race().t(), studio.running()), (studio.scene().seconds, false));
        assert_eq!(slow_motion(&studio), 1000, "a swing that grows by itself is fast enough");
        let hint = studio.hint().expect("what to do");
        assert!(hint.contains("`Home`") && hint.contains("`Space`"), "{hint}");
        studio.apply(ViewCommand::TogglePause);
        watch(&mut studio, 2);
        assert!(studio.running() && studio.race().t() > studio.scene().seconds);
        assert!(!studio.hint().is_some_and(|hint| hint.contains("are over")));
    }

    #[test]
    fn an_undo_at_rest_resumes_the_run() {
        let mut studio = watched("spring");
        watch(&mut studio, 5);
        let switched = studio.race().tick();
        studio.apply(StageCommand::Pick(1));
        watch(&mut studio, 20);
        assert!(!studio.running());
        studio.apply(RunCommand::Undo);
        assert!(studio.running() && studio.race().tick() == switched, "nobody has paused it");
        watch(&mut studio, 20);
        let end = studio.race().tick();
        studio.apply(StageCommand::Pick(2));
        studio.apply(RunCommand::Undo);
        assert_eq!((studio.race().tick(), studio.running()), (end, false), "it rests there");
    }

    #[test]
    fn a_restart_runs_after_a_rest_and_stays_paused_after_a_pause() {
        let mut studio = watched("spring");
        watch(&mut studio, 21);
        assert!(!studio.running());
        studio.apply(StageCommand::Restart);
        assert_eq!((studio.race().tick(), studio.running()), (0, true));
        watch(&mut studio, 1);
        studio.apply(ViewCommand::TogglePause);
        studio.apply(StageCommand::Restart);
        assert_eq!((studio.race().tick(), studio.running()), (0, false));
    }

    #[test]
    fn a_run_rests_at_its_end_in_every_mode_and_the_next_run_starts_running() {
        let race = |studio: &mut Studio| _ = studio.apply(StageCommand::ToggleRace);
        let kick = |studio: &mut Studio| _ = studio.apply(RunCommand::Act(Action::Kick(1.0)));
        let guide = |studio: &mut Studio| {
            studio.apply(ViewCommand::GoToStop(9));
            studio.apply(ViewCommand::Predict(0));
        };
        let prepared: [fn(&mut Studio); 4] = [|_| {}, race, kick, guide];
        let opened = [
            Command::Stage(StageCommand::Restart),
            Command::Stage(StageCommand::SceneBeside(Step::Next)),
            Command::Stage(StageCommand::OpenSpring),
            Command::Run(RunCommand::Act(Action::Kick(1.0))),
        ];
        for (prepare, open) in
            prepared.iter().flat_map(|it| opened.iter().map(move |open| (it, open)))
        {
            let mut studio = watched("spring");
            prepare(&mut studio);
            while studio.running() && studio.race().t() < 21.0 {
                studio.advance(16_666_667);
            }
            assert_eq!((studio.race().t(), studio.running()), (20.0, false), "{open:?}");
            let hint = studio.hint().expect("what to do");
            assert!(hint.contains("are over") && hint.contains("`Home`"), "{hint}");
            studio.apply(open.clone());
            assert!(studio.running(), "{open:?}");
        }
        let mut studio = watched("spring");
        watch(&mut studio, 21);
        studio.apply(StageCommand::ToggleRace);
        assert!(studio.running() && studio.race().tick() == 0);
    }

    #[test]
    fn a_seek_into_the_future_stops_at_the_present_with_a_notice() {
        let mut studio = watched("spring");
        (0..120).for_each(|_| studio.tick());
        studio.apply(RunCommand::Seek(60));
        assert_eq!((studio.race().tick(), studio.viewer.notice.as_deref()), (60, None));
        studio.apply(RunCommand::Seek(600));
        assert_eq!((studio.race().tick(), studio.running()), (120, false));
        let told = studio.viewer.notice.as_deref().unwrap_or_default();
        assert!(told.contains("only reached 2 s"), "{told}");
        studio.apply(ViewCommand::TogglePause);
        studio.advance(16_666_667);
        assert_eq!(studio.viewer.notice.as_deref(), None, "the run has got further");
    }

    #[test]
    fn a_rest_does_not_count_as_the_pause_a_guide_stop_asks_for() {
        use crate::guide::{Goal, STOPS};
        let mut studio = watched("spring");
        let stop = STOPS.iter().position(|stop| stop.goal == Goal::Paused).unwrap();
        studio.apply(ViewCommand::GoToStop(stop));
        studio.apply(ViewCommand::Predict(0));
        let end = studio.scene().seconds;
        watch(&mut studio, end as u32 + 2);
        assert!(!studio.running());
        studio.apply(ViewCommand::ToggleGhost);
        assert!(!studio.viewer.tour().unwrap().is_done());
        studio.apply(ViewCommand::TogglePause);
        watch(&mut studio, 1);
        studio.apply(ViewCommand::TogglePause);
        assert!(studio.viewer.tour().unwrap().is_done());
    }

    #[test]
    fn recorded_and_timed_runs_never_rest() {
        let ends = |mut studio: Studio| {
            watch(&mut studio, 21);
            studio.race().t() > studio.scene().seconds
        };
        assert!(ends(Studio::new(Scene::built_in("spring").unwrap())), "nobody watches");
        let mut told = watched("spring");
        for _ in 0..60 * 21 {
            told.advance_in_time(10_000, 16_666_667, &mut || true, &mut ());
        }
        assert!(told.race().t() > told.scene().seconds);
    }

    #[test]
    fn a_blow_up_slows_rests_and_replays_to_the_bit() {
        let text = "title = 't'\ntick_hz = 60\nseconds = 20\nmethods = ['explicit-euler']\n\
             [[spring]]\nmass_kg = 1\nstiffness_n_per_m = 1e6\nx0_m = 1\n";
        let scene = Scene::parse("t.toml", text).unwrap();
        let mut frames = [Motion::Recorded, Motion::Live].map(|motion| {
            let mut studio = Studio::new(scene.clone());
            studio.viewer.preferences.display.motion = motion;
            let halts = |studio: &Studio| studio.deck.lost_at().is_some();
            let frames = (0..2000).take_while(|_| {
                studio.advance(16_666_667);
                !halts(&studio)
            });
            (frames.count(), studio)
        });
        let [(usual, plain), (slow, studio)] = &mut frames;
        assert!(*slow > 3 * *usual, "{slow} frames of what takes {usual}");
        assert_eq!(studio.deck.lost_at(), plain.deck.lost_at());
        assert!(!studio.running() && plain.running(), "it rests");
        assert!(studio.hint().is_some_and(|hint| hint.contains("blew up") && hint.contains("`W`")));
        let (end, hash) = (studio.race().tick(), studio.race().state_hash());
        studio.apply(RunCommand::WatchAgain);
        assert!(studio.running() && studio.race().tick() < end);
        watch(studio, 20);
        assert_eq!((studio.race().tick(), studio.race().state_hash()), (end, hash));
        assert!(!studio.running());
    }
}
