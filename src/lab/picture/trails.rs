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
/// The same in a wake, which has no bends and fades within each segment.
const SHORTEST_OF_WAKE: f32 = 8.0;

impl Shown<'_> {
    /// The colour of the method that flew a body at a moment of its past.
    pub(super) fn colour(&self, sample: &Sample) -> Rgba {
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
    pub(super) fn trail(
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
            if Vec2::from(last).distance(next.into()) < SHORTEST_SEGMENT {
                continue;
            }
            let colour = faded(colour(sample), self.fade(age));
            // Butt, for round ends would lie over each other and show as beads where a trail fades.
            let segment = line(last, next, 1.5, colour, camera.rect);
            picture.strokes.push(Stroke { cap: Cap::Butt, ..segment });
            last = next;
        }
    }

    /// Foam behind the hull, wider and fainter with age, and the two arms of the bow wave.
    pub(super) fn wake(
        &self,
        picture: &mut Picture,
        camera: &Camera,
        from: DVec2,
        history: &History,
    ) {
        /// Half the opening of a ship's wake on deep water, as Kelvin found it: sin = 1/3.
        const KELVIN_SLOPE: f64 = 0.353_553_390_593_273_8;
        let point = |x: f64, y: f64| camera.points(DVec2::new(x, y));
        let (mut new, mut since) = (from.x, 0.0);
        for (age, sample) in self.recent(history) {
            let old = sample.q;
            if camera.length((new - old).abs()) < SHORTEST_OF_WAKE {
                continue;
            }
            let ages = [since, age];
            let paler = |colour, part: f32| ages.map(|age| faded(colour, part * self.fade(age)));
            picture.strokes.push(Stroke {
                radii: ages.map(|age| camera.length(0.35 + 0.25 * age)),
                colours: paler(self.colour(sample), 0.55),
                cap: Cap::Butt,
                ..line(point(new, 0.0), point(old, 0.0), 1.0, palette::TRUTH, camera.rect)
            });
            for side in [-1.0, 1.0] {
                let spread = |x: f64| side * (1.2 + KELVIN_SLOPE * (from.x - x).abs());
                let (a, b) = (point(new + 3.0, spread(new)), point(old + 3.0, spread(old)));
                let arm = line(a, b, 1.2, palette::TRUTH, camera.rect);
                let colours = paler(palette::TRUTH, 0.35);
                picture.strokes.push(Stroke { colours, cap: Cap::Butt, ..arm });
            }
            (new, since) = (old, age);
        }
    }
}
