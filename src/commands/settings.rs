//! From an experiment and a recording to the settings in a manifest.

use super::experiment::{Experiment, Lineup};
use super::fingerprint::fingerprint;
use super::manifest::{LaneEntry, SceneText, Settings};
use super::recording::Recording;
use crate::lab::LaneSpec;
use crate::view::Panels;

/// What a manifest says of a run that is about to be recorded.
pub(super) fn written(experiment: &Experiment, recording: &Recording) -> Settings {
    let scene = &experiment.scene;
    let lane =
        |lane: &LaneSpec| LaneEntry { method: lane.method.id.to_owned(), substeps: lane.substeps };
    Settings {
        scene: SceneText {
            name: scene.name.clone(),
            hash: fingerprint(experiment.text.as_bytes()),
            text: experiment.text.clone(),
        },
        lanes: scene.lanes.iter().map(lane).collect(),
        race: experiment.lineup == Lineup::Everyone,
        selected: experiment.selected.map(|method| method.id.to_owned()),
        tick_hz: scene.tick_hz,
        frames: recording.schedule.frames,
        fps: recording.schedule.fps,
        size: recording.size_px,
        // The shortest decimal of an f32 is the same number as an f64 for people, and reads back.
        scale: recording.scale.to_string().parse().expect("a number's own text"),
        panels: recording.panels == Panels::Shown,
        motion: recording.motion,
        mark_every: recording.mark_every,
    }
}

/// The hash of settings, by which an altered one is known.
pub(super) fn hash(settings: &Settings) -> String {
    let text = serde_json::to_string(settings).expect("all keys are strings");
    fingerprint(text.as_bytes())
}
