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
    for from in UI_SPRINGS.iter().filter(|dialect| dialect.is_read()) {
        for _ in 0..20 {
            // Whole milliseconds, and a damping that most can express.
            let period = dice.between(50.0, 2000.0).round() / 1e3;
            let drawn = swings(1.0 / period, dice.between(0.06, 1.5));
            let values = from.port(&drawn, 60.0).values;
            let wish = from.read(&values).unwrap();
            for to in UI_SPRINGS.iter().filter(|dialect| dialect.is_read()) {
                let told = to.read(&to.port(&wish, 60.0).values).unwrap();
                let [a, b] = [wish, told].map(|wish| [wish.frequency_hz, wish.damping_ratio]);
                let is_expressed = apart(&a, &b) < 1e-9;
                let takes_any = to.keys.iter().any(|key| key.name.starts_with("stiff"));
                assert!(is_expressed || !takes_any, "{} from {}: {told:?}", to.id, from.id);
                if is_expressed {
                    pairs += 1;
                    let back = from.port(&told, 60.0).values;
                    let apart = apart(&back, &values);
                    assert!(apart < 1e-12, "{} by {}: {values:?} {back:?}", from.id, to.id);
                }
            }
        }
    }
    assert!(pairs > 2000, "{pairs}");
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
        let told = dialect("per-frame").port(&wish, 60.0).explodes_below_hz.unwrap();
        let by_formula = TAU * hz / (2.0 * ((1.0 + ratio * ratio).sqrt() - ratio));
        assert!((told - by_formula).abs() < 1e-6 * told, "{told} {by_formula}");
        assert!(stepped(wish.joint(), 1.0 / (told - 0.1), 20_000) > 1e6, "{told}");
        assert!(stepped(wish.joint(), 1.0 / (told + 0.1), 20_000) < 1.0, "{told}");
    }
}

#[test]
fn react_spring_is_stable_at_every_frame_rate_or_none() {
    let of = dialect("react-spring");
    for (tension, friction, is_stable) in
        [(170.0, 26.0, true), (3.9e6, 0.1, true), (4.1e6, 0.1, false), (170.0, 2010.0, false)]
    {
        let port = of.port(&of.read(&[1.0, tension, friction]).unwrap(), 60.0);
        assert_eq!(port.is_stable, is_stable, "{tension} {friction}");
        assert_eq!(stepped([tension, friction], 1e-3, 20_000) < 10.0, is_stable);
        assert_eq!(port.explodes_below_hz, None);
    }
    for (fps, steps) in [(60.0, 17), (144.0, 7), (240.0, 5), (100.0, 10), (10.0, 64)] {
        let wish = swings(0.5, 0.02);
        let seen = of.port(&wish, fps).seen.unwrap();
        // An undamped turn later, at most a frame off, it is at its stretch again.
        let frames = (fps / seen.frequency_hz().unwrap()).round();
        let x = stepped(wish.joint(), 1e-3, frames as usize * steps);
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
        ("react-spring", 0.5, PortOutcome::Nearest),
        ("css", 0.2, PortOutcome::Nearest),
        ("css", 0.01, PortOutcome::Unreachable),
        // Newton's method has not come to its end.
        ("motion-duration", 1.0 - 1e-8, PortOutcome::Nearest),
        // It decays, and changes sides at every frame.
        ("per-frame", 4.0, PortOutcome::Nearest),
        ("per-frame", 0.0, PortOutcome::Nearest),
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
        assert!(read.is_err() || dialect(id).read(&[-2.0, -2.0, -2.0]).is_err(), "{id}");
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
