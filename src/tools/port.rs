//! The settings with which a spring moves the same in every engine.
//!
//! Each engine's map of a tick, which [`Setup::sees`] measures on its stepper, is inverted: for what a player is to see of
//! a spring, the stiffness and damping are sought under which the engine shows it. The body is on a line, has no drag, and
//! what holds the spring rests.

use super::identify::Effective;
use crate::scene::Swing;
use crate::sim::integrators::{METHODS, Method};

mod dialect;
mod drive;
mod follow;
mod friction;
mod inverse;
pub(super) mod seen;

pub use dialect::{DIALECTS, Departure, Dialect, DialectPort, Key, Switch};
pub use drive::{DriveLimits, GainRange, drive_limits};
pub use follow::{Approach, FollowerPort, followers};
pub use friction::Friction;
use inverse::{Found, invert, min_damping};
pub use seen::Setup;

/// What a player is to see of a spring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wish {
    /// The frequency at which it swings, or would without its damping, in hertz.
    pub frequency_hz: f64,
    /// The damping as a part of what just lets it swing no more.
    pub damping_ratio: f64,
    /// The mass on it, in kg.
    pub mass_kg: f64,
}

/// Why no engine shows a wish at a tick rate.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum WishError {
    /// A number has no meaning.
    #[error("{what} is {value}; give {wanted}")]
    OutOfRange {
        /// Which number.
        what: &'static str,
        /// What it is.
        value: f64,
        /// What it may be.
        wanted: &'static str,
    },
    /// Less than two ticks a swing.
    #[error(
        "{frequency_hz} Hz cannot be seen at {tick_hz} ticks per second, but less than half of them; tick faster than {} Hz",
        2.0 * frequency_hz
    )]
    BeyondNyquist {
        /// Of the wish.
        frequency_hz: f64,
        /// Ticks per second.
        tick_hz: f64,
    },
    /// So many ticks a swing that rounding hides it.
    #[error(
        "a swing of {frequency_hz} Hz takes more than {MAX_TICKS} ticks at {tick_hz} Hz, so that rounding hides it; give more than {} Hz, or tick slower",
        tick_hz / MAX_TICKS
    )]
    TooSlow {
        /// Of the wish.
        frequency_hz: f64,
        /// Ticks per second.
        tick_hz: f64,
    },
    /// A part of the motion is over within a tick.
    #[error(
        "a damping ratio of {damping_ratio} at {frequency_hz} Hz is over within a tick of {tick_hz} Hz; damp less, or tick faster"
    )]
    TooFast {
        /// Of the wish.
        damping_ratio: f64,
        /// Of the wish.
        frequency_hz: f64,
        /// Ticks per second.
        tick_hz: f64,
    },
}

/// The most that the fast part of a damped motion may decay in a tick, as an exponent: beyond it rounding hides it.
const MAX_DECAY: f64 = 16.0;
/// The most ticks of a swing: of more, the map of a tick is the same as without a spring, to rounding.
const MAX_TICKS: f64 = 30_000.0;
/// What is missed at most where a wish is reached: of the frequency as a part of it, and of the damping ratio.
const REACHED: f64 = 1e-8;
/// The most substeps that are tried to see how far more of them lead.
const MAX_SUBSTEPS: u32 = 64;

impl Wish {
    /// Finds whether its numbers and a tick rate in hertz have a meaning.
    ///
    /// # Errors
    /// The first that has none.
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

    /// Finds whether it can be seen at this tick rate in hertz.
    ///
    /// # Errors
    /// The first reason against it.
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

    /// 2π times the frequency, per second.
    fn omega(&self) -> f64 {
        std::f64::consts::TAU * self.frequency_hz
    }

    /// The stiffness in 1/s² and damping in 1/s, each per unit of mass, by the equation of motion.
    pub fn joint(&self) -> [f64; 2] {
        let &Self { frequency_hz, damping_ratio, .. } = self;
        Swing { frequency_hz, damping_ratio }.per_mass()
    }

    /// The wish whose spring has this stiffness in 1/s² and damping in 1/s, each per unit of mass, by the equation of motion.
    pub fn of_joint([stiffness, damping]: [f64; 2], mass_kg: f64) -> Self {
        let omega = stiffness.sqrt();
        Self::of(Effective { omega, decay: damping / 2.0 }, mass_kg)
    }

