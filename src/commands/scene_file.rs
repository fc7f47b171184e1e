//! Loads the scene that `--scene` names, which is a built-in scene, or else a file or a link.

use std::path::{Path, PathBuf};

use super::argument::brief;
use super::captured;
use super::error::Error;
use super::manifest::FILE_NAME;
use super::output::Input;
use super::own_file::is_step;

use crate::loops::TraceCard;
pub(super) use crate::regular_file::is_link;
use crate::regular_file::{self, MAX_TABLE_BYTES, Unreadable};
use crate::run::link::{self, Link};
use crate::scene::{BuiltIn, MAX_FILE_BYTES, SCENES, Scene, SceneErrors, nearest};
use crate::sim::TickRate;
use crate::sim::integrators::Method;
use crate::sim::law::StepText;
use crate::studio::picture_note;
use crate::tools::rule::rule_scene;

/// Frame rate of the author of a rule, if nothing states it. It is the usual one of games.
const USUAL_FPS: TickRate = TickRate::whole(60);

/// Loads the built-in scene with this name, or the scene in the file or link. Returns the scene and its text.
pub(super) fn load(path: &Path) -> Result<(Scene, String), Error> {
    if let Some(built_in) = built_in(path) {
        return Ok((Scene::parse(built_in.name, built_in.text)?, built_in.text.to_owned()));
    }
    if is_step(path) {
        let scene = scene_of_rule(path)?;
        let text = scene.to_toml();
        return Ok((scene, text));
    }
    if let Some(dir) = capture_at(path) {
        let scene = captured::scene_of_capture(&dir)?;
        let text = scene.to_toml();
        return Ok((scene, text));
    }
    let bytes = read(path)?;
    let scene =
        Scene::from_bytes(&name_in_link(path).unwrap_or_else(|| name_in_messages(path)), &bytes)?;
    Ok((scene, String::from_utf8_lossy(&bytes).into_owned()))
}

/// Returns the folder of the capture at `path`, which is that folder or the manifest in it. Returns `None` if there is
/// no manifest.
fn capture_at(path: &Path) -> Option<PathBuf> {
    match path.is_dir() {
        true => path.join(FILE_NAME).is_file().then(|| path.to_owned()),
        false if path.is_file() && path.file_name()? == FILE_NAME => {
            Some(path.parent().filter(|dir| *dir != Path::new("")).unwrap_or(Path::new(".")).into())
        }
        false => None,
    }
}

/// Returns the trace of the loop lab that the capture at `path` shows, if it does.
pub(super) fn loop_trace_of(path: &Path) -> Option<&'static TraceCard> {
    captured::read_run(&capture_at(path)?).ok()?.0.experiment.loop_trace
}

/// Returns the scene of the rule whose lines are in a file.
fn scene_of_rule(path: &Path) -> Result<Scene, Error> {
    let (name, bytes) = (brief(path), read(path)?);
    let Ok(text) = str::from_utf8(&bytes) else {
        return Err(Error::mistake(format!("{name} is not text; save it as UTF-8")));
    };
    if StepText::read(text).is_ok_and(|text| text.acceleration_at().is_some()) {
        return Err(Error::mistake(format!(
            "{name} calls the acceleration, so it is a method; give `--method {name}`, with a scene"
        )));
    }
    Ok(rule_scene(&name, text, USUAL_FPS)?)
}

/// Returns the present text of the built-in scene with this name, or of the file at this path. Returns `None` if the
/// text cannot be read.
pub(super) fn text_now(path: &Path) -> Option<String> {
    match built_in(path) {
        Some(built_in) => Some(built_in.text.to_owned()),
        None if is_step(path) => Some(scene_of_rule(path).ok()?.to_toml()),
        None => Some(String::from_utf8_lossy(&read(path).ok()?).into_owned()),
    }
}

/// Checks that `method`, which the command line names, can step `scene`.
pub(super) fn check_method(scene: &Scene, method: &Method) -> Result<(), Error> {
    if let Some(own) = scene.own_methods.iter().find(|own| own.id == method.id && *own != &method) {
        return Err(Error::mistake(format!(
            "--method: the scene has a method {:?} of its own, with other lines; give the file another name",
            own.id
        )));
    }
    let Some(refusal) = scene.refusal(method) else { return Ok(()) };
    Err(Error::mistake(format!(
        "--method {refusal}; name another, which `regatta list methods` has, or another scene"
    )))
}

