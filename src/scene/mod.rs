//! A scene: what is simulated, and how. It is read from TOML text and checked as a whole.
//!
//! Reading is driven by the tables of [methods](crate::sim::integrators::METHODS) and
//! [bodies](crate::sim::bodies::BODIES): a scene may name whatever they list. All faults of a file are
//! reported at once, each with its place and its remedy; a [`Scene`] has none.

use std::path::Path;
use std::sync::{Arc, LazyLock, OnceLock};

pub use crate::sim::TickRate;
use crate::sim::bodies::{ClaimHorizon, Kind, Origin};
use crate::sim::integrators::Method;

mod action;
mod appearance;
pub(crate) mod clip;
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
mod sayable;
mod script;
mod syntax;
mod table;
mod time_scale;
mod wanted;
mod writer;

pub use action::Action;
pub(crate) use action::Control;
pub use appearance::Appearance;
pub(crate) use appearance::{Drawing, Preview};
#[cfg(feature = "cli")]
pub(crate) use clip::cut;
pub(crate) use clip::{clip, clip_list};
pub use cloud_shape::{CloudKind, CloudShape};
pub use custom::{Options, OptionsError};
pub use edit::{EditError, check_entered, edited_values, entered_tick_rate};
pub use errors::{MAX_SHOWN, Mistake, SceneError, SceneErrors};
pub(crate) use keys::tick_rate_line;
pub use known::{SceneKey, scene_tables};
pub use lane_spec::{LaneId, LaneSpec, Swing};
pub use nearest::nearest;
pub(crate) use outline::Thread;
pub use outline::{Mark, Outline};
pub use own::is_rule;
#[cfg(feature = "cli")]
pub(crate) use own::own;
pub(crate) use own::own_table;
pub use refusal::Refusal;
pub use time_scale::TimeScale;
pub(crate) use time_scale::{Piece, nearest_tick};

/// The largest scene file in bytes: tens of thousands of scripted commands. A file of nothing but
/// mistakes takes the parser some hundred times its size in memory.
pub const MAX_FILE_BYTES: usize = 1 << 20;

/// The highest tick rate in Hz: ten times the finest rate of physics in games.
pub const MAX_TICK_HZ: u32 = 10_000;

/// The ticks of a scene of this length (s) and rate, at which the claims of its bodies are held against their motion.
pub(crate) fn claim_horizon(seconds: f64, tick_hz: TickRate) -> ClaimHorizon {
    ClaimHorizon { tick_hz, ticks: (seconds * tick_hz.hz()).round() as u64 }
}

/// The longest a scene may run, in seconds: a year. At [`MAX_TICK_HZ`] its last tick is far below
/// 2⁵³, so that `tick / rate` is exact to the last bit of an f64.
pub const MAX_SECONDS: f64 = 365.0 * 86_400.0;

/// The shortest that a scene may run, in seconds: a tick at [`MAX_TICK_HZ`].
pub const MIN_SECONDS: f64 = 1.0 / MAX_TICK_HZ as f64;

/// How long a scene runs that does not say so, in seconds: twenty swings of a spring at 1 Hz.
pub const USUAL_SECONDS: f64 = 20.0;

/// The last tick of the longest scene at the highest rate.
pub const LAST_TICK: u64 = 365 * 86_400 * MAX_TICK_HZ as u64;

/// The most bodies in a scene: more cells than this cannot be told apart on a stage.
pub const MAX_BODIES: usize = 64;

/// The most lanes in a scene: twice the number of colours that can be told apart.
pub const MAX_LANES: usize = 32;

/// The most substeps in a tick of a lane.
pub const MAX_SUBSTEPS: u32 = 1_000;

/// The tolerances that a lane may be given: below the least, round-off alone is more; with the largest, an
/// error may be as large as the value.
pub const TOLERANCES: (f64, f64) = (1e-14, 1.0);

/// The largest magnitude of a coordinate that a body can be placed at. Beyond it bodies halt; see
/// [`ESCAPE`](crate::run::race::ESCAPE).
const MAX_COORDINATE: f64 = 1e38;

/// The most characters in a body's name: it stands in one line beside its cell.
pub const MAX_NAME_CHARS: usize = 64;

