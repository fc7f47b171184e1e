//! Measures how the width of numbers affects a method. The chapter's ship is stepped under explicit Euler and
//! Runge-Kutta 4, in `f32` and in `f64`, at finer and finer steps. Only this experiment is generic over its numbers.
//! The rest of the program uses `f64`.
//!
//! With a finer step, a method's own error is smaller, as the p-th power of the step, but its roundings are more
//! numerous. On logarithmic axes the error falls to a minimum and rises again, like a V. Sources: Henrici, *Discrete
//! Variable Methods in Ordinary Differential Equations*, 1962; Higham, *Accuracy and Stability of Numerical
//! Algorithms*, 2nd edition, section 4.3, for Euler's method.

use std::ops::{Add, Div, Mul, RangeInclusive, Sub};

use super::grid::Swept;
use crate::scene::Scene;
use crate::sim::State;
use crate::sim::bodies::{Body, Ship};
use crate::sim::integrators::Method;

/// Times at which the speed is compared with the exact speed, in simulated seconds. There are several times, because
/// roundings go either way, so that the error at one time may vanish by chance.
pub(super) const MOMENTS_S: [f64; 4] = [2.0, 4.0, 6.0, 8.0];

/// Powers of two that are tried as the step, in seconds. They are exact in both widths, so the step itself is never
/// rounded. The finest step needs two million steps.
pub(super) const STEPS_LOG2: RangeInclusive<i32> = -18..=1;

/// A width of floating-point numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Width {
    /// `f32`, with 24 bits of significand.
    Single,
    /// `f64`, with 53 bits.
    Double,
}

impl Width {
    /// Returns the name of the type.
    pub(super) fn text(self) -> &'static str {
        match self {
            Width::Single => "f32",
            Width::Double => "f64",
        }
    }
}

/// A step, and the error of the ship's speed that results from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct StepError {
    /// Step in seconds.
    pub(super) h_s: f64,
    /// Largest error at [`MOMENTS_S`], in metres per second.
    pub(super) error_m_per_s: f64,
}

/// The errors of a method in numbers of one width.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ErrorCurve {
    pub(super) method: &'static Method,
    pub(super) width: Width,
    /// One error for each of [`STEPS_LOG2`], from the finest step to the coarsest.
    pub(super) errors: Vec<StepError>,
}

impl ErrorCurve {
    /// Returns the step with the smallest error, which is at the bottom of the V.
    pub(super) fn best(&self) -> StepError {
        let least = self.errors.iter().min_by(|a, b| a.error_m_per_s.total_cmp(&b.error_m_per_s));
        *least.expect("some steps were tried")
    }
}

/// Name of the built-in scene that has the ship.
const SCENE: &str = "ship";

/// Whether the sweep includes the chapter's ship under Runge-Kutta 4.
pub(super) fn is_swept(swept: &Swept) -> bool {
    swept.scenes.iter().any(|(name, _)| name == SCENE)
        && swept.methods.iter().any(|method| method.id == RUNGE_KUTTA)
}

