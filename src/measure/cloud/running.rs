//! The clouds of a run, one per lane, which are stepped outside the window's thread. A [`CloudRequest`] goes in, and
//! each [`FoundCloud`] comes back.
//!
//! A cloud depends only on the run, the tick and the choice, so that its picture at a tick is the same from either
//! direction.

use std::sync::Arc;

use super::request::{GRID, cost};
use super::{
    Cloud, CloudAxes, CloudBody, CloudBorder, CloudPicture, CloudRequest, CloudStart, Density,
    FoundCloud, LaneCloud, NoCloud,
};
use crate::run::race::Race;
use crate::scene::LaneSpec;
use crate::sim::TickRate;

/// Number of samples of an area over the length of a run.
const SAMPLES: u64 = 200;
/// Enlargement of a studio's clouds, which would otherwise look small.
const REACH: f64 = 2.0;

/// A run that is more seconds behind than this, and does not catch up soon, continues with a tenth of its points. Their
/// number does not fall below the minimum.
const BEHIND_S: f64 = 0.125;
const LEAST_POINTS: usize = 1_000;

/// Approximate number of evaluations in one call of `work`, and the maximum for a real-time run to reach its first
/// requested tick with all points.
const WORK: u64 = 4_000_000;
const WORK_AT_FIRST: u64 = 8 * WORK;

/// Number of points of each cloud that the axes of a picture take into account.
const SEEN: usize = 1_000;

/// Steps the clouds of the current [`CloudRequest`] in the background.
pub struct CloudWorker {
    request: Option<Arc<CloudRequest>>,
    /// The run of the last request.
    run: Option<Result<Box<CloudRun>, NoCloud>>,
    is_done: bool,
    /// Stride through the points, of which every n-th is stepped.
    stride: usize,
    /// The requested and the reached tick, at the last check of whether the run keeps up.
    looked: Option<[u64; 2]>,
}

impl Default for CloudWorker {
    fn default() -> Self {
        Self { request: None, run: None, is_done: false, stride: 1, looked: None }
    }
}

impl CloudWorker {
    /// Replaces the request; `None` cancels it. Clouds of the same run continue from their current tick. They use fewer
    /// points if they fall behind a real-time run, and all points once the run stands still.
    pub fn set_request(&mut self, request: Option<Arc<CloudRequest>>) {
        match (&self.request, &request) {
            (Some(old), Some(new)) if old.is_alike(new) => {
                let stride = self.stride_for(old.tick, new);
                if stride != self.stride {
                    (self.run, self.looked, self.stride) = (None, None, stride);
                }
            }
            (_, new) => {
                let stride = new.as_deref().map_or(1, initial_stride);
                (self.run, self.looked, self.stride) = (None, None, stride);
            }
        }
        self.is_done = request.is_none();
        self.request = request;
    }

    /// Returns the stride to use from now on, when `new` replaces the request for the tick `old`.
    fn stride_for(&mut self, old: u64, new: &CloudRequest) -> usize {
        let Some(Ok(run)) = &self.run else { return self.stride };
        if !new.in_time {
            self.looked = None;
            return 1;
        }
        let part = (BEHIND_S * f64::from(new.tick_hz)) as u64;
        let now = [old, run.tick];
        let [asked, reached] = *self.looked.get_or_insert(now);
        if (asked..=asked + part).contains(&old) {
            return self.stride;
        }
        self.looked = Some(now);
        let behind = old.saturating_sub(run.tick);
        let gained = (run.tick.saturating_sub(reached)).saturating_sub(old.saturating_sub(asked));
        let keeps_up = behind <= part || 2 * gained >= behind;
        if keeps_up { self.stride } else { next_stride(new, self.stride) }
    }

    /// Whether no work remains.
    pub fn is_done(&self) -> bool {
        self.is_done || self.request.is_none()
    }

    /// Steps some ticks towards the requested one, and returns the picture if it is due.
    pub fn work(&mut self) -> Option<FoundCloud> {
        let request = self.request.as_ref().filter(|_| !self.is_done)?;
        let run = self.run.get_or_insert_with(|| CloudRun::new(request, self.stride).map(Box::new));
        let picture = match run {
            Ok(run) => {
                run.work(request.tick);
                self.is_done = run.tick == request.tick;
                let is_shown = self.is_done || run.tick.is_multiple_of(run.sampled_every);
                is_shown.then(|| Ok(run.picture()))?
            }
            Err(why) => {
                self.is_done = true;
                Err(why.clone())
            }
        };
        Some(FoundCloud { request: Arc::clone(request), picture })
    }
}

/// Returns the stride for a tenth of the points, or the same stride if too few points would be left.
fn next_stride(request: &CloudRequest, stride: usize) -> usize {
    if request.choice.points / (10 * stride) < LEAST_POINTS { stride } else { 10 * stride }
}

/// Returns the initial stride of a run. It is larger if the first requested tick is late.
fn initial_stride(request: &CloudRequest) -> usize {
    let points = request.choice.points as u64;
    let work =
        request.lanes.iter().map(|(_, spec)| cost(spec)).sum::<u64>() * points * request.tick;
    let mut stride = 1;
    while request.in_time && work / stride as u64 > WORK_AT_FIRST {
        match next_stride(request, stride) {
            same if same == stride => break,
            fewer => stride = fewer,
        }
    }
    stride
}

/// A cloud with its area at each sampled tick up to now.
struct SampledCloud<C> {
    cloud: C,
    areas: Vec<Option<f64>>,
}

