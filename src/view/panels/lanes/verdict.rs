//! The verdict in a row of the table: a glyph in the verdict's colour, and as many of its words as fit.

use egui::epaint::PathShape;
use egui::{Color32, FontId, Pos2, Stroke, Ui, pos2};

use crate::lab::{Entrant, Lab, Outcome};
use crate::view::panels::{ink, short, tone};
use crate::view::theme::TYPE;

/// Half the size of a glyph, in points.
const HALF: f32 = 4.5;
/// The room that a glyph takes, in points.
pub(super) const GLYPH: f32 = 17.0;

/// What is said in a row, from the longest wording to the shortest.
pub(super) struct Said {
    /// What is known of the method; `None` while it is being judged.
    outcome: Option<Outcome>,
    wordings: Vec<String>,
}

impl Said {
    /// What is said of the method on this index of the list, and of the lane under it if there is one. The judged body is
    /// named, unless the row is the body's own or it is the one `named_above`.
    pub(super) fn of(
        lab: &Lab,
        entry: usize,
        flown: Option<&Entrant>,
        body: Option<usize>,
        named_above: Option<usize>,
    ) -> Self {
        let halts = flown.into_iter().flat_map(|entrant| entrant.lane.halts());
        let mut halts: Vec<_> = halts.filter(|halt| body.is_none_or(|b| b == halt.body)).collect();
        // The displayed body first: of several, not all may fit.
        halts.sort_by_key(|halt| halt.body != lab.view().body);
        if let Some(first) = halts.first() {
            let did = if first.is_blow_up() { "blew up" } else { "gave up" };
            let several = lab.scene().bodies.len() > 1 && body.is_none();
            let name = |body: usize| match several && named_above != Some(body) {
                true => format!(" ({})", lab.scene().bodies[body].name),
                false => String::new(),
            };
            let bodies = flown.map_or(&[][..], |entrant| entrant.lane.bodies());
            let all = halts.iter().map(|halt| {
                let name = &lab.scene().bodies[halt.body].name;
                format!("{name} {}", bodies[halt.body].fate().unwrap_or_default())
            });
            let short = format!("{}{}", first.fate(), name(first.body));
            let outcome = if first.is_blow_up() { Outcome::BlewUp } else { Outcome::GaveUp };
            let all: Vec<String> = all.collect();
            let wordings = vec![all.join("; "), short, did.into()];
            return Self { outcome: Some(outcome), wordings };
        }
        let verdict = lab.viewer().verdict(entry);
        let verdict = match body {
            Some(body) => verdict.and_then(|verdict| verdict.of_bodies.get(body)),
            None => verdict,
        };
        let Some(verdict) = verdict else {
            return Self { outcome: None, wordings: vec!["judging…".into()] };
        };
        let is_named = body.is_none() && named_above != Some(verdict.body);
        Self { outcome: Some(verdict.outcome()), wordings: verdict.wordings(is_named) }
    }

    /// Everything.
    pub(super) fn whole(&self) -> &str {
        &self.wordings[0]
    }

    /// By how bad it is, once that is known.
    pub(super) fn rank(&self) -> Option<f64> {
        let outcome = self.outcome?;
        let place = Outcome::ALL.iter().position(|known| *known == outcome);
        place.map(|place| place as f64)
    }

    /// Draws the glyph and the longest wording that fits between here and `right`.
    pub(super) fn paint(&self, ui: &Ui, left: Pos2, right: f32, colour: Color32) {
        if let Some(outcome) = self.outcome {
            glyph(ui, pos2(left.x + HALF, left.y), outcome);
        }
        let colour = if self.outcome.is_some() { colour } else { ink(ui).dim };
        let room = right - left.x - GLYPH;
        let font = || FontId::proportional(TYPE);
        let fits = |words: &&String| short(ui, words, font(), room, colour).1;
        let last = self.wordings.last().expect("there is a wording");
        let words = self.wordings.iter().find(fits).unwrap_or(last);
        let (text, _) = short(ui, words, font(), room, colour);
        let at = pos2(left.x + GLYPH, left.y - text.size().y / 2.0);
        ui.painter().galley(at, text, colour);
    }
}

/// Draws the sign of an outcome: ● is right, ◆ drifts, ▲ gains, ▼ loses, ✕ is lost, a ring is not known.
fn glyph(ui: &Ui, at: Pos2, outcome: Outcome) {
    let colour = tone(ui, outcome);
    let polygon = |corners: &[(f32, f32)]| {
        let corners = corners.iter().map(|(x, y)| pos2(at.x + x * HALF, at.y + y * HALF)).collect();
        ui.painter().add(PathShape::convex_polygon(corners, colour, Stroke::NONE));
    };
    match outcome {
        Outcome::Rounding | Outcome::Accurate => {
            ui.painter().circle_filled(at, HALF, colour);
        }
        Outcome::NotJudged | Outcome::NoTruth => {
            ui.painter().circle_stroke(at, HALF - 1.0, Stroke::new(1.5, colour));
        }
        Outcome::OutOfPhase => polygon(&[(0.0, -1.15), (1.15, 0.0), (0.0, 1.15), (-1.15, 0.0)]),
        Outcome::GainsEnergy => polygon(&[(0.0, -1.0), (1.1, 0.9), (-1.1, 0.9)]),
        Outcome::LosesEnergy => polygon(&[(-1.1, -0.9), (1.1, -0.9), (0.0, 1.0)]),
        Outcome::GaveUp | Outcome::BlewUp => {
            for side in [-1.0, 1.0] {
                let ends = [-1.0, 1.0]
                    .map(|end| pos2(at.x + side * end * HALF * 0.9, at.y + end * HALF * 0.9));
                ui.painter().line_segment(ends, Stroke::new(2.2, colour));
            }
        }
    }
}
