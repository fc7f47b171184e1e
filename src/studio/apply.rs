//! Passes each command to the part of the studio that executes it.
//!
//! Each command first closes the open undo change unless the pointer is down, so that one change is one key or one
//! drag. While the guide asks for a prediction, commands that move time are refused: a prediction after the motion is
//! none.

use super::Studio;
use super::book_figure::{figure_of_digit, open_figure};
use super::command::{
    Command, RunCommand, SCALE_LADDER, StageCommand, USUAL_SCALE_PERCENT, ViewCommand,
};
use super::dispatch::{carry_out_on_run, carry_out_on_stage};
use super::display::DriverRequest;
use super::escaping::escape;
use super::guiding::{go_to_stop, go_to_stop_beside, look_at_goal, toggle_guide};
use super::joint::joint_code;
use super::looping::{change_loop_lab, refuse_in_loop_lab};
use super::my_lines::{read_lines, run_lines};
use super::opening::described_spring;
use super::restarting::plot_coordinate;
use super::viewer::Dialog;

impl Studio {
    /// Executes a command. Returns the part of the command that the driver has to execute, if any.
    pub fn apply(&mut self, command: impl Into<Command>) -> Option<DriverRequest> {
        let command = command.into();
        // Every deed answers the question, a moving pointer does not.
        let is_deed = !matches!(command, Command::View(ViewCommand::PointAt(_)));
        if is_deed && self.viewer.quit_question.take().is_some() {
            match command {
                Command::View(ViewCommand::Enter) => return Some(DriverRequest::Quit),
                Command::View(ViewCommand::Escape) => return None,
                _ => {}
            }
        }
        self.viewer.hints.mark_followed(&command, self.deck.run.next().scene.hint.as_deref());
        if !self.viewer.pointer_is_down() {
            self.deck.run.close_change();
        }
        let (ran, was_asked) = (self.deck.time_runs(), self.viewer.is_asked());
        if was_asked && moves_time(&command) {
            self.viewer.set_notice("first predict: click an answer. Page Down skips the question");
            return None;
        }
        self.viewer.measure_for(&command);
        let request = self.carry_out(command);
        look_at_goal(self, was_asked);
        if !ran && self.deck.time_runs() {
            self.deck.run_on(self.viewer.display().interpolation);
        }
        request
    }

    pub(super) fn carry_out(&mut self, command: Command) -> Option<DriverRequest> {
        if let (Command::Stage(StageCommand::Pick(entry)), Some(Dialog::Figures)) =
            (&command, &self.viewer.dialog)
        {
            let figure = figure_of_digit(entry + 1)?;
            return self.carry_out_on_view(ViewCommand::OpenFigure(figure));
        }
        if self.loop_lab().is_some() && !matches!(command, Command::View(_) | Command::Ask(_)) {
            self.viewer.notice = None;
        }
        match command {
            Command::View(command) => return self.carry_out_on_view(command),
            Command::Run(_)
            | Command::Ask(
                DriverRequest::Record | DriverRequest::Report | DriverRequest::CopyLink,
            ) if self.loops.is_some() => {
                refuse_in_loop_lab(self);
            }
            Command::Ask(request) => return if_copyable(self, request),
            Command::Run(command) => carry_out_on_run(self, command),
            Command::Stage(command) => carry_out_on_stage(self, command),
            Command::Loop(command) => change_loop_lab(self, command),
        }
        None
    }

