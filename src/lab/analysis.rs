//! Verdicts on methods on a scene, and advice on which method to choose. Both are pure functions of a scene, measured on
//! runs of it.

mod advice;
mod amplitude;
mod by_energy;
mod change;
mod chase_finding;
mod criterion;
mod criterion_met;
mod energy;
mod energy_finding;
mod frequency;
mod judge;
mod limits;
mod modes;
mod outcome;
mod peaks;
mod run;
mod searches;
mod slices;
mod stability_map;
mod survey;
mod truth;
mod verdict;
mod worker;

pub use advice::{
    Adviser, CriterionMet, CriterionResult, MAX_ADVISED_SUBSTEPS, MethodAdvice, recommended,
};
pub use amplitude::Change;
pub use chase_finding::ChaseFinding;
pub use criterion::{CRITERIA, Criterion};
pub use energy_finding::EnergyFinding;
pub use judge::{Judge, MAX_HORIZON_S};
pub use limits::{FREQUENCY_TOLERANCE, TOLERANCE, VISIBLE};
pub use outcome::{Outcome, Severity};
pub use run::MAX_WORK;
pub use stability_map::{Coverage, Here, MapRequest, Region, SeenLine, StabilityMap};
pub use truth::LONG_RUN;
pub use verdict::{
    Comparison, Finding, LongTerm, NoTruth, NotJudged, RunFailure, Verdict, duration,
};
pub use worker::{Advice, AdvisedBodies, AnalysisRequest, AnalysisWorker, Findings};
