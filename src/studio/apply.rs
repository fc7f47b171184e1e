//! The effects of commands: each becomes an [action](Action) on the run, or changes the display.

use std::mem::take;

use super::Studio;
use super::command::{
    Command, RunCommand, SCALE_LADDER, SPEED_LADDER, StageCommand, TICK_LADDER,
    USUAL_SCALE_PERCENT, ViewCommand,
};
use super::display::DriverRequest;
use super::looping::Activity;
use super::step::Step;
use super::viewer::Dialog;
use crate::loops::loop_lab::LoopCommand;
use crate::run::race::{Mode, equal_cost};
use crate::run::{METRICS, StartSettings};
use crate::scene::{Action, LaneId, LaneSpec};
use crate::sim::bodies::Acts;
use crate::sim::integrators::Method;
use crate::sim::number::round;

/// What is asked before a run that is not saved is lost.
const QUIT_QUESTION: &str = "what you did in this run is not saved: F5 saves it, Esc again quits";

impl Studio {
    /// Carries out a command. Returns what the driver has to do for it, if anything.
    pub fn apply(&mut self, command: impl Into<Command>) -> Option<DriverRequest> {
        let command = command.into();
        self.viewer.hints.see(&command, self.run.next().scene.hint.as_deref());
        if !self.viewer.pointer_is_down() {
            self.run.close_change();
        }
        let ran = self.time_runs();
        self.measure_for(&command);
        let request = self.carry_out(command);
        if !ran && self.time_runs() {
            self.run_on();
        }
        self.look_at_goal();
        request
    }

    /// Shows the instruments if this command is about what they show.
    fn measure_for(&mut self, command: &Command) {
        let is_about = match command {
            Command::Stage(command) => matches!(
                command,
                StageCommand::ToggleRace
                    | StageCommand::Instrument(_)
                    | StageCommand::InstrumentBeside(_)
                    | StageCommand::OpenSpring
            ),
            Command::Loop(command) => *command == LoopCommand::ToggleLab,
            Command::Run(command) => *command == RunCommand::ToggleInspector,
            Command::View(command) => {
                matches!(command, ViewCommand::ToggleEnlarged | ViewCommand::ToggleGuide)
            }
            Command::Ask(_) => false,
        };
        self.viewer.preferences.display.measure |= is_about;
    }

    pub(super) fn carry_out(&mut self, command: Command) -> Option<DriverRequest> {
        if self.loop_lab().is_some() && !matches!(command, Command::View(_) | Command::Ask(_)) {
            self.viewer.notice = None;
        }
        match (command, &self.activity) {
            (Command::View(command), _) => return self.carry_out_on_view(command),
            (Command::Ask(DriverRequest::Record | DriverRequest::CopyLink), Activity::Loops(_)) => {
                self.refuse_in_loop_lab();
            }
            (Command::Ask(request), _) => return self.possible(request),
            (Command::Run(command), Activity::Run) => self.carry_out_on_run(command),
            (Command::Run(_), Activity::Loops(_)) => self.refuse_in_loop_lab(),
            (Command::Stage(command), Activity::Run) => self.carry_out_on_stage(command),
            (Command::Stage(command), Activity::Loops(_)) => self.carry_out_in_loop_lab(command),
            (Command::Loop(LoopCommand::ToggleLab), Activity::Run) => self.open_loop_lab(),
            (Command::Loop(_), Activity::Run) => {}
            (Command::Loop(command), Activity::Loops(_)) => self.change_loop_lab(command),
        }
        None
    }

    fn carry_out_on_run(&mut self, command: RunCommand) {
        let race = self.race();
        match command {
            RunCommand::Act(action) => self.act(action),
            RunCommand::SetLane(spec) => self.set_lane(spec),
            RunCommand::SpeedPercent(percent) => self.clock.set_speed_percent(percent),
            RunCommand::ThrottleUp => self.act(Action::Throttle(tenths(race.throttle(), 1.0))),
            RunCommand::ThrottleDown => self.act(Action::Throttle(tenths(race.throttle(), -1.0))),
            RunCommand::RudderLeft => self.act(Action::Rudder(tenths(race.rudder(), 1.0))),
            RunCommand::RudderRight => self.act(Action::Rudder(tenths(race.rudder(), -1.0))),
            RunCommand::Seek(tick) => {
                self.running = false;
                self.seek(tick);
                self.tell_of_the_future(tick);
            }
            RunCommand::WatchAgain => self.watch_again(),
            RunCommand::Undo => self.undo(),
            RunCommand::Redo => self.redo(),
            RunCommand::NextInterpolation => self.viewer.next_interpolation(),
            RunCommand::MapParameter(parameter) => {
                let view = &mut self.viewer.view;
                view.mapped_parameter = Some((view.body, parameter));
            }
            RunCommand::Cloud(choice) => self.viewer.preferences.display.cloud = choice,
            RunCommand::ToggleInspector => {
                let display = &mut self.viewer.preferences.display;
                display.inspector = !display.inspector;
            }
            RunCommand::Seconds(seconds) => {
                self.set_start("the length", |start| start.set_seconds(seconds));
            }
            RunCommand::Hold(held) => self.viewer.held = Some(held),
            RunCommand::ToggleEqualCost => self.toggle_equal_cost(),
        }
    }

