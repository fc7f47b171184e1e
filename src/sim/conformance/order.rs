//! Measures the global order of a method, from how the error falls when the step is halved.

use super::Claim;
use super::problems::{
    Air, Kepler, KeplerRadius, Problem, SHIP, course_in_air, fixed_step, kepler_orbit, problem,
    spring,
};
use crate::body::Body;
use crate::integrators::{Method, StepFailure};
use crate::state::{State, Vector};
use crate::system::System;

/// Number of halvings that must agree.
const HALVINGS: usize = 4;

/// Returns the number of halvings to compare. The error of a method of order 5 falls to round-off in three halvings,
/// counted from where the error's next term is small.
fn halvings(order: u32) -> usize {
    if order < 5 { HALVINGS } else { 3 }
}

/// Number of steps of the coarsest run.
const MIN_STEPS: u32 = 8;
/// Number of steps with which every method must succeed.
const FINE_ENOUGH: u32 = 128;

/// Number of extra halvings for a method of order 0. Its error settles late, because the error is a drag that grows
/// with the rate.
const MORE_IF_NO_ORDER: usize = 6;

/// Number of moments at which the error is sampled. The leading term of the error has zeros, near which the next term
/// shows. At some of the moments the leading term is large.
const MOMENTS: u32 = 8;

/// The time span on springs, in seconds. It is no multiple of the springs' period 2π, of its half or of its quarter.
const SWING: f64 = 7.7;

/// The time span on an orbit from its farthest point past the nearest, in seconds.
const LONG_ARC: f64 = 4.4;

/// The tolerance of a measured order.
const MARGIN: f64 = 0.1;

/// A test problem with its exact solution.
struct ConvergenceTest<V> {
    name: &'static str,
    system: Problem<V>,
    span: f64,
    /// The exact states at the start and at each moment of the span.
    truths: Vec<State<V>>,
    /// The round-off of a step, relative to the values. It grows with the square root of the number of steps.
    round_off: f64,
    /// The maximum number of runs, each with half the step of the run before, and the number of halvings to compare.
    /// The runs are enough for the leading term to show, and too few for round-off.
    times: usize,
    halvings: usize,
}

impl<V: Vector> ConvergenceTest<V> {
    fn of_body<B: Body<Vector = V>>(
        name: &'static str,
        body: B,
        span: f64,
        halvings: usize,
    ) -> Self {
        let at = |moment| body.exact(span * f64::from(moment) / f64::from(MOMENTS), &body.start());
        let truths = (0..=MOMENTS).map(|moment| at(moment).expect("a closed form")).collect();
        Self { name, system: problem(body), span, truths, round_off: 5e-16, times: 10, halvings }
    }
}

/// Returns the largest errors of position and of velocity in `steps` steps, relative to the largest position and
/// velocity, in units of round-off.
fn errors<V: Vector>(
    method: &Method,
    course: &ConvergenceTest<V>,
    steps: u32,
) -> Result<[f64; 2], String> {
    let ConvergenceTest { name, system, span, truths, round_off, .. } = course;
    let mut state = truths[0].clone();
    let mut integrator = fixed_step(method, &state.q);
    let (mut worst, mut largest) = ([0.0, 0.0], [0.0, 0.0]);
    let stretch = span / f64::from(MOMENTS);
    for (moment, truth) in (0..MOMENTS).zip(&truths[1..]) {
        let t = stretch * f64::from(moment);
        let n = steps / MOMENTS;
        let h = stretch / f64::from(n);
        // Substeps of a tick over which a force is held would not go to the true motion.
        let stepped =
            (0..n).try_for_each(|i| integrator.step(system, t + h * f64::from(i), h, &mut state));
        match stepped {
            // This close to the centre, an implicit equation need not have a solution.
            Err(_) if steps < FINE_ENOUGH => return Ok([f64::INFINITY; 2]),
            Err(failure) => return Err(format!("on the {name}: {failure}")),
            Ok(()) => {}
        }
        let parts = [(&state.q, &truth.q), (&state.v, &truth.v)];
        for (part, (found, truth)) in parts.into_iter().enumerate() {
            for (found, truth) in found.components().iter().zip(truth.components()) {
                if !found.is_finite() {
                    return Err(format!("on the {name} it gives {found} in {steps} steps"));
                }
                worst[part] = (found - truth).abs().max(worst[part]);
                largest[part] = truth.abs().max(largest[part]);
            }
        }
    }
    let round_off = round_off * f64::from(steps).sqrt();
    Ok([worst[0] / largest[0] / round_off, worst[1] / largest[1] / round_off])
}