pub(super) fn is_built_in(path: &Path) -> bool {
    built_in(path).is_some()
}

/// Whether `path` looks like a scene: it ends in .toml, .step or .png, names a built-in scene, or is a folder or the
/// manifest of a capture.
pub(super) fn is_name(path: &Path) -> bool {
    is_built_in(path)
        || is_step(path)
        || has_picture_ending(path)
        || path.extension().is_some_and(|ending| ending == "toml")
        || path.is_dir()
        || capture_at(path).is_some()
}

/// Whether `path` is the path of a scene file, which means that it is neither a built-in scene nor a link nor a
/// capture.
pub(super) fn is_file(path: &Path) -> bool {
    !is_built_in(path) && !is_link(path) && capture_at(path).is_none()
}

/// Returns the scene at `path` as an input of a command, if the scene is a file.
pub(super) fn input(path: &Path) -> Option<Input<'_>> {
    is_file(path).then_some((path, "the scene that is run"))
}

/// Returns the path in the form that it has in messages. A link is too long to show, because it contains its run.
pub(super) fn name_in_messages(path: &Path) -> String {
    if is_link(path) { "the link".into() } else { brief(path) }
}

/// Returns the name of the built-in scene in a link, or `None` if `path` is not such a link.
fn name_in_link(path: &Path) -> Option<String> {
    let link = Link::read(path.to_str().filter(|_| is_link(path))?).ok()?;
    link.named().ok().filter(|_| !link.is_packed()).map(|named| named.scene.name)
}

/// Returns the tick at which a link opens, or `None` if `path` is not a link with a tick.
pub(super) fn tick_of(path: &Path) -> Option<u64> {
    let written = path.to_str().filter(|_| is_link(path))?;
    Link::read(written).ok()?.tick()
}

fn built_in(path: &Path) -> Option<&'static BuiltIn> {
    SCENES.iter().find(|scene| path.to_str() == Some(scene.name))
}

fn read(path: &Path) -> Result<Vec<u8>, Error> {
    if let Some(written) = path.to_str().filter(|_| is_link(path)) {
        return link::text(written).map(String::into_bytes).map_err(Error::mistake);
    }
    let shown = brief(path);
    let limit = if has_picture_ending(path) { MAX_TABLE_BYTES } else { MAX_FILE_BYTES };
    let read = regular_file::read(path, limit);
    if let Some(picture) = read.as_deref().ok().filter(|bytes| picture_note::is_picture(bytes)) {
        let recording = picture_note::recording_in(picture).map(|text| text.as_bytes().to_vec());
        return recording.ok_or_else(|| {
            Error::mistake(format!(
                "{shown} is a picture without a run; `regatta report`, and Shift P in the window, make one with its run"
            ))
        });
    }
    read.map_err(|error| {
        Error::mistake(match error {
            Unreadable::Directory => {
                format!("{shown} is a directory without {FILE_NAME}; give a scene file, or the directory of a capture")
            }
            Unreadable::TooLarge { .. } => {
                return SceneErrors::too_large(&shown).into();
            }
            missing if missing.is_missing() => format!(
                "no file and no built-in scene ({}) is called {shown:?}; {}",
                names(),
                remedy(path)
            ),
            error => format!("cannot read the scene file {shown}: {error}"),
        })
    })
}

/// Whether `path` has the ending of a picture, which may be a report.
pub(super) fn has_picture_ending(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png"))
}

fn remedy(path: &Path) -> String {
    let names = SCENES.iter().map(|scene| (scene.name, scene.name));
    match path.to_str().and_then(|path| nearest(path, names)) {
        Some(name) => format!("did you mean {name}?"),
        None => "give one of these, or the path of a scene file".into(),
    }
}

fn names() -> String {
    SCENES.iter().map(|scene| scene.name).collect::<Vec<_>>().join(", ")
}
