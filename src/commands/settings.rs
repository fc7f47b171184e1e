//! The settings of a capture, and their conversion to and from those of a manifest.

use super::experiment::Experiment;
use super::frame_names::{MAX_FRAMES, frame_name};
use super::id::{CLOUD, INSTRUMENT, TRACE};
use super::manifest::{
    FrameEntry, LaneEntry, Manifest, OwnEntry, SceneText, Settings, fingerprint,
};
use super::schedule::{MAX_FPS, Schedule};
use crate::look::palette::Theme;
use crate::measure::cloud::{CloudChoice, CloudKind};
use crate::run::race::Mode;
use crate::scene::{LaneSpec, MAX_LANES, MAX_SUBSTEPS, Scene, Swing, TOLERANCES, own};
use crate::sim::integrators::{Method, method};
use crate::sim::{Impact, impact};
use crate::studio::{Instrument, Motion, RunCommand, Studio};
#[cfg(feature = "view")]
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
    /// Kind of the clouds, or `None` for the default shape.
    pub(super) cloud: Option<CloudKind>,
    /// Whether trails fade and the camera glides.
    pub(super) motion: bool,
    pub(super) theme: Theme,
    /// Number of ticks between two marks in the manifest.
    pub(super) mark_every: u64,
    #[cfg(feature = "view")]
    pub(super) renderer: RendererChoice,
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
        if let Some(kind) = self.cloud {
            studio.apply(RunCommand::Cloud(CloudChoice { kind, ..studio.display().cloud }));
        }
        studio
    }
}

/// Name of the light theme in a manifest. The dark theme is not written.
const LIGHT: &str = "light";

/// Returns the settings of a run in the form for its manifest.
pub(super) fn settings_for_manifest(
    experiment: &Experiment,
    capture: &CaptureSettings,
) -> Settings {
    let scene = &experiment.scene;
    let lane = |lane: &LaneSpec| LaneEntry {
        method: lane.method.id.to_owned(),
        substeps: lane.substeps,
        tolerance: lane.tolerance,
        joint: lane.joint.map(|it| [it.frequency_hz, it.damping_ratio]),
        impact: (lane.impact != <&Impact>::default()).then(|| lane.impact.id.to_owned()),
    };
    let own = |method: &&Method| {
        let step = method.own_text()?.to_owned();
        let fps = method.rule_fps().map(|fps| fps.to_string());
        Some(OwnEntry { id: method.id.to_owned(), step, fps })
    };
    Settings {
        scene: SceneText {
            name: scene.name.clone(),
            hash: fingerprint(experiment.text.as_bytes()),
            text: experiment.text.clone(),
        },
        lanes: scene.lanes.iter().map(lane).collect(),
        methods: scene.own_methods.iter().filter_map(own).collect(),
        race: experiment.mode == Mode::Race,
        loop_trace: experiment.loop_trace.map(|card| card.id.to_owned()),
        selected: (!experiment.leaves_selection())
            .then(|| experiment.opening_method().id.to_owned()),
        tick_hz: scene.tick_hz,
        frames: capture.schedule.frames,
        fps: capture.schedule.fps,
        size: capture.size_px,
        // The shortest decimal of the f32 reads well as an f64, and reads back as the same f32.
        scale: capture.scale.to_string().parse().expect("a number's own text"),
        panels: capture.panels,
        instrument: capture.instrument.map(Instrument::id),
        cloud: capture.cloud.map(|kind| kind.name().to_owned()),
        motion: capture.motion,
        theme: (capture.theme == Theme::Light).then(|| LIGHT.to_owned()),
        mark_every: capture.mark_every,
    }
}

