//! The cells of a picture for a pointer: handles that a hand can take, and the hand's place in a body's world.

use glam::DVec2;

use super::sketch::Camera;
use super::{Rect, hull};
use crate::look::{Look, Pull};
use crate::run::MenuIndex;
use crate::scene::LaneId;
use crate::studio::{HeldBody, PulledBody, Studio, ZoomPan};

/// Least radius (points) of a handle: as close as people aim.
const MIN_RADIUS: f32 = 14.0;

/// By how much a handle of a moving body is larger, in points.
const MOVING: f32 = 16.0;

/// One body's cell of one lane.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// Rectangle on the stage.
    pub rect: Rect,
    /// The lane in front.
    pub lane: LaneId,
    /// Menu index of the lane's method.
    pub entry: MenuIndex,
    /// Index of the body in the scene.
    pub body: usize,
    /// Index in the scene of the body whose zoom and pan apply; bodies on one ruler use those of the first.
    pub zoomed_as: usize,
    /// Bodies that a hand can take, with their coordinates as drawn.
    pub(super) seen: Vec<(Whose, Vec<f64>)>,
    pub(super) camera: Camera,
}

/// A handle of a body on the stage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grip {
    /// Middle of the handle, in points.
    pub at: [f32; 2],
    /// Radius within which a hand takes it, in points.
    pub radius: f32,
    /// Index among the body's handles.
    pub handle: usize,
    /// Owner of the body.
    pub whose: Whose,
}

/// The owner of a body in a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Whose {
    /// A lane.
    Lane {
        /// The lane.
        lane: LaneId,
        /// Menu index of its method.
        entry: MenuIndex,
    },
    /// The truth, whose body is a ghost.
    Truth,
}

impl Cell {
    /// The handles of the bodies in this cell.
    pub fn grips(&self, studio: &Studio) -> impl Iterator<Item = Grip> {
        self.seen.iter().flat_map(move |(whose, q)| self.grips_of(studio, *whose, q))
    }

    fn grips_of(
        &self,
        studio: &Studio,
        whose: Whose,
        q: &[f64],
    ) -> impl Iterator<Item = Grip> + use<> {
        let look = Look::of(&studio.race().truth().bodies()[self.body]);
        let is_recorder = self.camera.quay_m != 0.0;
        let least = if is_recorder { MIN_RADIUS.max(self.camera.block / 2.0) } else { MIN_RADIUS };
        let camera = self.camera;
        look.handles(q).into_iter().enumerate().map(move |(handle, part)| {
            let radius = camera.size(part.radius).max(least);
            Grip { at: camera.points(part.at), radius, handle, whose }
        })
    }

    /// The handle under a hand at this point of the stage: the nearest one that it touches. Another lane's body or a
    /// ghost counts only if the body of the cell's own lane is out of reach.
    pub fn grip_at(&self, studio: &Studio, at: [f32; 2]) -> Option<Grip> {
        self.moving_grip_at(studio, &[], at)
    }

    /// The same while bodies move. `before` are the cells of earlier pictures, the newest first. A lane's handle that
    /// no hand touches is larger, and counts where it was in those pictures and on its way between them.
    pub fn moving_grip_at(&self, studio: &Studio, before: &[&Cell], at: [f32; 2]) -> Option<Grip> {
        if !self.rect.contains(at) {
            return None;
        }
        let mut best: Option<((usize, usize, usize, f32), Grip)> = None;
        for (whose, q) in &self.seen {
            let is_ghost = *whose == Whose::Truth;
            let rank = match whose {
                Whose::Lane { lane, .. } if *lane == self.lane => 0,
                Whose::Lane { .. } => 1,
                Whose::Truth => 2,
            };
            let now: Vec<Grip> = self.grips_of(studio, *whose, q).collect();
            let mut later = now.clone();
            let ages = before.iter().take(if is_ghost { 0 } else { before.len() });
            for (age, cell) in std::iter::once(&self).chain(ages).enumerate() {
                // An earlier picture may be of another scene.
                let is_same =
                    |(of, then): &&(Whose, Vec<f64>)| of == whose && then.len() == q.len();
                let Some((_, q)) = cell.seen.iter().find(is_same) else { break };
                let then: Vec<Grip> = cell.grips_of(studio, *whose, q).collect();
                for ((grip, after), now) in then.iter().zip(&later).zip(&now) {
                    let away = distance(at, [grip.at, after.at]);
                    let is_touched = age == 0 && away <= grip.radius;
                    let is_near = !is_ghost && !before.is_empty() && away <= grip.radius + MOVING;
                    let tier = if is_ghost { 2 } else { usize::from(!is_touched) };
                    let order = (tier, rank, age, away);
                    if (is_touched || is_near) && best.is_none_or(|(least, _)| order < least) {
                        best = Some((order, *now));
                    }
                }
                later = then;
            }
        }
        best.map(|(_, grip)| grip)
    }

