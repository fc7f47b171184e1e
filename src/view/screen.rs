//! The surface of a window or a canvas, and the instance that can make it again.

use super::gpu::{Gpu, GpuError, RendererChoice, instance};

/// The surface for the frames of a window. The window decides on the frames and their times.
#[derive(Debug)]
pub struct Screen {
    instance: wgpu::Instance,
    surface: wgpu::Surface<'static>,
}

impl Screen {
    /// Creates a surface for `window` on its display, which GL needs to present.
    ///
    /// # Errors
    /// [`GpuError::NoSurface`], or the reason why no device can be made.
    pub async fn new(
        display: Box<dyn wgpu::wgt::WgpuHasDisplayHandle>,
        window: impl Into<wgpu::SurfaceTarget<'static>>,
    ) -> Result<Self, GpuError> {
        let descriptor = wgpu::InstanceDescriptor::new_with_display_handle_from_env(display);
        let instance = instance(descriptor);
        match instance.create_surface(window) {
            Ok(surface) => Ok(Self { instance, surface }),
            // Without a driver there is no surface either, but the missing driver is the cause to report.
            Err(refusal) => match Gpu::choose(&instance, None, RendererChoice::Gpu).await {
                Ok(_) => Err(refusal.into()),
                Err(error) => Err(error),
            },
        }
    }

    /// Creates a surface that needs no display: a browser's canvas.
    ///
    /// # Errors
    /// [`GpuError::NoSurface`].
    pub fn of_canvas(canvas: impl Into<wgpu::SurfaceTarget<'static>>) -> Result<Self, GpuError> {
        let instance = instance(wgpu::InstanceDescriptor::new_without_display_handle());
        let surface = instance.create_surface(canvas)?;
        Ok(Self { instance, surface })
    }

    /// The best device that `choice` allows and that can present here. Call it again after the loss of a device.
    ///
    /// # Errors
    /// [`GpuError::NoAdapter`] or [`GpuError::DeviceRefused`].
    pub async fn gpu(&self, choice: RendererChoice) -> Result<Gpu, GpuError> {
        Gpu::choose(&self.instance, Some(&self.surface), choice).await.inspect(Gpu::log)
    }

    /// The same screen with a new surface, for [`wgpu::CurrentSurfaceTexture::Lost`].
    ///
    /// # Errors
    /// [`GpuError::NoSurface`].
    pub fn renewed(
        self,
        window: impl Into<wgpu::SurfaceTarget<'static>>,
    ) -> Result<Self, GpuError> {
        let Self { instance, surface } = self;
        // A window can have one surface at a time.
        drop(surface);
        let surface = instance.create_surface(window)?;
        Ok(Self { instance, surface })
    }

    /// The surface, to take textures from.
    pub fn surface(&self) -> &wgpu::Surface<'static> {
        &self.surface
    }

    /// Sets the size of the surface's textures to `size_px`, limited to at least one pixel and to the adapter's
    /// maximum. Presenting waits for the display's refresh.
    pub fn configure(&self, gpu: &Gpu, size_px: [u32; 2]) {
        let [width, height] = size_px.map(|side| side.clamp(1, gpu.max_texture_side_px));
        let configuration = wgpu::SurfaceConfiguration {
            // Not every surface accepts copies, which a backdrop needs.
            usage: self.surface.get_capabilities(&gpu.adapter).usages
                & wgpu::TextureUsages::COPY_DST
                | wgpu::TextureUsages::RENDER_ATTACHMENT,
            format: gpu.pipelines.format,
            color_space: wgpu::SurfaceColorSpace::Auto,
            width,
            height,
            present_mode: wgpu::PresentMode::AutoVsync,
            desired_maximum_frame_latency: 2,
            alpha_mode: wgpu::CompositeAlphaMode::Auto,
            view_formats: Vec::new(),
        };
        self.surface.configure(&gpu.device, &configuration);
    }
}
