//! Draws recordings: the renderer for one, what it writes at the end, and the errors on the way.

use super::error::Cause;
use super::frame_folder::FrameFolderError;
use super::interrupt::Interrupted;
use super::manifest::Adapter;
use super::output::OutputError;
use super::recording::Recording;
use super::schedule::Schedule;
use crate::view::{AdapterPreference, Gpu, GpuError, OffscreenRenderer, Panels, ReadbackError};

/// The most pixels of a whole capture: hours of drawing and about a hundred gigabytes of files. More is
/// probably a typing mistake.
const MAX_PIXELS: u64 = 1_000_000_000_000;

impl Recording {
    /// A renderer for frames of this size.
    pub(super) fn renderer(&self) -> Result<OffscreenRenderer, DrawingError> {
        let (frames, size_px) = (self.schedule.frames, self.size_px);
        let pixels = u64::from(frames) * u64::from(size_px[0]) * u64::from(size_px[1]);
        if pixels > MAX_PIXELS {
            return Err(DrawingError::TooManyPixels { frames, size_px, pixels, most: MAX_PIXELS });
        }
        let panels = if self.panels { Panels::Shown } else { Panels::Off };
        let gpu = Gpu::headless(AdapterPreference::Any)?;
        log::info!("drawing with {} ({})", gpu.info.name, gpu.info.backend);
        Ok(OffscreenRenderer::new(gpu, size_px, self.scale)?.with_panels(panels))
    }
}

/// Why a run was not drawn or written whole.
#[derive(Debug, thiserror::Error)]
pub(super) enum DrawingError {
    /// The frames have more pixels in all than a capture may have.
    #[error(
        "{frames} frames of {}x{} are {} gigapixels, and a capture has at most {}; \
         give fewer --frames or a smaller --size",
        size_px[0], size_px[1], pixels / GIGA, most / GIGA
    )]
    TooManyPixels {
        /// Asked for.
        frames: u32,
        /// Asked for.
        size_px: [u32; 2],
        /// Of all frames together.
        pixels: u64,
        /// The most there may be.
        most: u64,
    },
    /// The folder cannot be used.
    #[error(transparent)]
    Folder(#[from] FrameFolderError),
    /// A frame could not be written.
    #[error("{source}; whole before that: {whole}; the same command with --force draws all frames")]
    Write {
        /// The error.
        source: FrameFolderError,
        /// The names of the frames written before.
        whole: String,
    },
    /// No graphics device can draw the frames.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// A frame was drawn, but not read back from the device.
    #[error(transparent)]
    Readback(#[from] ReadbackError),
    /// One file, or standard output, could not be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// Ctrl-C was pressed.
    #[error(transparent)]
    Interrupted(Interrupted),
}

const GIGA: u64 = 1_000_000_000;

impl DrawingError {
    /// An interrupt after `done` of `frames` frames; `whole` names those that are written whole.
    pub(super) fn interrupted(done: u32, frames: u32, whole: &str) -> Self {
        let done = format!("{done} of {frames} frames; whole: {whole}");
        Self::Interrupted(Interrupted::After { done })
    }
}

impl Cause for DrawingError {
    fn exit_code(&self) -> u8 {
        match self {
            DrawingError::TooManyPixels { .. } => 2,
            DrawingError::Folder(error) => error.exit_code(),
            DrawingError::Gpu(error) => error.exit_code(),
            DrawingError::Output(error) => error.exit_code(),
            DrawingError::Interrupted(error) => error.exit_code(),
            DrawingError::Write { .. } | DrawingError::Readback(_) => 1,
        }
    }

    fn is_closed_pipe(&self) -> bool {
        matches!(self, DrawingError::Output(error) if error.is_closed_pipe())
    }
}

/// The message at the end of a recording: what was written, and where.
pub(super) fn closing_line(recording: &Recording, place: &str) -> String {
    let Schedule { frames, fps } = recording.schedule;
    let [width, height] = recording.size_px;
    let plural = if frames == 1 { "" } else { "s" };
    format!("wrote {frames} frame{plural}, {width}x{height}, {fps} fps: {place}")
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