    pub(super) fn carry_out_on_stage(&mut self, command: StageCommand) {
        let race = self.race();
        match command {
            StageCommand::Method(method) => {
                self.listed(method).into_iter().for_each(|entry| self.pick(entry));
            }
            StageCommand::Pick(entry) => self.pick(entry),
            StageCommand::MethodBeside(step) => self.pick_beside(step),
            StageCommand::TickHz(tick_hz) => self.act(Action::TickHz(tick_hz)),
            StageCommand::TickRate(step) => {
                let beside = step.along(&TICK_LADDER, race.tick_hz());
                beside.into_iter().for_each(|hz| self.act(Action::TickHz(hz)));
            }
            StageCommand::Speed(step) => {
                let beside = step.along(&SPEED_LADDER, self.clock.speed_percent());
                beside.into_iter().for_each(|percent| self.clock.set_speed_percent(percent));
            }
            StageCommand::ToggleRace => match race.mode() {
                Mode::Solo => {
                    self.restart(Some("the race"), |next| next.mode = Mode::Race);
                    self.select_best();
                }
                Mode::Race => {
                    let lane = self.selected().id;
                    self.act(Action::Solo { lane });
                    self.run.next_mut().mode = Mode::Solo;
                    // It may be about a lane that has left the race.
                    self.viewer.notice = None;
                }
            },
            StageCommand::Tick(step) => self.step_by(step.sign()),
            StageCommand::Second(step) => self.step_by(step.sign() * i64::from(race.tick_hz())),
            StageCommand::Restart => {
                self.viewer.view.zoom_pans.clear();
                // A hint leads on; the old run is a click away on the timeline.
                if self.restart_keeping_run() && self.hint().is_none() {
                    self.viewer.set_notice("restarted: Ctrl Z brings the run back");
                }
            }
            StageCommand::Scene(index) => self.open(index),
            StageCommand::SceneBeside(step) => self.open_beside(step),
            StageCommand::ToggleArrangement => self.viewer.toggle_arrangement(),
            StageCommand::Instrument(instrument) => {
                self.viewer.preferences.display.instrument = instrument
            }
            StageCommand::InstrumentBeside(step) => {
                let instrument = &mut self.viewer.preferences.display.instrument;
                *instrument = instrument.beside(step);
            }
            StageCommand::Metric(index) => {
                self.viewer.preferences.display.metric = index.min(METRICS.len() - 1)
            }
            StageCommand::Body(body) => {
                self.viewer.view.body = body.min(self.scene().bodies.len() - 1);
            }
            StageCommand::OpenSpring => self.open_spring(),
        }
    }

