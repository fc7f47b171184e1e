//! `fixture`: exact states as a test, which a good engine passes and a bad one fails.

use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

use super::{refusal, run_in, stdout_of};
use crate::compilers::{compile, rustc};

/// A spring of 2 kg on 40 N/m with 0.5 N s/m.
const SPRING: &str = "fixture --k 40 --c 0.5 --mass 2 --seconds 5";

/// A language of tests, with the placeholder for an engine's step in its file.
type Open = (&'static str, &'static str);

const PYTHON: Open = ("pytest", "    raise NotImplementedError(\"put your engine's step here\")");
const CPP: Open = ("gtest", "    throw std::logic_error(\"put your engine's step here\");");
const RUST: Open = ("rust", "    todo!(\"put your engine's step here\")");

/// A step on that spring, for such a place: of Runge-Kutta 4, or of explicit Euler.
fn engine(language: &str, is_good: bool) -> String {
    let (k, end) = match language {
        "pytest" => ("    ", ""),
        "gtest" => ("    const double ", ";"),
        _ => ("    let ", ";"),
    };
    let number = |array: &str| match language {
        "rust" => format!("f64::from({array}[0])"),
        _ => format!("{array}[0]"),
    };
    let stages =
        [("0.0", "0.0", "0.0"), ("0.5", "v1", "a1"), ("0.5", "v2", "a2"), ("1.0", "v3", "a3")];
    let mut code = format!("{k}x = {}{end}\n{k}y = {}{end}\n", number("q"), number("v"));
    for (i, (part, v, a)) in (1..).zip(stages) {
        code += &format!("{k}v{i} = y + {part} * h * {a}{end}\n");
        code += &format!("{k}a{i} = -(40.0 * (x + {part} * h * {v}) + 0.5 * v{i}) / 2.0{end}\n");
    }
    let [first, middle, last] = if is_good { ["1.0", "2.0", "1.0"] } else { ["6.0", "0.0", "0.0"] };
    let sum = |of: &str| {
        format!("h * ({first} * {of}1 + {middle} * ({of}2 + {of}3) + {last} * {of}4) / 6.0")
    };
    let [dx, dy] = ["v", "a"].map(sum);
    code + &match language {
        "pytest" => format!("    return [x + {dx}], [y + {dy}]"),
        "gtest" => format!("    q[0] = Real(x + {dx});\n    v[0] = Real(y + {dy});"),
        _ => format!("    q[0] = (x + {dx}) as _;\n    v[0] = (y + {dy}) as _;"),
    }
}

/// As much of GoogleTest as the file needs.
const GTEST: &str = "
#include <cstdlib>
#include <iostream>
struct Failure { ~Failure() { std::cerr << std::endl; std::exit(1); } };
template <class T> const Failure& operator<<(const Failure& it, const T& what) { std::cerr << what; return it; }
#define ASSERT_LE(a, b) if ((a) <= (b)) ; else Failure() << \"\"
#define TEST(suite, name) int main()
";

/// Whether the test in this file passes, with its output.
fn passes(folder: &Path, language: &str, text: &str) -> (bool, String) {
    let program = folder.join("program");
    let (name, text) = match language {
        "pytest" => ("test.py", format!("{text}\n\nexpect(step)\n")),
        "gtest" => ("test.cc", text.to_owned()),
        _ => ("test.rs", text.to_owned()),
    };
    let file = folder.join(name);
    fs::write(&file, text).unwrap();
    fs::create_dir_all(folder.join("gtest")).unwrap();
    fs::write(folder.join("gtest/gtest.h"), GTEST).unwrap();
    let mut run = Command::new(&program);
    match language {
        "pytest" => {
            run = Command::new("python3");
            run.arg(&file);
        }
        "gtest" => {
            let mut compiler = Command::new("c++");
            compiler.args(["-std=c++14", "-Wall", "-pedantic", "-Werror", "-I"]).arg(folder);
            compile(compiler.arg(&file).arg("-o").arg(&program));
        }
        _ => compile(rustc().args(["--test", "-Dwarnings"]).arg(&file).arg("-o").arg(&program)),
    }
    let run = run.output().unwrap();
    (run.status.success(), String::from_utf8([run.stdout, run.stderr].concat()).unwrap())
}

