//! The fan of futures on the stage: one thread for each method's next second with a dot per tick, and a white one for
//! the exact motion. On a chart recorder it hangs from the mass in place of the trail.

use super::moment::DrawContext;
use super::sketch::Camera;
use super::{Align, Picture, captions};
use crate::look::Framing;
use crate::measure::{FutureCurve, FutureMoment};
use crate::studio::futures;

/// Half the width of a thread, and of the exact one, in points.
const THREAD: f32 = 1.7;
const EXACT: f32 = 1.5;
/// Radius of a dot, and least distance between dots, in points.
const DOT: f32 = 2.6;
const APART: f32 = 7.0;
/// Room for a digit at the end of a thread, and for the word at the end of the exact one, in points.
const DIGIT: f32 = 15.0;
const WORD: f32 = 40.0;
/// Least distance of a digit from the edge of the stage, in points.
const MARGIN: f32 = 26.0;
/// From the end of a thread down to its digit, and half the height of a digit, in points.
const BELOW: f32 = 11.0;
const HALF_LINE: f32 = 7.0;

/// Draws the futures of a body.
pub(super) fn draw(
    picture: &mut Picture,
    moment: &DrawContext<'_>,
    camera: &Camera,
    framing: Framing,
    body: usize,
) {
    let (palette, clip) = (moment.palette, camera.rect);
    let mut ends: Vec<([f32; 2], Option<usize>)> = Vec::new();
    let mut futures = futures(&moment.studio.deck, body);
    // The truth comes last, over the others, and below it the first method.
    let methods = futures.len().saturating_sub(1);
    futures[..methods].reverse();
    for FutureCurve { entry, moments } in &futures {
        let now_s = moments[0].t;
        let place = |at: &FutureMoment| match framing {
            Framing::Recorder { .. } => camera.paper_point(at.at, at.t - now_s),
            Framing::Follow { .. } | Framing::Fixed { .. } => camera.points(at.at),
        };
        let (colour, width) = match entry {
            Some(entry) => (moment.style(*entry).0, THREAD),
            None => (palette.exact, EXACT),
        };
        let places: Vec<[f32; 2]> = moments.iter().map(place).collect();
        if places.len() > 1 {
            picture.pen(clip).path(places.iter().copied(), width, colour);
        }
        // A thread whose end is off the stage ends where it first leaves it.
        let end = places.last().filter(|at| clip.contains(**at));
        if let Some(end) = end.or(places.iter().find(|at| !clip.contains(**at))) {
            // The order of the bounds suits a stage of no size too.
            let at = [0, 1]
                .map(|axis| end[axis].max(clip.min[axis] + MARGIN).min(clip.max[axis] - MARGIN));
            ends.push((at, *entry));
        }
        if entry.is_none() {
            continue;
        }
        let mut last = places[0];
        for at in &places[1..] {
            if libm::hypotf(at[0] - last[0], at[1] - last[1]) >= APART {
                picture.pen(clip).disc(*at, DOT, colour);
                last = *at;
            }
        }
    }
    // From the top, so that a digit gives way downwards or to the left.
    ends.sort_by(|a, b| a.0[1].total_cmp(&b.0[1]).then(a.0[0].total_cmp(&b.0[0])));
    let mut taken: Vec<([f32; 2], f32)> = Vec::new();
    for ([x, y], entry) in ends {
        let (words, colour, size) = match entry {
            Some(entry) => (format!("{}", entry + 1), moment.style(entry).0, DIGIT),
            None => ("exact".to_owned(), palette.exact, WORD),
        };
        let y = (y + BELOW).min(clip.max[1] - HALF_LINE);
        let is_free = |x: f32| {
            let is_apart = |([at_x, at_y], wide): &([f32; 2], f32)| {
                (at_x - x).abs() >= (wide + size) / 2.0 || (at_y - y).abs() >= 2.0 * HALF_LINE
            };
            let is_within = x - size / 2.0 >= clip.min[0] && x + size / 2.0 <= clip.max[0];
            is_within && taken.iter().all(is_apart)
        };
        let steps = (0..40).flat_map(|n| [1.0, -1.0].map(|way| x + way * n as f32 * DIGIT / 2.0));
        let Some(x) = steps.into_iter().find(|x| is_free(*x)) else { continue };
        taken.push(([x, y], size));
        let label = captions::text(palette, [x, y], Align::Centre, 12.0, colour, words);
        picture.labels.push(label.strong());
    }
}
