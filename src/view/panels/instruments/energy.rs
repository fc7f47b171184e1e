//! Energies of the selected lane and of the exact solution, and the energy that each lane has gained.

use super::super::ranges;
use super::super::series_styles::SeriesStyles;
use super::super::tracks::Track;
use super::error;
use super::motion::HEALTHY;
use super::plot_set::{ExactLine, PlotAxis, PlotModel, PlotSet, over_time, time_in_view};
use crate::chart::AxisScale;
use crate::run::Metric;
use crate::run::past::Energies;
use crate::studio::Studio;

/// An energy in the plot: its name, its dash, its opacity, and its formula.
type Part = (&'static str, [f32; 2], f32, fn(Energies) -> f64);

/// Energies in the plot. The total comes after the terms of its sum.
const PARTS: [Part; 3] = [
    ("potential", [2.0, 3.0], 0.5, Energies::potential_j),
    ("kinetic", [8.0, 4.0], 0.5, |energies| energies.kinetic_j),
    ("total", [1.0, 0.0], 1.0, |energies| energies.total_j),
];

pub(super) fn plot_set(studio: &Studio) -> PlotSet {
    let body = studio.view().body;
    let title = "share of the swing's energy";
    let drift = error::plot(studio, body, Metric::ENERGY_DRIFT, title.into());
    let energies = energies(studio, body);
    let conserves = !energies.exact.iter().all(|line| line.times.is_empty());
    // The plot of the drift gives a reason for a missing drift only if there is no plot of energies either.
    let drift = Some(drift).filter(|plot| plot.nothing.is_none() || !conserves);
    let plots = conserves.then_some(energies).into_iter().chain(drift).collect();
    PlotSet { styles: SeriesStyles::of(studio), title: "Energy".into(), plots }
}

fn energies(studio: &Studio, body: usize) -> PlotModel {
    let energy = |(part, dash, strength, of): Part| {
        let tracks = Track::of(studio, body, |s| [s.t, s.energies.map_or(f64::NAN, of)]);
        tracks
            .into_iter()
            .filter(|track| track.is_front)
            .map(move |t| t.into_part(part, dash, strength))
    };
    let exact = PARTS.map(|(part, dash, strength, of)| {
        ExactLine::of(studio, body, |s| Some([s.t, of(s.energies?)]))
            .into_part(part, dash, strength)
    });
    let tracks: Vec<Track> = PARTS.into_iter().flat_map(energy).collect();
    let [from_s, _] = time_in_view(studio.scene().seconds, studio.race().t());
    let lanes = Track::fitted(studio, &tracks);
    let exact_range = exact.iter().flat_map(|line| line.fitted(studio, 1));
    let seen = Track::front_since(&lanes, 1, from_s).chain(exact_range);
    let y = ranges::around_truth(seen, &lanes, 1, HEALTHY);
    let (id, title) = (format!("energies of {body}"), "kinetic dashed, potential dotted".into());
    let axes = [PlotAxis::time("time t"), PlotAxis::new("energy", "J", AxisScale::Linear)];
    let plot = PlotModel::new(body, id, title, axes, over_time(studio, y));
    PlotModel { tracks, exact: exact.into(), is_of_ticks: true, ..plot }
}
