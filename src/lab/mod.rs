//! The experiment: a scene, a clock, lanes racing against the truth, measurements, and the picture
//! they make.
//!
//! This layer knows no GPU, no window, no files and no wall clock: text comes in as `&str`, time as
//! integers, and what comes out is plain data.
//!
//! What most programs need is here; the rest is in its room. From a scene to what a person sees of it:
//!
//! - A [`scene`] says what is simulated; [`custom`] makes one of a body written in Rust.
//! - A [`race`] ticks its lanes and the truth, a [`session`] makes a run of it that can be gone back in, and the [`past`] is
//!   what is drawn of it.
//! - [`analysis`] judges methods and gives advice, a [`cloud`] shows what a method does to an area, [`pacing`] measures what a
//!   game's loop adds, and the [`loop_lab`] shows all loops side by side.
//! - [`identify`](mod@identify) names the method that made a log, [`port`](mod@port) carries a spring from engine to engine, and
//!   [`source_code`](mod@source_code) is a method to be taken into a game.
//! - A [`studio`] is a person at a run, a [`picture`] what it shows, and a [`palette`] its colours.

mod action;
pub mod analysis;
mod bisection;
pub mod cloud;
mod cloud_shape;
#[cfg(any(feature = "cli", feature = "view"))]
mod csv_row;
pub mod custom;
pub mod diff;
pub mod identify;
mod lane_id;
mod lane_spec;
pub mod link;
mod look;
pub mod loop_lab;
pub mod pacing;
pub mod palette;
pub mod past;
pub mod picture;
pub mod port;
pub mod race;
pub mod scene;
pub mod session;
pub mod source_code;
pub mod studio;
mod time_scale;
pub mod trace;

// What the view, which sees nothing of `sim`, names of it.
#[cfg(feature = "view")]
pub(crate) use crate::sim::{
    bodies::{Acts, Coordinate, Parameter, Range},
    number,
};
pub use action::Action;
pub use analysis::{
    Adviser, CRITERIA, Criterion, Judge, METRICS, Metric, Report, Verdict, advise, try_advise,
};
#[cfg(any(feature = "cli", feature = "view"))]
pub(crate) use csv_row::csv_row;
pub use custom::Options;
pub use identify::identify;
pub use lane_id::LaneId;
pub use lane_spec::{LaneSpec, Swing};
pub use port::port;
pub use race::{Follow, Journal, Lane, Race};
#[cfg(feature = "cli")]
pub(crate) use scene::clip::{clip, cut};
pub use scene::{SCENES, Scene, SceneBody, SceneErrors};
pub use session::{Session, Timeline};
pub use source_code::source_code;
pub use studio::Studio;
