//! The listing with adaptive steps, both as printed and as intended.

use std::fmt::Write;

use serde::Serialize;

use super::{exactly, scene};
use crate::sim::bodies::{Body, Ship};
use crate::sim::integrators::{AdaptiveEuler, AdaptiveEulerAsPrinted, Integrator, Tolerance};
use crate::sim::number::significant;
use crate::sim::{Counted, State};

/// The tolerances of the speed in the chapter, in m/s.
const TOLERANCES: [f64; 3] = [1e-2, 1e-3, 1e-4];
const TICKS: u32 = 17;

/// The results of both listings side by side.
pub(super) struct Listings {
    pub(super) rows: Vec<ListingRow>,
    /// Length of a tick, the time asked for (s), and the true speed then (m/s).
    h: f64,
    asked_s: f64,
    exact: f64,
}

/// The results at one tolerance. Errors are of the speed.
#[derive(Serialize)]
pub(super) struct ListingRow {
    tolerance_m_per_s: f64,
    printed_simulated_s: f64,
    printed_m_per_s: f64,
    printed_error_percent: f64,
    corrected_m_per_s: f64,
    corrected_error_percent: f64,
    substeps: u64,
    evaluations: u64,
}

/// Runs both listings at each tolerance.
pub(super) fn listings() -> Listings {
    let scene = scene("ship");
    let h = scene.tick_hz.step_s();
    let asked_s = h * f64::from(TICKS);
    let ship = Ship::BLANK.with_parameters(&scene.bodies[0].values);
    let exact = exactly(&scene, asked_s, scene.tick_hz).last().map_or(0.0, |end| end.v);
    let percent = |v: f64| 100.0 * (v - exact) / exact;
    let row = |tolerance| {
        let allowed = Tolerance { absolute_q: f64::INFINITY, absolute_v: tolerance, relative: 0.0 };
        let mut printed = AdaptiveEulerAsPrinted::with_tolerance(&0.0, allowed);
        let (slow, _) = run(&mut printed, &ship, h);
        let mut corrected = AdaptiveEuler::with_tolerance(&0.0, allowed);
        let (right, evaluations) = run(&mut corrected, &ship, h);
        ListingRow {
            tolerance_m_per_s: tolerance,
            printed_simulated_s: asked_s - Integrator::<Counted<Ship>>::lost_time(&printed),
            printed_m_per_s: slow.v,
            printed_error_percent: percent(slow.v),
            corrected_m_per_s: right.v,
            corrected_error_percent: percent(right.v),
            substeps: corrected.attempts().0,
            evaluations,
        }
    };
    Listings { rows: TOLERANCES.map(row).into(), h, asked_s, exact }
}

impl Listings {
    pub(super) fn text(&self) -> String {
        let Self { rows, h, asked_s, exact } = self;
        let mut text = format!(
            "Adaptive Euler, {TICKS} ticks of {h} s: {asked_s} s are asked for, the speed is then {exact:.6} m/s\n\n\
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
        let percent = |error: f64| format!("{} %", significant(error, 3));
        for row in rows {
            let _ = writeln!(
                text,
                "{:>9}  {:>10.4} s  {:>7.5}  {:>9}  {:>11.8}  {:>14}  {:>8}  {:>11}",
                row.tolerance_m_per_s,
                row.printed_simulated_s,
                row.printed_m_per_s,
                percent(row.printed_error_percent),
                row.corrected_m_per_s,
                percent(row.corrected_error_percent),
                row.substeps,
                row.evaluations,
            );
        }
        let lines = text.lines().map(|line| format!("{}\n", line.trim_end()));
        lines.collect::<String>()
            + "\n  As printed a step that is cut short is never made up for: the ship sails in slow motion.\n"
    }
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
