//! The plots of an instrument before they are drawn. They are stacked over one horizontal axis, and are the source of
//! the drawing in a window and of copied and saved files.

use std::collections::BTreeMap;
use std::ops::Range;

use egui::Color32;

use super::super::series_styles::{SeriesStyle, SeriesStyles};
use super::super::tracks::{self, Track, TrackStyle};
use crate::chart::{Arrow, AxisScale, Bounds, Curve, Dots, Drawing, LineStyle, SwitchMark};
use crate::run::Unit;
use crate::run::past::{Quantity, Sample, TruthCurve, TruthSample};
use crate::stage::Coordinate;
use crate::stage::number::significant;
use crate::studio::{Studio, shows_futures};
use crate::theme::palette_of;

/// Width of the exact curve, in points. A lane that follows the truth is visible on both sides of this curve.
pub(super) const EXACT: f32 = 1.3;

/// Width of the curve of the run before, in points.
const BEFORE: f32 = 1.8;

/// The plots of an instrument.
pub(super) struct PlotSet {
    pub(super) styles: SeriesStyles,
    pub(super) title: String,
    pub(super) plots: Vec<PlotModel>,
}

/// A plot of lanes and the exact solution.
pub(super) struct PlotModel {
    /// Id of the plot's zoom, which is unique among all plots of a scene.
    pub(super) id: String,
    pub(super) title: String,
    /// Index of the body in the scene.
    pub(super) body: usize,
    /// Horizontal and vertical axis.
    pub(super) axes: [PlotAxis; 2],
    /// Bounds in view unless the user has zoomed.
    pub(super) fit: Bounds,
    /// Tracks of the lanes. The front track comes last.
    pub(super) tracks: Vec<Track>,
    pub(super) dots: Dots,
    pub(super) exact: Vec<ExactLine>,
    /// Further curves: the next second under each method, with a dot for each tick, and in truth; or lines that do not
    /// move.
    pub(super) beside: Vec<Curve>,
    /// The run before the last restart, beside the lanes.
    pub(super) before: Option<BeforeLine>,
    /// Whether the quantity is known at ticks only. Its present value is that of the last tick, as in the table.
    pub(super) is_of_ticks: bool,
    /// Whether both axes have the same scale, so that a circle is one.
    pub(super) is_round: bool,
    /// Message in place of the plot, which is the reason why there is nothing to show.
    pub(super) nothing: Option<String>,
}

/// The curve of the run before the last restart.
pub(super) struct BeforeLine {
    pub(super) track: Track,
    /// What that run had instead, such as `2 Hz`.
    pub(super) name: String,
    pub(super) colour: Color32,
}

/// An axis of a plot.
pub(super) struct PlotAxis {
    pub(super) quantity: String,
    /// Unit of the quantity. Empty for a pure number.
    pub(super) unit: String,
    pub(super) scale: AxisScale,
    is_time: bool,
}

/// A curve of the exact solution.
pub(super) struct ExactLine {
    pub(super) curve: Curve,
    /// The time of each point, in seconds.
    pub(super) times: Vec<f64>,
    /// The part of the solution that the curve shows, such as an energy, or an empty text for the whole.
    pub(super) part: &'static str,
    /// Indices of the points at which the body was put elsewhere. No path leads to these points.
    jumps: Vec<usize>,
    /// The plotted quantity, if the plot is over time and the solution is known between the points too.
    known: Option<Quantity>,
}

/// The value of one curve at a moment.
pub(super) struct Readout {
    /// Index of the curve's style, or `None` for the exact solution.
    pub(super) entry: Option<usize>,
    pub(super) colour: Color32,
    pub(super) is_front: bool,
    /// Digit of the method in a race, followed by the name of the part if the curve shows a part.
    pub(super) name: String,
    /// The point of the curve, in places of the axes.
    pub(super) at: [f64; 2],
}

impl PlotAxis {
    pub(super) fn new(quantity: &str, unit: &str, scale: AxisScale) -> Self {
        Self { quantity: quantity.into(), unit: unit.into(), scale, is_time: false }
    }

