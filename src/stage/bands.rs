//! Bands of lanes one below the other: the name and the verdict above each body, and a card with the lane's code.

use super::captions::{self, plate, text};
use super::lane::{Chip, RaceLane, StageLane};
use super::letters::width;
use super::{Align, Label, Picture, Rect, breakpoints, chart};
use crate::look::palette::{Palette, Rgba, fade};
use crate::measure::Outcome;
use crate::sim::number::{counted, significant};
use crate::studio::bare_lines;

/// Width of the column of cards relative to the stage, and its least and greatest width in points.
const COLUMN: f32 = 0.25;
const COLUMNS: [f32; 2] = [216.0, 430.0];
/// Height of a strip for a card below the body on a narrow stage, in points.
const STRIP: f32 = 60.0;
/// Distance of a card from the sides of its room, from its head and foot, and of its words from its rim, in points.
const AROUND: [f32; 2] = [18.0, 3.0];
const PADDING: [f32; 2] = [11.0, 8.0];
/// Sizes of code from best to worst in points, the last, and distance of its lines and width of its letters relative to
/// its size.
const SIZES: [f32; 9] = [18.0, 16.0, 14.0, 13.0, 12.0, 11.0, 10.0, 9.0, LEAST];
const LEAST: f32 = 8.5;
const LEADING: f32 = 1.22;
const LETTER: f32 = 0.602;
/// Size of words below code, mean width of their letters, their height, and that of the bar below them, in points.
const SMALL: f32 = 11.5;
const SMALL_LETTER: f32 = 6.1;
const ROW: f32 = 18.0;
const BAR: f32 = 10.0;
/// Sizes of a name, and of a verdict, and mean widths of their letters, in points.
const NAME: [f32; 2] = [16.0, 8.7];
const VERDICT: [f32; 2] = [14.5, 7.7];
/// Distance between the two, and size of both in a narrow or low band, relative to the usual one.
const BETWEEN: f32 = 18.0;
const SMALLER: f32 = 0.82;
/// Greatest distance of a thread between two cards from the lines that it joins, in points.
const AWAY: f32 = 70.0;
/// Ends of the scale of errors, in decades of the coordinate's unit.
const DECADES: [f64; 2] = [-6.0, 2.0];

/// The parts of a band.
pub(super) struct Band {
    pub(super) ruler: Option<Rect>,
    pub(super) cell: Rect,
    /// Room for the card.
    pub(super) card: Option<Rect>,
}

impl Band {
    /// Divides a band: the card is at the right, or below the body on a narrow stage.
    pub(super) fn of(band: Rect) -> Self {
        let [width, height] = band.sides();
        let mut rest = band;
        let card = if width >= breakpoints::CARD_BESIDE {
            let [least, most] = COLUMNS;
            rest.max[0] -= (COLUMN * width).clamp(least, most);
            Some(Rect { min: [rest.max[0], band.min[1]], max: band.max })
        } else if height >= breakpoints::CARD_BELOW {
            rest.max[1] -= STRIP;
            Some(Rect { min: [band.min[0], rest.max[1]], max: band.max })
        } else {
            None
        };
        let (ruler, cell) = chart::under_ruler(rest, height >= breakpoints::RULER_OF_BAND);
        Self { ruler, cell, card }
    }
}

/// Writes the name of the lane's method at the head of its cell, and the verdict beside it in the words of an eye.
pub(super) fn head(picture: &mut Picture, cell: Rect, lane: RaceLane<'_>, swing_m: Option<f64>) {
    let height = cell.max[1] - cell.min[1];
    if height < breakpoints::SCALE_BAR {
        return;
    }
    let (left, name) = (captions::left_of(cell), lane.name());
    let found = verdict(lane, swing_m);
    let wide = |[_, letter]: [f32; 2], words: &str| width(letter, words);
    let words = found.as_ref().map_or("", |(words, _)| words);
    let whole = wide(NAME, &name) + BETWEEN + wide(VERDICT, words);
    let is_low = height < breakpoints::LOW_BAND;
    let size = if is_low || left + whole > cell.max[0] { SMALLER } else { 1.0 };
    let y = cell.min[1] + if is_low { 10.0 } else { 15.0 };
    let beside = left + size * (wide(NAME, &name) + BETWEEN);
    let named = Some((left, NAME[0], lane.colour(), name));
    let judged = found.map(|(words, colour)| (beside, VERDICT[0], colour, words));
    let judged = judged.filter(|_| left + size * whole <= cell.max[0]);
    for (x, type_size, colour, words) in named.into_iter().chain(judged) {
        let (palette, size) = (lane.moment.palette, size * type_size);
        let label = text(palette, [x, y], Align::Left, size, colour, words);
        picture.labels.push(label.strong());
    }
}

