//! The claims of the engines' cards, measured both ways.

use std::collections::HashSet;
use std::f64::consts::TAU;

use regatta::conformance::problems::fresh;
use regatta::sim::bodies::{BODIES, Body as _, Kind, Net, Range, incompatibility, kind};
use regatta::sim::integrators::{METHODS, Method, StepFailure, method};
use regatta::sim::{BodyClass, Solver, State};

use super::log::{Body, Log};

fn engines() -> impl Iterator<Item = &'static Method> {
    METHODS.iter().filter(|method| method.is_engine())
}

/// A held force is a spring of user code, and so is any spring where there is no joint: in pybullet's multibody.
fn spring_of(method: &Method, spring: [f64; 2]) -> Body {
    Body { spring, drag: 0.0, push: 0.0, is_held: !method.has_joint() }
}

fn has_spring(method: &Method) -> bool {
    method.engine.expect("an engine").damping_ratio.is_some()
}

/// The state after `ticks` ticks of `h`.
fn after(method: &Method, body: &Body, h: f64, ticks: u32, from: [f64; 2]) -> State<f64> {
    let mut state = State { q: from[0], v: from[1] };
    let (body, mut engine) = (body.problem(), fresh(method));
    for tick in 0..ticks {
        engine.steps(&body, f64::from(tick) * h, h, method.default_substeps, &mut state).unwrap();
    }
    state
}

/// The order of the error after 1 s, from 256 and 512 ticks, against the exact state.
fn order(method: &Method, body: &Body, from: [f64; 2], exact: [f64; 2]) -> f64 {
    let error = |ticks: u32| {
        let State { q, v } = after(method, body, 1.0 / f64::from(ticks), ticks, from);
        (q - exact[0]).abs().max((v - exact[1]).abs())
    };
    (error(256) / error(512)).log2()
}

/// The exact state of a damped oscillator after 1 s from (1, 0).
fn oscillator(omega: f64, alpha: f64) -> [f64; 2] {
    let turned = (omega * omega - alpha * alpha).sqrt();
    let (sin, cos, decay) = (turned.sin(), turned.cos(), (-alpha).exp());
    [decay * (cos + alpha / turned * sin), -decay * omega * omega / turned * sin]
}

#[test]
fn an_engine_has_the_order_of_its_card_with_and_without_drag() {
    for method in engines() {
        let undamped = spring_of(method, [4.0, 0.0]);
        let straight = order(method, &undamped, [1.0, 0.0], oscillator(2.0, 0.0));
        let damped = spring_of(method, [4.0, 1.0]);
        let with_drag = order(method, &damped, [1.0, 0.0], oscillator(2.0, 0.5));
        for (found, claimed) in [(straight, method.order), (with_drag, method.order_with_drag)] {
            // An error that does not shrink may grow, as the damping of Bullet's older spring fades with the tick.
            let least = if claimed == 0 { -0.2 } else { f64::from(claimed) - 0.05 };
            let is_near = (least..f64::from(claimed) + 0.05).contains(&found);
            assert!(is_near, "{}: {found}, not {claimed}", method.id);
        }
    }
}

/// The map of a tick, whose columns are the states after a tick from (1, 0) and from (0, 1).
fn map(method: &Method, body: &Body, h: f64) -> [[f64; 2]; 2] {
    let [x, v] = [[1.0, 0.0], [0.0, 1.0]].map(|from| after(method, body, h, 1, from));
    [[x.q, v.q], [x.v, v.v]]
}

/// The damping ratio of a map whose eigenvalues are a pair.
fn damping_ratio(map: [[f64; 2]; 2]) -> f64 {
    let determinant = map[0][0] * map[1][1] - map[0][1] * map[1][0];
    let real = (map[0][0] + map[1][1]) / 2.0;
    let turned = (determinant - real * real).sqrt().atan2(real);
    let decay = -determinant.ln() / 2.0;
    decay / decay.hypot(turned)
}

