//! The true modes of a body, at any number of turns per tick.

use nalgebra::DMatrix;

use super::comparison::Mode;
use super::spectrum;
use super::tick::Tick;
use super::tick_map::{TickMap, force_jacobian, scale, state_of};
use crate::sim::integrators::StepFailure;
use crate::sim::{Solver, Stepper};

/// The modes of the exact flow about the current state, over the tick or a fraction of it in which no
/// mode makes more than a quarter turn.
pub(super) fn true_modes(body: &dyn Stepper, tick: Tick) -> Result<Vec<Mode>, StepFailure> {
    let here = state_of(body);
    let at = |h: f64| -> Result<Vec<Mode>, StepFailure> {
        let mut there = body.with_solver(Solver::Truth, tick.t);
        there.advance(tick.t, h, 1)?;
        let scale = scale(&here, &state_of(&*there), h);
        let mut tick_map = TickMap::new(body, Solver::Truth, Tick { h, substeps: 1, ..tick });
        let [map] = tick_map.derivatives(&here, &scale)?;
        let values = spectrum::eigenvalues_of_map(&map).unwrap_or_default();
        Ok(values.into_iter().map(|value| Mode::new(value, h)).collect())
    };
    let fastest = |modes: &[Mode]| modes.iter().map(|m| m.frequency).fold(0.0, f64::max);
    let linearised = linearised_frequency(body, &here, tick);
    let mut h = tick.h;
    while linearised * h >= QUARTER_TURN {
        h /= 2.0;
    }
    let mut modes = at(h)?;
    // A turn and a quarter looks like a quarter turn, so a result must be confirmed over half the time.
    for _ in 0..MAX_HALVINGS {
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

/// Halves a second down to a microsecond.
const MAX_HALVINGS: u32 = 20;

/// The highest frequency under the forces linearised about the current state, in radians per second.
fn linearised_frequency(body: &dyn Stepper, here: &[f64], tick: Tick) -> f64 {
    let n = here.len() / 2;
    let force_jacobian = force_jacobian(body, here, &scale(here, here, tick.h), tick.t);
    let system = DMatrix::from_fn(2 * n, 2 * n, |i, j| match i.checked_sub(n) {
        Some(i) => force_jacobian[(i, j)],
        None => f64::from(u8::from(j == i + n)),
    });
    let values = spectrum::eigenvalues_of_map(&system).unwrap_or_default();
    let frequencies = values.iter().map(|value| value.modulus * libm::sin(value.angle));
    frequencies.filter(|frequency| frequency.is_finite()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::bodies::kind;

    #[test]
    fn true_modes_of_a_spring_have_its_frequency_at_any_number_of_turns_per_tick() {
        // Among others 2 and 200 turns in a tenth of a second, and a fraction.
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
