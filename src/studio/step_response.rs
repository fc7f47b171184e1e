//! The answer of a custom spring to a step: the exact one, and those of a game at two tick rates.

use std::iter;

use super::my_spring::{MySpring, overshoot_in_words};
use crate::sim::bodies::Spring;
use crate::sim::integrators::method;
use crate::sim::{Solver, TickRate, stepper};

/// Tick rates in Hz that a game is likely to meet.
const USUAL_HZ: [u32; 2] = [60, 144];
/// Number of points of the exact answer.
const POINTS: usize = 240;
/// Most and fewest periods that an answer shows, and the most ticks.
const MOST_PERIODS: f64 = 6.0;
const FEWEST_PERIODS: f64 = 0.75;
const MOST_TICKS: f64 = 20_000.0;
/// A place that a mass passes only if its swing grows.
const LOST: f64 = 3.0;

/// The places of a mass over time, where it begins at 0 and rests at 1.
pub struct StepResponse {
    /// Time between two places, in seconds.
    pub step_s: f64,
    /// The places, from the start on.
    pub places: Vec<f64>,
}

impl StepResponse {
    /// Returns the place that is drawn at time `t` (s), between two ticks on the straight line.
    pub fn at(&self, t: f64) -> f64 {
        let steps = (t / self.step_s).max(0.0);
        let [from, to] = [steps.floor() as usize, steps.floor() as usize + 1]
            .map(|index| self.places[index.min(self.places.len() - 1)]);
        from + (to - from) * steps.fract()
    }

    /// Says how far the mass goes beyond its rest.
    pub fn in_words(&self) -> String {
        let furthest = self.places.iter().fold(0.0_f64, |most, place| most.max(place.abs()));
        if furthest > LOST { "blows up".into() } else { overshoot_in_words(furthest - 1.0) }
    }
}

/// The same step of a spring, exact and at two tick rates.
pub struct StepResponses {
    /// Time after which the mass hardly moves, or after which enough of its swings were seen, in seconds.
    pub seconds: f64,
    /// The exact answer.
    pub exact: StepResponse,
    /// The answer at each tick rate, from the lowest on.
    pub at_rates: [(TickRate, StepResponse); 2],
}

impl MySpring {
    /// Returns the answers to a step under semi-implicit Euler, at this tick rate beside 144 Hz, or beside 60 Hz if the
    /// rate is 144 Hz.
    pub fn step_responses(self, tick_hz: TickRate) -> Option<StepResponses> {
        let [usual, fast] = USUAL_HZ.map(TickRate::from);
        let mut rates = [tick_hz, if tick_hz == fast { usual } else { fast }];
        rates.sort();
        let period_s = 1.0 / self.frequency_hz();
        let settled_s = self.settles_s().map_or(f64::INFINITY, |settles_s| 1.2 * settles_s);
        // Under strong damping the mass comes to rest over many periods without a swing.
        let most_s = if self.damping_ratio() < 1.0 { MOST_PERIODS * period_s } else { settled_s };
        let seconds = settled_s.clamp(FEWEST_PERIODS * period_s, most_s.max(period_s));
        let seconds = seconds.min(MOST_TICKS / rates[1].hz());
        let games = Solver::Method(method("semi-implicit-euler")?);
        let at_rates = rates.map(|rate| {
            let ticks = (seconds * rate.hz()).ceil() as usize + 1;
            (rate, self.step_response(games, 1.0 / rate.hz(), ticks))
        });
        let exact = self.step_response(Solver::Truth, seconds / POINTS as f64, POINTS);
        Some(StepResponses { seconds, exact, at_rates })
    }

    fn step_response(self, solver: Solver, step_s: f64, steps: usize) -> StepResponse {
        let Self { mass_kg: mass, stiffness_n_per_m: stiffness, .. } = self;
        let damping = self.damping_n_s_per_m;
        let spring = Spring { mass, stiffness, damping, x0: -1.0, ..Spring::default() };
        let mut mass = stepper(spring, solver);
        let moved = (0..steps).map_while(|step| {
            mass.advance(step as f64 * step_s, step_s, 1).ok()?;
            Some(1.0 + mass.q()[0]).filter(|place| place.is_finite())
        });
        StepResponse { step_s, places: iter::once(0.0).chain(moved).collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_overshoots_as_far_as_the_formula_says() {
        for ratio in [0.1, 0.3, 0.6] {
            let spring = MySpring::of_frequency(3.0, 2.0, ratio);
            let StepResponses { seconds, exact, at_rates } =
                spring.step_responses(60.into()).unwrap();
            let over = |response: &StepResponse| {
                response.places.iter().fold(0.0_f64, |most, place| most.max(*place)) - 1.0
            };
            assert!((over(&exact) - spring.overshoot()).abs() < 2e-3, "{ratio}");
            let [slow, fast] = at_rates.each_ref().map(|(_, it)| (over(it) - over(&exact)).abs());
            assert!(fast < 0.06 && slow < 0.12, "{ratio}: {slow} {fast}");
            for (rate, response) in &at_rates {
                assert!(response.places.len() as f64 > seconds * rate.hz(), "{ratio} {rate}");
                let middle = (response.places[3] + response.places[4]) / 2.0;
                assert!((response.at(3.5 / rate.hz()) - middle).abs() < 1e-12);
                assert_eq!(response.at(1e9), *response.places.last().unwrap());
            }
        }
    }

    #[test]
    fn every_spring_that_may_be_described_has_a_finite_answer() {
        for frequency_hz in [1e-5, 0.01, 1.0, 25.0, 4000.0] {
            for ratio in [0.0, 0.2, 1.0, 3.0, 1e5] {
                let spring = MySpring::of_frequency(2.0, frequency_hz, ratio);
                for hz in [5, 60, 144, 1000] {
                    let seen = spring.step_responses(hz.into()).unwrap();
                    let [(low, _), (high, _)] = &seen.at_rates;
                    assert!(low.hz() < high.hz(), "{low} {high}");
                    assert!(seen.seconds > 0.0 && seen.seconds.is_finite(), "{frequency_hz}");
                    let all = seen.at_rates.iter().map(|(_, it)| it).chain([&seen.exact]);
                    assert!(all.flat_map(|it| &it.places).all(|place| place.is_finite()));
                }
            }
        }
        let stiff = MySpring::of_frequency(1.0, 25.0, 0.0).step_responses(60.into()).unwrap();
        assert_eq!(stiff.at_rates[0].1.in_words(), "blows up");
        assert!(stiff.at_rates[1].1.in_words().starts_with("overshoots"));
    }
}
