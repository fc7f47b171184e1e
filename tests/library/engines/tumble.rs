//! A body that spins freely in space: the maps that the cards name, against logs of the engines and on their own.

use std::collections::BTreeSet;

use glam::DVec3;
use regatta::sim::integrators::{FreeSpin, METHODS, SpinMap, method};

use super::log::{Entry, columns, manifest};

/// The principal moments of inertia of the body of every log, in kg m².
const INERTIA: DVec3 = DVec3::new(1.0, 2.0, 3.0);

/// The angular velocities, in rad/s, from which the logs start: near the axis of the least moment, near that of the
/// largest, and near the middle axis, where a spin is unstable.
const STARTS: [DVec3; 3] =
    [DVec3::new(3.0, 0.5, 0.5), DVec3::new(0.5, 0.5, 3.0), DVec3::new(0.01, 5.0, 0.01)];

fn energy(omega: DVec3) -> f64 {
    omega.dot(INERTIA * omega) / 2.0
}

/// The larger of two values, or NaN if one is.
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}

/// The largest component of a difference, or NaN.
fn off(found: DVec3, wanted: DVec3) -> f64 {
    (found - wanted).abs().to_array().into_iter().fold(0.0, larger)
}

/// The free spin on an engine's card.
fn free_spin(id: &str) -> FreeSpin {
    let engine = method(id).and_then(|method| method.engine).expect("an engine");
    engine.free_spin.unwrap_or_else(|| panic!("{id} claims nothing"))
}

/// The angular velocity after a tick of `length` (s).
fn spin(id: &str, map: SpinMap, omega: DVec3, length: f64, substeps: u32) -> DVec3 {
    let steps = if free_spin(id).is_once_a_tick { 1 } else { substeps };
    let h = length / f64::from(steps);
    (0..steps).fold(omega, |omega, _| map.step(INERTIA, omega, h))
}

/// A row of a log.
#[derive(Clone, Copy, Debug)]
struct Row {
    tick: u64,
    /// In the frame of the principal axes, in rad/s.
    omega: DVec3,
    /// The kinetic energy, in joules.
    energy: f64,
}

/// A log of a tumble.
struct Tumble {
    file: String,
    /// The id of the card that is to reproduce it.
    id: &'static str,
    map: SpinMap,
    is_f32: bool,
    tick_s: f64,
    substeps: u32,
    rows: Vec<Row>,
}

impl Tumble {
    fn all() -> Vec<Tumble> {
        let entries = manifest();
        let logs: Vec<Tumble> =
            entries.iter().filter(|entry| entry["scenario"] == "tumble").map(Tumble::of).collect();
        assert_eq!(logs.len(), 33);
        logs
    }

    fn of(entry: &Entry) -> Tumble {
        let default = |id| (id, free_spin(id).default);
        let opt_in = |id| (id, free_spin(id).opt_in.expect("something to switch on"));
        let (id, map) = match &*entry["engine"] {
            "rapier3d" => default("engine-rapier"),
            "box3d" => default("engine-box3d"),
            "bullet" => default("engine-bullet"),
            "mujoco-Euler" => default("engine-mujoco"),
            "mujoco-RK4" => default("engine-mujoco-rk4"),
            "jolt-gyro" => opt_in("engine-jolt"),
            "physx-pgs-gyro" => opt_in("engine-physx"),
            "mujoco-implicit" | "mujoco-implicitfast" => opt_in("engine-mujoco"),
            other => panic!("no card for {other}"),
        };
        let row = |[tick, x, y, z, energy]: [f64; 5]| Row {
            tick: tick as u64,
            omega: DVec3::new(x, y, z),
            energy,
        };
        let rows = columns(&entry["file"], ["tick", "wx", "wy", "wz", "e"]);
        Tumble {
            file: entry["file"].clone(),
            id,
            map,
            is_f32: entry["precision"] == "f32",
            tick_s: entry["dt_s"].parse().expect("a number"),
            substeps: entry["n"].parse().expect("a number of substeps"),
            rows: rows.into_iter().map(row).collect(),
        }
    }

    /// The angular velocity a tick later, as the card says.
    fn tick(&self, omega: DVec3) -> DVec3 {
        spin(self.id, self.map, omega, self.tick_s, self.substeps)
    }

    /// The run of the card from the first row, at each row.
    fn run(&self) -> impl Iterator<Item = (DVec3, Row)> {
        let (mut tick, mut omega) = (self.rows[0].tick, self.rows[0].omega);
        self.rows.iter().map(move |row| {
            while tick < row.tick {
                omega = self.tick(omega);
                tick += 1;
            }
            (omega, *row)
        })
    }

