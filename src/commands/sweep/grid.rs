//! Runs every method at every rate on every body, in parallel, and makes the rows.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};
use std::time::Duration;

use super::varied::Varied;
use crate::commands::error::Error;
use crate::commands::jobs;
use crate::commands::terminal::progress;
use crate::measure::{Judge, MAX_HORIZON_S, Verdict};
use crate::run::{Lane, Ticker};
use crate::scene::{LaneSpec, Scene, SceneBody};
use crate::sim::TickRate;
use crate::sim::bodies::Text;
use crate::sim::integrators::Method;
use crate::stopwatch;

/// The scenes, methods and rates to run.
pub(super) struct Swept {
    /// The scenes, each with the name that the user gave. The names are unique.
    pub(super) scenes: Vec<(String, Scene)>,
    /// The methods, in the order of the table.
    pub(super) methods: Vec<&'static Method>,
    /// The tick rates in Hz, ascending. If there are none, each scene runs at octaves of its own rate.
    pub(super) rates: Vec<TickRate>,
    /// Length of every run in seconds, or `None` for the own length of each scene.
    pub(super) seconds: Option<f64>,
    /// The parameter that is varied, or `None` to leave each body as it is in its scene.
    pub(super) varied: Option<Varied>,
}

/// One body, alone in its scene, because bodies do not affect each other.
struct Subject {
    /// Name of the scene, as the user gave it.
    scene_name: String,
    alone: Scene,
    /// Key and value of the varied parameter, if the body has this parameter.
    varied: Option<(Text, f64)>,
    horizon_s: f64,
    /// The judge, which the first run that needs it builds. A truth over years takes minutes, during which an interrupt
    /// must work.
    judge: OnceLock<Judge>,
}

impl Subject {
    fn judge(&self) -> &Judge {
        self.judge.get_or_init(|| Judge::over(&self.alone, self.horizon_s))
    }
}

struct PlannedRun {
    subject: usize,
    spec: LaneSpec,
    tick_hz: TickRate,
}

pub(super) struct Grid {
    subjects: Vec<Subject>,
    /// The planned runs, in the order of the rows.
    runs: Vec<PlannedRun>,
}

/// A row of the table, which is a finished run.
pub(super) struct Row {
    pub(super) scene: String,
    pub(super) body: String,
    pub(super) method: &'static Method,
    pub(super) tick_hz: TickRate,
    pub(super) verdict: Verdict,
    pub(super) ns_per_s: Option<f64>,
    pub(super) varied: Option<(Text, f64)>,
}

impl Row {
    /// Returns the simulated seconds of the run.
    pub(super) fn seconds(&self) -> f64 {
        let verdict = &self.verdict;
        verdict.failure().map_or(verdict.seconds, |failure| failure.t)
    }

    /// Returns the number of evaluations of the body's acceleration per simulated second.
    pub(super) fn evaluations_per_s(&self) -> f64 {
        let (verdict, hz) = (&self.verdict, f64::from(self.tick_hz));
        // Whole ticks are counted, so that a method with a fixed number of evaluations per step has a whole number.
        verdict.evaluations as f64 * hz / (verdict.seconds * hz).round()
    }
}

impl Grid {
    /// Plans the runs of a sweep.
    pub(super) fn new(swept: &Swept) -> Self {
        let mut grid = Self { subjects: Vec::new(), runs: Vec::new() };
        for (name, scene) in &swept.scenes {
            let horizon_s = swept.seconds.unwrap_or(scene.seconds.min(MAX_HORIZON_S));
            let own = octaves(scene.tick_hz);
            let rates = if swept.rates.is_empty() { &own } else { &swept.rates };
            let bodies = scene.bodies.iter().flat_map(|body| variants(body, &swept.varied));
            for (body, varied) in bodies {
                let alone = Scene { bodies: vec![body], ..scene.clone() };
                let fits = |method: &&&Method| alone.refusal(method).is_none();
                for method in swept.methods.iter().filter(fits) {
                    grid.runs.extend(rates.iter().map(|&tick_hz| PlannedRun {
                        subject: grid.subjects.len(),
                        spec: scene.plain_lane(method),
                        tick_hz,
                    }));
                }
                grid.subjects.push(Subject {
                    scene_name: name.clone(),
                    judge: OnceLock::new(),
                    horizon_s,
                    alone,
                    varied,
                });
            }
        }
        grid
    }

