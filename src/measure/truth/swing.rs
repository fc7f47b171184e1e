//! The true swing of a body, with its crossings and the widths of its half turns.

use super::{BodyTruth, TruthNode};
use crate::amplitude::Measure;
use crate::criterion::{FREQUENCY_TOLERANCE, VISIBLE};
use crate::sim::Solver;
use crate::sim::numerics::bisect;

/// Share of the energy from which on a mode counts as the whole motion.
const ONE_MODE: f64 = 0.99;

/// Fraction of the largest speed below which a crossing does not count as a swing.
const FAINT: f64 = 1e-3;

/// The true swing of a body.
pub(crate) struct Swing {
    /// The coordinate whose crossings are counted.
    pub(crate) coordinate: usize,
    /// Times at which this coordinate crosses its centre upwards, in seconds.
    pub(crate) crossings: Vec<f64>,
    /// Largest distance of any coordinate from its centre in each half turn, in amplitudes. A half turn ends when the
    /// swinging coordinate passes its centre. The first one begins at the start, and the last one ends with the motion.
    pub(crate) half_turns: Vec<f64>,
    /// Times (s) at the ends of the half turns but for the last, each at the next known moment.
    pub(crate) passages: Vec<f64>,
}

impl Swing {
    /// Returns the largest distance of any coordinate from its centre, in amplitudes.
    pub(crate) fn widest(&self) -> f64 {
        self.half_turns.iter().copied().fold(0.0, f64::max)
    }

    /// Returns the width of this swing relative to `other`, which is farthest from 1 in a complete half turn of both at
    /// about the same time; `None` if there is none. The distances are in metres or the like by these amplitudes. Half
    /// turns of which nothing is seen do not count.
    pub(crate) fn width_beside(&self, other: &Self, [own, others]: [f64; 2]) -> Option<f64> {
        let complete = |swing: &Self| -> Vec<([f64; 2], f64)> {
            let ends = swing.passages.windows(2).map(|ends| [ends[0], ends[1]]);
            ends.zip(swing.half_turns.iter().skip(1).copied()).collect()
        };
        let theirs = complete(other);
        let seen = VISIBLE * other.widest();
        let ratios = complete(self).into_iter().filter_map(|([from, to], width)| {
            let middle = (from + to) / 2.0;
            let at = theirs.iter().find(|([from, to], _)| (*from..*to).contains(&middle))?;
            (at.1 > seen).then_some(width * own / (at.1 * others))
        });
        ratios.max_by(|a, b| libm::log(*a).abs().total_cmp(&libm::log(*b).abs()))
    }

    /// Returns the lead in seconds over a swing that crosses its centre upwards at these times (s). It is that of the
    /// crossings nearest to `t`, and at most half a period.
    pub(crate) fn lead_s(&self, crossings: &[f64], t: f64) -> f64 {
        let nearest = |crossings: &[f64], t: f64| {
            let apart = |a: &f64, b: &f64| (a - t).abs().total_cmp(&(b - t).abs());
            crossings.iter().copied().min_by(apart).unwrap_or(t)
        };
        let own = nearest(&self.crossings, t);
        libm::remainder(nearest(crossings, own) - own, self.period())
    }

    /// Returns the largest error, in amplitudes, of a harmonic motion that is this many seconds early or late.
    pub(crate) fn error_when(&self, early_s: f64) -> f64 {
        let half_turns = (early_s.abs() / self.period()).min(0.5);
        2.0 * libm::sin(std::f64::consts::PI * half_turns)
    }

    /// Whether a shift by this many seconds explains at least half of an error in amplitudes.
    pub(crate) fn is_cause_of(&self, early_s: f64, error: f64) -> bool {
        self.error_when(early_s) >= error / 2.0
    }

