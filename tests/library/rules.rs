//! The generated code of rules, compiled and run at any frame rate, against the rules at their own rate.

use std::fmt::Write as _;
use std::process::Command;
use std::{env, fs};

use regatta::sim::law::StepText;
use regatta::tools::Rule;
use regatta::tools::rule::RuleCode;
use regatta::tools::source_code::Language;

use crate::compilers::{build_folder, compiled_or_skip};

/// Linear rules: pairs of eigenvalues, real ones, close and double ones, and those without a rest.
pub(crate) const LINEAR: [&str; 19] = [
    "v = (v + (target - x) * 0.2) * 0.85; x += v",
    "v += ((target - x) * 100 - v * 20) * dt; x += v * dt",
    "v += ((target - x) * 100 - v * 40) * dt; x += v * dt",
    "v *= 0.5; x = x * 0.5 + v",
    "v *= 0.5; x = x * 0.50000001 + v",
    "v = v * 0.5 - x * 1e-9; x = x * 0.5 + v",
    "x += (target - x) * 20 * dt",
    "x = Mathf.Lerp(x, target, 0.1f);",
    "x = x * 0.9 + 1",
    "x = x * 0.8 + target * 0.1 + 0.3",
    "v *= 0.9; x += v * dt",
    "v -= 9.81 * dt; v *= 0.99; x += v * dt",
    "v -= 9.81 * dt; x += v * dt",
    "old = x; x += (x - prev) * 0.98; prev = old",
    "v *= 0.9",
    "x += 3 * dt",
    "let k = 1 - exp(-20 * dt); v = lerp(v, 2, k); x += v * dt - x * 0.01 + target * 0.002",
    "x += (target - x) * 0.1; v += (target - v) * 0.3",
    "x *= 0.9; v *= 0.5",
];
/// Rules that are not, or have no closed form.
pub(crate) const STEPPED: [&str; 7] = [
    "v -= v * abs(v) * 0.1; x += v * dt",
    "v += (target - x) * 40 * dt; if v > 1 { v = 1 } else if v < -1 { v = -1 }\nx += v * dt",
    "v -= sign(v) * min(abs(v), 3 * dt); x += v * dt",
    "x += (target - x) * 1.5",
    "v = (target - x) * 5; x += v * dt",
    "memory in = 0.5; in += (target - x) * dt; v += (target - x) * 2 + in * 0.1 - v; x += v * dt",
    "dt = min(dt, 0.01); y = x; if y > 0.5 and not (v < 0) { y = pow(x, 2) + hypot(x, v) }; x += (target - y) * dt",
];

pub(crate) const FPS: f64 = 60.0;
pub(crate) const FRAMES: usize = 48;
pub(crate) const START: [f64; 2] = [0.25, 1.5];
pub(crate) const TARGET: f64 = 2.0;
/// The largest difference from the rule, as a part of the largest number of the run.
const ROUNDING: f64 = 1e-12;

/// x and v after each frame of a rule, from [`START`].
pub(crate) fn frames(rule: &str) -> Vec<[f64; 2]> {
    let text = StepText::read(rule).unwrap();
    let mut registers = text.registers();
    (0..2).for_each(|index| text.set(&mut registers, index, START[index]));
    let step = |_| {
        text.step(&mut registers, 1.0 / FPS, TARGET);
        [0, 1].map(|index| text.value(&registers, index))
    };
    (0..FRAMES).map(step).collect()
}

pub(crate) fn code(rule: &str, language: Language) -> RuleCode {
    Rule::read(rule, FPS).unwrap().code(rule, language).unwrap()
}

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

#[test]
fn exactly_the_linear_rules_have_a_closed_form() {
    for (rule, is_closed) in
        LINEAR.iter().map(|rule| (rule, true)).chain(STEPPED.iter().map(|rule| (rule, false)))
    {
        let because = code(rule, Language::Rust).steps_because;
        assert_eq!(because.is_none(), is_closed, "{rule}: {because:?}");
    }
}

#[test]
fn a_closed_form_writes_out_no_power_of_its_lines() {
    let power = (0..8).fold("0.99".to_owned(), |power, _| format!("({power}^16)"));
    let rule = format!("let k = {power}; x += (target - x) * 0.1 + 0*k");
    assert_eq!(code(&rule, Language::Rust).steps_because, None);
}

