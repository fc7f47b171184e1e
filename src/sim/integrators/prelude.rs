//! Imports for the file of a method, for its card, its traits, and its vectors.

pub(super) use glam::{DQuat, DVec3};

pub(super) use super::card::{
    ADAPTIVE, AS_PRINTED, BARE, DAMPS_BY_RATE, ENGINE, EXPLICIT, Engine, FIRST_ORDER_FOLLOWER,
    FollowerQuantity, FollowerSetting, GYRO, IMPLICIT, INTERFACE, LINEARISED, Method, RINGS_ON,
    SECOND_ORDER_FOLLOWER, SLOW_GROWTH, STEPS_BACK, SYMPLECTIC, Substeps,
};
pub(super) use super::engine::{EngineRule, EngineTick, cap, each, part_below};
pub(super) use super::engine_bounce::EngineBounce;
pub(super) use super::failure::Stepped;
pub(super) use super::follower::{FollowerRule, lerp};
pub(super) use super::free_spin::{FreeSpin, SpinMap};
pub(super) use super::gyro::{GyroRule, Split, Turned, carried, fixed_point, turned};
pub(super) use super::integrator::{Integrator, Override, Tolerance};
pub(super) use super::joint_mode::{JointMode, mode, newton_mode, si_mode};
pub(super) use super::only::{Needs, Only};
pub(super) use crate::spin::{axes_by_moment, free_acceleration, free_jerk, seen_from, turn_by};
pub(super) use crate::state::{Elementwise, State, Vector};
pub(super) use crate::system::{Coupling, StateOf, System};
