//! The stability map: for each method the tick rates and the values of a parameter at which it is stable on a body.
//!
//! A method is stable on a linear body if it is stable on each of its normal modes, and each of those is a spring. Where
//! damping couples the modes, the map of a step of the whole body decides. A nonlinear body is linearised about rest. A
//! method that chooses its own steps has no region: no tick rate bounds it.

use std::sync::Arc;

use contour::{Corners, contour};

pub use seen::SeenLine;
use seen::seen_lines;

use super::modes::STEPS_PER_MODE;
use super::slices::{Meter, Sliced};
use super::truth::work_of;
use crate::scene::{LaneSpec, SceneBody};
use crate::sim::bodies::{Follow, Kind, Ship, Spring};
use crate::sim::stability::{
    CoupledMotion, NoSmallMotion, NormalMode, SmallMotion, Stability, Tick,
};
use crate::sim::{EngineSettings, Solver, Stepper, TickRate, stepper};

mod contour;
mod seen;
mod words;

/// The tick rates of a map in Hz: those of the keys. A present rate outside widens the map.
const RATES_HZ: [f64; 2] = [2.0, 1000.0];
/// A map reaches over this many powers of ten of the parameter.
const DECADES: f64 = 5.0;
/// The values of a parameter that is 0 in the scene, which says nothing of its size.
const FROM_NOTHING: [f64; 2] = [0.01, 1000.0];
/// Points at which a method is tried, along the rates and along the values. Boundaries between them are bisected, so
/// that more points only find narrower regions.
const CORNERS: [usize; 2] = [37, 33];
/// The same for a body of many coupled coordinates: a region takes tens of milliseconds with 2, and would take seconds
/// with 16.
const FEWER_CORNERS: [usize; 2] = [19, 17];
/// From this many coupled coordinates on.
const MANY_COUPLED: usize = 9;
/// The work of the eigenvalues of a motion, in evaluations of one coordinate, by the cube of its coordinates.
const ROOTS_PER_CUBE: u64 = 50;

/// A stability map that is wanted.
#[derive(Clone, Debug, PartialEq)]
pub struct MapRequest {
    /// The body's index in the scene.
    pub body: usize,
    /// The index of the mapped parameter among those of the body's kind.
    pub parameter: usize,
    /// The methods, with their indices on the list.
    pub specs: Vec<(usize, LaneSpec)>,
    /// The present tick rate.
    pub tick_hz: TickRate,
    /// The present parameters of the body.
    pub(super) values: Vec<f64>,
    /// The rates at the left and at the right end, in Hz.
    pub rates_hz: [f64; 2],
    /// The values of the parameter at the lower and at the upper end.
    pub range: [f64; 2],
}

impl MapRequest {
    pub(crate) fn new(
        (body, parameter): (usize, usize),
        opened: &SceneBody,
        values: &[f64],
        tick_hz: impl Into<TickRate>,
        specs: Vec<(usize, LaneSpec)>,
    ) -> Self {
        let tick_hz = tick_hz.into();
        let [slowest, fastest] = RATES_HZ;
        Self {
            body,
            parameter,
            specs,
            tick_hz,
            values: values.to_vec(),
            rates_hz: [slowest.min(f64::from(tick_hz)), fastest.max(f64::from(tick_hz))],
            range: range(opened.values[parameter], values[parameter]),
        }
    }

    /// The present value of the mapped parameter.
    pub fn value(&self) -> f64 {
        self.values[self.parameter]
    }

    /// Whether both have the same regions: the present point does not change them.
    fn has_regions_of(&self, other: &Self) -> bool {
        let fixed = |request: &Self| {
            let mut fixed = request.clone();
            fixed.tick_hz = TickRate::MIN;
            fixed.values[fixed.parameter] = 0.0;
            fixed
        };
        fixed(self) == fixed(other)
    }
}

