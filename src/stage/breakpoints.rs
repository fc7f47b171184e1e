//! Smallest widths and heights (points) at which the stage shows its elements. With less room it omits them or moves
//! them closer.

// Widths of the stage.
pub(super) const LANE_NAMES: f32 = 520.0;
/// Words beside the bodies of the loop lab.
pub(super) const WORDS_BESIDE_BODIES: f32 = 420.0;
/// The code of a band beside its body rather than below it.
pub(super) const CARD_BESIDE: f32 = 560.0;
pub(super) const METHOD_BESIDE_LOOP: f32 = 620.0;

// Heights of the stage.
pub(super) const RULER: f32 = 260.0;

// Heights of a band.
pub(super) const RULER_OF_BAND: f32 = 110.0;
/// Words at the head of a cell have their usual size.
pub(super) const LOW_BAND: f32 = 125.0;
/// The code of a band below its body.
pub(super) const CARD_BELOW: f32 = 170.0;

// Widths of a cell.
pub(super) const NUMBERS: f32 = 330.0;
/// Distance marks along the bottom.
pub(super) const MARKS: f32 = 330.0;

// Heights of a cell, or of a band of the loop lab.
pub(super) const CHIP: f32 = 90.0;
/// Path of the frames below the body.
pub(super) const PATH: f32 = 90.0;
pub(super) const SCALE_BAR: f32 = 64.0;
pub(super) const LINE_OF_WORDS: f32 = 46.0;

/// Width and height of a stage with the sign of a pause.
pub(super) const PAUSE: [f32; 2] = [160.0, 110.0];
/// Width and height of a cell.
pub(super) const CAPTION: [f32; 2] = [70.0, 30.0];
/// Length of a hull that shows a deck and a house, and of one that shows planks.
pub(super) const DECK: f32 = 22.0;
pub(super) const PLANKS: f32 = 70.0;
