//! The scenes that a person can go through: those that are built in, then the files that were opened.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use super::scene::{SCENES, Scene};

/// The list of scenes, and which of them is open.
#[derive(Clone, Debug)]
pub struct Shelf {
    files: Vec<SceneFile>,
    /// The place of the open scene; `None` of one that is in no list.
    open: Option<usize>,
}

/// A scene that was read from a file.
#[derive(Clone, Debug)]
pub(super) struct SceneFile {
    /// As it was given.
    path: PathBuf,
    /// As it was read last without a mistake.
    pub(super) scene: Scene,
    /// What is wrong with the file since.
    pub(super) mistakes: Option<String>,
}

impl SceneFile {
    /// Its path, for people.
    pub(super) fn name(&self) -> String {
        self.path.display().to_string()
    }
}

impl Shelf {
    /// Of a scene that is taken for the built-in one of its name, if there is one.
    pub(super) fn of(scene: &Scene) -> Self {
        let open = SCENES.iter().position(|built_in| built_in.name == scene.name);
        Self { files: Vec::new(), open }
    }

    /// How many scenes there are.
    pub(super) fn count(&self) -> usize {
        SCENES.len() + self.files.len()
    }

    /// The place of the open scene, if it is in the list.
    pub fn open(&self) -> Option<usize> {
        self.open
    }

    /// The names of all scenes. That of a file has its ending, and no built-in one has; of several files of one name
    /// it is the path.
    pub fn names(&self) -> impl Iterator<Item = String> {
        let built_in = SCENES.iter().map(|scene| scene.name.to_owned());
        built_in.chain(self.files.iter().map(|file| self.file_name(&file.path)))
    }

    fn file_name(&self, path: &Path) -> String {
        let namesakes = self.files.iter().filter(|file| file.path.file_name() == path.file_name());
        let name = path.file_name().filter(|name| namesakes.count() < 2 && has_ending(name));
        name.unwrap_or(path.as_os_str()).display().to_string()
    }

    /// The path of the open scene, if it was read from a file.
    pub fn open_path(&self) -> Option<&Path> {
        Some(&self.file(self.open?)?.path)
    }

    /// The paths of all files, in the order in which they were opened first.
    pub fn paths(&self) -> impl Iterator<Item = &Path> {
        self.files.iter().map(|file| &*file.path)
    }

    pub(super) fn file(&self, place: usize) -> Option<&SceneFile> {
        self.files.get(place.checked_sub(SCENES.len())?)
    }

    /// The scene on this place, as it is in its file.
    pub(super) fn scene(&self, place: usize) -> Scene {
        let built_in = || Scene::built_in(SCENES[place].name).expect("a name of SCENES");
        self.file(place).map_or_else(built_in, |file| file.scene.clone())
    }

    pub(super) fn set_open(&mut self, place: usize) {
        self.open = Some(place);
    }

    /// Puts the scene of a file on the list, in place of what the file was before. Returns its place.
    pub(super) fn put(&mut self, path: &Path, scene: Scene) -> usize {
        let file = SceneFile { path: path.to_owned(), scene, mistakes: None };
        match self.files.iter().position(|known| known.path == path) {
            Some(place) => {
                self.files[place] = file;
                SCENES.len() + place
            }
            None => {
                self.files.push(file);
                self.count() - 1
            }
        }
    }

    /// Notes what is wrong with a file that is on the list.
    pub(super) fn mark(&mut self, path: &Path, mistakes: String) {
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
    fn a_file_never_has_the_name_of_a_built_in_scene_nor_of_another_file() {
        let ship = Scene::built_in("ship").unwrap();
        let mut shelf = Shelf::of(&ship);
        assert_eq!(shelf.names().nth(shelf.open().unwrap()).unwrap(), "ship");
        let place = shelf.put(Path::new("a/ship.toml"), ship.clone());
        assert_eq!(shelf.names().nth(place).unwrap(), "ship.toml");
        assert_eq!(place, SCENES.len());
        let other = shelf.put(Path::new("b/ship.toml"), ship.clone());
        let bare = shelf.put(Path::new("c/ship"), ship.clone());
        let names: Vec<String> = shelf.names().skip(SCENES.len()).collect();
        assert_eq!(names, ["a/ship.toml", "b/ship.toml", "c/ship"]);
        assert_eq!((other, bare), (place + 1, place + 2));
        assert_eq!(shelf.put(Path::new("a/ship.toml"), ship), place, "it keeps its place");
        assert_eq!(shelf.count(), SCENES.len() + 3);
    }
}
