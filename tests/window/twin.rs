//! A copy of the window's panels that knows the position of each widget and the commands of the mouse on it.

use std::num::NonZero;

use egui::accesskit::{Action, Node, Role};
use egui::{Event, Key, Modifiers, PointerButton, Pos2, RawInput, Rect};
use image::RgbaImage;
use regatta::studio::{Command, Dialog, Pace, Studio, run_loops};
use regatta::view::{CpuExecutor, FrameRenderer};

use crate::desk::Desk;

/// The size at which a window opens.
const SIZE_PX: [u32; 2] = [1280, 720];
/// On the stage, away from all bodies: a widget under the pointer lights up.
const ASIDE: Pos2 = Pos2::new(40.0, 300.0);

/// A studio and its panels with the window's inputs.
pub(crate) struct Twin {
    pub(crate) studio: Studio,
    renderer: FrameRenderer,
    executor: CpuExecutor,
    /// The accessible widgets of the last frame.
    nodes: Vec<Node>,
}

impl Twin {
    pub(crate) fn new(mut studio: Studio) -> Self {
        // As in a window, which shows the memory for rewinding.
        studio.viewer.pace = Some(Pace::Unknown);
        let renderer = FrameRenderer::new(4096);
        let executor = CpuExecutor::new(NonZero::<usize>::MIN);
        renderer.context().enable_accesskit();
        Self { studio, renderer, executor, nodes: Vec::new() }
    }

    /// Shows a frame with this event, and applies its commands.
    fn frame(&mut self, event: Option<Event>) -> Vec<u8> {
        let events = event.into_iter().collect();
        let input = RawInput { events, focused: true, ..RawInput::default() };
        let Self { studio, renderer, executor, .. } = self;
        let (commands, mut output) = renderer.draw(SIZE_PX, 1.0, input, studio);
        let mut rgba = Vec::new();
        executor.execute(&output.drawing, &mut rgba);
        let update = output.platform.accesskit_update.take().expect("it is enabled");
        self.nodes = update.nodes.into_iter().map(|(_, node)| node).collect();
        for command in commands {
            self.studio.apply(command);
        }
        rgba
    }

    fn show(&mut self, events: impl IntoIterator<Item = Event>) {
        for event in events {
            drop(self.frame(Some(event)));
        }
    }

    /// Shows frames until nothing changes any more.
    fn settle(&mut self) {
        run_loops(&mut self.studio);
        self.studio.analyse();
        (0..3).for_each(|_| drop(self.frame(None)));
    }

    /// The rectangle of the widget whose name or value starts with `name`, among those that `is_meant` accepts.
    #[track_caller]
    fn find(&mut self, name: &str, is_meant: impl Fn(&Node) -> bool) -> Rect {
        self.settle();
        let is_so = |text: Option<&str>| text.is_some_and(|text| text.starts_with(name));
        let is_found = |node: &&Node| is_so(node.label()) || is_so(node.value());
        let mut meant = self.nodes.iter().filter(|node| is_meant(node));
        let is_named = |node: &&Node| [node.label(), node.value()].contains(&Some(name));
        let Some(found) = meant.clone().find(is_named).or_else(|| meant.clone().find(is_found))
        else {
            let names: Vec<_> = meant.by_ref().map(|node| node.label().or(node.value())).collect();
            panic!("no \"{name}\" in {names:?}");
        };
        let rect = found.bounds().expect("widgets are somewhere");
        let [min, max] =
            [[rect.x0, rect.y0], [rect.x1, rect.y1]].map(|at| at.map(|side| side as f32));
        Rect::from_min_max(min.into(), max.into())
    }

    /// Where the slider of this name is.
    #[track_caller]
    pub(crate) fn slider(&mut self, name: &str) -> Rect {
        self.find(name, |node| node.role() == Role::Slider)
    }

    /// Applies a command, for which a key was pressed in the window.
    pub(crate) fn apply(&mut self, command: impl Into<Command>) {
        self.studio.apply(command);
    }

