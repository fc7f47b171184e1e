//! Regatta in a browser: drives a [`Studio`](regatta::studio::Studio) by the frames and events of a page, and draws it with the
//! [`FrameRenderer`](regatta::view::FrameRenderer) on a canvas, as the window of the program does.
//!
//! The page is one thread. What takes longer than a frame is done in slices between frames; see [`work`].

mod address;
mod canvas;
mod clipboard;
#[cfg(test)]
mod contrast;
mod driver;
mod files;
mod frame;
mod hashes;
mod keyboard;
mod listening;
mod pointer;
mod questions;
mod work;

use wasm_bindgen::JsCast;
use wasm_bindgen::prelude::{JsValue, wasm_bindgen};

use address::Address;
use canvas::Canvas;
use driver::Driver;

pub use hashes::{early_hashes, judged_words};
pub use questions::number;

/// Shows the program on the canvas of the page, and returns when its first frame is drawn.
///
/// # Errors
/// Why nothing can be drawn, in a sentence for the page.
#[wasm_bindgen]
pub async fn start() -> Result<(), JsValue> {
    std::panic::set_hook(Box::new(|panic| web_sys::console::error_1(&panic.to_string().into())));
    log::set_logger(&Console).map_err(|_| "the page has been started before")?;
    log::set_max_level(log::LevelFilter::Warn);
    open().await.map_err(|reason| reason.into())
}

/// Opens what the address asks for, and draws the first frame.
///
/// # Errors
/// Why nothing can be drawn.
async fn open() -> Result<(), String> {
    let window = web_sys::window().ok_or("there is no page")?;
    let element = window.document().and_then(|document| document.get_element_by_id("stage"));
    let element = element.and_then(|element| element.dyn_into().ok()).ok_or("there is no stage")?;
    // Nothing runs of an address that leads nowhere.
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

/// The tick of the run on the page.
#[wasm_bindgen]
pub fn tick() -> f64 {
    let mut tick = 0;
    driver::with(|driver| tick = driver.frames.studio.race().tick());
    tick as f64
}

/// Puts the run into the address of the page, and returns the whole address.
///
/// # Errors
/// Why no link can hold the run.
#[wasm_bindgen]
pub fn link() -> Result<String, JsValue> {
    let mut link = Err("the page is not ready".into());
    driver::with(|driver| link = driver.put_into_address());
    link.map_err(JsValue::from)
}

/// Has time run, or stand still.
#[wasm_bindgen]
pub fn pause() {
    driver::with(Driver::play);
}

/// The frames drawn so far.
#[wasm_bindgen]
pub fn frames() -> u32 {
    let mut frames = 0;
    driver::with(|driver| frames = driver.drawn);
    frames
}

/// Starts the run again, and has time run.
#[wasm_bindgen]
pub fn again() {
    driver::with(Driver::begin_again);
}

/// Has the page know whether any of it is in sight; what is not is not drawn, and no time passes there.
#[wasm_bindgen]
pub fn set_in_sight(is_in_sight: bool) {
    driver::with(|driver| driver.set_in_sight(is_in_sight));
}

/// What wgpu complains of is in the browser's console.
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
