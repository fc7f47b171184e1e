//! `port`: a wish, an engine's settings or a log in; every engine's settings out.

use serde_json::Value;

use super::{run, stderr, stdout_of};

fn json(arguments: &str) -> Value {
    serde_json::from_str(&stdout_of(&format!("port {arguments} --format json"))).unwrap()
}

fn rows(found: &Value, key: &str) -> Vec<Value> {
    found[key].as_array().unwrap_or_else(|| panic!("{key}: {found}")).clone()
}

#[test]
fn a_target_has_settings_code_and_version_for_every_engine_mode() {
    let found = json("--frequency 2.5Hz --damping-ratio 0.3 --mass 80");
    assert_eq!(found["want"]["frequency_hz"], 2.5);
    assert_eq!((&found["want"]["mass_kg"], &found["tick_hz"]), (&80.0.into(), &60.0.into()));
    let engines = rows(&found, "engines");
    let modes: Vec<&str> = engines.iter().map(|row| row["mode"].as_str().unwrap()).collect();
    for mode in
        ["acceleration-based", "spring-damper", "stiffness-and-damping", "unity", "actuator"]
    {
        assert!(modes.contains(&mode), "{modes:?}");
    }
    for row in &engines {
        let text = row["code"].as_str().unwrap();
        let settings = row["settings"].as_object().unwrap();
        assert_eq!(settings.len(), 2, "{row}");
        for value in settings.values() {
            let digits = format!("{:.5e}", value.as_f64().unwrap());
            let written = text.split(|c: char| !(c.is_ascii_digit() || "-.e".contains(c)));
            let mut numbers = written.filter_map(|word| word.parse::<f64>().ok());
            assert!(numbers.any(|number| format!("{:.5e}", number.abs()) == digits), "{row}");
        }
        let reached = row["word"] == "reached";
        let near = |key: &str, wanted: f64| {
            (row["sees"][key].as_f64().unwrap() / wanted - 1.0).abs() < 1e-7
        };
        let is_near = near("frequency_hz", 2.5) && near("damping_ratio", 0.3);
        // The ratio of Bullet's older spring is a mean, as it is no linear map.
        let is_linear = row["method"] != "engine-bullet-6dof";
        assert_eq!(reached, is_near && is_linear, "{row}");
    }
    let box2d = &engines[0];
    assert_eq!((&box2d["method"], &box2d["substeps"]), (&"engine-box2d".into(), &4.into()));
    assert!((box2d["settings"]["hertz"].as_f64().unwrap() - 2.518_990).abs() < 1e-5, "{box2d}");
    assert!((box2d["floor"]["damping_ratio"].as_f64().unwrap() - 0.0653).abs() < 1e-3, "{box2d}");
    assert_eq!(
        (&box2d["version"], &box2d["logged"]),
        (&"3.x main 617d32a".into(), &"2026-11-21".into())
    );
}

