//! Every field of every method's card, measured both ways.
//!
//! Each test loops over `METHODS`: a new method is tested against its card without a line here. Results are compared
//! with the exact flow, which `tests/library/exact_flows.rs` has checked before.

mod abouts;
mod adaptive;
mod cards;
mod claims;
mod cost;
mod followers;
mod impacts;
mod implicit;
pub(crate) mod limits;
mod linearised;
mod long_run;
mod memory;
mod orbit;
pub(crate) mod systems;
mod vectors;
