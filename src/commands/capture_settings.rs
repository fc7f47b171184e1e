//! The settings with which a run is drawn.

use super::schedule::Schedule;
use crate::look::palette::Theme;
use crate::measure::cloud::{CloudChoice, CloudKind};
use crate::studio::{Instrument, Motion, RunCommand, Studio};

/// How a run is drawn: its frames, their size and what they show.
#[derive(Clone, Copy, Debug)]
pub(super) struct CaptureSettings {
    pub(super) schedule: Schedule,
    pub(super) size_px: [u32; 2],
    /// Pixels per point.
    pub(super) scale: f32,
    /// Whether panels are shown around the stage.
    pub(super) panels: bool,
    /// The instrument among them; `None` for the usual one.
    pub(super) instrument: Option<Instrument>,
    /// What the clouds are; `None` for the usual shape.
    pub(super) cloud: Option<CloudKind>,
    /// Whether trails fade and the camera glides.
    pub(super) motion: bool,
    pub(super) theme: Theme,
    /// Ticks between two marks in the manifest.
    pub(super) mark_every: u64,
}

impl CaptureSettings {
    /// The studio of an experiment at the start of the run, as it is drawn.
    pub(super) fn dress(&self, mut studio: Studio) -> Studio {
        studio.viewer_mut().preferences.display.motion =
            if self.motion { Motion::Recorded } else { Motion::Reduced };
        studio.viewer_mut().preferences.choose_theme(self.theme);
        self.instrument
            .into_iter()
            .for_each(|it| studio.viewer_mut().preferences.display.instrument = it);
        if let Some(kind) = self.cloud {
            studio.apply(RunCommand::Cloud(CloudChoice { kind, ..studio.display().cloud }));
        }
        studio
    }
}
