//! The options that set a tick rate, as ticks per second or as the length of a tick.

use clap::Args;

use super::argument::number_that;
use crate::sim::TickRate;

/// The tick rate of a run.
#[derive(Clone, Debug, Args)]
pub(super) struct TickRateArgs {
    /// Ticks per second [default: the scene's]
    ///
    /// From 0.01 to 10000, with at most nine digits after the point, such as 66.667, or a ratio, such as 60000/1001.
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    tick_hz: Option<TickRate>,

    /// The length of a tick, in place of --tick-hz
    ///
    /// From 0.0001 to 100 seconds, such as 0.015, 15ms or 1/66.667.
    #[arg(long, value_name = "s", value_parser = TickRate::of_step, conflicts_with = "tick_hz")]
    #[arg(allow_negative_numbers = true)]
    step: Option<TickRate>,
}

impl TickRateArgs {
    /// Returns the tick rate that is given, if any.
    pub(super) fn tick_rate(&self) -> Option<TickRate> {
        self.tick_hz.or(self.step)
    }
}

/// The tick rates of many runs.
#[derive(Clone, Debug, Args)]
pub(super) struct TickRatesArgs {
    /// Tick rates in Hz, separated by commas
    ///
    /// From 0.01 to 10000, with at most nine digits after the point, or ratios such as 60000/1001; by default octaves
    /// about the scene's own.
    #[arg(long, value_name = "N", value_delimiter = ',', allow_negative_numbers = true)]
    tick_hz: Vec<TickRate>,

    /// Lengths of a tick in seconds, in place of --tick-hz
    ///
    /// From 0.0001 to 100 seconds, separated by commas, such as 0.015 or 1/66.667.
    #[arg(long, value_name = "s", value_delimiter = ',', value_parser = TickRate::of_step)]
    #[arg(conflicts_with = "tick_hz", allow_negative_numbers = true)]
    step: Vec<TickRate>,
}

impl TickRatesArgs {
    /// Returns the tick rates that are given, ascending and without duplicates.
    pub(super) fn tick_rates(&self) -> Vec<TickRate> {
        let mut rates = [&self.tick_hz[..], &self.step[..]].concat();
        rates.sort_unstable();
        rates.dedup();
        rates
    }
}

/// Parses the tick rate of a game that ran elsewhere. It may be any number of hertz above 0, up to a million.
///
/// # Errors
/// A message with the valid range.
pub(super) fn rate_of_a_log(written: &str) -> Result<f64, String> {
    let wanted = "a rate above 0 and up to 1000000 Hz, such as 60";
    let number = |_| number_that(written, |hz| hz > 0.0 && hz <= 1e6, wanted);
    written.parse().map(TickRate::hz).or_else(number)
}

/// Parses the length of a tick in seconds, and returns the rate in hertz.
///
/// # Errors
/// A message with the valid form.
pub(super) fn rate_of_a_step(written: &str) -> Result<f64, String> {
    TickRate::of_step(written).map(TickRate::hz)
}
