//! Building blocks shared by several methods.

pub(super) mod composition;
pub(super) mod embedded_pair;
pub(super) mod jacobian;
mod krylov;
pub(super) mod last_step;
pub(super) mod linear_flow;
pub(super) mod linearisation;
mod lu;
pub(super) mod newton;
mod slopes;
pub(super) mod stages;
pub(super) mod step_size;
