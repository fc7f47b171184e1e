//! Measures how a difference grows.

/// Relative difference at which growth saturates, because the motions have separated.
const LARGE: f64 = 0.1;
/// Smallest factor that counts as growth.
const LEAST_GROWTH: f64 = 1e3;
/// Smallest share of the logarithm's variance that exponential growth must explain.
const LEAST_EXPLAINED: f64 = 0.95;

/// Running sums for a line through points.
#[derive(Clone, Copy, Default)]
struct Line {
    n: f64,
    mean: [f64; 2],
    /// Sums of squares and of products, about the means.
    xx: f64,
    xy: f64,
    yy: f64,
}

impl Line {
    /// Adds a point (Welford 1962).
    fn add(&mut self, x: f64, y: f64) {
        self.n += 1.0;
        let [dx, dy] = [x - self.mean[0], y - self.mean[1]];
        self.mean[0] += dx / self.n;
        self.mean[1] += dy / self.n;
        self.xx += dx * (x - self.mean[0]);
        self.xy += dx * (y - self.mean[1]);
        self.yy += dy * (y - self.mean[1]);
    }

    fn slope(&self) -> f64 {
        self.xy / self.xx
    }

    /// Returns the share of the variance that the line explains.
    fn explained_share(&self) -> f64 {
        self.xy * self.xy / (self.xx * self.yy)
    }
}

/// The largest difference of each tick so far, on a logarithmic scale, fitted against time and against the logarithm of
/// time.
#[derive(Default)]
pub(super) struct Growth {
    /// The tick of the present points, and its time.
    present: Option<(u64, f64)>,
    largest: f64,
    /// Time and size of the first difference.
    start: Option<(f64, f64)>,
    exponential: Line,
    power: Line,
}

impl Growth {
    /// Adds a difference at time `t` (s). If there are no times, there is no rate.
    pub(super) fn note_difference(&mut self, tick: u64, t: Option<f64>, difference: f64) {
        let Some(t) = t.filter(|_| difference > 0.0) else { return };
        if self.present.is_some_and(|(present, _)| present != tick) {
            self.end_tick();
        }
        self.present = Some((tick, t));
        self.largest = self.largest.max(difference);
    }

    fn end_tick(&mut self) {
        let Some((_, t)) = self.present.filter(|_| self.largest < LARGE) else { return };
        let (start, _) = *self.start.get_or_insert((t, self.largest));
        let size = libm::log(self.largest);
        self.exponential.add(t, size);
        if t > start {
            self.power.add(libm::log(t - start), size);
        }
    }

    /// Returns the growth rate in 1/s, if the difference grew exponentially.
    pub(super) fn per_second(mut self) -> Option<f64> {
        self.end_tick();
        let (_, least) = self.start?;
        let grew = self.largest.min(LARGE) >= LEAST_GROWTH * least;
        let explained = self.exponential.explained_share();
        let is_best = explained >= LEAST_EXPLAINED && explained > self.power.explained_share();
        let slope = self.exponential.slope();
        (grew && is_best && slope.is_finite()).then_some(slope)
    }
}
