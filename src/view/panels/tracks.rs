//! The lanes as curves of a plot. Each piece of a curve has the colour of the method that flew it. A lane that has left
//! the plot is not drawn.

use std::borrow::Cow;
use std::ops::RangeInclusive;

use super::series_styles::SeriesStyles;
use crate::chart::{Arrow, Bounds, Curve, Dots, Drawing, LineStyle, Switch};
use crate::run::past::{History, Quantity, Sample, Summary};
use crate::run::race::Entrant;
use crate::studio::Studio;

/// A sample of a lane in a plot.
#[derive(Clone, Copy, Debug)]
struct Point {
    t: f64,
    /// Index on the list of the method that flew the lane at the sample.
    entry: usize,
    at: [f64; 2],
    /// Lowest and highest value on the way to the sample.
    swept: [f64; 2],
    /// Whether the body was put at this point. If so, no path leads here from the previous point.
    jumped: bool,
}

/// Level of detail of a plot.
#[derive(Clone, Copy, Debug)]
pub(super) enum Detail {
    /// Every sample.
    Samples,
    /// As many samples as are needed for this number of pixel columns.
    Columns(f32),
}

impl Detail {
    /// Returns the number of points that is enough for a curve.
    fn min_points(self) -> usize {
        match self {
            Self::Samples => usize::MAX,
            Self::Columns(columns) => columns.ceil() as usize,
        }
    }
}

/// Returns a function that gives the lowest and highest value along an axis on the way to a point.
fn range_along(axis: usize) -> impl Fn(&Point) -> [f64; 2] + Clone {
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
    /// Index on the list of the lane's present method.
    pub(super) entry: usize,
    /// Whether the track is drawn in front. In solo mode it is the lane, and in a race the selected lane.
    pub(super) is_front: bool,
    /// The part of the lane, such as an energy, if several tracks show the same lane. Otherwise empty.
    pub(super) part: &'static str,
    /// Length of a dash and of the gap after it, in points, if they differ from the method's.
    dash: Option<[f32; 2]>,
    /// Opacity of the colour.
    strength: f32,
    /// Whether the track holds each sample until the next, as a display does.
    is_held: bool,
}

/// Minimum stay of a lane that re-enters the plot for it to be drawn again, relative to the run's length. A diverging
/// swing crosses the plot again and again, but does not stay.
const RETURNED: f64 = 0.1;

impl Track {
    /// Creates a track for each lane, with its samples of the body at the points that `place` returns. Points that are
    /// not finite are left out. The front track is the last.
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

