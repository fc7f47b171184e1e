//! How the modes of a body turn in truth, however often that is in a tick.

use nalgebra::DMatrix;

use super::comparison::Mode;
use super::probe::{Probe, rates, scale, state_of};
use super::spectrum;
use super::tick::Tick;
use crate::sim::integrators::StepFailure;
use crate::sim::{Solver, Stepper};

/// The modes of the exact flow about the body's present state, over the tick or a part of it that is
/// short enough for no mode to make more than a quarter turn.
pub(super) fn true_modes(body: &dyn Stepper, tick: Tick) -> Result<Vec<Mode>, StepFailure> {
    let here = state_of(body);
    let at = |h: f64| -> Result<Vec<Mode>, StepFailure> {
        let mut there = body.with_solver(Solver::Truth, tick.t);
        there.advance(tick.t, h, 1)?;
        let scale = scale(&here, &state_of(&*there), h);
        let mut probe = Probe::new(body, Solver::Truth, Tick { h, substeps: 1, ..tick });
        let [map] = probe.derivatives(&here, &scale)?;
        let values = spectrum::of_map(&map).unwrap_or_default();
        Ok(values.into_iter().map(|value| Mode::new(value, h)).collect())
    };
    let fastest = |modes: &[Mode]| modes.iter().map(|m| m.frequency).fold(0.0, f64::max);
    let frozen = frozen_frequency(body, &here, tick);
    let mut h = tick.h;
    while frozen * h >= QUARTER_TURN {
        h /= 2.0;
    }
    let mut modes = at(h)?;
    // A turn and a quarter looks like a quarter turn: only what half the stretch confirms is believed.
    for _ in 0..MOST_HALVINGS {
        let finer = at(h / 2.0)?;
        let (coarse, fine) = (fastest(&modes), fastest(&finer));
        if coarse * h < QUARTER_TURN && (coarse - fine).abs() <= 0.01 * fine {
            break;
        }
        (h, modes) = (h / 2.0, finer);
    }
    Ok(modes)
}

const QUARTER_TURN: f64 = std::f64::consts::FRAC_PI_2;

/// From a second down to a microsecond.
const MOST_HALVINGS: u32 = 20;

/// The frequency of the fastest mode under the forces of here and now, straightened, in radians per second.
fn frozen_frequency(body: &dyn Stepper, here: &[f64], tick: Tick) -> f64 {
    let n = here.len() / 2;
    let rates = rates(body, here, &scale(here, here, tick.h), tick.t);
    let system = DMatrix::from_fn(2 * n, 2 * n, |i, j| match i.checked_sub(n) {
        Some(i) => rates[(i, j)],
        None => f64::from(u8::from(j == i + n)),
    });
    let values = spectrum::of_map(&system).unwrap_or_default();
    let frequencies = values.iter().map(|value| value.modulus * libm::sin(value.angle));
    frequencies.filter(|frequency| frequency.is_finite()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::bodies::kind;

    #[test]
    fn true_modes_of_a_spring_turn_as_fast_as_they_do_however_often_that_is_in_a_tick() {
        // 2 and 200 turns in a tenth of a second, and a bit, among others.
        for (omega, damping) in
            [(0.3, 0.0), (30.0, 2.0), (105.0, 9.0), (127.0, 0.0), (126.0, 9.0), (12_567.0, 20.0)]
        {
            let values = [1.0, omega * omega, damping, 1.0, 0.0, 1.0];
            let spring = (kind("spring").unwrap().build)(&values, Solver::Truth);
            let swing = libm::sqrt(omega * omega - damping * damping / 4.0);
            for h in [0.1, 1.0 / 60.0] {
                let modes = true_modes(&*spring, Tick { t: 0.0, h, substeps: 1 }).unwrap();
                assert_eq!(modes.len(), 2);
                for mode in modes {
                    let shown = format!("{omega}, {h}: {mode:?}");
                    assert!((mode.frequency / swing - 1.0).abs() < 1e-6, "{shown}");
                    assert!((mode.growth_per_s + damping / 2.0).abs() < 1e-6 * swing, "{shown}");
                }
            }
        }
    }
}