/// The halt of a lane's body, or else the verdict with its sign, in its colour.
fn verdict(lane: RaceLane<'_>, swing_m: Option<f64>) -> Option<(String, Rgba)> {
    let body = &lane.bodies()[0];
    if let Some(halt) = body.halted() {
        let severity = Outcome::of_halt(halt).severity();
        return Some((halt.fate(), lane.moment.palette.of_severity(severity)));
    }
    let unit = body.coordinates().at(0).shown_unit();
    let Chip { sign, colours, wordings } = Chip::in_words(lane, 0, |verdict| {
        vec![match swing_m {
            Some(swing_m) => verdict.for_the_eye(swing_m, unit),
            None => verdict.to_string(),
        }]
    })?;
    Some((format!("{sign} {}", wordings[0]), colours[0]))
}

/// The code of a lane, laid out in its room.
pub(super) struct Card {
    colour: Rgba,
    rect: Rect,
    lines: Vec<String>,
    size: f32,
    /// Evaluations in words, and the largest error so far with its unit.
    figures: Option<(String, f64, &'static str)>,
}

impl Card {
    /// The card of a lane in this room; `None` if not even a line fits.
    pub(super) fn of(lane: RaceLane<'_>, room: Rect) -> Option<Self> {
        let studio = lane.moment.studio;
        let figures = studio.has_chosen_bands().then(|| {
            let count = studio.deck.evaluations_of_next_tick(lane.entry());
            let error = lane.history(0).peaks().error;
            let unit = lane.bodies()[0].coordinates().at(0).shown_unit();
            (counted(count, "evaluation"), error, unit)
        });
        let [width, height] =
            [0, 1].map(|axis| room.size()[axis] as f32 - 2.0 * (AROUND[axis] + PADDING[axis]));
        let has_room = height >= 2.0 * LEADING * LEAST + ROW + BAR;
        let below = if figures.is_some() && has_room { ROW + BAR } else { 0.0 };
        let code = bare_lines(lane.entrant.spec.method);
        let close: Vec<String> = code.iter().map(|line| closed_up(line)).collect();
        let fitted = SIZES.into_iter().find_map(|size| {
            let letters = (width / (LETTER * size)) as usize;
            [&code, &close].into_iter().find_map(|code| {
                let is_fit = code.iter().all(|line| line.chars().count() <= letters)
                    && code.len() as f32 * LEADING * size <= height - below;
                is_fit.then(|| (code.clone(), size))
            })
        });
        let unread = format!("{} lines of code", code.len());
        let (lines, size, figures, below) = match (fitted, figures) {
            (Some((lines, size)), figures) => (lines, size, figures, below),
            // A low card has room for figures or for a line.
            (None, Some(figures)) => {
                let said = format!("{unread} · {}", figures.0);
                (Vec::new(), SMALL, Some((said, figures.1, figures.2)), ROW + BAR)
            }
            (None, None) => (vec![unread], SMALL, None, 0.0),
        };
        let inside = lines.len() as f32 * LEADING * size + below;
        if inside > height || width < 0.0 {
            return None;
        }
        let half = inside / 2.0 + PADDING[1];
        let middle = (room.min[1] + room.max[1]) / 2.0;
        let rect = Rect {
            min: [room.min[0] + AROUND[0], middle - half],
            max: [room.max[0] - AROUND[0], middle + half],
        };
        let (colour, figures) = (lane.colour(), figures.filter(|_| below > 0.0));
        Some(Self { colour, rect, lines, size, figures })
    }

    /// The middle of a line of code, in points.
    fn y_of(&self, line: usize) -> f32 {
        self.rect.min[1] + PADDING[1] + (line as f32 + 0.5) * LEADING * self.size
    }

