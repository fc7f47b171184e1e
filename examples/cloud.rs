//! A cloud of a custom body: what two methods do to the area of two thousand starts.

use regatta::measure::cloud::{Cloud, CloudShape, NoCloud};
use regatta::prelude::*;

/// A buoy in the swell, which floats up to its rim.
#[derive(Clone)]
struct Buoy;

impl System for Buoy {
    type Vector = f64;
    fn acceleration(&self, t: f64, z: &f64, _v: &f64, a: &mut f64) {
        *a = -9.81 * z.clamp(-1.0, 0.5) + swell(t);
    }
}

/// A wave every five seconds.
fn swell(t: f64) -> f64 {
    let part = t / 5.0 % 1.0;
    if part < 0.5 { 0.4 } else { -0.4 }
}

fn main() -> Result<(), NoCloud> {
    let start = State { q: 0.4, v: 0.0 };
    for id in ["explicit-euler", "semi-implicit-euler"] {
        let lane = LaneSpec::plain(method(id).expect("a built-in method"));
        let mut cloud = Cloud::of(&Buoy, start, CloudShape::Cat, 2000, &lane, 60)?;
        cloud.advance(600);
        println!("{id}: the cloud {}", cloud.in_words(cloud.area_ratio(), []));
    }
    Ok(())
}
