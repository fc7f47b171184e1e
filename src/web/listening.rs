//! Listeners for events of the page: keys, pointers, files, and the page's becoming visible or hidden.

use regatta::run::link;
use regatta::view::{command_of, egui};
use wasm_bindgen::JsCast;
use wasm_bindgen::convert::FromWasmAbi;
use wasm_bindgen::prelude::Closure;
use web_sys::{
    ClipboardEvent, DragEvent, Element, Event, EventTarget, KeyboardEvent, PointerEvent, WheelEvent,
};

use crate::driver::{Driver, theme_of, with};
use crate::files;
use crate::keyboard::Press;
use crate::pointer::{self, PointerAction};

/// Calls a function with the driver at each event with this name.
fn add_listener<E>(target: &EventTarget, name: &str, handler: impl Fn(&mut Driver, E) + 'static)
where
    E: FromWasmAbi + 'static,
{
    let handler = Closure::<dyn Fn(E)>::new(move |event| with(|driver| handler(driver, event)));
    _ = target.add_event_listener_with_callback(name, handler.as_ref().unchecked_ref());
    // The listener must live as long as the page.
    handler.forget();
}

/// Adds all listeners to the page.
pub(crate) fn listen() {
    with(|driver| {
        let canvas = driver.canvas.element.clone();
        let window = driver.window.clone();
        add_listener(&window, "keydown", Driver::key_down);
        add_listener(&window, "keyup", |driver, event| driver.key_up(&event));
        add_listener(&window, "blur", |driver, _: Event| {
            driver.set_modifiers(egui::Modifiers::default())
        });
        for (name, action) in [
            ("pointerdown", PointerAction::Down),
            ("pointermove", PointerAction::Move),
            ("pointerup", PointerAction::Up),
            ("pointercancel", PointerAction::Cancel),
            ("pointerleave", PointerAction::Cancel),
        ] {
            add_listener(&canvas, name, move |driver, event| driver.pointer(&event, action));
        }
        // A person has to enter the stage again after it has lost the focus.
        add_listener(&canvas, "blur", |driver, _: Event| driver.set_entered(false));
        add_listener(&canvas, "contextmenu", |_, event: Event| event.prevent_default());
        add_listener(&canvas, "wheel", |driver: &mut Driver, event: WheelEvent| {
            // The wheel scrolls a page that embeds the stage until a person has entered the stage.
            let is_passed = driver.is_embedded && !driver.has_focus();
            let turned = pointer::wheel_event(&event, driver.held).filter(|_| !is_passed);
            if let Some(turned) = turned {
                event.prevent_default();
                driver.send_to_panels([turned]);
            }
        });
        add_listener(&canvas, "webglcontextlost", |driver, _: Event| driver.reload_page());
        for (name, copied) in [("copy", egui::Event::Copy), ("cut", egui::Event::Cut)] {
            add_listener(&window, name, move |driver: &mut Driver, event: Event| {
                if driver.is_for_stage(&event) {
                    driver.send_to_panels([copied.clone()]);
                }
            });
        }
        add_listener(&window, "paste", |driver, event| driver.paste(&event));
        add_listener(&window, "dragover", |_, event: Event| event.prevent_default());
        add_listener(&window, "drop", |_, event: DragEvent| {
            event.prevent_default();
            let dropped = event.data_transfer().and_then(|dropped| dropped.files());
            if let Some(file) = dropped.and_then(|files| files.get(0)) {
                files::open(file);
            }
        });
        add_listener(&window, "resize", |driver, _: Event| driver.request_frame());
        if let Some(document) = window.document() {
            // Time during which nobody could see the page is not simulated.
            add_listener(&document, "visibilitychange", |driver, _: Event| {
                driver.frames.skip_time();
                driver.remember();
                driver.request_frame();
            });
        }
        if let Ok(Some(light)) = window.match_media("(prefers-color-scheme: light)") {
            add_listener(&light, "change", |driver, _: Event| {
                let theme = theme_of(&driver.window);
                driver.frames.studio.viewer.preferences.follow_theme(theme);
                driver.request_frame();
            });
        }
    });
}

impl Driver {
    /// Whether this page has the keyboard focus, rather than a page around it.
    fn has_focus(&self) -> bool {
        self.window.document().is_some_and(|document| document.has_focus().unwrap_or(false))
    }

    /// Sends events to the panels, which receive them with the next frame.
    fn send_to_panels(&mut self, events: impl IntoIterator<Item = egui::Event>) {
        self.input.events.extend(events);
        self.request_frame();
    }

    /// Updates the held modifier keys.
    fn set_modifiers(&mut self, held: egui::Modifiers) {
        if std::mem::replace(&mut self.held, held) != held {
            self.send_to_panels([egui::Event::ModifiersChanged(held)]);
        }
    }

    /// Whether an event belongs to the stage. Other elements of the page handle their own events.
    fn is_for_stage(&self, event: &Event) -> bool {
        let target = event.target().and_then(|target| target.dyn_into::<Element>().ok());
        target.is_none_or(|target| matches!(&*target.tag_name(), "CANVAS" | "BODY" | "HTML"))
    }

    /// Whether the stage itself has the focus.
    fn has_stage(&self) -> bool {
        let focused = self.window.document().and_then(|document| document.active_element());
        focused.is_some_and(|focused| focused.is_same_node(Some(&self.canvas.element)))
    }

    /// Records that a person has entered or left the stage.
    fn set_entered(&mut self, is_entered: bool) {
        if std::mem::replace(&mut self.is_entered, is_entered) != is_entered {
            self.request_frame();
        }
    }

    fn key_down(&mut self, event: KeyboardEvent) {
        let press = Press::of(&event, self.is_mac());
        self.set_modifiers(press.modifiers());
        if !self.is_for_stage(&event) {
            return;
        }
        let was_escaped = std::mem::replace(&mut self.was_escaped, press.is_escape());
        if press.is_tab() && was_escaped {
            self.set_entered(false);
        } else if self.has_stage() && !press.is_tab() && !press.is_modifier() {
            self.set_entered(true);
        }
        let panels = self.canvas.renderer.context();
        if let Some(key) = press.bound()
            && let Some(command) = command_of(key, press.is_repeated, panels)
        {
            event.prevent_default();
            self.frames.queue(command);
            return self.request_frame();
        }
        // The Tab key leaves an embedded stage, because only the page around it has other elements to focus.
        let moves_focus = press.is_tab() && self.is_entered && !self.is_embedded;
        if press.is_tab() && !moves_focus {
            return;
        }
        let is_typed = panels.egui_wants_keyboard_input() && press.edits();
        if moves_focus || is_typed {
            event.prevent_default();
        }
        self.send_to_panels(press.events(true));
    }

    fn key_up(&mut self, event: &KeyboardEvent) {
        let press = Press::of(event, self.is_mac());
        self.set_modifiers(press.modifiers());
        self.send_to_panels(press.events(false));
    }

    fn is_mac(&self) -> bool {
        self.window.navigator().platform().is_ok_and(|platform| platform.starts_with("Mac"))
    }

    fn pointer(&mut self, event: &PointerEvent, action: PointerAction) {
        if action == PointerAction::Down {
            event.prevent_default();
            _ = self.canvas.element.focus();
            _ = self.canvas.element.set_pointer_capture(event.pointer_id());
            self.set_entered(true);
        }
        let zoom = self.canvas.renderer.context().zoom_factor();
        let at = egui::pos2(event.offset_x() as f32, event.offset_y() as f32) / zoom;
        let modifiers = self.held;
        let events = pointer::events(&mut self.fingers, event, action, at, modifiers);
        self.send_to_panels(events);
    }

    fn paste(&mut self, event: &ClipboardEvent) {
        if !self.is_for_stage(event) {
            return;
        }
        let pasted = event.clipboard_data().and_then(|data| data.get_data("text").ok());
        let Some(text) = pasted else { return };
        event.prevent_default();
        if link::is_link(&text) && !self.canvas.renderer.context().text_edit_focused() {
            return self.open_link(&text);
        }
        self.send_to_panels([egui::Event::Paste(text)]);
    }
}
