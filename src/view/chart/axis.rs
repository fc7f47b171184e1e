//! Axis scales and the marks of axes. Marks lie at round values, and an axis has at least three if they fit.

use crate::stage::number::{grouped, round, superscript};

/// Spacing of values along an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AxisScale {
    /// Spaced evenly.
    Linear,
    /// Spaced by their decimal logarithm.
    Log,
    /// Spaced by sign and logarithm, but roughly evenly within this distance of zero.
    SymLog(f64),
}

/// Place of a mark along its axis, and the mark's number as text.
pub(crate) type AxisMark = (f64, String);

/// Minimum number of marks on an axis, because two marks do not show whether an axis is linear.
const MIN_MARKS: usize = 3;
/// Maximum number of significant digits of a mark.
const MAX_DIGITS: usize = 15;
/// Range of numbers that a linear axis writes out. It writes other numbers with a power of ten.
const PLAIN: std::ops::Range<f64> = 1e-3..1e6;
/// Exponents of the powers of ten that a logarithmic axis writes out.
const PLAIN_POWERS: std::ops::RangeInclusive<i32> = -3..=5;

/// Leading digits of the marks on a logarithmic axis, from sparse to dense.
const DIGITS: [&[f64]; 5] = [
    &[1.0],
    &[1.0, 3.0],
    &[1.0, 2.0, 5.0],
    &[1.0, 1.5, 2.0, 3.0, 5.0, 7.0],
    &[1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0],
];
/// Factor by which the minimum distance of marks may shrink if too few marks fit otherwise.
const NEARER: f64 = 0.6;

impl AxisScale {
    /// Returns the place of a value along the axis.
    pub(crate) fn place(self, value: f64) -> f64 {
        match self {
            Self::Linear => value,
            Self::Log => libm::log10(value),
            Self::SymLog(linear) => libm::copysign(libm::log10(1.0 + value.abs() / linear), value),
        }
    }

    /// Returns the value at a place of the axis.
    pub(crate) fn value(self, place: f64) -> f64 {
        match self {
            Self::Linear => place,
            Self::Log => libm::pow(10.0, place),
            Self::SymLog(linear) => {
                libm::copysign(linear * (libm::pow(10.0, place.abs()) - 1.0), place)
            }
        }
    }

    /// Returns the marks between two places that lie `room` screen points apart. As many marks fit as have `apart`
    /// points between them, but at least three.
    pub(crate) fn marks(self, range: [f64; 2], room: f32, apart: f64) -> Vec<AxisMark> {
        let apart = apart * (range[1] - range[0]) / f64::from(room.max(1.0));
        match self {
            Self::Linear => linear(range, apart),
            Self::Log => logarithmic(range, apart),
            Self::SymLog(linear) => self.symmetric(linear, range, apart),
        }
        .unwrap_or_else(|| self.distinct(range, apart))
    }

    /// Returns evenly spaced marks, with just enough digits to differ from each other.
    fn distinct(self, range: [f64; 2], apart: f64) -> Vec<AxisMark> {
        let (places, _) = multiples(range, apart);
        let texts = |digits: usize| -> Vec<AxisMark> {
            places.iter().map(|&place| (place, round(self.value(place), digits))).collect()
        };
        let differ = |marks: &Vec<AxisMark>| marks.windows(2).all(|pair| pair[0].1 != pair[1].1);
        (3..MAX_DIGITS).map(texts).find(differ).unwrap_or_else(|| texts(MAX_DIGITS))
    }

    /// Returns zero, and powers of ten on both sides of zero.
    fn symmetric(self, linear: f64, [low, high]: [f64; 2], apart: f64) -> Option<Vec<AxisMark>> {
        let first = libm::ceil(libm::log10(linear)) as i32;
        let last = first + libm::ceil(low.abs().max(high.abs())) as i32;
        let mut places = vec![(0.0, "0".to_owned())];
        for exponent in first..=last {
            let place = self.place(libm::pow(10.0, f64::from(exponent)));
            let outermost = places.last().map_or(0.0, |(place, _)| *place);
            if place - outermost >= apart {
                places.push((place, power(1.0, exponent, PLAIN_POWERS.contains(&exponent))));
            }
        }
        let below = places[1..].iter().rev();
        let below = below.map(|(place, text)| (-place, format!("\u{2212}{text}")));
        let above = places[1..].iter().map(|(place, text)| (*place, format!("+{text}")));
        let all = below.chain([places[0].clone()]).chain(above);
        let marks: Vec<_> = all.filter(|(place, _)| (low..=high).contains(place)).collect();
        (marks.len() >= MIN_MARKS).then_some(marks)
    }
}