    /// Makes the runs on `threads` threads, by default one per core, and then measures the time of each run by itself.
    /// The rows come in the order of the grid.
    pub(super) fn run(
        self,
        threads: Option<usize>,
        interrupted: &AtomicBool,
    ) -> Result<Vec<Row>, Error> {
        let grid = Arc::new(self);
        let verdicts = judge_all(&grid, threads, interrupted)?;
        let progress = progress(grid.runs.len() as u32, "runs timed");
        let effort = effort(grid.runs.len());
        let rows = grid.runs.iter().zip(verdicts).map(|(run, verdict)| {
            if interrupted.load(Ordering::Relaxed) {
                return Err(Error::nothing_written());
            }
            progress.inc(1);
            Ok(grid.row(run, verdict, effort))
        });
        let rows = rows.collect();
        progress.finish_and_clear();
        rows
    }

    fn row(&self, run: &PlannedRun, verdict: Verdict, effort: Duration) -> Row {
        let &PlannedRun { subject, spec, tick_hz } = run;
        let Subject { scene_name, alone, varied, .. } = &self.subjects[subject];
        let mut row = Row {
            scene: scene_name.clone(),
            body: alone.bodies[0].name.clone(),
            method: spec.method,
            tick_hz,
            verdict,
            ns_per_s: None,
            varied: varied.clone(),
        };
        let ticks = (row.seconds() * f64::from(tick_hz)).round() as u64;
        let lane = || Lane::new(alone, spec.solver(), spec.substeps);
        let runs = stopwatch::ns_per_tick(|| Ticker::new(lane(), tick_hz), ticks, effort);
        row.ns_per_s = runs.first().map(|least| least * f64::from(tick_hz));
        row
    }
}

/// Returns a body with each value of the varied parameter, or only the unchanged body.
fn variants(body: &SceneBody, varied: &Option<Varied>) -> Vec<(SceneBody, Option<(Text, f64)>)> {
    let found = varied.as_ref().and_then(|varied| {
        let (index, parameter) = body.kind.parameter(&varied.key)?;
        Some((index, &parameter.key, &varied.values))
    });
    let Some((index, key, values)) = found else { return vec![(body.clone(), None)] };
    let variant = |&value: &f64| {
        let mut body = body.clone();
        body.values[index] = value;
        (body, Some((key.clone(), value)))
    };
    values.iter().map(variant).collect()
}

/// Maximum and minimum time for measuring one run, and approximate time for measuring all of them. Runs are measured
/// one after the other, so that thousands of them would otherwise take longer to measure than to judge.
const MAX_EFFORT: Duration = Duration::from_millis(1);
const MIN_EFFORT: Duration = Duration::from_micros(100);
const EFFORT_ON_ALL: Duration = Duration::from_millis(500);

/// Returns the time for measuring each of `runs` runs.
fn effort(runs: usize) -> Duration {
    (EFFORT_ON_ALL / (runs as u32).max(1)).clamp(MIN_EFFORT, MAX_EFFORT)
}

/// Returns the verdict on every run, in the order of the grid.
fn judge_all(
    grid: &Arc<Grid>,
    threads: Option<usize>,
    interrupted: &AtomicBool,
) -> Result<Vec<Verdict>, Error> {
    let pool = jobs::pool(threads.unwrap_or_default())?;
    let runs = grid.runs.len();
    let worked_on = Arc::clone(grid);
    let judge = move |run: usize| {
        let PlannedRun { subject, spec, tick_hz } = worked_on.runs[run];
        worked_on.subjects[subject].judge().verdict(spec, tick_hz)
    };
    let verdicts = jobs::results(&pool, runs, &progress(runs as u32, "runs"), interrupted, judge);
    let whole: Option<Vec<Verdict>> = verdicts.into_iter().collect();
    whole.ok_or_else(Error::nothing_written)
}

/// Returns the octaves from a quarter of this rate to eight times the rate, within the clock's range. The methods
/// differ in this region. If the rate is a whole number, its octaves are rounded down to whole numbers.
fn octaves(tick_hz: TickRate) -> Vec<TickRate> {
    let rates = [(1, 4), (1, 2), (1, 1), (2, 1), (4, 1), (8, 1)].map(|(times, parts)| {
        let rate = tick_hz.scaled(times, parts);
        if tick_hz.whole_hz().is_some() { TickRate::whole(rate.hz() as u32) } else { rate }
    });
    rates.into_iter().filter(|rate| rate.is_in_range()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_runs_are_timed_more_briefly_each() {
        let micros = [1, 500, 1000, 5000, 1_000_000].map(|runs| effort(runs).as_micros());
        assert_eq!(micros, [1000, 1000, 500, 100, 100]);
    }

    #[test]
    fn octaves_of_a_whole_rate_are_whole() {
        assert_eq!(octaves(60.into()), [15, 30, 60, 120, 240, 480]);
        assert_eq!(octaves(5.into()), [1, 2, 5, 10, 20, 40]);
        assert_eq!(octaves(1.into()), [1, 2, 4, 8]);
        assert_eq!(octaves(10_000.into()), [2500, 5000, 10_000]);
    }
}
