//! The listing with adaptive steps, both as printed and as intended.

use std::fmt::Write;

use super::{exactly, scene};
use crate::sim::bodies::{Body, Ship};
use crate::sim::integrators::{AdaptiveEuler, AdaptiveEulerAsPrinted, Integrator, Tolerance};
use crate::sim::number::significant;
use crate::sim::{Counted, State};

/// The tolerances of the speed in the chapter, in m/s.
const TOLERANCES: [f64; 3] = [1e-2, 1e-3, 1e-4];
const TICKS: u32 = 17;

/// Returns the results of both listings side by side.
pub(super) fn listings() -> String {
    let scene = scene("ship");
    let h = scene.tick_hz.step_s();
    let asked = h * f64::from(TICKS);
    let ship = Ship::BLANK.with_parameters(&scene.bodies[0].values);
    let truth = exactly(&scene, asked, scene.tick_hz).last().map_or(0.0, |end| end.v);
    let mut text = format!(
        "Adaptive Euler, {TICKS} ticks of {h} s: {asked} s are asked for, the speed is then {truth:.6} m/s\n\n\
         {:>9}  {:^32}  {:^50}\n\
         {:>9}  {:>12}  {:>7}  {:>9}  {:>11}  {:>14}  {:>8}  {:>11}\n",
        "",
        "as printed",
        "corrected",
        "tolerance",
        "simulated",
        "v (m/s)",
        "error",
        "v (m/s)",
        "error",
        "substeps",
        "evaluations",
    );
    for tolerance in TOLERANCES {
        let allowed = Tolerance { absolute_q: f64::INFINITY, absolute_v: tolerance, relative: 0.0 };
        let mut printed = AdaptiveEulerAsPrinted::with_tolerance(&0.0, allowed);
        let (slow, _) = run(&mut printed, &ship, h);
        let simulated = asked - Integrator::<Counted<Ship>>::lost_time(&printed);
        let mut corrected = AdaptiveEuler::with_tolerance(&0.0, allowed);
        let (right, evaluations) = run(&mut corrected, &ship, h);
        let percent = |v: f64| format!("{} %", significant(100.0 * (v - truth) / truth, 3));
        let _ = writeln!(
            text,
            "{tolerance:>9}  {simulated:>10.4} s  {:>7.5}  {:>9}  {:>11.8}  {:>14}  {:>8}  {evaluations:>11}",
            slow.v,
            percent(slow.v),
            right.v,
            percent(right.v),
            corrected.attempts().0,
        );
    }
    let lines = text.lines().map(|line| format!("{}\n", line.trim_end()));
    lines.collect::<String>()
        + "\n  As printed a step that is cut short is never made up for: the ship sails in slow motion.\n"
}

/// Steps the ship through all ticks. Returns its final state, and the number of evaluations.
fn run(integrator: &mut dyn Integrator<Counted<Ship>>, ship: &Ship, h: f64) -> (State<f64>, u64) {
    let system = Counted::new(ship.clone());
    let mut state = ship.start();
    for tick in 0..TICKS {
        integrator
            .step(&system, h * f64::from(tick), h, &mut state)
            .expect("the ship is gentle enough for every tolerance of the table");
    }
    (state, system.evaluations())
}