#[test]
fn generated_rust_matches_its_rule_at_every_frame_rate() {
    let folder = build_folder("rules-rust");
    let (source, program) = (folder.join("driver.rs"), folder.join("driver"));
    fs::write(&source, rust()).unwrap();
    let mut compiler = Command::new(env::var_os("RUSTC").unwrap_or("rustc".into()));
    compiler.args(["--edition=2024", "-Dwarnings", "-o"]).arg(&program).arg(&source);
    if compiled_or_skip("generated_rust_matches_its_rule_at_every_frame_rate", &mut compiler) {
        hold(&mut Command::new(&program));
    }
}

#[test]
fn generated_c_matches_its_rule_and_is_valid_cpp() {
    for (compiler, file, standard) in
        [("cc", "driver.c", "-std=c99"), ("c++", "driver.cpp", "-std=c++14")]
    {
        let folder = build_folder(&format!("rules-{file}"));
        let (source, program) = (folder.join(file), folder.join("driver"));
        fs::write(&source, c()).unwrap();
        let mut compiler = Command::new(compiler);
        compiler.args(["-Wall", "-Wextra", "-pedantic", "-Werror", standard, "-o"]);
        compiler.arg(&program).arg(&source).arg("-lm");
        if compiled_or_skip("generated_c_matches_its_rule_and_is_valid_cpp", &mut compiler) {
            hold(&mut Command::new(&program));
        }
    }
}

#[test]
fn generated_c_sharp_matches_its_rule() {
    let folder = build_folder("rules-cs");
    let (source, program) = (folder.join("driver.cs"), folder.join("driver.exe"));
    fs::write(&source, c_sharp()).unwrap();
    let mut compiler = Command::new("mcs");
    compiler.args(["-langversion:3", &format!("-out:{}", program.display())]).arg(&source);
    if compiled_or_skip("generated_c_sharp_matches_its_rule", &mut compiler) {
        hold(Command::new("mono").arg(&program));
    }
}

/// The frequency that is seen, the damping ratio, and the seconds to the last hundredth.
fn seen(rule: &str, fps: f64) -> [Option<f64>; 3] {
    let seen = Rule::read(rule, FPS).unwrap().motion_at(fps);
    [seen.hz, seen.spring.and_then(|spring| spring.damping_ratio()), seen.settles_s]
}

pub(crate) fn is_near(found: Option<f64>, expected: f64) -> bool {
    found.is_some_and(|found| (found / expected - 1.0).abs() < 1e-3)
}

#[test]
fn the_visible_motion_of_a_spring_follows_from_its_eigenvalues() {
    let spring = LINEAR[0];
    let [hz, ratio, settles] = seen(spring, 60.0);
    assert!(is_near(hz, 4.057) && is_near(ratio, 0.1879) && is_near(settles, 0.8893));
    assert!(is_near(seen(spring, 120.0)[0], 2.0 * 4.0568));
    let rule = Rule::read(spring, FPS).unwrap();
    let wish = rule.spring().unwrap();
    assert!(is_near(Some(wish.frequency_hz), 4.130) && is_near(Some(wish.damping_ratio), 0.1879));
    assert_eq!((rule.rings_below_fps(), rule.explodes_below_fps()), (None, None));
    // The frames overshoot as predicted, up to the position of the peak between two frames.
    let overshoot = rule.motion_at(FPS).overshoot.unwrap();
    let text = StepText::read(spring).unwrap();
    let mut registers = text.registers();
    let step = |_| {
        text.step(&mut registers, 1.0 / FPS, 1.0);
        text.value(&registers, 0)
    };
    let farthest = (0..20).map(step).fold(0.0, f64::max);
    assert!((farthest - 1.0 - overshoot).abs() < 0.02, "{farthest} {overshoot}");
    let grows =
        |decay: &str| Rule::read(&spring.replace("0.85", decay), FPS).unwrap().motion_at(FPS);
    assert!(!grows("1.0").grows && grows("1.05").grows);
    assert!(is_near(grows("1.05").spring.unwrap().damping_ratio(), -0.0534));
}

