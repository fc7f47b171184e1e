//! One moment of a body in a history.

use glam::DVec2;

use crate::run::METRICS;
use crate::run::race::LaneBody;
use crate::sim::Stepper;

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

/// The energies of a body that conserves energy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Energies {
    /// The kinetic energy in joules.
    pub kinetic_j: f64,
    /// The total energy in joules.
    pub total_j: f64,
}

impl Energies {
    /// Those of a body now; `None` if it conserves none. Never allocates.
    pub(crate) fn of(body: &dyn Stepper) -> Option<Self> {
        Some(Self { kinetic_j: body.kinetic_energy()?, total_j: body.energy()? })
    }

    /// The potential energy in joules.
    pub fn potential_j(self) -> f64 {
        self.total_j - self.kinetic_j
    }

    pub(super) fn to_bits(self) -> [u64; 2] {
        [self.kinetic_j, self.total_j].map(f64::to_bits)
    }
}

/// The least and the greatest value of a coordinate from the sample before to this sample.
#[derive(Clone, Copy, Debug)]
pub struct SweptRange {
    /// The least value.
    pub least: f64,
    /// The greatest value.
    pub greatest: f64,
}

/// Compares bits.
impl PartialEq for SweptRange {
    fn eq(&self, other: &Self) -> bool {
        let bits = |swept: &Self| [swept.least, swept.greatest].map(f64::to_bits);
        bits(self) == bits(other)
    }
}

impl SweptRange {
    /// The empty range.
    pub(super) const NOTHING: Self = Self { least: f64::INFINITY, greatest: f64::NEG_INFINITY };

    /// The range of one value.
    pub(super) fn at(q: f64) -> Self {
        Self { least: q, greatest: q }
    }

    /// The range extended by `q`.
    pub(super) fn and(self, q: f64) -> Self {
        Self { least: self.least.min(q), greatest: self.greatest.max(q) }
    }

    /// The least and the greatest value.
    pub fn ends(self) -> [f64; 2] {
        [self.least, self.greatest]
    }
}

/// Consecutive samples of one motion under one method.
#[derive(Clone, Copy, Debug)]
pub struct Summary {
    /// The time of the last of them, in seconds.
    pub t: f64,
    /// The recorded coordinate there.
    pub q: f64,
    /// The range of that coordinate since the summary before.
    pub swept: SweptRange,
    /// The index of the lane's method on the [menu](super::Menu).
    pub entry: usize,
    /// Whether the body was put where they begin, so that no path leads from the summary before.
    pub jumped: bool,
}

impl Summary {
    /// A sample alone.
    pub fn of(sample: &Sample) -> Self {
        let &Sample { t, q, swept, entry, jumped, .. } = sample;
        Self { t, q, swept, entry, jumped }
    }

    /// Both, if they are of one motion under one method.
    pub(super) fn and(self, next: Self) -> Option<Self> {
        let is_one = self.entry == next.entry && !next.jumped;
        let ends = next.swept.ends();
        let swept = self.swept.and(ends[0]).and(ends[1]);
        (is_one && self.q.is_finite() && next.q.is_finite()).then_some(Self {
            swept,
            jumped: self.jumped,
            ..next
        })
    }
}
