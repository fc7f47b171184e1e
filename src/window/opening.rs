//! Opens scene files, traces, methods and loops that are dropped on the window or typed as paths, and completes paths.

use std::path::{MAIN_SEPARATOR, Path, PathBuf, is_separator};
use std::sync::Arc;

use super::caught::caught;
use crate::loops::{FrameTrace, PolicyCard, trace_file};
use crate::regular_file::{self, MAX_TABLE_BYTES};
use crate::run::diff::{Chosen, Comparison, NotComparable, Tolerance, diff};
use crate::run::trace::{Made, last_tick};
use crate::scene::{LaneSpec, MAX_FILE_BYTES, SCENES, Scene, ShownError, is_rule};
use crate::studio::{
    SceneList, StageCommand, Studio, ViewCommand, open_file, open_own_loop, open_traces,
    race_own_method, races_own_method, read_own_loop, refuse_typed_path, reload_failed,
    reload_file, reload_own_method, runs_beside, show_comparison, show_mistakes,
};

/// Reads a scene file. Returns its scene and its text, or its mistakes as the command line would print them.
pub type ReadScene = Arc<dyn Fn(&Path) -> Result<(Scene, String), Vec<ShownError>> + Send + Sync>;

/// Saves the recording of a run so far, the text of a scene file, or returns the reason why it cannot. Called every
/// few seconds on a separate thread, each time with a longer text.
pub type KeepRecording = Box<dyn FnMut(&str) -> Result<(), String> + Send>;

/// Functions that read and write scene files for a window, and the file that it starts with.
pub struct SceneFiles {
    /// The function that reads a file.
    pub read: ReadScene,
    /// The file of the window's studio, and its text.
    pub opened: Option<(PathBuf, String)>,
    /// The files of a person's own methods that the window starts with.
    pub methods: Vec<PathBuf>,
    /// The function that saves the recording of the run as it grows, if it is recorded.
    pub keep: Option<KeepRecording>,
}

/// A file that was dropped on the window or typed as a path.
pub(super) struct RequestedFile {
    path: PathBuf,
    is_typed: bool,
    /// Whether the file was opened before, and has changed.
    has_changed: bool,
    /// The run to compare the file with, if it is not to be opened.
    compared: Option<Box<Scene>>,
}

/// Content of a requested file, or its mistakes as the command line would print them.
pub(super) struct ReadFile {
    requested: RequestedFile,
    content: Result<FileContent, Vec<ShownError>>,
}

enum FileContent {
    Scene {
        scene: Box<Scene>,
        text: String,
    },
    Traces(Vec<FrameTrace>),
    /// A lane with a person's own method, and its text.
    Lane(LaneSpec, String),
    /// A person's own loop, and its text.
    Loop(Arc<PolicyCard>, String),
    /// The comparison with the run, and the recording.
    Compared(Box<(Comparison, Scene)>),
}

impl RequestedFile {
    fn of(path: PathBuf) -> Self {
        Self { path, is_typed: false, has_changed: false, compared: None }
    }

    /// The dropped file at `path`.
    pub(super) fn dropped(studio: &Studio, path: &Path) -> Self {
        Self::of(listed_path(studio, path))
    }

    /// The typed file, as the command line reads it. The name of a built-in scene opens that scene at once and
    /// returns `None`.
    pub(super) fn typed(studio: &mut Studio) -> Option<Self> {
        let typed = studio.viewer.typed_path().trim().to_owned();
        if studio.viewer.compares_typed_path() {
            let compared = Some(studio.deck.recorded().into());
            return Some(Self { is_typed: true, compared, ..Self::of(from_home(&typed)) });
        }
        if let Some(index) = SCENES.iter().position(|scene| scene.name == typed) {
            studio.apply(StageCommand::Scene(index));
            return None;
        }
        Some(Self { is_typed: true, ..Self::of(listed_path(studio, &from_home(&typed))) })
    }

