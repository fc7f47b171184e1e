//! Minimum widths and heights, in points, for the elements of the window. An element that lacks room is left out, or
//! laid out closer.

/// No panel appears below this width or height.
pub(super) const PANELS: [f32; 2] = [96.0, 64.0];

// Constants from here on are widths of the window.
/// The top bar has the whole name of the scene, and margins in the control of the modes.
pub(super) const WIDE_PARTS_OF_TOP_BAR: f32 = 360.0;
pub(super) const INSTRUMENTS: f32 = 420.0;
pub(super) const TICK_FORWARD: f32 = 480.0;
pub(super) const KEYS_BESIDE_HINT: f32 = 560.0;
/// Below this width, the methods take several rows if the window is high enough.
pub(super) const METHODS_IN_ONE_ROW: f32 = 560.0;
pub(super) const MENUS: f32 = 600.0;
pub(super) const SPRING: f32 = 660.0;
pub(super) const MY_SPRING: f32 = 760.0;
pub(super) const TICK_BACK: f32 = 820.0;
pub(super) const WORDS_IN_TOP_BAR: f32 = 960.0;
pub(super) const PACE: f32 = 1100.0;
/// From this width on, the menu of traces is in the top bar, and below this width in the instrument.
pub(super) const MENU_OF_TRACES: f32 = 1180.0;
pub(super) const HELP_IN_TWO_COLUMNS: f32 = 860.0;

/// From this width on, a dialog stays on the stage.
pub(super) const DIALOG_ON_STAGE: f32 = 310.0;

// Constants from here on are heights of the window.
pub(super) const TOP_BAR: f32 = 120.0;
pub(super) const FOOTER: f32 = 200.0;
/// An embedded frame 270 points high, with a bar of 28, still has the lanes.
pub(super) const LANES: f32 = 240.0;
pub(super) const TIMELINE: f32 = 420.0;
pub(super) const TIMES_OF_TIMELINE: f32 = 560.0;

/// Minimum width and height of a window that shows the scale of tick rates below the stage, and the height from
/// which on the scale has numbers.
pub(super) const RATE_SCALE: [f32; 2] = [320.0, 300.0];
pub(super) const NUMBERS_OF_RATE_SCALE: f32 = 400.0;

/// Minimum width and height of a stage that shows the button to fit its view.
pub(super) const FIT: [f32; 2] = [160.0, 110.0];

// Constants from here on are widths of a panel, or of a part of it.
pub(super) const TIME_IN_TOP_BAR: f32 = 48.0;
/// The timeline has a name at its left, and the used memory at its right.
pub(super) const WORDS_BESIDE_TIMELINE: f32 = 700.0;
/// The buttons have the names of their keys, and the title is beside them.
pub(super) const KEYS_OF_GUIDE: f32 = 600.0;
pub(super) const TITLE_OF_LOOP_LAB: f32 = 340.0;
/// Numbers have four digits instead of three, and the gaps between columns are wider.
pub(super) const FOUR_FIGURES: f32 = 330.0;
pub(super) const COPY_CODE: f32 = 240.0;
/// Minimum height below the recommendations of the advice for source code above the table.
pub(super) const CODE: f32 = 230.0;
/// Minimum remaining width of a plot that has values beside it.
pub(super) const PLOT_BESIDE_VALUES: f32 = 170.0;
pub(super) const NUMBER_ON_BAR: f32 = 30.0;

// Constants from here on are heights of a panel, or of a part of it.
pub(super) const AREAS_OVER_TIME: f32 = 330.0;
pub(super) const WORDS_OF_MAP: f32 = 260.0;
/// Two small plots appear below the moments of the loop lab.
pub(super) const TWO_PLOTS_BELOW: f32 = 230.0;
pub(super) const HISTOGRAM: f32 = 210.0;
pub(super) const LEGEND: f32 = 170.0;
/// The map has all lines of equal damping, not only those at powers of ten.
pub(super) const ALL_LINES_OF_MAP: f32 = 130.0;
