//! The cells of a picture, for a pointer over them: what can be taken hold of, and where in its world a hand is.

use glam::DVec2;

use super::Rect;
use super::sketch::Camera;
use crate::look::{Look, Pull};
use crate::scene::LaneId;
use crate::studio::{HeldBody, Studio};

/// How close to the middle of a small handle a hand can take hold of it, in points: as close as people aim.
const MIN_RADIUS: f32 = 14.0;

/// One body's cell of one lane.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// Where it is.
    pub rect: Rect,
    /// The lane in front.
    pub lane: LaneId,
    /// The place of the lane's method on the list.
    pub entry: usize,
    /// The body's index in the scene.
    pub body: usize,
    /// The body whose zoom and pan it is seen with, by its index in the scene: with those on one ruler that of the first.
    pub zoomed_as: usize,
    /// The bodies that can be taken hold of, with their coordinates as they are drawn.
    pub(super) seen: Vec<(Whose, Vec<f64>)>,
    pub(super) camera: Camera,
}

/// Where a body can be taken hold of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grip {
    /// The middle of what is taken hold of, in points.
    pub at: [f32; 2],
    /// How far from there a hand takes hold of it, in points.
    pub radius: f32,
    /// Its place among the body's handles.
    pub handle: usize,
    /// Whose body it is.
    pub whose: Whose,
}

/// Whose body is seen in a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Whose {
    /// A lane's.
    Lane {
        /// Which.
        lane: LaneId,
        /// The place of its method on the list.
        entry: usize,
    },
    /// The truth's: a ghost.
    Truth,
}

impl Cell {
    /// Where the bodies can be taken hold of.
    pub fn grips(&self, studio: &Studio) -> impl Iterator<Item = Grip> {
        let look = Look::of(&studio.race().truth().bodies()[self.body]);
        let is_recorder = self.camera.quay_m != 0.0;
        let least = if is_recorder { MIN_RADIUS.max(self.camera.block / 2.0) } else { MIN_RADIUS };
        self.seen.iter().flat_map(move |(whose, q)| {
            look.handles(q).into_iter().enumerate().map(move |(handle, part)| {
                let radius = self.camera.size(part.radius).max(least);
                Grip { at: self.camera.points(part.at), radius, handle, whose: *whose }
            })
        })
    }

    /// What a hand at this point of the stage takes hold of: of what it touches the nearest, another lane's body or a
    /// ghost only where that of the cell's own lane is out of reach.
    pub fn grip_at(&self, studio: &Studio, at: [f32; 2]) -> Option<Grip> {
        if !self.rect.contains(at) {
            return None;
        }
        let away = |grip: &Grip| libm::hypotf(grip.at[0] - at[0], grip.at[1] - at[1]);
        let rank = |grip: &Grip| match grip.whose {
            Whose::Lane { lane, .. } if lane == self.lane => 0,
            Whose::Lane { .. } => 1,
            Whose::Truth => 2,
        };
        let touched = self.grips(studio).filter(|grip| away(grip) <= grip.radius);
        touched.min_by(|a, b| rank(a).cmp(&rank(b)).then(away(a).total_cmp(&away(b))))
    }

    /// Where a point of the stage is in the body's world, in metres.
    pub fn metres(&self, at: [f32; 2]) -> DVec2 {
        self.camera.metres(at)
    }

    /// Where a point of the stage is in the cell: across and down from its middle, in its widths and heights.
    pub fn part(&self, at: [f32; 2]) -> [f64; 2] {
        self.rect.part(at)
    }
}

/// A hand on a body.
#[derive(Clone, Debug)]
pub struct Grasp {
    cell: Cell,
    handle: usize,
    /// From the handle to the hand, in metres.
    offset_m: DVec2,
    held: HeldBody,
}

impl Grasp {
    /// Takes hold of the body in `cell` by `grip`, with the hand at this point of the stage.
    pub fn new(studio: &Studio, cell: &Cell, grip: &Grip, hand: [f32; 2]) -> Option<Self> {
        let race = studio.race();
        let lane = match grip.whose {
            Whose::Lane { lane, .. } => &race.entrant(lane)?.lane,
            Whose::Truth => race.truth(),
        };
        let stepper = &lane.bodies()[cell.body].stepper;
        let (place, hand_m) = (cell.metres(grip.at), cell.metres(hand));
        let mut grasp = Self {
            handle: grip.handle,
            offset_m: hand_m - place,
            held: HeldBody {
                lane: match grip.whose {
                    Whose::Lane { lane, .. } => lane,
                    Whose::Truth => cell.lane,
                },
                body: cell.body,
                q: stepper.q().into(),
                v: stepper.v().into(),
                hand: hand_m,
                handle: place,
            },
            cell: cell.clone(),
        };
        grasp.pull(studio, hand, [0.0; 2]);
        Some(grasp)
    }

    /// Brings the hand to a point of the stage, where it moves with this velocity in points per second of simulated
    /// time, y down.
    pub fn pull(&mut self, studio: &Studio, hand: [f32; 2], velocity: [f64; 2]) {
        let Self { cell, handle, offset_m, held } = self;
        let body = &studio.race().truth().bodies()[cell.body];
        let look = Look::of(body);
        held.hand = cell.metres(hand);
        let velocity = DVec2::new(velocity[0], -velocity[1]) / cell.camera.points_per_metre;
        let pull = Pull { handle: *handle, to: held.hand - *offset_m, velocity };
        look.pull(&mut held.q, &mut held.v, pull);
        held.handle = look.handles(&held.q)[*handle].at;
    }

    /// The body as it is held.
    pub fn held(&self) -> &HeldBody {
        &self.held
    }
}

#[cfg(test)]
mod tests;
