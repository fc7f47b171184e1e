//! `report`: a picture that carries its run.

use std::fs;

use super::{run_in, stderr};

#[test]
fn a_report_is_a_picture_that_every_command_takes_as_its_run() {
    let folder = tempfile::tempdir().unwrap();
    let run = |arguments: &str| {
        let output = run_in(folder.path(), arguments);
        let data = String::from_utf8_lossy(&output.stdout).into_owned();
        (output.status.code(), data, stderr(&output))
    };
    let made = run("report spring --method rk4 --seconds 2 --out a.png");
    assert_eq!(made.0, Some(0), "{}", made.2);
    assert!(made.2.contains("the run to tick 120"), "{}", made.2);
    let path = folder.path().join("a.png");
    let picture = image::open(&path).unwrap().into_rgb8();
    assert_eq!(picture.dimensions(), (1280, 720));
    assert!(picture.pixels().any(|pixel| pixel != picture.get_pixel(0, 0)));
    let judged = run("verify a.png");
    assert_eq!((judged.0, judged.2.as_str()), (Some(0), ""));
    assert!(judged.1.contains("rk4: same to the bit: 2 checks to tick 120"), "{}", judged.1);
    let states = run("trace spring --method rk4 --seconds 2").1;
    assert_eq!(run("trace a.png --method rk4 --seconds 2").1, states);
    // The name of an attachment may have lost its ending.
    fs::copy(&path, folder.path().join("b")).unwrap();
    assert_eq!(run("trace --scene b --method rk4 --seconds 2").1, states);
    // Nothing is replaced unasked, and a report is no text.
    for refused in [
        "report spring --out a.png",
        "verify a.png --bless",
        "report --scene a.png --out a.png --force",
    ] {
        let (code, _, message) = run(refused);
        assert_eq!(code, Some(2), "{refused}: {message}");
    }
    assert_eq!(run("report ship --seconds 1 --out a.png --force").0, Some(0));
    picture.save(&path).unwrap();
    let (code, _, message) = run("verify a.png");
    assert_eq!(code, Some(2));
    assert!(message.contains("a.png is a picture without a run; `regatta report`"), "{message}");
}

#[test]
fn a_report_of_a_recording_keeps_the_hashes_of_the_recording() {
    let folder = tempfile::tempdir().unwrap();
    let text = fs::read_to_string("assets/scenes/spring.toml").unwrap();
    let wrong = format!("{text}\n[[check]]\ntick = 60\nlane = 1\nhash = \"{}\"\n", "0".repeat(16));
    fs::write(folder.path().join("run.toml"), wrong).unwrap();
    let made = run_in(folder.path(), "report run.toml --out a.png");
    assert_eq!(made.status.code(), Some(0), "{}", stderr(&made));
    let judged = run_in(folder.path(), "verify a.png");
    assert_eq!(judged.status.code(), Some(1));
    let told = String::from_utf8_lossy(&judged.stdout).into_owned();
    assert!(
        told.contains("differs first at tick 60 (1 s): 0000000000000000 in the file"),
        "{told}"
    );
}
