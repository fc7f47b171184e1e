//! Every field of every method's card, measured both ways.
//!
//! Each test loops over `METHODS`: a new method is held to its own card without a line here. What a
//! result is compared with is the exact flow, which `tests/exact_flows.rs` has checked before.

mod abouts;
mod adaptive;
mod cards;
mod cost;
mod followers;
mod geometry;
mod implicit;
mod limits;
mod long_run;
mod memory;
mod order;
mod stability;
mod systems;
mod vectors;
