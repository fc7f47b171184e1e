//! Answers the requests of a screen reader, by AccessKit.

use egui_winit::State;
use egui_winit::accesskit_winit::{self, WindowEvent};
use winit::event_loop::{ActiveEventLoop, EventLoopProxy};
use winit::window::Window;

/// A request of a screen reader.
pub(super) type Request = accesskit_winit::Event;

/// Tells screen readers about a window, which is not visible yet.
pub(super) fn announce<E: From<Request> + Send + 'static>(
    egui: &mut State,
    event_loop: &ActiveEventLoop,
    window: &Window,
    proxy: EventLoopProxy<E>,
) {
    egui.init_accesskit(event_loop, window, proxy);
}

/// Gives the screen reader of `lost` to the state that takes its place.
pub(super) fn hand_over(lost: State, egui: &mut State) {
    egui.accesskit = lost.accesskit;
}

pub(super) fn answer_request(egui: &mut State, request: Request) {
    match request.window_event {
        WindowEvent::InitialTreeRequested => egui.egui_ctx().enable_accesskit(),
        WindowEvent::ActionRequested(request) => egui.on_accesskit_action_request(request),
        WindowEvent::AccessibilityDeactivated => egui.egui_ctx().disable_accesskit(),
    }
}
