//! Amplitudes, swings and the long run of true motions.

use super::*;
use crate::scene::Scene;
use crate::slices::block_on;

fn of_first_body(scene: &Scene, seconds: f64) -> BodyTruth {
    block_on(BodyTruth::find(&scene.bodies[0], &[], 1.0, seconds, Arc::default()))
}

fn truth(text: &str, seconds: f64) -> BodyTruth {
    let text = format!("title = \"t\"\ntick_hz = 60\nseconds = {seconds}\n{text}");
    let scene = Scene::parse("t", &text).unwrap();
    of_first_body(&scene, seconds)
}

#[test]
fn amplitudes_do_not_depend_on_the_ratio_of_period_and_horizon() {
    let omega = std::f64::consts::TAU;
    for seconds in [1.0, 20.0, 511.0, 512.0, 1024.0] {
        let spring = format!("[[spring]]\nmass_kg = 1\nstiffness_n_per_m = {}\n", omega * omega);
        let [q, v] = truth(&spring, seconds).amplitudes[..] else { panic!("one coordinate") };
        assert!((q - 1.0).abs() < 1e-4 && (v / omega - 1.0).abs() < 1e-4, "{seconds} s: {q}, {v}");
    }
    // There are 512 periods and a half in 20 s.
    let fast =
        "[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 25872.6957612\nx0_m = 0\nv0_m_per_s = 10\n";
    let [q, v] = truth(fast, 20.0).amplitudes[..] else { panic!("one coordinate") };
    let omega = 25_872.695_761_2_f64.sqrt();
    assert!((q * omega / 10.0 - 1.0).abs() < 1e-4 && (v / 10.0 - 1.0).abs() < 1e-4, "{q}, {v}");
    // The motion decays within a hundredth of the horizon, so the velocity's range is that of its first swing.
    let damped = "[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 10000\ndamping_n_s_per_m = 100\n";
    let [q, v] = truth(damped, 60.0).amplitudes[..] else { panic!("one coordinate") };
    let dense = (0..200_000).map(|i| f64::from(i) * 5e-7).map(|t| {
        let w = 7500.0_f64.sqrt();
        let decay = libm::exp(-50.0 * t);
        let x = decay * (libm::cos(w * t) + 50.0 / w * libm::sin(w * t));
        (x, -decay * 10_000.0 / w * libm::sin(w * t))
    });
    let (mut x, mut y) = ((1.0_f64, 1.0_f64), (0.0_f64, 0.0_f64));
    for (q, v) in dense {
        x = (x.0.min(q), x.1.max(q));
        y = (y.0.min(v), y.1.max(v));
    }
    let (expected_q, expected_v) = ((x.1 - x.0) / 2.0, (y.1 - y.0) / 2.0);
    assert!((q / expected_q - 1.0).abs() < 1e-3, "{q}, not {expected_q}");
    assert!((v / expected_v - 1.0).abs() < 1e-3, "{v}, not {expected_v}");
}

#[test]
fn an_eccentric_orbit_keeps_the_peak_of_its_speed() {
    // The eccentricity is 0.998, so that the body is 2000 times faster near the centre than far from it.
    let orbit = "[[orbit]]\nmu_m3_per_s2 = 1000\nx0_m = 100\nvy0_m_per_s = 0.1414213562373095\n";
    let truth = truth(orbit, 200.0);
    let fastest = truth.amplitudes[3];
    assert!((fastest / 70.78 - 1.0).abs() < 0.01, "{fastest}");
}