    /// The largest |ω|.
    fn scale(&self) -> f64 {
        self.rows.iter().map(|row| row.omega.length()).fold(0.0, larger)
    }

    fn is_near_the_middle_axis(&self) -> bool {
        let start = self.rows[0].omega;
        start.y > start.x && start.y > start.z
    }

    /// Half of the last digit of a figure of the log: it has 9 or 12 of them.
    fn half_digit(&self, figure: f64) -> f64 {
        let digits = if self.is_f32 { 9 } else { 12 };
        if figure == 0.0 { 0.0 } else { 0.5 * 10.0_f64.powi(lead(figure) + 1 - digits) }
    }
}

/// The power of ten of a figure's first digit.
fn lead(figure: f64) -> i32 {
    figure.abs().log10().floor() as i32
}

#[test]
fn the_logged_energy_of_a_tumble_matches_its_angular_velocity() {
    for log in Tumble::all() {
        let most = if log.is_f32 { 1e-8 } else { 2e-11 };
        for row in &log.rows {
            let off = (energy(row.omega) / row.energy - 1.0).abs();
            assert!(off <= most, "{}, tick {}: {off:e}", log.file, row.tick);
        }
        assert!(STARTS.iter().any(|start| off(*start, log.rows[0].omega) < 1e-9), "{}", log.file);
    }
}

#[test]
fn every_spin_map_on_a_card_has_a_log_with_two_exceptions() {
    let seen: BTreeSet<_> = Tumble::all().iter().map(|log| (log.id, log.map.id())).collect();
    let engines = METHODS.iter().filter_map(|method| Some((method.id, method.engine?.free_spin?)));
    let named = engines
        .flat_map(|(id, spin)| {
            [Some(spin.default), spin.opt_in].map(|map| map.map(|map| (id, map)))
        })
        .flatten()
        .filter(|(id, map)| *map != SpinMap::Constant && *id != "engine-physx-tgs")
        .map(|(id, map)| (id, map.id()));
    assert_eq!(seen, named.collect());
}

/// Asserts that the worst of some differences is within its bound, and that the bound is no looser than `slack` times.
fn near(what: &str, worst: f64, most: f64, slack: f64) {
    assert!(worst <= most && worst * slack >= most, "{what}: {worst:.1e}, bound {most:.0e}");
}

#[test]
fn the_map_of_a_card_reproduces_each_logged_tick_of_a_tumble() {
    let (mut worst, mut compared) = ([0.0_f64; 2], 0);
    for log in Tumble::all() {
        let pairs = log.rows.windows(2).filter(|pair| pair[1].tick == pair[0].tick + 1);
        for pair in pairs {
            let off = off(log.tick(pair[0].omega), pair[1].omega) / log.scale();
            let most = if log.is_f32 { 1e-6 } else { 4e-12 };
            assert!(off <= most, "{}, tick {}: {off:.1e}", log.file, pair[1].tick);
            let worst = &mut worst[usize::from(log.is_f32)];
            *worst = larger(*worst, off);
            compared += 1;
        }
    }
    assert_eq!(compared, 33 * 20);
    // The logs of engines in double precision have 12 digits.
    near("f64", worst[0], 4e-12, 2.0);
    near("f32", worst[1], 1e-6, 10.0);
}

#[test]
fn twenty_ticks_of_a_tumble_match_the_digits_of_the_log() {
    let mut worst = [0.0_f64; 2];
    for log in Tumble::all() {
        let scale = log.rows[0].omega.length();
        for (found, row) in log.run().take(21) {
            for (found, wanted) in found.to_array().into_iter().zip(row.omega.to_array()) {
                let beyond = ((found - wanted).abs() - log.half_digit(wanted)).max(0.0) / scale;
                let most = if log.is_f32 { 4e-6 } else { 3e-14 };
                let is_near = found.is_finite() && beyond <= most;
                assert!(is_near, "{}, tick {}: {found}, {wanted}", log.file, row.tick);
                let worst = &mut worst[usize::from(log.is_f32)];
                *worst = larger(*worst, beyond);
            }
        }
    }
    near("f32", worst[1], 4e-6, 10.0);
}

/// The allowed relative error of the energy over a whole log: for double precision, near the middle axis (where
/// errors grow e-fold in 0.35 s), for explicit Euler where it magnifies them, for single precision, and for single
/// precision with energy loss near the middle axis.
const ENERGY_TOLERANCES: [f64; 5] = [5e-12, 1e-10, 2e-5, 2e-3, 5e-2];