    fn carry_out_on_view(&mut self, command: ViewCommand) -> Option<DriverRequest> {
        let is_in_loop_lab = self.loop_lab().is_some();
        let display = &mut self.viewer.preferences.display;
        match command {
            ViewCommand::TogglePause => self.running = !self.running,
            ViewCommand::PointerDown(is_down) => {
                self.viewer.hz_at_press = is_down.then(|| self.run.session().race().tick_hz());
            }
            ViewCommand::ToggleFutures => {
                display.futures = !display.futures;
                self.running &= !display.futures;
            }
            // The loop lab is its instruments.
            ViewCommand::ToggleMeasure => {
                display.measure = !display.measure || is_in_loop_lab;
                display.enlarged &= !display.measure;
            }
            ViewCommand::Split(splits) => display.splits = splits.within(),
            ViewCommand::ToggleGhost => display.ghost = !display.ghost,
            ViewCommand::ToggleTheme => {
                display.theme = display.theme.other();
                self.viewer.preferences.theme_is_chosen = true;
            }
            ViewCommand::Scale(step) => {
                let beside = step.along(&SCALE_LADDER, display.scale_percent);
                beside.into_iter().for_each(|percent| self.viewer.show_scale(percent));
            }
            ViewCommand::UsualScale => self.viewer.show_scale(USUAL_SCALE_PERCENT),
            ViewCommand::Quantity(quantity) => display.quantity = quantity,
            ViewCommand::Coordinate { body, coordinate } => self.plot_coordinate(body, coordinate),
            ViewCommand::PlotRanges(ranges) => self.viewer.view.plot_ranges = ranges,
            ViewCommand::ToggleEnlarged => display.enlarged = !display.enlarged,
            ViewCommand::Copy => {
                let of_lane =
                    |entry| [DriverRequest::CopyJoint(entry), DriverRequest::CopyMethod(entry)];
                let pointed = self.viewer.pointed.map(of_lane);
                let mut copies =
                    pointed.into_iter().flatten().chain([DriverRequest::CopyInstrument]);
                return copies.find_map(|copy| self.possible(copy));
            }
            ViewCommand::Language(language) => self.viewer.preferences.language = language,
            ViewCommand::CopyMethod { entry, language } => {
                self.viewer.preferences.language = language;
                return self.possible(DriverRequest::CopyMethod(entry));
            }
            ViewCommand::PointAt(entry) => self.viewer.pointed = entry,
            ViewCommand::AdviseOnOneBody(is_one) => display.advises_on_one_body = is_one,
            ViewCommand::ToggleHelp => display.help = !display.help,
            ViewCommand::LetGo => self.viewer.held = None,
            ViewCommand::ZoomPan { body, zoom_pan } => {
                self.viewer.view.set_zoom_pan(body, zoom_pan)
            }
            ViewCommand::AskForPath => self.viewer.dialog = Some(Dialog::path(false)),
            ViewCommand::AskForRun => self.viewer.dialog = Some(Dialog::path(true)),
            ViewCommand::TypePath(path) => self.type_path(path),
            ViewCommand::AskForSpring => self.viewer.dialog = Some(Dialog::Spring),
            ViewCommand::DescribeSpring(spring) => self.viewer.preferences.my_spring = spring,
            ViewCommand::CloseDialog => self.viewer.dialog = None,
            ViewCommand::ToggleGuide => self.toggle_guide(),
            ViewCommand::GoToStop(index) => self.go_to_stop(index),
            ViewCommand::StopBeside(step) => self.go_to_stop_beside(step),
            ViewCommand::Predict(choice) => {
                self.viewer.tour.iter_mut().for_each(|tour| tour.predict(choice));
            }
            ViewCommand::Escape => return if self.escape() { None } else { self.quit() },
        }
        None
    }

    /// The request, unless there is nothing for the driver to copy.
    fn possible(&self, request: DriverRequest) -> Option<DriverRequest> {
        match request {
            DriverRequest::CopyMethod(entry) => self.entries().get(entry).map(|_| request),
            DriverRequest::CopyJoint(entry) => self.joint_code(entry).map(|_| request),
            _ => Some(request),
        }
    }

    /// Closes the foremost of what is open. Returns whether anything was.
    fn escape(&mut self) -> bool {
        self.viewer.held.take().is_some()
            || self.viewer.dialog.take().is_some()
            || take(&mut self.viewer.preferences.display.help)
            || self.close_guide()
            || take(&mut self.viewer.preferences.display.enlarged)
            || take(&mut self.viewer.preferences.display.inspector)
            || self.leave_loop_lab()
    }

    /// Quits; while there is something to lose, at the second time of asking.
    fn quit(&mut self) -> Option<DriverRequest> {
        let is_asked = self.viewer.notice.as_deref() == Some(QUIT_QUESTION);
        if is_asked || self.deeds == self.saved_deeds || self.viewer.preferences.is_recorded {
            return Some(DriverRequest::Quit);
        }
        self.viewer.set_notice(QUIT_QUESTION);
        None
    }

