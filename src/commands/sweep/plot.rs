//! The file that a sweep's picture goes to, and what draws it.

use std::path::Path;

use super::SweepError;
use crate::commands::capture::CaptureError;
use crate::commands::outlet::Outlet;
use crate::view::{AdapterPreference, Artist, Figure, Gpu, png};

/// Pixels of a chart, and pixels to a point: legible where a few of them fill a screen.
const CHART_PX: [u32; 2] = [920, 660];
const SCALE: f32 = 1.6;

/// Pixels that title, legend and note take.
const MARGIN_PX: u32 = 240;

/// A picture to be made.
pub(super) struct Plot {
    gpu: Gpu,
    outlet: Outlet,
}

impl Plot {
    /// Makes sure that there will be a place for it, and something to draw it with.
    pub(super) fn open(path: &Path, replace: bool) -> Result<Self, SweepError> {
        let outlet = Outlet::open(path, replace).map_err(|error| match error {
            CaptureError::Taken { path } => SweepError::PlotTaken { path },
            error => error.into(),
        })?;
        Ok(Self { gpu: Gpu::headless(AdapterPreference::Any)?, outlet })
    }

    /// Draws it: where it goes, its size in pixels, and its bytes.
    pub(super) fn draw(self, figure: &Figure) -> Result<(Outlet, [u32; 2], Vec<u8>), SweepError> {
        let columns = figure.columns as u32;
        let rows = (figure.charts.len() as u32).div_ceil(columns);
        let size_px = [columns * CHART_PX[0], rows * CHART_PX[1] + MARGIN_PX];
        let mut artist = Artist::new(self.gpu, size_px, SCALE)?;
        let mut rgba = Vec::new();
        artist.draw_figure(figure, &mut rgba)?;
        Ok((self.outlet, size_px, png::encode(size_px, &rgba)))
    }
}
