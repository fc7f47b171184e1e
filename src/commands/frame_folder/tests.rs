//! Frame folders with all kinds of existing content.

use super::*;
use crate::view::png;

fn inspect(path: &Path, existing: FolderPolicy) -> Result<FrameFolder, Error> {
    FrameFolder::inspect(path, existing, PlaceOf::Option("--out"))
}

/// Returns a picture of one grey pixel, encoded as in a capture.
fn frame(grey: u8) -> Vec<u8> {
    png::encode([1, 1], &[grey, grey, grey, 255])
}

fn names(folder: &Path) -> Vec<OsString> {
    let mut names: Vec<_> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    names
}

#[test]
fn a_folder_in_use_is_refused_untouched() {
    let parent = tempfile::tempdir().unwrap();
    let path = parent.path().join("clip");
    fs::create_dir(&path).unwrap();
    assert!(inspect(&path, FolderPolicy::Refuse).is_ok());
    fs::write(path.join("frame-000000.png"), "old").unwrap();
    let error = inspect(&path, FolderPolicy::Refuse).unwrap_err();
    assert!(error.is_mistake() && error.to_string().contains("is not empty"), "{error}");
    assert_eq!(fs::read(path.join("frame-000000.png")).unwrap(), b"old");
}

#[test]
fn frames_replace_only_frames() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name);
    for name in ["frame-000000.png", "frame-000001.png", "frame-000001.png.regatta-a1B2c3.part"] {
        fs::write(file(name), frame(0)).unwrap();
    }
    for name in ["frame-000001.png.part", "manifest.json.part", "notes.txt"] {
        fs::write(file(name), "mine").unwrap();
    }
    let mut frames = inspect(folder.path(), FolderPolicy::Replace).unwrap();
    frames.clear().unwrap();
    frames.push(&frame(1)).unwrap();
    let others = ["frame-000001.png.part", "manifest.json.part", "notes.txt"];
    assert_eq!(names(folder.path()), [&["frame-000000.png"], &others[..]].concat());
    assert_eq!(fs::read(file("frame-000000.png")).unwrap(), frame(1));
    assert_eq!(frames.others(), others);
    assert!(frames.range().ends_with("frame-000000.png"), "{}", frames.range());
    frames.finish("{}").unwrap();
    for name in others {
        assert_eq!(fs::read(file(name)).unwrap(), b"mine", "{name}");
    }
}

#[test]
fn only_leftovers_of_a_killed_capture_are_removed() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        path
    };
    for name in [
        "frame-000001.png.regatta-a1B2c3.part",
        ".regatta-bless-a1B2c3/frame-000000.png",
        ".regatta-bless-a1B2c3/frame-000001.png.regatta-d4E5f6.part",
    ] {
        fs::write(at(name), frame(0)).unwrap();
    }
    fs::write(at("manifest.json.regatta-a1B2c3.part"), "").unwrap();
    let kept = [
        ".regatta-bless-backup/thesis.txt",
        ".regatta-bless-mine/thesis.txt",
        "frame-000000.png.backup.part",
        "frame-000002.png.regatta-backup.part",
        "manifest.json.backup.part",
    ];
    for name in kept {
        fs::write(at(name), "mine").unwrap();
    }
    // The file is a copy of one of our frames.
    fs::write(at(kept[2]), frame(0)).unwrap();
    let mut frames = inspect(folder.path(), FolderPolicy::Replace).unwrap();
    frames.clear().unwrap();
    frames.finish("{}").unwrap();
    for name in kept {
        let expected = if name == kept[2] { frame(0) } else { b"mine".to_vec() };
        assert_eq!(fs::read(folder.path().join(name)).unwrap(), expected, "{name}");
    }
    let mut left = kept.map(|name| OsString::from(name.split('/').next().unwrap())).to_vec();
    left.push("manifest.json".into());
    left.sort();
    assert_eq!(names(folder.path()), left);
}

