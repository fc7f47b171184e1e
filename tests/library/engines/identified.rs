//! The engine that made a log is found by its motion alone.

use regatta::table::TableOptions;
use regatta::tools::identify::{
    Candidate, Conclusion, Identification, Log as Text, LoggedBody, SpringForm, identify,
};
use regatta::tools::port::{Setup, setups};

use super::log::{Log, Row};
use crate::dice::Dice;
use crate::port::run;

/// The identification of a log written as text, whose body is known.
fn identified(log: &Log, rows: &[Row], has_velocity: bool) -> Identification {
    let body = LoggedBody {
        spring: Some(log.body.spring),
        drag: log.body.drag,
        push: log.body.push,
        ..LoggedBody::default()
    };
    identified_by(&body, log, rows, has_velocity)
}

/// The identification of a log written as text.
fn identified_by(body: &LoggedBody, log: &Log, rows: &[Row], has_velocity: bool) -> Identification {
    let mut text = String::from(if has_velocity { "tick,x,v\n" } else { "tick,x\n" });
    for Row { tick, x, v } in rows {
        match has_velocity {
            true => text += &format!("{tick},{x:e},{v:e}\n"),
            false => text += &format!("{tick},{x:e}\n"),
        }
    }
    let tick_hz = (1.0 / log.tick_s).round();
    let text = Text::parse(&log.file, &text, &TableOptions::default(), tick_hz).unwrap();
    identify(&text, body, tick_hz).unwrap_or_else(|| panic!("{}: nothing runs", log.file))
}

/// Whether the log's engine with its substeps is named, or is among those that do the same.
fn names(found: &Identification, log: &Log) -> bool {
    let all = [found.best.unwrap().candidate].into_iter().chain(found.also.iter().copied());
    let mut all = all.filter(|candidate| candidate.substeps == log.substeps);
    match &*log.engine {
        "mujoco-Euler-actuator" => {
            all.any(|candidate| candidate.spring_label() == Some("actuator-euler"))
        }
        "havok-limit" => all.any(|candidate| candidate.spring_label() == Some("limit")),
        _ => all.any(|candidate| candidate.method == log.method()),
    }
}

#[test]
fn a_log_of_every_mode_of_every_engine_is_identified_at_three_settings() {
    let settings =
        [(60.0, None, [40.0, 1.2]), (30.0, Some(3), [218.0, 15.2]), (144.0, Some(2), [900.0, 6.0])];
    for (tick_hz, substeps, spring) in settings {
        let all = setups(None, tick_hz, substeps);
        assert!(all.len() > 20, "{} modes", all.len());
        for (index, setup) in all.iter().copied().enumerate() {
            // Modes that move a spring alike make the same log.
            let is_alike = |other: &Setup| {
                let is_explicit = [other, &setup].map(|setup| setup.mode.is_explicit);
                other.method == setup.method && is_explicit[0] == is_explicit[1]
            };
            if all[..index].iter().any(is_alike) {
                continue;
            }
            let rows = run(&setup, spring, [1.0, -0.5], 24).into_iter().enumerate();
            let rows: String = rows.map(|(tick, [x, v])| format!("{tick},{x:e},{v:e}\n")).collect();
            let columns = TableOptions::default();
            let text = Text::parse("log", &format!("tick,x,v\n{rows}"), &columns, tick_hz);
            let body = LoggedBody { spring: Some(spring), ..LoggedBody::default() };
            let found = identify(&text.unwrap(), &body, tick_hz).unwrap();
            let Setup { method, mode, substeps, .. } = setup;
            let is_it = |candidate: &Candidate| {
                let is_told = match candidate.spring {
                    SpringForm::Joint(told) => told.is_explicit == mode.is_explicit,
                    SpringForm::HeldForce => method.holds_force(),
                    SpringForm::Acceleration => false,
                };
                is_told && candidate.method == method && candidate.substeps == substeps
            };
            let is_named =
                [&found.best.unwrap().candidate].into_iter().chain(&found.also).any(is_it);
            assert!(
                is_named && found.conclusion == Conclusion::Identified,
                "{} ×{substeps}, {} at {tick_hz} Hz: {} {}",
                method.id,
                mode.id,
                found.conclusion.id(),
                found.best.unwrap().candidate,
            );
        }
    }
}

