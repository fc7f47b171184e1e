//! The loop lab as a mode of the studio: opening and leaving it, and what commands do in it.

use std::mem::take;
use std::sync::Arc;

use super::Studio;
use super::command::{StageCommand, TICK_LADDER};
use super::guide::Goal;
use super::instrument::Instrument;
use super::step::Step;
use crate::loops::FrameTrace;
use crate::loops::loop_lab::{FoundLoop, LoopCommand, LoopLab, LoopRequest, LoopWorker, SLOWNESS};
use crate::scene::SceneBody;
use crate::sim::integrators::{Method, method};

/// What a person is at: what the stage shows, and what its commands act on.
#[derive(Default)]
pub(super) enum Activity {
    /// The run.
    #[default]
    Run,
    /// The loop lab, while the run waits.
    Loops(Box<LoopLab>),
}

/// The method of the body at first: none that adds much of its own.
const METHOD_AT_FIRST: &str = "rk4";

impl Studio {
    /// Why the loop lab does not take the displayed body: a net, because what is made ready for every loop would take too
    /// long. `None` if it does.
    pub fn loop_lab_refusal(&self) -> Option<String> {
        let SceneBody { name, kind, .. } = &self.scene().bodies[self.view().body];
        let refusal = "is a net, which the loop lab does not take; open another scene";
        kind.net().is_some().then(|| format!("{name} {refusal}"))
    }

    /// Opens the loop lab with the displayed body, unless it is [refused](Self::loop_lab_refusal).
    pub(super) fn open_loop_lab(&mut self) {
        let method = method(METHOD_AT_FIRST).expect("a built-in method");
        let body = self.view().body;
        if let Some(refusal) = self.loop_lab_refusal() {
            return self.viewer.set_notice(refusal);
        }
        let mut loops = LoopLab::new(self.scene(), body, method);
        loops.run_goes_on = self.running;
        loops.play_opening();
        self.activity = Activity::Loops(loops.into());
        self.viewer.preferences.display.instrument = Instrument::Loop;
        self.viewer.preferences.display.inspector = false;
        self.viewer.held = None;
        self.viewer.notice = None;
        if self.viewer.tour.as_ref().is_some_and(|tour| tour.stop().goal != Goal::LoopLab) {
            self.leave_guide();
        }
        self.running = true;
    }

    /// Leaves the loop lab; the run goes on as it did before. Returns whether it was open.
    pub(super) fn leave_loop_lab(&mut self) -> bool {
        let Activity::Loops(loops) = take(&mut self.activity) else { return false };
        self.running = loops.run_goes_on;
        self.viewer.notice = None;
        if self.display().instrument == Instrument::Loop {
            self.viewer.preferences.display.instrument = Instrument::Motion;
        }
        true
    }

    /// Opens the loop lab on the trace of this name, if there is one.
    pub fn open_loop_lab_on(&mut self, trace: &str) {
        self.open_loop_lab();
        if let Activity::Loops(loops) = &mut self.activity
            && let Some(index) = loops.traces().iter().position(|known| known.name() == trace)
        {
            loops.choose_trace(index);
            loops.end_opening();
        }
    }

    /// Opens the loop lab, if it is closed, on the first of these traces.
    pub fn open_traces(&mut self, traces: Vec<FrameTrace>) {
        if self.loop_lab().is_none() {
            self.open_loop_lab();
        }
        if let Activity::Loops(loops) = &mut self.activity
            && !traces.is_empty()
        {
            let missing = traces[0].missing_display();
            loops.add_traces(traces);
            loops.end_opening();
            missing.into_iter().for_each(|missing| self.viewer.set_notice(missing));
        }
    }

    /// The loops that the open loop lab wants at present, for a [`LoopWorker`]; `None` if it has all, or is closed.
    pub fn loop_request(&self) -> Option<Arc<LoopRequest>> {
        let loops = self.loop_lab().filter(|loops| !loops.is_complete());
        loops.map(|loops| Arc::clone(loops.request()))
    }

    /// Shows a loop that was run, if it is still wanted.
    pub fn accept_loop(&mut self, found: FoundLoop) {
        if let Activity::Loops(loops) = &mut self.activity {
            loops.accept(found);
        }
    }

    /// Runs all loops that the open loop lab wants, now.
    pub fn run_loops(&mut self) {
        let mut worker = LoopWorker::default();
        worker.set_request(self.loop_request());
        while let Some(found) = worker.work(&|| false) {
            self.accept_loop(found);
        }
    }

