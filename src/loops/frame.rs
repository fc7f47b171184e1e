//! A frame of a game on a display.

/// When a frame began and when its picture was displayed, in nanoseconds from the start of its trace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frame {
    /// When the game began it, which is when it reads the time.
    pub began_ns: i64,
    /// When its picture appeared on the display; `None` if another replaced it before.
    pub displayed_ns: Option<i64>,
}
