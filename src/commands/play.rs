//! `regatta play`: opens the window. If there is no display, draws the first seconds as pictures.

use std::env;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use annotate_snippets::Renderer;
use clap::Args;

use super::error::Error;
use super::experiment::{self, Experiment, known_trace};
use super::experiment_args::ExperimentArgs;
use super::frame_folder::FrameFolder;
use super::help::flowing;
use super::id::{RENDERER, THEME};
use super::interrupt::on_interrupt;
use super::output::{Destination, Output};
use super::schedule::{FPS, Schedule, frames_in};
use super::settings::{CaptureSettings, drawing_for_manifest};
use super::terminal::print_status;
use super::{WINDOW_LIBRARIES, clip, scene_file, state_log};
use crate::atomic_file::IfExists;
use crate::look::palette::Theme;
use crate::loops::TraceCard;
use crate::run::race::Mode;
use crate::run::trace::last_tick;
use crate::scene::OPENING;
use crate::sim::number::counted;
use crate::studio::{Motion, SavedPreferences, Studio, show_clouds_of_scene};
use crate::view::RendererChoice;
use crate::window::{self, Closed, SceneFiles, WindowError, WindowSettings};
use unfinished::UnfinishedRecording;

mod preferences;
mod unfinished;

const EXAMPLES: &str = "\
Examples:
  regatta play --scene spring --method explicit-euler
  regatta play --scene stiff --race --tick-hz 49
  regatta play --scene my.toml
  regatta play --scene spring --record run.toml

In the window, H shows the keys. Without a display, play draws the first seconds into
./regatta-frames instead.";

/// Open the window (also without `play`)
#[derive(Clone, Debug, Args)]
#[command(after_long_help = flowing(EXAMPLES))]
pub(super) struct PlayArgs {
    #[command(flatten)]
    experiment: ExperimentArgs,

    /// Race all methods of the scene at once
    #[arg(long)]
    race: bool,

    /// Open the loop lab on a trace [default: edge]
    ///
    /// `regatta list traces` has the names.
    #[arg(long = "loop", value_name = "TRACE", conflicts_with = "race")]
    #[arg(num_args = 0..=1, default_missing_value = "edge", value_parser = known_trace)]
    loop_trace: Option<&'static TraceCard>,

    /// Close after these simulated seconds
    ///
    /// At the nearest tick. The default is never.
    #[arg(long, value_name = "s", value_parser = experiment::seconds)]
    #[arg(allow_negative_numbers = true)]
    seconds: Option<f64>,

    /// Write the run to FILE as a scene
    ///
    /// Play writes it when the window closes, or on Ctrl-C. Until then it saves the run so far as FILE.unfinished.toml.
    #[arg(long, value_name = "FILE")]
    record: Option<PathBuf>,

    /// Replace the --record FILE if it exists
    #[arg(long, requires = "record", hide_short_help = true)]
    force: bool,

    /// The theme: dark or light
    ///
    /// The default is the one chosen last, else the system's.
    #[arg(long, value_name = "THEME", value_parser = THEME)]
    #[arg(hide_possible_values = true, hide_short_help = true)]
    theme: Option<Theme>,

    /// What draws: auto, gpu or cpu [default: auto]
    ///
    /// Auto takes a graphics card, or the processor if there is none.
    #[arg(long, value_name = "WHAT", value_parser = RENDERER)]
    #[arg(hide_possible_values = true, hide_short_help = true)]
    renderer: Option<RendererChoice>,

    /// Trails do not fade, and the camera zooms out in steps
    #[arg(long, hide_short_help = true)]
    reduced_motion: bool,
}

impl PlayArgs {
    /// Whether no option is about the run, as if the program was started by a click.
    fn asks_for_nothing(&self) -> bool {
        !self.race && self.loop_trace.is_none() && self.seconds.is_none() && self.record.is_none()
    }

    /// Whether a graphics device may draw.
    pub(super) fn may_take_a_device(&self) -> bool {
        self.renderer != Some(RendererChoice::Cpu)
    }
}

/// Directory into which the pictures are drawn if there is no display.
const FRAMES_DIR: &str = "regatta-frames";
/// Number of pictures if there is no display. They are enough to show how each method behaves, and are drawn in a few
/// seconds.
const FRAMES: u32 = 4 * FPS;
/// Size of these pictures in pixels, which is also that of the window.
const SIZE_PX: [u32; 2] = [1280, 720];

