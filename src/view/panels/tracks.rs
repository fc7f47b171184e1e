//! The lanes as curves of a plot: every piece in the colour of the method that flew it, and nothing of a
//! lane that has left the plot.

use std::borrow::Cow;
use std::ops::RangeInclusive;

use super::series_styles::SeriesStyles;
use crate::run::past::{History, Quantity, Sample, Summary};
use crate::run::race::Entrant;
use crate::studio::Studio;
use crate::view::chart::{Arrow, Bounds, Curve, Dots, Drawing, LineStyle, Switch};

/// A sample of a lane in a plot.
#[derive(Clone, Copy, Debug)]
struct Point {
    t: f64,
    /// The method that flew the lane there, by its index on the list.
    entry: usize,
    at: [f64; 2],
    /// The least and the greatest height on the way there.
    swept: [f64; 2],
    /// Whether the body was put there, so that no path leads from the point before.
    jumped: bool,
}

/// How closely a plot is looked at.
#[derive(Clone, Copy, Debug)]
pub(super) enum Detail {
    /// Every sample counts.
    Samples,
    /// The number of pixel columns on which it is seen.
    Columns(f32),
}

impl Detail {
    /// The number of a curve's points that is enough.
    fn min_points(self) -> usize {
        match self {
            Self::Samples => usize::MAX,
            Self::Columns(columns) => columns.ceil() as usize,
        }
    }
}

/// The least and the greatest value along an axis on the way to a point.
fn ends(axis: usize) -> impl Fn(&Point) -> [f64; 2] + Clone {
    move |point| if axis == 1 { point.swept } else { [point.at[axis]; 2] }
}

fn finite(points: impl Iterator<Item = Point>) -> Vec<Point> {
    let mut kept = Vec::with_capacity(points.size_hint().0);
    let finite = points.filter(|point| point.at.iter().all(|x| x.is_finite()));
    finite.for_each(|point| kept.push(point));
    kept
}

/// The samples of one lane, oldest first.
#[derive(Clone, Debug)]
pub(super) struct Track {
    points: Vec<Point>,
    /// The method of the lane now, by its index on the list.
    pub(super) entry: usize,
    /// Whether it is drawn in front: the lane in solo mode, or the selected lane of a race.
    pub(super) is_front: bool,
    /// What of the lane it is, where several tracks are of one lane; else empty.
    pub(super) part: &'static str,
    /// Drawn length and gap in points, where it is not the method's.
    dash: Option<[f32; 2]>,
    /// How much of its colour it has.
    strength: f32,
    /// Whether it stays at each sample until the next, as a display does.
    is_held: bool,
}

/// A lane that re-enters the plot is drawn again once it has stayed for this fraction of the visible time: a diverging swing
/// crosses the plot again and again.
const RETURNED: f64 = 0.1;

impl Track {
    /// A track for each lane, of `place` of its samples of the body; those that are not finite are left out. The one in
    /// front is the last.
    pub(super) fn of(
        studio: &Studio,
        body: usize,
        place: impl Fn(&Sample) -> [f64; 2],
    ) -> Vec<Self> {
        Self::of_points(studio, body, |s| {
            let at = place(s);
            Point { t: s.t, entry: s.entry, at, swept: [at[1]; 2], jumped: s.jumped }
        })
    }

    /// A track for each lane, of a quantity of the body over time; of a coordinate with all that it comes to between
    /// samples.
    pub(super) fn of_quantity(
        studio: &Studio,
        body: usize,
        quantity: Quantity,
        detail: Detail,
    ) -> Vec<Self> {
        if quantity != Quantity::Position {
            return Self::of(studio, body, |sample| {
                [sample.t, quantity.among([sample.q, sample.v])]
            });
        }
        let point = |s: Summary| Point {
            t: s.t,
            entry: s.entry,
            at: [s.t, s.q],
            swept: s.swept.ends(),
            jumped: s.jumped,
        };
        let points = |history: &History| {
            finite(history.summaries(detail.min_points()).into_iter().map(point))
        };
        Self::of_histories(studio, body, points)
    }

    fn of_points(studio: &Studio, body: usize, point: impl Fn(&Sample) -> Point) -> Vec<Self> {
        Self::of_histories(studio, body, |history| finite(history.samples().map(&point)))
    }

    fn of_histories(
        studio: &Studio,
        body: usize,
        points: impl Fn(&History) -> Vec<Point>,
    ) -> Vec<Self> {
        let front = studio.selected().id;
        let track = |lane: &Entrant| Self {
            points: points(&studio.past().histories(lane.id)[body]),
            entry: studio.entry(lane),
            is_front: lane.id == front,
            part: "",
            dash: None,
            strength: 1.0,
            is_held: false,
        };
        let lanes = studio.race().entrants().iter();
        let mut tracks: Vec<Self> = lanes.map(track).collect();
        tracks.sort_by_key(|track| track.is_front);
        tracks
    }