    /// Creates the axis of a coordinate.
    pub(super) fn of(coordinate: &Coordinate) -> Self {
        Self::new(&coordinate.name, coordinate.shown_unit(), AxisScale::Linear)
    }

    /// Creates the axis of a coordinate's velocity.
    pub(super) fn of_velocity(coordinate: &Coordinate) -> Self {
        Self::new(&coordinate.velocity, &Unit::Velocity.on(coordinate), AxisScale::Linear)
    }

    /// Creates the two axes of a coordinate and its velocity.
    pub(super) fn of_phase(coordinate: &Coordinate) -> [Self; 2] {
        [Self::of(coordinate), Self::of_velocity(coordinate)]
    }

    /// Creates the axis of a quantity of a coordinate.
    pub(super) fn of_quantity(quantity: Quantity, coordinate: &Coordinate) -> Self {
        match quantity {
            Quantity::Position => Self::of(coordinate),
            Quantity::Velocity => Self::of_velocity(coordinate),
        }
    }

    /// Creates the axis of time in seconds.
    pub(super) fn time(quantity: &str) -> Self {
        Self { is_time: true, ..Self::new(quantity, "s", AxisScale::Linear) }
    }

    /// Returns the name of the quantity with its unit.
    pub(super) fn name(&self) -> String {
        let Self { quantity, unit, .. } = self;
        if unit.is_empty() { quantity.clone() } else { format!("{quantity}, {unit}") }
    }

    /// Formats the value at a place, with its unit.
    pub(super) fn with_unit(&self, place: f64) -> String {
        let number = self.number(place);
        if self.unit.is_empty() { number } else { format!("{number} {}", self.unit) }
    }

    /// Formats the value at a place, without its unit.
    pub(super) fn number(&self, place: f64) -> String {
        significant(self.scale.value(place), 3)
    }
}

impl BeforeLine {
    /// Creates the curve of a body in the run before, if there is one.
    pub(super) fn of(
        studio: &Studio,
        body: usize,
        place: impl Fn(&Sample) -> [f64; 2],
    ) -> Option<Self> {
        let before = studio.deck.run_before()?;
        let samples = before.histories.get(body)?.since(before.from_s);
        let places = samples.take_while(|sample| sample.t <= before.until_s);
        let places = places.map(|sample| (sample.t, place(sample)));
        let track = Track::of_places(studio.active(), false, places);
        let colour = palette_of(studio.display().theme).dim;
        (!track.is_empty()).then(|| Self { track, name: before.name.clone(), colour })
    }
}

impl ExactLine {
    /// Creates the exact solution of a body, with a point at each sample for which `place` returns one.
    pub(super) fn of(
        studio: &Studio,
        body: usize,
        mut place: impl FnMut(&TruthSample) -> Option<[f64; 2]>,
    ) -> Self {
        let samples = samples(studio, body);
        let most = samples.size_hint().0;
        let (mut times, mut points) = (Vec::with_capacity(most), Vec::with_capacity(most));
        let (mut jumps, mut has_jumped) = (Vec::new(), false);
        samples.for_each(|sample| {
            has_jumped |= sample.jumped;
            let at = place(&sample).filter(|at| at.iter().all(|x| x.is_finite()));
            let Some(at) = at else { return };
            if std::mem::take(&mut has_jumped) {
                jumps.push(points.len());
            }
            times.push(sample.t);
            points.push(at);
        });
        Self::through(studio, times, points, jumps)
    }

    /// Creates the exact solution from times (s) and places. Places that are not finite are dropped.
    pub(super) fn of_places(
        studio: &Studio,
        places: impl Iterator<Item = (f64, [f64; 2])>,
    ) -> Self {
        let known = places.filter(|(_, at)| at.iter().all(|x| x.is_finite()));
        let (times, points) = known.unzip();
        Self::through(studio, times, points, Vec::new())
    }

    fn through(studio: &Studio, times: Vec<f64>, points: Vec<[f64; 2]>, jumps: Vec<usize>) -> Self {
        let style = LineStyle::solid(palette_of(studio.display().theme).exact, EXACT);
        let curve = Curve::new(style, points);
        Self { curve, times, part: "", jumps, known: None }
    }

