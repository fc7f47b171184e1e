//! Opens built-in scenes and scene files. A file may change while its scene runs.
//!
//! A person who edits a scene beside the program wants to see the difference at the present moment. So a changed scene
//! runs to the present tick if its lanes and bodies allow that, and otherwise starts at tick 0.

use std::path::Path;

use super::Studio;
use super::command::RunCommand;
use super::compared::Compared;
use super::deck::Deck;
use super::driving::make_tick;
use super::instrument::Instrument;
use super::my_spring::MySpring;
use super::restarting::{Jump, follow, is_by_hand, restart};
use super::step::Step;
use super::viewer::Dialog;
use crate::run::diff::Comparison;
use crate::run::race::Mode;
use crate::run::{Run, StartSettings};
use crate::scene::{LaneSpec, Scene, SceneErrors, ShownError};
use crate::sim::TickRate;
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

/// Whether a run of one scene can continue in the other one. It can if both scenes have equal lanes, and bodies of the
/// same kinds.
fn is_alike(a: &Scene, b: &Scene) -> bool {
    let kinds = |scene: &Scene| -> Vec<_> {
        let bodies = scene.bodies.iter();
        bodies.map(|body| (body.kind.id, body.kind.coordinates(&body.values).len())).collect()
    };
    a.lanes == b.lanes && kinds(a) == kinds(b)
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
    studio.deck.openings += 1;
    (studio.viewer.findings, studio.viewer.dialog) = (None, None);
    studio.viewer.set_notice(format!("{}: {}", method.id, method.about));
}

/// Opens the spring that a person has described under the recommended method, in solo mode and running, and shows
/// advice on it. Its entry on the list of scenes is not a file.
pub(super) fn open_spring(studio: &mut Studio) {
    let (spring, tick_hz) = described_spring(studio);
    open_described(studio, spring.advised_scene(tick_hz));
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

/// Replaces the scene of a changed file. If the scene is open and equal, its run continues. If it has the same lanes
/// and kinds of bodies, the new scene runs to the present tick, unless that would take too long. Otherwise it starts at
/// tick 0. A notice reports if the person's actions were left out.
pub fn reload_file(studio: &mut Studio, path: &Path, scene: Scene) {
    let is_open = studio.deck.scene_list.open_path() == Some(path);
    let tick = studio.race().tick();
    let before = studio.deck.scene_list.open().map(|index| studio.deck.scene_list.scene(index));
    let is_equal = before.as_ref().is_some_and(|before| before.to_toml() == scene.to_toml());
    let keeps = before.is_some_and(|before| is_alike(&before, &scene));
    let index = studio.deck.scene_list.add_or_replace(path, scene);
    if !is_open {
        return;
    }
    let name = studio.deck.scene_name();
    if is_equal {
        studio.viewer.dialog.take_if(|dialog| matches!(dialog, Dialog::Mistakes { .. }));
        return studio.viewer.set_notice(format!("{name} saved; nothing that matters changed"));
    }
    let is_by_hand = is_by_hand(&studio.deck.run);
    let told = if !keeps {
        studio.loops = None;
        open(studio, index);
        "reloaded from the start, with other lanes or bodies".into()
    } else if tick > MAX_RERUN {
        run_again(studio, index, 0);
        format!("reloaded from the start: tick {tick} is too far to rerun")
    } else {
        run_again(studio, index, tick);
        format!("reloaded and rerun to tick {tick}")
    };
    let left_out = match (is_by_hand, keeps) {
        (false, _) => "",
        (true, true) => " (your kicks and edits left out; Ctrl Z: old run)",
        // The undo stack is lost when another scene is opened.
        (true, false) => " (your kicks and edits left out)",
    };
    studio.viewer.set_notice(format!("{name}: {told}{left_out}"));
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

/// Runs the open scene, which has changed, to a tick again. `index` is its place on the list. The chosen methods, rate
/// and display stay, but actions by hand are left out.
fn run_again(studio: &mut Studio, index: usize, tick: u64) {
    let scene = studio.deck.scene_list.scene(index);
    restart(studio, Some("the change of the file"), |next| {
        // The rate of the new scene applies if nobody has chosen a rate.
        if next.tick_hz == next.scene.tick_hz {
            next.tick_hz = scene.tick_hz;
        }
        next.opened = scene.clone().into();
        next.scene = scene.into();
    });
    studio.deck.openings += 1;
    studio.viewer.findings = None;
    studio.viewer.dialog = None;
    (0..tick).for_each(|_| make_tick(studio, &mut ()));
    studio.deck.running &= !studio.deck.comes_to_rest(studio.viewer.motion());
    studio.deck.run.show_present();
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
