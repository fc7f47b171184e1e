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
pub(super) struct Readback {
    spare: Option<wgpu::Buffer>,
}

impl Readback {
    /// Submits `commands`, waits for all work so far, and replaces `rows` by the pixels of the texture, which is one of
    /// [`Offscreen`](super::offscreen_renderer::Offscreen): top row first, no padding.
    ///
    /// # Errors
    /// A [`ReadbackError`]; `rows` is then unspecified.
    pub(super) fn read(
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::testing::gpu_or_skip;

    /// A texture holding `rows`, uploaded rather than drawn.
    fn uploaded(gpu: &Gpu, [width, height]: [u32; 2], rows: &[u8]) -> wgpu::Texture {
        let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: Gpu::OFFSCREEN_FORMAT,
            usage: wgpu::TextureUsages::COPY_DST | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(4 * width),
            rows_per_image: None,
        };
        gpu.queue.write_texture(texture.as_image_copy(), rows, layout, size);
        texture
    }

    #[test]
    fn pixels_come_back_exactly_at_odd_widths() {
        let Some(gpu) = gpu_or_skip("pixels_come_back_exactly_at_odd_widths") else { return };
        let mut readback = Readback::default();
        let mut rows = Vec::new();
        for [width, height] in [[1, 1], [63, 5], [64, 5], [65, 5], [257, 3]] {
            let sent: Vec<u8> = (0..4 * width * height).map(|i| (i * 7 % 251) as u8).collect();
            let texture = uploaded(&gpu, [width, height], &sent);
            readback.read(&gpu, None, &texture, &mut rows).unwrap();
            assert_eq!(rows, sent, "{width}x{height}");
        }
    }

    #[test]
    fn reading_from_a_lost_device_is_an_error() {
        let Some(gpu) = gpu_or_skip("reading_from_a_lost_device_is_an_error") else { return };
        let texture = uploaded(&gpu, [1, 1], &[0; 4]);
        gpu.device.destroy();
        let error = Readback::default().read(&gpu, None, &texture, &mut Vec::new()).unwrap_err();
        assert!(matches!(error, ReadbackError::DeviceLost), "{error}");
    }
}
