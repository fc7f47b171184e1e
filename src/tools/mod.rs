//! A developer's tools: the method behind a log, a spring's settings in another engine, a method's source code,
//! what a game's own lines do at every frame rate.

pub mod identify;
pub mod port;
pub mod rule;
pub mod source_code;

pub use identify::identify;
pub use port::port;
pub use rule::Rule;
pub use source_code::source_code;
