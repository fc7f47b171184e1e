//! `verify`: the same runs, changed runs, and clips that cannot be judged.

use std::fs;
use std::path::{Path, PathBuf};

use regatta::commands::manifest::{Manifest, fingerprint};
use serde_json::Value;
use tempfile::TempDir;

use super::{dimensions, regatta, run_in, stderr};

/// Captures the spring racing into `clip`: 7 frames, 12 ticks, a mark at each.
pub(super) fn clip() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let capture = "capture --scene spring --race --frames 7 --size 64x36 --scale 0.5 --out clip";
    let output = run_in(folder.path(), capture);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    folder
}

/// Exit code, standard output and standard error of `verify clip`.
pub(super) fn verify(folder: &Path, arguments: &str) -> (Option<i32>, String, String) {
    let output = run_in(folder, &format!("verify clip {arguments}"));
    let stdout = String::from_utf8(output.stdout.clone()).unwrap();
    (output.status.code(), stdout, stderr(&output))
}

fn manifest_of(folder: &Path) -> PathBuf {
    folder.join("clip/manifest.json")
}

/// Changes the manifest without regard to its hashes.
fn edit(folder: &Path, change: impl FnOnce(&mut Manifest)) {
    let mut manifest = read(folder);
    change(&mut manifest);
    fs::write(manifest_of(folder), manifest.to_text()).unwrap();
}

fn read(folder: &Path) -> Manifest {
    serde_json::from_str(&fs::read_to_string(manifest_of(folder)).unwrap()).unwrap()
}

#[test]
fn a_capture_from_this_machine_verifies_as_the_same() {
    let folder = clip();
    let (code, stdout, stderr) = verify(folder.path(), "");
    assert_eq!((code, &*stderr), (Some(0), ""));
    let expected =
        "physics: same to the bit: 5 lanes to tick 12\npixels: same: 7 frames, every pixel\n";
    assert_eq!(stdout, expected);
}

#[test]
fn frames_need_no_driver_unless_a_device_is_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let run = |arguments: &str| {
        regatta()
            .current_dir(folder.path())
            // No system has all of these.
            .env("WGPU_BACKEND", if cfg!(windows) { "metal" } else { "dx12" })
            .args(arguments.split(' '))
            .output()
            .unwrap()
    };
    let capture = "capture --scene harbour --race --frames 3 --size 64x36 --out";
    for arguments in [&*format!("{capture} clip"), "verify clip", "verify clip --physics-only"] {
        let output = run(arguments);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    }
    let output = run(&format!("{capture} other --renderer gpu"));
    assert_eq!(output.status.code(), Some(1));
    let said = stderr(&output);
    assert!(said.starts_with("error: no usable graphics adapter: "), "{said}");
    assert!(said.trim_end().ends_with("or take --renderer cpu"), "{said}");
}

#[test]
fn one_bit_of_one_frame_is_a_change_of_pixels_and_not_of_physics() {
    let folder = clip();
    let path = folder.path().join("clip/frame-000003.png");
    let mut picture = image::open(&path).unwrap().into_rgba8();
    picture.get_pixel_mut(5, 6).0[1] ^= 4;
    picture.save(&path).unwrap();
    let (code, stdout, stderr) = verify(folder.path(), "--diff off/here");
    assert_eq!(code, Some(1), "{stdout}{stderr}");
    let lines: Vec<_> = stdout.lines().collect();
    assert_eq!(lines[0], "physics: same to the bit: 5 lanes to tick 12");
    let expected = "pixels: frame-000003.png: 1 pixel off, the worst by 4; the file no longer \
                    matches its hash in the manifest; see off/here/frame-000003.png";
    assert_eq!(lines[1..], [expected, "pixels: 1 of 7 frames differ"]);
    assert!(stderr.contains("pixels differ from clip/manifest.json"), "{stderr}");
    let difference = folder.path().join("off/here/frame-000003.png");
    assert_eq!(dimensions(&difference), (64, 36));
    let picture = image::open(difference).unwrap().into_rgba8();
    assert_eq!(picture.get_pixel(5, 6).0, [0, 255, 0, 255]);
    assert_eq!(picture.pixels().filter(|pixel| pixel.0 != [0, 0, 0, 255]).count(), 1);
}