    /// The watched file at `path`, which has changed.
    pub(super) fn changed(path: &Path) -> Self {
        Self { has_changed: true, ..Self::of(path.to_owned()) }
    }

    /// Whether the path is a link to a run instead of a file.
    fn is_link(&self) -> bool {
        regular_file::is_link(&self.path)
    }

    /// Reads the file, and prepares anything that its first frame would wait for. A disk can be slow, and a large net
    /// takes longer than a frame, so this must not run on the drawing thread.
    pub(super) fn read(self, read: &ReadScene) -> ReadFile {
        let content = read_caught(|| self.content(read));
        ReadFile { requested: self, content }
    }

    fn content(&self, read: &ReadScene) -> Result<FileContent, Vec<ShownError>> {
        if let Some(run) = &self.compared {
            read(&self.path).map(|(scene, _)| {
                FileContent::Compared(
                    (compare_recordings(scene.clone(), (**run).clone()), scene).into(),
                )
            })
        } else if is_trace(&self.path) {
            traces_in(&self.path).map(FileContent::Traces)
        } else if has_ending(&self.path, "step") {
            lines_in(&self.path, read)
        } else if has_ending(&self.path, "loop") {
            let bytes = bytes_of(&self.path, MAX_FILE_BYTES)?;
            read_own_loop(&self.path, bytes).map(|(card, text)| FileContent::Loop(card, text))
        } else {
            scene_in(&self.path, read)
        }
    }
}

/// Reads a file. A panic counts as a mistake of the file, so that the next file can be opened.
fn read_caught<T>(read: impl FnOnce() -> Result<T, Vec<ShownError>>) -> Result<T, Vec<ShownError>> {
    caught(read).unwrap_or_else(|sentence| Err(vec![format!("error: {sentence}").into()]))
}

impl ReadFile {
    /// Path and text of the file, if it is a scene or a loop.
    pub(super) fn watched(&self) -> Option<(PathBuf, String)> {
        match &self.content {
            Ok(
                FileContent::Scene { text, .. }
                | FileContent::Lane(_, text)
                | FileContent::Loop(_, text),
            ) if !self.requested.is_link() => Some((self.requested.path.clone(), text.clone())),
            _ => None,
        }
    }

    /// Opens the scene, or the loop lab on the traces. A dialog shows mistakes. For a typed path this is the path
    /// field, which stays open.
    pub(super) fn show(self, studio: &mut Studio) {
        let name = self.requested.is_link().then(|| "a link".into());
        let RequestedFile { path, is_typed, has_changed, .. } = self.requested;
        if has_changed {
            return reload(studio, &path, self.content);
        }
        let path = name.unwrap_or(path);
        match self.content {
            Ok(FileContent::Scene { scene, .. }) => open_file(studio, &path, *scene),
            Ok(FileContent::Traces(traces)) => {
                open_traces(studio, traces);
                if is_typed {
                    studio.apply(ViewCommand::CloseDialog);
                }
            }
            Ok(FileContent::Lane(lane, _)) => {
                race_own_method(studio, lane);
                if is_typed {
                    studio.apply(ViewCommand::CloseDialog);
                }
            }
            Ok(FileContent::Loop(card, _)) => {
                open_own_loop(studio, card);
                if is_typed {
                    studio.apply(ViewCommand::CloseDialog);
                }
            }
            Ok(FileContent::Compared(compared)) => {
                let (found, recording) = *compared;
                let name = path.file_name().unwrap_or_default().to_string_lossy();
                show_comparison(studio, &name, &found, recording);
            }
            Err(report) if is_typed => refuse_typed_path(studio, &path, report),
            Err(report) => show_mistakes(studio, &path, report),
        }
    }
}

