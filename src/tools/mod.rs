//! A developer's tools. They identify the method behind a log, port a spring to other engines, print a method's
//! source code, and show a game's own lines at every frame rate.

// The rules of a room: see `src/lib.rs` and clippy.toml.
#![warn(clippy::exit, clippy::print_stderr, clippy::print_stdout)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]
#![warn(clippy::iter_over_hash_type)]

use regatta_scene as scene;
use regatta_sim as sim;
use regatta_table as table;

pub mod identify;
pub mod port;
pub mod rule;
pub mod source_code;

pub use identify::identify;
pub use port::port;
pub use rule::Rule;
pub use source_code::source_code;
