//! A quantity of every body over time, for all lanes and for the exact solution.

use super::super::ranges;
use super::super::series_styles::SeriesStyles;
use super::super::tracks::{Detail, Track};
use super::error::capitalised;
use super::plot_set::{
    BeforeLine, EXACT, ExactLine, PlotAxis, PlotModel, PlotSet, origin, over_time, time_in_view,
};
use crate::chart::{Curve, Dots, LineStyle};
use crate::look::{Framing, Look};
use crate::measure::FutureCurve;
use crate::run::past::Quantity;
use crate::stage::Coordinate;
use crate::studio::{Studio, futures, shows_futures};
use crate::theme::palette_of;

/// A lane does not extend an axis where it is further out than the truth and the selected lane by more than this
/// factor.
pub(super) const HEALTHY: f64 = 1.6;

/// The width of the curve of a future, in points.
const FUTURE: f32 = 1.8;

pub(super) fn plot_set(studio: &Studio, detail: Detail) -> PlotSet {
    let bodies = 0..studio.scene().bodies.len();
    PlotSet {
        styles: SeriesStyles::of(studio),
        title: "Motion".into(),
        plots: bodies
            .flat_map(|body| track(studio, body).into_iter().chain([plot(studio, body, detail)]))
            .collect(),
    }
}

/// Returns the track of a body that is steered across a plane, because the track shows more than coordinates over time.
fn track(studio: &Studio, body: usize) -> Option<PlotModel> {
    let truth = &studio.race().truth().bodies()[body];
    let is_steered = matches!(Look::of(truth).framing(), Framing::Follow { .. });
    if !is_steered || truth.coordinates().len() < 2 {
        return None;
    }
    let mut tracks = Track::of(studio, body, |sample| sample.at.into());
    let held = studio.deck.held().filter(|held| held.body == body);
    for (track, held) in tracks.iter_mut().filter(|track| track.is_front).zip(held) {
        track.add_jump(studio.race().t(), [held.q[0], held.q[1]]);
    }
    let exact = ExactLine::of(studio, body, |sample| Some(sample.at.into()));
    let lanes = Track::fitted(studio, &tracks);
    let range = |axis: usize| {
        let front = Track::front_since(&lanes, axis, f64::NEG_INFINITY);
        let seen = front.chain(exact.fitted(studio, axis)).chain(origin(studio));
        ranges::around_truth(seen, &lanes, axis, HEALTHY)
    };
    let fit = [range(0).into(), range(1).into()];
    let axes = [0, 1].map(|axis| PlotAxis::of(&truth.coordinates().at(axis)));
    let title = format!("{}, track", capitalised(&studio.scene().bodies[body].name));
    let plot = PlotModel::new(body, format!("track of {body}"), title, axes, fit);
    Some(PlotModel { tracks, dots: Dots::Sparse, exact: vec![exact], ..plot })
}

fn plot(studio: &Studio, body: usize, detail: Detail) -> PlotModel {
    let truth = &studio.race().truth().bodies()[body];
    let (coordinate, _) = studio.past().coordinate(studio.race(), body);
    let quantity = studio.display().quantity.unwrap_or_else(|| Quantity::usual(truth));
    let mut tracks = Track::of_quantity(studio, body, quantity, detail);
    extend_by_held_body(studio, body, &mut tracks, |t, [q, v]| [t, quantity.value([q, v])]);
    let exact = ExactLine::of_quantity(studio, body, quantity);
    let lanes = Track::fitted(studio, &tracks);
    // The view also follows the selected lane. Beside a lane that has grown, the truth may be a flat line.
    let [from_s, _] = time_in_view(studio.scene().seconds, studio.race().t());
    let seen = Track::front_since(&lanes, 1, from_s).chain(exact.fitted(studio, 1));
    let futures = future_curves(studio, body, quantity);
    let exact_future = futures.last().into_iter().flat_map(|curve| &curve.points);
    let before = BeforeLine::of(studio, body, |s| [s.t, quantity.value([s.q, s.v])]);
    let seen = seen.chain(before.iter().flat_map(|before| before.track.along(1)));
    let seen = seen.chain(origin(studio)).chain(exact_future.map(|at| at[1]));
    let y = ranges::around_truth(seen, &lanes, 1, HEALTHY);
    let y = ranges::with_room(y, futures.iter().flat_map(|curve| &curve.points), ROOM_FOR_FUTURES);
    let name = name_of_plotted(studio, body, &coordinate);
    let title = match truth.halted() {
        Some(_) => format!("{name}, {}", truth.truth().missing()),
        None => name,
    };
    let id = format!("{} of {body}", quantity.symbol(&coordinate));
    let axes = [PlotAxis::time("time t"), PlotAxis::of_quantity(quantity, &coordinate)];
    let plot = PlotModel::new(body, id, title, axes, over_time(studio, y));
    PlotModel {
        tracks,
        dots: Dots::SparseAlongX,
        exact: vec![exact],
        beside: futures,
        before,
        ..plot
    }
}

/// Maximum enlargement of a plot to show futures.
const ROOM_FOR_FUTURES: f64 = 4.0;

/// Returns the next second of a body under each method and in truth, or nothing if the display does not show it.
fn future_curves(studio: &Studio, body: usize, quantity: Quantity) -> Vec<Curve> {
    if !shows_futures(studio) {
        return Vec::new();
    }
    let palette = palette_of(studio.display().theme);
    let curve = |future: FutureCurve| {
        let style = match future.entry {
            Some(entry) => {
                let (colour, _) = palette.style(studio.entries(), &studio.entries()[entry]);
                LineStyle { dots: Dots::SparseAlongX, ..LineStyle::solid(colour, FUTURE) }
            }
            None => LineStyle::solid(palette.exact, EXACT),
        };
        let points = future.moments.iter().map(|moment| [moment.t, quantity.value(moment.state)]);
        Curve::new(style, points.collect())
    };
    futures(&studio.deck, body).into_iter().map(curve).collect()
}

/// Returns the name of a body. The name of a net includes the node that the plot shows.
pub(super) fn name_of_plotted(studio: &Studio, body: usize, coordinate: &Coordinate) -> String {
    let plotted = &studio.scene().bodies[body];
    let name = capitalised(&plotted.name);
    let node = plotted.kind.node(&coordinate.name);
    node.map_or(name.clone(), |(_, node)| format!("{name}, node {node}"))
}

/// Extends the selected lane to the place where a body in the user's hand would be released. The stage does the same.
pub(super) fn extend_by_held_body(
    studio: &Studio,
    body: usize,
    tracks: &mut [Track],
    place: impl Fn(f64, [f64; 2]) -> [f64; 2],
) {
    let Some(held) = studio.deck.held().filter(|held| held.body == body) else { return };
    let (_, plotted) = studio.past().coordinate(studio.race(), body);
    let (q, v) = (held.q[plotted], held.v[plotted]);
    let front = tracks.iter_mut().filter(|track| track.is_front);
    front.for_each(|track| track.add_jump(studio.race().t(), place(studio.race().t(), [q, v])));
}
