//! The program without its window: what its commands print and write, and what its frames show.
#![cfg(feature = "desktop")]

mod command_line;
#[path = "../dice/mod.rs"]
mod dice;
mod golden;
mod memory;
mod packaging;
#[cfg(unix)]
#[path = "../printed/mod.rs"]
mod printed;
