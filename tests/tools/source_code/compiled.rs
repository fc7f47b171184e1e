//! Each language's driver, compiled and run, and its states against the methods of the table.

use std::fs;
use std::process::Command;

use regatta::sim::integrators::{Family, METHODS, Method};
use regatta::tools::source_code::{Language, Precision, source_code};

use super::drivers;
use super::known::{CASES, Case, FORCES, STEPS, steps_as};
use crate::compilers::{build_folder, compile, rustc};

/// The methods whose function does not make the same operations as the method of the table: those that solve
/// equations, for which Newton's iteration is written out for one coordinate, and those that use a power or an
/// exponential, which is not the same in every library. They agree within [`ROUNDING`].
const OTHER_OPERATIONS: [&str; 20] = [
    "bogacki-shampine-32",
    "dormand-prince-54",
    "implicit-euler",
    "implicit-midpoint",
    "newmark",
    "bdf2",
    "gauss-legendre-4",
    "exponential-decay",
    "critically-damped-spring",
    "tr-bdf2",
    "verlet-exact-drag",
    "exponential-rosenbrock-euler",
    "engine-bullet",
    "engine-pybullet",
    "engine-chipmunk",
    "engine-godot",
    "engine-cannon",
    "engine-phaser-arcade",
    "engine-bullet-6dof",
    "engine-newton-xpbd",
];
/// The largest difference of these, relative to the largest coordinate or velocity of the run.
const ROUNDING: f64 = 1e-14;

/// The same in single precision.
const SINGLE_ROUNDING: f64 = 2e-4;
/// That of the methods that choose their substeps, which rounding chooses otherwise: about their tolerance.
const OTHER_SUBSTEPS: f64 = 2e-2;

/// Compares the output of a driver with the methods of the table.
pub(super) fn same(language: Language, precision: Precision, text: &str) {
    let mut lines = text.lines();
    let mut wrong = Vec::new();
    for (k, case) in CASES.iter().enumerate() {
        // Those of a free spin have drivers of their own.
        let here = |method: &&Method| {
            !method.is_for_spin() && source_code(method, language, precision).is_ok()
        };
        for method in METHODS.iter().filter(here) {
            let mut found = Vec::new();
            for _ in 0..STEPS {
                let line = lines.next().expect("a line for each step");
                let mut words = line.split(' ');
                assert_eq!((words.next(), words.next()), (Some(method.id), Some(&*k.to_string())));
                let mut number =
                    || f64::from_bits(u64::from_str_radix(words.next().unwrap(), 16).unwrap());
                found.push([number(), number()]);
            }
            let off = match case.is_paused() {
                true => off_where_paused(method, case, &found),
                false => off_from_table(method, precision, &steps_as(method, method, case), &found),
            };
            if let Some(off) = off {
                let force = FORCES[case.force].text;
                wrong.push(format!("{} in {language} on {force}, case {k}: {off}", method.id));
            }
        }
    }
    assert_eq!(lines.next(), None);
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// How far a run is from that of the table, if that is too far.
fn off_from_table(
    method: &Method,
    precision: Precision,
    known: &[[f64; 2]],
    found: &[[f64; 2]],
) -> Option<String> {
    let allowed = match precision {
        Precision::Single if method.family == Family::Adaptive => OTHER_SUBSTEPS,
        Precision::Single => SINGLE_ROUNDING,
        Precision::Double if OTHER_OPERATIONS.contains(&method.id) => ROUNDING,
        Precision::Double => 0.0,
    };
    let size = |part: usize| known.iter().map(|y| y[part].abs()).fold(0.0, f64::max);
    let mut worst = 0.0_f64;
    for part in 0..2 {
        for (known, found) in known.iter().zip(found) {
            let off = (found[part] - known[part]).abs() / size(part);
            worst = if off.is_nan() || off > worst { off } else { worst };
        }
    }
    let bound = match allowed {
        0.0 => "bits have to be equal; add the terms one by one, in the order of `add_terms`"
            .to_owned(),
        allowed => format!("at most {allowed:e}"),
    };
    (worst.is_nan() || worst > allowed).then(|| format!("differs by {worst:.1e}: {bound}"))
}

/// The fault of a run that starts at rest, or in which some steps take no time.
fn off_where_paused(method: &Method, case: &Case, found: &[[f64; 2]]) -> Option<String> {
    let mut before = case.start;
    for (n, found) in (0..).zip(found) {
        if !found.iter().all(|part| part.is_finite()) {
            return Some(format!("{found:?} at step {n}"));
        }
        // It moves by a part of the way, however long the step is.
        let moves = method.id == "lerp-per-frame";
        if case.length(n) == 0.0 && !moves && (found[0] - before[0]).abs() > 1e-6 {
            return Some(format!("moves from {before:?} to {found:?} in no time"));
        }
        before = *found;
    }
    None
}

/// The output of a compiled driver.
pub(super) fn printed(driver: &mut Command) -> String {
    let output = driver.output().unwrap();
    assert!(output.status.success(), "{:?}", output.status);
    String::from_utf8(output.stdout).unwrap()
}

const PRECISIONS: [(Precision, &str); 2] =
    [(Precision::Double, "double"), (Precision::Single, "single")];

pub(crate) fn generated_rust_matches_the_methods() {
    for (precision, name) in PRECISIONS {
        let folder = build_folder(&format!("methods-rust-{name}"));
        let (source, program) = (folder.join("driver.rs"), folder.join("driver"));
        fs::write(&source, drivers::rust(precision)).unwrap();
        let mut compiler = rustc();
        compile(compiler.args(["-Dwarnings", "-Copt-level=1", "-o"]).arg(&program).arg(&source));
        same(Language::Rust, precision, &printed(&mut Command::new(&program)));
    }
}

/// Compiles the functions in C with these additional arguments, and compares them.
fn compare_c(compiler: &str, file: &str, more: &[&str]) {
    for (precision, name) in PRECISIONS {
        let folder = build_folder(&format!("methods-{file}-{name}"));
        let (source, program) = (folder.join(file), folder.join("driver"));
        fs::write(&source, drivers::c(precision)).unwrap();
        let mut compiler = Command::new(compiler);
        compiler.args(["-O1", "-Wall", "-Wextra", "-pedantic", "-Werror"]).args(more);
        compile(compiler.arg("-o").arg(&program).arg(&source).arg("-lm"));
        same(Language::C, precision, &printed(&mut Command::new(&program)));
    }
}

pub(crate) fn generated_c_matches_the_methods() {
    compare_c("cc", "driver.c", &["-std=c99", "-Wconversion", "-Wdouble-promotion"]);
}

pub(crate) fn generated_c_is_valid_cpp() {
    compare_c("c++", "driver.cpp", &["-std=c++14"]);
}

pub(crate) fn generated_c_sharp_matches_the_methods() {
    for (precision, name) in PRECISIONS {
        let folder = build_folder(&format!("methods-cs-{name}"));
        let (source, program) = (folder.join("driver.cs"), folder.join("driver.exe"));
        fs::write(&source, drivers::c_sharp(precision)).unwrap();
        let mut compiler = Command::new("mcs");
        compiler.args(["-langversion:3", "-warnaserror", &format!("-out:{}", program.display())]);
        compile(compiler.arg(&source));
        same(Language::CSharp, precision, &printed(Command::new("mono").arg(&program)));
    }
}
