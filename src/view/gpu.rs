//! A graphics device, with or without a window, and the errors when there is none.
//!
//! Choosing a device is asynchronous because a browser needs that; desktop drivers block on it.
//!
//! This module enumerates and ranks adapters itself rather than requesting one from wgpu. The best adapter may refuse
//! to make a device or our pipelines while the next one would.

use std::error::Error;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::pipelines::Pipelines;

/// What draws frames.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RendererChoice {
    /// A graphics card, or the processor if there is none. A software driver is not used, because our own code takes
    /// less time than it.
    #[default]
    Auto,
    /// A graphics device, which may be a software driver.
    Gpu,
    /// The processor.
    Cpu,
}

/// Why there is no device.
#[derive(Debug, thiserror::Error)]
pub enum GpuError {
    /// No driver offers a usable adapter.
    #[error(
        "no usable graphics adapter: {reasons}; unset WGPU_BACKEND if it is set, install a driver, or \
         take --renderer cpu"
    )]
    NoAdapter {
        /// The fault of each adapter, or the backends without one.
        reasons: String,
    },
    /// Adapters exist, but none of them made a device and our pipelines.
    #[error(
        "no graphics device: {refusals}; update the driver, try another WGPU_BACKEND, or take --renderer cpu"
    )]
    DeviceRefused {
        /// Each adapter tried, with its refusal.
        refusals: String,
    },
    /// The window system provided no surface to draw on.
    #[error("no surface to draw on: {0}; try WGPU_BACKEND=gl, or take --renderer cpu")]
    NoSurface(#[from] wgpu::CreateSurfaceError),
}

/// A device that draws our frames, its queue, and the adapter they came from. A clone is the same device.
#[derive(Clone, Debug)]
pub struct Gpu {
    /// Creates textures, buffers and pipelines.
    pub device: wgpu::Device,
    /// Accepts work for the device.
    pub queue: wgpu::Queue,
    /// Reports the capabilities of a surface.
    pub adapter: wgpu::Adapter,
    /// Name, backend, driver and kind of the adapter.
    pub info: wgpu::AdapterInfo,
    /// The longest side of a texture, in pixels.
    pub max_texture_side_px: u32,
    pub(super) pipelines: Pipelines,
    lost: Arc<AtomicBool>,
}

impl Gpu {
    /// Format of the targets of a device without a surface: gamma space, red first.
    pub const OFFSCREEN_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

    /// Creates a device that draws into textures only. It needs no display.
    ///
    /// `WGPU_BACKEND` (`vulkan`, `gl`, …) restricts the search.
    ///
    /// # Errors
    /// [`GpuError::NoAdapter`] or [`GpuError::DeviceRefused`].
    pub async fn headless(choice: RendererChoice) -> Result<Self, GpuError> {
        let descriptor = wgpu::InstanceDescriptor::new_without_display_handle_from_env();
        Self::choose(&instance(descriptor), None, choice).await.inspect(Self::log)
    }

    /// Names the adapter in the log.
    pub(super) fn log(&self) {
        log::info!("drawing with {}", title(&self.info));
    }

    /// Creates a device of the best ranked adapter that `choice` allows and that makes our pipelines. If there is a
    /// `surface`, the adapter must be able to present to it.
    pub(super) async fn choose(
        instance: &wgpu::Instance,
        surface: Option<&wgpu::Surface<'_>>,
        choice: RendererChoice,
    ) -> Result<Self, GpuError> {
        let mut unfit = Vec::new();
        let mut candidates = Vec::new();
        let mut adapters = instance.enumerate_adapters(wgpu::Backends::all()).await;
        // A browser offers an adapter only for a canvas.
        if adapters.is_empty() && surface.is_some() {
            let compatible_surface = surface;
            let options = wgpu::RequestAdapterOptions { compatible_surface, ..Default::default() };
            adapters.extend(instance.request_adapter(&options).await);
        }
        for adapter in adapters {
            let info = adapter.get_info();
            // A display of few colours is supported by some drivers, and has no format that they draw in.
            let format = match surface {
                Some(surface) => format_of(surface, &adapter),
                None => Some(Self::OFFSCREEN_FORMAT),
            };
            let Some(format) = format else {
                let refusal = "cannot present to this window, which may need 24 bits a pixel";
                unfit.push(format!("{} {refusal}", title(&info)));
                continue;
            };
            if info.device_type == wgpu::DeviceType::Cpu && choice != RendererChoice::Gpu {
                unfit.push(format!("{} draws with the processor", title(&info)));
            } else {
                candidates.push((adapter, info, format));
            }
        }
        if candidates.is_empty() {
            // wgpu has more to report on each backend. But its report is one sentence, and it includes backends that
            // are not built in.
            let built_in = wgpu::Instance::enabled_backend_features();
            let names = wgpu::Backend::ALL.into_iter().filter(|it| built_in.contains((*it).into()));
            let names: Vec<_> = names.map(wgpu::Backend::to_str).collect();
            let none = || format!("{} offered none", names.join(" and "));
            let reasons = if unfit.is_empty() { none() } else { unfit.join(", ") };
            return Err(GpuError::NoAdapter { reasons });
        }
        candidates.sort_by_key(|(_, info, _)| rank(info));

        let mut refusals = Vec::new();
        for (adapter, info, format) in candidates {
            match Self::open(adapter, info.clone(), format).await {
                Ok(gpu) => return Ok(gpu),
                Err(refusal) => {
                    let refusal = format!("{}: {refusal}", title(&info));
                    log::info!("passed over {refusal}");
                    refusals.push(refusal);
                }
            }
        }
        Err(GpuError::DeviceRefused { refusals: refusals.join(", ") })
    }

