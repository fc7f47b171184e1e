//! What a scene file can have wrong, one file each, with the reviewed message beside it.
//!
//! `BLESS=1 cargo test --test bad_scenes` writes the messages anew; without it, one that is missing or
//! different fails.

use std::fs;
use std::path::{Path, PathBuf};

use regatta::lab::{LARGEST_FILE, MOST_BODIES, MOST_SHOWN, SCENES, Scene, SceneErrors};

#[test]
fn every_bad_scene_gives_its_reviewed_message() {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad_scenes");
    let is_blessing = std::env::var_os("BLESS").is_some();
    let mut wrong = Vec::new();
    let files = files(&directory, "toml");
    for file in &files {
        let name = file.file_name().unwrap().to_str().unwrap();
        let message = match Scene::from_bytes(name, &fs::read(file).unwrap()) {
            Ok(_) => panic!("{name} is a good scene"),
            Err(errors) => format!("{errors}\n"),
        };
        let golden = file.with_extension("txt");
        if is_blessing {
            fs::write(&golden, &message).unwrap();
        } else if fs::read_to_string(&golden).ok().as_deref() != Some(&message) {
            wrong.push(message);
        }
    }
    assert!(files.len() >= 30, "only {} bad scenes", files.len());
    assert_eq!(wrong, [""; 0], "not as in the text files beside them");
    let scenes: Vec<_> = files.iter().map(|file| file.with_extension("txt")).collect();
    assert_eq!(self::files(&directory, "txt"), scenes, "a message without a scene, or none");
}

fn files(directory: &Path, ending: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(directory).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<_> =
        entries.filter(|path| path.extension().is_some_and(|found| found == ending)).collect();
    files.sort();
    files
}

#[test]
fn a_million_bodies_are_refused_for_the_size_of_their_file() {
    let errors = refused(&"[[ship]]\n".repeat(1_000_000));
    let message = "bad.toml:1:1: the file holds more than 1048576 bytes; give a scene file, with a shorter script";
    assert_eq!(errors.to_string(), message);
}

#[test]
fn as_many_bodies_as_a_file_can_hold_are_refused_by_their_number() {
    let head = "title = 'many'\ntick_hz = 60\nseconds = 1\n";
    let body = "[[ship]]\n";
    let count = (LARGEST_FILE - head.len()) / body.len();
    let errors = refused(&(head.to_owned() + &body.repeat(count)));
    // Three keys are missing in each ship that is looked at.
    assert_eq!(errors.errors.len() + errors.more, 3 * MOST_BODIES + 1);

    let good = "[[ship]]\nthrust_n = 1\ndrag_n_s_per_m = 1\nmass_kg = 1\n";
    let count = (LARGEST_FILE - head.len()) / good.len();
    let errors = refused(&(head.to_owned() + &good.repeat(count)));
    let message =
        format!("bad.toml:260:1: the scene has {count} bodies; keep at most {MOST_BODIES}");
    assert_eq!(errors.to_string(), message);
}

#[test]
fn a_file_of_nothing_but_mistakes_is_refused_without_a_word_too_many() {
    for mistake in ["=\n", "a=\n", "a=1\n", "\0", "\0\n", "[", "\"", "a=1 1\n", "[[x]]\n", "é\r"] {
        let errors = refused(&mistake.repeat(LARGEST_FILE / mistake.len()));
        assert!(errors.to_string().lines().count() <= MOST_SHOWN + 1);
        check_places(&errors);
    }
}

#[test]
fn nesting_as_deep_as_a_file_can_hold_does_not_overflow_the_stack() {
    for opening in ["[", "{a=", "a.", "[[", "[{a="] {
        for start in ["", "a=", "methods=", "[a."] {
            let text = start.to_owned() + &opening.repeat((LARGEST_FILE - 8) / opening.len());
            check_places(&refused(&text));
        }
    }
}

#[test]
fn a_built_in_scene_with_mistakes_thrown_in_never_panics_and_every_error_has_its_place() {
    let seed = match std::env::var("SEED") {
        Ok(seed) => seed.parse().expect("SEED is a number"),
        Err(_) => 0x5EA_5EED,
    };
    println!("run again with SEED={seed}");
    let mut random = Xorshift(seed);
    let mut refused = 0;
    for round in 0..8_000 {
        let text = SCENES[round % SCENES.len()].text;
        let bytes = mutate(text.as_bytes(), &mut random);
        let outcome = std::panic::catch_unwind(|| Scene::from_bytes("mutant.toml", &bytes));
        let shown = String::from_utf8_lossy(&bytes);
        match outcome.unwrap_or_else(|_| panic!("round {round} panics on:\n{shown}")) {
            Ok(scene) => assert!(!scene.lanes.is_empty() && !scene.bodies.is_empty(), "{shown}"),
            Err(errors) => {
                check_places(&errors);
                refused += 1;
            }
        }
    }
    assert!((2_000..8_000).contains(&refused), "{refused} of 8000 refused: bad mutations");
}

/// What mutation puts in: parts of scenes, and what is hard on a parser.
const MORSELS: [&str; 24] = [
    "[[ship]]\n",
    "[[spring]]\n",
    "[[lane]]\n",
    "[[command]]\n",
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
    "\n",
    "\r\n",
    "#",
    "\0",
    "é",
    "nan",
    "-1e999",
    "tick = 3\n",
    "methods = [\"rk4\", \"rk4\"]\n",
    "99999999999999999999",
];

/// One to four cuts, doublings, replaced bytes or morsels.
fn mutate(text: &[u8], random: &mut Xorshift) -> Vec<u8> {
    let mut bytes = text.to_vec();
    for _ in 0..1 + random.below(4) {
        let at = random.below(bytes.len() + 1);
        let end = (at + random.below(40)).min(bytes.len());
        match random.below(6) {
            0 => bytes.truncate(at),
            1 => drop(bytes.drain(at..end)),
            2 => {
                let part = bytes[at..end].to_vec();
                let to = random.below(bytes.len() + 1);
                drop(bytes.splice(to..to, part));
            }
            3 if at < bytes.len() => bytes[at] = random.below(256) as u8,
            4 if at < bytes.len() => bytes[at] = b' ' + random.below(95) as u8,
            _ => {
                let morsel = MORSELS[random.below(MORSELS.len())];
                drop(bytes.splice(at..at, morsel.bytes()));
            }
        }
    }
    bytes
}

struct Xorshift(u64);

impl Xorshift {
    fn below(&mut self, end: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % end as u64) as usize
    }
}

fn refused(text: &str) -> SceneErrors {
    Scene::parse("bad.toml", text).expect_err("a good scene")
}

/// Errors come in order, and each begins at a place that an editor can go to.
fn check_places(errors: &SceneErrors) {
    assert!(!errors.errors.is_empty());
    let lines: Vec<&str> = errors.text.split('\n').collect();
    let mut last = (1, 1);
    for error in &errors.errors {
        let place = errors.position(error.span.start);
        assert!(place >= last, "{errors}");
        let (line, column) = place;
        assert!((1..=lines.len()).contains(&line), "{errors}");
        assert!((1..=lines[line - 1].chars().count() + 1).contains(&column), "{errors}");
        assert!(error.span.start <= error.span.end && error.span.end <= errors.text.len());
        assert!(!error.to_string().contains(char::is_control), "{errors:?}");
        last = place;
    }
}
