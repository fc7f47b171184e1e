//! Settings of a window, and its result after it is closed.

use winit::dpi::{LogicalSize, PhysicalSize};
use winit::event_loop::ActiveEventLoop;
use winit::window::{Window, WindowAttributes};

use crate::look::palette::Theme;
use crate::studio::Studio;
use crate::view::RendererChoice;

/// Settings of a window: how it opens, and when it closes by itself.
#[derive(Clone, Copy, Debug, Default)]
pub struct WindowSettings {
    /// End of the run: the tick nearest to this many simulated seconds.
    pub seconds: Option<f64>,
    /// The tick to go to first. Time stands still there.
    pub tick: Option<u64>,
    /// Initial size in points; `None` for the default.
    pub size: Option<[u32; 2]>,
    /// What draws its frames.
    pub renderer: RendererChoice,
    /// Registers a callback for Ctrl-C in the terminal and the system's requests to close the window. Without one,
    /// such a request ends the window at once.
    pub on_interrupt: Option<OnInterrupt>,
}

/// Stores the function that closes a window, and calls it when the program is to end.
pub type OnInterrupt = fn(close: Box<dyn Fn() + Send>);

/// The result of a closed window.
pub struct Closed {
    /// The studio in its last state.
    pub studio: Studio,
    /// Whether Ctrl-C or the system closed it.
    pub interrupted: bool,
    /// Its last size in points at which it did not fill the screen.
    pub size: Option<[u32; 2]>,
}

/// Name of the desktop file.
#[cfg(target_os = "linux")]
const NAME: &str = "regatta";

/// Default size of a window in points, and the smallest size.
const USUAL_SIZE: [u32; 2] = [1280, 720];
const MIN_SIZE: [u32; 2] = [320, 240];

/// Height in points that a screen needs besides a window: for its title and the bars of the desktop. Not all systems
/// report theirs.
const BARS: f64 = 80.0;

/// Attributes of a window of this size, cut to the room on the screen.
pub(super) fn attributes(size: Option<[u32; 2]>, event_loop: &ActiveEventLoop) -> WindowAttributes {
    let wanted = size.unwrap_or(USUAL_SIZE);
    let screen = event_loop.primary_monitor().or_else(|| event_loop.available_monitors().next());
    let size = screen.map_or(wanted, |screen| {
        let PhysicalSize { width, height } = screen.size();
        on_screen(wanted, [width, height], screen.scale_factor())
    });
    let attributes = Window::default_attributes()
        .with_inner_size(LogicalSize::<u32>::from(size))
        .with_min_inner_size(LogicalSize::<u32>::from(MIN_SIZE));
    named(attributes)
}

/// The window with the name by which a desktop finds `regatta.desktop` and its icon.
#[cfg(target_os = "linux")]
fn named(attributes: WindowAttributes) -> WindowAttributes {
    use winit::platform::{wayland, x11};
    let attributes = wayland::WindowAttributesExtWayland::with_name(attributes, NAME, "");
    x11::WindowAttributesExtX11::with_name(attributes, NAME, NAME)
}

#[cfg(not(target_os = "linux"))]
fn named(attributes: WindowAttributes) -> WindowAttributes {
    attributes
}

/// Cuts a size in points to the room on a screen of this size in pixels, with `scale` pixels per point.
fn on_screen(wanted: [u32; 2], screen_px: [u32; 2], scale: f64) -> [u32; 2] {
    let room = [f64::from(screen_px[0]) / scale, f64::from(screen_px[1]) / scale - BARS];
    [0, 1].map(|side| match screen_px[side] {
        0 => wanted[side],
        _ => wanted[side].min(room[side] as u32).max(MIN_SIZE[side]),
    })
}

/// The size to remember for a window of this size in pixels; `None` if it fills the screen or can hardly be seen.
pub(super) fn size_of(window: &Window, size_px: PhysicalSize<u32>) -> Option<[u32; 2]> {
    if window.fullscreen().is_some() || window.is_maximized() {
        return None;
    }
    let LogicalSize { width, height } = size_px.to_logical::<u32>(window.scale_factor());
    let size = [width, height];
    (0..2).all(|side| size[side] >= MIN_SIZE[side]).then_some(size)
}

/// Translates the system's theme.
pub(super) fn theme_of(theme: winit::window::Theme) -> Theme {
    match theme {
        winit::window::Theme::Dark => Theme::Dark,
        winit::window::Theme::Light => Theme::Light,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_window_fits_its_screen_at_the_scale_of_that_screen() {
        for (screen_px, scale, fitted) in [
            ([1280, 800], 1.5, [853, 453]),
            ([800, 600], 1.0, [800, 520]),
            ([1920, 1080], 1.5, [1280, 640]),
            ([1280, 800], 1.0, USUAL_SIZE),
            ([2560, 1440], 1.25, USUAL_SIZE),
            ([640, 200], 2.0, MIN_SIZE),
            ([0, 0], 1.0, USUAL_SIZE),
        ] {
            assert_eq!(on_screen(USUAL_SIZE, screen_px, scale), fitted, "{screen_px:?} at {scale}");
        }
    }
}
