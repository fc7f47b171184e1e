//! The mathematics: a state, an equation of motion, and ways to step the state.
//!
//! This layer has no files, wall clocks or pixels. Threads only share loops, in `batch`, which changes no bit.
//! Everything that is stepped is `f64` and uses only `+ - × ÷ √` and `libm`, so that the same inputs give the same bits
//! on every platform, in every build profile.

// The rules of a room: see `src/lib.rs` and clippy.toml.
#![warn(clippy::exit, clippy::print_stderr, clippy::print_stdout)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]
#![warn(clippy::iter_over_hash_type)]
#![cfg_attr(
    feature = "batch",
    allow(
        clippy::incompatible_msrv,
        reason = "the oldest compiler is for games, without features"
    )
)]
#![cfg_attr(
    not(feature = "lab"),
    allow(
        dead_code,
        unused_imports,
        reason = "bodies and laws use it, which are not compiled here"
    )
)]
// docs.rs marks what needs a feature with its name.
#![cfg_attr(docsrs, feature(doc_cfg))]

#[cfg(feature = "batch")]
pub mod batch;
#[cfg(feature = "lab")]
pub mod bodies;
mod body;
mod body_stepper;
mod bouncer;
mod clock;
#[cfg(feature = "lab")]
pub mod conformance;
mod contact;
mod double_double;
mod exact_flow;
mod exact_since_start;
mod fnv;
mod impact;
mod impact_of_method;
pub mod integrators;
#[cfg(feature = "lab")]
pub mod law;
mod near_wall;
#[cfg(feature = "lab")]
mod net_plan;
pub mod number;
#[cfg(feature = "lab")]
pub mod numerics;
#[cfg(feature = "lab")]
mod own_method;
mod parameter;
pub mod prelude;
mod propagator;
mod reference;
mod spin;
#[cfg(feature = "lab")]
pub mod stability;
mod state;
mod stepper;
mod system;
#[cfg(feature = "lab")]
pub mod text;
mod tick_rate;
mod vec_system;

/// The vectors of the systems, in the version whose bits are promised.
pub use glam;

pub use body::{Body, Distances, Input, MAX_SWITCHES, NO_BOUNDARIES, Piece};
pub use body_stepper::stepper;
pub use clock::{Accumulator, Clock, Due, MAX_FRAME_MS, TickRateError};
pub use fnv::Fnv;
pub use impact::{Bounces, IMPACTS, Impact, Wall, impact, impact_spellings};
pub use parameter::{
    Fault, MAX_POINTS, MAX_VALUE, Parameter, ParameterOf, Range, TakesEffect, Text,
};
pub use reference::{MAX_REFERENCE_WORK, REFERENCE_ACCURACY};
pub use state::{Elementwise, State, Vector};
pub use stepper::{Change, PlacedBody, RecordedTick, Solver, Stepper};
pub use system::{
    BodyClass, Counted, Coupling, EngineSettings, Evaluation, Pursuit, Query, StateOf, System,
};
pub use tick_rate::TickRate;
#[cfg(feature = "lab")]
pub use {
    numerics::{golden_section, least_squares},
    own_method::{
        MAX_OWN_ID_CHARS, OwnLines, check_own_id, linear_rule, own_method, own_method_id, own_rule,
    },
};
