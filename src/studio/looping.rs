//! The loop lab as a mode of the studio. Opens and leaves the lab, and executes commands in it.

use std::path::Path;
use std::sync::Arc;

use super::Studio;
use super::deck::Deck;
use super::guide::Goal;
use super::guiding::{close_guide, return_from_guide};
use super::instrument::Instrument;
use super::step::Step;
use super::viewer::Dialog;
use crate::loops::loop_lab::{
    FoundLoop, LoopCommand, LoopLab, LoopRequest, LoopWorker, SLOWNESS, SLOWNESS_AT_FIRST,
};
use crate::loops::{FrameTrace, PolicyCard, own_loop};
use crate::scene::{SceneBody, SceneErrors, ShownError};
use crate::sim::integrators::{Method, method};

/// Initial method of the body in the loop lab. Its error is small.
const METHOD_AT_FIRST: &str = "rk4";

/// The open loop lab, and the state that returns when it closes.
pub(super) struct OpenLab {
    pub(super) lab: Box<LoopLab>,
    run_goes_on: bool,
    stage_was_alone: bool,
}

/// Returns the reason why the loop lab refuses the displayed body, or `None` if it accepts the body. It refuses a net,
/// because preparing a net for every loop would take too long.
pub fn loop_lab_refusal(studio: &Studio) -> Option<String> {
    let SceneBody { name, kind, .. } = &studio.scene().bodies[studio.viewer.view.body];
    let refusal = "is a net, which the loop lab does not take; open another scene";
    kind.net().is_some().then(|| format!("{name} {refusal}"))
}

/// Opens the loop lab with the displayed body, unless the body is [refused](loop_lab_refusal).
pub(super) fn open_loop_lab(studio: &mut Studio) {
    let body = studio.viewer.view.body;
    let flown = studio.selected().spec.method;
    // A run that has begun goes on in the lab under its method and at its rate, as far as the lab has them.
    let has_begun = studio.race().tick() > 0;
    let usual = method(METHOD_AT_FIRST).expect("a built-in method");
    let method = if has_begun { flown } else { usual };
    if let Some(refusal) = loop_lab_refusal(studio) {
        return studio.viewer.set_notice(refusal);
    }
    let mut loops = LoopLab::new(studio.scene(), body, method);
    let run_goes_on = studio.deck.running;
    let stage_was_alone = !studio.display().measure;
    studio.viewer.preferences.display.measure = true;
    if has_begun {
        loops.set_tick_hz(studio.race().tick_hz());
        loops.set_slowness(slowness_of(studio.clock().speed_percent()));
    } else {
        loops.play_opening();
    }
    studio.loops = Some(OpenLab { lab: loops.into(), run_goes_on, stage_was_alone });
    studio.viewer.preferences.display.instrument = Instrument::Loop;
    studio.viewer.preferences.display.inspector = false;
    studio.deck.let_go();
    studio.viewer.notice = None;
    if studio.viewer.tour.as_ref().is_some_and(|tour| tour.stop().goal != Goal::LoopLab) {
        studio.viewer.leave_guide(studio.deck.left.as_deref());
        studio.viewer.set_notice("the guide is closed: F2 opens it again, L leads to your own run");
    } else if let Some(loops) = studio.loop_lab().filter(|_| has_begun) {
        let notice = format!(
            "the loops start again at t = 0, with your {} at {:.3} Hz, {}",
            loops.method().name,
            loops.scene().tick_hz,
            match loops.slowness() {
                1 => "in real time".into(),
                slowness => format!("{slowness} times slower"),
            },
        );
        studio.viewer.set_notice(notice);
    }
    studio.deck.running = true;
}

/// Returns the slow motion of the loop lab for a run at this speed (percent). At real time and above it is the usual
/// one, because a loop's judder passes too fast to be seen.
fn slowness_of(speed_percent: u32) -> u32 {
    let slower = SLOWNESS.into_iter().rev().find(|slowness| slowness * speed_percent <= 100);
    slower.filter(|_| speed_percent < 100).unwrap_or(SLOWNESS_AT_FIRST)
}

