//! `verify --report`: reports for programs and for a CI's list of tests, and the files that they never replace.

use std::fs;
use std::path::Path;

use serde_json::Value;

use super::regatta;
use super::verify::{clip, verify};

#[test]
fn reports_are_machine_readable() {
    let folder = clip();
    fs::remove_file(folder.path().join("clip/frame-000002.png")).unwrap();
    let report = |format: &str| {
        let (code, ..) = verify(folder.path(), &format!("--report {format} report"));
        assert_eq!(code, Some(1));
        fs::read_to_string(folder.path().join("report")).unwrap()
    };
    let json: Value = serde_json::from_str(&report("json")).unwrap();
    assert_eq!(json["same"], false);
    assert_eq!(json["physics"]["same"], true);
    assert_eq!(json["pixels"]["frames"], 7);
    assert_eq!(json["pixels"]["differences"][0]["file"], "frame-000002.png");
    let junit = report("junit");
    let suite = "<testsuite name=\"regatta verify clip\" tests=\"8\" failures=\"1\" errors=\"0\">";
    assert_eq!(junit.lines().nth(1), Some(suite));
    let failed = "<testcase classname=\"regatta\" name=\"frame-000002.png\"><failure message=\"";
    assert!(junit.contains(failed), "{junit}");
    assert_eq!(junit.matches("<testcase ").count(), 8);
}

#[test]
fn two_reports_are_two_files() {
    let folder = clip();
    let reports = "--physics-only --report junit a.xml --report json b.json";
    let (code, _, stderr) = verify(folder.path(), reports);
    assert_eq!((code, &*stderr), (Some(0), ""));
    let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    assert!(read("a.xml").contains("<testsuite "), "{}", read("a.xml"));
    assert!(serde_json::from_str::<Value>(&read("b.json")).unwrap()["same"] == true);
}

#[test]
fn an_unwritable_report_names_its_own_option() {
    let folder = clip();
    let (code, stdout, stderr) = verify(folder.path(), "--physics-only --report json no/x");
    assert_eq!((code, &*stdout), (Some(1), ""), "the place is looked at first: {stderr}");
    let (in_a_folder, findings, why) = verify(folder.path(), "--physics-only --report junit clip");
    assert_eq!((in_a_folder, &*findings), (Some(2), ""), "{why}");
    assert!(why.contains("clip is a directory; give --report a file"), "{why}");
    let remedy = "; give another --report, in a directory that is there\n";
    assert!(stderr.ends_with(remedy), "{stderr}");
}

#[test]
fn a_report_never_replaces_a_file_of_a_capture() {
    let folder = clip();
    fs::create_dir(folder.path().join("other")).unwrap();
    for name in ["manifest.json", "frame-000002.png"] {
        let [from, to] = ["clip", "other"].map(|clip| folder.path().join(clip).join(name));
        fs::copy(from, to).unwrap();
    }
    fs::remove_file(folder.path().join("clip/frame-000003.png")).unwrap();
    for name in [
        "clip/manifest.json",
        "clip/frame-000002.png",
        "clip/../clip/frame-000003.png",
        "other/manifest.json",
        "other/frame-000002.png",
    ] {
        let path = folder.path().join(name);
        let before = fs::read(&path).ok();
        let (code, stdout, stderr) = verify(folder.path(), &format!("--report junit {name}"));
        assert_eq!((code, &*stdout), (Some(2), ""), "{stderr}");
        let said = format!("{name} is a file of a capture; give another --report");
        assert!(stderr.contains(&said), "{stderr}");
        assert!(fs::read(&path).ok() == before, "{name}");
    }
    let (code, _, stderr) = verify(folder.path(), "--physics-only --report junit clip/report.xml");
    assert_eq!(code, Some(0), "{stderr}");
}

#[cfg(unix)]
#[test]
fn a_report_through_a_symbolic_link_is_written_to_its_target() {
    let folder = clip();
    let [link, target] = ["link", "target"].map(|name| folder.path().join(name));
    fs::write(&target, "").unwrap();
    std::os::unix::fs::symlink("target", &link).unwrap();
    let (code, _, stderr) = verify(folder.path(), "--physics-only --report junit link");
    assert_eq!(code, Some(0), "{stderr}");
    assert_eq!(fs::read_link(link).unwrap(), Path::new("target"));
    assert!(fs::read_to_string(target).unwrap().contains("<testsuite "));
}

#[cfg(target_os = "linux")]
#[test]
fn a_report_to_standard_output_is_appended() {
    let folder = clip();
    let log = folder.path().join("log");
    let status = regatta()
        .current_dir(folder.path())
        .args("verify clip --physics-only --report junit /dev/stdout".split(' '))
        .stdout(fs::File::options().append(true).create(true).open(&log).unwrap())
        .status();
    assert!(status.unwrap().success());
    let log = fs::read_to_string(log).unwrap();
    assert!(log.starts_with("physics: same to the bit: "), "{log}");
    assert!(log.ends_with("</testsuite>\n"), "{log}");
}
