//! Building blocks shared by several methods.

pub(super) mod composition;
pub(super) mod embedded_pair;
pub(super) mod jacobian;
pub(super) mod last_step;
pub(super) mod linear_flow;
pub(super) mod linear_solve;
mod lu;
pub(super) mod newton;
pub(super) mod slopes;
pub(super) mod step_size;
