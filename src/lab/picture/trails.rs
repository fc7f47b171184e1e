//! Where bodies have been: the trace of a mass, the wake of a ship.

use glam::DVec2;

use super::compose::Shown;
use super::palette::{self, faded, style};
use super::sketch::{Camera, demote, line};
use super::{Cap, Picture, Rgba, Stroke};
use crate::lab::{History, Sample};

/// The most segments in a trail: more would not show.
const TRAIL_SEGMENTS: usize = 180;

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
            let colour = faded(colour(sample), self.fade(age, self.paper_s));
            picture.strokes.push(line(last, next, 1.5, colour, camera.rect));
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
        let (mut last, mut ahead, mut run) = (from, DVec2::X, 0.0);
        for (age, sample) in self.recent(history, wake_s) {
            let leg = last - sample.at;
            ahead = leg.try_normalize().unwrap_or(ahead);
            let fade = self.fade(age, wake_s);
            let foam = faded(self.colour(sample), 0.55 * fade);
            let radius = camera.length(unit * (0.35 + 0.75 * age / wake_s));
            picture.strokes.push(Stroke {
                radii: [radius, radius],
                cap: Cap::Butt,
                ..line(camera.points(last), camera.points(sample.at), 1.0, foam, camera.rect)
            });
            let arm = faded(palette::TRUTH, 0.35 * fade);
            for side in [-1.0, 1.0] {
                let edge = |at: DVec2, run: f64| {
                    let spread = side * (1.2 * unit + KELVIN_SLOPE * run);
                    camera.points(at + 3.0 * unit * ahead + spread * ahead.perp())
                };
                let (a, b) = (edge(last, run), edge(sample.at, run + leg.length()));
                picture.strokes.push(line(a, b, 1.2, arm, camera.rect));
            }
            run += leg.length();
            last = sample.at;
        }
    }
}
