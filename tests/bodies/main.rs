//! The bodies of several coordinates and those without a closed form: their flows against their
//! equations, their conserved quantities, and what the reference is worth.
//!
//! Other suites take a body's truth for true. If this one fails, believe none of them; the bodies of one
//! coordinate that have a closed form are in `tests/exact_flows.rs`.

mod chain;
mod edits;
mod fifty_digits;
mod flow;
mod helm;
mod orbit;
mod reference;
