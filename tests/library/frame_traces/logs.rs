//! The logs of each tool, their units, and the columns next to their times.

use std::time::Instant;

use regatta::loops::trace_file::{from_bytes, read};

use super::{frames, traces};

/// The one-line summary of a log, and the starts of its frames in ms.
fn summed(text: &str) -> (String, Vec<f64>) {
    let [trace] = &traces("log", text)[..] else { panic!("one trace") };
    let began = frames(trace).iter().map(|frame| frame.began_ns as f64 / 1e6).collect();
    (trace.summary().expect("a log"), began)
}

#[test]
fn a_list_of_times_is_read_with_or_without_heading_in_any_unit() {
    let expected = vec![0.0, 16.6, 50.0];
    for (text, unit) in [
        ("# level 3\nframe_ms\n16.7\n16.6\n33.4\n", ""),
        ("16.7\n16.6\n33.4\n", ""),
        ("0.0167\n0.0166\n0.0334\n", ", in seconds"),
        ("delta_s\n0.0167\n0.0166\n0.0334\n", ", in seconds"),
        ("dt\n0.0167\n0.0166\n0.0334\n", ", in seconds"),
        ("frametime_us\n16700\n16600\n33400\n", ", in µs"),
        ("16700\n16600\n33400\n", ", in µs"),
    ] {
        let (said, began) = summed(text);
        assert_eq!(began, expected, "{text}");
        let wanted =
            format!("read 3 frames in 0.0667 s: 45.0 a second, longest 33.4 ms (a list{unit})");
        assert_eq!(said, wanted, "{text}");
    }
    assert!(read("log", "temperature\n16.7\n").is_err(), "whatever it is, it is no time");
}

#[test]
fn mangohuds_unit_follows_from_its_fps_and_sampled_logs_are_refused() {
    let (said, began) =
        summed("fps,frametime,cpu_load\n190.114,5260,10\n200,5000,11\n100,10000,9\n");
    assert_eq!(began, [0.0, 5.0, 15.0]);
    assert!(said.ends_with("(MangoHud, in µs)"), "{said}");
    let elapsed = |step_ms: f64| {
        let row = |n: u32| format!("250,4.0,{}\n", (f64::from(n) * step_ms * 1e6) as u64);
        format!("fps,frametime,elapsed\n{}", (0..50).map(row).collect::<String>())
    };
    assert_eq!(summed(&elapsed(4.0)).1.len(), 50);
    assert!(
        summed("n,Frame Time (s),cpu\n1,0.008,3\n2,0.008,4\n").0.ends_with("(a list, in seconds)")
    );
    let error = read("log", &elapsed(100.0)).err().unwrap().to_string();
    assert!(error.contains("samples every 100 ms (log_interval)"), "{error}");
}

#[test]
fn a_frame_without_display_time_counts_as_dropped() {
    let text = "TimeInSeconds,MsBetweenPresents,MsBetweenDisplayChange,MsUntilDisplayed\n\
                0.000,7,14,15\n0.007,7,7,15\n0.014,7,14,NA\n0.021,7,0,15\n";
    let [trace] = &traces("log", text)[..] else { panic!("one trace") };
    let ms = |ms: i64| ms * 1_000_000;
    let displayed: Vec<_> = frames(trace).iter().map(|frame| frame.displayed_ns).collect();
    assert_eq!(displayed, [Some(ms(15)), Some(ms(22)), None, Some(ms(36))]);
    assert!(trace.has_one_clock() && trace.missing_display().is_none());
    assert!(trace.summary().unwrap().contains(", 1 never displayed (PresentMon)"));
}

#[test]
fn an_afterburner_log_is_refused_by_name() {
    let text = "00, 24-10-2025 15:41:23, Hardware monitoring log v1.6 \n\
                02, 24-10-2025 15:41:23, Power               ,Framerate           ,Frametime           \n\
                80, 24-10-2025 15:41:24, 143.1               ,99.691              ,10.031              \n";
    let error = read("log", text).err().unwrap().to_string();
    assert!(error.contains("a log of MSI Afterburner has a sample a second"), "{error}");
}

/// Small logs of ten frames as each tool writes them. In two logs, one frame was never displayed.
const OF_TOOLS: [(&str, &str, &str); 11] = [
    (
        "presentmon-1.csv",
        include_str!("../../data/frame-traces/tools/presentmon-1.csv"),
        "PresentMon 1",
    ),
    (
        "presentmon-2.csv",
        include_str!("../../data/frame-traces/tools/presentmon-2.csv"),
        "PresentMon 2",
    ),
    ("ocat.csv", include_str!("../../data/frame-traces/tools/ocat.csv"), "OCAT"),
    ("capframex.csv", include_str!("../../data/frame-traces/tools/capframex.csv"), "CapFrameX"),
    ("capframex.json", include_str!("../../data/frame-traces/tools/capframex.json"), "CapFrameX"),
    ("frameview.csv", include_str!("../../data/frame-traces/tools/frameview.csv"), "FrameView"),
    ("mangohud.csv", include_str!("../../data/frame-traces/tools/mangohud.csv"), "MangoHud"),
    (
        "mangohud-0.6.csv",
        include_str!("../../data/frame-traces/tools/mangohud-0.6.csv"),
        "MangoHud, in µs",
    ),
    ("unreal.csv", include_str!("../../data/frame-traces/tools/unreal.csv"), "Unreal"),
    ("fraps.csv", include_str!("../../data/frame-traces/tools/fraps.csv"), "FRAPS"),
    ("times.txt", include_str!("../../data/frame-traces/tools/times.txt"), "a list"),
];

