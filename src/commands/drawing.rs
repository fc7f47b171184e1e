//! Draws recordings: the renderer for one, and what is told at the end or of an interrupt.

use super::capture_settings::CaptureSettings;
use super::error::Error;
use super::manifest::Adapter;
use super::schedule::Schedule;
use crate::sim::number::counted;
use crate::view::{AdapterPreference, Gpu, OffscreenRenderer, Panels};

/// The most pixels of a whole capture: hours of drawing and about a hundred gigabytes of files. More is
/// probably a typing mistake.
const MAX_PIXELS: u64 = 1_000_000_000_000;

impl CaptureSettings {
    /// A renderer for frames of this size.
    pub(super) fn renderer(&self) -> Result<OffscreenRenderer, Error> {
        let size_px = self.size_px;
        check_pixels(self.schedule.frames, size_px, MAX_PIXELS)?;
        let panels = if self.panels { Panels::Shown } else { Panels::Off };
        Ok(OffscreenRenderer::new(gpu()?, size_px, self.scale)?.with_panels(panels))
    }
}

/// The best graphics device that needs no display.
pub(super) fn gpu() -> Result<Gpu, Error> {
    let gpu = pollster::block_on(Gpu::headless(AdapterPreference::Any))?;
    log::info!("drawing with {} ({})", gpu.info.name, gpu.info.backend);
    Ok(gpu)
}

const GIGA: u64 = 1_000_000_000;

/// Fails if so many frames of this size have more pixels in all than `most`.
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

/// An interrupt after `done` of `frames` frames; `whole` names those that are written whole.
pub(super) fn interrupted_after(done: u32, frames: u32, whole: &str) -> Error {
    Error::interrupted_after(format!("{done} of {frames} frames; whole: {whole}"))
}

/// The message at the end of a capture: what was written, and where.
pub(super) fn closing_line(capture: &CaptureSettings, place: &str) -> String {
    let Schedule { frames, fps } = capture.schedule;
    let [width, height] = capture.size_px;
    format!("wrote {}, {width}x{height}, {fps} fps: {place}", counted(frames, "frame"))
}

/// The adapter as the manifest describes it.
pub(super) fn adapter(renderer: &OffscreenRenderer) -> Adapter {
    let info = renderer.adapter();
    Adapter {
        name: info.name.clone(),
        driver: info.driver.clone(),
        driver_info: info.driver_info.clone(),
        backend: info.backend.to_str().to_owned(),
        kind: format!("{:?}", info.device_type),
    }
}
