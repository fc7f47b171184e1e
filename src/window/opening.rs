//! Opens scene files that are dropped on the window or typed by their paths, and completes paths.

use std::path::{MAIN_SEPARATOR, Path, PathBuf};
use std::sync::Arc;

use crate::lab::pacing::trace_file;
use crate::lab::scene::{Mistake, SCENES, Scene};
use crate::lab::studio::{StageCommand, Studio, ViewCommand};
use crate::regular_file::{self, MAX_TABLE_BYTES};

/// Reads a scene file and returns its scene and its text, or what the command line would print of its mistakes.
pub type ReadScene = Arc<dyn Fn(&Path) -> Result<(Scene, String), Vec<Mistake>> + Send + Sync>;

/// Keeps the recording of a run so far, a scene file's text, or says why not. It is called every few seconds, with more each
/// time, on a thread of its own.
pub type KeepRecording = Box<dyn FnMut(&str) -> Result<(), String> + Send>;

/// How a window reads and writes scene files, and the one that it starts with.
pub struct SceneFiles {
    /// The function that reads a file.
    pub read: ReadScene,
    /// The file that the window's lab was read from, and its text.
    pub opened: Option<(PathBuf, String)>,
    /// The function that keeps the recording of the run as it grows, if it is recorded.
    pub keep: Option<KeepRecording>,
}

/// Opens the scene file at `path` and returns its path and text. If it cannot be opened, a dialog says why.
pub(super) fn open(
    studio: &mut Studio,
    read: &ReadScene,
    path: &Path,
) -> Option<(PathBuf, String)> {
    if is_trace(path) {
        open_trace(studio, path).unwrap_or_else(|report| studio.show_mistakes(path, report));
        return None;
    }
    let path = known(studio, path);
    match open_listed(studio, read, &path) {
        Ok(text) => Some((path, text)),
        Err(report) => {
            studio.show_mistakes(&path, report);
            None
        }
    }
}

/// Whether a file's name says that it holds a trace of frames.
fn is_trace(path: &Path) -> bool {
    let is =
        |known: &str| path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case(known));
    is("csv") || is("txt")
}

/// Opens the loop lab on the traces in a CSV file.
fn open_trace(studio: &mut Studio, path: &Path) -> Result<(), Vec<Mistake>> {
    let bytes = regular_file::read(path, MAX_TABLE_BYTES)
        .map_err(|why| vec![format!("error: cannot read {}: {why}", path.display()).into()])?;
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let traces = trace_file::from_bytes(&name, &bytes);
    studio.open_traces(traces.map_err(|error| vec![format!("error: {error}").into()])?);
    Ok(())
}

fn open_listed(studio: &mut Studio, read: &ReadScene, path: &Path) -> Result<String, Vec<Mistake>> {
    let (scene, text) = read(path)?;
    studio.open_file(path, scene);
    Ok(text)
}

/// Opens what was typed, as the command line does: the built-in scene of that name, or else the file at that path,
/// whose path and text are returned. If it cannot be opened, the field stays open and says why.
pub(super) fn open_typed(studio: &mut Studio, read: &ReadScene) -> Option<(PathBuf, String)> {
    let typed = studio.viewer().typed_path().trim().to_owned();
    match SCENES.iter().position(|scene| scene.name == typed) {
        Some(index) => {
            studio.apply(StageCommand::Scene(index));
            None
        }
        None => {
            let path = known(studio, &from_home(&typed));
            if is_trace(&path) {
                match open_trace(studio, &path) {
                    Ok(()) => _ = studio.apply(ViewCommand::CloseDialog),
                    Err(report) => studio.refuse_typed_path(&path, report),
                }
                return None;
            }
            match open_listed(studio, read, &path) {
                Ok(text) => Some((path, text)),
                Err(report) => {
                    studio.refuse_typed_path(&path, report);
                    None
                }
            }
        }
    }
}

/// The path under which the file is already on the list of scenes, or else `path` itself.
fn known(studio: &Studio, path: &Path) -> PathBuf {
    let real = path.canonicalize().ok();
    let is_same = |listed: &&Path| real.is_some() && listed.canonicalize().ok() == real;
    studio.scene_list().paths().find(is_same).unwrap_or(path).to_owned()
}

/// Replaces a `~` at the beginning of a path by the home directory.
fn from_home(typed: &str) -> PathBuf {
    let rest = typed.strip_prefix('~').filter(|rest| rest.starts_with(MAIN_SEPARATOR));
    match (rest, std::env::home_dir()) {
        (Some(rest), Some(home)) => home.join(rest.trim_start_matches(MAIN_SEPARATOR)),
        _ => typed.into(),
    }
}