#[test]
fn a_pendulum_swings_at_the_period_of_its_amplitude() {
    let truth = truth("[[pendulum]]\nlength_m = 0.4\ntheta0_rad = 0.7\n", 20.0);
    let swing = truth.swing.unwrap();
    let n = swing.crossings.len() - 1;
    let period = (swing.crossings[n] - swing.crossings[0]) / n as f64;
    // The period is 2π √(l/g) (1 + θ²/16 + 11 θ⁴/3072 + 173 θ⁶/737280).
    let series =
        1.0 + 0.49 / 16.0 + 11.0 * 0.49_f64.powi(2) / 3072.0 + 173.0 * 0.49_f64.powi(3) / 737_280.0;
    let expected = std::f64::consts::TAU * (0.4_f64 / 9.81).sqrt() * series;
    assert!((period / expected - 1.0).abs() < 1e-5, "{period}, not {expected}");
    let whole = &swing.half_turns[..swing.half_turns.len() - 1];
    assert_eq!(whole.len(), 2 * swing.crossings.len() + 1, "from rest at the right: {whole:?}");
    assert!(whole.iter().all(|peak| (peak - 1.0).abs() < 1e-3), "{whole:?}");
}

#[test]
fn the_long_run_has_the_reach_of_its_reference() {
    for name in ["helm", "quarter-car"] {
        let scene = Scene::built_in(name).unwrap();
        let truth = of_first_body(&scene, 2.0);
        let [close, exact] = [close_solver(), Solver::Truth]
            .map(|solver| block_on(truth.long_run(solver, 2000)).ok().unwrap());
        let n = close.means.len();
        for i in 0..n {
            let off = (close.means[i] - exact.means[i]).abs() / truth.amplitudes[i];
            assert!(off < 1e-6, "{name}: mean {i} is off by {off}");
        }
        let ranges = close.reach.ranges.0.iter().zip(&exact.reach.ranges.0);
        for (i, (close, exact)) in ranges.enumerate() {
            let off = (close.0 - exact.0).abs().max((close.1 - exact.1).abs());
            assert!(off < 1e-3 * truth.amplitudes[i], "{name}: range {i} is off by {off}");
        }
    }
}

#[test]
fn half_turns_are_compared_one_by_one_and_missing_ones_count_as_rest() {
    let turns = 50;
    let decaying = |rate: f64, count: usize| -> Vec<f64> {
        (0..count).map(|i| libm::exp(-rate * i as f64)).collect()
    };
    let swing = |half_turns: Vec<f64>| Swing {
        passages: Vec::new(),
        coordinate: 0,
        crossings: (0..=turns).map(f64::from).collect(),
        half_turns,
    };
    for (truth, lane, is_as_wide) in [
        (decaying(0.1, 100), decaying(0.1, 100), true),
        (decaying(0.1, 100), decaying(0.11, 100), true),
        (decaying(0.1, 100), decaying(0.12, 100), false),
        (decaying(0.1, 100), decaying(0.08, 100), false),
        // The number of half turns may differ by one per cent, plus those at the ends.
        (decaying(0.0, 100), decaying(0.0, 98), true),
        (decaying(0.0, 98), decaying(0.0, 100), true),
        (decaying(0.0, 100), decaying(0.0, 90), false),
        (decaying(0.0, 90), decaying(0.0, 100), false),
        (decaying(0.1, 100), decaying(0.1, 40), true),
        (decaying(0.1, 40), decaying(0.1, 100), true),
        (decaying(0.0, 4), Vec::new(), false),
    ] {
        let found = swing(truth.clone()).is_as_wide(&lane, 0);
        assert_eq!(found, is_as_wide, "{truth:?}\n{lane:?}");
        // The limit is relative to the widest half turn, so that it does not depend on the unit.
        let thrice = |half_turns: Vec<f64>| half_turns.into_iter().map(|x| 3.0 * x).collect();
        let lane: Vec<f64> = thrice(lane);
        assert_eq!(swing(thrice(truth)).is_as_wide(&lane, 0), is_as_wide, "{lane:?}");
    }
    let narrow_first = [vec![0.9], decaying(0.0, 9)].concat();
    for (first, is_as_wide) in [(0, false), (1, true)] {
        assert_eq!(swing(decaying(0.0, 10)).is_as_wide(&narrow_first, first), is_as_wide);
    }
}
