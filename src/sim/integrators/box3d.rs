//! Box3D, which makes the soft step of Box2D in space.

use super::box2d::{self, Box2d};
use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "engine-box3d",
    name: "Box3D",
    also: &[],
    about: "the spring of Box2D to the bit: it is solved twice a substep and loses energy as fast",
    engine: Some(Engine {
        bounce: None,
        free_spin: Some(FreeSpin::of(SpinMap::NewtonStep)),
        version: "0.1.0 in box3d-sys 0.1.16",
        logged: Some("2026-11-22"),
        modes: &box2d::OWN,
        ..box2d::ENGINE
    }),
    source: "Box3D 0.1.0 in box3d-sys 0.1.16: solver.c b3IntegrateVelocitiesTask, b3IntegratePositionsTask; \
             distance_joint.c",
    ..box2d::CARD
};

/// Box3D, whose tick follows the [formula](Method::formula) on its card, which is that of Box2D.
#[derive(Clone)]
pub struct Box3d;

impl EngineRule for Box3d {
    fn tick<V: Vector>(tick: EngineTick<'_, V>, q: &mut V, v: &mut V) {
        Box2d::tick(tick, q, v);
    }
}
