//! The numbers of lanes: a flag over each body behind, and a badge at the edge for each that left the stage.

use glam::DVec2;

use super::sketch::{Camera, rounded};
use super::{Align, Label, Picture, Rect};
use crate::look::palette::{Palette, Rgba, fade, mix};
use crate::sim::number::{significant, superscript};

/// Height and least width of a flag, and least gap between two, in points.
const FLAG: f32 = 18.0;
const GAP: f32 = 3.0;
/// With more than `MANY` flags, those within `NEAR` points of each other share one.
const MANY: usize = 8;
const NEAR: f32 = 9.0;
/// Most numbers on one flag.
const MAX_NUMBERS: usize = 3;
/// Rounds of pushing flags apart, per flag.
const PUSHES: usize = 3;
/// Height of a badge, least width of one with words, and width of one without.
const BADGE: f32 = 24.0;
const WIDE_BADGE: f32 = 92.0;
const NARROW_BADGE: f32 = 26.0;
/// Width of a badge besides its words, and upper bound of the mean width of their letters, in points.
const BESIDE_WORDS: f32 = 40.0;
const LETTER: f32 = 7.3;
/// From this value on, badges show places as powers of ten.
const FAR_AWAY: f64 = 1e4;

/// The number of a lane, with its place on the stage.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flag {
    /// The place that the flag marks, in points.
    pub(super) at: [f32; 2],
    pub(super) number: usize,
    pub(super) colour: Rgba,
}

/// Lifts flags that would cover the number of the front body at `front`, to the height of its own flag.
pub(super) fn clear_number(flags: &mut [Flag], front: [f32; 2], lift: f32) {
    for flag in flags {
        let [across, down] = [flag.at[0] - front[0], flag.at[1] - lift - front[1]];
        if across.abs() < 2.0 * FLAG && down.abs() < 2.0 * FLAG {
            flag.at[1] = flag.at[1].min(front[1]);
        }
    }
}

/// Draws flags over these places, within `room` and beside the `name` of their body, and pushes overlapping ones
/// apart. With many flags, those at one place share one.
pub(super) fn flags(
    picture: &mut Picture,
    flags: &[Flag],
    lift: f32,
    palette: &Palette,
    (room, clip, name): (Rect, Rect, Option<Rect>),
) {
    let mut shared: Vec<Vec<Flag>> = Vec::new();
    for flag in flags {
        let is_near =
            |other: &Vec<Flag>| (0..2).all(|i| (other[0].at[i] - flag.at[i]).abs() < NEAR);
        match shared.iter_mut().find(|other| flags.len() > MANY && is_near(other)) {
            Some(other) => other.push(*flag),
            None => shared.push(vec![*flag]),
        }
    }
    let half = FLAG / 2.0;
    let [(left, right), (top, bottom)] = [0, 1].map(|axis| {
        let least = room.min[axis] + half;
        (least, (room.max[axis] - half).max(least))
    });
    let over = |flags: &Vec<Flag>| {
        let [x, y] = flags[0].at;
        [x.clamp(left, right), (y - lift - half).clamp(top, bottom)]
    };
    let widths: Vec<f32> = shared.iter().map(|flags| width(flags)).collect();
    let mut places: Vec<[f32; 2]> = shared.iter().map(over).collect();
    let least = |([_, y], width): (&[f32; 2], &f32)| {
        let beside = name.filter(|name| y - half < name.max[1] && y + half > name.min[1]);
        beside.map_or(left, |name| (name.max[0] + GAP + width / 2.0).clamp(left, right))
    };
    let lefts: Vec<f32> = places.iter().zip(&widths).map(least).collect();
    places.iter_mut().zip(&lefts).for_each(|(place, left)| place[0] = place[0].max(*left));
    for _ in 0..PUSHES * places.len() {
        for first in 0..places.len() {
            for second in first + 1..places.len() {
                push_apart(&mut places, &widths, [first, second], (&lefts, right));
            }
        }
    }
    space_out(&mut places, &widths, [room.min[0], room.max[0]]);
    for ((flags, [x, y]), width) in shared.iter().zip(places).zip(widths) {
        let colour = if flags.len() == 1 { flags[0].colour } else { palette.dim };
        let foot = [flags[0].at[0], flags[0].at[1] - lift + 6.0];
        picture.pen(clip).line([x, y + half], foot, 1.4, colour);
        draw_board(picture, [x, y], width, (text(flags), colour), palette, clip);
    }
}