/// Closes the guide, and a loop lab that shows the motion of the guide's stop. Returns whether the guide was open.
pub(super) fn close_guide_and_lab(studio: &mut Studio) -> bool {
    let is_closed = close_guide(studio);
    studio.loops.take_if(|_| is_closed);
    is_closed
}

/// Leaves the loop lab. The run resumes or stays paused as before. If the guide was closed meanwhile, the run that the
/// person left for it returns. Returns whether the loop lab was open.
pub(super) fn leave_loop_lab(studio: &mut Studio) -> bool {
    let Some(open) = studio.loops.take() else { return false };
    studio.deck.running = open.run_goes_on;
    studio.viewer.preferences.display.measure = !open.stage_was_alone;
    studio.viewer.notice = None;
    if studio.display().instrument == Instrument::Loop {
        studio.viewer.preferences.display.instrument = Instrument::Motion;
    }
    if studio.viewer.tour.is_none() {
        return_from_guide(studio);
    }
    true
}

/// Opens the loop lab on the trace of this name, if there is one.
pub fn open_loop_lab_on(studio: &mut Studio, trace: &str) {
    open_loop_lab(studio);
    if let Some(loops) = studio.loop_lab_mut()
        && let Some(index) = loops.traces().iter().position(|known| known.name() == trace)
    {
        loops.choose_trace(index);
        loops.end_opening();
    }
}

/// Opens the loop lab if it is closed, on the first of these traces.
pub fn open_traces(studio: &mut Studio, traces: Vec<FrameTrace>) {
    if studio.loop_lab().is_none() {
        open_loop_lab(studio);
    }
    if let Some(loops) = studio.loop_lab_mut()
        && !traces.is_empty()
    {
        let missing = traces[0].missing_display();
        loops.add_traces(traces);
        loops.end_opening();
        if let Some(missing) = missing {
            studio.viewer.set_notice(missing);
        }
    }
}

/// Whether the loop lab runs the loop with this id beside the ideal ones.
pub fn runs_beside(studio: &Studio, id: &str) -> bool {
    let engine = studio.loop_lab().and_then(|loops| loops.engine());
    engine.is_some_and(|card| card.id == id)
}

/// Reads a person's own loop, which is named after its file.
///
/// # Errors
/// The first fault of its lines, or that they are not text.
pub fn read_own_loop(
    path: &Path,
    bytes: Vec<u8>,
) -> Result<(Arc<PolicyCard>, String), Vec<ShownError>> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let text = String::from_utf8(bytes)
        .map_err(|_| vec![format!("error: {name} is not text; save it as UTF-8").into()])?;
    match own_loop(&path.file_stem().unwrap_or_default().to_string_lossy(), &text) {
        Ok(card) => Ok((card, text)),
        Err(fault) => Err(SceneErrors::of_step(&name, &text, fault).into()),
    }
}

/// Runs a person's own loop beside the others in the loop lab, which opens if it is closed.
pub fn open_own_loop(studio: &mut Studio, card: Arc<PolicyCard>) {
    let told = if runs_beside(studio, &card.id) { "reloaded" } else { "runs beside the others" };
    if studio.loop_lab().is_none() {
        open_loop_lab(studio);
    }
    if let Some(loops) = studio.loop_lab_mut() {
        loops.run_beside(card.clone());
        loops.end_opening();
        studio.viewer.dialog.take_if(|dialog| matches!(dialog, Dialog::Mistakes { .. }));
        studio.viewer.set_notice(format!("{}: {told}", card.id));
    }
}

