//! Rules as people paste them with the function around them, and values as seven languages write them.

use regatta::sim::law::Remedy;
use regatta::tools::Rule;
use regatta::tools::source_code::Language;

use crate::rules::{FPS, code, frames};

/// A chase that most of the lines below mean.
const CHASE: &str = "x += (target - x) * 5 * dt";

/// Lines as they are pasted, each with the plain lines that it means.
const PASTED: [(&str, &str); 52] = [
    // Functions around the lines.
    ("void Update() { x += (target - x) * 5 * Time.deltaTime; }", CHASE),
    (
        "private float k = 5f;\npublic Transform target;\nprivate void Update()\n{\n    x += (target.x - x) * k * Time.deltaTime;\n}",
        CHASE,
    ),
    (
        "extends Node2D\n@export var k := 5.0\nfunc _process(delta: float) -> void:\n\tposition += (target - position) * k * delta",
        CHASE,
    ),
    (
        "class Ball:\n    def update(self, dt=0.016):\n        self.x += (self.target - self.x) * 5 * dt",
        CHASE,
    ),
    (
        "function love.update(dt)\n  if x < 9 then\n    x = x + (target - x) * 5 * dt\n  end\nend",
        CHASE,
    ),
    ("RunService.Heartbeat:Connect(function(dt)\n  x = x + (target - x) * 5 * dt\nend)", CHASE),
    ("update(time, delta) {\n  this.x += (this.targetX - this.x) * 5 * delta;\n}", CHASE),
    ("function tick(dt) { x += (target - x) * 5 * dt }", CHASE),
    (
        "useFrame((state, delta) => {\n  ref.position.x += (target - ref.position.x) * 5 * delta;\n});",
        CHASE,
    ),
    (
        "fn follow(time: Res<Time>, mut query: Query<&mut Transform>) {\n  for mut transform in &mut query {\n    transform.translation.x += (target - transform.translation.x) * 5.0 * time.delta_secs();\n  }\n}",
        CHASE,
    ),
    (
        "void AActor::Tick(float DeltaTime)\n{\n  Super::Tick(DeltaTime);\n  X += (Target - X) * 5.f * DeltaTime;\n}",
        CHASE,
    ),
    (
        "public override void _Process(double delta) {\n  base._Process(delta);\n  x += (target - x) * 5 * (float)delta;\n}",
        CHASE,
    ),
    ("float a, b;\nvoid Update() { a = 2; b = a + 3; x += (target - x) * b * dt; }", CHASE),
    (
        "var n = 1.0\nfunc _process(dt):\n\tn *= 0.5\n\tx += n * dt",
        "memory n = 1; n *= 0.5; x += n * dt",
    ),
    // Words before and in the lines.
    ("[SerializeField] private float k = 5f; x += (target - x) * k * dt;", CHASE),
    ("@export_range(0, 9) var k = 5\nx += (target - x) * k * dt", CHASE),
    ("if x > 9:\n    pass\nelse:\n    x += (target - x) * 5 * dt", CHASE),
    ("if (x > 1) begin\n  x = 1\nend\nx += v", "if x > 1 { x = 1 } x += v"),
    // The length of a frame, or a number of that name.
    ("h = 5; x += (target - x) * h * dt", CHASE),
    ("var h = 0.1\nx += (target - x) * h", "x += (target - x) * 0.1"),
    ("x += v * h", "x += v * dt"),
    ("h = min(h, 0.01); x += v * h", "x += v * 0.01"),
    // Calls that change a vector.
    ("camera.position.lerp(target, 0.1);", "x += (target - x) * 0.1"),
    (
        "ball.position.addScaledVector(velocity, dt); velocity.multiplyScalar(0.9)",
        "x += v * dt; v *= 0.9",
    ),
    ("position.add(velocity.clone().multiplyScalar(dt))", "x += v * dt"),
    ("transform.translation = transform.translation.lerp(target, 0.1)", "x += (target - x) * 0.1"),
    // Numbers of another type.
    ("x += (float)(target - x) * 5 * (float)dt", CHASE),
    ("x += float(target - x) * static_cast<float>(5) * dt", CHASE),
    ("x += (target - x) as f32 * 5.0 * dt as f64", CHASE),
    ("x += (int)(v * 3 - 9)", "x += trunc(v * 3 - 9)"),
    ("x += -(int)v * 0.5", "x += -trunc(v) * 0.5"),
    ("x += int((target - x) / 0.4) * 0.1", "x += trunc((target - x) / 0.4) * 0.1"),
    ("x += ((target - x) / 0.4 | 0) * 0.1", "x += trunc((target - x) / 0.4) * 0.1"),
    ("x += (target - x) / 0.4 | 0", "x += trunc((target - x) / 0.4)"),
    // Divisions without a remainder, and remarks.
    ("x += (target - x) // 0.4 * 0.1", "x += floor((target - x) / 0.4) * 0.1"),
    ("self.v -= 5 // 2\nself.x += self.v // 3", "v -= 2; x += floor(v / 3)"),
    ("self.x += (target - self.x) * 5 * dt // 60 is best", CHASE),
    ("x += v * dt // drag", "x += v * dt"),
    // Choices.
    (
        "let k = if x > 1.0 { 1.0 } else if x > 0.5 { 3.0 } else { 2.0 }; x += k * dt;",
        "if x > 1 { x += dt } else if x > 0.5 { x += 3*dt } else { x += 2*dt }",
    ),
    // Angles that are wrapped.
    (
        "let a = v * 500; while (a > 180) a -= 360; while (a < -180) a += 360; x = a",
        "x = mod(v * 500 + 180, 360) - 180",
    ),
    ("x += v * 9\nwhile x >= 2*PI:\n\tx -= 2*PI", "x = mod(x + v * 9, 2*pi)"),
    (
        "x = x + v\nwhile x > 3 do\n  x = x - 3\nend",
        "x += v; if x > 3 { x -= 3 * ceil((x - 3) / 3) }",
    ),
    // Remainders of Lua and Python have the sign of the second number.
    (
        "local d = (target - x + 180) % 360 - 180\nx = x + d*0.1",
        "x += (mod(target - x + 180, 360) - 180)*0.1",
    ),
    // A place that is read, changed and written.
    (
        "var pos = transform.position;\npos.x = lerp(pos.x, target.position.x, 5 * dt);\ntransform.position = pos;",
        CHASE,
    ),
    ("local pos = part.Position\npos = pos + (target - pos)*5*dt\npart.Position = pos", CHASE),
    (
        "Vector3 vel = rb.velocity;\nvel.x *= 0.9f;\nrb.velocity = vel;\nx += vel.x;",
        "v *= 0.9; x += v",
    ),
    ("x = Mathf.Lerp(x, target, 70 * Time.deltaTime)", "x = target"),
    ("x = Mathf.Lerp(x, target, 5 * Time.deltaTime)", CHASE),
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
        (
            "void Start() { x = 3; }\nvoid Update() { x += 1; }",
            24..39,
            "`void Update() {` is a second function",
            "leave the lines of one, that of each frame",
        ),
        ("while x < target: x += v", 0..5, "`while` cannot stand in a rule", "angle_difference"),
        ("while x > 3: x += 3", 0..5, "`while` cannot stand in a rule", "wrap(x, -pi, pi)"),
        ("switch (x) { x = 1 }", 0..11, "`switch(…)` is a call", "x += v * dt"),
        ("x += v as str", 10..13, "`str` is no type of a number", "trunc(x)"),
        ("x += v | 1", 7..8, "`|` has no meaning here", "write `or`"),
        ("x = Quaternion.Slerp(x, target, 0.1)", 15..20, "unknown function `slerp`", "lerp_angle"),
        ("x = lerp(x, target, t)", 20..21, "unknown name `t`", "let t = 1"),
        ("move_and_slide()", 0..16, "`move_and_slide(…)` is a call", "x += v * dt"),
        ("enemies.lerp(target, 0.1)", 0..25, "`enemies.lerp(target, 0.1)` is one part", "`x`"),
        ("vel.x += acc.x*dt; x += vel.x", 9..12, "unknown name `acc`", "let acc = 1"),
        ("if time.elapsed() > 1 { x = 1 }", 3..7, "unknown name `time`", "let time = 1"),
        ("x++", 0..3, "`x` is counted", "write `x += 1`"),
        ("x += (target - x) >> 3", 18..20, "`>>` has no meaning here", "floor(x / 2^n)"),
        ("x = ~~(x + v)", 4..6, "`~~` has no meaning here", "trunc(x)"),
        ("v += Vector2(0, 9)*dt; x += v", 5..12, "unknown function `Vector2`", "one component"),
        ("if (keyboard_check(9)) x += v", 4..18, "unknown function `keyboard_check`", "no input"),
        ("if is_down(\"left\"): x += v", 11..12, "`\\\"` cannot be in an expression", "no input"),
        ("x += v; requestAnimationFrame(f)", 8..32, "`requestAnimationFrame(…)`", "remove it"),
        ("for i in range(4): x += v", 0..3, "`for` cannot stand in a step", "while n < 4"),
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