    /// A track of these times (s) and places, under the one at place `entry` of the styles.
    pub(super) fn of_places(
        entry: usize,
        is_front: bool,
        places: impl Iterator<Item = (f64, [f64; 2])>,
    ) -> Self {
        let point =
            |(t, at): (f64, [f64; 2])| Point { t, entry, at, swept: [at[1]; 2], jumped: false };
        let points = finite(places.map(point));
        Self { points, entry, is_front, part: "", dash: None, strength: 1.0, is_held: false }
    }

    /// The same track, which stays at each sample until the next.
    pub(super) fn held(self) -> Self {
        Self { is_held: true, ..self }
    }

    /// The same track as a part of its lane, with a dash of its own, and so much of its colour.
    pub(super) fn into_part(self, part: &'static str, dash: [f32; 2], strength: f32) -> Self {
        Self { part, dash: Some(dash), strength, ..self }
    }

    /// The method that flew the lane at time `t` (s), and where it was, between samples on the line through them.
    pub(super) fn at(&self, t: f64) -> Option<(usize, [f64; 2])> {
        if self.is_held {
            let last = self.points.partition_point(|point| point.t <= t).checked_sub(1)?;
            return Some((self.points[last].entry, [t, self.points[last].at[1]]));
        }
        // Where the body was put at that time, it is there.
        let after = self.points.partition_point(|point| point.t <= t);
        let from = self.points[after.checked_sub(1)?];
        if from.t == t {
            return Some((from.entry, from.at));
        }
        let to = self.points.get(after)?;
        let part = if to.t > from.t { (t - from.t) / (to.t - from.t) } else { 1.0 };
        Some((to.entry, [0, 1].map(|axis| from.at[axis] + part * (to.at[axis] - from.at[axis]))))
    }

    /// When the lane was sampled, the method that flew it, and where it was, oldest first.
    pub(super) fn places(&self) -> impl Iterator<Item = (f64, usize, [f64; 2])> {
        self.points.iter().map(|point| (point.t, point.entry, point.at))
    }

    /// The methods that flew it, in order.
    pub(super) fn flown(&self) -> impl Iterator<Item = usize> {
        self.points.chunk_by(|a, b| a.entry == b.entry).map(|run| run[0].entry)
    }

    /// Goes on at a place where the body is put at time `t` (s).
    pub(super) fn put(&mut self, t: f64, at: [f64; 2]) {
        let entry = self.points.last().map_or(self.entry, |last| last.entry);
        self.points.push(Point { t, entry, at, swept: [at[1]; 2], jumped: true });
    }

    /// Keeps the last `count` samples.
    pub(super) fn keep_latest(&mut self, count: usize) {
        self.points.drain(..self.points.len().saturating_sub(count));
    }

    /// The values along an axis, with those between samples.
    pub(super) fn along(&self, axis: usize) -> impl Iterator<Item = f64> + Clone {
        self.points.iter().flat_map(ends(axis))
    }

    /// The values along an axis of the lane in front from time `t` (s) on, with those between samples: the axes of a plot
    /// always show them.
    pub(super) fn front_since(
        tracks: &[Self],
        axis: usize,
        t: f64,
    ) -> impl Iterator<Item = f64> + Clone {
        let front = tracks.iter().filter(|track| track.is_front);
        let later = move |track: &Self| track.points.partition_point(|point| point.t < t);
        let points = front.flat_map(move |track| &track.points[later(track)..]);
        points.flat_map(ends(axis)).filter(|value| value.is_finite())
    }

    /// The tracks that an axis is fitted to: without what was before a body was put elsewhere or a parameter changed, but
    /// for the moments after that.
    pub(super) fn fitted<'t>(studio: &Studio, tracks: &'t [Self]) -> Cow<'t, [Self]> {
        let since_s = studio.past().swing_since_s(studio.race().t());
        if since_s == f64::NEG_INFINITY {
            return Cow::Borrowed(tracks);
        }
        Cow::Owned(tracks.iter().map(|track| track.since(since_s)).collect())
    }

    /// The track from time `t` (s) on; where the body was put elsewhere at that time, from there.
    fn since(&self, t: f64) -> Self {
        let later = self.points.partition_point(|point| point.t < t);
        let put = self.points.iter().rposition(|point| point.t == t && point.jumped);
        Self { points: self.points[put.unwrap_or(later)..].to_vec(), ..*self }
    }

    /// The times of the first and the last sample, in seconds.
    pub(super) fn times(&self) -> Option<(f64, f64)> {
        Some((self.points.first()?.t, self.points.last()?.t))
    }

    pub(super) fn is_empty(&self) -> bool {
        self.points.is_empty()
    }
}

/// The width of the curve in front, in points.
const FRONT: f32 = 2.8;
/// How much of its colour a lane of a race has that is not selected, and by how much its curve is thinner, in points.
const DIM: f32 = 0.62;
const THINNER: f32 = 1.0;

/// How tracks are drawn.
#[derive(Clone, Copy, Debug)]
pub(super) struct TrackStyle {
    pub(super) dots: Dots,
    /// Whether the axis along is time: no lane leaves the plot by it, for the plot follows.
    pub(super) is_over_time: bool,
}

