//! The lanes as curves of a plot. Each piece has the colour of the method that flew it, and a lane that has left the
//! plot is not drawn.

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
    /// Index on the list of the method that flew the lane there.
    entry: usize,
    at: [f64; 2],
    /// Lowest and highest value on the way there.
    swept: [f64; 2],
    /// Whether the body was put there. No path then leads from the point before.
    jumped: bool,
}

/// Level of detail of a plot.
#[derive(Clone, Copy, Debug)]
pub(super) enum Detail {
    /// Every sample.
    Samples,
    /// Enough samples for this number of pixel columns.
    Columns(f32),
}

impl Detail {
    /// Number of points that suffices for a curve.
    fn min_points(self) -> usize {
        match self {
            Self::Samples => usize::MAX,
            Self::Columns(columns) => columns.ceil() as usize,
        }
    }
}

/// Lowest and highest value along an axis on the way to a point.
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
    /// Whether it is drawn in front: the lane in solo mode, or the selected lane of a race.
    pub(super) is_front: bool,
    /// The part of the lane, such as an energy, if several tracks show one lane; else empty.
    pub(super) part: &'static str,
    /// Drawn length and gap in points, if they are not the method's.
    dash: Option<[f32; 2]>,
    /// Opacity of the colour.
    strength: f32,
    /// Whether the track holds each sample until the next, as a display does.
    is_held: bool,
}

/// A lane that re-enters the plot is drawn again once it has stayed for this fraction of the run's length. A
/// diverging swing only crosses the plot again and again.
const RETURNED: f64 = 0.1;

impl Track {
    /// A track for each lane, at `place` of its samples of the body, without places that are not finite. The front
    /// track is the last.
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

    /// A track for each lane, of a quantity of the body over time. A position includes its extremes between samples.
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
        let mut tracks: Vec<Self> = lanes.map(track).collect();
        tracks.sort_by_key(|track| track.is_front);
        tracks
    }

    /// A track of these times (s) and places, in the style at index `entry`.
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

    /// The same track, which holds each sample until the next.
    pub(super) fn held(self) -> Self {
        Self { is_held: true, ..self }
    }

    /// The same track as a part of its lane, with its own dash and opacity.
    pub(super) fn into_part(self, part: &'static str, dash: [f32; 2], strength: f32) -> Self {
        Self { part, dash: Some(dash), strength, ..self }
    }

    /// The method of the lane at time `t` (s), and its place: between samples, on the line through them.
    pub(super) fn at(&self, t: f64) -> Option<(usize, [f64; 2])> {
        if self.is_held {
            let last = self.points.partition_point(|point| point.t <= t).checked_sub(1)?;
            return Some((self.points[last].entry, [t, self.points[last].at[1]]));
        }
        // If the body was put elsewhere at that time, the new place counts.
        let after = self.points.partition_point(|point| point.t <= t);
        let from = self.points[after.checked_sub(1)?];
        if from.t == t {
            return Some((from.entry, from.at));
        }
        let to = self.points.get(after)?;
        let part = if to.t > from.t { (t - from.t) / (to.t - from.t) } else { 1.0 };
        Some((to.entry, [0, 1].map(|axis| from.at[axis] + part * (to.at[axis] - from.at[axis]))))
    }

    /// Time, method and place of each sample, oldest first.
    pub(super) fn places(&self) -> impl Iterator<Item = (f64, usize, [f64; 2])> {
        self.points.iter().map(|point| (point.t, point.entry, point.at))
    }

    /// The methods that flew the lane, in order.
    pub(super) fn methods(&self) -> impl Iterator<Item = usize> {
        self.points.chunk_by(|a, b| a.entry == b.entry).map(|run| run[0].entry)
    }

    /// Adds the place where the body is put at time `t` (s).
    pub(super) fn add_jump(&mut self, t: f64, at: [f64; 2]) {
        let entry = self.points.last().map_or(self.entry, |last| last.entry);
        self.points.push(Point { t, entry, at, swept: [at[1]; 2], jumped: true });
    }

    /// Keeps the last `count` samples.
    pub(super) fn keep_latest(&mut self, count: usize) {
        self.points.drain(..self.points.len().saturating_sub(count));
    }

    /// Values along an axis, including those between samples.
    pub(super) fn along(&self, axis: usize) -> impl Iterator<Item = f64> + Clone {
        self.points.iter().flat_map(range_along(axis))
    }

    /// Values of the front lane along an axis from time `t` (s) on, including those between samples. The axes of a
    /// plot always show them.
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

    /// The tracks that an axis is fitted to. They start at the last placement or change of a parameter, but include
    /// everything earlier while the motion after that has just begun.
    pub(super) fn fitted<'t>(studio: &Studio, tracks: &'t [Self]) -> Cow<'t, [Self]> {
        let since_s = studio.past().swing_since_s(studio.race().t());
        if since_s == f64::NEG_INFINITY {
            return Cow::Borrowed(tracks);
        }
        Cow::Owned(tracks.iter().map(|track| track.since(since_s)).collect())
    }

    /// The track from time `t` (s) on, or from the place where the body was put at that time.
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
/// Opacity of the lanes of a race that are not selected, and the width that their curves lack, in points.
const DIM: f32 = 0.62;
const THINNER: f32 = 1.0;

/// Style of the tracks in a plot.
#[derive(Clone, Copy, Debug)]
pub(super) struct TrackStyle {
    pub(super) dots: Dots,
    /// Whether the horizontal axis is time. No lane leaves such a plot sideways, because the plot follows.
    pub(super) is_over_time: bool,
}

/// Draws the lanes within `bounds`, with an arrow where one leaves them and a mark at each switch.
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
    // A halted body has no samples between its halt and the switch.
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
        // Extends to the edge on both sides, but not across a switch on the way in.
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
    // A method whose flight is out of view has an arrow at its end.
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

/// Ranges of samples within the plot, without short visits of a lane that has left it. A range counts if it begins at
/// the start, with another method or where the body was put, or if it lasts `min_s`.
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

/// Parts of a lane under one method each. Each part begins where the one before ends, unless the body was put
/// elsewhere, or was resumed some time after a halt.
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
