//! The experiment: a scene, a clock, lanes racing against the truth, measurements, and the picture
//! they make.
//!
//! This layer knows no GPU, no window, no files and no wall clock: text comes in as `&str`, time as
//! integers, and what comes out is plain data. [`Lab`] holds it all together.

mod action;
mod analysis;
mod clock;
mod command;
mod display;
mod duration;
mod equal_cost;
mod extent;
mod held;
mod journal;
#[expect(clippy::module_inception, reason = "the lab is what this layer is about")]
mod lab;
mod lane;
mod lane_spec;
mod lens;
mod metrics;
mod notices;
pub mod number;
mod past;
pub mod picture;
mod race;
mod scene;
mod session;
mod shelf;
mod start;
mod viewer;

pub use crate::sim::bodies::{Acts, Parameter, Range};
pub use action::Action;
pub use analysis::{
    Advice, Advised, Adviser, CRITERIA, Criterion, Fate, Findings, Judge, LONG_RUN,
    LONGEST_HORIZON_S, MOST_ADVISED_SUBSTEPS, MOST_WORK, Meets, Met, NoTruth, NotJudged, Question,
    RIGHT_PITCH, Severity, TOLERANCE, Thinker, VISIBLE, Verdict, Word, duration, recommended,
};
pub use clock::{Clock, Due};
pub use command::{Binding, Command, KEYS, Key, SPEED_LADDER, TICK_LADDER, command_for};
pub use display::{Ask, Display, Instrument, Interpolation, Pace};
pub use equal_cost::{equal_cost, lanes_that_race};
pub use held::Held;
pub use journal::{Journal, JournalRow, Source};
pub use lab::Lab;
pub use lane::{ESCAPE, Halt, Lane, LaneBody, Origin, TakenUp};
pub use lane_spec::LaneSpec;
pub use lens::{Lens, ZOOMS};
pub use metrics::{METRICS, Metric, Scale, Unit};
pub use past::{CAPACITY, History, Past, Run, Sample, Samples, Swept, TruthCurve, TruthSample};
pub use race::{Entrant, Mode, Observer, Race};
pub use scene::{
    BuiltIn, Check, EditError, LARGEST_FILE, LAST_TICK, LEAST_SECONDS, MOST_BODIES, MOST_LANES,
    MOST_NAME_CHARS, MOST_SECONDS, MOST_SHOWN, MOST_SUBSTEPS, MOST_TICK_HZ, SCENES, Scene,
    SceneBody, SceneError, SceneErrors, Scripted, TOLERANCES, edited_values, nearest,
    parameter_named,
};
pub use session::{
    Event, EventKind, RecordingTooLong, SNAPSHOT_BYTES, Session, TimeScale, Timeline,
};
pub use shelf::Shelf;
pub use viewer::{Dialog, Viewer};
