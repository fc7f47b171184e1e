//! A scene with the options of a command line applied, and the studio that it sets up.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use clap::builder::{PossibleValue, TypedValueParser};

use super::id::TRACE;
use crate::loops::{TRACES, TraceCard};
use crate::run::race::Mode;
use crate::scene::{MAX_SECONDS, SCENES, Scene};
use crate::sim::integrators::Method;
use crate::studio::{Studio, open_loop_lab_on};

/// A scene to which the options of the command line have been applied, and its methods.
pub(super) struct Experiment {
    /// The scene, with the options applied.
    pub(super) scene: Scene,
    /// The text of the scene file, without the options.
    pub(super) text: String,
    /// The first method that the options name. `None` if they name none, or many.
    pub(super) selected: Option<&'static Method>,
    /// Whether the lanes of the scene race.
    pub(super) mode: Mode,
    /// The trace on which the loop lab opens, if it does.
    pub(super) loop_trace: Option<&'static TraceCard>,
}

impl Experiment {
    /// Returns the method that is shown alone, or that is selected in a race.
    pub(super) fn opening_method(&self) -> &'static Method {
        self.selected.unwrap_or_else(|| self.scene.opening_lane().method)
    }

    /// Whether the race has no selected method yet. If so, its verdicts select one.
    pub(super) fn leaves_selection(&self) -> bool {
        self.mode == Mode::Race && self.selected.is_none()
    }

    /// Returns the studio at tick 0. A scene with a single lane opens in solo mode.
    pub(super) fn studio(&self) -> Studio {
        let mut studio = Studio::opened(self.scene.clone(), self.selected, self.mode);
        if let Some(card) = self.loop_trace {
            open_loop_lab_on(&mut studio, card.id);
        }
        studio
    }
}

/// Returns the built-in trace with this id. Clap uses this function as a parser.
pub(super) fn known_trace(id: &str) -> Result<&'static TraceCard, String> {
    TRACE.find(id).map_err(|refusal| match is_path(id) {
        true => "only built-in traces are taken here; drop the file on the window, open it there with O, or \
                 give it to `regatta loop --trace`"
            .into(),
        false => refusal,
    })
}

/// Whether an id looks like a file path.
fn is_path(id: &str) -> bool {
    Path::new(id).extension().is_some() || id.contains(['/', '\\'])
}

/// Parses a duration in seconds.
pub(super) fn seconds(written: &str) -> Result<f64, String> {
    match written.parse::<f64>() {
        Ok(seconds) if (0.0..=MAX_SECONDS).contains(&seconds) => Ok(seconds),
        Ok(_) => Err(format!("give 0 to {MAX_SECONDS} seconds")),
        Err(_) => Err("give a number of seconds, such as 8.5".into()),
    }
}

/// Parses a duration, which must be longer than 0 seconds.
pub(super) fn some_seconds(written: &str) -> Result<f64, String> {
    match seconds(written)? {
        0.0 => Err("give more than 0 seconds".into()),
        seconds => Ok(seconds),
    }
}

/// A parser that accepts any path, and offers these names for shell completion.
#[derive(Clone)]
pub(super) struct PathOrName(pub(super) fn() -> Vec<&'static str>);

impl TypedValueParser for PathOrName {
    type Value = PathBuf;

    fn parse_ref(
        &self,
        command: &clap::Command,
        arg: Option<&clap::Arg>,
        value: &OsStr,
    ) -> Result<PathBuf, clap::Error> {
        clap::builder::PathBufValueParser::new().parse_ref(command, arg, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new((self.0)().into_iter().map(PossibleValue::new)))
    }
}

pub(super) fn scene_names() -> Vec<&'static str> {
    SCENES.iter().map(|scene| scene.name).collect()
}

pub(super) fn trace_names() -> Vec<&'static str> {
    TRACES.iter().map(|card| card.id).collect()
}
