//! Building blocks shared by several methods.

pub(super) mod chase;
pub(super) mod composition;
pub(super) mod embedded_pair;
pub(super) mod last_step;
mod lu;
pub(super) mod newton;
pub(super) mod step_size;