#[test]
fn a_missing_or_broken_frame_is_named() {
    let folder = clip();
    let clip = folder.path().join("clip");
    fs::remove_file(clip.join("frame-000000.png")).unwrap();
    fs::write(clip.join("frame-000001.png"), "half").unwrap();
    fs::copy(clip.join("frame-000004.png"), clip.join("frame-000005.png")).unwrap();
    let (code, stdout, _) = verify(folder.path(), "");
    assert_eq!(code, Some(1));
    assert!(stdout.contains("pixels: frame-000000.png: is missing"), "{stdout}");
    assert!(stdout.contains("pixels: frame-000001.png: cannot be decoded: "), "{stdout}");
    assert!(stdout.contains("pixels: frame-000005.png: "), "{stdout}");
    assert!(stdout.ends_with("pixels: 3 of 7 frames differ\n"), "{stdout}");
}

#[test]
fn a_state_of_another_run_is_a_change_of_physics_at_its_tick() {
    let folder = clip();
    edit(folder.path(), |manifest| {
        let text = &manifest.recording;
        let checks: Vec<usize> = text.match_indices("[[check]]").map(|(at, _)| at).collect();
        assert_eq!(checks.len(), 5 * 13, "each lane at each tick");
        let [other, at_end] = [5 * 8 + 1, 5 * 12].map(|n| checks[n]);
        let zeroed = |part: &str| {
            let at = part.find("hash = \"").unwrap() + "hash = \"".len();
            format!("{}{}{}", &part[..at], "0".repeat(16), &part[at + 16..])
        };
        let between = zeroed(&text[other..at_end]);
        manifest.recording = text[..other].to_owned() + &between + &zeroed(&text[at_end..]);
        manifest.settings_hash = manifest.hash();
    });
    let (code, stdout, stderr) = verify(folder.path(), "--physics-only");
    assert_eq!(code, Some(1));
    assert!(stderr.contains("physics differ from"), "{stderr}");
    let first = "physics: differs first at tick 8: lane 2, semi-implicit-euler, its state is \
                 0000000000000000 in the manifest and ";
    assert!(stdout.starts_with(first) && stdout.ends_with(" now\n"), "{stdout}");
}

#[test]
fn a_different_final_state_is_a_change_of_physics() {
    let folder = clip();
    let whole = fs::read(manifest_of(folder.path())).unwrap();
    type Change = fn(&mut Manifest);
    let changes: [(Change, &str); 3] = [
        (
            |manifest| manifest.lanes[1]["hash"] = "0".repeat(16).into(),
            "its hash at the end is 0000000000000000",
        ),
        (|manifest| manifest.lanes[1]["method"] = "rk4".into(), "its method at the end is rk4"),
        (|manifest| manifest.lanes[1]["halted"] = 3.into(), "its halted at the end is 3"),
    ];
    for (change, said) in changes {
        fs::write(manifest_of(folder.path()), &whole).unwrap();
        edit(folder.path(), change);
        let (code, stdout, stderr) = verify(folder.path(), "--physics-only");
        assert_eq!(code, Some(1), "{stdout}{stderr}");
        let first = format!(
            "physics: differs first at tick 12: lane 2, semi-implicit-euler, {said} in the manifest"
        );
        assert!(stdout.starts_with(&first), "{stdout}");
    }
}

#[test]
fn a_scene_file_changed_since_the_capture_is_reported_and_not_run() {
    let folder = clip();
    let text = "a scene";
    edit(folder.path(), |manifest| {
        manifest.drawing.scene = "mine.toml".into();
        manifest.drawing.scene_hash = fingerprint(text.as_bytes());
        manifest.settings_hash = manifest.hash();
    });
    let file = folder.path().join("mine.toml");
    for (now, is_told) in [(text.to_owned(), false), (format!("{text}\nfaulty"), true)] {
        fs::write(&file, now).unwrap();
        let (code, stdout, stderr) = verify(folder.path(), "--physics-only");
        assert_eq!(code, Some(0), "{stdout}{stderr}");
        let said = "mine.toml has changed since the capture; verify runs the captured scene";
        assert_eq!(stderr.contains(said), is_told, "{stderr}");
    }
}