/// Returns the error curves of explicit Euler and Runge-Kutta 4 on the built-in ship, in both widths. A method that is
/// not among `methods` is left out.
pub(super) fn error_curves(methods: &[&'static Method]) -> Vec<ErrorCurve> {
    let ship = chapters_ship();
    let named = FORMULAS.iter().filter_map(|&(id, formula)| {
        Some((*methods.iter().find(|method| method.id == id)?, formula))
    });
    let curves = named.flat_map(|(method, formula)| {
        [Width::Single, Width::Double].map(|width| {
            let errors = STEPS_LOG2.map(|log2| step_error(&ship, formula, width, log2)).collect();
            ErrorCurve { method, width, errors }
        })
    });
    curves.collect()
}

fn chapters_ship() -> Ship {
    let scene = Scene::built_in(SCENE).expect("it is built in");
    Ship::BLANK.with_parameters(&scene.bodies[0].values)
}

fn step_error(ship: &Ship, formula: Formula, width: Width, h_log2: i32) -> StepError {
    let h_s = libm::exp2(f64::from(h_log2));
    let speeds = match width {
        Width::Single => speeds::<f32>(ship, formula, h_s),
        Width::Double => speeds::<f64>(ship, formula, h_s),
    };
    let errors = MOMENTS_S.iter().zip(speeds).map(|(&t, v)| {
        let State { v: exact, .. } = ship.exact(t, &ship.start()).expect("it has a closed form");
        (v - exact).abs()
    });
    StepError { h_s, error_m_per_s: errors.fold(0.0, f64::max) }
}

/// A method that steps only `v′ = T/m - C/m v`, because the speed of a ship does not depend on its position.
#[derive(Clone, Copy, Debug)]
enum Formula {
    ExplicitEuler,
    RungeKutta4,
}

const FORMULAS: [(&str, Formula); 2] =
    [("explicit-euler", Formula::ExplicitEuler), (RUNGE_KUTTA, Formula::RungeKutta4)];
const RUNGE_KUTTA: &str = "rk4";

/// Returns the speeds at [`MOMENTS_S`] with steps of `h_s`. All arithmetic is in the type `R`.
fn speeds<R: Real>(ship: &Ship, formula: Formula, h_s: f64) -> [f64; MOMENTS_S.len()] {
    let mass = R::rounded(ship.mass);
    let push = R::rounded(ship.thrust * ship.throttle) / mass;
    let rate = R::rounded(ship.drag) / mass;
    let a = |v: R| push - rate * v;
    let h = R::rounded(h_s);
    let [two, three, six] = [2.0, 3.0, 6.0].map(R::rounded);
    let step = |v: R| match formula {
        Formula::ExplicitEuler => v + h * a(v),
        Formula::RungeKutta4 => {
            let k1 = a(v);
            let k2 = a(v + h / two * k1);
            let k3 = a(v + h / two * k2);
            let k4 = a(v + h * k3);
            v + h / six * k1 + h / three * k2 + h / three * k3 + h / six * k4
        }
    };
    let (mut v, mut n) = (R::rounded(ship.v0), 0);
    MOMENTS_S.map(|t| {
        let steps = (t / h_s).round() as u64;
        while n < steps {
            v = step(v);
            n += 1;
        }
        v.into()
    })
}

/// A type of floating-point numbers.
trait Real:
    Copy + Into<f64> + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// Returns the value nearest to `x`.
    fn rounded(x: f64) -> Self;
}

impl Real for f32 {
    fn rounded(x: f64) -> Self {
        x as f32
    }
}

