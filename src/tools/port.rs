//! Finds the settings with which a spring moves the same in every engine.
//!
//! [`Setup::visible_motion`] measures an engine's map of a tick on the engine's stepper. Inverting that map gives the
//! stiffness and damping under which the engine shows a wished motion. The body is on a line and has no drag; the
//! anchor of the spring rests.

use super::identify::Effective;
use crate::scene::Swing;
use crate::sim::integrators::{METHODS, Method};

mod drive;
mod first_second;
mod follow;
mod friction;
mod inverse;
pub(super) mod seen;
mod ui_spring;

pub use drive::{DriveLimits, GainRange, drive_limits};
pub use first_second::FirstSecond;
pub use follow::{Approach, FollowerPort, followers};
pub use friction::Friction;
use inverse::{EvaluatedJoint, invert, min_damping};
pub use seen::Setup;
pub use ui_spring::{
    Departure, End, Key, SETTLED, Switch, UI_SPRINGS, USUAL_FRAME_HZ, UiSpring, UiSpringPort,
    settled_s,
};

/// The motion that a player should see of a spring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wish {
    /// Frequency of the swing without damping, in hertz.
    pub frequency_hz: f64,
    /// Damping ratio (1 = critical).
    pub damping_ratio: f64,
    /// Mass on the spring, in kg.
    pub mass_kg: f64,
}

/// The reason why no engine can show a wish at a tick rate.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum WishError {
    /// A number has no meaning.
    #[error("{what} is {value}; give {wanted}")]
    OutOfRange {
        /// Name of the number.
        what: &'static str,
        /// Value of the number.
        value: f64,
        /// Valid range of the number, in words.
        wanted: &'static str,
    },
    /// A swing takes two ticks or fewer.
    #[error(
        "{frequency_hz} Hz cannot be seen at {tick_hz} ticks per second, but less than half of them; tick faster than {} Hz",
        2.0 * frequency_hz
    )]
    BeyondNyquist {
        /// The wished frequency, in hertz.
        frequency_hz: f64,
        /// The tick rate, in hertz.
        tick_hz: f64,
    },
    /// A swing takes such a large number of ticks that rounding hides it.
    #[error(
        "a swing of {frequency_hz} Hz takes more than {MAX_TICKS} ticks at {tick_hz} Hz, so that rounding hides it; give more than {} Hz, or tick slower",
        tick_hz / MAX_TICKS
    )]
    TooSlow {
        /// The wished frequency, in hertz.
        frequency_hz: f64,
        /// The tick rate, in hertz.
        tick_hz: f64,
    },
    /// A part of the motion is over within a tick.
    #[error(
        "a damping ratio of {damping_ratio} at {frequency_hz} Hz is over within a tick of {tick_hz} Hz; damp less, or tick faster"
    )]
    TooFast {
        /// The wished damping ratio.
        damping_ratio: f64,
        /// The wished frequency, in hertz.
        frequency_hz: f64,
        /// The tick rate, in hertz.
        tick_hz: f64,
    },
}

/// Largest exponent by which the fast part of a damped motion may decay in a tick. Beyond it, rounding hides that part.
const MAX_DECAY: f64 = 16.0;
/// Maximum number of ticks in a swing. With more, the map of a tick equals, to rounding, the map without a spring.
const MAX_TICKS: f64 = 30_000.0;
/// Largest error of a reached wish: relative in the frequency, absolute in the damping ratio.
const REACHED: f64 = 1e-8;
/// Maximum number of substeps that are tried.
const MAX_SUBSTEPS: u32 = 64;

impl Wish {
    /// Checks that the wish's numbers and a tick rate in hertz have a meaning.
    ///
    /// # Errors
    /// Fails with the first number without a meaning.
    pub fn check_numbers(&self, tick_hz: f64) -> Result<(), WishError> {
        let &Self { frequency_hz, damping_ratio, mass_kg } = self;
        let positive = |value: f64| value > 0.0 && value.is_finite();
        let numbers = [
            ("the frequency", frequency_hz, positive(frequency_hz), "hertz above 0"),
            (
                "the damping ratio",
                damping_ratio,
                damping_ratio == 0.0 || positive(damping_ratio),
                "0 or more",
            ),
            ("the mass", mass_kg, positive(mass_kg), "kilograms above 0"),
            ("the tick rate", tick_hz, positive(tick_hz), "hertz above 0"),
        ];
        if let Some((what, value, _, wanted)) = numbers.into_iter().find(|(.., fits, _)| !fits) {
            return Err(WishError::OutOfRange { what, value, wanted });
        }
        Ok(())
    }