    /// Notes that a file has what a person did in the run so far.
    pub fn note_saved(&mut self) {
        self.saved_deeds = self.deeds;
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
        if action.clone().checked().is_none() {
            return self.viewer.set_notice(out_of_range(action.noun()));
        }
        let was_past = self.run.is_in_past();
        let (is_input, rests) = (action.input().is_some(), self.comes_to_rest());
        let (done, mut told) = self.watched(|run, notices| run.act_within(action, notices));
        let Some(done) = done else { return self.tell(told) };
        self.deeds += 1;
        // What a person does at rest is to be seen.
        self.running |= is_input && rests;
        if let Action::Lane { .. } = done.action {
            self.run.next_mut().entry = self.active();
        }
        let discarded = was_past.then(|| {
            let tick = self.race().tick();
            format!("you changed the past at tick {tick}: Ctrl Z takes it back")
        });
        let released = done.released.map(|control| {
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
        self.deeds += u64::from(self.run.set_next(what, set));
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
        self.run.next_mut().entry = entry;
    }

    /// The index of a method on the list. If it is not there, a notice says why.
    fn listed(&mut self, method: &Method) -> Option<usize> {
        let listed = self.entries().iter().position(|spec| spec.method == method);
        if listed.is_none() {
            let why = match self.scene().refusal(method) {
                Some(refusal) => refusal.to_string(),
                None => format!(
                    "{} is not on this scene's list: the scene does not name it",
                    method.name
                ),
            };
            self.viewer.set_notice(why);
        }
        listed
    }

    /// Gives a method of the list new substeps and a new tolerance, switches its lane in a race to them, and picks it. A race
    /// without the method restarts with it.
    fn set_lane(&mut self, spec: LaneSpec) {
        let Some(entry) = self.listed(spec.method) else { return };
        if !spec.is_in_range() {
            return self.viewer.set_notice(out_of_range("the switch"));
        }
        match (self.mode(), self.flown(entry)) {
            (Mode::Race, None) => {
                self.restart(Some("the new race"), |next| {
                    next.list[entry] = spec;
                    next.entry = entry;
                });
                self.viewer
                    .set_notice(format!("the race restarted with {} in it", spec.method.name));
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

    /// Picks the next index on the list that can be picked, cyclically, that way.
    fn pick_beside(&mut self, step: Step) {
        let count = self.entries().len();
        let beside = |entry: &usize| Some(step.around(*entry, count));
        let mut around = std::iter::successors(Some(self.active()), beside).skip(1).take(count);
        if let Some(entry) = around.find(|&entry| self.picked(entry).is_some()) {
            self.pick(entry);
        }
    }

    /// Switches equal cost on or off.
    fn toggle_equal_cost(&mut self) {
        if self.mode() == Mode::Solo {
            return self.viewer.set_notice("equal cost needs a race: press C");
        }
        let lanes: Vec<(LaneId, LaneSpec)> =
            self.race().entrants().iter().map(|entrant| (entrant.id, entrant.spec)).collect();
        let (wanted, before, notice) = match &self.run.next().before_equal_cost {
            Some(before) => {
                let of = |(lane, spec): &(LaneId, LaneSpec)| {
                    let own = before.iter().find(|(known, _)| known == lane);
                    let substeps =
                        own.map_or(spec.method.default_substeps, |(_, own)| own.substeps);
                    LaneSpec { substeps, ..*spec }
                };
                let wanted: Vec<LaneSpec> = lanes.iter().map(of).collect();
                (wanted, None, "equal cost is off: lanes have their own substeps again")
            }
            None => {
                let specs: Vec<LaneSpec> = lanes.iter().map(|(_, spec)| *spec).collect();
                let equal = equal_cost(self.scene(), &specs, self.race().tick_hz());
                (
                    equal,
                    Some(lanes.clone()),
                    "equal cost is on: each lane has as many substeps as match the dearest lane's cost",
                )
            }
        };
        for ((lane, _), spec) in lanes.into_iter().zip(wanted) {
            self.act(Action::Lane { lane, spec });
        }
        self.run.next_mut().before_equal_cost = before;
        self.viewer.set_notice(notice);
    }

    /// Pauses and goes `ticks` ticks forward, or back if negative.
    fn step_by(&mut self, ticks: i64) {
        self.running = false;
        let tick = self.race().tick().saturating_add_signed(ticks);
        self.seek(tick);
        while self.race().tick() < tick {
            self.tick();
        }
        self.run.show_present();
    }

    /// Says how far the run has got, if that is before this tick.
    fn tell_of_the_future(&mut self, tick: u64) {
        let (end, times) = (self.run.end(), self.run.times());
        if tick > end {
            let [wanted, end] = [tick, end].map(|tick| format!("{} s", round(times.t(tick), 3)));
            self.viewer.set_notice(vec![
                format!("{wanted} is still to come: the run has got to {end}"),
                "Space goes on".into(),
            ]);
        }
    }

    pub(super) fn seek(&mut self, tick: u64) {
        self.run.seek(tick);
        self.run.show_present();
        self.clock.set_tick_hz(self.race().tick_hz());
    }
}

/// What is told of an action with a number that is out of its range.
fn out_of_range(noun: &str) -> String {
    format!("out of range, so that nothing was changed: {noun}")
}

/// `part` plus `more` tenths, rounded to tenths, so that ten steps up and ten down end at the initial value.
fn tenths(part: f64, more: f64) -> f64 {
    ((part * 10.0).round() + more) / 10.0
}
