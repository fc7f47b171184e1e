//! Measurements, which are verdicts on methods on a scene, advice on which method to choose, and the effect of a method
//! on a state or an area of states.
//!
//! A [`Judge`] runs a scene under a method and gives a [`Verdict`]. An [`Adviser`] searches for the fewest substeps
//! that meet a [`Criterion`]. Both are pure functions of the scene. A [`cloud`] steps many starts, [`OneStep`] is the
//! anatomy of a tick, and a [`FutureCurve`] is the next second of a body. [`advise`] reports on a custom body. An
//! [`AnalysisWorker`] does all of this beside a run, in slices.

// The rules of a room: see `src/lib.rs` and clippy.toml.
#![warn(clippy::exit, clippy::print_stderr, clippy::print_stdout)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]
#![warn(clippy::iter_over_hash_type)]

use regatta_run as run;
use regatta_scene as scene;
use regatta_sim as sim;
use regatta_tools as tools;

mod advice;
mod amplitude;
mod bounce_finding;
mod by_bounces;
mod by_energy;
mod by_spin;
mod change;
mod chase_finding;
pub mod cloud;
mod criterion;
mod energy;
mod energy_finding;
mod frequency;
mod futures;
mod judge;
mod judged_run;
mod modes;
mod offset;
mod one_step;
mod outcome;
mod pace;
mod rank;
mod report;
mod searches;
mod slices;
mod spin_finding;
mod stability_map;
mod survey;
mod swing_curve;
mod swings;
mod truth;
mod verdict;
mod worker;

pub use crate::sim::number::duration;
pub use advice::{
    Adviser, CriterionMet, CriterionResult, MAX_ADVISED_SUBSTEPS, MethodAdvice, TAKEN_FOR,
    criterion_to_take, ranked, recommended,
};
pub use amplitude::{Measure, Trend};
pub use bounce_finding::BounceFinding;
pub use chase_finding::ChaseFinding;
pub use criterion::{CRITERIA, Criterion, FREQUENCY_TOLERANCE, TOLERANCE, VISIBLE};
pub use energy_finding::EnergyFinding;
pub use futures::{FutureCurve, FutureMoment};
pub use futures::{futures, has_no_futures};
pub use judge::{Judge, MAX_HORIZON_S};
pub use judged_run::MAX_WORK;
pub use one_step::{OneStep, Slope};
pub use one_step::{one_step, orbit};
pub use outcome::{Outcome, Severity, Sign};
pub use report::{Criteria, MethodReport, PassedOver, Recommendation, Report, advise, try_advise};
pub use spin_finding::SpinFinding;
pub use stability_map::{Coverage, DampingLine, MapRequest, PointStability, Region, StabilityMap};
pub use truth::LONG_RUN;
pub use verdict::{
    Comparison, Finding, LongTerm, NoTruth, NotJudged, RunFailure, SwingWidths, Verdict,
    VerdictNumber,
};
pub use worker::{Advice, AdvisedBodies, AnalysisRequest, AnalysisWorker, Findings};
