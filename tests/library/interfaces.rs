//! The springs of interfaces move and rest as their libraries do, which were run.

use regatta::conformance::problems::{Problem, fresh, problem};
use regatta::sim::integrators::{Family, METHODS, Method, method};
use regatta::sim::{Query, State, System};

/// A spring that pulls to a target.
#[derive(Clone, Copy)]
struct Pull {
    /// K and c, per unit of mass.
    spring: [f64; 2],
    target: f64,
}

impl System for Pull {
    type Vector = f64;

    fn acceleration(&self, _t: f64, x: &f64, v: &f64, a: &mut f64) {
        *a = self.spring[0] * (self.target - x) - self.spring[1] * v;
    }

    fn query(&self, _t: f64, query: Query<'_, f64>) -> bool {
        let Query::Engine { settings, force, .. } = query else { return false };
        [settings.stiffness, settings.damping] = self.spring;
        *force = self.spring[0] * self.target;
        true
    }
}

fn pull(spring: [f64; 2], target: f64) -> Problem<f64> {
    problem(Pull { spring, target })
}

/// The positions after each frame from 0, thrown at this speed, until the target is shown.
fn run(method: &Method, spring: [f64; 2], target: f64, speed: f64, fps: f64) -> Vec<f64> {
    let (body, mut stepper) = (pull(spring, target), fresh(method));
    let mut state = State { q: 0.0, v: speed };
    let mut shown = vec![0.0];
    while state != (State { q: target, v: 0.0 }) && shown.len() < 1000 {
        let t = shown.len() as f64 / fps;
        stepper.step(&body, t, 1.0 / fps, &mut state).unwrap();
        shown.push(state.q);
    }
    shown
}

/// The method of a dialect, K and c of its values, the way of the logged run, and the largest error.
fn of_dialect(id: &str, values: &[f64]) -> Option<(&'static str, [f64; 2], f64, f64)> {
    let (id, per_s, way, most) = match id {
        "react-spring" => ("react-spring", 1.0, 1.0, 0.0),
        "qt" => ("qt-spring", 0.016, 100.0, 0.0),
        "reanimated" => ("reanimated", 1.0, 1.0, 1e-14),
        _ => return None,
    };
    let [mass, stiffness, damping] = match id {
        "qt-spring" => [values[2], values[0], values[1]],
        _ => [values[0], values[1], values[2]],
    };
    // The values of another mass are divided by it, and have other last bits.
    let most = if mass == 1.0 { most } else { 1e-14 };
    Some((id, [stiffness, damping].map(|x| x / mass / per_s), way, most))
}

#[test]
fn an_interfaces_spring_moves_and_rests_as_its_library_to_the_last_bit() {
    let text = std::fs::read_to_string("tests/data/ui-springs/runs.csv").unwrap();
    let (mut runs, mut frames_held) = (0, 0);
    for line in text.lines().filter(|line| !line.starts_with('#')).skip(1) {
        let [id, values, fps, end, frames] = line.split(',').collect::<Vec<_>>()[..] else {
            panic!("{line}");
        };
        let values: Vec<f64> = values.split(' ').map(|value| value.parse().unwrap()).collect();
        let Some((id, spring, way, most)) = of_dialect(id, &values) else { continue };
        let shown = run(method(id).unwrap(), spring, way, 0.0, fps.parse().unwrap());
        for (frame, x) in frames.split(' ').filter_map(|frame| frame.split_once(':')) {
            let (frame, x): (usize, f64) = (frame.parse().unwrap(), x.parse().unwrap());
            // The precision of some runs in Qt was higher.
            let Some(found) = shown.get(frame) else { continue };
            let apart = (found / way - x).abs();
            assert!(apart <= most || way == *found, "{id} {values:?} {fps}, {frame}: {apart:e}");
            frames_held += 1;
        }
        assert!(end.is_empty() || end == (shown.len() - 1).to_string(), "{id} {values:?} {fps}");
        runs += 1;
    }
    assert!(runs == 18 && frames_held > 200, "{runs} {frames_held}");
    // Qt's own end, of a way of 100.
    let qt = run(method("qt-spring").unwrap(), [125.0, 12.5], 100.0, 0.0, 62.5);
    assert_eq!(qt.len(), 101);
}

#[test]
fn reanimated_keeps_a_throw_to_the_target_and_drops_one_away() {
    let reanimated = method("reanimated").unwrap();
    let thrown = |speed| run(reanimated, [100.0, 10.0], 1.0, speed, 60.0);
    assert_eq!(thrown(-3.0), thrown(0.0));
    let toward = thrown(5.0);
    // Of a run at that speed.
    for (frame, x) in [(1, 0.089_522_754_371_941_68), (30, 1.030_619_356_228_776_9)] {
        assert!((toward[frame] - x).abs() < 1e-14, "{}", toward[frame]);
    }
    assert_eq!(toward.len() - 1, 115);
}

#[test]
fn frames_of_another_length_show_the_same_clock() {
    let half = |id: &str, fps: f64| run(method(id).unwrap(), [170.0, 26.0], 1.0, 0.0, fps);
    // Two frames of Qt at 125 a second are one at 62.5.
    let (fine, coarse) = (half("qt-spring", 125.0), half("qt-spring", 62.5));
    assert!(fine.iter().skip(2).step_by(2).eq(coarse.iter().skip(1)));
    // react-spring has 17 steps in its first frame, then at 120 frames a second 9 and at most 64.
    let [slow, fast, slowest] = [60.0, 120.0, 2.0].map(|fps| half("react-spring", fps));
    assert!(slow[1] == fast[1] && slow[1] == slowest[1] && fast[2] < slow[2]);
    assert_eq!(half("react-spring", 1.0), slowest);
}

#[test]
fn a_kick_is_a_new_start_and_none_moves_a_body_without_a_spring() {
    for card in METHODS.iter().filter(|card| card.family == Family::Interface) {
        let (body, mut stepper) = (pull([170.0, 26.0], 1.0), fresh(card));
        let mut state = State { q: 0.0, v: 0.0 };
        for frame in 0..10 {
            stepper.step(&body, f64::from(frame) / 60.0, 1.0 / 60.0, &mut state).unwrap();
        }
        assert_eq!(body.evaluations(), 10, "{}", card.id);
        state.v += 2.0;
        let mut other = (state, fresh(card));
        for (state, stepper) in [(&mut state, &mut stepper), (&mut other.0, &mut other.1)] {
            stepper.step(&body, 0.0, 1.0 / 60.0, state).unwrap();
        }
        assert_eq!(state, other.0, "{}", card.id);
        let none = pull([0.0, 1.0], 0.0);
        let refused = fresh(card).step(&none, 0.0, 1.0 / 60.0, &mut state).unwrap_err();
        assert!(refused.to_string().contains("only a spring with a stiffness"), "{refused}");
    }
}
