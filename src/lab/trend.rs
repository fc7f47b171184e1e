//! Where a method takes the energy of a body that conserves it, in the long run.
//!
//! Small deviations about one moment do not tell what becomes of a nonlinear body: a pendulum near its
//! top falls away from every neighbour, under the exact flow too. Its energy tells, if only its swing from
//! tick to tick, which every method has, is taken out of it.

use crate::sim::Stepper;
use crate::sim::integrators::StepFailure;
use crate::sim::stability::Tick;

/// How many times the stretch asked about a body is followed: over less, a trend as small as counts could
/// not be told from the swing.
const LONG: u64 = 4;

/// A body whose energy is off by this part of its scale, and stays so, is astray: an orbit has opened, a
/// pendulum turns over. What its energy does from then on says little.
const ASTRAY: f64 = 0.25;

/// How fast the amplitude of `body` grows in a second, the natural logarithm of the factor, by its energy
/// over [`LONG`] times `ticks` ticks such as `tick`, the first of them from where it stands at `tick.t`;
/// `scale` is its energy in joules without what is there at rest.
///
/// It is half the trend of the energy: the mean over the second half less that over the first, both
/// weighted by Birkhoff's bump, which takes what comes back out of a mean faster than any power of the
/// time (Das, Saiki, Sander & Yorke, Quantitative quasiperiodicity, 2017). Of a body that goes astray it is
/// what took it there.
///
/// # Errors
/// The failure of the method before the body is astray; [`StepFailure::NotFinite`] where the energy is not
/// a number any more.
///
/// # Panics
/// If the body conserves no energy.
pub(super) fn growth_of_energy(
    body: &mut dyn Stepper,
    tick: Tick,
    ticks: u64,
    scale: f64,
) -> Result<f64, StepFailure> {
    let half = (ticks * LONG / 2).max(1);
    let mut course = Course { start: energy(body), scale, astray: None };
    let seconds = tick.h * half as f64;
    let means = course.mean(body, tick, half).and_then(|first| {
        let second = Tick { t: tick.t + seconds, ..tick };
        Ok([first, course.mean(body, second, half)?])
    });
    let by_going_astray = course.astray.map(|(t, part)| libm::log(1.0 + part) / 2.0 / (t - tick.t));
    match (means, by_going_astray) {
        (Err(_), Some(growth)) => Ok(growth),
        (Ok([_, last]), Some(growth)) if (last - course.start).abs() > ASTRAY * scale => Ok(growth),
        (means, _) => means.map(|[first, last]| (last - first) / seconds / scale / 2.0),
    }
}

fn energy(body: &dyn Stepper) -> f64 {
    body.energy().expect("it conserves its energy")
}

/// What is seen of a body's energy as it goes along.
struct Course {
    /// In joules.
    start: f64,
    scale: f64,
    /// When it first was astray, in seconds, and to which side, in parts of the scale.
    astray: Option<(f64, f64)>,
}

impl Course {
    /// The weighted mean over the next `ticks` ticks.
    fn mean(
        &mut self,
        body: &mut dyn Stepper,
        Tick { t, h, substeps }: Tick,
        ticks: u64,
    ) -> Result<f64, StepFailure> {
        let (mut sum, mut weights) = (0.0, 0.0);
        for k in 0..ticks {
            body.advance(t + h * k as f64, h, substeps)?;
            let energy = energy(body);
            if !energy.is_finite() {
                return Err(StepFailure::NotFinite { coordinate: "energy", value: energy });
            }
            let off = (energy - self.start) / self.scale;
            if self.astray.is_none() && off.abs() > ASTRAY {
                self.astray = Some((t + h * (k + 1) as f64, ASTRAY.copysign(off)));
            }
            let weight = bump((k as f64 + 0.5) / ticks as f64);
            sum += weight * energy;
            weights += weight;
        }
        Ok(sum / weights)
    }
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
        growth_of_energy(&mut *spring, tick, (seconds / h) as u64, 18.0)
    }

    #[test]
    fn energy_that_grows_as_the_map_says_shows_its_rate() {
        // Each step multiplies the amplitude by √(1 + (h ω)⁴ / 4) under improved Euler, by √(1 + (h ω)²)
        // under the explicit one.
        let slow = |h: f64| libm::log(1.0 + (6.0 * h).powi(4) / 4.0) / h / 2.0;
        let fast = |h: f64| libm::log(1.0 + (6.0 * h).powi(2)) / h / 2.0;
        for (id, h, rate) in [
            ("improved-euler", 0.01, slow(0.01)),
            ("improved-euler", 0.04, slow(0.04)),
            ("explicit-euler", 0.001, fast(0.001)),
            ("explicit-euler", 0.02, fast(0.02)),
        ] {
            let found = growth(id, h, 10.0).unwrap();
            assert!((found / rate - 1.0).abs() < 0.1, "{id} by {h} s: {found}, of {rate}");
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

    #[test]
    fn energy_past_all_numbers_does_not_hide_how_it_went_there() {
        let found = growth("explicit-euler", 2.0, 2000.0).unwrap();
        assert!((0.01..1.0).contains(&found), "{found}");
    }
}
