//! The generated code of rules, compiled and run at any frame rate, against the rules at their own rate.

use std::fmt::Write as _;
use std::fs;
use std::process::Command;

use regatta::tools::source_code::Language;

use crate::compilers::{build_folder, compile, rustc};

#[path = "../library/rules/cases.rs"]
mod cases;

use cases::frames;
pub(crate) use cases::{FPS, FRAMES, LINEAR, START, STEPPED, TARGET, code};

/// The largest difference from the rule, as a part of the largest number of the run.
const ROUNDING: f64 = 1e-12;

/// The steps of the driver, in frames.
pub(crate) const PARTS: [f64; 3] = [1.0, 0.5, 2.0];

/// The driver's call of the function of rule `n` with its memory, and the lines around them in the language.
fn rust() -> String {
    let (mut text, mut calls) = (String::new(), String::new());
    for (n, rule) in LINEAR.iter().chain(&STEPPED).enumerate() {
        let printed = code(rule, Language::Rust).text;
        let memory = printed.contains("memory: &mut");
        let target = if printed.contains("target: f64") { ", TARGET" } else { "" };
        let (made, given) = match memory {
            true => (format!("let mut m = rule{n}::RuleMemory::default();"), "&mut m, "),
            false => (String::new(), ""),
        };
        writeln!(text, "mod rule{n} {{\n{printed}}}").unwrap();
        writeln!(
            calls,
            "{{ {made} let (mut x, mut v) = (START[0], START[1]); for _ in 0..frames {{ \
             (x, v) = rule{n}::rule({given}x, v, h{target}); show(x, v); }} }}"
        )
        .unwrap();
    }
    format!(
        "#![allow(unused_assignments)]\n{text}const START: [f64; 2] = {START:?};\nconst TARGET: f64 = {TARGET:?};\n\
         fn show(x: f64, v: f64) {{ println!(\"{{:016x}} {{:016x}}\", x.to_bits(), v.to_bits()); }}\n\
         fn main() {{ for part in {PARTS:?} {{ let h = part / {FPS:?}; let frames = ({FRAMES} as f64 / part) as usize;\n{calls}}} }}\n"
    )
}

fn c() -> String {
    let (mut text, mut calls) =
        ("#include <stdio.h>\n#include <string.h>\n".to_owned(), String::new());
    for (n, rule) in LINEAR.iter().chain(&STEPPED).enumerate() {
        let printed = code(rule, Language::C).text;
        let target = if printed.contains("double target") { ", TARGET" } else { "" };
        let (made, given) = match printed.contains("rule_memory") {
            true => (format!("rule{n}_memory m = RULE{n}_START;"), "&m, "),
            false => (String::new(), ""),
        };
        let named = printed
            .replace("rule(", &format!("rule{n}("))
            .replace("rule_", &format!("rule{n}_"))
            .replace("RULE_", &format!("RULE{n}_"));
        text.push_str(&named);
        writeln!(
            calls,
            "{{ {made} double x = START[0], v = START[1]; for (int i = 0; i < frames; i++) {{ \
             rule{n}({given}&x, &v, h{target}); show(x, v); }} }}"
        )
        .unwrap();
    }
    let [x, v] = START;
    let [one, half, two] = PARTS;
    format!(
        "{text}static const double START[2] = {{ {x:?}, {v:?} }};\nstatic const double TARGET = {TARGET:?};\n\
         static void show(double x, double v) {{ unsigned long long bits[2]; memcpy(&bits[0], &x, 8); memcpy(&bits[1], &v, 8); \
         printf(\"%016llx %016llx\\n\", bits[0], bits[1]); }}\n\
         int main(void) {{ const double parts[] = {{ {one:?}, {half:?}, {two:?} }}; for (int p = 0; p < 3; p++) {{ \
         const double h = parts[p] / {FPS:?}; const int frames = (int)({FRAMES} / parts[p]);\n{calls}}} return 0; }}\n"
    )
}

