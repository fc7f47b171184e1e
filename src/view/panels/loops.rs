//! The instrument of loops.

use egui::{Ui, Vec2};

use crate::lab::{Command, Lab};

/// Shows what each loop of the loop lab shows, or what the window's own loop does.
pub(super) fn show(_ui: &mut Ui, _lab: &Lab, _room: Vec2, _commands: &mut Vec<Command>) {}
