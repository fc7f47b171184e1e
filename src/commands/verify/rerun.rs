//! The run of a capture, repeated.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::commands::capture_settings::CaptureSettings;
use crate::commands::experiment::Experiment;
use crate::commands::manifest::Manifest;
use crate::commands::state_log::StateLog;
use crate::studio::Studio;

/// The run of a manifest, to be repeated.
pub(super) struct Rerun {
    pub(super) manifest: Manifest,
    pub(super) capture: CaptureSettings,
    pub(super) experiment: Experiment,
}

/// The frames of a repeated run.
pub(super) struct Frames {
    /// Whether they have to be the same to the byte.
    pub(super) are_exact: bool,
    /// How each differs from its file, if it does.
    pub(super) differences: Vec<Option<String>>,
}

impl Rerun {
    /// The studio at the start of the run, and the log of its states.
    pub(super) fn begin(&self) -> (Studio, StateLog) {
        let studio = self.capture.dress(self.experiment.studio());
        let state_log = StateLog::new(self.capture.mark_every, studio.race());
        (studio, state_log)
    }

    /// The studio at the end of the run and its log, where nothing is drawn; `None` after an interrupt.
    pub(super) fn run(&self, interrupted: &AtomicBool) -> Option<(Studio, StateLog)> {
        let (mut studio, mut state_log) = self.begin();
        for frame in 0..self.manifest.frames.len() as u32 {
            if interrupted.load(Ordering::Relaxed) {
                return None;
            }
            self.capture.schedule.advance(&mut studio, frame, &mut state_log);
        }
        Some((studio, state_log))
    }
}
