//! The experiment: a scene, a clock, lanes racing against the truth, measurements, and the picture
//! they make.
//!
//! This layer knows no GPU, no window, no files and no wall clock: text comes in as `&str`, time as
//! integers, and what comes out is plain data. [`Studio`] holds it all together.

mod action;
pub mod analysis;
mod appearance;
mod bisection;
mod chase;
pub mod cloud;
mod command;
mod csv_row;
mod custom;
mod display;
mod equal_cost;
mod extent;
mod follow;
mod gesture;
pub mod guide;
mod held;
pub mod identify;
mod instrument;
mod interpolation;
mod intervention;
mod journal;
mod key;
mod lane;
mod lane_id;
mod lane_spec;
mod live_loop;
pub mod loop_lab;
mod menu;
mod metrics;
mod my_spring;
mod notice;
mod notices;
mod one_step;
mod outline;
pub mod pacing;
pub mod palette;
pub mod past;
pub mod picture;
pub mod port;
mod quantity;
mod race;
mod report;
pub mod scene;
mod scene_list;
pub mod session;
pub mod source_code;
mod step;
mod studio;
mod time_scale;
mod viewer;
mod zoom_pan;

pub use crate::sim::Clock;
pub use crate::sim::bodies::{Acts, Coordinate, Parameter, Range};
pub use crate::sim::integrators::METHODS;
pub use crate::sim::number;
pub use crate::sim::stability::NoSmallMotion;
pub use action::Action;
pub use analysis::{
    Advice, AdvisedBodies, Adviser, AnalysisWorker, CRITERIA, ChaseFinding, Coverage, Criterion,
    CriterionMet, CriterionResult, Judge, MAX_ADVISED_SUBSTEPS, MAX_HORIZON_S, MapRequest,
    MethodAdvice, Outcome, SeenLine, Severity, StabilityMap, Verdict, recommended,
};
pub use appearance::Appearance;
pub use chase::Chase;
pub use command::{
    Command, RunCommand, SCALE_LADDER, SPEED_LADDER, StageCommand, TICK_LADDER,
    USUAL_SCALE_PERCENT, ViewCommand,
};
pub use csv_row::csv_row;
pub use custom::{Draw, Options, OptionsError};
pub use display::{Arrangement, Display, DriverRequest, Motion, Pace, View};
pub use equal_cost::{equal_cost, lanes_that_race};
pub use follow::{Follow, StopReason, Ticked};
pub use gesture::{GESTURES, Gesture};
pub use held::HeldBody;
pub use identify::identify;
pub use instrument::{INSTRUMENTS, Instrument, InstrumentCard, InstrumentRow};
pub use interpolation::Interpolation;
pub use journal::{Journal, JournalRow, Source};
pub use key::{Binding, KEYS, Key, command_for};
pub use lane::{ESCAPE, Halt, Lane, LaneBody, Resumed, ResumedFrom};
pub use lane_id::LaneId;
pub use lane_spec::LaneSpec;
pub use live_loop::{LiveFrame, LiveLoop};
pub use loop_lab::{LoopCommand, LoopLab};
pub use menu::Menu;
pub use metrics::{METRICS, Metric, Scale, Unit};
pub use my_spring::MySpring;
pub use notice::Notice;
pub use one_step::{OneStep, Slope};
pub use past::{History, Sample};
pub use port::port;
pub use quantity::Quantity;
pub use race::{Entrant, Mode, Observer, Race};
pub use report::{Criteria, MethodReport, Recommendation, Report, advise};
#[cfg(feature = "cli")]
pub(crate) use scene::clip::clip;
pub use scene::{
    BuiltIn, Check, MAX_FILE_BYTES, MAX_LANES, MAX_SECONDS, MAX_SUBSTEPS, Mistake, SCENES, Scene,
    SceneBody, SceneErrors, SceneKey, TOLERANCES, edited_values, nearest, scene_tables,
};
pub use scene_list::SceneList;
pub use session::{Event, Session, Timeline};
pub use source_code::source_code;
pub use step::Step;
pub use studio::{MANY_LANES, SpringJoint, Studio};
pub use time_scale::TimeScale;
pub use viewer::{Dialog, Preferences, Viewer};
pub use zoom_pan::{ZOOMS, ZoomPan};
