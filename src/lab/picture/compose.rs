//! Lays out the stage and draws every body of every lane, with its ghost, trail and marks.

use glam::DVec2;

use super::palette::{self, faded, style};
use super::sketch::{Camera, Paint, SOLID, demote, strokes};
use super::{Align, Cap, Label, Picture, Rect, Rgba, Sea, Stroke};
use crate::lab::number::{round, significant};
use crate::lab::race::Entrant;
use crate::lab::{History, Interpolation, Lab, LaneBody, Mode, Sample};
use crate::sim::bodies::{Pen, View};

/// Space round the stage and between its cells, in points.
const MARGIN: f32 = 6.0;
/// The part of a scene's duration that a trail reaches back: three swings of the harbour's 1 Hz spring,
/// and no more of a faster one than can be told apart.
const TRAIL: f64 = 0.15;
/// The longest trail, in seconds: a ship under way has left the stage by then.
const LONGEST_TRAIL_S: f64 = 3.0;
/// The most segments in a trail: more would not show.
const TRAIL_SEGMENTS: usize = 180;

/// The least height of a cell, in points, that a scale bar does not crowd.
const ROOM_FOR_BAR: f32 = 44.0;
/// Room that a scale bar may take at the right of a cell, in points.
const BAR_MARGIN: f32 = 130.0;
/// The least width of a cell, in points, that distance marks do not crowd.
const ROOM_FOR_MARKS: f32 = 330.0;

/// The picture of the lab on a stage of `size` points.
pub fn compose(lab: &Lab, size: [f32; 2]) -> Picture {
    let mut picture = Picture::default();
    let race = lab.race();
    let h = 1.0 / f64::from(race.tick_hz());
    let shown = Shown {
        lab,
        alpha: if race.tick() == 0 { 1.0 } else { lab.clock().alpha() },
        h,
        t: match lab.display().interpolation {
            Interpolation::Raw => race.t(),
            _ => race.t() - (1.0 - lab.clock().alpha()) * h,
        },
        trail_s: (TRAIL * lab.scene().seconds).min(LONGEST_TRAIL_S),
    };
    for (cell, entrant, body) in cells(lab, size) {
        shown.cell(&mut picture, cell, entrant, body);
    }
    picture
}

/// The cells of the stage. Solo: the bodies below each other. Race: a row for each lane, in which the
/// bodies stand side by side.
fn cells(lab: &Lab, size: [f32; 2]) -> Vec<(Rect, &Entrant, usize)> {
    let bodies = lab.scene().bodies.len();
    let entrants = lab.race().entrants();
    let (rows, columns) = match lab.mode() {
        Mode::Solo => (bodies, 1),
        Mode::Race => (entrants.len(), bodies),
    };
    let width = (size[0] - MARGIN * (columns as f32 + 1.0)) / columns as f32;
    let height = (size[1] - MARGIN * (rows as f32 + 1.0)) / rows as f32;
    let rect = |row: usize, column: usize| {
        let min =
            [MARGIN + column as f32 * (width + MARGIN), MARGIN + row as f32 * (height + MARGIN)];
        Rect { min, max: [min[0] + width.max(0.0), min[1] + height.max(0.0)] }
    };
    let cell = |row, column| match lab.mode() {
        Mode::Solo => (rect(row, column), &entrants[0], row),
        Mode::Race => (rect(row, column), &entrants[row], column),
    };
    (0..rows).flat_map(|row| (0..columns).map(move |column| cell(row, column))).collect()
}

/// The moment that is drawn.
struct Shown<'a> {
    lab: &'a Lab,
    /// How far the moment is from the previous tick to the present one.
    alpha: f64,
    /// A tick in seconds.
    h: f64,
    /// The moment in seconds.
    t: f64,
    /// How far trails reach back, in seconds.
    trail_s: f64,
}

