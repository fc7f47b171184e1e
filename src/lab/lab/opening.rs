//! Opening scenes: those that are built in, and those of files, which can change while they run.

use std::path::Path;

use super::Lab;
use crate::lab::display::Display;
use crate::lab::scene::Scene;
use crate::lab::shelf::Shelf;
use crate::lab::viewer::Dialog;

/// How far a scene that changed is run again to where it was, in ticks: an hour at 60 Hz, which takes a second or so.
const LONGEST_RERUN: u64 = 60 * 3600;

impl Lab {
    /// The scenes that can be gone through.
    pub fn shelf(&self) -> &Shelf {
        &self.shelf
    }

    /// The name under which the open scene is listed.
    pub fn scene_name(&self) -> String {
        let listed = self.shelf.open().and_then(|place| self.shelf.names().nth(place));
        listed.unwrap_or_else(|| self.scene().name.clone())
    }

    /// Puts the open scene on the list as that of the file at `path`.
    pub fn list_as_file(&mut self, path: &Path) {
        let place = self.shelf.put(path, self.scene().clone());
        self.shelf.set_open(place);
    }

    /// Opens a scene that was read from the file at `path`, and puts it on the list.
    pub fn open_file(&mut self, path: &Path, scene: Scene) {
        let place = self.shelf.put(path, scene);
        self.open(place);
    }

    /// Takes in that a file on the list was changed. If it is open, the new scene is run to the tick that the old one
    /// had reached, if it has the same lanes and bodies of the same kinds; else it begins.
    pub fn reload_file(&mut self, path: &Path, scene: Scene) {
        let is_open = self.shelf.open_path() == Some(path);
        let tick = self.race().tick();
        let before = self.shelf.open().map(|place| self.shelf.scene(place));
        let keeps = before.is_some_and(|before| is_alike(&before, &scene));
        let place = self.shelf.put(path, scene);
        if !is_open {
            return;
        }
        let name = self.scene_name();
        if !keeps {
            self.open(place);
            self.set_notice(format!("{name} changed: it begins again, with other lanes or bodies"));
        } else if tick > LONGEST_RERUN {
            self.run_again(place, 0);
            self.set_notice(format!("{name} changed: it begins again, as tick {tick} is far"));
        } else {
            self.run_again(place, tick);
            self.set_notice(format!("{name} changed: run again to tick {tick}"));
        }
    }

    /// Tells what is wrong with a file. The run that is open goes on.
    pub fn show_mistakes(&mut self, path: &Path, report: String) {
        self.shelf.mark(path, report.clone());
        self.viewer.dialog = Some(Dialog::Mistakes { file: path.display().to_string(), report });
    }

    /// Takes in that a file on the list was changed and is no scene any more. The run goes on.
    pub fn reload_failed(&mut self, path: &Path, report: String) {
        if self.shelf.open_path() == Some(path) {
            self.show_mistakes(path, report);
        } else {
            self.shelf.mark(path, report);
        }
    }

    /// Runs the scene on this place, which is open and has changed, to a tick: under the methods, the rate and the looks
    /// that a person has chosen, and without what was done by hand.
    fn run_again(&mut self, place: usize, tick: u64) {
        let scene = self.shelf.scene(place);
        // What nobody has chosen is as the scene has it.
        if self.start.tick_hz == self.start.scene.tick_hz {
            self.start.tick_hz = scene.tick_hz;
        }
        self.start.opened = scene.clone().into();
        self.start.scene = scene.into();
        self.viewer.findings = None;
        self.viewer.dialog = None;
        self.restart();
        (0..tick).for_each(|_| self.tick());
        self.timeline.show_present();
    }

    pub(super) fn open_beside(&mut self, forward: bool) {
        let count = self.shelf.count();
        let offset = if forward { 1 } else { count - 1 };
        self.open(self.shelf.open().map_or(0, |here| (here + offset) % count));
    }

    /// Opens the scene on this place of the list, round, under its own opening method; mode and look stay as they are.
    pub(super) fn open(&mut self, place: usize) {
        let place = place % self.shelf.count();
        let mut lab = Lab::new(self.shelf.scene(place));
        lab.shelf = self.shelf.clone();
        lab.shelf.set_open(place);
        lab.start.mode = self.mode();
        lab.viewer.display = Display { body: 0, lenses: Vec::new(), ..self.display().clone() };
        lab.viewer.typed_path = self.viewer.typed_path.clone();
        lab.viewer.pace = self.viewer.pace;
        lab.clock.set_speed_percent(self.clock.speed_percent());
        lab.running = self.running;
        lab.restart();
        let file = lab.shelf.file(place);
        let mistakes = file.and_then(|file| Some((file.name(), file.mistakes.clone()?)));
        lab.viewer.dialog = mistakes.map(|(file, report)| Dialog::Mistakes { file, report });
        *self = lab;
    }
}

/// Whether a run of one scene can be gone on with in the other.
fn is_alike(a: &Scene, b: &Scene) -> bool {
    let kinds = |scene: &Scene| -> Vec<_> {
        let bodies = scene.bodies.iter();
        bodies.map(|body| (body.kind.id, (body.kind.coordinates)(&body.values).len())).collect()
    };
    a.lanes == b.lanes && kinds(a) == kinds(b)
}

#[cfg(test)]
mod tests;
