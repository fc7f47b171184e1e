//! Steps a hundred thousand oscillators at once, each with the bits that it has alone.

use regatta::sim::batch::{Batch, Ticks};
use regatta::sim::integrators::method;
use regatta::sim::{State, System};

#[derive(Clone)]
struct Oscillator;

impl System for Oscillator {
    type Vector = f64;
    fn acceleration(&self, _t: f64, x: &f64, _v: &f64, a: &mut f64) {
        *a = -40.0 * x;
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let starts = (0..100_000).map(|n| State { q: f64::from(n) * 1e-5, v: 0.0 });
    let method = method("explicit-euler").ok_or("no such method")?;
    let mut batch = Batch::new(&Oscillator, method, starts)?;
    batch.run(Ticks::from_start(60, 1, 600));
    println!("after ten seconds the last one is at {} m", batch.q()[99_999]);
    Ok(())
}
