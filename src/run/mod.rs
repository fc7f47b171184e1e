//! A run: lanes racing against the truth, what was done to them, what is drawn of it, and its text.
//!
//! A [`race`] ticks its lanes and performs the actions of its journal; a [`session`] makes a run of it that can be gone back
//! in. [`past`] holds what is drawn of earlier ticks, [`METRICS`] are read at each of them, a [`trace`] is the table of all,
//! and [`diff`] compares two of those. A [`link`] is a run in an address.

#[cfg(any(feature = "cli", feature = "view"))]
mod csv_row;
pub mod diff;
pub mod link;
mod metrics;
pub mod past;
pub mod race;
pub mod session;
pub mod trace;

#[cfg(any(feature = "cli", feature = "view"))]
pub(crate) use csv_row::csv_row;
pub use metrics::{METRICS, Metric, Scale, Unit, energy_gained_percent};
pub use race::{Follow, Journal, Lane, Race};
pub use session::{Session, Timeline};
