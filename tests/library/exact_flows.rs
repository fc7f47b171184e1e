//! The exact flows against the differential equation itself, by finite differences.
//!
//! Every other suite relies on [`Body::exact`]. If this one fails, trust none of them.

use regatta::sim::State;
use regatta::sim::bodies::{Body, Ship, Spring};

const CHAPTER_SHIP: Ship = ship(1_000.0);

const fn ship(drag: f64) -> Ship {
    Ship { thrust: 20_000.0, throttle: 1.0, drag, mass: 10_000.0, s0: 0.0, v0: 0.0, kick: 20_000.0 }
}

/// A spring of ω = 3 rad/s with this damping ratio.
fn spring(damping_ratio: f64) -> Spring {
    let (mass, omega) = (2.0, 3.0);
    let damping = 2.0 * damping_ratio * mass * omega;
    Spring { mass, stiffness: mass * omega * omega, damping, x0: 1.0, v0: 0.0, kick: 1.0 }
}

/// Undamped, underdamped, on both sides of the limits of the series at ζ = 1, overdamped.
const DAMPING_RATIOS: [f64; 22] = [
    0.0,
    1e-12,
    1e-6,
    0.05,
    0.2,
    0.7,
    0.98,
    1.0 - 1e-3,
    1.0 - 1e-4,
    1.0 - 1e-6,
    1.0 - 1e-9,
    1.0,
    1.0 + 1e-9,
    1.0 + 1e-6,
    1.0 + 1e-4,
    1.0 + 1e-3,
    1.02,
    1.5,
    4.0,
    10.0,
    100.0,
    1000.0,
];

/// No drag, less than the closed form resolves, on both sides of the limit of its series, and a drag
/// that stops the ship at once.
const DRAGS: [f64; 9] = [0.0, 1e-12, 1e-6, 1.0, 999.0, 1_000.0, 1_001.0, 1e5, 1e8];

const STATES: [(f64, f64); 5] = [(1.0, 0.0), (0.0, 1.0), (-2.0, 7.0), (300.0, -40.0), (0.0, 0.0)];

/// A body to check, with its largest rate (1/s).
struct Case<B> {
    name: String,
    body: B,
    rate: f64,
}

fn springs() -> impl Iterator<Item = Case<Spring>> {
    DAMPING_RATIOS.into_iter().map(|zeta| {
        let body = spring(zeta);
        let omega = body.angular_frequency();
        let rate = omega * zeta.max(1.0) * 2.0;
        Case { name: format!("spring with damping ratio {zeta:e}"), body, rate }
    })
}

fn ships() -> impl Iterator<Item = Case<Ship>> {
    DRAGS.into_iter().flat_map(|drag| {
        [1.0, 0.0, -0.3].map(|throttle| {
            let body = Ship { throttle, ..ship(drag) };
            let rate = (drag / body.mass).max(1.0);
            Case { name: format!("ship with drag {drag:e}, throttle {throttle}"), body, rate }
        })
    })
}

/// Strides in units of the fastest time scale; backwards only as far as rounding allows.
const STRIDES: [f64; 15] =
    [-2.0, -0.3, -0.01, -1e-6, 0.0, 1e-9, 1e-3, 0.03, 0.0316228, 0.1, 0.7, 3.0, 20.0, 500.0, 4e4];

fn flow<B: Body<Vector = f64>>(body: &B, dt: f64, from: &State<f64>) -> State<f64> {
    let state = body.exact(dt, from).expect("a closed form");
    assert!(state.q.is_finite() && state.v.is_finite(), "{state:?} after {dt} s");
    state
}

/// The derivative of the flow at `dt`, by central differences of order 8.
fn derivative<B: Body<Vector = f64>>(case: &Case<B>, dt: f64, from: &State<f64>) -> State<f64> {
    let step = 0.05 / case.rate;
    let weights = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
    let mut sum = State { q: 0.0, v: 0.0 };
    for (weight, n) in weights.into_iter().zip(1..) {
        let ahead = flow(&case.body, dt + step * f64::from(n), from);
        let behind = flow(&case.body, dt - step * f64::from(n), from);
        sum.q += weight * (ahead.q - behind.q);
        sum.v += weight * (ahead.v - behind.v);
    }
    State { q: sum.q / step, v: sum.v / step }
}

