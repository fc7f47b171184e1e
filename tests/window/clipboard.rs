//! The clipboard of the desktop, as other programs use it.

use x11rb::connection::Connection as _;
use x11rb::protocol::Event;
use x11rb::protocol::xproto::{
    AtomEnum, ConnectionExt, CreateWindowAux, EventMask, PropMode, SELECTION_NOTIFY_EVENT,
    SelectionNotifyEvent, Window, WindowClass,
};
use x11rb::rust_connection::RustConnection;
use x11rb::wrapper::ConnectionExt as _;
use x11rb::{CURRENT_TIME, NONE};

use crate::desk::Desk;

/// The window of another program, which is never seen.
fn unseen(connection: &RustConnection) -> Window {
    let root = connection.setup().roots[0].root;
    let (window, input_only) = (connection.generate_id().unwrap(), WindowClass::INPUT_ONLY);
    let aux = CreateWindowAux::new();
    connection.create_window(0, window, root, 0, 0, 1, 1, 0, input_only, 0, &aux).unwrap();
    window
}

impl Desk {
    /// The text that another program would paste; empty if there is none.
    #[track_caller]
    pub(crate) fn clipboard(&self) -> String {
        let (connection, _) = self.connect();
        let window = unseen(&connection);
        let atom = |name: &[u8]| connection.intern_atom(false, name).unwrap().reply().unwrap().atom;
        let [clipboard, text, place] =
            [&b"CLIPBOARD"[..], b"UTF8_STRING", b"REGATTA_PASTED"].map(atom);
        connection.convert_selection(window, clipboard, text, place, CURRENT_TIME).unwrap();
        connection.flush().unwrap();
        let given = loop {
            if let Event::SelectionNotify(given) = connection.wait_for_event().unwrap() {
                break given.property;
            }
        };
        if given == NONE {
            return String::new();
        }
        let property = connection.get_property(false, window, given, AtomEnum::ANY, 0, u32::MAX);
        String::from_utf8(property.unwrap().reply().unwrap().value).unwrap()
    }

    /// Puts a text on the clipboard as another program would, which offers it until somebody else copies.
    #[track_caller]
    pub(crate) fn copy_elsewhere(&self, text: &str) {
        let (connection, _) = self.connect();
        let window = unseen(&connection);
        let atom = |name: &[u8]| connection.intern_atom(false, name).unwrap().reply().unwrap().atom;
        let [clipboard, utf8] = [&b"CLIPBOARD"[..], b"UTF8_STRING"].map(atom);
        connection.set_selection_owner(window, clipboard, CURRENT_TIME).unwrap().check().unwrap();
        let text = text.to_owned();
        std::thread::spawn(move || {
            while let Ok(event) = connection.wait_for_event() {
                let Event::SelectionRequest(asked) = event else { continue };
                let (to, place) = (asked.requestor, asked.property);
                let given = if asked.target == utf8 { place } else { NONE };
                if given != NONE {
                    let mode = PropMode::REPLACE;
                    connection.change_property8(mode, to, place, utf8, text.as_bytes()).unwrap();
                }
                let answer = SelectionNotifyEvent {
                    response_type: SELECTION_NOTIFY_EVENT,
                    sequence: 0,
                    time: asked.time,
                    requestor: to,
                    selection: asked.selection,
                    target: asked.target,
                    property: given,
                };
                connection.send_event(false, to, EventMask::NO_EVENT, answer).unwrap();
                connection.flush().unwrap();
            }
        });
    }
}
