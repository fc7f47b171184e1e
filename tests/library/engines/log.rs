//! Logs of the engines in `tests/data/engines`, and the body that each of them is of.

use std::collections::HashMap;
use std::fs;
use std::path::PathBuf;

use regatta::conformance::problems::{Problem, fresh, problem};
use regatta::sim::integrators::{Method, StepFailure, method};
use regatta::sim::{Query, State, System};

/// Where the logs are, with their manifest.
fn folder() -> PathBuf {
    PathBuf::from("tests/data/engines")
}

/// A body in an engine: a spring, drag and a constant force, any of which may be 0.
#[derive(Clone, Debug)]
pub(crate) struct Body {
    /// K and c, per unit of mass.
    pub(crate) spring: [f64; 2],
    /// C, per second.
    pub(crate) drag: f64,
    /// The constant force, per unit of mass.
    pub(crate) push: f64,
    /// Whether user code applies the spring.
    pub(crate) is_held: bool,
}

impl Body {
    pub(crate) fn problem(&self) -> Problem<f64> {
        problem(self.clone())
    }
}

impl System for Body {
    type Vector = f64;

    fn acceleration(&self, _t: f64, x: &f64, v: &f64, a: &mut f64) {
        let [stiffness, damping] = self.spring;
        *a = self.push - (stiffness * x + damping * v) - self.drag * v;
    }

    fn query(&self, _t: f64, query: Query<'_, f64>) -> bool {
        let Query::Engine { state: State { q: x, v }, settings, force } = query else {
            return false;
        };
        let [stiffness, damping] = self.spring;
        settings.drag = self.drag;
        if self.is_held {
            *force = self.push - (stiffness * x + damping * v);
        } else {
            *force = self.push;
            (settings.stiffness, settings.damping) = (stiffness, damping);
        }
        true
    }
}

/// A row of a log.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row {
    pub(crate) tick: u64,
    pub(crate) x: f64,
    pub(crate) v: f64,
}

/// A log of an engine.
#[derive(Clone, Debug)]
pub(crate) struct Log {
    pub(crate) file: String,
    /// The engine as the manifest calls it.
    pub(crate) engine: String,
    /// `f32` or `f64`.
    pub(crate) precision: String,
    /// `spring`, `ship`, `damp`, `held` or `combo`.
    pub(crate) scenario: String,
    /// The tick that the engine was given, in seconds.
    pub(crate) tick_s: f64,
    pub(crate) substeps: u32,
    pub(crate) body: Body,
    pub(crate) rows: Vec<Row>,
}

impl Log {
    /// Every log of the manifest that is of a body without rotation.
    pub(crate) fn all() -> Vec<Log> {
        let rows = manifest();
        let logs: Vec<Log> =
            rows.iter().filter(|row| row["scenario"] != "tumble").map(Log::of).collect();
        assert!(logs.len() >= 100, "{} logs", logs.len());
        logs
    }

    fn of(row: &Entry) -> Log {
        let number = |key: &str| -> f64 {
            row[key].parse().unwrap_or_else(|error| panic!("{}: {key}: {error}", row["file"]))
        };
        let mass = number("mass");
        let has_spring = !matches!(&*row["scenario"], "ship" | "damp");
        let of_spring = |key: &str| if has_spring { number(key) / mass } else { 0.0 };
        let body = Body {
            spring: ["k", "c"].map(of_spring),
            drag: number("C"),
            push: number("force") / mass,
            is_held: row["scenario"] == "held",
        };
        let rows = columns(&row["file"], ["tick", "x", "v"]).into_iter();
        Log {
            file: row["file"].clone(),
            engine: row["engine"].clone(),
            precision: row["precision"].clone(),
            scenario: row["scenario"].clone(),
            tick_s: number("dt_s"),
            substeps: row["n"].parse().expect("a number of substeps"),
            body,
            rows: rows.map(|[tick, x, v]| Row { tick: tick as u64, x, v }).collect(),
        }
    }

