//! A developer's tools: the method behind a log, a spring's settings in another engine, a method's source code.

pub mod identify;
pub mod port;
pub mod source_code;

pub use identify::identify;
pub use port::port;
pub use source_code::source_code;
