//! From which width or height on, in points, there is room for what: with less it is left out, or laid out closer.

/// With less than this width or height no panel is laid out.
pub(super) const PANELS: [f32; 2] = [96.0, 64.0];

// Widths of the window.
/// The whole name of the scene, and margins in the control of the modes.
pub(super) const WIDE_PARTS_OF_TOP_BAR: f32 = 360.0;
pub(super) const INSTRUMENTS: f32 = 420.0;
pub(super) const TICK_FORWARD: f32 = 480.0;
pub(super) const KEYS_BESIDE_HINT: f32 = 560.0;
/// With less, methods have several rows where the window is tall.
pub(super) const METHODS_IN_ONE_ROW: f32 = 560.0;
pub(super) const MENUS: f32 = 600.0;
pub(super) const SPRING: f32 = 660.0;
pub(super) const MY_SPRING: f32 = 760.0;
pub(super) const TICK_BACK: f32 = 820.0;
pub(super) const WORDS_IN_TOP_BAR: f32 = 960.0;
pub(super) const PACE: f32 = 1100.0;
/// The menu of traces is in the top bar; else the instrument has it.
pub(super) const MENU_OF_TRACES: f32 = 1180.0;
pub(super) const HELP_IN_TWO_COLUMNS: f32 = 860.0;

/// A dialog keeps to the stage.
pub(super) const DIALOG_ON_STAGE: f32 = 310.0;

// Heights of the window.
pub(super) const TOP_BAR: f32 = 120.0;
pub(super) const FOOTER: f32 = 200.0;
/// A frame of 270 on another page has them below a bar of 28.
pub(super) const LANES: f32 = 240.0;
pub(super) const TIMELINE: f32 = 420.0;
pub(super) const TIMES_OF_TIMELINE: f32 = 560.0;

// Widths of a panel, or of a part of it.
pub(super) const TIME_IN_TOP_BAR: f32 = 48.0;
/// A name at the left of the timeline, and the memory at its right.
pub(super) const WORDS_BESIDE_TIMELINE: f32 = 700.0;
/// Buttons name their keys, and the title stands beside them.
pub(super) const KEYS_OF_GUIDE: f32 = 600.0;
pub(super) const TITLE_OF_LOOP_LAB: f32 = 340.0;
/// A number has four figures and not three, and columns are further apart.
pub(super) const FOUR_FIGURES: f32 = 330.0;
pub(super) const COPY_CODE: f32 = 240.0;
/// The height below the answer of the advice from which on it has code above its table.
pub(super) const CODE: f32 = 230.0;
/// What a plot has left with values beside it.
pub(super) const PLOT_BESIDE_VALUES: f32 = 170.0;
pub(super) const NUMBER_ON_BAR: f32 = 30.0;

// Heights of a panel, or of a part of it.
pub(super) const AREAS_OVER_TIME: f32 = 330.0;
pub(super) const WORDS_OF_MAP: f32 = 260.0;
/// Two small plots below the moments of the loop lab.
pub(super) const TWO_PLOTS_BELOW: f32 = 230.0;
pub(super) const HISTOGRAM: f32 = 210.0;
pub(super) const LEGEND: f32 = 170.0;
/// The map has all lines of equal damping, and not only those at powers of ten.
pub(super) const ALL_LINES_OF_MAP: f32 = 130.0;