/// Asserts that the defect of the flow in its equation is within `bound`, relative to the motion. Returns the
/// largest defect as a fraction of that.
fn equation_defect<B: Body<Vector = f64>>(case: &Case<B>, bound: f64) -> f64 {
    let mut worst: f64 = 0.0;
    for (q, v) in STATES {
        let from = State { q, v };
        for stride in STRIDES {
            let dt = stride / case.rate;
            let there = flow(&case.body, dt, &from);
            let change = derivative(case, dt, &from);
            let mut a = f64::NAN;
            case.body.acceleration(dt, &there.q, &there.v, &mut a);
            // Rounding of dt shifts a state by rate·ε·dt, so the bound grows with dt.
            let resolution = bound * case.rate * (1.0 + 1e-3 * dt.abs() * case.rate);
            let mut compare = |name: &str, found: f64, wanted: f64, scale: f64| {
                let error = (found - wanted).abs();
                if error > 0.0 {
                    worst = worst.max(error / (resolution * scale));
                }
                assert!(
                    error <= resolution * scale,
                    "{}: {name}′ = {found}, the equation says {wanted}, {dt} s after {from:?}",
                    case.name,
                );
            };
            let speed = there.v.abs() + a.abs() / case.rate;
            compare("q", change.q, there.v, there.q.abs() + speed / case.rate);
            compare("v", change.v, a, speed + from.v.abs().min(case.rate * there.q.abs()));
        }
    }
    worst
}

/// Asserts that the largest error of all cases, as a fraction of its bound, is a tenth of the bound or more.
fn assert_tight<B>(cases: impl Iterator<Item = Case<B>>, error: impl Fn(&Case<B>) -> f64) {
    let worst = cases.map(|case| error(&case)).fold(0.0, f64::max);
    assert!((0.1..=1.0).contains(&worst), "the largest error is {worst} of its bound");
}

#[test]
fn the_flow_of_springs_satisfies_their_equation() {
    assert_tight(springs(), |case| equation_defect(case, 3e-12));
}

#[test]
fn the_flow_of_ships_satisfies_their_equation() {
    assert_tight(ships(), |case| equation_defect(case, 3e-13));
}

fn is_the_identity_over_no_time<B: Body<Vector = f64>>(case: &Case<B>) {
    for (q, v) in STATES {
        let from = State { q, v };
        assert_eq!(flow(&case.body, 0.0, &from), from, "{}", case.name);
    }
}

#[test]
fn a_flow_over_no_time_is_the_identity() {
    springs().for_each(|case| is_the_identity_over_no_time(&case));
    ships().for_each(|case| is_the_identity_over_no_time(&case));
}

/// Asserts that a flow over two strides is the flow over their sum, within `bound`, relative to the motion.
/// Returns the largest difference as a fraction of that.
fn composition_defect<B: Body<Vector = f64>>(case: &Case<B>, bound: f64) -> f64 {
    let mut worst: f64 = 0.0;
    for (q, v) in STATES {
        let from = State { q, v };
        for first in STRIDES {
            // Backwards in time, round-off grows as fast as the motion decays forwards.
            for second in STRIDES.into_iter().filter(|&second| second > -1.0 || first < 3.0) {
                let (a, b) = (first / case.rate, second / case.rate);
                let between = flow(&case.body, a, &from);
                let twice = flow(&case.body, b, &between);
                let once = flow(&case.body, a + b, &from);
                let size = |s: &State<f64>| s.q.abs() + s.v.abs() / case.rate;
                let largest = size(&from).max(size(&between)).max(size(&once));
                let push = case.body.exact(a, &State { q: 0.0, v: 0.0 }).unwrap();
                let tolerance = bound
                    * (1.0 + (a.abs() + b.abs()) * case.rate * 1e-2)
                    * (largest + size(&push))
                    * (-second.min(0.0)).exp();
                let difference = State { q: twice.q - once.q, v: twice.v - once.v };
                if tolerance > 0.0 {
                    worst = worst.max(size(&difference) / tolerance);
                }
                assert!(
                    size(&difference) <= tolerance,
                    "{}: {once:?} after {a} + {b} s, {twice:?} after {a} s and {b} s",
                    case.name,
                );
            }
        }
    }
    worst
}

#[test]
fn a_flow_over_two_strides_is_the_flow_over_their_sum() {
    assert_tight(springs(), |case| composition_defect(case, 1e-13));
    assert_tight(ships(), |case| composition_defect(case, 3e-14));
}

