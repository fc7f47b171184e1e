//! Rules as people paste them: their words, pieces, drives and units.

use std::env;

use regatta::scene::SceneErrors;
use regatta::sim::law::Remedy;
use regatta::tools::Rule;
use regatta::tools::rule::Course;
use regatta::tools::source_code::Language;

use crate::rules::{FPS, START, TARGET, code, frames, is_near};

/// Lines as they are pasted, each with the plain lines that it means.
const PASTED: [(&str, &str); 59] = [
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
    (
        "x = Mathf.SmoothDamp(x, target, ref v, 0.3f, Mathf.Infinity, Time.deltaTime);",
        "x = smoothDamp(x, target, v, 0.3)",
    ),
    (
        "x = Mathf.SmoothDamp(x, target, ref v, 0.3f, 2f, Time.deltaTime);",
        "let near = x - clamp(x - target, -0.6, 0.6); x = smoothDamp(x, near, v, 0.3)",
    ),
    (
        "velocity = velocity.move_toward(Vector2.ZERO, 12 * delta); x += velocity * delta",
        "v = clamp(0, v - 12 * dt, v + 12 * dt); x += v * dt",
    ),
    ("v = min(v + 10 * dt, math.huge); x += v * dt", "v += 10 * dt; x += v * dt"),
    ("v = v.clamp(-f32::INFINITY, float.PositiveInfinity) + Vector3.zero; x += v", "x += v"),
    ("let power = 0.5; x += (target - x) * power", "x += (target - x) * 0.5"),
    ("camera.x += (player.x - camera.x) * 0.1", "x += (target - x) * 0.1"),
    ("this.x += (mouse.x - this.x) * 0.1", "x += (target - x) * 0.1"),
    (
        "transform.position = Vector3.Lerp(transform.position, player.transform.position, 0.1f)",
        "x += (target - x) * 0.1",
    ),
    ("vx += 2000*dt; vx *= 0.92; x += vx*dt", "v += 2000 * dt; v *= 0.92; x += v * dt"),
    ("-- follow the player\nx = x + (target - x) * 5 * dt -- smooth", "x += (target - x) * 5 * dt"),
    ("x += target > x ? 3 * dt : -3 * dt", "if target > x { x += 3 * dt } else { x -= 3 * dt }"),
    ("x += (3 if target > x else -3) * dt", "if target > x { x += 3 * dt } else { x -= 3 * dt }"),
    (
        "local k = target > x and 3 or x > 9 and 2 or -3\nx = x + k * dt",
        "if target > x { x += 3 * dt } else { x -= 3 * dt }",
    ),
    (
        "if x < 0.3:\n\tx += 3 * dt\nelif x > 2:\n\tx = 2\nelse:\n\tv *= 0.9\n\tif v < 0.3: v = 0.3\nx += v * dt",
        "if x < 0.3 { x += 3 * dt } else if x > 2 { x = 2 } else { v *= 0.9; if v < 0.3 { v = 0.3 } }; x += v * dt",
    ),
    (
        "if (x < 0.3) x += 3 * dt;\nelse if (v > 0.3) v *= 0.9;\nelse v = 0.4;\nx += v * dt;",
        "if x < 0.3 { x += 3 * dt } else if v > 0.3 { v *= 0.9 } else { v = 0.4 }; x += v * dt",
    ),
    (
        "const k = 5, min = 0.5; let step = Math.min(k * dt, min); x += (target - x) * step",
        "x += (target - x) * 5 * dt",
    ),
    ("local a, b = 1, 2\nx = x + (target - x) * a / b * dt", "x += (target - x) * dt / 2"),
    ("part.Position = part.Position:Lerp(target.Position, 0.1)", "x += (target - x) * 0.1"),
    (
        "global_position = global_position.lerp(player.global_position, 5 * delta)",
        "x += (target - x) * 5 * dt",
    ),
    (
        "rotation += angle_difference(rotation, target.rotation) * 0.1",
        "x += (mod(target - x + pi, 2 * pi) - pi) * 0.1",
    ),
    ("rotation = rotate_toward(rotation, 3.5 * pi, delta)", "x -= dt"),
    ("vy += 9 * dt; y += vy * dt", "v += 9 * dt; x += v * dt"),
    ("cam.y = Phaser.Math.Linear(cam.y, player.y, 0.1)", "x += (target - x) * 0.1"),
    (
        "if (this.y > 5) { this.y = 5; this.vy = 0 }\nthis.x += this.vx * dt; this.y += this.vy * dt",
        "x += v * dt",
    ),
    (
        "self.v += 1\nif self.v > 3:\n    self.v = 3\nself.x += self.v",
        "v += 1; if v > 3 { v = 3 } x += v",
    ),
    ("if self.v > 3: self.v = 3\nthis.v *= 0.9\nx += v", "if v > 3 { v = 3 } v *= 0.9; x += v"),
    (
        "if x > 3:\n    x = 3\nelse:\n    self.x += self.v\nself.v += 0.5",
        "if x > 3 { x = 3 } else { x += v } v += 0.5",
    ),
    (
        "const delta = target - x; v += delta*100*dt - v*10*dt; x += v*dt",
        "v += (target - x)*100*dt - v*10*dt; x += v*dt",
    ),
    ("float speed = 5f;\nx += (target - x) * speed * dt", "x += (target - x) * 5 * dt"),
    ("const goal = 5; x += (goal - x) * 0.1", "x += (5 - x) * 0.1"),
    ("entity.dy = entity.dy + 6\nentity.y = entity.y + entity.dy * dt", "v += 6; x += v * dt"),
    ("dx = mouseX - x; x += dx * 0.1", "x += (target - x) * 0.1"),
    ("if x ~= target then x += sin(PI / 6) end", "if x != target { x += 0.5 }"),
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
    // A limit at infinity is none.
    for free in [PASTED[25].0, PASTED[28].0, PASTED[29].0] {
        assert!(Rule::read(free, FPS).unwrap().is_linear(), "{free}");
    }
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
        (
            "if this.y > 5 { this.x = 1 }; this.x += v",
            8..9,
            "a line mixes the components x and y of vectors",
        ),
        ("x = Infinity", 4..12, "`Infinity` is no limit here"),
        ("x = move_toward(x, target, INF)", 27..30, "`INF` is no limit here"),
    ] {
        let fault = Rule::read(text, FPS).unwrap_err();
        assert_eq!((fault.span, &*fault.what), (at, what), "{text}");
    }
    let Remedy::Name { mut known, .. } = Rule::read("x = sm(x)", FPS).unwrap_err().remedy else {
        panic!("names")
    };
    let all = known.len();
    known.sort();
    known.dedup();
    assert_eq!(known.len(), all, "each function once");
    assert!(!known.iter().any(|name| ["angle_to", "damped"].contains(&&**name)), "{known:?}");
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
    assert!(is_near(Some(seen.spring.unwrap().undamped_hz()), 2.864), "{seen:?}");
    assert!(is_near(seen.spring.unwrap().damping_ratio(), 0.372), "{seen:?}");
    assert_eq!(snap[1].course(), Some(Course::Stops));
    assert!(is_near(snap[1].reached_s(&Rule::read(text, FPS).unwrap()), 0.3));
    let friction = "v = move_toward(v, 0, 5 * dt); x += v * dt";
    let (stops, whole) = (&pieces(friction)[1], Rule::read(friction, FPS).unwrap());
    assert!(stops.coasts() && !snap[1].coasts() && stops.course() == Some(Course::Stops));
    assert!((0.199..0.217).contains(&stops.reached_s(&whole).unwrap()));
    let toward = pieces("x = move_toward(x, target, 3 * dt)");
    let Some(Course::Moves(speed)) =
        toward.iter().find_map(|piece| piece.course().filter(|it| matches!(it, Course::Moves(_))))
    else {
        panic!("{toward:?}")
    };
    assert!(is_near(Some(speed), 3.0) && toward.len() == 2);
    let wrap = pieces("x += (mod(target - x + pi, 2 * pi) - pi) * 0.1");
    assert!(wrap.len() == 1 && is_near(wrap[0].rule.motion_at(60.0).halves_s, 0.1096), "{wrap:?}");
    let floored = pieces("x = floor(x + (target - x) * 0.5)");
    assert_eq!(floored[0].condition, "between two steps of `floor(x + (target - x) * 0.5)`");
    let slows = pieces("v = max(v - 5 * dt, 0); x += v * dt");
    assert_eq!(slows[0].condition, "within the limits of `max(v - 5 * dt, 0)`");
    assert_eq!(slows[1].condition, "at a limit of `max(v - 5 * dt, 0)`");
    let bracketed = pieces("if ((x > 1) && (x < 9)) x *= 0.5");
    let labels: Vec<&str> = bracketed.iter().map(|piece| &*piece.condition).collect();
    assert_eq!(labels, ["while x > 1 and x < 9", "elsewhere"]);
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

