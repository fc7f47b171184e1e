//! Trails of bodies: the trace of a mass, the wake of a ship.

use glam::{DVec2, Vec2};

use super::moment::DrawContext;
use super::sketch::{Camera, PEN, SOLID, demote};
use super::{PathPoint, Picture};
use crate::look::Framing;
use crate::look::palette::{Rgba, fade, mix};
use crate::run::past::{History, Sample};
use crate::studio::Motion;

/// Most points in a lane's trail: more would not show.
const TRAIL_POINTS: usize = 720;
/// Slope of the bow wave's arms away from the course, and spacing of the strokes in an arm, in sixtieths of the width
/// shown.
const BOW_SLOPE: f64 = 0.16;
const FEATHER: f64 = 1.1;
/// Most strokes of an arm: as many as fit on a stage.
const MAX_FEATHERS: usize = 60;
/// Time (s) between the eddies of a wake, and number of eddies at a time.
const EDDY_S: f64 = 0.2;
const EDDIES: u8 = 3;
/// From this spacing on, in points, samples of a trail are distinct and get dots of this radius.
const SPARSE: f32 = 6.0;
const DOT_RADIUS: f32 = 1.7;

/// A past place of a body.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// Age in seconds.
    pub(super) age: f64,
    /// Place in metres.
    pub(super) at: DVec2,
    /// Colour of the method that moved the body there.
    pub(super) colour: Rgba,
}

