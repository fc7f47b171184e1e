//! A loupe for a landing that lies too close to the exact landing to distinguish the two.

use egui::{Align2, Color32, FontId, Painter, Pos2, Stroke, Vec2, vec2};

use crate::chart::PlotArea;
use crate::measure::OneStep;
use crate::stage::number::{enlargement, round};
use crate::theme::PanelPalette;

/// Radius of the loupe, its minimum radius, and its distances from the plot's edges and from everything else in the
/// plot, in points.
const RADIUS: f32 = 44.0;
const MIN_RADIUS: f32 = 28.0;
const INSET: f32 = 6.0;
const APART: f32 = 8.0;
/// Maximum radius of the loupe, relative to the plot's height.
const MAX_PART_OF_HEIGHT: f32 = 0.3;
/// Maximum distance between the two landings that needs a loupe, in points.
const SEEN: f64 = 9.0;
/// Distance between the two landings in the loupe, relative to the loupe's radius.
const REACH: f64 = 0.8;
/// Radii of the method's landing and of the exact one, in points.
const LANDING: f32 = 5.0;
const EXACT: f32 = 7.0;

/// Draws the loupe if it is necessary and there is room. The loupe lies as far as possible from the `taken` places and
/// from the exact motion.
pub(super) fn show(
    painter: &Painter,
    area: &PlotArea,
    step: &OneStep,
    taken: &[Pos2],
    (palette, own): (&PanelPalette, Color32),
) {
    let (Some(landing), Some(exact)) = (step.landing, step.exact_landing()) else { return };
    let [right, up] = area.lengths([0, 1].map(|axis| landing[axis] - exact[axis]));
    let distance = libm::hypot(right, up);
    let radius = RADIUS.min(MAX_PART_OF_HEIGHT * area.rect.height());
    let times = enlargement(distance, REACH * f64::from(radius));
    let Some(times) = times.filter(|_| distance <= SEEN) else { return };
    let room = area.rect.shrink(radius + INSET);
    if radius < MIN_RADIUS || !room.is_positive() {
        return;
    }
    let curve = step.exact.iter().map(|point| area.at(*point));
    let taken: Vec<Pos2> = taken.iter().copied().chain(curve).collect();
    let places = (0..=8)
        .flat_map(|i| [0.0, 0.5, 1.0].map(|down| room.lerp_inside(vec2(i as f32 / 8.0, down))));
    let nearest =
        |place: &Pos2| taken.iter().map(|at| at.distance(*place)).fold(f32::INFINITY, f32::min);
    let furthest = places.max_by(|a, b| nearest(a).total_cmp(&nearest(b)));
    let Some(at) = furthest.filter(|at| nearest(at) > radius + APART) else { return };
    let pointed = area.at(landing);
    let towards = (pointed - at).normalized();
    let thin = Stroke::new(1.0, palette.dim);
    painter.line_segment([at + radius * towards, pointed - (EXACT + 2.0) * towards], thin);
    painter.circle(at, radius, palette.plot, Stroke::new(1.5, palette.dim));
    let half = vec2((right * times / 2.0) as f32, -(up * times / 2.0) as f32);
    let lift = Vec2::new(0.0, -5.0);
    let [exact, landing] = [at + lift - half, at + lift + half];
    painter.line_segment([exact, landing], Stroke::new(1.0, palette.grid));
    painter.circle_stroke(exact, EXACT, Stroke::new(2.2, palette.exact));
    painter.circle(landing, LANDING, own, Stroke::new(1.6, palette.plot));
    let text = format!("×{}", round(times, 1));
    let foot = at + vec2(0.0, radius - 9.0);
    painter.text(foot, Align2::CENTER_CENTER, text, FontId::proportional(11.0), palette.text);
}

#[cfg(test)]
mod tests {
    use crate::scene::Scene;
    use crate::studio::{Instrument, StageCommand, Studio, ViewCommand};
    use crate::tests::testing::TestWindow;

    /// Returns the labels of the loupes in a frame, under the method at this index of the spring's list.
    fn labels(entry: usize) -> Vec<String> {
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        studio.apply(StageCommand::Pick(entry));
        studio.apply(StageCommand::Instrument(Instrument::OneStep));
        studio.apply(ViewCommand::ToggleEnlarged);
        (0..20).for_each(|_| studio.tick());
        let (_, shown) = TestWindow::new([1280.0, 720.0]).panels(&studio, Vec::new());
        shown.words().into_iter().filter(|text| text.starts_with('×')).collect()
    }

    #[test]
    fn a_landing_that_covers_the_exact_one_gets_a_loupe_with_its_scale() {
        assert_eq!(labels(3).len(), 1, "Runge-Kutta 4: {:?}", labels(3));
        assert_eq!(labels(0), Vec::<String>::new(), "explicit Euler can be seen to miss");
    }
}
