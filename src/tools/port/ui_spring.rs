//! Ports a motion to the springs of user-interface libraries, and shows the effect of the frame rate on it.
//!
//! Each library takes the distance to the target as the stretch. The mass is 1 if the library has none of its own.

use nalgebra::Matrix2;

use super::follow::map_of_frame;
use super::seen::{is_stable, spring_of_map};
use super::{PortOutcome, REACHED, Wish};
use crate::identify::Effective;
use crate::sim::bodies::Spring;
use crate::sim::integrators::{QtSpring, ReactSpring, in_code, method};
use crate::sim::number::significant;
use crate::sim::numerics::bisect;
use crate::sim::{Body, State};

mod cards;
mod curve;
mod ends;
mod numbers;

pub use cards::UI_SPRINGS;
use curve::Curve;
use ends::Rest;
pub use ends::{End, SETTLED, settled_s};

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

impl Key {
    fn takes(&self, value: f64) -> bool {
        (self.range[0]..=self.range[1]).contains(&value)
    }
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

fn all_values(values: &[f64]) -> Values {
    let mut all = Values::default();
    all.iter_mut().zip(values).for_each(|(to, from)| *to = *from);
    all
}

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
    /// The library changes the velocity once a frame by a step of 1/60 s, and moves by the frame's length, which it
    /// cuts to this many seconds.
    Kick(f64),
    /// The library makes steps of semi-implicit Euler of 16 ms.
    Sixteen,
    /// The library makes steps of semi-implicit Euler of 1 ms. A frame's number of steps is rounded up, to at most 64.
    /// The first frame has 17 steps at every frame rate.
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
    /// Converts values to the motion of their equation. `None` if values of this library do not determine a motion.
    read: Option<fn(Values) -> Wish>,
    /// Converts values to the motion that the library shows, if it limits values.
    limited: Option<fn(Values) -> Wish>,
    /// Returns the values that come nearest to a motion.
    write: fn(&Wish) -> Values,
    steps: Steps,
    /// Returns the point at which a motion leaves the closed form, if it does.
    departure: fn(&Wish) -> Option<Departure>,
    /// The rule by which the library ends a motion.
    rest: Rest,
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
    /// Time in seconds by which a motion through points starts later, to be nearest to the frames of another library.
    pub delay_s: Option<f64>,
    /// The end of the motion over a way of 1, if the library's rule ends it.
    pub ends: Option<End>,
    /// The line of code; empty if the library has no values for the wish.
    pub code: String,
}

/// Frame rate in Hz that stands in for an unknown one.
pub const USUAL_FRAME_HZ: f64 = 60.0;
/// Points show another motion if their error is larger than this, as a fraction of the way.
const ASTRAY: f64 = 0.1;
/// Lowest and highest frame rate per second in the search for the limit of stability, and number of times that the
/// interval is halved.
const RATES: [f64; 2] = [1e-6, 1e12];
const HALVINGS: u32 = 60;
/// Step of the velocity in a frame, in seconds.
const KICK_S: f64 = 1.0 / 60.0;

/// Returns the fraction of the way that is left at this angle (ω times the time), and its change per angle. The spring
/// starts at rest, and has this damping ratio.
fn left_at(damping_ratio: f64, angle: f64) -> [f64; 2] {
    let spring =
        Spring { mass: 1.0, stiffness: 1.0, damping: 2.0 * damping_ratio, ..Spring::default() };
    let left = spring.exact(angle, &State { q: 1.0, v: 0.0 });
    let State { q, v } = left.expect("a spring has a closed form");
    [q, v]
}

/// Returns the fraction of the way that is left, as [`left_at`] does.
pub(super) fn part_left(damping_ratio: f64, angle: f64) -> f64 {
    left_at(damping_ratio, angle)[0]
}

