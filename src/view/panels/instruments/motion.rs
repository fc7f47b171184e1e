//! A quantity of every body over time, under all lanes and exactly.

use super::super::ranges;
use super::super::series_styles::SeriesStyles;
use super::super::tracks::{Detail, Track};
use super::error::capitalised;
use super::plot_set::{ExactLine, PlotAxis, PlotModel, PlotSet, over_time};
use crate::lab::{Mode, Studio};
use crate::view::chart::Dots;

/// A lane this many times further out than the truth no longer stretches the axes; and where it is alone,
/// squeezes nothing but the truth, and is looked at for how it grows.
const HEALTHY: f64 = 1.6;
const HEALTHY_ALONE: f64 = 4.0;

pub(super) fn plot_set(lab: &Studio, detail: Detail) -> PlotSet {
    let bodies = 0..lab.scene().bodies.len();
    let title = if bodies.len() > 1 { "Motion of every body" } else { "Motion" };
    PlotSet {
        styles: SeriesStyles::of(lab),
        title: title.into(),
        plots: bodies.map(|body| plot(lab, body, detail)).collect(),
    }
}

fn plot(lab: &Studio, body: usize, detail: Detail) -> PlotModel {
    let truth = &lab.race().truth().bodies()[body];
    let (coordinate, _) = lab.past().coordinate(lab.race(), body);
    let quantity = lab.display().quantity;
    let tracks = Track::of_quantity(lab, body, quantity, detail);
    let exact = ExactLine::of_quantity(lab, body, quantity);
    let lanes = Track::fitted(lab, &tracks);
    // Where the truth has ended, what the selected lane does is looked at.
    let selected = lanes
        .iter()
        .filter(|lane| lane.is_front && truth.halted().is_some())
        .flat_map(|lane| lane.along(1));
    let y = ranges::around_truth(exact.fitted(lab, 1).chain(selected), &lanes, 1, healthy(lab));
    let name = capitalised(&lab.scene().bodies[body].name);
    let title = match truth.halted() {
        Some(_) => format!("{name}, {}", truth.truth().missing()),
        None => name,
    };
    let id = format!("{} of {body}", quantity.symbol(&coordinate));
    let axes = [PlotAxis::time("time t"), PlotAxis::of_quantity(quantity, &coordinate)];
    let plot = PlotModel::new(body, id, title, axes, over_time(lab, y));
    PlotModel { tracks, dots: Dots::SparseAlongX, exact: vec![exact], ..plot }
}

/// How many times further out than the truth a lane still stretches the axes.
pub(super) fn healthy(lab: &Studio) -> f64 {
    match lab.mode() {
        Mode::Solo => HEALTHY_ALONE,
        Mode::Race => HEALTHY,
    }
}