/// Whole powers of ten around the value that the scene has, and around the present one.
fn range(opened: f64, present: f64) -> [f64; 2] {
    let [low, high] = if opened > 0.0 {
        let low = libm::pow(10.0, (libm::log10(opened) - 1.5).round());
        [low, low * libm::pow(10.0, DECADES)]
    } else {
        FROM_NOTHING
    };
    if present <= 0.0 {
        return [low, high];
    }
    let decade = |round: fn(f64) -> f64| libm::pow(10.0, round(libm::log10(present)));
    [low.min(decade(libm::floor)), high.max(decade(libm::ceil))]
}

/// Where a method is stable. Points are the common logarithms of the rate in Hz and of the parameter's value.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// How much of the map it covers.
    pub coverage: Coverage,
    /// Convex polygons that cover it.
    pub pieces: Vec<Vec<[f64; 2]>>,
    /// Its boundary, as lines through these points.
    pub boundary: Vec<Vec<[f64; 2]>>,
    /// The ω h of a tick at the boundary, where the method's card tells it: nothing on the map may be damped.
    pub limit: Option<f64>,
    /// Lines along which a player sees the same damping; of an engine whose joint the body is.
    pub seen: Vec<SeenLine>,
}

impl Region {
    /// Whether this point is in one of its pieces.
    pub fn contains(&self, [x, y]: [f64; 2]) -> bool {
        let is_left = |(a, b): (&[f64; 2], &[f64; 2])| {
            (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]) >= 0.0
        };
        self.pieces.iter().any(|piece| piece.iter().zip(piece.iter().cycle().skip(1)).all(is_left))
    }
}

/// How much of a map a region covers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coverage {
    /// All of it.
    Everywhere,
    /// None of it.
    Nowhere,
    /// A part of it.
    Part,
    /// The method chooses its own steps, so that no tick rate bounds it.
    OwnSteps,
}

/// What a method does at the present point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Here {
    /// It is stable.
    Stable,
    /// It grows: the swing doubles in this many seconds.
    Doubles(f64),
    /// The method chooses its own steps.
    OwnSteps,
}

/// The stability map of a body, as far as it has been found.
#[derive(Clone, Debug)]
pub struct StabilityMap {
    /// What it is a map of.
    pub request: MapRequest,
    /// The regions of the leading methods of the request.
    pub regions: Vec<Region>,
    /// What each method of the request does at the present point; empty until it is known.
    pub here: Vec<Here>,
    /// Why the body cannot be mapped, if it is neither linear nor can be linearised about rest.
    pub refused: Option<NoSmallMotion>,
    /// Whether the body is linear, so that the map holds at any amplitude.
    pub is_linear: bool,
    /// Whether the true motion grows at the present point. Such growth is not counted against a method.
    pub truth_grows: bool,
}

/// What a method is tried on.
enum TestProblem {
    /// The normal modes, the fastest first.
    Uncoupled(Uncoupled),
    /// All coordinates together: damping couples the modes, or one grows.
    Coupled(CoupledMotion),
}

/// The normal modes of a body.
struct Uncoupled {
    modes: Vec<NormalMode>,
    /// What an engine integrates itself.
    settings: EngineSettings,
    /// The same modes for an engine that holds the whole force of such a body.
    held: Option<CoupledMotion>,
}

impl TestProblem {
    fn of(body: &dyn Stepper) -> Result<Self, NoSmallMotion> {
        let small = SmallMotion::of(body)?;
        if let Some(mut modes) = small.normal_modes() {
            modes.sort_by(|a, b| b.omega_squared.total_cmp(&a.omega_squared));
            let settings = body.engine_settings(0.0);
            let is_held = settings == EngineSettings::NONE;
            let held = if is_held { small.coupled().ok() } else { None };
            return Ok(Self::Uncoupled(Uncoupled { modes, settings, held }));
        }
        small.coupled().map(Self::Coupled)
    }

    /// What a method is tried on: each of these modes, or all coordinates together.
    fn tried(&self, spec: &LaneSpec) -> (&[NormalMode], Option<&CoupledMotion>) {
        match self {
            Self::Uncoupled(Uncoupled { held: Some(held), .. }) if spec.method.is_engine() => {
                (&[], Some(held))
            }
            Self::Uncoupled(Uncoupled { modes, .. }) => (modes, None),
            Self::Coupled(coupled) => (&[], Some(coupled)),
        }
    }

