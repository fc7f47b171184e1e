//! A scene, which is the bodies of a simulation, with the methods, the tick rate and the script of its run. It is read
//! from TOML text and checked as a whole.
//!
//! The tables of [methods](crate::sim::integrators::METHODS) and [bodies](crate::sim::bodies::BODIES) drive the reader,
//! so that a scene may name any entry of them. The reader reports all faults of a file at once, each with its place and
//! its remedy; a [`Scene`] has no faults.

// The rules of a room: see `src/lib.rs` and clippy.toml.
#![warn(clippy::exit, clippy::print_stderr, clippy::print_stdout)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]
#![warn(clippy::iter_over_hash_type)]

use regatta_sim as sim;

use std::path::Path;
use std::sync::{Arc, LazyLock, OnceLock};

pub use crate::sim::TickRate;
use crate::sim::bodies::{ClaimHorizon, Kind, Origin};
use crate::sim::integrators::Method;

mod action;
mod action_range;
mod appearance;
pub mod clip;
mod cloud_shape;
pub mod custom;
mod described;
mod document;
mod edit;
mod errors;
mod fault;
mod keys;
mod known;
mod lane_spec;
mod law;
mod nearest;
mod net;
mod outline;
mod own;
mod refusal;
mod saved;
mod script;
mod syntax;
mod table;
mod time_scale;
mod wanted;
mod writer;

pub use action::Action;
pub use action::Control;
pub use appearance::Appearance;
pub use appearance::{Drawing, Preview};
pub use clip::truncate;
pub use clip::{clip, clip_list};
pub use cloud_shape::CloudShape;
pub use custom::{Options, OptionsError};
pub use edit::{EditError, check_entered, edited_values, entered_tick_rate};
pub use errors::{MAX_SHOWN, SceneError, SceneErrors, ShownError};
pub use keys::tick_rate_line;
pub use known::{SceneKey, scene_tables};
pub use lane_spec::{LaneId, LaneSpec, Swing};
pub use nearest::nearest;
pub use outline::Thread;
pub use outline::{Mark, Outline};
pub use own::is_rule;
pub use own::own_table;
pub use refusal::Refusal;
pub use time_scale::TimeScale;
pub use time_scale::{Piece, nearest_tick};

/// Largest scene file in bytes, with room for tens of thousands of scripted commands. For a file full of mistakes, the
/// parser needs some hundred times the size of the file in memory.
pub const MAX_FILE_BYTES: usize = 1 << 20;

/// Highest tick rate in Hz, which is ten times the finest rate of physics in games.
pub const MAX_TICK_HZ: u32 = 10_000;

/// Returns the ticks at which a scene of this length (s) and rate checks the claims of its bodies against their motion.
pub(crate) fn claim_horizon(seconds: f64, tick_hz: TickRate) -> ClaimHorizon {
    ClaimHorizon { tick_hz, ticks: (seconds * tick_hz.hz()).round() as u64 }
}

/// Longest run of a scene in seconds, which is a year. At [`MAX_TICK_HZ`] its last tick is far below 2⁵³, so that
/// `tick / rate` is exact to the last bit of an f64.
pub const MAX_SECONDS: f64 = 365.0 * 86_400.0;

/// Shortest run of a scene in seconds, which is a tick at [`MAX_TICK_HZ`].
pub const MIN_SECONDS: f64 = 1.0 / MAX_TICK_HZ as f64;

/// Length in seconds of a scene that gives none, which is twenty swings of a spring at 1 Hz.
pub const USUAL_SECONDS: f64 = 20.0;

/// The last tick of the longest scene at the highest rate.
pub const LAST_TICK: u64 = 365 * 86_400 * MAX_TICK_HZ as u64;

/// Maximum number of bodies in a scene. With more, the cells on a stage are indistinguishable.
pub const MAX_BODIES: usize = 64;

/// Maximum number of lanes in a scene, which is twice the number of distinguishable colours.
pub const MAX_LANES: usize = 32;

