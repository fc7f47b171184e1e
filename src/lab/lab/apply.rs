//! The effects of commands: each becomes an [action](Action) on the run, or changes the display.

use std::mem::take;

use super::Lab;
use crate::lab::action::Action;
use crate::lab::command::{
    Command, Receiver, SCALE_LADDER, SPEED_LADDER, TICK_LADDER, USUAL_SCALE_PERCENT, rung_above,
    rung_below,
};
use crate::lab::display::DriverRequest;
use crate::lab::equal_cost::equal_cost;
use crate::lab::lane_id::LaneId;
use crate::lab::lane_spec::LaneSpec;
use crate::lab::loop_lab::{LoopCommand, LoopLab};
use crate::lab::metrics::METRICS;
use crate::lab::race::{ActionResult, Mode};
use crate::lab::session::StartSettings;
use crate::lab::viewer::Dialog;
use crate::sim::bodies::Acts;

impl Lab {
    /// Carries out a command. Returns what the driver has to do for it, if anything.
    pub fn apply(&mut self, command: Command) -> Option<DriverRequest> {
        self.viewer.hints.see(&command, self.start.scene.hint.as_deref());
        if !self.viewer.pointer_is_down {
            self.timeline.close_change();
        }
        let ran = self.time_runs();
        let request = self.carry_out(command);
        if !ran && self.time_runs() {
            self.run_on();
        }
        self.look_at_goal();
        request
    }

