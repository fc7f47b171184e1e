//! Answers the requests of a screen reader, by AccessKit.

use egui_winit::State;
use egui_winit::accesskit_winit::{self, WindowEvent};

/// A request of a screen reader.
pub(super) type Request = accesskit_winit::Event;

pub(super) fn answer_request(egui: &mut State, request: Request) {
    match request.window_event {
        WindowEvent::InitialTreeRequested => egui.egui_ctx().enable_accesskit(),
        WindowEvent::ActionRequested(request) => egui.on_accesskit_action_request(request),
        WindowEvent::AccessibilityDeactivated => egui.egui_ctx().disable_accesskit(),
    }
}