    /// Creates the curve of a quantity of a body over time.
    pub(super) fn of_quantity(studio: &Studio, body: usize, quantity: Quantity) -> Self {
        let most = samples(studio, body).size_hint().0;
        let mut swept = Vec::with_capacity(most);
        let line = Self::of(studio, body, |s| {
            let at = finite_point(quantity, s)?;
            swept.push(s.swept.ends());
            Some(at)
        });
        if quantity != Quantity::Position {
            swept.clear();
        }
        Self { curve: Curve { swept, ..line.curve }, known: Some(quantity), ..line }
    }

    /// Returns the same line as a part of the solution, with its own dash and opacity.
    pub(super) fn into_part(self, part: &'static str, dash: [f32; 2], strength: f32) -> Self {
        let colour = self.curve.style.colour.gamma_multiply(strength);
        let style = LineStyle { dash, colour, ..self.curve.style };
        Self { part, curve: Curve { style, ..self.curve }, ..self }
    }

    /// Returns the pieces of the curve between jumps, for a plot of the times `view` on this number of pixel columns.
    fn curves(
        &self,
        studio: &Studio,
        body: usize,
        view: [f64; 2],
        columns: f32,
    ) -> impl Iterator<Item = Curve> {
        let starts = [0].iter().chain(&self.jumps);
        let ends = self.jumps.iter().copied().chain([self.curve.points.len()]);
        let pieces = starts.zip(ends).map(|(&start, end)| start..end);
        let pieces = pieces.filter(|piece| !piece.is_empty());
        pieces.map(move |piece| self.piece(piece, (studio, body), view, columns))
    }

    /// Returns a piece of the curve that has no jump. Every column gets a point if there are more columns than samples
    /// and the solution is known between the samples.
    fn piece(
        &self,
        piece: Range<usize>,
        (studio, body): (&Studio, usize),
        [from, to]: [f64; 2],
        columns: f32,
    ) -> Curve {
        let times = &self.times[piece.clone()];
        let first = times.partition_point(|&t| t < from);
        let end = times.partition_point(|&t| t <= to);
        let in_view = (end - first) as f32;
        let Some(quantity) = self.known.filter(|_| in_view <= columns) else {
            let swept = self.curve.swept.get(piece.clone()).unwrap_or_default().to_vec();
            return Curve { points: self.curve.points[piece].to_vec(), swept, ..self.curve };
        };
        let wide = (to - from) / f64::from(columns.max(1.0));
        let (first, end) = (first.saturating_sub(1), (end + 1).min(times.len()));
        let samples =
            samples(studio, body).filter(|sample| finite_point(quantity, sample).is_some());
        let samples: Vec<_> = samples.skip(piece.start + first).take(end - first).collect();
        let truth = &studio.race().truth().bodies()[body];
        let points = TruthCurve::finer(truth, quantity, &samples, wide);
        Curve { points, swept: Vec::new(), ..self.curve }
    }

    /// Returns the values that the axis must include, with those between the samples. They start at the last placement
    /// of a body or change of a parameter. While the motion since then has only begun, they include all earlier values.
    pub(super) fn fitted(&self, studio: &Studio, axis: usize) -> impl Iterator<Item = f64> + Clone {
        let since_s = studio.past().swing_since_s(studio.race().t());
        let later = self.times.partition_point(|&t| t < since_s);
        let put = self.jumps.iter().rfind(|&&jump| self.times[jump] == since_s);
        let first = put.copied().unwrap_or(later);
        let swept = self.curve.swept.iter().skip(first).flatten().filter(move |_| axis == 1);
        let points = self.curve.points[first..].iter();
        points.map(move |point| point[axis]).chain(swept.copied())
    }

    pub(super) fn values(&self, axis: usize) -> impl Iterator<Item = f64> + Clone {
        self.curve.points.iter().map(move |point| point[axis])
    }