#[test]
fn every_tool_in_the_manual_has_a_log_of_the_same_ten_frames() {
    for (name, text, tool) in OF_TOOLS {
        let read = traces(name, text);
        assert_eq!(read.len(), 1, "{name}");
        let never = if name.starts_with("presentmon") { ", 1 never displayed" } else { "" };
        // A list has the time of its first frame, and the others say how long after the one before it began.
        let is_list = ["a list", "MangoHud"].iter().any(|list| tool.starts_with(list));
        let lasted = if is_list { "0.183 s: 54.5 a second" } else { "0.167 s: 54.0 a second" };
        let summary = format!("read 10 frames in {lasted}, longest 33.4 ms{never} ({tool})");
        assert_eq!(read[0].summary(), Some(summary), "{name}");
        // In each unit the frames begin at the same nanosecond, to the digits that the tool writes.
        let began: Vec<i64> = frames(&read[0]).iter().map(|frame| frame.began_ns).collect();
        let wanted: Vec<i64> = frames(&traces(OF_TOOLS[0].0, OF_TOOLS[0].1)[0])
            .iter()
            .map(|frame| frame.began_ns)
            .collect();
        for (began, wanted) in began.iter().zip(&wanted) {
            assert!((began - wanted).abs() <= 1000, "{name}: {began} and {wanted}");
        }
    }
}

#[test]
fn contradicting_times_of_a_log_are_reported() {
    let log = |header: &str, row: &dyn Fn(f64) -> String| {
        let rows: Vec<String> = (0..300).map(|n| row(f64::from(n))).collect();
        traces("log", &format!("{header}\n{}\n", rows.join("\n"))).remove(0)
    };
    let presentmon = "TimeInSeconds,MsBetweenPresents,MsBetweenDisplayChange";
    for (every_s, time, unit) in
        [(0.008, 8.0, ""), (0.008, 8000.0, ", in µs"), (0.008, 0.008, ", in seconds")]
    {
        let trace = log(presentmon, &|n| format!("{},{time},{time}", n * every_s));
        let said = trace.summary().unwrap();
        assert_eq!(
            said,
            format!("read 300 frames in 2.39 s: 125 a second, longest 8.00 ms (PresentMon{unit})")
        );
        assert_eq!(trace.missing_display(), None);
    }
    let late = presentmon.replace("TimeInSeconds", "Dropped,MsUntilDisplayed");
    for (header, row, told) in [
        (presentmon, (&|n| format!("{},8,8", n * 0.0084)) as &dyn Fn(f64) -> String, "own time"),
        ("CPUStartTime,FrameTime,DisplayedTime", &|n| format!("{},8,8", n * 10.0), "own time"),
        (&late, &|n| format!("0,{},8,8", 20.0 + 0.4 * n), "frame and display clocks"),
        ("fps,frametime,elapsed", &|n| format!("125,8,{}", n * 8.4e6), "own time"),
        ("fps,frametime", &|_| "250,8".into(), "frame rates contradict"),
        ("frame;fps;frametime (ms)", &|n| format!("{n};250;8,0"), "frame rates contradict"),
    ] {
        let trace = log(header, row);
        let said = trace.missing_display().unwrap_or_default();
        assert!(said.contains(told) && trace.has_one_clock(), "{header}: {said}");
    }
    for (header, row) in [
        (
            "CPUStartTime,FrameTime,DisplayedTime",
            (&|n| format!("{},8,8", n * 8.0)) as &dyn Fn(f64) -> String,
        ),
        ("CPUStartTime,FrameTime,DisplayedTime", &|n| format!("{},8,8", n * 0.008)),
        (&late, &|n| format!("0,{},8,8", 20.0 + n % 3.0)),
    ] {
        assert_eq!(log(header, row).missing_display(), None, "{header}");
    }
}

#[test]
fn the_first_mangohud_logged_no_frame_times() {
    let header = "fps,cpu_load,gpu_load,cpu_temp,elapsed";
    let log = |step_ns: u64| {
        let row = |n: u64| format!("125,5,90,60,{}\n", 3_000_000_000 + n * step_ns);
        format!("os,cpu,gpu\nA,B,C\n{header}\n{}", (0..50).map(row).collect::<String>())
    };
    let (said, began) = summed(&log(8_000_000));
    assert_eq!(
        said,
        "read 50 frames in 0.392 s: 125 a second, longest 8.00 ms (MangoHud before 0.6)"
    );
    assert_eq!(began[..3], [0.0, 8.0, 16.0]);
    let error = read("log", &log(100_000_000)).err().unwrap().to_string();
    assert!(error.contains("samples every 100 ms (log_interval)"), "{error}");
}

#[test]
fn unreals_footer_is_no_frame_and_fraps_counts_from_its_start() {
    let rows = "EVENTS,FrameTime,GameThreadTime\n,16,9\n,17,9\n";
    let of_build = "[Platform],Windows,[Config],Test,[HasHeaderRowAtEnd],0\n";
    assert_eq!(frames(&traces("a", &format!("{rows}{of_build}"))[0]).len(), 2);
    let began: Vec<i64> = frames(&traces("a", "Frame, Time (ms)\n1, 5.0\n2, 21.5\n")[0])
        .iter()
        .map(|it| it.began_ns)
        .collect();
    assert_eq!(began, [0, 16_500_000]);
    let error = read("a", "Frame, Time (ms)\n1, 5.0\n2, 4.0\n").err().unwrap().to_string();
    assert_eq!(error, "a:3: the frame begins before the one above it; put rows in order");
}

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
    let began = Instant::now();
    assert_eq!(frames(&read("log", &text).unwrap()[0]).len(), 2);
    // Comparing each key with each takes minutes.
    assert!(began.elapsed().as_secs() < 10);
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
        assert!(summary.ends_with("(CapFrameX)"), "{summary}");
    }
}
