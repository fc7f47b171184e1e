//! The selected metric of the displayed body over time, which is an error or a count.

use super::super::ranges;
use super::super::series_styles::SeriesStyles;
use super::super::tracks::Track;
use super::plot_set::{BeforeLine, PlotAxis, PlotModel, PlotSet, over_time};
use crate::chart::{AxisScale, Dots};
use crate::run::{METRICS, Metric, Scale, Unit};
use crate::studio::Studio;

/// Message if every error is zero, because zero has no logarithm.
pub(super) const NO_ERROR: &str =
    "No error: every method shown is on the exact curve to the last bit.";

/// Message at the start of a run.
pub(super) const NOTHING_YET: &str = "Nothing has run yet.";

/// Returns the indices in [`METRICS`] of the metrics to choose from. They are all those that the energy instrument does
/// not show.
pub(super) fn choices() -> impl Iterator<Item = usize> {
    (0..METRICS.len()).filter(|&place| !METRICS[place].is_of_energy)
}

pub(super) fn plot_set(studio: &Studio) -> PlotSet {
    let (body, place) = (studio.view().body, studio.display().metric);
    let metric = &METRICS[place];
    let name = capitalised(&studio.scene().bodies[body].name);
    PlotSet {
        styles: SeriesStyles::of(studio),
        title: capitalised(metric.name),
        plots: vec![plot(studio, body, place, name)],
    }
}

/// Returns the plot of a metric of a body.
pub(super) fn plot(studio: &Studio, body: usize, place: usize, title: String) -> PlotModel {
    let metric = &METRICS[place];
    let truth = &studio.race().truth().bodies()[body];
    let unit = metric.unit.on(&truth.coordinates().at(0));
    let values = Track::of(studio, body, |s| [s.t, s.metrics[place]]);
    let scale = scale(metric, &values);
    let tracks = Track::of(studio, body, |s| [s.t, scale.place(s.metrics[place])]);
    let before = BeforeLine::of(studio, body, |s| [s.t, scale.place(s.metrics[place])]);
    let mut fitted = Track::fitted(studio, &tracks).into_owned();
    fitted.extend(before.iter().map(|before| before.track.clone()));
    let y = match (metric.scale, metric.unit) {
        (Scale::Log, _) => {
            let truth = studio.past().truth_curves()[body].samples();
            let size = truth.map(|s| s.q.abs().max(s.v.abs()));
            ranges::of_decades(&fitted, size.fold(0.0, f64::max))
        }
        (Scale::Linear, _) if matches!(scale, AxisScale::SymLog(_)) => {
            ranges::of_drift(&fitted, scale)
        }
        (Scale::Linear, Unit::Percent) => ranges::of_shares(&fitted),
        (Scale::Linear, _) => ranges::from_zero(&fitted),
    };
    let is_empty = tracks.iter().all(Track::is_empty);
    let has_values = values.iter().any(|track| !track.is_empty());
    let nothing = match has_values {
        true if studio.race().tick() == 0 => NOTHING_YET,
        true => NO_ERROR,
        false => metric.absent_on(truth),
    };
    let nothing = (is_empty && before.is_none()).then(|| nothing.to_owned());
    let axes = [PlotAxis::time("time t"), PlotAxis::new(metric.name, &unit, scale)];
    let id = format!("{} of {body}", metric.id);
    let plot = PlotModel::new(body, id, title, axes, over_time(studio, y));
    PlotModel { tracks, dots: Dots::SparseAlongX, nothing, before, is_of_ticks: true, ..plot }
}

fn scale(metric: &Metric, values: &[Track]) -> AxisScale {
    match metric.scale {
        Scale::Log => AxisScale::Log,
        Scale::Linear if metric.is_of_energy => AxisScale::SymLog(ranges::linear_drift(values)),
        Scale::Linear => AxisScale::Linear,
    }
}

/// Capitalises a name for the start of a sentence.
pub(super) fn capitalised(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}
