//! Opens built-in scenes and scene files. A file may change while its scene runs.

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
use super::step::Step;
use super::viewer::{Dialog, Viewer};
use crate::run::diff::Comparison;
use crate::run::race::{Author, Mode};
use crate::run::{Run, StartSettings};
use crate::scene::{Action, LaneSpec, Scene, SceneErrors, ShownError};
use crate::sim::TickRate;
use crate::sim::bodies::TakesEffect;
use crate::sim::integrators::Method;

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
    open(&mut studio.deck, &mut studio.viewer, index);
}

/// Adds a person's own method to a race in the open scene, which restarts. An undo brings back the previous run.
pub fn race_own_method(studio: &mut Studio, lane: LaneSpec) {
    let method = lane.method;
    let Studio { deck, viewer, loops, .. } = studio;
    if let Some(refusal) = deck.scene().refusal(method) {
        return viewer.set_notice(refusal.to_string());
    }
    let mut is_raced = true;
    restart(deck, viewer, Some("the method"), |next| is_raced = next.race_own(method));
    if !is_raced {
        return viewer.set_notice(format!(
            "there is no lane left for {}: open a scene with fewer",
            method.id
        ));
    }
    *loops = None;
    deck.openings += 1;
    (viewer.findings, viewer.dialog) = (None, None);
    viewer.set_notice(format!("{}: {}", method.id, method.about));
}

/// Opens the spring that a person has described under the recommended method, in solo mode and running, and shows
/// advice on it. Its entry on the list of scenes is not a file.
pub(super) fn open_spring(deck: &mut Deck, viewer: &mut Viewer) {
    let (spring, tick_hz) = described_spring(deck, viewer);
    open_described(deck, viewer, spring.advised_scene(tick_hz));
}

/// Races the changed lines of a person's own method in place of the earlier ones, if those are in the open scene. The
/// run is repeated to the present tick with the actions by hand, so that all other lanes keep their states.
pub fn reload_own_method(studio: &mut Studio, lane: LaneSpec) {
    let (method, race) = (lane.method, studio.race());
    let (tick, is_race) = (race.tick(), race.mode() == Mode::Race);
    let by_hand = race.journal().rows()[..race.done()].iter();
    let by_hand = by_hand.filter(|row| row.author == Author::Person);
    let mut actions: Vec<(u64, Action)> =
        by_hand.map(|row| (row.tick, row.action.clone())).collect();
    race_own_method(studio, lane);
    if !studio.entries().iter().any(|entry| entry.method == method) {
        return;
    }
    if tick > MAX_RERUN || !is_race {
        let told = format!("{}: reloaded from the start; {}", method.id, method.about);
        return studio.viewer.set_notice(told);
    }
    let Studio { deck, viewer, .. } = studio;
    let mut actions = actions.drain(..).peekable();
    loop {
        let now = deck.race().tick();
        while let Some((_, action)) = actions.next_if(|(at, _)| *at <= now) {
            act(deck, viewer, action);
        }
        if now >= tick {
            break;
        }
        make_tick(deck, viewer, &mut ());
    }
    deck.run.show_present();
    let (id, about) = (method.id, method.about);
    viewer.set_notice(format!("{id}: reloaded, the run repeated to tick {tick}; {about}"));
}

/// Whether a person's own method with this id is in the open scene.
pub fn races_own_method(studio: &Studio, id: &str) -> bool {
    studio.scene().own_methods.iter().any(|own| own.id == id)
}

/// Returns the spring that a person has described, and its tick rate, which is that of the dialog or else the present
/// one.
pub fn described_spring(deck: &Deck, viewer: &Viewer) -> (MySpring, TickRate) {
    let tick_hz = match viewer.dialog {
        Some(Dialog::Spring { tick_hz }) => tick_hz,
        _ => deck.clock.tick_hz(),
    };
    (viewer.preferences.my_spring, tick_hz)
}

/// Opens the result of `MySpring::advised_scene` for a person's spring, or shows the mistakes in it.
pub fn open_advised_spring(studio: &mut Studio, scene: Result<Scene, SceneErrors>) {
    if scene.is_ok() {
        studio.loops = None;
    }
    open_described(&mut studio.deck, &mut studio.viewer, scene);
}

fn open_described(deck: &mut Deck, viewer: &mut Viewer, scene: Result<Scene, SceneErrors>) {
    match scene {
        Ok(scene) => {
            open_as(deck, viewer, MY_SPRING, scene, Mode::Solo);
            viewer.preferences.display.instrument = Instrument::Advice;
            viewer.preferences.display.measure = true;
        }
        Err(errors) => {
            let report = errors.into();
            viewer.dialog = Some(Dialog::Mistakes { file: MY_SPRING.into(), report });
        }
    }
}