/// Pushes two flags apart if they overlap in one row.
fn push_apart(
    places: &mut [[f32; 2]],
    widths: &[f32],
    [first, second]: [usize; 2],
    (lefts, right): (&[f32], f32),
) {
    let [a, b] = [places[first], places[second]];
    let (low, high) = if a[0] <= b[0] { (first, second) } else { (second, first) };
    let apart = (widths[first] + widths[second]) / 2.0 + GAP;
    let lack = apart - (a[0] - b[0]).abs();
    if lack > 0.0 && (a[1] - b[1]).abs() < FLAG + GAP {
        // If one flag cannot move at the edge, the other moves more.
        let moved = (places[high][0] + lack / 2.0).min(right) - places[high][0];
        let back = (places[low][0] - (lack - moved)).max(lefts[low]);
        let rest = lack - moved - (places[low][0] - back);
        places[low][0] = back;
        places[high][0] = (places[high][0] + moved + rest).min(right);
    }
}

/// Resolves the remaining overlaps without a change of the order. From left to right, each flag starts after the left
/// edge and after its predecessor in the row. Then from right to left, none crosses the right edge.
pub(super) fn space_out(places: &mut [[f32; 2]], widths: &[f32], [left, right]: [f32; 2]) {
    let mut order: Vec<usize> = (0..places.len()).collect();
    order.sort_by(|a, b| places[*a][0].total_cmp(&places[*b][0]));
    let apart = |a: usize, b: usize| (widths[a] + widths[b]) / 2.0 + GAP;
    let in_a_row = |a: [f32; 2], b: [f32; 2]| (a[1] - b[1]).abs() < FLAG + GAP;
    for (i, &flag) in order.iter().enumerate() {
        places[flag][0] = places[flag][0].max(left + widths[flag] / 2.0);
        for &before in &order[..i] {
            if in_a_row(places[before], places[flag]) {
                places[flag][0] = places[flag][0].max(places[before][0] + apart(before, flag));
            }
        }
    }
    for (i, &flag) in order.iter().enumerate().rev() {
        places[flag][0] = places[flag][0].min(right - widths[flag] / 2.0);
        for &after in &order[i + 1..] {
            if in_a_row(places[after], places[flag]) {
                places[flag][0] = places[flag][0].min(places[after][0] - apart(flag, after));
            }
        }
    }
}

/// Text on the flag of some lanes.
fn text(flags: &[Flag]) -> String {
    let numbers = flags.iter().map(|flag| flag.number.to_string());
    match flags.len() {
        0..=MAX_NUMBERS => numbers.collect::<Vec<_>>().join(" "),
        many => format!("{many} lanes"),
    }
}

fn width(flags: &[Flag]) -> f32 {
    let letters = text(flags).chars().count();
    (FLAG - 9.0 + 8.0 * letters as f32).max(FLAG)
}

/// Draws words in a box.
fn draw_board(
    picture: &mut Picture,
    [x, y]: [f32; 2],
    width: f32,
    (text, colour): (String, Rgba),
    palette: &Palette,
    clip: Rect,
) {
    let [wide, high] = [width / 2.0, FLAG / 2.0];
    let shape = rounded([x - wide, y - high], [x + wide, y + high], 0.22 * FLAG);
    let pen = &mut picture.pen(clip);
    pen.fill(&shape, fade(palette.panel, 0.94));
    pen.ring(&shape, 1.5, colour);
    picture.labels.push(Label::new([x, y], Align::Centre, 0.68 * FLAG, colour, text).strong());
}

/// Selects the words of a badge.
type Worded = fn(&Lost) -> &str;

/// A lane whose body is beyond the edge of its cell, or comes and goes.
#[derive(Clone, Debug)]
pub(super) struct Lost {
    flag: Flag,
    /// Whether its badge is at the right edge.
    is_right: bool,
    /// Whether the body left through the left or right edge, rather than above or below.
    is_beside: bool,
    words: String,
}

impl Lost {
    fn words(&self) -> &str {
        &self.words
    }

