//! Tests of the library as a game uses it: the mathematics, the experiment, and the words of both.
#![cfg(feature = "lab")]

mod allocation;
mod as_printed;
mod bad_scenes;
mod batches;
mod blocks;
mod blow_up;
mod bodies;
mod bounce;
mod bounce_verdicts;
mod chapter;
#[cfg(feature = "cli")]
mod ci_recipe;
mod clouds;
mod conformance;
mod custom;
mod dialects;
#[path = "../dice/mod.rs"]
mod dice;
mod diff;
mod editing;
mod engine_loops;
mod engines;
mod events;
mod exact_curve;
mod exact_flows;
mod faults;
mod formulas;
mod frame_traces;
mod guide;
mod guide_runs;
mod hint_rates;
mod hints;
mod histories;
mod honesty;
mod interfaces;
mod judged_runs;
mod judged_words;
mod judging;
#[path = "../kept/mod.rs"]
mod kept;
mod keys;
mod known_motions;
mod laws;
mod layouts;
mod looks_right;
mod manual_tables;
mod misuse;
mod nets;
mod own_methods;
mod pacing_policies;
mod pasted_functions;
mod pasted_rules;
mod picture;
mod pinned;
mod port;
#[cfg(feature = "cli")]
#[path = "../printed/mod.rs"]
mod printed;
mod recordings;
mod restart;
mod robot;
mod rollback;
mod rules;
mod scenes;
mod sessions;
mod small_motions;
mod source_code;
mod stability;
mod stable;
mod step_doubling;
mod steppers;
mod stiff_logs;
mod switching;
mod tidy;
mod undo;
mod verdicts;
mod walks;
mod words;
