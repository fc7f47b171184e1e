//! Bounds of the coordinates of a body in its first seconds, found by a short run.

use crate::sim::body::Body;
use crate::sim::integrators::{DormandPrince54, Integrator};
use crate::sim::system::Counted;

/// How long the motion is followed, in ticks and seconds: as long as people look before they judge.
const TICKS: u32 = 1200;
const TICK_S: f64 = 1.0 / 60.0;

/// The most evaluations: a few milliseconds.
const MAX_EVALUATIONS: u64 = 30_000;

/// A coordinate beyond this many times its reach in the first second has run away.
const RUNAWAY: f64 = 1e4;

/// The least and the largest value of each coordinate in the first seconds.
pub(super) fn bounds<B: Body<Vector = Vec<f64>>>(body: &B) -> Vec<(f64, f64)> {
    bounds_seen(body, |_| {})
}

/// As [`bounds`]; passes the coordinates of every tick to `see`.
pub(super) fn bounds_seen<B: Body<Vector = Vec<f64>>>(
    body: &B,
    mut see: impl FnMut(&[f64]),
) -> Vec<(f64, f64)> {
    let mut state = body.start();
    let mut bounds: Vec<(f64, f64)> = state.q.iter().map(|&q| (q, q)).collect();
    see(&state.q);
    let body = Counted::new(body.clone());
    let mut solver = <DormandPrince54<Vec<f64>> as Integrator<Counted<B>>>::new(&state.q);
    let mut first_second: Vec<f64> = vec![f64::INFINITY; state.q.len()];
    for tick in 0..TICKS {
        let stepped = solver.step(&body, f64::from(tick) * TICK_S, TICK_S, &mut state);
        let is_near = |(q, most): (&f64, &f64)| q.abs() <= *most;
        if stepped.is_err()
            || body.evaluations() > MAX_EVALUATIONS
            || !state.q.iter().all(|q| q.is_finite())
            || !state.q.iter().zip(&first_second).all(is_near)
        {
            break;
        }
        for (range, &q) in bounds.iter_mut().zip(&state.q) {
            *range = (range.0.min(q), range.1.max(q));
        }
        see(&state.q);
        if tick == 60 {
            let reach = |range: &(f64, f64)| RUNAWAY * range.0.abs().max(range.1.abs()).max(1e-9);
            first_second = bounds.iter().map(reach).collect();
        }
    }
    bounds
}
