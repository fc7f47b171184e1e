//! Counts the steps between the rows of a log whose writer at times made none between two rows, and two after that.

use super::units::times_of_v;
use super::{Log, LogRow, scale_of};
use crate::sim::least_squares;

/// Usual ways in units of that at the mean velocity, and slowest velocity as a share of the largest, of a single step.
const ONE_STEP: std::ops::Range<f64> = 0.6..1.4;
const MOVING: f64 = 0.3;
/// Number of times that the map of a step is fitted to the pairs that are one step apart.
const ROUNDS: usize = 3;
/// Largest residual of a linear step, as a share of the largest coordinate or velocity.
const ALIKE: f64 = 1e-4;
/// Least ratio of the residuals of two numbers of steps that tells them apart.
const CLEAR: f64 = 10.0;

/// Minimum number of rows of which some may skip a tick, and of those for each that skips one without a repeat.
const MIN_ROWS: usize = 12;
const FEW: usize = 10;

/// A coordinate and a velocity, in units of the largest of the log.
type Place = [f64; 2];

/// An affine map of a step: the parts of x, of v and of 1.
type Step = [[f64; 3]; 2];

fn after(step: &Step, [x, v]: Place) -> Place {
    step.map(|[of_x, of_v, push]| of_x * x + of_v * v + push)
}

fn distance(a: Place, b: Place) -> f64 {
    (a[0] - b[0]).abs().max((a[1] - b[1]).abs())
}

/// Fits the map of a step to these pairs.
fn fit(pairs: &[[Place; 2]]) -> Option<Step> {
    let column = |part: usize| pairs.iter().map(|[from, _]| from[part]).collect::<Vec<_>>();
    let columns = [column(0), column(1), vec![1.0; pairs.len()]];
    let row = |part: usize| {
        let right: Vec<f64> = pairs.iter().map(|[_, to]| to[part]).collect();
        <[f64; 3]>::try_from(least_squares(&columns, &right)?).ok()
    };
    Some([row(0)?, row(1)?])
}

/// Returns the residuals of a pair for 0, 1 and 2 steps.
fn residuals(step: &Step, [from, to]: [Place; 2]) -> [f64; 3] {
    let once = after(step, from);
    [from, once, after(step, once)].map(|reached| distance(reached, to))
}

/// Returns the number of steps of each pair, which is 0, 1 or 2. `None` if that is not clear.
fn count(pairs: &[[Place; 2]], tick: f64) -> Option<Vec<u64>> {
    let is_single = |[from, to]: &&[Place; 2]| {
        let v = f64::midpoint(from[1], to[1]);
        v.abs() > MOVING && ONE_STEP.contains(&((to[0] - from[0]) / (tick * v)))
    };
    let mut single: Vec<_> = pairs.iter().filter(is_single).copied().collect();
    for _ in 0..ROUNDS {
        let step = fit(&single)?;
        let is_once = |pair: &&[Place; 2]| {
            let [none, once, twice] = residuals(&step, **pair);
            once < none.min(twice)
        };
        single = pairs.iter().filter(is_once).copied().collect();
    }
    let step = fit(&single)?;
    let steps = |pair: &[Place; 2]| {
        let mut all: Vec<_> = (0..).zip(residuals(&step, *pair)).collect();
        all.sort_by(|a, b| a.1.total_cmp(&b.1));
        let is_clear = all[0].1 <= ALIKE && all[1].1 >= CLEAR * all[0].1.max(f64::EPSILON);
        is_clear.then_some(all[0].0)
    };
    pairs.iter().map(steps).collect()
}

/// Largest residual of a linear step in the logs of other readings, as a share of the largest coordinate or velocity.
const EXACT: f64 = 1e-8;
const EXACT_IN_SINGLE: f64 = 3e-6;
/// Ratios of ways to velocities that may be per tick, in units of the tick rate.
const PER_TICK: std::ops::Range<f64> = 0.5..2.0;

impl Log {
    /// The rows as places, if they have velocities and each is a tick after the one before.
    fn places(&self) -> Option<Vec<Place>> {
        let is_even = self.rows.windows(2).all(|pair| pair[1].tick == pair[0].tick + 1);
        let place = |row: &LogRow| Some([row.x / self.scale[0], row.v? / self.scale[1]]);
        self.rows.iter().map(place).collect::<Option<Vec<_>>>().filter(|_| is_even)
    }

    /// Whether all rows follow from those before them by one linear step.
    pub(in crate::identify) fn is_of_one_step(&self) -> bool {
        let Some(places) = self.places() else { return false };
        let pairs: Vec<[Place; 2]> = places.windows(2).map(|pair| [pair[0], pair[1]]).collect();
        let off = |step: Step| {
            pairs.iter().map(|[from, to]| distance(after(&step, *from), *to)).fold(0.0, f64::max)
        };
        let most = if self.is_double() { EXACT } else { EXACT_IN_SINGLE };
        pairs.len() > 3 && fit(&pairs).is_some_and(|step| off(step) <= most)
    }

    /// Returns a log of these rows, from their first on; `None` if there are too few.
    fn of_rows(&self, rows: Vec<LogRow>) -> Option<Log> {
        let first = *rows.first().filter(|_| rows.len() >= Self::MIN_ROWS_WITHOUT_VELOCITY)?;
        let since_first =
            |row: LogRow| LogRow { tick: row.tick - first.tick, t_s: row.t_s - first.t_s, ..row };
        let rows: Vec<LogRow> = rows.into_iter().map(since_first).collect();
        Some(Log { scale: scale_of(&rows), rows, stepped: None, ..self.clone() })
    }