#[test]
fn a_changed_constant_is_a_change_of_physics_at_the_first_tick() {
    let folder = clip();
    edit(folder.path(), |manifest| {
        let text = manifest.recording.replace("mass_kg = 1.0", "mass_kg = 1.0000001");
        assert_ne!(manifest.recording, text);
        manifest.recording = text;
        manifest.settings_hash = manifest.hash();
    });
    let (code, stdout, _) = verify(folder.path(), "--physics-only");
    assert_eq!(code, Some(1));
    assert!(stdout.starts_with("physics: differs first at tick 1: lane 1, "), "{stdout}");
    assert_eq!(verify(folder.path(), "").0, Some(1));
}

#[test]
fn an_invalid_manifest_is_refused_with_the_reason() {
    let folder = clip();
    let whole = fs::read(manifest_of(folder.path())).unwrap();
    let refused = |change: &dyn Fn(&mut Manifest), said: &str| {
        fs::write(manifest_of(folder.path()), &whole).unwrap();
        edit(folder.path(), |manifest| change(manifest));
        let (code, stdout, stderr) = verify(folder.path(), "");
        assert_eq!((code, &*stdout), (Some(2), ""), "{stderr}");
        assert!(stderr.contains("cannot judge clip/manifest.json: "), "{stderr}");
        assert!(stderr.contains(said), "{stderr}");
    };
    let altered = "its recording or drawing was altered";
    refused(&|manifest| manifest.recording.push(' '), altered);
    refused(&|manifest| manifest.drawing.scale = 0.75, altered);
    for schema in [1, 9] {
        let said = format!(
            "it is of schema {schema}, and this program reads 2; capture again, with --force"
        );
        refused(&|manifest| manifest.schema = schema, &said);
    }
    refused(
        &|manifest| manifest.frames[1].file = "../x.png".into(),
        "in the place of frame-000001",
    );
    type Change = fn(&mut Manifest);
    let rehashed: [(Change, &str); 4] = [
        (|it| it.drawing.selected = Some("rk5".into()), "this program has no method \"rk5\""),
        (|it| it.drawing.scale = 0.0, "its scale is out of range"),
        (|it| it.drawing.fps = 0, "its fps is out of range"),
        (|it| it.recording = it.recording.replace("rk4", "rk5"), "cannot read the recording: "),
    ];
    for (change, said) in rehashed {
        let rehash = |manifest: &mut Manifest| {
            change(manifest);
            manifest.settings_hash = manifest.hash();
        };
        refused(&rehash, said);
    }
    refused(&|manifest| drop(manifest.frames.pop()), "it lists 6 frames of 7");
    refused(
        &|manifest| {
            manifest.frames.pop();
            manifest.complete = false;
        },
        "its capture was stopped after 6 of 7 frames; draw all frames with --bless",
    );
    for (text, said) in [("{", "it is not JSON"), ("{}", "does not name its schema")] {
        fs::write(manifest_of(folder.path()), text).unwrap();
        let (code, _, stderr) = verify(folder.path(), "");
        assert_eq!(code, Some(2));
        assert!(stderr.contains(said), "{stderr}");
    }
}

#[test]
fn another_driver_is_reported_and_judged_within_limits() {
    let folder = clip();
    edit(folder.path(), |manifest| manifest.adapter.name = "another card".into());
    let (code, stdout, stderr) = verify(folder.path(), "");
    assert_eq!(code, Some(0), "{stdout}{stderr}");
    assert!(stderr.starts_with("drawn then with another card ("), "{stderr}");
    let limits = ": a channel may differ by 2, in 1 pixel of 100 000 by more\n";
    assert!(stderr.contains(limits), "{stderr}");
    assert!(stdout.ends_with("pixels: same within the limits: 7 frames\n"), "{stdout}");
}

