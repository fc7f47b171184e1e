//! Other readings of a log and of the numbers given with it, for a log that no method explains as it stands.

use super::candidates::candidates;
use super::decision::NO_FIT;
use super::fit::{Start, fit};
use super::{Conclusion, Identification, Log, LoggedBody, identify};
use crate::sim::integrators::{Method, method};

/// A residual above this may be that of another reading.
const EXACT: f64 = 1e-9;
/// Largest residual of another reading, as a part of that of the first.
const NEARER: f64 = 0.1;
/// Number of first rows that an engine may log before it steps.
const FIRST_ROWS: usize = 2;
/// The engine whose damping of a spring is that of a motor.
const MOTOR: &str = "engine-bullet-6dof";
/// Damping ratio of a spring of oimophysics without damping.
const OIMO_FLOOR: f64 = 1e-6;

/// A log and a body in another reading.
struct Reading {
    log: Log,
    body: LoggedBody,
    /// How they are read.
    words: String,
    /// Start of the id of the engine that reads them so, or an empty one.
    engine: &'static str,
}

/// Finds the method behind `log`, a motion of `body` of this mass in kilograms, as [`identify`] does. Where no method
/// explains the numbers as they stand, or one does so beyond their rounding, other readings of them are tried. Returns
/// the sentence on the reading that explains them, too.
pub fn identify_reading(
    log: &Log,
    body: &LoggedBody,
    mass: f64,
) -> (Option<Identification>, Option<String>) {
    let mut found = identify(log, body, log.tick_hz());
    let residual = |found: &Identification| found.best.map_or(f64::INFINITY, |it| it.residual);
    let is_known = |found: &&Identification| found.conclusion != Conclusion::Unknown;
    let known = found.as_ref().filter(is_known);
    if known.is_some_and(|it| residual(it) <= EXACT || !log.is_double()) {
        let older = log.with_x_of_the_next_row().filter(|_| known.is_some_and(is_drift_first));
        let other = older.and_then(|log| identify(&log, body, log.tick_hz()));
        if let (Some(other), Some(found)) = (other.filter(|it| is_known(&it)), &mut found) {
            let names = other.best.map(|best| best.candidate).into_iter().chain(other.also);
            let new: Vec<_> = names.filter(|name| !found.also.contains(name)).collect();
            let first = new.first().or(found.also.first());
            let as_that = first.map_or(String::new(), |first| format!(": then as {first}"));
            let words = format!("or x is logged a tick before v{as_that}");
            found.also.extend(new);
            found.rivals.extend(other.rivals);
            return (Some(found.clone()), Some(words));
        }
        return (found, None);
    }
    let most = known.map_or(f64::INFINITY, |it| NEARER * residual(it));
    for Reading { log, body, words, engine } in readings(log, body, mass) {
        if !engine.is_empty() && !may_be_of(engine, &log, &body) {
            continue;
        }
        let Some(other) = identify(&log, &body, log.tick_hz()) else { continue };
        let best = other.best.map(|best| best.candidate);
        let mut names = best.iter().chain(&other.also);
        let is_named = names.any(|name| name.method.id.starts_with(engine));
        if is_known(&&other) && residual(&other) <= most && is_named {
            return (Some(other), Some(words));
        }
    }
    (found, None)
}

/// Whether a method whose id starts so comes near the log. This takes less time than a search of all methods.
fn may_be_of(engine: &str, log: &Log, body: &LoggedBody) -> bool {
    let start = Start { tick_hz: log.tick_hz(), rest: None, seen: None, map: None };
    let is_near =
        |candidate| fit(log, body, candidate, start).is_some_and(|fit| fit.residual() <= NO_FIT);
    candidates(body).into_iter().filter(|it| it.method.id.starts_with(engine)).any(is_near)
}

/// Whether the method moves the body before it changes the velocity.
fn is_drift_first(found: &Identification) -> bool {
    let is = |method: &Method| ["drift-first", "engine-chipmunk"].contains(&method.id);
    found.best.is_some_and(|best| is(best.candidate.method))
}

