//! Advice on *looks right* and on reserves, against peaks and errors found by another program or derived here.

use regatta::measure::{Adviser, CRITERIA};
use regatta::scene::Scene;
use regatta::sim::Solver;

use crate::dice::Dice;
use crate::judging::{LOOKS_RIGHT, run, scene, spec};

/// The substeps with which a method looks right, as advice has it.
fn substeps_that_look_right(adviser: &Adviser, id: &str) -> Option<u32> {
    adviser.meets(spec(id), CRITERIA[LOOKS_RIGHT]).met().map(|met| met.substeps)
}

const FOUR: [&str; 4] = ["semi-implicit-euler", "position-verlet", "midpoint", "implicit-midpoint"];

/// Each found by another program, from the closed form of the spring and the curve through the states, which has the
/// eigenvalues of the step.
#[test]
fn a_peak_within_the_first_tick_and_coarse_ticks_cost_no_substeps() {
    for (tick_hz, seconds, body, wanted) in [
        (14, 10.0, [1.0, 100.0, 0.2, 1.0, 3.5], [2, 2, 4, 3]),
        (18, 20.0, [0.10401, 14.5561, 0.010939, -1.628, -6.816], [2, 2, 4, 2]),
        (4, 10.0, [1.819, 99.983, 0.49197, 0.963, 11.108], [9, 5, 8, 6]),
        (25, 20.0, [0.14863, 160.576, 0.14009, -1.914, 52.289], [7, 4, 6, 4]),
        (2, 20.0, [1.709, 8.5376, 0.014361, 1.912, 3.756], [6, 3, 6, 4]),
    ] {
        let [m, k, c, x0, v0] = body;
        let spring = format!(
            "[[spring]]\nmass_kg = {m}\nstiffness_n_per_m = {k}\ndamping_n_s_per_m = {c}\nx0_m = {x0}\n\
             v0_m_per_s = {v0}"
        );
        let adviser = Adviser::new(&scene(seconds, &spring), tick_hz);
        let found = FOUR.map(|id| substeps_that_look_right(&adviser, id));
        assert_eq!(found, wanted.map(Some), "at {tick_hz} Hz: {spring}");
    }
    // Its first peak is within the first tick: between the steps Runge-Kutta 4 misses it by 1.8 % of the widest.
    let spring = "[[spring]]\nmass_kg = 1.2222\nstiffness_n_per_m = 21.0676\ndamping_n_s_per_m = 0.18888\n\
                  x0_m = -1.628\nv0_m_per_s = -2.392";
    let adviser = Adviser::new(&scene(20.0, spring), 6);
    assert_eq!(substeps_that_look_right(&adviser, "rk4"), Some(1));
    let pendulum = "[[pendulum]]\nlength_m = 1.0\ntheta0_rad = 0.5\nomega0_rad_per_s = 0.55";
    let adviser = Adviser::new(&scene(20.0, pendulum), 4);
    let found = FOUR.map(|id| substeps_that_look_right(&adviser, id));
    assert_eq!(found, [2, 2, 5, 3].map(Some));
}

/// The distances from rest at which a coordinate turns back, from the states after steps, each by the parabola through
/// three of them.
fn turning_points(x: &[f64]) -> Vec<f64> {
    let turns = x.windows(3).filter(|x| (x[1] - x[0]) * (x[2] - x[1]) < 0.0);
    let tops = turns.map(|x| x[1] - (x[2] - x[0]).powi(2) / (8.0 * (x[0] - 2.0 * x[1] + x[2])));
    tops.map(f64::abs).collect()
}

#[test]
fn a_random_damped_spring_that_looks_right_turns_back_where_the_truth_does() {
    let mut dice = Dice::new(60_03);
    let mut narrow = 0;
    for round in 0..40 {
        let omega = dice.between(3.0, 15.0);
        let ratio = libm::exp10(dice.between(-3.3, -1.4));
        let id = FOUR[round % 2];
        let tick_hz = (omega / dice.between(0.3, 2.0)).round().max(1.0) as u32;
        // It begins on its way in, so that each of its peaks is one of the method's, too.
        let [x0, v0] = [dice.between(0.5, 1.5), -omega * dice.between(0.5, 1.5)];
        let spring = format!(
            "[[spring]]\nmass_kg = 1\nstiffness_n_per_m = {}\ndamping_n_s_per_m = {}\nx0_m = {x0}\n\
             v0_m_per_s = {v0}",
            omega * omega,
            2.0 * ratio * omega,
        );
        let scene = scene(10.0, &spring);
        let adviser = Adviser::new(&scene, tick_hz);
        let told = substeps_that_look_right(&adviser, id).expect("some substeps do");
        let x = |solver, hz: u32| turning_points(&run(&scene, solver, hz, 10.0, |it| it.q()[0]));
        let exact = x(Solver::Truth, 4000);
        let widest = exact.iter().copied().fold(x0, f64::max);
        let off = |substeps: u32| {
            let pairs = x(spec(id).solver(), substeps * tick_hz).into_iter().zip(&exact);
            pairs.map(|(own, exact)| (own - exact).abs() / widest).fold(0.0, f64::max)
        };
        assert!(
            off(told) < 0.0515,
            "{id} ×{told} at {tick_hz} Hz is off by {}: {spring}",
            off(told)
        );
        // One fewer is too wide or too narrow, or too fast: by z²/24, and by a drag that is that of an older velocity.
        if told > 1 {
            let z = omega / f64::from((told - 1) * tick_hz);
            let is_fast = z >= 2.0 || 2.0 * libm::asin(z / 2.0) / z - 1.0 + ratio * z > 0.0099;
            assert!(is_fast || off(told - 1) > 0.0485, "{id} ×{told} at {tick_hz} Hz: {spring}");
            narrow += u32::from(!is_fast);
        }
    }
    assert!(narrow > 3, "{narrow} are refused for their width");
}

#[test]
fn the_reserve_of_a_barely_accurate_orbit_follows_from_its_errors() {
    // By its own steps against a reference of order 8 at 1, 1.05, 1.1, 1.2, 1.3 and 1.5 times mu, in percent: 0.94, 0.70,
    // 0.66, 0.55, 0.54, 0.59 for velocity Verlet, and 0.92, 0.65, 0.52, 0.23, 0.38, 1.03 for the midpoint method.
    let orbit = Scene::built_in("orbit").unwrap();
    let adviser = Adviser::new(&orbit, orbit.tick_hz);
    for (id, least, most) in [("velocity-verlet", 1.5, 10.0), ("midpoint", 1.3, 1.5)] {
        let met = adviser.meets(spec(id), CRITERIA[2]).met().unwrap().clone();
        let factor = met.stiffness_factor.unwrap();
        assert!((least..most).contains(&factor), "{id}: {met:?}");
    }
}