fn springs_and_coasting() -> Vec<Log> {
    let mut logs = Log::all();
    logs.retain(|log| ["spring", "damp"].contains(&&*log.scenario));
    assert!(logs.len() > 100, "{} logs", logs.len());
    logs
}

#[test]
fn every_log_of_a_spring_and_of_a_coasting_body_is_identified() {
    let mut wrong = Vec::new();
    for log in springs_and_coasting() {
        let found = identified(&log, &log.rows, true);
        if found.conclusion != Conclusion::Identified || !names(&found, &log) {
            let rival = found.runner_up.map(|other| (other.candidate.to_string(), other.residual));
            wrong.push(format!(
                "{}: {}: {} {:.1e}, {rival:?}",
                log.file,
                found.conclusion.id(),
                found.best.unwrap().candidate,
                found.best.unwrap().residual,
            ));
        }
    }
    assert!(wrong.is_empty(), "{}:\n{}", wrong.len(), wrong.join("\n"));
}

/// A number of the normal distribution.
fn normal(dice: &mut Dice) -> f64 {
    let (part, angle) = (dice.part(), dice.between(0.0, std::f64::consts::TAU));
    (-2.0 * (1.0 - part).ln()).sqrt() * angle.cos()
}

/// How often noise is added to each log, if `REGATTA_NOISES` says it.
fn noises() -> Option<u64> {
    std::env::var("REGATTA_NOISES").ok().and_then(|count| count.parse().ok())
}

#[test]
fn slight_noise_leaves_nearly_all_logs_identified_and_none_wrong() {
    let mut dice = Dice::new(1);
    // Unless more is asked for, every fourth log has it once.
    let (noises, every) = noises().map_or((1, 4), |noises| (noises, 1));
    let (mut right, mut wrong, mut all) = (0, Vec::new(), 0);
    for log in springs_and_coasting().into_iter().step_by(every) {
        let mut missed = Vec::new();
        for again in 0..noises {
            let rows = with_noise(&log, 1e-4, &mut dice);
            let found = identified(&log, &rows, true);
            all += 1;
            match (found.conclusion, names(&found, &log)) {
                (Conclusion::Identified, true) => right += 1,
                (Conclusion::Identified, false) => {
                    wrong.push(format!(
                        "{}, run {again}: {}",
                        log.file,
                        found.best.unwrap().candidate
                    ));
                }
                (word, _) => {
                    let rival = found.runner_up.map(|other| other.candidate.to_string());
                    let [word, best] =
                        [word.id().to_owned(), found.best.unwrap().candidate.to_string()];
                    missed.push(format!("{word}: {best}, {}", rival.unwrap_or_default()));
                }
            }
        }
        if let Some(first) = missed.first() {
            println!("{}: {} of {noises} not told, {first}", log.file, missed.len());
        }
    }
    println!("{right} of {all}");
    assert!(wrong.is_empty(), "{}:\n{}", wrong.len(), wrong.join("\n"));
    // These logs have a fifth of the rows that the engines wrote: with all of them it is 95 %.
    assert!(right * 100 >= all * 92, "{right} of {all}");
}

#[test]
fn an_unknown_spring_is_fitted_and_leaves_the_engine_open() {
    let logs = springs_and_coasting();
    let log = logs.iter().find(|log| log.file == "jolt__spring_1hz_z02_60hz.csv").unwrap();
    let found = identified_by(&LoggedBody::default(), log, &log.rows, true);
    assert_eq!(found.conclusion, Conclusion::CannotTell, "{}", found.best.unwrap().candidate);
    let seen = found.effective.unwrap();
    assert!((seen.frequency_hz().unwrap() - 0.9565).abs() < 1e-3, "{seen:?}");
    assert!((seen.damping_ratio().unwrap() - 0.249).abs() < 1e-3, "{seen:?}");
}

