//! Everything that a game's loop needs, in one import: the [`prelude`](crate::sim::prelude) of `sim`.
//!
//! With the feature `lab` it also has bodies, scenes, races and verdicts. The vectors of the systems are in
//! [`regatta::glam`](crate::glam), because a game may use another version of glam.

pub use crate::sim::prelude::*;
#[cfg(feature = "window")]
pub use crate::window::Window;
#[cfg(feature = "lab")]
pub use crate::{
    measure::{Adviser, CRITERIA, Judge, Report, Verdict},
    run::{Lane, METRICS, Race, Session},
    scene::{LaneSpec, Mark, Options, OptionsError, SCENES, Scene},
    sim::bodies::{BODIES, Extras},
};
