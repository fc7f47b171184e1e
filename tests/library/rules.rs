//! How rules of a frame are read: their closed forms, and the motion that is seen.

use regatta::sim::law::StepText;
use regatta::tools::Rule;
use regatta::tools::source_code::Language;

mod cases;

pub(crate) use cases::{FPS, START, TARGET, code, frames};
use cases::{LINEAR, STEPPED};

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
