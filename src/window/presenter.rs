//! Shows drawings in a window: by a graphics device, or by the processor if there is no graphics card.

use std::num::NonZero;
use std::sync::Arc;

use pollster::block_on;
use softbuffer::{Context, SoftBufferError, Surface};
use winit::event_loop::{ActiveEventLoop, OwnedDisplayHandle};
use winit::window::Window;

use super::WindowError;
use crate::view::{
    CpuExecutor, Drawing, Gpu, GpuError, GpuExecutor, KeptFrame, RendererChoice, Screen,
};

/// Shows the drawings of one renderer.
pub(super) enum Presenter {
    Device(Box<Device>),
    Processor(Box<Processor>),
}

impl Presenter {
    pub(super) fn new(
        event_loop: &ActiveEventLoop,
        window: &Arc<Window>,
        choice: RendererChoice,
    ) -> Result<Self, WindowError> {
        let display = event_loop.owned_display_handle();
        if choice != RendererChoice::Cpu {
            match Device::open(display.clone(), window, choice) {
                Ok(device) => return Ok(Self::Device(Box::new(device))),
                Err(error) if choice == RendererChoice::Gpu => return Err(error.into()),
                Err(error) => log::info!("{error}"),
            }
        }
        Ok(Self::Processor(Box::new(Processor::new(display, window)?)))
    }

    /// Longest side of a texture in its drawings.
    pub(super) fn max_texture_side_px(&self) -> u32 {
        match self {
            Self::Device(device) => device.gpu.max_texture_side_px,
            Self::Processor(_) => CpuExecutor::MAX_TEXTURE_SIDE_PX,
        }
    }

    /// Sets the size of the targets.
    pub(super) fn resize(&mut self, size_px: [u32; 2]) {
        match self {
            Self::Device(device) => {
                device.size_px = size_px;
                device.configure();
            }
            Self::Processor(processor) => processor.size_px = size_px,
        }
    }

    /// Replaces what the driver has lost. Returns true if the next drawing must come from a new renderer, because the
    /// textures of the old one are gone.
    pub(super) fn renew(&mut self, window: &Arc<Window>) -> Result<bool, WindowError> {
        let Self::Device(device) = self else { return Ok(false) };
        match device.renew(window) {
            Err(error) if device.choice == RendererChoice::Auto => {
                log::info!("{error}");
                let mut processor = Processor::new(device.display.clone(), window)?;
                processor.size_px = device.size_px;
                *self = Self::Processor(Box::new(processor));
                Ok(true)
            }
            renewed => Ok(renewed?),
        }
    }

    /// Makes the target of the next drawing ready. Returns its size; `None` if nothing can be shown at the moment.
    pub(super) fn acquire(&mut self) -> Option<[u32; 2]> {
        match self {
            Self::Device(device) => device.acquire(),
            Self::Processor(processor) => Some(processor.size_px),
        }
    }

    /// Draws on the target and shows it.
    pub(super) fn present(
        &mut self,
        drawing: &Drawing,
        window: &Window,
    ) -> Result<(), WindowError> {
        match self {
            Self::Device(device) => device.present(drawing, window),
            Self::Processor(processor) => return processor.present(drawing, window),
        }
        Ok(())
    }
}

/// A graphics device and a surface of the window.
pub(super) struct Device {
    gpu: Gpu,
    executor: GpuExecutor,
    /// `None` only if the surface could not be created again.
    screen: Option<Screen>,
    surface_is_lost: bool,
    size_px: [u32; 2],
    /// The target of the next drawing, and whether the surface must be configured again afterwards.
    acquired: Option<(wgpu::SurfaceTexture, bool)>,
    choice: RendererChoice,
    display: OwnedDisplayHandle,
}

impl Device {
    fn open(
        display: OwnedDisplayHandle,
        window: &Arc<Window>,
        choice: RendererChoice,
    ) -> Result<Self, GpuError> {
        let screen = block_on(Screen::new(Box::new(display.clone()), Arc::clone(window)))?;
        let gpu = block_on(screen.gpu(choice))?;
        Ok(Self {
            executor: GpuExecutor::new(&gpu),
            gpu,
            screen: Some(screen),
            surface_is_lost: false,
            size_px: [0, 0],
            acquired: None,
            choice,
            display,
        })
    }

    fn configure(&self) {
        if let Some(screen) = &self.screen {
            screen.configure(&self.gpu, self.size_px);
        }
    }