    /// Returns the place at time `t` (s). It lies on the line between two points, unless the truth of `body` is known
    /// between them.
    pub(super) fn at(&self, (studio, body): (&Studio, usize), t: f64) -> Option<[f64; 2]> {
        let after = self.times.partition_point(|&time| time <= t);
        let before = after.checked_sub(1)?;
        let (from_s, from) = (self.times[before], self.curve.points[before]);
        if from_s == t {
            return Some(from);
        }
        let (&to_s, to) = self.times.get(after).zip(self.curve.points.get(after))?;
        if let Some(quantity) = self.known.filter(|_| to_s > from_s) {
            let mut ends =
                samples(studio, body).filter(|sample| finite_point(quantity, sample).is_some());
            let (from, to) = ends.nth(before).zip(ends.next())?;
            let truth = &studio.race().truth().bodies()[body];
            return Some([t, TruthCurve::between(truth, quantity, [&from, &to], t)]);
        }
        let part = if to_s > from_s { (t - from_s) / (to_s - from_s) } else { 1.0 };
        Some([0, 1].map(|axis| from[axis] + part * (to[axis] - from[axis])))
    }
}

/// Returns the recent samples of the exact solution of a body, up to now.
fn samples(studio: &Studio, body: usize) -> impl Iterator<Item = TruthSample> {
    let (curve, t) = (&studio.past().truth_curves()[body], studio.race().t());
    let truth = &studio.race().truth().bodies()[body];
    let goes_on = truth.halted().is_none() && curve.samples().next_back().is_some_and(|s| s.t < t);
    let present = goes_on.then(|| curve.present(truth, t));
    curve.since(studio.deck.drawn_from_s()).copied().chain(present)
}

/// Returns a quantity at a sample as a point over time, or `None` if the quantity is not finite.
fn finite_point(quantity: Quantity, sample: &TruthSample) -> Option<[f64; 2]> {
    let at = [sample.t, quantity.value([sample.q, sample.v])];
    at.iter().all(|x| x.is_finite()).then_some(at)
}

impl PlotModel {
    /// Creates an empty plot of a body.
    pub(super) fn new(
        body: usize,
        id: String,
        title: String,
        axes: [PlotAxis; 2],
        fit: Bounds,
    ) -> Self {
        let (tracks, exact, beside) = (Vec::new(), Vec::new(), Vec::new());
        let (dots, before, nothing) = (Dots::None, None, None);
        let [is_of_ticks, is_round] = [false; 2];
        Self {
            id,
            title,
            body,
            axes,
            fit,
            tracks,
            dots,
            exact,
            beside,
            before,
            is_of_ticks,
            is_round,
            nothing,
        }
    }

    /// Whether the horizontal axis is time.
    pub(super) fn is_over_time(&self) -> bool {
        self.axes[0].is_time
    }

    /// Returns the names of the axes, which are unique in the scene. All plots over the same time share its name, and
    /// so its range.
    pub(super) fn axis_names(&self) -> [String; 2] {
        let along = if self.is_over_time() { &self.axes[0].quantity } else { &self.id };
        [format!("{along}, along"), format!("{}, up", self.id)]
    }

    /// Returns the bounds in view, with the ranges that the user has chosen.
    pub(super) fn in_view(&self, ranges: &BTreeMap<String, [f64; 2]>) -> Bounds {
        let names = self.axis_names();
        [0, 1].map(|axis| ranges.get(&names[axis]).copied().unwrap_or(self.fit[axis]))
    }

    /// Returns the contents of the plot on this number of pixel columns, with `bounds` in view.
    pub(super) fn drawing(
        &self,
        studio: &Studio,
        styles: &SeriesStyles,
        bounds: &Bounds,
        columns: f32,
    ) -> Drawing {
        let healthy = [0, 1].map(|axis| {
            let ([low, high], [least, most]) = (bounds[axis], self.fit[axis]);
            [low.min(least), high.max(most)]
        });
        let style = TrackStyle { dots: self.dots, is_over_time: self.is_over_time() };
        let mut drawing = tracks::drawing(styles, &self.tracks, &healthy, style);
        if let Some(BeforeLine { track, colour, .. }) = &self.before {
            let places = track.places().map(|(_, _, at)| at).collect();
            drawing.curves.insert(0, Curve::new(LineStyle::solid(*colour, BEFORE), places));
        }
        if !style.is_over_time {
            drawing.switch_mark = SwitchMark::Ring;
        }
        let curves = |line| ExactLine::curves(line, studio, self.body, bounds[0], columns);
        drawing.truth = self.exact.iter().flat_map(curves).collect();
        drawing.truth.extend(self.beside.iter().cloned());
        if self.is_over_time() {
            let left = drawing.truth.iter().filter_map(|curve| departure(curve, bounds));
            drawing.arrows.extend(left.collect::<Vec<_>>());
        }
        drawing
    }

