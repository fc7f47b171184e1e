//! The canvas of the page, and the renderer that draws on it.

use regatta::studio::{Command, Studio};
use regatta::view::{
    FrameOutput, FrameRenderer, Gpu, GpuExecutor, RendererChoice, Screen, egui, wgpu,
};
use web_sys::HtmlCanvasElement;

pub(crate) struct Canvas {
    pub(crate) element: HtmlCanvasElement,
    pub(crate) renderer: FrameRenderer,
    executor: GpuExecutor,
    screen: Screen,
    gpu: Gpu,
    size_px: [u32; 2],
}

impl Canvas {
    /// # Errors
    /// The reason why nothing can be drawn on the canvas.
    pub(crate) async fn new(element: HtmlCanvasElement) -> Result<Self, String> {
        let refused = |reason: &dyn std::error::Error| {
            log::error!("{reason}");
            "This browser draws no WebGL 2, which Regatta needs. Another browser may, or this one with hardware acceleration."
                .to_owned()
        };
        let screen = Screen::of_canvas(target(element.clone())).map_err(|e| refused(&e))?;
        let gpu = screen.gpu(RendererChoice::Gpu).await.map_err(|e| refused(&e))?;
        let renderer = FrameRenderer::new(gpu.max_texture_side_px);
        let executor = GpuExecutor::new(&gpu);
        Ok(Self { element, renderer, executor, screen, gpu, size_px: [0, 0] })
    }

    /// Draws a frame and shows it, with `scale` pixels per point of the page. Returns the commands from the panels, or
    /// `None` if the canvas cannot be drawn on at present.
    pub(crate) fn draw(
        &mut self,
        scale: f64,
        input: egui::RawInput,
        studio: &Studio,
    ) -> Option<(Vec<Command>, FrameOutput)> {
        let sides = [self.element.client_width(), self.element.client_height()];
        let size_px = sides.map(|side| (f64::from(side) * scale).round() as u32);
        if size_px.contains(&0) {
            return None;
        }
        if size_px != self.size_px {
            self.size_px = size_px;
            self.element.set_width(size_px[0]);
            self.element.set_height(size_px[1]);
            self.screen.configure(&self.gpu, size_px);
        }
        let texture = match self.screen.surface().get_current_texture() {
            wgpu::CurrentSurfaceTexture::Success(texture)
            | wgpu::CurrentSurfaceTexture::Suboptimal(texture) => texture,
            _ => {
                self.screen.configure(&self.gpu, size_px);
                return None;
            }
        };
        let size_px = [texture.texture.width(), texture.texture.height()];
        let view = texture.texture.create_view(&wgpu::TextureViewDescriptor::default());
        let (commands, output) = self.renderer.draw(size_px, scale as f32, input, studio);
        self.gpu.queue.submit(self.executor.encode(&self.gpu, &output.drawing, &view));
        self.gpu.queue.present(texture);
        Some((commands, output))
    }
}

/// Returns the surface on which frames are drawn.
#[cfg(target_arch = "wasm32")]
fn target(element: HtmlCanvasElement) -> wgpu::SurfaceTarget<'static> {
    wgpu::SurfaceTarget::Canvas(element)
}

/// Outside a browser there is no canvas, but lints read this crate and tests run it.
#[cfg(not(target_arch = "wasm32"))]
fn target(_: HtmlCanvasElement) -> wgpu::SurfaceTarget<'static> {
    unreachable!("only a browser has a canvas")
}
