//! Reads the run of a capture back from its manifest.

use std::path::Path;

use serde_json::Value;

use super::argument::brief;
use super::error::Error;
use super::experiment::Experiment;
use super::manifest::{self, FILE_NAME, Manifest, SCHEMA};
use super::settings::{self, CaptureSettings};
use crate::regular_file::{self, Unreadable};
use crate::scene::{Check, LaneId, Scene};

/// The run of a capture, as its manifest describes it.
pub(super) struct CapturedRun {
    pub(super) manifest: Manifest,
    pub(super) capture: CaptureSettings,
    pub(super) experiment: Experiment,
}

/// Returns a function that makes the error for a capture in `dir` that cannot be judged, from the reason.
pub(super) fn unjudged(dir: &Path) -> impl Fn(String) -> Error {
    let manifest = dir.join(FILE_NAME);
    move |reason| Error::mistake(format!("cannot judge {}: {reason}", brief(&manifest)))
}

/// Reads the run of the capture in `dir` from its manifest.
pub(super) fn read_run(dir: &Path) -> Result<CapturedRun, Error> {
    let read = || {
        let manifest = read(&dir.join(FILE_NAME))?;
        let (experiment, capture) = settings::from_manifest(&manifest.settings)?;
        Ok(CapturedRun { manifest, capture, experiment })
    };
    read().map_err(unjudged(dir))
}

/// Returns the run of the capture in `dir` as a scene, with the states of its marks as checks.
pub(super) fn scene_of_capture(dir: &Path) -> Result<Scene, Error> {
    let CapturedRun { manifest, experiment, .. } = read_run(dir)?;
    let (race, opening) = (manifest.settings.race, experiment.opening_method());
    let lanes = &experiment.scene.lanes;
    let first =
        if race { 0 } else { lanes.iter().position(|it| it.method == opening).unwrap_or(0) };
    let check = |tick: u64, (index, hash): (usize, &String)| {
        let hash = u64::from_str_radix(hash, 16).map_err(|_| {
            let file = brief(&dir.join(FILE_NAME));
            Error::mistake(format!("{file}: {hash:?} is no hash of a state; capture again"))
        })?;
        Ok(Check { tick, lane: LaneId::of_index(first + index), hash })
    };
    let marks = manifest.marks.iter().flat_map(|mark| {
        let lanes = mark.lanes.iter().map(|lane| &lane.hash).enumerate();
        lanes.map(|lane| check(mark.tick, lane))
    });
    let checks = marks.collect::<Result<Vec<Check>, Error>>()?;
    Ok(Scene {
        checks,
        opens_as_race: race,
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
                "it is of schema {schema}, and this program reads {SCHEMA}; capture again"
            ));
        }
        None => return Err("it does not name its schema; capture again".into()),
    }
    let manifest: Manifest = serde_json::from_slice(&bytes)
        .map_err(|error| format!("it does not follow schema {SCHEMA}: {error}; capture again"))?;
    settings::check(&manifest)?;
    Ok(manifest)
}
