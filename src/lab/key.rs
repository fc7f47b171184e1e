//! The keys that commands are bound to.

/// A key as this layer knows it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Key {
    /// A digit by its place on the keyboard, so that it works unshifted on every layout.
    Digit(u8),
    /// A lower-case letter or a sign, as the layout gives it.
    Sign(char),
    /// The same letter with Shift held.
    ShiftSign(char),
    /// A letter or a sign with Control held, or with Command on a Mac.
    ControlSign(char),
    /// The space bar.
    Space,
    /// The up arrow.
    Up,
    /// The down arrow.
    Down,
    /// The left arrow.
    Left,
    /// The right arrow.
    Right,
    /// Home.
    Home,
    /// Page Down.
    PageDown,
    /// Enter, or Return.
    Enter,
    /// Escape.
    Escape,
    /// A function key.
    Function(u8),
}
