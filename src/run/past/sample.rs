//! One moment of a body in a history.

use glam::DVec2;

use super::energies::Energies;
use super::swept_range::SweptRange;
use crate::run::METRICS;
use crate::run::race::LaneBody;

/// The most samples shown: every tick of 30 s at 60 Hz, and more than a plot has pixels.
pub const CAPACITY: usize = 2048;

/// One moment of a body.
#[derive(Clone, Debug)]
pub struct Sample {
    /// Time in seconds.
    pub t: f64,
    /// The recorded coordinate.
    pub q: f64,
    /// The range of that coordinate since the sample before.
    pub swept: SweptRange,
    /// Its velocity.
    pub v: f64,
    /// Where the body was, in metres.
    pub at: DVec2,
    /// Its energies, if it conserves energy.
    pub energies: Option<Energies>,
    /// The index of the lane's method on the [menu](super::Menu) at that moment: a trail changes colour at a switch.
    pub entry: usize,
    /// One value for each of [`METRICS`]; NaN where it has no meaning.
    pub metrics: [f64; METRICS.len()],
    /// Whether the body was put here, so that no path leads from the sample before.
    pub jumped: bool,
}

/// Compares bits.
impl PartialEq for Sample {
    fn eq(&self, other: &Self) -> bool {
        let numbers = |s: &Self| [s.t, s.q, s.v, s.at.x, s.at.y].map(f64::to_bits);
        let metrics = |s: &Self| s.metrics.map(f64::to_bits);
        let energies = |s: &Self| s.energies.map(Energies::to_bits);
        numbers(self) == numbers(other)
            && energies(self) == energies(other)
            && metrics(self) == metrics(other)
            && (self.entry, self.jumped, self.swept) == (other.entry, other.jumped, other.swept)
    }
}

impl Sample {
    /// The present of `body`, of its coordinate with this index, in a lane whose method has the index `entry`.
    pub(crate) fn new(
        t: f64,
        entry: usize,
        coordinate: usize,
        [body, truth]: [&LaneBody; 2],
    ) -> Self {
        let (q, v) = (body.stepper.q()[coordinate], body.stepper.v()[coordinate]);
        let metrics =
            std::array::from_fn(|i| (METRICS[i].measure)(body, truth).unwrap_or(f64::NAN));
        let (swept, at) = (SweptRange::at(q), body.stepper.place());
        let energies = Energies::of(&*body.stepper);
        Self { t, q, swept, v, at, energies, entry, metrics, jumped: false }
    }
}
