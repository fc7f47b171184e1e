//! Each card reproduces its engine.

use regatta::conformance::problems::fresh;
use regatta::sim::State;

use super::log::{Log, Row};

/// How far a state is from a row, in units of the scale.
fn off(found: Row, row: Row, scale: [f64; 2]) -> f64 {
    let parts = [(found.x - row.x) / scale[0], (found.v - row.v) / scale[1]];
    let worst = |most: f64, part: f64| if part.is_nan() { f64::NAN } else { most.max(part.abs()) };
    parts.into_iter().fold(0.0, worst)
}

#[test]
fn the_card_of_an_engine_reproduces_the_log_of_a_run() {
    let mut wrong = Vec::new();
    for log in Log::all() {
        let (scale, [_, most]) = (log.scale(), log.tolerances());
        let run = log.run().unwrap();
        let offs = run.iter().zip(&log.rows).map(|(found, row)| off(*found, *row, scale));
        let worst =
            offs.fold(0.0_f64, |most, off| if off.is_nan() || off > most { off } else { most });
        if worst.is_nan() || worst > most {
            wrong.push(format!("{}: {worst:.1e}, not {most:.0e}", log.file));
        }
    }
    assert!(wrong.is_empty(), "{} logs:\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn the_card_of_an_engine_reproduces_each_logged_tick() {
    let (mut wrong, mut compared) = (Vec::new(), 0);
    // The velocity added by Avian's motor is in no log.
    for log in Log::all().iter().filter(|log| log.method().restart.is_none()) {
        let (scale, [most, _]) = (log.scale(), log.tolerances());
        let mut worst = 0.0_f64;
        for pair in log.rows.windows(2).filter(|pair| pair[1].tick == pair[0].tick + 1) {
            let [from, to] = [pair[0], pair[1]];
            let mut state = State { q: from.x, v: from.v };
            let (body, mut stepper) = (log.body.problem(), fresh(log.method()));
            let t = from.tick as f64 * log.tick_s;
            stepper.steps(&body, t, log.tick_s, log.substeps, &mut state).unwrap();
            let off = off(Row { tick: to.tick, x: state.q, v: state.v }, to, scale);
            worst = if off.is_nan() || off > worst { off } else { worst };
            compared += 1;
        }
        if worst.is_nan() || worst > most {
            wrong.push(format!("{}: {worst:.1e}, not {most:.0e}", log.file));
        }
    }
    assert!(compared > 1000, "{compared} ticks");
    assert!(wrong.is_empty(), "{} logs:\n{}", wrong.len(), wrong.join("\n"));
}
