//! Clouds, which are many starts around the state of a body, stepped by one method, and the change of the area that
//! they cover.
//!
//! A method is a map of the phase plane. Its effect on an area is its character, because it preserves, spreads, shrinks
//! or tears the area.

use crate::sim::batch::{Batch, InstructionSet, OneCoordinate, Ticks};
use crate::sim::bodies::{Kind, Tumble};
use crate::sim::integrators::Family;
use crate::sim::number::significant;
use crate::sim::{State, Stepper, TickRate};

mod axes;
mod border;
mod course;
mod density;
mod lozenges;
mod request;
mod running;

pub use crate::scene::CloudShape;
use axes::CloudAxes;
pub use border::CloudBorder;
use course::{Course, Memory, Subject, copies_of};
pub use density::{Density, MAX_LINE_PART, PlaneView};
use lozenges::Lozenges;
pub use request::MAX_CLOUDS;
pub use request::{CloudChoice, CloudPicture, CloudRequest, FoundCloud, LaneCloud, POINTS};
pub use running::CloudWorker;

use crate::run::race::ESCAPE;
use crate::scene::LaneSpec;
use crate::sim::Fnv;

/// Default number of points of a cloud.
pub const USUAL_POINTS: usize = 100_000;

/// Half-width of a cloud on the sphere of the directions of L, in radians.
const USUAL_TURN: f64 = 0.05;

/// The reason why there is no cloud.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoCloud {
    /// The body has no phase plane, or several ones.
    #[error("a cloud needs a body of one coordinate, and {body} has {coordinates}")]
    SeveralCoordinates {
        /// Name of the body.
        body: String,
        /// Number of the body's coordinates.
        coordinates: usize,
    },
    /// The coordinate of a custom body has another type than `f64`.
    #[error("{body} is a custom body whose coordinate is no f64")]
    Custom {
        /// Name of the body.
        body: String,
    },
    /// The direction of L of a body that turns in space is unknown, because the body is at rest.
    #[error("{body} is at rest, so that its L has no direction")]
    AtRest {
        /// Name of the body.
        body: String,
    },
    /// The shape does not fit on the sphere of the directions of L.
    #[error("a reach of {reach} rad goes over a pole; give at most {most}")]
    OverThePole {
        /// Half-width in radians.
        reach: f64,
        /// Largest half-width, rounded down.
        most: f64,
    },
    /// The points of all methods together do not fit into memory.
    #[error("{points} points do not fit into memory; give fewer")]
    TooMany {
        /// Number of points per cloud.
        points: usize,
    },
}

/// A body from which a cloud is made.
#[derive(Clone, Copy)]
pub struct CloudBody<'a> {
    /// Name of the body, for errors.
    pub name: &'a str,
    /// Kind of the body.
    pub kind: &'a Kind,
    /// The body under its solver. Its state is the middle of the cloud.
    pub body: &'a dyn Stepper,
}

/// The start of a cloud.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CloudStart {
    /// Shape of the cloud.
    pub shape: CloudShape,
    /// Start time in seconds, for forces that depend on time.
    pub t: f64,
    /// Coordinate and velocity of the middle.
    pub middle: [f64; 2],
    /// Half-width in the coordinate and in the velocity.
    pub reach: [f64; 2],
    /// Whether the two are a [direction](Tumble::direction) of L, on a sphere.
    pub is_on_sphere: bool,
}

impl CloudStart {
    /// Returns a cloud's start around the state of a body at time 0. `size` is the half-width in the unit of the
    /// coordinate, by default a quarter of the swing. The half-width in velocity is `size` times the rate of the body's
    /// motion in this state.
    ///
    /// The cloud of a body that turns in space is on the sphere of the [directions](Tumble::direction) of its L, and
    /// `size` is an angle in radians.
    ///
    /// # Errors
    /// If the body has several coordinates, or turns in space and has no L or not enough room around it.
    pub fn about(
        CloudBody { name, body, .. }: CloudBody<'_>,
        shape: CloudShape,
        size: Option<f64>,
    ) -> Result<Self, NoCloud> {
        if let Some(tumble) = body.body().downcast_ref::<Tumble>() {
            let middle = tumble.direction(body.v());
            let across = (1.0 - middle[1] * middle[1]).sqrt();
            if !across.is_finite() {
                return Err(NoCloud::AtRest { body: name.into() });
            }
            let reach = size.unwrap_or(USUAL_TURN);
            let most = ((1.0 - middle[1].abs()) / across).min(std::f64::consts::PI * across);
            if reach > most {
                return Err(NoCloud::OverThePole { reach, most: (100.0 * most).floor() / 100.0 });
            }
            let reach = [reach / across, reach * across];
            return Ok(Self { shape, t: 0.0, middle, reach, is_on_sphere: true });
        }
        let coordinates = body.q().len();
        if coordinates > 1 {
            return Err(NoCloud::SeveralCoordinates { body: name.into(), coordinates });
        }
        let middle = [body.q()[0], body.v()[0]];
        let force = |q: f64| {
            let mut a = [0.0];
            body.acceleration(0.0, &[q], &[middle[1]], &mut a);
            a[0]
        };
        Ok(Self::around(middle, force, shape, size))
    }

