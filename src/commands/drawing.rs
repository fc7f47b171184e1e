//! Renderers for captures and charts, and the messages that end a capture or report its interruption.

use std::io::Write;

use super::error::Error;
use super::manifest::Adapter;
use super::output::{Destination, Output};
use super::schedule::Schedule;
use super::settings::CaptureSettings;
use crate::sim::number::counted;
use crate::view::{
    Figure, FrameSizeError, Gpu, OffscreenRenderer, Panels, RendererChoice, letter_instructions,
    png,
};

/// Maximum number of pixels of a whole capture, which is hours of drawing and about a hundred gigabytes of files. A
/// larger request is probably a typing mistake.
const MAX_PIXELS: u64 = 1_000_000_000_000;

impl CaptureSettings {
    /// Returns a renderer for the frames, or an error if the capture has too many pixels.
    pub(super) fn renderer(&self) -> Result<OffscreenRenderer, Error> {
        let size_px = self.size_px;
        check_pixels(self.schedule.frames, size_px, MAX_PIXELS)?;
        let panels = if self.panels { Panels::Shown } else { Panels::Off };
        let renderer = match self.gpu()? {
            Some(gpu) => OffscreenRenderer::on_gpu(gpu, size_px, self.scale)?,
            None => OffscreenRenderer::new(size_px, self.scale)?,
        };
        Ok(renderer.with_panels(panels))
    }

    /// The graphics device that draws, if any.
    fn gpu(&self) -> Result<Option<Gpu>, Error> {
        let found = || pollster::block_on(Gpu::headless(self.renderer));
        Ok(match self.renderer {
            RendererChoice::Cpu => None,
            RendererChoice::Gpu => Some(found()?),
            RendererChoice::Auto => found().ok(),
        })
    }
}

const GIGA: u64 = 1_000_000_000;

/// Fails if all frames together have more than `most` pixels.
pub(super) fn check_pixels(frames: u32, [width, height]: [u32; 2], most: u64) -> Result<(), Error> {
    let pixels = u64::from(frames) * u64::from(width) * u64::from(height);
    if pixels <= most {
        return Ok(());
    }
    Err(Error::mistake(format!(
        "{frames} frames of {width}x{height} are {} gigapixels, and a capture has at most {}; \
         give fewer --frames or a smaller --size",
        pixels / GIGA,
        most / GIGA
    )))
}

/// Returns the error for an interrupt after `done` of `frames` frames. `whole` names the complete frames.
pub(super) fn interrupted_after(done: u32, frames: u32, whole: &str) -> Error {
    Error::interrupted_after(format!("{done} of {frames} frames; whole: {whole}"))
}

/// Returns the last message of a capture: the number of frames, their size and their place.
pub(super) fn closing_line(capture: &CaptureSettings, place: &str) -> String {
    let Schedule { frames, fps } = capture.schedule;
    let [width, height] = capture.size_px;
    format!("wrote {}, {width}x{height}, {fps} fps: {place}", counted(frames, "frame"))
}

/// The adapter as the manifest describes it. Frames of equal adapters are equal.
pub(super) fn adapter(renderer: &OffscreenRenderer) -> Adapter {
    let Some(info) = renderer.adapter() else {
        return Adapter {
            name: "regatta".to_owned(),
            driver: String::new(),
            driver_info: format!("letters by {}", letter_instructions()),
            backend: "cpu".to_owned(),
            kind: "Cpu".to_owned(),
        };
    };
    Adapter {
        name: info.name.clone(),
        driver: info.driver.clone(),
        driver_info: info.driver_info.clone(),
        backend: info.backend.to_str().to_owned(),
        kind: format!("{:?}", info.device_type),
    }
}

/// Size of a chart in pixels, and pixels per point. The text is legible when a few charts fill a screen.
const CHART_PX: [u32; 2] = [920, 660];
const SCALE: f32 = 1.6;

/// Height of the title, the legend and the note together, in pixels.
const MARGIN_PX: u32 = 240;

/// Draws one figure of charts into a PNG file, which is opened before the figure is computed.
pub(super) struct Plot {
    renderer: OffscreenRenderer,
    output: Output,
}

impl Plot {
    /// Opens the output for a figure of `charts` charts.
    pub(super) fn open(to: Destination<'_>, charts: usize) -> Result<Self, Error> {
        let output = to.open()?;
        let columns = columns(charts);
        let [across, down] = [columns, charts.div_ceil(columns)].map(|number| number as u32);
        let size_px = [across * CHART_PX[0], down * CHART_PX[1] + MARGIN_PX];
        let renderer = OffscreenRenderer::new(size_px, SCALE).map_err(|error| match error {
            FrameSizeError::TooLarge { limit, .. } => Error::mistake(format!(
                "a picture of {charts} charts is larger than {limit}x{limit}; \
                     give fewer scenes, or no --plot"
            )),
            error => error.into(),
        })?;
        Ok(Self { renderer, output })
    }

    pub(super) fn draw(mut self, figure: &Figure) -> Result<(), Error> {
        let (size_px, mut rgba) = (self.renderer.size_px(), self.renderer.buffer()?);
        self.renderer.draw_figure(figure, &mut rgba)?;
        self.output.write_all(&png::encode(size_px, &rgba))?;
        self.output.finish(&format!("a picture of {}x{}", size_px[0], size_px[1]))
    }
}

/// Returns the number of columns of a grid that has about as many rows as columns.
pub(super) fn columns(charts: usize) -> usize {
    (2..charts).find(|columns| columns * (columns + 1) >= charts).unwrap_or(charts.min(2))
}
