//! The stability map, which shows the tick rates and parameter values at which each method is stable on a body.
//!
//! A method is stable on a linear body if it is stable on each of the body's normal modes, which are springs. If
//! damping couples the modes, the map of a step of the whole body decides. A nonlinear body is linearised about rest. A
//! method that chooses its own steps has no region, because no tick rate bounds it.

use std::sync::Arc;

use contour::{Corners, contour};

pub use seen::DampingLine;
use seen::damping_lines;

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

/// Lowest and highest tick rate of a map in Hz, which are those that keys can set. A current rate outside widens the
/// map.
const RATES_HZ: [f64; 2] = [2.0, 1000.0];
/// Number of decades of the parameter that a map covers.
const DECADES: f64 = 5.0;
/// Smallest and largest value of a parameter that is 0 in the scene, so that its scale is unknown.
const FROM_NOTHING: [f64; 2] = [0.01, 1000.0];
/// Number of points at which a method is tried, along the rates and along the values. Boundaries are bisected between
/// the points, so that more points only find narrower regions.
const CORNERS: [usize; 2] = [37, 33];
/// Number of such points for a body with many coupled coordinates. A region takes tens of milliseconds with 2
/// coordinates, and would take seconds with 16.
const FEWER_CORNERS: [usize; 2] = [19, 17];
/// Number of coupled coordinates from which on [`FEWER_CORNERS`] is used.
const MANY_COUPLED: usize = 9;
/// Work of a motion's eigenvalues, in evaluations of one coordinate, per cube of the number of coordinates.
const ROOTS_PER_CUBE: u64 = 50;

/// A request for a stability map.
#[derive(Clone, Debug, PartialEq)]
pub struct MapRequest {
    /// Index of the body in the scene.
    pub body: usize,
    /// Index of the mapped parameter among those of the body's kind.
    pub parameter: usize,
    /// The methods, with their indices in the list.
    pub specs: Vec<(usize, LaneSpec)>,
    /// The current tick rate.
    pub tick_hz: TickRate,
    /// The current parameters of the body.
    pub(super) values: Vec<f64>,
    /// Rates in Hz at the left and right end of the map.
    pub rates_hz: [f64; 2],
    /// Values of the parameter at the lower and upper end of the map.
    pub range: [f64; 2],
}

impl MapRequest {
    /// Requests the map of a parameter of a body, by their indices, around these values of its parameters. Each method
    /// has its index in the list.
    pub fn new(
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

    /// Returns the current value of the mapped parameter.
    pub fn value(&self) -> f64 {
        self.values[self.parameter]
    }

    /// Whether both requests have the same regions, which do not depend on the current point.
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

/// Returns the limits of whole decades around the scene's value and the current one.
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

/// The region in which a method is stable. Points are the common logarithms of the rate in Hz and of the parameter's
/// value.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// How much of the map the region covers.
    pub coverage: Coverage,
    /// Convex polygons that together cover the region.
    pub pieces: Vec<Vec<[f64; 2]>>,
    /// Boundary of the region, as lines through these points.
    pub boundary: Vec<Vec<[f64; 2]>>,
    /// The ω h of a tick at the boundary, if the method's card states it and no motion on the map is damped.
    pub limit: Option<f64>,
    /// Lines of equal damping as a player sees it, for an engine that models the body as its joint.
    pub seen: Vec<DampingLine>,
}

impl Region {
    /// Whether a point is in one of the region's pieces.
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
    /// The region covers all of the map.
    Everywhere,
    /// The region covers none of the map.
    Nowhere,
    /// The region covers a part of the map.
    Part,
    /// The method chooses its own steps, so that no tick rate bounds it.
    OwnSteps,
}

/// Stability of a method at the current point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PointStability {
    /// The method is stable.
    Stable,
    /// The motion grows, so that the swing doubles in this number of seconds.
    Doubles(f64),
    /// The method chooses its own steps.
    OwnSteps,
}

