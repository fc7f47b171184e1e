//! Compares the heights of a jump or of bounces with those of the exact motion.

use glam::DVec2;

use super::lane::{RaceLane, StageLane};
use super::letters::fitting;
use super::sketch::Camera;
use super::{Align, Picture, captions};
use crate::look::Framing;
use crate::look::palette::fade;
use crate::run::METRICS;
use crate::run::past::{Sample, SweptRange};
use crate::sim::number::significant;
use crate::sim::{Bounces, Stepper};

/// Half the width of a height mark, in points.
const APEX: f32 = 34.0;
/// Gap between the mark and its words, and width of a letter, in points.
const GAP: f32 = 8.0;
const LETTER: f32 = 7.0;

/// Width and pitch of the bars of bounces, their distance from the floor and from the edge, and the size and the place
/// below them of their numbers, in points. Fewest bars for which there must be room.
const BAR: f32 = 11.0;
const PITCH: f32 = 17.0;
const ASIDE: f32 = 18.0;
const NUMBER: f32 = 10.0;
const FEWEST: usize = 3;

/// A longer flight, in ticks, has a peak, even one of the same height as the flight before.
const LEAST_TICKS: u32 = 4;

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
    is_crowded: bool,
    lane: RaceLane<'_>,
    index: usize,
) {
    let (moment, past) = (lane.moment, lane.moment.studio.past());
    let since_s = past.changed_s();
    let of_lane = apex(lane.history(index).since(since_s).map(|sample| sample.swept));
    let of_truth = apex(past.truth_curves()[index].since(since_s).map(|sample| sample.swept));
    let own = &lane.bodies()[index].stepper;
    let bounced = |bounces: &Bounces| {
        let truth = &moment.studio.race().truth().bodies()[index].stepper;
        let floor = floor(&**own);
        let heights = [bounces.apex?, truth.true_bounce(bounces.apex_after)?[1]];
        Some((floor + heights[0], floor + heights[1]))
    };
    let heights = match own.bounces() {
        Some(bounces) => bounced(bounces),
        None => of_lane.zip(of_truth),
    };
    let Some((lane_m, exact_m)) = heights else { return };
    for (height, colour) in [(exact_m, moment.palette.exact), (lane_m, lane.colour())] {
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
    let whole = format!("{} m high, {differs}", significant(lane_m, 4));
    let Some(words) = fitting([whole, differs], LETTER, room) else { return };
    let label = captions::text(moment.palette, at, Align::Right, 13.0, moment.palette.text, words);
    picture.labels.push(label.strong());
}

/// Returns the heights (m) of the flights between impacts, each with the number of impacts before it. The present
/// flight is the last, once it has a height. Hops without a peak are left out.
fn flights<'s>(samples: impl Iterator<Item = &'s Sample>) -> Vec<(u64, f64)> {
    let column = |id: &str| METRICS.iter().position(|metric| metric.id == id);
    let (Some(impacts), Some(apex)) = (column("impacts"), column("apex")) else {
        return Vec::new();
    };
    let (mut found, mut at_first, mut ticks) = (Vec::<(u64, f64)>::new(), f64::NAN, 0);
    let is_new = |height: f64, at_first: f64| height.to_bits() != at_first.to_bits();
    for Sample { metrics, .. } in samples.filter(|it| it.metrics[impacts] >= 1.0) {
        let (n, height) = (metrics[impacts] as u64, metrics[apex]);
        ticks += 1;
        if let Some((last, known)) = found.last_mut()
            && *last == n
        {
            *known = height;
            continue;
        }
        found.pop_if(|(_, known)| ticks <= LEAST_TICKS && !is_new(*known, at_first));
        (at_first, ticks) = (height, 0);
        found.push((n, height));
    }
    // Until its peak, the height is that of the flight before.
    found.pop_if(|(_, height)| !is_new(*height, at_first));
    found
}

/// Returns the place above which a body's heights are counted.
fn floor(body: &dyn Stepper) -> f64 {
    body.bounces().map_or(0.0, |it| body.q()[it.coordinate] - it.height())
}