    /// Returns a cloud's start around a state, where `force` is the force per unit mass at this state's velocity.
    fn around(
        middle: [f64; 2],
        force: impl Fn(f64) -> f64,
        shape: CloudShape,
        size: Option<f64>,
    ) -> Self {
        let near = 1e-3 * (1.0 + middle[0].abs());
        let slope = (force(middle[0] + near) - force(middle[0] - near)) / (2.0 * near);
        let rate = if slope.abs() > 1e-12 { slope.abs().sqrt() } else { 1.0 };
        let swing = middle[0].abs().max(middle[1].abs() / rate);
        let usual = if swing > 0.0 { swing / 4.0 } else { 0.25 };
        let size = size.unwrap_or(usual);
        Self { shape, t: 0.0, middle, reach: [size, size * rate], is_on_sphere: false }
    }

    fn state(&self, [x, y]: [f64; 2]) -> State<f64> {
        State { q: self.middle[0] + self.reach[0] * x, v: self.middle[1] + self.reach[1] * y }
    }

    fn ticks(&self, tick_hz: TickRate, substeps: u32) -> Ticks {
        Ticks { origin: self.t, ..Ticks::from_start(tick_hz, substeps, 0) }
    }
}

/// Measurements of a cloud.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CloudMeasure {
    /// Number of points left. The other points blew up.
    pub points: usize,
    /// Area relative to the start; `None` if no point is left, or if the cloud is too fine, folded or torn to
    /// measure.
    pub area_ratio: Option<f64>,
    /// RMS distance of the points from their middle, relative to the start.
    pub spread: Option<f64>,
    /// Hash of the exact states, like the [lane hashes](crate::run::Race::lane_hashes) of a race: 64-bit FNV-1a with
    /// -0 as 0.
    pub hash: u64,
}

/// Many starts of a body under one method.
pub struct Cloud {
    course: Course,
    area: Area,
    start: CloudStart,
    spread: f64,
}

/// How the area is measured.
enum Area {
    /// The area is measured by lozenges around some points. The course steps the corners of the lozenges.
    Lozenges(Course),
    /// The area is measured by the border of the whole cloud. This is done if near points take different steps, so that
    /// the map is too rough for small areas.
    Border(CloudBorder),
}

/// The area is recovering if its log change was once larger than `BACK` × the current log change + `LITTLE_BACK`.
const BACK: f64 = 1.1;
const LITTLE_BACK: f64 = 0.01;

/// Log changes of an area below which the area counts as preserved, for lozenges and for a border. For lozenges a
/// larger change counts as zero too if it is within `UNKNOWN_ERRORS` standard errors of the mean.
const UNKNOWN: f64 = 1e-6;
const UNKNOWN_ERRORS: f64 = 3.0;
const UNKNOWN_BY_BORDER: f64 = 2e-3;
/// Log change of an area below which it is reported as a percentage of the area, and not as a rate.
const SLIGHT: f64 = 1e-2;

/// Relative standard error of the mean area above which the mean is unknown, because a few far points decide it.
const UNEVEN: f64 = 0.1;

/// Fraction of points beyond the axes below which they are not mentioned.
const HIDDEN: f64 = 0.1;

/// Maximum number of sampled points, and number of a cloud's points per sample.
const MAX_SAMPLES: usize = 256;
const POINTS_TO_A_SAMPLE: usize = 16;