/// Shows a file that has changed since it was opened, if it is still in use.
fn reload(studio: &mut Studio, path: &Path, content: Result<FileContent, Vec<ShownError>>) {
    let id = stem(path);
    let is_raced = has_ending(path, "step") && races_own_method(studio, &id);
    match content {
        Ok(FileContent::Scene { scene, .. }) => reload_file(studio, path, *scene),
        Ok(FileContent::Lane(lane, _)) if is_raced => reload_own_method(studio, lane),
        Ok(FileContent::Loop(card, _)) if runs_beside(studio, &id) => open_own_loop(studio, card),
        Err(report) if is_raced || runs_beside(studio, &id) => {
            show_mistakes(studio, path, report);
        }
        Err(report) => reload_failed(studio, path, report),
        Ok(_) => {}
    }
}

/// Compares two recordings up to the end of the longer one.
fn compare_recordings(recording: Scene, run: Scene) -> Comparison {
    let last = last_tick(&recording).max(last_tick(&run));
    let [mut a, mut b] = [recording, run].map(|scene| Made::of_scene(scene, last));
    let found = diff(&mut a, &mut b, Tolerance::default(), &Chosen::default());
    found.unwrap_or_else(|_: NotComparable| unreachable!("two traces have the same columns"))
}

/// Whether a file's ending is that of a trace of frames.
fn is_trace(path: &Path) -> bool {
    has_ending(path, "csv") || has_ending(path, "txt")
}

fn has_ending(path: &Path, known: &str) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case(known))
}

/// Reads a scene, and prepares anything that its first frame would wait for.
fn scene_in(path: &Path, read: &ReadScene) -> Result<FileContent, Vec<ShownError>> {
    let (scene, text) = read(path)?;
    SceneList::prepare_scene(&scene);
    Ok(FileContent::Scene { scene: Box::new(scene), text })
}

/// Reads a file of lines: a method is a lane of the open scene, a rule a scene of its own.
fn lines_in(path: &Path, read: &ReadScene) -> Result<FileContent, Vec<ShownError>> {
    let lines = bytes_of(path, MAX_FILE_BYTES)?;
    if !is_rule(&lines) {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let lane = LaneSpec::from_step(&name, &lines).map_err(Vec::from)?;
        return Ok(FileContent::Lane(lane, String::from_utf8_lossy(&lines).into_owned()));
    }
    let held = scene_in(path, read)?;
    // The watch compares with the file, which holds the lines instead of the scene.
    Ok(match (held, String::from_utf8(lines)) {
        (FileContent::Scene { scene, .. }, Ok(text)) => FileContent::Scene { scene, text },
        (held, _) => held,
    })
}

fn bytes_of(path: &Path, most: usize) -> Result<Vec<u8>, Vec<ShownError>> {
    regular_file::read(path, most)
        .map_err(|why| vec![format!("error: cannot read {}: {why}", path.display()).into()])
}

