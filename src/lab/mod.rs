//! The experiment: a scene, a clock, lanes racing against the truth, measurements, and the picture
//! they make.
//!
//! This layer knows no GPU, no window, no files and no wall clock: text comes in as `&str`, time as
//! integers, and what comes out is plain data. [`Lab`] holds it all together.

mod command;
pub mod picture;

pub use command::{Binding, Command, KEYS, Key, SPEED_LADDER, TICK_LADDER, command_for};
