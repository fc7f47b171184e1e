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
    /// All lanes of a body over each other, the selected one in front.
    #[default]
    Overlay,
    /// Each lane in its own cells.
    SideBySide,
}

/// Motion on the stage besides that of the bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// The least for a person who watches: trails do not fade, the camera turns pages, and the stage zooms out in
    /// steps.
    Reduced,
    /// Trails fade, and the camera follows bodies smoothly.
    Recorded,
    /// The most for a person who watches: the stage also zooms out evenly after a lane that outgrows it, while time
    /// slows down. A run rests at the end of its scene or bodies.
    Live,
}

/// Display settings, independent of the scene. They do not affect the physics.
#[derive(Clone, Debug, PartialEq)]
pub struct Display {
    /// Whether instruments, table and timeline surround the stage; otherwise it fills the window, above the methods.
    pub measure: bool,
    /// Boundaries between stage, instruments and table as the person set them.
    pub splits: Splits,
    /// Whether the stage shows the next second under each method while time stands still.
    pub futures: bool,
    /// Whether the stage shows the exact ghost.
    pub ghost: bool,
    /// How bodies are drawn between ticks.
    pub interpolation: Interpolation,
    /// Instrument in the panel beside the stage.
    pub instrument: Instrument,
    /// Whether the instrument covers the stage, too.
    pub enlarged: bool,
    /// Quantity of every body in the motion instrument; `None` for the [usual](Quantity::usual) one.
    pub quantity: Option<Quantity>,
    /// Metric of the error instrument, by its index in [`METRICS`](crate::run::METRICS).
    pub metric: usize,
    /// Whether the advice covers only the [displayed body](View::body).
    pub advises_on_one_body: bool,
    /// The clouds of the cloud instrument.
    pub cloud: CloudChoice,
    /// Arrangement of a race's lanes on the stage.
    pub arrangement: Arrangement,
    /// A dark or a light chart.
    pub theme: Theme,
    /// Chosen size of type and panels, in percent of the usual one.
    pub scale_percent: u32,
    /// Whether the help overlay is open.
    pub help: bool,
    /// Whether the inspector is open.
    pub inspector: bool,
    /// Motion besides that of the bodies.
    pub motion: Motion,
}

/// Shares of the window for instruments and table, in percent; `None` for the usual share.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Splits {
    /// Width of the instruments, from 20 to 70.
    pub instruments: Option<u32>,
    /// Height of the table, from 8 to 60.
    pub table: Option<u32>,
}

impl Splits {
    /// Clamps both to their ranges.
    pub fn clamped(self) -> Self {
        Self {
            instruments: self.instruments.map(|percent| percent.clamp(20, 70)),
            table: self.table.map(|percent| percent.clamp(8, 60)),
        }
    }
}

/// The person's view of one scene, discarded with it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct View {
    /// The body of the plots and the lane list, by its index in the scene.
    pub body: usize,
    /// Chosen coordinate of each body in the plots, by its index. A body beyond the end has the [usual
    /// one](crate::run::race::LaneBody::plotted_coordinate).
    pub coordinates: Vec<Option<usize>>,
    /// Indices of the body and its parameter chosen for the stability map.
    pub mapped_parameter: Option<(usize, usize)>,
    /// Ranges to which the person zoomed and panned the plots' axes, by name. An axis without a range is fitted.
    pub plot_ranges: BTreeMap<String, [f64; 2]>,
    /// Zoom and pan of each body, by its index in the scene; a body beyond the end is fitted.
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

/// Real-time pace of a driver, by its own measurement.
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
    /// Copy the link to the run to the clipboard.
    CopyLink,
    /// Copy the instrument's values to the clipboard.
    CopyInstrument,
    /// Copy the method with this menu index to the clipboard, as source code in the viewer's
    /// [language](super::Viewer::language).
    CopyMethod(MenuIndex),
    /// Copy the lines of code that set the displayed body's spring in the engine with this menu index.
    CopyJoint(MenuIndex),
    /// Save the instrument as a picture, a drawing and a table.
    ExportInstrument,
    /// Enter or leave full screen.
    ToggleFullScreen,
    /// Open the scene file at the typed path.
    OpenTypedPath,
    /// Complete the typed path up to its first ambiguity.
    CompletePath,
    /// End the program.
    Quit,
}
