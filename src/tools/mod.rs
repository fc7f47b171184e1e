//! A developer's tools. They identify the method behind a log, port a spring to other engines, print a method's
//! source code, and show a game's own lines at every frame rate.

pub mod identify;
pub mod port;
pub mod rule;
pub mod source_code;

pub use identify::identify;
pub use port::port;
pub use rule::Rule;
pub use source_code::source_code;
