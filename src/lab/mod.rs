//! The experiment: a scene, a clock, lanes racing against the truth, measurements, and the picture
//! they make.
//!
//! This layer knows no GPU, no window, no files and no wall clock: text comes in as `&str`, time as
//! integers, and what comes out is plain data. [`Lab`] holds it all together.

mod advice;
mod clock;
mod command;
mod display;
mod duration;
mod history;
mod judge;
#[expect(clippy::module_inception, reason = "the lab is what this layer is about")]
mod lab;
mod lane;
mod metrics;
pub mod number;
pub mod picture;
mod race;
pub mod round_off;
mod scene;
mod thinking;
mod trend;
mod verdict;

pub use crate::sim::stability::Stability;
pub use advice::{Advised, Adviser, Good, cheapest};
pub use clock::{Clock, Due};
pub use command::{Binding, Command, KEYS, Key, SPEED_LADDER, TICK_LADDER, command_for};
pub use display::{Ask, Display, Instrument, Interpolation, Mode, Pace};
pub use history::{CAPACITY, History, Sample};
pub use judge::{Judge, LONGEST_HORIZON_S, Outcome, TOLERANCE};
pub use lab::Lab;
pub use lane::{ESCAPE, Halt, Lane, LaneBody};
pub use metrics::{METRICS, Metric, Scale, Unit};
pub use race::{Entrant, Race};
pub use scene::{
    BuiltIn, LARGEST_FILE, LAST_TICK, LaneSpec, MOST_BODIES, MOST_LANES, MOST_NAME_CHARS,
    MOST_SECONDS, MOST_SHOWN, MOST_SUBSTEPS, MOST_TICK_HZ, SCENES, Scene, SceneBody, SceneError,
    SceneErrors, Scripted, TOLERANCES, nearest,
};
pub use thinking::{Advice, Findings, Question, Thinker};
pub use verdict::{Fate, Verdict, Word, duration};