pub use crate::sim::law::MAX_SUBSTEPS;

/// Range of a lane's tolerance. Below this range, round-off alone is larger; at its upper end, an error may be as large
/// as the value.
pub const TOLERANCES: (f64, f64) = (1e-14, 1.0);

/// Largest magnitude of a coordinate at which a body can be placed. Bodies halt beyond
/// `ESCAPE`.
const MAX_COORDINATE: f64 = 1e38;

/// Maximum number of characters in a body's name, which appears in one line beside the body's cell.
pub const MAX_NAME_CHARS: usize = 64;

/// The bodies of a simulation, with the settings of its run.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Name of the built-in scene, or of its file without directory and ending.
    pub name: String,
    /// The text from which the scene was read; `None` if there is none.
    pub source: Option<Arc<str>>,
    /// Name of the scene for people.
    pub title: String,
    /// Description of the scene for people; empty if the file has none.
    pub about: String,
    /// A suggestion to try, for the line under the stage.
    pub hint: Option<String>,
    /// Ticks per second, in [`Clock::TICK_HZ`](crate::sim::Clock::TICK_HZ).
    pub tick_hz: TickRate,
    /// Length of the scene's run in seconds, from [`MIN_SECONDS`] to [`MAX_SECONDS`].
    pub seconds: f64,
    /// Methods in the author's own lines, each with a unique id.
    pub own_methods: Vec<&'static Method>,
    /// The lanes in the race, 1 to [`MAX_LANES`], all different.
    pub lanes: Vec<LaneSpec>,
    /// The method of the lane with which the program opens the scene; `None` for the first lane.
    pub opening_method: Option<&'static Method>,
    /// Whether each lane gets the substeps that bring its cost nearest to that of the most expensive lane.
    pub equal_cost: bool,
    /// Whether the program opens the scene as a race rather than under one method.
    pub opens_as_race: bool,
    /// Whether a race of the scene's only body opens with each lane in a band of its own, beside its lines of code.
    pub opens_in_bands: bool,
    /// The shape of the clouds of many starts with which the scene opens; `None` if it opens with the bodies.
    pub clouds: Option<CloudShape>,
    /// The bodies in the order of the file, 1 to [`MAX_BODIES`], each with a unique name.
    pub bodies: Vec<SceneBody>,
    /// The scripted commands by time. Commands with the same time keep the order of the file.
    pub script: Vec<Scripted>,
    /// States that a race of the scene must reproduce, in the order of the file. A scene with checks is a recording,
    /// and its file gives the script in ticks.
    pub checks: Vec<Check>,
}

/// A body of a scene.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct SceneBody {
    /// Name of the body, unique in the scene.
    pub name: String,
    /// Kind of the body.
    pub kind: Arc<Kind>,
    /// Argument of [`Kind::build`]: one value for each parameter of the kind, in their order, and two for each point
    /// of a curve.
    pub values: Vec<f64>,
    /// Drawing of the body, shared with the body's copies.
    pub appearance: Arc<Appearance>,
}

impl SceneBody {
    /// Creates a body with the usual look of its kind.
    pub fn new(name: impl Into<String>, kind: Arc<Kind>, values: Vec<f64>) -> Self {
        Self { name: name.into(), kind, values, appearance: Arc::default() }
    }
}

/// A command of a scene's script, which is an action at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct Scripted {
    /// Time of the action in seconds, at most [`MAX_SECONDS`]. The action comes before the nearest tick at the rate in
    /// force, in every lane and in the truth.
    pub at_s: f64,
    /// The action.
    pub action: Action,
}

