//! The rule for the impacts of a ball that belongs to the recommended method, beside the rule that the scene has.
//!
//! A rule of a lower order than the method's costs the method its order, so that the advice names both together.

use serde_json::{Value, json};

use super::judged::{Row, advised, recommended_row};
use crate::measure::{Adviser, CRITERIA, Verdict, criterion_to_take};
use crate::scene::{LaneSpec, Scene};
use crate::sim::integrators::method;
use crate::sim::{Impact, TickRate};
use crate::tools::source_code::{CodeForm, impact_code_for};

/// A method with a rule that fits it.
pub(super) struct ImpactAdvice {
    spec: LaneSpec,
    criterion: usize,
    /// The lane of a person's own lines or with which the scene opens, if it has another rule.
    yours: Option<(LaneSpec, Verdict)>,
    tick_hz: TickRate,
}

impl ImpactAdvice {
    /// Returns the recommended method with the default rule, or else velocity Verlet with it; `None` if no body of the
    /// scene meets a wall, or neither meets a criterion.
    pub(super) fn of(scene: &Scene, adviser: &Adviser, rows: &[Row]) -> Option<Self> {
        if !scene.bodies.iter().any(|body| body.kind.has_walls) {
            return None;
        }
        let exact: &'static Impact = Default::default();
        let take = criterion_to_take(&advised(rows));
        let row = take.and_then(|criterion| Some(recommended_row(rows, criterion)?.0));
        let found = match row.filter(|row| row.advised.spec.impact == exact) {
            Some(row) => row.advised.clone(),
            None => adviser.judged(LaneSpec::plain(method("velocity-verlet")?)),
        };
        let met = |criterion: usize| Some((criterion, found.met[criterion].met()?.substeps));
        let (criterion, substeps) = (0..CRITERIA.len()).rev().find_map(met)?;
        let spec = LaneSpec { substeps, ..found.spec };
        // Lines of a person's own come before the lane with which the scene opens.
        let mut judged = rows.iter().map(|row| row.advised.spec);
        let own = judged.find(|lane| lane.method.has_own_floor).unwrap_or(*scene.opening_lane());
        let yours = (own.impact != exact).then(|| (own, adviser.verdict(own)));
        Some(Self { spec, criterion, yours, tick_hz: adviser.tick_hz() })
    }

    /// Returns the advice in a line.
    pub(super) fn line(&self) -> String {
        let Self { spec, criterion, yours, tick_hz } = self;
        let steps = if spec.substeps == 1 { "substep" } else { "substeps" };
        let (method, rule) = (spec.method.id, spec.impact.id);
        let met = CRITERIA[*criterion].id();
        let beside = yours.as_ref().map(|(lane, verdict)| {
            let own = match lane.method == spec.method {
                true => lane.impact.id.to_owned(),
                false if lane.method.has_own_floor => lane.method.id.to_owned(),
                false => format!("{} with {}", lane.method.id, lane.impact.id),
            };
            format!("; your {own} at {tick_hz:.3} Hz: {verdict}")
        });
        let beside = beside.unwrap_or_default();
        format!("{method} with {rule}: {met} at {} {steps}{beside}\n", spec.substeps)
    }

    /// Returns the advice as JSON.
    pub(super) fn object(&self) -> Value {
        let yours = self.yours.as_ref().map(|(lane, verdict)| {
            let text = verdict.to_string();
            json!({ "method": lane.method.id, "impact": lane.impact.id, "text": text })
        });
        json!({
            "method": self.spec.method.id,
            "impact": self.spec.impact.id,
            "criterion": CRITERIA[self.criterion].id(),
            "substeps": self.spec.substeps,
            "yours": yours,
        })
    }
}

/// Returns the exact bounces of the scene's ball as code; `None` if its body is no ball that falls without drag.
pub(super) fn exact_code(scene: &Scene, form: CodeForm) -> Option<String> {
    let [body] = &scene.bodies[..] else { return None };
    let of = |key: &str| Some(body.values[body.kind.parameter(key)?.0]);
    let [e, g] = [of("restitution")?, of("gravity_m_per_s2")?];
    let is_free =
        ["drag_per_s", "ceiling_m", "floor_amplitude_m"].iter().all(|key| of(key) == Some(0.0));
    if !is_free {
        return None;
    }
    impact_code_for(Default::default(), form, [e, g]).ok()
}