#[test]
fn an_engine_damps_a_1_hz_spring_as_its_card_states() {
    for method in engines().filter(|method| has_spring(method)) {
        let engine = method.engine.unwrap();
        let body = spring_of(method, [TAU * TAU, 0.0]);
        let h = 1.0 / f64::from(engine.tick_hz);
        let found = if method.restart.is_none() {
            damping_ratio(map(method, &body, h))
        } else {
            // It has a memory: from the mean amplitudes of two periods that are 10 s apart.
            let mean = |second: u32| {
                let ticks = second * engine.tick_hz..(second + 1) * engine.tick_hz;
                let amplitude = |tick| {
                    let State { q, v } = after(method, &body, h, tick, [1.0, 0.0]);
                    (q * q + v * v / (TAU * TAU)).sqrt()
                };
                ticks.map(amplitude).sum::<f64>()
            };
            (mean(2) / mean(12)).ln() / (10.0 * TAU)
        };
        let claimed = engine.damping_ratio.unwrap();
        assert!((found - claimed).abs() < 1e-5, "{}: {found:.6}, not {claimed}", method.id);
    }
}

/// Whether an undamped spring stays within bounds for long.
fn is_bounded(method: &Method, z: f64) -> bool {
    let body = spring_of(method, [z * z, 0.0]).problem();
    let mut state = State { q: 1.0, v: 0.01 };
    let mut engine = fresh(method);
    (0..200_000).all(|_| {
        engine.steps(&body, 0.0, 1.0, method.default_substeps, &mut state).unwrap();
        state.q.abs() < 1e3 && state.v.abs() < 1e3 * z.max(1.0)
    })
}

#[test]
fn an_engine_is_stable_up_to_the_limit_on_its_card() {
    for method in engines() {
        match method.stability_limit {
            Some(limit) => {
                let below = limit == 0.0 || is_bounded(method, limit - 0.01);
                assert!(below && !is_bounded(method, limit + 0.02), "{}: {limit}", method.id);
            }
            None => {
                for z in [0.1, 0.5, 1.0, 1.9, 2.1, 3.0, 7.0, 50.0, 1e3] {
                    assert!(is_bounded(method, z), "{}: {z}", method.id);
                }
            }
        }
    }
}

#[test]
fn an_engine_with_logs_has_their_date() {
    let logs = Log::all();
    for method in engines() {
        let logged = method.engine.unwrap().logged;
        let has_logs = logs.iter().any(|log| log.method() == method);
        assert_eq!(logged.is_some(), has_logs, "{}", method.id);
        let is_day = |day: &str| {
            let parts: Vec<&str> = day.split('-').collect();
            parts.iter().map(|part| part.len()).eq([4, 2, 2])
                && parts.iter().all(|part| part.parse::<u32>().is_ok())
        };
        assert!(logged.is_none_or(is_day), "{}: {logged:?}", method.id);
        let engine = method.engine.unwrap();
        let said = engine.checked_against().unwrap_or_default();
        let parts = [Some(engine.version), logged];
        assert!(parts.into_iter().flatten().all(|part| said.contains(part)), "{said}");
        assert_eq!(said.is_empty(), method.holds_force(), "{}: {said}", method.id);
        assert_eq!(said.starts_with("held against version"), has_logs, "{}: {said}", method.id);
    }
}

#[test]
fn mujoco_resets_a_runaway_to_the_origin_at_rest() {
    for id in ["engine-mujoco", "engine-mujoco-rk4"] {
        let method = method(id).unwrap();
        // Four substeps on a force held through all of them gain energy.
        let body = Body { spring: [987.0, 0.0], drag: 0.0, push: 0.0, is_held: true }.problem();
        let mut state = State { q: 1.0, v: 0.0 };
        let mut engine = fresh(method);
        let mut largest = 0.0_f64;
        for _ in 0..2000 {
            engine.steps(&body, 0.0, 1.0 / 60.0, 4, &mut state).unwrap();
            largest = largest.max(state.q.abs());
        }
        assert!(largest > 1e7 && largest < 1e11, "{id}: {largest:e}");
        assert_eq!((state.q, state.v), (0.0, 0.0), "{id}");
    }
}

/// The determinant of a map.
fn area(map: [[f64; 2]; 2]) -> f64 {
    map[0][0] * map[1][1] - map[0][1] * map[1][0]
}

#[test]
fn an_engine_keeps_area_as_its_card_states_and_none_is_reversible() {
    // The velocity added by a motor appears a tick later.
    for method in engines().filter(|method| method.restart.is_none()) {
        let body = spring_of(method, [4.0, 0.0]);
        let change = (area(map(method, &body, 0.1)) - 1.0).abs();
        let keeps = change < 1e-13;
        assert!(keeps || change > 1e-7, "{}: {change:e}", method.id);
        assert_eq!(keeps, method.symplectic, "{}: {change:e}", method.id);
        let there = after(method, &body, 0.1, 1, [1.0, 0.5]);
        let back = after(method, &body, -0.1, 1, [there.q, there.v]);
        let off = (back.q - 1.0).abs().max((back.v - 0.5).abs());
        assert!(!method.reversible && off > 1e-9, "{}: {off:e}", method.id);
    }
}

