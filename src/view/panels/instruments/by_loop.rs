//! The plots of the loop lab. They show the states that each loop on the stage displays and computes, up to the moment
//! of display.

use super::super::ranges;
use super::super::series_styles::SeriesStyles;
use super::super::tracks::Track;
use super::error::capitalised;
use super::motion::HEALTHY;
use super::phase::SAMPLES;
use super::plot_set::{ExactLine, PlotAxis, PlotModel, PlotSet, time_in_view};
use crate::chart::{AxisScale, Bounds, Dots};
use crate::loops::loop_lab::{FRAME_METRICS, LoopFrame, LoopLab, LoopLane};
use crate::run::past::Energies;
use crate::run::{METRICS, Metric, Scale};
use crate::studio::{Instrument, Studio};

/// Length of the time in view, in seconds. It is short enough to see every frame.
const FRAMES_S: f64 = 1.0;
/// Like [`HEALTHY`], but for an energy.
const HEALTHY_ENERGY: f64 = 50.0;
/// Names of the two states of the body that plots show: the displayed state, and the state after the last step.
const SHOWN: &str = "as shown";
const STEPPED: &str = "as stepped";
/// Message if every error is zero, because zero has no logarithm.
const NO_ERROR: &str = "No error: every loop on the stage shows the exact place.";

/// Returns the instrument's plots, or `None` if the instrument has none in the loop lab.
pub(super) fn plot_set(
    studio: &Studio,
    loops: &LoopLab,
    instrument: Instrument,
) -> Option<PlotSet> {
    let plots = Plots { studio, loops };
    let (title, mut plot) = match instrument {
        Instrument::Motion => ("Motion", plots.motion()),
        Instrument::Error => ("Error", plots.metric()),
        Instrument::Energy => ("Energy", plots.energy()),
        Instrument::Phase => ("Phase portrait", plots.phase()),
        Instrument::Cost
        | Instrument::Polhode
        | Instrument::StabilityMap
        | Instrument::OneStep
        | Instrument::Cloud
        | Instrument::Loop
        | Instrument::Advice => return None,
    };
    if let Some(waiting) = loops.waiting() {
        plot.nothing = Some(waiting.into());
    }
    Some(PlotSet { styles: SeriesStyles::of(studio), title: title.into(), plots: vec![plot] })
}

#[derive(Clone, Copy)]
struct Plots<'a> {
    studio: &'a Studio,
    loops: &'a LoopLab,
}

