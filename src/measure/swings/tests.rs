use std::sync::Arc;

use super::*;
use crate::judged_run::{MAX_WORK, Until, follow};
use crate::pace::Pace;
use crate::scene::{LaneSpec, Scene};
use crate::sim::integrators::method;
use crate::slices::block_on;
use crate::truth::BodyTruth;

/// Returns the swings of a pendulum of 0.4 m under a method at this rate.
fn swings(head: &str, id: &str, tick_hz: u32, substeps: u32) -> Swings {
    let text =
        format!("title = 't'\ntick_hz = 60\nseconds = 20\n[[pendulum]]\nlength_m = 0.4\n{head}");
    let scene = Scene::parse("t", &text).unwrap();
    let spec = LaneSpec { substeps, ..LaneSpec::plain(method(id).unwrap()) };
    let body = &scene.bodies[0];
    let truth = block_on(BodyTruth::find(body, &[], 1.0, scene.seconds, Arc::default()));
    let run =
        block_on(follow(&truth, Pace { spec, tick_hz: tick_hz.into() }, Until::Swings, MAX_WORK));
    run.swings.expect("it swings")
}

#[test]
fn peaks_are_found_between_coarse_steps_and_between_the_first_two() {
    // The motion starts at 0.7 rad, or below with the same energy: g/l (1 - cos 0.7) = ω²/2 + g/l (1 - cos θ).
    let pushed = |theta: f64| (2.0 * 9.81 / 0.4 * (libm::cos(theta) - libm::cos(0.7))).sqrt();
    for (theta, omega) in
        [(0.7, 0.0), (0.65, pushed(0.65)), (-0.6, -pushed(-0.6)), (0.1, pushed(0.1))]
    {
        let head = format!("theta0_rad = {theta}\nomega0_rad_per_s = {omega}\n");
        for (id, tick_hz, substeps) in [
            ("gauss-legendre-4", 5, 1),
            ("rk4", 4, 4),
            ("pefrl", 3, 3),
            ("dormand-prince-54", 3, 1),
        ] {
            let found = swings(&head, id, tick_hz, substeps);
            // The start cuts off the first half turn.
            let whole = &found.half_turns[1..found.half_turns.len() - 1];
            // There are 15.3 turns of 1.31 s with an amplitude of 0.7.
            assert!((29..=32).contains(&whole.len()), "{id}, {head}: {whole:?}");
            let off = whole.iter().map(|peak| (peak - 1.0).abs()).fold(0.0, f64::max);
            assert!(off < 0.02, "{id}, {head}: off by {off}");
        }
    }
}

#[test]
fn the_velocities_of_semi_implicit_euler_are_shifted_to_its_coordinates() {
    // The initial amplitude of this method is off by ω h/2 of the velocity, and does not change later.
    let found = swings("theta0_rad = 0.05\n", "semi-implicit-euler", 15, 1);
    let whole = &found.half_turns[1..found.half_turns.len() - 1];
    let z = (9.81_f64 / 0.4).sqrt() / 15.0;
    let wanted = 1.0 / (1.0 - z * z / 4.0).sqrt();
    assert!(whole.iter().all(|peak| (peak / wanted - 1.0).abs() < 1e-3), "{wanted}: {whole:?}");
}

#[test]
fn crossings_between_coarse_ticks_keep_the_period() {
    let found = swings("theta0_rad = 0.7\n", "dormand-prince-54", 3, 1);
    let turns = found.crossings.len() - 1;
    let period = (found.crossings[turns] - found.crossings[0]) / turns as f64;
    // The period is 2π √(l/g) (1 + θ²/16 + 11 θ⁴/3072).
    let series = 1.0 + 0.49 / 16.0 + 11.0 * 0.49_f64.powi(2) / 3072.0;
    let wanted = std::f64::consts::TAU * (0.4_f64 / 9.81).sqrt() * series;
    assert!((period / wanted - 1.0).abs() < 1e-3, "{period}, not {wanted}");
}