    pub(super) fn carry_out(&mut self, command: Command) -> Option<DriverRequest> {
        if self.loop_lab.is_some() {
            self.viewer.notice = None;
            match command.receiver() {
                Receiver::Run => {
                    self.set_notice("not in the loop lab: L leaves it");
                    self.loop_lab.iter_mut().for_each(LoopLab::end_opening);
                    return None;
                }
                Receiver::Stage => return self.carry_out_in_loop_lab(command),
                Receiver::Window => {}
            }
        }
        let race = self.race();
        match command {
            Command::Act(action) => self.act(action),
            Command::Method(method) => {
                let listed = self.entries().iter().position(|spec| spec.method == method);
                match (listed, self.scene().refusal(method)) {
                    (Some(entry), _) => self.pick(entry),
                    (None, Some(refusal)) => self.set_notice(refusal.to_string()),
                    (None, None) => unreachable!("every method that fits is on the list"),
                }
            }
            Command::Pick(entry) => self.pick(entry),
            Command::SetLane(spec) => self.set_lane(spec),
            Command::NextMethod => self.pick_beside(1),
            Command::PreviousMethod => self.pick_beside(-1),
            Command::TickHz(tick_hz) => self.act(Action::TickHz(tick_hz)),
            Command::TickRateUp => {
                let higher = rung_above(&TICK_LADDER, race.tick_hz());
                higher.into_iter().for_each(|hz| self.act(Action::TickHz(hz)));
            }
            Command::TickRateDown => {
                let lower = rung_below(&TICK_LADDER, race.tick_hz());
                lower.into_iter().for_each(|hz| self.act(Action::TickHz(hz)));
            }
            Command::SpeedPercent(percent) => self.clock.set_speed_percent(percent),
            Command::SpeedUp => {
                let faster = rung_above(&SPEED_LADDER, self.clock.speed_percent());
                faster.into_iter().for_each(|percent| self.clock.set_speed_percent(percent));
            }
            Command::SpeedDown => {
                let slower = rung_below(&SPEED_LADDER, self.clock.speed_percent());
                slower.into_iter().for_each(|percent| self.clock.set_speed_percent(percent));
            }
            Command::ThrottleUp => self.act(Action::Throttle(tenths(race.throttle(), 1.0))),
            Command::ThrottleDown => self.act(Action::Throttle(tenths(race.throttle(), -1.0))),
            Command::RudderLeft => self.act(Action::Rudder(tenths(race.rudder(), 1.0))),
            Command::RudderRight => self.act(Action::Rudder(tenths(race.rudder(), -1.0))),
            Command::ToggleRace => match race.mode() {
                Mode::Solo => {
                    self.keep_run("the race");
                    self.start.mode = Mode::Race;
                    self.restart();
                }
                Mode::Race => {
                    let lane = self.selected().id;
                    self.act(Action::Solo { lane });
                    self.start.mode = Mode::Solo;
                    // It may be about a lane that has left the race.
                    self.viewer.notice = None;
                }
            },
            Command::Loop(LoopCommand::ToggleLab) => self.open_loop_lab(),
            // The loop lab is closed.
            Command::Loop(_) => {}
            Command::TogglePause => self.running = !self.running,
            Command::TickForward => self.step_by(1),
            Command::TickBack => self.step_by(-1),
            Command::SecondForward => self.step_by(i64::from(race.tick_hz())),
            Command::SecondBack => self.step_by(-i64::from(race.tick_hz())),
            Command::Seek(tick) => {
                self.running = false;
                self.seek(tick);
            }
            Command::WatchAgain => self.watch_again(),
            Command::Undo => self.undo(),
            Command::Redo => self.redo(),
            Command::PointerDown(is_down) => self.viewer.pointer_is_down = is_down,
            Command::Restart => {
                // A run that has come to rest by itself was not paused by anybody.
                self.running |= self.comes_to_rest();
                // A hint leads on; the old run is a click away on the timeline.
                if self.restart_keeping_run() && self.hint().is_none() {
                    self.set_notice("restarted: Ctrl Z brings the run back");
                }
            }
            Command::Scene(place) => self.open(place),
            Command::NextScene => self.open_beside(true),
            Command::PreviousScene => self.open_beside(false),
            Command::ToggleGhost => {
                self.viewer.preferences.display.ghost = !self.viewer.preferences.display.ghost
            }
            Command::NextInterpolation => self.viewer.next_interpolation(),
            Command::ToggleArrangement => self.viewer.toggle_arrangement(),
            Command::ToggleTheme => {
                self.viewer.preferences.theme_is_chosen = true;
                self.viewer.preferences.display.theme =
                    self.viewer.preferences.display.theme.other();
            }
            Command::ScaleUp => {
                let larger = rung_above(&SCALE_LADDER, self.display().scale_percent);
                larger.into_iter().for_each(|percent| self.viewer.show_scale(percent));
            }
            Command::ScaleDown => {
                let smaller = rung_below(&SCALE_LADDER, self.display().scale_percent);
                smaller.into_iter().for_each(|percent| self.viewer.show_scale(percent));
            }
            Command::UsualScale => self.viewer.show_scale(USUAL_SCALE_PERCENT),
            Command::Instrument(instrument) => {
                self.viewer.preferences.display.instrument = instrument
            }
            Command::Quantity(quantity) => self.viewer.preferences.display.quantity = quantity,
            Command::Coordinate { body, coordinate } => self.plot_coordinate(body, coordinate),
            Command::PlotRanges(ranges) => self.viewer.view.plot_ranges = ranges,
            Command::MapParameter(parameter) => {
                let view = &mut self.viewer.view;
                view.mapped_parameter = Some((view.body, parameter));
            }
            Command::Cloud(choice) => self.viewer.preferences.display.cloud = choice,
            Command::NextInstrument => self.viewer.instrument_beside(1),
            Command::PreviousInstrument => self.viewer.instrument_beside(-1),
            Command::Metric(place) => {
                self.viewer.preferences.display.metric = place.min(METRICS.len() - 1)
            }
            Command::ToggleEnlarged => {
                self.viewer.preferences.display.enlarged =
                    !self.viewer.preferences.display.enlarged;
            }
            Command::Copy => {
                let pointed = self.viewer.pointed.filter(|entry| *entry < self.entries().len());
                let copy = pointed.map(|entry| match self.joint_code(entry) {
                    Some(_) => DriverRequest::CopyJoint(entry),
                    None => DriverRequest::CopyMethod(entry),
                });
                return Some(copy.unwrap_or(DriverRequest::CopyInstrument));
            }
            Command::CopyInstrument => return Some(DriverRequest::CopyInstrument),
            Command::CopyMethod { entry, language } => {
                self.viewer.preferences.language = language;
                let known = entry < self.entries().len();
                return known.then_some(DriverRequest::CopyMethod(entry));
            }
            Command::CopyJoint(entry) => {
                return self.joint_code(entry).map(|_| DriverRequest::CopyJoint(entry));
            }
            Command::PointAt(entry) => self.viewer.pointed = entry,
            Command::ExportInstrument => return Some(DriverRequest::ExportInstrument),
            Command::Body(body) => {
                self.viewer.view.body = body.min(self.scene().bodies.len() - 1);
            }
            Command::AdviseOnOneBody(is_one) => {
                self.viewer.preferences.display.advises_on_one_body = is_one;
            }
            Command::ToggleHelp => {
                self.viewer.preferences.display.help = !self.viewer.preferences.display.help
            }
            Command::ToggleInspector => {
                self.viewer.preferences.display.inspector =
                    !self.viewer.preferences.display.inspector;
            }
            Command::Seconds(seconds) => {
                self.set_start("the length", |start| start.set_seconds(seconds));
            }
            Command::Hold(held) => self.viewer.held = Some(held),
            Command::LetGo => self.viewer.held = None,
            Command::ZoomPan { body, zoom_pan } => self.viewer.view.set_zoom_pan(body, zoom_pan),
            Command::AskForPath => self.viewer.dialog = Some(Dialog::Path { refused: None }),
            Command::TypePath(path) => self.type_path(path),
            Command::CompletePath => return Some(DriverRequest::CompletePath),
            Command::OpenTypedPath => return Some(DriverRequest::OpenTypedPath),
            Command::AskForSpring => self.viewer.dialog = Some(Dialog::Spring),
            Command::DescribeSpring(spring) => self.viewer.preferences.my_spring = spring,
            Command::OpenSpring => self.open_spring(),
            Command::CloseDialog => self.viewer.dialog = None,
            Command::ToggleGuide => self.toggle_guide(),
            Command::GoToStop(place) => self.go_to_stop(place),
            Command::NextStop => self.go_to_stop_beside(1),
            Command::PreviousStop => self.go_to_stop_beside(-1),
            Command::Predict(choice) => {
                self.viewer.tour.iter_mut().for_each(|tour| tour.predict(choice));
            }
            Command::Escape => return (!self.escape()).then_some(DriverRequest::Quit),
            Command::Screenshot => return Some(DriverRequest::Screenshot),
            Command::Record => return Some(DriverRequest::Record),
            Command::ToggleEqualCost => self.toggle_equal_cost(),
            Command::ToggleFullScreen => return Some(DriverRequest::ToggleFullScreen),
        }
        None
    }

