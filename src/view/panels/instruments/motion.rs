//! A quantity of every body over time, under all lanes and exactly.

use super::super::ranges;
use super::super::series_styles::SeriesStyles;
use super::super::tracks::{Detail, Track};
use super::error::capitalised;
use super::plot_set::{ExactLine, PlotAxis, PlotModel, PlotSet, over_time};
use crate::lab::Studio;
use crate::lab::race::Mode;
use crate::view::chart::Dots;

/// A lane this many times further out than the truth no longer stretches the axes; and where it is alone,
/// squeezes nothing but the truth, and is looked at for how it grows.
const HEALTHY: f64 = 1.6;
const HEALTHY_ALONE: f64 = 4.0;

pub(super) fn plot_set(studio: &Studio, detail: Detail) -> PlotSet {
    let bodies = 0..studio.scene().bodies.len();
    let title = if bodies.len() > 1 { "Motion of every body" } else { "Motion" };
    PlotSet {
        styles: SeriesStyles::of(studio),
        title: title.into(),
        plots: bodies.map(|body| plot(studio, body, detail)).collect(),
    }
}

fn plot(studio: &Studio, body: usize, detail: Detail) -> PlotModel {
    let truth = &studio.race().truth().bodies()[body];
    let (coordinate, _) = studio.past().coordinate(studio.race(), body);
    let quantity = studio.display().quantity;
    let tracks = Track::of_quantity(studio, body, quantity, detail);
    let exact = ExactLine::of_quantity(studio, body, quantity);
    let lanes = Track::fitted(studio, &tracks);
    // Where the truth has ended, what the selected lane does is looked at.
    let selected = lanes
        .iter()
        .filter(|lane| lane.is_front && truth.halted().is_some())
        .flat_map(|lane| lane.along(1));
    let y =
        ranges::around_truth(exact.fitted(studio, 1).chain(selected), &lanes, 1, healthy(studio));
    let name = capitalised(&studio.scene().bodies[body].name);
    let title = match truth.halted() {
        Some(_) => format!("{name}, {}", truth.truth().missing()),
        None => name,
    };
    let id = format!("{} of {body}", quantity.symbol(&coordinate));
    let axes = [PlotAxis::time("time t"), PlotAxis::of_quantity(quantity, &coordinate)];
    let plot = PlotModel::new(body, id, title, axes, over_time(studio, y));
    PlotModel { tracks, dots: Dots::SparseAlongX, exact: vec![exact], ..plot }
}

/// How many times further out than the truth a lane still stretches the axes.
pub(super) fn healthy(studio: &Studio) -> f64 {
    match studio.mode() {
        Mode::Solo => HEALTHY_ALONE,
        Mode::Race => HEALTHY,
    }
}
