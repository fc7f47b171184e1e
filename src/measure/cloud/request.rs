//! What is asked of clouds, and what comes back.

use std::sync::Arc;

use super::{CloudBody, CloudKind, CloudShape, Density, NoCloud, PlaneView, USUAL_POINTS};
use crate::run::race::Interventions;
use crate::scene::{LaneSpec, Scene};
use crate::sim::TickRate;
use crate::sim::integrators::steps_in_blocks;

/// The points of a cloud that a person can choose.
pub const POINTS: [usize; 3] = [10_000, USUAL_POINTS, 1_000_000];

/// The most lanes that have a cloud.
pub(crate) const MAX_CLOUDS: usize = 9;

/// The cells of a density image, each way: more than a cloud has pixels in most windows.
pub(super) const GRID: usize = 512;

/// What a step of a copy alone costs, in evaluations of one in a block.
const ALONE: u64 = 30;

/// What a person has chosen of the clouds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CloudChoice {
    /// What is shown.
    pub kind: CloudKind,
    /// The points of a cloud of a shape.
    pub points: usize,
}

impl Default for CloudKind {
    fn default() -> Self {
        Self::Shape(CloudShape::default())
    }
}

impl Default for CloudChoice {
    fn default() -> Self {
        Self { kind: CloudKind::default(), points: USUAL_POINTS }
    }
}

/// The clouds that a studio wants.
#[derive(Clone, Debug)]
pub struct CloudRequest {
    pub(crate) scene: Arc<Scene>,
    /// What has changed in the run.
    pub(crate) changes: Interventions,
    /// The body, by its index in the scene.
    pub(crate) body: usize,
    /// The lanes, by their indices on the list.
    pub(crate) lanes: Vec<(usize, LaneSpec)>,
    pub(crate) tick_hz: TickRate,
    pub(crate) choice: CloudChoice,
    /// Ticks since the clouds started.
    pub(crate) tick: u64,
    /// Whether the run goes on in time, so that the clouds have to keep up.
    pub(crate) in_time: bool,
}

/// A request as it is worked on.
#[derive(Clone, Copy)]
pub(super) struct Request<'a> {
    /// At the start.
    pub(super) of: CloudBody<'a>,
    pub(super) lanes: &'a [(usize, LaneSpec)],
    pub(super) tick_hz: TickRate,
    /// The length of the run, in seconds.
    pub(super) seconds: f64,
    /// The time of the start, in seconds.
    pub(super) t: f64,
}

impl CloudRequest {
    /// Whether both are of one run of clouds, at whatever tick.
    pub fn is_alike(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.scene, &other.scene)
            && self.changes == other.changes
            && self.body == other.body
            && self.lanes == other.lanes
            && self.tick_hz == other.tick_hz
            && self.choice == other.choice
    }

    /// The tick of the clouds.
    pub fn tick(&self) -> u64 {
        self.tick
    }

    /// Whether the run goes on in time.
    pub fn in_time(&self) -> bool {
        self.in_time
    }

    /// The time of a picture in the run, in seconds.
    pub fn t_s(&self, picture: &CloudPicture) -> f64 {
        self.changes.starts_at_s() + self.tick_hz.seconds(picture.tick)
    }

    /// How many seconds of the run there are between the request and a picture.
    pub fn behind_s(&self, picture: &CloudPicture) -> f64 {
        self.tick_hz.seconds(self.tick.abs_diff(picture.tick))
    }
}

/// The answer to a [`CloudRequest`]: the clouds, or why there are none.
#[derive(Clone, Debug)]
pub struct FoundCloud {
    /// What they were asked for.
    pub request: Arc<CloudRequest>,
    /// The clouds at some tick, of which the last found is at the one that was asked for.
    pub picture: Result<CloudPicture, NoCloud>,
}

/// The clouds of all lanes at a tick.
#[derive(Clone, Debug)]
pub struct CloudPicture {
    /// Ticks since the start of the clouds; 0 of a section.
    pub tick: u64,
    /// The points of each cloud, fewer than were chosen where these did not keep up; 0 of a section.
    pub points: usize,
    /// Of a section, when its points are taken.
    pub section: Option<String>,
    /// What part of the plane the density images show.
    pub view: PlaneView,
    /// The border of the exact cloud.
    pub border: Vec<Vec<[f64; 2]>>,
    /// The time in seconds and the area of the exact cloud over that at the start, as long as it is known.
    pub exact: Vec<[f64; 2]>,
    /// In the order of the lanes.
    pub lanes: Vec<LaneCloud>,
}

/// The cloud of a lane.
#[derive(Clone, Debug)]
pub struct LaneCloud {
    /// The index of the lane's method on the list.
    pub entry: usize,
    /// Where its points are.
    pub density: Arc<Density>,
    /// How many points blew up and are left out.
    pub lost: usize,
    /// How many of the others are beyond the axes; 0 of a section.
    pub hidden: usize,
    /// The area over that at the start, as [`crate::measure::cloud::Cloud::area_ratio`].
    pub area_ratio: Option<f64>,
    /// What the area has become.
    pub words: String,
    /// How the area is measured.
    pub measured: String,
    /// The time in seconds and the area so far.
    pub areas: Vec<[f64; 2]>,
}

/// What a tick of a point costs, in evaluations of a copy in a block.
pub(super) fn cost(spec: &LaneSpec) -> u64 {
    let evaluations = u64::from(spec.method.evaluations.unwrap_or(2)).max(1);
    let alone = if steps_in_blocks(spec.method) { 1 } else { ALONE };
    evaluations * u64::from(spec.substeps) * alone
}
