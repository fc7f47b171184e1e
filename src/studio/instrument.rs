//! The instruments beside the stage. The tabs, the keys and the tests follow from one table.

/// An instrument in the panel beside the stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Instrument {
    /// A coordinate of every body, or its velocity, over time.
    Motion,
    /// The chosen metric over time.
    Error,
    /// Kinetic, potential and total energy, and the drift of each lane.
    Energy,
    /// Velocity over coordinate.
    Phase,
    /// The direction of the angular momentum, as seen from a body that turns in space.
    Polhode,
    /// The tick rates and the values of a parameter at which each method is stable.
    StabilityMap,
    /// The anatomy of the selected method's next tick.
    OneStep,
    /// The effect of each method on the area of a cloud of starts.
    Cloud,
    /// Advice on methods and tick rates.
    Advice,
    /// The moments that game loops show, and the timing of this program's own loop.
    Loop,
    /// The cost of a tick in each lane.
    Cost,
}

/// The groups of tabs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InstrumentGroup {
    /// Instruments that show the run.
    See,
    /// Instruments that explain the run.
    Why,
    /// Instruments that suggest a remedy.
    Do,
}

/// An entry in the table of instruments.
#[derive(Debug)]
pub struct InstrumentCard {
    /// The instrument.
    pub instrument: Instrument,
    /// Group in which the instrument's tab is.
    pub group: InstrumentGroup,
    /// Text of the instrument's tab.
    pub name: &'static str,
    /// Description of what the instrument measures, and how to read it.
    pub about: &'static str,
}

use super::step::Step;
use crate::scene::{Scene, SceneBody};
use crate::sim::BodyClass;
use InstrumentGroup::{Do, See, Why};

/// Every instrument, in the order of the tabs.
pub static INSTRUMENTS: &[InstrumentCard] = &[
    InstrumentCard {
        instrument: Instrument::Motion,
        group: See,
        name: "Motion",
        about: "Where every body is over time. A method that follows the exact curve is right; one that swings wider \
                and wider grows, one that slides sideways is early or late.",
    },
    InstrumentCard {
        instrument: Instrument::Error,
        group: See,
        name: "Error",
        about: "How far each method is from the exact solution, on a logarithmic scale: one mark up is a larger error by \
                a power of ten. A straight climb is exponential growth.",
    },
    InstrumentCard {
        instrument: Instrument::Energy,
        group: See,
        name: "Energy",
        about: "Kinetic, potential and total energy, and the energy each method has gained or lost. The exact total is \
                a level line.",
    },
    InstrumentCard {
        instrument: Instrument::Phase,
        group: See,
        name: "Phase",
        about: "Velocity against position. A motion that repeats is a closed loop; a spiral outwards gains energy, a \
                spiral inwards loses it.",
    },
    InstrumentCard {
        instrument: Instrument::Polhode,
        group: See,
        name: "Polhode",
        about: "Where the angular momentum L points, as seen from a body that turns in space along its middle axis. In truth \
                it goes to and fro on the white curve; the thin lines part the turns about one axis from those about \
                another. A trail that drifts to them tips the body over.",
    },
    InstrumentCard {
        instrument: Instrument::StabilityMap,
        group: Why,
        name: "Stability map",
        about: "Where each method is bounded: tick rates across, a parameter of the body up. Drag the cross to change \
                both values.",
    },
    InstrumentCard {
        instrument: Instrument::OneStep,
        group: Why,
        name: "One step",
        about: "The next tick of the selected method: where it evaluates the force, the slope it finds there, where \
                it lands, and where the exact solution lands.",
    },
    InstrumentCard {
        instrument: Instrument::Cloud,
        group: Why,
        name: "Cloud",
        about: "A shape of very many starts around the body's, stepped by each method: brighter where more points \
                are, the exact cloud outlined. A method keeps their area, grows it or shrinks it. They start again \
                whenever you or the script act on a body; all their ticks use the present method, substeps and tick \
                rate.",
    },
    InstrumentCard {
        instrument: Instrument::Advice,
        group: Do,
        name: "Advice",
        about: "Which method meets which demand at this tick rate, and how many evaluations per second it takes.",
    },
    InstrumentCard {
        instrument: Instrument::Loop,
        group: Do,
        name: "Loop",
        about: "In the loop lab, the moments that each game loop shows against the moments of display: a level step is a \
                repeated frame. Elsewhere, the frame times and ticks of this window's own loop.",
    },
    InstrumentCard {
        instrument: Instrument::Cost,
        group: Do,
        name: "Cost",
        about: "The cost of a tick of each lane: evaluations of the force, and in the window their time, also as a \
                share of a frame at 60 Hz.",
    },
];

