//! The experiment: a scene, a clock, lanes racing against the truth, measurements, and the picture
//! they make.
//!
//! This layer knows no GPU, no window, no files and no wall clock: text comes in as `&str`, time as
//! integers, and what comes out is plain data. [`Lab`] holds it all together.

mod action;
mod analysis;
mod appearance;
mod bisection;
mod chase;
mod cloud;
mod command;
mod custom;
mod display;
mod equal_cost;
mod extent;
mod follow;
mod gesture;
mod guide;
mod held;
mod identify;
mod instrument;
mod interpolation;
mod intervention;
mod journal;
mod key;
#[expect(clippy::module_inception, reason = "the lab is what this layer is about")]
mod lab;
mod lane;
mod lane_id;
mod lane_spec;
mod live_loop;
mod loop_lab;
mod menu;
mod metrics;
mod my_spring;
mod notice;
mod notices;
mod one_step;
mod outline;
pub mod pacing;
pub mod palette;
mod past;
pub mod picture;
mod port;
mod quantity;
mod race;
mod report;
mod scene;
mod scene_list;
mod session;
mod source_code;
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
    Advice, AdvisedBodies, Adviser, AnalysisRequest, AnalysisWorker, CRITERIA, Change,
    ChaseFinding, Comparison, Coverage, Criterion, CriterionMet, CriterionResult, EnergyFinding,
    FREQUENCY_TOLERANCE, Finding, Findings, Here, Judge, LONG_RUN, LongTerm, MAX_ADVISED_SUBSTEPS,
    MAX_HORIZON_S, MAX_WORK, MapRequest, MethodAdvice, NoTruth, NotJudged, Outcome, Region,
    RunFailure, SeenLine, Severity, StabilityMap, TOLERANCE, VISIBLE, Verdict, duration,
    recommended,
};
pub use appearance::Appearance;
pub use chase::Chase;
pub use cloud::{
    Cloud, CloudAxes, CloudChoice, CloudKind, CloudMeasure, CloudPicture, CloudRequest, CloudShape,
    CloudStart, CloudWorker, Density, ExactBorder, FoundCloud, LaneCloud, NoCloud, POINTS,
    PlaneView, ShownTicks, USUAL_POINTS,
};
pub use command::{Command, SCALE_LADDER, SPEED_LADDER, TICK_LADDER, USUAL_SCALE_PERCENT};
pub use custom::{Draw, Options, OptionsError};
pub use display::{Arrangement, Display, DriverRequest, Motion, Pace, View};
pub use equal_cost::{equal_cost, lanes_that_race};
pub use follow::{Follow, StopReason, Ticked};
pub use gesture::{GESTURES, Gesture};
pub use guide::{Goal, STOPS, Stop, Tour};
pub use held::HeldBody;
pub use identify::{
    Candidate, Columns, Conclusion, Effective, Fitted, Identification, Log, LogError, LogRow,
    LoggedBody, identify,
};
pub use instrument::{INSTRUMENTS, Instrument, InstrumentCard, InstrumentRow};
pub use interpolation::Interpolation;
pub use journal::{Journal, JournalRow, Source};
pub use key::{Binding, KEYS, Key, command_for};
pub use lab::{Lab, MANY_LANES, SpringJoint};
pub use lane::{ESCAPE, Halt, Lane, LaneBody, Resumed, ResumedFrom};
pub use lane_id::LaneId;
pub use lane_spec::LaneSpec;
pub use live_loop::{LiveFrame, LiveLoop};
pub use loop_lab::{
    FRAME_METRICS, FoundLoop, FrameMetric, LoopCommand, LoopFrame, LoopLab, LoopLane, LoopRequest,
    LoopState, LoopVerdict, LoopWorker, MAX_ON_STAGE, SLOWNESS,
};
pub use menu::Menu;
pub use metrics::{METRICS, Metric, Scale, Unit};
pub use my_spring::MySpring;
pub use notice::Notice;
pub use one_step::{OneStep, Slope};
pub use past::{
    CAPACITY, Energies, History, Past, Sample, Samples, Summary, SweptRange, TruthCurve,
    TruthSample,
};
pub use port::{
    Approach, DriveLimits, FollowerPort, Ported, Reach, Relief, Setup, Wish, WishError,
    drive_limits, followers, port, setups,
};
pub use quantity::Quantity;
pub use race::{Entrant, Mode, Observer, Race};
pub use report::{Criteria, MethodReport, Recommendation, Report, advise};
#[cfg(feature = "cli")]
pub(crate) use scene::clip::clip;
pub use scene::{
    BuiltIn, Check, EditError, LAST_TICK, MAX_BODIES, MAX_FILE_BYTES, MAX_LANES, MAX_NAME_CHARS,
    MAX_SECONDS, MAX_SHOWN, MAX_SUBSTEPS, MAX_TICK_HZ, MIN_SECONDS, Mistake, Refusal, SCENES,
    Scene, SceneBody, SceneError, SceneErrors, SceneKey, Scripted, TOLERANCES, USUAL_SECONDS,
    edited_values, nearest, parameter_named, scene_tables,
};
pub use scene_list::SceneList;
pub use session::{
    Event, EventKind, Recorder, RecordingError, RunToRecord, SNAPSHOT_BYTES, Session, Timeline,
};
pub use source_code::{Language, MethodInput, MethodSource, NoSourceCode, Precision, source_code};
pub use time_scale::TimeScale;
pub use viewer::{Dialog, Preferences, Viewer};
pub use zoom_pan::{ZOOMS, ZoomPan};
