//! Marks along the axes of the instruments: at round values, at least three of them wherever they fit,
//! each with its number.

use std::ops::RangeInclusive;

use egui_plot::{GridInput, GridMark};

use crate::lab::number::superscript;

/// What `egui_plot` takes for the least distance between two grid lines, in points: a [`GridInput`] is
/// counted in it.
pub(super) const FINEST: f64 = 8.0;
/// The fewest marks of an axis: with two, nothing says whether it is linear.
const FEWEST: i64 = 3;
/// Numbers of this size are written out, others with a power of ten.
const PLAIN: std::ops::Range<f64> = 1e-3..1e6;

/// Marks at multiples of 1, 2 or 5 times a power of ten, at least `apart` points from each other unless
/// that leaves fewer than [`FEWEST`].
pub(super) fn linear(input: GridInput, apart: f64) -> Vec<GridMark> {
    let (low, high) = input.bounds;
    let mut decade = libm::ceil(libm::log10(input.base_step_size / FINEST * apart)) as i32 + 1;
    let mut marks = Vec::new();
    // From coarse to fine: the last that is coarse enough, or the first with enough marks.
    loop {
        for digit in [5.0, 2.0, 1.0] {
            let step = digit * libm::pow(10.0, f64::from(decade));
            let is_close = step * FINEST < input.base_step_size * apart;
            if (is_close && marks.len() as i64 >= FEWEST) || !(step > 0.0 && step.is_finite()) {
                return marks;
            }
            let (first, last) = (libm::ceil(low / step), libm::floor(high / step));
            if last - first > 1000.0 {
                return marks;
            }
            let mark = |i: i64| GridMark { value: (first + i as f64) * step, step_size: step };
            marks = (0..=(last - first) as i64).map(mark).collect();
        }
        decade -= 1;
    }
}

/// The number at a mark that [`linear`] made, with its unit.
pub(super) fn linear_label(mark: GridMark, in_view: &RangeInclusive<f64>, unit: &str) -> String {
    let GridMark { value, step_size } = mark;
    let largest = in_view.start().abs().max(in_view.end().abs());
    let number = if value.abs() < step_size / 2.0 {
        "0".to_owned()
    } else {
        let decade = |x: f64| libm::floor(libm::log10(x) + 1e-9) as i32;
        let power = if PLAIN.contains(&largest) { 0 } else { decade(largest) };
        let decimals = (power - decade(step_size)).max(0) as usize;
        let magnitude = value.abs() / libm::pow(10.0, f64::from(power));
        let sign = if value < 0.0 { "\u{2212}" } else { "" };
        match power {
            0 => format!("{sign}{magnitude:.decimals$}"),
            _ => format!("{sign}{magnitude:.decimals$}·10{}", superscript(power)),
        }
    };
    with_unit(number, unit)
}

/// A mark at every whole power of ten, or every few where they crowd: at least `apart` points from each
/// other unless that leaves fewer than [`FEWEST`].
pub(super) fn decades(input: GridInput, apart: f64) -> Vec<GridMark> {
    let (low, high) = input.bounds;
    let marks = |step: i64| -> Vec<GridMark> {
        let [first, last] =
            [libm::ceil(low / step as f64), libm::floor(high / step as f64)].map(|i| i as i64);
        let mark = |i: i64| GridMark { value: (i * step) as f64, step_size: step as f64 };
        (first..=last).map(mark).collect()
    };
    let mut step = (libm::ceil(input.base_step_size / FINEST * apart) as i64).max(1);
    while step > 1 && (marks(step).len() as i64) < FEWEST {
        step -= 1;
    }
    marks(step)
}

/// What the numbers at the marks of an axis of few decades begin with, from few to many.
const DIGITS: [&[f64]; 4] = [
    &[1.0, 3.0],
    &[1.0, 2.0, 5.0],
    &[1.0, 1.5, 2.0, 3.0, 5.0, 7.0],
    &[1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0],
];

/// How much nearer marks may be where none are further apart.
const NEARER: f64 = 0.6;

/// The logarithms of round numbers, as many as are at least `apart` points from each other, or a little nearer; `None` if
/// there are fewer than [`FEWEST`].
pub(super) fn round_numbers(input: GridInput, apart: f64) -> Option<Vec<f64>> {
    let (low, high) = input.bounds;
    let least = input.base_step_size / FINEST * apart;
    let marks = |digits: &&[f64]| -> Vec<f64> {
        let decades = libm::floor(low) as i32..=libm::floor(high) as i32;
        let of_decade = |decade| digits.iter().map(move |x| libm::log10(*x) + f64::from(decade));
        decades.flat_map(of_decade).filter(|place| (low..=high).contains(place)).collect()
    };
    let fit = |marks: &Vec<f64>, least: f64| {
        marks.len() as i64 >= FEWEST && marks.windows(2).all(|pair| pair[1] - pair[0] >= least)
    };
    let mut all = DIGITS.iter().map(marks);
    let far = all.clone().rfind(|marks| fit(marks, least));
    far.or_else(|| all.find(|marks| fit(marks, NEARER * least)))
}

