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
fn mistakes_in_own_methods_are_told_with_place_and_remedy() {
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
            "no line calls `a(x, v)`, so that the lines are a rule; ask `regatta rule`",
        ),
        (
            "rk4.step",
            "v += a(x, v) * dt; x += v * dt",
            "\"rk4\" is a name of the built-in method rk4; give it another name",
        ),
        ("aim.step", "v += a(target, v) * dt", "a method moves by `a(x, v)`, and has no target"),
        ("while.step", "while x < 1 { v += a(x, v) }", "`while` cannot stand in a step"),
    ] {
        let path = file(folder.path(), name, text);
        let output = regatta().args(["trace", "--method", &path]).output().unwrap();
        let said = stderr(&output);
        assert!(said.contains(told) && output.status.code() == Some(2), "{said}");
        assert!(said.contains('^'), "{said}");
    }
    let output = regatta().args(["rule", "v += a(x, v) * dt; x += v * dt"]).output().unwrap();
    assert!(stderr(&output).contains("as a method: `--method my.step`"), "{}", stderr(&output));
    let missing = regatta().args(["show", "none.step"]).output().unwrap();
    assert!(stderr(&missing).contains("no file is called"), "{}", stderr(&missing));
}
