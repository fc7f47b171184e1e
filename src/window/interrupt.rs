//! Ctrl-C in the terminal that the window was opened from, and a request of the system to end.

use std::process;
use std::sync::Mutex;

use winit::event_loop::EventLoopProxy;

use super::Event;

/// Makes Ctrl-C, SIGTERM and SIGHUP send an event to the window in place of ending the process.
pub(super) fn send_interrupts(window: EventLoopProxy<Event>) {
    let window = Mutex::new(window);
    let tell = move || {
        // Once the window is closed, what is left may wait for another program: a recording that goes to a pipe.
        if window.lock().is_ok_and(|window| window.send_event(Event::Interrupted).is_err()) {
            process::exit(130);
        }
    };
    if let Err(error) = ctrlc::set_handler(tell) {
        log::warn!("Ctrl-C will stop the window at once: {error}");
    }
}
