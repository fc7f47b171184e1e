//! Ctrl-C in the terminal that the window was opened from.

use std::sync::Mutex;

use winit::event_loop::EventLoopProxy;

use super::Event;

/// Tells the window of Ctrl-C, which then no longer ends the process at once.
pub(super) fn heed(window: EventLoopProxy<Event>) {
    let window = Mutex::new(window);
    let tell = move || {
        // A window that is closed already needs no telling.
        if let Ok(window) = window.lock() {
            let _ = window.send_event(Event::Interrupted);
        }
    };
    if let Err(error) = ctrlc::set_handler(tell) {
        log::warn!("Ctrl-C will stop the window at once: {error}");
    }
}
