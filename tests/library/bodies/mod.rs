//! Bodies with several coordinates or without a closed form: their flows and equations, their conserved
//! quantities, and the accuracy of the reference.
//!
//! Other suites rely on the truth of a body. If this one fails, trust none of them; bodies of one
//! coordinate with a closed form are in `tests/library/exact_flows.rs`.

mod chain;
mod edits;
mod fifty_digits;
mod flow;
mod follow;
mod helm;
mod orbit;
mod reference;
mod tumble;
