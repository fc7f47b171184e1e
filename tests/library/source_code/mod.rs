//! The generated source code matches the methods, step by step, in each language with a compiler.

#![cfg(feature = "lab")]

mod compiled;
mod copying;
mod drivers;
mod gdscript;
mod held;
pub(crate) mod known;
mod scripts;
mod spin;
mod text;
mod words;