/// Returns the orders that the last halvings above round-off show.
fn orders(errors: impl Iterator<Item = f64>, halvings: usize) -> Vec<f64> {
    let above: Vec<f64> = errors.take_while(|&error| error > 1.0).collect();
    // The unit of round-off grows with the square root of the number of steps, which adds half an order.
    let orders: Vec<f64> = above.windows(2).map(|e| libm::log2(e[0] / e[1]) - 0.5).collect();
    orders[orders.len().saturating_sub(halvings)..].to_vec()
}

/// The orders of position and of velocity on a course.
struct MeasuredOrders {
    course: &'static str,
    orders: [Vec<f64>; 2],
}

/// Measures the orders on a course of a method with this expected order.
fn measure<V: Vector>(
    method: &Method,
    course: &ConvergenceTest<V>,
    expected: u32,
) -> Result<MeasuredOrders, String> {
    let mut table = Vec::new();
    let more = if expected == 0 { MORE_IF_NO_ORDER } else { 0 };
    for times in 0..course.times + more {
        let errors = errors(method, course, MIN_STEPS << times)?;
        if errors.iter().all(|&error| error <= 1.0) {
            break;
        }
        table.push(errors);
    }
    let orders =
        [0, 1].map(|part| orders(table.iter().map(|errors| errors[part]), course.halvings));
    if orders.iter().any(|orders| orders.len() < course.halvings) {
        return Err(format!("on the {} its error is rounding alone", course.name));
    }
    Ok(MeasuredOrders { course: course.name, orders })
}

impl MeasuredOrders {
    /// Returns the orders of the last halving.
    fn last(&self) -> [f64; 2] {
        self.orders.each_ref().map(|orders| orders.last().copied().unwrap_or(f64::NAN))
    }

    fn match_expected(&self, expected: u32, method: &Method) -> bool {
        let is_expected = |part: usize, order: f64| {
            let off = order - f64::from(expected);
            // In a method as printed, the velocity has the order of the method that the listing is meant to be.
            off.abs() < MARGIN || method.is_as_printed() && part == 1 && off > 0.0
        };
        let mut parts = self.orders.iter().enumerate();
        parts.all(|(part, orders)| orders.iter().all(|order| is_expected(part, *order)))
    }
}

fn claim(
    method: &Method,
    field: &'static str,
    expected: u32,
    measured: Vec<Result<MeasuredOrders, String>>,
) -> Claim {
    let is_so = |found: &MeasuredOrders| found.match_expected(expected, method);
    let holds = measured.iter().all(|found| found.as_ref().is_ok_and(is_so));
    let in_words = |found: MeasuredOrders| {
        let [q, v] = found.last();
        format!("{q:.2} and {v:.2} on the {}", found.course)
    };
    let words: Vec<String> =
        measured.into_iter().map(|found| found.map_or_else(|why| why, in_words)).collect();
    let measured = format!("of position and velocity: {}", words.join(", "));
    Claim { field, claimed: expected.to_string(), measured, holds }
}

/// Measures the order on an undamped spring and on a Kepler orbit, or only on the orbit if the method is exact on the
/// spring.
pub(super) fn without_drag(method: &Method) -> Claim {
    claim(method, "order", method.order, measured_without_drag(method, method.order))
}

fn measured_without_drag(method: &Method, expected: u32) -> Vec<Result<MeasuredOrders, String>> {
    let orbit = match is_for_one_coordinate(method) {
        true => {
            let radius = KeplerRadius { eccentricity: 0.5 };
            on_orbit(method, "radius of the orbit", radius, expected, LONG_ARC, |t| radius.at(t))
        }
        // On the long arc the next term hides Dormand-Prince's leading term until both are round-off.
        false => {
            let arc = if expected < 5 { LONG_ARC } else { 1.5 };
            on_orbit(method, "orbit", Kepler, expected, arc, |t| kepler_orbit(0.3, t))
        }
    };
    let mut measured = vec![orbit];
    if !method.exact_if_linear {
        let spring = ConvergenceTest::of_body("undamped spring", spring(1.0, 0.0), SWING, HALVINGS);
        measured.insert(0, measure(method, &spring, expected));
    }
    measured
}