    /// Its words from the number on.
    fn figure(&self) -> &str {
        let begins = |letter: char| letter.is_ascii_digit() || ['±', '−'].contains(&letter);
        self.words.find(begins).map_or(&self.words, |from| &self.words[from..])
    }

    /// The badge for a body at these places, newest first; `None` if it was always inside `room`.
    pub(super) fn of(
        flag: Flag,
        camera: &Camera,
        room: Rect,
        places: impl Iterator<Item = DVec2> + Clone,
    ) -> Option<Self> {
        // Side of the room for a place, along each axis: -1, 0 or 1.
        let side = |place: DVec2| {
            let at = camera.points(place);
            [0, 1].map(|i| i32::from(at[i] > room.max[i]) - i32::from(at[i] < room.min[i]))
        };
        if places.clone().all(|place| side(place) == [0; 2]) {
            return None;
        }
        let sides: Vec<[i32; 2]> = places.clone().map(side).collect();
        let oldest = sides.iter().rposition(|side| *side != [0; 2])?;
        let told = if sides[0] == [0; 2] { sides[oldest] } else { sides[0] };
        let axis = usize::from(told[0] == 0);
        let swings = [-1, 1].iter().all(|way| sides.iter().any(|side| side[axis] == *way));
        let comes_back = sides[..oldest].contains(&[0; 2]);
        let along = |place: DVec2| [place.x, place.y][axis];
        let furthest =
            places.clone().reduce(|a, b| if along(b).abs() > along(a).abs() { b } else { a });
        let (newest, furthest) = (places.clone().next()?, furthest?);
        let is_beside = axis == 0;
        let told = |value: f64, digits| format!("{} {}", distance(value, digits), camera.unit);
        // No arrow points up or down, so the words do.
        let way = |value: f64| match (is_beside, value < 0.0) {
            (true, _) => "out",
            (false, true) => "down",
            (false, false) => "up",
        };
        let (words, at) = match (swings, comes_back, is_beside) {
            (true, ..) => (format!("swings ±{}", told(along(furthest).abs(), 2)), None),
            (false, true, _) => {
                let value = along(furthest);
                (format!("{} to {}", way(value), told(value, 2)), Some(furthest))
            }
            (false, false, true) => (told(along(newest), 3), Some(newest)),
            (false, false, false) => {
                let value = along(newest);
                (format!("{} at {}", way(value), told(value, 3)), Some(newest))
            }
        };
        let middle = (camera.rect.min[0] + camera.rect.max[0]) / 2.0;
        let is_right = at.is_none_or(|place| camera.points(place)[0] > middle);
        Some(Self { flag, is_right, is_beside, words })
    }
}

/// A distance, from [`FAR_AWAY`] on as a power of ten.
fn distance(value: f64, digits: usize) -> String {
    if value.abs() < FAR_AWAY {
        return significant(value, digits);
    }
    let sign = if value < 0.0 { "−" } else { "" };
    format!("{sign}10{}", superscript(libm::floor(libm::log10(value.abs())) as i32))
}

