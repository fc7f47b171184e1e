//! The energies of a body at one moment.

use crate::sim::Stepper;

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