fn tells_engines_apart((language, open): Open) {
    let folder = tempfile::tempdir().unwrap();
    for precision in ["", " --float"] {
        let text = stdout_of(&format!("{SPRING} --as {language}{precision}"));
        assert!(text.contains("stiffness_n_per_m = 40") && text.contains(open), "{text}");
        for is_good in [true, false] {
            let filled = text.replace(open, &engine(language, is_good));
            let (passed, said) = passes(folder.path(), language, &filled);
            assert_eq!(passed, is_good, "{language}{precision}: {said}");
            assert!(is_good || said.contains("spring, tick "), "{said}");
        }
    }
}

pub(crate) fn a_good_engine_passes_and_a_bad_one_fails_in_python() {
    tells_engines_apart(PYTHON);
}

pub(crate) fn a_good_engine_passes_and_a_bad_one_fails_in_cpp() {
    tells_engines_apart(CPP);
}

pub(crate) fn a_good_engine_passes_and_a_bad_one_fails_in_rust() {
    tells_engines_apart(RUST);
}

pub(crate) fn a_fixture_in_rust_passes_the_lints() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("fixture.rs");
    for precision in ["", " --float"] {
        // The speeds of a spring of 1 Hz look like constants.
        fs::write(&file, stdout_of(&format!("fixture --scene spring --as rust{precision}")))
            .unwrap();
        let mut lints = Command::new("clippy-driver");
        lints.args(["--edition", "2024", "--test", "-Dwarnings"]).arg(&file);
        compile(lints.arg("-o").arg(folder.path().join("program")));
    }
}

pub(crate) fn a_fixture_has_the_states_of_a_trace_and_the_least_tolerance_of_its_truth() {
    let json = |arguments: &str| -> Value { serde_json::from_str(&stdout_of(arguments)).unwrap() };
    let found = json("fixture --scene spring --every 7 --seconds 1 --as json");
    let states = found["bodies"][0]["states"].as_array().unwrap();
    let trace = stdout_of("trace --scene spring --every 7 --seconds 1");
    let rows: Vec<Vec<&str>> = trace.lines().map(|line| line.split(',').collect()).collect();
    let exact: Vec<_> = rows.iter().filter(|row| row[3] == "exact").collect();
    assert_eq!((states.len(), exact.len()), (9, 9));
    for (state, row) in states.iter().zip(exact) {
        assert_eq!(state[0].to_string(), row[0]);
        for (number, text) in [(&state[1][0], row[6]), (&state[2][0], row[7])] {
            assert_eq!(number.as_f64(), text.parse().ok(), "{row:?}");
        }
    }
    assert_eq!((&found["tick_hz"], &found["least_tolerance"]), (&60.into(), &1e-12.into()));
    // Without a closed form it is as good as the reference is.
    let least = json("fixture --scene kicked-rotor --as json")["least_tolerance"].as_f64();
    assert!(least.is_some_and(|least| (1.1e-12..1e-8).contains(&least)), "{least:?}");
    let why = "no states of cloth: it has no reference solution";
    assert!(refusal("fixture --scene cloth --seconds 0.5 --as json", 1).contains(why));
    assert!(refusal("fixture --scene spring", 2).contains("--as"));
}

pub(crate) fn names_are_escaped_and_a_fixture_without_later_states_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let name = "re\u{301}sort \\ \"2\"";
    let scene = "title = 'A'\nabout = 'a'\ntick_hz = 60\nseconds = 1\nmethods = ['rk4']\n\
        [[spring]]\nmass_kg = 1.0\nstiffness_n_per_m = 1.0\nx0_m = 1.0\nname = ";
    let scene = format!("{scene}{name:?}\n").replace("\\u{301}", "\u{301}");
    fs::write(folder.path().join("named.toml"), scene).unwrap();
    for language in ["pytest", "gtest", "rust"] {
        let arguments = format!("fixture --scene named.toml --as {language}");
        let text = String::from_utf8(run_in(folder.path(), &arguments).stdout).unwrap();
        assert!(text.contains("\"re\u{301}sort \\\\ \\\"2\\\"\""), "{text}");
    }
    let said = refusal("fixture --k 40 --every 100000 --as pytest", 2);
    assert!(said.contains("no state after the start is written"), "{said}");
}
