//! A window with the renderer and the presenter of its frames.

use std::mem;
use std::sync::Arc;
use std::time::{Duration, Instant};

use winit::event_loop::{ActiveEventLoop, EventLoopProxy};
use winit::window::Window;

use super::clipboard::Clipboard;
use super::presenter::Presenter;
use super::{Event, WindowError, screen_reader};
use crate::studio::{Command, Studio};
use crate::view::{FrameRenderer, RendererChoice};

pub(super) struct Canvas {
    pub(super) window: Arc<Window>,
    pub(super) egui: egui_winit::State,
    pub(super) renderer: FrameRenderer,
    presenter: Presenter,
    opened: Instant,
    /// The display's refresh rate in millihertz, if it is known.
    pub(super) refresh_mhz: Option<u32>,
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
        choice: RendererChoice,
    ) -> Result<Self, WindowError> {
        let presenter = Presenter::new(event_loop, &window, choice)?;
        let renderer = FrameRenderer::new(presenter.max_texture_side_px());
        let egui = translator(&renderer, &window);
        let mut canvas = Self {
            window,
            egui,
            renderer,
            presenter,
            opened: Instant::now(),
            refresh_mhz: None,
            size_px: [0, 0],
        };
        // Screen readers find the window only if this comes before it is visible.
        screen_reader::announce(&mut canvas.egui, event_loop, &canvas.window, proxy);
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
            self.presenter.resize(size_px);
        }
    }

    /// Draws a frame and shows it. Puts text that was copied from a text field on the clipboard.
    pub(super) fn draw(
        &mut self,
        studio: &Studio,
        clipboard: &mut Clipboard,
    ) -> Result<FrameOutcome, WindowError> {
        if self.presenter.renew(&self.window)? {
            self.renew_renderer();
        }
        let Some(size_px) = self.presenter.acquire() else { return Ok(FrameOutcome::Skipped) };
        // Not by `take_egui_input`, which asks the window for its size and panics if the display has destroyed it.
        let input = self.egui.egui_input_mut();
        input.time = Some(self.opened.elapsed().as_secs_f64());
        let input = input.take();
        let scale = self.window.scale_factor() as f32;
        let (commands, output) = self.renderer.draw(size_px, scale, input, studio);
        clipboard.set_copied(&output.platform.commands);
        self.egui.handle_platform_output(&self.window, output.platform);
        self.presenter.present(&output.drawing, &self.window)?;
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

    /// Replaces the renderer. The old one assumes that its fonts are on the device.
    fn renew_renderer(&mut self) {
        self.renderer = FrameRenderer::new(self.presenter.max_texture_side_px());
        let egui = translator(&self.renderer, &self.window);
        let lost = mem::replace(&mut self.egui, egui);
        screen_reader::hand_over(lost, &mut self.egui);
    }
}

/// Translates the window's events to those of the renderer's panels.
fn translator(renderer: &FrameRenderer, window: &Window) -> egui_winit::State {
    egui_winit::State::new(
        renderer.context().clone(),
        egui::ViewportId::ROOT,
        window,
        Some(window.scale_factor() as f32),
        None,
        // The renderer sets it.
        None,
    )
}
