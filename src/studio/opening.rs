//! Opening built-in scenes and scene files, which may change while they run.

use std::path::Path;

use super::instrument::Instrument;
use super::restarting::is_by_hand;
use super::scene_list::SceneList;
use super::step::Step;
use super::viewer::Dialog;
use super::{RunCommand, StageCommand, Studio};
use crate::run::diff::Comparison;
use crate::run::race::Mode;
use crate::run::{Run, StartSettings};
use crate::scene::{Mistake, Scene, SceneErrors};
use crate::sim::integrators::Method;

/// The name of a custom spring on the list of scenes.
const MY_SPRING: &str = "my spring";
/// With so many methods named, none of them is selected.
pub const MANY_LANES: usize = 10;
/// The most ticks for which a changed scene is run again: an hour at 60 Hz, which takes about a second.
const MAX_RERUN: u64 = 60 * 3600;

impl Studio {
    /// The scenes that can be opened.
    pub fn scene_list(&self) -> &SceneList {
        &self.scene_list
    }

    /// The open scene's name on the list.
    pub fn scene_name(&self) -> String {
        let listed = self.scene_list.open().and_then(|index| self.scene_list.names().nth(index));
        listed.unwrap_or_else(|| self.scene().name.clone())
    }

    /// Lists the open scene as the file at `path`.
    pub fn list_as_file(&mut self, path: &Path) {
        let index = self.scene_list.put(path, self.scene().clone());
        self.scene_list.set_open(index);
        self.tell_outdated();
    }

    /// At tick 0 of a scene, as options ask for it: under the method `selected`, or else the one that the scene opens with.
    /// Of a race in which none was selected the verdicts select one. A single lane is shown solo.
    pub fn opened(scene: Scene, selected: Option<&'static Method>, mode: Mode) -> Self {
        let method = selected.unwrap_or_else(|| scene.opening_lane().method);
        let mut studio = Self::new(scene);
        studio.apply(StageCommand::Method(method));
        if mode == Mode::Race && studio.scene().lanes.len() > 1 {
            studio.apply(StageCommand::ToggleRace);
        } else {
            studio.apply(StageCommand::Restart);
        }
        if mode == Mode::Race && selected.is_none() {
            studio.leave_selection();
        }
        studio.begin_hints();
        studio.forget_changes();
        studio
    }

    /// Opens a scene that was read from the file at `path`, and puts it on the list.
    pub fn open_file(&mut self, path: &Path, scene: Scene) {
        let index = self.scene_list.put(path, scene);
        self.open(index);
        self.tell_outdated();
    }

    /// Tells of a file that says in ticks when its commands are done, which is read for this release only.
    fn tell_outdated(&mut self) {
        if self.scene().outdated.is_some() {
            let name = self.scene_name();
            self.viewer.set_notice(format!(
                "{name}: `tick` in a command is read for this release only; write `at_s`, in seconds"
            ));
        }
    }

    /// Opens the spring that a person has described, alone and running, at the present tick rate, under what is recommended
    /// for it, and advises on it. It is on the list of scenes under a name that is no file's.
    pub(super) fn open_spring(&mut self) {
        let scene = self.viewer.preferences.my_spring.advised_scene(self.clock.tick_hz());
        self.open_advised_spring(scene);
    }

    /// Opens what [`MySpring::advised_scene`](super::MySpring::advised_scene) has made of it.
    pub(crate) fn open_advised_spring(&mut self, scene: Result<Scene, SceneErrors>) {
        let path = Path::new(MY_SPRING);
        match scene {
            Ok(scene) => {
                let index = self.scene_list.put(path, scene);
                self.open_with(index, |next| next.mode = Mode::Solo);
                self.running = true;
                self.viewer.preferences.display.instrument = Instrument::Advice;
            }
            Err(errors) => {
                let report = errors.into();
                self.viewer.dialog = Some(Dialog::Mistakes { file: MY_SPRING.into(), report });
            }
        }
    }

