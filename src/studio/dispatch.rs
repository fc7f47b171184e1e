//! Passes commands on the run, and on the stage with a run or the loop lab, to the functions that execute them.

use super::Studio;
use super::acting::{
    act, menu_index, next_impact, pick, pick_beside, seek, set_lane, step_by, tell_of_the_future,
    toggle_equal_cost,
};
use super::bands::toggle_band;
use super::command::{RunCommand, SPEED_LADDER, StageCommand, TICK_LADDER};
use super::findings::select_best;
use super::looping::{
    end_opening, leave_loop_lab, method_beside, set_loop_method, show_in_loop_lab,
};
use super::opening::{open, open_beside, open_spring};
use super::restarting::{redo, restart, restart_keeping_run, undo};
use super::resting::watch_again;
use crate::loops::loop_lab::SLOWNESS;
use crate::run::METRICS;
use crate::run::race::Mode;
use crate::scene::Action;

/// Time for which futures are shown after a key has set the tick rate, in nanoseconds.
const FUTURES_NS: i64 = 1_000_000_000;

pub(super) fn carry_out_on_run(studio: &mut Studio, command: RunCommand) {
    let race = studio.race();
    match command {
        RunCommand::Act(action) => act(studio, action),
        RunCommand::SetLane(spec) => set_lane(studio, spec),
        RunCommand::SpeedPercent(percent) => studio.deck.clock.set_speed_percent(percent),
        RunCommand::ThrottleUp => act(studio, Action::Throttle(tenths(race.throttle(), 1.0))),
        RunCommand::ThrottleDown => act(studio, Action::Throttle(tenths(race.throttle(), -1.0))),
        RunCommand::RudderLeft => act(studio, Action::Rudder(tenths(race.rudder(), 1.0))),
        RunCommand::RudderRight => act(studio, Action::Rudder(tenths(race.rudder(), -1.0))),
        RunCommand::Seek(tick) => {
            studio.deck.running = false;
            seek(studio, tick);
            tell_of_the_future(studio, tick);
        }
        RunCommand::WatchAgain => watch_again(studio),
        RunCommand::Undo => undo(studio),
        RunCommand::Redo => redo(studio),
        RunCommand::NextInterpolation => studio.viewer.next_interpolation(),
        RunCommand::NextImpact => next_impact(studio),
        RunCommand::MapParameter(parameter) => {
            let view = &mut studio.viewer.view;
            view.mapped_parameter = Some((view.body, parameter));
        }
        RunCommand::Cloud(choice) => studio.viewer.preferences.display.cloud = choice,
        RunCommand::ToggleInspector => {
            let display = &mut studio.viewer.preferences.display;
            display.inspector = !display.inspector;
        }
        RunCommand::Seconds(seconds) => {
            studio.deck.set_start("the length", |start| start.set_seconds(seconds));
        }
        RunCommand::Hold(held) => studio.deck.held = Some(held),
        RunCommand::Pull(pulled) => studio.deck.pulled = Some(pulled),
        RunCommand::ToggleEqualCost => toggle_equal_cost(studio),
    }
}

