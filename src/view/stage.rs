//! The stage: a picture's sea, then its shapes, in their place on the target.

use super::gpu::Gpu;
use super::place::{Place, PlaceGroup};
use super::sea::SeaPipeline;
use super::shapes::ShapeRenderer;
use crate::lab::picture::{FAR, Picture, Rect};

/// What clips nothing.
const EVERYWHERE: Rect = Rect { min: [-FAR; 2], max: [FAR; 2] };

/// The part of the frame that panels leave free, and what to show there.
#[derive(Clone, Debug)]
pub(super) struct Stage {
    /// Where, in points of the frame.
    pub(super) rect: egui::Rect,
    /// What, in points of the stage.
    pub(super) picture: Picture,
}

/// Draws the part of a picture that is not text.
#[derive(Debug)]
pub(super) struct StageRenderer {
    place: PlaceGroup,
    sea: SeaPipeline,
    shapes: ShapeRenderer,
    /// Left, top, width and height on the target.
    scissor_px: [u32; 4],
}

impl StageRenderer {
    pub(super) fn new(gpu: &Gpu, format: wgpu::TextureFormat) -> Self {
        let place = PlaceGroup::new(gpu);
        let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("stage"),
            bind_group_layouts: &[Some(&place.layout)],
            immediate_size: 0,
        });
        Self {
            place,
            sea: SeaPipeline::new(gpu, &layout, format),
            shapes: ShapeRenderer::new(gpu, &layout, format),
            scissor_px: [0; 4],
        }
    }

    /// Uploads what [`Self::paint`] will draw on a target of `size_px`.
    pub(super) fn prepare(&mut self, gpu: &Gpu, stage: &Stage, size_px: [u32; 2], scale: f32) {
        // On whole pixels: what the picture puts on whole points stays sharp.
        let low_px = (stage.rect.min.to_vec2() * scale).round();
        let high_px = (stage.rect.max.to_vec2() * scale).round();
        let [left, right] = [low_px.x, high_px.x].map(|x| x.clamp(0.0, size_px[0] as f32));
        let [top, bottom] = [low_px.y, high_px.y].map(|y| y.clamp(0.0, size_px[1] as f32));
        let place = Place {
            size_px,
            origin_px: low_px.into(),
            px_per_point: scale,
            edges_px: [left, top, right.max(left), bottom.max(top)],
        };
        self.place.write(gpu, &place);
        self.scissor_px = place.scissor_px(EVERYWHERE);
        self.sea.upload(gpu, stage.picture.sea.as_ref(), &place);
        self.shapes.upload(gpu, &stage.picture.shapes, &place);
    }

    /// Draws what was prepared, and nothing outside the stage.
    pub(super) fn paint(&self, pass: &mut wgpu::RenderPass<'_>) {
        let [left, top, width, height] = self.scissor_px;
        if width == 0 || height == 0 {
            return;
        }
        pass.set_scissor_rect(left, top, width, height);
        pass.set_bind_group(0, &self.place.group, &[]);
        self.sea.paint(pass);
        self.shapes.paint(pass);
    }
}