    /// The stability of a method on each mode, or on all together. `None` where the method fails.
    fn under<'a>(
        &'a self,
        spec: &'a LaneSpec,
        hz: f64,
    ) -> impl Iterator<Item = Option<Stability>> + 'a {
        let (modes, coupled) = self.tried(spec);
        let has_joint = match self {
            Self::Uncoupled(Uncoupled { settings, .. }) => settings.has_spring(),
            Self::Coupled(_) => false,
        };
        let together = coupled
            .into_iter()
            .map(move |coupled| coupled.stability(spec.method, 1.0 / hz, spec.substeps).ok());
        modes.iter().map(move |mode| stability(spec, has_joint, mode, hz)).chain(together)
    }

    fn is_stable(&self, spec: &LaneSpec, hz: f64) -> bool {
        self.under(spec, hz).all(|found| found.is_some_and(|stability| stability.is_bounded()))
    }

    /// About the work of a point under a method: steps from each of two states a coordinate, and the roots of their map.
    fn work(&self, spec: &LaneSpec) -> u64 {
        let steps = |n: u64| {
            let evaluations = u64::from(spec.method.evaluations.unwrap_or(n as u32));
            let evaluations = STEPS_PER_MODE * n * evaluations * u64::from(spec.substeps);
            work_of(evaluations, n, spec.solver()) + work_of_roots(n)
        };
        let (modes, coupled) = self.tried(spec);
        let together = coupled.map_or(0, |coupled| steps(coupled.coordinates() as u64));
        modes.len() as u64 * steps(1) + together
    }

    fn is_undamped(&self) -> bool {
        matches!(self, Self::Uncoupled(Uncoupled { modes, .. }) if modes.iter().all(NormalMode::is_conserved))
    }

    /// Whether the true motion grows.
    fn grows(&self) -> bool {
        matches!(self, Self::Coupled(coupled) if coupled.grows())
    }
}

/// What the points of a map are tried on.
struct Plane {
    kind: Arc<Kind>,
    values: Vec<f64>,
    parameter: usize,
    corners: Corners,
    meter: Arc<Meter>,
}

impl Plane {
    /// The motion of the body with this value of the mapped parameter.
    fn motion_at(&self, value: f64) -> Option<TestProblem> {
        TestProblem::of(&*self.body_at(value)).ok()
    }

    fn body_at(&self, value: f64) -> Box<dyn Stepper> {
        let mut values = self.values.clone();
        values[self.parameter] = value;
        (self.kind.build)(&values, Solver::Truth)
    }

    /// About the work of finding a motion.
    fn work_of_motion(&self) -> u64 {
        work_of_roots(self.kind.coordinates(&self.values).len() as u64)
    }

    /// What each method does at a value and a rate, and whether the true motion grows there.
    async fn here(&self, specs: &[(usize, LaneSpec)], value: f64, hz: f64) -> (Vec<Here>, bool) {
        let motion = self.motion_at(value);
        self.meter.yield_after(self.work_of_motion()).await;
        let mut found = Vec::with_capacity(specs.len());
        for (_, spec) in specs {
            found.push(here(spec, motion.as_ref(), hz));
            self.meter.yield_after(motion.as_ref().map_or(0, |motion| motion.work(spec))).await;
        }
        (found, motion.is_some_and(|motion| motion.grows()))
    }

    /// The motion at each row of the map; `None` where the body cannot be linearised.
    async fn rows(&self) -> Rows {
        let mut rows = Vec::new();
        for j in 0..self.corners.counts()[1] {
            rows.push(self.motion_at(libm::pow(10.0, self.corners.at([0, j])[1])));
            self.meter.yield_after(self.work_of_motion()).await;
        }
        rows
    }

