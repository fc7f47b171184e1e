//! Where bodies have been: the trace of a mass, the wake of a ship.

use std::iter;

use glam::{DVec2, Vec2};

use super::compose::Shown;
use super::palette::{self, faded, style};
use super::sketch::{Camera, demote, line};
use super::{Picture, Rect, Rgba, Ribbon, RibbonPoint};
use crate::lab::{History, Sample};

/// The most points in a lane's trail: more would not show.
const TRAIL_POINTS: usize = 720;
/// Half the width of a trail and of an arm of a bow wave, in points.
const TRAIL_RADIUS: f32 = 0.75;
const ARM_RADIUS: f32 = 0.6;
/// From this distance on, in points, samples of a trail can be told apart, and have dots of this radius.
const SPARSE: f32 = 6.0;
const DOT_RADIUS: f32 = 1.7;

/// A moment of a body's past.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moment {
    /// How long ago, in seconds.
    pub(super) age: f64,
    /// Where the body was, in metres.
    pub(super) at: DVec2,
    /// The colour of what got it there.
    pub(super) colour: Rgba,
}

/// A ribbon through some moments.
fn ribbon(moments: &[Moment], clip: Rect, point: impl FnMut(&Moment) -> RibbonPoint) -> Ribbon {
    Ribbon { points: moments.iter().map(point).collect(), clip }
}

impl Shown<'_> {
    /// The samples of the last `trail_s` seconds before the moment drawn, newest first, thinned to
    /// what shows, each with its age.
    fn recent<'h>(
        &self,
        history: &'h History,
        trail_s: f64,
    ) -> impl Iterator<Item = (f64, &'h Sample)> {
        let shown = self.lanes_t;
        // A body that was put elsewhere did not move there.
        let jump = history.samples().rev().position(|sample| sample.jumped);
        let unbroken = jump.map_or(usize::MAX, |jump| jump + 1);
        let recent = move |s: &&Sample| shown - s.t < trail_s;
        let count = history.samples().rev().take(unbroken).take_while(recent).count();
        let every = count.div_ceil(TRAIL_POINTS).max(1);
        let newest_first = history.samples().rev().take(unbroken).take_while(recent);
        let newest_first = newest_first.step_by(every);
        newest_first.filter(move |s| s.t < shown).map(move |s| (shown - s.t, s))
    }

    /// The past of a body that is now at `from`, newest first, cut where its method was switched, each
    /// part beginning where the one before ends.
    pub(super) fn legs(&self, from: DVec2, history: &History, trail_s: f64) -> Vec<Vec<Moment>> {
        let past: Vec<(f64, &Sample)> = self.recent(history, trail_s).collect();
        let (mut age, mut at) = (0.0, from);
        let legs = past.chunk_by(|(_, new), (_, old)| new.entry == old.entry).map(|flown| {
            let colour = style(self.lab.entries()[flown[0].1.entry].method).0;
            let first = Moment { age, at, colour };
            let rest = flown.iter().map(|&(age, sample)| Moment { age, at: sample.at, colour });
            let leg: Vec<Moment> = iter::once(first).chain(rest).collect();
            (age, at) = leg.last().map_or((age, at), |last| (last.age, last.at));
            leg
        });
        legs.collect()
    }

    fn fade(&self, age: f64, trail_s: f64) -> f32 {
        if self.lab.display().motion { demote(1.0 - age / trail_s) } else { 0.6 }
    }

    /// Where a moment lies on a chart recorder's paper: older is further down.
    pub(super) fn on_paper(&self, camera: &Camera, moment: &Moment) -> [f32; 2] {
        let drop = camera.paper / self.paper_s;
        let [x, y] = camera.points(moment.at);
        [x, demote(f64::from(y) + moment.age * drop)]
    }

    /// Where a body has been that moves along x, drawn as a chart recorder would.
    pub(super) fn recorded(&self, picture: &mut Picture, camera: &Camera, past: &[Moment]) {
        picture.ribbons.push(ribbon(past, camera.rect, |moment| RibbonPoint {
            at: self.on_paper(camera, moment),
            radius: TRAIL_RADIUS,
            colour: faded(moment.colour, self.fade(moment.age, self.paper_s)),
        }));
    }

    /// Where a body has been, in its place.
    pub(super) fn path(
        &self,
        picture: &mut Picture,
        camera: &Camera,
        past: &[Moment],
        trail_s: f64,
    ) {
        picture.ribbons.push(ribbon(past, camera.rect, |moment| RibbonPoint {
            at: camera.points(moment.at),
            radius: TRAIL_RADIUS,
            // Opaque, since where a trail crosses itself one piece covers the other.
            colour: palette::dimmed(moment.colour, self.fade(moment.age, trail_s)),
        }));
    }

    /// A dot on each sample of a lane's trail that is far enough from the next one for the line between
    /// them to be taken for motion. The first moment of a leg is no sample.
    pub(super) fn dots(
        &self,
        picture: &mut Picture,
        camera: &Camera,
        leg: &[Moment],
        trail_s: f64,
        place: impl Fn(&Moment) -> [f32; 2],
    ) {
        for ends in leg.windows(2) {
            let [newer, older] = [0, 1].map(|i| Vec2::from(place(&ends[i])));
            if newer.distance(older) >= SPARSE {
                let colour = faded(ends[1].colour, self.fade(ends[1].age, trail_s));
                let at = older.into();
                picture.strokes.push(line(at, at, 2.0 * DOT_RADIUS, colour, camera.rect));
            }
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
                colour: faded(moment.colour, 0.55 * self.fade(moment.age, wake_s)),
            }));
        }
        let course: Vec<Moment> = legs.into_iter().flatten().collect();
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