impl Shown<'_> {
    /// A body's coordinates and velocities at the moment drawn.
    fn state(&self, body: &LaneBody) -> (Vec<f64>, Vec<f64>) {
        let (q0, v0) = (&body.previous_q, &body.previous_v);
        let (q1, v1) = (body.stepper.q(), body.stepper.v());
        let each = |f: &dyn Fn(usize) -> f64| (0..q1.len()).map(f).collect::<Vec<_>>();
        let line = |a: f64, b: f64| a + (b - a) * self.alpha;
        match self.lab.display().interpolation {
            Interpolation::Raw => (q1.to_vec(), v1.to_vec()),
            Interpolation::Linear => (each(&|i| line(q0[i], q1[i])), each(&|i| line(v0[i], v1[i]))),
            Interpolation::Hermite => (
                each(&|i| hermite(self.alpha, self.h, [q0[i], q1[i]], [v0[i], v1[i]])),
                each(&|i| line(v0[i], v1[i])),
            ),
        }
    }

    fn cell(&self, picture: &mut Picture, rect: Rect, entrant: &Entrant, index: usize) {
        let truth = &self.lab.race().truth().bodies()[index];
        let truth_history = &self.lab.race().truth_histories()[index];
        let body = &entrant.lane.bodies()[index];
        let (truth_q, truth_v) = self.state(truth);
        let (q, v) = self.state(body);
        let mut ghost = Pen::default();
        truth.stepper.outline(&truth_q, &truth_v, &mut ghost);
        let mut pen = Pen::default();
        body.stepper.outline(&q, &v, &mut pen);

        let view = truth.stepper.view();
        let camera = self.camera(rect, view, ghost.at, truth_history);
        let style = style(self.lab.entries()[entrant.entry].method);
        let own = Paint { colour: style.0, line_width: 2.0, grow: 0.0 };
        let exact = Paint { colour: faded(palette::TRUTH, 0.75), line_width: 1.0, grow: 1.6 };

        picture.seas.push(self.sea(&camera, view));
        let history = &entrant.histories[index];
        match view {
            View::Follow { .. } => self.wake(picture, &camera, pen.at, history),
            View::Fixed { .. } => {
                let truth_trail = (truth_history, faded(palette::TRUTH, 0.55));
                if self.lab.display().ghost {
                    self.trail(picture, &camera, ghost.at, truth_trail.0, |_| truth_trail.1);
                }
                self.trail(picture, &camera, pen.at, history, |s| self.colour(s));
                self.envelope(picture, &camera, truth_history, palette::TRUTH);
            }
        }
        if self.lab.display().ghost {
            picture.strokes.extend(strokes(&ghost.marks, &camera, exact));
        }
        picture.strokes.extend(strokes(&pen.marks, &camera, own));
        self.arrow(picture, &camera, pen.at, style.0);
        let last = self.lab.race().entrants().last();
        if self.lab.mode() == Mode::Solo || last.is_some_and(|last| last.entry == entrant.entry) {
            scale_bar(picture, &camera);
        }
        if let View::Follow { .. } = view {
            distance_marks(picture, &camera);
        }
        if self.lab.mode() == Mode::Race && index == 0 && entrant.entry == self.lab.active() {
            let x = rect.min[0] + 2.5;
            let ends = [[x, rect.min[1] + 6.0], [x, rect.max[1] - 6.0]];
            picture.strokes.push(line(ends[0], ends[1], 3.0, style.0, rect));
        }
        self.words(picture, rect, entrant, index, (q[0], v[0]));
    }

    fn camera(&self, rect: Rect, view: View, truth_at: DVec2, truth: &History) -> Camera {
        let [width, height] = [0, 1].map(|i| f64::from(rect.max[i] - rect.min[i]).max(1.0));
        let middle = [0, 1].map(|i| (rect.min[i] + rect.max[i]) / 2.0);
        match view {
            View::Follow { width_m } => {
                let centre_m = if self.lab.display().motion {
                    truth_at
                } else {
                    // In pages, so that nothing but the ship moves.
                    let page = 0.6 * width_m;
                    DVec2::new((libm::floor(truth_at.x / page) + 0.5) * page, truth_at.y)
                };
                // Half a ship's length ahead of the middle leaves room for the wake.
                let at = [middle[0] + 0.1 * width as f32, middle[1] + 0.06 * height as f32];
                let points_per_metre = (width / width_m).min(height / 9.0);
                Camera { rect, centre_m, at, points_per_metre }
            }
            View::Fixed { half_width_m } => {
                let swing = truth.samples().map(|s| s.q.abs()).fold(0.0, f64::max);
                let half_width_m = half_width_m.max(1.15 * swing);
                let at = [middle[0] + 0.05 * width as f32, rect.min[1] + 0.46 * height as f32];
                let points_per_metre = (width / 2.1).min(height * 1.1) / half_width_m;
                Camera { rect, centre_m: DVec2::ZERO, at, points_per_metre }
            }
        }
    }

    fn sea(&self, camera: &Camera, view: View) -> Sea {
        let step_m = camera.round_length_m(48.0);
        // The nearest grid line to the camera, so that no large number reaches an f32.
        let line = DVec2::new(libm::round(camera.centre_m.x / step_m) * step_m, 0.0);
        Sea {
            rect: camera.rect,
            grid_origin: camera.points(line),
            grid_step: camera.length(step_m),
            waves: if matches!(view, View::Follow { .. }) { 1.0 } else { 0.0 },
            phase: if self.lab.display().motion {
                demote((self.t * 0.7) % std::f64::consts::TAU)
            } else {
                0.0
            },
        }
    }

    fn colour(&self, sample: &Sample) -> Rgba {
        style(self.lab.entries()[sample.entry].method).0
    }

    /// The samples of the last `trail_s` seconds before the moment drawn, newest first, thinned to
    /// what shows.
    fn recent<'h>(&self, history: &'h History) -> impl Iterator<Item = (f64, &'h Sample)> {
        let (shown, trail_s) = (self.t, self.trail_s);
        let recent = move |s: &&Sample| shown - s.t < trail_s;
        let count = history.samples().rev().take_while(recent).count();
        let every = count.div_ceil(TRAIL_SEGMENTS).max(1);
        let newest_first = history.samples().rev().take_while(recent).step_by(every);
        newest_first.filter(move |s| s.t < shown).map(move |s| (shown - s.t, s))
    }

    fn fade(&self, age: f64) -> f32 {
        if self.lab.display().motion { demote(1.0 - age / self.trail_s) } else { 0.6 }
    }

    /// Where the mass has been, drawn as a chart recorder would: older is further down.
    fn trail(
        &self,
        picture: &mut Picture,
        camera: &Camera,
        from: DVec2,
        history: &History,
        colour: impl Fn(&Sample) -> Rgba,
    ) {
        let drop = (camera.rect.max[1] - camera.at[1]) as f64 / self.trail_s;
        let point = |q: f64, age: f64| {
            let [x, y] = camera.points(DVec2::new(q, 0.0));
            [x, demote(f64::from(y) + age * drop)]
        };
        let mut last = point(from.x, 0.0);
        for (age, sample) in self.recent(history) {
            let next = point(sample.q, age);
            let colour = faded(colour(sample), self.fade(age));
            picture.strokes.push(line(last, next, 1.5, colour, camera.rect));
            last = next;
        }
    }

    /// Foam behind the hull, wider and fainter with age, and the two arms of the bow wave.
    fn wake(&self, picture: &mut Picture, camera: &Camera, from: DVec2, history: &History) {
        /// Half the opening of a ship's wake on deep water, as Kelvin found it: sin = 1/3.
        const KELVIN_SLOPE: f64 = 0.353_553_390_593_273_8;
        let point = |x: f64, y: f64| camera.points(DVec2::new(x, y));
        let mut last = from.x;
        for (age, sample) in self.recent(history) {
            let (old, new) = (sample.q, last);
            let fade = self.fade(age);
            let foam = faded(self.colour(sample), 0.55 * fade);
            let radius = camera.length(0.35 + 0.25 * age);
            picture.strokes.push(Stroke {
                radii: [radius, radius],
                cap: Cap::Butt,
                ..line(point(new, 0.0), point(old, 0.0), 1.0, foam, camera.rect)
            });
            let arm = faded(palette::TRUTH, 0.35 * fade);
            for side in [-1.0, 1.0] {
                let spread = |x: f64| side * (1.2 + KELVIN_SLOPE * (from.x - x).abs());
                let (a, b) = (point(new + 3.0, spread(new)), point(old + 3.0, spread(old)));
                picture.strokes.push(line(a, b, 1.2, arm, camera.rect));
            }
            last = old;
        }
    }

    /// Two ticks at the largest swing of the truth: a mass beyond them has gained energy.
    fn envelope(&self, picture: &mut Picture, camera: &Camera, truth: &History, colour: Rgba) {
        let swing = truth.samples().rev().map(|s| s.q.abs()).fold(0.0, f64::max);
        for x in [-swing, swing] {
            let [x, y] = camera.points(DVec2::new(x, 0.0));
            let half = 0.13 * (camera.rect.max[1] - camera.rect.min[1]);
            let mut tick = line([x, y - half], [x, y + half], 1.0, faded(colour, 0.6), camera.rect);
            tick.dash = [3.0, 3.0, 0.0];
            picture.strokes.push(tick);
        }
    }

    /// An arrow at the edge of the cell for a body beyond it, with its place as a number.
    fn arrow(&self, picture: &mut Picture, camera: &Camera, at: DVec2, colour: Rgba) {
        let (left, right) = camera.span_m();
        let Rect { min, max } = camera.rect;
        let y = camera.at[1];
        let (tip, back, align) = if at.x < left {
            (min[0] + 5.0, min[0] + 17.0, Align::Left)
        } else if at.x > right {
            (max[0] - 5.0, max[0] - 17.0, Align::Right)
        } else {
            return;
        };
        let mut arrow = line([back, y], [tip, y], 1.0, colour, camera.rect);
        arrow.radii = [7.0, 0.8];
        picture.strokes.push(arrow);
        picture.labels.push(Label {
            at: [back + (back - tip).signum() * 11.0, y - 12.0],
            align,
            size: 12.0,
            colour,
            text: format!("{} m", significant(at.x, 3)),
        });
    }

    /// Who this is, where it is, and what became of it.
    fn words(
        &self,
        picture: &mut Picture,
        rect: Rect,
        entrant: &Entrant,
        index: usize,
        (q, v): (f64, f64),
    ) {
        let Rect { min, max } = rect;
        let [width, height] = [max[0] - min[0], max[1] - min[1]];
        if width < 70.0 || height < 18.0 {
            return;
        }
        let method = self.lab.entries()[entrant.entry].method;
        let body = &self.lab.scene().bodies[index];
        let colour = style(method).0;
        let y = min[1] + 11.0;
        let mut write = |at, align, size, colour, text: String| {
            picture.labels.push(Label { at, align, size, colour, text });
        };
        let race = self.lab.mode() == Mode::Race;
        let name = match (race, index) {
            (true, 0) => format!("{} {}", entrant.entry + 1, method.name),
            (true, _) => body.name.clone(),
            (false, _) => format!("{}: {}", body.name, method.name),
        };
        let quiet = race && index > 0;
        let name_colour = if quiet { palette::TEXT } else { colour };
        write([min[0] + 9.0, y], Align::Left, 12.0, name_colour, name);
        if let Some(halt) = entrant.lane.halted() {
            let text = format!("halted at tick {}", halt.tick);
            write([max[0] - 9.0, y], Align::Right, 12.0, palette::ALARM, text);
        } else if width > 330.0 {
            let coordinate = &body.kind.coordinates[0];
            let text = format!(
                "{} = {} {}   {} = {} {}/s",
                coordinate.name,
                significant(q, 4),
                coordinate.unit,
                coordinate.velocity,
                significant(v, 4),
                coordinate.unit,
            );
            write([max[0] - 9.0, y], Align::Right, 12.0, palette::TEXT, text);
        }
    }
}

/// Distance marks along a ship's course.
fn distance_marks(picture: &mut Picture, camera: &Camera) {
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

fn scale_bar(picture: &mut Picture, camera: &Camera) {
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

/// The cubic through `q` at both ends of a tick of `h` seconds with the velocities `v` there, at the
/// part `alpha` of it.
fn hermite(alpha: f64, h: f64, q: [f64; 2], v: [f64; 2]) -> f64 {
    let (a, b) = (alpha, 1.0 - alpha);
    let ends = b * b * (1.0 + 2.0 * a) * q[0] + a * a * (1.0 + 2.0 * b) * q[1];
    ends + h * a * b * (b * v[0] - a * v[1])
}

fn line(from: [f32; 2], to: [f32; 2], width: f32, colour: Rgba, clip: Rect) -> Stroke {
    let radii = [width / 2.0; 2];
    Stroke { from, to, radii, colours: [colour; 2], dash: SOLID, cap: Cap::Round, clip }
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