    async fn region(&self, spec: LaneSpec, rows: &Rows) -> Region {
        if chooses_steps(&spec) {
            let coverage = Coverage::OwnSteps;
            return Region {
                coverage,
                pieces: vec![],
                boundary: vec![],
                limit: None,
                seen: vec![],
            };
        }
        let stable = |motion: Option<&TestProblem>, x: f64| {
            motion.is_some_and(|motion| motion.is_stable(&spec, libm::pow(10.0, x)))
        };
        let of_point = rows.iter().flatten().map(|motion| motion.work(&spec)).max().unwrap_or(0);
        let region = contour(
            &self.corners,
            |[i, j]| stable(rows[j].as_ref(), self.corners.at([i, j])[0]),
            |x, j| stable(rows[j].as_ref(), x),
            |[x, y]| stable(self.motion_at(libm::pow(10.0, y)).as_ref(), x),
            (&self.meter, [of_point, of_point + self.work_of_motion()]),
        )
        .await;
        let is_undamped = rows.iter().flatten().all(TestProblem::is_undamped);
        let of_step = spec.method.stability_limit.filter(|limit| is_undamped && *limit > 0.0);
        let limit = of_step.map(|limit| limit * f64::from(spec.substeps));
        let joint_at = |value| self.kind.joint(&*self.body_at(value));
        let seen = seen_lines(&spec, &self.corners, joint_at, &self.meter).await;
        Region { limit, seen, ..region }
    }
}

type Rows = Vec<Option<TestProblem>>;

/// A map being computed: what the methods do at the present point, and then region by region.
pub(super) struct MapWork {
    plane: Arc<Plane>,
    map: StabilityMap,
    rows: Option<Arc<Rows>>,
    /// What is being found of the present point, and of the regions.
    here: Option<Sliced<(Vec<Here>, bool)>>,
    part: Option<Sliced<Part>>,
    /// Whether the last slice found nothing yet.
    is_within_a_part: bool,
}

enum Part {
    Rows(Rows),
    Region(Region),
}

impl MapWork {
    pub(super) fn new(kind: Arc<Kind>, request: MapRequest) -> Self {
        let body = (kind.build)(&request.values, Solver::Truth);
        let found = TestProblem::of(&*body);
        let is_slow =
            matches!(found, Ok(TestProblem::Coupled(_))) && body.q().len() >= MANY_COUPLED;
        let counts = if is_slow { FEWER_CORNERS } else { CORNERS };
        let ends = [request.rates_hz, request.range].map(|ends| ends.map(libm::log10));
        let plane = Plane {
            kind,
            values: request.values.clone(),
            parameter: request.parameter,
            corners: Corners::new(counts, ends),
            meter: Arc::default(),
        };
        let map = StabilityMap {
            regions: Vec::new(),
            here: Vec::new(),
            truth_grows: found.as_ref().is_ok_and(TestProblem::grows),
            refused: found.err(),
            is_linear: body.is_linear(),
            request,
        };
        let plane = Arc::new(plane);
        Self { plane, map, rows: None, here: None, part: None, is_within_a_part: false }
    }

    /// Replaces the request. Regions that answer the new one too are kept, also one that is being found.
    pub(super) fn set_request(&mut self, request: MapRequest) {
        if !request.has_regions_of(&self.map.request) {
            *self = Self::new(self.plane.kind.clone(), request);
        } else if request != self.map.request {
            self.map.request = request;
            self.map.here.clear();
            self.here = None;
        }
    }

    /// Whether it maps the body of `request`, which is of this kind.
    pub(super) fn is_of(&self, kind: &Arc<Kind>, request: &MapRequest) -> bool {
        Arc::ptr_eq(&self.plane.kind, kind) && self.map.request.body == request.body
    }

    pub(super) fn map(&self) -> StabilityMap {
        self.map.clone()
    }

    pub(super) fn is_done(&self) -> bool {
        let wanted = self.map.request.specs.len();
        self.map.refused.is_some()
            || self.map.here.len() == wanted && self.map.regions.len() == wanted
    }

    /// Whether the last slice was within a part, so that nothing more is known than before.
    pub(super) fn is_within_a_part(&self) -> bool {
        self.is_within_a_part
    }

