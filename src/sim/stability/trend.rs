//! Where a method takes the energy of a body that conserves it, in the long run.

use super::tick::Tick;
use crate::sim::Stepper;
use crate::sim::integrators::StepFailure;

/// How fast the amplitude of `body` grows per second, the natural logarithm of the factor, by its energy over
/// `ticks` ticks such as `tick`, the first of them from where it stands at `tick.t`; `scale` is its energy in
/// joules without what is there at rest.
///
/// It is half the trend of the energy: the mean over the second half less that over the first, both weighted by
/// Birkhoff's bump, which takes what comes back out of a mean faster than any power of the time (Das, Saiki,
/// Sander & Yorke, Quantitative quasiperiodicity, 2017). Right for a growth that is small over the stretch.
///
/// # Errors
/// The failure of the method; [`StepFailure::NotFinite`] where the energy is not a number any more.
///
/// # Panics
/// If the body conserves no energy.
pub(super) fn growth_of_energy(
    body: &mut dyn Stepper,
    tick: Tick,
    ticks: u64,
    scale: f64,
) -> Result<f64, StepFailure> {
    let half = (ticks / 2).max(1);
    let seconds = tick.h * half as f64;
    let first = mean_energy(body, tick, half)?;
    let last = mean_energy(body, Tick { t: tick.t + seconds, ..tick }, half)?;
    Ok((last - first) / seconds / scale / 2.0)
}

/// The weighted mean over the next `ticks` ticks.
fn mean_energy(
    body: &mut dyn Stepper,
    Tick { t, h, substeps }: Tick,
    ticks: u64,
) -> Result<f64, StepFailure> {
    let (mut sum, mut weights) = (0.0, 0.0);
    for k in 0..ticks {
        body.advance(t + h * k as f64, h, substeps)?;
        let energy = body.energy().expect("it conserves its energy");
        if !energy.is_finite() {
            return Err(StepFailure::NotFinite { coordinate: "energy", value: energy });
        }
        let weight = bump((k as f64 + 0.5) / ticks as f64);
        sum += weight * energy;
        weights += weight;
    }
    Ok(sum / weights)
}

/// Smooth, and flat at both ends of 0 to 1 in every derivative.
fn bump(part: f64) -> f64 {
    libm::exp(-1.0 / (part * (1.0 - part)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::Solver;
    use crate::sim::bodies::kind;
    use crate::sim::integrators::method;

    /// The growth on an undamped spring of 1 kg and ω = 6 rad/s, let go at 1 m: of its 18 J.
    fn growth(id: &str, h: f64, seconds: f64) -> Result<f64, StepFailure> {
        let build = kind("spring").unwrap().build;
        let mut spring =
            build(&[1.0, 36.0, 0.0, 1.0, 0.0, 1.0], Solver::Method(method(id).unwrap()));
        let tick = Tick { t: 0.0, h, substeps: 1 };
        growth_of_energy(&mut *spring, tick, (4.0 * seconds / h) as u64, 18.0)
    }

    #[test]
    fn energy_that_grows_as_the_map_says_shows_its_rate() {
        // Each step multiplies the amplitude by √(1 + (h ω)⁴ / 4) under improved Euler.
        for h in [0.001_f64, 0.003] {
            let rate = libm::log(1.0 + (6.0 * h).powi(4) / 4.0) / h / 2.0;
            let found = growth("improved-euler", h, 10.0).unwrap();
            assert!((found / rate - 1.0).abs() < 0.01, "by {h} s: {found}, of {rate}");
        }
        let found = growth("rk4", 0.05, 10.0).unwrap();
        let rate = libm::log(1.0 - 0.3_f64.powi(6) / 72.0 + 0.3_f64.powi(8) / 576.0) / 0.05 / 2.0;
        assert!((found / rate - 1.0).abs() < 0.01, "{found}, of {rate}");
    }

    #[test]
    fn energy_that_swings_and_comes_back_does_not_grow() {
        for id in ["semi-implicit-euler", "velocity-verlet", "yoshida4", "newmark"] {
            let found = growth(id, 0.02, 10.0).unwrap();
            assert!(found.abs() < 1e-9, "{id}: {found}");
        }
    }
}
