//! How far a lane is from the truth where its verdict begins.
//!
//! Such a lane is judged beside the exact motion from its own state, which shows what its method does from there. The
//! distance between that motion and the truth is added to the method's errors.

use super::amplitude::Trend;
use super::criterion::{FREQUENCY_TOLERANCE, TOLERANCE, VISIBLE};
use super::judge::Judge;
use super::truth::{BodyTruth, ticks};
use super::verdict::{Comparison, Finding, SwingWidths, Verdict};
use crate::sim::bodies::Tumble;
use crate::sim::{Solver, TickRate};

impl Verdict {
    /// Returns the verdict of `own`, the judge of the exact motion from a lane's state, as one beside the truth of
    /// `judge`.
    pub(super) async fn beside(self, own: &Judge, judge: &Judge, tick_hz: TickRate) -> Self {
        let mut of_bodies = Vec::with_capacity(self.of_bodies.len());
        for verdict in self.of_bodies {
            let truths = [own, judge].map(|judge| judge.truth(verdict.body));
            let finding = match verdict.finding {
                Finding::Compared(found) => Finding::Compared(beside(found, truths, tick_hz).await),
                Finding::Bounced(found) => {
                    let exact = truths.map(|truth| truth.start(Solver::Truth));
                    let height = |of: usize, after| Some(exact[of].true_bounce(after)?[1]);
                    let offset = |after| Some(height(0, after)? / height(1, after)? - 1.0);
                    let offsets = [0, 1].map(|after| offset(after).filter(|it| it.is_finite()));
                    Finding::Bounced(found.beside(offsets))
                }
                Finding::Spun(found) => {
                    let [own, truth] = truths.map(|truth| truth.start(Solver::Truth));
                    let energy = own.energy().zip(truth.energy());
                    let ratio =
                        energy.filter(|it| it.1 > 0.0).map_or(1.0, |(own, truth)| own / truth);
                    Finding::Spun(found.beside(Tumble::angle_between(own.q(), truth.q()), ratio))
                }
                finding => finding,
            };
            of_bodies.push(Verdict { finding, ..verdict });
        }
        Judge::of_all(of_bodies)
    }
}

/// Adds the distance between two exact motions to the errors beside the first.
async fn beside(found: Comparison, [own, truth]: [&BodyTruth; 2], tick_hz: TickRate) -> Comparison {
    let distance = Distance::between(own, truth, tick_hz).await;
    let error = found.error + distance.error;
    let swings = own.swing.as_ref().zip(truth.swing.as_ref());
    let widths = [own, truth].map(width_of);
    // A swing that grows has no width to stay at, so that its width is the present one.
    let grown = found.width.filter(|_| found.change != Trend::Grows).unwrap_or(1.0);
    let widths = widths[0].zip(widths[1]);
    // The first half turn of a swing that loses energy begins anywhere, so that the next ones show its width.
    let of_half_turns =
        swings.filter(|_| truth.energy_scale.is_none()).and_then(|(ours, theirs)| {
            ours.width_beside(theirs, [own, truth].map(|it| it.amplitudes[theirs.coordinate]))
        });
    let width = of_half_turns.or(widths.map(|(own, truth)| own / truth));
    let width = width.map(|width| grown * width).or(found.width);
    let own_frequency = found.frequency_error.unwrap_or(0.0);
    let frequency_error = swings
        .and_then(|(own, truth)| truth.frequency_error(&own.crossings))
        .map(|error| (1.0 + error) * (1.0 + own_frequency) - 1.0);
    let shift = swings.map_or(0.0, |(own, truth)| -truth.lead_s(&own.crossings, 0.0));
    // Exact motions in two wells can share a width and a frequency. No shift between them explains their distance.
    let is_of_phase = swings.is_none_or(|(_, truth_swing)| {
        let drift = frequency_error.unwrap_or(0.0) * truth.horizon_s;
        let expected = truth_swing.error_when(shift.abs() + drift.abs()) + 2.0 * VISIBLE;
        expected >= distance.error / 2.0
    });
    let is_alike = match width {
        Some(width) if swings.is_some() => {
            (width - 1.0).abs() <= VISIBLE
                && frequency_error.is_none_or(|error| error.abs() <= FREQUENCY_TOLERANCE)
                && is_of_phase
        }
        _ => error <= 2.0 * VISIBLE,
    };
    let is_shifted = found.early_s.is_some() || distance.error > TOLERANCE;
    Comparison {
        error,
        error_at_s: if distance.error > found.error { distance.at_s } else { found.error_at_s },
        last_error: found.last_error + distance.last,
        looks_right: found.looks_right.map(|looks_right| looks_right && is_alike),
        width,
        widths: widths.zip(swings).filter(|_| truth.energy_scale.is_some()).map(
            |((own, exact), (_, swing))| SwingWidths {
                own: grown * own,
                truth: exact,
                unit: truth.coordinates().at(swing.coordinate).shown_unit(),
            },
        ),
        early_s: swings.filter(|_| is_shifted && is_of_phase).and_then(|(_, truth_swing)| {
            let early_s = found.early_s.unwrap_or(0.0) + shift;
            truth_swing.is_cause_of(early_s, error).then_some(early_s)
        }),
        frequency_error: frequency_error.or(found.frequency_error),
        ..found
    }
}

/// Returns half the width of a body's swing, in the unit of the swinging coordinate.
fn width_of(truth: &BodyTruth) -> Option<f64> {
    let swing = truth.swing.as_ref()?;
    Some(swing.widest() * truth.amplitudes[swing.coordinate]).filter(|&width| width > 0.0)
}

/// The distance between two exact motions at the ticks of a rate, in amplitudes of the second.
struct Distance {
    /// Largest distance of a coordinate or a velocity, and its time in seconds.
    error: f64,
    at_s: f64,
    /// Largest distance in the last twentieth of the horizon.
    last: f64,
}

impl Distance {
    async fn between(own: &BodyTruth, truth: &BodyTruth, tick_hz: TickRate) -> Self {
        let series = [own.series(tick_hz).await, truth.series(tick_hz).await];
        let horizon = ticks(truth.horizon_s, tick_hz);
        let mut distance = Self { error: 0.0, at_s: 0.0, last: 0.0 };
        for tick in 1..=horizon {
            let [Some(own), Some(exact)] = [&series[0], &series[1]].map(|it| it.at(tick)) else {
                break;
            };
            let parts = own.iter().zip(exact).zip(&truth.amplitudes);
            let parts = parts.map(|((own, exact), amplitude)| match (own - exact).abs() {
                0.0 => 0.0,
                apart => apart / amplitude,
            });
            let off = parts.fold(0.0, f64::max);
            if off > distance.error {
                (distance.error, distance.at_s) = (off, tick_hz.seconds(tick));
            }
            if 20 * tick > 19 * horizon {
                distance.last = distance.last.max(off);
            }
        }
        distance
    }
}