#[test]
fn a_spring_whose_tick_is_not_linear_is_found_without_its_numbers() {
    for damping in ["005", "01"] {
        let mut log = log_of(&format!("bullet-6dof__spring_k40_d{damping}_60hz.csv"));
        // The engine's own log is thinned: all rows of its card.
        log.rows = (0..300).map(|tick| Row { tick, ..log.rows[0] }).collect();
        log.rows = log.run().unwrap();
        let found = identified_by(&LoggedBody::default(), &log, &log.rows, true);
        let best = found.best.unwrap();
        assert!(found.conclusion == Conclusion::Identified && names(&found, &log), "{damping}");
        assert!(best.residual < 1e-6, "{damping}: {}", best.residual);
    }
}

#[test]
fn a_motion_of_no_known_method_is_unknown() {
    let logs = springs_and_coasting();
    let mut log =
        logs.iter().find(|log| log.file == "box2d__spring_1hz_z0_60hz.csv").unwrap().clone();
    for row in &mut log.rows {
        // Friction by hand: a motion that dies along a line.
        let left = (1.0 - row.tick as f64 / 700.0).max(0.0);
        let turned = std::f64::consts::TAU * row.tick as f64 / 60.0;
        (row.x, row.v) = (left * turned.cos(), -left * std::f64::consts::TAU * turned.sin());
    }
    assert_eq!(identified(&log, &log.rows, true).conclusion, Conclusion::Unknown);
}

#[test]
fn a_double_precision_log_needs_a_match_within_its_rounding() {
    // Velocity Verlet between two halves of an implicit drag: the exponential is off by parts in a million.
    let motion = |c: f64, kept: f64| {
        let (h, mut x, mut v) = (1.0 / 60.0, 1.0_f64, 0.0_f64);
        let mut text = String::from("tick,x,v\n0,1,0\n");
        for tick in 1..=240 {
            v *= kept;
            v -= h / 2.0 * 40.0 * x;
            x += h * v;
            v -= h / 2.0 * 40.0 * x;
            v *= kept;
            text += &format!("{tick},{x:e},{v:e}\n");
        }
        let text = Text::parse("log", &text, &TableOptions::default(), 60.0).unwrap();
        let body = LoggedBody { spring: Some([40.0, c]), ..LoggedBody::default() };
        identify(&text, &body, 60.0).unwrap()
    };
    for c in [0.5, 1.0, 2.0] {
        let quarter = c / 60.0 / 4.0;
        let implicit = motion(c, (1.0 - quarter) / (1.0 + quarter));
        assert_eq!(
            implicit.conclusion,
            Conclusion::Unknown,
            "{c}: {}",
            implicit.best.unwrap().candidate
        );
        let exact = motion(c, libm::exp(-2.0 * quarter));
        assert_eq!(
            exact.conclusion,
            Conclusion::Identified,
            "{c}: {}",
            exact.best.unwrap().candidate
        );
        assert_eq!(exact.best.unwrap().candidate.method.id, "verlet-exact-drag", "{c}");
    }
}

#[test]
fn positions_alone_leave_the_order_of_kick_and_drift_open() {
    let logs = springs_and_coasting();
    let log = logs.iter().find(|log| log.file == "chipmunk__spring_1hz_z0_60hz.csv").unwrap();
    let with_velocities = identified(log, &log.rows, true);
    assert_eq!(with_velocities.conclusion, Conclusion::Identified);
    assert_eq!(with_velocities.best.unwrap().candidate.method.id, "engine-chipmunk");
    let found = identified(log, &log.rows, false);
    let ids: Vec<&str> = [found.best.unwrap().candidate]
        .into_iter()
        .chain(found.also)
        .map(|candidate| candidate.method.id)
        .collect();
    assert!(ids.contains(&"engine-chipmunk") && ids.contains(&"engine-bullet"), "{ids:?}");
}