/// Executes a command on the run, or on the loop lab while the stage shows it.
pub(super) fn carry_out_on_stage(studio: &mut Studio, command: StageCommand) {
    let has_lab = studio.loops.is_some();
    let display = &mut studio.viewer.preferences.display;
    let loops = studio.loops.as_mut().map(|open| &mut *open.lab);
    match (command, loops) {
        (StageCommand::Method(method), Some(_)) => set_loop_method(studio, method),
        (StageCommand::Method(method), None) => {
            if let Some(entry) = menu_index(studio, method) {
                pick(studio, entry);
            }
        }
        (StageCommand::MethodBeside(step), Some(loops)) => {
            let beside = method_beside(loops, step);
            set_loop_method(studio, beside);
        }
        (StageCommand::MethodBeside(step), None) => pick_beside(studio, step),
        (StageCommand::Pick(index), Some(loops)) => loops.select(index),
        (StageCommand::Pick(entry), None) => {
            let has_bands = !studio.bands().is_empty();
            let selected = if has_bands { toggle_band(studio, entry) } else { entry };
            pick(studio, selected);
        }
        (StageCommand::TickHz(tick_hz), Some(loops)) => loops.set_tick_hz(tick_hz),
        (StageCommand::TickHz(tick_hz), None) => act(studio, Action::TickHz(tick_hz)),
        (StageCommand::TickRate(step), loops) => {
            let of_run = studio.deck.race().tick_hz();
            let tick_hz = loops.map_or(of_run, |loops| loops.scene().tick_hz);
            if let Some(hz) = step.next_rung(&TICK_LADDER, tick_hz) {
                carry_out_on_stage(studio, StageCommand::TickHz(hz.into()));
                if !has_lab {
                    let viewer = &mut studio.viewer;
                    (viewer.futures_left_ns, viewer.futures_are_new) = (FUTURES_NS, true);
                }
            }
        }
        (StageCommand::Speed(step), Some(loops)) => {
            if let Some(slowness) = step.opposite().next_rung(&SLOWNESS, loops.slowness()) {
                loops.set_slowness(slowness);
            }
        }
        (StageCommand::Speed(step), None) => {
            let clock = &mut studio.deck.clock;
            if let Some(percent) = step.next_rung(&SPEED_LADDER, clock.speed_percent()) {
                clock.set_speed_percent(percent);
            }
        }
        (command @ (StageCommand::ToggleRace | StageCommand::OpenSpring), _) => {
            if leave_loop_lab(studio) {
                studio.viewer.measure_for(&command.clone().into());
            }
            match command {
                StageCommand::ToggleRace => toggle_race(studio),
                _ => open_spring(studio),
            }
        }
        (StageCommand::Tick(step), _) => step_by(studio, step.sign()),
        (StageCommand::Second(step), loops) => {
            let of_run = studio.deck.race().tick_hz().hz().round().max(1.0);
            let rate = loops.map_or(of_run, |loops| loops.chosen_trace().refresh().hz().round());
            step_by(studio, step.sign() * rate as i64);
        }
        (StageCommand::Restart, Some(loops)) => loops.seek(0),
        (StageCommand::Restart, None) => restart_by_hand(studio),
        (StageCommand::Scene(index), _) => open_on_stage(studio, |studio| open(studio, index)),
        (StageCommand::SceneBeside(step), _) => {
            open_on_stage(studio, |studio| open_beside(studio, step))
        }
        (StageCommand::Body(body), _) => open_on_stage(studio, |studio| {
            studio.viewer.view.body = body.min(studio.scene().bodies.len() - 1);
        }),
        (StageCommand::ToggleArrangement, Some(loops)) => loops.is_overlaid = !loops.is_overlaid,
        (StageCommand::ToggleArrangement, None) => studio.viewer.toggle_arrangement(),
        (StageCommand::Instrument(instrument), Some(_)) if !instrument.is_in_loop_lab() => {
            let name = instrument.name();
            studio.viewer.set_notice(format!("{name} is not in the loop lab: L leaves it"));
        }
        (StageCommand::Instrument(instrument), _) => return display.instrument = instrument,
        (StageCommand::InstrumentBeside(step), Some(loops)) => {
            loops.choose_trace(step.cyclic_index(loops.trace(), loops.traces().len()));
        }
        (StageCommand::InstrumentBeside(step), None) => loop {
            display.instrument = display.instrument.neighbour(step);
            if display.instrument.is_of(studio.deck.scene()) {
                break;
            }
        },
        (StageCommand::Metric(index), Some(loops)) => loops.set_metric(index),
        (StageCommand::Metric(index), None) => display.metric = index.min(METRICS.len() - 1),
    }
    end_opening(studio);
}

/// Calls `open`, which shows another body, and shows that body in the loop lab too if the lab is open. Playback of an
/// open lab goes on as before.
fn open_on_stage(studio: &mut Studio, open: impl FnOnce(&mut Studio)) {
    let running = studio.deck.running;
    open(studio);
    if studio.loops.is_some() {
        studio.deck.running = running;
        show_in_loop_lab(studio);
    }
}

/// Restarts the run, with the whole stage in view.
fn restart_by_hand(studio: &mut Studio) {
    studio.viewer.view.zoom_pans.clear();
    studio.viewer.view.bands = None;
    // A hint suggests the next step, and the old run is a click away on the timeline.
    if restart_keeping_run(studio) && studio.hint().is_none() {
        studio.viewer.set_notice("restarted: Ctrl Z brings the run back");
    }
}

/// Switches between solo and race. Later scenes open in the chosen mode, unless the guide is open.
fn toggle_race(studio: &mut Studio) {
    match studio.mode() {
        Mode::Solo => {
            restart(studio, Some("the race"), |next| next.mode = Mode::Race);
            select_best(studio);
        }
        Mode::Race => {
            let lane = studio.selected().id;
            act(studio, Action::Solo { lane });
            studio.deck.run.next_mut().mode = Mode::Solo;
            // The notice may be about a lane that has left the race.
            studio.viewer.notice = None;
        }
    }
    if studio.viewer.tour.is_none() {
        studio.viewer.preferences.choose_mode(studio.deck.mode(), studio.deck.scene());
    }
}

/// Returns `part` plus `more` tenths, rounded to tenths. Because of the rounding, ten steps up and ten steps down end
/// at the initial value.
fn tenths(part: f64, more: f64) -> f64 {
    ((part * 10.0).round() + more) / 10.0
}
