//! From simulated seconds to ticks, across the changes of tick rate that a script makes.

use super::action::Action;
use super::lab::Lab;
use super::scene::Scene;

/// The tolerance, in ticks, by which a tie between two ticks goes to the later one: a time may be off by its last bit.
const TIE: f64 = 1e-6;

impl Scene {
    /// The ticks from `tick` on at which the script sets a tick rate, in order, with that rate in Hz.
    pub fn rates_from(&self, tick: u64) -> impl Iterator<Item = (u64, u32)> {
        let first = self.script.partition_point(|scripted| scripted.tick < tick);
        self.script[first..].iter().filter_map(|scripted| match scripted.action {
            Action::TickHz(tick_hz) => Some((scripted.tick, tick_hz)),
            _ => None,
        })
    }
}

impl Lab {
    /// The fractional tick at which `seconds` of simulated time have passed, if only the script changes the tick rate from
    /// now on; the present tick if they have passed already.
    pub fn tick_at(&self, seconds: f64) -> f64 {
        let race = self.race();
        let (mut tick, mut t, mut tick_hz) = (race.tick(), race.t(), race.tick_hz());
        for (at, next_hz) in self.scene().rates_from(tick) {
            let reached = t + (at - tick) as f64 / f64::from(tick_hz);
            if reached >= seconds {
                break;
            }
            (tick, t, tick_hz) = (at, reached, next_hz);
        }
        tick as f64 + ((seconds - t) * f64::from(tick_hz)).max(0.0)
    }

    /// The tick nearest to `seconds` of simulated time, by [`Lab::tick_at`].
    pub fn nearest_tick(&self, seconds: f64) -> u64 {
        (self.tick_at(seconds) + TIE).round() as u64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1 Hz, from tick 5 on 100 Hz, from tick 45 on 2 Hz.
    fn lab() -> Lab {
        let text = "title = 'x'\ntick_hz = 1\nseconds = 9\n[[spring]]\nmass_kg = 1\n\
                    stiffness_n_per_m = 1\n[[command]]\ntick = 5\ntick_hz = 100\n\
                    [[command]]\ntick = 45\ntick_hz = 2\n";
        Lab::new(Scene::parse("x.toml", text).unwrap())
    }

    #[test]
    fn seconds_are_counted_across_the_rates_of_a_script() {
        for (seconds, tick) in [
            (0.0, 0),
            (0.4, 0),
            (4.4, 4),
            (4.5, 5),
            (5.0, 5),
            (5.2, 25),
            (5.254, 30),
            (5.4, 45),
            (5.6, 45),
            (5.65, 46),
            (9.4, 53),
        ] {
            assert_eq!(lab().nearest_tick(seconds), tick, "{seconds} s");
        }
    }

    #[test]
    fn the_tick_is_the_same_seen_from_any_tick_before_it() {
        let mut lab = lab();
        for tick in 0..60 {
            assert_eq!(lab.race().tick(), tick);
            assert_eq!(lab.nearest_tick(9.4), 53.max(tick));
            assert_eq!(lab.nearest_tick(lab.race().t()), tick);
            lab.tick();
        }
    }
}