    /// What is seen of `v = (v + (target - x) * stiffness) * kept; x += v` once a frame, on this mass in kg.
    ///
    /// # Errors
    /// If it is no swing that dies away: how the rule moves.
    pub fn of_decay_per_frame(
        [stiffness, kept]: [f64; 2],
        fps: f64,
        mass_kg: f64,
    ) -> Result<Self, String> {
        // x and v times a frame go by [[1 - dk, d], [-dk, d]].
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
        let seen = seen::seen(trace, determinant, 1.0 / fps);
        let seen =
            seen.ok_or("so set it jumps to the other side in each frame, as no spring does")?;
        Ok(Self::of(seen, mass_kg))
    }

    /// What a player is to see.
    fn seen(&self) -> Effective {
        Effective { omega: self.omega(), decay: self.damping_ratio * self.omega() }
    }

    /// The wish for what is seen of a spring on this mass in kg.
    pub fn of(seen: Effective, mass_kg: f64) -> Self {
        let damping_ratio = seen.damping_ratio().unwrap_or(0.0);
        Self { frequency_hz: seen.undamped_hz(), damping_ratio, mass_kg }
    }
}

/// Whether an engine shows what is wished.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reach {
    /// It does, to rounding.
    Reached,
    /// It does not; the settings come nearest.
    Nearest,
    /// It does not, because it damps more by itself; the settings come nearest.
    Unreachable,
}

impl Reach {
    /// The word in output.
    pub fn id(self) -> &'static str {
        match self {
            Reach::Reached => "reached",
            Reach::Nearest => "nearest",
            Reach::Unreachable => "unreachable",
        }
    }
}

/// What lowers the damping that an engine has by itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relief {
    /// Twice the substeps; with those of before, the tick rate is twice as high.
    pub setup: Setup,
    /// The least damping ratio then.
    pub damping_ratio: f64,
    /// The fewest substeps, doubled from those of before, at which the wish is no lower; `None` if more do not help.
    pub enough: Option<u32>,
}

/// The settings of an engine for a wish.
#[derive(Clone, Debug, PartialEq)]
pub struct Ported {
    /// The engine, and how it is told.
    pub setup: Setup,
    /// Whether they lead there.
    pub reach: Reach,
    /// The values of the mode's settings.
    pub values: [f64; 2],
    /// What a player sees with them.
    pub sees: Effective,
    /// The least damping ratio at the wished frequency, where the engine has some by itself.
    pub floor: Option<f64>,
    /// What lowers it, where the wish is below it.
    pub relief: Option<Relief>,
    /// The stiffness in N/m and damping in N s/m of a custom force that the engine holds through each tick, with which
    /// the wish is reached; only where the joint does not.
    pub own_force: Option<[f64; 2]>,
}

impl Ported {
    /// The lines of code that set them, and the substeps where these are not the engine's own.
    pub fn code(&self) -> String {
        self.setup.code(self.values)
    }
}

/// Every mode of these engines, at this tick rate in hertz and with these substeps, or those of the card. `None` in the
/// place of methods stands for every engine.
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

/// The settings with which an engine shows a wish, or comes nearest. Of two that are as near, the frequency is kept.
/// `None` if it shows no spring that is near.
///
/// The wish must pass its [check](Wish::check) at the tick rate.
pub fn port(wish: &Wish, setup: Setup) -> Option<Ported> {
    let wanted = wish.seen();
    let sees = |joint| setup.sees(joint);
    let Found { joint, seen, missed } = invert(&sees, &wanted)?;
    let least = min_damping(&sees, wanted.omega).map(|(_, ratio)| ratio);
    let floor = least.filter(|ratio| *ratio > REACHED);
    let is_below = floor.is_some_and(|floor| wish.damping_ratio < floor);
    let reach = match missed <= REACHED {
        true => Reach::Reached,
        false if is_below => Reach::Unreachable,
        false => Reach::Nearest,
    };
    let own_force = || {
        let found = invert(&|joint| setup.sees_held(joint, 1), &wanted)?;
        (found.missed <= REACHED).then(|| found.joint.map(|x| x * wish.mass_kg))
    };
    Some(Ported {
        setup,
        reach,
        values: setup.mode.values(joint, wish.mass_kg),
        sees: seen,
        floor,
        relief: if reach == Reach::Unreachable { relief(wish, setup, floor) } else { None },
        own_force: if reach == Reach::Reached { None } else { own_force() },
    })
}

/// How far twice the substeps lead, or twice the rate.
fn relief(wish: &Wish, setup: Setup, floor: Option<f64>) -> Option<Relief> {
    let least = |setup: Setup| Some(min_damping(&|joint| setup.sees(joint), wish.omega())?.1);
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
