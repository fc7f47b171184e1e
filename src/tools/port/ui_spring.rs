//! Ports a motion to the springs of user-interface libraries, and shows the effect of the frame rate on it.
//!
//! Each library takes the distance to the target as the stretch. The mass is 1 if the library has none of its own.

use std::fmt::Write;

use nalgebra::Matrix2;

use super::follow::map_of_frame;
use super::seen::{is_stable, map_of_step, spring_of_map};
use super::{PortOutcome, REACHED, Wish};
use crate::sim::bodies::Spring;
use crate::sim::integrators::{in_code, method};
use crate::sim::number::significant;
use crate::sim::numerics::bisect;
use crate::sim::{Body, State};
use crate::tools::identify::Effective;

mod cards;

pub use cards::UI_SPRINGS;

/// A number that a library takes.
#[derive(Debug)]
pub struct Key {
    /// Name as the library spells it.
    pub name: &'static str,
    /// Default value in the library.
    pub usual: f64,
    /// Smallest and largest valid value.
    pub range: [f64; 2],
    /// The valid range in words.
    pub wanted: &'static str,
    /// The switch, if the number is a switch with the values 0 and 1.
    pub switch: Option<Switch>,
}

/// A setting that is on or off.
#[derive(Debug)]
pub struct Switch {
    /// The statement that turns the setting on.
    code: &'static str,
    /// A note for people while the setting is on.
    pub note: &'static str,
}

/// Values of a dialect's keys; unused places are 0.
type Values = [f64; 4];

/// The way in which a library advances from frame to frame.
#[derive(Clone, Copy, Debug)]
enum Steps {
    /// The library uses the closed form.
    Exact,
    /// The library uses the closed form, at times cut to whole milliseconds.
    WholeMilliseconds,
    /// The library moves along straight lines between points of the closed form.
    Sampled,
    /// The library makes a step of semi-implicit Euler in each frame.
    PerFrame,
    /// The library makes steps of semi-implicit Euler of 1 ms. A frame's number of steps is rounded up, to at most 64.
    Milliseconds,
    /// The library makes a step of the follower `smooth-damp` in each frame.
    SmoothDamp,
}

/// A library's way to set a spring.
#[derive(Debug)]
pub struct UiSpring {
    /// Id on the command line.
    pub id: &'static str,
    /// Name for people.
    pub name: &'static str,
    /// The numbers that the library takes, up to four.
    pub keys: &'static [Key],
    /// The file or page that shows how the library reads these numbers and how it steps.
    pub source: &'static str,
    /// The release or commit against which the card was checked; empty for code of your own.
    pub version: &'static str,
    /// How the card was checked against that version.
    pub evidence: &'static str,
    /// Converts values to a motion. `None` if values of this library do not determine a motion.
    read: Option<fn(Values) -> Wish>,
    /// Returns the values that come nearest to a motion.
    write: fn(&Wish) -> Values,
    steps: Steps,
    /// Returns the point at which a motion leaves the closed form, if it does.
    departure: fn(&Wish) -> Option<Departure>,
    /// A line of code with `<name>` in place of a key's value, or `<name:decimal>` if the language has no exponents.
    code: &'static str,
}

/// The point at which a library leaves the closed form.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Departure {
    /// Time from the start, in seconds.
    pub at_s: f64,
    /// Fraction of the way that is left at that time.
    pub left: f64,
    /// Damping ratio from then on; `None` if the motion jumps to its end.
    pub damping_ratio: Option<f64>,
}

/// A library's settings for a wish, and the motion that they show.
#[derive(Clone, Debug, PartialEq)]
pub struct UiSpringPort {
    /// Whether the settings show the wish. It is unreachable if the library damps more or explodes.
    pub outcome: PortOutcome,
    /// Values of the keys, in the order of the keys.
    pub values: Vec<f64>,
    /// Frames per second below which the motion explodes; `None` if this does not depend on the frame rate.
    pub explodes_below_hz: Option<f64>,
    /// Whether the motion stays bounded at the frame rate.
    pub is_stable: bool,
    /// The visible motion at the frame rate; `None` if no single damped spring moves like this.
    pub seen: Option<Effective>,
    /// The point at which the motion leaves the closed form, if it does.
    pub departure: Option<Departure>,
    /// Largest error of a motion drawn through points, as a fraction of the way.
    pub error: Option<f64>,
    /// The line of code; empty if the library has no values for the wish.
    pub code: String,
}

