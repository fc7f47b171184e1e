//! Poincaré sections, which are the positions of many starts at each period of a drive or, if there is no drive, at
//! each tick.

use super::request::{GRID, Request, cost};
use super::{
    Cloud, CloudAxes, CloudPicture, CloudShape, CloudStart, Density, LaneCloud, NoCloud, ShownTicks,
};
use crate::sim::number::significant;
use crate::sim::{Stepper, TickRate, golden_section};

/// Number of starts of a section. Each start leaves a point at each crossing.
const STARTS: usize = 400;
/// Maximum number of crossings of a lane, the work limit for all crossings in evaluations of a copy in a block, and the
/// number of pictures until they are complete.
const MAX_CROSSINGS: u64 = 3000;
const WORK: u64 = 100_000_000;
const PARTS: u64 = 40;
/// Reach of the starts, in swings. An angle is covered all around.
const REACH: f64 = 1.5;
/// Longest period of a drive in seconds, and maximum number of candidate periods.
const MAX_PERIOD_S: f64 = 60.0;
const MAX_TRIED: f64 = 20_000.0;
/// Number of moments at which forces are compared, and relative difference that counts as rounding.
const MOMENTS: u64 = 48;
const ROUNDING: f64 = 1e-6;

/// A section, which has the positions of a cloud's points at all crossings up to now.
struct Section {
    /// Time between two crossings, in ticks.
    period: f64,
    crossings: u64,
    density: Density,
}

impl Section {
    /// Creates a section without crossings. They follow at intervals of `period` (ticks, above 0) after the start, and
    /// `density` counts their points.
    fn new(period: f64, density: Density) -> Self {
        Self { period, crossings: 0, density }
    }

    /// Steps a cloud to the next crossing, and counts its points.
    fn cross(&mut self, cloud: &mut Cloud) {
        self.crossings += 1;
        let [q, v] = cloud.states_at(self.crossings as f64 * self.period);
        self.density.add(&q, &v);
    }
}

/// The sections of all lanes in progress.
pub(super) struct SectionRun {
    lanes: Vec<SectionLane>,
    axes: CloudAxes,
    strobe: String,
    /// Unit of the interval between crossings: `ticks`, or `periods` of the drive.
    intervals: &'static str,
}

struct SectionLane {
    entry: usize,
    cloud: Cloud,
    section: Section,
    /// Number of crossings to make.
    wanted: u64,
}

impl SectionRun {
    pub(super) fn new(request: Request<'_>) -> Result<Self, NoCloud> {
        let Request { of, lanes, tick_hz, seconds, t } = request;
        let plain = CloudStart::about(of, CloudShape::Disc, Some(1.0))?;
        let swing = plain.middle[0].abs().max(plain.middle[1].abs() / plain.reach[1]);
        let usual = if swing > 0.0 { REACH * swing } else { REACH };
        let reach = if of.body.is_angle(0) { std::f64::consts::PI } else { usual };
        let start = CloudStart { t, reach: plain.reach.map(|unit| unit * reach), ..plain };
        let shown = ((seconds.min(ShownTicks::MAX_S) * f64::from(tick_hz)) as u64).max(1);
        let specs: Vec<_> = lanes.iter().map(|(_, spec)| *spec).collect();
        let axes = CloudAxes::of_run(of, start, &specs, tick_hz, shown.into())?;
        let drive = period(of.body, start.middle, seconds, tick_hz);
        // If there is no drive, a crossing occurs at each tick.
        let period = drive.map_or(1.0, |seconds| seconds * f64::from(tick_hz));
        let strobe = match drive {
            Some(seconds) => format!("once in the drive's period of {} s", significant(seconds, 4)),
            None => "at each tick".into(),
        };
        let lane = |(entry, spec): &(usize, _)| {
            let cloud = Cloud::new(of, spec, start, STARTS, tick_hz)?;
            let work = (cost(spec) * STARTS as u64) as f64 * period;
            let wanted = ((WORK as f64 / work) as u64).clamp(1, MAX_CROSSINGS);
            let section = Section::new(period, Density::new([GRID; 2], axes.whole));
            Ok(SectionLane { entry: *entry, cloud, section, wanted })
        };
        let lanes = lanes.iter().map(lane).collect::<Result<_, NoCloud>>()?;
        let intervals = if drive.is_some() { "periods" } else { "ticks" };
        Ok(Self { lanes, axes, strobe, intervals })
    }