/// Draws a bar for each bounce of a body with walls, beside its floor: the exact height hollow, that of the lane in
/// front full, those of others as strokes.
pub(super) fn strip(
    picture: &mut Picture,
    camera: &Camera,
    framing: Framing,
    (lanes, front): (&[RaceLane<'_>], RaceLane<'_>),
    index: usize,
) {
    let (moment, colour) = (front.moment, front.colour());
    let truth = &moment.studio.race().truth().bodies()[index];
    let Framing::Fixed { half_m, .. } = framing else { return };
    if !truth.kind.has_walls {
        return;
    }
    let since_s = moment.studio.past().changed_s();
    let of = |lane: RaceLane<'_>| flights(lane.history(index).since(since_s));
    let own = &front.bodies()[index].stepper;
    let base = floor(&**own);
    let [left, floor] = camera.points(DVec2::new(half_m.x, base));
    let room = (camera.rect.max[0] - 2.0 * ASIDE - left) / PITCH;
    let (most, own) = (room.max(0.0) as usize, of(front));
    if most < FEWEST {
        return;
    }
    let head = captions::foot_of_verdicts(camera.rect) + NUMBER;
    let top = |height: f64| camera.points(DVec2::new(0.0, base + height))[1].clamp(head, floor);
    let others = lanes.iter().filter(|lane| lane.id() != front.id());
    let others: Vec<_> = others.map(|lane| (of(*lane), lane.colour())).collect();
    let shown = &own[own.len().saturating_sub(most)..];
    for ((n, height), place) in shown.iter().zip(0_u8..) {
        let x = left + ASIDE + PITCH * f32::from(place);
        let sides = [x, x + BAR];
        let bar = |y: f32| [[sides[0], floor], [sides[0], y], [sides[1], y], [sides[1], floor]];
        let pen = &mut picture.pen(camera.rect);
        if height.is_finite() {
            pen.fill(&bar(top(*height)), fade(colour, 0.6));
        }
        for (heights, colour) in &others {
            if let Some((_, height)) = heights.iter().find(|(other, _)| other == n) {
                let y = top(*height);
                pen.line([sides[0], y], [sides[1], y], 1.6, *colour);
            }
        }
        if let Some([_, exact]) = truth.stepper.true_bounce(*n) {
            pen.ring(&bar(top(exact)), 1.2, moment.palette.exact);
        }
        let at = [x + BAR / 2.0, floor + NUMBER];
        let (words, dim) = (n.to_string(), moment.palette.text);
        picture.labels.push(captions::text(moment.palette, at, Align::Centre, NUMBER, dim, words));
    }
}

#[cfg(test)]
mod tests {
    use super::flights;
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

    #[test]
    fn a_ball_that_lies_on_its_floor_has_no_bars() {
        let mut studio = Studio::new(Scene::built_in("landing").unwrap());
        (0..45).for_each(|_| studio.tick());
        let lane = studio.deck.selected();
        assert!(lane.lane.bodies()[0].stepper.bounces().unwrap().impacts > 5);
        assert_eq!(flights(studio.past().histories(lane.id)[0].since(0.0)), []);
    }

    #[test]
    fn a_strip_has_a_bar_for_each_bounce_of_a_ball() {
        let mut studio = Studio::new(Scene::built_in("perpetual").unwrap());
        (0..420).for_each(|_| studio.tick());
        let found = flights(studio.past().histories(studio.deck.selected().id)[0].since(0.0));
        let numbers: Vec<u64> = found.iter().map(|(n, _)| *n).collect();
        assert_eq!(numbers, [1, 2, 3, 4, 5, 6, 7]);
        // Velocity Verlet with a clamp reaches these heights.
        for (n, wanted) in [(1, 1.022043017), (5, 1.176759684)] {
            assert!((found[n - 1].1 - wanted).abs() < 1e-9, "{found:?}");
        }
        let labels = compose(&studio, [780.0, 440.0]).labels;
        assert!((1..8).all(|n| labels.iter().any(|label| label.text == n.to_string())));
        // On a narrow stage there is no room for bars.
        let narrow = compose(&studio, [160.0, 440.0]).labels;
        assert!(!narrow.iter().any(|label| label.text == "7"));
    }
}
