//! Methods by lines of a person's own, on the command line.

use std::fs;
use std::path::Path;

use super::{regatta, stderr, stdout_of};

fn file(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    fs::write(&path, text).unwrap();
    path.display().to_string()
}

#[test]
fn an_own_method_is_shown_raced_advised_about_and_swept() {
    let folder = tempfile::tempdir().unwrap();
    let path = file(folder.path(), "My_Euler.step", "v += a(x, v) * dt;\nx += v * dt;\n");
    let shown = stdout_of(&format!("show {path} --as csharp"));
    assert!(shown.contains("the same as") && shown.contains("class MyEuler"), "{shown}");
    let [cpp, c] = ["cpp", "c"].map(|it| stdout_of(&format!("show {path} --as {it}")));
    assert_eq!(cpp, c);
    let traced =
        |method: &str| stdout_of(&format!("trace --scene spring --seconds 0.1 --method {method}"));
    assert_eq!(
        traced(&path),
        traced("semi-implicit-euler").replace("semi-implicit-euler", "my-euler")
    );
    for command in ["advise", "sweep", "cloud"] {
        let told = stdout_of(&format!("{command} --scene spring --method {path}"));
        assert!(told.contains("my-euler"), "{command}: {told}");
    }
}

#[test]
fn mistakes_in_own_methods_are_reported_with_place_and_remedy() {
    let folder = tempfile::tempdir().unwrap();
    for (name, text, told) in [
        (
            "bad.step",
            "v += a(x, v) * dt\nx += w * dt",
            "bad.step:2:6: unknown name `w`; write x, v or h, or",
        ),
        (
            "rule.step",
            "x += v * dt",
            "no line calls `a(x, v)`, so that the lines are a rule; give its `fps` in a scene, or its file",
        ),
        (
            "rk4.step",
            "v += a(x, v) * dt; x += v * dt",
            "\"rk4\" is a name of the built-in method rk4; give it another name",
        ),
        ("aim.step", "v += a(target, v) * dt", "a method moves by `a(x, v)`, and has no target"),
        ("for.step", "for x < 1 { v += a(x, v) }", "`for` cannot stand in a step"),
    ] {
        let path = file(folder.path(), name, text);
        let output = regatta().args(["trace", "--method", &path]).output().unwrap();
        let said = stderr(&output);
        assert!(said.contains(told) && output.status.code() == Some(2), "{said}");
        assert!(said.contains('^'), "{said}");
    }
    let text = "count n = 0; while n < 2 { v += a(x, v) * h / 2; n += 1 }; x += v * h";
    let path = file(folder.path(), "loop.step", text);
    let output = regatta().args(["trace", "--scene", "orbit", "--method", &path]).output().unwrap();
    let said = stderr(&output);
    assert!(said.contains("lane 1 did not step") && output.status.code() == Some(1), "{said}");
    let output = regatta().args(["rule", "v += a(x, v) * dt; x += v * dt"]).output().unwrap();
    assert!(stderr(&output).contains("as a method: `--method my.step`"), "{}", stderr(&output));
    let missing = regatta().args(["show", "none.step"]).output().unwrap();
    assert!(stderr(&missing).contains("no file is called"), "{}", stderr(&missing));
}

#[test]
fn a_rule_file_can_replace_a_scene() {
    let folder = tempfile::tempdir().unwrap();
    let path = file(folder.path(), "camera.step", "x += (target - x) * 20 * dt");
    let scene = stdout_of(&format!("rule {path} --fps 60 --scene"));
    let toml = file(folder.path(), "camera.toml", &scene);
    let rows = |scene: &str| stdout_of(&format!("trace --scene {scene} --seconds 2.5"));
    assert_eq!(rows(&path), rows(&toml));
    assert!(rows(&path).contains(",camera,"));
    let other = stdout_of(&format!("rule {path} --fps 59.94 --scene"));
    assert!(other.contains("tick_hz = 29.97") && other.contains("fps = 59.94"), "{other}");
    let swept = stdout_of(&format!("sweep --scene {path} --tick-hz 60 --seconds 1"));
    assert!(swept.contains(",camera,camera,60,"), "{swept}");
    for (name, text, told) in [
        ("a.step", "v += a(x, v) * dt; x += v * dt", "is a method; give `--method a.step`"),
        ("b.step", "v -= v * abs(v) * dt; x += v", "b.step:1:1: the rule is not linear"),
        ("c.step", "x += (x - target) * dt", "c.step:1:1: the rule grows at 60 frames"),
        ("d.step", "x += (x - w) * dt", "d.step:1:11: unknown name `w`"),
        ("rk4.step", "x *= 0.9", "\"rk4\" is a name of the built-in method rk4"),
    ] {
        let path = file(folder.path(), name, text);
        let output = regatta().current_dir(&folder).args(["trace", "--scene", name]).output();
        let output = output.unwrap();
        let said = stderr(&output);
        assert!(said.contains(told) && output.status.code() == Some(2), "{path}: {said}");
    }
    let output =
        regatta().args(["trace", "--scene", "spring", "--method", &path]).output().unwrap();
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
}
