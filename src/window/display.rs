//! The window system that a window is opened on.

#[cfg(target_os = "linux")]
use std::{env, os::unix::net::UnixStream, path::Path};

use winit::event_loop::EventLoop;

use super::WindowError;
use super::error::reason;
use super::event::Event;

/// Connects to the window system. On Linux that is Wayland if the environment names a compositor that is there, and
/// else X11.
///
/// # Errors
/// [`WindowError::NoDisplay`].
pub(super) fn connect() -> Result<EventLoop<Event>, WindowError> {
    let mut builder = EventLoop::<Event>::with_user_event();
    #[cfg(target_os = "linux")]
    if is_only_x11_there() {
        winit::platform::x11::EventLoopBuilderExtX11::with_x11(&mut builder);
    }
    builder.build().map_err(|error| WindowError::NoDisplay(reason(&error)))
}

/// Whether the compositor is gone that the environment names, as in a terminal that outlives it, and X11 is named too.
/// winit would try that compositor alone.
#[cfg(target_os = "linux")]
fn is_only_x11_there() -> bool {
    let given = |name| env::var_os(name).filter(|value| !value.is_empty());
    match (given("WAYLAND_DISPLAY"), given("WAYLAND_SOCKET"), given("DISPLAY")) {
        (Some(socket), None, Some(_)) => {
            let folder = given("XDG_RUNTIME_DIR").unwrap_or_default();
            UnixStream::connect(Path::new(&folder).join(socket)).is_err()
        }
        _ => false,
    }
}
