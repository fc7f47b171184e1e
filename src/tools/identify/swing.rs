//! Fits a damped swing to a log, whose rows may be at uneven times.

use super::effective::Effective;
use super::logged::{Log, LoggedBody};
use crate::sim::least_squares;

/// Number of Gauss-Newton iterations, and maximum number of times that a step is halved if it does not improve the fit.
const ITERATIONS: usize = 30;
const HALVINGS: i32 = 10;
/// Displacement for the derivatives, in units of a parameter.
const DISPLACEMENT: f64 = 1e-5;
/// The fit ends once every parameter changes by less than this, in the parameter's unit.
const SETTLED: f64 = 1e-12;
/// Minimum number of rows beyond the number of parameters.
const SPARE_ROWS: usize = 2;
/// Damping counts as critical if k - (c/2)² is below this share of k.
const CRITICAL: f64 = 1e-8;

/// A damped swing fitted to a log by least squares.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FittedSwing {
    /// The motion that a player sees.
    pub seen: Effective,
    /// The rest of the swing, in metres.
    pub rest: f64,
    /// Standard errors of the undamped frequency in hertz and of the damping ratio.
    pub errors: [f64; 2],
    /// Root mean square of the residual of x, as a share of the largest distance from the rest.
    pub residual: f64,
    /// The same in metres, and the correlation of successive residuals.
    pub(super) rms: f64,
    pub(super) lag: f64,
}

/// Stiffness and damping per unit of mass, the rest, the coordinate and velocity of the first row, and the rest's own
/// velocity.
type Parameters = [f64; 6];

/// Returns the distance from the rest `t` seconds after the start `[x, v]`, by the closed form of x″ = -k x - c x′.
fn displacement_at([k, c]: [f64; 2], [x, v]: [f64; 2], t: f64) -> f64 {
    let half = c / 2.0;
    let square = k - half * half;
    let slope = v + half * x;
    let root = square.abs().sqrt();
    // These are cos and sin(ω t)/ω, or their hyperbolic forms.
    let [even, odd] = if square.abs() <= CRITICAL * k.abs() {
        [1.0, t]
    } else if square > 0.0 {
        [libm::cos(root * t), libm::sin(root * t) / root]
    } else {
        [libm::cosh(root * t), libm::sinh(root * t) / root]
    };
    libm::exp(-half * t) * (x * even + slope * odd)
}

/// Returns the coordinates at the times of the log.
fn sample_swing(log: &Log, [k, c, rest, x, v, drift]: Parameters) -> Vec<f64> {
    let at = |t: f64| rest + drift * t + displacement_at([k, c], [x - rest, v - drift], t);
    log.rows().iter().map(|row| at(row.t_s)).collect()
}

/// Makes a first guess from the equation of motion, integrated twice. Derivatives of x would amplify its noise.
fn guess(log: &Log, drifts: bool) -> Option<Parameters> {
    let rows = log.rows();
    let (mut once, mut twice) = (vec![0.0], vec![0.0]);
    for pair in rows.windows(2) {
        let h = pair[1].t_s - pair[0].t_s;
        let last = once[once.len() - 1];
        let next = last + h * (pair[0].x + pair[1].x) / 2.0;
        // x is a straight line between two rows.
        let area = h * last + h * h * (pair[0].x / 3.0 + pair[1].x / 6.0);
        twice.push(twice[twice.len() - 1] + area);
        once.push(next);
    }
    let times = || rows.iter().map(|row| row.t_s);
    // x = x₀ + (v₀ + c x₀) t - c ∫x - k ∬x + (k rest + c drift) t² / 2 + k drift t³ / 6.
    let mut columns = vec![
        vec![1.0; rows.len()],
        times().collect(),
        once.iter().map(|x| -x).collect(),
        twice.iter().map(|x| -x).collect(),
        times().map(|t| t * t / 2.0).collect(),
    ];
    columns.extend(drifts.then(|| times().map(|t| t * t * t / 6.0).collect()));
    let x: Vec<f64> = rows.iter().map(|row| row.x).collect();
    let found = least_squares(&columns, &x)?;
    let [x, slope, c, k, pull] = [found[0], found[1], found[2], found[3], found[4]];
    let drift = found.get(5).map_or(0.0, |pull| pull / k);
    (k > 0.0).then(|| [k, c, (pull - c * drift) / k, x, slope - c * x, drift])
}