    /// Creates a new surface, and a new device if the old one is lost or cannot present on it.
    fn renew(&mut self, window: &Arc<Window>) -> Result<bool, GpuError> {
        if !self.surface_is_lost && !self.gpu.is_lost() {
            return Ok(false);
        }
        let mut is_new = false;
        if let Some(screen) = self.screen.take() {
            let screen = screen.renewed(Arc::clone(window))?;
            if self.gpu.is_lost() || !self.gpu.adapter.is_surface_supported(screen.surface()) {
                self.gpu = block_on(screen.gpu(self.choice))?;
                self.executor = GpuExecutor::new(&self.gpu);
                is_new = true;
            }
            self.screen = Some(screen);
        }
        self.surface_is_lost = false;
        self.configure();
        Ok(is_new)
    }

    fn acquire(&mut self) -> Option<[u32; 2]> {
        use wgpu::CurrentSurfaceTexture::*;
        for _ in 0..2 {
            let found = self.screen.as_ref()?.surface().get_current_texture();
            let is_suboptimal = matches!(found, Suboptimal(_));
            match found {
                Success(target) | Suboptimal(target) => {
                    let size_px = [target.texture.width(), target.texture.height()];
                    self.acquired = Some((target, is_suboptimal));
                    return Some(size_px);
                }
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

    fn present(&mut self, drawing: &Drawing, window: &Window) {
        let Some((target, is_suboptimal)) = self.acquired.take() else { return };
        let view = target.texture.create_view(&wgpu::TextureViewDescriptor::default());
        self.gpu.queue.submit(self.executor.encode(&self.gpu, drawing, &view));
        window.pre_present_notify();
        self.gpu.queue.present(target);
        if is_suboptimal {
            self.configure();
        }
    }
}

/// The error for a picture that the window system refuses.
fn refused(error: SoftBufferError) -> WindowError {
    WindowError::NoPicture(match error {
        SoftBufferError::PlatformError(Some(said), Some(cause)) => format!("{said}: {cause}"),
        SoftBufferError::PlatformError(Some(said), None) => said,
        SoftBufferError::PlatformError(None, Some(cause)) => cause.to_string(),
        error => error.to_string(),
    })
}

/// Our own code and a buffer of the window system.
pub(super) struct Processor {
    surface: Surface<OwnedDisplayHandle, Arc<Window>>,
    frame: KeptFrame,
    size_px: [u32; 2],
}

impl Processor {
    fn new(display: OwnedDisplayHandle, window: &Arc<Window>) -> Result<Self, WindowError> {
        let context = Context::new(display).map_err(refused)?;
        let surface = Surface::new(&context, Arc::clone(window)).map_err(refused)?;
        log::info!("drawing with the processor");
        Ok(Self { surface, frame: KeptFrame::on_all_cores(), size_px: [0, 0] })
    }

    fn present(&mut self, drawing: &Drawing, window: &Window) -> Result<(), WindowError> {
        self.frame.draw(drawing);
        let [Some(width), Some(height)] = self.frame.size_px().map(NonZero::new) else {
            return Ok(());
        };
        self.surface.resize(width, height).map_err(refused)?;
        let mut buffer = self.surface.buffer_mut().map_err(refused)?;
        let has_last_frame = buffer.age() == 1;
        let whole = (!has_last_frame).then_some([0, 0, width.get(), height.get()]);
        let changed = self.frame.changed().filter(|_| has_last_frame);
        let width = width.get() as usize;
        for rect in whole.into_iter().chain(changed) {
            let [left, top, columns, rows] = rect.map(|px| px as usize);
            for first in (top..top + rows).map(|y| y * width + left) {
                let row = first..first + columns;
                copy_reordered(&self.frame.pixels()[row.clone()], &mut buffer[row]);
            }
        }
        // All of the window, for another one may have covered it since.
        window.pre_present_notify();
        buffer.present().map_err(refused)
    }
}

/// Copies pixels in the window system's order of channels.
fn copy_reordered(pixels: &[[u8; 4]], shown: &mut [u32]) {
    for (to, rgba) in shown.iter_mut().zip(pixels) {
        // Shifts of a word become vector instructions, and moves of its bytes do not.
        let abgr = u32::from_le_bytes(*rgba);
        let [red, green, blue] = [abgr & 0xff, abgr & 0xff00, abgr >> 16 & 0xff];
        // Displays ignore the first byte, but a screenshot may take it for opacity.
        *to = 0xff00_0000 | red << 16 | green | blue;
    }
}