#[test]
fn an_unusual_count_of_substeps_is_found_in_a_log_without_noise() {
    let logs = springs_and_coasting();
    for (file, substeps) in [
        ("jolt__spring_1hz_z02_60hz.csv", 7),
        ("bullet__spring_1hz_z02_60hz.csv", 12),
        ("box2d__damp_05_60hz.csv", 10),
    ] {
        let mut log = logs.iter().find(|log| log.file == file).unwrap().clone();
        (log.substeps, log.tick_s) = (substeps, 1.0 / 60.0);
        log.rows = log.run().unwrap();
        let found = identified(&log, &log.rows, true);
        assert_eq!(
            found.conclusion,
            Conclusion::Identified,
            "{file}: {}",
            found.best.unwrap().candidate
        );
        assert!(names(&found, &log), "{file}: {}", found.best.unwrap().candidate);
    }
}

/// A log with noise of this part of its largest values.
fn with_noise(log: &Log, part: f64, dice: &mut Dice) -> Vec<Row> {
    let scale = log.scale();
    let noisy = |row: &Row| Row {
        tick: row.tick,
        x: row.x + part * scale[0] * normal(dice),
        v: row.v + part * scale[1] * normal(dice),
    };
    log.rows.iter().map(noisy).collect()
}

fn log_of(file: &str) -> Log {
    springs_and_coasting().into_iter().find(|log| log.file == file).expect("a log")
}

#[test]
fn noise_above_the_start_of_a_runaway_identifies_no_other_engine() {
    let log = log_of("mujoco-Euler__spring_w100_z0_30hz.csv");
    let mut dice = Dice::new(3);
    for _ in 0..30 {
        let found = identified(&log, &with_noise(&log, 1e-4, &mut dice), true);
        let is_right = found.conclusion != Conclusion::Identified || names(&found, &log);
        assert!(is_right, "{}", found.best.unwrap().candidate);
    }
}

#[test]
fn a_small_correlated_residual_is_no_fit() {
    let mut log = log_of("box2d__spring_1hz_z0_60hz.csv");
    (log.substeps, log.body.spring) = (32, [0.4, 0.0]);
    log.tick_s = 1.0 / 60.0;
    for (index, row) in log.rows.iter_mut().enumerate() {
        row.tick = index as u64;
    }
    log.rows = log.run().unwrap();
    let found = identified(&log, &log.rows, true);
    assert_ne!(found.conclusion, Conclusion::Identified, "{}", found.best.unwrap().candidate);
}

#[test]
fn the_visible_motion_is_measured_below_the_speed_limit() {
    let mut log = log_of("box2d__spring_1hz_z0_60hz.csv");
    log.body.is_held = true;
    log.body.spring = [(10.0 * std::f64::consts::PI).powi(2), 0.0];
    log.tick_s = 1.0 / 60.0;
    log.rows = log.run().unwrap();
    let found = identified(&log, &log.rows, true);
    assert_eq!(found.conclusion, Conclusion::Identified);
    assert!(
        names(&found, &log) && found.best.unwrap().candidate.is_held(),
        "{}",
        found.best.unwrap().candidate
    );
    let doubles = -found.effective.unwrap().energy_halves_s().unwrap();
    assert!((doubles - 0.118).abs() < 1e-3, "{doubles}");
}

#[test]
fn a_short_coasting_log_identifies_no_method() {
    let mut log = log_of("box2d__damp_05_60hz.csv");
    log.rows.truncate(8);
    let rows = with_noise(&log, 1e-4, &mut Dice::new(2));
    let found = identified(&log, &rows, true);
    assert_ne!(found.conclusion, Conclusion::Identified, "{}", found.best.unwrap().candidate);
}
