//! One moment of a body in a history.

use glam::DVec2;

use crate::race::LaneBody;
use crate::sim::Stepper;
use crate::sim::bodies::Tumble;
use crate::{METRICS, MenuIndex};

/// Maximum number of displayed samples, which is enough for every tick of 30 s at 60 Hz, and more than a plot has
/// pixels.
pub const CAPACITY: usize = 2048;

/// One moment of a body.
#[derive(Clone, Debug)]
pub struct Sample {
    /// Time in seconds.
    pub t: f64,
    /// The recorded coordinate.
    pub q: f64,
    /// Range of the recorded coordinate since the previous sample.
    pub swept: SweptRange,
    /// Velocity of the recorded coordinate.
    pub v: f64,
    /// Place of the body, in metres.
    pub at: DVec2,
    /// Energies, if the body conserves energy.
    pub energies: Option<Energies>,
    /// Index of the lane's method on the [menu](super::Menu) at that moment. A trail changes colour at a switch.
    pub entry: MenuIndex,
    /// The [pole](Tumble::pole) of a body that turns in space; NaN for others.
    pub pole: [f64; 2],
    /// Values of all [`METRICS`]; NaN if undefined.
    pub metrics: [f64; METRICS.len()],
    /// Whether the body was placed at this moment, so that no path leads from the previous sample.
    pub jumped: bool,
}

/// Compares the bits of all numbers.
impl PartialEq for Sample {
    fn eq(&self, other: &Self) -> bool {
        let numbers =
            |s: &Self| [s.t, s.q, s.v, s.at.x, s.at.y, s.pole[0], s.pole[1]].map(f64::to_bits);
        let metrics = |s: &Self| s.metrics.map(f64::to_bits);
        let energies = |s: &Self| s.energies.map(Energies::to_bits);
        numbers(self) == numbers(other)
            && energies(self) == energies(other)
            && metrics(self) == metrics(other)
            && (self.entry, self.jumped, self.swept) == (other.entry, other.jumped, other.swept)
    }
}

impl Sample {
    /// Creates a sample of the present of `body` and of its coordinate with this index, in a lane whose method has the
    /// menu index `entry`.
    pub(crate) fn new(
        t: f64,
        entry: MenuIndex,
        coordinate: usize,
        [body, truth]: [&LaneBody; 2],
    ) -> Self {
        let (q, v) = (body.stepper.q()[coordinate], body.stepper.v()[coordinate]);
        let metrics =
            std::array::from_fn(|i| (METRICS[i].measure)(body, truth).unwrap_or(f64::NAN));
        let (swept, at) = (SweptRange::at(q), body.stepper.place());
        let energies = Energies::of(&*body.stepper);
        let tumble = body.stepper.body().downcast_ref::<Tumble>();
        let pole = tumble.map_or([f64::NAN; 2], |tumble| tumble.pole(body.stepper.v()));
        Self { t, q, swept, v, at, energies, entry, pole, metrics, jumped: false }
    }
}

/// The energies of a body that conserves energy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Energies {
    /// Kinetic energy in joules.
    pub kinetic_j: f64,
    /// Total energy in joules.
    pub total_j: f64,
}

impl Energies {
    /// Returns the body's present energies; `None` if the body conserves no energy. Never allocates.
    pub fn of(body: &dyn Stepper) -> Option<Self> {
        Some(Self { kinetic_j: body.kinetic_energy()?, total_j: body.energy()? })
    }

    /// Returns the potential energy in joules.
    pub fn potential_j(self) -> f64 {
        self.total_j - self.kinetic_j
    }

    pub(super) fn to_bits(self) -> [u64; 2] {
        [self.kinetic_j, self.total_j].map(f64::to_bits)
    }
}

/// Smallest and largest value of a coordinate since the previous sample.
#[derive(Clone, Copy, Debug)]
pub struct SweptRange {
    /// Smallest value.
    pub least: f64,
    /// Largest value.
    pub greatest: f64,
}

/// Compares the bits of both numbers.
impl PartialEq for SweptRange {
    fn eq(&self, other: &Self) -> bool {
        let bits = |swept: &Self| [swept.least, swept.greatest].map(f64::to_bits);
        bits(self) == bits(other)
    }
}

impl SweptRange {
    /// The empty range.
    pub(super) const NOTHING: Self = Self { least: f64::INFINITY, greatest: f64::NEG_INFINITY };

    /// Returns the range of one value.
    pub(super) fn at(q: f64) -> Self {
        Self { least: q, greatest: q }
    }

    /// Returns the range extended by `q`.
    pub(super) fn extended_by(self, q: f64) -> Self {
        Self { least: self.least.min(q), greatest: self.greatest.max(q) }
    }

    /// Returns the smallest and the largest value.
    pub fn ends(self) -> [f64; 2] {
        [self.least, self.greatest]
    }
}

/// Consecutive samples of one motion under one method.
#[derive(Clone, Copy, Debug)]
pub struct Summary {
    /// Time (s) of the last sample.
    pub t: f64,
    /// The recorded coordinate at the time of the last sample.
    pub q: f64,
    /// Range of the recorded coordinate since the previous summary.
    pub swept: SweptRange,
    /// Index of the lane's method on the [menu](super::Menu).
    pub entry: MenuIndex,
    /// Whether the body was placed at the first sample, so that no path leads from the previous summary.
    pub jumped: bool,
}

impl Summary {
    /// Returns the summary of one sample.
    pub fn of(sample: &Sample) -> Self {
        let &Sample { t, q, swept, entry, jumped, .. } = sample;
        Self { t, q, swept, entry, jumped }
    }

    /// Joins two summaries if both belong to one motion under one method.
    pub(super) fn joined_with(self, next: Self) -> Option<Self> {
        let is_one = self.entry == next.entry && !next.jumped;
        let ends = next.swept.ends();
        let swept = self.swept.extended_by(ends[0]).extended_by(ends[1]);
        (is_one && self.q.is_finite() && next.q.is_finite()).then_some(Self {
            swept,
            jumped: self.jumped,
            ..next
        })
    }
}