/// Returns the loops that the open loop lab needs now, as a request to a [`LoopWorker`]. Returns `None` if the lab has
/// all its loops, or is closed.
pub fn loop_request(studio: &Studio) -> Option<Arc<LoopRequest>> {
    let loops = studio.loop_lab().filter(|loops| !loops.is_complete());
    loops.map(|loops| Arc::clone(loops.request()))
}

/// Shows a finished loop, if the loop lab still needs it.
pub fn accept_loop(studio: &mut Studio, found: FoundLoop) {
    if let Some(loops) = studio.loop_lab_mut() {
        loops.accept(found);
    }
}

/// Runs at once all loops that the open loop lab needs.
pub fn run_loops(studio: &mut Studio) {
    let mut worker = LoopWorker::default();
    worker.set_request(loop_request(studio));
    while let Some(found) = worker.work(&|| false) {
        accept_loop(studio, found);
    }
}

/// Shows a notice that the loop lab accepts no command on the run.
pub(super) fn refuse_in_loop_lab(studio: &mut Studio) {
    studio.viewer.set_notice("not in the loop lab: L leaves it");
    end_opening(studio);
}

/// Lets the lab's playback stay on its trace after a command.
pub(super) fn end_opening(studio: &mut Studio) {
    if let Some(loops) = studio.loop_lab_mut() {
        loops.end_opening();
    }
}

/// Shows the displayed body in the open lab, which closes if it refuses the body.
pub(super) fn show_in_loop_lab(studio: &mut Studio) {
    if let Some(refusal) = loop_lab_refusal(studio) {
        leave_loop_lab(studio);
        return studio.viewer.set_notice(refusal);
    }
    let (scene, body) = (studio.deck.run.next().scene.clone(), studio.viewer.view.body);
    if let Some(loops) = studio.loop_lab_mut() {
        loops.show(&scene, body);
    }
}

pub(super) fn change_loop_lab(studio: &mut Studio, command: LoopCommand) {
    let Some(loops) = studio.loop_lab_mut() else {
        if command == LoopCommand::ToggleLab {
            open_loop_lab(studio);
        }
        return;
    };
    match command {
        LoopCommand::ToggleLab => drop(leave_loop_lab(studio)),
        LoopCommand::Select(index) => loops.select(index),
        LoopCommand::Engine(index) => loops.choose_engine(index),
        LoopCommand::ToggleOnStage(index) => loops.toggle(index),
        LoopCommand::Trace(index) => loops.choose_trace(index),
        LoopCommand::Slowness(slowness) => loops.set_slowness(slowness),
        LoopCommand::ShowGameTime(shows_it) => loops.shows_game_time = shows_it,
        LoopCommand::Seek(now_ns) => {
            loops.seek(now_ns);
            studio.deck.running = false;
        }
    }
    end_opening(studio);
}

pub(super) fn method_beside(loops: &LoopLab, step: Step) -> &'static Method {
    let methods: Vec<_> = loops.scene().fitting_methods().collect();
    let index = methods.iter().position(|method| *method == loops.method()).unwrap_or(0);
    methods[step.cyclic_index(index, methods.len())]
}

/// Steps every loop by a method, with a notice.
pub(super) fn set_loop_method(studio: &mut Studio, method: &'static Method) {
    let Some(loops) = studio.loop_lab_mut() else { return };
    let notice = match loops.scene().refusal(method) {
        Some(refusal) => refusal.to_string(),
        None => {
            loops.set_method(method);
            format!("every loop steps by {}", method.name)
        }
    };
    studio.viewer.set_notice(notice);
}

pub(super) fn title_of_loops(deck: &Deck, loops: &LoopLab) -> String {
    let trace = loops.chosen_trace().name();
    let paused = if deck.running { "" } else { " (paused)" };
    format!(
        "Regatta - {} - loop lab: {} - {trace} - {:.3} Hz{paused}",
        deck.scene_name(),
        loops.selected_card().name,
        loops.scene().tick_hz,
    )
}

#[cfg(test)]
mod tests;
