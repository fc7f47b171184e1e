//! What a developer may require of a method.

/// A requirement that a developer may have of a method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Criterion {
    /// Nothing grows that does not grow in truth, over the scene and in the long run.
    Bounded,
    /// Amplitude and frequency show no visible error.
    LooksRight,
    /// The state shows no visible error at any moment.
    Accurate,
}

/// Every criterion, from the easiest to the hardest.
pub static CRITERIA: [Criterion; 3] =
    [Criterion::Bounded, Criterion::LooksRight, Criterion::Accurate];

impl Criterion {
    /// Its name in output, in kebab case.
    pub fn id(self) -> &'static str {
        match self {
            Criterion::Bounded => "bounded",
            Criterion::LooksRight => "looks-right",
            Criterion::Accurate => "accurate",
        }
    }

    /// Its name for people.
    pub fn name(self) -> &'static str {
        match self {
            Criterion::Bounded => "bounded",
            Criterion::LooksRight => "looks right",
            Criterion::Accurate => "accurate",
        }
    }

    /// The requirement in one line.
    pub fn about(self) -> &'static str {
        match self {
            Criterion::Bounded => {
                "nothing grows that should not: no mode of a linear body doubles within a year; any other body, followed \
                 for 20 times the scene, neither doubles its swing nor goes on gaining, and one that loses, followed \
                 for up to 2000 times, comes to rest"
            }
            Criterion::LooksRight => {
                "each swing as wide as the truth's, within 5 % of the widest, its peak found between the steps, and the \
                 frequency within 1 %; of several modes the root of all their energies within 5 %, and the frequency of the \
                 one with the most energy; a body that swings less than three times in the scene is followed until it has; \
                 without a swing, within 5 % of the range"
            }
            Criterion::Accurate => {
                "no coordinate or velocity off by more than 1 % of its amplitude"
            }
        }
    }
}