    pub(super) fn is_done(&self) -> bool {
        self.lanes.iter().all(|lane| lane.section.crossings == lane.wanted)
    }

    /// Steps every lane through a fraction of its crossings.
    pub(super) fn work(&mut self) {
        for lane in &mut self.lanes {
            let SectionLane { cloud, section, wanted, .. } = lane;
            let part = wanted.div_ceil(PARTS);
            (0..part.min(*wanted - section.crossings)).for_each(|_| section.cross(cloud));
        }
    }

    pub(super) fn picture(&self) -> CloudPicture {
        let lane = |lane: &SectionLane| LaneCloud {
            entry: lane.entry,
            density: lane.section.density.clone().into(),
            lost: STARTS - lane.cloud.points_left(),
            hidden: 0,
            beyond: [0; 4],
            area_ratio: None,
            words: format!("{STARTS} starts, {} {} each", lane.section.crossings, self.intervals),
            measured: self.strobe.clone(),
            areas: Vec::new(),
        };
        CloudPicture {
            tick: 0,
            section: Some(self.strobe.clone()),
            points: 0,
            view: self.axes.whole,
            border: Vec::new(),
            exact: Vec::new(),
            lanes: self.lanes.iter().map(lane).collect(),
        }
    }
}

/// Returns the period in seconds of the force on a body held in a state; `None` if the force does not depend on time,
/// or has no period up to `seconds`.
fn period(body: &dyn Stepper, [q, v]: [f64; 2], seconds: f64, tick_hz: TickRate) -> Option<f64> {
    let (h, seconds) = (tick_hz.step_s(), seconds.min(MAX_PERIOD_S));
    let apart = (h / 2.0).max(seconds / MAX_TRIED);
    let force = |t: f64| {
        let mut a = [0.0];
        body.acceleration(t, &[q], &[v], &mut a);
        a[0]
    };
    // The spacing is irrational, so that no period divides it.
    let moments: Vec<f64> =
        (0..MOMENTS).map(|n| (n as f64 * 0.618_034).fract() * seconds).collect();
    let forces: Vec<f64> = moments.iter().map(|&t| force(t)).collect();
    let middle = forces.iter().sum::<f64>() / forces.len() as f64;
    let square = |numbers: &mut dyn Iterator<Item = f64>| numbers.map(|n| n * n).sum::<f64>();
    let change = square(&mut forces.iter().map(|force| force - middle));
    if change <= 0.0 || change.is_nan() {
        return None;
    }
    let mismatch = |period: f64| {
        let later = moments.iter().zip(&forces).map(|(t, now)| force(t + period) - now);
        square(&mut { later }) / change
    };
    let tried = (h / apart).ceil() as u64..(seconds / apart) as u64;
    let mut on_grid = tried.map(|n| n as f64 * apart).map(|period| (period, mismatch(period)));
    let (mut before, mut here) = (on_grid.next()?, on_grid.next()?);
    for after in on_grid {
        if here.1 < before.1 && here.1 <= after.1 {
            let found = golden_section(&mismatch, [before.0, after.0]);
            if mismatch(found) < ROUNDING {
                return Some(found);
            }
        }
        (before, here) = (here, after);
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::sim::Solver;

    fn period_of(scene: &str) -> Option<f64> {
        let scene = Scene::built_in(scene).unwrap();
        let body = &scene.bodies[0];
        let body = (body.kind.build)(&body.values, Solver::Truth);
        period(&*body, [0.3, 0.1], scene.seconds, scene.tick_hz)
    }

    #[test]
    fn a_drive_has_its_period_and_a_free_body_has_none() {
        let found = period_of("duffing").unwrap();
        assert!((found / std::f64::consts::TAU - 1.0).abs() < 1e-6, "{found}");
        assert_eq!(period_of("pendulum"), None);
        assert_eq!(period_of("kicked-rotor"), None);
    }
}
