//! Opens built-in scenes and scene files. A file may change while its scene runs.
//!
//! A person who edits a scene beside the program wants to see the difference at the present moment. So a changed scene
//! runs to the present tick if its lanes and bodies allow that, and otherwise starts at tick 0.

use std::path::Path;

use super::Studio;
use super::acting::act;
use super::command::RunCommand;
use super::compared::Compared;
use super::deck::Deck;
use super::driving::make_tick;
use super::instrument::Instrument;
use super::my_spring::MySpring;
use super::restarting::{Jump, follow, is_by_hand, restart};
use super::run_before::RunBefore;
use super::step::Step;
use super::viewer::Dialog;
use crate::run::diff::Comparison;
use crate::run::race::{Entrant, Mode};
use crate::run::{Run, StartSettings};
use crate::scene::{Action, LaneSpec, Scene, SceneErrors, ShownError};
use crate::sim::bodies::TakesEffect;
use crate::sim::integrators::Method;
use crate::sim::{TickRate, own_method_id};

/// Name that a custom spring has on the list of scenes.
const MY_SPRING: &str = "my spring";
/// Number of named methods from which none of them is selected.
pub const MANY_LANES: usize = 10;
/// Maximum tick to which a changed scene is run again. It is an hour at 60 Hz, which takes about a second to compute.
const MAX_RERUN: u64 = 60 * 3600;