    /// Returns the log without its first rows; `None` if too few are left.
    pub(in crate::identify) fn without_first(&self, rows: usize) -> Option<Log> {
        self.of_rows(self.rows.get(rows..)?.to_vec())
    }

    /// Returns the log with the x of the next row beside each v; `None` without velocities.
    pub(in crate::identify) fn with_x_of_the_next_row(&self) -> Option<Log> {
        self.places()?;
        let pairs = self.rows.windows(2);
        self.of_rows(pairs.map(|pair| LogRow { x: pair[1].x, ..pair[0] }).collect())
    }

    /// Returns the log with its velocities as ways in a tick, if they may be that.
    pub(in crate::identify) fn with_velocities_per_tick(&self) -> Option<Log> {
        let times = times_of_v(&self.rows)? / self.tick_hz;
        let rows = self.rows.iter().filter(|_| PER_TICK.contains(&times));
        let per_second = |row: &LogRow| LogRow { v: row.v.map(|v| v * self.tick_hz), ..*row };
        self.of_rows(rows.map(per_second).collect())
    }
}

/// Counts the ticks of rows, if some repeat the row before though the body moves, and leaves those out. Returns a note
/// on them.
pub(super) fn count_steps(rows: &mut Vec<LogRow>, tick_hz: f64) -> Option<String> {
    let is_same = |pair: &&[LogRow]| {
        let [a, b] = [&pair[0], &pair[1]];
        (a.x, a.v) == (b.x, b.v) && a.v.is_some_and(|v| v != 0.0)
    };
    let repeated = rows.windows(2).filter(is_same).count();
    let is_even = rows.windows(2).all(|pair| pair[1].tick == pair[0].tick + 1);
    if rows.len() < MIN_ROWS || !is_even {
        return None;
    }
    let said = match repeated {
        0 => "no row repeats the row before".to_owned(),
        1 => "1 row repeats the row before".to_owned(),
        several => format!("{several} rows repeat the row before"),
    };
    let scale = scale_of(rows);
    let place = |row: &LogRow| [row.x / scale[0], row.v.unwrap_or(0.0) / scale[1]];
    let pairs: Vec<_> = rows.windows(2).map(|pair| [place(&pair[0]), place(&pair[1])]).collect();
    let steps = count(&pairs, scale[1] / scale[0] / tick_hz);
    // A slow body may repeat a row of few digits.
    let none = |steps: &Vec<u64>| steps.iter().filter(|steps| **steps == 0).count();
    let Some(steps) = steps.filter(|steps| none(steps) == repeated) else {
        return (repeated > 0).then(|| said + ": log each tick once");
    };
    let twice = steps.iter().filter(|steps| **steps == 2).count();
    if repeated == 0 && (twice == 0 || twice * FEW > steps.len()) {
        return None;
    }
    let mut tick = rows[0].tick;
    for (row, steps) in rows[1..].iter_mut().zip(&steps) {
        tick += steps;
        (row.tick, row.t_s) = (tick, tick as f64 / tick_hz);
    }
    rows.dedup_by_key(|row| row.tick);
    Some(format!("{said}, and {twice} skip a tick: taken as 0 and 2 steps"))
}

#[cfg(test)]
mod tests {
    use crate::identify::{Conclusion, Identification, Log, LoggedBody, identify};
    use crate::table::TableOptions;

    /// A log of Drake's step, whose clock makes these numbers of steps before a row, and 1 before all others.
    fn found(steps: &[(usize, u32)], digits: usize) -> (Log, Identification) {
        let [h, mut x, mut v] = [1.0 / 60.0, 1.0_f64, 0.0_f64];
        let mut text = format!("tick,x,v\n0,{x},{v}\n");
        for row in 1..120 {
            let of = |(at, steps): &(usize, u32)| (*at == row).then_some(*steps);
            for _ in 0..steps.iter().find_map(of).unwrap_or(1) {
                v = (v - h * 20.0 * x) / (1.0 + h * 0.5);
                x += h * v;
            }
            text += &format!("{row},{x:.digits$},{v:.digits$}\n");
        }
        let log = Log::parse("log", &text, &TableOptions::default(), 60.0).unwrap();
        let body = LoggedBody { spring: Some([20.0, 0.5]), ..LoggedBody::default() };
        let found = identify(&log, &body, 60.0).unwrap();
        (log, found)
    }

    #[test]
    fn rows_after_no_step_and_after_two_are_counted_so() {
        let (log, found) = found(&[(24, 0), (25, 2), (32, 0), (60, 2), (78, 0), (79, 0)], 17);
        assert_eq!(found.conclusion, Conclusion::Identified, "{:?}", found.best);
        assert_eq!(found.best.unwrap().candidate.method.id, "engine-mujoco");
        let note = "4 rows repeat the row before, and 2 skip a tick: taken as 0 and 2 steps";
        assert_eq!(log.taken().notes, [note]);
        assert_eq!((log.rows().len(), log.rows().last().unwrap().tick), (116, 117));
    }

    #[test]
    fn rows_that_no_step_explains_are_said_and_slow_ones_are_no_repeats() {
        let (log, told) = found(&[(24, 0), (25, 5)], 17);
        assert_eq!(told.conclusion, Conclusion::Unknown);
        assert_eq!(log.taken().notes, ["1 row repeats the row before: log each tick once"]);
        assert_eq!(log.rows().len(), 120);
        let (log, told) = found(&[], 17);
        assert!(log.taken().notes.is_empty() && told.conclusion == Conclusion::Identified);
    }
}
