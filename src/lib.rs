//! Regatta shows, in real time, what a numerical integrator does to a game's moving bodies, so that a
//! developer picks the right one before shipping.
//!
//! # The house
//!
//! A room names those above it in this table only, and a test holds it to the third column.
//!
//! | room | holds | may name | open first |
//! |---|---|---|---|
//! | [`sim`] | mathematics: states, equations, methods, bodies | - | `sim/integrators/rk4.rs` |
//! | [`table`] | one reader of tables: bytes in, a header, rows and numbers out | - | `table/mod.rs` |
//! | [`scene`] | a scene as text and as value; actions; custom bodies | `sim` | `scene/mod.rs` |
//! | [`run`] | a race of methods against the truth: its actions, its drawn past, its text | `sim table scene` | `run/mod.rs` |
//! | [`tools`] | a developer's tools: the method of a log, a spring for an engine, source code | `sim table scene` | `tools/port.rs` |
//! | [`measure`] | verdicts, advice, stability maps, clouds of starts | `sim scene run tools` | `measure/judge.rs` |
//! | [`loops`] | game loops, traces of frames, the loop lab | `sim table scene run measure` | `loops/loop_run.rs` |
//! | [`look`] | how a body looks and is held; colours | `sim scene run measure` | `look/pendulum.rs` |
//! | [`studio`] | a person at a run: commands, the view, work in the background | `sim scene run tools measure loops look` | `studio/apply.rs` |
//! | [`stage`] | the picture as plain data: [`compose`](stage::compose()) makes a [`Picture`](stage::Picture) | `sim scene run measure loops look studio` | `stage/compose.rs` |
//! | `view` | pixels: panels, charts, and `FrameRenderer::draw`, the one way to draw | `scene run tools measure loops look studio stage` | `view/frame.rs` |
//! | `window` | a screen, real time, a person's files | `scene run measure loops look studio view` | `window.rs` |
//! | `commands` | the command line: files, captures, threads | `sim table scene run tools measure loops look studio view window` | `commands/mod.rs` |
//!
//! A feature is a row with all above it: without any the package is `sim` without its [`bodies`](sim::bodies) and
//! [`law`](sim::law)s, what a game's own loop needs; `lab` adds the rooms to `stage`; then come `view` and `window`. `cli` is
//! `commands`, of which those that draw come with `view`, and `play` with `window`. The default, `desktop`, has all. Up to `stage`
//! nothing knows a graphics crate, a file or a wall clock: text comes in as `&str`, time as integers.
//!
//! # A frame
//!
//! events → [`Command`](studio::Command)s → [`Studio::apply`](studio::Studio::apply) → [`Action`](scene::Action)s →
//! [`Race`](run::Race) → [`Done`](run::race::Done) → [`Clock::advance`](sim::Clock::advance) → the [ticks](run::Run::tick) that are
//! due → [`compose`](stage::compose()) → `FrameRenderer::draw` → present or read back; in real time, by a
//! [`FrameLoop`](studio::FrameLoop).
//!
//! # What holds
//!
//! - **The same bits everywhere.** Stepped state is `f64` and uses only `+ - × ÷ √` and `libm`; time is counted in whole
//!   ticks. Frame rate, drawing, platform and build profile change nothing: `tests/determinism.rs` compares
//!   [`Race::lane_hashes`](run::Race::lane_hashes) with committed values.
//! - **A run is a value.** A [`Session`](run::Session) changes by [`Action`](scene::Action)s and ticks only, and its
//!   [`Journal`](run::Journal) holds them all, whether a script, a person or a test gave them. A
//!   [`Run`](run::Run) goes to any tick and finds the same bits (`tests/library/sessions.rs`).
//! - **A body that blows up is data.** It halts, keeps its last good state and says why; the others go on, unchanged to the bit.
//! - **The step allocates nothing**, takes no lock and touches no file (`tests/library/allocation.rs`).
//! - **Claims are measured.** `tests/library/conformance` tests every field of a [`Method`](sim::integrators::Method) card both
//!   ways, with drag and without.
//! - **One table each** for [methods](sim::integrators::METHODS), [bodies](sim::bodies::BODIES), [metrics](run::METRICS),
//!   [scenes](scene::SCENES), [keys](studio::KEYS), the [stops](studio::guide::STOPS) of the guide,
//!   [game loops](loops::POLICIES), [their metrics](loops::PACING_METRICS) and [traces](loops::TRACES): menus, help, command
//!   line and tests loop over them.
//!
//! # Adding a thing
//!
//! - **A method**: copy `sim/integrators/midpoint.rs`, declare the file, add its line to `methods!`. A method for
//!   [some bodies only](sim::integrators::Only) comes after all others; a physics engine is a
//!   [family](sim::integrators::Family::Engine) of those, like `sim/integrators/bullet.rs`. Its
//!   [source code](tools::source_code::MethodSource) is in `assets/methods`.
//!   One by a person's lines is [read](sim::own_method()) when the program runs.
//!   `BLESS=1 cargo test --test library tables` writes its row in the [manual](mod@manual::methods).
//! - **A body**: copy `sim/bodies/pendulum.rs`, declare the file, add its card to [`BODIES`](sim::bodies::BODIES), and its
//!   look, a file beside `look/pendulum.rs`, to `LOOKS`. A [law](sim::bodies::law_kind) or a [net](sim::bodies::net_kind), which
//!   a scene lays out itself, has a kind of its own, made when the scene is read.
//! - **A scene**: add a file to `assets/scenes` and its name to a group of [`SCENES`](scene::SCENES).
//! - **A game loop**: a card in [`POLICIES`](loops::POLICIES), its source in `assets/loops`, and a file beside
//!   `loops/policies/whole_refresh.rs` if it has a memory.
//! - **A metric**: one entry of [`METRICS`](run::METRICS). **A key**: one entry of [`KEYS`](studio::KEYS).
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
//! A [`System`](sim::System) and a start are enough for [`advise`], [`Race::of`](run::Race::of),
//! [`Scene::of`](scene::Scene::of) and `Window::run`; [`Options`](scene::Options) and [`Extras`](sim::bodies::Extras) say more:
//!
//! ```
#![doc = include_str!("../examples/custom_body.rs")]
//! ```
//!
//! Many starts of a body of one coordinate are a [`Cloud`](measure::cloud::Cloud), which knows what becomes of their area:
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

