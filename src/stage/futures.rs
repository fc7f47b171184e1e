//! The fan of futures on the stage: one thread for each method's next second with a dot per tick, and a white one for
//! the exact motion. On a chart recorder it hangs from the mass in place of the trail. The numbers of the methods stand
//! below the ends of their threads, in the order of the ends.

use super::moment::DrawContext;
use super::sketch::Camera;
use super::{Align, Picture, Rect, captions, flags};
use crate::look::Framing;
use crate::look::palette::fade;
use crate::measure::{FutureCurve, FutureMoment};

/// Half the width of a thread, and of the exact one, in points.
const THREAD: f32 = 1.7;
const EXACT: f32 = 1.5;
/// Radius of a dot, and least distance between dots, in points.
const DOT: f32 = 2.6;
const APART: f32 = 7.0;
/// Words at the end of the exact thread. The ghost, which is exact since the start, is named elsewhere.
const EXACT_FROM_HERE: &str = "exact from here";
/// Width of a digit with the gap beside it, and mean width of a letter, in points. Threads whose ends are closer than a
/// digit share one tag.
const DIGIT: f32 = 13.0;
const LETTER: f32 = 6.6;
/// Least distance of a digit from the edge of the stage, in points.
const MARGIN: f32 = 26.0;
/// From the end of a thread down to its tag, half the height of a tag, and distance of a leader from both, in points.
const BELOW: f32 = 14.0;
const HALF_LINE: f32 = 7.0;
const CLEAR: f32 = 2.0;
/// Opacity of the plate behind a tag.
const PLATE: f32 = 0.8;
/// Least shift (points) of a tag beside the end of its thread for a leader.
const SHIFTED: f32 = 5.0;

/// The end of a thread in points, and the index of its method; `None` for the truth.
pub(super) type End = ([f32; 2], Option<usize>);

/// Draws the futures of a body within `clip`, and returns their ends.
pub(super) fn draw(
    picture: &mut Picture,
    moment: &DrawContext<'_>,
    (camera, clip): (&Camera, Rect),
    framing: Framing,
    mut futures: Vec<FutureCurve>,
) -> Vec<End> {
    let palette = moment.palette;
    let mut ends: Vec<End> = Vec::new();
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
    ends
}

