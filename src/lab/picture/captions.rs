//! Words and marks on the stage: who, where, how far, and what became of it.

use glam::DVec2;

use super::palette::{self, style};
use super::sketch::{Camera, line};
use super::{Align, Label, Picture, Rect, Rgba};
use crate::lab::number::{round, significant};
use crate::lab::race::Entrant;
use crate::lab::{Halt, Lab, LaneBody};

/// The least height of a cell, in points, that marks along its bottom do not crowd.
const ROOM_FOR_BAR: f32 = 64.0;
/// Room that a scale bar may take at the right of a cell, in points.
const BAR_MARGIN: f32 = 130.0;
/// The least width of a cell, in points, that distance marks do not crowd.
const ROOM_FOR_MARKS: f32 = 330.0;
/// The least size of a cell, in points, that its caption does not crowd.
const ROOM_FOR_CAPTION: [f32; 2] = [70.0, 30.0];
/// From this width of a cell on, in points, numbers fit beside its caption.
const ROOM_FOR_NUMBERS: f32 = 330.0;
/// From this width of a cell on, in points, the method's name fits beside the body's.
const ROOM_FOR_METHOD: f32 = 450.0;

/// Names a lane at the left of its row, with a bar where it is selected.
pub(super) fn lane(picture: &mut Picture, rect: Rect, lab: &Lab, entrant: &Entrant) {
    let method = lab.entries()[entrant.entry].method;
    let (colour, _) = style(method);
    let (left, right) = (rect.min[0] + 8.0, rect.max[0]);
    let middle = (rect.min[1] + rect.max[1]) / 2.0;
    if entrant.lane_number == lab.selected().lane_number {
        let (top, bottom) = (rect.min[1] + 4.0, rect.max[1] - 4.0);
        let x = rect.min[0] + 2.5;
        let bar = line([x, top], [x, bottom.max(top)], 3.0, colour, rect);
        picture.strokes.push(bar);
    }
    let mut write = |y, colour, text: String| {
        picture.labels.push(Label { at: [left, y], align: Align::Left, size: 12.0, colour, text });
    };
    let number = entrant.entry + 1;
    if right - rect.min[0] < ROOM_FOR_CAPTION[0] {
        write(middle, colour, format!("{number}"));
        return;
    }
    // Of several bodies, each has its own cell to say so in.
    let alone = match entrant.lane.bodies() {
        [body] => body.halted(),
        _ => None,
    };
    let y = if alone.is_some() { middle - 8.0 } else { middle };
    write(y, colour, format!("{number} {}", method.name));
    if let Some(halt) = alone {
        write(middle + 8.0, palette::ALARM, format!("halted, tick {}", halt.tick));
    }
}

/// Says at the foot of a cell what no longer goes on in it: the body, where the lane's name does not say so, and
/// the truth.
pub(super) fn halts(picture: &mut Picture, rect: Rect, body: Option<&Halt>, truth: &LaneBody) {
    let width = rect.max[0] - rect.min[0];
    if width < ROOM_FOR_CAPTION[0] {
        return;
    }
    let of_body = body.map(|halt| format!("halted, tick {}", halt.tick));
    let of_truth = truth
        .halted()
        .map(|halt| format!("no {} solution from tick {} on", truth.kind.truth.id(), halt.tick));
    for (text, y) in of_body.into_iter().chain(of_truth).zip([12.0, 27.0]) {
        let at = [rect.min[0] + 9.0, rect.max[1] - y];
        let (colour, size) = (palette::ALARM, 11.0);
        picture.labels.push(Label { at, align: Align::Left, size, colour, text });
    }
}

/// Names a body at the head of its column.
pub(super) fn column(picture: &mut Picture, rect: Rect, lab: &Lab, index: usize) {
    if let Some(at) = caption_place(rect) {
        let (colour, text) = (palette::TEXT, lab.scene().bodies[index].name.clone());
        picture.labels.push(Label { at, align: Align::Left, size: 11.0, colour, text });
    }
}

