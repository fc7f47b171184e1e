//! Fits the simplest motions to a log, and decides whether a damped swing explains more than they do.
//!
//! A motion with more numbers is named only if it lowers the Bayesian information criterion by [`GAIN`], and if its
//! residuals look like noise.

use super::logged::{Log, LoggedBody};
use super::swing::{FittedSwing, drifting_swing, lag};
use crate::sim::number::significant;
use crate::sim::{golden_section, least_squares};

/// A motion simpler than a swing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SimpleMotion {
    /// No motion, at `x` in metres but for noise.
    Rest {
        /// Coordinate, in metres.
        x: f64,
    },
    /// A steady speed.
    Steady {
        /// Velocity, in m/s.
        v: f64,
    },
    /// A constant acceleration.
    Accelerated {
        /// Acceleration, in m/s².
        a: f64,
    },
    /// A single exponential, as of a value that chases its target, and of a coast under linear drag.
    Chase {
        /// Time in which the distance halves, in seconds.
        half_life_s: f64,
        /// Coordinate of the end, in metres.
        end: f64,
    },
    /// Linear drag and a constant push.
    Driven {
        /// Time in which the distance from the last speed halves, in seconds.
        half_life_s: f64,
        /// The last velocity, in m/s.
        v: f64,
    },
    /// A coast under quadratic drag, v′ = -κ |v| v.
    Quadratic {
        /// The drag κ, in 1/m.
        per_m: f64,
    },
    /// A damped swing whose rest moves at a steady speed.
    DriftingSwing {
        /// Frequency, in hertz.
        hz: f64,
        /// Damping ratio.
        damping_ratio: f64,
        /// Velocity of the rest, in m/s.
        v: f64,
    },
}

impl SimpleMotion {
    /// Returns the motion in words.
    pub fn in_words(&self) -> String {
        let number = |number: f64| significant(number, 4);
        match *self {
            Self::Rest { x } => format!("a rest at {} m", number(x)),
            Self::Steady { v } => format!("a steady speed of {} m/s", number(v)),
            Self::Accelerated { a } => format!("a constant acceleration of {} m/s²", number(a)),
            Self::Chase { half_life_s, end } => format!(
                "a chase, or a coast under linear drag: halves in {} s and ends at {} m",
                number(half_life_s),
                number(end)
            ),
            Self::Driven { half_life_s, v } => format!(
                "linear drag and a push: the gap to its last speed, {} m/s, halves in {} s",
                number(v),
                number(half_life_s)
            ),
            Self::Quadratic { per_m } => {
                format!(
                    "a coast under quadratic drag: the speed loses e in {} m",
                    number(1.0 / per_m)
                )
            }
            Self::DriftingSwing { hz, damping_ratio, v } => format!(
                "a swing of {} Hz and damping ratio {} about a rest that moves at {} m/s",
                number(hz),
                number(damping_ratio),
                number(v)
            ),
        }
    }
}

/// A model of a motion: the columns beside a constant, at a time and a rate, and the motion of their parts.
struct Model {
    has_rate: bool,
    columns: fn(t: f64, rate: f64) -> [Option<f64>; 2],
    motion: fn(parts: [f64; 3], rate: f64) -> SimpleMotion,
}

const LN_2: f64 = std::f64::consts::LN_2;

/// The models, from few numbers to many.
const MODELS: [Model; 6] = [
    Model {
        has_rate: false,
        columns: |_, _| [None; 2],
        motion: |[x, ..], _| SimpleMotion::Rest { x },
    },
    Model {
        has_rate: false,
        columns: |t, _| [Some(t), None],
        motion: |[_, v, _], _| SimpleMotion::Steady { v },
    },
    Model {
        has_rate: false,
        columns: |t, _| [Some(t), Some(t * t / 2.0)],
        motion: |[.., a], _| SimpleMotion::Accelerated { a },
    },
    Model {
        has_rate: true,
        columns: |t, rate| [Some(libm::exp(-rate * t)), None],
        motion: |[end, ..], rate| SimpleMotion::Chase { half_life_s: LN_2 / rate, end },
    },
    Model {
        has_rate: true,
        columns: |t, rate| [Some(libm::log1p(rate * t)), None],
        motion: |[_, per, _], _| SimpleMotion::Quadratic { per_m: 1.0 / per.abs() },
    },
    Model {
        has_rate: true,
        columns: |t, rate| [Some(t), Some(libm::exp(-rate * t))],
        motion: |[_, v, _], rate| SimpleMotion::Driven { half_life_s: LN_2 / rate, v },
    },
];
/// The names of the models, for a log that none explains.
const TRIED: &str = "a rest, a steady speed, a constant acceleration, a chase, linear and quadratic drag, a swing, a swing about a moving rest";
/// Fall of the information criterion that a further number needs, which chance gives once in 150 logs.
const GAIN: f64 = 10.0;
/// Residuals below this share of the largest coordinate count as rounding.
const ROUNDING: f64 = 1e-9;
/// Residuals below this share of the spread need not look like noise, because an engine rounds.
const SMALL: f64 = 1e-5;
/// Largest correlation of successive residuals that may be noise, and fewest rows that show it.
const NOISE_LAG: f64 = 0.5;
const MIN_ROWS: usize = 20;
/// Largest residual that may be noise, relative to the root mean square, and relative to that of a log in which no
/// other row leaves anything. A runaway is all in its last rows.
const FEW: f64 = 6.0;
const FEW_OF_ALL: f64 = 0.7;
/// Number of rates on the grid.
const GRID: i32 = 24;