/// Returns the run that these settings describe.
///
/// # Errors
/// The reason why this program cannot make the run.
pub(super) fn from_manifest(settings: &Settings) -> Result<(Experiment, CaptureSettings), String> {
    let SceneText { name, text, .. } = &settings.scene;
    let made = |entry: &OwnEntry| {
        let refused = |why| format!("this program cannot read the method {:?}: {why}", entry.id);
        let fps = entry.fps.as_deref().map(str::parse).transpose().map_err(refused)?;
        own(&entry.id, &entry.step, fps).map_err(|fault| refused(fault.what))
    };
    let own = settings.methods.iter().map(made).collect::<Result<Vec<_>, _>>()?;
    let known = |id: &str| {
        let found = own.iter().copied().find(|own| own.id == id).or_else(|| method(id));
        found.ok_or_else(|| format!("this program has no method {id:?}"))
    };
    let scene = Scene::parse(&format!("{name}.toml"), text)
        .map_err(|errors| format!("this program cannot read the scene: {errors}"))?;
    let substeps = |lane: &LaneEntry| (1..=MAX_SUBSTEPS).contains(&lane.substeps);
    let tolerance = |lane: &LaneEntry| {
        lane.tolerance.is_none_or(|given| (TOLERANCES.0..=TOLERANCES.1).contains(&given))
    };
    let swing = |[frequency_hz, damping_ratio]: [f64; 2]| Swing { frequency_hz, damping_ratio };
    let joint = |lane: &LaneEntry| lane.joint.map(swing).is_none_or(Swing::is_in_range);
    for (key, is_in_range) in [
        ("tick_hz", settings.tick_hz.is_in_range()),
        ("frames", (1..=MAX_FRAMES).contains(&settings.frames)),
        ("fps", (1..=MAX_FPS).contains(&settings.fps)),
        ("scale", (0.5..=4.0).contains(&settings.scale)),
        ("mark_every", settings.mark_every > 0),
        ("lanes", (1..=MAX_LANES).contains(&settings.lanes.len())),
        ("substeps", settings.lanes.iter().all(substeps)),
        ("tolerance", settings.lanes.iter().all(tolerance)),
        ("joint", settings.lanes.iter().all(joint)),
    ] {
        if !is_in_range {
            return Err(format!("its {key} is out of range; capture again"));
        }
    }
    let mut scene = scene.at_tick_hz(settings.tick_hz);
    let lane = |lane: &LaneEntry| {
        let method = known(&lane.method)?;
        if lane.tolerance.is_some() && method.tolerance.is_none() {
            return Err(format!(
                "its {} has a tolerance, but the method takes none; capture again",
                method.id
            ));
        }
        let &LaneEntry { substeps, tolerance, .. } = lane;
        let joint = lane.joint.map(swing);
        let known = |id: &str| impact(id).ok_or_else(|| format!("this program has no rule {id:?}"));
        let impact = lane.impact.as_deref().map_or(Ok(Default::default()), known)?;
        Ok(LaneSpec { method, substeps, tolerance, joint, impact })
    };
    // The lanes already have the substeps that equal cost gave them.
    scene.equal_cost = false;
    scene.own_methods.clone_from(&own);
    scene.lanes = settings.lanes.iter().map(lane).collect::<Result<_, String>>()?;
    let experiment = Experiment {
        scene,
        text: text.clone(),
        selected: settings.selected.as_deref().map(known).transpose()?,
        mode: if settings.race { Mode::Race } else { Mode::Solo },
        loop_trace: settings.loop_trace.as_deref().map(|id| TRACE.find(id)).transpose()?,
    };
    let capture = CaptureSettings {
        schedule: Schedule { frames: settings.frames, fps: settings.fps },
        size_px: settings.size,
        scale: settings.scale as f32,
        panels: settings.panels,
        instrument: settings.instrument.as_deref().map(|id| INSTRUMENT.find(id)).transpose()?,
        cloud: settings.cloud.as_deref().map(|id| CLOUD.find(id)).transpose()?,
        motion: settings.motion,
        theme: match settings.theme.as_deref() {
            None => Theme::Dark,
            Some(LIGHT) => Theme::Light,
            Some(other) => return Err(format!("this program has no theme {other:?}")),
        },
        mark_every: settings.mark_every,
        #[cfg(feature = "view")]
        renderer: RendererChoice::Cpu,
    };
    Ok((experiment, capture))
}

/// Checks that nobody has altered a manifest.
///
/// # Errors
/// A description of the alteration.
pub(super) fn check(manifest: &Manifest) -> Result<(), String> {
    let settings = &manifest.settings;
    let scene = &settings.scene;
    if fingerprint(scene.text.as_bytes()) != scene.hash {
        return Err("the scene's text was altered: its hash differs; capture again".into());
    }
    let mut names = manifest.frames.iter().zip(0..).map(|(frame, n)| (&frame.file, frame_name(n)));
    let (drawn, asked) = (manifest.frames.len(), settings.frames as usize);
    if drawn > asked || manifest.complete && drawn < asked {
        return Err(format!("it lists {drawn} frames of {asked}; capture again"));
    }
    if let Some((file, name)) = names.find(|(file, name)| *file != name) {
        return Err(format!("it has {file:?} in the place of {name}; capture again"));
    }
    let marked = manifest.marks.last().map_or(0, |mark| mark.lanes.len());
    if manifest.lanes.len() < marked {
        let ended = manifest.lanes.len();
        return Err(format!("it lists the ends of {ended} lanes of {marked}; capture again"));
    }
    if settings.hash() == manifest.settings_hash {
        return Ok(());
    }
    match drawn_at_hz(manifest) {
        Some(hz) if hz != settings.tick_hz.hz().round() as u64 => Err(format!(
            "it says {} Hz, but at {} frames per second its frames are those of {hz} Hz: another tick rate \
             is another run; capture again",
            settings.tick_hz, settings.fps
        )),
        _ => Err("its settings were altered: their hash differs; capture again".into()),
    }
}

/// Returns the tick rate in Hz that follows from the tick and the time of the last frame, on the assumption that the
/// rate never changes.
fn drawn_at_hz(manifest: &Manifest) -> Option<u64> {
    let last = manifest.frames.len().checked_sub(1)?;
    let FrameEntry { tick, alpha: [numerator, denominator], .. } = manifest.frames[last];
    let Settings { frames, fps, .. } = manifest.settings;
    let ns = Schedule { frames, fps: fps.max(1) }.time_ns(u32::try_from(last).ok()?);
    let ticks = tick as f64 + numerator as f64 / denominator as f64;
    (ns > 0).then(|| (ticks * 1e9 / ns as f64).round() as u64)
}
