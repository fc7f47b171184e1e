//! Springs of user interfaces: their settings lead back to the motion, and each is stepped like its library does.

use std::f64::consts::TAU;

use regatta::tools::port::{PortOutcome, UI_SPRINGS, UiSpring, Wish};

use crate::dice::Dice;

fn dialect(id: &str) -> &'static UiSpring {
    UiSpring::of_id(id).unwrap()
}

fn swings(frequency_hz: f64, damping_ratio: f64) -> Wish {
    Wish { frequency_hz, damping_ratio, mass_kg: 1.0 }
}

/// The largest relative difference between found and wanted values.
fn apart(found: &[f64], wanted: &[f64]) -> f64 {
    assert!(found.len() == wanted.len() && found.iter().all(|x| x.is_finite()), "{found:?}");
    let parts = found.iter().zip(wanted).map(|(x, y)| (x - y).abs() / y.abs().max(1e-3));
    parts.fold(0.0, f64::max)
}

#[test]
fn a_swift_ui_spring_has_its_published_numbers() {
    let wish = dialect("swiftui").read(&[0.5, 0.3]).unwrap();
    let told = dialect("core-animation").port(&wish, 60.0);
    assert!(apart(&told.values[..3], &[1.0, 157.913_670, 17.592_919]) < 1e-8, "{told:?}");
    // Beyond critical damping its bounce is negative: 1 / (1 − 0.5).
    let wish = dialect("swiftui").read(&[0.5, -0.5]).unwrap();
    assert!(apart(&[wish.frequency_hz, wish.damping_ratio], &[2.0, 2.0]) < 1e-15);
}

#[test]
fn conversion_between_any_two_dialects_round_trips() {
    let mut dice = Dice::new(483);
    let mut pairs = 0;
    // Its library looks for a stiffness to half a per mille only.
    let readable = |dialect: &&UiSpring| dialect.is_read() && dialect.id != "reanimated-duration";
    for from in UI_SPRINGS.iter().filter(readable) {
        for _ in 0..20 {
            // Whole milliseconds, and a damping that most can express.
            let period = dice.between(50.0, 2000.0).round() / 1e3;
            let drawn = swings(1.0 / period, dice.between(0.06, 1.5));
            let port = from.port(&drawn, 60.0);
            let Ok(wish) = from.shown(&port.values, 60.0) else {
                assert_eq!(port.outcome, PortOutcome::Unreachable, "{}", from.id);
                continue;
            };
            let values = from.port(&wish, 60.0).values;
            for to in UI_SPRINGS.iter().filter(readable) {
                let port = to.port(&wish, 60.0);
                if port.outcome != PortOutcome::Reached {
                    continue;
                }
                pairs += 1;
                let told = to.shown(&port.values, 60.0).unwrap();
                let [a, b] = [wish, told].map(|wish| [wish.frequency_hz, wish.damping_ratio]);
                assert!(apart(&a, &b) < 1e-7, "{} from {}: {told:?}", to.id, from.id);
                let back = from.port(&told, 60.0).values;
                let is_exact = from.steps() == "exact" && to.steps() == "exact";
                let apart = apart(&back, &values);
                let most = if is_exact { 1e-11 } else { 1e-5 };
                assert!(apart < most, "{} by {}: {values:?} {back:?}", from.id, to.id);
            }
        }
    }
    assert!(pairs > 9000, "{pairs}");
}

/// The distance left after steps by semi-implicit Euler, or a large number.
fn stepped([stiffness, damping]: [f64; 2], step_s: f64, steps: usize) -> f64 {
    let (mut x, mut v) = (1.0_f64, 0.0);
    for _ in 0..steps {
        v += (-stiffness * x - damping * v) * step_s;
        x += v * step_s;
        if x.abs() > 1e6 {
            break;
        }
    }
    x.abs()
}

#[test]
fn a_per_frame_spring_explodes_below_the_reported_rate() {
    for (hz, ratio) in [(2.0, 0.7), (1.0, 0.05), (5.0, 3.0)] {
        let wish = swings(hz, ratio);
        let of = dialect("per-frame");
        let port = of.port(&wish, 60.0);
        let told = port.explodes_below_hz.unwrap();
        let numbers = of.read(&port.values).unwrap();
        let (hz, ratio) = (numbers.frequency_hz, numbers.damping_ratio);
        let by_formula = TAU * hz / (2.0 * ((1.0 + ratio * ratio).sqrt() - ratio));
        assert!((told - by_formula).abs() < 1e-6 * told, "{told} {by_formula}");
        assert!(stepped(numbers.joint(), 1.0 / (told - 0.1), 20_000) > 1e6, "{told}");
        assert!(stepped(numbers.joint(), 1.0 / (told + 0.1), 20_000) < 1.0, "{told}");
    }
}