/// Returns the damped swing nearest to a log; `None` if the body has no spring, no swing fits, or the log is too short.
pub(super) fn fitted_swing(log: &Log, body: &LoggedBody) -> Option<FittedSwing> {
    fit(log, body, false).map(|(swing, _)| swing)
}

/// Returns the damped swing nearest to a log, whose rest has a steady velocity, and that velocity in m/s.
pub(super) fn drifting_swing(log: &Log, body: &LoggedBody) -> Option<(FittedSwing, f64)> {
    fit(log, body, true)
}

fn fit(log: &Log, body: &LoggedBody, drifts: bool) -> Option<(FittedSwing, f64)> {
    if !body.has_spring() || log.rows().len() < 5 + usize::from(drifts) + SPARE_ROWS {
        return None;
    }
    let mut now = guess(log, drifts)?;
    let x: Vec<f64> = log.rows().iter().map(|row| row.x).collect();
    let residual = |run: &[f64]| -> Vec<f64> { x.iter().zip(run).map(|(x, y)| x - y).collect() };
    let squares = |residual: &[f64]| residual.iter().map(|r| r * r).sum::<f64>();
    let size = x.iter().map(|x| (x - now[2]).abs()).fold(0.0, f64::max);
    // A known rest or velocity is not fitted.
    let is_free = [true, true, body.rest.is_none(), true, body.v0.is_none(), drifts];
    now[2] = body.rest.unwrap_or(now[2]);
    now[4] = body.v0.unwrap_or(now[4]);
    let unit = |now: &Parameters| {
        let root = now[0].abs().sqrt();
        [now[0], root, size, size, size * root, size * root]
    };
    let slopes = |now: &Parameters, base: &[f64]| -> Vec<Vec<f64>> {
        let free = (0..6).filter(|i| is_free[*i]);
        let column = |i: usize| {
            let mut there = *now;
            there[i] += DISPLACEMENT * unit(now)[i];
            let moved = sample_swing(log, there);
            moved.iter().zip(base).map(|(there, here)| (there - here) / DISPLACEMENT).collect()
        };
        free.map(column).collect()
    };
    for _ in 0..ITERATIONS {
        let base = sample_swing(log, now);
        let off = residual(&base);
        let change = least_squares(&slopes(&now, &base), &off)?;
        let before = squares(&off);
        let units = unit(&now);
        let nearer = (0..=HALVINGS).find_map(|halving| {
            let part = libm::scalbn(1.0, -halving);
            let mut there = now;
            let free = (0..6).filter(|i| is_free[*i]);
            free.zip(&change).for_each(|(i, change)| there[i] += part * change * units[i]);
            let is_nearer =
                there[0] > 0.0 && squares(&residual(&sample_swing(log, there))) < before;
            is_nearer.then_some(there)
        });
        let Some(nearer) = nearer else { break };
        now = nearer;
        if change.iter().all(|change| change.abs() < SETTLED) {
            break;
        }
    }
    let base = sample_swing(log, now);
    let off = residual(&base);
    let [k, c, rest, ..] = now;
    let omega = k.sqrt();
    let seen = Effective { omega, decay: c / 2.0 };
    let square = squares(&off);
    let variance = square / (x.len() - is_free.iter().filter(|free| **free).count()) as f64;
    let [of_k, of_c] = deviations(&slopes(&now, &base), variance)?;
    // The errors follow from ω = √k and ζ = c / (2 ω); the deviations are in units of k and ω.
    let omega_error = of_k * omega / 2.0;
    let ratio_error = libm::hypot(of_c / 2.0, seen.damping_ratio()? * of_k / 2.0);
    let found = FittedSwing {
        seen,
        rest,
        errors: [omega_error / std::f64::consts::TAU, ratio_error],
        residual: (square / x.len() as f64).sqrt() / size,
        rms: (square / x.len() as f64).sqrt(),
        lag: lag(&off),
    };
    let numbers = [omega, c, rest, found.residual, omega_error, ratio_error];
    numbers.iter().all(|number| number.is_finite()).then_some((found, now[5]))
}

