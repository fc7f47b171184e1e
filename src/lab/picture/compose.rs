//! Lays out the stage and draws every body of every lane, with its ghost, its trail and its captions.

use glam::DVec2;

use super::ghost::Ghost;
use super::layout::{grid, mosaic};
use super::palette::{self, faded, style};
use super::sketch::{Camera, Paint, demote, line, strokes};
use super::{Cell, Framing, Look, Picture, Rect, Sea, Whose, captions};
use crate::lab::race::Entrant;
use crate::lab::{Interpolation, Lab, LaneBody, Mode};

/// The head of a cell in which its lane is named, and may have halted, in points.
const CAPTION: f32 = 32.0;
/// The head of a cell that a body with a fixed camera leaves to the caption, in points.
const HEAD: f64 = 20.0;
/// The column of lane names at the left of a race, in points: on a stage wide enough for names, and on
/// others, where only the number fits.
const GUTTERS: (f32, f32) = (120.0, 18.0);
/// From this width of the stage on, in points, lane names fit.
const ROOM_FOR_NAMES: f32 = 520.0;
/// How much is seen of a body where it was taken from, while it is held.
const LEFT_BEHIND: f32 = 0.35;
/// The part of a scene's duration that a chart recorder's paper holds: three swings of the harbour's
/// 1 Hz spring, and no more of a faster one than can be told apart.
const PAPER: f64 = 0.15;
/// The most that the paper holds, in seconds.
const LONGEST_PAPER_S: f64 = 3.0;

/// The picture of the lab on a stage of `size` points.
pub fn compose(lab: &Lab, size: [f32; 2]) -> Picture {
    let mut picture = Picture::default();
    let race = lab.race();
    let (alpha, h) = (lab.clock().alpha(), race.last_step_s());
    let t = race.t() - (1.0 - alpha) * h;
    let shown = Shown {
        lab,
        alpha,
        h,
        t,
        lanes_t: match lab.display().interpolation {
            Interpolation::Raw => race.t(),
            Interpolation::Linear | Interpolation::Hermite => t,
        },
        paper_s: (PAPER * lab.scene().seconds).min(LONGEST_PAPER_S),
    };
    let bodies = lab.scene().bodies.len();
    match lab.mode() {
        Mode::Solo => {
            let stage = Rect { min: [0.0; 2], max: size };
            for (index, cell) in grid(stage, bodies, 1).into_iter().enumerate() {
                let ghost = Ghost::new(&shown, index, cell);
                shown.body(&mut picture, cell, &race.entrants()[0], (index, &ghost));
            }
        }
        Mode::Race if let Some(shape) = shown.shape() => {
            let stage = Rect { min: [0.0; 2], max: size };
            let cells = mosaic(stage, race.entrants().len(), shape);
            let ghost = Ghost::new(&shown, 0, cells[0]);
            for (entrant, cell) in race.entrants().iter().zip(cells) {
                shown.body(&mut picture, cell, entrant, (0, &ghost));
                let bottom = (cell.min[1] + CAPTION).min(cell.max[1]);
                let head = Rect { min: cell.min, max: [cell.max[0], bottom] };
                captions::lane(&mut picture, head, lab, entrant);
            }
        }
        Mode::Race => {
            let gutter = if size[0] >= ROOM_FOR_NAMES { GUTTERS.0 } else { GUTTERS.1 };
            let stage = Rect { min: [gutter, 0.0], max: size };
            let cells = grid(stage, race.entrants().len(), bodies);
            let ghosts = cells.iter().take(bodies).enumerate();
            let ghosts: Vec<_> =
                ghosts.map(|(index, &cell)| Ghost::new(&shown, index, cell)).collect();
            for (entrant, row) in race.entrants().iter().zip(cells.chunks(bodies)) {
                let name = Rect { min: [0.0, row[0].min[1]], max: [gutter, row[0].max[1]] };
                captions::lane(&mut picture, name, lab, entrant);
                for (index, cell) in row.iter().enumerate() {
                    shown.body(&mut picture, *cell, entrant, (index, &ghosts[index]));
                }
            }
            for (index, cell) in cells.iter().take(bodies).enumerate() {
                captions::column(&mut picture, *cell, lab, index);
            }
        }
    }
    picture
}