    /// What counts the work on it.
    #[cfg(test)]
    pub(super) fn meter(&self) -> &Arc<Meter> {
        &self.plane.meter
    }

    /// Goes on for about this much work, in evaluations of one coordinate.
    pub(super) fn advance(&mut self, work: u64) {
        let request = &self.map.request;
        if self.is_done() {
            return;
        }
        if self.map.here.len() < request.specs.len() {
            let new = || {
                let (plane, specs) = (self.plane.clone(), request.specs.clone());
                let (value, hz) = (request.value(), f64::from(request.tick_hz));
                let find = async move { plane.here(&specs, value, hz).await };
                Sliced::new(self.plane.meter.clone(), find)
            };
            let mut finding = self.here.take().unwrap_or_else(new);
            match finding.resume(work) {
                Some((here, grows)) => (self.map.here, self.map.truth_grows) = (here, grows),
                None => self.here = Some(finding),
            }
            self.is_within_a_part = self.here.is_some();
            return;
        }
        let mut part = self.part.take().unwrap_or_else(|| self.next_part());
        match part.resume(work) {
            Some(Part::Rows(rows)) => self.rows = Some(rows.into()),
            Some(Part::Region(region)) => self.map.regions.push(region),
            None => self.part = Some(part),
        }
        self.is_within_a_part = self.part.is_some();
    }

    /// What the next region needs, or that.
    fn next_part(&self) -> Sliced<Part> {
        let (plane, meter) = (self.plane.clone(), self.plane.meter.clone());
        let (_, spec) = self.map.request.specs[self.map.regions.len()];
        match self.rows.clone() {
            Some(rows) => {
                Sliced::new(meter, async move { Part::Region(plane.region(spec, &rows).await) })
            }
            None => Sliced::new(meter, async move { Part::Rows(plane.rows().await) }),
        }
    }
}

/// The work of the eigenvalues of two values for each of `n` coordinates.
fn work_of_roots(n: u64) -> u64 {
    ROOTS_PER_CUBE * n * n * n
}

fn chooses_steps(spec: &LaneSpec) -> bool {
    spec.method.tolerance.is_some() || !spec.method.keeps_time
}

/// Stability on one mode, measured on a body of one coordinate that has it: a spring; for a follower method a follower; for
/// an engine on a body without a joint a ship. `None` if the method fails.
fn stability(spec: &LaneSpec, has_joint: bool, mode: &NormalMode, hz: f64) -> Option<Stability> {
    let NormalMode { omega_squared, damping_per_s, .. } = *mode;
    let body = match spec.method.law_order() {
        Some(order) => {
            let (order, rate) = (order as usize, omega_squared.sqrt());
            stepper(Follow { order, rate, step: 1.0, ..Follow::default() }, Solver::Truth)
        }
        None if spec.method.is_engine() && !has_joint => {
            stepper(Ship { drag: damping_per_s, mass: 1.0, ..Ship::BLANK }, Solver::Truth)
        }
        None => {
            let (stiffness, damping) = (omega_squared, damping_per_s);
            let spring = Spring { mass: 1.0, stiffness, damping, x0: 1.0, ..Spring::default() };
            stepper(spring, Solver::Truth)
        }
    };
    let tick = Tick { t: 0.0, h: 1.0 / hz, substeps: spec.substeps };
    NormalMode { shape: vec![1.0], ..*mode }.stability_of_small(&*body, spec.solver(), tick).ok()
}

fn here(spec: &LaneSpec, motion: Option<&TestProblem>, hz: f64) -> Here {
    if chooses_steps(spec) {
        return Here::OwnSteps;
    }
    let growths = motion.into_iter().flat_map(|motion| motion.under(spec, hz)).map(|found| {
        let doubling = |stability: Stability| stability.doubling_s().unwrap_or(f64::INFINITY);
        found.map_or(0.0, doubling)
    });
    let doubling_s = growths.fold(f64::INFINITY, f64::min);
    if doubling_s.is_finite() { Here::Doubles(doubling_s) } else { Here::Stable }
}

#[cfg(test)]
mod tests;