    /// Closes the foremost of what is open. Returns whether anything was.
    fn escape(&mut self) -> bool {
        self.viewer.held.take().is_some()
            || self.viewer.dialog.take().is_some()
            || take(&mut self.viewer.preferences.display.help)
            || self.close_guide()
            || take(&mut self.viewer.preferences.display.enlarged)
            || take(&mut self.viewer.preferences.display.inspector)
    }

    /// Performs an action on the run by hand.
    fn act(&mut self, action: Action) {
        if let Action::Set { body, parameter, value } = action
            && let Some(of) = self.scene().bodies.get(body)
            && of.kind.parameters.get(parameter).is_some_and(|it| it.acts == Acts::AtStart)
        {
            let set = |start: &mut StartSettings| start.set(body, parameter, value);
            return self.set_start("the start value", set);
        }
        let was_past = self.timeline.is_in_past();
        let before = self.start.clone();
        let (acted, mut told) =
            self.watched(|timeline, notices| timeline.act_seen(action.clone(), &before, notices));
        let ActionResult::Done { released } = acted else { return self.tell(told) };
        self.start.keep(&action, self.timeline.session().race(), self.timeline.past().menu());
        if let Action::Lane { .. } = action {
            self.start.entry = self.active();
        }
        let discarded = was_past.then(|| {
            let tick = self.race().tick();
            format!("you changed the past at tick {tick}: Ctrl Z takes it back")
        });
        let released = released.map(|control| {
            format!(
                "you have the {} now: the script leaves it alone until a restart",
                control.name()
            )
        });
        told.extend(released.into_iter().chain(discarded));
        self.tell(told);
    }

    /// Changes a setting of the next start by hand. `set` returns whether it changed anything.
    fn set_start(&mut self, what: &str, set: impl FnOnce(&mut StartSettings) -> bool) {
        let before = self.start.clone();
        if set(&mut self.start) {
            self.timeline.keep_settings(what, before);
        }
    }