/// The moment that is drawn.
pub(super) struct Shown<'a> {
    pub(super) lab: &'a Lab,
    /// How far the moment is from the previous tick to the present one.
    pub(super) alpha: f64,
    /// The last tick's length in seconds.
    h: f64,
    /// The moment in seconds.
    pub(super) t: f64,
    /// The moment at which lanes are drawn, in seconds: without interpolation the present tick.
    pub(super) lanes_t: f64,
    /// How far a chart recorder's trail reaches back, in seconds.
    pub(super) paper_s: f64,
}

impl Shown<'_> {
    /// The width and height, in metres, of what is to be seen of a body that is alone in its scene and
    /// moves both across and up. Other bodies move along rows.
    fn shape(&self) -> Option<DVec2> {
        let [body] = self.lab.race().truth().bodies() else { return None };
        match Look::of(body.kind).framing(&*body.stepper) {
            Framing::Fixed { half_m, .. } => Some(half_m),
            Framing::Follow { width_m, height_m, .. } if turns(body) => {
                Some(DVec2::new(width_m, height_m))
            }
            Framing::Follow { .. } | Framing::Recorder { .. } => None,
        }
    }

    /// A body's coordinates at the moment drawn.
    fn coordinates(&self, body: &LaneBody) -> Vec<f64> {
        let (q0, v0) = (&body.previous_q, &body.previous_v);
        let (q1, v1) = (body.stepper.q(), body.stepper.v());
        let each = |f: &dyn Fn(usize) -> f64| (0..q1.len()).map(f).collect();
        match self.lab.display().interpolation {
            Interpolation::Raw => q1.to_vec(),
            Interpolation::Linear => each(&|i| q0[i] + (q1[i] - q0[i]) * self.alpha),
            Interpolation::Hermite => {
                each(&|i| hermite(self.alpha, self.h, [q0[i], q1[i]], [v0[i], v1[i]]))
            }
        }
    }

    fn body(
        &self,
        picture: &mut Picture,
        rect: Rect,
        entrant: &Entrant,
        (index, ghost): (usize, &Ghost),
    ) {
        let truth = &self.lab.race().truth().bodies()[index];
        let body = &entrant.lane.bodies()[index];
        let race = self.lab.race().entrants();
        let place = race.iter().position(|other| other.lane_number == entrant.lane_number);
        let place = place.expect("it is in the race");
        let history = &self.lab.past().histories(place)[index];
        let (look, coordinates) = (Look::of(body.kind), self.coordinates(body));
        let outline = look.outline(&*body.stepper, &coordinates);

        let framing = ghost.framing;
        let camera = self.camera(rect, index, ghost);
        let (colour, _) = style(self.lab.entries()[entrant.entry].method);
        let own = Paint { colour, line_width: 2.0, grow: 0.0 };
        let exact = Paint { colour: faded(palette::TRUTH, 0.75), line_width: 1.0, grow: 1.6 };

        let shows_ghost = self.lab.display().ghost && truth.halted().is_none();
        picture.seas.push(self.sea(&camera, framing));
        match framing {
            Framing::Follow { width_m, wake_s, .. } => {
                self.wake(picture, &camera, outline.at, history, width_m, wake_s);
            }
            Framing::Recorder { .. } => {
                if shows_ghost {
                    self.recorded(picture, &camera, &ghost.past);
                }
                for leg in self.legs(outline.at, history, self.paper_s) {
                    self.recorded(picture, &camera, &leg);
                    self.dots(picture, &camera, &leg, self.paper_s, |moment| {
                        self.on_paper(&camera, moment)
                    });
                }
                envelope(picture, &camera, ghost.reach_m.x);
            }
            Framing::Fixed { trail_s, .. } => {
                if shows_ghost {
                    self.path(picture, &camera, &ghost.past, trail_s);
                }
                for leg in self.legs(outline.at, history, trail_s) {
                    self.path(picture, &camera, &leg, trail_s);
                    self.dots(picture, &camera, &leg, trail_s, |moment| camera.points(moment.at));
                }
            }
        }
        if shows_ghost {
            picture.strokes.extend(strokes(&ghost.outline.marks, &camera, exact));
        }
        match self.lab.viewer().held().filter(|held| held.body == index) {
            None => picture.strokes.extend(strokes(&outline.marks, &camera, own)),
            Some(held) => {
                let left = Paint { colour: faded(colour, LEFT_BEHIND), ..own };
                picture.strokes.extend(strokes(&outline.marks, &camera, left));
                let held_outline = look.outline(&*body.stepper, &held.q);
                picture.strokes.extend(strokes(&held_outline.marks, &camera, own));
                if held.lane == entrant.lane_number {
                    let [handle, hand] = [held.handle, held.hand].map(|at| camera.points(at));
                    picture.strokes.push(line(handle, hand, 1.0, palette::TEXT, rect));
                }
            }
        }

        captions::arrow(picture, &camera, outline.at, body.stepper.place(), colour);
        if self.lab.mode() == Mode::Solo || entrant.entry == race[race.len() - 1].entry {
            captions::scale_bar(picture, &camera);
        }
        if let (Framing::Follow { .. }, false) = (framing, turns(body)) {
            captions::distance_marks(picture, &camera);
        }
        let mut cell = Cell {
            rect,
            lane: entrant.lane_number,
            entry: entrant.entry,
            body: index,
            grips: Vec::new(),
            camera,
        };
        cell.add_grips(body, &coordinates, Whose::Lane);
        if shows_ghost {
            cell.add_grips(truth, &ghost.q, Whose::Truth);
        }
        picture.cells.push(cell);
        match self.lab.mode() {
            Mode::Solo => {
                captions::solo(picture, rect, self.lab, index, body);
                captions::halts(picture, rect, None, truth);
            }
            Mode::Race => {
                let is_alone = entrant.lane.bodies().len() == 1;
                let halt = body.halted().filter(|_| !is_alone);
                captions::halts(picture, rect, halt, truth);
            }
        }
    }

    /// The camera of a cell of the body at this place of the scene.
    pub(super) fn camera(&self, rect: Rect, index: usize, ghost: &Ghost) -> Camera {
        let turns = turns(&self.lab.race().truth().bodies()[index]);
        self.fitted(rect, turns, ghost).through(self.lab.display().lens(index))
    }

    fn fitted(&self, rect: Rect, turns: bool, ghost: &Ghost) -> Camera {
        let [width, height] = rect.size();
        let middle = [0, 1].map(|i| (rect.min[i] + rect.max[i]) / 2.0);
        match ghost.framing {
            Framing::Follow { width_m, height_m, .. } => {
                let centre_m = if self.lab.display().motion {
                    ghost.outline.at
                } else {
                    // In pages, so that nothing but the ship moves.
                    let (page, leaf) = (0.6 * width_m, 0.5 * height_m);
                    let x = (libm::floor(ghost.outline.at.x / page) + 0.5) * page;
                    DVec2::new(x, libm::round(ghost.outline.at.y / leaf) * leaf)
                };
                // On a straight course half a ship's length ahead of the middle leaves room for the
                // wake.
                let ahead = if turns { 0.0 } else { 0.1 };
                let at = [middle[0] + ahead * width as f32, middle[1] + 0.06 * height as f32];
                let points_per_metre = (width / width_m).min(height / height_m);
                Camera { rect, centre_m, at, points_per_metre, paper: 0.0 }
            }
            Framing::Recorder { half_width_m } => {
                let half_width_m = half_width_m.max(1.15 * ghost.reach_m.x);
                let at = [middle[0] + 0.05 * width as f32, rect.min[1] + 0.46 * height as f32];
                let points_per_metre = (width / 2.1).min(height * 1.1) / half_width_m;
                let paper = f64::from(rect.max[1] - at[1]);
                Camera { rect, centre_m: DVec2::ZERO, at, points_per_metre, paper }
            }
            Framing::Fixed { centre_m, half_m, .. } => {
                let half_m = half_m.max(1.05 * ghost.reach_m);
                let head = HEAD.min(height / 4.0);
                let at = [middle[0], middle[1] + head as f32 / 2.0];
                let points_per_metre = (width / half_m.x).min((height - head) / half_m.y) / 2.0;
                Camera { rect, centre_m, at, points_per_metre, paper: 0.0 }
            }
        }
    }

    fn sea(&self, camera: &Camera, framing: Framing) -> Sea {
        let step_m = camera.round_length_m(48.0);
        // The nearest grid line to the middle, so that no large number reaches an f32.
        let Rect { min, max } = camera.rect;
        let middle = camera.metres([0, 1].map(|axis| (min[axis] + max[axis]) / 2.0));
        let line = (middle / step_m).round() * step_m;
        Sea {
            rect: camera.rect,
            grid_origin: camera.points(line),
            grid_step: camera.length(step_m),
            waves: if matches!(framing, Framing::Follow { .. }) { 1.0 } else { 0.0 },
            phase: if self.lab.display().motion {
                demote((self.t * 0.7) % std::f64::consts::TAU)
            } else {
                0.0
            },
        }
    }
}