/// Opens a scene that is not a file, and runs it in this mode. It has this name on the list of scenes.
pub(super) fn open_as(deck: &mut Deck, viewer: &mut Viewer, name: &str, scene: Scene, mode: Mode) {
    let index = deck.scene_list.add_or_replace(Path::new(name), scene);
    open_with(deck, viewer, index, |next| next.mode = mode);
    deck.running = true;
}

/// Replaces the scene of a changed file. If the scene is open, its run keeps its state: it goes on if actions make the
/// change, such as another mass. Under other equations it is run again to the present tick, and every lane is put into
/// the present state of the selected one. With other lanes, bodies or coordinates it starts at tick 0.
pub fn reload_file(studio: &mut Studio, path: &Path, scene: Scene) {
    let is_open = studio.deck.scene_list.open_path() == Some(path);
    let before = studio.deck.scene_list.open().map(|index| studio.deck.scene_list.scene(index));
    let index = studio.deck.scene_list.add_or_replace(path, scene.clone());
    let Some(before) = before.filter(|_| is_open) else { return };
    let Studio { deck, viewer, loops } = studio;
    let name = deck.scene_name();
    if before.to_toml() == scene.to_toml() {
        viewer.dialog.take_if(|dialog| matches!(dialog, Dialog::Mistakes { .. }));
        return viewer.set_notice(format!("{name} saved; nothing that matters changed"));
    }
    let told = if !is_alike(&before, &scene) {
        let left_out = if is_by_hand(&deck.run) { " (your kicks and edits left out)" } else { "" };
        *loops = None;
        open(deck, viewer, index);
        format!("reloaded from the start, with other lanes or bodies{left_out}")
    } else if let Some(actions) = actions_between(&before, &scene) {
        change_in_flight(deck, viewer, scene, actions)
    } else {
        run_again(deck, viewer, scene)
    };
    viewer.set_notice(format!("{name}: {told}"));
}