/// Number of places at which the error is sampled.
const PLACES: u32 = 20_000;
/// Points show another motion if their error is larger than this, as a fraction of the way.
const ASTRAY: f64 = 0.1;
/// Lowest and highest frame rate per second in the search for the limit of stability, and number of times that the
/// interval is halved.
const RATES: [f64; 2] = [1e-6, 1e12];
const HALVINGS: u32 = 60;
/// Step of react-spring in seconds, and maximum number of steps in a frame.
const STEP_S: f64 = 1e-3;
const MAX_STEPS: f64 = 64.0;

/// Returns the fraction of the way that is left at this angle (ω times the time) for a spring that starts at rest with
/// this damping ratio.
fn part_left(damping_ratio: f64, angle: f64) -> f64 {
    let spring =
        Spring { mass: 1.0, stiffness: 1.0, damping: 2.0 * damping_ratio, ..Spring::default() };
    let left = spring.exact(angle, &State { q: 1.0, v: 0.0 });
    left.expect("a spring has a closed form").q
}

/// Formats a number as [`in_code`] does, but without an exponent.
fn decimal(value: f64) -> String {
    let rounded = format!("{value:.8e}").parse::<f64>();
    rounded.unwrap_or(value).to_string()
}

/// Returns the points of a motion as a style sheet writes them, and the largest error of the lines between these
/// points.
fn curve(wish: &Wish, [duration, points, ..]: Values) -> (String, f64) {
    let pieces = points as u32 - 1;
    let at = |place: f64| 1.0 - part_left(wish.damping_ratio, wish.omega() * duration * place);
    let point = |i: u32| match i == pieces {
        true => 1.0,
        false => (1e4 * at(f64::from(i) / f64::from(pieces))).round() / 1e4,
    };
    let (mut written, mut error) = ("0".to_owned(), 0.0_f64);
    let parts = PLACES / pieces;
    for i in 0..pieces {
        let [from, to] = [point(i), point(i + 1)];
        write!(written, ", {to}").expect("a text takes all");
        for part in 0..=parts {
            let part = f64::from(part) / f64::from(parts);
            let exact = at((f64::from(i) + part) / f64::from(pieces));
            error = error.max((from + (to - from) * part - exact).abs());
        }
    }
    (written, error)
}