/// Returns the mode and the selected method of a scene, for options that name `methods`. Several methods race. Without
/// any method, a scene that opens as a race does so. In all other cases, `asked` is the mode. The first method is
/// selected, unless there are [`MANY_LANES`] or more.
pub fn lineup(
    scene: &Scene,
    methods: &[&'static Method],
    asked: Mode,
) -> (Mode, Option<&'static Method>) {
    let mode = match methods.len() {
        0 if scene.opens_as_race => Mode::Race,
        0 | 1 => asked,
        _ => Mode::Race,
    };
    (mode, methods.first().filter(|_| methods.len() < MANY_LANES).copied())
}

/// Whether the states of one scene's run fit the other scene: both have lanes of the same methods by id, and bodies of
/// the same kinds.
fn is_alike(a: &Scene, b: &Scene) -> bool {
    let kinds = |scene: &Scene| -> Vec<_> {
        let bodies = scene.bodies.iter();
        bodies.map(|body| (body.kind.id, body.kind.coordinates(&body.values).len())).collect()
    };
    let lanes = |scene: &Scene| -> Vec<_> {
        let lanes = scene.lanes.iter();
        lanes
            .map(|lane| (lane.method.id, LaneSpec { method: a.lanes[0].method, ..*lane }))
            .collect()
    };
    lanes(a) == lanes(b) && kinds(a) == kinds(b)
}

/// Returns the actions that turn a run of one scene, in any state, into a run of the other scene. `None` if no actions
/// do, because the equations, the lines of a method or the script differ.
fn actions_between(before: &Scene, after: &Scene) -> Option<Vec<Action>> {
    let same_kinds = before
        .bodies
        .iter()
        .zip(&after.bodies)
        .all(|(a, b)| a.kind == b.kind && a.values.len() == b.values.len());
    if !same_kinds || before.lanes != after.lanes || before.script != after.script {
        return None;
    }
    let bodies = before.bodies.iter().zip(&after.bodies).enumerate();
    let set = bodies.flat_map(|(body, (a, b))| {
        let values = a.values.iter().zip(&b.values).enumerate();
        let changed = values.filter(|(_, (before, after))| before != after);
        changed.map(move |(parameter, (_, &value))| Action::Set { body, parameter, value })
    });
    let rate = (before.tick_hz != after.tick_hz).then_some(Action::TickHz(after.tick_hz));
    Some(set.chain(rate).collect())
}

/// Puts the open scene on the list as the file at `path`.
pub fn list_as_file(deck: &mut Deck, path: &Path) {
    let index = deck.scene_list.add_or_replace(path, deck.scene().clone());
    deck.scene_list.set_open(Some(index));
}

/// Opens a scene from the file at `path`, and puts it on the list.
pub fn open_file(studio: &mut Studio, path: &Path, scene: Scene) {
    studio.loops = None;
    let index = studio.deck.scene_list.add_or_replace(path, scene);
    open(studio, index);
}

/// Adds a person's own method to a race in the open scene, which restarts. An undo brings back the previous run.
pub fn race_own_method(studio: &mut Studio, lane: LaneSpec) {
    let method = lane.method;
    if let Some(refusal) = studio.scene().refusal(method) {
        let refusal = refusal.to_string();
        return studio.viewer.set_notice(refusal);
    }
    let mut is_raced = true;
    restart(studio, Some("the method"), |next| is_raced = next.race_own(method));
    if !is_raced {
        return studio.viewer.set_notice(format!(
            "there is no lane left for {}: open a scene with fewer",
            method.id
        ));
    }
    studio.loops = None;
    count_as_opened(studio);
    studio.viewer.set_notice(format!("{}: {}", method.id, method.about));
}

/// Counts the open run as another one than before, whose findings are not yet known.
fn count_as_opened(studio: &mut Studio) {
    studio.deck.openings += 1;
    (studio.viewer.findings, studio.viewer.dialog) = (None, None);
}

/// Opens the spring that a person has described under the recommended method, in solo mode and running, and shows
/// advice on it. Its entry on the list of scenes is not a file.
pub(super) fn open_spring(studio: &mut Studio) {
    let (spring, tick_hz) = described_spring(studio);
    open_described(studio, spring.advised_scene(tick_hz));
}

/// Races the changed lines of a person's own method in place of the earlier ones, if those are in the open scene. Their
/// lanes are switched in flight, so that every lane keeps its state.
pub fn reload_own_method(studio: &mut Studio, lane: LaneSpec) {
    let method = lane.method;
    if let Some(refusal) = studio.scene().refusal(method) {
        return studio.viewer.set_notice(refusal.to_string());
    }
    studio.deck.set_start("the change of the file", |next| {
        next.know_own(method);
        true
    });
    count_as_opened(studio);
    let lanes = studio.race().entrants().iter().filter(|it| it.spec.method.id == method.id);
    let switches = lanes.map(|&Entrant { id: lane, spec, .. }| Action::Lane {
        lane,
        spec: LaneSpec { method, ..spec },
    });
    act_as_in_file(studio, switches.collect());
    studio.deck.run.show_present();
    let (id, about, tick) = (method.id, method.about, studio.race().tick());
    studio.viewer.set_notice(format!("{id}: reloaded, state kept at tick {tick}; {about}"));
}

/// Performs actions that a change of a file asks for.
fn act_as_in_file(studio: &mut Studio, actions: Vec<Action>) {
    let tick = studio.race().tick();
    for action in actions {
        studio.deck.of_files.push((tick, action.clone()));
        act(studio, action);
    }
}

/// Whether a person's own method is in the open scene, from a file whose name without its extension is `stem`.
pub fn races_own_method(studio: &Studio, stem: &str) -> bool {
    let id = own_method_id(stem);
    studio.scene().own_methods.iter().any(|own| own.id == id)
}

/// Returns the spring that a person has described, and its tick rate, which is that of the dialog or else the present
/// one.
pub fn described_spring(studio: &Studio) -> (MySpring, TickRate) {
    let tick_hz = match studio.viewer.dialog {
        Some(Dialog::Spring { tick_hz }) => tick_hz,
        _ => studio.deck.clock.tick_hz(),
    };
    (studio.viewer.preferences.my_spring, tick_hz)
}

/// Opens the result of `MySpring::advised_scene` for a person's spring, or shows the mistakes in it.
pub fn open_advised_spring(studio: &mut Studio, scene: Result<Scene, SceneErrors>) {
    if scene.is_ok() {
        studio.loops = None;
    }
    open_described(studio, scene);
}

fn open_described(studio: &mut Studio, scene: Result<Scene, SceneErrors>) {
    match scene {
        Ok(scene) => {
            open_as(studio, MY_SPRING, scene, Mode::Solo);
            studio.viewer.preferences.display.instrument = Instrument::Advice;
            studio.viewer.preferences.display.measure = true;
        }
        Err(errors) => {
            let report = errors.into();
            studio.viewer.dialog = Some(Dialog::Mistakes { file: MY_SPRING.into(), report });
        }
    }
}

/// Opens a scene that is not a file, and runs it in this mode. It has this name on the list of scenes.
pub(super) fn open_as(studio: &mut Studio, name: &str, scene: Scene, mode: Mode) {
    let index = studio.deck.scene_list.add_or_replace(Path::new(name), scene);
    open_with(studio, index, |next| next.mode = mode);
    studio.deck.running = true;
}

/// Replaces the scene of a changed file. If the scene is open, its run keeps its state: it goes on if actions make the
/// change, such as another mass. Under other equations it is run again to the present tick, and every lane is put into
/// the present state of the selected one, whose past stays drawn. With other lanes, bodies or coordinates it starts at
/// tick 0.
pub fn reload_file(studio: &mut Studio, path: &Path, scene: Scene) {
    let is_open = studio.deck.scene_list.open_path() == Some(path);
    let before = studio.deck.scene_list.open().map(|index| studio.deck.scene_list.scene(index));
    let index = studio.deck.scene_list.add_or_replace(path, scene.clone());
    let Some(before) = before.filter(|_| is_open) else { return };
    let name = studio.deck.scene_name();
    if before.to_toml() == scene.to_toml() {
        studio.viewer.dialog.take_if(|dialog| matches!(dialog, Dialog::Mistakes { .. }));
        return studio.viewer.set_notice(format!("{name} saved; nothing that matters changed"));
    }
    let told = if !is_alike(&before, &scene) {
        let left_out =
            if is_by_hand(&studio.deck) { " (your kicks and edits left out)" } else { "" };
        studio.loops = None;
        open(studio, index);
        format!("reloaded from the start, with other lanes or bodies{left_out}")
    } else if let Some(actions) = actions_between(&before, &scene) {
        change_in_flight(studio, scene, actions)
    } else {
        run_again(studio, scene)
    };
    studio.viewer.set_notice(format!("{name}: {told}"));
}

/// Shows why the scene at the typed path cannot be opened. `path` is the file at that path. The field for the path
/// stays open.
pub fn refuse_typed_path(studio: &mut Studio, path: &Path, report: Vec<ShownError>) {
    studio.deck.scene_list.mark(path, report.clone());
    let compares = studio.viewer.compares_typed_path();
    studio.viewer.dialog = Some(Dialog::Path { compares, refused: Some(report) });
}

/// Moves to the first difference between a recording and the run. From there on, the stage shows the recording beside
/// the run.
pub fn show_comparison(studio: &mut Studio, name: &str, found: &Comparison, recording: Scene) {
    studio.viewer.dialog = None;
    studio.deck.compared = None;
    let compared = Compared::new(name, recording, found.first.as_ref(), studio.run());
    let told = match compared {
        _ if !found.is_comparable() => format!("{name} and this run share nothing that moves"),
        None if found.is_same() => format!("{name} is the same in {} rows", found.rows),
        None => format!("{name} and this run are equal in the {} rows that both have", found.rows),
        // The stage shows what differs.
        Some(compared) => {
            let tick = compared.tick();
            studio.deck.compared = Some(compared.into());
            studio.apply(RunCommand::Seek(tick));
            // The run may not yet have reached the tick of the difference.
            let ahead = tick.saturating_sub(studio.race().tick()).min(MAX_RERUN);
            (0..ahead).for_each(|_| studio.tick());
            studio.deck.follow_with_compared(studio.race().t());
            studio.viewer.notice = None;
            return;
        }
    };
    studio.viewer.set_notice(told);
}

/// Reports that a file on the list no longer exists. The run continues.
pub fn file_is_gone(studio: &mut Studio, path: &Path) {
    if let Some(name) = studio.deck.scene_list.name_of(path) {
        studio.viewer.set_notice(format!(
            "{name} is gone: the run continues, and reads the file again when it is back"
        ));
    }
}

/// Reports that a file on the list exists again, with the same text.
pub fn file_is_back(studio: &mut Studio, path: &Path) {
    if let Some(name) = studio.deck.scene_list.name_of(path) {
        studio.viewer.set_notice(format!("{name} is back, unchanged"));
    }
}

/// Shows the errors of a file. The run of the open scene continues.
pub fn show_mistakes(studio: &mut Studio, path: &Path, report: Vec<ShownError>) {
    studio.deck.scene_list.mark(path, report.clone());
    studio.viewer.dialog = Some(Dialog::Mistakes { file: path.display().to_string(), report });
}

/// Records the errors of a changed file, and shows them if the file is open. The run continues.
pub fn reload_failed(studio: &mut Studio, path: &Path, report: Vec<ShownError>) {
    if studio.deck.scene_list.open_path() == Some(path) {
        show_mistakes(studio, path, report);
    } else {
        studio.deck.scene_list.mark(path, report);
    }
}

/// Makes the open scene, which has changed, that of the next restart, and performs the changes that act at once.
/// Returns a part of a notice.
fn change_in_flight(studio: &mut Studio, scene: Scene, actions: Vec<Action>) -> String {
    let chosen_rate = studio.deck.run.next().tick_hz != studio.deck.run.next().scene.tick_hz;
    let waits = |action: &Action| {
        matches!(action, Action::Set { body, parameter, .. }
            if scene.bodies[*body].kind.parameters[*parameter].acts == TakesEffect::AtStart)
    };
    let actions = actions.into_iter().filter(|it| it.tick_hz().is_none() || !chosen_rate);
    let (waiting, at_once): (Vec<_>, Vec<_>) = actions.partition(waits);
    let words = |actions: &[Action]| -> String {
        let words: Vec<_> = actions.iter().map(|action| action.in_words(&scene)).collect();
        words.join(", ")
    };
    let mut told = format!("reloaded, state kept at tick {}", studio.deck.race().tick());
    if !at_once.is_empty() {
        told += &format!(": {}", words(&at_once));
    }
    if !waiting.is_empty() {
        told += &format!("; from the next restart (Home): {}", words(&waiting));
    }
    studio.deck.set_start("the change of the file", |next| {
        next.reload(scene);
        true
    });
    count_as_opened(studio);
    act_as_in_file(studio, at_once);
    studio.deck.run.show_present();
    told
}

/// Runs the open scene, which has changed, to the present tick again, and puts every lane into the present state of the
/// selected one. The chosen methods, rate and display stay. Returns a part of a notice.
fn run_again(studio: &mut Studio, scene: Scene) -> String {
    let (before, selected) = (studio.deck.race().tick(), studio.deck.selected());
    let tick = if before > MAX_RERUN { 0 } else { before };
    let (histories, from_s) =
        (studio.past().histories(selected.id).to_vec(), studio.deck.drawn_from_s());
    let placed = selected.lane.bodies().iter().enumerate().map(|(body, at)| Action::Place {
        body,
        q: at.stepper.q().into(),
        v: at.stepper.v().into(),
    });
    let inputs = [
        Action::Throttle(studio.deck.race().throttle()),
        Action::Rudder(studio.deck.race().rudder()),
    ];
    let actions: Vec<Action> = placed.chain(inputs).collect();
    let of_all = match studio.deck.mode() {
        Mode::Solo => String::new(),
        Mode::Race => format!(", every lane in that of {}", selected.spec.method.name),
    };
    restart(studio, Some("the change of the file"), |next| next.reload(scene));
    count_as_opened(studio);
    for _ in 0..tick {
        make_tick(studio, &mut ());
    }
    act_as_in_file(studio, actions);
    if tick == before {
        let (until_s, name) = (studio.race().t(), "the file as it was".into());
        let run_before = RunBefore { histories, from_s, until_s, name, is_continued: true };
        studio.deck.run_before = Some(run_before.into());
    }
    studio.deck.running &= !studio.deck.comes_to_rest(studio.viewer.motion());
    studio.deck.run.show_present();
    match tick {
        _ if tick == before => format!("reloaded, state kept at tick {tick}{of_all}"),
        _ => format!("reloaded at time 0, state kept{of_all}: tick {before} is too far to rerun"),
    }
}

/// Shows the clouds with which the scene opens, if any, in place of the stage.
pub fn show_clouds_of_scene(studio: &mut Studio) {
    let Some(shape) = studio.scene().clouds else { return };
    let display = &mut studio.viewer.preferences.display;
    (display.instrument, display.enlarged) = (Instrument::Cloud, true);
    display.cloud.shape = shape;
}

pub(super) fn open_beside(studio: &mut Studio, step: Step) {
    let count = studio.deck.scene_list.count();
    open(studio, studio.deck.scene_list.open().map_or(0, |here| step.cyclic_index(here, count)));
}

/// Opens the scene at this index of the list, modulo the list's length, under the scene's opening method. Closes the
/// guide, which is about another scene. The preferences stay, and a mode that a person has chosen takes precedence over
/// the scene's.
pub(super) fn open(studio: &mut Studio, index: usize) {
    open_with(studio, index, |_| ());
}

/// Opens a scene like [`open`], but lets `set` edit the settings of its start. Returns the previous deck.
pub(super) fn open_with(
    studio: &mut Studio,
    index: usize,
    set: impl FnOnce(&mut StartSettings),
) -> Deck {
    let mut scene_list = studio.deck.scene_list.clone();
    let index = index % scene_list.count();
    scene_list.set_open(Some(index));
    let mut next = StartSettings::of(scene_list.scene(index));
    next.mode = studio.viewer.preferences.mode.unwrap_or_else(|| Mode::opening(&next.scene));
    set(&mut next);
    let display = &mut studio.viewer.preferences.display;
    if studio.deck.scene().clouds.is_some() && display.enlarged {
        (display.enlarged, display.instrument) = (false, Instrument::Motion);
    }
    let before =
        std::mem::replace(&mut studio.deck, Deck::new(scene_list, Run::starting_with(next)));
    studio.viewer = studio.viewer.before_next_scene();
    studio.deck.clock.set_speed_percent(before.clock.speed_percent());
    studio.deck.running = before.runs_or_rests(studio.viewer.motion());
    studio.deck.openings = before.openings + 1;
    studio.deck.run.set_limit(before.run.limit());
    follow(studio, Jump::ToAnotherRun);
    show_clouds_of_scene(studio);
    let file = studio.deck.scene_list.file(index);
    let mistakes = file.and_then(|file| Some((file.name(), file.mistakes.clone()?)));
    studio.viewer.dialog = mistakes.map(|(file, report)| Dialog::Mistakes { file, report });
    studio.viewer.leave_guide(before.left.as_deref());
    before
}

#[cfg(test)]
mod tests;
