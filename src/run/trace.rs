//! The rows of a run, with every coordinate of every body of the truth and of each lane, tick by tick.

use std::convert::Infallible;

use csv::ByteRecord;

use super::race::LaneBody;
use super::{METRICS, Race, Session};
use crate::diff::{NotComparable, Records};
use crate::scene::Scene;
use crate::sim::Solver;

/// The columns of the table.
pub const COLUMNS: [&str; 8] = ["tick", "t", "lane", "method", "body", "coordinate", "q", "v"];

/// A row of a trace at one tick.
pub struct TraceRow<'a> {
    /// The lane's number from 1; 0 is the truth.
    pub lane: usize,
    /// Id of the lane's method.
    pub method: &'static str,
    /// Name of the body.
    pub body: &'a str,
    /// Name of the coordinate, or id of a metric.
    pub coordinate: &'a str,
    /// Value of the coordinate in metres or radians, or of the metric.
    pub q: f64,
    /// Velocity of the coordinate, per second; `None` for a metric.
    pub v: Option<f64>,
}

/// Passes the present of the truth and of every lane to `row`, without bodies that have halted.
///
/// # Errors
/// Fails with the first error that `row` returns.
pub fn each_row<E>(
    race: &Race,
    scene: &Scene,
    with_metrics: bool,
    row: &mut impl FnMut(TraceRow) -> Result<(), E>,
) -> Result<(), E> {
    let lanes = race.entrants().iter().map(|entrant| &entrant.lane);
    for (number, lane) in [race.truth()].into_iter().chain(lanes).enumerate() {
        let bodies = lane.bodies().iter().zip(&scene.bodies).enumerate();
        for (n, (body, named)) in bodies.filter(|(_, (body, _))| body.halted().is_none()) {
            let method = method_id(lane.solver(), body);
            let mut write = |coordinate: &str, q, v| {
                row(TraceRow { lane: number, method, body: &named.name, coordinate, q, v })
            };
            let values = body.stepper.q().iter().zip(body.stepper.v());
            for (coordinate, (&q, &v)) in body.coordinates().iter().zip(values) {
                write(&coordinate.name, q, Some(v))?;
            }
            for metric in METRICS.iter().filter(|_| with_metrics && number > 0) {
                let value = (metric.measure)(body, &race.truth().bodies()[n]);
                if let Some(value) = value.filter(|value| value.is_finite()) {
                    write(metric.id, value, None)?;
                }
            }
        }
    }
    Ok(())
}

/// Returns the id of a lane's method; for a body of the truth, the id of its kind of truth.
pub fn method_id(solver: Solver, body: &LaneBody) -> &'static str {
    solver.method().map_or(body.truth().id(), |method| method.id)
}

/// The rows of a run that is computed tick by tick.
pub struct Made {
    header: ByteRecord,
    rows: std::vec::IntoIter<ByteRecord>,
    /// Returns the rows of the next tick; `None` after the last tick.
    tick: Box<dyn FnMut() -> Option<Vec<ByteRecord>>>,
}

impl Made {
    /// Collects rows from `tick` until it returns `None`.
    pub fn new(tick: impl FnMut() -> Option<Vec<ByteRecord>> + 'static) -> Self {
        let header = ByteRecord::from(&COLUMNS[..]);
        Self { header, rows: Vec::new().into_iter(), tick: Box::new(tick) }
    }

    /// Creates the rows of a scene or recording through tick `last`.
    pub fn of_scene(scene: Scene, last: u64) -> Self {
        Self::of_session(Session::racing(scene.into()), last)
    }

    /// Creates the rows of a session from its present tick through tick `last`.
    pub fn of_session(mut session: Session, last: u64) -> Self {
        let mut has_begun = false;
        Self::new(move || {
            if std::mem::replace(&mut has_begun, true) {
                if session.race().tick() >= last {
                    return None;
                }
                session.tick(&mut ());
            }
            Some(present(session.race(), session.scene()))
        })
    }
}

impl Records for Made {
    type Error = NotComparable;

    fn header(&self) -> &ByteRecord {
        &self.header
    }

    fn next(&mut self, row: &mut ByteRecord) -> Result<bool, NotComparable> {
        loop {
            if let Some(next) = self.rows.next() {
                *row = next;
                return Ok(true);
            }
            let Some(rows) = (self.tick)() else { return Ok(false) };
            self.rows = rows.into_iter();
        }
    }
}

/// Returns a row of these cells: tick, time, lane and method, and then the cells of a coordinate.
pub(crate) fn row(at: [&str; 4], body: &str, coordinate: &str, [q, v]: [f64; 2]) -> ByteRecord {
    let mut row = ByteRecord::new();
    at.iter().chain([&body, &coordinate]).for_each(|cell| row.push_field(cell.as_bytes()));
    [q, v].iter().for_each(|x| row.push_field(format!("{x:?}").as_bytes()));
    row
}

/// Returns the last tick of a scene or a recording, which is its end, or its last check if that is later.
pub fn last_tick(scene: &Scene) -> u64 {
    let checked = scene.checks.iter().map(|check| check.tick).max().unwrap_or(0);
    Race::of_scene(scene).nearest_tick(scene.seconds).max(checked)
}

fn present(race: &Race, scene: &Scene) -> Vec<ByteRecord> {
    let (tick, t) = (race.tick().to_string(), format!("{:?}", race.t()));
    let mut rows = Vec::new();
    let Ok(()) = each_row(race, scene, false, &mut |it| {
        let at = [&tick, &t, &it.lane.to_string(), it.method];
        rows.push(row(at, it.body, it.coordinate, [it.q, it.v.unwrap_or_default()]));
        Ok::<(), Infallible>(())
    });
    rows
}
