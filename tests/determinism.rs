//! The same inputs give the same bits: in debug and release, on every machine, at every frame rate.
//!
//! `tests/hashes.txt` holds the state hash of every built-in scene under every method. `tests/early_hashes.txt` holds
//! the hash after a twentieth of the way, where a debug build stops unless `REGATTA_WHOLE` is set. After an intended
//! change of the physics, rewrite both: `BLESS=1 cargo test --release --test determinism`.

#![cfg(feature = "lab")]

use std::path::PathBuf;

use regatta::run::Race;
use regatta::scene::{Action, BuiltIn, LaneSpec, SCENES, Scene, SceneBody, Scripted};
use regatta::sim::integrators::{GENERAL_METHODS, Method, method};
use regatta::studio::{RunCommand, StageCommand, Studio};

#[path = "kept/mod.rs"]
mod kept;

use kept::hold_text;

/// Ticks after which the hash is taken: 28 minutes at 60 Hz. For a scene of many coordinates fewer, so
/// that it takes no longer than one of four.
fn ticks(scene: &Scene) -> u64 {
    let coordinates = |body: &SceneBody| body.kind.coordinates(&body.values).len() as u64;
    400_000 / scene.bodies.iter().map(coordinates).sum::<u64>().max(4)
}

/// The part of the ticks after which the early hash is taken.
const EARLY: u64 = 20;

/// Whether the run ends there: a debug build would take minutes for the rest.
fn stops_early() -> bool {
    cfg!(debug_assertions) && std::env::var_os("REGATTA_WHOLE").is_none()
}

const SECOND: i64 = 1_000_000_000;

/// Random numbers for frame times, the same on every machine.
struct XorShift(u64);

impl XorShift {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    fn below(&mut self, limit: i64) -> i64 {
        (self.next() % limit.unsigned_abs()) as i64
    }
}

