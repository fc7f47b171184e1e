//! A ball falls through air, stepped at 120 Hz whatever the frame rate, and drawn between ticks. Then a wind rises.

use std::time::Duration;

use regatta::glam::DVec2;
use regatta::prelude::*;

struct Ball {
    drag_per_s: f64,
    wind: DVec2,
    /// Number of changes of the wind.
    changes: u64,
}

impl System for Ball {
    type Vector = DVec2;
    fn acceleration(&self, _t: f64, _q: &DVec2, v: &DVec2, a: &mut DVec2) {
        *a = DVec2::new(0.0, -9.81) + self.drag_per_s * (self.wind - *v);
    }

    /// A method with a memory forgets the old forces when this number changes.
    fn generation(&self) -> u64 {
        self.changes
    }
}

fn main() -> Result<(), StepFailure> {
    let mut ball = Ball { drag_per_s: 0.1, wind: DVec2::ZERO, changes: 0 };
    let mut state = State { q: DVec2::new(0.0, 2.0), v: DVec2::new(5.0, 3.0) };
    let mut previous = state;
    let mut verlet = integrator(method("velocity-verlet").expect("a built-in method"), &state.q);

    let (mut clock, mut tick) = (Clock::new(120), 0_u64);
    for frame in [16_700, 16_600, 41_000].map(Duration::from_micros) {
        for _ in 0..clock.advance_by(frame).ticks {
            if tick == 4 {
                (ball.wind, ball.changes) = (DVec2::new(-20.0, 0.0), ball.changes + 1);
            }
            previous.assign(&state);
            verlet.step(&ball, tick as f64 * clock.dt_s(), clock.dt_s(), &mut state)?;
            tick += 1;
        }
        let drawn = previous.lerp(&state, clock.alpha()).q;
        println!("tick {tick}: the ball is drawn at {:.3} m, {:.3} m", drawn.x, drawn.y);
    }
    assert_eq!(tick, 8);
    assert!(state.is_finite() && state.q.x > 0.3 && state.v.x < 4.95);
    Ok(())
}