/// Completes a path: appends what all folders and TOML files whose names begin so have in common.
pub(super) fn completed(typed: &str) -> String {
    let (folder, begun) = match typed.rfind(MAIN_SEPARATOR) {
        Some(end) => typed.split_at(end + MAIN_SEPARATOR.len_utf8()),
        None => ("", typed),
    };
    let listed = if folder.is_empty() { PathBuf::from(".") } else { from_home(folder) };
    let entries = std::fs::read_dir(listed).into_iter().flatten().flatten();
    let fitting = entries.filter_map(|entry| {
        let name = entry.file_name().into_string().ok()?;
        let is_hidden = name.starts_with('.') && !begun.starts_with('.');
        if is_hidden || !name.starts_with(begun) {
            return None;
        }
        let path = entry.path();
        if path.is_dir() {
            return Some(format!("{name}{MAIN_SEPARATOR}"));
        }
        path.extension().is_some_and(|ending| ending == "toml").then_some(name)
    });
    let common = fitting.reduce(|common, name| {
        let alike = common.chars().zip(name.chars()).take_while(|(a, b)| a == b);
        alike.map(|(character, _)| character).collect()
    });
    format!("{folder}{}", common.as_deref().unwrap_or(begun))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::studio::Dialog;

    /// Reads scene files without the command line's options.
    fn read() -> ReadScene {
        Arc::new(|path: &Path| {
            let text =
                std::fs::read_to_string(path).map_err(|error| vec![error.to_string().into()])?;
            let scene = Scene::parse(&path.display().to_string(), &text);
            scene.map(|scene| (scene, text)).map_err(Vec::from)
        })
    }

    #[test]
    fn a_file_that_is_dropped_is_opened_and_one_with_mistakes_leaves_the_run_alone() {
        let folder = tempfile::tempdir().unwrap();
        let [good, bad] = ["ship.toml", "bad.toml"].map(|name| folder.path().join(name));
        let text = SCENES.iter().find(|scene| scene.name == "ship").unwrap().text;
        std::fs::write(&good, text).unwrap();
        std::fs::write(&bad, "tick_hz = 0").unwrap();
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        let opened = open(&mut studio, &read(), &good);
        assert_eq!(opened, Some((good, text.to_owned())));
        assert_eq!(studio.scene_name(), "ship.toml");
        studio.tick();
        assert_eq!(open(&mut studio, &read(), &bad), None);
        assert_eq!((studio.scene_name().as_str(), studio.race().tick()), ("ship.toml", 1));
        let Some(Dialog::Mistakes { report, .. }) = studio.viewer().dialog() else { panic!() };
        let message = &report[0].message;
        assert!(message.starts_with(&format!("{}:1:", bad.display())), "{message}");
        studio.apply(ViewCommand::AskForPath);
        studio.apply(ViewCommand::TypePath(bad.display().to_string()));
        assert_eq!(open_typed(&mut studio, &read()), None);
        let Some(Dialog::Path { refused: Some(report) }) = studio.viewer().dialog() else {
            panic!()
        };
        let message = &report[0].message;
        assert!(message.starts_with(&format!("{}:1:", bad.display())), "{message}");
        // The name of a built-in scene opens that, as on the command line.
        studio.apply(ViewCommand::TypePath(" ship ".into()));
        assert_eq!(open_typed(&mut studio, &read()), None);
        assert_eq!((studio.scene_name().as_str(), studio.viewer().dialog()), ("ship", None));
    }

    #[test]
    fn a_path_is_completed_as_far_as_it_is_sure() {
        let folder = tempfile::tempdir().unwrap();
        let root = format!("{}{MAIN_SEPARATOR}", folder.path().display());
        for name in ["ship-a.toml", "ship-b.toml", "ship.png", "other.toml", ".hidden.toml"] {
            std::fs::write(folder.path().join(name), "").unwrap();
        }
        std::fs::create_dir(folder.path().join("deep")).unwrap();
        std::fs::write(folder.path().join("deep/one.toml"), "").unwrap();
        let deep = format!("deep{MAIN_SEPARATOR}");
        for (typed, completed_name) in [
            ("s", "ship-"),
            ("ship-b", "ship-b.toml"),
            ("o", "other.toml"),
            ("x", "x"),
            ("d", deep.as_str()),
            ("", ""),
            (".", ".hidden.toml"),
        ] {
            assert_eq!(completed(&format!("{root}{typed}")), format!("{root}{completed_name}"));
        }
        assert_eq!(completed(&format!("{root}{deep}")), format!("{root}{deep}one.toml"));
        assert_eq!(completed("/no/such/folder/a"), "/no/such/folder/a");
    }

    #[test]
    fn a_file_is_known_by_whatever_path_it_is_opened() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.toml");
        std::fs::write(&path, "").unwrap();
        let mut studio = Studio::new(Scene::built_in("ship").unwrap());
        studio.open_file(&path, Scene::built_in("ship").unwrap());
        assert_eq!(known(&studio, &folder.path().join("./a.toml")), path);
        let other = folder.path().join("b.toml");
        assert_eq!(known(&studio, &other), other);
    }
}