#[test]
fn foreign_files_with_our_names_are_never_touched() {
    for existing in [FolderPolicy::Replace, FolderPolicy::Bless] {
        for (name, bytes) in [
            ("manifest.json", &br#"{"name":"my web app","version":"1"}"#[..]),
            ("frame-000003.png", b"a frame of another program"),
        ] {
            let folder = tempfile::tempdir().unwrap();
            fs::write(folder.path().join("frame-000000.png"), frame(0)).unwrap();
            fs::write(folder.path().join(name), bytes).unwrap();
            let error = inspect(folder.path(), existing).unwrap_err();
            assert!(
                error.is_mistake() && error.to_string().contains("was not made by regatta"),
                "{error}"
            );
            assert!(error.to_string().contains(name), "{error}");
            assert_eq!(fs::read(folder.path().join(name)).unwrap(), bytes);
        }
    }
}

#[test]
fn a_folder_has_one_writer_at_a_time() {
    let parent = tempfile::tempdir().unwrap();
    let path = parent.path().join("clip");
    let [mut first, mut second] = [0, 1].map(|_| inspect(&path, FolderPolicy::Replace).unwrap());
    first.clear().unwrap();
    for busy in [second.clear().unwrap_err(), inspect(&path, FolderPolicy::Refuse).unwrap_err()] {
        assert!(
            busy.is_mistake() && busy.to_string().contains("another regatta is writing"),
            "{busy}"
        );
    }
    first.push(&frame(0)).unwrap();
    drop(first);
    second.clear().unwrap();
    assert!(names(&path).is_empty(), "the second found what the first had left");
}

#[test]
fn a_folder_filled_during_the_wait_is_refused() {
    let parent = tempfile::tempdir().unwrap();
    let path = parent.path().join("clip");
    let [mut first, mut second] = [0, 1].map(|_| inspect(&path, FolderPolicy::Refuse).unwrap());
    first.clear().unwrap();
    first.push(&frame(0)).unwrap();
    first.finish("{}").unwrap();
    let error = second.clear().unwrap_err();
    assert!(error.is_mistake() && error.to_string().contains("is not empty"), "{error}");
}

#[test]
fn a_frame_that_cannot_be_written_leaves_nothing_behind() {
    let parent = tempfile::tempdir().unwrap();
    let mut frames = inspect(parent.path(), FolderPolicy::Refuse).unwrap();
    frames.clear().unwrap();
    // A file cannot replace a directory that has its name.
    fs::create_dir_all(parent.path().join("frame-000001.png/in the way")).unwrap();
    frames.push(&frame(0)).unwrap();
    let error = frames.push(&frame(0)).unwrap_err().to_string();
    assert!(error.starts_with("cannot write "), "{error}");
    assert!(error.contains("frame-000001.png: "), "{error}");
    assert_eq!(names(parent.path()), ["frame-000000.png", "frame-000001.png"]);
    assert!(frames.range().ends_with("frame-000000.png"), "{}", frames.range());
}

#[test]
fn a_file_in_the_way_is_no_folder() {
    let parent = tempfile::tempdir().unwrap();
    let path = parent.path().join("clip");
    fs::write(&path, "mine").unwrap();
    let error = inspect(&path, FolderPolicy::Replace).unwrap_err();
    assert!(error.is_mistake() && error.to_string().contains("is not a directory"), "{error}");
}

#[test]
fn a_name_in_use_gets_the_next_free_number() {
    let parent = tempfile::tempdir().unwrap();
    let name = parent.path().join("frames").display().to_string();
    assert_eq!(FrameFolder::new_sibling(&name).unwrap().path(), Path::new(&name));
    fs::create_dir(&name).unwrap();
    fs::write(Path::new(&name).join("mine"), "").unwrap();
    fs::write(format!("{name}-2"), "a file").unwrap();
    let third = format!("{name}-3");
    assert_eq!(FrameFolder::new_sibling(&name).unwrap().path(), Path::new(&third));
}
