//! The methods as source code do what the methods do, step by step, in each language for which there is a compiler.

#![cfg(feature = "lab")]

mod compiled;
mod copying;
mod drivers;
mod gdscript;
mod held;
mod known;
mod text;