    /// Checks that an engine can show the wish at this tick rate in hertz.
    ///
    /// # Errors
    /// Fails with the first reason against the wish.
    pub fn check(&self, tick_hz: f64) -> Result<(), WishError> {
        self.check_numbers(tick_hz)?;
        let &Self { frequency_hz, damping_ratio, .. } = self;
        if 2.0 * frequency_hz >= tick_hz {
            return Err(WishError::BeyondNyquist { frequency_hz, tick_hz });
        }
        if frequency_hz * MAX_TICKS < tick_hz {
            return Err(WishError::TooSlow { frequency_hz, tick_hz });
        }
        let apart = libm::sqrt((damping_ratio * damping_ratio - 1.0).max(0.0));
        if self.omega() / tick_hz * (damping_ratio + apart) > MAX_DECAY {
            return Err(WishError::TooFast { damping_ratio, frequency_hz, tick_hz });
        }
        Ok(())
    }

    /// Returns the angular frequency, in rad/s.
    fn omega(&self) -> f64 {
        std::f64::consts::TAU * self.frequency_hz
    }

    /// Returns the stiffness in 1/s² and damping in 1/s, each per unit of mass, by the equation of motion.
    pub fn joint(&self) -> [f64; 2] {
        let &Self { frequency_hz, damping_ratio, .. } = self;
        Swing { frequency_hz, damping_ratio }.per_mass()
    }

    /// Returns the wish for a spring with this stiffness in 1/s² and damping in 1/s, each per unit of mass, by the
    /// equation of motion.
    pub fn of_joint([stiffness, damping]: [f64; 2], mass_kg: f64) -> Self {
        let omega = stiffness.sqrt();
        Self::of(Effective { omega, decay: damping / 2.0 }, mass_kg)
    }

    /// Returns the wish for the visible spring of `v = (v + (target - x) * stiffness) * kept; x += v` once a frame, on
    /// this mass in kg.
    ///
    /// # Errors
    /// If the rule grows or changes sides in each frame; the error explains this in words.
    pub fn of_decay_per_frame(
        [stiffness, kept]: [f64; 2],
        fps: f64,
        mass_kg: f64,
    ) -> Result<Self, String> {
        // A frame maps x and v by [[1 - dk, d], [-dk, d]], with k the stiffness and d the kept part.
        let [trace, determinant] = [1.0 + kept - kept * stiffness, kept];
        if kept > 1.0 {
            return Err(format!("so set it grows: {kept} of v is left; leave at most 1"));
        }
        if !seen::is_stable(trace, determinant) {
            return Err(format!(
                "so set it grows; the stiffness is below {}",
                2.0 * (1.0 + kept) / kept
            ));
        }
        let seen = seen::spring_of_map(trace, determinant, 1.0 / fps);
        let seen =
            seen.ok_or("so set it jumps to the other side in each frame, as no spring does")?;
        Ok(Self::of(seen, mass_kg))
    }

    /// Returns the wished motion.
    fn effective(&self) -> Effective {
        Effective { omega: self.omega(), decay: self.damping_ratio * self.omega() }
    }

    /// Returns the wish for this visible motion, on this mass in kg.
    pub fn of(seen: Effective, mass_kg: f64) -> Self {
        let damping_ratio = seen.damping_ratio().unwrap_or(0.0);
        Self { frequency_hz: seen.undamped_hz(), damping_ratio, mass_kg }
    }
}

/// Whether an engine shows a wish.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PortOutcome {
    /// The engine shows the wish, to rounding.
    Reached,
    /// The engine does not show the wish, or only after a second; the settings come nearest.
    Nearest,
    /// The engine does not show the wish, because the engine itself damps more; the settings come nearest.
    Unreachable,
}

impl PortOutcome {
    /// Returns the word for output.
    pub fn id(self) -> &'static str {
        match self {
            PortOutcome::Reached => "reached",
            PortOutcome::Nearest => "nearest",
            PortOutcome::Unreachable => "unreachable",
        }
    }
}

/// A change that lowers an engine's own damping.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relief {
    /// The engine with twice the substeps or, if that does not help, at twice the tick rate.
    pub setup: Setup,
    /// Smallest damping ratio with this change.
    pub damping_ratio: f64,
    /// Minimum number of substeps that reach the wished damping ratio, doubled from the present number; `None` if more
    /// substeps do not help.
    pub enough: Option<u32>,
}