/// Returns the multiples of a step within a range, and the step, which is 1, 2 or 5 times a power of ten. The multiples
/// lie at least `apart` from each other, unless that leaves fewer than [`MIN_MARKS`].
fn multiples([low, high]: [f64; 2], apart: f64) -> (Vec<f64>, f64) {
    let mut decade = libm::ceil(libm::log10(apart)) as i32 + 1;
    let mut found = (Vec::new(), apart);
    // Steps from coarse to fine. The result is the last step of at least `apart`, or the first one with enough marks.
    loop {
        for digit in [5.0, 2.0, 1.0] {
            let step = digit * libm::pow(10.0, f64::from(decade));
            let has_enough = step < apart && found.0.len() >= MIN_MARKS;
            let (first, last) = (libm::ceil(low / step), libm::floor(high / step));
            if has_enough || !(step > 0.0 && step.is_finite()) || last - first > 1000.0 {
                return found;
            }
            let mark = |i: i64| (first + i as f64) * step;
            found = ((0..=(last - first) as i64).map(mark).collect(), step);
        }
        decade -= 1;
    }
}

/// Returns marks at multiples of a round step, with as many digits as the step has.
fn linear(range: [f64; 2], apart: f64) -> Option<Vec<AxisMark>> {
    let (places, step) = multiples(range, apart);
    let decade = |x: f64| libm::floor(libm::log10(x) + 1e-9) as i32;
    let largest = range[0].abs().max(range[1].abs());
    let power = if PLAIN.contains(&largest) { 0 } else { decade(largest) };
    let decimals = (power - decade(step)).max(0) as usize;
    let text = |value: f64| {
        if value.abs() < step / 2.0 {
            return "0".to_owned();
        }
        let magnitude = value.abs() / libm::pow(10.0, f64::from(power));
        let sign = if value < 0.0 { "\u{2212}" } else { "" };
        match power {
            0 => format!("{sign}{magnitude:.decimals$}"),
            _ => format!("{sign}{magnitude:.decimals$}·10{}", superscript(power)),
        }
    };
    Some(places.into_iter().map(|place| (place, text(place))).collect())
}

/// Returns marks at powers of ten: fewer marks if they crowd, and more of them in between if there is room. Returns
/// `None` if fewer than [`MIN_MARKS`] fit, or only crowded marks.
fn logarithmic([low, high]: [f64; 2], apart: f64) -> Option<Vec<AxisMark>> {
    let powers = |step: i64| -> Vec<(f64, i32)> {
        let [first, last] =
            [libm::ceil(low / step as f64), libm::floor(high / step as f64)].map(|i| i as i64);
        (first..=last).map(|i| (1.0, (i * step) as i32)).collect()
    };
    let between = |digits: &&[f64]| -> Vec<(f64, i32)> {
        let decades = libm::floor(low) as i32..=libm::floor(high) as i32;
        let all = decades.flat_map(|decade| digits.iter().map(move |digit| (*digit, decade)));
        all.filter(|number| (low..=high).contains(&place_of(number))).collect()
    };
    let fit = |marks: &Vec<(f64, i32)>, least: f64| {
        let is_apart = |pair: &[(f64, i32)]| place_of(&pair[1]) - place_of(&pair[0]) >= least;
        marks.len() >= MIN_MARKS && marks.windows(2).all(is_apart)
    };
    let is_plain = [low, high].map(|end| PLAIN_POWERS.contains(&(libm::floor(end) as i32)));
    let is_plain = is_plain == [true; 2];
    let numbers = || {
        let mut all = DIGITS.iter().map(between);
        let far = all.clone().rfind(|marks| fit(marks, apart));
        far.or_else(|| all.find(|marks| fit(marks, NEARER * apart)))
    };
    let mut step = (libm::ceil(apart) as i64).max(1);
    while step > 1 && powers(step).len() < MIN_MARKS {
        step -= 1;
    }
    let powers = Some(powers(step)).filter(|marks| marks.len() >= MIN_MARKS);
    let marks = if is_plain { numbers().or(powers) } else { powers.or_else(numbers) }?;
    let named = |mark: (f64, i32)| (place_of(&mark), power(mark.0, mark.1, is_plain));
    Some(marks.into_iter().map(named).collect())
}

fn place_of((digit, exponent): &(f64, i32)) -> f64 {
    libm::log10(*digit) + f64::from(*exponent)
}

