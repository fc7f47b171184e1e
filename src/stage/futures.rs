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
/// Least distance between the digits at the ends of threads, in points.
const DIGITS: f32 = 15.0;

/// Draws the futures of a body.
pub(super) fn draw(
    picture: &mut Picture,
    moment: &DrawContext<'_>,
    camera: &Camera,
    framing: Framing,
    body: usize,
) {
    let (palette, clip) = (moment.palette, camera.rect);
    let mut ends: Vec<([f32; 2], usize)> = Vec::new();
    for FutureCurve { entry, moments } in futures(&moment.studio.deck, body).iter().rev() {
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
        let Some(entry) = entry else { continue };
        let mut last = places[0];
        for at in &places[1..] {
            if libm::hypotf(at[0] - last[0], at[1] - last[1]) >= APART {
                picture.pen(clip).disc(*at, DOT, colour);
                last = *at;
            }
        }
        ends.push((places[places.len() - 1], *entry));
    }
    ends.retain(|(at, _)| clip.contains(*at));
    ends.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]));
    let mut free = f32::NEG_INFINITY;
    for ([x, y], entry) in ends {
        free = x.max(free + DIGITS);
        let at = [free, (y + 11.0).min(clip.max[1] - 7.0)];
        let colour = moment.style(entry).0;
        let digit =
            captions::text(palette, at, Align::Centre, 12.0, colour, format!("{}", entry + 1));
        picture.labels.push(digit.strong());
    }
}
