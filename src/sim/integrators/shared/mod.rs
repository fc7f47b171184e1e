//! What several methods are made of.

pub(super) mod composition;
pub(super) mod seam;
