//! The program without its window: the output of its commands, and the content of its frames.
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
#[cfg(target_os = "linux")]
#[path = "../processor/mod.rs"]
mod processor;
