//! What a person looks at: nothing here touches a run, and no run remembers it.

use super::analysis::{Advice, Findings, Verdict};
use super::display::{Display, Instrument, Interpolation, Pace};
use super::held::Held;
use super::lane_spec::LaneSpec;

/// What is open over everything else.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Dialog {
    /// A field for the path of a scene file.
    Path,
    /// What is wrong with a scene file.
    Mistakes {
        /// The file.
        file: String,
        /// What is wrong with it, and where.
        report: String,
    },
}

/// How a run is looked at, and what there is to read beside it.
#[derive(Clone, Debug)]
pub struct Viewer {
    /// What is shown, and how.
    pub display: Display,
    /// The number of the lane selected in a race: it stays selected, whatever method it is put under.
    pub(super) selected: usize,
    /// How fast the driver goes while time runs; `None` where there is no real time, as in a capture.
    pub pace: Option<Pace>,
    /// The latest thing worth telling, such as a screenshot's file name.
    pub notice: Option<String>,
    pub(super) findings: Option<Findings>,
    /// What lanes were under before they were given equal cost, while they have it.
    pub(super) before_equal_cost: Option<Vec<LaneSpec>>,
    /// The body in hand.
    pub(super) held: Option<Held>,
    pub(super) dialog: Option<Dialog>,
    pub(super) typed_path: String,
}

impl Viewer {
    /// A viewer who has selected the lane of this number.
    pub(super) fn new(selected: usize) -> Self {
        Self {
            display: Display {
                ghost: true,
                interpolation: Interpolation::Hermite,
                instrument: Instrument::Metric(0),
                body: 0,
                help: false,
                inspector: false,
                motion: true,
                lenses: Vec::new(),
            },
            selected,
            pace: None,
            notice: None,
            findings: None,
            before_equal_cost: None,
            held: None,
            dialog: None,
            typed_path: String::new(),
        }
    }

    /// What is open over everything else.
    pub fn dialog(&self) -> Option<&Dialog> {
        self.dialog.as_ref()
    }

    /// The path as far as it is typed.
    pub fn typed_path(&self) -> &str {
        &self.typed_path
    }

    /// The body in hand, if one is.
    pub fn held(&self) -> Option<&Held> {
        self.held.as_ref()
    }

    /// What is to be said of the method on this place of the list, over the scene from its start at the
    /// present tick rate and throttle; `None` until it was [learnt](super::Lab::learn).
    pub fn verdict(&self, entry: usize) -> Option<&Verdict> {
        self.findings.as_ref()?.verdicts.get(entry)?.as_ref()
    }

    /// What is known of every method on this scene, as far as it was [learnt](super::Lab::learn) and is shown.
    pub fn advice(&self) -> Option<&Advice> {
        self.findings.as_ref()?.advice.as_ref()
    }

    /// Shows the next way of drawing between ticks, and tells its name.
    pub(super) fn next_interpolation(&mut self) {
        self.display.interpolation = match self.display.interpolation {
            Interpolation::Raw => Interpolation::Linear,
            Interpolation::Linear => Interpolation::Hermite,
            Interpolation::Hermite => Interpolation::Raw,
        };
        let name = self.display.interpolation.name();
        self.notice = Some(format!("drawing between ticks: {name}"));
    }

    /// Shows the next instrument, round.
    pub(super) fn next_instrument(&mut self) {
        let mut after = Instrument::all().skip_while(|i| *i != self.display.instrument);
        self.display.instrument = after.nth(1).unwrap_or(Instrument::Metric(0));
    }
}