/// What is simulated, and how.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Scene {
    /// The built-in scene's name, or its file's name without directory and ending.
    pub name: String,
    /// The text that it was read from; `None` if there is none.
    pub source: Option<Arc<str>>,
    /// Its name for people.
    pub title: String,
    /// What it shows; empty if the file does not say.
    pub about: String,
    /// What to try, for the line under the stage.
    pub hint: Option<String>,
    /// Ticks per second, in [`Clock::TICK_HZ`](crate::sim::Clock::TICK_HZ).
    pub tick_hz: TickRate,
    /// How long it runs, from [`MIN_SECONDS`] to [`MAX_SECONDS`].
    pub seconds: f64,
    /// The methods by lines of its author's own, no two of one id.
    pub own_methods: Vec<&'static Method>,
    /// The methods that race, 1 to [`MAX_LANES`], no two alike.
    pub lanes: Vec<LaneSpec>,
    /// The method that the program opens the scene with, one of the lanes'; `None` for the first lane's.
    pub opening_method: Option<&'static Method>,
    /// Whether each lane gets as many substeps as bring its cost nearest to the dearest lane's.
    pub equal_cost: bool,
    /// Whether the program opens it as a race, and not under one method.
    pub opens_as_race: bool,
    /// The clouds of many starts that it opens with, in place of the bodies; `None` if it opens with those.
    pub clouds: Option<CloudKind>,
    /// The bodies in the order of the file, 1 to [`MAX_BODIES`], no two of one name.
    pub bodies: Vec<SceneBody>,
    /// The scripted commands by time, and those of one time in the order of the file.
    pub script: Vec<Scripted>,
    /// States that a race of the scene must reproduce, in the order of the file. A scene that has some is a recording, whose
    /// file tells its script in ticks.
    pub checks: Vec<Check>,
    /// What its file says in a way that will not be read for long, with the remedies; `None` if there is nothing.
    pub outdated: Option<Arc<SceneErrors>>,
}

/// A body of a scene.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct SceneBody {
    /// Its name, not found on any other body of the scene.
    pub name: String,
    /// What it is.
    pub kind: Arc<Kind>,
    /// What [`Kind::build`] takes: one value for each of the kind's parameters, in their order, and for
    /// a curve two for each point.
    pub values: Vec<f64>,
    /// How it is drawn; shared by its copies.
    pub appearance: Arc<Appearance>,
}

impl SceneBody {
    /// A body that is drawn as all of its kind are.
    pub(crate) fn new(name: impl Into<String>, kind: Arc<Kind>, values: Vec<f64>) -> Self {
        Self { name: name.into(), kind, values, appearance: Arc::default() }
    }
}

/// A command of a scene's script.
#[derive(Clone, Debug, PartialEq)]
pub struct Scripted {
    /// When it is done, in seconds, at most [`MAX_SECONDS`]: before the nearest tick at the rate in force, in every lane and
    /// in the truth.
    pub at_s: f64,
    /// What is done.
    pub action: Action,
}

impl Scripted {
    /// A script that is told in ticks, as a recording tells it: at this rate in Hz, and from a change of the rate on at the
    /// new one. The ticks are in order.
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
    /// When, at most [`LAST_TICK`].
    pub tick: u64,
    /// The lane.
    pub lane: LaneId,
    /// Its [hash](crate::run::Race::lane_hashes) when the tick is reached, before the actions of that tick.
    pub hash: u64,
}

impl Scene {
    /// Reads a scene from the bytes of a file; `file` is the file's name, for messages.
    ///
    /// # Errors
    /// As [`Scene::parse`], and where the bytes are not UTF-8.
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
    /// All faults of the text, in its order.
    pub fn parse(file: &str, text: &str) -> Result<Scene, SceneErrors> {
        if text.len() > MAX_FILE_BYTES {
            return Err(SceneErrors::too_large(file));
        }
        // Some editors begin a file with a byte order mark, and none of them counts it as a column.
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let stem = Path::new(file).file_stem().and_then(|stem| stem.to_str());
        let (mut scene, outdated) = document::read(stem.unwrap_or(file), text)
            .map_err(|errors| SceneErrors::new(file, text, errors))?;
        if !outdated.is_empty() {
            scene.outdated = Some(SceneErrors::new(file, text, outdated).into());
        }
        Ok(scene)
    }