    fn carry_out_on_view(&mut self, command: ViewCommand) -> Option<DriverRequest> {
        let (is_in_loop_lab, openings) = (self.loops.is_some(), self.deck.openings);
        let display = &mut self.viewer.preferences.display;
        match command {
            ViewCommand::TogglePause => self.deck.running = !self.deck.running,
            ViewCommand::PointerDown(is_down) => {
                self.viewer.hz_at_press = is_down.then(|| self.race().tick_hz());
                self.deck.tick_rate_is_held &= is_down;
                self.deck.pulled.take_if(|_| !is_down);
            }
            ViewCommand::HoldTickRate => self.deck.tick_rate_is_held = !is_in_loop_lab,
            ViewCommand::ToggleFutures => {
                display.futures = !display.futures;
                self.deck.running &= !display.futures;
            }
            ViewCommand::ToggleMeasure if is_in_loop_lab => {
                self.viewer.set_notice("the loop lab keeps its instruments: L leaves it");
            }
            ViewCommand::ToggleMeasure => {
                display.measure = !display.measure;
                display.enlarged &= !display.measure;
            }
            ViewCommand::Split(splits) => display.splits = splits.clamped(),
            ViewCommand::ToggleGhost => display.ghost = !display.ghost,
            ViewCommand::ToggleFrameRate => display.frame_rate = !display.frame_rate,
            ViewCommand::ToggleTheme => {
                display.theme = display.theme.other();
                self.viewer.preferences.theme_is_chosen = true;
            }
            ViewCommand::Scale(step) => {
                let beside = step.next_rung(&SCALE_LADDER, display.scale_percent);
                if let Some(percent) = beside {
                    self.viewer.show_scale(percent);
                }
            }
            ViewCommand::UsualScale => self.viewer.show_scale(USUAL_SCALE_PERCENT),
            ViewCommand::Quantity(quantity) => display.quantity = quantity,
            ViewCommand::Coordinate { body, coordinate } => plot_coordinate(self, body, coordinate),
            ViewCommand::PlotRanges(ranges) => self.viewer.view.plot_ranges = ranges,
            ViewCommand::ToggleEnlarged | ViewCommand::Enter => {
                display.enlarged = !display.enlarged
            }
            ViewCommand::Copy => return copy(self),
            ViewCommand::Language(language) => self.viewer.preferences.language = language,
            ViewCommand::CopyMethod { entry, language } => {
                self.viewer.preferences.language = language;
                return if_copyable(self, DriverRequest::CopyMethod(entry));
            }
            ViewCommand::PointAt(entry) => self.viewer.pointed = entry,
            ViewCommand::AdviseOnOneBody(is_one) => display.advises_on_one_body = is_one,
            ViewCommand::ToggleHelp => display.help = !display.help,
            ViewCommand::LetGo => _ = self.deck.let_go(),
            ViewCommand::ZoomPan { body, zoom_pan } => {
                self.viewer.view.set_zoom_pan(body, zoom_pan)
            }
            ViewCommand::AskForPath => self.viewer.dialog = Some(Dialog::path(false)),
            ViewCommand::AskForRun => self.viewer.dialog = Some(Dialog::path(true)),
            ViewCommand::TypePath(path) => self.viewer.type_path(path),
            ViewCommand::AskForSpring => {
                let tick_hz = described_spring(self).1;
                self.viewer.dialog = Some(Dialog::Spring { tick_hz });
            }
            ViewCommand::DescribeSpring(spring) => self.viewer.preferences.my_spring = spring,
            ViewCommand::SpringTickHz(tick_hz) => {
                self.viewer.dialog = Some(Dialog::Spring { tick_hz });
            }
            ViewCommand::CloseComparison => _ = self.deck.close_comparison(),
            ViewCommand::AskForLines => {
                let text = self.viewer.preferences.my_lines.clone();
                read_lines(&mut self.viewer, text);
            }
            ViewCommand::TypeLines(text) => read_lines(&mut self.viewer, text),
            ViewCommand::RunLines => run_lines(self),
            ViewCommand::ToggleFigures => {
                let is_open = self.viewer.dialog == Some(Dialog::Figures);
                self.viewer.dialog = (!is_open).then_some(Dialog::Figures);
            }
            ViewCommand::OpenFigure(index) => {
                open_figure(self, index);
            }
            ViewCommand::CloseDialog => self.viewer.dialog = None,
            ViewCommand::ToggleGuide => toggle_guide(self),
            ViewCommand::GoToStop(index) => go_to_stop(self, index),
            ViewCommand::StopBeside(step) => go_to_stop_beside(self, step),
            ViewCommand::Predict(choice) => {
                if let Some(tour) = &mut self.viewer.tour {
                    tour.predict(choice);
                }
            }
            ViewCommand::Escape => return escape(self),
        }
        // A stop of the guide opens a scene, which has a run of its own.
        if self.deck.openings != openings {
            self.loops = None;
        }
        None
    }
}

/// Whether the command lets time run, moves it, or shows what it will bring.
fn moves_time(command: &Command) -> bool {
    match command {
        Command::View(view) => {
            matches!(view, ViewCommand::TogglePause | ViewCommand::ToggleFutures)
        }
        Command::Stage(stage) => {
            use StageCommand::{Restart, Second, Tick};
            matches!(stage, Tick(_) | Second(_) | Restart)
        }
        Command::Run(run) => matches!(run, RunCommand::Seek(_) | RunCommand::WatchAgain),
        _ => false,
    }
}

/// Returns the request for the copy of the lane that is pointed at, or else of the instrument.
fn copy(studio: &Studio) -> Option<DriverRequest> {
    let of_lane = |entry| [DriverRequest::CopyJoint(entry), DriverRequest::CopyMethod(entry)];
    let of_lane = studio.viewer.pointed.map(of_lane).into_iter().flatten();
    let mut copies = of_lane.chain([DriverRequest::CopyInstrument]);
    copies.find_map(|copy| if_copyable(studio, copy))
}

/// Returns the request, or `None` if it would leave the driver nothing to copy.
fn if_copyable(studio: &Studio, request: DriverRequest) -> Option<DriverRequest> {
    match request {
        DriverRequest::CopyMethod(entry) => studio.entries().get(entry).map(|_| request),
        DriverRequest::CopyJoint(entry) => joint_code(studio, entry).map(|_| request),
        _ => Some(request),
    }
}