    /// Replaces the scene of a changed file. If it is open and equal, the run goes on; if it has the same lanes and kinds of
    /// bodies, the new scene runs to the present tick; otherwise it starts at tick 0. A notice says that
    /// what a person did in the run is left out.
    pub fn reload_file(&mut self, path: &Path, scene: Scene) {
        let is_open = self.scene_list.open_path() == Some(path);
        let tick = self.race().tick();
        let before = self.scene_list.open().map(|index| self.scene_list.scene(index));
        let is_equal = before.as_ref().is_some_and(|before| before.to_toml() == scene.to_toml());
        let keeps = before.is_some_and(|before| is_alike(&before, &scene));
        let index = self.scene_list.put(path, scene);
        if !is_open {
            return;
        }
        let name = self.scene_name();
        if is_equal {
            self.viewer.dialog.take_if(|dialog| matches!(dialog, Dialog::Mistakes { .. }));
            return self.viewer.set_notice(format!("{name} saved; nothing that matters changed"));
        }
        let is_by_hand = is_by_hand(&self.run);
        let told = if !keeps {
            self.open(index);
            "reloaded from the start, with other lanes or bodies".into()
        } else if tick > MAX_RERUN {
            self.run_again(index, 0);
            format!("reloaded from the start: tick {tick} is too far to rerun")
        } else {
            self.run_again(index, tick);
            format!("reloaded and rerun to tick {tick}")
        };
        let left_out = match (is_by_hand, keeps) {
            (false, _) => "",
            (true, true) => " (your kicks and edits left out; Ctrl Z: old run)",
            // Another scene has another studio.
            (true, false) => " (your kicks and edits left out)",
        };
        self.viewer.set_notice(format!("{name}: {told}{left_out}"));
    }

    /// Shows why the scene at the typed path, which is that of the file at `path`, cannot be opened. The field for the
    /// path stays open.
    pub fn refuse_typed_path(&mut self, path: &Path, report: Vec<Mistake>) {
        self.scene_list.mark(path, report.clone());
        let compares = self.viewer.compares_typed_path();
        self.viewer.dialog = Some(Dialog::Path { compares, refused: Some(report) });
    }

    /// Marks where the recording of this name, which is side a, first differs from the run, and goes there.
    pub fn show_comparison(&mut self, name: &str, found: &Comparison) {
        self.viewer.dialog = None;
        self.viewer.parting = None;
        let told = match &found.first {
            _ if !found.is_comparable() => {
                format!("{name} and this run have nothing to compare that moves")
            }
            None if found.is_same() => format!("{name} is the same in {} rows", found.rows),
            None => {
                format!("{name} and this run are equal in the {} rows that both have", found.rows)
            }
            Some(first) => {
                let told = format!("{name} is a, this run is b; they first differ {first}");
                self.viewer.parting = Some((first.tick, told.clone()));
                self.apply(RunCommand::Seek(first.tick));
                // The run may not have come so far yet.
                let ahead = first.tick.saturating_sub(self.race().tick()).min(MAX_RERUN);
                (0..ahead).for_each(|_| self.tick());
                told
            }
        };
        self.viewer.set_notice(told);
    }

    pub(super) fn type_path(&mut self, path: String) {
        if let Some(Dialog::Path { refused, .. }) = &mut self.viewer.dialog
            && path != self.viewer.preferences.typed_path
        {
            *refused = None;
        }
        self.viewer.preferences.typed_path = path;
    }

    /// Tells that a file on the list is not there any more. The run goes on.
    pub fn file_is_gone(&mut self, path: &Path) {
        if let Some(name) = self.scene_list.name_of(path) {
            self.viewer.set_notice(format!(
                "{name} is gone: the run goes on, and the file is read again when it is back"
            ));
        }
    }

    /// Tells that a file on the list is there again, with the same text.
    pub fn file_is_back(&mut self, path: &Path) {
        if let Some(name) = self.scene_list.name_of(path) {
            self.viewer.set_notice(format!("{name} is back, unchanged"));
        }
    }

    /// Shows the errors of a file. The open run goes on.
    pub fn show_mistakes(&mut self, path: &Path, report: Vec<Mistake>) {
        self.scene_list.mark(path, report.clone());
        self.viewer.dialog = Some(Dialog::Mistakes { file: path.display().to_string(), report });
    }

