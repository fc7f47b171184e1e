//! The stage: a picture's sea, then its shapes, at their place on the target.

use std::ops::Range;

use super::backdrop::{Backdrop, Covered};
use super::gpu::Gpu;
use super::screen_transform::{ScreenBindGroup, ScreenTransform};
use super::sea::SeaPipeline;
use super::shapes::ShapeRenderer;
use super::textures::{PassStart, begin_pass};
use crate::stage::{FAR, Picture, Rect};

/// A rectangle that clips nothing.
const EVERYWHERE: Rect = Rect { min: [-FAR; 2], max: [FAR; 2] };

/// The part of the frame that panels leave free, and its picture.
#[derive(Clone, Debug)]
pub(super) struct Stage {
    /// Place, in points of the frame.
    pub(super) rect: egui::Rect,
    /// Contents, in points of the stage.
    pub(super) picture: Picture,
}

/// Draws everything of a picture but its text.
#[derive(Debug)]
pub(super) struct StageRenderer {
    screen: ScreenBindGroup,
    backdrop: Backdrop,
    sea: SeaPipeline,
    shapes: ShapeRenderer,
    covered: Covered,
    /// Draws of the shapes that the backdrop covers, and of the shapes over it.
    draws: [Range<usize>; 2],
    /// Left, top, width and height on the target.
    scissor_px: [u32; 4],
}

impl StageRenderer {
    pub(super) fn new(gpu: &Gpu, format: wgpu::TextureFormat) -> Self {
        let screen = ScreenBindGroup::new(gpu);
        let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("stage"),
            bind_group_layouts: &[Some(&screen.layout)],
            immediate_size: 0,
        });
        Self {
            screen,
            backdrop: Backdrop::new(format),
            sea: SeaPipeline::new(gpu, &layout, format),
            shapes: ShapeRenderer::new(gpu, &layout, format),
            covered: Covered::Nothing,
            draws: [0..0, 0..0],
            scissor_px: [0; 4],
        }
    }

    /// Uploads the picture for [`Self::paint`], and copies the backdrop to the target if there is one. Returns the
    /// initial contents of the pass.
    pub(super) fn prepare(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::Texture,
        Stage { rect, picture }: Stage,
        scale: f32,
    ) -> PassStart {
        let size_px = [target.width(), target.height()];
        // On whole pixels, so that shapes on whole points stay sharp.
        let low_px = (rect.min.to_vec2() * scale).round();
        let high_px = (rect.max.to_vec2() * scale).round();
        let [left, right] = [low_px.x, high_px.x].map(|x| x.clamp(0.0, size_px[0] as f32));
        let [top, bottom] = [low_px.y, high_px.y].map(|y| y.clamp(0.0, size_px[1] as f32));
        let transform = ScreenTransform {
            size_px,
            origin_px: low_px.into(),
            px_per_point: scale,
            edges_px: [left, top, right.max(left), bottom.max(top)],
        };
        self.screen.write(gpu, &transform);
        self.scissor_px = transform.scissor_px(EVERYWHERE);
        self.covered = self.backdrop.choose_cover(gpu, target, &transform, &picture);
        let (below, above) = picture.shapes.split_at(self.covered.shapes());
        self.shapes.clear();
        self.draws = match self.covered {
            Covered::Drawn(_) => [0..0, self.shapes.add(above, &transform)],
            Covered::Nothing | Covered::Drawing(_) => {
                self.sea.upload(gpu, picture.sea.as_ref(), &transform);
                [self.shapes.add(below, &transform), self.shapes.add(above, &transform)]
            }
        };
        self.shapes.upload(gpu);
        if let (Covered::Drawing(_), Some(view)) = (self.covered, self.backdrop.view()) {
            // Submitted at once: later frames need the backdrop, even if the caller never submits this frame.
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            let mut pass = begin_pass(&mut encoder, "backdrop", &view, PassStart::Black);
            if self.begin(&mut pass) {
                self.paint_below(&mut pass);
            }
            drop(pass);
            gpu.queue.submit([encoder.finish()]);
        }
        self.backdrop.keep_picture(transform, picture);
        if self.covered == Covered::Nothing {
            return PassStart::Black;
        }
        self.backdrop.copy(encoder, target);
        PassStart::Keep
    }

    /// Draws the prepared picture, and nothing outside the stage.
    pub(super) fn paint(&self, pass: &mut wgpu::RenderPass<'_>) {
        if !self.begin(pass) {
            return;
        }
        if self.covered == Covered::Nothing {
            self.paint_below(pass);
        }
        self.shapes.paint(pass, self.draws[1].clone());
    }

    /// Confines all further drawing to the stage. Returns false if there is no room for one.
    fn begin(&self, pass: &mut wgpu::RenderPass<'_>) -> bool {
        let [left, top, width, height] = self.scissor_px;
        if width == 0 || height == 0 {
            return false;
        }
        pass.set_scissor_rect(left, top, width, height);
        pass.set_bind_group(0, &self.screen.group, &[]);
        true
    }

    fn paint_below(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.sea.paint(pass);
        self.shapes.paint(pass, self.draws[0].clone());
    }
}
