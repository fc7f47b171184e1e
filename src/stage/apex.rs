//! Compares the height of a jump with that of the exact motion.

use glam::DVec2;

use super::moment::DrawContext;
use super::sketch::Camera;
use super::{Align, Picture, captions};
use crate::run::past::SweptRange;
use crate::run::race::Entrant;
use crate::sim::Bounces;
use crate::sim::number::significant;

/// Half the width of a height mark, in points.
const APEX: f32 = 34.0;
/// Gap between the mark and its words, and width of a letter, in points.
const GAP: f32 = 8.0;
const LETTER: f32 = 7.0;

/// Height (m) of the last jump in the swept ranges; `None` until the body has come down again.
fn apex(swept: impl Iterator<Item = SweptRange>) -> Option<f64> {
    let (mut most_m, mut is_down) = (0.0, false);
    for SweptRange { least, greatest } in swept {
        if greatest > most_m {
            (most_m, is_down) = (greatest, false);
        }
        is_down |= least < most_m / 2.0;
    }
    (is_down && most_m > 0.0).then_some(most_m)
}

/// Marks the height of a body's jump or last bounce, and that of the exact one. Writes the difference in the words that
/// fit, unless the stage is crowded.
pub(super) fn draw(
    picture: &mut Picture,
    camera: &Camera,
    (moment, is_crowded): (&DrawContext<'_>, bool),
    lane: &Entrant,
    index: usize,
) {
    let past = moment.studio.past();
    let since_s = past.changed_s();
    let of_lane = apex(moment.history(lane, index).since(since_s).map(|sample| sample.swept));
    let of_truth = apex(past.truth_curves()[index].since(since_s).map(|sample| sample.swept));
    let bounced = |bounces: &Bounces| {
        let truth = &moment.studio.race().truth().bodies()[index].stepper;
        Some((bounces.apex?, truth.true_bounce(bounces.apex_after)?[1]))
    };
    let heights = match lane.lane.bodies()[index].stepper.bounces() {
        Some(bounces) => bounced(bounces),
        None => of_lane.zip(of_truth),
    };
    let Some((lane_m, exact_m)) = heights else { return };
    let (colour, _) = moment.style(moment.studio.entry(lane));
    for (height, colour) in [(exact_m, moment.palette.exact), (lane_m, colour)] {
        let [x, y] = camera.points(DVec2::new(0.0, height));
        let ends = [[x - APEX, y], [x + APEX, y]];
        picture.pen(camera.rect).dashed(ends, 1.6, colour, [5.0, 3.0]);
    }
    if is_crowded {
        return;
    }
    let percent = 100.0 * (lane_m / exact_m - 1.0);
    let differs = match percent.abs() < 0.05 {
        true => "as high as the exact one".to_owned(),
        false => {
            let way = if percent < 0.0 { "below" } else { "above" };
            let exact = significant(exact_m, 4);
            format!("{} % {way} the exact {exact} m", significant(percent.abs(), 2))
        }
    };
    let [x, y] = camera.points(DVec2::new(0.0, lane_m.min(exact_m)));
    let at = [x - APEX - GAP, y + 4.0];
    let room = at[0] - camera.rect.min[0] - GAP;
    let fits = |words: &String| LETTER * words.chars().count() as f32 <= room;
    let whole = format!("{} m high, {differs}", significant(lane_m, 4));
    let Some(words) = [whole, differs].into_iter().find(fits) else { return };
    let label = captions::text(moment.palette, at, Align::Right, 13.0, moment.palette.text, words);
    picture.labels.push(label.strong());
}

#[cfg(test)]
mod tests {
    use crate::compose;
    use crate::scene::Scene;
    use crate::studio::{StageCommand, Studio};

    #[test]
    fn a_finished_jump_reports_its_error_in_height() {
        let mut studio = Studio::new(Scene::built_in("jump").unwrap());
        let said = |studio: &Studio| -> Vec<String> {
            let labels = compose(studio, [780.0, 440.0]).labels.into_iter();
            labels.map(|label| label.text).filter(|text| text.contains(" m high")).collect()
        };
        assert_eq!(said(&studio).len(), 0);
        studio.apply(StageCommand::ToggleRace);
        (0..45).for_each(|_| studio.tick());
        for (entry, way, percent) in [(0, "below", 6.7), (1, "above", 6.8), (2, "as high", 0.0)] {
            studio.apply(StageCommand::Pick(entry));
            let said = said(&studio);
            assert_eq!(said.len(), 1, "{said:?}");
            assert!(said[0].contains(way), "{said:?}");
            if percent > 0.0 {
                let word = said[0].split(", ").nth(1).unwrap().split(' ').next().unwrap();
                let found: f64 = word.parse().unwrap();
                assert!((found - percent).abs() < 0.6, "{said:?}");
            }
        }
    }
}
