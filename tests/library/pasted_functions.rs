//! Rules as people paste them with the function around them, and values as seven languages write them.

use regatta::sim::law::Remedy;
use regatta::tools::Rule;
use regatta::tools::source_code::Language;

use crate::rules::{FPS, code, frames};

/// A chase that most of the lines below mean.
const CHASE: &str = "x += (target - x) * 5 * dt";

/// Lines as they are pasted, each with the plain lines that it means.
const PASTED: [(&str, &str); 18] = [
    // The length of a frame, or a number of that name.
    ("h = 5; x += (target - x) * h * dt", CHASE),
    ("var h = 0.1\nx += (target - x) * h", "x += (target - x) * 0.1"),
    ("x += v * h", "x += v * dt"),
    ("h = min(h, 0.01); x += v * h", "x += v * 0.01"),
    // Numbers of another type.
    ("x += (float)(target - x) * 5 * (float)dt", CHASE),
    ("x += float(target - x) * static_cast<float>(5) * dt", CHASE),
    ("x += (target - x) as f32 * 5.0 * dt as f64", CHASE),
    ("x += (int)(v * 3 - 9)", "x += trunc(v * 3 - 9)"),
    ("x += -(int)v * 0.5", "x += -trunc(v) * 0.5"),
    ("x += int((target - x) / 0.4) * 0.1", "x += trunc((target - x) / 0.4) * 0.1"),
    ("x += ((target - x) / 0.4 | 0) * 0.1", "x += trunc((target - x) / 0.4) * 0.1"),
    ("x += (target - x) / 0.4 | 0", "x += trunc((target - x) / 0.4)"),
    // Angles that are wrapped.
    (
        "let a = v * 500; while (a > 180) a -= 360; while (a < -180) a += 360; x = a",
        "x = mod(v * 500 + 180, 360) - 180",
    ),
    ("x += v * 9\nwhile x >= 2*PI:\n\tx -= 2*PI", "x = mod(x + v * 9, 2*pi)"),
    // A coordinate and its target by their names.
    ("zoom = lerp(zoom, target_zoom, 0.1)", "x += (target - x) * 0.1"),
    ("this.scale += (this.targetScale - this.scale) * 0.1", "x += (target - x) * 0.1"),
    ("cam.fov = Mathf.Lerp(cam.fov, fovTarget, 5 * Time.deltaTime)", CHASE),
    ("pos += (posTarget - pos) * 5 * dt", CHASE),
];

#[test]
fn lines_in_a_function_move_as_the_plain_lines_that_they_mean() {
    for (pasted, plain) in PASTED {
        for (found, expected) in frames(pasted).into_iter().zip(frames(plain)) {
            let off = [0, 1].map(|n| (found[n] - expected[n]).abs());
            assert!(off.iter().all(|off| *off < 1e-9), "{pasted}: {found:?} for {expected:?}");
        }
    }
}

#[test]
fn what_a_function_cannot_say_is_refused_with_its_remedy() {
    for (text, at, what, remedy) in [
        ("while x < target: x += v", 0..5, "`while` cannot stand in a rule", "angle_difference"),
        ("while x > 3: x += 3", 0..5, "`while` cannot stand in a rule", "wrap(x, -pi, pi)"),
        ("x += v as str", 10..13, "`str` is no type of a number", "trunc(x)"),
        ("x += v | 1", 7..8, "`|` has no meaning here", "write `or`"),
        ("x = Quaternion.Slerp(x, target, 0.1)", 15..20, "unknown function `slerp`", "lerp_angle"),
        ("x = lerp(x, target, t)", 20..21, "unknown name `t`", "let t = 1"),
    ] {
        let fault = Rule::read(text, FPS).unwrap_err();
        let Remedy::Words(words) = &fault.remedy else { panic!("{text}: {fault:?}") };
        assert_eq!(fault.span, at, "{text}: {fault:?}");
        assert!(fault.what.starts_with(what) && words.contains(remedy), "{text}: {fault:?}");
    }
}

#[test]
fn an_own_number_called_h_has_a_name_of_its_own_in_printed_code() {
    let own = code("h = 5; if x < 3 { x += h * dt }", Language::C).text;
    assert!(own.contains("own_h = 5") && own.contains("own_h * "), "{own}");
}
