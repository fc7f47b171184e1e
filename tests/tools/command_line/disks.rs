//! Disks that are full, or may not be written to.

use std::path::Path;
use std::process::{Command, Stdio};
use std::{fs, iter};

use super::{dimensions, names, run_in, stderr};

/// A disk in memory, which is taken away in the end.
pub(crate) struct Disk<'a>(&'a Path);

impl<'a> Disk<'a> {
    /// Mounts a disk of this size at a place that is not there yet; `None` where that is not allowed.
    pub(crate) fn mount(place: &'a Path, size: &str) -> Option<Self> {
        fs::create_dir(place).unwrap();
        let disk = Self(place);
        disk.has(&format!("size={size}")).then_some(disk)
    }

    /// Whether it has these options from now on.
    fn has(&self, options: &str) -> bool {
        let mut mount = Command::new("mount");
        mount.args(["-t", "tmpfs", "-o", options, "tmpfs"]).arg(self.0).stderr(Stdio::null());
        mount.status().is_ok_and(|status| status.success())
    }
}

impl Drop for Disk<'_> {
    fn drop(&mut self) {
        let _ = Command::new("umount").arg(self.0).stderr(Stdio::null()).status();
    }
}

pub(crate) fn an_unwritable_clip_is_a_failed_run() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path().join("clip");
    let disk = Disk::mount(&place, "2m").unwrap();
    run_in(folder.path(), "capture --scene spring --frames 2 --size 16x16 --out clip");
    assert!(disk.has("remount,ro"));
    let blessed = run_in(folder.path(), "verify clip --bless");
    assert_eq!(blessed.status.code(), Some(1), "{}", stderr(&blessed));
    let said = stderr(&blessed);
    assert!(said.contains("Read-only file system"), "{said}");
    assert!(said.contains("; make it one that you may write to"), "{said}");
    let judged = run_in(folder.path(), "verify clip");
    assert_eq!(judged.status.code(), Some(0), "{}", stderr(&judged));
}

pub(crate) fn a_full_disk_leaves_no_partial_file_and_a_remedy() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path().join("disk");
    let _disk = Disk::mount(&place, "64k").unwrap();
    let run = "capture --scene harbour --race --frames 30 --size 320x180 --out disk/run.";
    for format in ["gif", "y4m", "png"] {
        let output = run_in(folder.path(), &format!("{run}{format}"));
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(1), "{said}");
        assert!(said.contains("No space left on device"), "{said}");
        let way_on = "free some space, or give another --out; nothing is left of it, and the same \
                      command writes all of it";
        assert!(said.contains(way_on), "{said}");
        assert!(!said.contains(".part"), "{said}");
        assert_eq!(names(&place), [""; 0]);
    }
}

pub(crate) fn a_full_disk_ends_the_capture_with_whole_frames_only() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path().join("clip");
    let _disk = Disk::mount(&place, "2m").unwrap();
    let capture = "capture --scene harbour --race --frames 400 --size 640x360 --out clip";
    let output = run_in(folder.path(), capture);
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("No space left on device"), "{said}");
    assert!(said.contains("free some space, or give another --out"), "{said}");
    assert!(said.contains("the same command with --force draws all frames"), "{said}");
    let left = names(&place);
    let expected = (0..left.len()).map(|n| format!("frame-{n:06}.png"));
    assert!(left.iter().cloned().eq(expected), "{left:?}");
    let sizes = left.iter().map(|name| dimensions(&place.join(name)));
    assert!(!left.is_empty() && sizes.eq(iter::repeat_n((640, 360), left.len())));
}
