//! Regatta shows, in real time, what a numerical integrator does to a game's moving bodies, so that a
//! developer picks the right one before shipping.
//!
//! # The house
//!
//! Four layers, each knowing only those to its right: `main → commands, window → view → lab → sim`.
//!
//! - [`sim`] is mathematics: a [`State`](sim::State), an equation of motion ([`System`](sim::System)),
//!   and ways to step it ([`Integrator`](sim::integrators::Integrator)). It knows no files, clocks or
//!   pixels. RK4's formula is in `sim/integrators/rk4.rs`. [`sim::stability`] finds the map of a step of a
//!   method on a body's [small motions](sim::stability::SmallMotion) and [normal modes](sim::stability::NormalMode).
//! - [`lab`] is the experiment: a [`Scene`](lab::Scene) is read from text and written as text, a
//!   [`Clock`](sim::Clock) turns frames into ticks, a [`Race`](lab::Race) steps its [`Lane`](lab::Lane)s and the
//!   truth, and a [`Picture`](lab::picture::Picture) says what to draw. A run is a value, a
//!   [`Session`](lab::Session): it changes by [`Action`](lab::Action)s and ticks only. Its [`Journal`](lab::Journal) holds
//!   all of them, those of a script, a person, a recording or a test. A
//!   [`Timeline`](lab::Timeline) keeps snapshots of it and goes to any tick. What is drawn of earlier ticks is in a
//!   [`Past`](lab::past::Past), which watches the race as an [`Observer`](lab::race::Observer), and what a person looks at in a
//!   [`Viewer`](lab::studio::Viewer): neither is part of a run. A lane is one method on its own copy of the
//!   scene's bodies, known by its [`LaneId`](lab::LaneId), and a [`Follow`](lab::Follow) ticks one outside a run; a [`Judge`](lab::Judge) measures how far one strays, an
//!   [`Adviser`](lab::Adviser) searches for the substeps that meet a [`Criterion`](lab::Criterion), and an
//!   [`AnalysisWorker`](lab::analysis::AnalysisWorker) runs both, and the stability map, beside the race, as a
//!   [`CloudWorker`](lab::cloud::CloudWorker) steps a [`Cloud`](lab::cloud::Cloud) of starts under each lane. The truth is a
//!   lane whose solver is the exact flow, or a [reference](sim::REFERENCE_ACCURACY) for a body that has none. The layer knows no GPU and no wall clock: time comes in as
//!   integers, text as `&str`.
//!   [`identify`](fn@lab::identify) finds the method that made a log, and [`port`](fn@lab::port) the settings with which engines
//!   move a spring alike.
//!   Game loops are in [`lab::pacing`]: a [`Policy`](lab::pacing::Policy) decides each frame which steps are made, a
//!   [`FrameTrace`](lab::pacing::FrameTrace) says when frames begin and are displayed, and a
//!   [`LoopRun`](lab::pacing::LoopRun) measures what a viewer sees. The [`LoopLab`](lab::loop_lab::LoopLab) has every frame of every
//!   loop ready to be looked up.
//! - `view` is pixels: a graphics device, the sea and the shapes on the stage, panels in egui, and
//!   `FrameRenderer::draw`, the only code that draws a frame. Window, screenshot and capture call it
//!   and differ only in where time comes from and where the texture goes.
//! - `window` and `commands` are the drivers: they alone touch files and real time. How a scene file is read and
//!   what is said of its mistakes is the commands'; the window is handed it, and watches the files that it
//!   opened. A capture's frames pass from the thread that draws to those that encode, and come back in order
//!   (`commands/pipeline.rs`); what it drew is in a manifest (`commands::manifest` has the schema), by
//!   which `regatta verify` judges. A sweep's runs and the methods that `advise` judges share nothing, so
//!   that any number of threads makes the same rows (`commands/jobs.rs`).
//!
//! Each layer is a feature that has those below it: `lab`, `view`, `window`; `cli` is the commands, of which those that
//! draw come with `view` and `play` with `window`. The default, `desktop`, has all. `lab` and `cli` pull in no graphics
//! crate. The feature `batch` adds [`sim::batch`], on all cores, and `lab` has it. Without any feature the package is
//! `sim` without its [`bodies`](sim::bodies) and [`law`](sim::law)s, and needs two crates: what a game's loop wants.
//!
//! # A frame
//!
//! events → [`Command`](lab::studio::Command)s → [`Action`](lab::Action)s → [`Session::act`](lab::Session::act) →
//! [`Clock::advance`](sim::Clock::advance) → as many [`Session::tick`](lab::Session::tick)s as are due →
//! [`picture::compose`](lab::picture::compose) → `FrameRenderer::draw` → submit → present or read back.
//!
//! # What holds
//!
//! - **The same bits everywhere.** Stepped state is `f64` and uses only `+ - × ÷ √` and `libm`; time
//!   is counted in whole ticks. Frame rate, drawing, platform and build profile change nothing, and
//!   `tests/determinism.rs` compares [`Race::lane_hashes`](lab::Race::lane_hashes) with committed values.
//! - **Claims are measured.** Every field of a [`Method`](sim::integrators::Method) card is tested
//!   both ways by `tests/library/conformance`, with drag and without.
//! - **A run can be gone back in.** Copied, recorded, written, read and run again, or gone to from anywhere, a tick
//!   is to the bit what it was, with its plots (`tests/library/sessions.rs`, `tests/library/recordings.rs`).
//! - **The step allocates nothing**, takes no lock and touches no file (`tests/library/allocation.rs`).
//! - **A body that blows up is data.** It halts, keeps its last good state and says why; other bodies
//!   and lanes go on, unchanged to the bit. Under another method it resumes from the truth.
//! - **One table each** for [methods](sim::integrators::METHODS), [bodies](sim::bodies::BODIES),
//!   [metrics](lab::METRICS), [scenes](lab::SCENES), [keys](lab::studio::KEYS), the [stops](lab::studio::guide::STOPS) of the guide,
//!   [game loops](lab::pacing::POLICIES) with their [metrics](lab::pacing::PACING_METRICS), and [traces](lab::pacing::TRACES):
//!   menus, help, command line and tests loop over them.
//! - Who may import whom is enforced by the features, each of which compiles alone, and by `clippy.toml`.
//!
//! # Adding a thing
//!
//! - **A method**: copy `sim/integrators/midpoint.rs`, declare the file, add its line to
//!   `methods!`. If its card claims too much or too little, `tests/library/conformance` fails. One that is for some bodies
//!   [only](sim::integrators::Only) comes after all others, and is refused elsewhere with the reason on its card. A physics engine is a
//!   [family](sim::integrators::Family::Engine) of such methods: a rule like `sim/integrators/bullet.rs`, which reads the
//!   [settings](sim::EngineSettings) of a body.
//!   Its formula is on its card, and its [source code](lab::source_code::MethodSource) for other games in `assets/methods`: both are
//!   evaluated beside it. `BLESS=1 cargo test --test library tables` writes its row in the [manual](mod@manual::methods).
//! - **A body**: copy `sim/bodies/pendulum.rs`, declare the file, add its card to
//!   [`BODIES`](sim::bodies::BODIES); say how it looks, and where a person can grab it, in a file beside
//!   `lab/look/pendulum.rs`, and add that to `LOOKS`. `tests/library/exact_flows.rs` and `tests/library/bodies` hold its exact flow, or what stands in for one,
//!   against its equation.
//!   What a scene lays out itself, a [law](sim::bodies::law_kind) or a [net](sim::bodies::net_kind), has a kind of its own
//!   that is made when the scene is read.
//! - **A scene**: add a file to `assets/scenes` and its name to a group of [`SCENES`](lab::SCENES).
//! - **A game loop**: a file beside `lab/pacing/policies/whole_refresh.rs` if it has a memory, a card in
//!   [`POLICIES`](lab::pacing::POLICIES), and its source in `assets/loops`. `tests/library/pacing_policies.rs` runs it for a day.
//! - **A metric**: one entry of [`METRICS`](lab::METRICS). **A key**: one entry of [`KEYS`](lab::studio::KEYS).
//!
//! # In your own game loop
//!
//! The clock and the methods work on any system of yours. Here a ball falls through air, stepped at
//! 120 Hz whatever the frame rate, and drawn between ticks:
//!
//! ```
#![doc = include_str!("../examples/game_loop.rs")]
//! ```
//!
//! # Custom bodies and methods
//!
//! A [`System`](sim::System) and a start are enough for [`advise`], [`Race::of`](lab::Race::of),
//! [`Scene::of`](lab::Scene::of) and `Window::run`; [`Options`](lab::Options) and [`Extras`](sim::bodies::Extras) say more:
//!
//! ```
#![doc = include_str!("../examples/custom_body.rs")]
//! ```
//!
//! Many starts of a body of one coordinate are a [`Cloud`](lab::cloud::Cloud), which knows what becomes of their area:
//!
//! ```
#![doc = include_str!("../examples/cloud.rs")]
//! ```
//!
//! A million copies of such a body are a [`Batch`](sim::batch::Batch):
//!
//! ```
#![doc = include_str!("../examples/batch.rs")]
//! ```
//!
//! A custom method is an [`Integrator`](sim::integrators::Integrator) and a card, which
//! [`conformance::check`] measures:
//!
//! ```
#![doc = include_str!("../examples/custom_method.rs")]
//! ```
//!
//! # In continuous integration
//!
//! A race of a scene gives the same hashes for ever, unless its physics changes:
//!
//! ```
#![doc = include_str!("../examples/ci_hash.rs")]
//! ```
//!
//! # The manual
//!
//! What the program does, in [chapters](manual): from the [keys](mod@manual::keys) to what is [stable](mod@manual::stable).
//!
//! # Out of scope
//!
//! Collisions and contacts, which would hide the integrator behind the solver; generic scalars,
//! because the formulas would drown, but for one experiment on their width
//! (`commands/sweep/round_off.rs`); and constraints, because a closed body with natural coordinates needs
//! none.

