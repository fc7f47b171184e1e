//! What a screen reader hears and asks for, by AccessKit. Without the feature `accessibility` there is none.

pub(super) use implementation::{Request, answer, attach, carry_over};

#[cfg(feature = "accessibility")]
mod implementation {
    use egui_winit::State;
    use egui_winit::accesskit_winit::{self, WindowEvent};
    use winit::event_loop::{ActiveEventLoop, EventLoopProxy};
    use winit::window::Window;

    use crate::window::Event;

    /// A request of a screen reader.
    pub(in crate::window) type Request = accesskit_winit::Event;

    impl From<Request> for Event {
        fn from(request: Request) -> Self {
            Event::ScreenReader(request)
        }
    }

    /// Lets screen readers find the window, which must not be visible yet.
    pub(in crate::window) fn attach(
        egui: &mut State,
        event_loop: &ActiveEventLoop,
        window: &Window,
        proxy: EventLoopProxy<Event>,
    ) {
        egui.init_accesskit(event_loop, window, proxy);
    }

    /// Hands the window's screen readers from one state of its panels to the next.
    pub(in crate::window) fn carry_over(old: &mut State, new: &mut State) {
        new.accesskit = old.accesskit.take();
    }

    pub(in crate::window) fn answer(egui: &mut State, request: Request) {
        match request.window_event {
            WindowEvent::InitialTreeRequested => egui.egui_ctx().enable_accesskit(),
            WindowEvent::ActionRequested(request) => egui.on_accesskit_action_request(request),
            WindowEvent::AccessibilityDeactivated => egui.egui_ctx().disable_accesskit(),
        }
    }
}

#[cfg(not(feature = "accessibility"))]
mod implementation {
    use std::convert::Infallible;

    use egui_winit::State;
    use winit::event_loop::{ActiveEventLoop, EventLoopProxy};
    use winit::window::Window;

    use crate::window::Event;

    pub(in crate::window) type Request = Infallible;

    pub(in crate::window) fn attach(
        _egui: &mut State,
        _event_loop: &ActiveEventLoop,
        _window: &Window,
        _proxy: EventLoopProxy<Event>,
    ) {
    }

    pub(in crate::window) fn carry_over(_old: &mut State, _new: &mut State) {}

    pub(in crate::window) fn answer(_egui: &mut State, request: Request) {
        match request {}
    }
}
