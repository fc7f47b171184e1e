//! A window's surface and the renderer that draws on it. Both are created again when the driver loses them.

use std::mem;
use std::sync::Arc;
use std::time::Duration;

use pollster::block_on;
use winit::event_loop::{ActiveEventLoop, EventLoopProxy};
use winit::window::Window;

use super::clipboard::Clipboard;
use super::{Event, WindowError};
use crate::studio::{Command, Studio};
use crate::view::{FrameRenderer, Gpu, GpuExecutor, Screen};

pub(super) struct Canvas {
    pub(super) window: Arc<Window>,
    pub(super) egui: egui_winit::State,
    pub(super) gpu: Gpu,
    pub(super) renderer: FrameRenderer,
    executor: GpuExecutor,
    /// The display's refresh rate in millihertz, if it is known.
    pub(super) refresh_mhz: Option<u32>,
    /// `None` only if the surface could not be created again.
    screen: Option<Screen>,
    surface_is_lost: bool,
    size_px: [u32; 2],
}

/// The outcome of drawing a frame.
pub(super) enum FrameOutcome {
    /// The frame is on the screen.
    Shown {
        /// Commands from the panels.
        commands: Vec<Command>,
        /// Time until the panels must be drawn again even without an event.
        repaint_after: Duration,
    },
    /// No surface is available at the moment.
    Skipped,
}

impl Canvas {
    pub(super) fn new(
        event_loop: &ActiveEventLoop,
        window: Arc<Window>,
        proxy: EventLoopProxy<Event>,
    ) -> Result<Self, WindowError> {
        let display = Box::new(event_loop.owned_display_handle());
        let screen = block_on(Screen::new(display, Arc::clone(&window)))?;
        let gpu = block_on(screen.gpu())?;
        log::info!("drawing with {} ({})", gpu.info.name, gpu.info.backend);
        let renderer = FrameRenderer::new(gpu.max_texture_side_px);
        let executor = GpuExecutor::new(&gpu, screen.format(&gpu));
        let egui = translator(&renderer, &window, &gpu);
        let mut canvas = Self {
            window,
            egui,
            gpu,
            renderer,
            executor,
            refresh_mhz: None,
            screen: Some(screen),
            surface_is_lost: false,
            size_px: [0, 0],
        };
        // Screen readers find the window only if this comes before it is visible.
        #[cfg(feature = "accessibility")]
        canvas.egui.init_accesskit(event_loop, &canvas.window, proxy);
        #[cfg(not(feature = "accessibility"))]
        drop(proxy);
        canvas.resize();
        Ok(canvas)
    }

    /// Adopts the window's size and the refresh rate of its display.
    pub(super) fn resize(&mut self) {
        let display = self.window.current_monitor();
        self.refresh_mhz =
            display.and_then(|display| display.refresh_rate_millihertz()).filter(|&mhz| mhz > 0);
        let size = self.window.inner_size();
        let size_px = [size.width, size.height];
        if size_px != self.size_px && !size_px.contains(&0) {
            self.size_px = size_px;
            self.configure();
        }
    }

    fn configure(&self) {
        if let Some(screen) = &self.screen {
            screen.configure(&self.gpu, self.size_px);
        }
    }

    /// Draws a frame and shows it. Puts text that was copied from a text field on the clipboard.
    pub(super) fn draw(
        &mut self,
        studio: &Studio,
        clipboard: &mut Clipboard,
    ) -> Result<FrameOutcome, WindowError> {
        if self.surface_is_lost || self.gpu.is_lost() {
            self.renew_surface()?;
        }
        let Some((texture, reconfigure)) = self.acquire_texture() else {
            return Ok(FrameOutcome::Skipped);
        };
        let size_px = [texture.texture.width(), texture.texture.height()];
        let view = texture.texture.create_view(&wgpu::TextureViewDescriptor::default());
        let input = self.egui.take_egui_input(&self.window);
        let scale = self.window.scale_factor() as f32;
        let (commands, output) = self.renderer.draw(size_px, scale, input, studio);
        self.gpu.queue.submit(self.executor.encode(&self.gpu, &output.drawing, &view));
        clipboard.set_copied(&output.platform.commands);
        self.egui.handle_platform_output(&self.window, output.platform);
        self.window.pre_present_notify();
        self.gpu.queue.present(texture);
        if reconfigure {
            self.configure();
        }
        Ok(FrameOutcome::Shown { commands, repaint_after: output.repaint_delay })
    }

    /// Removes and returns the events that the panels have not handled yet.
    pub(super) fn take_events(&mut self) -> Vec<egui::Event> {
        mem::take(&mut self.egui.egui_input_mut().events)
    }

    /// Gives these events to the panels before any others.
    pub(super) fn put_back(&mut self, events: Vec<egui::Event>) {
        self.egui.egui_input_mut().events.splice(0..0, events);
    }

    /// The texture to draw on, and whether the surface must be configured again afterwards.
    fn acquire_texture(&mut self) -> Option<(wgpu::SurfaceTexture, bool)> {
        use wgpu::CurrentSurfaceTexture::*;
        for _ in 0..2 {
            match self.screen.as_ref()?.surface().get_current_texture() {
                Success(texture) => return Some((texture, false)),
                Suboptimal(texture) => return Some((texture, true)),
                Timeout | Occluded => return None,
                Outdated | Validation => self.configure(),
                Lost => {
                    log::info!("the surface was lost");
                    // The next frame creates it again. If the window is gone too, an event reports that first.
                    self.surface_is_lost = true;
                    return None;
                }
            }
        }
        None
    }

    /// Creates a new surface, and a new device if the old one is lost or cannot present on it.
    fn renew_surface(&mut self) -> Result<(), WindowError> {
        if let Some(screen) = self.screen.take() {
            let screen = screen.renewed(Arc::clone(&self.window))?;
            if self.gpu.is_lost() || !self.gpu.adapter.is_surface_supported(screen.surface()) {
                self.gpu = block_on(screen.gpu())?;
                // This needs a new context: the old one assumes that its fonts are on the device.
                self.renderer = FrameRenderer::new(self.gpu.max_texture_side_px);
                self.executor = GpuExecutor::new(&self.gpu, screen.format(&self.gpu));
                let egui = translator(&self.renderer, &self.window, &self.gpu);
                let lost = mem::replace(&mut self.egui, egui);
                #[cfg(feature = "accessibility")]
                {
                    self.egui.accesskit = lost.accesskit;
                }
                #[cfg(not(feature = "accessibility"))]
                drop(lost);
            }
            self.screen = Some(screen);
        }
        self.surface_is_lost = false;
        self.configure();
        Ok(())
    }
}

/// Translates the window's events to those of the renderer's panels.
fn translator(renderer: &FrameRenderer, window: &Window, gpu: &Gpu) -> egui_winit::State {
    egui_winit::State::new(
        renderer.context().clone(),
        egui::ViewportId::ROOT,
        window,
        Some(window.scale_factor() as f32),
        None,
        Some(gpu.max_texture_side_px as usize),
    )
}
