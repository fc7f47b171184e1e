//! In place of `screen_reader`, where the program is built without AccessKit.

use egui_winit::State;
use winit::event_loop::{ActiveEventLoop, EventLoopProxy};
use winit::window::Window;

/// No request can come.
pub(super) enum Request {}

pub(super) fn announce<E: 'static>(
    _: &mut State,
    _: &ActiveEventLoop,
    _: &Window,
    _: EventLoopProxy<E>,
) {
}

pub(super) fn hand_over(_: State, _: &mut State) {}

pub(super) fn answer_request(_: &mut State, request: Request) {
    match request {}
}