/// Writes the numbers of the methods below the ends of their threads, from left to right in the order of the ends.
/// Ends closer than a digit share one tag with one leader.
pub(super) fn label_ends(
    picture: &mut Picture,
    moment: &DrawContext<'_>,
    mut ends: Vec<End>,
    clip: Rect,
) {
    ends.sort_by(|(a, _), (b, _)| a[0].total_cmp(&b[0]));
    let mut tags: Vec<Vec<End>> = Vec::new();
    for end in ends {
        let is_near =
            |tag: &&mut Vec<End>| (0..2).all(|axis| (tag[0].0[axis] - end.0[axis]).abs() < DIGIT);
        match tags.iter_mut().rev().find(is_near) {
            Some(tag) => tag.push(end),
            None => tags.push(vec![end]),
        }
    }
    // Within a tag the methods have the order of their keys, and the truth is last.
    tags.iter_mut().for_each(|tag| tag.sort_by_key(|(_, entry)| entry.unwrap_or(usize::MAX)));
    let wide = |entry: Option<usize>| match entry {
        Some(_) => DIGIT,
        None => LETTER * (EXACT_FROM_HERE.len() + 1) as f32,
    };
    let widths: Vec<f32> =
        tags.iter().map(|tag| tag.iter().map(|(_, entry)| wide(*entry)).sum()).collect();
    let middles: Vec<[f32; 2]> = tags
        .iter()
        .map(|tag| [0, 1].map(|i| tag.iter().map(|(at, _)| at[i]).sum::<f32>() / tag.len() as f32))
        .collect();
    let place = |[x, y]: &[f32; 2]| [*x, (y + BELOW).min(clip.max[1] - HALF_LINE)];
    let mut places: Vec<[f32; 2]> = middles.iter().map(place).collect();
    flags::space_out(&mut places, &widths, [clip.min[0], clip.max[0]]);
    for (((tag, end), [x, y]), width) in tags.iter().zip(middles).zip(places).zip(widths) {
        let mut left = x - width / 2.0;
        // On a body of their own colour the digits would hardly be seen.
        let [top, bottom] = [y - HALF_LINE - CLEAR, y + HALF_LINE + CLEAR];
        let plate = [[left, top], [left + width, top], [left + width, bottom], [left, bottom]];
        picture.pen(clip).fill(&plate, fade(moment.palette.sea[1], PLATE));
        for &(_, entry) in tag {
            let (words, colour) = match entry {
                Some(entry) => (format!("{}", entry + 1), moment.style(entry).0),
                None => (EXACT_FROM_HERE.to_owned(), moment.palette.exact),
            };
            let at = [left + wide(entry) / 2.0, y];
            let label = captions::text(moment.palette, at, Align::Centre, 12.0, colour, words);
            picture.labels.push(label.strong());
            left += wide(entry);
        }
        if tag.len() > 1 || (x - end[0]).abs() > SHIFTED {
            let (from, to) = ([end[0], end[1] + CLEAR], [x, y - HALF_LINE + CLEAR]);
            picture.pen(clip).line(from, to, 1.0, moment.palette.text);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compose;
    use crate::scene::Scene;
    use crate::studio::{Studio, ViewCommand, futures};

    const NUMBERS: [&str; 9] = ["1", "2", "3", "4", "5", "6", "7", "8", "9"];

    /// A tag's words, and where they stand.
    type Tag = (String, f32, f32);

    /// Returns the tags, and the methods of the threads from left to right with the places of their ends.
    fn fan(studio: &Studio, size: [f32; 2]) -> (Vec<Tag>, Vec<(usize, f32)>) {
        let picture = compose(studio, size);
        let is_of_fan = |text: &str| NUMBERS.contains(&text) || text == EXACT_FROM_HERE;
        let labels = picture
            .labels
            .iter()
            .filter(|it| it.size == 12.0 && it.is_strong && it.halo[3] > 0 && is_of_fan(&it.text));
        let words = labels.map(|it| (it.text.clone(), it.at[0], it.at[1])).collect();
        let camera = picture.cells[0].camera;
        let end = |curve: &FutureCurve| {
            let last = curve.moments[curve.moments.len() - 1];
            Some((curve.entry?, camera.points(last.at)[0]))
        };
        (words, futures(&studio.deck, 0).iter().filter_map(end).collect())
    }

    #[test]
    fn the_numbers_of_the_fan_have_the_order_of_the_threads_ends() {
        let mut shared = 0;
        for hz in [5, 8, 10, 12, 18, 30, 60, 144, 240, 1000] {
            let scene = Scene { tick_hz: hz.into(), ..Scene::built_in("harbour").unwrap() };
            let mut studio = Studio::new(scene);
            studio.apply(ViewCommand::ToggleFutures);
            for _ in 0..7 {
                (0..1 + hz / 7).for_each(|_| studio.tick());
                for size in [[390.0, 420.0], [1000.0, 490.0]] {
                    let (words, ends) = fan(&studio, size);
                    let edge = 50.0 + DIGIT;
                    let within = |x: f32| (edge..size[0] - MARGIN - DIGIT).contains(&x);
                    let seen = ends.iter().filter(|(_, x)| within(*x));
                    for &(entry, x) in seen.clone() {
                        let of = |entry: usize| {
                            let found = words.iter().find(|it| it.0 == NUMBERS[entry]);
                            found.unwrap_or_else(|| panic!("{entry} at {hz} Hz: {words:?}")).1
                        };
                        let right = seen.clone().filter(|(_, other)| *other > x + DIGIT);
                        for &(other, _) in right {
                            assert!(of(entry) < of(other), "{hz} Hz: {words:?}, {ends:?}");
                        }
                    }
                    for (i, a) in words.iter().enumerate() {
                        for b in &words[i + 1..] {
                            let wide = |text: &str| match text {
                                EXACT_FROM_HERE => LETTER * text.len() as f32,
                                _ => 8.0,
                            };
                            let apart = (wide(&a.0) + wide(&b.0)) / 2.0;
                            let is_free = (a.1 - b.1).abs() >= apart || (a.2 - b.2).abs() > 12.0;
                            assert!(is_free, "{hz} Hz, {size:?}: {a:?} {b:?} of {words:?}");
                            shared += usize::from((a.1 - b.1).abs() < DIGIT + 0.1);
                        }
                    }
                    let exact = words.iter().filter(|it| it.0 == EXACT_FROM_HERE);
                    assert_eq!(exact.count(), 1, "{hz} Hz: {words:?}");
                }
            }
        }
        assert!(shared > 50, "{shared} neighbours in a tag");
    }
}