/// The clouds of all lanes in progress.
struct CloudRun {
    lanes: Vec<(usize, SampledCloud<Cloud>)>,
    exact: SampledCloud<CloudBorder>,
    axes: CloudAxes,
    start: CloudStart,
    points: usize,
    tick_hz: TickRate,
    tick: u64,
    /// Number of ticks between two samples.
    sampled_every: u64,
    /// Maximum number of ticks in one call of `work`.
    part: u64,
}

impl CloudRun {
    /// Starts the clouds of a request, with one of `stride` points each.
    fn new(request: &CloudRequest, stride: usize) -> Result<Self, NoCloud> {
        let &CloudRequest { ref scene, ref changes, body, ref lanes, tick_hz, choice, .. } =
            request;
        let points = choice.points / stride;
        let scene = changes.applied_to(scene).of_one_body(body);
        let mut race = Race::new(&scene, []).with_script(&scene.script);
        race.catch_up(&mut ());
        let of = CloudBody {
            name: &scene.bodies[0].name,
            kind: &scene.bodies[0].kind,
            body: &*race.truth().bodies()[0].stepper,
        };
        let about = CloudStart::about(of, choice.shape, None)?;
        let (t, reach) = (changes.starts_at_s(), about.reach.map(|reach| REACH * reach));
        let start = CloudStart { t, reach, ..about };
        Cloud::find_room(points, lanes.iter().map(|(_, spec)| spec))?;
        let new = |(entry, spec): &(usize, LaneSpec)| {
            let cloud = Cloud::new(of, spec, start, points, tick_hz)?.rewindable();
            Ok((*entry, SampledCloud { cloud, areas: Vec::new() }))
        };
        let runs = lanes.iter().map(new).collect::<Result<Vec<_>, NoCloud>>()?;
        let border = CloudBorder::exact(of, start, tick_hz)?.rewindable();
        let specs: Vec<LaneSpec> = lanes.iter().map(|(_, spec)| *spec).collect();
        let axes = CloudAxes::of_run(of, start, &specs, tick_hz, scene.seconds)?;
        let ticks = ((scene.seconds * f64::from(tick_hz)) as u64).max(1);
        let work: u64 = specs.iter().map(cost).sum();
        let mut run = Self {
            lanes: runs,
            exact: SampledCloud { cloud: border, areas: Vec::new() },
            axes,
            start,
            points,
            tick_hz,
            tick: 0,
            sampled_every: ticks.div_ceil(SAMPLES),
            part: (WORK / (work * points as u64)).max(1),
        };
        run.sample();
        Ok(run)
    }

    /// Steps towards a tick, or back to that tick.
    fn work(&mut self, to: u64) {
        let sampled = (self.tick / self.sampled_every + 1) * self.sampled_every;
        let tick = to.min(sampled).min(self.tick + self.part);
        self.exact.cloud.go_to(tick);
        self.lanes.iter_mut().for_each(|(_, lane)| lane.cloud.go_to(tick));
        self.tick = tick;
        self.sample();
    }

    /// Adds the current areas if this tick is due for a sample.
    fn sample(&mut self) {
        let is_next = |known: usize| known as u64 * self.sampled_every == self.tick;
        let Self { lanes, exact, .. } = self;
        if is_next(exact.areas.len()) {
            exact.areas.push(exact.cloud.area_ratio());
        }
        for (_, lane) in lanes.iter_mut().filter(|(_, lane)| is_next(lane.areas.len())) {
            lane.areas.push(lane.cloud.area_ratio());
        }
    }

    fn t(&self, tick: u64) -> f64 {
        self.start.t + self.tick_hz.seconds(tick)
    }

    fn picture(&self) -> CloudPicture {
        let border = self.exact.cloud.lines();
        let some = |(_, SampledCloud { cloud, .. }): &(usize, SampledCloud<Cloud>)| {
            let points = cloud.q().iter().zip(cloud.v()).map(|(&q, &v)| [q, v]);
            points.step_by(cloud.q().len().div_ceil(SEEN)).collect::<Vec<_>>()
        };
        let clouds: Vec<_> = self.lanes.iter().map(some).collect();
        let view = self.axes.around(&border.concat(), &clouds);
        let lane = |(entry, SampledCloud { cloud, areas }): &(usize, SampledCloud<Cloud>)| {
            let mut density = Density::new([GRID; 2], view);
            density.add(cloud.q(), cloud.v());
            let area_ratio = cloud.area_ratio();
            let areas = self.samples(areas, area_ratio);
            LaneCloud {
                entry: *entry,
                lost: cloud.q().len() - cloud.points_left(),
                hidden: cloud.hidden(&density),
                beyond: cloud.beyond(view),
                density: Arc::new(density),
                area_ratio,
                words: cloud.in_words(area_ratio, areas.iter().map(|[_, area]| *area)),
                measured: cloud.measured_in_words(),
                areas,
            }
        };
        CloudPicture {
            tick: self.tick,
            points: self.points,
            view,
            exact: self.samples(&self.exact.areas, self.exact.cloud.area_ratio()),
            lanes: self.lanes.iter().map(lane).collect(),
            border,
        }
    }

    /// Returns the areas at the sampled ticks up to now, and the current one.
    fn samples(&self, areas: &[Option<f64>], now: Option<f64>) -> Vec<[f64; 2]> {
        let sampled = (0..).step_by(self.sampled_every as usize).zip(areas.iter().copied());
        let so_far = sampled.take_while(|(tick, _)| *tick < self.tick);
        so_far
            .chain([(self.tick, now)])
            .filter_map(|(tick, area)| Some([self.t(tick), area?]))
            .collect()
    }
}
