//! The clipboard. A browser gives it only to pages of secure addresses, and asynchronously.

use wasm_bindgen_futures::{JsFuture, spawn_local};
use web_sys::Window;

use crate::driver::{Driver, with};

/// Copies a text to the clipboard, then calls `then` with the result.
pub(crate) fn write(
    window: &Window,
    text: &str,
    then: impl FnOnce(&mut Driver, Result<(), String>) + 'static,
) {
    let navigator = window.navigator();
    let is_there = js_sys::Reflect::get(&navigator, &"clipboard".into());
    let writing = is_there.is_ok_and(|clipboard| !clipboard.is_undefined());
    let writing = writing.then(|| JsFuture::from(navigator.clipboard().write_text(text)));
    spawn_local(async move {
        let taken = match writing {
            Some(writing) => writing.await.map(drop).map_err(|_| "the browser refused".into()),
            None => Err("the page has no secure address".into()),
        };
        with(|driver| then(driver, taken));
    });
}