    /// The lane that a pick of this index of the menu selects: in solo mode the only one.
    pub(super) fn picked(&self, entry: usize) -> Option<LaneId> {
        let picked = match self.mode() {
            Mode::Solo => self.race().entrants().first().filter(|_| entry < self.entries().len()),
            Mode::Race => self.flown(entry),
        };
        picked.map(|lane| lane.id)
    }

    fn pick(&mut self, entry: usize) {
        let Some(lane) = self.picked(entry) else { return };
        self.viewer.selected = lane;
        self.viewer.is_selected = true;
        if self.mode() == Mode::Solo {
            let spec = self.entries()[entry];
            self.act(Action::Lane { lane, spec });
        }
        self.start.entry = entry;
    }

    /// Gives a method of the list new substeps and a new tolerance, switches its lane in a race to them, and picks it. A race
    /// without the method restarts with it.
    fn set_lane(&mut self, spec: LaneSpec) {
        let listed = self.entries().iter().position(|known| known.method == spec.method);
        let entry = listed.expect("every method is on the list");
        match (self.mode(), self.flown(entry)) {
            (Mode::Race, None) => {
                self.keep_run("the new race");
                self.start.list[entry] = spec;
                self.start.entry = entry;
                self.restart();
                self.set_notice(format!("the race restarted with {} in it", spec.method.name));
            }
            (Mode::Race, Some(flown)) => {
                let lane = flown.id;
                self.act(Action::Lane { lane, spec });
                self.pick(entry);
            }
            (Mode::Solo, _) => {
                let lane = self.race().entrants()[0].id;
                self.act(Action::Lane { lane, spec });
            }
        }
    }

    /// Picks the next index on the list that can be picked, cyclically, in the direction of `step`.
    fn pick_beside(&mut self, step: isize) {
        let (active, count) = (self.active() as isize, self.entries().len() as isize);
        let mut around = (1..=count).map(|i| (active + i * step).rem_euclid(count) as usize);
        if let Some(entry) = around.find(|&entry| self.picked(entry).is_some()) {
            self.pick(entry);
        }
    }

    /// Switches equal cost on or off.
    fn toggle_equal_cost(&mut self) {
        if self.mode() == Mode::Solo {
            return self.set_notice("equal cost needs a race: press C");
        }
        let lanes: Vec<(LaneId, LaneSpec)> =
            self.race().entrants().iter().map(|entrant| (entrant.id, entrant.spec)).collect();
        let specs: Vec<LaneSpec> = lanes.iter().map(|(_, spec)| *spec).collect();
        let (wanted, before, notice) = match &self.start.before_equal_cost {
            Some(before) => {
                let of = |spec: &LaneSpec| {
                    let before = before.iter().find(|known| known.method == spec.method);
                    LaneSpec {
                        substeps: before
                            .map_or(spec.method.default_substeps, |known| known.substeps),
                        ..*spec
                    }
                };
                let wanted: Vec<LaneSpec> = specs.iter().map(of).collect();
                (wanted, None, "equal cost is off: lanes have their own substeps again")
            }
            None => {
                let equal = equal_cost(self.scene(), &specs, self.race().tick_hz());
                (
                    equal,
                    Some(specs),
                    "equal cost is on: each lane has as many substeps as match the dearest lane's cost",
                )
            }
        };
        for ((lane, _), spec) in lanes.into_iter().zip(wanted) {
            self.act(Action::Lane { lane, spec });
        }
        self.start.before_equal_cost = before;
        self.set_notice(notice);
    }

    /// Pauses and goes `ticks` ticks forward, or back if negative.
    fn step_by(&mut self, ticks: i64) {
        self.running = false;
        let tick = self.race().tick().saturating_add_signed(ticks);
        self.seek(tick);
        while self.race().tick() < tick {
            self.tick();
        }
        self.timeline.show_present();
    }

    pub(super) fn seek(&mut self, tick: u64) {
        self.timeline.seek(tick);
        self.timeline.show_present();
        self.clock.set_tick_hz(self.race().tick_hz());
    }
}

/// `part` plus `more` tenths, rounded to tenths, so that ten steps up and ten down end at the initial value.
fn tenths(part: f64, more: f64) -> f64 {
    ((part * 10.0).round() + more) / 10.0
}
