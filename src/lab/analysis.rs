//! What is to be said of methods on a scene: verdicts, and advice on which to take. Pure functions of a scene, measured
//! on the run.

mod advice;
mod change;
mod energy;
mod judge;
mod limits;
mod modes;
mod peaks;
mod pitch;
mod run;
mod searches;
mod survey;
mod thinking;
mod truth;
mod verdict;

pub use advice::{
    Advised, Adviser, CRITERIA, Criterion, MOST_ADVISED_SUBSTEPS, Meets, Met, recommended,
};
pub use judge::{Judge, LONGEST_HORIZON_S};
pub use limits::{RIGHT_PITCH, TOLERANCE, VISIBLE};
pub use run::MOST_WORK;
pub use thinking::{Advice, Findings, Question, Thinker};
pub use truth::LONG_RUN;
pub use verdict::{Fate, NoTruth, NotJudged, Severity, Verdict, Word, duration};