    async fn open(
        adapter: wgpu::Adapter,
        info: wgpu::AdapterInfo,
        format: wgpu::TextureFormat,
    ) -> Result<Self, String> {
        // The lowest limits that wgpu offers, since quads and uniforms suffice, but textures and buffers as large as
        // the adapter allows.
        let limits = wgpu::Limits {
            max_buffer_size: adapter.limits().max_buffer_size,
            ..wgpu::Limits::downlevel_webgl2_defaults().using_resolution(adapter.limits())
        };
        let max_texture_side_px = limits.max_texture_dimension_2d;
        let request = adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("regatta"),
            required_limits: limits,
            ..Default::default()
        });
        let (device, queue) = request.await.map_err(|error| error.to_string())?;
        device.on_uncaptured_error(Arc::new(|error| log::error!("graphics: {error}")));
        let pipelines = pipelines(&device, format).await?;

        let lost = Arc::new(AtomicBool::new(false));
        device.set_device_lost_callback({
            let lost = Arc::clone(&lost);
            move |reason, message| {
                lost.store(true, Ordering::Release);
                log::warn!("the graphics device is gone ({reason:?}): {message}");
            }
        });
        Ok(Self { device, queue, adapter, info, max_texture_side_px, pipelines, lost })
    }

    /// Checks that the device can draw frames on textures of this format.
    ///
    /// # Errors
    /// The device's refusal, on one line.
    pub async fn draws_on(&self, format: wgpu::TextureFormat) -> Result<(), String> {
        pipelines(&self.device, format).await.map(drop)
    }

    /// Whether the device is permanently lost: driver reset, unplugged, destroyed. Recovery needs a new [`Gpu`], and
    /// everything made from this one must be made again.
    pub fn is_lost(&self) -> bool {
        // A destroyed device reports its loss at the next poll.
        self.device.poll(wgpu::PollType::Poll).ok();
        self.lost.load(Ordering::Acquire)
    }
}

/// Creates an instance without validation of indirect draws, which we never issue. That validation needs compute
/// shaders, which some drivers' GL lacks.
pub(super) fn instance(mut descriptor: wgpu::InstanceDescriptor) -> wgpu::Instance {
    descriptor.flags.remove(wgpu::InstanceFlags::VALIDATION_INDIRECT_CALL);
    wgpu::Instance::new(descriptor)
}

async fn pipelines(
    device: &wgpu::Device,
    format: wgpu::TextureFormat,
) -> Result<Pipelines, String> {
    Pipelines::new(device, format).await.map_err(|error| cause(&error))
}

/// The innermost error, on one line. The outer ones only name the call of wgpu that failed.
fn cause(mut error: &dyn Error) -> String {
    while let Some(inner) = error.source() {
        error = inner;
    }
    error.to_string().split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The format of the surface's textures: one in gamma space if the surface has any. `None` if the adapter cannot
/// present to the surface.
fn format_of(surface: &wgpu::Surface<'_>, adapter: &wgpu::Adapter) -> Option<wgpu::TextureFormat> {
    let formats = surface.get_capabilities(adapter).formats;
    let gamma = [wgpu::TextureFormat::Bgra8Unorm, wgpu::TextureFormat::Rgba8Unorm];
    let found = gamma.into_iter().find(|format| formats.contains(format));
    found.or(formats.first().copied())
}

fn title(info: &wgpu::AdapterInfo) -> String {
    format!("{} ({})", info.name, info.backend)
}

/// Prefers hardware to software, a graphics card to an integrated chip, and an explicit interface to GL, which does
/// the same work with more of the driver in between.
fn rank(info: &wgpu::AdapterInfo) -> (u8, u8) {
    let kind = match info.device_type {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Other => 3,
        wgpu::DeviceType::Cpu => 4,
    };
    (kind, u8::from(info.backend == wgpu::Backend::Gl))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn info(kind: wgpu::DeviceType, backend: wgpu::Backend) -> wgpu::AdapterInfo {
        wgpu::AdapterInfo::new(kind, backend)
    }

    #[test]
    fn hardware_is_preferred_and_gl_is_the_last_resort_of_each_kind() {
        use wgpu::{Backend, DeviceType};
        let mut infos = [
            info(DeviceType::Cpu, Backend::Gl),
            info(DeviceType::Cpu, Backend::Vulkan),
            info(DeviceType::IntegratedGpu, Backend::Gl),
            info(DeviceType::DiscreteGpu, Backend::Vulkan),
        ];
        infos.sort_by_key(rank);
        let order = infos.map(|info| (info.device_type, info.backend));
        assert_eq!(
            order,
            [
                (DeviceType::DiscreteGpu, Backend::Vulkan),
                (DeviceType::IntegratedGpu, Backend::Gl),
                (DeviceType::Cpu, Backend::Vulkan),
                (DeviceType::Cpu, Backend::Gl),
            ]
        );
    }

    #[test]
    fn without_an_adapter_the_error_names_the_backends() {
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
        descriptor.backends = wgpu::Backends::empty();
        let instance = wgpu::Instance::new(descriptor);
        let chosen = pollster::block_on(Gpu::choose(&instance, None, RendererChoice::Auto));
        let error = chosen.unwrap_err().to_string();
        assert!(error.starts_with("no usable graphics adapter: "), "{error}");
        assert!(error.contains("gl offered none"), "{error}");
        assert!(error.ends_with("take --renderer cpu"), "{error}");
    }
}