    /// Creates a track for each lane, with a quantity of the body over time. A position includes its extremes between
    /// samples.
    pub(super) fn of_quantity(
        studio: &Studio,
        body: usize,
        quantity: Quantity,
        detail: Detail,
    ) -> Vec<Self> {
        if quantity != Quantity::Position {
            return Self::of(studio, body, |sample| {
                [sample.t, quantity.value([sample.q, sample.v])]
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
        let from_s = studio.deck.drawn_from_s();
        let mut tracks: Vec<Self> = lanes.map(|lane| track(lane).since(from_s)).collect();
        tracks.sort_by_key(|track| track.is_front);
        tracks
    }

    /// Creates a track of these times (s) and places, in the style at the index `entry`.
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

    /// Returns the same track, but with each sample held until the next one.
    pub(super) fn held(self) -> Self {
        Self { is_held: true, ..self }
    }

    /// Returns the same track as a part of its lane, with its own dash and opacity.
    pub(super) fn into_part(self, part: &'static str, dash: [f32; 2], strength: f32) -> Self {
        Self { part, dash: Some(dash), strength, ..self }
    }

    /// Returns the method of the lane at time `t` (s), and the lane's place, which lies between samples on the line
    /// through them.
    pub(super) fn at(&self, t: f64) -> Option<(usize, [f64; 2])> {
        if self.is_held {
            let last = self.points.partition_point(|point| point.t <= t).checked_sub(1)?;
            return Some((self.points[last].entry, [t, self.points[last].at[1]]));
        }
        // If the body was put elsewhere at exactly this time, the new place counts.
        let after = self.points.partition_point(|point| point.t <= t);
        let from = self.points[after.checked_sub(1)?];
        if from.t == t {
            return Some((from.entry, from.at));
        }
        let to = self.points.get(after)?;
        let part = if to.t > from.t { (t - from.t) / (to.t - from.t) } else { 1.0 };
        Some((to.entry, [0, 1].map(|axis| from.at[axis] + part * (to.at[axis] - from.at[axis]))))
    }

    /// Returns the time, the method and the place of each sample, oldest first.
    pub(super) fn places(&self) -> impl Iterator<Item = (f64, usize, [f64; 2])> {
        self.points.iter().map(|point| (point.t, point.entry, point.at))
    }

    /// Returns the methods that flew the lane, in order of time.
    pub(super) fn methods(&self) -> impl Iterator<Item = usize> {
        self.points.chunk_by(|a, b| a.entry == b.entry).map(|run| run[0].entry)
    }

    /// Adds the place at which the body is put at time `t` (s).
    pub(super) fn add_jump(&mut self, t: f64, at: [f64; 2]) {
        let entry = self.points.last().map_or(self.entry, |last| last.entry);
        self.points.push(Point { t, entry, at, swept: [at[1]; 2], jumped: true });
    }

    /// Keeps the last `count` samples.
    pub(super) fn keep_latest(&mut self, count: usize) {
        self.points.drain(..self.points.len().saturating_sub(count));
    }

    /// Returns the values along an axis, including those between samples.
    pub(super) fn along(&self, axis: usize) -> impl Iterator<Item = f64> + Clone {
        self.points.iter().flat_map(range_along(axis))
    }

    /// Returns the values of the front lane along an axis from time `t` (s) on, with those between samples. The axes of
    /// a plot always include them.
    pub(super) fn front_since(
        tracks: &[Self],
        axis: usize,
        t: f64,
    ) -> impl Iterator<Item = f64> + Clone {
        let front = tracks.iter().filter(|track| track.is_front);
        let later = move |track: &Self| track.points.partition_point(|point| point.t < t);
        let points = front.flat_map(move |track| &track.points[later(track)..]);
        points.flat_map(range_along(axis)).filter(|value| value.is_finite())
    }

    /// Returns the tracks that an axis must include. They start at the last placement of a body or change of a
    /// parameter. While the motion since then has only begun, they include everything earlier.
    pub(super) fn fitted<'t>(studio: &Studio, tracks: &'t [Self]) -> Cow<'t, [Self]> {
        let since_s = studio.past().swing_since_s(studio.race().t());
        if since_s == f64::NEG_INFINITY {
            return Cow::Borrowed(tracks);
        }
        Cow::Owned(tracks.iter().map(|track| track.since(since_s)).collect())
    }

    /// Returns the track from time `t` (s) on. If the body was put elsewhere at that time, the track starts at the new
    /// place.
    fn since(&self, t: f64) -> Self {
        let later = self.points.partition_point(|point| point.t < t);
        let put = self.points.iter().rposition(|point| point.t == t && point.jumped);
        Self { points: self.points[put.unwrap_or(later)..].to_vec(), ..*self }
    }

    /// Returns the times of the first and the last sample, in seconds.
    pub(super) fn times(&self) -> Option<(f64, f64)> {
        Some((self.points.first()?.t, self.points.last()?.t))
    }

    pub(super) fn is_empty(&self) -> bool {
        self.points.is_empty()
    }
}

/// The width of the curve in front, in points.
const FRONT: f32 = 2.8;
/// Opacity of the lanes of a race that are not selected, and amount by which their curves are thinner, in points.
const DIM: f32 = 0.62;
const THINNER: f32 = 1.0;

/// Style of the tracks in a plot.
#[derive(Clone, Copy, Debug)]
pub(super) struct TrackStyle {
    pub(super) dots: Dots,
    /// Whether the horizontal axis is time. No lane leaves such a plot at its sides, because the plot follows the
    /// present.
    pub(super) is_over_time: bool,
}

/// Draws the lanes within `bounds`, with an arrow where a lane leaves them and a mark at each switch of a method.
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
    // The time between a halt and a switch has no samples, because a halted body has none.
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
        // The piece extends to the edge at both ends. It does not cross a jump, nor a switch where it begins.
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
    // A method has an arrow at the end of its flight if no part of the flight is in view.
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

/// Returns the corners of a line that is level from each point to the next.
fn staircase(run: &[Point]) -> Vec<[f64; 2]> {
    let steps = run.windows(2).flat_map(|pair| [pair[0].at, [pair[1].at[0], pair[0].at[1]]]);
    steps.chain(run.last().map(|last| last.at)).collect()
}

/// Whether the lane went from one sample to the next under one method, without a jump.
fn goes_on(from: &Point, to: &Point) -> bool {
    from.entry == to.entry && !to.jumped
}

/// Returns the ranges of samples within the plot, without the short visits of a lane that has left the plot. A range
/// counts if it lasts `min_s`, or if it begins at the start, with another method, or where the body was put.
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

/// Returns the parts of a lane, each under one method. A part begins where the previous part ends, unless the body was
/// put elsewhere, or was resumed some time after a halt.
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