/// Formats a number as [`in_code`] does, but without an exponent.
fn decimal(value: f64) -> String {
    let rounded = format!("{value:.8e}").parse::<f64>();
    rounded.unwrap_or(value).to_string()
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

    /// Whether the library has a rule that ends a motion.
    pub fn has_end(&self) -> bool {
        !matches!(self.rest, Rest::Never)
    }

    /// Whether the library takes a mass.
    pub fn has_mass(&self) -> bool {
        self.keys.iter().any(|key| key.name == "mass")
    }

    /// Returns the motion that these values of the library's keys determine, by their equation.
    ///
    /// # Errors
    /// If the values determine no motion, or if a value is out of its range; the error explains the first fault in
    /// words.
    pub fn as_given(&self, values: &[f64]) -> Result<Wish, String> {
        let read = self.read.ok_or_else(|| {
            format!("{} is points of a motion, from which it cannot be told", self.name)
        })?;
        for (key, value) in self.keys.iter().zip(values) {
            let Key { name, wanted, .. } = key;
            if !key.takes(*value) {
                return Err(format!("{name} is {value}; it must be {wanted}"));
            }
        }
        Ok(read(all_values(values)))
    }

    /// Like [`UiSpring::as_given`], within the library's limits.
    ///
    /// # Errors
    /// As [`UiSpring::as_given`].
    pub fn read(&self, values: &[f64]) -> Result<Wish, String> {
        let given = self.as_given(values)?;
        Ok(self.limited.map_or(given, |limited| limited(all_values(values))))
    }

    /// Like [`UiSpring::read`], as it moves at this many frames per second.
    ///
    /// # Errors
    /// As [`UiSpring::read`], and if the motion is not that of a spring.
    pub fn shown(&self, values: &[f64], frame_hz: f64) -> Result<Wish, String> {
        let motion = self.read(values)?;
        let Some(map) = self.step_s(frame_hz).and(self.map(&motion, frame_hz)) else {
            return Ok(motion);
        };
        let of = |what| format!("so set, {} {what} at {frame_hz} frames per second", self.name);
        if !map.is_stable() {
            return Err(of("explodes"));
        }
        let seen = map.visible_motion().ok_or_else(|| of("moves as no spring does"))?;
        Ok(Wish::of(seen, motion.mass_kg))
    }

    /// Returns the library's stepping method, which is `exact`, or a method's id.
    pub fn steps(&self) -> &'static str {
        match self.steps {
            Steps::Exact | Steps::WholeMilliseconds | Steps::Sampled => "exact",
            Steps::PerFrame | Steps::Kick(_) | Steps::Sixteen | Steps::Milliseconds => {
                "semi-implicit-euler"
            }
            Steps::SmoothDamp => "smooth-damp",
        }
    }

    /// Returns the library's settings for a wish, whose numbers must [have a meaning](Wish::check_numbers), and the
    /// motion visible at this many frames per second.
    pub fn port(&self, wish: &Wish, frame_hz: f64) -> UiSpringPort {
        let values = (self.write)(&self.numbers(wish, frame_hz));
        let has_values = values.iter().all(|value| value.is_finite())
            && self.keys.iter().zip(values).all(|(key, value)| key.takes(value));
        let read = self.limited.or(self.read);
        let motion = read.filter(|_| has_values).map_or(*wish, |read| read(values));
        let (points, error) = match self.steps {
            Steps::Sampled if has_values => {
                let curve = Curve::of(wish, values);
                (curve.written(), curve.error(wish))
            }
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
            delay_s: None,
            ends: self.end(&motion, values, frame_hz).filter(|_| has_values),
            code: if has_values { code } else { String::new() },
        }
    }

    /// Like [`UiSpring::port`], for the motion of another library that leaves these fractions of the way at its frames.
    /// A motion through points is held against them.
    pub fn port_of_frames(&self, wish: &Wish, left: &[f64], frame_hz: f64) -> UiSpringPort {
        let mut port = self.port(wish, frame_hz);
        if let (false, Some(_)) = (left.is_empty(), port.error) {
            let curve = Curve::of(wish, all_values(&port.values));
            let (delay_s, error) = curve.delay_to(left, frame_hz);
            if delay_s != 0.0 {
                port.code += &format!(" {delay_s}s");
            }
            (port.error, port.delay_s) = (Some(error), Some(delay_s));
            let end = (port.values[0] + delay_s) * frame_hz;
            let at_s = libm::ceil(end - 1e-6) / frame_hz;
            port.ends = port.ends.map(|end| End { at_s, ..end });
            if error > ASTRAY {
                (port.outcome, port.seen) = (PortOutcome::Unreachable, None);
            }
        }
        port
    }

    /// Returns the switches that these values turn on.
    pub fn switched_on(&self, values: &[f64]) -> impl Iterator<Item = &'static Switch> {
        let is_on =
            |(key, value): (&'static Key, &f64)| key.switch.as_ref().filter(|_| *value == 1.0);
        self.keys.iter().zip(values).filter_map(is_on)
    }

    /// Returns the seconds of a step for the velocity, for the way and on the clock; `None` for a closed form.
    fn step_s(&self, frame_hz: f64) -> Option<[f64; 3]> {
        let frame_s = 1.0 / frame_hz;
        match self.steps {
            Steps::Exact | Steps::WholeMilliseconds | Steps::Sampled | Steps::SmoothDamp => None,
            Steps::PerFrame => Some([frame_s; 3]),
            Steps::Kick(longest) => Some([KICK_S, frame_s.min(longest), frame_s]),
            Steps::Sixteen => Some([QtSpring::STEP_S; 3]),
            Steps::Milliseconds => {
                let step_s = ReactSpring::STEP_S;
                Some([step_s, step_s, step_s / pace(frame_hz)])
            }
        }
    }

    /// Returns the map of one step of this motion; `None` for a closed form.
    fn map(&self, motion: &Wish, frame_hz: f64) -> Option<StepMap> {
        if let Steps::SmoothDamp = self.steps {
            let method = method(self.steps()).expect("a method of the table");
            // A step without a finite map is unstable.
            let map = map_of_frame(method, motion.omega(), frame_hz);
            let map = map.unwrap_or(Matrix2::from_element(f64::INFINITY));
            return Some(StepMap { map, step_s: 1.0 / frame_hz });
        }
        let [kick_s, move_s, step_s] = self.step_s(frame_hz)?;
        let [stiffness, damping] = motion.joint().map(|per_s| per_s * kick_s);
        let kept = 1.0 - damping;
        let map = Matrix2::new(1.0 - move_s * stiffness, move_s * kept, -stiffness, kept);
        Some(StepMap { map, step_s })
    }

    /// Returns the numbers whose steps show a wish at this many frames per second; the wish itself if none do.
    fn numbers(&self, wish: &Wish, frame_hz: f64) -> Wish {
        let Some([kick_s, move_s, step_s]) = self.step_s(frame_hz) else { return *wish };
        let Wish { damping_ratio: ratio, mass_kg, .. } = *wish;
        let apart = libm::sqrt((ratio * ratio - 1.0).abs());
        let [decay, angle] = [ratio, apart].map(|part| part * wish.omega() * step_s);
        if ratio < 1.0 && angle >= std::f64::consts::PI {
            return *wish;
        }
        // With the eigenvalues λ, these are (1 - λ₁)(1 - λ₂) and 1 - λ₁ λ₂.
        let stiffness = match ratio < 1.0 {
            true => {
                let [gone, half] = [libm::expm1(-decay), libm::sin(angle / 2.0)];
                gone * gone + 4.0 * libm::exp(-decay) * half * half
            }
            false => libm::expm1(angle - decay) * libm::expm1(-angle - decay),
        };
        let damping = -libm::expm1(-2.0 * decay);
        Wish::of_joint([stiffness / move_s / kick_s, damping / kick_s], mass_kg)
    }

    /// Returns the frames per second below which this motion explodes.
    fn explodes_below_hz(&self, motion: &Wish) -> Option<f64> {
        let (Steps::PerFrame | Steps::Kick(_)) = self.steps else { return None };
        let explodes = |log| self.map(motion, libm::exp(log)).is_some_and(|map| !map.is_stable());
        let rates = RATES.map(libm::log);
        let [_, high] = bisect(rates, HALVINGS, explodes);
        explodes(rates[0]).then(|| libm::exp(high))
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
                Some(error) => {
                    let at = port.delay_s.map_or(String::new(), |delay_s| {
                        let ms = significant(1e3 * delay_s, 2);
                        format!(" at these {frame_hz} frames per second, with a delay of {ms} ms")
                    });
                    format!("off by {} % of the way at most{at}", percent(error))
                }
                None => "without damping it never ends, and has no last point".into(),
            },
            Steps::Milliseconds if !port.is_stable => {
                "semi-implicit Euler by 1 ms: explodes at every frame rate".into()
            }
            Steps::Milliseconds => {
                let off = pace(frame_hz) - 1.0;
                let way = if off < 0.0 { "slow" } else { "fast" };
                format!(
                    "semi-implicit Euler by 1 ms, rounded up: its time runs {} % {way} at {frame_hz} frames per second, which these numbers allow for; the first frame is always 17 ms; lags below {} of them",
                    percent(off),
                    1.0 / ReactSpring::LONGEST_S,
                )
            }
            Steps::SmoothDamp => "a rational function for the exponential: never explodes".into(),
            Steps::Sixteen => "semi-implicit Euler by 16 ms, at every frame rate".into(),
            Steps::Kick(_) => {
                let below = match port.explodes_below_hz {
                    Some(hz) => format!("explodes below {} frames per second", significant(hz, 3)),
                    None => "never explodes".into(),
                };
                format!(
                    "v changes once a frame, however long it is: these numbers are for {frame_hz} frames per second; {below}"
                )
            }
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
    /// Length of the step on the clock, in seconds.
    step_s: f64,
}

impl StepMap {
    /// Whether no motion grows.
    fn is_stable(&self) -> bool {
        is_stable(self.map.trace(), self.map.determinant())
    }

    /// Returns the damped spring with the same motion.
    fn visible_motion(&self) -> Option<Effective> {
        spring_of_map(self.map.trace(), self.map.determinant(), self.step_s)
    }
}

/// Returns the number of simulated seconds per second in react-spring, which rounds each frame up to whole steps.
fn pace(frame_hz: f64) -> f64 {
    ReactSpring::steps(1.0 / frame_hz) * ReactSpring::STEP_S * frame_hz
}