impl UiSpring {
    /// Returns the dialect with this id.
    pub fn of_id(id: &str) -> Option<&'static Self> {
        UI_SPRINGS.iter().find(|dialect| dialect.id == id)
    }

    /// Returns the version against which the card was checked, and how, in words; `None` for code of your own.
    pub fn checked_against(&self) -> Option<String> {
        let Self { version, evidence, .. } = self;
        (!version.is_empty()).then(|| format!("held against {version}, {evidence}"))
    }

    /// Whether the library's values determine a motion.
    pub fn is_read(&self) -> bool {
        self.read.is_some()
    }

    /// Whether the library takes a mass.
    pub fn has_mass(&self) -> bool {
        self.keys.iter().any(|key| key.name == "mass")
    }

    /// Returns the motion that these values of the library's keys determine.
    ///
    /// # Errors
    /// If the values determine no motion, or if a value is out of its range; the error explains the first fault in
    /// words.
    pub fn read(&self, values: &[f64]) -> Result<Wish, String> {
        let read = self.read.ok_or_else(|| {
            format!("{} is points of a motion, from which it cannot be told", self.name)
        })?;
        for (Key { name, range: [least, most], wanted, .. }, value) in self.keys.iter().zip(values)
        {
            if !(least..=most).contains(&value) {
                return Err(format!("{name} is {value}; it must be {wanted}"));
            }
        }
        let mut all = Values::default();
        all.iter_mut().zip(values).for_each(|(to, from)| *to = *from);
        Ok(read(all))
    }

    /// Returns the library's stepping method, which is `exact`, or a method's id.
    pub fn steps(&self) -> &'static str {
        match self.steps {
            Steps::Exact | Steps::WholeMilliseconds | Steps::Sampled => "exact",
            Steps::PerFrame | Steps::Milliseconds => "semi-implicit-euler",
            Steps::SmoothDamp => "smooth-damp",
        }
    }

    /// Returns the library's settings for a wish, whose numbers must [have a meaning](Wish::check_numbers), and the
    /// motion visible at this many frames per second.
    pub fn port(&self, wish: &Wish, frame_hz: f64) -> UiSpringPort {
        let values = (self.write)(wish);
        let has_values = values.iter().all(|value| value.is_finite());
        let motion = self.read.map_or(*wish, |read| read(values));
        let (points, error) = match self.steps {
            Steps::Sampled if has_values => curve(wish, values),
            _ => Default::default(),
        };
        let departure = (self.departure)(&motion);
        let map = self.map(&motion, frame_hz);
        let is_stable = map.as_ref().is_none_or(StepMap::is_stable);
        let seen = map.map_or(Some(motion.effective()), |map| map.visible_motion());
        let seen = seen.filter(|_| has_values && error <= ASTRAY && departure.is_none());
        let missed = seen.and_then(|seen| {
            let ratio = seen.damping_ratio()? - wish.damping_ratio;
            Some([(seen.undamped_hz() / wish.frequency_hz - 1.0).abs(), ratio])
        });
        let near = REACHED * (1.0 + wish.damping_ratio);
        let outcome = match missed {
            _ if !has_values => PortOutcome::Unreachable,
            _ if error > ASTRAY => PortOutcome::Unreachable,
            _ if departure.is_some_and(|it| it.damping_ratio > Some(wish.damping_ratio + near)) => {
                PortOutcome::Unreachable
            }
            _ if error > 0.0 => PortOutcome::Nearest,
            None if is_stable => PortOutcome::Nearest,
            Some([of_hz, ratio]) if of_hz <= REACHED && ratio.abs() <= near => PortOutcome::Reached,
            Some(_) if motion.damping_ratio <= wish.damping_ratio + near => PortOutcome::Nearest,
            _ => PortOutcome::Unreachable,
        };
        let mut code = self.code.replace("<ms>", &(1e3 * values[0]).round().to_string());
        code = code.replace("<curve>", &points);
        for (key, value) in self.keys.iter().zip(values) {
            code = code.replace(&format!("<{}>", key.name), &in_code(value));
            code = code.replace(&format!("<{}:decimal>", key.name), &decimal(value));
        }
        for switch in self.switched_on(&values) {
            code = format!("{code}; {}", switch.code);
        }
        UiSpringPort {
            outcome,
            values: values[..self.keys.len()].to_vec(),
            explodes_below_hz: self.explodes_below_hz(&motion),
            is_stable,
            seen,
            departure,
            error: (error > 0.0).then_some(error),
            code: if has_values { code } else { String::new() },
        }
    }

    /// Returns the switches that these values turn on.
    pub fn switched_on(&self, values: &[f64]) -> impl Iterator<Item = &'static Switch> {
        let is_on =
            |(key, value): (&'static Key, &f64)| key.switch.as_ref().filter(|_| *value == 1.0);
        self.keys.iter().zip(values).filter_map(is_on)
    }

    /// Returns the map of one step of this motion; `None` for a closed form.
    fn map(&self, motion: &Wish, frame_hz: f64) -> Option<StepMap> {
        let (step_s, pace) = match self.steps {
            Steps::Exact | Steps::WholeMilliseconds | Steps::Sampled => return None,
            Steps::PerFrame | Steps::SmoothDamp => (1.0 / frame_hz, 1.0),
            Steps::Milliseconds => (STEP_S, pace(frame_hz)),
        };
        let method = method(self.steps()).expect("a method of the table");
        let map = match self.steps {
            Steps::SmoothDamp => map_of_frame(method, motion.omega(), frame_hz),
            _ => map_of_step(method, motion.joint(), step_s),
        };
        // A step without a finite map is unstable.
        let map = map.unwrap_or(Matrix2::from_element(f64::INFINITY));
        Some(StepMap { map, step_s, pace })
    }

    /// Returns the frames per second below which this motion explodes.
    fn explodes_below_hz(&self, motion: &Wish) -> Option<f64> {
        let Steps::PerFrame = self.steps else { return None };
        let explodes = |log| self.map(motion, libm::exp(log)).is_some_and(|map| !map.is_stable());
        let [_, high] = bisect(RATES.map(libm::log), HALVINGS, explodes);
        Some(libm::exp(high))
    }

    /// Returns the effect of the frame rate on a port, in words.
    pub fn at_frame_rates(&self, port: &UiSpringPort, frame_hz: f64) -> String {
        let percent = |part: f64| significant(100.0 * part.abs(), 2);
        match self.steps {
            Steps::Exact | Steps::WholeMilliseconds => {
                let times = match (self.steps, port.departure) {
                    (Steps::Exact, None) => ": the same at every frame rate",
                    (Steps::Exact, Some(_)) => "",
                    _ => " at whole milliseconds: up to 1 ms behind",
                };
                let departs = port.departure.map(|Departure { at_s, left, damping_ratio }| {
                    let at = significant(at_s, 4);
                    match damping_ratio {
                        Some(ratio) => format!("; from {at} s on with a damping ratio of {ratio}"),
                        None => {
                            let left = percent(left);
                            format!(", cut to its end at {at} s, with {left} % of the way left")
                        }
                    }
                });
                format!("the closed form{times}{}", departs.unwrap_or_default())
            }
            Steps::Sampled => match port.error {
                Some(error) => format!("off by {} % of the way at most", percent(error)),
                None => "without damping it never ends, and has no last point".into(),
            },
            Steps::Milliseconds if !port.is_stable => {
                "semi-implicit Euler by 1 ms: explodes at every frame rate".into()
            }
            Steps::Milliseconds => {
                let off = pace(frame_hz) - 1.0;
                let way = if off < 0.0 { "slow" } else { "fast" };
                let turns = if port.seen.is_none() { "; changes sides at every step" } else { "" };
                format!(
                    "semi-implicit Euler by 1 ms, rounded up: {} % {way} at {frame_hz} frames per second; lags below {} of them{turns}",
                    percent(off),
                    1.0 / (MAX_STEPS * STEP_S),
                )
            }
            Steps::SmoothDamp => "a rational function for the exponential: never explodes".into(),
            Steps::PerFrame => {
                let below = port.explodes_below_hz.map_or("any".into(), |hz| significant(hz, 3));
                let turns = match port.seen.is_none() && port.is_stable {
                    true => "; changes sides at every frame",
                    false => "",
                };
                format!(
                    "semi-implicit Euler once a frame: explodes below {below} frames per second{turns}"
                )
            }
        }
    }
}

/// The map of distance and velocity over a step.
struct StepMap {
    map: Matrix2<f64>,
    /// Length of the step, in seconds.
    step_s: f64,
    /// Number of simulated seconds per second.
    pace: f64,
}

impl StepMap {
    /// Whether no motion grows.
    fn is_stable(&self) -> bool {
        is_stable(self.map.trace(), self.map.determinant())
    }

    /// Returns the damped spring with the same motion.
    fn visible_motion(&self) -> Option<Effective> {
        let Self { map, step_s, pace } = self;
        let Effective { omega, decay } = spring_of_map(map.trace(), map.determinant(), *step_s)?;
        Some(Effective { omega: pace * omega, decay: pace * decay })
    }
}

/// Returns the number of simulated seconds per second in react-spring, which rounds each frame up to whole steps.
fn pace(frame_hz: f64) -> f64 {
    libm::ceil(1.0 / STEP_S / frame_hz).min(MAX_STEPS) * STEP_S * frame_hz
}