#[test]
fn react_spring_is_stable_at_every_frame_rate_or_none() {
    let of = dialect("react-spring");
    for (tension, friction, is_stable) in
        [(170.0, 26.0, true), (3.9e6, 0.1, true), (4.1e6, 0.1, false), (170.0, 2010.0, false)]
    {
        let shown = of.shown(&[1.0, tension, friction], 60.0);
        assert_eq!(shown.is_ok_and(|wish| wish.frequency_hz > 0.0), is_stable, "{tension}");
        assert_eq!(stepped([tension, friction], 1e-3, 20_000) < 10.0, is_stable);
        assert_eq!(of.port(&swings(2.0, 0.5), 60.0).explodes_below_hz, None);
    }
    for (fps, steps) in [(60.0, 17), (144.0, 7), (240.0, 5), (100.0, 10), (10.0, 64)] {
        let wish = swings(0.5, 0.02);
        let port = of.port(&wish, fps);
        let (seen, numbers) = (port.seen.unwrap(), of.read(&port.values).unwrap());
        assert!((seen.undamped_hz() / 0.5 - 1.0).abs() < 1e-7, "{fps}: {seen:?}");
        // An undamped turn later, at most a frame off, it is at its stretch again.
        let frames = (fps / seen.frequency_hz().unwrap()).round();
        let x = stepped(numbers.joint(), 1e-3, frames as usize * steps);
        let decayed = (-seen.decay * frames / fps).exp();
        assert!((x / decayed - 1.0).abs() < 0.02, "{fps}: {x} {decayed}");
    }
}

#[test]
fn css_points_deviate_as_reported_and_hit_both_ends() {
    for (hz, ratio) in [(2.0, 0.7), (1.0, 1.0), (3.0, 2.0), (2.0, 0.2)] {
        let port = dialect("css").port(&swings(hz, ratio), 60.0);
        let [duration, points] = port.values[..] else { panic!("two") };
        let list = port.code.split("linear(").nth(1).unwrap().trim_end_matches(')');
        let list: Vec<f64> = list.split(", ").map(|point| point.parse().unwrap()).collect();
        assert_eq!((list[0], list[list.len() - 1], list.len() as f64), (0.0, 1.0, points));
        // The equation by small steps of the midpoint rule, against the lines.
        let (steps, [k, c]) = (40_000, swings(hz, ratio).joint());
        let step_s = duration / f64::from(steps);
        let (mut x, mut v, mut most) = (-1.0_f64, 0.0_f64, 0.0_f64);
        for step in 0..steps {
            let place = f64::from(step) / f64::from(steps) * (points - 1.0);
            let i = place as usize;
            let line = list[i] + (list[i + 1] - list[i]) * place.fract();
            most = most.max((line - (1.0 + x)).abs());
            let half = [x + v * step_s / 2.0, v - (k * x + c * v) * step_s / 2.0];
            x += half[1] * step_s;
            v -= (k * half[0] + c * half[1]) * step_s;
        }
        let told = port.error.unwrap();
        assert!(most <= told * 1.01 && most > 0.7 * told, "{hz} {ratio}: {most} {told}");
        assert!(told < 0.006 || points == 100.0, "{told}");
    }
    let endless = dialect("css").port(&swings(2.0, 0.0), 60.0);
    assert!(endless.outcome == PortOutcome::Unreachable && endless.code.is_empty(), "{endless:?}");
}

