//! Draws one frame of a run into a PNG file, without a window.

use std::error::Error;

use regatta::prelude::*;
use regatta::studio::Studio;
use regatta::view::{OffscreenRenderer, png};

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "frame.png".into());
    let scene = Scene::built_in("spring").expect("a built-in scene");
    let mut session = Session::racing(scene.into());
    session.run(120);
    let mut renderer = OffscreenRenderer::new([1280, 720], 1.0)?;
    let mut rgba = Vec::new();
    renderer.draw(&Studio::of_session(session), &mut rgba)?;
    std::fs::write(&path, png::encode(renderer.size_px(), &rgba))?;
    println!("wrote {path}");
    Ok(())
}
