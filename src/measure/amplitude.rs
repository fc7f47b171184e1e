//! Trend of an amplitude within the horizon, and the quantity whose amplitude it is.

use super::criterion::VISIBLE;

/// Factor from which on a change of the amplitude counts even if it happens at once and then stops.
const LEAP: f64 = 1.5;

/// Change of an amplitude within the horizon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Trend {
    /// The change is too small to see.
    None,
    /// The amplitude grows.
    Grows,
    /// The amplitude shrinks.
    Dies,
}

/// The quantity of a body whose growth and decay a verdict measures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Measure {
    /// The swing of one coordinate, or of one mode of a linear body.
    Swing,
    /// The swing of several modes of a linear body, which is the root of their energy.
    Modes,
    /// Largest distance of any coordinate from its centre in units of that coordinate's amplitude, for coordinates that
    /// swing together.
    Reach,
    /// The distance from a motion that does not swing.
    #[default]
    Deviation,
}

impl Measure {
    /// Returns the quantity's name.
    pub fn name(self) -> &'static str {
        match self {
            Measure::Swing | Measure::Modes => "swing",
            Measure::Reach => "reach",
            Measure::Deviation => "deviation",
        }
    }
}

impl Trend {
    /// Returns the trend of a swing whose amplitude has changed by this factor.
    pub(super) fn of(amplitude: f64) -> Self {
        match amplitude {
            a if a >= 1.0 + VISIBLE => Trend::Grows,
            a if a <= 1.0 - VISIBLE => Trend::Dies,
            _ => Trend::None,
        }
    }

    /// Returns the trend of a swing with the amplitudes `first` in the first quarter and `last` in the last one, in
    /// units of the initial amplitude. A change that happens at once and then stops does not count, unless it is a
    /// [leap](LEAP).
    pub(super) fn between(first: f64, last: f64) -> Self {
        let trend = Trend::of(last / first);
        match Trend::of(last) {
            Trend::Grows if trend == Trend::Grows || last >= LEAP => Trend::Grows,
            Trend::Dies if trend == Trend::Dies || last * LEAP <= 1.0 => Trend::Dies,
            _ => Trend::None,
        }
    }
}

/// Returns the amplitude of a swing, in units of the initial amplitude, after a relative change of its energy.
pub(super) fn amplitude(energy_change: f64) -> f64 {
    (1.0 + energy_change).max(0.0).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_trend_must_continue_or_be_a_leap() {
        for (first, last, change) in [
            (1.0, 1.06, Trend::Grows),
            (1.04, 1.06, Trend::None),
            (1.0, 1.04, Trend::None),
            (1.45, 1.49, Trend::None),
            (1.45, 1.51, Trend::Grows),
            (1.0, 0.94, Trend::Dies),
            (0.96, 0.94, Trend::None),
            (1.0, 0.96, Trend::None),
            (0.69, 0.67, Trend::None),
            (0.69, 0.66, Trend::Dies),
            // A swing that grows first and then shrinks has not grown.
            (2.0, 1.2, Trend::None),
        ] {
            assert_eq!(Trend::between(first, last), change, "{first} to {last}");
        }
    }
}
