//! Rules of a frame, with and without a closed form, and the frames that they make.

use regatta::sim::law::StepText;
use regatta::tools::Rule;
use regatta::tools::rule::RuleCode;
use regatta::tools::source_code::Language;

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
