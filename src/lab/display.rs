//! How a lab is looked at, and what it asks of its driver.

use super::lens::Lens;
use super::metrics::METRICS;

/// How a body is drawn between two ticks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// The last tick's state as it is.
    Raw,
    /// A straight line between the last two ticks.
    Linear,
    /// A cubic through the last two ticks with the velocities known there.
    Hermite,
}

impl Interpolation {
    /// The name for people.
    pub fn name(self) -> &'static str {
        match self {
            Interpolation::Raw => "raw",
            Interpolation::Linear => "linear",
            Interpolation::Hermite => "Hermite",
        }
    }
}

/// The instruments of the lower plot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Instrument {
    /// The metric on this place of [`METRICS`], over time.
    Metric(usize),
    /// Velocity over coordinate.
    Phase,
    /// Which method to take, and at what rate.
    Advice,
}

impl Instrument {
    /// Every instrument, in the order of the tabs.
    pub fn all() -> impl Iterator<Item = Instrument> {
        (0..METRICS.len()).map(Instrument::Metric).chain([Instrument::Phase, Instrument::Advice])
    }

    /// The name for people.
    pub fn name(self) -> &'static str {
        match self {
            Instrument::Metric(index) => METRICS[index].name,
            Instrument::Phase => "phase",
            Instrument::Advice => "advice",
        }
    }
}

/// How the lab is looked at; nothing here touches the physics.
#[derive(Clone, Debug, PartialEq)]
pub struct Display {
    /// Whether the exact ghost is drawn.
    pub ghost: bool,
    /// How bodies are drawn between ticks.
    pub interpolation: Interpolation,
    /// What the lower plot shows.
    pub instrument: Instrument,
    /// The body that the plots and the lane list speak of, by its place in the scene.
    pub body: usize,
    /// Whether the help overlay is open.
    pub help: bool,
    /// Whether the inspector is open.
    pub inspector: bool,
    /// Whether trails fade and the camera follows smoothly.
    pub motion: bool,
    /// How each body is zoomed and panned, by its place in the scene; a body beyond the end is fitted.
    pub lenses: Vec<Lens>,
}

impl Display {
    /// How the body at this place of the scene is zoomed and panned.
    pub fn lens(&self, body: usize) -> Lens {
        self.lenses.get(body).copied().unwrap_or_default()
    }

    pub(super) fn set_lens(&mut self, body: usize, lens: Lens) {
        if self.lenses.len() <= body {
            self.lenses.resize(body + 1, Lens::default());
        }
        self.lenses[body] = lens;
    }
}

/// How fast the driver of a lab in real time goes; only it can know.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pace {
    /// Time runs, but not yet for long enough to tell.
    Unknown,
    /// What was measured since, over a second or more.
    Measured {
        /// Frames drawn in a second of real time.
        frames_per_second: f64,
        /// Simulated seconds in a second of real time.
        real_time_factor: f64,
    },
}

/// What the lab asks of its driver after a command that is not the lab's business.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ask {
    /// Save what is shown to a file.
    Screenshot,
    /// Save the run to a file.
    Record,
    /// Enter or leave full screen.
    ToggleFullScreen,
    /// Open the scene file at the path that was typed.
    OpenTypedPath,
    /// Type as much more of the path as is sure.
    CompletePath,
    /// End the program.
    Quit,
}