pub(super) fn run(args: &PlayArgs) -> Result<(), Error> {
    let mode = if args.race { Mode::Race } else { Mode::Solo };
    let preferences = preferences::load();
    // A run whose length is given belongs to a script, so it must be the same everywhere.
    let last_scene = preferences.scene.as_deref().filter(|_| args.seconds.is_none());
    let again = last_scene.map(|scene| args.experiment.or_scene(scene));
    let given = match args.asks_for_nothing() {
        true => args.experiment.or_scene(Path::new(OPENING)),
        false => args.experiment.clone(),
    };
    // The scene file may no longer exist.
    let again = again.and_then(|options| Some((options.load(mode).ok()?, options)));
    let (experiment, options) = match again {
        Some(opened) => opened,
        None => (given.load(mode)?, given),
    };
    let loop_trace = args.loop_trace.or_else(|| scene_file::loop_trace_of(options.scene()));
    let experiment = Experiment { loop_trace, ..experiment };
    let mut studio = experiment.studio();
    studio.viewer.preferences.display.motion =
        if args.reduced_motion { Motion::Reduced } else { Motion::Live };
    if loop_trace.is_none() {
        show_clouds_of_scene(&mut studio);
    }
    let opens_at_work = args.race || loop_trace.is_some();
    let shown = SavedPreferences {
        theme: args.theme.or(preferences.theme),
        measure: preferences.measure || opens_at_work,
        ..preferences.clone()
    };
    shown.apply(&mut studio);
    let inputs = Vec::from_iter(options.input());
    let record = args.record.as_deref().map(|path| {
        let if_exists = if args.force { IfExists::Replace } else { IfExists::Beside };
        Destination { path, option: "--record", if_exists, inputs: &inputs }
    });
    // The file is opened before the run, so that no run starts that cannot be saved. The file is begun again after the
    // run, so that a program that is killed leaves only the unfinished recording beside it.
    let opened = record.map(Destination::open_for_text).transpose()?;
    let unfinished = opened.as_ref().and_then(Output::file).map(UnfinishedRecording::for_recording);
    let stream = opened.filter(|output| output.file().is_none());
    for told in unfinished::left_behind() {
        print_status(&told);
        studio.viewer.set_notice(told);
    }
    let played = studio.scene().name.clone();
    let settings = WindowSettings {
        seconds: args.seconds,
        tick: scene_file::tick_of(options.scene()).map(|tick| tick.min(last_tick(studio.scene()))),
        size: preferences.size,
        renderer: args.renderer.unwrap_or_default(),
        on_interrupt: record.map(|_| on_interrupt as _),
    };
    let keep = unfinished.as_ref().map(UnfinishedRecording::keeper);
    let files = SceneFiles { keep, ..files(&options, &experiment) };
    let (studio, interrupted) = match window::run(studio, settings, files) {
        Err(WindowError::NoDisplay(reason)) => {
            (without_display(args, &experiment, &reason)?, false)
        }
        done => {
            let Closed { studio, interrupted, size } = done.map_err(Error::failed)?;
            let is_own = args.seconds.is_some() || args.experiment.names_a_scene();
            let scene = if is_own { preferences.scene } else { preferences::scene_of(&studio) };
            let shown = SavedPreferences::of(&studio);
            let theme = shown.theme.filter(|_| args.theme.is_none()).or(preferences.theme);
            let size = size.or(preferences.size);
            preferences::save(&SavedPreferences { scene, theme, size, ..shown });
            (studio, interrupted)
        }
    };
    if let Some(to) = record {
        let mut record = stream.map_or_else(|| to.begin(), Ok)?;
        let wanted = record.name();
        record.write_all(studio.deck.recording().map_err(Error::failed)?.as_bytes())?;
        let name = record.close()?;
        if let Some(unfinished) = unfinished {
            unfinished.finish();
        }
        if name != wanted {
            print_status(&format!(
                "another program created {wanted} during the run; it was not replaced"
            ));
        }
        if studio.scene().name != played {
            let scene = studio.deck.scene_name();
            print_status(&format!("the recording is of {scene}, which was opened after {played}"));
        }
        print_status(&format!("recorded {} in {name}", ticks(&studio)));
    }
    match interrupted {
        true => Err(Error::interrupted_after(ticks(&studio))),
        false => Ok(()),
    }
}

/// Describes the length of a run.
fn ticks(studio: &Studio) -> String {
    counted(studio.run().end(), "tick")
}

/// Draws the first seconds of the run into a folder. Returns the studio at the end of the run.
fn without_display(
    args: &PlayArgs,
    experiment: &Experiment,
    reason: &str,
) -> Result<Studio, Error> {
    let frames = match args.seconds {
        Some(seconds) => frames_in(seconds, FPS)?,
        None => FRAMES,
    };
    let folder = FrameFolder::new_sibling(FRAMES_DIR)?;
    let schedule = Schedule { frames, fps: FPS };
    let studio = experiment.studio();
    let capture = CaptureSettings {
        schedule,
        size_px: SIZE_PX,
        scale: 1.0,
        panels: true,
        instrument: None,
        cloud: None,
        motion: !args.reduced_motion,
        theme: args.theme.unwrap_or_default(),
        mark_every: state_log::usual_stride(schedule.ticks(&studio)),
        renderer: args.renderer.unwrap_or(RendererChoice::Cpu),
    };
    let drawing = drawing_for_manifest(experiment, &capture);
    // The error of a missing device comes before frames are promised.
    let renderer = capture.renderer()?;
    // winit names no library, and no display.
    let named = ["WAYLAND_DISPLAY", "DISPLAY"].map(|name| match env::var(name) {
        Ok(display) if !display.is_empty() => format!("; {name} is {display}"),
        _ => String::new(),
    });
    let remedy = match reason.contains("librar") {
        true => format!("; {WINDOW_LIBRARIES}"),
        false => named.concat(),
    };
    print_status(&format!(
        "no display to open a window on ({reason}{remedy}); drawing {} s of it into {} instead",
        f64::from(frames) / f64::from(FPS),
        folder.path().display(),
    ));
    let last = args.seconds.map(|seconds| studio.race().nearest_tick(seconds));
    let mut studio = clip::record(experiment, drawing, studio, capture, renderer, folder)?;
    // The last frame may be before the end of the run.
    while last.is_some_and(|last| studio.race().tick() < last) {
        studio.tick();
    }
    Ok(studio)
}

/// Returns the reader of scene files for the window. It applies the options of the command line only to the file that
/// they name. Its errors read as on the command line.
fn files(args: &ExperimentArgs, experiment: &Experiment) -> SceneFiles {
    let given = args.clone();
    let read = move |path: &Path| {
        given.read_anew(path).map_err(|error| error.mistakes(&Renderer::plain()))
    };
    let is_file = scene_file::is_file(args.scene());
    let opened = is_file.then(|| (args.scene().to_owned(), experiment.text.clone()));
    let methods = args.method_files().map(Path::to_owned).collect();
    SceneFiles { read: Arc::new(read), opened, methods, keep: None }
}