/// Returns the other readings, the likeliest first.
fn readings(log: &Log, body: &LoggedBody, mass: f64) -> Vec<Reading> {
    let of_body =
        |body: LoggedBody, words: String, engine| Reading { log: log.clone(), body, words, engine };
    let mut all = Vec::new();
    if body.drag > 0.0 && body.drag < 1.0 {
        let drag = -libm::log1p(-body.drag);
        let words = format!(
            "--drag {} is the part lost in a second, as in Bullet, cannon-es and p2-es: a drag of {drag} 1/s",
            body.drag
        );
        all.push(of_body(LoggedBody { drag, ..body.clone() }, words, ""));
    }
    let with = |spring| LoggedBody { spring: Some(spring), ..body.clone() };
    if let Some([k, c]) = body.spring.filter(|[k, _]| *k > 0.0) {
        if mass != 1.0 {
            let words = "--k and --c are per kilogram of the body".to_owned();
            all.push(of_body(with([k * mass, c * mass]), words, ""));
        }
        if c == 0.0 {
            let words = "cannon-es reads a damping of 0 as 1".to_owned();
            all.push(of_body(with([k, 1.0 / mass]), words, "engine-cannon"));
            let words = "oimophysics damps a spring by a ratio of at least 1e-6".to_owned();
            all.push(of_body(with([k, 2.0 * OIMO_FLOOR * k.sqrt()]), words, "engine-oimo"));
        } else {
            let settings = [k * mass, c * mass];
            let modes = method(MOTOR).and_then(|it| it.engine).map_or(&[][..], |it| it.modes);
            all.extend(modes.first().map(|mode| {
                let words =
                    format!("--c {} is the damping of btGeneric6DofSpringConstraint", c * mass);
                of_body(with(mode.joint(settings, mass)), words, MOTOR)
            }));
        }
    }
    let of_log = |log: Log, words: String| Reading { log, body: body.clone(), words, engine: "" };
    all.extend(
        log.with_velocities_per_tick()
            .map(|log| of_log(log, "v is per tick: taken as x a second".into())),
    );
    if log.is_of_one_step() {
        all.extend(log.with_x_of_the_next_row().map(|log| {
            of_log(
                log,
                "x is logged a tick before v: each v goes with the x of the next row".into(),
            )
        }));
    } else {
        let without = (1..=FIRST_ROWS).filter_map(|rows| Some((rows, log.without_first(rows)?)));
        let first = without.into_iter().find(|(_, log)| log.is_of_one_step());
        all.extend(first.map(|(rows, log)| {
            let rows = if rows == 1 { "row".to_owned() } else { format!("{rows} rows") };
            of_log(log, format!("without the first {rows}, after which the steps are alike"))
        }));
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::TableOptions;

    /// A row of a log.
    type Row = [f64; 2];
    const H: f64 = 1.0 / 60.0;

    /// The rows of a spring of k/m 20 and c/m 0.5 under semi-implicit Euler.
    fn spring() -> Vec<Row> {
        let step = |[x, v]: Row| {
            let v = v - H * (20.0 * x + 0.5 * v);
            [x + H * v, v]
        };
        std::iter::successors(Some([1.0, 0.0]), |row| Some(step(*row))).take(90).collect()
    }

    fn found(rows: &[Row], spring: Option<[f64; 2]>, mass: f64) -> (Identification, String) {
        let mut text = String::from("x,v\n");
        rows.iter().for_each(|[x, v]| text += &format!("{x:e},{v:e}\n"));
        let log = Log::parse("log", &text, &TableOptions::default(), 60.0).unwrap();
        let body = LoggedBody { spring, ..LoggedBody::default() };
        let (found, words) = identify_reading(&log, &body, mass);
        (found.unwrap(), words.unwrap_or_default())
    }

    #[test]
    fn numbers_in_another_reading_are_read_so_and_said() {
        let rows = spring();
        let older: Vec<Row> = rows.windows(2).map(|pair| [pair[0][0], pair[1][1]]).collect();
        let late = [&rows[..1], &rows].concat();
        let per_tick: Vec<Row> = rows.iter().map(|[x, v]| [*x, v * H]).collect();
        let plain = Some([20.0, 0.5]);
        for (rows, spring, mass, said) in [
            (&rows, plain, 1.0, ""),
            (&rows, Some([10.0, 0.25]), 2.0, "per kilogram"),
            (&older, plain, 1.0, "x is logged a tick before v"),
            (&late, plain, 1.0, "without the first row"),
            (&per_tick, plain, 1.0, ""),
        ] {
            let (found, words) = found(rows, spring, mass);
            assert_eq!(found.conclusion, Conclusion::Identified, "{said}: {found:?}");
            let names = found.best.map(|best| best.candidate).into_iter().chain(found.also);
            let is_named = names.into_iter().any(|name| name.method.id == "engine-bullet");
            assert!(is_named, "{said}: {:?}", found.best);
            assert!(words.contains(said) && words.is_empty() == said.is_empty(), "{words}");
        }
    }

    #[test]
    fn an_engine_that_reads_no_damping_as_some_is_named_by_it() {
        let step = |[x, v]: Row| {
            let v = v - H * (40.0 * x + v);
            [x + H * v, v]
        };
        let rows = std::iter::successors(Some([1.0, 0.0]), |row| Some(step(*row)));
        let (found, words) = found(&rows.take(90).collect::<Vec<_>>(), Some([40.0, 0.0]), 1.0);
        let names = found.best.map(|best| best.candidate).into_iter().chain(found.also);
        assert!(names.into_iter().any(|name| name.method.id == "engine-cannon"), "{words}");
        assert_eq!(words, "cannon-es reads a damping of 0 as 1");
    }

    #[test]
    fn a_residual_that_a_motion_foretells_is_no_noise() {
        // Implicit Euler of 16 Hz by x alone, whose rest of another method's fit changes sides from row to row.
        let (k, h) = (1e4, 1.0 / 120.0);
        let step = |[x, v]: Row| {
            let v = (v - h * k * x) / (1.0 + h * h * k);
            [x + h * v, v]
        };
        let rows = std::iter::successors(Some([0.3, -40.0]), |row| Some(step(*row))).take(60);
        let mut text = String::from("x\n");
        rows.for_each(|[x, _]| text += &format!("{x:e}\n"));
        let log = Log::parse("log", &text, &TableOptions::default(), 120.0).unwrap();
        let found = identify(&log, &LoggedBody::default(), 120.0).unwrap();
        let names = found.best.map(|best| best.candidate).into_iter().chain(found.also);
        let names: Vec<_> = names.chain(found.rivals).map(|name| name.method.id).collect();
        assert!(names.contains(&"implicit-euler"), "{names:?}");
    }
}