impl InstrumentGroup {
    /// Every group, from left to right.
    pub const ALL: [InstrumentGroup; 3] = [See, Why, Do];

    /// Returns the word before the group's tabs.
    pub fn name(self) -> &'static str {
        match self {
            See => "See",
            Why => "Why",
            Do => "Do",
        }
    }
}

impl Instrument {
    /// Returns every instrument, in the order of the tabs.
    pub fn all() -> impl DoubleEndedIterator<Item = Instrument> + Clone {
        INSTRUMENTS.iter().map(|card| card.instrument)
    }

    /// Returns the instrument's entry in the table.
    pub fn card(self) -> &'static InstrumentCard {
        let card = INSTRUMENTS.iter().find(|card| card.instrument == self);
        card.expect("every instrument has a line in the table")
    }

    /// Returns the text of the instrument's tab.
    pub fn name(self) -> &'static str {
        self.card().name
    }

    /// Returns the instrument's name on the command line and in file names.
    pub fn id(self) -> String {
        self.name().to_lowercase().replace(' ', "-")
    }

    /// Returns the instrument with this [id](Self::id).
    pub fn of_id(id: &str) -> Option<Self> {
        Self::all().find(|instrument| instrument.id() == id)
    }

    /// Whether the loop lab has the instrument. The loops there have different motions, but share one method.
    pub fn is_in_loop_lab(self) -> bool {
        match self {
            Self::Motion | Self::Error | Self::Energy | Self::Phase | Self::Loop => true,
            Self::Cost
            | Self::Polhode
            | Self::StabilityMap
            | Self::OneStep
            | Self::Cloud
            | Self::Advice => false,
        }
    }

    /// Whether the instrument has something to show in a scene.
    pub fn is_of(self, scene: &Scene) -> bool {
        let turns = |body: &SceneBody| body.kind.class == BodyClass::Spin;
        self != Self::Polhode || scene.bodies.iter().any(turns)
    }

    /// Returns the instrument of the next or previous tab, cyclically.
    pub(super) fn neighbour(self, step: Step) -> Self {
        let index = Self::all().position(|instrument| instrument == self).unwrap_or(0);
        INSTRUMENTS[step.cyclic_index(index, INSTRUMENTS.len())].instrument
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn instruments_are_contiguous_by_group_and_described() {
        let mut groups: Vec<InstrumentGroup> = INSTRUMENTS.iter().map(|card| card.group).collect();
        groups.dedup();
        assert_eq!(groups, InstrumentGroup::ALL);
        for card in INSTRUMENTS {
            assert!(card.about.len() > 40 && card.about.ends_with('.'), "{}", card.name);
            assert_eq!(card.instrument.name(), card.name);
        }
    }

    #[test]
    fn next_and_previous_wrap_around() {
        let mut instrument = Instrument::Motion;
        for _ in INSTRUMENTS {
            assert_eq!(instrument.neighbour(Step::Next).neighbour(Step::Previous), instrument);
            instrument = instrument.neighbour(Step::Next);
        }
        assert_eq!(instrument, Instrument::Motion);
        assert_eq!(Instrument::Motion.neighbour(Step::Previous), Instrument::Cost);
    }
}
