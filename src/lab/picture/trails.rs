//! Where bodies have been: the trace of a mass, the wake of a ship.

use glam::{DVec2, Vec2};

use super::compose::Shown;
use super::palette::{self, faded, style};
use super::sketch::{Camera, demote, line};
use super::{Cap, Picture, Rgba, Stroke};
use crate::lab::{History, Sample};

/// The most segments in a trail: more would not show.
const TRAIL_SEGMENTS: usize = 180;
/// The least length of a segment, in points: of shorter ones, too, more would not show.
const SHORTEST_SEGMENT: f32 = 2.0;
/// The same in a wake, which bends little and fades within each segment.
const SHORTEST_OF_WAKE: f32 = 8.0;

impl Shown<'_> {
    /// The colour of the method that flew a body at a moment of its past.
    pub(super) fn colour(&self, sample: &Sample) -> Rgba {
        style(self.lab.entries()[sample.entry].method).0
    }

    /// The samples of the last `trail_s` seconds before the moment drawn, newest first, thinned to
    /// what shows, each with its age.
    fn recent<'h>(
        &self,
        history: &'h History,
        trail_s: f64,
    ) -> impl Iterator<Item = (f64, &'h Sample)> {
        let shown = self.t;
        let recent = move |s: &&Sample| shown - s.t < trail_s;
        let count = history.samples().rev().take_while(recent).count();
        let every = count.div_ceil(TRAIL_SEGMENTS).max(1);
        let newest_first = history.samples().rev().take_while(recent).step_by(every);
        newest_first.filter(move |s| s.t < shown).map(move |s| (shown - s.t, s))
    }

    fn fade(&self, age: f64, trail_s: f64) -> f32 {
        if self.lab.display().motion { demote(1.0 - age / trail_s) } else { 0.6 }
    }

    /// Where a body has been that moves along x, drawn as a chart recorder would: older is further
    /// down.
    pub(super) fn recorded(
        &self,
        picture: &mut Picture,
        camera: &Camera,
        from: DVec2,
        history: &History,
        colour: impl Fn(&Sample) -> Rgba,
    ) {
        let drop = (camera.rect.max[1] - camera.at[1]) as f64 / self.paper_s;
        let point = |at: DVec2, age: f64| {
            let [x, y] = camera.points(at);
            [x, demote(f64::from(y) + age * drop)]
        };
        let mut last = point(from, 0.0);
        for (age, sample) in self.recent(history, self.paper_s) {
            let next = point(sample.at, age);
            if Vec2::from(last).distance(next.into()) < SHORTEST_SEGMENT {
                continue;
            }
            let colour = faded(colour(sample), self.fade(age, self.paper_s));
            // Butt, for round ends would lie over each other and show as beads where a trail fades.
            let segment = line(last, next, 1.5, colour, camera.rect);
            picture.strokes.push(Stroke { cap: Cap::Butt, ..segment });
            last = next;
        }
    }

    /// Where a body has been, in its place.
    pub(super) fn path(
        &self,
        picture: &mut Picture,
        camera: &Camera,
        from: DVec2,
        history: &History,
        trail_s: f64,
        colour: impl Fn(&Sample) -> Rgba,
    ) {
        let mut last = camera.points(from);
        for (age, sample) in self.recent(history, trail_s) {
            let next = camera.points(sample.at);
            if Vec2::from(last).distance(next.into()) < SHORTEST_SEGMENT {
                continue;
            }
            // Opaque, since where two segments meet one covers the other.
            let colour = palette::dimmed(colour(sample), self.fade(age, trail_s));
            picture.strokes.push(line(last, next, 1.5, colour, camera.rect));
            last = next;
        }
    }

    /// Foam behind the hull, wider and fainter with age, and the two arms of the bow wave. The wake is
    /// as wide as the hull, which is as long as the view makes it.
    pub(super) fn wake(
        &self,
        picture: &mut Picture,
        camera: &Camera,
        from: DVec2,
        history: &History,
        width_m: f64,
        wake_s: f64,
    ) {
        /// Half the opening of a ship's wake on deep water, as Kelvin found it: sin = 1/3.
        const KELVIN_SLOPE: f64 = 0.353_553_390_593_273_8;
        let unit = width_m / 60.0;
        let place = |at: DVec2| camera.points(at);
        let (mut last, mut since, mut run, mut arms) = (from, 0.0, 0.0, None);
        for (age, sample) in self.recent(history, wake_s) {
            let leg = last - sample.at;
            if camera.length(leg.length()) < SHORTEST_OF_WAKE {
                continue;
            }
            let ages = [since, age];
            let paler = |colour, part: f32| {
                ages.map(|age| faded(colour, part * self.fade(age, wake_s)))
            };
            picture.strokes.push(Stroke {
                radii: ages.map(|age| camera.length(unit * (0.35 + 0.75 * age / wake_s))),
                colours: paler(self.colour(sample), 0.55),
                cap: Cap::Butt,
                ..line(place(last), place(sample.at), 1.0, palette::TRUTH, camera.rect)
            });
            let ahead = leg.normalize();
            let edges = |at: DVec2, run: f64| {
                let spread = (1.2 * unit + KELVIN_SLOPE * run) * ahead.perp();
                [spread, -spread].map(|spread| place(at + 3.0 * unit * ahead + spread))
            };
            let starts = arms.unwrap_or_else(|| edges(last, run));
            run += leg.length();
            let ends = edges(sample.at, run);
            for (a, b) in starts.into_iter().zip(ends) {
                let arm = line(a, b, 1.2, palette::TRUTH, camera.rect);
                let colours = paler(palette::TRUTH, 0.35);
                picture.strokes.push(Stroke { colours, cap: Cap::Butt, ..arm });
            }
            (last, since, arms) = (sample.at, age, Some(ends));
        }
    }
}
