//! A graphics device, as a program uses one: its errors, its loss, and its pixels beside those of the processor.

use std::num::NonZero;

use regatta::scene::{SCENES, Scene};
use regatta::studio::{StageCommand, Studio};
use regatta::view::{
    CpuExecutor, Drawing, FrameRenderer, Gpu, GpuExecutor, PixelDifference, PixelLimits, Readback,
    ReadbackError, RendererChoice, egui, wgpu,
};

/// Whether a driver is installed that draws our frames.
pub(crate) fn is_there() -> bool {
    pollster::block_on(Gpu::headless(RendererChoice::Gpu)).is_ok()
}

fn gpu() -> Gpu {
    pollster::block_on(Gpu::headless(RendererChoice::Gpu)).unwrap()
}

/// A texture to draw on or to write to, and to read back.
fn texture(gpu: &Gpu, [width, height]: [u32; 2]) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: Gpu::OFFSCREEN_FORMAT,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT
            | wgpu::TextureUsages::COPY_DST
            | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    })
}

/// A texture holding `rows`, uploaded rather than drawn.
fn uploaded(gpu: &Gpu, size_px: [u32; 2], rows: &[u8]) -> wgpu::Texture {
    let texture = texture(gpu, size_px);
    let layout = wgpu::TexelCopyBufferLayout {
        offset: 0,
        bytes_per_row: Some(4 * size_px[0]),
        rows_per_image: None,
    };
    gpu.queue.write_texture(texture.as_image_copy(), rows, layout, texture.size());
    texture
}

pub(crate) fn an_uncaptured_error_does_not_end_the_program() {
    let gpu = gpu();
    drop(gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::MAX,
        usage: wgpu::BufferUsages::VERTEX,
        mapped_at_creation: false,
    }));
    assert!(!gpu.is_lost());
}

pub(crate) fn a_refused_format_is_an_error_of_one_line() {
    let gpu = gpu();
    let drawn_on = |format| pollster::block_on(gpu.draws_on(format));
    assert_eq!(drawn_on(wgpu::TextureFormat::Bgra8Unorm), Ok(()));
    // No device draws colours on depths.
    let refusal = drawn_on(wgpu::TextureFormat::Depth32Float).unwrap_err();
    assert!(refusal.contains("Depth32Float") && !refusal.contains('\n'), "{refusal}");
}

pub(crate) fn pixels_come_back_exactly_at_odd_widths() {
    let gpu = gpu();
    let mut readback = Readback::default();
    let mut rows = Vec::new();
    for [width, height] in [[1, 1], [63, 5], [64, 5], [65, 5], [257, 3]] {
        let sent: Vec<u8> = (0..4 * width * height).map(|i| (i * 7 % 251) as u8).collect();
        let texture = uploaded(&gpu, [width, height], &sent);
        readback.read(&gpu, None, &texture, &mut rows).unwrap();
        assert_eq!(rows, sent, "{width}x{height}");
    }
}

pub(crate) fn reading_from_a_lost_device_is_an_error() {
    let gpu = gpu();
    let texture = uploaded(&gpu, [1, 1], &[0; 4]);
    gpu.device.destroy();
    let error = Readback::default().read(&gpu, None, &texture, &mut Vec::new()).unwrap_err();
    assert!(matches!(error, ReadbackError::DeviceLost), "{error}");
}

/// The drawings of the first frames of a scene's race, with panels.
fn race(scene: &str, size_px: [u32; 2], scale: f32, frames: usize) -> Vec<Drawing> {
    let mut studio = Studio::new(Scene::built_in(scene).unwrap());
    studio.apply(StageCommand::ToggleRace);
    let mut renderer = FrameRenderer::new(CpuExecutor::MAX_TEXTURE_SIDE_PX);
    let mut frame = |_| {
        studio.advance(100_000_000);
        let input = egui::RawInput { time: Some(studio.race().t()), ..egui::RawInput::default() };
        renderer.draw(size_px, scale, input, &studio).1.drawing
    };
    (0..frames).map(&mut frame).collect()
}

/// How the pixels of drawings by a processor and by a device differ.
fn differences(
    gpu: &Gpu,
    drawings: &[Drawing],
    size_px: [u32; 2],
) -> impl Iterator<Item = PixelDifference> {
    let mut on_processor = CpuExecutor::new(NonZero::<usize>::MIN);
    let mut on_device = GpuExecutor::new(gpu);
    let texture = texture(gpu, size_px);
    let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
    let (mut one, mut other) = (Vec::new(), Vec::new());
    drawings.iter().map(move |drawing| {
        on_processor.execute(drawing, &mut one);
        let commands = on_device.encode(gpu, drawing, &view);
        Readback::default().read(gpu, commands, &texture, &mut other).unwrap();
        PixelDifference::between(&one, &other, |_| true)
    })
}

pub(crate) fn processor_and_device_draw_every_scene_almost_alike() {
    let (gpu, size_px) = (gpu(), [640, 360]);
    let pixels = 640 * 360;
    for scene in SCENES {
        let drawings = race(scene.name, size_px, 0.7, 4);
        for difference in differences(&gpu, &drawings, size_px) {
            let is_alike = PixelLimits::OF_EXECUTORS.allow(&difference);
            assert!(is_alike, "{}: worst {}", scene.name, difference.worst());
            for (difference_by, most) in [(1, pixels / 10_000), (2, pixels / 100_000)] {
                let beyond = difference.beyond(difference_by);
                assert!(beyond <= most, "{}: {beyond} by more than {difference_by}", scene.name);
            }
        }
    }
}

pub(crate) fn a_lost_device_does_not_panic_and_a_new_one_draws() {
    let (lost, size_px) = (gpu(), [128, 72]);
    let drawings = race("spring", size_px, 0.2, 1);
    let view = texture(&lost, size_px).create_view(&wgpu::TextureViewDescriptor::default());
    let mut executor = GpuExecutor::new(&lost);
    lost.device.destroy();
    assert!(executor.encode(&lost, &drawings[0], &view).is_none());
    assert!(lost.is_lost());
    for difference in differences(&gpu(), &drawings, size_px) {
        assert!(PixelLimits::OF_EXECUTORS.allow(&difference), "{}", difference.worst());
    }
}