/// The stability map of a body, with the results up to now.
#[derive(Clone, Debug)]
pub struct StabilityMap {
    /// The request.
    pub request: MapRequest,
    /// Regions of the request's methods, from the first one; later regions are not known yet.
    pub regions: Vec<Region>,
    /// Stability of each method of the request at the current point; empty until known.
    pub here: Vec<PointStability>,
    /// The reason why the body cannot be mapped, if it is neither linear nor linearisable about rest.
    pub refused: Option<NoSmallMotion>,
    /// Whether the body is linear, so that the map holds at any amplitude.
    pub is_linear: bool,
    /// Whether the true motion grows at the current point. Such growth does not count against a method.
    pub truth_grows: bool,
}

/// The motion on which a method is tried.
enum TestProblem {
    /// The normal modes, with the fastest first.
    Uncoupled(Uncoupled),
    /// All coordinates together, because damping couples the modes or one of them grows.
    Coupled(CoupledMotion),
}

/// The normal modes of a body.
struct Uncoupled {
    modes: Vec<NormalMode>,
    /// The forces that an engine integrates itself.
    settings: EngineSettings,
    /// The coupled motion, for an engine that keeps such a body's whole force constant over a step.
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

    /// Returns the modes on which a method is tried or, if it is not tried on modes, the coupled motion.
    fn test_motions(&self, spec: &LaneSpec) -> (&[NormalMode], Option<&CoupledMotion>) {
        match self {
            Self::Uncoupled(Uncoupled { held: Some(held), .. }) if spec.method.is_engine() => {
                (&[], Some(held))
            }
            Self::Uncoupled(Uncoupled { modes, .. }) => (modes, None),
            Self::Coupled(coupled) => (&[], Some(coupled)),
        }
    }

    /// Returns the stability of a method on each mode or on the coupled motion; `None` if the method fails.
    fn stabilities<'a>(
        &'a self,
        spec: &'a LaneSpec,
        hz: f64,
    ) -> impl Iterator<Item = Option<Stability>> + 'a {
        let (modes, coupled) = self.test_motions(spec);
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
        self.stabilities(spec, hz)
            .all(|found| found.is_some_and(|stability| stability.is_bounded()))
    }

    /// Returns the approximate work of a point under a method, which is that of steps from two states per coordinate,
    /// and of the roots of their map.
    fn work(&self, spec: &LaneSpec) -> u64 {
        let steps = |n: u64| {
            let evaluations = u64::from(spec.method.evaluations.unwrap_or(n as u32));
            let evaluations = STEPS_PER_MODE * n * evaluations * u64::from(spec.substeps);
            work_of(evaluations, n, spec.solver()) + work_of_roots(n)
        };
        let (modes, coupled) = self.test_motions(spec);
        let together = coupled.map_or(0, |coupled| steps(coupled.coordinates() as u64));
        modes.len() as u64 * steps(1) + together
    }

    fn is_undamped(&self) -> bool {
        matches!(self, Self::Uncoupled(Uncoupled { modes, .. }) if modes.iter().all(NormalMode::is_conserved))
    }

    fn grows(&self) -> bool {
        matches!(self, Self::Coupled(coupled) if coupled.grows())
    }
}

/// The body and the grid from which a map is made.
struct Plane {
    kind: Arc<Kind>,
    values: Vec<f64>,
    parameter: usize,
    corners: Corners,
    meter: Arc<Meter>,
}

impl Plane {
    /// Returns the motion of the body with this value of the mapped parameter.
    fn motion_at(&self, value: f64) -> Option<TestProblem> {
        TestProblem::of(&*self.body_at(value)).ok()
    }

    fn body_at(&self, value: f64) -> Box<dyn Stepper> {
        let mut values = self.values.clone();
        values[self.parameter] = value;
        (self.kind.build)(&values, Solver::Truth)
    }

    /// Returns the approximate work of finding a motion.
    fn work_of_motion(&self) -> u64 {
        work_of_roots(self.kind.coordinates(&self.values).len() as u64)
    }

    /// Returns the stability of each method at a value and a rate, and whether the true motion grows at this point.
    async fn stability_at_point(
        &self,
        specs: &[(usize, LaneSpec)],
        value: f64,
        hz: f64,
    ) -> (Vec<PointStability>, bool) {
        let motion = self.motion_at(value);
        self.meter.yield_after(self.work_of_motion()).await;
        let mut found = Vec::with_capacity(specs.len());
        for (_, spec) in specs {
            found.push(stability_at_point(spec, motion.as_ref(), hz));
            self.meter.yield_after(motion.as_ref().map_or(0, |motion| motion.work(spec))).await;
        }
        (found, motion.is_some_and(|motion| motion.grows()))
    }