/// Returns the text of `digit · 10^exponent`. The thousands of a number that is written out are grouped.
fn power(digit: f64, exponent: i32, is_written_out: bool) -> String {
    if !is_written_out {
        let factor = if digit == 1.0 { String::new() } else { format!("{digit}·") };
        return format!("{factor}10{}", superscript(exponent));
    }
    let value = digit * libm::pow(10.0, f64::from(exponent));
    if value < 1e4 { round(value, 4) } else { grouped(value.round() as u64) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCALES: [AxisScale; 3] = [AxisScale::Linear, AxisScale::Log, AxisScale::SymLog(0.001)];

    fn texts(scale: AxisScale, range: [f64; 2], room: f32, apart: f64) -> Vec<String> {
        scale.marks(range, room, apart).into_iter().map(|(_, text)| text).collect()
    }

    /// Returns the texts of the marks on a logarithmic axis between two values.
    fn decades(range: [f64; 2], room: f32, apart: f64) -> Vec<String> {
        texts(AxisScale::Log, range.map(libm::log10), room, apart)
    }

    #[test]
    fn marks_are_round_and_as_many_as_fit() {
        let even = |range, room, apart| texts(AxisScale::Linear, range, room, apart);
        assert_eq!(even([0.0, 20.0], 480.0, 70.0), ["0", "5", "10", "15", "20"]);
        let around_zero = ["\u{2212}1.0", "\u{2212}0.5", "0", "0.5", "1.0"];
        assert_eq!(even([-1.1, 1.1], 200.0, 30.0), around_zero);
        assert_eq!(even([3.4, 23.4], 200.0, 70.0), ["5", "10", "15", "20"]);
    }

    #[test]
    fn every_range_has_at_least_three_different_labels() {
        for exponent in [-300, -13, -9, -3, 0, 3, 9, 15, 37] {
            let size = libm::pow(10.0, f64::from(exponent));
            for range in [[0.0, 1.0], [-0.3, 0.8], [0.98, 1.02], [-5.0, -4.991], [1.0, 7.7]] {
                for room in [40.0, 110.0, 480.0] {
                    let range = range.map(|end| end * size);
                    let named = texts(AxisScale::Linear, range, room, 28.0);
                    assert!(named.len() >= 3, "{range:?}: {named:?}");
                    assert!(named.windows(2).all(|pair| pair[0] != pair[1]), "{named:?}");
                }
            }
        }
    }

    #[test]
    fn crowded_powers_of_ten_are_marked_every_few() {
        assert_eq!(decades([1e-6, 1.5], 120.0, 28.0), ["10⁻⁶", "10⁻⁴", "10⁻²", "10⁰"]);
        assert_eq!(decades([1e-17, 1e3], 60.0, 28.0).len(), 3);
        assert_eq!(decades([1e-2, 1.5], 10.0, 28.0).len(), 3);
    }

    #[test]
    fn a_logarithmic_axis_has_round_numbers_and_no_more_than_fit() {
        let wide = ["2", "5", "10", "20", "50", "100", "200", "500", "1000"];
        assert_eq!(decades([2.0, 1000.0], 400.0, 30.0), wide);
        assert_eq!(decades([2.0, 1000.0], 100.0, 30.0), ["10", "100", "1000"]);
        let large = ["10", "100", "1000", "10\u{a0}000", "100\u{a0}000"];
        assert_eq!(decades([1.5, 1.1e5], 200.0, 30.0), large);
        assert_eq!(decades([1e-4, 1e8], 400.0, 30.0)[..2], ["10⁻⁴", "10⁻³"]);
        assert_eq!(decades([0.4, 2.5], 80.0, 24.0), ["0.5", "1", "2"]);
        assert_eq!(decades([0.78, 1.28], 80.0, 24.0), ["0.8", "1", "1.2"]);
        assert_eq!(decades([0.09, 1.1], 80.0, 24.0), ["0.1", "0.3", "1"]);
        assert_eq!(decades([0.09, 1.1], 100.0, 24.0), ["0.1", "0.2", "0.5", "1"]);
    }

    #[test]
    fn small_and_large_numbers_have_a_power_of_ten() {
        let even = |range, apart| texts(AxisScale::Linear, range, 120.0, apart);
        assert_eq!(even([-3e-13, 3e-13], 28.0)[0], "\u{2212}2·10⁻¹³");
        assert_eq!(even([0.0, 2.5e7], 50.0), ["0", "1·10⁷", "2·10⁷"]);
    }

    #[test]
    fn a_position_converts_back_to_its_value() {
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
    fn every_range_has_three_distinct_marks_with_room_between() {
        for scale in SCALES {
            for range in [[-3.2, 1.2], [0.4, 0.6], [-0.01, 0.02], [-2.0, -1.0], [-9.0, 9.0]] {
                for room in [50.0, 160.0, 500.0] {
                    let marks = scale.marks(range, room, 24.0);
                    assert!(marks.len() >= 3, "{scale:?}, {range:?} on {room}: {marks:?}");
                    assert!(marks.windows(2).all(|pair| pair[0].0 < pair[1].0), "{marks:?}");
                    assert!(marks.windows(2).all(|pair| pair[0].1 != pair[1].1), "{marks:?}");
                    assert!(marks.iter().all(|(at, _)| (range[0]..=range[1]).contains(at)));
                }
            }
        }
    }

    #[test]
    fn a_symmetric_scale_is_marked_at_zero_and_at_powers_of_ten() {
        let texts = texts(AxisScale::SymLog(0.1), [-3.2, 3.2], 400.0, 24.0);
        assert_eq!(texts, ["\u{2212}100", "\u{2212}10", "\u{2212}1", "0", "+1", "+10", "+100"]);
    }
}
