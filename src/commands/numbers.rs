//! Numbers of the command line, or else what is wanted.

/// A finite number on the command line that fits, or else what is wanted.
pub(super) fn number_that(
    written: &str,
    fits: fn(f64) -> bool,
    wanted: &str,
) -> Result<f64, String> {
    let number = written.parse::<f64>().ok().filter(|number| number.is_finite() && fits(*number));
    number.ok_or_else(|| format!("give {wanted}"))
}

/// A number of the command line that is not negative.
pub(super) fn number(written: &str) -> Result<f64, String> {
    number_that(written, |x| x >= 0.0, "a number from 0 up")
}

/// A frequency of the command line in Hz, which may have its unit behind it.
pub(super) fn frequency(written: &str) -> Result<f64, String> {
    let number = written.strip_suffix("Hz").unwrap_or(written).trim_end();
    number_that(number, |hz| hz > 0.0, "a frequency above 0 in Hz, such as 2.5Hz")
}

/// A number of the command line above 0.
pub(super) fn positive(written: &str) -> Result<f64, String> {
    number_that(written, |x| x > 0.0, "a number above 0")
}
