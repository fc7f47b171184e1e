//! Reads a texture back as tightly packed RGBA rows.

use std::sync::mpsc;
use std::time::Duration;

use super::gpu::Gpu;

/// Time after which a device counts as hung. A software adapter needs seconds for the largest frames. A hung driver
/// would otherwise block the program for ever.
const PATIENCE: Duration = Duration::from_secs(60);

/// Why the pixels did not come back.
#[derive(Debug, thiserror::Error)]
pub enum ReadbackError {
    /// The device was lost.
    #[error("the graphics device was lost while a frame was read back; start again")]
    DeviceLost,
    /// The device did not finish the frame.
    #[error("the graphics device did not finish a frame in {} s; give a smaller size", PATIENCE.as_secs())]
    Timeout,
    /// The buffer could not be read.
    #[error("a frame could not be read back: {reason}; give a smaller size")]
    Unreadable {
        /// Error message of the device.
        reason: String,
    },
}

/// Reads textures back, and reuses its buffer from frame to frame.
#[derive(Debug, Default)]
pub struct Readback {
    spare: Option<wgpu::Buffer>,
}

impl Readback {
    /// Submits `commands`, waits for all work so far, and replaces `rows` by the pixels of the texture: top row first,
    /// no padding. The texture has the format [`Gpu::OFFSCREEN_FORMAT`], and may be copied from.
    ///
    /// # Errors
    /// A [`ReadbackError`]; `rows` is then unspecified.
    pub fn read(
        &mut self,
        gpu: &Gpu,
        commands: Option<wgpu::CommandBuffer>,
        texture: &wgpu::Texture,
        rows: &mut Vec<u8>,
    ) -> Result<(), ReadbackError> {
        if gpu.is_lost() {
            return Err(ReadbackError::DeviceLost);
        }
        let row_bytes = 4 * texture.width();
        let padded_row_bytes = row_bytes.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let bytes = u64::from(padded_row_bytes) * u64::from(texture.height());
        let spare = self.spare.take().filter(|buffer| buffer.size() == bytes);
        let buffer = spare.unwrap_or_else(|| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("readback"),
                size: bytes,
                usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
                mapped_at_creation: false,
            })
        });
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        encoder.copy_texture_to_buffer(
            texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(padded_row_bytes),
                    rows_per_image: None,
                },
            },
            texture.size(),
        );
        let submission = gpu.queue.submit(commands.into_iter().chain([encoder.finish()]));
        wait_until_mapped(gpu, &buffer, submission)?;
        rows.clear();
        {
            let mapped = buffer
                .get_mapped_range(..)
                .map_err(|error| ReadbackError::Unreadable { reason: error.to_string() })?;
            rows.reserve_exact(mapped.len() / padded_row_bytes as usize * row_bytes as usize);
            for row in mapped.chunks_exact(padded_row_bytes as usize) {
                rows.extend_from_slice(&row[..row_bytes as usize]);
            }
        }
        buffer.unmap();
        self.spare = Some(buffer);
        Ok(())
    }
}

fn wait_until_mapped(
    gpu: &Gpu,
    buffer: &wgpu::Buffer,
    submission: wgpu::SubmissionIndex,
) -> Result<(), ReadbackError> {
    let (sender, mapped) = mpsc::channel();
    buffer.map_async(wgpu::MapMode::Read, .., move |result| {
        // The receiver is gone only after its owner gave up waiting.
        sender.send(result).ok();
    });
    let wait = wgpu::PollType::Wait { submission_index: Some(submission), timeout: Some(PATIENCE) };
    let polled = gpu.device.poll(wait);
    match mapped.try_recv() {
        Ok(Ok(())) => Ok(()),
        _ if gpu.is_lost() => Err(ReadbackError::DeviceLost),
        Ok(Err(error)) => Err(ReadbackError::Unreadable { reason: error.to_string() }),
        Err(_) => match polled {
            Err(wgpu::PollError::Timeout) | Ok(_) => Err(ReadbackError::Timeout),
            Err(error) => Err(ReadbackError::Unreadable { reason: error.to_string() }),
        },
    }
}
