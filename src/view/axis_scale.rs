//! How values lie along the axis of an instrument, and where they are marked.

use egui_plot::{GridInput, GridMark};

use super::ticks::{self, FINEST};
use crate::lab::number::{round, superscript};

/// How values lie along an axis. A plot's points are [placed](AxisScale::place) before they are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum AxisScale {
    /// Evenly.
    Linear,
    /// By their decimal logarithm.
    Log,
    /// By sign and logarithm, evenly round zero as far as this value.
    SymLog(f64),
}

/// The most significant digits of a mark.
const MAX_DIGITS: usize = 15;
/// The powers of ten that are written out on a symmetric scale.
const PLAIN_FROM: i32 = -3;
const PLAIN_TO: i32 = 4;
/// The fewest marks of an axis.
const FEWEST: usize = 3;

impl AxisScale {
    /// Where a value lies.
    pub(super) fn place(self, value: f64) -> f64 {
        match self {
            Self::Linear => value,
            Self::Log => libm::log10(value),
            Self::SymLog(linear) => libm::copysign(libm::log10(1.0 + value.abs() / linear), value),
        }
    }

    /// The value at a place.
    pub(super) fn value(self, place: f64) -> f64 {
        match self {
            Self::Linear => place,
            Self::Log => libm::pow(10.0, place),
            Self::SymLog(linear) => {
                libm::copysign(linear * (libm::pow(10.0, place.abs()) - 1.0), place)
            }
        }
    }

    /// The marks between two places, `room` points of the screen apart: where each lies, and its number. At least three,
    /// and as many as fit at least `apart` points from each other.
    pub(super) fn marks(
        self,
        (low, high): (f64, f64),
        room: f64,
        apart: f64,
    ) -> Vec<(f64, String)> {
        let input = || GridInput {
            bounds: (low, high),
            base_step_size: FINEST * (high - low) / room.max(1.0),
        };
        let evenly = || ticks::linear(input(), apart);
        // In as many digits as tell the marks apart.
        let distinct_name = || {
            let texts = |digits: usize| -> Vec<(f64, String)> {
                let text = |mark: &GridMark| round(self.value(mark.value), digits);
                evenly().iter().map(|mark| (mark.value, text(mark))).collect()
            };
            let differ = |marks: &Vec<(f64, String)>| marks.windows(2).all(|m| m[0].1 != m[1].1);
            (3..MAX_DIGITS).map(texts).find(differ).unwrap_or_else(|| texts(MAX_DIGITS))
        };
        match self {
            Self::Linear => {
                let label = |mark: &GridMark| ticks::linear_label(*mark, &(low..=high), "");
                evenly().iter().map(|mark| (mark.value, label(mark))).collect()
            }
            Self::Log => {
                let decades = ticks::decades(input(), apart).into_iter();
                let decades: Vec<_> =
                    decades.map(|mark| (mark.value, ticks::decade_label(mark, ""))).collect();
                if decades.len() >= FEWEST {
                    return decades;
                }
                let named = |place: f64| (place, round(self.value(place), 3));
                let numbers = ticks::round_numbers(input(), apart);
                numbers.map_or_else(distinct_name, |it| it.into_iter().map(named).collect())
            }
            Self::SymLog(_) => {
                let marks = self.symmetric_marks((low, high), apart * (high - low) / room.max(1.0));
                if marks.len() >= FEWEST {
                    return marks;
                }
                distinct_name()
            }
        }
    }

    /// Zero, and powers of ten on both sides of it, at least `apart` from each other.
    fn symmetric_marks(self, (low, high): (f64, f64), apart: f64) -> Vec<(f64, String)> {
        let Self::SymLog(linear) = self else { return Vec::new() };
        let first = libm::ceil(libm::log10(linear)) as i32;
        let last = first + libm::ceil(low.abs().max(high.abs())) as i32;
        let mut places = vec![(0.0, "0".to_owned())];
        for exponent in first..=last {
            let value = libm::pow(10.0, f64::from(exponent));
            let place = self.place(value);
            let outermost = places.last().map_or(0.0, |(place, _)| *place);
            if place - outermost >= apart {
                let text = match exponent {
                    PLAIN_FROM..=PLAIN_TO => round(value, 1),
                    _ => format!("10{}", superscript(exponent)),
                };
                places.push((place, text));
            }
        }
        let below = places[1..].iter().rev();
        let below = below.map(|(place, text)| (-place, format!("\u{2212}{text}")));
        let above = places[1..].iter().map(|(place, text)| (*place, format!("+{text}")));
        let all = below.chain([places[0].clone()]).chain(above);
        all.filter(|(place, _)| (low..=high).contains(place)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCALES: [AxisScale; 3] = [AxisScale::Linear, AxisScale::Log, AxisScale::SymLog(0.001)];

    #[test]
    fn a_place_leads_back_to_its_value() {
        for scale in SCALES {
            for value in [1e-6, 0.003, 1.0, 77.0, 1e9] {
                let back = scale.value(scale.place(value));
                assert!((back - value).abs() < 1e-9 * value.max(0.1), "{scale:?}: {back}");
            }
        }
        let scale = AxisScale::SymLog(0.001);
        assert_eq!(scale.place(0.0), 0.0);
        assert_eq!(scale.place(-5.0), -scale.place(5.0));
    }

    #[test]
    fn every_range_has_three_different_marks_apart_from_each_other() {
        for scale in SCALES {
            for (low, high) in [(-3.2, 1.2), (0.4, 0.6), (-0.01, 0.02), (-2.0, -1.0), (-9.0, 9.0)] {
                for room in [50.0, 160.0, 500.0] {
                    let marks = scale.marks((low, high), room, 24.0);
                    assert!(marks.len() >= 3, "{scale:?}, {low} to {high} on {room}: {marks:?}");
                    assert!(marks.windows(2).all(|pair| pair[0].0 < pair[1].0), "{marks:?}");
                    assert!(marks.windows(2).all(|pair| pair[0].1 != pair[1].1), "{marks:?}");
                    assert!(marks.iter().all(|(place, _)| (low..=high).contains(place)));
                }
            }
        }
    }

    #[test]
    fn a_symmetric_scale_is_marked_at_zero_and_at_powers_of_ten() {
        let marks = AxisScale::SymLog(0.1).marks((-3.2, 3.2), 400.0, 24.0);
        let texts: Vec<&str> = marks.iter().map(|(_, text)| &**text).collect();
        assert_eq!(texts, ["\u{2212}100", "\u{2212}10", "\u{2212}1", "0", "+1", "+10", "+100"]);
    }
}
