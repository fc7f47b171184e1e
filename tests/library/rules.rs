//! The generated code of rules, compiled and run at any frame rate, against the rules at their own rate.

use std::fmt::Write as _;
use std::process::Command;
use std::{env, fs};

use regatta::scene::SceneErrors;
use regatta::sim::law::StepText;
use regatta::tools::Rule;
use regatta::tools::rule::{Course, RuleCode};
use regatta::tools::source_code::Language;

use crate::compilers::{build_folder, compiled_or_skip};

/// Linear rules: pairs of eigenvalues, real ones, close and double ones, and those without a rest.
const LINEAR: [&str; 19] = [
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
const STEPPED: [&str; 7] = [
    "v -= v * abs(v) * 0.1; x += v * dt",
    "v += (target - x) * 40 * dt; if v > 1 { v = 1 } else if v < -1 { v = -1 }\nx += v * dt",
    "v -= sign(v) * min(abs(v), 3 * dt); x += v * dt",
    "x += (target - x) * 1.5",
    "v = (target - x) * 5; x += v * dt",
    "memory in = 0.5; in += (target - x) * dt; v += (target - x) * 2 + in * 0.1 - v; x += v * dt",
    "dt = min(dt, 0.01); y = x; if y > 0.5 and not (v < 0) { y = pow(x, 2) + hypot(x, v) }; x += (target - y) * dt",
];

const FPS: f64 = 60.0;
const FRAMES: usize = 48;
const START: [f64; 2] = [0.25, 1.5];
const TARGET: f64 = 2.0;
/// The largest difference from the rule, as a part of the largest number of the run.
const ROUNDING: f64 = 1e-12;

/// x and v after each frame of a rule, from [`START`].
fn frames(rule: &str) -> Vec<[f64; 2]> {
    let text = StepText::read(rule).unwrap();
    let mut registers = text.registers();
    (0..2).for_each(|index| text.set(&mut registers, index, START[index]));
    let step = |_| {
        text.step(&mut registers, 1.0 / FPS, TARGET);
        [0, 1].map(|index| text.value(&registers, index))
    };
    (0..FRAMES).map(step).collect()
}

fn code(rule: &str, language: Language) -> RuleCode {
    Rule::read(rule, FPS).unwrap().code(rule, language).unwrap()
}

/// The steps of the driver, in frames.
const PARTS: [f64; 3] = [1.0, 0.5, 2.0];

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
fn hold(driver: &mut Command) {
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

fn is_near(found: Option<f64>, expected: f64) -> bool {
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

/// Lines as they are pasted, each with the plain lines that it means.
const PASTED: [(&str, &str); 26] = [
    (
        "position = position.lerp(target, 1 - exp(-8 * delta))",
        "x = lerp(x, target, 1 - exp(-8 * dt))",
    ),
    (
        "velocity = move_toward(velocity, 0, 12 * delta); x += velocity * delta",
        "v = clamp(0, v - 12 * dt, v + 12 * dt); x += v * dt",
    ),
    (
        "velocity.x = lerp(velocity.x, 0.0, 0.2); x += velocity.x * delta",
        "v = lerp(v, 0, 0.2); x += v * dt",
    ),
    (
        "let t = 1.0 - (-8.0 * dt).exp(); x += (target - x) * t;",
        "x += (target - x) * (1 - exp(-8 * dt))",
    ),
    ("x = lerp(x, target, 1 - power(0.9, dt * 60))", "x = lerp(x, target, 1 - pow(0.9, dt * 60))"),
    ("x += (target - x) * (1 - 0.9 ** (dt * 60))", "x += (target - x) * (1 - pow(0.9, dt * 60))"),
    (
        "x += (target - x) * (1 - 0.9f32.powf(dt * 60.0))",
        "x += (target - x) * (1 - pow(0.9, dt * 60))",
    ),
    (
        "this.x += (this.targetX - this.x) * (1 - Math.pow(0.001, dt));",
        "x += (target - x) * (1 - pow(0.001, dt))",
    ),
    ("x = FMath::FInterpTo(x, target, DeltaTime, 5.f);", "x += (target - x) * min(5 * dt, 1)"),
    (
        "transform.position = Vector3.Lerp(transform.position, target.position, 5f * Time.deltaTime);",
        "x = lerp(x, target, 5 * dt)",
    ),
    (
        "player.velocity.x *= 0.9; player.position.x += player.velocity.x * time.delta_secs()",
        "v *= 0.9; x += v * dt",
    ),
    (
        "pos.x += (target.x - pos.x) * 0.1; pos.y += (target.y - pos.y) * 0.1",
        "x += (target - x) * 0.1",
    ),
    (
        "local d = target - x\nif d > 1 then\n  x = x + d * 0.1\nelse\n  x = x + d * 0.5\nend",
        "if target - x > 1 { x += (target - x) * 0.1 } else { x += (target - x) * 0.5 }",
    ),
    ("if x > 2 then x = 2 end; x += v * elapsed", "if x > 2 { x = 2 }; x += v * dt"),
    (
        "if (x > 2 && v > 0 || !(x < 9)) { v = -v }; x += v",
        "if x > 2 and v > 0 or not x < 9 { v = -v }; x += v",
    ),
    (
        "v = round(v - 800 * dt); x += v * dt",
        "let w = v - 800 * dt; v = sign(w) * floor(abs(w) + 0.5); x += v * dt",
    ),
    ("x = (x + 5) % 3", "x = fmod(x + 5, 3)"),
    ("x = (x + 5) mod 3", "let y = x + 5; x = y - 3 * floor(y / 3)"),
    ("x = Mathf.Repeat(x - 7, 3)", "let y = x - 7; x = y - 3 * floor(y / 3)"),
    ("x += (target - x) * saturate(20 * dt)", "x += (target - x) * clamp(20 * dt, 0, 1)"),
    ("x += Mathf.Clamp01(v) * smoothstep(0, 1, 0.5)", "x += clamp(v, 0, 1) * 0.5"),
    ("x = Mathf.SmoothStep(x, target, 0.5)", "x = lerp(x, target, 0.5)"),
    (
        "x = Mathf.MoveTowards(x, target, 3 * Time.deltaTime)",
        "x = clamp(target, x - 3 * dt, x + 3 * dt)",
    ),
    ("x = ceil(v) + trunc(-1.5) + step(1, 2)", "x = -floor(-v) + -1 + 1"),
    ("x += min(v, 1, 9)", "x += min(min(v, 1), 9)"),
    ("let power = 0.5; x += (target - x) * power", "x += (target - x) * 0.5"),
];

#[test]
fn pasted_lines_move_as_the_plain_lines_that_they_mean() {
    for (pasted, plain) in PASTED {
        let all = frames(pasted).into_iter().zip(frames(plain));
        for (found, expected) in all {
            let off = [0, 1].map(|n| (found[n] - expected[n]).abs());
            assert!(off.iter().all(|off| *off < 1e-12), "{pasted}: {found:?} for {expected:?}");
        }
    }
    let two = Rule::read(PASTED[11].0, FPS).unwrap();
    assert_eq!((two.left_out(), two.is_linear()), (Some(['x', 'y']), true));
    // Unity's spring, by its own lines.
    let [mut x, mut v] = START;
    let h = 1.0 / FPS;
    for found in frames("x = Mathf.SmoothDamp(x, target, ref v, 0.3f);") {
        let omega = 2.0 / 0.3;
        let k = omega * h;
        let kept = 1.0 / (1.0 + k + 0.48 * k * k + 0.235 * k * k * k);
        let away = x - TARGET;
        let push = (v + omega * away) * h;
        (x, v) = (TARGET + (away + push) * kept, (v - omega * push) * kept);
        assert!((found[0] - x).abs() < 1e-12 && (found[1] - v).abs() < 1e-12, "{found:?}");
    }
}

#[test]
fn a_refusal_points_at_the_part_that_is_meant() {
    for (text, at, what) in [
        ("x = x.spring(target)", 6..12, "unknown function `spring`"),
        ("x = (x + v).length", 12..18, "`length` is one part of a value"),
        ("x = (x + v).norm", 12..16, "`norm` is one part of a value"),
        ("pos.x += vel.y", 9..10, "a line mixes the components x and y of vectors"),
        ("if x > 1 then x = 1", 18..19, "a block is not closed"),
    ] {
        let fault = Rule::read(text, FPS).unwrap_err();
        assert_eq!((fault.span, &*fault.what), (at, what), "{text}");
    }
}

#[test]
fn a_rule_in_pieces_is_told_piece_by_piece() {
    let pieces = |text: &str| Rule::read(text, FPS).unwrap().pieces();
    let both = "if target > x { x += (target - x) * 0.9 } else { x += (target - x) * 0.05 }";
    let found = pieces(both);
    assert_eq!(found.len(), 2);
    assert_eq!(
        (&*found[0].condition, &*found[1].condition),
        ("while target > x", "while target <= x")
    );
    assert!(is_near(found[0].rule.motion_at(60.0).halves_s, 0.005017));
    assert!(is_near(found[1].rule.motion_at(60.0).halves_s, 0.2252));
    assert_eq!(code(both, Language::Rust).steps_because, None);
    let zone = pieces("if abs(target - x) > 2 { x += (target - x) * 0.1 }");
    assert_eq!(zone[0].condition, "beyond 2 of the target");
    assert!(is_near(zone[0].rule.motion_at(60.0).halves_s, 0.1096));
    assert_eq!(zone[1].course(), Some(Course::Stays));
    let text = "v += (target - x) * 0.1\nv *= 0.8\nx += v\nif abs(target - x) < 0.01 { x = target; v = 0 }";
    let snap = pieces(text);
    let seen = snap[0].rule.motion_at(60.0);
    assert_eq!(snap[0].condition, "beyond 0.01 of the target");
    assert!(is_near(seen.hz, 2.864) || is_near(seen.spring.unwrap().frequency_hz(), 2.864));
    assert!(is_near(seen.spring.unwrap().damping_ratio(), 0.372), "{seen:?}");
    assert_eq!(snap[1].course(), Some(Course::Stops));
    assert!(is_near(snap[1].reached_s(&Rule::read(text, FPS).unwrap()), 0.3));
    let toward = pieces("x = move_toward(x, target, 3 * dt)");
    let Some(Course::Moves(speed)) =
        toward.iter().find_map(|piece| piece.course().filter(|it| matches!(it, Course::Moves(_))))
    else {
        panic!("{toward:?}")
    };
    assert!(is_near(Some(speed), 3.0) && toward.len() == 2);
    let wrap = pieces("x += (mod(target - x + pi, 2 * pi) - pi) * 0.1");
    assert!(wrap.len() == 1 && is_near(wrap[0].rule.motion_at(60.0).halves_s, 0.1096), "{wrap:?}");
    assert!(pieces("x += (target - x) * 0.1").is_empty());
    assert!(pieces("v -= v * abs(v) * 0.1; x += v * dt").is_empty());
}

#[test]
fn a_driven_rule_has_its_top_speed_and_its_acceleration_at_every_rate() {
    let rule = |text: &str| Rule::read(text, FPS).unwrap();
    let drag = rule("v += 2000 * dt; v *= 0.92; x += v * dt");
    for (fps, top) in
        [(30.0, 766.667), (60.0, 383.333), (120.0, 191.667), (144.0, 159.722), (240.0, 95.833)]
    {
        let seen = drag.motion_at(fps);
        assert!(is_near(seen.top_speed, top) && seen.jump.is_none(), "{seen:?}");
    }
    let fall = rule("v -= 6; x += v * dt");
    assert!(is_near(fall.jump_speed(), 150.0));
    for (fps, gain, height) in [(30.0, -180.0, 60.0), (60.0, -360.0, 30.0), (144.0, -864.0, 12.5)] {
        let seen = fall.motion_at(fps);
        assert!(is_near(seen.accelerates, gain) && seen.top_speed.is_none(), "{seen:?}");
        assert!(is_near(seen.jump.map(|[height, _]| height), height), "{seen:?}");
    }
    let limited = rule("v = min(v + 10 * dt, 5); x += v * dt").motion_at(60.0);
    assert!(is_near(limited.top_speed, 5.0), "{limited:?}");
    let still = rule("v = (v + (target - x) * 0.2) * 0.85; x += v").motion_at(60.0);
    assert_eq!((still.top_speed, still.accelerates), (None, None));
}

#[test]
fn a_frame_length_has_its_unit_and_a_rule_its_own_end() {
    let phaser = |text: &str| Rule::read(text, FPS).unwrap();
    let slow = phaser("x += (target - x) * 0.006 * delta");
    let (unit, halves) = slow.other_unit().unwrap();
    assert!(unit == "ms" && is_near(Some(halves), 0.1096), "{unit} {halves}");
    let (unit, _) = phaser("x += (target - x) * 0.000005 * delta_time").other_unit().unwrap();
    assert_eq!(unit, "us");
    assert!(is_near(slow.in_units(1e3).motion_at(60.0).halves_s, 0.1096));
    let chase = phaser("x += (target - x) * 0.1");
    assert!(chase.other_unit().is_none());
    let end =
        |within: f64| phaser("x += (target - x) * 0.1").within(within).motion_at(60.0).settles_s;
    assert!(is_near(end(0.02), f64::ln(0.02) / f64::ln(0.9) / 60.0));
    assert_eq!(end(0.01), chase.motion_at(60.0).settles_s);
}

/// Set `RULES` for more lines.
#[test]
fn a_thousand_random_lines_are_answered_or_refused_at_a_place() {
    const PIECES: [&str; 64] = [
        "x",
        "v",
        "target",
        "dt",
        "k",
        " = ",
        " += ",
        " -= ",
        " *= ",
        " - ",
        " + ",
        " * ",
        " / ",
        "(",
        ")",
        ", ",
        "; ",
        "\n",
        "0.5",
        "2",
        "0.1f",
        "let ",
        "float ",
        "memory ",
        "if ",
        "{ ",
        " }",
        " else ",
        " < ",
        " > ",
        "abs(",
        "clamp(",
        "min(",
        "lerp(",
        "round(",
        "mod(",
        "wrap(",
        "move_toward(x, target, 3 * dt)",
        "sign(v)",
        ".exp()",
        ".lerp(",
        ".x",
        "this.",
        "velocity.y",
        " % ",
        " && ",
        "!",
        "**",
        "then ",
        "end ",
        "elseif ",
        "Mathf.",
        "std::",
        "x = Mathf.SmoothDamp(x, target, ref v, 0.3f)",
        "&",
        "->",
        "é",
        "#",
        "x += v * dt; ",
        "v *= 0.9; ",
        "x += (target - x) * 0.1; ",
        "if x > 1 { v = -v }; ",
        "if abs(target - x) < 0.1 { ",
        "x = target }; ",
    ];
    let count = env::var("RULES").ok().and_then(|count| count.parse().ok()).unwrap_or(1000_u32);
    let mut seed = 75_u64;
    println!("seed {seed}");
    let mut next = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as usize
    };
    let mut answered = 0;
    for _ in 0..count {
        let text: String = (0..1 + next() % 14).map(|_| PIECES[next() % PIECES.len()]).collect();
        match Rule::read(&text, FPS) {
            Ok(rule) => {
                answered += 1;
                let _ = (rule.motions(), rule.pieces(), rule.other_unit(), rule.rings_below_fps());
                for language in Language::ALL {
                    let _ = rule.code(&text, language);
                }
            }
            Err(fault) => {
                assert!(text.get(fault.span.clone()).is_some(), "{text}: {fault:?}");
                let said = SceneErrors::of_step("rule", &text, fault).to_string();
                let place: Vec<&str> = said.split(':').take(3).collect();
                let are_numbers =
                    place[1..].iter().all(|part| part.parse::<u32>().is_ok_and(|n| n > 0));
                assert!(place[0] == "rule" && are_numbers, "{text}: {said}");
            }
        }
    }
    assert!(answered > count / 50, "{answered} of {count}");
}