impl Scripted {
    /// Converts a script in ticks, such as that of a recording, to seconds. The ticks must be in order. They have the
    /// rate `tick_hz` until an action sets another one.
    pub fn of_ticks(
        tick_hz: impl Into<TickRate>,
        rows: impl IntoIterator<Item = (u64, Action)>,
    ) -> Vec<Self> {
        let mut piece = Piece::first(tick_hz);
        let scripted = |(tick, action): (u64, Action)| {
            let at_s = piece.t(tick);
            if let Some(tick_hz) = action.tick_hz() {
                piece = piece.then(tick, tick_hz);
            }
            Self { at_s, action }
        };
        rows.into_iter().map(scripted).collect()
    }
}

/// The state that a lane must reach in a race of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Check {
    /// Tick of the check, at most [`LAST_TICK`].
    pub tick: u64,
    /// Number of the lane.
    pub lane: LaneId,
    /// The lane's hash when the lane reaches the tick, before the actions of that
    /// tick.
    pub hash: u64,
}

impl Scene {
    /// Reads a scene from the bytes of a file; `file` is the file's name, for messages.
    ///
    /// # Errors
    /// Fails as [`Scene::parse`] does, and if the bytes are not UTF-8.
    pub fn from_bytes(file: &str, bytes: &[u8]) -> Result<Scene, SceneErrors> {
        if bytes.len() > MAX_FILE_BYTES {
            return Err(SceneErrors::too_large(file));
        }
        match str::from_utf8(bytes) {
            Ok(text) => Scene::parse(file, text),
            Err(error) => Err(SceneErrors::not_utf8(file, bytes, error.valid_up_to())),
        }
    }

    /// Reads a scene from the text of a file; `file` is the file's name, for messages.
    ///
    /// # Errors
    /// Fails with all faults of the text, in the order of the text.
    pub fn parse(file: &str, text: &str) -> Result<Scene, SceneErrors> {
        if text.len() > MAX_FILE_BYTES {
            return Err(SceneErrors::too_large(file));
        }
        // Some editors begin a file with a byte order mark, and none of them counts it as a column.
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let stem = Path::new(file).file_stem().and_then(|stem| stem.to_str());
        document::read(stem.unwrap_or(file), text)
            .map_err(|errors| SceneErrors::new(file, text, errors))
    }

    /// Returns for each command of the script its tick in a run at the scene's rate, and the tick's time in seconds.
    pub(crate) fn script_on_ticks(&self) -> impl Iterator<Item = (u64, f64)> {
        let script = self.script.iter().map(|row| (row.at_s, &row.action));
        Piece::first(self.tick_hz).put_on_ticks(script)
    }

    /// Returns the actions of the script in order, each with its tick's time in seconds.
    pub fn timed_script(&self) -> impl Iterator<Item = (f64, &Action)> {
        let actions = self.script.iter().map(|row| &row.action);
        self.script_on_ticks().map(|(_, t)| t).zip(actions)
    }

    /// Returns the methods that digits and lanes refer to: the scene's lanes, then plain lanes of all other methods
    /// that step the scene's bodies.
    pub fn method_list(&self) -> Vec<LaneSpec> {
        let is_listed = |method: &Method| self.lanes.iter().any(|spec| spec.method == method);
        let others = self.fitting_methods().filter(|method| !is_listed(method));
        let plain = others.map(|method| self.plain_lane(method));
        self.lanes.iter().copied().chain(plain).collect()
    }

    /// Returns the scene with only the body at this index. The result has no checks, because these cover all bodies.
    pub fn of_one_body(mut self, index: usize) -> Scene {
        self.bodies = vec![self.bodies.swap_remove(index)];
        self.checks.clear();
        self.script.retain_mut(|scripted| match &mut scripted.action {
            Action::Set { body, .. } | Action::Place { body, .. } | Action::Push { body, .. } => {
                std::mem::replace(body, 0) == index
            }
            _ => true,
        });
        self
    }