/// Shows why the scene at the typed path cannot be opened. `path` is the file at that path. The field for the path
/// stays open.
pub fn refuse_typed_path(
    deck: &mut Deck,
    viewer: &mut Viewer,
    path: &Path,
    report: Vec<ShownError>,
) {
    deck.scene_list.mark(path, report.clone());
    let compares = viewer.compares_typed_path();
    viewer.dialog = Some(Dialog::Path { compares, refused: Some(report) });
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
pub fn file_is_gone(deck: &mut Deck, viewer: &mut Viewer, path: &Path) {
    if let Some(name) = deck.scene_list.name_of(path) {
        viewer.set_notice(format!(
            "{name} is gone: the run continues, and reads the file again when it is back"
        ));
    }
}

/// Reports that a file on the list exists again, with the same text.
pub fn file_is_back(deck: &mut Deck, viewer: &mut Viewer, path: &Path) {
    if let Some(name) = deck.scene_list.name_of(path) {
        viewer.set_notice(format!("{name} is back, unchanged"));
    }
}

/// Shows the errors of a file. The run of the open scene continues.
pub fn show_mistakes(deck: &mut Deck, viewer: &mut Viewer, path: &Path, report: Vec<ShownError>) {
    deck.scene_list.mark(path, report.clone());
    viewer.dialog = Some(Dialog::Mistakes { file: path.display().to_string(), report });
}

/// Records the errors of a changed file, and shows them if the file is open. The run continues.
pub fn reload_failed(deck: &mut Deck, viewer: &mut Viewer, path: &Path, report: Vec<ShownError>) {
    if deck.scene_list.open_path() == Some(path) {
        show_mistakes(deck, viewer, path, report);
    } else {
        deck.scene_list.mark(path, report);
    }
}

/// Makes the open scene, which has changed, that of the next restart, and performs the changes that act at once.
/// Returns a part of a notice.
fn change_in_flight(
    deck: &mut Deck,
    viewer: &mut Viewer,
    scene: Scene,
    actions: Vec<Action>,
) -> String {
    let chosen_rate = deck.run.next().tick_hz != deck.run.next().scene.tick_hz;
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
    let mut told = format!("reloaded, state kept at tick {}", deck.race().tick());
    if !at_once.is_empty() {
        told += &format!(": {}", words(&at_once));
    }
    if !waiting.is_empty() {
        told += &format!("; from the next restart (Home): {}", words(&waiting));
    }
    deck.set_start("the change of the file", |next| {
        next.reload(scene);
        true
    });
    (deck.openings, viewer.findings, viewer.dialog) = (deck.openings + 1, None, None);
    at_once.into_iter().for_each(|action| act(deck, viewer, action));
    deck.run.show_present();
    told
}

/// Runs the open scene, which has changed, to the present tick again, and puts every lane into the present state of the
/// selected one. The chosen methods, rate and display stay. Returns a part of a notice.
fn run_again(deck: &mut Deck, viewer: &mut Viewer, scene: Scene) -> String {
    let (before, selected) = (deck.race().tick(), deck.selected());
    let tick = if before > MAX_RERUN { 0 } else { before };
    let placed = selected.lane.bodies().iter().enumerate().map(|(body, at)| Action::Place {
        body,
        q: at.stepper.q().into(),
        v: at.stepper.v().into(),
    });
    let inputs = [Action::Throttle(deck.race().throttle()), Action::Rudder(deck.race().rudder())];
    let actions: Vec<Action> = placed.chain(inputs).collect();
    let of_all = match deck.mode() {
        Mode::Solo => String::new(),
        Mode::Race => format!(", every lane in that of {}", selected.spec.method.name),
    };
    restart(deck, viewer, Some("the change of the file"), |next| next.reload(scene));
    (deck.openings, viewer.findings, viewer.dialog) = (deck.openings + 1, None, None);
    (0..tick).for_each(|_| make_tick(deck, viewer, &mut ()));
    actions.into_iter().for_each(|action| act(deck, viewer, action));
    deck.running &= !deck.comes_to_rest(viewer.motion());
    deck.run.show_present();
    match tick {
        _ if tick == before => format!("reloaded, state kept at tick {tick}{of_all}"),
        _ => format!("reloaded at time 0, state kept{of_all}: tick {before} is too far to rerun"),
    }
}

/// Shows the clouds with which the scene opens, if any, in place of the stage.
pub fn show_clouds_of_scene(deck: &mut Deck, viewer: &mut Viewer) {
    let Some(shape) = deck.scene().clouds else { return };
    let display = &mut viewer.preferences.display;
    (display.instrument, display.enlarged) = (Instrument::Cloud, true);
    display.cloud.shape = shape;
}

pub(super) fn open_beside(deck: &mut Deck, viewer: &mut Viewer, step: Step) {
    let count = deck.scene_list.count();
    open(deck, viewer, deck.scene_list.open().map_or(0, |here| step.cyclic_index(here, count)));
}

/// Opens the scene at this index of the list, modulo the list's length, under the scene's opening method. Closes the
/// guide, which is about another scene. The preferences stay, and a mode that a person has chosen takes precedence over
/// the scene's.
pub(super) fn open(deck: &mut Deck, viewer: &mut Viewer, index: usize) {
    open_with(deck, viewer, index, |_| ());
}

/// Opens a scene like [`open`], but lets `set` edit the settings of its start. Returns the previous deck.
pub(super) fn open_with(
    deck: &mut Deck,
    viewer: &mut Viewer,
    index: usize,
    set: impl FnOnce(&mut StartSettings),
) -> Deck {
    let mut scene_list = deck.scene_list.clone();
    let index = index % scene_list.count();
    scene_list.set_open(Some(index));
    let mut next = StartSettings::of(scene_list.scene(index));
    next.mode = viewer.preferences.mode.unwrap_or_else(|| Mode::opening(&next.scene));
    set(&mut next);
    let display = &mut viewer.preferences.display;
    if deck.scene().clouds.is_some() && display.enlarged {
        (display.enlarged, display.instrument) = (false, Instrument::Motion);
    }
    let before = std::mem::replace(deck, Deck::new(scene_list, Run::starting_with(next)));
    *viewer = viewer.before_next_scene();
    deck.clock.set_speed_percent(before.clock.speed_percent());
    deck.running = before.runs_or_rests(viewer.motion());
    deck.openings = before.openings + 1;
    deck.run.set_limit(before.run.limit());
    follow(deck, viewer, Jump::ToAnotherRun);
    show_clouds_of_scene(deck, viewer);
    let file = deck.scene_list.file(index);
    let mistakes = file.and_then(|file| Some((file.name(), file.mistakes.clone()?)));
    viewer.dialog = mistakes.map(|(file, report)| Dialog::Mistakes { file, report });
    viewer.leave_guide(before.left.as_deref());
    before
}

#[cfg(test)]
mod tests;
