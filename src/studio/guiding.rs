//! The guide and the hints of a studio. Opens stops, and notes when their tasks are done.

use super::Studio;
use super::ahead::without_futures;
use super::deck::LeftRun;
use super::display::Display;
use super::guide::{Goal, HintContext, STOPS, Stop, Tour};
use super::opening::open_with;
use super::restarting::{Jump, follow};
use super::resting::rest_hint;
use super::step::Step;
use crate::measure::Outcome;
use crate::run::Metric;
use crate::run::past::Quantity;
use crate::run::race::Interpolation;
use crate::scene::{SCENES, SceneBody};

/// Returns the index of the metric that is the error of this quantity.
fn error_of(quantity: Quantity) -> usize {
    match quantity {
        Quantity::Position => Metric::POSITION_ERROR,
        Quantity::Velocity => Metric::VELOCITY_ERROR,
    }
}

/// Returns the state of the studio on which goals and hints depend.
fn hint_context(studio: &Studio) -> HintContext<'_> {
    let own = &studio.deck.scene_as_opened().bodies;
    let has_own_values = |(index, body): (usize, &SceneBody)| {
        body.values == studio.race().values(index)
            && body.values == studio.scene().bodies[index].values
    };
    HintContext {
        has_own_values: own.iter().enumerate().all(has_own_values),
        scene: studio.scene(),
        race: studio.race(),
        menu: studio.entries(),
        active: studio.active(),
        is_from_the_start: !studio.deck.was_changed_on_the_way(),
        speed_percent: studio.deck.clock.speed_percent(),
        is_paused: !studio.deck.running && !studio.deck.comes_to_rest(studio.viewer.motion()),
        is_in_loop_lab: studio.loops.is_some(),
        has_bands: !studio.bands().is_empty(),
        is_lost: studio.deck.lost_at().is_some(),
        display: studio.display(),
    }
}

/// Opens the guide where the person left it, or closes it.
pub(super) fn toggle_guide(studio: &mut Studio) {
    if studio.viewer.close_guide() {
        return_from_guide(studio);
    } else {
        go_to_stop(studio, studio.viewer.preferences.left_at);
    }
}

/// Closes the guide, and brings back the run that the person left for it. Returns whether there was a guide or a run.
pub(super) fn close_guide(studio: &mut Studio) -> bool {
    let was_open = studio.viewer.close_guide();
    return_from_guide(studio) || was_open
}

/// Brings back the run that the person left for the guide, with the person's view of it. Returns whether there was such
/// a run.
pub(super) fn return_from_guide(studio: &mut Studio) -> bool {
    let Some(left) = studio.deck.left.take() else { return false };
    let LeftRun { deck: own, view, display: before } = *left;
    let stop = std::mem::replace(&mut studio.deck, own);
    // A file on the list may have changed meanwhile, so the newer list stays.
    let open = studio.deck.scene_list.open();
    studio.deck.scene_list = stop.scene_list;
    studio.deck.scene_list.set_open(open);
    studio.deck.openings = stop.openings + 1;
    studio.viewer = studio.viewer.before_next_scene();
    (studio.viewer.view, studio.viewer.hints) = (view, studio.viewer.hints_of_left.clone());
    let display = &mut studio.viewer.preferences.display;
    *display = Display {
        measure: before.measure,
        instrument: before.instrument,
        enlarged: before.enlarged,
        quantity: before.quantity,
        metric: before.metric,
        interpolation: before.interpolation,
        ..display.clone()
    };
    follow(studio, Jump::OverAnEdit);
    true
}

/// Opens the next or the previous stop, if the guide is open and has one.
pub(super) fn go_to_stop_beside(studio: &mut Studio, step: Step) {
    let Some(tour) = &studio.viewer.tour else { return };
    let index =
        tour.index().checked_add_signed(step.sign() as isize).filter(|index| *index < STOPS.len());
    if let Some(index) = index {
        go_to_stop(studio, index);
    }
}

