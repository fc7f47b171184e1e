//! Velocity over coordinate, for the last turns of each lane and of the exact solution.

use super::super::ranges;
use super::super::series_styles::SeriesStyles;
use super::super::tracks::Track;
use super::motion::{HEALTHY, extend_by_held_body, name_of_plotted};
use super::plot_set::{ExactLine, PlotAxis, PlotModel, PlotSet, origin};
use crate::chart::Dots;
use crate::studio::Studio;

/// Number of samples in a phase portrait. They make only a few turns, so that the turns can be distinguished.
pub(super) const SAMPLES: usize = 360;

pub(super) fn plot_set(studio: &Studio) -> PlotSet {
    let body = studio.view().body;
    let mut tracks = Track::of(studio, body, |s| [s.q, s.v]);
    tracks.iter_mut().for_each(|lane| lane.keep_latest(SAMPLES));
    extend_by_held_body(studio, body, &mut tracks, |_, place| place);
    // The exact solution covers the same time as the lanes that still move.
    let newest = tracks.iter().filter_map(Track::times).max_by(|a, b| a.1.total_cmp(&b.1));
    let since_s = newest.map_or(f64::NEG_INFINITY, |(first, _)| first);
    let exact = ExactLine::of(studio, body, |s| (s.t >= since_s).then_some([s.q, s.v]));
    let fitted = Track::fitted(studio, &tracks);
    let [x, y] = [0, 1].map(|axis| {
        let front = Track::front_since(&fitted, axis, f64::NEG_INFINITY);
        let seen = front.chain(exact.fitted(studio, axis)).chain(origin(studio));
        ranges::around_orbit(seen, &fitted, axis, HEALTHY)
    });
    let (coordinate, _) = studio.past().coordinate(studio.race(), body);
    let id = format!("phase portrait of {} of {body}", coordinate.name);
    let title = name_of_plotted(studio, body, &coordinate);
    let axes = PlotAxis::of_phase(&coordinate);
    let plot = PlotModel::new(body, id, title, axes, [x.into(), y.into()]);
    let plot = PlotModel { tracks, dots: Dots::Sparse, exact: vec![exact], ..plot };
    PlotSet { styles: SeriesStyles::of(studio), title: "Phase portrait".into(), plots: vec![plot] }
}