/// Draws badges at the edges of a cell, in a column, for the lanes that leave it. The column starts at the first
/// height in `tops` (points below the cell's top) from which it fits. Returns the area that stays free.
pub(super) fn badges(
    picture: &mut Picture,
    camera: &Camera,
    lost: &[Lost],
    tops: [f32; 2],
    palette: &Palette,
) -> Rect {
    let clip = camera.rect;
    let mut free = clip;
    let (width, height) = (clip.max[0] - clip.min[0], clip.max[1] - clip.min[1]);
    // In a low cell, a badge is as high as the cell.
    let high = BADGE.min(height).max(1.0);
    let scale = high / BADGE;
    for is_right in [false, true] {
        let of_side: Vec<&Lost> = lost.iter().filter(|badge| badge.is_right == is_right).collect();
        let rows = |top: f32| ((height - top) / (high + 3.0)).max(1.0) as usize;
        let top = if of_side.len() <= rows(tops[0]) { tops[0] } else { tops[1] };
        let top = top.min(height - high);
        let rows = rows(top);
        let widest = |words: Worded| {
            let letters = of_side.iter().map(|badge| words(badge).chars().count()).max();
            (BESIDE_WORDS + LETTER * letters.unwrap_or(0) as f32).max(WIDE_BADGE)
        };
        // In a narrow cell, a badge shows only its number.
        let worded: [(Worded, f32); 2] = [(Lost::words, 3.0), (Lost::figure, 1.6)];
        let worded = worded.map(|(words, times)| (words, widest(words), times));
        let worded = worded
            .into_iter()
            .find(|(_, widest, times)| width > times * widest)
            .filter(|_| of_side.len() <= rows);
        let is_wide = worded.is_some();
        let wide = worded.map_or(NARROW_BADGE, |(_, widest, _)| widest);
        let taken = of_side.len().div_ceil(rows) as f32 * (wide + 8.0);
        match is_right {
            true => free.max[0] -= taken,
            false => free.min[0] += taken,
        }
        for (i, badge) in of_side.into_iter().enumerate() {
            let inset = (i / rows) as f32 * (wide + 8.0) + 6.0;
            let y = clip.min[1] + top + (i % rows) as f32 * (high + 3.0);
            let tip = if is_right { clip.max[0] - inset } else { clip.min[0] + inset };
            let inwards = if is_right { -1.0 } else { 1.0 };
            let far = tip + inwards * wide;
            let middle = y + high / 2.0;
            let shoulder = tip + inwards * if badge.is_beside { 9.0 * scale } else { 0.0 };
            let shape =
                [[tip, middle], [shoulder, y], [far, y], [far, y + high], [shoulder, y + high]];
            picture.pen(clip).fill(&shape, fade(palette.panel, 0.94));
            picture.pen(clip).ring(&shape, 1.6, badge.flag.colour);
            let at = [if is_wide { far - inwards * 14.0 } else { (far + shoulder) / 2.0 }, middle];
            let (colour, dark) = (badge.flag.colour, mix(palette.background, [0, 0, 0, 255], 0.2));
            let number = badge.flag.number.to_string();
            let half = [if number.len() > 1 { 10.0 } else { 7.5 }, 7.5].map(|half| half * scale);
            let corner = |sign: f32| [0, 1].map(|axis| at[axis] + sign * half[axis]);
            let digit = rounded(corner(-1.0), corner(1.0), 3.0 * scale);
            picture.pen(clip).fill(&digit, colour);
            let mut write = |at, size, colour, text| {
                picture.labels.push(Label::new(at, Align::Centre, size, colour, text).strong());
            };
            write(at, 12.0 * scale, dark, number);
            if let Some((words, ..)) = worded {
                let middle_of_text = (far - inwards * 24.0 + shoulder) / 2.0;
                write([middle_of_text, middle], 12.5 * scale, palette.text, words(badge).into());
            }
        }
    }
    free
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::captions::foot_of_verdicts;
    use crate::compose;
    use crate::scene::Scene;
    use crate::studio::{StageCommand, Studio};

    /// Words of the badge for a body at these places, in a cell that shows 5 m to each side, and whether it is at the
    /// right.
    fn badge_words(places: &[[f64; 2]]) -> Option<(String, bool)> {
        let rect = Rect { min: [0.0; 2], max: [100.0, 50.0] };
        let camera = Camera { points_per_metre: 10.0, ..Camera::of(rect, 10.0) };
        let flag = Flag { at: [0.0; 2], number: 1, colour: [255; 4] };
        let places = places.iter().map(|place| DVec2::from(*place));
        Lost::of(flag, &camera, rect, places).map(|lost| (lost.words, lost.is_right))
    }

    fn told_along(places: &[f64]) -> Option<(String, bool)> {
        badge_words(&places.iter().map(|x| [*x, 0.0]).collect::<Vec<_>>())
    }

    #[test]
    fn a_badge_shows_the_distance_even_in_a_lanes_own_cell() {
        let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
        studio.apply(StageCommand::ToggleRace);
        studio.viewer.preferences.display.arrangement = crate::studio::Arrangement::SideBySide;
        (0..10 * studio.race().tick_hz().hz() as u32).for_each(|_| studio.tick());
        for width in [780.0, 490.0] {
            let picture = compose(&studio, [width, 440.0]);
            let told = picture.labels.iter().filter(|label| label.text.starts_with('±'));
            assert!(told.count() >= 1, "at {width} points");
        }
    }

    #[test]
    fn the_badge_shows_the_place_of_a_lost_body_or_its_swing_if_it_returns() {
        let said = |words: &str, is_right| Some((words.to_owned(), is_right));
        assert_eq!(told_along(&[1.0, -4.9, 4.9]), None, "it stayed");
        assert_eq!(told_along(&[23.4, 6.0, 2.0]), said("23.4 m", true), "it left");
        assert_eq!(told_along(&[-3e6, -7.0]), said("−10⁶ m", false), "it left long ago");
        assert_eq!(told_along(&[2.31, -12.0, 0.0, 14.2]), said("swings ±14 m", true));
        assert_eq!(
            told_along(&[-14.2, 3.0, 12.0]),
            said("swings ±14 m", true),
            "the badge stays there"
        );
        assert_eq!(told_along(&[2.0, -7.5, 2.0]), said("out to −7.5 m", false));
    }

    #[test]
    fn the_badge_of_a_body_in_the_plane_shows_its_present_direction() {
        let said = |words: &str, is_right| Some((words.to_owned(), is_right));
        let over_the_top = [[-37.0, 2.0], [-4.0, 2.0], [0.0, 11.0]];
        assert_eq!(badge_words(&over_the_top), said("out to −37 m", false));
        assert_eq!(badge_words(&over_the_top[1..]), said("up to 11 m", false), "it is back");
        assert_eq!(badge_words(&[[1.0, -9.0], [1.0, -5.0]]), said("down at −9.00 m", true));
    }

    #[test]
    fn badges_never_cover_springs_and_flags_never_cover_names() {
        let mut studio = Studio::new(Scene::with_two_springs());
        studio.apply(StageCommand::ToggleRace);
        // The stage follows the selected lane, so that the badges are of the others.
        studio.apply(StageCommand::Pick(1));
        let (mut badges, mut beside) = (0, 0);
        for _ in 0..300 {
            studio.tick();
            // In the last, there is no room for verdicts, and flags stand beside the names.
            for size in [[496.0, 342.0], [794.0, 430.0], [496.0, 170.0]] {
                let picture = compose(&studio, size);
                for (cell, name) in picture.cells.iter().zip(["Spring", "Damped spring"]) {
                    let of_cell =
                        |label: &&Label| cell.rect.contains(label.at) && label.at[1] > 30.0;
                    let name = picture.labels.iter().find(|label| label.text == name).unwrap();
                    let end = name.at[0] + 7.0 * name.text.chars().count() as f32;
                    for label in picture.labels.iter().filter(of_cell) {
                        let is_flag = label.text.len() == 1 && label.size == 0.68 * FLAG;
                        if is_flag && (label.at[1] - name.at[1]).abs() < 0.8 * FLAG {
                            beside += 1;
                            assert!(
                                label.at[0] - FLAG / 2.0 > end,
                                "{} at {:?}",
                                label.text,
                                label.at
                            );
                        }
                        if label.text.starts_with("swings") {
                            badges += 1;
                            let apart = (label.at[1] - cell.camera.at[1]).abs();
                            let wanted = (cell.camera.block + BADGE) / 2.0;
                            assert!(apart >= wanted, "{} at {:?}", label.text, label.at);
                        }
                    }
                }
            }
        }
        assert!(badges > 100 && beside > 100, "{badges} badges, {beside} flags");
    }

    #[test]
    fn flags_stand_below_the_verdicts_of_a_race() {
        let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
        studio.apply(StageCommand::ToggleRace);
        studio.analyse();
        let mut seen = 0;
        for _ in 0..60 {
            studio.tick();
            let picture = compose(&studio, [794.0, 480.0]);
            for cell in &picture.cells {
                let is_flag = |label: &&Label| {
                    label.text.len() == 1
                        && label.size == 0.68 * FLAG
                        && cell.rect.contains(label.at)
                };
                for flag in picture.labels.iter().filter(is_flag) {
                    seen += 1;
                    let top = flag.at[1] - FLAG / 2.0;
                    assert!(top >= foot_of_verdicts(cell.rect), "{} at {:?}", flag.text, flag.at);
                }
            }
        }
        assert!(seen > 100, "{seen} flags");
    }
}