#[test]
fn each_dialect_reports_whether_it_can_show_the_motion() {
    let reach = |id: &str, ratio| dialect(id).port(&swings(2.0, ratio), 60.0).outcome;
    for (id, ratio, wanted) in [
        ("compose", 0.0, PortOutcome::Reached),
        ("flutter-duration", 3.0, PortOutcome::Reached),
        ("slint", 0.5, PortOutcome::Reached),
        ("slint", 3.0, PortOutcome::Nearest),
        ("slint", 0.05, PortOutcome::Unreachable),
        ("motion-duration", 0.01, PortOutcome::Unreachable),
        ("motion-duration", 2.0, PortOutcome::Reached),
        ("motion-duration", 30.0, PortOutcome::Nearest),
        ("core-animation", 2.0, PortOutcome::Reached),
        ("unity-smooth-damp", 0.5, PortOutcome::Unreachable),
        ("unity-smooth-damp", 1.0, PortOutcome::Nearest),
        ("react-spring", 0.5, PortOutcome::Reached),
        ("svelte", 0.5, PortOutcome::Reached),
        ("qt", 1.5, PortOutcome::Reached),
        ("reanimated", 0.5, PortOutcome::Reached),
        ("reanimated", 1.5, PortOutcome::Nearest),
        ("react-native", 1.5, PortOutcome::Nearest),
        ("react-native", 0.0, PortOutcome::Unreachable),
        ("wobble", 1.5, PortOutcome::Reached),
        ("niri", 0.05, PortOutcome::Unreachable),
        ("css", 0.2, PortOutcome::Nearest),
        ("css", 0.01, PortOutcome::Unreachable),
        // Newton's method has not come to its end.
        ("motion-duration", 1.0 - 1e-8, PortOutcome::Nearest),
        ("per-frame", 4.0, PortOutcome::Reached),
        ("per-frame", 0.0, PortOutcome::Reached),
    ] {
        assert_eq!(reach(id, ratio), wanted, "{id} {ratio}");
    }
    // Dialects that never explode, and dialects that are the same at every frame rate.
    for fps in [0.01, 1.0, 24.0, 60.0, 1000.0] {
        let [smooth, exact] = ["unity-smooth-damp", "compose"].map(|id| {
            let port = dialect(id).port(&swings(2.0, 1.0), fps);
            assert!(port.is_stable && port.explodes_below_hz.is_none(), "{id}, {fps} fps");
            port.seen
        });
        assert_eq!(exact.unwrap().damping_ratio(), Some(1.0));
        // Within its rational function's error up to a step of 1 / ω.
        let seen = smooth.map_or(0.0, |seen| seen.undamped_hz());
        assert!(fps < 13.0 || (seen / 2.0 - 1.0).abs() < 0.01, "{fps} fps: {seen}");
    }
    let whole = dialect("flutter-duration").port(&swings(3.0, 0.5), 60.0);
    assert_eq!((whole.outcome, whole.values[0]), (PortOutcome::Nearest, 0.333));
    for UiSpring { id, keys, source, version, evidence, .. } in UI_SPRINGS {
        assert!(!source.is_empty() && keys.len() <= 4, "{id}");
        // Two lines of your own have no version.
        assert_eq!(version.is_empty(), *id == "per-frame", "{id}");
        assert_eq!(version.is_empty(), evidence.is_empty(), "{id}");
        let usual: Vec<f64> = keys.iter().map(|key| key.usual).collect();
        let read = dialect(id).read(&usual);
        assert_eq!(read.is_ok(), dialect(id).is_read(), "{read:?}");
        assert!(read.is_err() || dialect(id).read(&[-1e9; 3]).is_err(), "{id}");
    }
}

#[test]
fn the_slint_line_is_valid_for_its_compiler() {
    // Compiled by slint-ui 1.18.1: a number without an exponent from -1 to 1, and whole milliseconds.
    let (slint, small) = (dialect("slint"), 2.0_f64.powi(-22));
    for (wish, line) in [
        (swings(2.0, 0.7), "animate x { easing: spring(0.3); duration: 500ms; }"),
        (swings(2.0, 9.0), "animate x { easing: spring(-1); duration: 500ms; }"),
        (
            swings(3.0, 1.0 - small),
            "animate x { easing: spring(0.000000238418579); duration: 333ms; }",
        ),
    ] {
        assert_eq!(slint.port(&wish, 60.0).code, line);
    }
    // A duration is cut to whole milliseconds, and 290 of them are no 289.
    for (seconds, cut) in [(0.5004, 0.5), (0.29, 0.29)] {
        assert_eq!(slint.read(&[seconds, 0.3]).unwrap().frequency_hz, 1.0 / cut);
        let flutter = dialect("flutter-duration").read(&[seconds, 0.3]).unwrap();
        assert_eq!(flutter.frequency_hz, 1.0 / cut);
    }
}

