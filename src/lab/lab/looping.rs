//! The loop lab as a mode of the lab: opening and leaving it, and what commands do in it.

use std::sync::Arc;

use super::Lab;
use crate::lab::command::{Command, TICK_LADDER, rung_above, rung_below};
use crate::lab::display::DriverRequest;
use crate::lab::guide::Goal;
use crate::lab::instrument::Instrument;
use crate::lab::loop_lab::{FoundLoop, LoopCommand, LoopLab, LoopRequest, LoopWorker, SLOWNESS};
use crate::lab::pacing::FrameTrace;
use crate::lab::scene::SceneBody;
use crate::sim::integrators::{Method, method};

/// The method of the body at first: none that adds much of its own.
const METHOD_AT_FIRST: &str = "rk4";

impl Lab {
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
            return self.set_notice(refusal);
        }
        let mut loops = LoopLab::new(self.scene(), body, method);
        loops.offer(self.viewer.live.trace());
        loops.run_goes_on = self.running;
        loops.play_opening();
        self.loop_lab = Some(loops);
        self.viewer.preferences.display.instrument = Instrument::Loop;
        self.viewer.preferences.display.inspector = false;
        self.viewer.held = None;
        self.viewer.notice = None;
        if self.viewer.tour.as_ref().is_some_and(|tour| tour.stop().goal != Goal::LoopLab) {
            self.leave_guide();
        }
        self.running = true;
    }

    /// Leaves the loop lab; the run goes on as it did before.
    fn leave_loop_lab(&mut self) {
        let Some(loops) = self.loop_lab.take() else { return };
        self.running = loops.run_goes_on;
        self.viewer.notice = None;
        if self.display().instrument == Instrument::Loop {
            self.viewer.preferences.display.instrument = Instrument::Motion;
        }
    }

    /// Opens the loop lab on the trace of this name, if there is one.
    pub fn open_loop_lab_on(&mut self, trace: &str) {
        self.open_loop_lab();
        if let Some(loops) = &mut self.loop_lab
            && let Some(place) = loops.traces().iter().position(|known| known.name() == trace)
        {
            loops.choose_trace(place);
            loops.end_opening();
        }
    }

    /// Opens the loop lab, if it is closed, on the first of these traces.
    pub fn open_traces(&mut self, traces: Vec<FrameTrace>) {
        if self.loop_lab.is_none() {
            self.open_loop_lab();
        }
        if let Some(loops) = &mut self.loop_lab
            && !traces.is_empty()
        {
            loops.add_traces(traces);
            loops.end_opening();
        }
    }

    /// The loops that the open loop lab wants at present, for a [`LoopWorker`]; `None` if it has all, or is closed.
    pub fn loop_request(&self) -> Option<Arc<LoopRequest>> {
        let loops = self.loop_lab.as_ref().filter(|loops| !loops.is_complete());
        loops.map(|loops| Arc::clone(loops.request()))
    }

    /// Shows a loop that was run, if it is still wanted.
    pub fn accept_loop(&mut self, found: FoundLoop) {
        if let Some(loops) = &mut self.loop_lab {
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

    /// Carries out a command of the stage on the open loop lab. Returns what the driver has to do for
    /// it, if anything.
    pub(super) fn carry_out_in_loop_lab(&mut self, command: Command) -> Option<DriverRequest> {
        let loops = self.loop_lab.as_mut()?;
        let tick_hz = loops.scene().tick_hz;
        let (slowness, traces) = (loops.slowness(), loops.traces().len());
        let frames_per_second = loops.traces()[loops.trace()].refresh().hz().round() as i64;
        match command {
            Command::Loop(command) => self.change_loop_lab(command),
            Command::ToggleRace | Command::OpenSpring => {
                self.leave_loop_lab();
                return self.carry_out(command);
            }
            Command::Pick(place) => loops.select(place),
            Command::ToggleArrangement => loops.toggle_overlay(),
            Command::NextInstrument => loops.choose_trace((loops.trace() + 1) % traces),
            Command::PreviousInstrument => {
                loops.choose_trace((loops.trace() + traces - 1) % traces)
            }
            Command::Restart => loops.seek(0),
            Command::TickForward => self.step_loops(1),
            Command::TickBack => self.step_loops(-1),
            Command::SecondForward => self.step_loops(frames_per_second),
            Command::SecondBack => self.step_loops(-frames_per_second),
            Command::NextMethod => {
                let next = method_beside(loops, true);
                self.set_loop_method(next);
            }
            Command::PreviousMethod => {
                let previous = method_beside(loops, false);
                self.set_loop_method(previous);
            }
            Command::Method(method) => self.set_loop_method(method),
            Command::TickHz(tick_hz) => loops.set_tick_hz(tick_hz),
            Command::TickRateUp => {
                let higher = rung_above(&TICK_LADDER, tick_hz);
                higher.into_iter().for_each(|hz| loops.set_tick_hz(hz));
            }
            Command::TickRateDown => {
                let lower = rung_below(&TICK_LADDER, tick_hz);
                lower.into_iter().for_each(|hz| loops.set_tick_hz(hz));
            }
            Command::SpeedUp => {
                let faster = rung_below(&SLOWNESS, slowness);
                faster.into_iter().for_each(|slowness| loops.set_slowness(slowness));
            }
            Command::SpeedDown => {
                let slower = rung_above(&SLOWNESS, slowness);
                slower.into_iter().for_each(|slowness| loops.set_slowness(slowness));
            }
            Command::Scene(_) | Command::NextScene | Command::PreviousScene | Command::Body(_) => {
                let (loops, running) = (self.loop_lab.take(), self.running);
                self.carry_out(command);
                self.loop_lab = loops;
                self.running = running;
                if let Some(refusal) = self.loop_lab_refusal() {
                    self.leave_loop_lab();
                    self.set_notice(refusal);
                    return None;
                }
                let (scene, body) = (self.start.scene.clone(), self.view().body);
                self.loop_lab.iter_mut().for_each(|loops| loops.show(&scene, body));
            }
            Command::Metric(place) => loops.set_metric(place),
            Command::Instrument(instrument) if !instrument.is_in_loop_lab() => {
                self.set_notice(format!(
                    "{} is not in the loop lab: L leaves it",
                    instrument.name()
                ));
            }
            Command::Instrument(instrument) => {
                self.viewer.preferences.display.instrument = instrument;
                return None;
            }
            other => unreachable!("{other:?} is not a command of the stage"),
        }
        self.loop_lab.iter_mut().for_each(LoopLab::end_opening);
        None
    }

    fn change_loop_lab(&mut self, command: LoopCommand) {
        let Some(loops) = &mut self.loop_lab else { return };
        match command {
            LoopCommand::ToggleLab => self.leave_loop_lab(),
            LoopCommand::Select(place) => loops.select(place),
            LoopCommand::ToggleOnStage(place) => loops.toggle(place),
            LoopCommand::Trace(place) => loops.choose_trace(place),
            LoopCommand::Slowness(slowness) => loops.set_slowness(slowness),
            LoopCommand::Seek(now_ns) => {
                loops.seek(now_ns);
                self.running = false;
            }
        }
    }

    fn set_loop_method(&mut self, method: &'static Method) {
        let Some(loops) = &mut self.loop_lab else { return };
        let notice = match loops.scene().refusal(method) {
            Some(refusal) => refusal.to_string(),
            None => {
                loops.set_method(method);
                format!("every loop steps by {}", method.name)
            }
        };
        self.set_notice(notice);
    }

    fn step_loops(&mut self, frames: i64) {
        self.running = false;
        if let Some(loops) = &mut self.loop_lab {
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

fn method_beside(loops: &LoopLab, is_next: bool) -> &'static Method {
    let methods: Vec<_> = loops.scene().fitting_methods().collect();
    let place = methods.iter().position(|method| *method == loops.method()).unwrap_or(0);
    methods[(place + if is_next { 1 } else { methods.len() - 1 }) % methods.len()]
}
