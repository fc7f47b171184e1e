//! Draws a figure of charts into a PNG file, which is opened first.

use crate::commands::error::{Cause, Error};
use crate::commands::output::{AtomicOutput, Place};
use crate::view::{
    AdapterPreference, Figure, Gpu, GpuError, OffscreenRenderer, ReadbackError, png,
};

/// Pixels of a chart, and pixels per point: legible when a few charts fill a screen.
const CHART_PX: [u32; 2] = [920, 660];
const SCALE: f32 = 1.6;

/// Pixels that title, legend and note take.
const MARGIN_PX: u32 = 240;

/// The charts do not fit on the largest picture of the adapter.
#[derive(Debug, thiserror::Error)]
#[error(
    "a picture of {charts} charts is larger than {limit}x{limit}, what this adapter can make; \
     give fewer scenes, or no --plot"
)]
struct TooManyCharts {
    /// One for each scene, and one more.
    charts: usize,
    /// The longest side in pixels.
    limit: u32,
}

impl Cause for TooManyCharts {
    fn exit_code(&self) -> u8 {
        2
    }
}

/// A picture to be made.
pub(super) struct Plot {
    renderer: OffscreenRenderer,
    output: AtomicOutput,
}

impl Plot {
    /// Opens the output and a device that can draw this many charts.
    pub(super) fn open(place: Place<'_>, charts: usize) -> Result<Self, Error> {
        let output = AtomicOutput::open(place)?;
        let columns = columns(charts);
        let [across, down] = [columns, charts.div_ceil(columns)].map(|number| number as u32);
        let size_px = [across * CHART_PX[0], down * CHART_PX[1] + MARGIN_PX];
        let gpu = Gpu::headless(AdapterPreference::Any)?;
        let renderer =
            OffscreenRenderer::new(gpu, size_px, SCALE).map_err(|error| match error {
                GpuError::TooLarge { limit, .. } => Error::from(TooManyCharts { charts, limit }),
                error => error.into(),
            })?;
        Ok(Self { renderer, output })
    }

    /// Draws the figure. Returns the output, the size in pixels, and the PNG file.
    pub(super) fn draw(
        mut self,
        figure: &Figure,
    ) -> Result<(AtomicOutput, [u32; 2], Vec<u8>), ReadbackError> {
        let (size_px, mut rgba) = (self.renderer.size_px(), Vec::new());
        self.renderer.draw_figure(figure, &mut rgba)?;
        Ok((self.output, size_px, png::encode(size_px, &rgba)))
    }
}

/// The number of columns that gives about as many rows.
pub(super) fn columns(charts: usize) -> usize {
    (2..charts).find(|columns| columns * (columns + 1) >= charts).unwrap_or(2)
}
