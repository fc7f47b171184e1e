//! Finds how many digits after the point the numbers of a log were printed with.

use super::Log;

/// Largest number of digits that is looked for, and largest error of a number with fewer, in units of its last one.
const MOST: i32 = 9;
const WHOLE: f64 = 1e-6;

impl Log {
    /// Returns the last printed digit of the coordinates and of the velocities, in units of the scale; 0 for numbers of
    /// full precision.
    pub(in crate::identify) fn printed(&self) -> [f64; 2] {
        let [of_x, of_v] = self.scale();
        let x = last_digit(self.rows.iter().map(|row| row.x));
        let v = last_digit(self.rows.iter().filter_map(|row| row.v));
        [x / of_x, v / of_v]
    }
}

fn last_digit(numbers: impl Iterator<Item = f64> + Clone) -> f64 {
    let is_whole = |digits: &i32| {
        let scale = libm::exp10(f64::from(*digits));
        numbers.clone().all(|number| (number * scale - (number * scale).round()).abs() <= WHOLE)
    };
    let digits = (0..=MOST).find(is_whole);
    digits.map_or(0.0, |digits| libm::exp10(-f64::from(digits)))
}

#[cfg(test)]
mod tests {
    use super::last_digit;

    #[test]
    fn the_last_digit_of_printed_numbers_is_found_and_doubles_have_none() {
        for (numbers, digit) in [
            ([0.25, 1.125, -3.0], 1e-3),
            ([0.333_333, 1e-6, 7.0], 1e-6),
            ([12.0, -3.0, 0.0], 1.0),
            ([1.0 / 3.0, 0.1, 2.0], 0.0),
        ] {
            let found = last_digit(numbers.into_iter());
            assert!((found - digit).abs() <= 1e-12 * digit, "{found} for {digit}");
        }
    }
}