// Only `main` exits, and what is said to a person goes by way of the commands.
#![warn(clippy::exit, clippy::print_stderr)]
// docs.rs marks what needs a feature with its name.
#![cfg_attr(docsrs, feature(doc_cfg))]

#[cfg(any(feature = "cli", feature = "window"))]
#[cfg_attr(
    not(all(feature = "cli", feature = "window")),
    allow(
        dead_code,
        reason = "the commands and the window share it, and each has parts of its own"
    )
)]
mod atomic_file;
#[cfg(feature = "cli")]
pub mod commands;
#[cfg(feature = "lab")]
#[cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]
#[warn(clippy::print_stdout)]
pub mod lab;
pub mod manual;
#[cfg(any(feature = "cli", feature = "view"))]
mod picture_note;
pub mod prelude;
#[cfg(any(feature = "cli", feature = "window"))]
mod regular_file;
#[cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]
#[warn(clippy::print_stdout)]
pub mod sim;
#[cfg(any(feature = "cli", feature = "window"))]
mod stopwatch;
#[cfg(feature = "view")]
#[cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]
#[warn(clippy::print_stdout)]
pub mod view;
#[cfg(feature = "window")]
pub mod window;

#[cfg(feature = "lab")]
pub use lab::{advise, try_advise};
#[cfg(feature = "lab")]
pub use sim::conformance;