    /// The script on the ticks of a run at the scene's rate: for each command its tick, and the time of that in seconds.
    pub(crate) fn script_on_ticks(&self) -> impl Iterator<Item = (u64, f64)> {
        let script = self.script.iter().map(|row| (row.at_s, &row.action));
        Piece::first(self.tick_hz).put_on_ticks(script)
    }

    /// The actions of the script with the times of their ticks in seconds, in order.
    pub(crate) fn timed_script(&self) -> impl Iterator<Item = (f64, &Action)> {
        let actions = self.script.iter().map(|row| &row.action);
        self.script_on_ticks().map(|(_, t)| t).zip(actions)
    }

    /// The methods that digits and lanes refer to: the scene's lanes, then all others that step its bodies.
    pub fn method_list(&self) -> Vec<LaneSpec> {
        let is_listed = |method: &Method| self.lanes.iter().any(|spec| spec.method == method);
        let others = self.fitting_methods().filter(|method| !is_listed(method));
        self.lanes.iter().copied().chain(others.map(LaneSpec::plain)).collect()
    }

    /// The scene with the body at this index alone. It has no checks: they are of all bodies.
    pub(crate) fn of_one_body(mut self, index: usize) -> Scene {
        self.bodies = vec![self.bodies.swap_remove(index)];
        self.checks.clear();
        self.script.retain_mut(|scripted| match &mut scripted.action {
            Action::Set { body, .. } | Action::Place { body, .. } => {
                std::mem::replace(body, 0) == index
            }
            _ => true,
        });
        self
    }

    /// The name of a body, or the id of a lane's method, that is written in Rust, so that no scene file holds it; `None`
    /// if there is none.
    pub fn in_rust(&self) -> Option<&str> {
        let mut bodies =
            self.bodies.iter().filter(|body| matches!(body.kind.origin, Origin::Custom(_)));
        let mut lanes = self.lanes.iter().filter(|lane| lane.method.custom.is_some());
        let body = bodies.next().map(|body| &*body.name);
        body.or_else(|| lanes.next().map(|lane| lane.method.id))
    }

    /// The scene of [`SCENES`] with this name. It is read once, and what is found out for drawing it is shared by all copies.
    pub fn built_in(name: &str) -> Option<Scene> {
        static READ: LazyLock<Vec<OnceLock<Scene>>> =
            LazyLock::new(|| SCENES.iter().map(|_| OnceLock::new()).collect());
        let index = SCENES.iter().position(|scene| scene.name == name)?;
        let BuiltIn { name, text, .. } = SCENES[index];
        let read = || Scene::parse(name, text).expect("tests/library/scenes parses them all");
        Some(READ[index].get_or_init(read).clone())
    }

    /// The harbour with a second spring, for what concerns springs beside each other.
    #[cfg(test)]
    pub(crate) fn with_two_springs() -> Scene {
        let [mut scene, mut damped] =
            ["harbour", "damped"].map(|name| Scene::built_in(name).unwrap());
        "damped spring".clone_into(&mut damped.bodies[0].name);
        scene.bodies.splice(1..1, damped.bodies);
        scene
    }
}

/// A scene that is part of the program.
#[derive(Debug)]
pub struct BuiltIn {
    /// The name of its file in `assets/scenes`, without the ending.
    pub name: &'static str,
    /// Where it stands in menus and lists.
    pub group: SceneGroup,
    /// The file.
    pub text: &'static str,
}

/// What a built-in scene is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SceneGroup {
    /// For the first minutes.
    StartHere,
    /// What the chapter warns of, or is about.
    Chapter,
    /// Methods of physics engines.
    Engines,
    /// All others.
    More,
}

impl SceneGroup {
    /// All, in the order of menus.
    pub const ALL: [Self; 4] = [Self::StartHere, Self::Chapter, Self::Engines, Self::More];

    /// Its heading.
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

/// Every built-in scene, in menu order; the first is the one that the program opens with.
pub static SCENES: &[BuiltIn] = scenes! {
    StartHere: "harbour" "spring" "ship" "damped" "pendulum";
    Chapter: "stiff" "surge" "chain" "helm";
    Engines: "alike" "engines" "held-force" "stiff-in-engines";
    More: "liouville" "kicked-rotor" "orbit" "follow" "lerp" "duffing" "quarter-car" "bouncing-bungee" "lift" "jump" "rope"
        "cloth" "bridge";
};
