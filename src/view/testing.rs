//! What the tests of this layer share: a device, and the pixels drawn with it.

use std::io::{self, Write};

use super::stage::Stage;
use super::{AdapterPreference, Gpu, Offscreen, Readback};
use crate::lab::picture::{Picture, Rect};
use crate::view::stage::StageRenderer;
use crate::view::textures::pass;

/// A software device, or a line on stderr that says which test did not run and why.
pub(super) fn gpu_or_skip(test: &str) -> Option<Gpu> {
    pollster::block_on(Gpu::headless(AdapterPreference::CpuOnly))
        // Not `eprintln!`, which the test runner hides when a test passes.
        .inspect_err(|error| drop(writeln!(io::stderr(), "SKIPPED {test}: {error}")))
        .ok()
}

/// Tightly packed RGBA rows.
pub(super) struct Pixels {
    pub(super) size_px: [u32; 2],
    pub(super) rows: Vec<u8>,
}

impl Pixels {
    pub(super) fn at(&self, x: u32, y: u32) -> [u8; 4] {
        let first = 4 * (y * self.size_px[0] + x) as usize;
        self.rows[first..first + 4].try_into().expect("four bytes are four bytes")
    }

    /// How many pixels are not black.
    pub(super) fn lit(&self) -> usize {
        self.rows.chunks_exact(4).filter(|pixel| pixel[..3] != [0, 0, 0]).count()
    }

    /// The sum of a channel over all pixels, 1 for a full one.
    pub(super) fn sum(&self, channel: usize) -> f32 {
        self.rows.iter().skip(channel).step_by(4).map(|&value| f32::from(value) / 255.0).sum()
    }
}

/// A picture alone on black, the stage filling the target, `scale` pixels a point.
pub(super) fn draw_picture(gpu: &Gpu, size_px: [u32; 2], scale: f32, picture: &Picture) -> Pixels {
    draw_next(gpu, &mut StageRenderer::new(gpu, Offscreen::FORMAT), size_px, scale, picture)
}

/// The same with a renderer that has drawn other pictures before.
pub(super) fn draw_next(
    gpu: &Gpu,
    renderer: &mut StageRenderer,
    size_px: [u32; 2],
    scale: f32,
    picture: &Picture,
) -> Pixels {
    let target = Offscreen::new(gpu, size_px).expect("tests ask for small targets");
    let rect = egui::Rect::from_min_size(
        egui::Pos2::ZERO,
        egui::vec2(size_px[0] as f32, size_px[1] as f32) / scale,
    );
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let stage = Stage { rect, picture: picture.clone() };
    let start = renderer.prepare(gpu, &mut encoder, &target.texture, stage, scale);
    renderer.paint(&mut pass(&mut encoder, "picture", &target.view, start));
    read(gpu, Some(encoder.finish()), &target)
}

/// What `drawing` makes of the target.
pub(super) fn read(gpu: &Gpu, drawing: Option<wgpu::CommandBuffer>, target: &Offscreen) -> Pixels {
    let mut rows = Vec::new();
    let read = Readback::default().read(gpu, drawing, &target.texture, &mut rows);
    read.expect("a fresh target can be read");
    Pixels { size_px: target.size_px, rows }
}

/// A clip rectangle that clips nothing.
pub(super) const EVERYWHERE: Rect = Rect { min: [-1e4; 2], max: [1e4; 2] };
