//! Game loops and their effect on motion, independent of the method that steps it.
//!
//! A [`FrameTrace`] records when each [`Frame`] began and when its picture was displayed. A policy is a file of
//! [lines](crate::sim::law::LoopText). It knows only the duration of the last frame, as a game does, and decides on
//! steps and the moment to show. [`POLICIES`] lists the ideal ones, and [`ENGINES`] those of engines. A [`PacedLane`]
//! steps bodies by a policy, a [`LoopRun`] runs such a lane over a trace, and [`PACING_METRICS`] measure how the motion
//! looks on the display. Time is counted in whole numbers of a [`TimeBase`]; there is no clock here.

// The rules of a room: see `src/lib.rs` and clippy.toml.
#![warn(clippy::exit, clippy::print_stderr, clippy::print_stdout)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]
#![warn(clippy::iter_over_hash_type)]

use regatta_measure as measure;
use regatta_run as run;
use regatta_scene as scene;
use regatta_sim as sim;
use regatta_table as table;

mod advice;
mod camera;
mod engines;
mod game_time;
mod hitch;
mod lines;
pub mod log;
pub mod loop_lab;
mod loop_run;
mod metrics;
mod paced_lane;
mod pacer;
mod patterns;
mod policies;
mod policy;
mod replay;
mod scripted_truth;
mod time_base;
mod trace;
pub mod trace_file;
mod verdict;

pub use crate::sim::{Accumulator, Due, MAX_FRAME_MS};
pub use advice::{AdvisedLoop, MeasuredLoops, NoLoop, USUAL_LATENCY_MS};
pub use camera::{CAMERA_METRICS, Camera, CameraMetric};
pub use engines::{ENGINES, engine, own_loop};
pub use game_time::GameTime;
pub use hitch::Hitch;
pub use loop_run::{LoopRun, MIN_RUN_S};
pub use metrics::{FrameRecord, PACING_METRICS, PacingMetric, PacingReport};
pub use paced_lane::PacedLane;
pub use pacer::Pacer;
pub use patterns::{TRACES, TraceCard, frames_on_display, steady_trace, trace_card};
pub use policies::{POLICIES, policy};
pub use policy::{Engine, Excess, FrameLimits, LongFrame, PolicyCard, Steps};
pub use time_base::{RefreshRate, TimeBase};
pub use trace::{Frame, FrameTrace, Frames};
pub use verdict::LoopVerdict;
