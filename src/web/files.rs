//! Files that a person drops on the page or picks, and files that the page saves.

use std::path::Path;

use js_sys::{Array, Uint8Array};
use regatta::loops::trace_file;
use regatta::scene::Scene;
use regatta::studio::picture_note::recording_in;
use regatta::studio::{
    instrument_file_name, open_file, open_own_loop, open_traces, read_own_loop, show_mistakes,
};
use regatta::view::{instrument_csv, instrument_svg};
use wasm_bindgen::JsCast;
use wasm_bindgen::prelude::{Closure, JsValue};
use wasm_bindgen_futures::{JsFuture, spawn_local};
use web_sys::{
    Blob, BlobPropertyBag, File, HtmlAnchorElement, HtmlCanvasElement, HtmlInputElement, Url,
};

use crate::driver::{Driver, with};

/// Lets a person pick a file, and opens it.
pub(crate) fn pick_file() {
    let Some(input) = element::<HtmlInputElement>("input") else { return };
    input.set_type("file");
    input.set_accept(".toml,.csv,.txt,.loop");
    let picked = input.clone();
    let picked = Closure::once_into_js(move || {
        if let Some(file) = picked.files().and_then(|files| files.get(0)) {
            open(file);
        }
    });
    input.set_onchange(Some(picked.unchecked_ref()));
    input.click();
}

/// Reads a file and opens it.
pub(crate) fn open(file: File) {
    spawn_local(async move {
        if let Ok(read) = JsFuture::from(file.array_buffer()).await {
            with(|driver| driver.open_bytes(&file.name(), &Uint8Array::new(&read).to_vec()));
        }
    });
}

/// Saves the canvas as a picture. The browser allows this only in the turn in which the canvas was drawn.
pub(crate) fn save_picture(canvas: &HtmlCanvasElement, name: String) {
    let save = Closure::once_into_js(move |picture: Option<Blob>| {
        let notice = match picture {
            Some(picture) => {
                save_blob(&picture, &name);
                format!("saved {name}")
            }
            None => "no screenshot: the browser gave no picture".into(),
        };
        with(|driver| {
            driver.frames.studio.viewer.set_notice(notice);
            driver.request_frame();
        });
    });
    _ = canvas.to_blob(save.unchecked_ref());
}

fn element<T: JsCast>(tag: &str) -> Option<T> {
    web_sys::window()?.document()?.create_element(tag).ok()?.dyn_into().ok()
}

/// Saves a text as a download.
fn save_text(text: &str, kind: &str, name: &str) {
    let options = BlobPropertyBag::new();
    options.set_type(kind);
    let parts = Array::of1(&JsValue::from_str(text));
    if let Ok(blob) = Blob::new_with_str_sequence_and_options(&parts, &options) {
        save_blob(&blob, name);
    }
}

fn save_blob(blob: &Blob, name: &str) {
    let address = Url::create_object_url_with_blob(blob);
    if let (Ok(address), Some(link)) = (address, element::<HtmlAnchorElement>("a")) {
        link.set_href(&address);
        link.set_download(name);
        link.click();
        _ = Url::revoke_object_url(&address);
    }
}

impl Driver {
    /// Opens a scene, or the loop lab on a trace of frames or with a person's own loop. A dialog shows any mistakes.
    fn open_bytes(&mut self, name: &str, bytes: &[u8]) {
        let path = Path::new(name);
        let is = |known| path.extension().is_some_and(|end| end.eq_ignore_ascii_case(known));
        let studio = &mut self.frames.studio;
        let opened = if is("csv") || is("txt") {
            let traces = trace_file::from_bytes(name, bytes);
            let traces = traces.map_err(|error| vec![format!("error: {error}").into()]);
            traces.map(|traces| open_traces(studio, traces))
        } else if is("loop") {
            read_own_loop(path, bytes.into()).map(|(card, text)| {
                let id = card.id.clone();
                open_own_loop(studio, card);
                // A page cannot watch a file.
                studio.viewer.preferences.my_lines = text;
                studio.viewer.set_notice(format!("{id} runs beside the others: Shift S edits it"));
            })
        } else {
            let bytes = recording_in(bytes).map_or(bytes, str::as_bytes);
            let scene = Scene::from_bytes(name, bytes).map_err(Into::into);
            scene.map(|scene| open_file(studio, path, scene))
        };
        if let Err(report) = opened {
            show_mistakes(studio, path, report);
        }
        self.frames.skip_time();
        self.request_frame();
    }

    /// Saves the run so far.
    pub(crate) fn save_recording(&mut self) {
        let notice = match self.frames.studio.deck.recording() {
            Ok(text) => {
                let name = self.frames.studio.deck.recording_file_name();
                save_text(&text, "text/plain", &name);
                self.frames.studio.deck.note_saved();
                format!("Saved {name}. Check it with: regatta verify {name}")
            }
            Err(error) => format!("no recording: {error}"),
        };
        self.frames.studio.viewer.set_notice(notice);
    }

    /// Saves the plots of the instrument as a drawing and a table.
    pub(crate) fn save_instrument(&mut self) {
        let name = instrument_file_name(&self.frames.studio);
        let csv = instrument_csv(&self.frames.studio).map(|lines| lines.concat());
        let files = [
            ("svg", "image/svg+xml", instrument_svg(&self.frames.studio)),
            ("csv", "text/csv", csv),
        ];
        let mut saved = Vec::new();
        for (ending, kind, text) in files {
            if let Some(text) = text {
                let name = format!("{name}.{ending}");
                save_text(&text, kind, &name);
                saved.push(name);
            }
        }
        self.frames.studio.viewer.set_notice(match saved.is_empty() {
            true => "nothing saved: this instrument has no plots".into(),
            false => format!("saved {}", saved.join(", ")),
        });
    }
}
