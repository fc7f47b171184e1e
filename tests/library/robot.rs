//! Randomly broken files: each is read, or refused at a place, and every file that is read also runs.

use std::panic::{AssertUnwindSafe, catch_unwind};

use regatta::loops::trace_file;
use regatta::run::Race;
use regatta::scene::{Action, SCENES, Scene};
use regatta::studio::{RunCommand, Studio};
use regatta::table::TableOptions;
use regatta::tools::identify::Log;

use super::bad_scenes::check_places;
use super::dice::Dice;

/// Files of each kind that are broken and read.
const ROUNDS: usize = 5_000;
/// One scene in this many is raced for a few ticks; most of the time of a round would go there.
const RACED: usize = 20;

/// A kind of file that the program reads.
struct Target {
    name: &'static str,
    /// Good ones, to break.
    files: Vec<String>,
    /// Reads one; whether it is good.
    read: fn(&[u8], round: usize) -> bool,
    /// How many of a thousand broken ones are refused: fewer, and they are not broken; more, and nothing is tested but
    /// the first letters.
    refused_per_mille: std::ops::Range<usize>,
}

fn targets() -> Vec<Target> {
    let scenes = || SCENES.iter().filter(|scene| !scene.text.is_empty());
    let logs = [
        include_str!("../data/engines/avian-motor__combo_60hz.csv"),
        include_str!("../data/engines/avian-motor__spring_1hz_z02_30hz.csv"),
    ];
    let first_lines = |text: &str| text.split_inclusive('\n').take(40).collect::<String>();
    let frames = [
        include_str!("../data/frame-traces/presentmon_test_case_0.csv"),
        include_str!("../data/frame-traces/presentmon_test_case_3.csv"),
    ];
    vec![
        Target {
            name: "scenes",
            files: scenes().map(|scene| scene.text.to_owned()).collect(),
            read: read_scene,
            refused_per_mille: 250..990,
        },
        Target {
            name: "laws and nets",
            files: scenes()
                .map(|scene| scene.text)
                .filter(|text| text.contains("[[law]]") || text.contains("[[net]]"))
                .map(str::to_owned)
                .collect(),
            read: read_scene,
            refused_per_mille: 250..990,
        },
        Target {
            name: "recordings",
            files: ["harbour", "helm", "chain"].map(recording).into(),
            read: read_scene,
            refused_per_mille: 250..990,
        },
        Target {
            name: "frame traces",
            files: frames.map(first_lines).into(),
            read: |bytes, _| trace_file::read("t.csv", &String::from_utf8_lossy(bytes)).is_ok(),
            refused_per_mille: 50..990,
        },
        Target {
            name: "logs of motion",
            files: logs.map(first_lines).into(),
            read: |bytes, _| {
                let text = String::from_utf8_lossy(bytes);
                Log::parse("log.csv", &text, &TableOptions::default(), 60.0).is_ok()
            },
            refused_per_mille: 50..990,
        },
    ]
}

/// A run with an act in it.
fn recording(scene: &str) -> String {
    let mut studio = Studio::new(Scene::built_in(scene).expect("a built-in scene"));
    (0..70).for_each(|_| studio.tick());
    studio.apply(RunCommand::Act(Action::Kick(0.5)));
    (0..70).for_each(|_| studio.tick());
    studio.deck.recording().expect("a run that can be written")
}

fn read_scene(bytes: &[u8], round: usize) -> bool {
    match Scene::from_bytes("mutant.toml", bytes) {
        Ok(scene) => {
            assert!(!scene.lanes.is_empty() && !scene.bodies.is_empty());
            if round.is_multiple_of(RACED) {
                Race::of_scene(&scene).run(3);
            }
            true
        }
        Err(errors) => {
            check_places(&errors);
            false
        }
    }
}

/// Inserted pieces: parts of files, and text that is hard on a parser.
const MORSELS: [&str; 29] = [
    "[[ship]]\n",
    "[[spring]]\n",
    "[[lane]]\n",
    "[[command]]\n",
    "[[law]]\n",
    "[[net]]\n",
    "[ship]\n",
    "[",
    "]",
    "{",
    "}",
    "\"",
    "'",
    "\"\"\"",
    "=",
    ".",
    ",",
    ";",
    "\n",
    "\r\n",
    "#",
    "\0",
    "é",
    "nan",
    "-1e999",
    "tick = 3\n",
    "at_s = 0.05\n",
    "methods = [\"rk4\", \"rk4\"]\n",
    "99999999999999999999",
];

/// One to four cuts, doublings, replaced bytes or morsels.
fn broken(text: &str, dice: &mut Dice) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    for _ in 0..1 + dice.below(4) {
        let at = dice.below(bytes.len() + 1);
        let end = (at + dice.below(40)).min(bytes.len());
        match dice.below(6) {
            0 => bytes.truncate(at),
            1 => drop(bytes.drain(at..end)),
            2 => {
                let part = bytes[at..end].to_vec();
                let to = dice.below(bytes.len() + 1);
                drop(bytes.splice(to..to, part));
            }
            3 if at < bytes.len() => bytes[at] = dice.below(256) as u8,
            4 if at < bytes.len() => bytes[at] = b' ' + dice.below(95) as u8,
            _ => drop(bytes.splice(at..at, MORSELS[dice.below(MORSELS.len())].bytes())),
        }
    }
    bytes
}

#[test]
fn no_broken_file_of_any_kind_causes_a_panic() {
    for (n, target) in targets().iter().enumerate() {
        let mut dice = Dice::new(0xb0 + n as u64);
        let mut refused = 0;
        for round in 0..ROUNDS {
            let bytes = broken(&target.files[round % target.files.len()], &mut dice);
            let read = catch_unwind(AssertUnwindSafe(|| (target.read)(&bytes, round)));
            let shown = || String::from_utf8_lossy(&bytes).into_owned();
            let good = read.unwrap_or_else(|_| panic!("{} {round}:\n{}", target.name, shown()));
            refused += usize::from(!good);
        }
        let per_mille = refused * 1000 / ROUNDS;
        assert!(target.refused_per_mille.contains(&per_mille), "{}: {per_mille}", target.name);
    }
}
