//! The guide and the hints of a lab: how a stop is opened, and when its task is done.

use super::Lab;
use crate::lab::command::Command;
use crate::lab::guide::{Hints, STOPS, Situation, Stop, Tour, suits_race};
use crate::lab::interpolation::Interpolation;
use crate::lab::race::Mode;
use crate::lab::scene::SCENES;

impl Lab {
    /// What to try next: the scene's own hint, then what follows on it. Keys stand between backticks.
    pub fn hint(&self) -> Option<String> {
        if let Some(tour) = &self.viewer.tour {
            let is_last = tour.place() + 1 == STOPS.len();
            let next = match is_last {
                true => "That was the last stop. Press `Esc` to close the guide.",
                false => "Press `Page Down` for the next stop, or `Esc` to close the guide.",
            };
            return Some(if tour.is_done() { next } else { tour.stop().task }.to_owned());
        }
        let entry = self.active();
        let outcome = self.viewer.verdict(entry).map(|verdict| verdict.outcome);
        let flown = (self.entries()[entry].method.name, outcome);
        let suits = |hint: &&str| self.mode() == Mode::Solo || suits_race(hint);
        self.viewer.hints.text(self.scene().hint.as_deref().filter(suits), flown)
    }

    /// Shows the hints from the first one again: for a driver that has set up the lab by commands.
    pub fn begin_hints(&mut self) {
        self.viewer.hints = Hints::default();
        if self.mode() == Mode::Race {
            self.viewer.hints.see(&Command::ToggleRace, None);
        }
    }

    /// Opens the guide where it was left, or closes it.
    pub(super) fn toggle_guide(&mut self) {
        match self.viewer.tour.take() {
            Some(tour) => self.viewer.left_at = tour.place(),
            None => self.go_to_stop(self.viewer.left_at),
        }
    }

    /// Opens this stop of the guide: its scene from the start, running in real time, under its method and rate.
    pub(super) fn go_to_stop(&mut self, place: usize) {
        let tour = Tour::at(place);
        let Stop { scene, method, tick_hz, mode, .. } = *tour.stop();
        let listed = SCENES.iter().position(|built_in| built_in.name == scene);
        self.open(listed.expect("a stop names a built-in scene"));
        let method = self.entries().iter().position(|spec| spec.method.id == method);
        self.start.entry = method.expect("a stop names a method");
        self.start.tick_hz = tick_hz;
        self.start.mode = mode;
        self.restart();
        self.clock.set_speed_percent(100);
        self.running = true;
        self.viewer.display.interpolation = Interpolation::Hermite;
        self.viewer.tour = Some(tour);
    }

    /// Notes whether the task of the guide's stop is done.
    pub(super) fn look_at_goal(&mut self) {
        let Some(mut tour) = self.viewer.tour.take() else { return };
        if self.scene().name == tour.stop().scene {
            tour.look(&Situation {
                race: self.race(),
                method: self.entries()[self.active()].method.id,
                speed_percent: self.clock.speed_percent(),
                is_running: self.running,
                display: self.display(),
            });
        }
        self.viewer.tour = Some(tour);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::{Key, Scene, command_for};

    #[test]
    fn a_key_goes_to_the_next_stop_of_the_open_guide_and_stays_at_the_last() {
        let (next, _) = command_for(Key::PageDown).expect("a key of the table");
        let mut lab = Lab::new(Scene::built_in("spring").unwrap());
        lab.apply(next.clone());
        assert!(lab.viewer.tour.is_none(), "the guide is closed");
        lab.apply(Command::ToggleGuide);
        for place in (1..STOPS.len()).chain([STOPS.len() - 1]) {
            lab.apply(next.clone());
            assert_eq!(lab.viewer.tour.as_ref().map(Tour::place), Some(place));
        }
    }
}