/// Opens this stop of the guide: its scene at the start, under the stop's method and rate, and the stop's instrument.
/// Time stands still until the person predicts.
pub(super) fn go_to_stop(studio: &mut Studio, index: usize) {
    let (view, display) = (studio.viewer.view.clone(), studio.viewer.preferences.display.clone());
    let hints = studio.viewer.hints.clone();
    studio.viewer.tour = None;
    let tour = Tour::at(index);
    let Stop { scene, method, tick_hz, mode, instrument, quantity, .. } = *tour.stop();
    let listed = SCENES.iter().position(|built_in| built_in.name == scene);
    let listed = listed.expect("a stop names a built-in scene");
    let mut before = open_with(studio, listed, |next| {
        let method = next.list.iter().position(|spec| spec.method.id == method);
        next.entry = method.expect("a stop names a method");
        next.tick_hz = tick_hz.into();
        next.mode = mode;
    });
    studio.deck.left = before.left.take().or_else(|| {
        studio.viewer.preferences.display.measure = true;
        studio.viewer.hints_of_left = hints;
        Some(Box::new(LeftRun { deck: before, view, display }))
    });
    studio.deck.clock.set_speed_percent(100);
    studio.deck.running = false;
    // A scene of clouds would open with the cloud in place of the stage.
    studio.viewer.preferences.display.enlarged = false;
    studio.viewer.preferences.display.instrument = instrument;
    studio.viewer.preferences.display.quantity = Some(quantity);
    studio.viewer.preferences.display.metric = error_of(quantity);
    studio.viewer.preferences.display.interpolation = Interpolation::default();
    studio.viewer.tour = Some(tour);
}

/// Marks the stop's task as done if its goal is met and the person has predicted. `was_asked` is whether the stop
/// waited for a prediction before the command. If it did and no longer does, time starts, unless the task is to step.
pub(super) fn look_at_goal(studio: &mut Studio, was_asked: bool) {
    let Some(mut tour) = studio.viewer.tour.take() else { return };
    if tour.is_asking() {
        // A command that restarts the run would start it.
        studio.deck.running = false;
    } else {
        let is_stepped = matches!(tour.stop().goal, Goal::SteppedTo(_));
        studio.deck.running |= was_asked && !is_stepped && studio.race().tick() == 0;
        tour.check_goal(&hint_context(studio));
    }
    studio.viewer.tour = Some(tour);
}

/// Returns the hint while a person holds the tick rate or looks at futures.
fn fan_hint(studio: &Studio) -> Option<String> {
    let shows_fan = studio.display().futures && !studio.deck.time_runs() && studio.loops.is_none();
    let hint = match (studio.deck.tick_rate_is_held, studio.deck.running) {
        (true, true) => "Let go, and time runs on at this rate. `Esc` brings the old one back.",
        (true, false) => "Let go to keep this rate. `Esc` brings the old one back.",
        (false, _) if shows_fan => {
            let found = without_futures(&studio.deck, studio.viewer.view.body);
            let found = found.unwrap_or("Where do the threads part?");
            return Some(format!("{found} `F` or `Esc` closes the fan, `Space` runs on."));
        }
        _ => return None,
    };
    Some(hint.to_owned())
}

impl Studio {
    /// Returns the next thing to try, which a run at rest, the guide, the scene or the program suggests. Keys stand
    /// between backticks.
    pub fn hint(&self) -> Option<String> {
        if let Some(rest) = rest_hint(self) {
            return Some(rest);
        }
        if let Some(tour) = &self.viewer.tour {
            let is_last = tour.index() + 1 == STOPS.len();
            let next = match (tour.is_done(), is_last) {
                _ if tour.is_asking() => {
                    "Time and numbers wait for your prediction. `Page Down` skips it, `Esc` closes the guide."
                }
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
        if let Some(fan) = fan_hint(self) {
            return Some(fan);
        }
        let from_start =
            self.viewer.verdict(self.active()).filter(|verdict| verdict.starts_at_s == 0.0);
        let outcome = from_start.map(|verdict| verdict.outcome());
        let mut now = hint_context(self);
        now.is_lost |= matches!(outcome, Some(Outcome::BlewUp | Outcome::GaveUp));
        self.viewer.hints.text(&now, outcome)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::command::{Command, RunCommand, StageCommand, ViewCommand};
    use crate::run::METRICS;
    use crate::scene::Scene;
    use crate::{Key, Studio, command_for};

    #[test]
    fn leaving_the_guide_restores_the_settings_of_its_stops() {
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
    fn keys_walk_the_stops_of_the_open_guide_and_halt_at_its_ends() {
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