fn stem(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

fn traces_in(path: &Path) -> Result<Vec<FrameTrace>, Vec<ShownError>> {
    let bytes = bytes_of(path, MAX_TABLE_BYTES)?;
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    trace_file::from_bytes(&name, &bytes).map_err(|error| vec![format!("error: {error}").into()])
}

/// The listed path of the same file, or else `path` itself.
fn listed_path(studio: &Studio, path: &Path) -> PathBuf {
    let real = path.canonicalize().ok();
    let is_same = |listed: &&Path| real.is_some() && listed.canonicalize().ok() == real;
    studio.deck.scene_list().paths().find(is_same).unwrap_or(path).to_owned()
}

/// Replaces a leading `~` in a path with the home directory.
fn from_home(typed: &str) -> PathBuf {
    let rest = typed.strip_prefix('~').filter(|rest| rest.starts_with(is_separator));
    match (rest, std::env::home_dir()) {
        (Some(rest), Some(home)) => home.join(rest.trim_start_matches(is_separator)),
        _ => typed.into(),
    }
}

/// Completes a path with the common beginning of all matching folders and files of scenes and lines.
pub(super) fn complete_path(typed: &str) -> String {
    // Windows has two separators, each of one byte like that of other systems.
    let (folder, begun) = match typed.rfind(is_separator) {
        Some(end) => typed.split_at(end + 1),
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
        ["toml", "step", "loop"].iter().any(|ending| has_ending(&path, ending)).then_some(name)
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
    use crate::loops::POLICIES;
    use crate::run::link;
    use crate::studio::{Compared, Dialog, RunCommand};
    use crate::tools::rule::rule_scene;

    /// Reads scene files without the command line's options.
    fn read() -> ReadScene {
        Arc::new(|path: &Path| {
            let written = path.to_str().filter(|written| link::is_link(written));
            let text = match written {
                Some(written) => link::text(written).map_err(|error| error.to_string()),
                None => std::fs::read_to_string(path).map_err(|error| error.to_string()),
            };
            let text = text.map_err(|error| vec![error.into()])?;
            let scene = Scene::parse(&path.display().to_string(), &text);
            scene.map(|scene| (scene, text)).map_err(Vec::from)
        })
    }

    #[test]
    fn a_typed_recording_is_compared_up_to_its_first_differing_tick() {
        let folder = tempfile::tempdir().unwrap();
        let recording = folder.path().join("clip.toml");
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        (0..90).for_each(|_| studio.tick());
        let recorded = studio.deck.recording().unwrap();
        let mut compare = |text: &str| {
            std::fs::write(&recording, text).unwrap();
            studio.apply(ViewCommand::AskForRun);
            studio.apply(ViewCommand::TypePath(recording.display().to_string()));
            RequestedFile::typed(&mut studio).unwrap().read(&read()).show(&mut studio);
            let notice = studio.viewer.notice.as_deref().unwrap_or_default().to_owned();
            (studio.deck.compared().map(Compared::tick), studio.race().tick(), notice)
        };
        let same = compare(&recorded);
        assert!(same.0.is_none() && same.1 == 90, "{same:?}");
        assert!(same.2.contains("clip.toml is the same in "), "{same:?}");
        // The kick acts within the tick before.
        let pulled = compare(&format!("{recorded}\n[[command]]\nat_s = 1.0\nkick = 1.0\n"));
        assert_eq!(pulled.0, Some(61), "{pulled:?}");
        assert_eq!(pulled.1, 61, "{pulled:?}");
    }

    #[test]
    fn a_typed_link_opens_its_run_and_not_a_file() {
        let mut studio = Studio::new(Scene::built_in("ship").unwrap());
        (0..90).for_each(|_| studio.tick());
        studio.apply(RunCommand::ThrottleDown);
        let link = studio.deck.link().unwrap();
        studio.apply(ViewCommand::AskForPath);
        studio.apply(ViewCommand::TypePath(format!("https://example.org/{link}")));
        let found = RequestedFile::typed(&mut studio).unwrap().read(&read());
        assert_eq!(found.watched(), None);
        found.show(&mut studio);
        assert_eq!((studio.deck.scene_name().as_str(), studio.race().tick()), ("a link", 0));
        assert_eq!(studio.scene().checks.last().unwrap().tick, 90);
    }

    #[test]
    fn a_dropped_loop_runs_beside_the_others_and_a_changed_one_replaces_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("mine.loop");
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        let show = |studio: &mut Studio, lines: &str, has_changed: bool| {
            std::fs::write(&path, lines).unwrap();
            let requested = match has_changed {
                true => RequestedFile::changed(&path),
                false => RequestedFile::dropped(studio, &path),
            };
            let found = requested.read(&read());
            let watched = found.watched();
            found.show(studio);
            watched
        };
        // A file that changes does not open the lab.
        show(&mut studio, "tick 1", true);
        assert!(studio.loop_lab().is_none());
        let watched = show(&mut studio, "tick 1", false);
        assert_eq!(watched, Some((path.clone(), "tick 1".to_owned())));
        let own =
            |studio: &Studio| studio.loop_lab().and_then(|loops| loops.engine()).unwrap().clone();
        let first = own(&studio);
        assert!(first.id == "mine" && first.has_fixed_tick);
        let lab = studio.loop_lab().unwrap();
        assert!(lab.lanes().len() == POLICIES.len() + 1 && lab.selected() == POLICIES.len());
        show(&mut studio, "tick 1 of dtt", true);
        let Some(Dialog::Mistakes { report, .. }) = studio.viewer.dialog() else { panic!() };
        assert!(report[0].message.starts_with("mine.loop:1:11: unknown name `dtt`"), "{report:?}");
        assert_eq!(own(&studio).lines(), first.lines());
        show(&mut studio, "tick 1 of dt", true);
        assert!(studio.viewer.dialog().is_none() && !own(&studio).has_fixed_tick);
        assert_eq!(studio.viewer.notice.as_deref(), Some("mine: reloaded"));
    }

    #[test]
    fn a_dropped_method_joins_the_race_and_a_changed_one_replaces_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("mine.step");
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        let lanes = studio.scene().lanes.len();
        (0..30).for_each(|_| studio.tick());
        let drop = |studio: &mut Studio, lines: &str| {
            std::fs::write(&path, lines).unwrap();
            RequestedFile::dropped(studio, &path).read(&read()).show(studio);
            let specs = studio.race().entrants().iter().map(|entrant| entrant.spec);
            let own: Vec<_> = specs.filter(|spec| spec.method.id == "mine").collect();
            (own, studio.viewer.notice.as_deref().unwrap_or_default().to_owned())
        };
        let (first, notice) = drop(&mut studio, "v += h * a(x, v); x += h * v");
        assert!(notice.starts_with("mine: order 1.00"), "{notice}");
        assert_eq!((first.len(), studio.race().tick()), (1, 0));
        assert_eq!(studio.scene().lanes.len(), lanes + 1);
        (0..30).for_each(|_| studio.tick());
        let recorded = studio.deck.recording().unwrap();
        assert!(
            recorded.contains("[[method]]") && recorded.contains("id = \"mine\""),
            "{recorded}"
        );
        let (second, _) = drop(&mut studio, "x += h * v; v += h * a(x, v)");
        assert!(second.len() == 1 && second != first);
        assert_eq!(studio.scene().lanes.len(), lanes + 1);
        drop(&mut studio, "x += h * w");
        let Some(Dialog::Mistakes { report, .. }) = studio.viewer.dialog() else { panic!() };
        assert!(report[0].message.starts_with("mine.step:1:10: unknown name `w`"), "{report:?}");
    }

    #[test]
    fn a_dropped_rule_opens_as_a_watched_scene() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("mine.step");
        let lines = "x += (target - x) * 20 * dt";
        std::fs::write(&path, lines).unwrap();
        let rule: ReadScene = Arc::new(|path| {
            let text = std::fs::read_to_string(path).unwrap();
            let scene = rule_scene("mine.step", &text, 60.into()).map_err(Vec::from)?;
            Ok((scene.clone(), scene.to_toml()))
        });
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        let found = RequestedFile::dropped(&studio, &path).read(&rule);
        assert_eq!(found.watched(), Some((path.clone(), lines.to_owned())));
        found.show(&mut studio);
        assert_eq!((studio.scene().name.as_str(), studio.race().entrants().len()), ("mine", 3));
        std::fs::write(&path, "x -= x * abs(x)").unwrap();
        RequestedFile::dropped(&studio, &path).read(&rule).show(&mut studio);
        let Some(Dialog::Mistakes { report, .. }) = studio.viewer.dialog() else { panic!() };
        assert!(report[0].message.contains("the rule is not linear"), "{report:?}");
        assert_eq!(studio.scene().name, "mine");
    }

    #[test]
    fn a_file_on_which_the_reader_panics_is_refused_and_the_next_one_opens() {
        let folder = tempfile::tempdir().unwrap();
        let [bad, good] = ["bad.toml", "good.toml"].map(|name| folder.path().join(name));
        let text = SCENES.iter().find(|scene| scene.name == "ship").unwrap().text;
        std::fs::write(&good, text).unwrap();
        let (reader, fails) = (read(), bad.clone());
        let reader: ReadScene = Arc::new(move |path: &Path| match path == fails {
            true => panic!("index out of bounds"),
            false => reader(path),
        });
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        RequestedFile::dropped(&studio, &bad).read(&reader).show(&mut studio);
        let Some(Dialog::Mistakes { report, .. }) = studio.viewer.dialog() else { panic!() };
        assert!(report[0].message.contains("index out of bounds"), "{report:?}");
        RequestedFile::dropped(&studio, &good).read(&reader).show(&mut studio);
        assert_eq!(
            (studio.deck.scene_name().as_str(), studio.viewer.dialog()),
            ("good.toml", None)
        );
    }

    #[test]
    fn a_dropped_file_is_opened_unless_it_has_mistakes() {
        let folder = tempfile::tempdir().unwrap();
        let [good, bad] = ["ship.toml", "bad.toml"].map(|name| folder.path().join(name));
        let text = SCENES.iter().find(|scene| scene.name == "ship").unwrap().text;
        std::fs::write(&good, text).unwrap();
        std::fs::write(&bad, "tick_hz = 0").unwrap();
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        let found = RequestedFile::dropped(&studio, &good).read(&read());
        assert_eq!(found.watched(), Some((good, text.to_owned())));
        found.show(&mut studio);
        assert_eq!(studio.deck.scene_name(), "ship.toml");
        studio.tick();
        let found = RequestedFile::dropped(&studio, &bad).read(&read());
        assert_eq!(found.watched(), None);
        found.show(&mut studio);
        assert_eq!((studio.deck.scene_name().as_str(), studio.race().tick()), ("ship.toml", 1));
        let Some(Dialog::Mistakes { report, .. }) = studio.viewer.dialog() else { panic!() };
        let message = &report[0].message;
        assert!(message.starts_with(&format!("{}:1:", bad.display())), "{message}");
        studio.apply(ViewCommand::AskForPath);
        studio.apply(ViewCommand::TypePath(bad.display().to_string()));
        RequestedFile::typed(&mut studio).unwrap().read(&read()).show(&mut studio);
        let Some(Dialog::Path { refused: Some(report), .. }) = studio.viewer.dialog() else {
            panic!()
        };
        let message = &report[0].message;
        assert!(message.starts_with(&format!("{}:1:", bad.display())), "{message}");
        // As on the command line, the name of a built-in scene opens that scene.
        studio.apply(ViewCommand::TypePath(" ship ".into()));
        assert!(RequestedFile::typed(&mut studio).is_none());
        assert_eq!((studio.deck.scene_name().as_str(), studio.viewer.dialog()), ("ship", None));
    }

    #[test]
    fn a_path_is_completed_up_to_the_first_ambiguity() {
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
            assert_eq!(complete_path(&format!("{root}{typed}")), format!("{root}{completed_name}"));
        }
        assert_eq!(complete_path(&format!("{root}{deep}")), format!("{root}{deep}one.toml"));
        assert_eq!(complete_path("/no/such/folder/a"), "/no/such/folder/a");
    }

    #[test]
    fn a_file_is_recognised_by_any_of_its_paths() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.toml");
        std::fs::write(&path, "").unwrap();
        let mut studio = Studio::new(Scene::built_in("ship").unwrap());
        open_file(&mut studio, &path, Scene::built_in("ship").unwrap());
        assert_eq!(listed_path(&studio, &folder.path().join("./a.toml")), path);
        let other = folder.path().join("b.toml");
        assert_eq!(listed_path(&studio, &other), other);
    }
}
