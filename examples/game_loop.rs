//! A ball falls through air, stepped at 120 Hz whatever the frame rate, and drawn between ticks.

use regatta::glam::DVec2;
use regatta::prelude::*;

struct Ball {
    drag_per_s: f64,
}

impl System for Ball {
    type Vector = DVec2;
    fn acceleration(&self, _t: f64, _q: &DVec2, v: &DVec2, a: &mut DVec2) {
        *a = DVec2::new(0.0, -9.81) - self.drag_per_s * *v;
    }
}

fn main() -> Result<(), StepFailure> {
    let ball = Ball { drag_per_s: 0.1 };
    let mut state = State { q: DVec2::new(0.0, 2.0), v: DVec2::new(5.0, 3.0) };
    let mut previous = state;
    let mut rk4 = integrator::<Ball>(method("rk4").expect("a built-in method"), &state.q);

    let (mut clock, mut tick) = (Clock::new(120), 0_u64);
    for frame_ns in [16_700_000, 16_600_000, 41_000_000] {
        for _ in 0..clock.advance(frame_ns).ticks {
            previous.assign(&state);
            rk4.step(&ball, tick as f64 / 120.0, 1.0 / 120.0, &mut state)?;
            tick += 1;
        }
        let drawn = previous.q.lerp(state.q, clock.alpha());
        println!("tick {tick}: the ball is drawn at {:.3} m, {:.3} m", drawn.x, drawn.y);
    }
    assert_eq!(tick, 8);
    assert!(state.q.x > 0.3 && state.v.y < 3.0);
    Ok(())
}
