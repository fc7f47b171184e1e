//! Regatta shows in real time what a numerical integrator does to a game's moving bodies, so that a developer picks
//! the right one before shipping.
//!
#![cfg_attr(
    feature = "lab",
    doc = r#"
# The house

A room may use only the rooms that its row lists, all of them above it. Those with a package of their own are kept to that by
Cargo, and have `crate::sim` for `regatta_sim`; for the others a test checks it. This package is the façade: it has every room
under the name in the first column.

| room | package | holds | may name | open first |
|---|---|---|---|---|
| [`lines`] | `regatta-lines` | the language of methods, rules and loops | - | `lines/step_text.rs` |
| [`sim`] | `regatta-sim` | states, equations, methods, bodies | `lines` | `sim/integrators/rk4.rs` |
| [`scene`] | `regatta-scene` | scenes as text and value, actions, custom bodies | `sim` | `scene/mod.rs` |
| [`table`] | `regatta-table` | a table reader: bytes to rows and numbers | `sim scene` | `table/mod.rs` |
| [`run`] | `regatta-run` | a race against the truth: actions, past, recording | `sim table scene` | `run/mod.rs` |
| [`tools`] | `regatta-tools` | a log's method, springs for engines, source code | `sim table scene` | `tools/port.rs` |
| [`measure`] | `regatta-measure` | verdicts, advice, stability maps, clouds | `sim scene run tools` | `measure/judge.rs` |
| [`loops`] | `regatta-loops` | game loops, frame traces, the loop lab | `sim table scene run measure` | `loops/loop_run.rs` |
| [`look`] | `regatta-look` | shapes, handles and colours of bodies | `sim scene run measure` | `look/pendulum.rs` |
| [`studio`] | `regatta-studio` | a person at a run: commands, view, background work | `sim scene run tools measure loops look` | `studio/apply.rs` |
| [`stage`] | `regatta-stage` | the picture as data: [`compose`](stage::compose()) makes a [`Picture`](stage::Picture) | `sim scene run measure loops look studio` | `stage/compose.rs` |
| `view` | `regatta-view` | pixels: panels, charts, `FrameRenderer::draw`, two executors | `scene run tools measure loops look studio stage` | `view/frame.rs` |
| `window` | `regatta` | a screen, real time, files | `scene run measure loops look studio view` | `window.rs` |
| `commands` | `regatta` | the command line: captures, threads | `sim table scene run tools measure loops look studio view window` | `commands/mod.rs` |

Without features this package is `sim` without [`bodies`](sim::bodies) and [`law`](sim::law)s, for a game's own loop, which
may as well take `regatta-sim` alone.
`lab` adds the rooms up to `stage`; `view` and `window` follow. `cli` is `commands` above
`view`, and `play` needs `window`. The default, `desktop`, has all. Up to `stage` nothing knows a graphics crate, a file or
a wall clock: text comes in as `&str`, time as integers.

# A frame

events → [`Command`](studio::Command)s → [`Studio::apply`](studio::Studio::apply) → [`Action`](scene::Action)s →
[`Race`](run::Race) → [`PerformedAction`](run::race::PerformedAction) → [`Clock::advance`](sim::Clock::advance) →
due [ticks](run::Run::tick) → [`compose`](stage::compose()) → `FrameRenderer::draw` → `CpuExecutor`,
`KeptFrame` in a window, or `GpuExecutor`. A [`FrameLoop`](studio::FrameLoop) does this in real time.

# Invariants

- **The same bits everywhere.** Stepped state is `f64` and uses only `+ - × ÷ √` and `libm`; time is whole ticks.
  Frame rate, drawing, platform and build profile change nothing: `tests/determinism.rs` compares hashes.
- **A run is a value.** A [`Session`](run::Session) changes only by [`Action`](scene::Action)s and ticks, and its
  [`Journal`](run::Journal) holds them all. A [`Run`](run::Run) goes to any tick and finds the same bits.
- **A body that blows up is data.** It halts, keeps its last good state and gives a reason; the other bodies go
  on unchanged.
- **A step allocates nothing**, locks nothing and touches no file.
- **Claims are measured.** Tests hold every field of a [`Method`](sim::integrators::Method) card from both sides,
  with drag and without.
- **One table each** for [methods](sim::integrators::METHODS), [bodies](sim::bodies::BODIES),
  [rules for impacts](sim::IMPACTS), [metrics](run::METRICS), [scenes](scene::SCENES), [keys](studio::KEYS),
  [stops](studio::guide::STOPS), [game loops](loops::POLICIES), [their metrics](loops::PACING_METRICS) and
  [traces](loops::TRACES). Menus, help and tests loop over them.

# Words

