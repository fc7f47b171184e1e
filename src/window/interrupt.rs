//! Ctrl-C in the terminal that the window was opened from, and a request of the system to end.

use std::sync::Mutex;

use winit::event_loop::EventLoopProxy;

use super::Event;

/// Makes Ctrl-C, SIGTERM and SIGHUP send an event to the window in place of ending the process.
pub(super) fn send_interrupts(window: EventLoopProxy<Event>) {
    let window = Mutex::new(window);
    let tell = move || {
        // A closed window needs no event.
        if let Ok(window) = window.lock() {
            let _ = window.send_event(Event::Interrupted);
        }
    };
    if let Err(error) = ctrlc::set_handler(tell) {
        log::warn!("Ctrl-C will stop the window at once: {error}");
    }
}
