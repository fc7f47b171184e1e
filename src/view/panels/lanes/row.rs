//! A row of the table of lanes, and the numbers in it.

use super::verdict;
use crate::measure::{ChaseFinding, Verdict};
use crate::panels::verdict::VerdictText;
use crate::run::past::Peaks;
use crate::run::race::{Entrant, LaneBody, Mode};
use crate::run::{METRICS, MenuIndex, Metric, energy_gained_j, energy_gained_percent, energy_j};
use crate::scene::LaneSpec;
use crate::stage::number::significant;
use crate::studio::{Studio, shown_state};

/// A value smaller than this share of its scale is only rounding.
const ROUNDING: f64 = 1e-12;

/// A row of the table, which is about a method. In solo mode it may be about a body of the active lane.
pub(super) struct Row<'a> {
    pub(super) studio: &'a Studio,
    /// Index of the method on the list.
    pub(super) entry: MenuIndex,
    pub(super) spec: &'a LaneSpec,
    /// The lane that flies the method, if any.
    pub(super) entrant: Option<&'a Entrant>,
    /// The body whose numbers are shown.
    pub(super) body: usize,
    /// Whether the row is about `body` alone.
    pub(super) is_of_body: bool,
    /// Whether the row is the first one of its method.
    pub(super) is_first: bool,
    pub(super) is_selected: bool,
    /// First coordinate of the exact body at the displayed moment, if known.
    exact: Option<f64>,
    /// Index of the judged body, if the head of the table names it.
    named_above: Option<usize>,
}

impl<'a> Row<'a> {
    /// Creates the rows of the method at this index of the list. `exact` has the first coordinate of each exact body.
    /// `named_above` is the [judged body](judged_body) if it is the same for all rows.
    pub(super) fn of_method(
        studio: &'a Studio,
        (entry, spec): (usize, &'a LaneSpec),
        exact: &[Option<f64>],
        named_above: Option<usize>,
    ) -> Vec<Self> {
        let entrant = studio.deck.lane_of(entry);
        let shown = studio.view().body;
        let count = studio.scene().bodies.len();
        let is_active = entry == studio.active();
        let is_of_body = studio.mode() == Mode::Solo && entrant.is_some() && count > 1;
        let row = |body: usize| Row {
            studio,
            entry,
            spec,
            entrant,
            body,
            is_of_body,
            is_first: !is_of_body || body == 0,
            is_selected: is_active && (!is_of_body || body == shown),
            exact: exact[body],
            named_above,
        };
        match is_of_body {
            true => (0..count).map(row).collect(),
            false => vec![row(shown)],
        }
    }

    /// Returns the verdict of the row.
    pub(super) fn verdict_text(&self) -> VerdictText {
        let named = (self.is_of_body.then_some(self.body), self.named_above);
        verdict::text_of(self.studio, self.entry, self.entrant, named)
    }

    /// Returns the further findings of the verdict.
    pub(super) fn details(&self) -> Vec<String> {
        let verdict = self.studio.viewer.verdict_from_here(&self.studio.deck, self.entry);
        let of_row = |verdict: &'a Verdict| match self.is_of_body {
            true => verdict.of_bodies.get(self.body),
            false => Some(verdict),
        };
        verdict.and_then(of_row).map(Verdict::details).unwrap_or_default()
    }

