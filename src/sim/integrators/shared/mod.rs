//! What several methods are made of.

pub(super) mod composition;
pub(super) mod embedded_pair;
mod lu;
pub(super) mod newton;
pub(super) mod seam;
pub(super) mod step_size;
pub(super) mod watched;