/// The condition of each piece, its acceleration and its top speed at 30, 60 and 240 Hz, and its course.
type Driven = (&'static str, Option<f64>, Option<f64>, Option<Course>);

#[test]
fn each_piece_of_a_drive_has_its_own_acceleration_and_speed() {
    const CASES: [(&str, [Driven; 2]); 7] = [
        (
            "if x > 0 { v -= 9*dt } else { v += 9*dt }; x += v*dt",
            [("while x > 0", Some(-9.0), None, None), ("while x <= 0", Some(9.0), None, None)],
        ),
        (
            "if x < 0 { v += 9*dt }; x += v*dt",
            [("while x < 0", Some(9.0), None, None), ("while x >= 0", None, None, None)],
        ),
        (
            "v -= sign(x)*9*dt; x += v*dt",
            [("while x > 0", Some(-9.0), None, None), ("while x < 0", Some(9.0), None, None)],
        ),
        (
            "v += 900*dt; v = clamp(v, -200, 200); x += v*dt",
            [
                ("within the limits of `clamp(v, -200, 200)`", Some(900.0), None, None),
                (
                    "beyond the limits of `clamp(v, -200, 200)`",
                    None,
                    Some(200.0),
                    Some(Course::Moves(200.0)),
                ),
            ],
        ),
        (
            "v = move_toward(v, 300, 900*dt); x += v*dt",
            [
                ("beyond the limits of `move_toward(v, 300, 900*dt)`", Some(900.0), None, None),
                (
                    "within the limits of `move_toward(v, 300, 900*dt)`",
                    None,
                    Some(300.0),
                    Some(Course::Moves(300.0)),
                ),
            ],
        ),
        (
            "v = move_toward(v, 300, 900*dt)",
            [
                ("beyond the limits of `move_toward(v, 300, 900*dt)`", Some(900.0), None, None),
                (
                    "within the limits of `move_toward(v, 300, 900*dt)`",
                    None,
                    Some(300.0),
                    Some(Course::Moves(300.0)),
                ),
            ],
        ),
        (
            "v = move_toward(v, target, 900*dt); x += v*dt",
            [
                ("beyond the limits of `move_toward(v, target, 900*dt)`", Some(900.0), None, None),
                (
                    "within the limits of `move_toward(v, target, 900*dt)`",
                    None,
                    None,
                    Some(Course::ByTarget),
                ),
            ],
        ),
    ];
    for (text, wanted) in CASES {
        let rule = Rule::read(text, FPS).unwrap();
        let pieces = rule.pieces();
        assert_eq!(pieces.len(), 2, "{text}");
        for (condition, gain, top, course) in wanted {
            let piece = pieces.iter().find(|piece| piece.condition == condition);
            let piece = piece.unwrap_or_else(|| panic!("{condition}: {pieces:?}"));
            let is = |found: Option<f64>, wanted: Option<f64>| match wanted {
                Some(wanted) => is_near(found.map(f64::abs), wanted.abs()),
                None => found.is_none(),
            };
            for seen in [30.0, 60.0, 240.0].map(|fps| piece.rule.motion_at(fps)) {
                assert!(is(seen.accelerates, gain) && is(seen.top_speed, top), "{text}: {seen:?}");
            }
            match (piece.course(), course) {
                (Some(Course::Moves(found)), Some(Course::Moves(speed))) => {
                    assert!(is_near(Some(found), speed), "{text}: {found}");
                }
                (found, course) => assert_eq!(found, course, "{text}"),
            }
        }
    }
    for (text, top) in [(CASES[3].0, 200.0), (CASES[4].0, 300.0)] {
        for seen in Rule::read(text, FPS).unwrap().motions() {
            let Some(gain) = seen.accelerates else { panic!("{text}: {seen:?}") };
            assert!(is_near(seen.top_speed, top) && is_near(Some(gain), 900.0), "{text}: {seen:?}");
        }
    }
}

#[test]
fn a_jump_that_ends_on_a_frame_lasts_no_frame_longer() {
    for (text, frames) in [
        ("v -= 6; x += v * dt", [49.0, 49.0]),
        ("x += v * dt - 4.905 * dt * dt; v -= 9.81 * dt", [25.0, 50.0]),
    ] {
        for (fps, frames) in [30.0, 60.0].into_iter().zip(frames) {
            let seen = Rule::read(text, FPS).unwrap().motion_at(fps);
            assert_eq!(seen.jump.map(|[_, seconds]| seconds), Some(frames / fps), "{text}: {fps}");
        }
    }
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
    const PIECES: [&str; 77] = [
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
        "while x > 2: x -= 3\n",
        "while x",
        "(float)",
        " as f32",
        " | 0",
        " // 2",
        "void Update() {",
        "function f(dt) ",
        "def f(self):\n\t",
        "=> {",
        "pass",
        "@export(",
        "[Range",
    ];
    const LINES: [&str; 9] = [
        "x += v * dt; ",
        "v *= 0.9; ",
        "x += (target - x) * 0.1; ",
        "if x > 1 { v = -v }; ",
        "x = Mathf.SmoothDamp(x, target, ref v, 0.3f); ",
        "v = round(v - 800 * dt); ",
        "x = move_toward(x, target, 3 * dt); ",
        "if abs(target - x) < 0.1 { x = target }; ",
        "x = wrap(x, -1, 1); ",
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
        let mut some = |pieces: &[&str], most: usize| -> String {
            (0..next() % (most + 1)).map(|_| pieces[next() % pieces.len()]).collect()
        };
        // Half of the lines are whole ones, with a piece too many at most.
        let text = match some(&["+"], 1).is_empty() {
            true => some(&PIECES, 14),
            false => some(&LINES, 3) + &some(&PIECES, 1) + &some(&LINES, 2),
        };
        match Rule::read(&text, FPS) {
            Ok(rule) => {
                answered += 1;
                let _ = (rule.motions(), rule.pieces(), rule.other_unit(), rule.rings_below_fps());
                let language = Language::ALL[answered as usize % Language::ALL.len()];
                let _ = rule.code(&text, language);
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
    assert!(answered > count / 10, "{answered} of {count}");
}

#[test]
fn a_choice_is_one_operand_in_languages_without_compound_signs() {
    let lines = "v *= v > 5 ? 0.5 : 0.9; x += v";
    let code = Rule::read(lines, FPS).unwrap().code(lines, Language::Lua).unwrap();
    assert!(code.text.contains("v = v * ((v > 5.0) and 0.5 or 0.9)"), "{}", code.text);
}