/// As drag goes to 0 the flow converges linearly to the flow without drag: the difference per unit of
/// drag is the same at any small drag, until round-off dominates.
fn converges_as_drag_vanishes<B: Body<Vector = f64>>(with_drag: impl Fn(f64) -> B, dt: f64) {
    let from = State { q: 0.4, v: 1.3 };
    let free = flow(&with_drag(0.0), dt, &from);
    let slope = |drag: f64| {
        let state = flow(&with_drag(drag), dt, &from);
        ((state.q - free.q) / drag, (state.v - free.v) / drag)
    };
    let (q, v) = slope(1e-5);
    assert!(q.abs() > 1e-7 && v.abs() > 1e-7, "drag has no effect: {q}, {v}");
    for drag in [1e-4, 1e-6, 1e-7, 1e-8] {
        let near = |found: f64, wanted: f64| (found / wanted - 1.0).abs() < 1e-3;
        let (q_there, v_there) = slope(drag);
        assert!(near(q_there, q) && near(v_there, v), "{q_there}, {v_there} at a drag of {drag}");
    }
    for drag in [1e-16, 1e-100, f64::MIN_POSITIVE] {
        let state = flow(&with_drag(drag), dt, &from);
        let near = |found: f64, wanted: f64| (found - wanted).abs() <= 1e-13 * wanted.abs();
        assert!(near(state.q, free.q) && near(state.v, free.v), "{state:?} at a drag of {drag}");
    }
}

#[test]
fn without_drag_the_flow_is_the_limit_of_flows_with_drag() {
    for dt in [-1.7, 0.01, 2.3, 9.1] {
        converges_as_drag_vanishes(|damping| Spring { damping, ..spring(0.0) }, dt);
        converges_as_drag_vanishes(|drag| Ship { mass: 1.0, thrust: 2.0, ..ship(drag) }, dt);
    }
}

#[test]
fn without_drag_the_flows_are_the_textbook_formulas() {
    let from = State { q: 0.4, v: 1.3 };
    for dt in [-1.7f64, 0.01, 2.3, 9.1] {
        let coasting = flow(&ship(0.0), dt, &from);
        assert!((coasting.q - (0.4 + 1.3 * dt + dt * dt)).abs() < 1e-13 * (1.0 + dt * dt));
        assert!((coasting.v - (1.3 + 2.0 * dt)).abs() < 1e-14 * (1.0 + dt.abs()));
        let swinging = flow(&spring(0.0), dt, &from);
        let (sin, cos) = (libm::sin(3.0 * dt), libm::cos(3.0 * dt));
        assert!((swinging.q - (0.4 * cos + 1.3 / 3.0 * sin)).abs() < 1e-14);
        assert!((swinging.v - (1.3 * cos - 0.4 * 3.0 * sin)).abs() < 1e-14);
    }
}

#[test]
fn the_chapters_ship_has_the_speeds_of_table_7_1() {
    let printed = [
        (6.5, 9.559084465),
        (7.0, 10.068293924),
        (7.5, 10.552668945),
        (8.0, 11.013420718),
        (8.5, 11.451701361),
    ];
    for (t, v) in printed {
        let found = flow(&CHAPTER_SHIP, t, &CHAPTER_SHIP.start()).v;
        assert!((found - v).abs() <= 0.51e-9, "{found} at {t} s, printed {v}");
    }
}

#[test]
fn the_chapters_ship_is_at_55_4829864_m_after_8_5_s() {
    let found = flow(&CHAPTER_SHIP, 8.5, &CHAPTER_SHIP.start()).q;
    assert!((found - 55.4829864).abs() <= 0.51e-7, "{found}");
}

#[test]
fn a_strongly_damped_spring_has_an_accurate_velocity() {
    // After the fast part has decayed, v = -slow x, with slow = ω² / (α + w), about ω / 2ζ.
    for zeta in [10.0, 1e3, 1e5] {
        let body = spring(zeta);
        let (omega, alpha) = (3.0, 3.0 * zeta);
        let slow = omega * omega / (alpha + (alpha * alpha - omega * omega).sqrt());
        let later = flow(&body, 60.0 / alpha, &State { q: 1.0, v: 5.0 });
        let error = (later.v / (-slow * later.q) - 1.0).abs();
        assert!(error < 1e-13, "off by {error:e} at damping ratio {zeta}");
    }
}