/// Returns the deviation of a log's coordinates from their mean, in metres.
fn spread(log: &Log) -> f64 {
    let n = log.rows().len() as f64;
    let mean = log.rows().iter().map(|row| row.x).sum::<f64>() / n;
    (log.rows().iter().map(|row| (row.x - mean) * (row.x - mean)).sum::<f64>() / n).sqrt()
}

/// Returns the information criterion of a fit with `numbers` parameters.
fn criterion(log: &Log, rms: f64, numbers: usize) -> f64 {
    let n = log.rows().len() as f64;
    let rms = rms.max(ROUNDING * log.scale()[0]);
    2.0 * n * libm::log(rms) + numbers as f64 * libm::log(n)
}

/// A model with its fit.
struct Fitted {
    motion: SimpleMotion,
    criterion: f64,
    rms: f64,
    lag: f64,
    /// Largest residual, in metres.
    largest: f64,
}

impl Fitted {
    /// Returns whether the fit leaves rounding, or noise in a log that is long enough to tell.
    fn is_known(&self, log: &Log) -> bool {
        let rows = log.rows().len();
        let is_spread = self.largest <= FEW.min(FEW_OF_ALL * (rows as f64).sqrt()) * self.rms;
        let is_noise = self.lag.abs() < NOISE_LAG && rows >= MIN_ROWS && is_spread;
        self.rms <= SMALL * spread(log) || is_noise
    }
}

impl Model {
    /// Fits the model with this rate, and returns its parts and residuals.
    fn at(&self, log: &Log, rate: f64) -> Option<([f64; 3], Vec<f64>)> {
        let row = |row: &super::LogRow| (self.columns)(row.t_s, rate);
        let all: Vec<[Option<f64>; 2]> = log.rows().iter().map(row).collect();
        let x: Vec<f64> = log.rows().iter().map(|row| row.x).collect();
        let mut columns = vec![vec![1.0; x.len()]];
        columns.extend((0..2).filter_map(|of| all.iter().map(|row| row[of]).collect()));
        let found = least_squares(&columns, &x)?;
        let residual = |(at, x): (usize, &f64)| {
            x - columns.iter().zip(&found).map(|(column, part)| column[at] * part).sum::<f64>()
        };
        let residuals = x.iter().enumerate().map(residual).collect();
        Some(([0, 1, 2].map(|of| found.get(of).copied().unwrap_or(0.0)), residuals))
    }

    fn fit(&self, log: &Log) -> Option<Fitted> {
        let n = log.rows().len() as f64;
        let rms = |residuals: &[f64]| (residuals.iter().map(|r| r * r).sum::<f64>() / n).sqrt();
        let off = |log_rate: f64| {
            let fit = self.at(log, libm::exp(log_rate));
            fit.map_or(f64::INFINITY, |(_, residuals)| rms(&residuals))
        };
        let lasted = log.rows().last()?.t_s;
        let [low, high] = [0.2 / lasted, n / lasted].map(libm::log);
        let step = (high - low) / f64::from(GRID);
        let mut rate = 0.0;
        if self.has_rate {
            let grid = (0..=GRID).map(|at| low + step * f64::from(at));
            let best = grid.map(|rate| (off(rate), rate)).min_by(|a, b| a.0.total_cmp(&b.0))?.1;
            let log_rate = golden_section(&off, [best - step, best + step]);
            rate = libm::exp(log_rate);
            // A rate at the end of the grid is that of a simpler motion.
            if !(low..=high).contains(&libm::log(rate)) {
                return None;
            }
        }
        let (parts, residuals) = self.at(log, rate)?;
        let numbers =
            1 + (self.columns)(0.0, rate).iter().flatten().count() + usize::from(self.has_rate);
        let rms = rms(&residuals);
        let criterion = criterion(log, rms, numbers);
        let largest = residuals.iter().fold(0.0_f64, |largest, r| largest.max(r.abs()));
        let (motion, lag) = ((self.motion)(parts, rate), lag(&residuals));
        Some(Fitted { motion, criterion, rms, lag, largest })
    }
}