#[test]
fn slint_changes_its_damping_after_its_duration() {
    let departure = |ratio| dialect("slint").port(&swings(2.0, ratio), 60.0).departure;
    assert_eq!((departure(0.13), departure(0.5), departure(1.0)), (None, None, None));
    for (ratio, later) in [(0.05, 0.13), (0.0, 0.13), (1.1, 1.0), (2.0, 1.0)] {
        let found = departure(ratio).unwrap();
        assert_eq!((found.at_s, found.damping_ratio), (0.5, Some(later)), "{ratio}");
    }
}

#[test]
fn core_animation_is_critically_damped_unless_it_allows_overdamping() {
    let of = dialect("core-animation");
    let switched = "; spring.allowsOverdamping = true";
    for (ratio, is_on) in [(0.7, false), (1.0, false), (1.4, true), (20.0, true)] {
        let port = of.port(&swings(2.0, ratio), 60.0);
        assert_eq!((port.values[3] == 1.0, port.code.ends_with(switched)), (is_on, is_on));
        assert_eq!(port.outcome, PortOutcome::Reached, "{ratio}");
    }
    let ratio = |allowed| of.read(&[1.0, 100.0, 40.0, allowed]).unwrap().damping_ratio;
    assert_eq!((ratio(0.0), ratio(1.0)), (1.0, 2.0));
}

#[test]
fn motion_has_the_numbers_of_its_generator() {
    // getSpringOptions and the generator of motion-dom 14.14.0.
    let of = dialect("motion-duration");
    for (bounce, stiffness, ratio) in [
        (0.0, 341.023_697_708_471, 1.0),
        (-0.3, 1_205.796_752_825_017_8, 1.428_571_428_571_428_6),
        (-0.6, 4_438.341_221_993_417, 2.5),
    ] {
        let wish = of.read(&[0.5, bounce]).unwrap();
        let found = [wish.joint()[0], wish.damping_ratio];
        assert!(apart(&found, &[stiffness, ratio]) < 1e-12, "{bounce}: {found:?}");
        assert!(apart(&of.port(&wish, 60.0).values, &[0.5, bounce]) < 1e-12);
    }
    assert_eq!(of.read(&[0.5, -1.0]).unwrap().damping_ratio, 20.0);
    // 0.4864 of the way at 0.2 s, and 0.9994 at 0.205 s.
    let cut = |values: &[f64]| {
        let motion = dialect("motion");
        motion.port(&motion.read(values).unwrap(), 60.0).departure
    };
    let found = cut(&[1.0, 10_000.0, 3_000.0]).unwrap();
    assert!(
        (found.at_s - 0.200_446).abs() < 1e-6 && (found.left - 0.512_84).abs() < 1e-4,
        "{found:?}"
    );
    assert_eq!(found.damping_ratio, None);
    // Below 1000 rad/s it is not cut, and of a little damping nothing is left by then.
    assert_eq!((cut(&[1.0, 100.0, 300.0]), cut(&[1.0, 1e6, 4_000.0])), (None, None));
}

#[test]
fn each_library_is_replayed_to_rounding_frame_by_frame_and_ends_where_it_did() {
    let text = std::fs::read_to_string("tests/data/ui-springs/runs.csv").unwrap();
    let mut runs = 0;
    for line in text.lines().filter(|line| !line.starts_with('#')).skip(1) {
        let [id, values, fps, end, frames] = line.split(',').collect::<Vec<_>>()[..] else {
            panic!("{line}");
        };
        let values: Vec<f64> = values.split(' ').map(|value| value.parse().unwrap()).collect();
        let fps: f64 = fps.parse().unwrap();
        let (left, ends) = dialect(id).run(&values, fps).unwrap();
        // The clock of that run was a little slow.
        let most = if id == "wobble" { 1e-6 } else { 1e-12 };
        for frame in frames.split(' ') {
            let (frame, x) = frame.split_once(':').unwrap();
            let (frame, x): (usize, f64) = (frame.parse().unwrap(), x.parse().unwrap());
            // A way of 100 ends later, and so does a higher precision.
            let Some(left) = left.get(frame).filter(|left| **left != 0.0) else {
                assert!(end.is_empty(), "{id} {values:?}, frame {frame}");
                continue;
            };
            let apart = (1.0 - left - x).abs();
            assert!(apart.is_finite() && apart <= most, "{id} {values:?}, {frame}: {apart:e}");
        }
        let at = ends.map(|end| (end.at_s * fps).round() as usize);
        match end.split_once("..") {
            Some((least, most)) => {
                let [least, most]: [usize; 2] = [least, most].map(|frame| frame.parse().unwrap());
                assert!(at.is_some_and(|at| (least..=most).contains(&at)), "{id}: {at:?}");
            }
            None if end.is_empty() => {}
            None => assert_eq!(at, Some(end.parse().unwrap()), "{id} {values:?}"),
        }
        runs += 1;
    }
    assert!(runs >= 35, "{runs}");
}

