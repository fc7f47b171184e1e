//! The settings of a capture, and their conversion to and from those of a manifest.

use super::experiment::Experiment;
use super::frame_names::{MAX_FRAMES, frame_name};
use super::id::{INSTRUMENT, SHAPE, TRACE};
use super::manifest::{Drawing, Manifest, fingerprint};
use super::schedule::{MAX_FPS, Schedule};
use crate::look::palette::Theme;
use crate::measure::cloud::{CloudChoice, CloudShape};
use crate::run::race::Mode;
use crate::scene::{Check, Scene};
use crate::sim::integrators::method;
use crate::studio::{Instrument, Motion, RunCommand, Studio};
use crate::view::RendererChoice;

/// Settings of a capture, namely its frames, their size and their content.
#[derive(Clone, Copy, Debug)]
pub(super) struct CaptureSettings {
    pub(super) schedule: Schedule,
    pub(super) size_px: [u32; 2],
    /// Number of pixels per point.
    pub(super) scale: f32,
    /// Whether panels are shown around the stage.
    pub(super) panels: bool,
    /// Instrument in the panels, or `None` for the default one.
    pub(super) instrument: Option<Instrument>,
    /// Shape of the clouds, or `None` for the default shape.
    pub(super) cloud: Option<CloudShape>,
    /// Whether trails fade and the camera glides.
    pub(super) motion: bool,
    pub(super) theme: Theme,
    /// Number of ticks between two states in the manifest.
    pub(super) mark_every: u64,
    pub(super) renderer: RendererChoice,
}

/// The run of a capture, as its manifest describes it.
pub(super) struct CapturedRun {
    pub(super) capture: CaptureSettings,
    pub(super) experiment: Experiment,
    /// The states that the lanes reached, by tick.
    pub(super) checks: Vec<Check>,
}

impl CaptureSettings {
    /// Prepares the studio of an experiment for drawing.
    pub(super) fn prepare_studio(&self, mut studio: Studio) -> Studio {
        studio.viewer.preferences.display.motion =
            if self.motion { Motion::Recorded } else { Motion::Reduced };
        studio.viewer.preferences.choose_theme(self.theme);
        if let Some(instrument) = self.instrument {
            studio.viewer.preferences.display.instrument = instrument;
        }
        if let Some(shape) = self.cloud {
            studio.apply(RunCommand::Cloud(CloudChoice { shape, ..studio.display().cloud }));
        }
        studio
    }
}

/// Name of the light theme in a manifest. The dark theme is not written.
const LIGHT: &str = "light";

/// Returns the drawing of an experiment in the form for its manifest.
pub(super) fn drawing_for_manifest(experiment: &Experiment, capture: &CaptureSettings) -> Drawing {
    let scene = &experiment.scene;
    Drawing {
        scene: scene.name.clone(),
        scene_hash: fingerprint(experiment.text.as_bytes()),
        own_checks: scene.checks.len(),
        race: experiment.mode == Mode::Race,
        loop_trace: experiment.loop_trace.map(|card| card.id.to_owned()),
        selected: (!experiment.leaves_selection())
            .then(|| experiment.opening_method().id.to_owned()),
        frames: capture.schedule.frames,
        fps: capture.schedule.fps,
        size: capture.size_px,
        // The shortest decimal of the f32 reads well as an f64, and reads back as the same f32.
        scale: capture.scale.to_string().parse().expect("a number's own text"),
        panels: capture.panels,
        instrument: capture.instrument.map(Instrument::id),
        cloud: capture.cloud.map(|shape| shape.id().to_owned()),
        motion: capture.motion,
        theme: (capture.theme == Theme::Light).then(|| LIGHT.to_owned()),
        mark_every: capture.mark_every,
    }
}

/// Returns the run that a manifest describes, with its settings and the states that its lanes reached.
///
/// # Errors
/// The reason why this program cannot make the run.
pub(super) fn from_manifest(manifest: &Manifest) -> Result<CapturedRun, String> {
    let Manifest { recording, drawing, .. } = manifest;
    for (key, is_in_range) in [
        ("frames", (1..=MAX_FRAMES).contains(&drawing.frames)),
        ("fps", (1..=MAX_FPS).contains(&drawing.fps)),
        ("scale", (0.5..=4.0).contains(&drawing.scale)),
        ("mark_every", drawing.mark_every > 0),
    ] {
        if !is_in_range {
            return Err(format!("its {key} is out of range; capture again"));
        }
    }
    let mut scene = Scene::parse(&format!("{}.toml", drawing.scene), recording)
        .map_err(|errors| format!("this program cannot read the recording: {errors}"))?;
    let checks = scene.checks.split_off(drawing.own_checks.min(scene.checks.len()));
    let known = |id: &str| {
        let found = scene.own_methods.iter().copied().find(|own| own.id == id);
        found.or_else(|| method(id)).ok_or_else(|| format!("this program has no method {id:?}"))
    };
    let experiment = Experiment {
        selected: drawing.selected.as_deref().map(known).transpose()?,
        scene,
        text: recording.clone(),
        mode: if drawing.race { Mode::Race } else { Mode::Solo },
        loop_trace: drawing.loop_trace.as_deref().map(|id| TRACE.find(id)).transpose()?,
    };
    let capture = CaptureSettings {
        schedule: Schedule { frames: drawing.frames, fps: drawing.fps },
        size_px: drawing.size,
        scale: drawing.scale as f32,
        panels: drawing.panels,
        instrument: drawing.instrument.as_deref().map(|id| INSTRUMENT.find(id)).transpose()?,
        cloud: drawing.cloud.as_deref().map(|id| SHAPE.find(id)).transpose()?,
        motion: drawing.motion,
        theme: match drawing.theme.as_deref() {
            None => Theme::Dark,
            Some(LIGHT) => Theme::Light,
            Some(other) => return Err(format!("this program has no theme {other:?}")),
        },
        mark_every: drawing.mark_every,
        renderer: RendererChoice::Cpu,
    };
    Ok(CapturedRun { experiment, capture, checks })
}

/// Checks that nobody has altered a manifest.
///
/// # Errors
/// A description of the alteration.
pub(super) fn check(manifest: &Manifest) -> Result<(), String> {
    let mut names = manifest.frames.iter().zip(0..).map(|(frame, n)| (&frame.file, frame_name(n)));
    let (drawn, asked) = (manifest.frames.len(), manifest.drawing.frames as usize);
    if drawn > asked || manifest.complete && drawn < asked {
        return Err(format!("it lists {drawn} frames of {asked}; capture again"));
    }
    if let Some((file, name)) = names.find(|(file, name)| *file != name) {
        return Err(format!("it has {file:?} in the place of {name}; capture again"));
    }
    match manifest.hash() == manifest.settings_hash {
        true => Ok(()),
        false => {
            Err("its recording or drawing was altered: their hash differs; capture again".into())
        }
    }
}