/// The lanes within `bounds`, with an arrow where one leaves them and a mark where one was switched.
pub(super) fn drawing(
    styles: &SeriesStyles,
    tracks: &[Track],
    bounds: &Bounds,
    style: TrackStyle,
) -> Drawing {
    let mut drawing = Drawing::default();
    for track in tracks {
        add(&mut drawing, styles, track, bounds, style);
    }
    drawing
}

fn add(
    drawing: &mut Drawing,
    styles: &SeriesStyles,
    track: &Track,
    bounds: &Bounds,
    style: TrackStyle,
) {
    let points = &track.points[..];
    let is_dim = styles.is_race && !track.is_front;
    let is_thin = is_dim || track.strength < 1.0;
    let width = if is_thin { FRONT - THINNER } else { FRONT };
    let series = |point: &Point| &styles.series[point.entry];
    let strength = if is_dim { DIM } else { track.strength };
    let rgba = |point: &Point| series(point).colour.gamma_multiply(strength);
    // A body that had halted has no samples from there to the switch.
    for pair in points.windows(2).filter(|pair| pair[0].entry != pair[1].entry) {
        drawing.switches.push(Switch { at: pair[1].at, colour: rgba(&pair[1]) });
    }
    let within = |point: &Point| {
        let values = [[point.at[0]; 2], point.swept];
        let is_within = |i: usize| {
            let [low, high] = bounds[i];
            values[i].iter().all(|value| (low..=high).contains(value))
        };
        (style.is_over_time || is_within(0)) && is_within(1)
    };
    let is_in_view = |point: &Point| !style.is_over_time || point.at[0] >= bounds[0][0];
    let mut is_drawn = vec![false; points.len()];
    for stay in stays(points, within, RETURNED * styles.length_s) {
        let (first, last) = stay.into_inner();
        // To the edge on both sides, and not across a switch on the way in.
        let enters = first > 0 && goes_on(&points[first - 1], &points[first]);
        let leaves = points.get(last + 1).is_some_and(|next| !next.jumped);
        let piece = first - usize::from(enters)..=last + usize::from(leaves);
        is_drawn[piece.clone()].fill(true);
        drawing.curves.extend(runs(&points[piece]).map(|run| {
            let newest = &run[run.len() - 1];
            let dash = track.dash.unwrap_or(series(newest).dash);
            Curve {
                style: LineStyle { colour: rgba(newest), width, dash, dots: style.dots },
                points: if track.is_held { staircase(run) } else { places(run) },
                swept: if track.is_held { Vec::new() } else { swept(run) },
            }
        }));
        if leaves && is_in_view(&points[last + 1]) {
            let colour = rgba(&points[last + 1]);
            drawing.arrows.push(Arrow { from: points[last].at, to: points[last + 1].at, colour });
        }
    }
    // A method of whose flight nothing shows has an arrow where it ended.
    let mut end = 0;
    for run in points.chunk_by(goes_on) {
        let start = end;
        end += run.len();
        let newest = &points[end - 1];
        let shows = |i: usize| is_drawn[i] && is_in_view(&points[i]);
        if !within(newest) && is_in_view(newest) && !(start..end).any(shows) {
            drawing.arrows.push(Arrow { from: newest.at, to: newest.at, colour: rgba(newest) });
        }
    }
}

fn places(run: &[Point]) -> Vec<[f64; 2]> {
    run.iter().map(|point| point.at).collect()
}

fn swept(run: &[Point]) -> Vec<[f64; 2]> {
    run.iter().map(|point| point.swept).collect()
}

/// The corners of a line that is level from each point to the next.
fn staircase(run: &[Point]) -> Vec<[f64; 2]> {
    let steps = run.windows(2).flat_map(|pair| [pair[0].at, [pair[1].at[0], pair[0].at[1]]]);
    steps.chain(run.last().map(|last| last.at)).collect()
}

/// Whether the lane went from one sample to the next under one method.
fn goes_on(from: &Point, to: &Point) -> bool {
    from.entry == to.entry && !to.jumped
}

/// The ranges of samples that are within, but for short visits of a lane that has left: what begins at
/// the start, or with another method, or where the body was put, or lasts.
fn stays(
    points: &[Point],
    within: impl Fn(&Point) -> bool,
    min_s: f64,
) -> Vec<RangeInclusive<usize>> {
    let mut stays = Vec::new();
    let mut next = 0;
    while let Some(first) = (next..points.len()).find(|&i| within(&points[i])) {
        let outside = (first..points.len()).find(|&i| !within(&points[i]));
        let last = outside.unwrap_or(points.len()) - 1;
        let begins = first == 0 || !goes_on(&points[first - 1], &points[first]);
        if begins || points[last].t - points[first].t >= min_s {
            stays.push(first..=last);
        }
        next = last + 1;
    }
    stays
}

/// The parts flown by one method each; each begins where the one before ends, unless the body was put elsewhere or had
/// halted there and was taken up again later.
fn runs(points: &[Point]) -> impl Iterator<Item = &[Point]> {
    let mut start = 0;
    points.chunk_by(goes_on).map(move |run| {
        let first: usize = start;
        start += run.len();
        let meets = first > 0 && points[first - 1].t == points[first].t && !points[first].jumped;
        &points[first - usize::from(meets)..start]
    })
}

#[cfg(test)]
mod tests;