impl Real for f64 {
    fn rounded(x: f64) -> Self {
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::integrators::{METHODS, method};
    use crate::sim::{Solver, stepper};

    fn curve(id: &str, width: Width) -> ErrorCurve {
        let mut curves = error_curves(&METHODS.iter().collect::<Vec<_>>()).into_iter();
        let curve = curves.find(|curve| curve.method.id == id && curve.width == width).unwrap();
        let errors = curve.errors.iter();
        assert!(errors.clone().all(|e| e.error_m_per_s.is_finite() && e.error_m_per_s > 0.0));
        assert_eq!(errors.count(), 20);
        curve
    }

    fn at(curve: &ErrorCurve, h_log2: i32) -> f64 {
        curve.errors[(h_log2 - STEPS_LOG2.start()) as usize].error_m_per_s
    }

    /// Returns how many times the error doubles per doubling of the step, on average from the step `2^from` to the step
    /// `2^to`.
    fn slope(curve: &ErrorCurve, from: i32, to: i32) -> f64 {
        libm::log2(at(curve, to) / at(curve, from)) / f64::from(to - from)
    }

    #[test]
    fn the_f64_versions_match_the_methods_to_the_bit() {
        let ship = chapters_ship();
        for (id, formula) in FORMULAS {
            for h_log2 in [1, -1, -6] {
                let h = libm::exp2(f64::from(h_log2));
                let mut body = stepper(ship.clone(), Solver::Method(method(id).unwrap()));
                let mut tick = 0_u32;
                let stepped = MOMENTS_S.map(|t| {
                    while f64::from(tick) * h < t {
                        body.advance(f64::from(tick) * h, h, 1).unwrap();
                        tick += 1;
                    }
                    body.v()[0]
                });
                assert_eq!(speeds::<f64>(&ship, formula, h), stepped, "{id} at 2^{h_log2} s");
            }
        }
    }

    #[test]
    fn the_truncation_branch_has_the_methods_order() {
        for (id, width, coarse, fine, order) in [
            ("explicit-euler", Width::Double, -3, -18, 1.0),
            ("explicit-euler", Width::Single, -3, -11, 1.0),
            ("rk4", Width::Double, 0, -6, 4.0),
            ("rk4", Width::Single, 1, 0, 4.0),
        ] {
            let slope = slope(&curve(id, width), fine, coarse);
            assert!((slope - order).abs() < 0.2, "{id} in {}: {slope}", width.text());
        }
    }

    /// Predicts the step with the smallest error, and that error. The model treats each rounding of the speed as
    /// random. In n steps of m additions, the error grows to √(n m) times that of one rounding. The error of one
    /// rounding is the spacing of the numbers near v, divided by √12. The truncation error C h^p is added to this.
    fn bottom(id: &str, width: Width) -> (f64, f64) {
        let ship = chapters_ship();
        let (t, v) = (8.0_f64, ship.exact(8.0, &ship.start()).unwrap().v);
        let bits = if width == Width::Single { 24 } else { 53 };
        let spacing = libm::exp2(libm::floor(libm::log2(v)) + 1.0 - f64::from(bits));
        // The factor of a step is e^-z (1 + z⁵/120 + …) under Runge-Kutta, and e^-z (1 - z²/2 + …) under Euler. The
        // remaining difference to the final speed is 20 e^(-t/10).
        let rest = 20.0 * (-0.1 * t).exp();
        let (c, p, m) = match id {
            "rk4" => (rest * t * 0.1_f64.powi(5) / 120.0, 4.0, 4.0),
            _ => (rest * t * 0.1_f64.powi(2) / 2.0, 1.0, 1.0),
        };
        let rounding = (t * m).sqrt() * spacing / 12.0_f64.sqrt();
        let h = (rounding / (2.0 * p * c)).powf(1.0 / (p + 0.5));
        (h, c * h.powf(p) + rounding / h.sqrt())
    }

    #[test]
    fn the_error_is_smallest_where_theory_predicts() {
        for (id, width) in
            [("explicit-euler", Width::Single), ("rk4", Width::Single), ("rk4", Width::Double)]
        {
            let StepError { h_s, error_m_per_s } = curve(id, width).best();
            let (h, error) = bottom(id, width);
            // The steps agree to within an octave, because a V is flat at its bottom.
            let octaves = libm::log2(h_s / h);
            assert!(octaves.abs() < 1.0, "{id} in {}: {h_s} s, not {h}", width.text());
            let ratio = error_m_per_s / error;
            assert!((0.2..2.0).contains(&ratio), "{id}: {error_m_per_s} m/s, not {error}");
        }
    }

    #[test]
    fn f32_errors_rise_again_at_fine_steps_but_f64_euler_errors_do_not() {
        for id in ["explicit-euler", "rk4"] {
            let single = curve(id, Width::Single);
            // The slope lies between those of h^-½ and h^-2. Random roundings give h^-½. Roundings that go one way in
            // ever longer runs, while an increment is a few units in the last place, give h^-2.
            let slope = slope(&single, -18, -13);
            assert!((-2.2..-1.2).contains(&slope), "{id}: {slope}");
            assert!(at(&single, -18) > 100.0 * single.best().error_m_per_s);
        }
        let double = curve("explicit-euler", Width::Double);
        assert_eq!(double.best().h_s, libm::exp2(f64::from(*STEPS_LOG2.start())));
    }
}