    /// Carries out a command on the stage while the loop lab is on it.
    pub(super) fn carry_out_in_loop_lab(&mut self, command: StageCommand) {
        let Activity::Loops(loops) = &mut self.activity else { return };
        let tick_hz = loops.scene().tick_hz;
        let frames_per_second = loops.traces()[loops.trace()].refresh().hz().round() as i64;
        match command {
            StageCommand::ToggleRace | StageCommand::OpenSpring => {
                self.leave_loop_lab();
                return self.carry_out_on_stage(command);
            }
            StageCommand::Pick(index) => loops.select(index),
            StageCommand::ToggleArrangement => loops.toggle_overlay(),
            StageCommand::InstrumentBeside(step) => {
                loops.choose_trace(step.around(loops.trace(), loops.traces().len()));
            }
            StageCommand::Restart => loops.seek(0),
            StageCommand::Tick(step) => self.step_loops(step.sign()),
            StageCommand::Second(step) => self.step_loops(step.sign() * frames_per_second),
            StageCommand::MethodBeside(step) => {
                let beside = method_beside(loops, step);
                self.set_loop_method(beside);
            }
            StageCommand::Method(method) => self.set_loop_method(method),
            StageCommand::TickHz(tick_hz) => loops.set_tick_hz(tick_hz),
            StageCommand::TickRate(step) => {
                let beside = step.along(&TICK_LADDER, tick_hz);
                beside.into_iter().for_each(|hz| loops.set_tick_hz(hz));
            }
            StageCommand::Speed(step) => {
                let beside = step.other().along(&SLOWNESS, loops.slowness());
                beside.into_iter().for_each(|slowness| loops.set_slowness(slowness));
            }
            StageCommand::Scene(_) | StageCommand::SceneBeside(_) | StageCommand::Body(_) => {
                let (loops, running) = (take(&mut self.activity), self.running);
                self.carry_out_on_stage(command);
                self.activity = loops;
                self.running = running;
                if let Some(refusal) = self.loop_lab_refusal() {
                    self.leave_loop_lab();
                    return self.viewer.set_notice(refusal);
                }
                let (scene, body) = (self.run.next().scene.clone(), self.view().body);
                if let Activity::Loops(loops) = &mut self.activity {
                    loops.show(&scene, body);
                }
            }
            StageCommand::Metric(index) => loops.set_metric(index),
            StageCommand::Instrument(instrument) if instrument.is_in_loop_lab() => {
                self.viewer.preferences.display.instrument = instrument;
                return;
            }
            StageCommand::Instrument(instrument) => {
                let name = instrument.name();
                self.viewer.set_notice(format!("{name} is not in the loop lab: L leaves it"));
            }
        }
        self.end_opening_of_loop_lab();
    }

    /// Says that the loop lab takes no command on the run.
    pub(super) fn refuse_in_loop_lab(&mut self) {
        self.viewer.set_notice("not in the loop lab: L leaves it");
        self.end_opening_of_loop_lab();
    }

    fn end_opening_of_loop_lab(&mut self) {
        if let Activity::Loops(loops) = &mut self.activity {
            loops.end_opening();
        }
    }

    pub(super) fn change_loop_lab(&mut self, command: LoopCommand) {
        let Activity::Loops(loops) = &mut self.activity else { return };
        match command {
            LoopCommand::ToggleLab => drop(self.leave_loop_lab()),
            LoopCommand::Select(index) => loops.select(index),
            LoopCommand::ToggleOnStage(index) => loops.toggle(index),
            LoopCommand::Trace(index) => loops.choose_trace(index),
            LoopCommand::Slowness(slowness) => loops.set_slowness(slowness),
            LoopCommand::Seek(now_ns) => {
                loops.seek(now_ns);
                self.running = false;
            }
        }
        self.end_opening_of_loop_lab();
    }

    fn set_loop_method(&mut self, method: &'static Method) {
        let Activity::Loops(loops) = &mut self.activity else { return };
        let notice = match loops.scene().refusal(method) {
            Some(refusal) => refusal.to_string(),
            None => {
                loops.set_method(method);
                format!("every loop steps by {}", method.name)
            }
        };
        self.viewer.set_notice(notice);
    }

    fn step_loops(&mut self, frames: i64) {
        self.running = false;
        if let Activity::Loops(loops) = &mut self.activity {
            loops.step(frames);
        }
    }

    pub(super) fn title_of_loops(&self, loops: &LoopLab) -> String {
        let trace = loops.traces()[loops.trace()].name();
        let paused = if self.running { "" } else { " (paused)" };
        format!(
            "Regatta - {} - loop lab: {} - {trace} - {} Hz{paused}",
            self.scene_name(),
            loops.selected_card().name,
            loops.scene().tick_hz,
        )
    }
}

fn method_beside(loops: &LoopLab, step: Step) -> &'static Method {
    let methods: Vec<_> = loops.scene().fitting_methods().collect();
    let index = methods.iter().position(|method| *method == loops.method()).unwrap_or(0);
    methods[step.around(index, methods.len())]
}