    /// Returns the motion at each row of the map; `None` if the body cannot be linearised.
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
        let seen = damping_lines(&spec, &self.corners, joint_at, &self.meter).await;
        Region { limit, seen, ..region }
    }
}

type Rows = Vec<Option<TestProblem>>;

/// A map in progress. The current point comes first, then region by region.
pub(super) struct MapWork {
    plane: Arc<Plane>,
    map: StabilityMap,
    rows: Option<Arc<Rows>>,
    /// Work in progress on the current point. Below is the work in progress on the rows or a region.
    here: Option<Sliced<(Vec<PointStability>, bool)>>,
    part: Option<Sliced<MapPart>>,
    /// Whether the last slice ended without a new result.
    is_within_a_part: bool,
}

enum MapPart {
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

    /// Replaces the request. Regions that also answer the new request are kept, including one in progress.
    pub(super) fn set_request(&mut self, request: MapRequest) {
        if !request.has_regions_of(&self.map.request) {
            *self = Self::new(self.plane.kind.clone(), request);
        } else if request != self.map.request {
            self.map.request = request;
            self.map.here.clear();
            self.here = None;
        }
    }

    /// Whether the map is of the body of `request`, which is of this kind.
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

    /// Whether the last slice ended within a part, without a new result.
    pub(super) fn is_within_a_part(&self) -> bool {
        self.is_within_a_part
    }

    /// Returns the meter that counts the map's work.
    #[cfg(test)]
    pub(super) fn meter(&self) -> &Arc<Meter> {
        &self.plane.meter
    }

    /// Continues for about this much work, in evaluations of one coordinate.
    pub(super) fn advance(&mut self, work: u64) {
        let request = &self.map.request;
        if self.is_done() {
            return;
        }
        if self.map.here.len() < request.specs.len() {
            let new = || {
                let (plane, specs) = (self.plane.clone(), request.specs.clone());
                let (value, hz) = (request.value(), f64::from(request.tick_hz));
                let find = async move { plane.stability_at_point(&specs, value, hz).await };
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
            Some(MapPart::Rows(rows)) => self.rows = Some(rows.into()),
            Some(MapPart::Region(region)) => self.map.regions.push(region),
            None => self.part = Some(part),
        }
        self.is_within_a_part = self.part.is_some();
    }

    /// Returns the work for the next region, or for the rows that it needs first.
    fn next_part(&self) -> Sliced<MapPart> {
        let (plane, meter) = (self.plane.clone(), self.plane.meter.clone());
        let (_, spec) = self.map.request.specs[self.map.regions.len()];
        match self.rows.clone() {
            Some(rows) => {
                Sliced::new(meter, async move { MapPart::Region(plane.region(spec, &rows).await) })
            }
            None => Sliced::new(meter, async move { MapPart::Rows(plane.rows().await) }),
        }
    }
}

/// Returns the work of the eigenvalues of two values for each of `n` coordinates.
fn work_of_roots(n: u64) -> u64 {
    ROOTS_PER_CUBE * n * n * n
}

fn chooses_steps(spec: &LaneSpec) -> bool {
    spec.method.tolerance.is_some() || !spec.method.keeps_time
}

/// Returns the stability on one mode, measured on a body with one coordinate and this mode. The body is a spring, but a
/// follower for a follower method, and a ship for an engine without a joint for the body. `None` if the method fails.
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

fn stability_at_point(spec: &LaneSpec, motion: Option<&TestProblem>, hz: f64) -> PointStability {
    if chooses_steps(spec) {
        return PointStability::OwnSteps;
    }
    let growths = motion.into_iter().flat_map(|motion| motion.stabilities(spec, hz)).map(|found| {
        let doubling = |stability: Stability| stability.doubling_s().unwrap_or(f64::INFINITY);
        found.map_or(0.0, doubling)
    });
    let doubling_s = growths.fold(f64::INFINITY, f64::min);
    if doubling_s.is_finite() {
        PointStability::Doubles(doubling_s)
    } else {
        PointStability::Stable
    }
}

#[cfg(test)]
mod tests;
