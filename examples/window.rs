//! Opens the window on a custom body: a buoy under every method at once, beside the truth.

use std::error::Error;

use regatta::prelude::*;

/// It floats up to its rim.
#[derive(Clone)]
struct Buoy {
    drag_per_s: f64,
}

impl System for Buoy {
    type Vector = f64;
    fn acceleration(&self, _t: f64, z: &f64, v: &f64, a: &mut f64) {
        *a = -9.81 * z.clamp(-1.0, 0.5) - self.drag_per_s * v;
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let options = Options { name: "buoy", tick_hz: 20.into(), ..Options::default() };
    let scene = Scene::of(&Buoy { drag_per_s: 0.3 }, State { q: 0.8, v: 0.0 }, options)?;
    let closed = Window::run(Session::racing(scene.into()))?;
    println!("closed at {} s", closed.studio.race().t());
    Ok(())
}
