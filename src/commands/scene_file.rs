//! Loads the scene that `--scene` names: a built-in scene, or else a file.

use std::path::{Path, PathBuf};

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};

use super::error::{Cause, message};
use crate::lab::{BuiltIn, MAX_FILE_BYTES, Mistake, Refusal, SCENES, Scene, SceneErrors, nearest};
use crate::regular_file::{self, Unreadable};
use crate::sim::integrators::Method;

/// The reason why a scene cannot be loaded.
#[derive(Debug, thiserror::Error)]
pub(super) enum SceneFileError {
    /// Neither a built-in scene nor a file has this name.
    #[error("no file and no built-in scene ({}) is called {path:?}; {}", names(), remedy(.path))]
    NotFound {
        /// As it was given.
        path: PathBuf,
    },
    /// The name is that of a directory.
    #[error("{} is a directory; give a scene file in it", .path.display())]
    Directory {
        /// As it was given.
        path: PathBuf,
    },
    /// The file is there but is not read.
    #[error("cannot read the scene file {}: {source}", .path.display())]
    Unreadable {
        /// As it was given.
        path: PathBuf,
        /// Why.
        source: Unreadable,
    },
    /// A method that the command line names does not step a body of the scene.
    #[error("--method {0}; name another, which `regatta list methods` has, or another scene")]
    Refused(Refusal),
    /// The file holds no valid scene.
    #[error(transparent)]
    Invalid(#[from] SceneErrors),
}

impl Cause for SceneFileError {
    fn exit_code(&self) -> u8 {
        2
    }

    fn report(&self, renderer: &Renderer) -> String {
        match self {
            SceneFileError::Invalid(_) => {
                let parts = self.mistakes(renderer).into_iter();
                let parts = parts.flat_map(|Mistake { message, quoted }| [message, quoted]);
                parts.filter(|part| !part.is_empty()).collect::<Vec<_>>().join("\n")
            }
            _ => message(self, renderer),
        }
    }
}

impl SceneFileError {
    /// The error's messages, each with the lines of the file that it is about.
    pub(super) fn mistakes(&self, renderer: &Renderer) -> Vec<Mistake> {
        let SceneFileError::Invalid(errors) = self else {
            return vec![message(self, renderer).into()];
        };
        let mut spans = errors.errors.iter().map(|error| error.span.clone());
        let mistake = |message| {
            let span = spans.next().filter(|_| !errors.text.is_empty());
            let quoted = span.map(|span| {
                let annotation = AnnotationKind::Primary.span(span);
                let snippet = Snippet::source(&errors.text).annotation(annotation);
                renderer.render(&[Group::with_level(Level::ERROR).element(snippet)])
            });
            Mistake { message, quoted: quoted.unwrap_or_default() }
        };
        errors.messages().map(mistake).collect()
    }
}

/// The built-in scene of that name, or the scene in the file at that path, and its text.
pub(super) fn load(path: &Path) -> Result<(Scene, String), SceneFileError> {
    if let Some(built_in) = built_in(path) {
        return Ok((Scene::parse(built_in.name, built_in.text)?, built_in.text.to_owned()));
    }
    let bytes = read(path)?;
    let scene = Scene::from_bytes(&path.display().to_string(), &bytes)?;
    Ok((scene, String::from_utf8_lossy(&bytes).into_owned()))
}

/// The text that the built-in scene of that name, or the file at that path, has now; `None` if it cannot be read.
pub(super) fn text_now(path: &Path) -> Option<String> {
    match built_in(path) {
        Some(built_in) => Some(built_in.text.to_owned()),
        None => Some(String::from_utf8_lossy(&read(path).ok()?).into_owned()),
    }
}

/// Checks that `method`, which the command line names, steps `scene`.
pub(super) fn check_method(scene: &Scene, method: &Method) -> Result<(), SceneFileError> {
    scene.refusal(method).map_or(Ok(()), |refusal| Err(SceneFileError::Refused(refusal)))
}

/// Whether `path` is the name of a built-in scene.
pub(super) fn is_built_in(path: &Path) -> bool {
    built_in(path).is_some()
}

fn built_in(path: &Path) -> Option<&'static BuiltIn> {
    SCENES.iter().find(|scene| path.to_str() == Some(scene.name))
}

fn read(path: &Path) -> Result<Vec<u8>, SceneFileError> {
    regular_file::read(path, MAX_FILE_BYTES).map_err(|source| {
        let path = path.to_owned();
        match source {
            Unreadable::Directory => SceneFileError::Directory { path },
            Unreadable::TooLarge { .. } => {
                SceneErrors::too_large(&path.display().to_string()).into()
            }
            missing if missing.is_missing() => SceneFileError::NotFound { path },
            source => SceneFileError::Unreadable { path, source },
        }
    })
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