/// Returns the simplest motion that explains a log as well as a swing does; `None` if a swing, or nothing, explains it.
pub(super) fn simplest(log: &Log, swing: Option<&FittedSwing>) -> Option<SimpleMotion> {
    let best = simplest_of_models(log)?;
    let of_swing = swing.map_or(f64::INFINITY, |swing| criterion(log, swing.rms, 5));
    (best.is_known(log) && best.criterion <= of_swing + GAIN).then_some(best.motion)
}

fn simplest_of_models(log: &Log) -> Option<Fitted> {
    let mut best: Option<Fitted> = None;
    for fit in MODELS.iter().filter_map(|model| model.fit(log)) {
        if best.as_ref().is_none_or(|best| fit.criterion < best.criterion - GAIN) {
            best = Some(fit);
        }
    }
    best
}

/// Returns a swing whose rest moves at a steady speed. `None` if the log shows less than a turn, or if a simpler motion
/// explains as much.
pub(super) fn drifting(log: &Log, body: &LoggedBody) -> Option<SimpleMotion> {
    let (swing, v) = drifting_swing(log, body)?;
    let (hz, damping_ratio) = (swing.seen.frequency_hz()?, swing.seen.damping_ratio()?);
    let motion = SimpleMotion::DriftingSwing { hz, damping_ratio, v };
    let (criterion, rms, lag) = (criterion(log, swing.rms, 6), swing.rms, swing.lag);
    let fit = Fitted { motion, criterion, rms, lag, largest: rms };
    let is_simplest =
        simplest_of_models(log).is_none_or(|simple| fit.criterion < simple.criterion - GAIN);
    let is_seen = hz * log.rows().last()?.t_s >= 1.0
        && rms <= MOST_LEFT * spread(log)
        && damping_ratio >= -MOST_GAIN;
    (is_simplest && is_seen && fit.is_known(log)).then_some(fit.motion)
}

/// A swing about a moving rest gains no more than this damping ratio. A runaway is no swing.
const MOST_GAIN: f64 = 0.01;
/// Share of the spread that a swing may leave at most, and from which on its residuals must look like noise.
const MOST_LEFT: f64 = 0.3;
const SMALL_LEFT: f64 = 0.005;
/// Correlation of successive residuals from which on they are no noise.
const NO_NOISE: f64 = 0.7;
/// Turns that a log must show, and turns that suffice without noise.
const MIN_TURNS: f64 = 0.5;
const MIN_TURNS_EXACT: f64 = 0.02;
/// Share of the way that may be left to the rest of an overdamped motion.
const NOT_THERE: f64 = 0.2;

/// Returns the reason why a swing does not explain a log; `None` if it does.
pub(super) fn refusal(log: &Log, swing: &FittedSwing) -> Option<String> {
    let left = swing.rms / spread(log);
    let last = log.rows().last()?;
    let percent = significant(100.0 * left, 2);
    let is_noise = swing.lag.abs() < NO_NOISE;
    let far = |x: f64| (x - swing.rest).abs();
    let farthest = log.rows().iter().map(|row| far(row.x)).fold(0.0, f64::max);
    let why = match swing.seen.frequency_hz() {
        _ if left > MOST_LEFT => format!("leaves {percent} % of the spread"),
        _ if left > SMALL_LEFT && !is_noise => {
            format!("leaves {percent} % of the spread, which is no noise")
        }
        Some(hz) if hz * last.t_s < MIN_TURNS => {
            if left < SMALL && hz * last.t_s > MIN_TURNS_EXACT {
                return None;
            }
            format!("would have made {} turns", significant(hz * last.t_s, 2))
        }
        None if far(last.x) > NOT_THERE * farthest => {
            format!("would not have reached its rest at {} m", significant(swing.rest, 4))
        }
        _ => return None,
    };
    Some(format!("a damped swing {why}; tried: {TRIED}"))
}