#[test]
fn react_native_has_the_numbers_of_its_source() {
    // 3.62 (50 - 30) + 194 and 3 (1 - 8) + 25.
    let wish = dialect("react-native").read(&[50.0, 1.0]).unwrap();
    assert!(apart(&wish.joint(), &[266.4, 4.0]) < 1e-12, "{wish:?}");
    // Speed 12 and bounciness 8 are tension 70.91 and friction 8.69 there.
    let wish = dialect("react-native-bounciness").read(&[12.0, 8.0]).unwrap();
    let tension = 12.0 / 34.0 * 199.5 + 0.5;
    let least =
        4.5e-7 * f64::powi(tension, 3) - 3.32e-4 * tension * tension + 0.1078 * tension + 5.84;
    let part: f64 = 8.0 / 1.7 / 20.0 * 0.8;
    let part = 2.0 * part - part * part;
    let friction = part * 0.01 + (1.0 - part) * least;
    let joint = [(tension - 30.0) * 3.62 + 194.0, (friction - 8.0) * 3.0 + 25.0];
    assert!(apart(&wish.joint(), &joint) < 1e-12, "{wish:?} {joint:?}");
    // Above critical damping it takes the critical form.
    let of = dialect("react-native-stiffness");
    let ratio = |damping| of.read(&[1.0, 100.0, damping]).unwrap().damping_ratio;
    assert_eq!((ratio(10.0), ratio(40.0)), (0.5, 1.0));
    assert_eq!(of.as_given(&[1.0, 100.0, 40.0]).unwrap().damping_ratio, 2.0);
}

#[test]
fn a_motion_settles_when_the_closed_form_does() {
    use regatta::tools::port::{SETTLED, settled_s};
    for (wish, wanted) in [
        (swings(4.6401, 1.15), [0.2957, 0.4314, 0.5671]),
        (swings(1.0, 1.0), [1.0565, 1.4695, 1.8711]),
    ] {
        let found = SETTLED.map(|part| settled_s(&wish, part));
        assert!(apart(&found, &wanted) < 3e-4, "{found:?}");
    }
    // A swing is beyond the part just before, and never after.
    let exact = dialect("flutter");
    for ratio in [0.1, 0.3, 0.9] {
        let wish = swings(2.0, ratio);
        let (left, _) = exact.run(&exact.port(&wish, 60.0).values, 2000.0).unwrap();
        let [settled, ..] = SETTLED.map(|part| settled_s(&wish, part) * 2000.0);
        let last = left.iter().rposition(|left| left.abs() > SETTLED[0]).unwrap() as f64;
        assert!(settled >= last && settled <= last + 1.0, "{ratio}: {settled} {last}");
    }
    assert_eq!(settled_s(&swings(1.0, 0.0), 0.01), f64::INFINITY);
}

#[test]
fn each_rule_of_rest_ends_a_motion_near_its_target() {
    for dialect in UI_SPRINGS.iter().filter(|dialect| dialect.has_end()) {
        for ratio in [0.3, 0.7, 1.0, 1.3] {
            let port = dialect.port(&swings(2.0, ratio), 60.0);
            if port.departure.is_some() {
                continue;
            }
            let end = port.ends.unwrap_or_else(|| panic!("{} {ratio}", dialect.id));
            assert!(
                end.left.abs() <= 0.0101 && end.at_s > 0.2 && end.at_s < 4.0,
                "{}: {end:?}",
                dialect.id
            );
        }
        let endless = dialect.port(&swings(2.0, 0.0), 60.0);
        // anime.js gives up after a minute.
        let is_told = endless.outcome == PortOutcome::Unreachable || dialect.id == "anime";
        assert!(endless.ends.is_none() || is_told, "{}: {endless:?}", dialect.id);
    }
    // Motion jumps by 0.43 % of the way here.
    let end = dialect("motion").run(&[1.0, 100.0, 10.0], 60.0).unwrap().1.unwrap();
    assert!((end.left + 0.004_328).abs() < 1e-6 && (end.at_s - 1.083_333).abs() < 1e-5, "{end:?}");
}