    /// Clicks the widget of this name here and in the window, and waits for both to have the same title.
    #[track_caller]
    pub(crate) fn click(&mut self, desk: &Desk, name: &str) {
        let is_clickable =
            |node: &Node| node.supports_action(Action::Click) && node.role() != Role::Label;
        let rect = self.find(name, is_clickable);
        self.click_at(desk, rect.center());
    }

    /// Clicks a place here and in the window, and waits for both to have the same title.
    #[track_caller]
    pub(crate) fn click_at(&mut self, desk: &Desk, at: Pos2) {
        let at = at.floor();
        if !self.studio.running() {
            self.wait_for(desk);
        }
        desk.click(at.x as u32, at.y as u32);
        self.show([Event::PointerMoved(at), button(at, true), button(at, false)]);
        desk.titled(&self.studio.title());
    }

    /// Clicks the widget of this name with the right button, here and in the window.
    #[track_caller]
    pub(crate) fn right_click(&mut self, desk: &Desk, name: &str) {
        let at = self.find(name, |node| node.supports_action(Action::Click)).center().floor();
        desk.still();
        desk.xdotool(&format!("mousemove --window WINDOW {} {} click 3", at.x, at.y));
        let press = |pressed| Event::PointerButton {
            pos: at,
            button: PointerButton::Secondary,
            pressed,
            modifiers: Modifiers::NONE,
        };
        self.show([Event::PointerMoved(at), press(true), press(false)]);
        self.settle();
    }

    /// Waits for the paused window to have drawn all that it had to; the dialog of a spring swings on.
    #[track_caller]
    fn wait_for(&self, desk: &Desk) {
        match self.studio.viewer.dialog() {
            Some(Dialog::Spring { .. }) => desk.settles(),
            _ => desk.still(),
        }
    }

    /// Types into the number of this name.
    #[track_caller]
    pub(crate) fn enter(&mut self, desk: &Desk, name: &str, number: &str) {
        let rect = self.find(name, |node| node.role() == Role::SpinButton);
        self.click_at(desk, rect.center());
        self.wait_for(desk);
        for digit in number.chars() {
            desk.press(&digit.to_string());
            self.show([Event::Text(digit.to_string())]);
        }
        desk.press("Return");
        self.show([Event::Key {
            key: Key::Enter,
            physical_key: None,
            pressed: true,
            repeat: false,
            modifiers: Modifiers::NONE,
        }]);
        self.settle();
        desk.titled(&self.studio.title());
    }

    /// Drags from a place to another, here and in the window.
    #[track_caller]
    pub(crate) fn drag(&mut self, desk: &Desk, from: Pos2, to: Pos2) {
        let [from, to] = [from, to].map(Pos2::floor);
        let middle = from.lerp(to, 0.5).floor();
        desk.still();
        desk.xdotool(&format!("mousemove --window WINDOW {} {} mousedown 1", from.x, from.y));
        self.show([Event::PointerMoved(from), button(from, true)]);
        for at in [middle, to] {
            desk.xdotool(&format!("mousemove --window WINDOW {} {}", at.x, at.y));
            self.show([Event::PointerMoved(at)]);
            desk.titled(&self.studio.title());
        }
        desk.xdotool("mouseup 1");
        self.show([button(to, false)]);
        self.settle();
        desk.titled(&self.studio.title());
    }

    /// Moves the pointer aside here and in the window.
    #[track_caller]
    fn move_aside(&mut self, desk: &Desk) {
        desk.xdotool(&format!("mousemove --window WINDOW {} {}", ASIDE.x, ASIDE.y));
        self.show([Event::PointerMoved(ASIDE)]);
    }

    /// Waits for the window to match this twin, apart from notices, which disappear.
    #[track_caller]
    pub(crate) fn looks_alike(&mut self, desk: &Desk) {
        self.move_aside(desk);
        self.studio.viewer.pass_time(i64::MAX);
        self.settle();
        let rgba = self.frame(None);
        let picture = RgbaImage::from_raw(SIZE_PX[0], SIZE_PX[1], rgba).unwrap();
        desk.shows(&picture, 1);
    }
}

fn button(pos: Pos2, pressed: bool) -> Event {
    let button = PointerButton::Primary;
    Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE }
}