impl Cloud {
    /// Checks whether memory suffices for a cloud of `points` under each of these lanes at once. Allocates nothing.
    ///
    /// # Errors
    /// Fails with [`NoCloud::TooMany`] if memory does not suffice.
    pub fn find_room<'s>(
        points: usize,
        specs: impl IntoIterator<Item = &'s LaneSpec>,
    ) -> Result<(), NoCloud> {
        let solvers = specs.into_iter().map(LaneSpec::solver);
        Batch::find_room(points, solvers).map_err(|_| NoCloud::TooMany { points })
    }

    /// Creates a cloud of `points` starts of a body, under a lane of a race at this tick rate.
    ///
    /// # Errors
    /// Fails with the reason if the body has no cloud.
    pub fn new(
        of: CloudBody<'_>,
        spec: &LaneSpec,
        start: CloudStart,
        points: usize,
        tick_hz: impl Into<TickRate>,
    ) -> Result<Self, NoCloud> {
        let copies = copies_of(of);
        let subject = Subject::new(of.name, &copies);
        Self::of_subject(subject, of.body.is_linear(), spec, start, points, tick_hz.into())
    }

    /// Creates a cloud of `points` starts of a custom body around a start. The cloud's half-width is a quarter of the
    /// swing.
    ///
    /// ```
    /// use regatta_measure::cloud::{Cloud, CloudShape};
    /// use regatta_scene::LaneSpec;
    /// use regatta_sim::prelude::*;
    ///
    /// #[derive(Clone)]
    /// struct Buoy;
    ///
    /// impl System for Buoy {
    ///     type Vector = f64;
    ///     fn acceleration(&self, _t: f64, z: &f64, v: &f64, a: &mut f64) {
    ///         *a = -9.81 * z.clamp(-1.0, 0.5) - 0.3 * v;
    ///     }
    /// }
    ///
    /// let rk4 = LaneSpec::plain(method("rk4").expect("a built-in method"));
    /// let start = State { q: 0.8, v: 0.0 };
    /// let mut cloud = Cloud::of(&Buoy, start, CloudShape::Cat, 1000, &rk4, 60)?;
    /// cloud.advance(300);
    /// // The drag takes e^(-0.3 · 5) of any area.
    /// assert!((cloud.area_ratio().unwrap() - 0.223).abs() < 0.01);
    /// # Ok::<(), regatta_measure::cloud::NoCloud>(())
    /// ```
    ///
    /// # Errors
    /// Fails with [`NoCloud::TooMany`] if memory does not suffice.
    pub fn of<S: OneCoordinate>(
        system: &S,
        start: State<f64>,
        shape: CloudShape,
        points: usize,
        spec: &LaneSpec,
        tick_hz: impl Into<TickRate>,
    ) -> Result<Self, NoCloud> {
        let force = |q: f64| {
            let mut a = 0.0;
            system.acceleration(0.0, &q, &start.v, &mut a);
            a
        };
        let around = CloudStart::around([start.q, start.v], force, shape, None);
        let copies = |solver, starts: Vec<State<f64>>| {
            Some(Batch::on(InstructionSet::widest(), system, solver, starts.into_iter()))
        };
        let subject = Subject::new("body", &copies);
        Self::of_subject(subject, false, spec, around, points, tick_hz.into())
    }

    fn of_subject(
        subject: Subject<'_>,
        is_linear: bool,
        spec: &LaneSpec,
        start: CloudStart,
        points: usize,
        tick_hz: TickRate,
    ) -> Result<Self, NoCloud> {
        let is_adaptive = spec.method.family == Family::Adaptive;
        let is_linear = is_linear && !is_adaptive;
        let samples = if is_linear { 1 } else { samples(points) };
        let memory = match spec.method.restart {
            None => Memory::Absent,
            Some(_) => Memory::Carried,
        };
        let (solver, ticks) = (spec.solver(), start.ticks(tick_hz, spec.substeps));
        let shape = || start.shape.points(points).map(|point| start.state(point)).collect();
        let course = Course::new(subject, (solver, memory), ticks, points, shape)?;
        let area = if is_adaptive {
            let border = CloudBorder::new(subject, (solver, memory), ticks, start, points)?;
            Area::Border(border)
        } else {
            let lozenges = Lozenges::new(samples, spec.method, is_linear, start.reach);
            let corners = || {
                let middles = start.shape.points(samples).map(|point| start.state(point));
                let corners = middles.flat_map(|State { q, v }| lozenges.corners([q, v]));
                corners.map(|[q, v]| State { q, v }).collect()
            };
            let memory = if lozenges.is_renewed() { Memory::Dropped } else { memory };
            let corners = Course::new(subject, (solver, memory), ticks, points, corners)?;
            Area::Lozenges(corners.around(lozenges))
        };
        let mut cloud = Self { course, area, start, spread: 0.0 };
        cloud.spread = cloud.distance().unwrap_or(0.0);
        Ok(cloud)
    }

    /// Returns the same cloud, which from now on stores states so that it can go back.
    pub fn rewindable(self) -> Self {
        let area = match self.area {
            Area::Lozenges(corners) => Area::Lozenges(corners.rewindable()),
            Area::Border(border) => Area::Border(border.rewindable()),
        };
        Self { course: self.course.rewindable(), area, ..self }
    }

    /// Steps all points forward.
    pub fn advance(&mut self, ticks: u64) {
        self.go_to(self.tick() + ticks);
    }

    /// Steps all points to a tick. Only a [rewindable](Self::rewindable) cloud can return to an earlier tick, where
    /// its states are the same to the bit.
    pub fn go_to(&mut self, tick: u64) {
        self.course.go_to(tick);
        match &mut self.area {
            Area::Lozenges(corners) => corners.go_to(tick),
            Area::Border(border) => border.go_to(tick),
        }
    }

    /// Returns the current tick.
    pub fn tick(&self) -> u64 {
        self.course.tick()
    }

    /// Returns the coordinates of the points.
    pub fn q(&self) -> &[f64] {
        self.course.q()
    }

    /// Returns the velocities of the points.
    pub fn v(&self) -> &[f64] {
        self.course.v()
    }

    /// Describes in words how the area is measured.
    pub fn measured_in_words(&self) -> String {
        match &self.area {
            Area::Border(_) => "measured by its border".into(),
            Area::Lozenges(corners) => match corners.areas().len() {
                1 => "measured at the middle".into(),
                samples => format!("measured around {samples} points"),
            },
        }
    }

    /// Measures the cloud at its current tick.
    pub fn measure(&self) -> CloudMeasure {
        let area_ratio = self.area_ratio();
        let mut hash = Fnv::default();
        for &number in self.q().iter().chain(self.v()) {
            // The bits of a NaN depend on the processor.
            hash.number(if number.is_nan() { f64::NAN } else { number });
        }
        let spread = self.distance().map(|distance| distance / self.spread);
        CloudMeasure { points: self.points_left(), area_ratio, spread, hash: hash.0 }
    }

    /// Returns the number of points left. The other points blew up.
    pub fn points_left(&self) -> usize {
        self.present().count()
    }

    /// Returns the area relative to the start; `None` if no point is left, or if the cloud is too fine, folded or torn
    /// to measure.
    pub fn area_ratio(&self) -> Option<f64> {
        self.present().next()?;
        match &self.area {
            Area::Border(border) => border.area_ratio(),
            Area::Lozenges(corners) => {
                let all = corners.areas();
                let areas: Vec<f64> = all.iter().copied().flatten().collect();
                let [mean, error] = mean_and_error(&areas);
                let is_known = 2 * areas.len() >= all.len() && error <= UNEVEN * mean;
                is_known.then_some(mean)
            }
        }
    }

    /// Describes the change of the area in words. `before` yields earlier areas relative to the start, because an area
    /// that is recovering has no rate.
    pub fn in_words(
        &self,
        area_ratio: Option<f64>,
        before: impl IntoIterator<Item = f64>,
    ) -> String {
        let Some(ratio) = area_ratio else {
            let is_lost = self.present().next().is_none();
            return if is_lost { "is lost" } else { "is too fine, folded or torn to measure" }
                .into();
        };
        let seconds = self.course.t() - self.start.t;
        let far = |area: f64| libm::log(area).abs();
        let farthest = before.into_iter().max_by(|&a, &b| far(a).total_cmp(&far(b)));
        if let Some(area) = farthest.filter(|&area| far(area) > BACK * far(ratio) + LITTLE_BACK) {
            return format!("was ×{} before", significant(area, 3));
        }
        let change = libm::log(ratio);
        let time = || super::duration(seconds * std::f64::consts::LN_2 / change.abs());
        match change {
            _ if seconds == 0.0 => "is what it was".into(),
            _ if change.abs() <= self.unknown() => "keeps area".into(),
            _ if change.abs() < SLIGHT => {
                let word = if change > 0.0 { "gains" } else { "loses" };
                format!("{word} {} %", significant(100.0 * (ratio - 1.0).abs(), 2))
            }
            _ if change > 0.0 => format!("grows ×2 in {}", time()),
            _ if change.is_finite() => format!("shrinks ×½ in {}", time()),
            _ => "shrinks to nothing".into(),
        }
    }

    /// Returns the log change of the area below which the change may be a measurement error.
    fn unknown(&self) -> f64 {
        match &self.area {
            Area::Border(_) => UNKNOWN_BY_BORDER,
            Area::Lozenges(corners) => {
                let areas: Vec<f64> = corners.areas().iter().copied().flatten().collect();
                let [mean, error] = mean_and_error(&areas);
                UNKNOWN.max(UNKNOWN_ERRORS * error / mean)
            }
        }
    }

    /// Returns the number of points left that lie beyond the axes of a picture.
    pub fn hidden(&self, picture: &Density) -> usize {
        // The margin of an axis may show points that blew up.
        self.points_left().saturating_sub(picture.points())
    }

    /// Returns the number of points left that lie on each side of a view: left, right, below and above. A point counts
    /// for the side on which it is furthest beyond the view.
    pub fn beyond(&self, view: PlaneView) -> [usize; 4] {
        let mut beyond = [0; 4];
        for [q, v] in self.present() {
            let [x, y] = view.place(q, v);
            let sides = [-x, x - 1.0, -y, y - 1.0];
            let (side, by) = sides
                .into_iter()
                .enumerate()
                .fold((0, f64::MIN), |most, side| if side.1 > most.1 { side } else { most });
            beyond[side] += usize::from(by > 0.0);
        }
        beyond
    }

    /// Returns the points that have not blown up.
    fn present(&self) -> impl Iterator<Item = [f64; 2]> {
        let is_there = |state: &[f64; 2]| state.iter().all(|number| number.abs() <= ESCAPE);
        self.q().iter().zip(self.v()).map(|(&q, &v)| [q, v]).filter(is_there)
    }

    /// Returns the RMS distance of the points from their middle, in units of the half-width, or straight through the
    /// sphere; `None` if there are no points.
    fn distance(&self) -> Option<f64> {
        let CloudStart { reach, is_on_sphere, .. } = self.start;
        let places = || {
            self.present().map(move |[q, v]| match is_on_sphere {
                true => on_sphere([q, v]),
                false => [q / reach[0], v / reach[1], 0.0],
            })
        };
        let count = places().count() as f64;
        let add = |sum: [f64; 3], place: [f64; 3]| [0, 1, 2].map(|i| sum[i] + place[i]);
        let middle = places().fold([0.0; 3], add).map(|sum| sum / count);
        let square = |place: [f64; 3]| {
            let [x, y, z] = [0, 1, 2].map(|i| place[i] - middle[i]);
            x * x + y * y + z * z
        };
        (count > 0.0).then(|| (places().map(square).sum::<f64>() / count).sqrt())
    }
}

