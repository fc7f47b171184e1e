//! The guide and the hints of a studio: how a stop is opened, and when its task is done.

use super::Studio;
use super::guide::{Chosen, Goal, Hints, STOPS, Situation, Stop, Tour};
use super::step::Step;
use crate::run::Metric;
use crate::run::past::Quantity;
use crate::run::race::{Author, Interpolation};
use crate::scene::SCENES;

impl Studio {
    /// What to try next: the scene's own hint, then what follows on it. Keys stand between backticks.
    pub fn hint(&self) -> Option<String> {
        if let Some(rest) = self.rest_hint() {
            return Some(rest);
        }
        if let Some(tour) = &self.viewer.tour {
            let is_last = tour.index() + 1 == STOPS.len();
            let next = match (tour.is_done(), is_last) {
                (true, true) => "That was the last stop. Press `Esc` to close the guide.",
                (true, false) => {
                    "Press `Page Down` for the next stop, or `Esc` to close the guide."
                }
                (false, _) => {
                    "`Page Down` goes to the next stop, `Page Up` back, `Esc` closes the guide."
                }
            };
            return Some(next.to_owned());
        }
        let outcome = self.viewer.verdict(self.active()).map(|verdict| verdict.outcome());
        self.viewer.hints.text(&self.situation(), outcome)
    }

    /// What it is doing, as far as goals and hints ask.
    fn situation(&self) -> Situation<'_> {
        Situation {
            scene: self.scene(),
            race: self.race(),
            menu: self.entries(),
            active: self.active(),
            is_from_the_start: !self.was_changed_on_the_way(),
            speed_percent: self.clock.speed_percent(),
            is_paused: !self.running && !self.comes_to_rest(),
            is_in_loop_lab: self.loop_lab().is_some(),
            display: self.display(),
        }
    }

    /// Whether a person has acted since the start, so that the run from the start is another.
    pub(crate) fn was_changed_on_the_way(&self) -> bool {
        let race = self.race();
        let rows = &race.journal().rows()[..race.done()];
        rows.iter().any(|row| row.tick > 0 && row.author == Author::Person)
    }

    /// Whether the run on the screen is another than the judged one: a person has changed it since on its way.
    pub fn is_judged_apart(&self) -> bool {
        self.run().starts().was_changed_since_judged(self.race())
    }

    /// Shows the hints from the first one again: for a driver that has set up the studio by commands.
    pub fn begin_hints(&mut self) {
        self.viewer.hints = Hints::default();
    }

    /// Opens the guide where it was left, or closes it.
    pub(super) fn toggle_guide(&mut self) {
        if !self.close_guide() {
            self.go_to_stop(self.viewer.preferences.left_at);
        }
    }

    /// Closes the guide, as what it tells of is no longer shown.
    pub(super) fn leave_guide(&mut self) {
        if self.close_guide() {
            self.viewer.set_notice("the guide is closed: F2 opens it where you left it");
        }
    }

    /// Closes the guide and shows again what the person chose before it. Scene, run and instrument stay: they are in sight.
    /// Returns whether the guide was open.
    pub(super) fn close_guide(&mut self) -> bool {
        let Some(tour) = self.viewer.tour.take() else { return false };
        self.viewer.preferences.left_at = tour.index();
        tour.before().restore(&mut self.viewer.preferences.display);
        true
    }

    /// Opens the stop this many further on, if the guide is open and has one.
    pub(super) fn go_to_stop_beside(&mut self, step: Step) {
        let Some(tour) = &self.viewer.tour else { return };
        let index = tour
            .index()
            .checked_add_signed(step.sign() as isize)
            .filter(|index| *index < STOPS.len());
        index.into_iter().for_each(|index| self.go_to_stop(index));
    }

    /// Opens this stop of the guide: its scene from the start under its method and rate, and its instrument. Time runs,
    /// unless a person is to step.
    pub(super) fn go_to_stop(&mut self, index: usize) {
        let display = &self.viewer.preferences.display;
        let before = self.viewer.tour.take().map_or_else(|| Chosen::of(display), |t| t.before());
        let tour = Tour::at(index, before);
        let Stop { scene, method, tick_hz, mode, instrument, quantity, goal, .. } = *tour.stop();
        let listed = SCENES.iter().position(|built_in| built_in.name == scene);
        self.open_with(listed.expect("a stop names a built-in scene"), |next| {
            let method = next.list.iter().position(|spec| spec.method.id == method);
            next.entry = method.expect("a stop names a method");
            next.tick_hz = tick_hz;
            next.mode = mode;
        });
        self.clock.set_speed_percent(100);
        self.running = !matches!(goal, Goal::SteppedTo(_));
        // A scene of clouds opens with them in the place of the stage.
        self.viewer.preferences.display.enlarged = false;
        self.viewer.preferences.display.instrument = instrument;
        self.viewer.preferences.display.quantity = Some(quantity);
        self.viewer.preferences.display.metric = error_of(quantity);
        self.viewer.preferences.display.interpolation = Interpolation::default();
        self.viewer.tour = Some(tour);
    }

    /// Notes whether the task of the guide's stop is done.
    pub(super) fn look_at_goal(&mut self) {
        let Some(mut tour) = self.viewer.tour.take() else { return };
        tour.look(&self.situation());
        self.viewer.tour = Some(tour);
    }
}

/// The index of the metric that compares this quantity with the truth's.
fn error_of(quantity: Quantity) -> usize {
    match quantity {
        Quantity::Position => Metric::POSITION_ERROR,
        Quantity::Velocity => Metric::VELOCITY_ERROR,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::METRICS;
    use crate::scene::Scene;
    use crate::studio::command::{Command, RunCommand, StageCommand, ViewCommand};
    use crate::studio::{Key, command_for};

    #[test]
    fn what_a_stop_sets_without_saying_so_is_undone_when_the_guide_is_left() {
        let chosen = |studio: &Studio| {
            let display = studio.display();
            (display.quantity, display.metric, display.interpolation)
        };
        for (close, stops) in [
            (Command::View(ViewCommand::Escape), 1),
            (Command::View(ViewCommand::ToggleGuide), 4),
            (Command::Stage(StageCommand::SceneBeside(Step::Next)), 14),
        ] {
            let mut studio = Studio::new(Scene::built_in("spring").unwrap());
            studio.apply(StageCommand::Metric(METRICS.len() - 1));
            studio.apply(RunCommand::NextInterpolation);
            let before = chosen(&studio);
            studio.apply(ViewCommand::ToggleGuide);
            (0..stops).for_each(|_| _ = studio.apply(ViewCommand::StopBeside(Step::Next)));
            assert_ne!(chosen(&studio), before);
            studio.apply(RunCommand::NextInterpolation);
            studio.apply(close.clone());
            assert!(studio.viewer.tour.is_none() && chosen(&studio) == before, "{close:?}");
        }
    }

    #[test]
    fn keys_go_through_the_stops_of_the_open_guide_both_ways_and_stay_at_its_ends() {
        let [next, back] = [Key::PageDown, Key::PageUp].map(|key| command_for(key).unwrap().0);
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        studio.apply(next.clone());
        studio.apply(back.clone());
        assert!(studio.viewer.tour.is_none(), "the guide is closed");
        studio.apply(ViewCommand::ToggleGuide);
        let last = STOPS.len() - 1;
        for (command, indices) in [
            (next, (1..=last).chain([last]).collect::<Vec<_>>()),
            (back, (0..last).rev().chain([0]).collect()),
        ] {
            for index in indices {
                studio.apply(command.clone());
                assert_eq!(studio.viewer.tour.as_ref().map(Tour::index), Some(index));
            }
        }
    }
}
