//! The experiment: a scene, a clock, lanes racing against the truth, measurements, and the picture
//! they make.
//!
//! This layer knows no GPU, no window, no files and no wall clock: text comes in as `&str`, time as
//! integers, and what comes out is plain data. [`Lab`] holds it all together.

mod analysis;
mod clock;
mod command;
mod display;
mod duration;
mod extent;
mod history;
#[expect(clippy::module_inception, reason = "the lab is what this layer is about")]
mod lab;
mod lane;
mod metrics;
mod notices;
pub mod number;
pub mod picture;
mod race;
pub mod round_off;
mod scene;
mod script;
mod truth_curve;

pub use analysis::{
    Advice, Advised, Adviser, CRITERIA, Criterion, Fate, Findings, Judge, LONG_RUN,
    LONGEST_HORIZON_S, MOST_ADVISED_SUBSTEPS, MOST_WORK, Meets, Met, NoTruth, NotJudged, Question,
    RIGHT_PITCH, Severity, TOLERANCE, Thinker, VISIBLE, Verdict, Word, duration, recommended,
};
pub use clock::{Clock, Due};
pub use command::{Binding, Command, KEYS, Key, SPEED_LADDER, TICK_LADDER, command_for};
pub use display::{Ask, Display, Instrument, Interpolation, Mode, Pace};
pub use history::{CAPACITY, History, Run, Sample};
pub use lab::Lab;
pub use lane::{ESCAPE, Halt, Lane, LaneBody, Origin, TakenUp};
pub use metrics::{METRICS, Metric, Scale, Unit};
pub use race::{Entrant, Race};
pub use scene::{
    BuiltIn, LARGEST_FILE, LAST_TICK, LEAST_SECONDS, LaneSpec, MOST_BODIES, MOST_LANES,
    MOST_NAME_CHARS, MOST_SECONDS, MOST_SHOWN, MOST_SUBSTEPS, MOST_TICK_HZ, SCENES, Scene,
    SceneBody, SceneError, SceneErrors, Scripted, TOLERANCES, nearest,
};
pub use truth_curve::{TruthCurve, TruthSample};
