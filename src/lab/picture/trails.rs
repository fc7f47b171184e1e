//! Where bodies have been: the trace of a mass, the wake of a ship.

use std::iter;

use glam::DVec2;

use super::compose::Shown;
use super::palette::{self, faded, style};
use super::sketch::{Camera, demote};
use super::{Picture, Rect, Rgba, Ribbon, RibbonPoint};
use crate::lab::{History, Sample};

/// The most points in a trail: more would not show.
const TRAIL_POINTS: usize = 180;
/// Half the width of a trail and of an arm of a bow wave, in points.
const TRAIL_RADIUS: f32 = 0.75;
const ARM_RADIUS: f32 = 0.6;

/// A moment of a body's past.
struct Moment<'h> {
    /// How long ago, in seconds.
    age: f64,
    /// Where the body was, in metres.
    at: DVec2,
    /// By what method it got there.
    sample: &'h Sample,
}

/// A ribbon through some moments.
fn ribbon<'h>(
    moments: &[Moment<'h>],
    clip: Rect,
    point: impl FnMut(&Moment<'h>) -> RibbonPoint,
) -> Ribbon {
    Ribbon { points: moments.iter().map(point).collect(), clip }
}

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
        let unbroken_since = history.unbroken_since();
        let recent = move |s: &&Sample| shown - s.t < trail_s && s.t >= unbroken_since;
        let count = history.samples().rev().take_while(recent).count();
        let every = count.div_ceil(TRAIL_POINTS).max(1);
        let newest_first = history.samples().rev().take_while(recent).step_by(every);
        newest_first.filter(move |s| s.t < shown).map(move |s| (shown - s.t, s))
    }

    /// The past of a body that is now at `from`, newest first, cut where its method was switched, each
    /// part beginning where the one before ends.
    fn legs<'h>(&self, from: DVec2, history: &'h History, trail_s: f64) -> Vec<Vec<Moment<'h>>> {
        let past: Vec<(f64, &Sample)> = self.recent(history, trail_s).collect();
        let (mut age, mut at) = (0.0, from);
        let legs = past.chunk_by(|(_, new), (_, old)| new.entry == old.entry).map(|flown| {
            let first = Moment { age, at, sample: flown[0].1 };
            let rest = flown.iter().map(|&(age, sample)| Moment { age, at: sample.at, sample });
            let leg: Vec<Moment<'_>> = iter::once(first).chain(rest).collect();
            (age, at) = leg.last().map_or((age, at), |last| (last.age, last.at));
            leg
        });
        legs.collect()
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
        let place = |moment: &Moment<'_>| {
            let [x, y] = camera.points(moment.at);
            [x, demote(f64::from(y) + moment.age * drop)]
        };
        for leg in self.legs(from, history, self.paper_s) {
            picture.ribbons.push(ribbon(&leg, camera.rect, |moment| RibbonPoint {
                at: place(moment),
                radius: TRAIL_RADIUS,
                colour: faded(colour(moment.sample), self.fade(moment.age, self.paper_s)),
            }));
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
        for leg in self.legs(from, history, trail_s) {
            picture.ribbons.push(ribbon(&leg, camera.rect, |moment| RibbonPoint {
                at: camera.points(moment.at),
                radius: TRAIL_RADIUS,
                // Opaque, since where a trail crosses itself one piece covers the other.
                colour: palette::dimmed(colour(moment.sample), self.fade(moment.age, trail_s)),
            }));
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
        let legs = self.legs(from, history, wake_s);
        for leg in &legs {
            picture.ribbons.push(ribbon(leg, camera.rect, |moment| RibbonPoint {
                at: camera.points(moment.at),
                radius: camera.length(unit * (0.35 + 0.75 * moment.age / wake_s)),
                colour: faded(self.colour(moment.sample), 0.55 * self.fade(moment.age, wake_s)),
            }));
        }
        let course: Vec<Moment<'_>> = legs.into_iter().flatten().collect();
        let Some([newest, next]) = course.first_chunk() else { return };
        for side in [-1.0, 1.0] {
            let (mut last, mut run) = (newest.at, 0.0);
            let mut ahead = (newest.at - next.at).try_normalize().unwrap_or(DVec2::X);
            picture.ribbons.push(ribbon(&course, camera.rect, |moment| {
                let sailed = last - moment.at;
                ahead = sailed.try_normalize().unwrap_or(ahead);
                (last, run) = (moment.at, run + sailed.length());
                let spread = side * (1.2 * unit + KELVIN_SLOPE * run);
                RibbonPoint {
                    at: camera.points(moment.at + 3.0 * unit * ahead + spread * ahead.perp()),
                    radius: ARM_RADIUS,
                    colour: faded(palette::TRUTH, 0.35 * self.fade(moment.age, wake_s)),
                }
            }));
        }
    }
}
