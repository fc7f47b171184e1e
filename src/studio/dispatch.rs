//! Passes commands on the run to the functions that execute them, and so commands on the stage while it shows the run.
//!
//! A command has the same effect whether it comes from a key, a panel, a script or a test. Its rules therefore stand in
//! the function that executes it, and never in the panel with its button. The loop lab refuses commands on the run, and
//! has its own meaning for commands on the stage.

use super::acting::{
    act, menu_index, next_impact, pick, pick_beside, seek, set_lane, step_by, tell_of_the_future,
    toggle_equal_cost,
};
use super::bands::{bands, toggle_band};
use super::command::{RunCommand, SPEED_LADDER, StageCommand, TICK_LADDER};
use super::deck::Deck;
use super::findings::select_best;
use super::guiding::hint;
use super::opening::{open, open_beside, open_spring};
use super::restarting::{redo, restart, restart_keeping_run, undo};
use super::resting::watch_again;
use super::viewer::Viewer;
use crate::run::METRICS;
use crate::run::race::Mode;
use crate::scene::Action;

/// Time for which futures are shown after a key has set the tick rate, in nanoseconds.
const FUTURES_NS: i64 = 1_000_000_000;

pub(super) fn carry_out_on_run(deck: &mut Deck, viewer: &mut Viewer, command: RunCommand) {
    let race = deck.race();
    match command {
        RunCommand::Act(action) => act(deck, viewer, action),
        RunCommand::SetLane(spec) => set_lane(deck, viewer, spec),
        RunCommand::SpeedPercent(percent) => deck.clock.set_speed_percent(percent),
        RunCommand::ThrottleUp => act(deck, viewer, Action::Throttle(tenths(race.throttle(), 1.0))),
        RunCommand::ThrottleDown => {
            act(deck, viewer, Action::Throttle(tenths(race.throttle(), -1.0)))
        }
        RunCommand::RudderLeft => act(deck, viewer, Action::Rudder(tenths(race.rudder(), 1.0))),
        RunCommand::RudderRight => act(deck, viewer, Action::Rudder(tenths(race.rudder(), -1.0))),
        RunCommand::Seek(tick) => {
            deck.running = false;
            seek(deck, viewer, tick);
            tell_of_the_future(deck, viewer, tick);
        }
        RunCommand::WatchAgain => watch_again(deck, viewer),
        RunCommand::Undo => undo(deck, viewer),
        RunCommand::Redo => redo(deck, viewer),
        RunCommand::NextInterpolation => viewer.next_interpolation(),
        RunCommand::NextImpact => next_impact(deck, viewer),
        RunCommand::MapParameter(parameter) => {
            let view = &mut viewer.view;
            view.mapped_parameter = Some((view.body, parameter));
        }
        RunCommand::Cloud(choice) => viewer.preferences.display.cloud = choice,
        RunCommand::ToggleInspector => {
            let display = &mut viewer.preferences.display;
            display.inspector = !display.inspector;
        }
        RunCommand::Seconds(seconds) => {
            deck.set_start("the length", |start| start.set_seconds(seconds));
        }
        RunCommand::Hold(held) => deck.held = Some(held),
        RunCommand::Pull(pulled) => deck.pulled = Some(pulled),
        RunCommand::ToggleEqualCost => toggle_equal_cost(deck, viewer),
    }
}

pub(super) fn carry_out_on_stage(deck: &mut Deck, viewer: &mut Viewer, command: StageCommand) {
    let race = deck.race();
    match command {
        StageCommand::Method(method) => {
            if let Some(entry) = menu_index(deck, viewer, method) {
                pick(deck, viewer, entry);
            }
        }
        StageCommand::Pick(entry) if bands(deck, viewer).is_empty() => pick(deck, viewer, entry),
        StageCommand::Pick(entry) => {
            let selected = toggle_band(deck, viewer, entry);
            pick(deck, viewer, selected);
        }
        StageCommand::MethodBeside(step) => pick_beside(deck, viewer, step),
        StageCommand::TickHz(tick_hz) => act(deck, viewer, Action::TickHz(tick_hz)),
        StageCommand::TickRate(step) => {
            if let Some(hz) = step.next_rung(&TICK_LADDER, race.tick_hz()) {
                act(deck, viewer, Action::TickHz(hz.into()));
                (viewer.futures_left_ns, viewer.futures_are_new) = (FUTURES_NS, true);
            }
        }
        StageCommand::Speed(step) => {
            if let Some(percent) = step.next_rung(&SPEED_LADDER, deck.clock.speed_percent()) {
                deck.clock.set_speed_percent(percent);
            }
        }
        StageCommand::ToggleRace => toggle_race(deck, viewer),
        StageCommand::Tick(step) => step_by(deck, viewer, step.sign()),
        StageCommand::Second(step) => {
            step_by(deck, viewer, step.sign() * race.tick_hz().hz().round().max(1.0) as i64)
        }
        StageCommand::Restart => {
            viewer.view.zoom_pans.clear();
            viewer.view.bands = None;
            // A hint suggests the next step, and the old run is a click away on the timeline.
            if restart_keeping_run(deck, viewer) && hint(deck, viewer, false).is_none() {
                viewer.set_notice("restarted: Ctrl Z brings the run back");
            }
        }
        StageCommand::Scene(index) => open(deck, viewer, index),
        StageCommand::SceneBeside(step) => open_beside(deck, viewer, step),
        StageCommand::ToggleArrangement => viewer.toggle_arrangement(),
        StageCommand::Instrument(instrument) => viewer.preferences.display.instrument = instrument,
        StageCommand::InstrumentBeside(step) => {
            let instrument = &mut viewer.preferences.display.instrument;
            *instrument = instrument.neighbour(step);
            while !instrument.is_of(deck.scene()) {
                *instrument = instrument.neighbour(step);
            }
        }
        StageCommand::Metric(index) => {
            viewer.preferences.display.metric = index.min(METRICS.len() - 1)
        }
        StageCommand::Body(body) => {
            viewer.view.body = body.min(deck.scene().bodies.len() - 1);
        }
        StageCommand::OpenSpring => open_spring(deck, viewer),
    }
}

/// Switches between solo and race. Later scenes open in the chosen mode, unless the guide is open.
fn toggle_race(deck: &mut Deck, viewer: &mut Viewer) {
    match deck.mode() {
        Mode::Solo => {
            restart(deck, viewer, Some("the race"), |next| next.mode = Mode::Race);
            select_best(deck, viewer);
        }
        Mode::Race => {
            let lane = deck.selected().id;
            act(deck, viewer, Action::Solo { lane });
            deck.run.next_mut().mode = Mode::Solo;
            // The notice may be about a lane that has left the race.
            viewer.notice = None;
        }
    }
    if viewer.tour.is_none() {
        viewer.preferences.choose_mode(deck.mode(), deck.scene());
    }
}

/// Returns `part` plus `more` tenths, rounded to tenths. Because of the rounding, ten steps up and ten steps down end
/// at the initial value.
fn tenths(part: f64, more: f64) -> f64 {
    ((part * 10.0).round() + more) / 10.0
}