/// An engine's settings for a wish.
#[derive(Clone, Debug, PartialEq)]
pub struct Ported {
    /// The engine with its mode, tick rate and substeps.
    pub setup: Setup,
    /// Whether the settings show the wish.
    pub outcome: PortOutcome,
    /// Values of the mode's settings.
    pub values: [f64; 2],
    /// The visible motion with these values.
    pub sees: Effective,
    /// The errors in the first second, if a tick is not linear, so that the values are chosen by them.
    pub first_second: Option<FirstSecond>,
    /// Smallest damping ratio at the wished frequency, if the engine itself damps.
    pub floor: Option<f64>,
    /// The change that lowers `floor`, if the wish is below `floor`.
    pub relief: Option<Relief>,
    /// Stiffness in N/m and damping in N s/m of a custom force that reaches the wish if it is held through each tick.
    /// They are given only if the joint does not reach the wish.
    pub own_force: Option<[f64; 2]>,
}

impl Ported {
    /// Returns the code for these values, with the substeps unless they are the engine's default.
    pub fn code(&self) -> String {
        self.setup.code(self.values)
    }
}

/// Returns every joint mode of these engines at this tick rate in hertz, with these substeps or else each method's
/// default. If `methods` is `None`, all engines are included.
pub fn setups(
    methods: Option<&[&'static Method]>,
    tick_hz: f64,
    substeps: Option<u32>,
) -> Vec<Setup> {
    let all = METHODS.iter().filter(|m| methods.is_none_or(|methods| methods.contains(m)));
    let modes = all.flat_map(|method| {
        let modes = method.engine.map_or(&[][..], |engine| engine.modes).iter();
        modes.map(move |mode| (method, mode))
    });
    let setup = |(method, mode): (&'static Method, _)| {
        let substeps = substeps.unwrap_or(method.default_substeps);
        Setup { method, mode, tick_hz, substeps }
    };
    modes.map(setup).collect()
}

/// Returns the settings with which an engine shows a wish, or comes nearest. On a tie, the settings that keep the
/// frequency win. `None` if the engine shows no spring that is near.
///
/// The wish must pass its [check](Wish::check) at the tick rate.
pub fn port(wish: &Wish, setup: Setup) -> Option<Ported> {
    let wanted = wish.effective();
    let sees = |joint| setup.visible_motion(joint);
    let by_second = match setup.mode.is_linear(wish.joint()[1]) {
        true => None,
        false => first_second::nearest(&setup, wish)
            .and_then(|(joint, errors)| Some((joint, sees(joint)?, errors))),
    };
    let (joint, seen, missed, first_second) = match by_second {
        Some((joint, seen, errors)) => (joint, seen, f64::INFINITY, Some(errors)),
        None => {
            let EvaluatedJoint { joint, seen, missed } = invert(&sees, &wanted)?;
            (joint, seen, missed, None)
        }
    };
    let least = min_damping(&sees, wanted.omega).map(|(_, ratio)| ratio);
    let floor = least.filter(|ratio| *ratio > REACHED);
    let is_below = floor.is_some_and(|floor| wish.damping_ratio < floor);
    let is_reached = missed <= REACHED && setup.mode.is_linear(joint[1]);
    let outcome = match is_reached {
        true => PortOutcome::Reached,
        false if is_below => PortOutcome::Unreachable,
        false => PortOutcome::Nearest,
    };
    let own_force = || {
        let found = invert(&|joint| setup.sees_held(joint, 1), &wanted)?;
        (found.missed <= REACHED).then(|| found.joint.map(|x| x * wish.mass_kg))
    };
    Some(Ported {
        setup,
        outcome,
        values: setup.mode.values(joint, wish.mass_kg),
        sees: seen,
        first_second,
        floor,
        relief: if outcome == PortOutcome::Unreachable {
            damping_relief(wish, setup, floor)
        } else {
            None
        },
        own_force: if outcome == PortOutcome::Reached { None } else { own_force() },
    })
}

/// Returns the change that lowers `floor`, which is twice the substeps or, if they do not help, twice the tick rate.
fn damping_relief(wish: &Wish, setup: Setup, floor: Option<f64>) -> Option<Relief> {
    let least =
        |setup: Setup| Some(min_damping(&|joint| setup.visible_motion(joint), wish.omega())?.1);
    let by = |times: u32| Setup { substeps: setup.substeps * times, ..setup };
    let lower = least(by(2)).filter(|ratio| floor.is_some_and(|floor| *ratio < 0.99 * floor));
    let Some(damping_ratio) = lower else {
        let setup = Setup { tick_hz: 2.0 * setup.tick_hz, ..setup };
        return Some(Relief { setup, damping_ratio: least(setup)?, enough: None });
    };
    let counts = (1..).map(|i| 1 << i).take_while(|times| setup.substeps * times <= MAX_SUBSTEPS);
    let enough = |times: &u32| least(by(*times)).is_some_and(|least| least <= wish.damping_ratio);
    let enough = counts.into_iter().find(enough).map(|times| setup.substeps * times);
    Some(Relief { setup: by(2), damping_ratio, enough })
}
