//! The generated source code as a text; `tests/tools` compiles and runs it.

#![cfg(feature = "lab")]

mod copying;
mod gdscript;
mod held;
pub(crate) mod known;
mod text;