/// Names the body and the method that it flies under, and says where it is at the present tick.
pub(super) fn solo(picture: &mut Picture, rect: Rect, lab: &Lab, index: usize, flown: &LaneBody) {
    let Some(at) = caption_place(rect) else { return };
    let body = &lab.scene().bodies[index];
    let method = lab.entries()[lab.active()].method;
    let width = rect.max[0] - rect.min[0];
    let text = if width > ROOM_FOR_METHOD {
        format!("{}: {}", body.name, method.name)
    } else {
        body.name.clone()
    };
    let (colour, size) = (style(method).0, 12.0);
    picture.labels.push(Label { at, align: Align::Left, size, colour, text });

    let at = [rect.max[0] - 9.0, at[1]];
    if let Some(halt) = flown.halted() {
        let (colour, text) = (palette::ALARM, format!("halted at tick {}", halt.tick));
        picture.labels.push(Label { at, align: Align::Right, size, colour, text });
    } else if width > ROOM_FOR_NUMBERS {
        let held = lab.viewer().held().filter(|held| held.body == index);
        let (q, v) = match held {
            Some(held) => (&*held.q, &*held.v),
            None => (flown.stepper.q(), flown.stepper.v()),
        };
        let coordinate = &flown.coordinates[0];
        let text = format!(
            "{} = {} {unit}   {} = {} {unit}/s",
            coordinate.name,
            significant(q[0], 4),
            coordinate.velocity,
            significant(v[0], 4),
            unit = coordinate.unit,
        );
        let colour = palette::TEXT;
        picture.labels.push(Label { at, align: Align::Right, size, colour, text });
    }
}

fn caption_place(rect: Rect) -> Option<[f32; 2]> {
    let fits = (0..2).all(|axis| rect.max[axis] - rect.min[axis] >= ROOM_FOR_CAPTION[axis]);
    fits.then_some([rect.min[0] + 9.0, rect.min[1] + 11.0])
}

/// An arrow at the edge of the cell for a body drawn `at` a place beyond it, with its place at the present tick, `told`,
/// as a number.
pub(super) fn arrow(picture: &mut Picture, camera: &Camera, at: DVec2, told: DVec2, colour: Rgba) {
    let Rect { min, max } = camera.rect;
    let place = camera.points(at);
    // Left and right before up and down: a ship's lane is low.
    let Some(axis) = (0..2).find(|&i| place[i] < min[i] || place[i] > max[i]) else { return };
    let other = 1 - axis;
    let (edge, inwards) = if place[axis] < min[axis] { (min, 1.0) } else { (max, -1.0) };
    let along = place[other].clamp(min[other], max[other].max(min[other]));
    let point = |inset: f32| {
        let mut point = [along; 2];
        point[axis] = edge[axis] + inwards * inset;
        point
    };
    let mut arrow = line(point(17.0), point(5.0), 1.0, colour, camera.rect);
    arrow.radii = [7.0, 0.8];
    picture.strokes.push(arrow);
    let (at_text, align) = match (axis, inwards > 0.0) {
        (0, true) => ([point(28.0)[0], along - 12.0], Align::Left),
        (0, false) => ([point(28.0)[0], along - 12.0], Align::Right),
        _ => ([along + 12.0, point(12.0)[1]], Align::Left),
    };
    let text = format!("{} m", significant(told[axis], 3));
    picture.labels.push(Label { at: at_text, align, size: 12.0, colour, text });
}

/// Distance marks along a ship's course.
pub(super) fn distance_marks(picture: &mut Picture, camera: &Camera) {
    let Rect { min, max } = camera.rect;
    if max[0] - min[0] < ROOM_FOR_MARKS || max[1] - min[1] < ROOM_FOR_BAR {
        return;
    }
    let step_m = camera.round_length_m(96.0);
    let (left, right) = camera.span_m();
    let first = libm::ceil(left / step_m);
    let bottom = max[1] - 1.0;
    for i in 0..=((right - left) / step_m) as usize {
        let x_m = (first + i as f64) * step_m;
        let [x, _] = camera.points(DVec2::new(x_m, 0.0));
        if x > min[0] + 20.0 && x < max[0] - BAR_MARGIN {
            let colour = palette::MARK;
            picture.strokes.push(line([x, bottom], [x, bottom - 5.0], 1.0, colour, camera.rect));
            let at = [x, bottom - 12.0];
            let text = format!("{} m", round(x_m, 6));
            picture.labels.push(Label { at, align: Align::Centre, size: 10.0, colour, text });
        }
    }
}

/// How long a round number of metres is.
pub(super) fn scale_bar(picture: &mut Picture, camera: &Camera) {
    let Rect { min, max } = camera.rect;
    if max[0] - min[0] < BAR_MARGIN || max[1] - min[1] < ROOM_FOR_BAR {
        return;
    }
    let length_m = camera.round_length_m(40.0);
    let (right, y, colour) = (max[0] - 10.0, max[1] - 8.0, palette::MARK);
    let left = right - camera.length(length_m);
    picture.strokes.push(line([left, y], [right, y], 1.5, colour, camera.rect));
    for x in [left, right] {
        picture.strokes.push(line([x, y - 3.0], [x, y + 3.0], 1.5, colour, camera.rect));
    }
    let at = [(left + right) / 2.0, y - 10.0];
    let text = format!("{} m", round(length_m, 4));
    picture.labels.push(Label { at, align: Align::Centre, size: 10.0, colour, text });
}