/// The number at a mark that [`decades`] made, with its unit.
pub(super) fn decade_label(mark: GridMark, unit: &str) -> String {
    with_unit(format!("10{}", superscript(mark.value.round() as i32)), unit)
}

fn with_unit(number: String, unit: &str) -> String {
    if unit.is_empty() { number } else { format!("{number} {unit}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The labels of an axis of `room` points over this range.
    fn labels(low: f64, high: f64, room: f64, apart: f64) -> Vec<String> {
        let input =
            || GridInput { bounds: (low, high), base_step_size: FINEST * (high - low) / room };
        let label = |mark| linear_label(mark, &(low..=high), "m");
        linear(input(), apart).into_iter().map(label).collect()
    }

    #[test]
    fn marks_are_round_and_as_many_as_fit() {
        assert_eq!(labels(0.0, 20.0, 480.0, 70.0), ["0 m", "5 m", "10 m", "15 m", "20 m"]);
        assert_eq!(
            labels(-1.1, 1.1, 200.0, 30.0),
            ["\u{2212}1.0 m", "\u{2212}0.5 m", "0 m", "0.5 m", "1.0 m"]
        );
        assert_eq!(labels(3.4, 23.4, 200.0, 70.0), ["5 m", "10 m", "15 m", "20 m"]);
    }

    #[test]
    fn every_range_has_at_least_three_different_labels() {
        for exponent in [-300, -13, -9, -3, 0, 3, 9, 15, 37] {
            let size = libm::pow(10.0, f64::from(exponent));
            for (low, high) in [(0.0, 1.0), (-0.3, 0.8), (0.98, 1.02), (-5.0, -4.991), (1.0, 7.7)] {
                for room in [40.0, 110.0, 480.0] {
                    let named = labels(low * size, high * size, room, 28.0);
                    assert!(named.len() >= 3, "{low} to {high} times {size}: {named:?}");
                    let differ = named.windows(2).all(|pair| pair[0] != pair[1]);
                    assert!(differ, "{low} to {high} times {size}: {named:?}");
                }
            }
        }
    }

    #[test]
    fn powers_of_ten_are_marked_every_few_where_they_crowd() {
        let labels = |low: f64, high: f64, room: f64| -> Vec<String> {
            let base_step_size = FINEST * (high - low) / room;
            let marks = decades(GridInput { bounds: (low, high), base_step_size }, 28.0);
            marks.into_iter().map(|mark| decade_label(mark, "m")).collect()
        };
        assert_eq!(labels(-2.2, 0.2, 200.0), ["10⁻² m", "10⁻¹ m", "10⁰ m"]);
        assert_eq!(labels(-6.2, 0.2, 120.0), ["10⁻⁶ m", "10⁻⁴ m", "10⁻² m", "10⁰ m"]);
        assert_eq!(labels(-17.2, 3.2, 60.0).len(), 3);
        assert_eq!(labels(-2.2, 0.2, 10.0).len(), 3);
    }

    #[test]
    fn an_axis_of_few_decades_is_marked_at_round_numbers() {
        let numbers = |low: f64, high: f64, room: f64| -> Option<Vec<f64>> {
            let bounds = (libm::log10(low), libm::log10(high));
            let base_step_size = FINEST * (bounds.1 - bounds.0) / room;
            let marks = round_numbers(GridInput { bounds, base_step_size }, 24.0)?;
            Some(marks.into_iter().map(|x| (1e3 * libm::pow(10.0, x)).round() / 1e3).collect())
        };
        assert_eq!(numbers(0.4, 2.5, 80.0), Some(vec![0.5, 1.0, 2.0]));
        assert_eq!(numbers(0.78, 1.28, 80.0), Some(vec![0.8, 1.0, 1.2]));
        assert_eq!(numbers(0.09, 1.1, 80.0), Some(vec![0.1, 0.3, 1.0]));
        assert_eq!(numbers(0.09, 1.1, 100.0), Some(vec![0.1, 0.2, 0.5, 1.0]));
        assert_eq!(numbers(0.98, 1.02, 80.0), None);
        assert_eq!(numbers(0.47, 2.1, 50.0), Some(vec![0.5, 1.0, 2.0]));
        assert_eq!(numbers(0.4, 2.5, 30.0), None);
    }

    #[test]
    fn small_and_large_numbers_have_a_power_of_ten() {
        assert_eq!(labels(-3e-13, 3e-13, 120.0, 28.0)[0], "\u{2212}2·10⁻¹³ m");
        assert_eq!(labels(0.0, 2.5e7, 120.0, 50.0), ["0 m", "1·10⁷ m", "2·10⁷ m"]);
    }
}
