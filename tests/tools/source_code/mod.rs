//! The generated source code matches the methods, step by step, in each language with a compiler.

pub(crate) mod compiled;
mod drivers;
#[path = "../../library/source_code/known.rs"]
mod known;
pub(crate) mod scripts;
pub(crate) mod spin;
pub(crate) mod words;
