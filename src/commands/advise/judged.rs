//! Judges the methods and measures their times.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use rayon::ThreadPool;

use crate::commands::jobs;
use crate::commands::terminal::{print_status, progress};
use crate::measure::{Adviser, CRITERIA, MethodAdvice, Recommendation, ranked, recommended};
use crate::run::{Lane, Ticker};
use crate::scene::{LaneSpec, Scene};
use crate::sim::TickRate;
use crate::sim::number::significant;
use crate::stopwatch;

/// The measured cost of a lane.
#[derive(Clone, Copy, Debug)]
struct Timing {
    /// Time of the fastest run, in nanoseconds per simulated second.
    ns_per_s: f64,
    /// Excess of the median run's time over that of the fastest run, relative to the latter.
    spread: f64,
}

impl Timing {
    /// Computes the timing from the times of several runs in nanoseconds per tick, sorted upwards. Returns `None` if
    /// there are no runs.
    fn of(runs: &[f64], tick_hz: TickRate) -> Option<Self> {
        let least = *runs.first()?;
        let spread = runs[runs.len() / 2] / least - 1.0;
        Some(Self { ns_per_s: least * f64::from(tick_hz), spread })
    }
}

/// The advice on a method, and the method's measured costs.
pub(super) struct Row {
    pub(super) advised: MethodAdvice,
    /// Measured cost for each criterion. `None` for a criterion that is not met, or not yet timed.
    timings: [Option<Timing>; CRITERIA.len()],
    /// Slowest tick rate in Hz at which each criterion is met. `None` without `--rates`.
    pub(super) rates: Option<[Option<u32>; CRITERIA.len()]>,
}

/// Duration of one measurement. It is so short that six dozen of them do not keep a person waiting.
const EFFORT: Duration = Duration::from_millis(5);

/// Median spread of the run times above which a warning is printed.
const NOISE: f64 = 0.2;

/// Judges the methods in their order, but does not search margins. After an interrupt, returns the methods judged so
/// far.
pub(super) fn judge_all(
    pool: &ThreadPool,
    adviser: &Arc<Adviser>,
    specs: Vec<LaneSpec>,
    rates: bool,
    interrupted: &AtomicBool,
) -> Vec<Row> {
    let (methods, adviser) = (specs.len(), Arc::clone(adviser));
    let judge = move |method: usize| Row::judged(&adviser, specs[method], rates);
    let progress = progress(methods as u32, "methods judged");
    let rows = jobs::results(pool, methods, &progress, interrupted, judge);
    rows.into_iter().flatten().collect()
}

/// Searches margins until the recommendations are decided, or until the user interrupts.
pub(super) fn decide(
    pool: &ThreadPool,
    adviser: &Arc<Adviser>,
    rows: &mut [Row],
    interrupted: &AtomicBool,
) {
    while !interrupted.load(Ordering::Relaxed) {
        let undecided = adviser.undecided_margins(&advised(rows));
        if undecided.is_empty() {
            return;
        }
        search_margins(pool, adviser, rows, undecided, interrupted);
    }
}

/// Searches these margins. Each is given as the indices of a row and of a criterion. An interrupt leaves the remaining
/// margins unsearched.
pub(super) fn search_margins(
    pool: &ThreadPool,
    adviser: &Arc<Adviser>,
    rows: &mut [Row],
    margins: Vec<(usize, usize)>,
    interrupted: &AtomicBool,
) {
    let advised = advised(rows);
    let progress = progress(margins.len() as u32, "margins searched");
    let (wanted, adviser) = (margins.clone(), Arc::clone(adviser));
    let search = move |index: usize| {
        let (row, criterion) = wanted[index];
        let mut searched = advised[row].clone();
        searched.search_margins(&adviser, criterion);
        searched.met[criterion].clone()
    };
    let found = jobs::results(pool, margins.len(), &progress, interrupted, search);
    for ((row, criterion), met) in margins.into_iter().zip(found) {
        if let Some(met) = met {
            rows[row].advised.met[criterion] = met;
        }
    }
}

impl Row {
    fn judged(adviser: &Adviser, spec: LaneSpec, rates: bool) -> Self {
        let plain = LaneSpec { substeps: spec.method.default_substeps, ..spec };
        Self {
            advised: adviser.judged(spec),
            timings: [None; CRITERIA.len()],
            rates: rates.then(|| CRITERIA.map(|criterion| adviser.slowest(plain, criterion))),
        }
    }

    /// Measures the cost of meeting each criterion that the method meets. Nothing else should run meanwhile.
    pub(super) fn time(&mut self, scene: &Scene) {
        let ticks = (scene.seconds.min(10.0) * f64::from(scene.tick_hz)).round() as u64;
        for (i, met) in self.advised.met.iter().enumerate() {
            let Some(met) = met.met() else { continue };
            let known = (0..i).find(|&j| {
                self.advised.met[j].met().is_some_and(|other| other.substeps == met.substeps)
            });
            self.timings[i] = match known {
                Some(j) => self.timings[j],
                None => {
                    let spec = LaneSpec { substeps: met.substeps, ..self.advised.spec };
                    let lane = || Lane::new(scene, spec.solver(), spec.substeps);
                    let made = || Ticker::new(lane(), scene.tick_hz);
                    Timing::of(&stopwatch::ns_per_tick(made, ticks, EFFORT), scene.tick_hz)
                }
            };
        }
    }

    pub(super) fn ns_per_s(&self, criterion: usize) -> Option<f64> {
        Some(self.timings[criterion]?.ns_per_s)
    }
}

/// Warns if other work kept the machine busy during the measurements.
pub(super) fn warn_of_load(rows: &[Row]) {
    let timings = rows.iter().flat_map(|row| row.timings.iter().flatten());
    let mut spreads: Vec<f64> = timings.map(|timing| timing.spread).collect();
    spreads.sort_by(f64::total_cmp);
    if let Some(&middle) = spreads.get(spreads.len() / 2)
        && middle > NOISE
    {
        print_status(&format!(
            "warning: the machine is busy: costs in ns vary by {} % from run to run; the recommendation does not",
            significant(100.0 * middle, 2)
        ));
    }
}

pub(super) fn advised(rows: &[Row]) -> Vec<MethodAdvice> {
    rows.iter().map(|row| row.advised.clone()).collect()
}

/// Returns the row of the method that is recommended for a criterion, and the recommendation.
pub(super) fn recommended_row(rows: &[Row], criterion: usize) -> Option<(&Row, Recommendation)> {
    let advised = advised(rows);
    let row = &rows[recommended(&advised, criterion)?];
    Some((row, Recommendation::of(&advised, criterion)?))
}

/// Returns at most `most` rows, best first. They are the rows that are recommended for each criterion, then the
/// runners-up, and so on. Rows that meet no criterion come last.
pub(super) fn best_rows(rows: &[Row], most: usize) -> Vec<&Row> {
    let advised = advised(rows);
    let ranked: Vec<Vec<usize>> = (0..CRITERIA.len()).map(|i| ranked(&advised, i)).collect();
    let places =
        (0..rows.len()).flat_map(|place| ranked.iter().filter_map(move |it| it.get(place)));
    let mut best: Vec<usize> = Vec::new();
    for row in places.copied().chain(0..rows.len()) {
        if !best.contains(&row) {
            best.push(row);
        }
    }
    best.into_iter().take(most).map(|row| &rows[row]).collect()
}