    /// Whether the half turns of a lane, from index `first` on, are as wide as the true ones within [`VISIBLE`] of the
    /// widest. They may come earlier or later. The end of the horizon may cut off the last half turn of each motion.
    pub(crate) fn is_as_wide(&self, lane: &[f64], first: usize) -> bool {
        let whole = |half_turns: &[f64]| half_turns.len().saturating_sub(1).max(1);
        let widest = |half_turns: &[f64]| half_turns.iter().copied().fold(0.0, f64::max);
        let (wanted, found) = (whole(&self.half_turns), whole(lane));
        let most = VISIBLE * self.widest();
        let both = wanted.min(found);
        let mut pairs = lane.iter().zip(&self.half_turns).take(both).skip(first);
        // A slow lane makes fewer half turns and a fast lane more, and a motion at rest makes none.
        let unpaired = |half_turns: &[f64], count: usize| {
            let fewest = (1.0 - FREQUENCY_TOLERANCE) * count as f64 - 2.0;
            widest(half_turns.get(both..(fewest.max(both as f64) as usize)).unwrap_or_default())
        };
        !lane.is_empty()
            && pairs.all(|(lane, truth)| (lane - truth).abs() <= most)
            && unpaired(&self.half_turns, wanted) <= most
            && unpaired(lane, found) <= most
    }
}

impl BodyTruth {
    /// Returns the quantity that grows or dies away.
    pub(crate) fn measure(&self) -> Measure {
        match (&self.swing, &self.modes) {
            (None, _) => Measure::Deviation,
            (Some(_), Some(modes)) if modes.iter().all(|moved| moved.share < ONE_MODE) => {
                Measure::Modes
            }
            (Some(_), None) if self.coordinates().len() > 1 => Measure::Reach,
            _ => Measure::Swing,
        }
    }

    /// Measures the swing about `middles`, one per coordinate, using the `seen` moments if they were kept.
    pub(super) async fn measure_swing(
        &self,
        middles: &[f64],
        seen: Option<&[(TruthNode, TruthNode)]>,
        most: usize,
    ) -> Option<Swing> {
        let n = middles.len();
        let mut crossings = vec![Vec::new(); n];
        let mut passages = vec![Vec::new(); n];
        let fast: Vec<f64> = self.amplitudes[n..].iter().map(|v| FAINT * v).collect();
        let mut peaks: Vec<(f64, f64)> = Vec::new();
        let mut body = self.start(Solver::Truth);
        let mut see = |from: &TruthNode, to: &TruthNode| {
            let mut peak: f64 = 0.0;
            for i in 0..n {
                let (a, b) = (from.x[i] - middles[i], to.x[i] - middles[i]);
                peak = peak.max(a.abs().max(b.abs()) / self.amplitudes[i]);
                if (a < 0.0) != (b < 0.0) {
                    passages[i].push(to.t);
                }
                if a < 0.0 && b >= 0.0 && to.t > from.t && to.x[n + i] > fast[i] {
                    crossings[i].push(crossing(from, to, i, middles[i]));
                }
                if from.slope[i] * to.slope[i] < 0.0 {
                    let within = (1..8).map(|s| from.between(to, i, f64::from(s) / 8.0));
                    let most = within.map(|x| (x - middles[i]).abs()).fold(0.0, f64::max);
                    peak = peak.max(most / self.amplitudes[i]);
                }
            }
            peaks.push((to.t, peak));
        };
        match seen {
            Some(seen) => seen.iter().for_each(|(from, to)| see(from, to)),
            None => {
                self.walk(&mut *body, Solver::Truth, self.horizon_s, most, see).await.ok()?;
            }
        }
        let coordinate = (0..n).find(|&i| crossings[i].len() >= 2)?;
        let crossings = std::mem::take(&mut crossings[coordinate]);
        let passages = std::mem::take(&mut passages[coordinate]);
        let mut half_turns = vec![0.0_f64; passages.len() + 1];
        for (t, peak) in peaks {
            let half_turn = &mut half_turns[passages.partition_point(|&passed| passed <= t)];
            *half_turn = half_turn.max(peak);
        }
        Some(Swing { coordinate, crossings, half_turns, passages })
    }
}

/// Returns the time in seconds at which coordinate `i` crosses `level` between two moments.
fn crossing(from: &TruthNode, to: &TruthNode, i: usize, level: f64) -> f64 {
    let [low, _] = bisect([0.0, 1.0], 50, |part| from.between(to, i, part) < level);
    from.t + low * (to.t - from.t)
}