/// Which of the tolerances is the log's.
fn energy_tolerance(log: &Tumble) -> usize {
    let is_lost = log.rows.last().is_some_and(|row| row.tick < 3600);
    match log.map {
        SpinMap::NewtonStep if log.is_f32 && log.is_near_the_middle_axis() => 4,
        _ if log.is_f32 => 3,
        SpinMap::Explicit if is_lost || log.is_near_the_middle_axis() => 2,
        _ if log.is_near_the_middle_axis() => 1,
        _ => 0,
    }
}

#[test]
fn the_energy_of_a_tumble_stays_with_the_log_for_a_minute() {
    let (mut lost, mut worst) = (Vec::new(), [0.0_f64; 5]);
    for log in Tumble::all() {
        let off = log.run().map(|(found, row)| (energy(found) / row.energy - 1.0).abs());
        let off = off.fold(0.0, larger);
        let class = energy_tolerance(&log);
        let most = ENERGY_TOLERANCES[class];
        assert!(off <= most, "{}: {off:.1e}, not {most:.0e}", log.file);
        worst[class] = larger(worst[class], off);
        if log.rows.last().unwrap().tick < 3600 {
            lost.push(log.file);
        }
    }
    for (worst, most) in worst.into_iter().zip(ENERGY_TOLERANCES) {
        near("the energy", worst, most, 100.0);
    }
    assert_eq!(lost, ["mujoco-Euler__tumble_b_60hz.csv"]);
}

/// A card, its map, the substeps, E/E₀ after a minute at 60 Hz from each of the starts (infinite where it diverges),
/// and the allowed error of a figure.
type Minute = (&'static str, SpinMap, u32, [f64; 3], f64);

/// Half of the last digit of a figure, and rounding.
const LAST_DIGIT: f64 = 0.51e-6;

/// The figures of the engines' own logs. The last three compute in single precision, whose rounding drifts.
const MINUTES: [Minute; 9] = [
    ("engine-rapier", SpinMap::ScaledMomentum, 4, [0.899085, 1.081465, 1.000002], LAST_DIGIT),
    ("engine-rapier", SpinMap::ScaledMomentum, 1, [0.708405, 1.474344, 1.000002], LAST_DIGIT),
    ("engine-bullet", SpinMap::NewtonStep, 1, [0.861181, 0.973171, 0.402005], LAST_DIGIT),
    ("engine-mujoco", SpinMap::NewtonStep, 1, [0.861181, 0.973171, 0.402005], LAST_DIGIT),
    ("engine-mujoco", SpinMap::Explicit, 1, [4.024905, f64::INFINITY, 5.584288], LAST_DIGIT),
    ("engine-mujoco-rk4", SpinMap::RungeKutta, 1, [1.000000, 1.000000, 1.000000], LAST_DIGIT),
    ("engine-jolt", SpinMap::ScaledMomentum, 1, [0.708636, 1.474918, 1.000209], 7e-4),
    ("engine-physx", SpinMap::ScaledMomentum, 4, [0.708422, 1.474518, 1.000008], 3e-4),
    ("engine-physx-tgs", SpinMap::ScaledMomentum, 4, [0.710216, 1.478912, 1.001710], 6e-3),
];

/// The angular velocity after `ticks` ticks at 60 Hz.
fn after(id: &str, map: SpinMap, substeps: u32, start: DVec3, ticks: u32) -> DVec3 {
    (0..ticks).fold(start, |omega, _| spin(id, map, omega, 1.0 / 60.0, substeps))
}

#[test]
fn the_energy_after_a_minute_matches_the_engine() {
    for (id, map, substeps, kept, most) in MINUTES {
        assert!([Some(free_spin(id).default), free_spin(id).opt_in].contains(&Some(map)), "{id}");
        let mut worst = 0.0_f64;
        for (start, wanted) in STARTS.into_iter().zip(kept) {
            let found = energy(after(id, map, substeps, start, 3600)) / energy(start);
            if wanted.is_infinite() {
                assert!(!found.is_finite(), "{id}, {map:?}: {found}");
                continue;
            }
            let off = (found - wanted).abs();
            assert!(off <= most, "{id}, {map:?} ×{substeps}: {found:.7}, not {wanted}");
            worst = worst.max(off);
        }
        near(id, worst, most, 6.0);
    }
}

/// MuJoCo resets a state whose velocity passes this, in rad/s.
const MUJOCO_LIMIT: f64 = 1e10;

#[test]
fn explicit_euler_diverges_after_45_s_about_the_axis_of_largest_moment() {
    let speed = |ticks| after("engine-mujoco", SpinMap::Explicit, 1, STARTS[1], ticks).length();
    let [logged, lost] = [2670, 2700].map(speed);
    assert!((logged - 109.4).abs() < 0.1, "{logged}");
    assert!(lost.is_nan() || lost > MUJOCO_LIMIT, "{lost}");
}