#[test]
fn chases_and_frictions_are_not_read_as_springs() {
    let chase = Rule::read("x += (target - x) * 20 * dt", 30.0).unwrap();
    let at_30 = chase.motion_at(30.0);
    assert!(is_near(at_30.halves_s, 0.02103) && at_30.hz.is_none() && !at_30.grows);
    assert!(is_near(at_30.settles_s, 0.1397));
    assert!(is_near(chase.rings_below_fps(), 20.0) && is_near(chase.explodes_below_fps(), 10.0));
    assert_eq!(
        (chase.motion_at(20.0).settles_s, chase.motion_at(15.0).hz),
        (Some(0.05), Some(7.5))
    );
    assert!(chase.motion_at(9.0).grows && chase.spring().is_none());
    assert!(is_near(chase.approach().map(|approach| approach.half_life_s), 0.02103));
    let friction = Rule::read("v *= 0.9", FPS).unwrap();
    assert!(is_near(friction.motion_at(60.0).halves_s, 0.1096));
    let [after, before] = friction.coasts_s().unwrap()[..] else { panic!() };
    assert!(is_near(Some(after), 0.15) && is_near(Some(before), 0.16667));
    for rule in ["v *= 0.9; x += v * dt", "old = x; x += (x - prev) * 0.9; prev = old"] {
        let friction = Rule::read(rule, FPS).unwrap();
        assert!(friction.spring().is_none() && friction.approach().is_none());
        assert!(is_near(friction.motion_at(60.0).halves_s, 0.1096), "{rule}");
    }
}

#[test]
fn a_nonlinear_rule_is_described_by_its_small_motions_or_not_at_all() {
    let rule = |text: &str| Rule::read(text, FPS).unwrap();
    let limited = rule("v += ((target - x) * 40 - v * 2) * dt; v = clamp(v, -3, 3); x += v * dt");
    let free = rule("v += ((target - x) * 40 - v * 2) * dt; x += v * dt");
    assert!(!limited.is_linear() && free.is_linear());
    assert_eq!(limited.motion_at(60.0), free.motion_at(60.0));
    assert_eq!(limited.explodes_below_fps(), free.explodes_below_fps());
    let dry = rule("v -= sign(v) * 3 * dt; x += v * dt").motion_at(60.0);
    assert_eq!((dry.hz, dry.settles_s, dry.grows), (None, None, false));
    assert!(rule("x += x * abs(x) + 0.1").motion_at(60.0).grows);
}

#[test]
fn growth_starts_below_a_rate_or_occurs_at_every_rate() {
    let of = |lines: &str| {
        let rule = Rule::read(lines, FPS).unwrap();
        (rule.explodes_below_fps(), rule.grows())
    };
    // Semi-implicit Euler holds up to h ω = 2, and explicit Euler with friction up to h = c / k.
    let found = of("v -= 3600 * x * dt; x += v * dt");
    assert!(is_near(found.0, 30.0) && !found.1, "{found:?}");
    let found = of("let ox = x; x += v * dt; v -= (500 * ox + 20 * v) * dt");
    assert!(is_near(found.0, 25.0) && !found.1, "{found:?}");
    for always in [
        "let ox = x; x += v * dt; v -= 30 * ox * dt",
        "let mx = x + v * dt / 2; let mv = v - 30 * x * dt / 2; x += mv * dt; v -= 30 * mx * dt",
    ] {
        assert_eq!(of(always), (None, true), "{always}");
    }
    assert!(!of("v -= 30 * x * dt; x += v * dt").1);
}

#[test]
fn common_names_and_start_values_of_games_are_read() {
    let plain = frames("v += (target - x) * 0.1; x += v");
    for same in [
        "velocity += (goal - position) * 0.1; position += velocity",
        "this.vel += (targetPos - this.pos) * 0.1f; this.pos += this.vel;",
        "float x = 0f; float v = 3f;\nv += (target - x) * 0.1f; x += v;",
    ] {
        assert_eq!(frames(same), plain, "{same}");
    }
    let declared = StepText::read("float x = 2f;\nx += v;").unwrap();
    assert_eq!(declared.value(&declared.registers(), 0), 2.0);
    let own = StepText::read("let speed = 2; x += speed * v").unwrap();
    assert!(own.is_linear() && own.leaves_unchanged(1), "a name of its own beside v");
    let fault = Rule::read("x += v; x = x / 0", FPS).unwrap_err();
    assert_eq!((fault.span, &*fault.what), (11..17, "it divides by 0"));
}