fn c_sharp() -> String {
    let (mut text, mut calls) = ("using System;\n".to_owned(), String::new());
    for (n, rule) in LINEAR.iter().chain(&STEPPED).enumerate() {
        let printed = code(rule, Language::CSharp).text;
        let target = if printed.contains("double target") { ", Target" } else { "" };
        let (made, given) = match printed.contains("Memory memory") {
            true => (format!("var m = new Rule{n}.Memory();"), "m, "),
            false => (String::new(), ""),
        };
        let printed = printed.replace("using System;\n", "");
        text.push_str(&printed.replace("class Rule\n", &format!("class Rule{n}\n")));
        writeln!(
            calls,
            "{{ {made} double x = Start[0], v = Start[1]; for (int i = 0; i < frames; i++) {{ \
             Rule{n}.Step({given}ref x, ref v, h{target}); Show(x, v); }} }}"
        )
        .unwrap();
    }
    let [x, v] = START;
    let [one, half, two] = PARTS;
    format!(
        "{text}public static class Driver {{ static readonly double[] Start = {{ {x:?}, {v:?} }}; const double Target = {TARGET:?};\n\
         static void Show(double x, double v) {{ Console.WriteLine(\"{{0:x16}} {{1:x16}}\", BitConverter.DoubleToInt64Bits(x), \
         BitConverter.DoubleToInt64Bits(v)); }}\n\
         public static void Main() {{ foreach (double part in new double[] {{ {one:?}, {half:?}, {two:?} }}) {{ \
         double h = part / {FPS:?}; int frames = (int)({FRAMES} / part);\n{calls}}} }} }}\n"
    )
}

/// Compares the output of a driver with the rules: at every frame, every second half frame and every other frame.
pub(crate) fn hold(driver: &mut Command) {
    let output = driver.output().unwrap();
    assert!(output.status.success(), "{:?}", output.status);
    let text = String::from_utf8(output.stdout).unwrap();
    let number = |word: &str| f64::from_bits(u64::from_str_radix(word, 16).unwrap());
    let mut rows = text.lines().map(|line| {
        let mut words = line.split(' ').map(number);
        [(); 2].map(|()| words.next().unwrap())
    });
    for part in PARTS {
        for (n, rule) in LINEAR.iter().chain(&STEPPED).enumerate() {
            let known = frames(rule);
            let size = known.iter().flatten().fold(1.0_f64, |size, x| size.max(x.abs()));
            let rows: Vec<[f64; 2]> = rows.by_ref().take((FRAMES as f64 / part) as usize).collect();
            for (frame, known) in known.iter().enumerate() {
                let steps = (frame + 1) as f64 / part;
                if steps.fract() != 0.0 {
                    continue;
                }
                let found = rows[steps as usize - 1];
                // The velocity of a chase is not part of its motion.
                for place in (0..2).filter(|place| n < LINEAR.len() || *place == 0) {
                    let off = (found[place] - known[place]).abs();
                    assert!(
                        off <= ROUNDING * size,
                        "{rule} by {part} frames, {frame}: {found:?} {known:?}"
                    );
                }
            }
        }
    }
    assert_eq!(rows.next(), None);
}

pub(crate) fn generated_rust_matches_its_rule_at_every_frame_rate() {
    let folder = build_folder("rules-rust");
    let (source, program) = (folder.join("driver.rs"), folder.join("driver"));
    fs::write(&source, rust()).unwrap();
    compile(rustc().args(["-Dwarnings", "-o"]).arg(&program).arg(&source));
    hold(&mut Command::new(&program));
}

/// Holds what a compiler of this standard makes of the C.
fn hold_c(compiler: &str, file: &str, standard: &str) {
    let folder = build_folder(&format!("rules-{file}"));
    let (source, program) = (folder.join(file), folder.join("driver"));
    fs::write(&source, c()).unwrap();
    let mut compiler = Command::new(compiler);
    compiler.args(["-Wall", "-Wextra", "-pedantic", "-Werror", standard, "-o"]);
    compile(compiler.arg(&program).arg(&source).arg("-lm"));
    hold(&mut Command::new(&program));
}

pub(crate) fn generated_c_matches_its_rule() {
    hold_c("cc", "driver.c", "-std=c99");
}

pub(crate) fn generated_c_of_a_rule_is_valid_cpp() {
    hold_c("c++", "driver.cpp", "-std=c++14");
}

pub(crate) fn generated_c_sharp_matches_its_rule() {
    let folder = build_folder("rules-cs");
    let (source, program) = (folder.join("driver.cs"), folder.join("driver.exe"));
    fs::write(&source, c_sharp()).unwrap();
    let mut compiler = Command::new("mcs");
    compile(compiler.args(["-langversion:3", &format!("-out:{}", program.display())]).arg(&source));
    hold(Command::new("mono").arg(&program));
}
