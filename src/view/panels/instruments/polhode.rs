//! The polhode of the true body, and the trail of each lane on the sphere of L/|L|.

use super::super::series_styles::SeriesStyles;
use super::super::tracks::Track;
use super::error::capitalised;
use super::phase::SAMPLES;
use super::plot_set::{ExactLine, PlotAxis, PlotModel, PlotSet};
use crate::chart::{AxisScale, Curve, Dots, LineStyle};
use crate::look::Polhode;
use crate::run::{METRICS, Metric};
use crate::studio::Studio;
use crate::theme::palette_of;

/// Width of the separatrix and of the rim, in points.
const THIN: f32 = 1.0;
/// Half the range in view, in which the sphere has the radius 1.
const HALF: f64 = 1.1;

pub(super) fn plot_set(studio: &Studio) -> PlotSet {
    let body = studio.view().body;
    let truth = &studio.race().truth().bodies()[body];
    let polhode = Polhode::of(truth);
    let axes = polhode.as_ref().map_or(["x", "y", "z"], |polhode| polhode.axes);
    let axis = |name| PlotAxis::new(&format!("L{name} / |L|"), "", AxisScale::Linear);
    let name = capitalised(&studio.scene().bodies[body].name);
    let title = format!("{name}, along its {}", axes[1]);
    let (id, names) = (format!("polhode of {body}"), [axis(axes[0]), axis(axes[2])]);
    let plot = PlotModel::new(body, id, title, names, [[-HALF, HALF]; 2]);
    let why = METRICS[Metric::ATTITUDE_ERROR].absent;
    let plot = match polhode {
        Some(polhode) => filled(studio, plot, polhode),
        None => PlotModel { nothing: Some(why.into()), ..plot },
    };
    PlotSet { styles: SeriesStyles::of(studio), title: "Polhode".into(), plots: vec![plot] }
}

fn filled(studio: &Studio, plot: PlotModel, polhode: Polhode) -> PlotModel {
    let mut tracks = Track::of(studio, plot.body, |sample| sample.pole);
    tracks.iter_mut().for_each(|lane| lane.keep_latest(SAMPLES));
    let now = studio.race().t();
    let exact = ExactLine::of_places(studio, polhode.way.into_iter().map(|at| (now, at)));
    let style = LineStyle::solid(palette_of(studio.display().theme).dim, THIN);
    let beside = polhode.borders.into_iter().map(|line| Curve::new(style, line)).collect();
    let (exact, dots) = (vec![exact], Dots::Sparse);
    PlotModel { tracks, dots, exact, beside, is_of_ticks: true, is_round: true, ..plot }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::studio::Instrument;

    #[test]
    fn a_lane_leaves_a_trail_and_a_body_that_does_not_turn_in_space_has_a_reason() {
        let after = |scene: &str| {
            let mut studio = Studio::new(Scene::built_in(scene).unwrap());
            (0..60).for_each(|_| studio.tick());
            (plot_set(&studio).plots.remove(0), Instrument::Polhode.is_of(studio.scene()))
        };
        let (coin, is_of_coin) = after("coin");
        assert!(is_of_coin && coin.nothing.is_none() && coin.tracks[0].places().count() > 50);
        assert!(coin.tracks[0].along(1).fold(1.0, f64::min) < 0.9, "it has tipped over");
        let (spring, is_of_spring) = after("spring");
        assert_eq!(spring.nothing.as_deref(), Some(METRICS[Metric::ATTITUDE_ERROR].absent));
        assert!(!is_of_spring);
    }
}