    /// The card that is to reproduce it.
    pub(crate) fn method(&self) -> &'static Method {
        let id = match &*self.engine {
            "box2d" | "box2d-prismatic" => "engine-box2d",
            "box3d" | "box3d-prismatic" => "engine-box3d",
            "rapier2d" | "rapier3d" => "engine-rapier",
            "avian" => "engine-avian",
            "avian-motor" => "engine-avian-motor",
            "jolt" | "jolt-slider" | "crashcat" => "engine-jolt",
            "physx-pgs" | "physx-pgs-acc" | "physx-pgs-distance" => "engine-physx",
            "physx-tgs" => "engine-physx-tgs",
            "physx-tgs-56" => "engine-physx-tgs-56",
            "bullet" => "engine-bullet",
            "bullet-6dof" => "engine-bullet-6dof",
            "pybullet-multibody" => "engine-pybullet",
            "chipmunk" => "engine-chipmunk",
            "mujoco-Euler"
            | "mujoco-implicitfast"
            | "mujoco-implicitfast-actuator"
            | "drake"
            | "newton-mujoco" => "engine-mujoco",
            "mujoco-RK4" => "engine-mujoco-rk4",
            "mujoco-discrete" | "newton-vbd" | "newton-kamino" => "engine-mujoco-discrete",
            "planck" | "box2d-wasm" => "engine-box2d-2",
            "cannon" | "p2" | "newton-featherstone" | "newton-semi-implicit" | "drake-tamsi" => {
                "engine-cannon"
            }
            "newton-xpbd" => "engine-newton-xpbd",
            "matter" => "engine-matter",
            "havok" => "engine-havok",
            "oimophysics-symplectic" => "engine-oimo-symplectic",
            "oimophysics" => "engine-oimo",
            "nape" => "engine-nape",
            "phaser-arcade" => "engine-phaser-arcade",
            "excalibur" => "engine-excalibur",
            // Without the limits of its spring, with an actuator in place of a joint, or at a limit, all is explicit.
            "bullet-unlimited" | "mujoco-Euler-actuator" | "havok-limit" => "semi-implicit-euler",
            other => panic!("no card for {other}"),
        };
        method(id).expect("a method of the table")
    }

    /// The allowed error of a row over one tick and over the run, in units of the largest coordinate or velocity.
    pub(crate) fn tolerances(&self) -> [f64; 2] {
        match &*self.precision {
            "f32" => [4e-6, 5e-5],
            _ => [3e-14, 1e-12],
        }
    }

    /// The largest |x| and |v|.
    pub(crate) fn scale(&self) -> [f64; 2] {
        let largest = |part: fn(&Row) -> f64| {
            self.rows.iter().map(|row| part(row).abs()).fold(0.0_f64, f64::max)
        };
        [largest(|row| row.x), largest(|row| row.v)]
    }

    /// The run of its card from the first row, at the ticks of all rows.
    pub(crate) fn run(&self) -> Result<Vec<Row>, StepFailure> {
        let mut state = State { q: self.rows[0].x, v: self.rows[0].v };
        let (body, mut stepper) = (self.body.problem(), fresh(self.method()));
        let mut tick = self.rows[0].tick;
        let mut reached = Vec::new();
        for row in &self.rows {
            while tick < row.tick {
                let t = tick as f64 * self.tick_s;
                stepper.steps(&body, t, self.tick_s, self.substeps, &mut state)?;
                tick += 1;
            }
            reached.push(Row { tick, x: state.q, v: state.v });
        }
        Ok(reached)
    }
}

/// The manifest's entry for a log, by key.
pub(crate) type Entry = HashMap<String, String>;

/// The manifest, with an entry for each log.
pub(crate) fn manifest() -> Vec<Entry> {
    let text = fs::read_to_string(folder().join("manifest.csv")).expect("a manifest");
    let mut lines = text.lines();
    let keys: Vec<&str> = lines.next().expect("a heading").split(',').collect();
    let pairs = |line: &str| -> Entry {
        let values = line.split(',').map(str::to_owned);
        keys.iter().map(|key| (*key).to_owned()).zip(values).collect()
    };
    lines.map(pairs).collect()
}

/// The columns `wanted` of the log in `file`, row by row.
pub(crate) fn columns<const N: usize>(file: &str, wanted: [&str; N]) -> Vec<[f64; N]> {
    let text = fs::read_to_string(folder().join(file)).unwrap_or_else(|e| panic!("{file}: {e}"));
    let mut lines = text.lines();
    let keys: Vec<&str> = lines.next().expect("a heading").split(',').collect();
    let indices = wanted.map(|key| keys.iter().position(|known| *known == key).expect("a column"));
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        indices.map(|index| cells[index].parse::<f64>().expect("a number"))
    };
    lines.map(row).collect()
}