    /// Records the errors of a changed file, and shows them if it is open. The run goes on.
    pub fn reload_failed(&mut self, path: &Path, report: Vec<Mistake>) {
        if self.scene_list.open_path() == Some(path) {
            self.show_mistakes(path, report);
        } else {
            self.scene_list.mark(path, report);
        }
    }

    /// Runs the open scene with this index, which has changed, to a tick: with the methods, the rate and the display that a
    /// person has chosen, and without actions by hand.
    fn run_again(&mut self, index: usize, tick: u64) {
        let scene = self.scene_list.scene(index);
        self.restart(Some("the change of the file"), |next| {
            // Without a choice the scene's rate applies.
            if next.tick_hz == next.scene.tick_hz {
                next.tick_hz = scene.tick_hz;
            }
            next.opened = scene.clone().into();
            next.scene = scene.into();
        });
        self.openings += 1;
        self.viewer.findings = None;
        self.viewer.dialog = None;
        (0..tick).for_each(|_| self.tick());
        self.running &= !self.comes_to_rest();
        self.run.show_present();
    }

    /// Shows the clouds that the scene opens with, if it does, at full size.
    pub fn show_clouds_of_scene(&mut self) {
        let Some(kind) = self.scene().clouds else { return };
        let display = &mut self.viewer.preferences.display;
        (display.instrument, display.enlarged) = (Instrument::Cloud, true);
        display.cloud.kind = kind;
    }

    pub(super) fn open_beside(&mut self, step: Step) {
        let count = self.scene_list.count();
        self.open(self.scene_list.open().map_or(0, |here| step.around(here, count)));
    }

    /// Opens the scene with this index in the list, modulo its length, under the scene's opening method, and closes the
    /// guide, which is about another. The preferences stay, and so does the mode, unless the scene opens as a race.
    pub(super) fn open(&mut self, index: usize) {
        self.open_with(index, |_| ());
    }

    /// Like [`Self::open`], with the settings of its start as `set` sets them.
    pub(super) fn open_with(&mut self, index: usize, set: impl FnOnce(&mut StartSettings)) {
        let mut scene_list = self.scene_list.clone();
        let index = index % scene_list.count();
        scene_list.set_open(index);
        let mut next = StartSettings::of(scene_list.scene(index));
        next.mode = if next.scene.opens_as_race { Mode::Race } else { self.mode() };
        set(&mut next);
        let mut studio = Self::of_run(scene_list, Run::starting_with(next));
        studio.viewer = self.viewer.before_next_scene(studio.viewer.selected);
        if self.scene().clouds.is_some() && studio.display().enlarged {
            let display = &mut studio.viewer.preferences.display;
            (display.enlarged, display.instrument) = (false, Instrument::Motion);
        }
        studio.show_clouds_of_scene();
        studio.clock.set_speed_percent(self.clock.speed_percent());
        studio.running = self.runs_or_rests();
        studio.run.set_limit(self.run.limit());
        studio.record_chosen_coordinates();
        studio.select_entry_of_start();
        let file = studio.scene_list.file(index);
        let mistakes = file.and_then(|file| Some((file.name(), file.mistakes.clone()?)));
        studio.viewer.dialog = mistakes.map(|(file, report)| Dialog::Mistakes { file, report });
        studio.leave_guide();
        studio.openings = self.openings + 1;
        *self = studio;
    }
}

/// Whether the lanes of a scene race, and which method is selected, where options name these methods. Several race, and so does a
/// scene that opens as a race where none is named; else it is as `asked`. The first is selected, unless they are [`MANY_LANES`].
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

/// Whether a run of one scene can continue in the other: they have equal lanes and bodies of the same kinds.
fn is_alike(a: &Scene, b: &Scene) -> bool {
    let kinds = |scene: &Scene| -> Vec<_> {
        let bodies = scene.bodies.iter();
        bodies.map(|body| (body.kind.id, body.kind.coordinates(&body.values).len())).collect()
    };
    a.lanes == b.lanes && kinds(a) == kinds(b)
}

#[cfg(test)]
mod tests;
