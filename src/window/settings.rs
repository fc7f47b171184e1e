//! How a window opens, and what is left of it when it is closed.

use winit::dpi::{LogicalSize, PhysicalSize};
use winit::event_loop::ActiveEventLoop;
use winit::window::{Window, WindowAttributes};

use crate::look::palette::Theme;
use crate::studio::Studio;

/// How a window opens, and when it closes by itself.
#[derive(Clone, Copy, Debug, Default)]
pub struct WindowSettings {
    /// The end of the run, at the tick nearest to this many simulated seconds.
    pub seconds: Option<f64>,
    /// The tick to go to at first, where time then stands still.
    pub tick: Option<u64>,
    /// The size at first, in points; `None` for the usual one.
    pub size: Option<[u32; 2]>,
    /// Takes what is to be called when Ctrl-C in the terminal, or the system, asks the window to close; `None` for a window
    /// that such a request ends at once.
    pub on_interrupt: Option<OnInterrupt>,
}

/// Keeps what closes a window, and calls it when the program is to end.
pub type OnInterrupt = fn(close: Box<dyn Fn() + Send>);

/// What a closed window returns.
pub struct Closed {
    /// The studio in its last state.
    pub studio: Studio,
    /// Whether it was closed by Ctrl-C.
    pub interrupted: bool,
    /// Its last size in points, if it did not fill the screen.
    pub size: Option<[u32; 2]>,
}

/// The size of a window in points if nothing else is asked for, and the smallest one.
const USUAL_SIZE: [u32; 2] = [1280, 720];
const MIN_SIZE: [u32; 2] = [320, 240];

/// What a screen's height holds beside a window: its title, and the bars of the desktop, in points. Systems do not all say
/// how high theirs are.
const BARS: f64 = 80.0;

/// The attributes of a window of this size, or of as much of it as the screen has room for.
pub(super) fn attributes(size: Option<[u32; 2]>, event_loop: &ActiveEventLoop) -> WindowAttributes {
    let wanted = size.unwrap_or(USUAL_SIZE);
    let screen = event_loop.primary_monitor().or_else(|| event_loop.available_monitors().next());
    let size = screen.map_or(wanted, |screen| {
        let PhysicalSize { width, height } = screen.size();
        on_screen(wanted, [width, height], screen.scale_factor())
    });
    Window::default_attributes()
        .with_inner_size(LogicalSize::<u32>::from(size))
        .with_min_inner_size(LogicalSize::<u32>::from(MIN_SIZE))
}

/// As much of a size in points as a screen of this size in pixels has room for, at this number of pixels per point.
fn on_screen(wanted: [u32; 2], screen_px: [u32; 2], scale: f64) -> [u32; 2] {
    let room = [f64::from(screen_px[0]) / scale, f64::from(screen_px[1]) / scale - BARS];
    [0, 1].map(|side| match screen_px[side] {
        0 => wanted[side],
        _ => wanted[side].min(room[side] as u32).max(MIN_SIZE[side]),
    })
}

/// The size to remember of a window that has this size in pixels: none if it fills the screen, or can hardly be seen.
pub(super) fn size_of(window: &Window, size_px: PhysicalSize<u32>) -> Option<[u32; 2]> {
    if window.fullscreen().is_some() || window.is_maximized() {
        return None;
    }
    let LogicalSize { width, height } = size_px.to_logical::<u32>(window.scale_factor());
    let size = [width, height];
    (0..2).all(|side| size[side] >= MIN_SIZE[side]).then_some(size)
}

/// The system's theme.
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
    fn a_window_is_no_larger_than_its_screen_at_the_scale_of_that() {
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
