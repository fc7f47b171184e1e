//! Imports for the file of a body, for its card, its parameters, and the traits that it implements.

pub(super) use glam::DVec2;

pub(super) use super::kind::{Coordinate, Kind};
pub(super) use crate::sim::body::{Body, Input};
pub(super) use crate::sim::parameter::{Fault, ParameterOf, Range};
pub(super) use crate::sim::state::State;
pub(super) use crate::sim::system::{BodyClass, Coupling, Pursuit, Query, System};