    pub(super) fn body_name(&self) -> &'a str {
        &self.studio.scene().bodies[self.body].name
    }

    /// Returns the method's name with its substeps and tolerance.
    pub(super) fn method_name(&self) -> String {
        let within = self.spec.tolerance.map(|tolerance| format!(" {tolerance:e}"));
        self.spec.name_with_substeps(self.studio.entries()) + &within.unwrap_or_default()
    }

    /// Returns the digits of both methods for a lane of a race that was switched, or else the method's name.
    pub(super) fn head(&self) -> String {
        match self.studio.deck.switched(self.entry) {
            Some((to, at_s)) => {
                format!("{} → {} (switched at {at_s:.2} s)", self.entry + 1, to + 1)
            }
            None => self.method_name(),
        }
    }

    fn flown_body(&self) -> Option<&'a LaneBody> {
        Some(&self.entrant?.lane.bodies()[self.body])
    }

    /// Whether there is a truth to compare the body with.
    pub(super) fn has_truth(&self) -> bool {
        self.truth().halted().is_none()
    }

    fn truth(&self) -> &'a LaneBody {
        &self.studio.race().truth().bodies()[self.body]
    }

    /// Returns the largest values of the body so far, if a lane flies the method.
    fn peaks(&self) -> Option<Peaks> {
        Some(self.studio.past().histories(self.entrant?.id)[self.body].peaks())
    }

    /// Returns the value, or 0 if the value is only rounding at this scale.
    fn above_rounding(value: f64, scale: f64) -> f64 {
        if value.abs() < ROUNDING * scale { 0.0 } else { value }
    }

    /// Formats a value with the unit of the body's first coordinate.
    pub(super) fn in_unit(&self, value: f64) -> Option<String> {
        let value = Self::above_rounding(value, self.peaks().map_or(0.0, |most| most.size));
        let unit = self.truth().coordinates().at(0).shown_unit();
        Some(format!("{} {unit}", significant(value, 3)).trim_end().to_owned())
    }

    pub(super) fn position(&self) -> Option<f64> {
        let (q, _) = shown_state(self.studio, self.flown_body()?);
        q.first().copied()
    }

    pub(super) fn exact(&self) -> Option<f64> {
        self.flown_body().and(self.exact)
    }

    /// Returns the metric of the body at this index of [`METRICS`], if a lane flies the method.
    fn measure(&self, metric: usize) -> Option<f64> {
        (METRICS[metric].measure)(self.flown_body()?, self.truth())
    }

    /// Returns the largest position error so far, if there is a truth.
    pub(super) fn largest_error(&self) -> Option<f64> {
        self.peaks().filter(|_| self.has_truth()).map(|most| most.error)
    }

    /// Returns the angle (rad) between the attitudes of the body and of the truth, if it turns in space.
    pub(super) fn attitude_error(&self) -> Option<f64> {
        let angle = self.measure(Metric::ATTITUDE_ERROR)?;
        Some(Self::above_rounding(angle, std::f64::consts::TAU))
    }

    /// Returns the energy that the body has gained over the truth with its unit, in percent, or else in joules. Without
    /// a truth, returns the total energy of the body.
    pub(super) fn energy(&self) -> Option<(f64, &'static str)> {
        let (lane, truth) = (self.flown_body()?, self.truth());
        if !self.has_truth() {
            return Some((energy_j(lane)?, "J"));
        }
        match energy_gained_percent(lane, truth) {
            Some(percent) => Some((Self::above_rounding(percent, 100.0), "%")),
            None => {
                let scale = energy_j(truth).map_or(0.0, f64::abs);
                Some((Self::above_rounding(energy_gained_j(lane, truth)?, scale), "J"))
            }
        }
    }

    /// Returns the half-life of the body, in milliseconds, in this lane, or else in the verdict.
    pub(super) fn half_life_ms(&self) -> Option<f64> {
        let judged = || Some(1e3 * self.chase()?.half_life_s?);
        self.measure(Metric::HALF_LIFE).or_else(judged)
    }

    /// Returns the overshoot of the body, in percent, in this lane, or else in the verdict.
    pub(super) fn overshoot_percent(&self) -> Option<f64> {
        let judged = || Some(self.chase()?.overshoot_percent);
        self.measure(Metric::OVERSHOOT).or_else(judged)
    }

    fn chase(&self) -> Option<&'a ChaseFinding> {
        self.studio.viewer.verdict(self.entry)?.of_bodies.get(self.body)?.chase.as_ref()
    }

    pub(super) fn evaluations(&self) -> Option<u64> {
        Some(self.flown_body()?.stepper.evaluations())
    }

    /// Returns the evaluations per tick according to the method's card, or else in the last tick. Returns `None` for a
    /// halted body.
    pub(super) fn cost(&self) -> Option<f64> {
        let body = self.flown_body();
        if body.is_some_and(|body| body.halted().is_some()) {
            return None;
        }
        let substeps = self.entrant.map_or(self.spec.substeps, |entrant| entrant.lane.substeps());
        let of_card = self.spec.method.evaluations_per_tick(substeps).map(f64::from);
        let of_last_tick = || body.map(|body| body.evaluations_of_last_tick() as f64);
        of_card.or_else(|| of_last_tick().filter(|&count| count > 0.0))
    }
}

/// Returns the body that the verdicts on all methods of a race are about, if it is the same one and the scene has
/// several. The table names this body once, above the rows.
pub(super) fn judged_body(studio: &Studio) -> Option<usize> {
    if studio.mode() == Mode::Solo || studio.scene().bodies.len() < 2 {
        return None;
    }
    let lanes = studio.race().entrants().iter();
    let mut bodies = lanes.map(|lane| Some(studio.viewer.verdict(studio.entry(lane))?.body));
    let first = bodies.next()??;
    bodies.all(|body| body == Some(first)).then_some(first)
}
