//! How a window opens, and what is left of it when it is closed.

use winit::dpi::{LogicalSize, PhysicalSize};
use winit::window::{Window, WindowAttributes};

use crate::look::palette::Theme;
use crate::studio::Studio;

/// How a window opens, and when it closes by itself.
#[derive(Clone, Copy, Debug, Default)]
pub struct WindowSettings {
    /// The end of the run, at the tick nearest to this many simulated seconds.
    pub seconds: Option<f64>,
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

/// The attributes of a window of this size.
pub(super) fn attributes(size: Option<[u32; 2]>) -> WindowAttributes {
    let size = size.unwrap_or(USUAL_SIZE);
    Window::default_attributes()
        .with_inner_size(LogicalSize::<u32>::from(size))
        .with_min_inner_size(LogicalSize::<u32>::from(MIN_SIZE))
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
