//! The long-term drift of the energy of a conservative body under a method.

use super::tick::Tick;
use crate::sim::Stepper;
use crate::sim::integrators::StepFailure;

/// The growth rate of the amplitude of `body`, as the natural logarithm of the factor per second, from
/// its energy over `ticks` ticks of length `tick.h`, starting at `tick.t`. `scale` is its energy in
/// joules in excess of that at rest.
///
/// It is half the trend of the energy: the mean over the second half less that over the first. Both are
/// weighted by a bump function, whose means of quasiperiodic functions converge faster than any power
/// of the time (Das, Saiki, Sander & Yorke, Quantitative quasiperiodicity, 2017). Valid for small
/// growth over the stretch.
///
/// # Errors
/// The failure of the method; [`StepFailure::NotFinite`] if the energy is not finite.
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

/// The weighted mean energy over the next `ticks` ticks.
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
            return Err(StepFailure::NotFinite { coordinate: "energy".into(), value: energy });
        }
        let weight = bump((k as f64 + 0.5) / ticks as f64);
        sum += weight * energy;
        weights += weight;
    }
    Ok(sum / weights)
}

/// A bump function on 0 to 1: all its derivatives vanish at both ends.
fn bump(part: f64) -> f64 {
    libm::exp(-1.0 / (part * (1.0 - part)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::Solver;
    use crate::sim::bodies::kind;
    use crate::sim::integrators::method;

    /// The growth rate of an undamped spring of 1 kg and ω = 6 rad/s, released at 1 m: 18 J.
    fn growth(id: &str, h: f64, seconds: f64) -> Result<f64, StepFailure> {
        let build = &kind("spring").unwrap().build;
        let mut spring =
            build(&[1.0, 36.0, 0.0, 1.0, 0.0, 1.0], Solver::Method(method(id).unwrap()));
        let tick = Tick { t: 0.0, h, substeps: 1 };
        growth_of_energy(&mut *spring, tick, (4.0 * seconds / h) as u64, 18.0)
    }

    #[test]
    fn the_trend_is_the_growth_rate_of_the_map() {
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
    fn an_oscillating_energy_has_no_trend() {
        for id in ["semi-implicit-euler", "velocity-verlet", "yoshida4", "newmark"] {
            let found = growth(id, 0.02, 10.0).unwrap();
            assert!(found.abs() < 1e-9, "{id}: {found}");
        }
    }
}
