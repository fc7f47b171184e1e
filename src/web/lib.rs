//! Regatta in a browser. This crate drives a [`Studio`](regatta::studio::Studio) by the frames and events of a page. It
//! draws the studio with the [`FrameRenderer`](regatta::view::FrameRenderer) on a canvas, as the window of the program
//! does.
//!
//! The page has one thread. Work that takes longer than a frame runs in slices between frames, as described in
//! [`work`].

mod address;
mod canvas;
mod clipboard;
mod driver;
mod files;
mod frame;
mod hashes;
mod keyboard;
mod listening;
mod pointer;
#[cfg(feature = "processor")]
mod processor;
mod questions;
mod work;

use wasm_bindgen::JsCast;
use wasm_bindgen::prelude::{JsValue, wasm_bindgen};

use address::Address;
use canvas::Canvas;
use driver::Driver;

pub use hashes::{early_hashes, judged_words};
#[cfg(feature = "processor")]
pub use processor::golden_race;
pub use questions::number;

/// Shows the program on the page's canvas. Returns when the first frame has been drawn.
///
/// # Errors
/// A sentence for the page with the reason why nothing can be drawn.
#[wasm_bindgen]
pub async fn start() -> Result<(), JsValue> {
    std::panic::set_hook(Box::new(|panic| web_sys::console::error_1(&panic.to_string().into())));
    log::set_logger(&Console).map_err(|_| "the page has been started before")?;
    log::set_max_level(log::LevelFilter::Warn);
    open().await.map_err(|reason| reason.into())
}

/// Opens the run in the address, and draws the first frame.
///
/// # Errors
/// The reason why nothing can be drawn.
async fn open() -> Result<(), String> {
    let window = web_sys::window().ok_or("there is no page")?;
    let element = window.document().and_then(|document| document.get_element_by_id("stage"));
    let element = element.and_then(|element| element.dyn_into().ok()).ok_or("there is no stage")?;
    // An address that leads nowhere does not start a run.
    let led = |refused: String| {
        let end = if refused.ends_with('?') { "" } else { "." };
        format!("This address leads to no run: {refused}{end}")
    };
    let address = Address::of(&window.location().hash().unwrap_or_default()).map_err(led)?;
    let studio = address.studio().map_err(led)?;
    let canvas = Canvas::new(element).await?;
    let mut driver = Driver::new(window, canvas, address, studio);
    driver.frame();
    driver::set(driver);
    listening::listen();
    Ok(())
}

/// Returns the present tick of the run on the page.
#[wasm_bindgen]
pub fn tick() -> f64 {
    let mut tick = 0;
    driver::with(|driver| tick = driver.frames.studio.race().tick());
    tick as f64
}

/// Puts the run into the page's address, and returns the whole address.
///
/// # Errors
/// The reason why no link can hold the run.
#[wasm_bindgen]
pub fn link() -> Result<String, JsValue> {
    let mut link = Err("the page is not ready".into());
    driver::with(|driver| link = driver.put_into_address());
    link.map_err(JsValue::from)
}

/// Resumes time, or pauses it.
#[wasm_bindgen]
pub fn pause() {
    driver::with(Driver::toggle_pause);
}

/// Returns the number of frames drawn so far.
#[wasm_bindgen]
pub fn frames() -> u32 {
    let mut frames = 0;
    driver::with(|driver| frames = driver.drawn);
    frames
}

/// Restarts the run and lets time run.
#[wasm_bindgen]
pub fn restart() {
    driver::with(Driver::restart);
}

/// Sets whether any part of the page is in sight. While it is out of sight, nothing is drawn and no time passes.
#[wasm_bindgen]
pub fn set_in_sight(is_in_sight: bool) {
    driver::with(|driver| driver.set_in_sight(is_in_sight));
}

/// A log that writes wgpu's warnings to the browser's console.
struct Console;

impl log::Log for Console {
    fn enabled(&self, metadata: &log::Metadata<'_>) -> bool {
        metadata.level() <= log::Level::Warn
    }

    fn log(&self, record: &log::Record<'_>) {
        web_sys::console::warn_1(&record.args().to_string().into());
    }

    fn flush(&self) {}
}

#[cfg(test)]
mod tests {
    mod contrast;
}