    /// Returns the values of all curves at time `t` (s).
    pub(super) fn readouts(&self, studio: &Studio, styles: &SeriesStyles, t: f64) -> Vec<Readout> {
        let lanes = self.tracks.iter().filter_map(|track| {
            let (entry, at) = track.at(t)?;
            let key = if styles.is_race { styles.number(entry).to_string() } else { String::new() };
            let (colour, name) = (styles.series[entry].colour, joined(&key, track.part));
            Some(Readout { entry: Some(entry), colour, is_front: track.is_front, name, at })
        });
        let exact = self.exact.iter().filter_map(|line| {
            let (at, name) = (line.at((studio, self.body), t)?, joined("", line.part));
            Some(Readout { entry: None, colour: styles.exact_colour, is_front: true, name, at })
        });
        let before = self.before.iter().filter_map(|line| {
            let (_, at) = line.track.at(t)?;
            let (colour, name) = (line.colour, "before".to_owned());
            Some(Readout { entry: None, colour, is_front: true, name, at })
        });
        lanes.chain(exact).chain(before).collect()
    }
}

/// Returns the point where a curve first leaves the view upwards or downwards. If the curve is nowhere in view, returns
/// its end.
fn departure(curve: &Curve, bounds: &Bounds) -> Option<Arrow> {
    let is_in_view = |axis: usize, at: &[f64; 2]| {
        let [low, high] = bounds[axis];
        (low..=high).contains(&at[axis])
    };
    let mut at_hand = curve.points.iter().filter(|at| is_in_view(0, at));
    let mut from = at_hand.next()?;
    let left = at_hand.find(|to| {
        let leaves = is_in_view(1, from) && !is_in_view(1, to);
        from = if leaves { from } else { to };
        leaves
    });
    let to = left.or((!is_in_view(1, from)).then_some(from))?;
    Some(Arrow { from: *from, to: *to, colour: curve.style.colour })
}

fn joined(key: &str, part: &str) -> String {
    format!("{key} {part}").trim().to_owned()
}

impl PlotSet {
    /// Returns the styles of the visible curves, with the index of each.
    pub(super) fn visible_styles(&self) -> impl Iterator<Item = (usize, &SeriesStyle)> {
        let tracks = self.plots.iter().flat_map(|plot| &plot.tracks);
        let mut shown: Vec<usize> =
            tracks.flat_map(|track| track.methods().chain([track.entry])).collect();
        shown.sort_unstable();
        shown.dedup();
        shown.into_iter().map(|entry| (entry, &self.styles.series[entry]))
    }
}

/// Returns the bounds of a plot that shows the time in view and this range of values.
pub(super) fn over_time(studio: &Studio, (low, high): (f64, f64)) -> Bounds {
    let [from, to] = time_in_view(studio.scene().seconds, studio.race().t());
    // The time includes the next second if the plot shows futures.
    let to = if shows_futures(studio) { to.max(studio.race().t() + 1.0) } else { to };
    [[from, to], [low, high]]
}

/// Returns a zero for axes to include while a run is in its first view. Without this zero, the small motion of a body
/// that has hardly moved would fill the plot.
pub(super) fn origin(studio: &Studio) -> Option<f64> {
    let [_, to_s] = time_in_view(studio.scene().seconds, 0.0);
    (studio.race().t() <= to_s).then_some(0.0)
}

/// Returns the time in view for a run of this length, in seconds. The view first covers a quarter of the length, then
/// half of it, then all of it. After that it covers the last full length.
pub(super) fn time_in_view(length_s: f64, now_s: f64) -> [f64; 2] {
    let windows = [0.25, 0.5, 1.0].map(|part| part * length_s);
    let to = windows.into_iter().find(|&to| now_s <= to).unwrap_or(now_s);
    [(to - length_s).max(0.0), to]
}
