//! Layout of an instrument's plots and of the texts around them.

use std::collections::BTreeMap;

use egui::{Rect, pos2};

use super::plot_set::{PlotModel, PlotSet};
use crate::chart::{ABOVE, AxisMark, NAMES, NUMBERS, PlotArea};
use crate::panels::breakpoints;

/// Minimum distance between marks, horizontally and vertically, in points. If fewer than three marks would fit, they
/// move closer.
const MARKS_APART: [f64; 2] = [80.0, 34.0];
/// Width at the right for values, and width for values with names, in points.
const RIGHT: f32 = 92.0;
const RIGHT_OF_PARTS: f32 = 156.0;
/// Gap between two plots, in points.
const GAP: f32 = 5.0;
/// Minimum height of a plot, and the height to which plots shrink if all of them fit then, in points. Otherwise only
/// some plots appear.
const MIN_HEIGHT: f32 = 70.0;
const SHRUNK: f32 = 44.0;
/// Height of the displayed body's plot, relative to the other plots.
const CHOSEN: f32 = 2.0;

/// A plot at its place in the instrument.
pub(super) struct Cell<'s> {
    pub(super) plot: &'s PlotModel,
    /// Rectangle in which the curves are drawn.
    pub(super) frame: Rect,
    /// Left edge of the numbers beside the plot.
    pub(super) left: f32,
    /// Right edge of the values beside the plot, or right edge of `frame` if there is no room for values.
    pub(super) right: f32,
    /// Whether no plot directly below shares the horizontal axis.
    pub(super) is_lowest: bool,
}

impl Cell<'_> {
    /// Returns the plot's area, with the ranges that the user has chosen.
    pub(super) fn area(&self, ranges: &BTreeMap<String, [f64; 2]>) -> PlotArea {
        let mut bounds = self.plot.in_view(ranges);
        if self.plot.is_round {
            let sides = [self.frame.width(), self.frame.height()].map(f64::from);
            let scales = [0, 1].map(|axis| (bounds[axis][1] - bounds[axis][0]) / sides[axis]);
            let scale = scales[0].max(scales[1]);
            for ([low, high], side) in bounds.iter_mut().zip(sides) {
                let middle = (*low + *high) / 2.0;
                (*low, *high) = (middle - scale * side / 2.0, middle + scale * side / 2.0);
            }
        }
        PlotArea { rect: self.frame, bounds }
    }

    pub(super) fn marks(&self, area: &PlotArea, axis: usize) -> Vec<AxisMark> {
        area.marks(axis, self.plot.axes[axis].scale, MARKS_APART[axis])
    }
}

/// Returns the number of plots that fit into a height, and their minimum height.
fn fitting_plots(plots: usize, height: f32) -> (usize, f32) {
    let height = (height - NUMBERS - NAMES).max(1.0);
    let of_least = |least: f32| ((height + GAP) / (ABOVE + least + GAP)).floor().max(1.0) as usize;
    let least = [MIN_HEIGHT, SHRUNK].into_iter().find(|least| of_least(*least) >= plots);
    let least = least.unwrap_or(MIN_HEIGHT);
    (plots.min(of_least(least)), least)
}

/// Whether all plots fit into a height.
pub(super) fn all_fit(plots: usize, height: f32) -> bool {
    fitting_plots(plots, height).0 == plots
}

/// Returns the plots that fit into `room`, which include the plot of `body`. The numbers of the vertical axes have
/// `left` points.
pub(super) fn cells(set: &PlotSet, room: Rect, left: f32, body: usize) -> Vec<Cell<'_>> {
    let below = NUMBERS + NAMES;
    // A plot has its own numbers if its horizontal axis differs from that of the plot below.
    let is_last_of_axis = |plots: &[PlotModel], i: usize| {
        let below = plots.get(i + 1).map(PlotModel::is_over_time);
        below != Some(plots[i].is_over_time())
    };
    let axes = (0..set.plots.len()).filter(|&i| is_last_of_axis(&set.plots, i)).count().max(1);
    let room_of_one_axis = room.height() - (axes - 1) as f32 * below;
    let height = (room_of_one_axis - below).max(1.0);
    let (count, least) = fitting_plots(set.plots.len(), room_of_one_axis);
    let chosen = set.plots.iter().position(|plot| plot.body == body).unwrap_or(0);
    let first = chosen.min(set.plots.len() - count);
    let shown = &set.plots[first..first + count];
    let weight = |plot: &PlotModel| if plot.body == body { CHOSEN } else { 1.0 };
    let weights: f32 = shown.iter().map(weight).sum();
    let spare = height - count as f32 * (ABOVE + least) - (count - 1) as f32 * GAP;
    let has_parts = shown.iter().any(|plot| plot.tracks.iter().any(|track| !track.part.is_empty()));
    let for_values = if has_parts { RIGHT_OF_PARTS } else { RIGHT };
    let has_values = room.width() - left - for_values >= breakpoints::PLOT_BESIDE_VALUES;
    let beside = if has_values { for_values } else { 10.0 };
    let mut top = room.top();
    let cell = |(i, plot): (usize, &'_ PlotModel)| {
        let tall = (least + spare * weight(plot) / weights).max(1.0);
        let frame = Rect::from_min_max(
            pos2(room.left() + left, top + ABOVE),
            pos2((room.right() - beside).max(room.left() + left + 1.0), top + ABOVE + tall),
        );
        top = frame.bottom() + GAP + if is_last_of_axis(shown, i) { below } else { 0.0 };
        let right = if has_values { room.right() } else { frame.right() };
        (i, frame, right)
    };
    let placed: Vec<_> = shown.iter().enumerate().map(cell).collect();
    let cells = placed.into_iter().zip(shown).map(|((i, frame, right), plot)| Cell {
        plot,
        frame,
        left: room.left(),
        right,
        is_lowest: is_last_of_axis(shown, i),
    });
    cells.collect()
}