#[test]
fn a_wish_is_also_code_of_your_own_in_every_language() {
    for (wish, part) in [
        ("--frequency 2 --damping-ratio 0.3 --to per-frame", "takes target"),
        ("--from swiftui:duration=0.5,bounce=0.3 --to css", "takes target"),
        ("--from lerp:0.1@60fps", "x = target + (x - target) * exp("),
        ("--from friction:0.9@60fps", "v *= exp((-6.32"),
    ] {
        assert!(stdout_of(&format!("port {wish} --as step")).contains(part), "{wish}");
        for (language, head) in [
            ("rust", "pub fn rule("),
            ("cpp", "void rule("),
            ("csharp", "public static void Step("),
            ("gdscript", "static func rule("),
            ("javascript", "function rule("),
            ("lua", "local function rule("),
        ] {
            let text = stdout_of(&format!("port {wish} --as {language}"));
            assert!(text.contains(head), "{wish}: {text}");
        }
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("own.step");
    let text = stdout_of("port --frequency 2 --damping-ratio 0.3 --to per-frame --as step");
    std::fs::write(&path, &text[text.find("# This rule").unwrap()..]).unwrap();
    let seen = stdout_of(&format!("rule {} --fps 60", path.display()));
    assert!(seen.contains("it is a spring of 2.000 Hz, damping ratio 0.3000"), "{seen}");
    let refused = run("port --frequency 2 --ends --as lua");
    assert_eq!(refused.status.code(), Some(2), "{}", stderr(&refused));
}

#[test]
fn substeps_are_explained_for_engines_without_their_own() {
    let text = stdout_of(
        "port --frequency 2Hz --damping-ratio 0.2 --substeps 4 --to engine-chipmunk,engine-godot,engine-physx,engine-jolt",
    );
    for (said, times) in [
        (
            "    for (int i = 0; i < 4; i++) cpSpaceStep(space, dt / 4); // step 4 times with dt / 4\n",
            1,
        ),
        (
            "    Engine.physics_ticks_per_second = 240 # step 4 times with dt / 4: Godot has no substeps",
            1,
        ),
        ("    // 4 position iterations\n", 3),
        ("  held against version 5.1.3 on 2026-11-21\n", 3),
        ("  read from version 4.x, held against no log\n", 1),
    ] {
        assert_eq!(text.matches(said).count(), times, "{said}: {text}");
    }
    let text =
        stdout_of("port --frequency 2Hz --damping-ratio 0.2 --to engine-chipmunk,engine-godot");
    assert!(!text.contains("dt / "), "{text}");
}

#[test]
fn each_name_of_a_card_has_its_own_version() {
    for (id, version) in [
        ("engine-drake", "4.0.0"),
        ("engine-newton-mujoco", "4.0.0"),
        ("engine-newton-vbd", "4.0.0"),
        ("engine-newton-kamino", "4.0.0"),
        ("engine-crashcat", "5.5.1"),
        ("engine-phaser-box2d", "617d32a"),
        ("engine-planck", "2.4"),
        ("engine-p2", "0.20.0"),
    ] {
        let other = format!("port --frequency 1 --damping-ratio 0.2 --to {id}");
        let row = rows(&json(&other["port ".len()..]), "engines").remove(0);
        let own = row["version"].as_str().unwrap();
        assert!(row["method"] == id && !own.contains(version), "{row}");
        let text = stdout_of(&other);
        let held = match row["logged"].as_str() {
            Some(day) => format!("held against version {own} on {day}"),
            None => format!("read from version {own}, held against no log"),
        };
        assert!(text.contains(&held) && !text.contains(&format!("version {version}")), "{text}");
    }
    let version =
        |id| rows(&json(&format!("--frequency 1 --to {id}")), "engines")[0]["version"].clone();
    let ids = ["engine-drake", "engine-newton-vbd", "engine-crashcat"];
    assert_eq!(ids.map(version), ["1.51.1", "1.8.0", "0.0.5"]);
}

#[test]
fn physx_5_6_tgs_reproduces_its_measured_motion() {
    // In PhysX 5.6.1 the settings of 5.1's card swing at 1.9978 Hz with a damping ratio of 0.1595.
    let from = "engine-physx-tgs-56:mode=force-drive,stiffness=158.851359,damping=3.37567442";
    let found = json(&format!("--from {from} --to engine-physx-tgs-56"));
    let want = |key: &str| found["want"][key].as_f64().unwrap();
    assert!((want("frequency_hz") - 1.9978).abs() < 1e-4, "{found}");
    assert!((want("damping_ratio") - 0.1595).abs() < 1e-4, "{found}");
}

#[test]
fn a_damping_of_0_or_none_is_read_and_written_as_its_engine_takes_it() {
    let want = |from: &str| json(&format!("--from {from} --to engine-p2"))["want"].clone();
    let one = want("engine-p2:stiffness=40,damping=1");
    for same in ["engine-cannon:stiffness=40,damping=0", "engine-cannon:stiffness=40"] {
        assert_eq!(want(same), one, "{same}");
    }
    assert_eq!(want("engine-p2:stiffness=40"), one);
    assert!(want("engine-p2:stiffness=40,damping=0")["damping_ratio"].as_f64().unwrap() < 1e-9);
    let older = "engine-bullet-6dof:stiffness=40";
    assert_eq!(want(older), want(&format!("{older},damping=1")));
    let text = stdout_of("port --frequency 1 --mass 2 --to engine-cannon");
    assert!(
        text.contains("spring: reached\n  stiffness = 78.8847 N/m, damping = 2·10⁻⁹"),
        "{text}"
    );
    assert!(text.contains("stiffness: 78.8847067, damping: 2e-9 })"), "{text}");
}

#[test]
fn the_spring_of_cannon_pulls_in_the_first_step_too() {
    let text = stdout_of("port --frequency 1 --damping-ratio 0.1 --to engine-cannon");
    // Its event comes after a step, so that a line before it makes the force of the first.
    let lines: Vec<&str> = text.lines().filter(|line| line.contains("applyForce()")).collect();
    let [first, later] = lines[..] else { panic!("{text}") };
    assert!(first.trim().starts_with("spring.applyForce() //"), "{text}");
    assert!(later.contains("'postStep', () => spring.applyForce()"), "{text}");
}

#[test]
fn a_damping_floor_is_reported_with_a_way_below_it() {
    let text = stdout_of("port --frequency 1Hz --to engine-box2d,engine-physx");
    for said in [
        "engine-box2d ×4, spring: unreachable",
        "Box2D ×4 at 60 Hz cannot go below a damping ratio of 0.0262 at 1 Hz; ×8 can go to 0.0131",
        "a force of your own reaches it: stiffness 39.4424 N/m, damping 0.246515 N s/m",
        "at 120 Hz can go to 0.0262",
    ] {
        assert!(text.contains(said), "{said}: {text}");
    }
    let text = stdout_of("port --frequency 6Hz --damping-ratio 0.2 --to engine-bullet");
    assert!(
        text.contains("6dof-spring: nearest") && text.contains("missed: frequency by"),
        "{text}"
    );
}

#[test]
fn settings_of_an_engine_and_a_log_round_trip() {
    let found = json("--from engine-godot:stiffness=1000,damping=80 --mass 80 --to engine-godot");
    let settings = &rows(&found, "engines")[0]["settings"];
    let near = |key: &str, wanted: f64| {
        assert!((settings[key].as_f64().unwrap() / wanted - 1.0).abs() < 1e-9, "{settings}");
    };
    near("stiffness", 1000.0);
    near("damping", 80.0);
    // Another rate, another count of substeps, another mode.
    let from =
        "engine-rapier:mode=acceleration-based,stiffness=250,damping=9,tick_hz=120,substeps=2";
    let found = json(&format!("--from {from} --mass 3 --to engine-jolt"));
    for row in rows(&found, "engines") {
        assert_eq!(row["word"], "reached", "{row}");
    }
    // Box2D's spring of 1 Hz and ζ 0.05, as it was logged.
    let log = "tests/data/engines/box2d__spring_1hz_z005_60hz.csv";
    let found = json(&format!("--from {log} --to engine-box2d --k 39.4784 --c 0.628319"));
    let settings = &rows(&found, "engines")[0]["settings"];
    assert!((settings["hertz"].as_f64().unwrap() - 1.0).abs() < 1e-3, "{settings}");
    assert!((settings["dampingRatio"].as_f64().unwrap() - 0.05).abs() < 1e-3, "{settings}");
}

#[test]
fn a_drive_has_its_limits_and_a_chase_has_rates_for_every_follower() {
    let found = json(
        "--frequency 5Hz --damping-ratio 1 --mass 2 --drive --decimation 4 --tick-hz 500 --to engine-mujoco",
    );
    let drives = rows(&found, "drives");
    let of = |mode: &str| drives.iter().find(|row| row["mode"] == mode).unwrap();
    // h² K < 4 - 2 h c.
    let most = of("actuator-euler")["max_kp_n_per_m"].as_f64().unwrap();
    assert!((most / 1.874_336e6 - 1.0).abs() < 1e-5, "{most}");
    assert!(of("joint")["max_kv_n_s_per_m"].is_null());
    assert_eq!(of("own-force")["decimation"], 4);
    assert!(of("own-force")["max_kp_n_per_m"].as_f64().unwrap() < most / 20.0);

    let text = stdout_of("port --from lerp:0.1@60fps");
    assert!(text.starts_with("halves in 0.1096 s: 1 - exp(-6.322 dt)\n"), "{text}");
    assert!(text.contains("144 fps  0.042951"), "{text}");
    let found = json("--from smooth-damp:0.3");
    assert!((found["want"]["half_life_s"].as_f64().unwrap() - 0.251_752).abs() < 1e-6, "{found}");
    let found = json("--from half-life:0.2s");
    assert!((found["want"]["rate_per_s"].as_f64().unwrap() - 3.465_736).abs() < 1e-6, "{found}");
}

#[test]
fn an_interface_spring_is_converted_with_the_effect_of_the_frame_rate() {
    let found = json("--from swiftui:duration=0.5,bounce=0.3");
    assert!(rows(&found, "engines").is_empty());
    let ids: Vec<String> =
        rows(&found, "dialects").iter().map(|row| row["id"].as_str().unwrap().to_owned()).collect();
    assert!(ids.len() > 14 && ids[0] == "swiftui" && ids.contains(&"motion-duration".into()));
    let found = json("--from swiftui --to engine-jolt,react-spring,core-animation --tick-hz 30");
    assert_eq!(rows(&found, "engines").len(), 2);
    let [react, apple] = &rows(&found, "dialects")[..] else { panic!("{found}") };
    assert_eq!(
        (&react["word"], &react["steps"]),
        (&"reached".into(), &"semi-implicit-euler".into())
    );
    assert!(react["explodes_below_hz"].is_null() && apple["steps"] == "exact");
    // 34 ms in a frame of 33.3 ms, and the stiffness is lower by the square.
    let hz = react["seen"]["hz"].as_f64().unwrap();
    let tension = react["settings"]["tension"].as_f64().unwrap();
    assert!((hz / 2.0 - 1.0).abs() < 1e-7 && (tension / 157.9137 * 1.0404 - 1.0).abs() < 0.02);
    assert!(apple["settings"]["stiffness"].as_f64().is_some_and(|k| (k - 157.9137).abs() < 1e-4));
    let text = stdout_of("port --from swiftui --mass 5 --to flutter,flutter");
    assert!(text.matches("mass: 5.0, stiffness: 789.5683").count() == 1, "{text}");
    let text = stdout_of("port --from flutter:mass=2,stiffness=8,damping=4 --to compose,css");
    assert!(text.contains("spring(dampingRatio = 0.5f, stiffness = 4.0f)"), "{text}");
    assert!(text.contains("linear(0, 0.0"), "{text}");
}

#[test]
fn an_impossible_request_is_one_error_with_a_remedy() {
    for (arguments, told) in [
        ("", "required arguments were not provided"),
        ("--frequency 2.5s", "give a frequency above 0 in Hz, such as 2.5Hz"),
        ("--frequency -2Hz", "give a frequency above 0 in Hz, such as 2.5Hz"),
        ("--frequency 40Hz", "40 Hz cannot be seen at 60 ticks per second"),
        (
            "--frequency 20Hz --damping-ratio 100",
            "is over within a tick of 60 Hz; damp less, or tick faster",
        ),
        ("--frequency 1e-9Hz", "takes more than 30000 ticks at 60 Hz, so that rounding hides it"),
        ("--frequency 2Hz --tick-hz -60", "give a rate above 0"),
        ("--frequency 2Hz --substeps 0", "0 is not in 1..=1000"),
        (
            "--from engine-godot",
            "give its settings too: engine-godot:stiffness=NUMBER,damping=NUMBER",
        ),
        ("--frequency 2Hz --damping-ratio -1", "give a number from 0 up"),
        ("--frequency 2Hz --mass -1", "give a number above 0"),
        ("--frequency 2Hz --to engine-foo", "no such engine or user interface with a spring"),
        ("--frequency 2Hz --to engine-pybullet", "no such engine or user interface with a spring"),
        ("--frequency 2Hz --decimation 2", "--drive"),
        ("--from engine-gdot:stiffness=1", "did you mean engine-godot?"),
        (
            "--from engine-godot:stiffness=1,dampng=8",
            "engine-godot has no stiffness and dampng; it has stiffness and damping",
        ),
        ("--from engine-godot:stiffness=1kg", "stiffness: \"1kg\" is no number of N/m"),
        ("--from engine-godot:damping=8", "give stiffness too"),
        ("--from engine-godot:stiffness", "\"stiffness\" is no KEY=VALUE"),
        ("--from engine-jolt:mStiffness=10,mDamping=-1", "mDamping is -1; it must be 0 or more"),
        (
            "--from engine-havok:stiffness=40,damping=2,mode=limit",
            "damping is 2, with which mode=limit of engine-havok is not linear; give 0, or mode=motor-force",
        ),
        (
            "--from engine-bullet-6dof:stiffness=40,damping=0",
            "damping is 0, with which engine-bullet-6dof never moves, at any tick rate; give more",
        ),
        ("--from engine-physx:mode=soft,stiffness=1", "no mode soft; there are force-drive,"),
        ("--from held-force:stiffness=1e5", "nothing swings so in held-force ×4 at 60 Hz"),
        ("--from held-force:stiffness=100", "gains energy: its damping ratio is -0.03"),
        ("--from nothing.csv", "cannot read the log nothing.csv"),
        ("--from lerp:2@60fps", "the part is 2; it must be between 0 and 1"),
        ("--from lerp:0.1", "give the frames too: lerp:0.1@60fps"),
        ("--from swiftui:bounce=2", "bounce is 2; it must be above −1 and at most 1"),
        (
            "--from swiftui:bouce=0",
            "swiftui has no key \"bouce\"; write duration=NUMBER,bounce=NUMBER",
        ),
        ("--from css", "CSS linear() is points of a motion, from which it cannot be told"),
        ("--from swiftui --damping-ratio 0.5", "cannot be used with '--damping-ratio"),
        ("--from swiftui --substeps 4", "--substeps is for engines"),
        ("--frequency 2Hz --to ui --drive", "--drive is for engines"),
        ("--from half-life:1s --drive", "--drive is for a spring"),
    ] {
        let output = run(&format!("port {arguments}"));
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{arguments}: {said}");
        assert!(said.contains(told) && said.matches("error:").count() == 1, "{arguments}: {said}");
        assert!(output.stdout.is_empty(), "{arguments}");
    }
}

#[test]
fn a_drive_is_judged_by_its_gains_with_both_stability_limits() {
    let engine = "--from engine-mujoco:mode=actuator,kp=2000,kv=100 --mass 0.002 --tick-hz 500";
    let interface = "--from core-animation:mass=0.002,stiffness=2000,damping=100 --tick-hz 500";
    for from in [engine, interface] {
        let found = json(&format!("{from} --drive --to engine-mujoco"));
        let drives = rows(&found, "drives");
        let of = |mode: &str| drives.iter().find(|row| row["mode"] == mode).unwrap();
        let number = |row: &Value, key: &str| row[key].as_f64().unwrap();
        let [implicit, explicit] = ["actuator", "actuator-euler"].map(of);
        let gains = &implicit["gains"];
        assert!((number(gains, "kp_n_per_m") / 2000.0 - 1.0).abs() < 1e-9, "{gains}");
        assert!((number(gains, "kv_n_s_per_m") / 100.0 - 1.0).abs() < 1e-9, "{gains}");
        assert!((number(implicit, "spectral_radius") - 0.960).abs() < 1e-3, "{implicit}");
        // m / h² (4 + 2 h kv / m).
        assert!((number(implicit, "max_kp_n_per_m") / 102_000.0 - 1.0).abs() < 1e-6, "{implicit}");
        assert!(number(explicit, "spectral_radius") > 90.0, "{explicit}");
        assert_eq!(number(explicit, "max_kp_n_per_m"), 0.0);
        // Semi-implicit Euler holds from kv = 0 up to 2 m/h - kp h/2 only, and that is below 0 here.
        assert_eq!(number(explicit, "max_kv_n_s_per_m"), 0.0);
    }
    // A force that is held for a tick gains energy without damping.
    let drives = rows(
        &json("--frequency 1Hz --damping-ratio 0.3 --drive --decimation 4 --to engine-jolt"),
        "drives",
    );
    let held = drives.iter().find(|row| row["mode"] == "own-force").unwrap();
    let [least, most] =
        ["min_kv_n_s_per_m", "max_kv_n_s_per_m"].map(|key| held[key].as_f64().unwrap());
    assert!(0.0 < least && least < most, "{held}");
    let text = stdout_of(
        "port --frequency 1Hz --damping-ratio 0.3 --drive --decimation 4 --to engine-jolt",
    );
    assert!(text.contains(" to ") && text.contains("N s/m with this kp"), "{text}");
}

#[test]
fn per_frame_formulas_of_games_are_accepted_as_written() {
    let chase = stdout_of("port --from lerp-dt:20@30fps");
    assert!(chase.starts_with("halves in 0.02103 s: 1 - exp(-32.96 dt)\n"), "{chase}");
    assert_eq!(chase, stdout_of("port --from lerp:0.6666666666666666@30fps"));
    let friction = json("--from friction:0.9@60fps");
    let number = |key: &str| friction[key].as_f64().unwrap();
    assert!(
        (number("half_life_s") - 0.1096).abs() < 1e-4
            && (number("rate_per_s") - 6.3216).abs() < 1e-4
    );
    let factors: Vec<f64> =
        rows(&friction, "factors").iter().map(|row| row["kept"].as_f64().unwrap()).collect();
    for (factor, wanted) in factors.iter().zip([0.81, 0.9, 0.948_683, 0.957_049, 0.974_004]) {
        assert!((factor - wanted).abs() < 1e-6, "{factors:?}");
    }
    let text = stdout_of("port --from friction:0.9@60fps");
    for told in ["6.3216", "6.0000", "6.6667", "0.1582 m", "0.1500 m", "0.1667 m"] {
        assert!(text.contains(told), "{told}: {text}");
    }
    let spring =
        json("--from per-frame-decay:stiffness=0.2,decay=0.85 --to core-animation,per-frame");
    assert!((spring["want"]["frequency_hz"].as_f64().unwrap() - 4.130).abs() < 1e-3, "{spring}");
    assert!((spring["want"]["damping_ratio"].as_f64().unwrap() - 0.1879).abs() < 1e-4);
    let exact = &rows(&spring, "dialects")[0]["settings"];
    assert!((exact["stiffness"].as_f64().unwrap() / 673.508 - 1.0).abs() < 1e-5, "{exact}");
    assert!((exact["damping"].as_f64().unwrap() / 9.751_14 - 1.0).abs() < 1e-5, "{exact}");
    for (wrong, told) in [
        ("lerp-dt:20@8fps", "grows"),
        ("lerp-dt:20@20fps", "is there in one frame"),
        ("friction:1.1@60fps", "must be between 0 and 1"),
        ("friction:0.9", "give the frames too"),
        ("per-frame-decay:stiffness=0.2", "write per-frame-decay:"),
        ("per-frame-decay:stiffness=5,decay=0.85", "so set it grows"),
        ("per-frame-decay:stiffness=0.2,decay=1.05", "so set it grows"),
    ] {
        let output = run(&format!("port --from {wrong}"));
        assert_eq!(output.status.code(), Some(2), "{wrong}");
        assert!(stderr(&output).contains(told), "{wrong}: {}", stderr(&output));
    }
}

#[test]
fn a_damping_that_an_interface_cuts_is_said() {
    let from = "--from core-animation:mass=1,stiffness=850,damping=67.056";
    let said = stderr(&run(&format!("port {from} --to motion")));
    let told =
        "core-animation shows damping ratio 1.000 here; with allowsOverdamping=true it is 1.150";
    assert!(said.contains(told), "{said}");
    let said = stderr(&run(&format!("port {from},allowsOverdamping=true --to motion")));
    assert!(said.is_empty(), "{said}");
}

#[test]
fn an_interface_is_read_as_it_moves_and_its_limits_are_said() {
    let want = |found: &Value, key: &str| found["want"][key].as_f64().unwrap();
    let found = json("--from react-native:tension=50,friction=1 --to core-animation");
    assert!((want(&found, "frequency_hz") - 2.5977).abs() < 1e-4, "{found}");
    assert!((want(&found, "damping_ratio") - 0.122_536).abs() < 1e-5, "{found}");
    // 8 % too fast by rounding up 8.33 ms to 9 ms, and back to the same numbers.
    let from = "--from react-spring:tension=180,friction=12 --tick-hz 120";
    let output = run(&format!("port {from} --to css,react-spring --format json"));
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    let by_numbers = 180.0_f64.sqrt() / std::f64::consts::TAU;
    assert!((want(&found, "frequency_hz") / by_numbers / 1.08 - 1.0).abs() < 0.01, "{found}");
    let back = &rows(&found, "dialects")[1]["settings"]["tension"];
    assert!((back.as_f64().unwrap() / 180.0 - 1.0).abs() < 1e-6, "{back}");
    for (from, told) in [
        ("react-spring:tension=180,friction=12", "its numbers say 2.135 Hz, damping ratio 0.4472"),
        ("reanimated:mass=1,stiffness=100,damping=40", "damping ratio 1.000; its numbers say"),
        ("anime:mass=0.5,stiffness=100", "anime shows 1.592 Hz, damping ratio 0.5000; its numbers"),
        ("qt:spring=2,damping=0.2", "its numbers say"),
        ("qt:spring=2,damping=3", "Qt SpringAnimation moves as no spring does at 60 frames"),
        ("wobble:damping=40", "with allowsOverdamping=true it is 2.000"),
    ] {
        let said = stderr(&run(&format!("port --from {from} --to motion")));
        assert!(said.contains(told), "{from}: {said}");
    }
    // Its own mass is 4.
    assert!(stderr(&run("port --from reanimated --to motion")).is_empty());
    let exploding = run("port --from per-frame:stiffness=1e5,damping=1 --to motion");
    assert_eq!(exploding.status.code(), Some(2));
    assert!(stderr(&exploding).contains("explodes at 60 frames per second"));
}

#[test]
fn css_from_react_spring_is_off_at_its_frames_as_said() {
    for (fps, longest) in [(30, 34), (60, 17), (120, 9)] {
        let from = format!("port --from react-spring:tension=180,friction=12 --tick-hz {fps}");
        let output = run(&format!("{from} --to css --format json"));
        let found: Value = serde_json::from_slice(&output.stdout).unwrap();
        let row = rows(&found, "dialects").remove(0);
        let code = row["code"].as_str().unwrap();
        let (head, rest) = code.split_once("s linear(").unwrap();
        let (points, delay) = rest.split_once(") ").unwrap();
        let points: Vec<f64> = points.split(", ").map(|point| point.parse().unwrap()).collect();
        let duration: f64 = head.rsplit(' ').next().unwrap().parse().unwrap();
        let delay: f64 = delay.trim_end_matches('s').parse().unwrap();
        let (mut x, mut v, mut most) = (0.0_f64, 0.0_f64, 0.0_f64);
        for frame in 0..fps {
            let time = f64::from(frame) / f64::from(fps) - delay;
            let place = (time / duration).clamp(0.0, 0.999_999) * (points.len() - 1) as f64;
            let [from, to] = [0, 1].map(|i| points[place as usize + i]);
            most = most.max((from + (to - from) * place.fract() - x).abs());
            // Steps of 1 ms, and 17 in the first frame at every rate.
            for _ in 0..if frame == 0 { 17 } else { longest } {
                v += 1e-3 * (180.0 * (1.0 - x) - 12.0 * v);
                x += 1e-3 * v;
            }
        }
        let said = row["error"].as_f64().unwrap();
        assert!((most / said - 1.0).abs() < 1e-3 && said < 0.01, "{fps}: {most}, not {said}");
        let text = String::from_utf8(run(&format!("{from} --to css")).stdout).unwrap();
        assert!(
            text.contains(&format!("at these {fps} frames per second, with a delay of")),
            "{text}"
        );
        assert!(delay != 0.0 && row["delay_s"] == delay, "{row}");
    }
    let said = stderr(&run("port --from react-spring:tension=180 --tick-hz 30 --to motion"));
    assert!(said.contains("ms behind such a spring"), "{said}");
}

#[test]
fn each_interface_ends_a_motion_by_its_rule_and_the_rest_of_the_way_is_told() {
    let motion = "--frequency 4.6401Hz --damping-ratio 1.15";
    let settles =
        "stays within 1 % of the way from 0.2957 s, 0.1 % from 0.4314 s, 0.01 % from 0.5671 s";
    let text = stdout_of(&format!("port {motion} --to react-spring,motion,compose"));
    assert!(text.contains(settles) && text.matches("  ends at ").count() == 3, "{text}");
    let text = stdout_of("port --from motion:stiffness=100,damping=10 --ends");
    for line in [
        "motion                    1.0833 s  0.43 % of the way\n",
        "reanimated                1.9667 s  0.0043 % of the way\n",
        "popmotion                 0.6000 s  0.23 % of the way\n",
        "swiftui                    no rule\n",
    ] {
        assert!(text.contains(line), "{line}: {text}");
    }
    let found = json(&format!("{motion} --to motion --ends"));
    let ends = &rows(&found, "dialects")[0]["ends"];
    assert!((ends["at_s"].as_f64().unwrap() - 0.466_667).abs() < 1e-6, "{ends}");
    let settles: Vec<f64> =
        rows(&found["want"], "settles_s").iter().map(|s| s.as_f64().unwrap()).collect();
    assert!((settles[1] - 0.4314).abs() < 1e-4, "{settles:?}");
    let refused = run(&format!("port {motion} --to engine-jolt --ends"));
    assert_eq!(refused.status.code(), Some(2));
    assert!(stderr(&refused).contains("--ends is for user interfaces"));
}