/// Returns the place on a sphere of radius 1 of an angle in radians about an axis and the part along it.
fn on_sphere([angle, part]: [f64; 2]) -> [f64; 3] {
    let across = (1.0 - part * part).max(0.0).sqrt();
    let (sin, cos) = libm::sincos(angle);
    [across * cos, across * sin, part]
}

/// Describes the percentage of points beyond the axes in words; `None` if it is small.
pub fn hidden_in_words(hidden: usize, points: usize) -> Option<String> {
    let part = hidden as f64 / points as f64;
    (part >= HIDDEN).then(|| format!("{} % off the picture", significant(100.0 * part, 2)))
}

/// Returns the mean of areas and the standard error of this mean.
fn mean_and_error(areas: &[f64]) -> [f64; 2] {
    let count = areas.len() as f64;
    let mean = areas.iter().sum::<f64>() / count;
    let squares = areas.iter().map(|area| (area - mean) * (area - mean));
    [mean, (squares.sum::<f64>() / (count * (count - 1.0).max(1.0))).sqrt()]
}

/// Returns the number of sampled points in a cloud of `points`.
fn samples(points: usize) -> usize {
    (points / POINTS_TO_A_SAMPLE).clamp(POINTS_TO_A_SAMPLE / 2, MAX_SAMPLES)
}