/// A scene under one method, or a race of every method there is.
#[derive(Clone, Copy)]
enum Field {
    Solo(&'static Method),
    Everyone,
}

impl Field {
    fn open(self, scene: &Scene) -> Studio {
        match self {
            Field::Solo(method) => {
                let mut studio = Studio::new(scene.clone());
                studio.apply(StageCommand::Method(method));
                // From the start again, so that the script has the method in hand.
                studio.apply(StageCommand::Restart);
                studio
            }
            Field::Everyone => {
                let spec = |method| LaneSpec { method, ..scene.lanes[0] };
                let lanes = scene.fitting_methods().map(spec).collect();
                let mut opened = scene.clone();
                opened.lanes = lanes;
                let mut studio = Studio::new(opened);
                studio.apply(StageCommand::ToggleRace);
                studio
            }
        }
    }
}

fn built_in(name: &str) -> Scene {
    Scene::built_in(name).expect("a built-in scene")
}

/// The tick reached and the hash of each lane there.
type Mark = (u64, Vec<u64>);

fn mark(studio: &Studio) -> Mark {
    (studio.race().tick(), studio.race().lane_hashes().collect())
}

/// Runs a studio from frames of these lengths in nanoseconds, and marks the first frame at which each of
/// ten parts of `ticks` ticks is reached.
fn paced(mut studio: Studio, ticks: u64, mut frames: impl FnMut() -> i64) -> Vec<Mark> {
    let mut marks = Vec::new();
    for part in 1..=10 {
        while studio.race().tick() < ticks * part / 10 {
            studio.advance(frames());
        }
        marks.push(mark(&studio));
    }
    marks
}

/// Frames of a window at 60 a second, to the nanosecond.
fn steady() -> impl FnMut() -> i64 {
    let mut n = 0;
    move || {
        n += 1;
        SECOND * n / 60 - SECOND * (n - 1) / 60
    }
}

/// Frames of every kind: usual ones of 0.1 to 40 ms, none, backward ones, hitches beyond the cap.
fn ragged(seed: u64) -> impl FnMut() -> i64 {
    println!("frame times from seed {seed:#x}");
    let mut random = XorShift(seed);
    move || match random.below(20) {
        0 => 0,
        1 => -random.below(SECOND),
        2 => SECOND / 10 + random.below(SECOND),
        _ => SECOND / 10_000 + random.below(SECOND / 25),
    }
}

/// Ticks a studio one by one up to the last of `ticks`, compares it on the way with the marks of the pacings, and
/// returns the hashes at `ticks`.
fn compare(
    mut studio: Studio,
    ticks: &[u64],
    paced: &[(&str, Vec<Mark>)],
    what: &str,
) -> Vec<Vec<u64>> {
    let mut hashes = Vec::new();
    let marked = paced.iter().flat_map(|(_, marks)| marks).map(|mark| mark.0);
    let last = marked.chain(ticks.iter().copied()).max().expect("some ticks");
    while studio.race().tick() < last {
        studio.tick();
        let tick = studio.race().tick();
        if ticks.contains(&tick) {
            hashes.push(mark(&studio).1);
        }
        for (pacing, marks) in paced {
            if let Some(there) = marks.iter().find(|there| there.0 == tick) {
                assert_eq!(*there, mark(&studio), "{what}: {pacing} pacing against tick by tick");
            }
        }
    }
    hashes
}

/// The lines of one scene, early and at the end: its name, the method, and the hash after its ticks, which over the first
/// part must not depend on the pacing.
fn lines(name: &str) -> Vec<String> {
    let scene = built_in(name);
    let ticks = if stops_early() {
        vec![ticks(&scene) / EARLY]
    } else {
        vec![ticks(&scene) / EARLY, ticks(&scene)]
    };
    // Frames end within ticks, or they do not: that is seen long before the hash is taken.
    let paced_ticks = ticks[0] / 4;
    let pacings = [
        ("steady", paced(Field::Everyone.open(&scene), paced_ticks, steady())),
        ("ragged", paced(Field::Everyone.open(&scene), paced_ticks, ragged(0x5eed_0001))),
    ];
    let hashes = compare(Field::Everyone.open(&scene), &ticks, &pacings, name);
    let line = |(method, hash): (&Method, u64)| format!("{name} {} {hash:016x}\n", method.id);
    hashes.into_iter().map(|at| scene.fitting_methods().zip(at).map(line).collect()).collect()
}

/// Compares `found` with a stored file, or rewrites the file.
fn hold(file: &str, found: &str) {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests").join(file);
    if std::env::var_os("BLESS").is_some_and(|value| value == "1") {
        std::fs::write(&path, found).expect("the file can be written");
    }
    let kept = std::fs::read_to_string(&path)
        .expect("it is there; write it with BLESS=1 cargo test --release --test determinism");
    let remedy = "BLESS=1 cargo test --release --test determinism writes them; of the rows that are there none may change \
                  without a reason in the CHANGELOG";
    hold_text(&format!("tests/{file}"), found, &kept, remedy);
}

#[test]
fn every_scene_and_method_keeps_its_hash_at_any_pacing() {
    let found: Vec<Vec<String>> = std::thread::scope(|threads| {
        let scenes = SCENES.iter().map(|scene| threads.spawn(|| lines(scene.name)));
        let scenes: Vec<_> = scenes.collect();
        scenes.into_iter().map(|lines| lines.join().expect("see above")).collect()
    });
    for (n, file) in ["early_hashes.txt", "hashes.txt"].iter().take(found[0].len()).enumerate() {
        hold(file, &found.iter().map(|scene| scene[n].as_str()).collect::<String>());
    }
}

/// Every kind of input that a script can give.
fn script() -> Vec<(u64, Action)> {
    let of = |tick, action| (tick, action);
    let switch = |tick, id| of(tick, Action::Method(method(id).expect("a method")));
    vec![
        of(0, Action::Kick(0.5)),
        of(7, Action::Throttle(0.3)),
        switch(60, "semi-implicit-euler"),
        of(61, Action::Kick(-1.0)),
        of(200, Action::TickHz(49.into())),
        switch(300, "adaptive-euler"),
        of(301, Action::Throttle(0.2)),
        of(301, Action::Throttle(0.1)),
        of(800, Action::TickHz(240.into())),
        switch(1000, "rk4"),
        of(1001, Action::Throttle(-1.0)),
        of(1001, Action::Rudder(0.7)),
        of(1400, Action::Rudder(0.6)),
        of(1500, Action::Kick(2.0)),
    ]
}

/// Beyond the last act of the script.
const SCRIPTED_TICKS: u64 = 1600;

/// One lane whose method the script switches, and all methods at once.
fn fields() -> [(&'static str, Field); 2] {
    [("solo", Field::Solo(&GENERAL_METHODS[0])), ("race", Field::Everyone)]
}

fn scripted(name: &str, script: Vec<(u64, Action)>) -> Scene {
    let mut scene = built_in(name);
    scene.script = Scripted::of_ticks(scene.tick_hz, script);
    scene
}

/// The built-in scenes without the cloth, which needs minutes for thousands of ticks in a debug build.
fn quick_scenes() -> impl Iterator<Item = &'static BuiltIn> {
    SCENES.iter().filter(|scene| scene.name != "cloth")
}

#[test]
fn a_script_acts_at_its_ticks_at_any_pacing() {
    std::thread::scope(|threads| {
        for scene in quick_scenes() {
            threads.spawn(move || a_script_acts_at_its_ticks(scene.name));
        }
    });
}

fn a_script_acts_at_its_ticks(name: &str) {
    let [with, without] = [script(), Vec::new()].map(|script| scripted(name, script));
    for (kind, field) in fields() {
        let what = format!("scripted {name} {kind}");
        let mut pacings =
            vec![("ragged", paced(field.open(&with), SCRIPTED_TICKS, ragged(0x5eed_0002)))];
        // An action on one lane acts on all, at the tick of the pacing.
        if matches!(field, Field::Solo(_)) {
            pacings.extend([
                ("steady", paced(field.open(&with), SCRIPTED_TICKS, steady())),
                ("hasty", paced(field.open(&with), SCRIPTED_TICKS, || SECOND / 4)),
            ]);
        }
        let hash = compare(field.open(&with), &[SCRIPTED_TICKS], &pacings, &what);
        if matches!(field, Field::Solo(_)) {
            let plain = compare(field.open(&without), &[SCRIPTED_TICKS], &[], &what);
            assert_ne!(hash, plain, "{what}: the script changes something");
        }
    }
}

#[test]
fn a_persons_commands_act_like_the_same_script() {
    for (kind, field) in fields() {
        let mut by_script = field.open(&scripted("harbour", script()));
        let mut by_hand = field.open(&scripted("harbour", Vec::new()));
        let mut commands = script().into_iter().peekable();
        for tick in 0..SCRIPTED_TICKS {
            while let Some(due) = commands.next_if(|(due, _)| *due == tick) {
                by_hand.apply(RunCommand::Act(due.1));
            }
            by_hand.tick();
            by_script.tick();
            assert_eq!(mark(&by_hand), mark(&by_script), "harbour {kind} at tick {tick}");
        }
        assert!(commands.next().is_none());
    }
}

#[test]
fn ragged_frames_lose_ticks_to_the_cap_and_count_them() {
    let mut frames = ragged(0x5eed_0003);
    let mut studio = Studio::new(built_in("spring"));
    let (mut real_ns, mut ticks, mut dropped) = (0, 0, 0);
    for _ in 0..2000 {
        let frame = frames();
        real_ns += frame.max(0);
        let due = studio.advance(frame);
        assert!(due.ticks <= studio.clock().max_ticks());
        ticks += u64::from(due.ticks);
        dropped += due.dropped;
    }
    assert!(dropped > 0);
    assert_eq!((studio.race().tick(), studio.deck.dropped_ticks()), (ticks, dropped));
    let owed = real_ns.unsigned_abs() * u64::from(studio.clock().tick_hz().whole_hz().unwrap())
        / SECOND.unsigned_abs();
    assert_eq!(ticks + dropped, owed, "every nanosecond is a tick stepped, dropped, or owed");
}

#[test]
fn the_hash_depends_on_the_last_bit_of_every_value() {
    let scene = built_in("harbour");
    let hash = |scene: &Scene| Field::Everyone.open(scene).race().state_hash();
    let plain = hash(&scene);
    for (body, place) in (0..scene.bodies.len()).flat_map(|body| [(body, 3), (body, 4)]) {
        let mut moved = scene.clone();
        let value = &mut moved.bodies[body].values[place];
        *value = value.next_up();
        assert_ne!(hash(&moved), plain, "body {body}, value {place}");
        let mut negated = scene.clone();
        let value = &mut negated.bodies[body].values[place];
        if *value == 0.0 {
            *value = -0.0;
            assert_eq!(hash(&negated), plain, "-0 and 0 are one state");
        }
    }
}

#[test]
fn each_lane_has_the_hash_it_has_alone() {
    let scene = built_in("harbour");
    let mut race = Field::Everyone.open(&scene);
    let mut solos: Vec<Studio> =
        GENERAL_METHODS.iter().map(|method| Field::Solo(method).open(&scene)).collect();
    for _ in 0..200 {
        race.tick();
        solos.iter_mut().for_each(Studio::tick);
    }
    let alone = solos.iter().map(|studio| studio.race().state_hash());
    assert!(race.race().lane_hashes().eq(alone));
}

#[test]
fn the_hash_depends_on_which_body_halted_and_when() {
    // Two equal springs at rest with different kicks. A large kick breaks a body before tick `when`.
    let hash = |kicks: [&str; 2], when: u64| {
        let spring = "[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 1\nx0_m = 0\nkick_n_s =";
        let [one, other] = kicks;
        let text = format!(
            "title = 'x'\ntick_hz = 60\nseconds = 1\nmethods = ['rk4']\n{spring} {one}\n{spring} {other}\n"
        );
        let mut race = Race::of_scene(&Scene::parse("twins.toml", &text).unwrap());
        race.run(when);
        race.perform(&Action::Kick(1e300), &mut ());
        race.run(10 - when);
        race.state_hash()
    };
    let hashes = [
        hash(["0", "0"], 3),
        hash(["1", "0"], 3),
        hash(["0", "1"], 3),
        hash(["1", "1"], 3),
        hash(["1", "0"], 4),
    ];
    for (n, hash) in hashes.iter().enumerate() {
        assert!(!hashes[..n].contains(hash), "case {n}: {hash:x}");
    }
}

#[test]
fn the_race_of_the_library_is_the_race_of_the_program() {
    let plain = quick_scenes().map(|scene| built_in(scene.name));
    let scripted = quick_scenes().map(|scene| scripted(scene.name, script()));
    // Past the last action of the script; a scene without a script differs sooner.
    let scenes = plain.map(|scene| (scene, 5)).chain(scripted.map(|scene| (scene, 16)));
    for (scene, hundreds) in scenes {
        let mut race = Race::of_scene(&scene);
        let mut studio = Studio::new(scene);
        studio.apply(StageCommand::ToggleRace);
        for _ in 0..hundreds {
            race.run(100);
            (0..100).for_each(|_| studio.tick());
            assert_eq!(race.t().to_bits(), studio.race().t().to_bits());
            assert!(race.lane_hashes().eq(studio.race().lane_hashes()), "{}", studio.scene().name);
        }
        let methods = studio.scene().lanes.iter().map(|lane| lane.method.id);
        assert!(race.hashes_by_method().eq(methods.zip(race.lane_hashes())));
    }
}