impl Plots<'_> {
    fn motion(self) -> PlotModel {
        let tracks = self.held(|frame| frame.q[0]);
        let exact = self.exact(|t, frame| [t, frame.exact[0]]);
        let [from_s, _] = self.last_frames();
        let seen = Track::front_since(&tracks, 1, from_s).chain(self.loops.range());
        let y = ranges::around_truth(seen, &tracks, 1, HEALTHY);
        let up = PlotAxis::of(&self.loops.body().coordinates().at(0));
        self.over_time("motion by loop", up, tracks, Some(exact), (self.last_frames(), y))
    }

    fn metric(self) -> PlotModel {
        let metric = &FRAME_METRICS[self.loops.metric()];
        let scale = match metric.scale {
            Scale::Log => AxisScale::Log,
            Scale::Linear => AxisScale::Linear,
        };
        let tracks = self.held(|frame| scale.place((metric.measure)(frame)));
        let [least, most] = self.loops.range();
        let y = match metric.scale {
            Scale::Log => ranges::of_decades(&tracks, least.abs().max(most.abs())),
            Scale::Linear => ranges::from_zero(&tracks),
        };
        let unit = metric.unit.on(&self.loops.body().coordinates().at(0));
        let up = PlotAxis::new(metric.name, &unit, scale);
        let is_empty = tracks.iter().all(Track::is_empty);
        let id = format!("{} by loop", metric.id);
        let plot = self.over_time(&id, up, tracks, None, (self.last_frames(), y));
        PlotModel { nothing: is_empty.then(|| NO_ERROR.into()), ..plot }
    }

    fn energy(self) -> PlotModel {
        let total = |energies: Option<Energies>| energies.map_or(f64::NAN, |known| known.total_j);
        let tracks = self.held(|frame| total(frame.stepped.energies));
        let exact = self.exact(|t, frame| [t, total(frame.exact_state.energies)]);
        let view = self.time_in_view();
        let seen = Track::front_since(&tracks, 1, view[0]).chain(exact.values(1));
        let y = ranges::around_truth(seen, &tracks, 1, HEALTHY_ENERGY);
        let up = PlotAxis::new("total energy", "J", AxisScale::Linear);
        let is_empty = exact.times.is_empty();
        let plot = self.over_time("energy by loop", up, tracks, Some(exact), (view, y));
        let truth = &self.studio.race().truth().bodies()[self.studio.view().body];
        let why = is_empty.then(|| METRICS[Metric::ENERGY_DRIFT].absent_on(truth).to_owned());
        PlotModel { title: self.title(STEPPED), nothing: why, ..plot }
    }

    fn phase(self) -> PlotModel {
        let mut tracks = self.tracks(|_, frame| [frame.stepped.q, frame.stepped.v]);
        tracks.iter_mut().for_each(|track| track.keep_latest(SAMPLES));
        let newest = tracks.iter().filter_map(Track::times).map(|(first, _)| first);
        let since_s = newest.fold(f64::NEG_INFINITY, f64::max);
        let exact = self.exact(|t, frame| {
            let state = frame.exact_state;
            if t >= since_s { [state.q, state.v] } else { [f64::NAN; 2] }
        });
        let [x, y] = [0, 1].map(|axis| {
            let front = Track::front_since(&tracks, axis, f64::NEG_INFINITY);
            ranges::around_orbit(front.chain(exact.values(axis)), &tracks, axis, HEALTHY)
        });
        let axes = PlotAxis::of_phase(&self.loops.body().coordinates().at(0));
        let plot = self.plot("phase portrait by loop", STEPPED, axes, [x.into(), y.into()]);
        PlotModel { tracks, dots: Dots::Sparse, exact: vec![exact], ..plot }
    }

    fn over_time(
        self,
        id: &str,
        up: PlotAxis,
        tracks: Vec<Track>,
        exact: Option<ExactLine>,
        ([from, to], (low, high)): ([f64; 2], (f64, f64)),
    ) -> PlotModel {
        let axes = [PlotAxis::time("moment of display"), up];
        let plot = self.plot(id, SHOWN, axes, [[from, to], [low, high]]);
        PlotModel { tracks, exact: exact.into_iter().collect(), ..plot }
    }

    /// Returns an empty plot whose title is the name of the body with `shown`.
    fn plot(self, id: &str, shown: &str, axes: [PlotAxis; 2], fit: Bounds) -> PlotModel {
        PlotModel::new(self.studio.view().body, id.into(), self.title(shown), axes, fit)
    }

    fn title(self, what: &str) -> String {
        format!("{}, {what}", capitalised(&self.loops.scene().bodies[0].name))
    }

    fn now_s(self) -> f64 {
        self.loops.now_ns() as f64 / 1e9
    }

    fn last_frames(self) -> [f64; 2] {
        [(self.now_s() - FRAMES_S).max(0.0), self.now_s().max(FRAMES_S)]
    }

    fn time_in_view(self) -> [f64; 2] {
        time_in_view(self.loops.end_ns() as f64 / 1e9, self.now_s())
    }

    /// Returns a track for each loop on the stage. The track holds each value until the next frame.
    fn held(self, value: impl Fn(&LoopFrame) -> f64) -> Vec<Track> {
        let tracks = self.tracks(|t, frame| [t, value(frame)]);
        tracks.into_iter().map(Track::held).collect()
    }

    /// Returns a track of the frames so far for each loop on the stage. The selected loop comes last.
    fn tracks(self, place: impl Fn(f64, &LoopFrame) -> [f64; 2]) -> Vec<Track> {
        let track = |&entry: &usize| {
            let places = self.frames(&self.loops.lanes()[entry], 1, &place);
            Track::of_places(entry, entry == self.loops.selected(), places)
        };
        let mut tracks: Vec<Track> = self.loops.on_stage().iter().map(track).collect();
        tracks.sort_by_key(|track| track.is_front);
        tracks
    }

    /// Returns the exact solution at the frames of the selected loop so far, and at the next frame, so that the present
    /// lies between two known points.
    fn exact(self, place: impl Fn(f64, &LoopFrame) -> [f64; 2]) -> ExactLine {
        let lane = &self.loops.lanes()[self.loops.selected()];
        ExactLine::of_places(self.studio, self.frames(lane, 2, &place))
    }

    /// Returns the frames of a lane so far. If `after` is 1 they end with the displayed frame, and if it is 2 with the
    /// next one.
    fn frames<'f>(
        self,
        lane: &'f LoopLane,
        after: usize,
        place: &'f impl Fn(f64, &LoopFrame) -> [f64; 2],
    ) -> impl Iterator<Item = (f64, [f64; 2])> + 'f {
        let so_far = lane.frame_at(self.loops.now_ns()).map_or(0, |last| last + after);
        lane.frames()[..so_far.min(lane.frames().len())].iter().map(move |frame| {
            let t = frame.displayed_ns as f64 / 1e9;
            (t, place(t, frame))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::loops::loop_lab::LoopCommand;
    use crate::panels::instruments::{csv, svg};
    use crate::scene::Scene;
    use crate::studio::{Command, StageCommand, run_loops};

    fn lab_at(scene: &str, now_ns: i64) -> Studio {
        let mut studio = Studio::new(Scene::built_in(scene).unwrap());
        studio.apply(Command::Loop(LoopCommand::ToggleLab));
        run_loops(&mut studio);
        studio.apply(Command::Loop(LoopCommand::Seek(now_ns)));
        studio
    }

    fn plot(studio: &Studio, instrument: Instrument) -> PlotModel {
        plot_set(studio, studio.loop_lab().unwrap(), instrument).unwrap().plots.remove(0)
    }

    #[test]
    fn every_loop_lab_instrument_plots_and_exports_each_loop_on_the_stage() {
        for scene in ["spring", "harbour", "orbit"] {
            let mut studio = lab_at(scene, 3_000_000_000);
            studio.apply(StageCommand::Pick(1));
            for instrument in Instrument::all().filter(|one| one.is_in_loop_lab()) {
                studio.apply(StageCommand::Instrument(instrument));
                assert_eq!(studio.display().instrument, instrument);
                let table = csv(&studio).unwrap().concat();
                let names = ["lockstep", "fixed", "whole-refresh"];
                let drawing = svg(&studio);
                let lines = drawing.as_ref().map(|text| text.matches("<polyline").count());
                assert!(lines.is_some_and(|lines| lines > 10), "{scene} {instrument:?}");
                let has_values = table.lines().count() > 100;
                let Some(set) = plot_set(&studio, studio.loop_lab().unwrap(), instrument) else {
                    continue;
                };
                assert_eq!(has_values, set.plots[0].nothing.is_none(), "{scene} {instrument:?}");
                if has_values {
                    assert!(names.iter().all(|name| table.contains(&format!(",{name},"))));
                    assert!(!drawing.unwrap().contains("NaN"), "{scene} {instrument:?}");
                }
            }
            studio.apply(StageCommand::Instrument(Instrument::StabilityMap));
            assert_eq!(studio.display().instrument, Instrument::Loop, "the map is of the run");
        }
    }

    #[test]
    fn a_display_holds_the_shown_state_until_the_next_frame() {
        let studio = lab_at("spring", 900_000_000);
        let motion = plot(&studio, Instrument::Motion);
        let loops = studio.loop_lab().unwrap();
        let frames = loops.lanes()[loops.selected()].frames();
        let [one, next] = [&frames[20], &frames[21]];
        let between = (one.displayed_ns + next.displayed_ns) as f64 / 2e9;
        let track = motion.tracks.last().unwrap();
        assert!(track.is_front);
        assert_eq!(track.at(between).unwrap().1[1], one.q[0]);
        // The cosine of the spring is interpolated between the exact values at two frames.
        let exact = motion.exact[0].at((&studio, 0), between).unwrap()[1];
        let true_value = libm::cos(2.0 * std::f64::consts::PI * between);
        assert!((exact - true_value).abs() < 3e-3, "{exact} and {true_value}");
        assert!(motion.exact[0].at((&studio, 0), 0.9).is_some(), "the present is known");
        assert!(motion.fit[0][1] - motion.fit[0][0] == FRAMES_S);
    }

    #[test]
    fn every_measure_of_a_frame_can_be_plotted() {
        let mut studio = lab_at("spring", 2_000_000_000);
        studio.apply(StageCommand::Instrument(Instrument::Error));
        for (place, metric) in FRAME_METRICS.iter().enumerate() {
            studio.apply(StageCommand::Metric(place));
            let plot = plot(&studio, Instrument::Error);
            assert!(plot.axes[1].name().starts_with(metric.name) && plot.nothing.is_none());
            let raw = plot.tracks.last().unwrap().at(1.5).unwrap().1[1];
            let loops = studio.loop_lab().unwrap();
            let fixed = &loops.lanes()[loops.selected()];
            let frame = &fixed.frames()[fixed.frame_at(1_500_000_000).unwrap()];
            assert_eq!(plot.axes[1].scale.place((metric.measure)(frame)), raw, "{}", metric.id);
        }
    }
}
