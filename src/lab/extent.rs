//! What a motion has covered so far: the scales that errors of speed and energy are held against.

/// An exchange of energy this small against the largest kinetic energy is rounding.
const ROUNDING: f64 = 1e-9;

/// What the true motion of a body has covered since its start.
#[derive(Clone, Debug, Default)]
pub(super) struct Extent {
    largest_speed: f64,
    kinetic: Option<Kinetic>,
}

/// The kinetic energy so far, in joules.
#[derive(Clone, Copy, Debug)]
struct Kinetic {
    start: f64,
    least: f64,
    most: f64,
    /// Whether it went a good way from the start and half of that way back.
    has_turned: bool,
}

impl Extent {
    /// Takes in a moment: the speed and, where the body conserves its energy, the kinetic energy (J).
    pub(super) fn cover(&mut self, speed: f64, kinetic_j: Option<f64>) {
        self.largest_speed = self.largest_speed.max(speed);
        if let Some(now) = kinetic_j {
            let start = Kinetic { start: now, least: now, most: now, has_turned: false };
            self.kinetic.get_or_insert(start).cover(now);
        }
    }

    /// The largest speed so far, 0 for what has not moved.
    pub(super) fn largest_speed(&self) -> f64 {
        self.largest_speed
    }

    /// The energy that the motion exchanges, in joules: the range of its kinetic energy. `None` where none is
    /// conserved or exchanged, and before the kinetic energy has turned for the first time, as the range is
    /// still a small part of itself then.
    pub(super) fn exchanged_j(&self) -> Option<f64> {
        self.kinetic.filter(|kinetic| kinetic.has_turned).map(|kinetic| kinetic.range())
    }
}

impl Kinetic {
    fn range(self) -> f64 {
        self.most - self.least
    }

    fn cover(&mut self, now: f64) {
        (self.least, self.most) = (self.least.min(now), self.most.max(now));
        let range = self.range();
        let fell = self.most - self.start >= range / 4.0 && self.most - now >= range / 2.0;
        let rose = self.start - self.least >= range / 4.0 && now - self.least >= range / 2.0;
        self.has_turned |= range > ROUNDING * self.most && (fell || rose);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn covered(kinetic_j: impl IntoIterator<Item = f64>) -> Extent {
        let mut extent = Extent::default();
        kinetic_j.into_iter().for_each(|kinetic_j| extent.cover(0.0, Some(kinetic_j)));
        extent
    }

    #[test]
    fn a_swing_exchanges_its_energy_once_it_has_turned() {
        let swing = |from: usize, to: usize| {
            (from..=to).map(|i| libm::sin(i as f64 * std::f64::consts::PI / 100.0).powi(2))
        };
        assert_eq!(covered(swing(0, 50)).exchanged_j(), None, "it has only risen");
        assert_eq!(covered(swing(0, 80)).exchanged_j(), Some(1.0));
        assert_eq!(covered(swing(50, 100)).exchanged_j(), None, "it has only fallen");
        assert!((covered(swing(50, 140)).exchanged_j().unwrap() - 1.0).abs() < 1e-12);
        assert!((covered(swing(25, 150)).exchanged_j().unwrap() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn where_nothing_is_exchanged_there_is_no_energy_to_hold_a_drift_against() {
        assert_eq!(Extent::default().exchanged_j(), None);
        assert_eq!(covered([0.0; 9]).exchanged_j(), None);
        let rounding = [3.0, 3.0 + 4e-16, 3.0 - 9e-16, 3.0, 3.0 - 4e-16];
        assert_eq!(covered(rounding).exchanged_j(), None, "a circular orbit");
        let thrust = rounding.into_iter().chain((0..100).map(f64::from).map(|i| 3.0 + i * i));
        assert_eq!(covered(thrust).exchanged_j(), None, "a ship that only gathers way");
    }

    #[test]
    fn the_largest_speed_stays() {
        let mut extent = Extent::default();
        [1.0, 4.0, 2.0].into_iter().for_each(|speed| extent.cover(speed, None));
        assert_eq!(extent.largest_speed(), 4.0);
    }
}
