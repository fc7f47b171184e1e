//! Requests for clouds, and their results.

use std::sync::Arc;

use super::{CloudShape, Density, NoCloud, PlaneView, USUAL_POINTS};
use crate::run::race::Interventions;
use crate::scene::{LaneSpec, Scene};
use crate::sim::TickRate;
use crate::sim::integrators::steps_in_blocks;

/// Numbers of points that a person can choose.
pub const POINTS: [usize; 3] = [10_000, USUAL_POINTS, 1_000_000];

/// Maximum number of lanes with a cloud.
pub const MAX_CLOUDS: usize = 9;

/// Number of cells of a density image in each direction, which is more than a cloud has pixels in most windows.
pub(super) const GRID: usize = 512;

/// Cost of stepping a single copy, relative to the cost of a copy in a block.
const ALONE: u64 = 30;

/// A person's choice of clouds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CloudChoice {
    /// The shape of the starts.
    pub shape: CloudShape,
    /// Number of points.
    pub points: usize,
}

impl Default for CloudChoice {
    fn default() -> Self {
        Self { shape: CloudShape::default(), points: USUAL_POINTS }
    }
}

/// The clouds that a studio requests.
#[derive(Clone, Debug)]
pub struct CloudRequest {
    /// The scene, with the parameters of its bodies.
    pub scene: Arc<Scene>,
    /// Edits to the run.
    pub changes: Interventions,
    /// Index of the body in the scene.
    pub body: usize,
    /// The lanes, by their indices in the list.
    pub lanes: Vec<(usize, LaneSpec)>,
    /// Tick rate of the clouds.
    pub tick_hz: TickRate,
    /// The shape and the number of points.
    pub choice: CloudChoice,
    /// Ticks since the clouds started.
    pub tick: u64,
    /// Whether the run plays in real time, so that the clouds have to keep up.
    pub in_time: bool,
}

impl CloudRequest {
    /// Whether both requests are for the same run of clouds, at any tick.
    pub fn is_alike(&self, other: &Self) -> bool {
        self.is_of_one_run(other) && self.choice.points == other.choice.points
    }

    /// Whether both requests are for the same run of clouds, at any tick and with any number of points.
    pub fn is_of_one_run(&self, other: &Self) -> bool {
        self.is_of_one_picture(other)
            && self.changes == other.changes
            && self.tick_hz == other.tick_hz
    }

    /// Whether both requests are for clouds of the same body under the same methods, in any run of the scene.
    pub fn is_of_one_picture(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.scene, &other.scene)
            && self.body == other.body
            && self.lanes == other.lanes
            && self.choice.shape == other.choice.shape
    }

    /// Returns the tick of the clouds.
    pub fn tick(&self) -> u64 {
        self.tick
    }

    /// Whether the run plays in real time.
    pub fn in_time(&self) -> bool {
        self.in_time
    }

    /// Returns the time of `tick`, counted from the start of the clouds, in seconds of the run.
    fn time_s(&self, tick: u64) -> f64 {
        self.changes.starts_at_s() + self.tick_hz.seconds(tick)
    }

    /// Returns the time of a picture in the run, in seconds.
    pub fn t_s(&self, picture: &CloudPicture) -> f64 {
        self.time_s(picture.tick)
    }

    /// Returns the time between a picture of this request and `now`, in seconds of the run.
    pub fn behind_s(&self, picture: &CloudPicture, now: &Self) -> f64 {
        (now.time_s(now.tick) - self.t_s(picture)).abs()
    }
}

/// Result of a [`CloudRequest`], which is the clouds, or the reason why there are none.
#[derive(Clone, Debug)]
pub struct FoundCloud {
    /// The request.
    pub request: Arc<CloudRequest>,
    /// Clouds at some tick. The last result for a request is at the requested tick.
    pub picture: Result<CloudPicture, NoCloud>,
}

/// The clouds of all lanes at a tick.
#[derive(Clone, Debug)]
pub struct CloudPicture {
    /// Ticks since the start of the clouds.
    pub tick: u64,
    /// Number of points per cloud, which is less than the chosen number if the clouds fell behind.
    pub points: usize,
    /// The part of the plane in the density images.
    pub view: PlaneView,
    /// Border of the exact cloud.
    pub border: Vec<Vec<[f64; 2]>>,
    /// Times in seconds and areas of the exact cloud relative to the start, at the moments at which these are known.
    pub exact: Vec<[f64; 2]>,
    /// The clouds of the lanes, in the order of the lanes.
    pub lanes: Vec<LaneCloud>,
}

/// The cloud of a lane.
#[derive(Clone, Debug)]
pub struct LaneCloud {
    /// Index of the lane's method in the list.
    pub entry: usize,
    /// The number of the cloud's points on each pixel.
    pub density: Arc<Density>,
    /// Number of points that blew up and are left out.
    pub lost: usize,
    /// Number of remaining points beyond the axes.
    pub hidden: usize,
    /// Number of the `hidden` points on each side: left, right, below, above.
    pub beyond: [usize; 4],
    /// Area relative to the start, as [`crate::cloud::Cloud::area_ratio`] returns it.
    pub area_ratio: Option<f64>,
    /// The change of the area, in words.
    pub words: String,
    /// Description of how the area is measured.
    pub measured: String,
    /// Times in seconds and areas of the cloud relative to the start, up to now.
    pub areas: Vec<[f64; 2]>,
}

/// Returns the cost of a point's tick, in evaluations of a copy in a block.
pub(super) fn cost(spec: &LaneSpec) -> u64 {
    let evaluations = u64::from(spec.method.evaluations.unwrap_or(2)).max(1);
    let alone = if steps_in_blocks(spec.method) { 1 } else { ALONE };
    evaluations * u64::from(spec.substeps) * alone
}
