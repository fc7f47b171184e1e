//! How a studio is displayed, and what it requests of its driver.

use std::collections::BTreeMap;

use super::instrument::Instrument;
use super::zoom_pan::ZoomPan;
use crate::look::palette::Theme;
use crate::measure::cloud::CloudChoice;
use crate::run::past::Quantity;
use crate::run::race::Interpolation;

/// How the lanes of a race share the stage.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Arrangement {
    /// All lanes of a body over each other, the selected one in front.
    #[default]
    Overlay,
    /// Each lane in cells of its own.
    SideBySide,
}

/// What moves on a stage besides the bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// As little as can be, for a person who watches: trails do not fade, the camera turns pages, and the stage zooms out
    /// after a lane that outgrows it in steps.
    Reduced,
    /// Trails fade, and the camera follows bodies smoothly.
    Recorded,
    /// The stage also zooms out evenly after a lane that outgrows it, while time slows down, and a run rests where the scene
    /// or its bodies end: for a person who watches.
    Live,
}

/// How the studio is displayed, whatever the scene is. It does not affect the physics.
#[derive(Clone, Debug, PartialEq)]
pub struct Display {
    /// Whether instruments, table and timeline stand round the stage; otherwise it fills the window, over the methods.
    pub measure: bool,
    /// Where a person has put the boundaries between stage, instruments and table.
    pub splits: Splits,
    /// Whether the next second under each method is drawn while time stands still.
    pub futures: bool,
    /// Whether the exact ghost is drawn.
    pub ghost: bool,
    /// How bodies are drawn between ticks.
    pub interpolation: Interpolation,
    /// What the panel beside the stage shows.
    pub instrument: Instrument,
    /// Whether the instrument covers the stage too.
    pub enlarged: bool,
    /// What the motion instrument shows of every body; `None` for what is [usual](Quantity::usual).
    pub quantity: Option<Quantity>,
    /// The metric of the error instrument, by its index in [`METRICS`](crate::run::METRICS).
    pub metric: usize,
    /// Whether the advice is about the [displayed body](View::body) alone, and not about all.
    pub advises_on_one_body: bool,
    /// The clouds of the cloud instrument.
    pub cloud: CloudChoice,
    /// How the lanes of a race share the stage.
    pub arrangement: Arrangement,
    /// A dark or a light chart.
    pub theme: Theme,
    /// The size of type and panels in percent of the usual one, as a person chose it.
    pub scale_percent: u32,
    /// Whether the help overlay is open.
    pub help: bool,
    /// Whether the inspector is open.
    pub inspector: bool,
    /// What moves besides the bodies.
    pub motion: Motion,
}

/// The parts of the window that instruments and table have, in percent; `None` as it is usual.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Splits {
    /// The width of the instruments, from 20 to 70.
    pub instruments: Option<u32>,
    /// The height of the table, from 8 to 60.
    pub table: Option<u32>,
}

impl Splits {
    /// The same, each within its range.
    pub fn within(self) -> Self {
        Self {
            instruments: self.instruments.map(|percent| percent.clamp(20, 70)),
            table: self.table.map(|percent| percent.clamp(8, 60)),
        }
    }
}

/// Where a person looks in a scene. It ends with the scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct View {
    /// The body of the plots and the lane list, by its index in the scene.
    pub body: usize,
    /// The coordinate of each body that a person has chosen for the plots, by its index; a body beyond the end has the
    /// [usual one](crate::run::race::LaneBody::plotted_coordinate).
    pub coordinates: Vec<Option<usize>>,
    /// The body and its parameter that a person has chosen for the stability map, by their indices.
    pub mapped_parameter: Option<(usize, usize)>,
    /// What a person has zoomed and panned the plots to: a range of each axis, by its name. An axis without a range is
    /// fitted.
    pub plot_ranges: BTreeMap<String, [f64; 2]>,
    /// The zoom and the pan of each body, by its index in the scene; a body beyond the end is fitted.
    pub zoom_pans: Vec<ZoomPan>,
}

impl View {
    /// The zoom and the pan of the body with this index in the scene.
    pub fn zoom_pan(&self, body: usize) -> ZoomPan {
        self.zoom_pans.get(body).copied().unwrap_or_default()
    }

    pub(super) fn choose_coordinate(&mut self, body: usize, coordinate: usize) {
        if self.coordinates.len() <= body {
            self.coordinates.resize(body + 1, None);
        }
        self.coordinates[body] = Some(coordinate);
    }

    pub(super) fn set_zoom_pan(&mut self, body: usize, zoom_pan: ZoomPan) {
        if self.zoom_pans.len() <= body {
            self.zoom_pans.resize(body + 1, ZoomPan::default());
        }
        self.zoom_pans[body] = zoom_pan;
    }
}

/// The pace of a driver in real time, as the driver measures it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pace {
    /// Time has not run long enough for a measurement.
    Unknown,
    /// A measurement over a second or more.
    Measured {
        /// Frames drawn per second of real time.
        frames_per_second: f64,
        /// Simulated seconds per second of real time.
        real_time_factor: f64,
    },
}

/// What a command requests of the driver, because the studio cannot do it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DriverRequest {
    /// Save a screenshot to a file.
    Screenshot,
    /// Save the run to a file.
    Record,
    /// Copy the link to the run to the clipboard.
    CopyLink,
    /// Copy the instrument's values to the clipboard.
    CopyInstrument,
    /// Copy the method with this index in the list to the clipboard, as source code in the viewer's
    /// [language](super::Viewer::language).
    CopyMethod(usize),
    /// Copy the lines of code that tell the engine with this index in the list the displayed body's spring.
    CopyJoint(usize),
    /// Save the instrument as a picture, a drawing and a table.
    ExportInstrument,
    /// Enter or leave full screen.
    ToggleFullScreen,
    /// Open the scene file at the path that was typed.
    OpenTypedPath,
    /// Complete the typed path as far as it is unambiguous.
    CompletePath,
    /// End the program.
    Quit,
}
