//! Reads the run of a capture back from its manifest.

use std::path::Path;

use serde_json::Value;

use super::argument::brief;
use super::error::Error;
use super::manifest::{self, FILE_NAME, Manifest, SCHEMA};
use super::settings::{self, CapturedRun};
use crate::regular_file::{self, Unreadable};
use crate::run::race::Mode;
use crate::scene::Scene;

/// Returns a function that makes the error for a capture in `dir` that cannot be judged, from the reason.
pub(super) fn unjudged(dir: &Path) -> impl Fn(String) -> Error {
    let manifest = dir.join(FILE_NAME);
    move |reason| Error::mistake(format!("cannot judge {}: {reason}", brief(&manifest)))
}

/// Reads the run of the capture in `dir` from its manifest, and the manifest.
pub(super) fn read_run(dir: &Path) -> Result<(CapturedRun, Manifest), Error> {
    let read = || {
        let manifest = read(&dir.join(FILE_NAME))?;
        Ok((settings::from_manifest(&manifest)?, manifest))
    };
    read().map_err(unjudged(dir))
}

/// Returns the run of the capture in `dir` as a scene, with the states of its lanes as checks.
pub(super) fn scene_of_capture(dir: &Path) -> Result<Scene, Error> {
    let (CapturedRun { experiment, checks, .. }, _) = read_run(dir)?;
    Ok(Scene {
        checks,
        opens_as_race: experiment.mode == Mode::Race,
        opening_method: experiment.selected.or(experiment.scene.opening_method),
        ..experiment.scene
    })
}

/// Reads the manifest at `path`.
///
/// # Errors
/// The reason why the manifest cannot be used: it is missing, incomplete, altered or of another schema.
fn read(path: &Path) -> Result<Manifest, String> {
    let bytes = regular_file::read(path, manifest::MAX_BYTES).map_err(|error| match error {
        Unreadable::System(error) => format!("{error}; `regatta capture` writes it"),
        error => error.to_string(),
    })?;
    let value: Value = serde_json::from_slice(&bytes)
        .map_err(|error| format!("it is not JSON: {error}; capture again"))?;
    match value["schema"].as_u64() {
        Some(schema) if schema == u64::from(SCHEMA) => {}
        Some(schema) => {
            return Err(format!(
                "it is of schema {schema}, and this program reads {SCHEMA}; capture again, with --force"
            ));
        }
        None => return Err("it does not name its schema; capture again".into()),
    }
    let manifest: Manifest = serde_json::from_slice(&bytes)
        .map_err(|error| format!("it does not follow schema {SCHEMA}: {error}; capture again"))?;
    settings::check(&manifest)?;
    Ok(manifest)
}
