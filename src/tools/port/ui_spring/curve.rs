//! The points through which a style sheet draws a motion along straight lines.

use super::{Values, part_left};
use crate::port::Wish;

/// Number of places at which the error is sampled.
const PLACES: u32 = 20_000;
/// Number of delays per second that are tried, and the longest, in seconds, beside one frame.
const DELAYS_PER_S: f64 = 1e4;
const LONGEST_DELAY_S: f64 = 0.02;

/// The points of a motion at equal times.
pub(super) struct Curve {
    points: Vec<f64>,
    duration_s: f64,
}

impl Curve {
    /// Returns the points of a motion, to four digits as a style sheet writes them. The last one is the target.
    pub(super) fn of(wish: &Wish, [duration_s, points, ..]: Values) -> Self {
        let pieces = points as u32 - 1;
        let exact = |place: f64| exact(wish, duration_s * place);
        let point = |i: u32| match i == pieces {
            true => 1.0,
            false => (1e4 * exact(f64::from(i) / f64::from(pieces))).round() / 1e4,
        };
        Self { points: (0..=pieces).map(point).collect(), duration_s }
    }

    /// Returns the points in the notation of style sheets.
    pub(super) fn written(&self) -> String {
        self.points.iter().map(f64::to_string).collect::<Vec<_>>().join(", ")
    }

    /// Returns the position at this time, as a fraction of the way.
    fn at(&self, time_s: f64) -> f64 {
        let pieces = self.points.len() - 1;
        let place = (time_s / self.duration_s).clamp(0.0, 1.0) * pieces as f64;
        let i = (place as usize).min(pieces - 1);
        self.points[i] + (self.points[i + 1] - self.points[i]) * (place - i as f64)
    }

    /// Returns the largest error of the lines between the points, as a fraction of the way.
    pub(super) fn error(&self, wish: &Wish) -> f64 {
        let time_s = |place: u32| self.duration_s * f64::from(place) / f64::from(PLACES);
        let error = |place: u32| (self.at(time_s(place)) - exact(wish, time_s(place))).abs();
        (0..=PLACES).map(error).fold(0.0, f64::max)
    }

    /// Returns the delay in seconds with which the lines are nearest to a motion that leaves these fractions of the way
    /// at its frames, and their largest error there.
    pub(super) fn delay_to(&self, left: &[f64], frame_hz: f64) -> (f64, f64) {
        let error = |delay_s: f64| {
            let error = |(n, left): (usize, &f64)| {
                (self.at(n as f64 / frame_hz - delay_s) - (1.0 - left)).abs()
            };
            left.iter().enumerate().map(error).fold(0.0, f64::max)
        };
        let longest = (DELAYS_PER_S * (LONGEST_DELAY_S + 1.0 / frame_hz)) as i32;
        // The shortest delays come first, so that they win if the errors are equal.
        let delays = (0..=longest).flat_map(|i| [i, -i]).map(|i| f64::from(i) / DELAYS_PER_S);
        let all = delays.map(|delay_s| (delay_s, error(delay_s)));
        all.min_by(|a, b| a.1.total_cmp(&b.1)).expect("0 is one")
    }
}

/// Returns the exact position at this time after a start from rest, as a fraction of the way.
fn exact(wish: &Wish, time_s: f64) -> f64 {
    1.0 - part_left(wish.damping_ratio, wish.omega() * time_s)
}
