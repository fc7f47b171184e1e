//! What a game that uses the library relies on: the mathematics, the experiment, and the words of both.
#![cfg(feature = "lab")]

mod allocation;
mod as_printed;
mod bad_scenes;
mod blow_up;
mod bodies;
mod chapter;
mod ci_recipe;
mod compilers;
mod conformance;
#[path = "../dice/mod.rs"]
mod dice;
mod editing;
mod engines;
mod exact_curve;
mod exact_flows;
mod formulas;
mod frame_traces;
mod guide;
mod hints;
mod histories;
mod honesty;
mod judged_runs;
mod judging;
mod laws;
mod layouts;
mod loop_snippets;
mod nets;
mod own;
mod pacing_policies;
mod picture;
mod pinned;
mod recordings;
mod restart;
mod robot;
mod scenes;
mod sessions;
mod source_code;
mod stability;
mod step_doubling;
mod steppers;
mod switching;
mod tidy;
mod undo;
mod verdicts;
mod words;
