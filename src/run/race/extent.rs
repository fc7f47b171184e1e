//! The range of a motion so far, which is the scale of errors in speed and energy.
//!
//! The scale comes from the true motion, so that all lanes have the same one, and a lane that grows cannot make its own
//! error look small. It is unknown until the motion has been at both ends of its range, because a part of the range
//! would exaggerate the drift.

use crate::sim::Stepper;
use crate::sim::bodies::Tumble;

/// An exchange of energy counts as rounding if its share of the largest kinetic energy is below this.
const ROUNDING: f64 = 1e-9;
/// Kinetic energy counts as 0 if its share of the largest one is below this, because it may have been 0 between ticks.
const AT_REST: f64 = 0.01;

/// The range of a body's true motion since its start.
#[derive(Clone, Debug, Default)]
pub struct Extent {
    largest_speed: f64,
    /// Largest sum of kinetic and potential energy (J), for a body that does not conserve this sum.
    most_j: f64,
    kinetic: Option<Kinetic>,
}

/// Range of the kinetic energy so far (J).
#[derive(Clone, Copy, Debug)]
struct Kinetic {
    least: f64,
    most: f64,
    /// Range of the kinetic energy since the last turn.
    recent: (f64, f64),
    /// Whether the kinetic energy was last rising; `None` before its first change.
    rises: Option<bool>,
    /// Number of reversals by at least half the range.
    turns: u32,
}

impl Extent {
    /// Adds a moment's speed, and its kinetic energy (J) if the body conserves its energy.
    pub fn add_moment(&mut self, speed: f64, kinetic_j: Option<f64>) {
        self.largest_speed = self.largest_speed.max(speed);
        if let Some(now) = kinetic_j {
            self.kinetic.get_or_insert_with(|| Kinetic::from(now)).add(now);
        }
    }

    /// Adds a moment's kinetic and potential energy (J), if known, of a body that does not conserve their sum.
    pub(crate) fn cover_energy(&mut self, energies: Option<[f64; 2]>) {
        let sum = energies.map_or(0.0, |[kinetic, potential]| kinetic + potential);
        self.most_j = self.most_j.max(sum);
    }

    /// Returns the largest sum of kinetic and potential energy so far (J); 0 if unknown.
    pub(crate) fn most_j(&self) -> f64 {
        self.most_j
    }

    /// Returns the largest speed so far; 0 if the body has not moved.
    pub(crate) fn largest_speed(&self) -> f64 {
        self.largest_speed
    }

    /// Returns the energy (J) that the motion of `truth` exchanges, which is the range of its kinetic energy. For a
    /// linear body it is at least the total energy, because the modes exchange all of that in time. `None` if energy is
    /// not conserved or exchanged, and before the motion has reached both ends of the range. A part of the range would
    /// exaggerate the drift.
    pub fn exchanged_j(&self, truth: &dyn Stepper) -> Option<f64> {
        // A free rotation exchanges none, so that its energy is measured against the whole.
        if truth.body().is::<Tumble>() {
            return truth.energy();
        }
        let whole = truth.energy().filter(|_| truth.is_linear());
        let range = self.range_j()?;
        // A larger range is that of the motion before a kick or a placement.
        Some(
            whole
                .filter(|whole| range > whole * (1.0 + ROUNDING))
                .unwrap_or(range)
                .max(whole.unwrap_or(0.0)),
        )
    }

    /// Forgets the energies of a motion that a kick or a placement ended.
    pub(crate) fn forget_energy(&mut self) {
        self.kinetic = None;
    }

    fn range_j(&self) -> Option<f64> {
        self.kinetic.filter(|kinetic| kinetic.has_seen_both_ends()).map(|kinetic| kinetic.range())
    }
}

impl Kinetic {
    fn from(now: f64) -> Self {
        Self { least: now, most: now, recent: (now, now), rises: None, turns: 0 }
    }

    fn range(self) -> f64 {
        self.most - self.least
    }

    /// Whether the kinetic energy has turned at both ends, or has come to rest.
    fn has_seen_both_ends(self) -> bool {
        self.turns >= 2 || self.turns == 1 && self.least <= AT_REST * self.most
    }

    fn add(&mut self, now: f64) {
        (self.least, self.most) = (self.least.min(now), self.most.max(now));
        let range = self.range();
        if range <= ROUNDING * self.most {
            return;
        }
        let (low, high) = (self.recent.0.min(now), self.recent.1.max(now));
        self.recent = (low, high);
        let (rose, fell) = (now - low >= range / 2.0, high - now >= range / 2.0);
        let turns = match self.rises {
            Some(true) => fell,
            Some(false) => rose,
            None => {
                self.rises = Some(rose);
                false
            }
        };
        if turns {
            self.turns += 1;
            (self.rises, self.recent) = (self.rises.map(|rises| !rises), (now, now));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn covered(kinetic_j: impl IntoIterator<Item = f64>) -> Extent {
        let mut extent = Extent::default();
        kinetic_j.into_iter().for_each(|kinetic_j| extent.add_moment(0.0, Some(kinetic_j)));
        extent
    }

    #[test]
    fn a_swing_exchanges_its_energy_once_it_has_turned() {
        let swing = |from: usize, to: usize| {
            (from..=to).map(|i| libm::sin(i as f64 * std::f64::consts::PI / 100.0).powi(2))
        };
        assert_eq!(covered(swing(0, 50)).range_j(), None, "it has only risen");
        assert_eq!(covered(swing(0, 80)).range_j(), Some(1.0));
        assert_eq!(covered(swing(50, 100)).range_j(), None, "it has only fallen");
        assert!((covered(swing(50, 140)).range_j().unwrap() - 1.0).abs() < 1e-12);
        // From the middle the energy rises by half its range, and then falls by all of it.
        assert_eq!(covered(swing(25, 90)).range_j(), None, "it has turned at the top only");
        assert!((covered(swing(25, 130)).range_j().unwrap() - 1.0).abs() < 1e-12);
        assert_eq!(covered(swing(75, 110)).range_j(), None, "it has hardly turned");
        assert!((covered(swing(75, 190)).range_j().unwrap() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_restless_motion_has_an_energy_range_once_both_turns_were_seen() {
        let swing = |from: usize, to: usize| {
            (from..=to).map(|i| 3.0 + libm::sin(i as f64 * std::f64::consts::PI / 100.0).powi(2))
        };
        assert_eq!(covered(swing(0, 90)).range_j(), None, "the bottom may be lower");
        assert_eq!(covered(swing(25, 120)).range_j(), None, "it has turned at the top only");
        assert!((covered(swing(25, 150)).range_j().unwrap() - 1.0).abs() < 1e-12);
        assert!((covered(swing(50, 180)).range_j().unwrap() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn without_exchange_there_is_no_energy_scale_for_a_drift() {
        assert_eq!(Extent::default().range_j(), None);
        assert_eq!(covered([0.0; 9]).range_j(), None);
        let rounding = [3.0, 3.0 + 4e-16, 3.0 - 9e-16, 3.0, 3.0 - 4e-16];
        assert_eq!(covered(rounding).range_j(), None, "a circular orbit");
        let thrust = rounding.into_iter().chain((0..100).map(f64::from).map(|i| 3.0 + i * i));
        assert_eq!(covered(thrust).range_j(), None, "a ship that only gathers way");
    }

    #[test]
    fn the_largest_speed_is_remembered() {
        let mut extent = Extent::default();
        [1.0, 4.0, 2.0].into_iter().for_each(|speed| extent.add_moment(speed, None));
        assert_eq!(extent.largest_speed(), 4.0);
    }
}
