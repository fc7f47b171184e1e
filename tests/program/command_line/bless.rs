//! `verify --bless`: after any interruption there is a whole clip, the old one or the new one.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use tempfile::TempDir;

#[cfg(unix)]
use super::mishaps::XorShift;
#[cfg(unix)]
use super::{ended_by, start};
use super::{run_in, stderr};

type Content = BTreeMap<String, Vec<u8>>;

/// Files of the clip by name, and the names of all other files in the directory.
fn content(folder: &Path) -> Content {
    let entries = fs::read_dir(folder.join("clip")).unwrap().map(|entry| entry.unwrap());
    let read = |path: &Path| if path.is_dir() { Vec::new() } else { fs::read(path).unwrap() };
    entries.map(|e| (e.file_name().into_string().unwrap(), read(&e.path()))).collect()
}

fn restore(folder: &Path, content: &Content) {
    let clip = folder.join("clip");
    fs::remove_dir_all(&clip).unwrap();
    fs::create_dir(&clip).unwrap();
    for (name, bytes) in content {
        fs::write(clip.join(name), bytes).unwrap();
    }
}

/// A clip to bless, next to a foreign file: its folder, its content before and after blessing, and the duration.
fn clip() -> (TempDir, Content, Content, Duration) {
    let folder = tempfile::tempdir().unwrap();
    let capture = "capture --scene spring --race --frames 12 --size 64x36 --scale 0.5 --out clip";
    let output = run_in(folder.path(), capture);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    fs::write(folder.path().join("clip/notes.txt"), "mine").unwrap();
    let new = content(folder.path());
    let mut old = new.clone();
    let manifest = String::from_utf8(old["manifest.json"].clone()).unwrap();
    let manifest = manifest.replacen("\"driver_info\": \"", "\"driver_info\": \"old ", 1);
    old.insert("manifest.json".into(), manifest.into_bytes());
    old.insert("frame-000001.png".into(), b"old".to_vec());
    assert!(old["manifest.json"] != new["manifest.json"]);
    restore(folder.path(), &old);
    let begin = Instant::now();
    let blessed = run_in(folder.path(), "verify clip --bless");
    assert_eq!(blessed.status.code(), Some(0), "{}", stderr(&blessed));
    assert!(content(folder.path()) == new);
    (folder, old, new, begin.elapsed())
}

#[cfg(unix)]
#[test]
fn killing_bless_leaves_the_old_clip_or_the_new_one() {
    let (folder, old, new, duration) = clip();
    let folder = folder.path();
    let mut random = XorShift::new();
    for _ in 0..8 {
        restore(folder, &old);
        let mut child = start(folder, "verify clip --bless");
        std::thread::sleep(Duration::from_micros(random.below(duration.as_micros() as u64)));
        // That is SIGKILL.
        child.kill().unwrap();
        child.wait().unwrap();
        let left = content(folder);
        let judged = run_in(folder, "verify clip --physics-only");
        assert!(content(folder) == left, "a judge changes nothing");
        if judged.status.code() == Some(2) {
            let said = stderr(&judged);
            assert!(said.contains("a --bless was interrupted while it replaced"), "{said}");
        } else {
            assert_eq!(judged.status.code(), Some(0), "{}", stderr(&judged));
            let is_frame = |name: &str| !name.starts_with(".regatta-bless");
            let left: Content = left.into_iter().filter(|(name, _)| is_frame(name)).collect();
            assert!(left == old || left == new, "{:?}", left.keys());
        }
        let blessed = run_in(folder, "verify clip --bless");
        assert_eq!(blessed.status.code(), Some(0), "{}", stderr(&blessed));
        assert!(content(folder) == new);
    }
}

#[cfg(unix)]
#[test]
fn interrupting_bless_keeps_the_old_clip() {
    let (folder, old, new, _) = clip();
    let folder = folder.path();
    let mut interrupted = 0;
    for _ in 0..5 {
        restore(folder, &old);
        let child = start(folder, "verify clip --bless");
        let is_begun = || content(folder).keys().any(|name| name.starts_with(".regatta-bless-"));
        while !is_begun() {
            std::thread::sleep(Duration::from_millis(1));
        }
        let output = ended_by("-INT", child);
        match output.status.code() {
            Some(0) => assert!(content(folder) == new),
            Some(130) => {
                interrupted += 1;
                assert!(content(folder) == old, "{:?}", content(folder).keys());
                let said = stderr(&output);
                assert!(said.starts_with("error: not blessed: interrupted after "), "{said}");
            }
            // It was stopped before it watched for that.
            _ => assert!(content(folder)["manifest.json"] == old["manifest.json"]),
        }
    }
    assert!(interrupted > 0, "every run was done before it was interrupted");
}

#[test]
fn verify_reports_an_interrupted_swap_and_bless_completes_it() {
    let (folder, old, new, _) = clip();
    let folder = folder.path();
    restore(folder, &old);
    let ready = folder.join("clip/.regatta-blessed");
    fs::create_dir(&ready).unwrap();
    for (name, bytes) in new.iter().filter(|(name, _)| **name != "notes.txt") {
        fs::write(ready.join(name), bytes).unwrap();
    }
    fs::rename(ready.join("frame-000000.png"), folder.join("clip/frame-000000.png")).unwrap();
    let before = content(folder);
    let judged = run_in(folder, "verify clip");
    assert_eq!(judged.status.code(), Some(2), "{}", stderr(&judged));
    let said = "a --bless was interrupted while it replaced the frames; --bless completes it";
    assert!(stderr(&judged).contains(said), "{}", stderr(&judged));
    assert!(content(folder) == before);
    let blessed = run_in(folder, "verify clip --bless");
    assert_eq!(blessed.status.code(), Some(0), "{}", stderr(&blessed));
    assert!(content(folder) == new);
}

#[test]
fn a_file_in_the_directory_of_a_swap_never_replaces_another() {
    let (folder, _, new, _) = clip();
    let folder = folder.path();
    let stray = folder.join("clip/.regatta-blessed");
    fs::create_dir(&stray).unwrap();
    fs::write(stray.join("notes.txt"), "not mine").unwrap();
    let mut expected = new.clone();
    expected.insert(".regatta-blessed".into(), Vec::new());
    // Without a manifest there is no swap to complete; with one, nothing strange may be in its way.
    for (has_manifest, judged) in [(false, 0), (true, 2)] {
        if has_manifest {
            fs::write(stray.join("manifest.json"), &new["manifest.json"]).unwrap();
        }
        for (command, code) in [("verify clip", judged), ("verify clip --bless", 2)] {
            let output = run_in(folder, command);
            let said = stderr(&output);
            assert_eq!(output.status.code(), Some(code), "{command}: {said}");
            assert!(content(folder) == expected, "{command}: {:?}", content(folder).keys());
            let strange = "clip/.regatta-blessed/notes.txt";
            let is_told = said.contains(&format!("{strange} was not made by regatta"));
            assert_eq!(is_told, command.ends_with("--bless"), "{said}");
            // The clip that is blessed cannot be another.
            assert!(!is_told || said.ends_with("is not replaced; move it away\n"), "{said}");
            let is_advised = said.contains(&format!("move {strange} away"));
            assert_eq!(is_advised, (command, code) == ("verify clip", 2), "{said}");
        }
        assert_eq!(fs::read(stray.join("notes.txt")).unwrap(), b"not mine");
    }
}
