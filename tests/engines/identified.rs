//! The engine that made a log is found by its motion alone.

use regatta::lab::{Columns, Identification, Log as Text, LoggedBody, Word, identify};

use crate::log::{Log, Row};

/// What is read of a log as a person would write it.
fn identified(log: &Log, rows: &[Row], has_velocity: bool) -> Identification {
    let mut text = String::from(if has_velocity { "tick,x,v\n" } else { "tick,x\n" });
    for Row { tick, x, v } in rows {
        match has_velocity {
            true => text += &format!("{tick},{x:e},{v:e}\n"),
            false => text += &format!("{tick},{x:e}\n"),
        }
    }
    let tick_hz = (1.0 / log.tick_s).round();
    let text = Text::parse(&log.file, &text, &Columns::default(), tick_hz).unwrap();
    let body =
        LoggedBody { spring: Some(log.body.spring), drag: log.body.drag, push: log.body.push };
    identify(&text, &body, tick_hz).unwrap_or_else(|| panic!("{}: nothing runs", log.file))
}

/// Whether the log's engine with its substeps is named, or is among those that do the same.
fn names(found: &Identification, log: &Log) -> bool {
    let all = [found.best.candidate].into_iter().chain(found.also.iter().copied());
    // Position iterations of PhysX do not change one joint.
    let counts = log.method().id != "engine-physx";
    all.into_iter().any(|candidate| {
        candidate.method == log.method() && (!counts || candidate.substeps == log.substeps)
    })
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
        if found.word != Word::Identified || !names(&found, &log) {
            let rival = found.runner_up.map(|other| (other.candidate.to_string(), other.residual));
            wrong.push(format!(
                "{}: {}: {} {:.1e}, {rival:?}",
                log.file,
                found.word.id(),
                found.best.candidate,
                found.best.residual,
            ));
        }
    }
    assert!(wrong.is_empty(), "{}:\n{}", wrong.len(), wrong.join("\n"));
}

/// Numbers of a normal distribution, from a seed.
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        let mut uniform = || {
            self.0 ^= self.0 << 13;
            self.0 ^= self.0 >> 7;
            self.0 ^= self.0 << 17;
            (self.0 >> 11) as f64 / (1_u64 << 53) as f64
        };
        let (a, b) = (uniform(), uniform());
        (-2.0 * (1.0 - a).ln()).sqrt() * (std::f64::consts::TAU * b).cos()
    }
}

#[test]
fn noise_of_a_ten_thousandth_leaves_nearly_all_logs_identified_and_none_wrong() {
    let seeds: u64 = std::env::var("SEEDS").map_or(2, |seeds| seeds.parse().unwrap());
    let (mut right, mut wrong, mut all) = (0, Vec::new(), 0);
    for (place, log) in springs_and_coasting().iter().enumerate() {
        let scale = log.scale();
        let mut missed = 0;
        for seed in 0..seeds {
            let mut noise = Noise(0x9E37_79B9_7F4A_7C15 ^ (1 + seed + 1000 * place as u64));
            (0..10).for_each(|_| _ = noise.next());
            let noisy = |row: &Row| Row {
                tick: row.tick,
                x: row.x + 1e-4 * scale[0] * noise.next(),
                v: row.v + 1e-4 * scale[1] * noise.next(),
            };
            let rows: Vec<Row> = log.rows.iter().map(noisy).collect();
            let found = identified(log, &rows, true);
            all += 1;
            match (found.word, names(&found, log)) {
                (Word::Identified, true) => right += 1,
                (Word::Identified, false) => {
                    wrong.push(format!("{} seed {seed}: {}", log.file, found.best.candidate));
                }
                _ => missed += 1,
            }
        }
        if missed > 0 {
            println!("{}: {missed} of {seeds} not told", log.file);
        }
    }
    println!("{right} of {all}");
    assert!(wrong.is_empty(), "{}:\n{}", wrong.len(), wrong.join("\n"));
    assert!(right * 100 >= all * 95, "{right} of {all}");
}