/// Whether a body leaves the line that it starts on: the one coordinate of the others is along it.
pub(super) fn turns(body: &LaneBody) -> bool {
    body.coordinates.len() > 1
}

/// Two dashed ticks at the largest swing of the truth: a mass beyond them has gained energy.
fn envelope(picture: &mut Picture, camera: &Camera, swing_m: f64) {
    /// From the beginning of a dash to its end and to the next one, in points.
    const DASH: f32 = 3.0;
    const PERIOD: f32 = 6.0;
    let colour = faded(palette::TRUTH, 0.6);
    let half = 0.13 * (camera.rect.max[1] - camera.rect.min[1]);
    for x in [-swing_m, swing_m] {
        let [x, y] = camera.points(DVec2::new(x, 0.0));
        for dash in 0..(2.0 * half / PERIOD).ceil() as u32 {
            let from = y - half + dash as f32 * PERIOD;
            let to = (from + DASH).min(y + half);
            // Their round ends are part of them.
            let (from, to) = (from + 0.5, to.max(from + 1.0) - 0.5);
            picture.strokes.push(line([x, from], [x, to], 1.0, colour, camera.rect));
        }
    }
}

/// The cubic through `q` at both ends of a tick of `h` seconds with the velocities `v` there, at the
/// part `alpha` of it.
fn hermite(alpha: f64, h: f64, q: [f64; 2], v: [f64; 2]) -> f64 {
    let (a, b) = (alpha, 1.0 - alpha);
    let ends = b * b * (1.0 + 2.0 * a) * q[0] + a * a * (1.0 + 2.0 * b) * q[1];
    ends + h * a * b * (b * v[0] - a * v[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hermite_cubic_passes_its_ends_with_their_slopes_and_keeps_a_parabola() {
        let (q, v) = (|t: f64| 3.0 + 2.0 * t - t * t, |t: f64| 2.0 - 2.0 * t);
        for alpha in [0.0, 0.25, 0.5, 0.75, 1.0] {
            let h = 0.5;
            let shown = hermite(alpha, h, [q(1.0), q(1.5)], [v(1.0), v(1.5)]);
            assert!((shown - q(1.0 + alpha * h)).abs() < 1e-15, "at {alpha}: {shown}");
        }
    }
}