    /// The place (m) in the body's world of a point on the stage.
    pub fn metres(&self, at: [f32; 2]) -> DVec2 {
        self.camera.metres(at)
    }

    /// The zoom and the pan of the cell as drawn, which keep the body in view.
    pub fn zoom_pan(&self) -> ZoomPan {
        self.camera.zoom_pan
    }

    /// The greatest factor by which the cell may still be zoomed in: no part of its body that a hand can take, and no
    /// beam of a ship, grows beyond half of the cell. Never below 1.
    pub fn max_zoom_in(&self, studio: &Studio) -> f64 {
        let look = Look::of(&studio.race().truth().bodies()[self.body]);
        let half = |(whose, q): &(Whose, Vec<f64>)| {
            let of_ship = hull::half_height(&look.outline(studio.race().t(), q), &self.camera);
            let grips = self.grips_of(studio, *whose, q).map(|grip| grip.radius);
            if of_ship > 0.0 { of_ship } else { grips.fold(MIN_RADIUS, f32::max) }
        };
        let own = self.seen.iter().filter(|(whose, _)| *whose != Whose::Truth).map(half);
        let [width, height] = self.rect.size();
        (width.min(height) / 4.0 / f64::from(own.fold(MIN_RADIUS, f32::max))).max(1.0)
    }

    /// A point of the stage relative to the cell's middle: across and down, in widths and heights of the cell.
    pub fn part(&self, at: [f32; 2]) -> [f64; 2] {
        self.rect.part(at)
    }
}

/// Distance of a point from the straight line between two places.
fn distance(at: [f32; 2], [from, to]: [[f32; 2]; 2]) -> f32 {
    let ([dx, dy], [x, y]) =
        ([to[0] - from[0], to[1] - from[1]], [at[0] - from[0], at[1] - from[1]]);
    let square = dx * dx + dy * dy;
    let part = if square > 0.0 { ((x * dx + y * dy) / square).clamp(0.0, 1.0) } else { 0.0 };
    libm::hypotf(x - part * dx, y - part * dy)
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
    /// Takes the body in `cell` by `grip`, with the hand at this point of the stage. `None` if the lane has left the
    /// race.
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

    /// Moves the hand to a point of the stage, with this velocity in points per second of simulated time, y down.
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

    /// Follows the camera of the cell, which may move with its body.
    pub fn follow_camera(&mut self, cells: &[Cell]) {
        let is_same = |cell: &&Cell| (cell.body, cell.lane) == (self.cell.body, self.cell.lane);
        if let Some(cell) = cells.iter().find(is_same) {
            self.cell.camera = cell.camera;
        }
    }

    /// The body on a spring to the hand.
    pub fn pulled(&self) -> PulledBody {
        let HeldBody { lane, body, hand, .. } = self.held;
        PulledBody { lane, body, handle: self.handle, to: hand - self.offset_m, hand }
    }

    /// The body in the hand.
    pub fn held(&self) -> &HeldBody {
        &self.held
    }
}

#[cfg(test)]
mod tests;