/// Measures the orders on an arc of an orbit, of which `truth` has the state at a time after periapsis.
fn on_orbit<S: System<Vector: Vector> + 'static>(
    method: &Method,
    name: &'static str,
    system: S,
    expected: u32,
    span: f64,
    truth: impl Fn(f64) -> State<S::Vector>,
) -> Result<MeasuredOrders, String> {
    // The approach to the centre magnifies earlier rounding. So the span starts at the farthest point from the centre.
    let round_off = if expected < 5 { 2e-14 } else { 2e-15 };
    let half_a_revolution = std::f64::consts::PI;
    let at = |moment| span * f64::from(moment) / f64::from(MOMENTS) + half_a_revolution;
    let orbit = ConvergenceTest {
        name,
        system: problem(system),
        span,
        truths: (0..=MOMENTS).map(|moment| truth(at(moment))).collect(),
        round_off,
        times: 12,
        halvings: halvings(expected),
    };
    measure(method, &orbit, expected)
}

/// Whether the method refuses a body of two coordinates.
fn is_for_one_coordinate(method: &Method) -> bool {
    let mut state = kepler_orbit(0.3, 0.0);
    let stepped = fixed_step(method, &state.q).step(&problem(Kepler), 0.0, 1e-3, &mut state);
    matches!(stepped, Err(StepFailure::Refused { .. }))
}

/// Measures the order on a damped spring and on the ship, or on a body in air if the method is exact on both.
pub(super) fn with_drag(method: &Method) -> Claim {
    let expected = method.order_with_drag;
    claim(method, "order_with_drag", expected, measured_with_drag(method, expected))
}

fn measured_with_drag(method: &Method, expected: u32) -> Vec<Result<MeasuredOrders, String>> {
    if method.exact_if_linear {
        let span = 2.2;
        let at = |moment| course_in_air(span * f64::from(moment) / f64::from(MOMENTS));
        let truths = (0..=MOMENTS).map(at).collect();
        let (name, halvings) = ("body in air", halvings(expected));
        let air = ConvergenceTest {
            name,
            system: problem(Air),
            span,
            truths,
            round_off: 5e-16,
            times: 10,
            halvings,
        };
        vec![measure(method, &air, expected)]
    } else {
        let spring = ConvergenceTest::of_body("damped spring", spring(1.0, 0.2), SWING, HALVINGS);
        let ship = ConvergenceTest::of_body("ship", SHIP, 5.5, halvings(expected));
        vec![measure(method, &spring, expected), measure(method, &ship, expected)]
    }
}

/// Returns the orders of the whole state without drag and with drag. Each is the lowest order of the position or the
/// velocity on any of the problems.
///
/// # Errors
/// The reason why an order cannot be measured.
pub fn orders_of(method: &Method) -> [Result<f64, String>; 2] {
    /// The expected order of an unknown method.
    const USUAL: u32 = 4;
    [measured_without_drag, measured_with_drag].map(|measured| {
        let lowest = |expected: u32| {
            let found = measured(method, expected).into_iter().collect::<Result<Vec<_>, _>>()?;
            Ok::<f64, String>(
                found.iter().flat_map(MeasuredOrders::last).fold(f64::INFINITY, f64::min),
            )
        };
        // The error of a higher order falls to round-off in fewer halvings.
        let rough = lowest(USUAL).or_else(|_| lowest(USUAL + 1))?;
        match whole(rough) {
            // More halvings would find no order either.
            0 | USUAL => Ok(rough),
            expected => lowest(expected),
        }
    })
}

/// Describes the orders without drag and with drag.
pub(super) fn in_words(orders: &[Result<f64, String>; 2]) -> String {
    match orders {
        [Ok(order), _] if whole(*order) == 0 => "order 0: it does not converge".into(),
        [Ok(order), Ok(with_drag)] if (order - with_drag).abs() < 2.0 * MARGIN => {
            format!("order {order:.2}")
        }
        [Ok(order), Ok(with_drag)] => format!("order {order:.2}, {with_drag:.2} with drag"),
        [Ok(order), Err(why)] => format!("order {order:.2}, with drag none: {why}"),
        [Err(why), _] => format!("no order: {why}"),
    }
}

/// Returns the nearest whole order.
pub(super) fn whole(order: f64) -> u32 {
    order.round().max(0.0) as u32
}