#[test]
fn letters_by_other_instructions_excuse_no_other_pixel() {
    let folder = clip();
    let others = |manifest: &mut Manifest| manifest.adapter.driver_info = "letters by hand".into();
    edit(folder.path(), others);
    let (code, stdout, stderr) = verify(folder.path(), "");
    assert_eq!(code, Some(0), "{stdout}{stderr}");
    assert!(stderr.contains(": a channel of a letter may differ by 2\n"), "{stderr}");
    // The corner of the top bar has no letter.
    let path = folder.path().join("clip/frame-000003.png");
    let mut picture = image::open(&path).unwrap().into_rgba8();
    picture.get_pixel_mut(0, 0).0[1] ^= 1;
    picture.save(&path).unwrap();
    edit(folder.path(), |manifest| manifest.frames[3].pixels = fingerprint(&picture));
    let (code, stdout, _) = verify(folder.path(), "");
    assert_eq!(code, Some(1), "{stdout}");
    let expected = "pixels: frame-000003.png: 1 pixel off, the worst by 1\n";
    assert!(stdout.contains(expected), "{stdout}");
    // Other limits are those of letters too.
    let (code, stdout, stderr) = verify(folder.path(), "--max-channel 9 --max-pixels 1");
    assert_eq!(code, Some(1), "{stdout}");
    let limits =
        ": a channel of a letter may differ by 9, and in 1 % of a frame's pixels by more than 1\n";
    assert!(stderr.contains(limits), "{stderr}");
}

#[test]
fn differences_never_replace_judged_or_foreign_frames() {
    let folder = clip();
    let frame = folder.path().join("clip/frame-000003.png");
    fs::copy(folder.path().join("clip/frame-000004.png"), &frame).unwrap();
    let before = fs::read(&frame).unwrap();
    let (code, _, stderr) = verify(folder.path(), "--diff clip");
    assert_eq!(code, Some(2), "{stderr}");
    assert!(
        stderr.contains("clip holds the frames that are judged; give another --diff"),
        "{stderr}"
    );
    assert!(fs::read(&frame).unwrap() == before);
    let other = folder.path().join("other");
    fs::create_dir(&other).unwrap();
    for name in ["manifest.json", "frame-000003.png"] {
        fs::copy(folder.path().join("clip").join(name), other.join(name)).unwrap();
    }
    let (code, _, stderr) = verify(folder.path(), "--diff other");
    assert_eq!(code, Some(2), "{stderr}");
    assert!(stderr.contains("other holds another capture; give another --diff"), "{stderr}");
    assert!(fs::read(other.join("frame-000003.png")).unwrap() == before);
    fs::create_dir(folder.path().join("off")).unwrap();
    fs::write(folder.path().join("off/frame-000003.png"), "mine").unwrap();
    let (code, _, stderr) = verify(folder.path(), "--diff off");
    assert_eq!(code, Some(2), "{stderr}");
    assert!(stderr.contains("off/frame-000003.png was not made by regatta"), "{stderr}");
    assert_eq!(fs::read(folder.path().join("off/frame-000003.png")).unwrap(), b"mine");
}

#[test]
fn blessed_frames_verify_as_the_same() {
    let folder = clip();
    let whole = fs::read(manifest_of(folder.path())).unwrap();
    let frame = folder.path().join("clip/frame-000001.png");
    fs::write(&frame, "broken").unwrap();
    edit(folder.path(), |manifest| manifest.lanes[0]["hash"] = "other".into());
    assert_eq!(verify(folder.path(), "").0, Some(1));
    let (code, stdout, stderr) = verify(folder.path(), "--bless");
    assert_eq!((code, &*stdout), (Some(0), ""), "{stderr}");
    assert!(stderr.starts_with("wrote 7 frames, 64x36"), "{stderr}");
    assert_eq!(verify(folder.path(), "").0, Some(0));
    assert!(fs::read(manifest_of(folder.path())).unwrap() == whole);
}

