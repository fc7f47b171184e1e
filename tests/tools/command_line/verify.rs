//! `verify` on frames that a graphics device has drawn.

use super::{run_in, stderr};

pub(crate) fn frames_from_a_device_verify_within_the_limits() {
    let folder = tempfile::tempdir().unwrap();
    let capture = "capture --scene harbour --race --frames 9 --fps 3 --size 640x360 --renderer gpu";
    let output = run_in(folder.path(), &format!("{capture} --out clip"));
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let output = run_in(folder.path(), "verify clip");
    let (stdout, said) = (String::from_utf8_lossy(&output.stdout), stderr(&output));
    assert_eq!(output.status.code(), Some(0), "{stdout}{said}");
    assert!(said.starts_with("drawn then with "), "{said}");
    assert!(said.contains(", now with regatta (cpu, "), "{said}");
    assert!(stdout.starts_with("physics: same to the bit: "), "{stdout}");
}