/// The evaluations of 10 ticks of a body that is pushed.
fn evaluations(method: &Method, substeps: u32) -> u64 {
    let body = Body { spring: [0.0; 2], drag: 0.1, push: 1.0, is_held: false };
    let counted = body.problem();
    let mut state = State { q: 0.0, v: 0.0 };
    let mut engine = fresh(method);
    for tick in 0..10 {
        engine.steps(&counted, f64::from(tick), 1.0, substeps, &mut state).unwrap();
    }
    counted.evaluations()
}

#[test]
fn an_engine_tick_costs_the_evaluations_on_its_card() {
    for method in engines() {
        for substeps in [1, 4, 7] {
            let claimed = method.evaluations_per_tick(substeps).unwrap();
            let has_substeps = method.engine.unwrap().has_substeps();
            assert_eq!(claimed, if has_substeps { 1 } else { substeps }, "{}", method.id);
            assert_eq!(evaluations(method, substeps), 10 * u64::from(claimed), "{}", method.id);
        }
    }
    assert_eq!(method("rk4").unwrap().evaluations_per_tick(3), Some(12));
    assert_eq!(method("adaptive-euler").unwrap().evaluations_per_tick(3), None);
}

#[test]
fn a_held_spring_force_is_bounded_only_with_one_substep() {
    let held = method("held-force").unwrap();
    let is_bounded = |z: f64, substeps: u32| {
        let body = spring_of(held, [z * z, 0.0]).problem();
        let mut state = State { q: 1.0, v: 0.01 };
        let mut engine = fresh(held);
        for tick in 0..200_000 {
            engine.steps(&body, f64::from(tick), 1.0, substeps, &mut state).unwrap();
        }
        state.q.is_finite() && state.q.abs() < 1e3
    };
    assert!(is_bounded(0.1, 1) && is_bounded(1.99, 1) && !is_bounded(2.02, 1));
    for substeps in [2, 4, 64] {
        assert!([0.02, 0.5, 1.0].iter().all(|z| !is_bounded(*z, substeps)), "{substeps}");
    }
}

#[test]
fn each_body_unknown_to_engines_has_its_own_reason() {
    let box2d = method("engine-box2d").unwrap();
    let steps = |method: &Method, kind: &Kind| method.incompatibility(kind.class).is_none();
    let mut reasons = Vec::new();
    // A map of a free spin is on the card of an engine, not of a body.
    for kind in BODIES.iter().filter(|kind| kind.class != BodyClass::Spin) {
        assert_eq!(steps(box2d, kind), kind.class.engine_refusal().is_none(), "{}", kind.id);
        let Some(reason) = kind.class.engine_refusal() else { continue };
        reasons.push(reason);
        let values: Vec<f64> = kind.parameters.iter().map(|p| p.default.unwrap_or(1.0)).collect();
        for method in engines() {
            let expected = (!steps(method, kind)).then_some(reason);
            assert_eq!(
                incompatibility(method, kind, &values),
                expected,
                "{} {}",
                method.id,
                kind.id
            );
        }
    }
    reasons.extend(Net::CLASS.engine_refusal());
    let distinct: HashSet<_> = reasons.iter().collect();
    assert_eq!((reasons.len(), distinct.len()), (4, 4), "{reasons:?}");
    // A reason of the engine's own stays.
    let spring = kind("spring").unwrap();
    let said = incompatibility(method("engine-pybullet").unwrap(), spring, &[1.0; 6]).unwrap();
    assert!(said.contains("no joint with a spring"), "{said}");
}

#[test]
fn a_method_steps_exactly_the_bodies_it_does_not_refuse() {
    for kind in BODIES.iter() {
        let mut values = kind.plain_values();
        if kind.parameters.iter().any(|parameter| matches!(parameter.range, Range::Curve { .. })) {
            // The last value is the x of the only point.
            values.push(1.0);
        }
        for method in METHODS {
            let mut body = (kind.build)(&values, Solver::Method(method));
            let refused = incompatibility(method, kind, &values);
            let expected = refused.map_or(Ok(()), |reason| Err(StepFailure::Refused { reason }));
            assert_eq!(body.advance(0.0, 1e-3, 1), expected, "{} {}", method.id, kind.id);
        }
    }
}