/// Edits each leaf of a value in turn, and calls `with` on the path of the leaf.
fn edit_leaves(value: &mut Value, path: &str, with: &mut dyn FnMut(&str, &mut Value)) {
    match value {
        Value::Object(entries) => {
            for (key, value) in entries.iter_mut() {
                edit_leaves(value, &format!("{path}.{key}"), with);
            }
        }
        Value::Array(entries) => {
            for (n, value) in entries.iter_mut().enumerate() {
                edit_leaves(value, &format!("{path}[{n}]"), with);
            }
        }
        leaf => with(path, leaf),
    }
}

/// Another value of the same kind.
fn altered(leaf: &Value) -> Value {
    match leaf {
        Value::Null => 3.into(),
        Value::Bool(flag) => (!flag).into(),
        Value::String(text) => format!("{text}0").into(),
        Value::Number(number) => match (number.as_u64(), number.as_f64()) {
            (Some(whole), _) => (whole + 1).into(),
            (None, Some(number)) => (number + number.abs().max(1e-9) / 1024.0).into(),
            _ => unreachable!("{number}"),
        },
        _ => unreachable!("{leaf}"),
    }
}

#[test]
fn each_edited_leaf_of_a_manifest_is_found() {
    let folder = tempfile::tempdir().unwrap();
    let capture =
        "capture --scene spring --method rk4 --frames 3 --size 64x36 --scale 0.5 --out clip";
    assert_eq!(run_in(folder.path(), capture).status.code(), Some(0));
    let text = fs::read_to_string(manifest_of(folder.path())).unwrap();
    let whole: Value = serde_json::from_str(&text).unwrap();
    let mut leaves = Vec::new();
    edit_leaves(&mut whole.clone(), "", &mut |path, leaf| {
        leaves.push((path.to_owned(), leaf.clone()))
    });
    assert!(leaves.len() > 50, "{leaves:?}");
    for (wanted, was) in &leaves {
        let mut edited = whole.clone();
        edit_leaves(&mut edited, "", &mut |path, leaf| {
            if path == wanted {
                *leaf = altered(leaf);
            }
        });
        fs::write(manifest_of(folder.path()), edited.to_string()).unwrap();
        for arguments in ["", "--physics-only"] {
            let (code, stdout, stderr) = verify(folder.path(), arguments);
            let said = stdout + &stderr;
            let is_exempt = wanted == ".regatta"
                || wanted.starts_with(".adapter")
                || arguments == "--physics-only" && wanted.ends_with(".pixels");
            assert_eq!(code == Some(0), is_exempt, "{wanted} ({was}) {arguments}: {said}");
            if wanted.starts_with(".lanes") || wanted.starts_with(".frames") && !is_exempt {
                let leaf = wanted.rsplit(['.', '[']).find(|word| !word.ends_with(']')).unwrap();
                let leaf = leaf
                    .replace("halted", "halt")
                    .replace("file", "frame-")
                    .replace("pixels", "hash");
                assert!(said.contains(&leaf), "{wanted} {arguments}: {said}");
            }
        }
    }
}

#[test]
fn frames_without_a_place_or_an_end_are_named() {
    let folder = clip();
    let frame = |n: u32| folder.path().join(format!("clip/frame-{n:06}.png"));
    let whole = fs::read(frame(2)).unwrap();
    for file in [&whole[..whole.len() - 1], &[&whole[..], b"more"].concat()] {
        fs::write(frame(2), file).unwrap();
        let (code, stdout, _) = verify(folder.path(), "");
        assert_eq!(code, Some(1));
        assert!(stdout.contains("frame-000002.png: ") && !stdout.contains("same: 7"), "{stdout}");
    }
    fs::write(frame(2), &whole).unwrap();
    for surplus in ["frame-000012.png", "frame-12.png"] {
        let path = folder.path().join("clip").join(surplus);
        fs::write(&path, &whole).unwrap();
        let (code, stdout, _) = verify(folder.path(), "");
        assert_eq!(code, Some(1));
        let named = format!("{surplus}: no frame of the manifest has this name");
        assert!(stdout.contains(&named), "{stdout}");
        fs::remove_file(path).unwrap();
    }
}
