//! Stability of a method on a body: the map of a step about rest, its growth and its frequencies, compared with the true
//! motion.
//!
//! The acceleration of a body is linearised about rest, which changes nothing of a linear body. Where damping does not
//! couple its normal modes, a method acts on each of them alone; otherwise all coordinates are taken together. The map of
//! a step, of the state and of what the method carries from step to step, is found from the method's own steps, never
//! from a formula, so that it holds for any method with equal steps. Growth that the true motion has too, such as
//! the fall of an upright pendulum, is not counted against a method.
//!
//! Of a body of many coordinates the spectral radius alone is found, about its present state, by power iteration.

mod comparison;
mod deviation;
mod modes;
mod power;
mod search;
mod small_motion;
mod spectrum;
mod tick;
mod trend;

pub use comparison::{FOREVER_S, Stability};
pub use modes::{NormalMode, unforced};
pub use power::PowerIteration;
pub use search::{RATES_HZ, RateSearch};
pub use small_motion::{CoupledMotion, NoSmallMotion, SmallMotion, normal_modes};
pub use tick::Tick;
