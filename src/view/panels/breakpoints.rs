//! Widths and heights, in points, from which there is room for an element. With less, the element is left out or laid
//! out closer.

/// Below this width or height no panel appears.
pub(super) const PANELS: [f32; 2] = [96.0, 64.0];

// Widths of the window.
/// The whole name of the scene, and margins in the control of the modes.
pub(super) const WIDE_PARTS_OF_TOP_BAR: f32 = 360.0;
pub(super) const INSTRUMENTS: f32 = 420.0;
pub(super) const TICK_FORWARD: f32 = 480.0;
pub(super) const KEYS_BESIDE_HINT: f32 = 560.0;
/// Below this width, the methods take several rows if the window is tall.
pub(super) const METHODS_IN_ONE_ROW: f32 = 560.0;
pub(super) const MENUS: f32 = 600.0;
pub(super) const SPRING: f32 = 660.0;
pub(super) const MY_SPRING: f32 = 760.0;
pub(super) const TICK_BACK: f32 = 820.0;
pub(super) const WORDS_IN_TOP_BAR: f32 = 960.0;
pub(super) const PACE: f32 = 1100.0;
/// From this width, the top bar has the menu of traces; below it, the instrument does.
pub(super) const MENU_OF_TRACES: f32 = 1180.0;
pub(super) const HELP_IN_TWO_COLUMNS: f32 = 860.0;

/// From this width, a dialog stays on the stage.
pub(super) const DIALOG_ON_STAGE: f32 = 310.0;

// Heights of the window.
pub(super) const TOP_BAR: f32 = 120.0;
pub(super) const FOOTER: f32 = 200.0;
/// An embedded frame of 270, with a bar of 28, still has them.
pub(super) const LANES: f32 = 240.0;
pub(super) const TIMELINE: f32 = 420.0;
pub(super) const TIMES_OF_TIMELINE: f32 = 560.0;

/// Width and height of a stage with a scale of tick rates.
pub(super) const RATE_SCALE: [f32; 2] = [320.0, 280.0];

// Widths of a panel, or of a part of it.
pub(super) const TIME_IN_TOP_BAR: f32 = 48.0;
/// A name at the left of the timeline, and the memory at its right.
pub(super) const WORDS_BESIDE_TIMELINE: f32 = 700.0;
/// Room for key names on buttons, with the title beside them.
pub(super) const KEYS_OF_GUIDE: f32 = 600.0;
pub(super) const TITLE_OF_LOOP_LAB: f32 = 340.0;
/// Room for numbers with four digits instead of three, and for wider gaps between columns.
pub(super) const FOUR_FIGURES: f32 = 330.0;
pub(super) const COPY_CODE: f32 = 240.0;
/// Height below the answer of the advice from which code stands above the table.
pub(super) const CODE: f32 = 230.0;
/// Width left for a plot with values beside it.
pub(super) const PLOT_BESIDE_VALUES: f32 = 170.0;
pub(super) const NUMBER_ON_BAR: f32 = 30.0;

// Heights of a panel, or of a part of it.
pub(super) const AREAS_OVER_TIME: f32 = 330.0;
pub(super) const WORDS_OF_MAP: f32 = 260.0;
/// Room for two small plots below the moments of the loop lab.
pub(super) const TWO_PLOTS_BELOW: f32 = 230.0;
pub(super) const HISTOGRAM: f32 = 210.0;
pub(super) const LEGEND: f32 = 170.0;
/// Room for all lines of equal damping on the map, instead of only those at powers of ten.
pub(super) const ALL_LINES_OF_MAP: f32 = 130.0;
