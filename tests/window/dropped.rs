//! A scene file dropped on the window by another program, as file managers do: by the XDND protocol.

use std::path::Path;

use x11rb::connection::Connection;
use x11rb::protocol::Event;
use x11rb::protocol::xproto::{
    Atom, ClientMessageEvent, ConnectionExt, CreateWindowAux, EventMask, PropMode,
    SELECTION_NOTIFY_EVENT, SelectionNotifyEvent, SelectionRequestEvent, Window, WindowClass,
};
use x11rb::rust_connection::RustConnection;
use x11rb::wrapper::ConnectionExt as _;

use crate::desk::{Desk, until};

/// The version of XDND that file managers speak.
const VERSION: u32 = 5;

/// The program that a file is dragged from.
struct Source<'a> {
    connection: &'a RustConnection,
    window: Window,
    target: Window,
}

impl Source<'_> {
    fn atom(&self, name: &str) -> Atom {
        self.connection.intern_atom(false, name.as_bytes()).unwrap().reply().unwrap().atom
    }

    fn tell(&self, message: &str, [a, b, c, d]: [u32; 4]) {
        let data = [self.window, a, b, c, d];
        let event = ClientMessageEvent::new(32, self.target, self.atom(message), data);
        let sent = self.connection.send_event(false, self.target, EventMask::NO_EVENT, event);
        sent.unwrap().check().unwrap();
    }

    /// Answers a request for the dragged files.
    fn hand_over(&self, request: &SelectionRequestEvent, uris: &str) {
        let SelectionRequestEvent { requestor, property, target, selection, time, .. } = *request;
        let bytes = uris.as_bytes();
        let changed =
            self.connection.change_property8(PropMode::REPLACE, requestor, property, target, bytes);
        changed.unwrap().check().unwrap();
        let answer = SelectionNotifyEvent {
            response_type: SELECTION_NOTIFY_EVENT,
            sequence: 0,
            time,
            requestor,
            selection,
            target,
            property,
        };
        let sent = self.connection.send_event(false, requestor, EventMask::NO_EVENT, answer);
        sent.unwrap().check().unwrap();
    }
}

/// Drags a file over the window and drops it there.
#[track_caller]
pub(crate) fn drop_file(desk: &Desk, path: &Path) {
    let (connection, target) = desk.connect();
    let root = connection.setup().roots[0].root;
    let window = connection.generate_id().unwrap();
    let class = WindowClass::INPUT_ONLY;
    let made =
        connection.create_window(0, window, root, 0, 0, 1, 1, 0, class, 0, &CreateWindowAux::new());
    made.unwrap().check().unwrap();
    let source = Source { connection: &connection, window, target };
    let owned = connection.set_selection_owner(window, source.atom("XdndSelection"), 0u32);
    owned.unwrap().check().unwrap();

    source.tell("XdndEnter", [VERSION << 24, source.atom("text/uri-list"), 0, 0]);
    source.tell("XdndPosition", [0, 300 << 16 | 300, 0, source.atom("XdndActionCopy")]);
    let [status, finished] = ["XdndStatus", "XdndFinished"].map(|name| source.atom(name));
    let uris = format!("file://{}\r\n", path.display());
    until("the end of the drop", || {
        match connection.poll_for_event().unwrap()? {
            Event::SelectionRequest(request) => source.hand_over(&request, &uris),
            Event::ClientMessage(message) if message.type_ == status => {
                assert_eq!(message.data.as_data32()[1] & 1, 1, "the window takes no files");
                source.tell("XdndDrop", [0; 4]);
            }
            Event::ClientMessage(message) if message.type_ == finished => return Some(()),
            _ => {}
        }
        None
    });
}

pub(crate) fn a_dropped_scene_file_is_opened_unless_it_has_mistakes() {
    let folder = tempfile::tempdir().unwrap();
    let [good, bad] = ["mine.toml", "bad.toml"].map(|name| folder.path().join(name));
    std::fs::write(&good, include_str!("../../assets/scenes/ship.toml")).unwrap();
    std::fs::write(&bad, "tick_hz = 0").unwrap();
    let desk = Desk::open("--scene spring");
    desk.press("space");
    until("a pause", || desk.title().contains("(paused").then_some(()));
    drop_file(&desk, &good);
    let title = "Regatta - mine.toml - Explicit Euler - 2 Hz (paused)";
    desk.titled(title);
    desk.still();
    let before = desk.sight();
    drop_file(&desk, &bad);
    until("the mistakes", || (desk.sight() != before).then_some(()));
    desk.titled(title);
    desk.press_and_see("Escape");
    desk.quit();
}

pub(crate) fn a_dropped_frame_log_opens_the_loop_lab_or_shows_its_mistakes() {
    let folder = tempfile::tempdir().unwrap();
    let [good, bad] = ["log.csv", "bad.csv"].map(|name| folder.path().join(name));
    let rows = "16.7,16.7\n".repeat(100);
    std::fs::write(&good, format!("MsBetweenPresents,MsBetweenDisplayChange\n{rows}")).unwrap();
    std::fs::write(&bad, "a,b\n1,2\n").unwrap();
    let desk = Desk::open("--scene spring");
    desk.titled("Regatta - spring - Explicit Euler - 60 Hz");
    drop_file(&desk, &good);
    desk.titled("Regatta - spring - loop lab: Fixed - log.csv - 60 Hz");
    desk.press("space");
    let title = "Regatta - spring - loop lab: Fixed - log.csv - 60 Hz (paused)";
    desk.titled(title);
    desk.still();
    let before = desk.sight();
    drop_file(&desk, &bad);
    until("the mistakes", || (desk.sight() != before).then_some(()));
    desk.titled(title);
    desk.press_and_see("Escape");
    desk.quit();
}
