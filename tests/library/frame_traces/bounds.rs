//! Bounds of logs in frames, programs, columns and time, and names in every encoding.

use regatta::loops::trace_file::{from_bytes, read};

use super::frames;

#[test]
fn times_that_no_clock_holds_are_refused_with_their_row() {
    let generated = "g,X,86399999,86399999\n".repeat(107_000);
    for head in ["MsBetweenPresents,MsBetweenDisplayChange", "MsFrameTime,MsDisplayedTime"] {
        let text = format!("Application,FrameType,{head}\ng,Application,16,16\n{generated}");
        let error = read("log", &text).err().unwrap();
        assert!(error.to_string().contains("more than a year in all; split the log"), "{error}");
        assert!((360..375).contains(&error.line), "{head}: {error}");
    }
}

#[test]
fn a_log_is_bounded_in_frames_and_programs() {
    let list = "9\n".repeat(1_100_000);
    let error = read("log", &list).err().unwrap().to_string();
    assert_eq!(error, "log:1048577: the log has more than 1048576 frames; split it");
    let rows: String = (0..1100).map(|n| format!("g{n},9,9\n")).collect();
    let head = "Application,MsBetweenPresents,MsBetweenDisplayChange\n";
    let error = read("log", &format!("{head}{rows}")).err().unwrap().to_string();
    assert!(error.starts_with("log:1002: the log has more than 1000 programs"), "{error}");
}

#[test]
#[cfg(feature = "serde")]
fn a_json_capture_costs_only_its_known_columns() {
    let capture = |data: &str| format!("{{\"Runs\":[{{\"CaptureData\":{{{data}}}}}]}}");
    let unknown: String = (0..200_000).map(|n| format!("\"k{n}\":[1],")).collect();
    let text = capture(&format!("{unknown}\"MsBetweenPresents\":[9, 8]"));
    // Comparing each key with each would take minutes.
    assert_eq!(frames(&read("log", &text).unwrap()[0]).len(), 2);
    let long = capture(&format!("\"MsBetweenPresents\":[{}9]", "9,".repeat(1_100_000)));
    let error = read("log", &long).err().unwrap().to_string();
    assert!(error.contains("more than 1048576 frames; split it"), "{error}");
    // A program's name is in every row, so that a long one would fill the memory.
    let (name, cells) = ("n".repeat(100_000), "9,".repeat(50_000));
    let text = capture(&format!("\"MsBetweenPresents\":[{cells}9]"));
    let text = text.replacen('{', &format!("{{\"Info\":{{\"ProcessName\":\"{name}\"}},"), 1);
    assert_eq!(frames(&read("log", &text).unwrap()[0]).len(), 50_001);
}

#[test]
fn a_log_of_capframex_has_its_name_in_every_encoding() {
    let text = "//GameName=g\r\n//ProcessName=g.exe\r\nMsBetweenPresents,MsBetweenDisplayChange,Dropped\r\n\
                16,16,0\r\n16,16,0\r\n16,16,0\r\n";
    let utf_16 = |mark: u16, order: fn(u16) -> [u8; 2]| -> Vec<u8> {
        std::iter::once(mark).chain(text.encode_utf16()).flat_map(order).collect()
    };
    let marked = [b"\xef\xbb\xbf", text.as_bytes()].concat();
    for bytes in
        [text.into(), marked, utf_16(0xfeff, u16::to_le_bytes), utf_16(0xfeff, u16::to_be_bytes)]
    {
        let summary = from_bytes("log", &bytes).unwrap()[0].summary().unwrap();
        assert!(summary.contains("(CapFrameX)"), "{summary}");
    }
}