- **band**: a lane's strip of the stage, or a loop's in the loop lab; of a matrix, the entries near its diagonal
- **card**: the constant that describes a method, a loop or a trace: names, source and claims, which tests measure
- **check**: the hash of a lane at a tick, in a recording
- **checkpoint**: the state after a change of the run, from which a verdict, advice or a cloud starts
- **cloud**: many starts around the state of a body, stepped by one method
- **criterion**: a demand on a method: bounded, looks right or accurate
- **deck**: a run as a person controls it, with its clock, the selected lane and a body in hand
- **entrant**: a lane in a race, with its number and its settings
- **entry**: a method on the menu; a digit, a row and a colour name it by its menu index
- **fan**: the next second of a body under each method, drawn from its present state
- **ghost**: the true body, drawn among the lanes
- **halt**: the end of a body that blew up or whose method failed; it keeps its last good state
- **horizon**: the time over which a lane is judged: the length of the scene, a minute at most
- **journal**: all actions of a run by tick, performed and pending, by the script and by hand
- **lane**: one method on its own copy of the scene's bodies; the truth is a lane, too
- **moment**: a time to draw, which may lie between two ticks
- **notice**: a message to the person, which disappears by itself
- **past**: the samples of a run that are kept for drawing, and no part of its state
- **reserve**: the factor by which bodies could be stiffer before a method misses its criterion
- **rule**: the line after a step that handles an impact, or a person's own lines for one frame
- **stage**: the picture of the bodies, as data
- **stop**: one station of the guide: a scene, a question and a task
- **substep**: a step of the method; a tick has one or more of equal length, unless the method chooses them
- **tick**: the unit of a run's time; actions come before a tick, and drawing lies between two
- **told**: in code, words that something has returned: the parts of a notice, the lines of a report
- **truth**: the exact motion, by a closed form or by the reference solution
- **verdict**: the result of a comparison of a lane with the truth: a word, its number, and the findings behind them
- **viewer**: a person's view of a run, which never changes the run

# Add a thing

- **A method**: copy `sim/integrators/midpoint.rs`, add a line to `methods!` and its source to `assets/methods`.
- **A physics engine**: a method [for some bodies only](sim::integrators::Only), like `sim/integrators/bullet.rs`.
- **A body**: copy `sim/bodies/pendulum.rs` and `look/pendulum.rs`; add it to `BODIES` and `LOOKS`.
- **A scene**: a file in `assets/scenes` and its name in [`SCENES`](scene::SCENES).
- **A game loop**: its lines in `assets/loops`, with the claims of its card above them, and its id in
  [`POLICIES`](loops::POLICIES).
- **A rule for impacts**: a line of [`IMPACTS`](sim::IMPACTS), its change in `sim/bouncer.rs`, and its source in
  `assets/impacts`.
- **A metric** or **a key**: one entry of its table.
"#
)]
//!
//! # In your own game loop
//!
//! A ball falls through air, stepped at 120 Hz at any frame rate and drawn between ticks:
//!
//! ```
#![doc = include_str!("../examples/game_loop.rs")]
//! ```
//!
#![cfg_attr(
    feature = "lab",
    doc = r#"
# Custom bodies and methods

A [`System`](sim::System) and a start are enough for [`advise`], [`Race::of`](run::Race::of),
[`Scene::of`](scene::Scene::of) and `Window::run`:

```
"#,
    doc = include_str!("../examples/custom_body.rs"),
    doc = r#"
```

A custom method is an [`Integrator`](sim::integrators::Integrator) and a card, which [`conformance::check`]
measures:

```
"#,
    doc = include_str!("../examples/custom_method.rs"),
    doc = r#"
```

For many copies of a body see `examples/cloud.rs` and `examples/batch.rs`.

# In continuous integration

A race of a scene keeps its hashes until its physics changes:

```
"#,
    doc = include_str!("../examples/ci_hash.rs"),
    doc = r#"
```
"#
)]
//!
//! The [manual] describes the program.
//!
//! # Out of scope
//!
//! Contacts among bodies, friction, and rotation at a contact, which would hide the integrator behind the solver.
//! One body on one given floor is in: it has no solver, and the rule of its impacts is one visible line. Generic
//! scalars, which would bury the formulas (`commands/sweep/round_off.rs` is the exception); constraints, which a
//! closed body with natural coordinates does not need.

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
pub mod manual;
pub mod prelude;
#[cfg(any(feature = "cli", feature = "window"))]
#[cfg_attr(not(feature = "cli"), allow(dead_code, reason = "the commands read tables, too"))]
#[allow(clippy::disallowed_methods, clippy::disallowed_types, reason = "of the drivers")]
mod regular_file;
#[cfg(any(feature = "cli", feature = "window"))]
#[allow(clippy::disallowed_methods, clippy::disallowed_types, reason = "of the drivers")]
mod stopwatch;
#[cfg(feature = "window")]
#[allow(clippy::disallowed_methods, clippy::disallowed_types, reason = "of the drivers")]
pub mod window;

/// The vectors of the systems, in the version whose bits are promised.
pub use glam;
#[doc(inline)]
pub use regatta_sim as sim;
#[cfg(feature = "view")]
#[doc(inline)]
pub use regatta_view as view;
#[cfg(feature = "lab")]
#[doc(inline)]
pub use {
    regatta_lines as lines, regatta_look as look, regatta_loops as loops,
    regatta_measure as measure, regatta_run as run, regatta_scene as scene, regatta_stage as stage,
    regatta_studio as studio, regatta_table as table, regatta_tools as tools,
};

#[cfg(feature = "lab")]
pub use {
    measure::{advise, try_advise},
    sim::conformance,
};