// Only `main` exits, and the printers of the commands alone speak to a person.
#![warn(clippy::exit, clippy::print_stderr, clippy::print_stdout)]
// Files, clocks, threads and the environment are for drivers, each of which is named below: see clippy.toml.
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]
// The order of a hash map differs from run to run.
#![warn(clippy::iter_over_hash_type)]
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
#[allow(clippy::disallowed_methods, clippy::disallowed_types, reason = "of the drivers")]
mod atomic_file;
#[cfg(feature = "cli")]
#[allow(clippy::disallowed_methods, clippy::disallowed_types, reason = "of the drivers")]
pub mod commands;
#[cfg(feature = "lab")]
pub mod lab;
#[cfg(feature = "lab")]
pub mod look;
#[cfg(feature = "lab")]
pub mod loops;
pub mod manual;
#[cfg(feature = "lab")]
pub mod measure;
#[cfg(any(feature = "cli", feature = "view"))]
mod picture_note;
pub mod prelude;
#[cfg(any(feature = "cli", feature = "window"))]
#[allow(clippy::disallowed_methods, clippy::disallowed_types, reason = "of the drivers")]
mod regular_file;
#[cfg(feature = "lab")]
pub mod run;
#[cfg(feature = "lab")]
pub mod scene;
pub mod sim;
#[cfg(feature = "lab")]
pub mod stage;
#[cfg(any(feature = "cli", feature = "window"))]
#[allow(clippy::disallowed_methods, clippy::disallowed_types, reason = "of the drivers")]
mod stopwatch;
#[cfg(feature = "lab")]
pub mod studio;
#[cfg(feature = "lab")]
pub mod table;
#[cfg(feature = "lab")]
pub mod tools;
#[cfg(feature = "view")]
#[allow(clippy::iter_over_hash_type, reason = "textures are uploaded in any order")]
pub mod view;
#[cfg(feature = "window")]
#[allow(clippy::disallowed_methods, clippy::disallowed_types, reason = "of the drivers")]
pub mod window;

/// The vectors of the systems, in the version whose bits are promised.
pub use glam;

#[cfg(feature = "lab")]
pub use measure::{advise, try_advise};
#[cfg(feature = "lab")]
pub use sim::conformance;
