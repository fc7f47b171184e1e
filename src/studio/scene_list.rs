//! The scenes that a person can open. The built-in scenes come before the opened files.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use crate::run::race::{Lane, LaneBody};
use crate::scene::{BuiltIn, SCENES, Scene, ShownError};
use crate::sim::Solver;
use crate::sim::bodies::Origin;

/// The list of scenes, and the index of the open one.
#[derive(Clone, Debug)]
pub struct SceneList {
    files: Vec<SceneFile>,
    /// Index of the open scene, or `None` if that is not on the list.
    open: Option<usize>,
}

/// A scene from a file.
#[derive(Clone, Debug)]
pub(super) struct SceneFile {
    /// The path, as it was given.
    path: PathBuf,
    /// The scene, as it was last read without errors.
    pub(super) scene: Scene,
    /// Errors in the file's present text, if it has any.
    pub(super) mistakes: Option<Vec<ShownError>>,
}

impl SceneFile {
    /// Returns the path for people.
    pub(super) fn name(&self) -> String {
        self.path.display().to_string()
    }
}

impl SceneList {
    /// Creates a list of the built-in scenes. The one with the name of `scene` is open.
    pub(super) fn of(scene: &Scene) -> Self {
        let is_open = |built_in: &BuiltIn| built_in.name == scene.name && scene.in_rust().is_none();
        let open = SCENES.iter().position(is_open);
        Self { files: Vec::new(), open }
    }

    /// Parses every built-in scene, and previews bodies whose drawing depends on their motion. Otherwise the first
    /// opening of such a scene would wait for this.
    pub fn prepare() {
        let scenes = SCENES.iter().filter_map(|scene| Scene::built_in(scene.name));
        scenes.for_each(|scene| Self::prepare_scene(&scene));
    }

    /// [Prepares](Self::prepare) one scene.
    pub fn prepare_scene(scene: &Scene) {
        let truth = Lane::new(scene, Solver::Truth, 1);
        let is_followed = |body: &&LaneBody| !matches!(body.kind.origin, Origin::Table);
        truth.bodies().iter().filter(is_followed).for_each(|body| drop(body.preview()));
    }

    pub(super) fn count(&self) -> usize {
        SCENES.len() + self.files.len()
    }

    /// Returns the index of the open scene, if it is on the list.
    pub fn open(&self) -> Option<usize> {
        self.open
    }

    /// Returns the names of all scenes. The name of a file includes its extension. If several files have the same name,
    /// their paths are listed.
    pub fn names(&self) -> impl Iterator<Item = String> {
        let built_in = SCENES.iter().map(|scene| scene.name.to_owned());
        built_in.chain(self.files.iter().map(|file| self.file_name(&file.path)))
    }

    /// Returns the name under which the file at `path` is listed, if it is on the list.
    pub(super) fn name_of(&self, path: &Path) -> Option<String> {
        self.paths().any(|listed| listed == path).then(|| self.file_name(path))
    }

    fn file_name(&self, path: &Path) -> String {
        let namesakes = self.files.iter().filter(|file| file.path.file_name() == path.file_name());
        let name = path.file_name().filter(|name| namesakes.count() < 2 && has_ending(name));
        name.unwrap_or(path.as_os_str()).display().to_string()
    }

    /// Returns the path of the open scene's file, if it comes from a file.
    pub fn open_path(&self) -> Option<&Path> {
        Some(&self.file(self.open?)?.path)
    }

    /// Returns the paths of all files, in the order in which they were first opened.
    pub fn paths(&self) -> impl Iterator<Item = &Path> {
        self.files.iter().map(|file| &*file.path)
    }

    pub(super) fn file(&self, index: usize) -> Option<&SceneFile> {
        self.files.get(index.checked_sub(SCENES.len())?)
    }

    /// Returns the scene at this index, as it was last read from its file.
    pub(super) fn scene(&self, index: usize) -> Scene {
        let built_in = || Scene::built_in(SCENES[index].name).expect("a name of SCENES");
        self.file(index).map_or_else(built_in, |file| file.scene.clone())
    }

    pub(super) fn set_open(&mut self, index: Option<usize>) {
        self.open = index;
    }

    /// Puts the scene of a file on the list, or replaces the earlier scene of the same file. Returns its index.
    pub(super) fn add_or_replace(&mut self, path: &Path, scene: Scene) -> usize {
        let file = SceneFile { path: path.to_owned(), scene, mistakes: None };
        match self.files.iter().position(|known| known.path == path) {
            Some(index) => {
                self.files[index] = file;
                SCENES.len() + index
            }
            None => {
                self.files.push(file);
                self.count() - 1
            }
        }
    }

    /// Records the errors of a file on the list.
    pub(super) fn mark(&mut self, path: &Path, mistakes: Vec<ShownError>) {
        if let Some(file) = self.files.iter_mut().find(|file| file.path == path) {
            file.mistakes = Some(mistakes);
        }
    }
}

fn has_ending(name: &OsStr) -> bool {
    Path::new(name).extension().is_some()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_file_on_the_list_has_a_name_of_its_own() {
        let ship = Scene::built_in("ship").unwrap();
        let mut scene_list = SceneList::of(&ship);
        assert_eq!(scene_list.names().nth(scene_list.open().unwrap()).unwrap(), "ship");
        let index = scene_list.add_or_replace(Path::new("a/ship.toml"), ship.clone());
        assert_eq!(scene_list.names().nth(index).unwrap(), "ship.toml");
        assert_eq!(index, SCENES.len());
        let other = scene_list.add_or_replace(Path::new("b/ship.toml"), ship.clone());
        let bare = scene_list.add_or_replace(Path::new("c/ship"), ship.clone());
        let names: Vec<String> = scene_list.names().skip(SCENES.len()).collect();
        assert_eq!(names, ["a/ship.toml", "b/ship.toml", "c/ship"]);
        assert_eq!((other, bare), (index + 1, index + 2));
        assert_eq!(
            scene_list.add_or_replace(Path::new("a/ship.toml"), ship),
            index,
            "it keeps its index"
        );
        assert_eq!(scene_list.count(), SCENES.len() + 3);
    }
}