    fn draw(&self, picture: &mut Picture, palette: &Palette, stage: Rect) {
        plate(picture, self.rect, self.colour, stage, palette);
        let left = self.rect.min[0] + PADDING[0];
        for (index, line) in self.lines.iter().enumerate() {
            let at = [left, self.y_of(index)];
            let label = Label::new(at, Align::Left, self.size, palette.text, line.clone());
            picture.labels.push(Label { is_code: true, ..label });
        }
        let Some((evaluations, error, unit)) = &self.figures else { return };
        let bottom = self.rect.max[1] - PADDING[1];
        let error_in_words = format!("error {} {unit}", significant(*error, 2));
        let whole = format!("{evaluations} · {error_in_words}");
        let room = self.rect.max[0] - self.rect.min[0] - 2.0 * PADDING[0];
        let words = if width(SMALL_LETTER, &whole) <= room { whole } else { error_in_words };
        let at = [left, bottom - BAR - 0.45 * ROW];
        picture.labels.push(Label::new(at, Align::Left, SMALL, palette.dim, words));
        let (right, y) = (self.rect.max[0] - PADDING[0], bottom - 0.3 * BAR);
        let [low, high] = DECADES;
        let part = match *error > 0.0 {
            true => ((libm::log10(*error) - low) / (high - low)).clamp(0.0, 1.0) as f32,
            false => 0.0,
        };
        let x = |part: f32| left + part * (right - left);
        let pen = &mut picture.pen(stage);
        pen.line([left, y], [right, y], 2.0, fade(palette.dim, 0.4));
        for decade in 0..=(high - low) as u8 {
            let x = x(f32::from(decade) / (high - low) as f32);
            pen.line([x, y - 3.0], [x, y + 3.0], 1.0, fade(palette.dim, 0.6));
        }
        pen.line([left, y], [x(part), y], 6.0, self.colour);
    }
}

/// Draws the cards. If two neighbours have the same two lines in two orders, threads join the equal lines.
pub(super) fn draw(picture: &mut Picture, palette: &Palette, stage: Rect, cards: &[Card]) {
    cards.iter().for_each(|card| card.draw(picture, palette, stage));
    for pair in cards.windows(2) {
        let [upper, lower] = [&pair[0], &pair[1]];
        let ([first, second], [third, fourth]) = (&upper.lines[..], &lower.lines[..]) else {
            continue;
        };
        let is_beside = upper.rect.min[0] > stage.min[0] + AROUND[0];
        if !is_beside || [first, second] != [fourth, third] {
            continue;
        }
        let end = |card: &Card, line: usize| {
            let wide = width(LETTER * card.size, &card.lines[line]);
            [card.rect.min[0] + PADDING[0] + wide + 8.0, card.y_of(line)]
        };
        let room = upper.rect.max[0] - end(upper, 0)[0] - PADDING[0];
        let away = room.clamp(0.0, AWAY);
        for (from, to, away) in [(0, 1, away), (1, 0, away / 2.0)] {
            let thread = thread([end(upper, from), end(lower, to)], away);
            picture.pen(stage).path(thread, 1.2, fade(palette.text, 0.55));
        }
    }
}

/// A smooth line between two ends that bends to the right by this many points.
fn thread([from, to]: [[f32; 2]; 2], away: f32) -> impl Iterator<Item = [f32; 2]> {
    const PIECES: u8 = 32;
    (0..=PIECES).map(move |piece| {
        let part = f32::from(piece) / f32::from(PIECES);
        let out = 4.0 * part * (1.0 - part);
        let bend = away * out * (2.0 - out);
        let [x, y] = [0, 1].map(|axis| from[axis] + part * (to[axis] - from[axis]));
        [x + bend, y]
    })
}

/// Writes a line of code without blanks around products, and with whole numbers.
fn closed_up(line: &str) -> String {
    line.replace(" * ", "*").replace(" / ", "/").replace(".0", "")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compose;
    use crate::run::race::Mode;
    use crate::scene::Scene;
    use crate::studio::{Motion, StageCommand, Studio};

    fn opening() -> Studio {
        let scene = Scene::built_in("two-springs").unwrap();
        let mut studio = Studio::opened(scene, None, Mode::Race);
        studio.viewer.preferences.display.motion = Motion::Live;
        studio
    }

    #[test]
    fn the_opening_shows_the_same_two_lines_in_two_orders_and_a_ghost_beside_each() {
        let mut studio = opening();
        studio.analyse();
        let picture = compose(&studio, [1280.0, 620.0]);
        let code = picture.labels.iter().filter(|label| label.is_code);
        let code: Vec<&str> = code.map(|label| &*label.text).collect();
        let [x, v] = ["x += h * v", "v += h * a"];
        assert_eq!(code, [x, v, v, x]);
        let said: Vec<&str> = picture.labels.iter().map(|label| &*label.text).collect();
        for words in ["▲ twice as wide every 2.1 s", "● stays ±1 m"] {
            assert!(said.contains(&words), "{words}: {said:?}");
        }
        assert_eq!(said.iter().filter(|words| **words == "exact").count(), 2);
        assert_eq!(picture.cells.len(), 2);
    }

    #[test]
    fn a_band_that_grows_zooms_out_by_itself_and_its_neighbour_stays() {
        let mut studio = opening();
        let scales = |studio: &Studio| {
            let cells = compose(studio, [1280.0, 620.0]).cells;
            cells.iter().map(|cell| cell.camera.points_per_metre).collect::<Vec<_>>()
        };
        let before = scales(&studio);
        (0..360).for_each(|_| studio.tick());
        let after = scales(&studio);
        assert!(after[0] < 0.3 * before[0], "{before:?} {after:?}");
        assert!((after[1] / before[1] - 1.0).abs() < 0.1, "{before:?} {after:?}");
        let labels = compose(&studio, [1280.0, 620.0]).labels;
        assert!(labels.iter().any(|label| label.text.contains("people")), "{labels:?}");
    }

    #[test]
    fn bands_and_cards_stay_on_any_stage_for_any_methods() {
        for size in
            [[1280.0, 620.0], [1920.0, 980.0], [800.0, 500.0], [390.0, 750.0], [200.0, 90.0]]
        {
            let mut studio = opening();
            for digit in [0, 2, 3, 4] {
                (0..40).for_each(|_| studio.tick());
                for label in compose(&studio, size).labels {
                    let [x, y] = label.at;
                    let is_within = (0.0..=size[0]).contains(&x) && (0.0..=size[1]).contains(&y);
                    assert!(is_within, "{label:?} on {size:?}");
                    let wide = LETTER * label.size * label.text.chars().count() as f32;
                    assert!(!label.is_code || x + wide <= size[0], "{label:?} on {size:?}");
                }
                studio.apply(StageCommand::Pick(digit));
            }
        }
    }
}