    /// Returns the name of a body, or the id of a lane's method, that is written in Rust and so cannot be in a scene
    /// file; `None` if there is none.
    pub fn in_rust(&self) -> Option<&str> {
        let mut bodies =
            self.bodies.iter().filter(|body| matches!(body.kind.origin, Origin::Custom(_)));
        let is_in_rust = |method: &Method| method.custom.is_some() && method.own_text().is_none();
        let mut lanes = self.lanes.iter().filter(|lane| is_in_rust(lane.method));
        let body = bodies.next().map(|body| &*body.name);
        body.or_else(|| lanes.next().map(|lane| lane.method.id))
    }

    /// Returns the scene of [`SCENES`] with this name. The scene is read once, and all copies share its drawing data.
    pub fn built_in(name: &str) -> Option<Scene> {
        static READ: LazyLock<Vec<OnceLock<Scene>>> =
            LazyLock::new(|| SCENES.iter().map(|_| OnceLock::new()).collect());
        let index = SCENES.iter().position(|scene| scene.name == name)?;
        let BuiltIn { name, text, .. } = SCENES[index];
        let read = || Scene::parse(name, text).expect("tests/library/scenes parses them all");
        Some(READ[index].get_or_init(read).clone())
    }

    /// Returns the built-in scene of this name, or the first whose first body is of a kind of this name.
    #[doc(hidden)]
    pub fn with_kind(kind: &str) -> Scene {
        let others = SCENES.iter().filter_map(|scene| Scene::built_in(scene.name));
        let mut others = others.filter(|scene| scene.bodies[0].kind.id == kind);
        Scene::built_in(kind).or_else(|| others.next()).expect("a scene for each kind")
    }

    /// Returns the harbour with a second spring, for tests on several springs.
    #[doc(hidden)]
    pub fn with_two_springs() -> Scene {
        let [mut scene, mut damped] = ["harbour", "damped"].map(Scene::with_kind);
        "damped spring".clone_into(&mut damped.bodies[0].name);
        scene.bodies.splice(1..1, damped.bodies);
        scene
    }
}

/// A scene that is part of the program.
#[derive(Debug)]
pub struct BuiltIn {
    /// Name of the scene's file in `assets/scenes`, without the ending.
    pub name: &'static str,
    /// Group of the scene in menus and lists.
    pub group: SceneGroup,
    /// Text of the scene's file.
    pub text: &'static str,
}

/// The group of a built-in scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SceneGroup {
    /// Scenes for the first minutes.
    StartHere,
    /// Scenes on the chapter's topics and warnings.
    Chapter,
    /// Scenes with the methods of physics engines.
    Engines,
    /// All other scenes.
    More,
}

impl SceneGroup {
    /// All groups, in the order of menus.
    pub const ALL: [Self; 4] = [Self::StartHere, Self::Chapter, Self::Engines, Self::More];

    /// Returns the heading of the group.
    pub fn title(self) -> &'static str {
        match self {
            Self::StartHere => "Start here",
            Self::Chapter => "The chapter",
            Self::Engines => "Engines",
            Self::More => "More",
        }
    }
}

/// Makes the table of built-in scenes from their names, group by group.
macro_rules! scenes {
    ($($group:ident: $($name:literal)+;)+) => {
        &[$($(BuiltIn {
            name: $name,
            group: SceneGroup::$group,
            text: include_str!(concat!("../../assets/scenes/", $name, ".toml")),
        },)+)+]
    };
}

/// Name of the scene with which the program opens if nothing else is asked for.
pub const OPENING: &str = "two-springs";

/// Every built-in scene, in menu order. An option without a scene is about the first.
pub static SCENES: &[BuiltIn] = scenes! {
    StartHere: "harbour" "spring" "ship" "damped" "pendulum" "two-springs";
    Chapter: "stiff" "surge" "chain" "helm";
    Engines: "alike" "engines" "held-force" "stiff-in-engines";
    More: "liouville" "kicked-rotor" "orbit" "follow" "lerp" "duffing" "quarter-car" "bouncing-bungee" "lift" "jump" "ball" "perpetual" "drop" "pong" "landing" "paddle" "coin" "t-handle" "phone" "long-box" "gyro" "rope"
        "cloth" "bridge";
};
