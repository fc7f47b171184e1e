//! The verdict in a row of a table: a sign in the verdict's colour, and as many of its words as fit.

use egui::epaint::PathShape;
use egui::{Color32, FontId, Pos2, Rect, Stroke, Ui, pos2, vec2};

use super::parts::{severity_tone, short};
use crate::look::palette::STALE;
use crate::measure::{Severity, Sign};
use crate::theme::{TYPE, palette};

/// Half the size of a sign, and width for the sign, in points.
const HALF: f32 = 4.5;
const ROOM: f32 = 17.0;

/// The verdict in a row.
pub(super) struct VerdictText {
    /// The sign and its colour, or `None` before the judgement.
    pub(super) sign: Option<(Sign, Severity)>,
    /// Whether the verdict is about the present tick rate. If not, the sign is dimmed.
    pub(super) is_current: bool,
    /// Wordings from the longest to the shortest.
    pub(super) wordings: Vec<String>,
    /// Rank of the verdict for sorting, if known.
    pub(super) rank: Option<f64>,
}

fn paint(sign: Sign, ui: &Ui, at: Pos2, colour: Color32) {
    let polygon = |corners: &[(f32, f32)]| {
        let corners = corners.iter().map(|(x, y)| at + HALF * vec2(*x, *y)).collect();
        ui.painter().add(PathShape::convex_polygon(corners, colour, Stroke::NONE));
    };
    match sign {
        Sign::Disc => drop(ui.painter().circle_filled(at, HALF, colour)),
        Sign::Ring => {
            ui.painter().circle_stroke(at, HALF - 1.0, Stroke::new(1.5, colour));
        }
        Sign::Diamond => polygon(&[(0.0, -1.15), (1.15, 0.0), (0.0, 1.15), (-1.15, 0.0)]),
        Sign::Rising => polygon(&[(0.0, -1.0), (1.1, 0.9), (-1.1, 0.9)]),
        Sign::Falling => polygon(&[(-1.1, -0.9), (1.1, -0.9), (0.0, 1.0)]),
        Sign::Cross => {
            for side in [-1.0, 1.0] {
                let ends = [-1.0, 1.0].map(|end| at + 0.9 * HALF * vec2(side * end, end));
                ui.painter().line_segment(ends, Stroke::new(2.2, colour));
            }
        }
    }
}

impl VerdictText {
    /// Returns the longest wording.
    pub(super) fn whole(&self) -> &str {
        &self.wordings[0]
    }

    /// Shows only the sign, centred at `at`.
    pub(super) fn paint_sign(&self, ui: &Ui, at: Pos2) {
        if let Some((sign, severity)) = self.sign {
            let tone = severity_tone(ui, severity);
            let tone = if self.is_current { tone } else { tone.gamma_multiply(STALE) };
            paint(sign, ui, at, tone);
        }
    }

    /// Shows the sign and the longest wording that fits.
    pub(super) fn show(&self, ui: &Ui, cell: Rect, colour: Color32) {
        let left = cell.left_center();
        self.paint_sign(ui, pos2(left.x + HALF, left.y));
        let colour = if self.sign.is_some() { colour } else { palette(ui).dim };
        let room = cell.width() - ROOM;
        let fitted = |words: &String| short(ui, words, FontId::proportional(TYPE), room, colour);
        let fits = self.wordings.iter().map(fitted).find(|(_, is_whole)| *is_whole);
        let shortest = || fitted(self.wordings.last().expect("there is a wording"));
        let (text, _) = fits.unwrap_or_else(shortest);
        ui.painter().galley(left + vec2(ROOM, -text.size().y / 2.0), text, colour);
    }
}
