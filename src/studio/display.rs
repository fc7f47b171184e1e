//! The display settings of a studio, and its requests to the driver.

use std::collections::BTreeMap;

use super::instrument::Instrument;
use super::zoom_pan::ZoomPan;
use crate::look::palette::Theme;
use crate::measure::cloud::CloudChoice;
use crate::run::MenuIndex;
use crate::run::past::Quantity;
use crate::run::race::Interpolation;

/// Arrangement of a race's lanes on the stage.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Arrangement {
    /// All lanes of a body lie over each other, with the selected one in front.
    #[default]
    Overlay,
    /// Each lane has its own cells.
    SideBySide,
}

/// Amount of motion on the stage besides that of the bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// The least motion for a person who watches. Trails do not fade, the camera turns pages, and the stage zooms out
    /// in steps.
    Reduced,
    /// Trails fade, and the camera follows bodies smoothly.
    Recorded,
    /// The most motion for a person who watches. The stage also zooms out evenly after a lane that outgrows it, while
    /// time slows down. The run rests at the end of its scene or when its bodies are lost.
    Live,
}

/// Display settings, which are independent of the scene and do not affect the physics.
#[derive(Clone, Debug, PartialEq)]
pub struct Display {
    /// Whether the instruments, the table and the timeline surround the stage. Otherwise the stage fills the window
    /// above the methods.
    pub measure: bool,
    /// Boundaries between stage, instruments and table, as far as the person has set them.
    pub splits: Splits,
    /// Whether the stage shows the next second under each method while time stands still.
    pub futures: bool,
    /// Whether the stage shows the exact ghost.
    pub ghost: bool,
    /// Whether the stage shows the frame rate of the driver, and the time of a frame.
    pub frame_rate: bool,
    /// How bodies are drawn between ticks.
    pub interpolation: Interpolation,
    /// Instrument in the panel beside the stage.
    pub instrument: Instrument,
    /// Whether the instrument also covers the stage.
    pub enlarged: bool,
    /// Quantity of every body in the motion instrument, or `None` for the [usual](Quantity::usual) one of each.
    pub quantity: Option<Quantity>,
    /// Index in [`METRICS`](crate::run::METRICS) of the metric in the error instrument.
    pub metric: usize,
    /// Whether the advice covers only the [displayed body](View::body).
    pub advises_on_one_body: bool,
    /// The clouds that the cloud instrument shows.
    pub cloud: CloudChoice,
    /// Arrangement of a race's lanes on the stage.
    pub arrangement: Arrangement,
    /// The dark or the light theme.
    pub theme: Theme,
    /// Chosen size of type and panels, in percent of the usual size.
    pub scale_percent: u32,
    /// Whether the help overlay is open.
    pub help: bool,
    /// Whether the inspector is open.
    pub inspector: bool,
    /// Amount of motion on the stage besides that of the bodies.
    pub motion: Motion,
}

/// Shares of the window for the instruments and the table, in percent. `None` is the usual share.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Splits {
    /// Width of the instruments, from 20 to 70 % of the window's.
    pub instruments: Option<u32>,
    /// Height of the table, from 8 to 60 % of the window's.
    pub table: Option<u32>,
}

impl Splits {
    /// Returns both shares, clamped to their ranges.
    pub fn clamped(self) -> Self {
        Self {
            instruments: self.instruments.map(|percent| percent.clamp(20, 70)),
            table: self.table.map(|percent| percent.clamp(8, 60)),
        }
    }
}

/// The person's view of one scene. It is discarded with the scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct View {
    /// Index in the scene of the displayed body, which is the one of the plots and the lane list.
    pub body: usize,
    /// Coordinate that is chosen for each body's plots, by the body's index. A body beyond the end of the list has the
    /// [usual one](crate::run::race::LaneBody::plotted_coordinate).
    pub coordinates: Vec<Option<usize>>,
    /// Indices of the body and the parameter that are chosen for the stability map.
    pub mapped_parameter: Option<(usize, usize)>,
    /// Ranges to which the person has zoomed and panned the axes of plots, by the names of the axes. An axis without a
    /// range is fitted.
    pub plot_ranges: BTreeMap<String, [f64; 2]>,
    /// Menu indices of the methods whose [bands](super::Studio::bands) the person has chosen, or `None` for the first
    /// ones.
    pub bands: Option<Vec<MenuIndex>>,
    /// Zoom and pan of each body, by its index in the scene. A body beyond the end of the list is fitted.
    pub zoom_pans: Vec<ZoomPan>,
}

impl View {
    /// Returns the zoom and the pan of the body with this index in the scene.
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

/// A driver's pace in real time, as measured by the driver.
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

/// The part of a command that only the driver can execute.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DriverRequest {
    /// Save a screenshot to a file.
    Screenshot,
    /// Save the run to a file.
    Record,
    /// Save a screenshot that carries the recording of the run.
    Report,
    /// Copy the link to the run to the clipboard.
    CopyLink,
    /// Copy the instrument's values to the clipboard.
    CopyInstrument,
    /// Copy the method with this menu index to the clipboard, as source code in the viewer's
    /// [language](super::Viewer::language).
    CopyMethod(MenuIndex),
    /// Copy the lines of code that set the displayed body's spring in the engine with this menu index.
    CopyJoint(MenuIndex),
    /// Save the instrument as a picture, as a drawing and as a table.
    ExportInstrument,
    /// Enter or leave full screen.
    ToggleFullScreen,
    /// Open the scene file at the typed path.
    OpenTypedPath,
    /// Complete the typed path as far as it is unambiguous.
    CompletePath,
    /// End the program.
    Quit,
}
