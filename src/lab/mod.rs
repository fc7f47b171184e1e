//! The experiment: a scene, a clock, lanes racing against the truth, measurements, and the picture
//! they make.
//!
//! This layer knows no GPU, no window, no files and no wall clock: text comes in as `&str`, time as
//! integers, and what comes out is plain data. [`Lab`] holds it all together.

mod clock;
mod command;
mod history;
#[expect(clippy::module_inception, reason = "the lab is what this layer is about")]
mod lab;
mod lane;
mod metrics;
pub mod picture;
mod race;
mod scene;

pub use crate::sim::StepperExports as _;
