//! Imports for the file of a body, for its card, its parameters, and the traits that it implements.

pub(super) use glam::DVec2;

pub(super) use super::kind::{Coordinate, Kind};
pub(super) use crate::body::{Body, Input};
pub(super) use crate::parameter::{Fault, ParameterOf, Range};
pub(super) use crate::state::State;
pub(super) use crate::system::{BodyClass, Coupling, Pursuit, Query, System};