/// Returns the correlation of successive residuals.
pub(super) fn lag(residuals: &[f64]) -> f64 {
    let of = |pairs: &mut dyn Iterator<Item = f64>| pairs.sum::<f64>();
    of(&mut residuals.windows(2).map(|pair| pair[0] * pair[1]))
        / of(&mut residuals.iter().map(|one| one * one)).max(f64::MIN_POSITIVE)
}

/// Returns the standard deviations of the first two parameters of a fit with these slopes, in the parameters' units.
/// The residual of a slope, fitted by the other slopes, shows how well its parameter is known.
fn deviations(slopes: &[Vec<f64>], variance: f64) -> Option<[f64; 2]> {
    let of = |i: usize| {
        let others: Vec<Vec<f64>> = slopes
            .iter()
            .enumerate()
            .filter(|(j, _)| *j != i)
            .map(|(_, slope)| slope.clone())
            .collect();
        let part = least_squares(&others, &slopes[i])?;
        let own = slopes[i].iter().enumerate().map(|(row, slope)| {
            let explained: f64 =
                others.iter().zip(&part).map(|(other, part)| part * other[row]).sum();
            slope - explained
        });
        Some((variance / own.map(|left| left * left).sum::<f64>()).sqrt())
    };
    Some([of(0)?, of(1)?])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::TableOptions;

    /// Returns a log of a spring that rests at 3, with x at uneven times.
    fn log(noise: f64) -> Log {
        let (mut t, mut text) = (0.0, "t,x\n".to_owned());
        for row in 0..400 {
            let off = [0.3, -1.0, 0.8, -0.4, 0.1][row % 5];
            let x = 3.0 + displacement_at([20.0, 0.25], [1.0, -0.5], t) + noise * off;
            text += &format!("{t:?},{x:?}\n");
            t += 0.012 + 0.01 * f64::from((row * 7 % 11) as u32) / 11.0;
        }
        Log::parse("log.csv", &text, &TableOptions::default(), 60.0).unwrap()
    }

    #[test]
    fn an_uneven_swing_is_fitted_to_rounding_and_a_noisy_one_within_its_errors() {
        let body = LoggedBody::default();
        for noise in [0.0, 1e-3, 1e-2] {
            let log = log(noise);
            assert!(log.is_uneven());
            let found = fitted_swing(&log, &body).unwrap();
            let (ratio, hz) = (found.seen.damping_ratio().unwrap(), found.seen.undamped_hz());
            let off =
                [hz - 20.0_f64.sqrt() / std::f64::consts::TAU, ratio - 0.125 / 20.0_f64.sqrt()];
            for (off, error) in off.into_iter().zip(found.errors) {
                assert!(off.abs() <= 1e-9 + 4.0 * error, "{noise}: {off:e} and {error:e}");
                assert!(noise == 0.0 || error > 1e-4 * noise, "{error:e}");
            }
            assert!((found.rest - 3.0).abs() < 1e-9 + noise, "{}", found.rest);
            assert!(found.residual <= noise + 1e-9, "{:e}", found.residual);
        }
    }

    #[test]
    fn the_closed_form_satisfies_its_equation_on_both_sides_of_critical_damping() {
        let (k, h) = (4.0_f64, 1e-4);
        for c in [-0.5, 0.0, 0.5, 3.999_999_99, 4.0, 4.000_000_01, 9.0] {
            let at = |t| displacement_at([k, c], [1.0, -0.3], t);
            let [x, v] = [at(0.5), (at(0.5 + h) - at(0.5 - h)) / (2.0 * h)];
            let a = (at(0.5 + h) - 2.0 * x + at(0.5 - h)) / (h * h);
            assert!((a + k * x + c * v).abs() < 1e-4, "{c}: {a}");
            assert!(((at(h) - at(-h)) / (2.0 * h) + 0.3).abs() < 1e-5, "{c}");
        }
    }
}
