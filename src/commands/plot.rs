//! Draws a figure of charts into a PNG file, which is opened first.

use std::io::Write;

use crate::commands::drawing::gpu;
use crate::commands::error::Error;
use crate::commands::output::{Destination, Output};
use crate::view::{Figure, GpuError, OffscreenRenderer, png};

/// Pixels of a chart, and pixels per point: legible when a few charts fill a screen.
const CHART_PX: [u32; 2] = [920, 660];
const SCALE: f32 = 1.6;

/// Pixels that title, legend and note take.
const MARGIN_PX: u32 = 240;

/// A picture to be made.
pub(super) struct Plot {
    renderer: OffscreenRenderer,
    output: Output,
}

impl Plot {
    /// Opens the output and a device that can draw this many charts.
    pub(super) fn open(to: Destination<'_>, charts: usize) -> Result<Self, Error> {
        let output = to.open()?;
        let columns = columns(charts);
        let [across, down] = [columns, charts.div_ceil(columns)].map(|number| number as u32);
        let size_px = [across * CHART_PX[0], down * CHART_PX[1] + MARGIN_PX];
        let renderer =
            OffscreenRenderer::new(gpu()?, size_px, SCALE).map_err(|error| match error {
                GpuError::TooLarge { limit, .. } => Error::mistake(format!(
                    "a picture of {charts} charts is larger than {limit}x{limit}, what this adapter can make; \
                     give fewer scenes, or no --plot"
                )),
                error => error.into(),
            })?;
        Ok(Self { renderer, output })
    }

    /// Draws the figure into its output.
    pub(super) fn draw(mut self, figure: &Figure) -> Result<(), Error> {
        let (size_px, mut rgba) = (self.renderer.size_px(), Vec::new());
        self.renderer.draw_figure(figure, &mut rgba)?;
        self.output.write_all(&png::encode(size_px, &rgba))?;
        self.output.finish(&format!("a picture of {}x{}", size_px[0], size_px[1]))
    }
}

/// The number of columns that gives about as many rows.
pub(super) fn columns(charts: usize) -> usize {
    (2..charts).find(|columns| columns * (columns + 1) >= charts).unwrap_or(charts.min(2))
}