impl DrawContext<'_> {
    /// The last `trail_s` seconds of a body that is now at `from`, newest first, in one leg per method. Each leg
    /// starts at the end of the one before. Drops points that would not show.
    pub(super) fn legs(&self, from: DVec2, history: &History, trail_s: f64) -> Vec<Vec<Place>> {
        let shown = self.t;
        // No path leads to a placement.
        let mut has_jumped = false;
        let recent = move |s: &&Sample| {
            let goes_on = !has_jumped && shown - s.t < trail_s;
            has_jumped = s.jumped;
            goes_on
        };
        let newest_first = history.samples().rev().take_while(recent);
        let has_more = history.samples().rev().nth(TRAIL_POINTS).filter(|s| shown - s.t < trail_s);
        let every = has_more.map_or(1, |_| newest_first.clone().count().div_ceil(TRAIL_POINTS));
        let mut legs: Vec<Vec<Place>> = Vec::new();
        let (mut flown, mut newer) = (None, Place { age: 0.0, at: from, colour: [0; 4] });
        newest_first.step_by(every).filter(|s| s.t < shown).for_each(|sample| {
            if flown.replace(sample.entry) != Some(sample.entry) {
                newer.colour = self.style(sample.entry).0;
                let mut leg = Vec::with_capacity(TRAIL_POINTS + 1);
                leg.push(newer);
                legs.push(leg);
            }
            newer = Place { age: shown - sample.t, at: sample.at, ..newer };
            legs.last_mut().expect("one has begun").push(newer);
        });
        legs
    }

    fn fade(&self, age: f64, trail_s: f64) -> f32 {
        if self.studio.display().motion != Motion::Reduced {
            demote(1.0 - age / trail_s)
        } else {
            0.6
        }
    }

    /// Point of a place on a chart recorder's paper, which starts at the pen under the block; older places are
    /// further down.
    fn on_paper(&self, camera: &Camera, place: &Place) -> [f32; 2] {
        let pen = f64::from(PEN * camera.block);
        let drop = (camera.paper - pen).max(0.0) / self.paper_s;
        let [x, y] = camera.points(place.at);
        [x, demote(f64::from(y) + pen + place.age * drop)]
    }

    /// Draws a trail in its camera's framing.
    pub(super) fn trail(
        &self,
        picture: &mut Picture,
        camera: &Camera,
        framing: Framing,
        places: &[Place],
        width: f32,
    ) {
        let radius = width / 2.0;
        let pen = &mut picture.pen(camera.rect);
        match framing {
            Framing::Follow { .. } => {}
            Framing::Recorder { .. } => {
                let point = |place: &Place| PathPoint {
                    at: self.on_paper(camera, place),
                    radius,
                    colour: fade(place.colour, self.fade(place.age, self.paper_s)),
                };
                pen.course(places.iter().map(point), SOLID);
            }
            Framing::Fixed { trail_s, .. } => {
                let point = |place: &Place| {
                    // Opaque, since where a trail crosses itself one piece covers the other.
                    let part = self.fade(place.age, trail_s) * f32::from(place.colour[3]) / 255.0;
                    let colour = mix(self.palette.sea[1], place.colour, part);
                    PathPoint { at: camera.points(place.at), radius, colour }
                };
                pen.course(places.iter().map(point), SOLID);
            }
        }
    }

    /// Draws a dot on each sample of a lane's trail that is far from the next one, so that nobody takes the line
    /// between them for motion. The first place of a leg is not a sample.
    pub(super) fn dots(
        &self,
        picture: &mut Picture,
        camera: &Camera,
        framing: Framing,
        leg: &[Place],
    ) {
        let trail_s = match framing {
            Framing::Follow { .. } => return,
            Framing::Recorder { .. } => self.paper_s,
            Framing::Fixed { trail_s, .. } => trail_s,
        };
        let at = |place: &Place| match framing {
            Framing::Recorder { .. } => self.on_paper(camera, place),
            Framing::Follow { .. } | Framing::Fixed { .. } => camera.points(place.at),
        };
        let mut newer = None;
        for place in leg {
            let older = Vec2::from(at(place));
            if newer.replace(older).is_some_and(|newer| newer.distance(older) >= SPARSE) {
                let colour = fade(place.colour, self.fade(place.age, trail_s));
                picture.pen(camera.rect).disc(older.into(), DOT_RADIUS, colour);
            }
        }
    }

    /// Draws foam behind the hull, wider and fainter with age, its eddies, and the two feathered arms of the bow
    /// wave. The wake is as wide as the hull, whose length follows the view.
    pub(super) fn wake(
        &self,
        picture: &mut Picture,
        camera: &Camera,
        from: DVec2,
        history: &History,
        (width_m, wake_s): (f64, f64),
    ) {
        let unit = width_m / 60.0;
        let foam = self.palette.chart;
        let course = self.legs(from, history, wake_s).concat();
        if course.is_empty() {
            return;
        }
        let half_width = |age: f64| unit * (0.8 + 0.9 * age / wake_s);
        for (spread, part) in [(1.0, 0.24), (0.7, 0.16), (0.4, 0.22)] {
            let point = |place: &Place| PathPoint {
                at: camera.points(place.at),
                radius: camera.size(spread * half_width(place.age)),
                colour: fade(mix(foam, place.colour, 0.35), part * self.fade(place.age, wake_s)),
            };
            picture.pen(camera.rect).course(course.iter().map(point), SOLID);
        }
        for ends in course.windows(2) {
            let [newer, older] = [ends[0], ends[1]];
            let Some(ahead) = (newer.at - older.at).try_normalize() else { continue };
            // Keyed by the moment at which the hull passed, so that eddies stay fixed in the water.
            let moment = |place: Place| libm::floor((self.t - place.age) / EDDY_S);
            if moment(newer) == moment(older) {
                continue;
            }
            for i in 0..EDDIES {
                let dice = |salt: f64| {
                    let x = 43_758.545 * libm::sin(moment(newer) * 12.9898 + f64::from(i) * salt);
                    x - libm::floor(x)
                };
                let aside = 0.9 * (2.0 * dice(78.233) - 1.0) * half_width(older.age);
                let at = older.at + aside * ahead.perp() + unit * dice(37.719) * ahead;
                let ends = [at, at - unit * (0.5 + dice(11.137)) * ahead];
                let colour = fade(self.palette.text, 0.42 * self.fade(older.age, wake_s));
                let [tip, tail] = ends.map(|end| camera.points(end));
                picture.pen(camera.rect).taper([(tip, 1.1), (tail, 0.3)], colour);
            }
        }
        for side in [-1.0, 1.0] {
            self.bow_wave(picture, camera, &course, side * unit, wake_s);
        }
    }

    /// Draws the crest that the bow throws to one side, given by the sign of `unit`, in strokes that lean outwards.
    fn bow_wave(
        &self,
        picture: &mut Picture,
        camera: &Camera,
        course: &[Place],
        unit: f64,
        wake_s: f64,
    ) {
        let Some([newest, next]) = course.first_chunk() else { return };
        let (mut last, mut run) = (newest.at, 0.0);
        let mut ahead = (newest.at - next.at).try_normalize().unwrap_or(DVec2::X);
        let mut crest = Vec::new();
        for place in course {
            let sailed = last - place.at;
            ahead = sailed.try_normalize().unwrap_or(ahead);
            (last, run) = (place.at, run + sailed.length());
            let spread = unit * (1.2 + BOW_SLOPE * run / unit.abs());
            crest.push((run, place.at + 3.0 * unit.abs() * ahead + spread * ahead.perp(), ahead));
        }
        let (mut due, mut left) = (0.0, 0..MAX_FEATHERS);
        for (ends, place) in crest.windows(2).zip(course) {
            let [(from, near, _), (to, far, ahead)] = [ends[0], ends[1]];
            while due < to && left.next().is_some() {
                let at = near.lerp(far, ((due - from) / (to - from)).clamp(0.0, 1.0));
                let out = unit * ahead.perp();
                let strength = self.fade(place.age, wake_s);
                let foot = at + 0.9 * unit.abs() * ahead - 0.25 * out;
                let bend = at + 0.1 * out;
                let tip = at - 0.8 * unit.abs() * ahead + 0.6 * out;
                let colour = fade(self.palette.chart, 0.85 * strength);
                let points = [(foot, 0.4), (bend, 1.2), (tip, 0.2)];
                let points = points.map(|(at, radius)| (camera.points(at), radius));
                picture.pen(camera.rect).taper(points, colour);
                due += FEATHER * unit.abs();
            }
        }
    }
}
