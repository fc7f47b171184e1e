//! Each language's driver, compiled and run, and its states beside those of the table's methods.

use std::process::Command;
use std::{env, fs};

use regatta::lab::{Language, source_code};
use regatta::sim::integrators::METHODS;

use super::drivers;
use super::known::{FORCES, Force, STEPS, steps};
use crate::compilers::{build_folder, compiled_or_skip};

/// The methods whose function does not make the same operations as the method of the table: those that solve
/// equations, for which Newton's iteration is written out for one coordinate, and those that use a power or an
/// exponential, which is not the same in every library. They agree within [`ROUNDING`].
const OTHER_OPERATIONS: [&str; 16] = [
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
];
/// The largest difference of these, relative to the largest coordinate or velocity of the run.
const ROUNDING: f64 = 1e-14;

/// Checks what a driver printed against the methods of the table.
fn same(language: Language, text: &str) {
    let mut lines = text.lines();
    let mut wrong = Vec::new();
    for (k, Force { name, a, .. }) in FORCES.iter().enumerate() {
        for method in METHODS.iter().filter(|method| source_code(method, language).is_ok()) {
            let known = steps(method, *a);
            let size = |part: usize| known.iter().map(|y| y[part].abs()).fold(0.0, f64::max);
            let sizes = [size(0), size(1)];
            let is_exact = !OTHER_OPERATIONS.contains(&method.id);
            let (mut differs, mut worst) = (false, 0.0_f64);
            assert_eq!(known.len(), STEPS as usize);
            for known in &known {
                let line = lines.next().expect("a line for each step");
                let mut words = line.split(' ');
                assert_eq!((words.next(), words.next()), (Some(method.id), Some(&*k.to_string())));
                let bits = words.map(|word| u64::from_str_radix(word, 16).unwrap());
                let found: Vec<f64> = bits.map(f64::from_bits).collect();
                for part in 0..2 {
                    let off = (found[part] - known[part]).abs() / sizes[part];
                    differs |= found[part].to_bits() != known[part].to_bits();
                    worst = if off.is_nan() || off > worst { off } else { worst };
                }
            }
            let is_off = if is_exact { differs } else { worst.is_nan() || worst > ROUNDING };
            if is_off {
                wrong.push(format!("{} in {language} on {name}: {worst:.1e}", method.id));
            }
        }
    }
    assert_eq!(lines.next(), None);
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// What a compiled driver prints.
fn printed(driver: &mut Command) -> String {
    let output = driver.output().unwrap();
    assert!(output.status.success(), "{:?}", output.status);
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn the_rust_functions_do_what_the_methods_do() {
    let folder = build_folder("methods-rust");
    let (source, program) = (folder.join("driver.rs"), folder.join("driver"));
    fs::write(&source, drivers::rust()).unwrap();
    let mut compiler = Command::new(env::var_os("RUSTC").unwrap_or("rustc".into()));
    compiler
        .args(["--edition=2024", "-Dwarnings", "-Copt-level=1", "-o"])
        .arg(&program)
        .arg(&source);
    if compiled_or_skip("the_rust_functions_do_what_the_methods_do", &mut compiler) {
        same(Language::Rust, &printed(&mut Command::new(&program)));
    }
}

#[test]
fn the_c_functions_do_what_the_methods_do() {
    let folder = build_folder("methods-c");
    let (source, program) = (folder.join("driver.c"), folder.join("driver"));
    fs::write(&source, drivers::c()).unwrap();
    let mut compiler = Command::new("cc");
    compiler.args([
        "-std=c99",
        "-O1",
        "-Wall",
        "-Wextra",
        "-Wconversion",
        "-pedantic",
        "-Werror",
        "-o",
    ]);
    compiler.arg(&program).arg(&source).arg("-lm");
    if compiled_or_skip("the_c_functions_do_what_the_methods_do", &mut compiler) {
        same(Language::C, &printed(&mut Command::new(&program)));
    }
}

#[test]
fn the_c_functions_are_cpp_too() {
    let folder = build_folder("methods-cpp");
    let (source, program) = (folder.join("driver.cpp"), folder.join("driver"));
    fs::write(&source, drivers::c()).unwrap();
    let mut compiler = Command::new("c++");
    compiler.args(["-std=c++14", "-O1", "-Wall", "-Wextra", "-pedantic", "-Werror", "-o"]);
    compiler.arg(&program).arg(&source);
    if compiled_or_skip("the_c_functions_are_cpp_too", &mut compiler) {
        same(Language::C, &printed(&mut Command::new(&program)));
    }
}

#[test]
fn the_c_sharp_functions_do_what_the_methods_do() {
    let folder = build_folder("methods-cs");
    let (source, program) = (folder.join("driver.cs"), folder.join("driver.exe"));
    fs::write(&source, drivers::c_sharp()).unwrap();
    let mut compiler = Command::new("mcs");
    compiler.args(["-langversion:3", "-warnaserror", &format!("-out:{}", program.display())]);
    compiler.arg(&source);
    if compiled_or_skip("the_c_sharp_functions_do_what_the_methods_do", &mut compiler) {
        same(Language::CSharp, &printed(Command::new("mono").arg(&program)));
    }
}
