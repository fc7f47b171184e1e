//! The logs of each tool, their units, and the columns next to their times.

use regatta::loops::FrameTrace;
use regatta::loops::trace_file::{from_table, read};
use regatta::table::{TableOptions, Unit};

use super::{frames, traces};

/// The one-line summary of a log, and the starts of its frames in ms.
fn summed(text: &str) -> (String, Vec<f64>) {
    let [trace] = &traces("log", text)[..] else { panic!("one trace") };
    let began = frames(trace).iter().map(|frame| frame.began_ns as f64 / 1e6).collect();
    (short(trace), began)
}

/// The summary of a trace, without the rows that were taken.
fn short(trace: &FrameTrace) -> String {
    let summary = trace.summary().expect("a log");
    summary.split("; rows ").next().unwrap().to_owned()
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
        assert_eq!(short(&read[0]), summary, "{name}");
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
        let said = short(&trace);
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

/// The summary of a log, or the reason why it is refused.
fn said_of(text: &str, options: &TableOptions) -> String {
    match from_table("log", text.as_bytes(), options) {
        Ok(traces) => traces[0].summary().unwrap(),
        Err(error) => error.to_string(),
    }
}

#[test]
fn a_list_or_table_is_read_by_its_size_heading_and_form() {
    let rows = |row: &dyn Fn(usize) -> String| (0..40).map(|n| row(n) + "\n").collect::<String>();
    // Every tenth frame lasts two refreshes of 60 Hz.
    let t_ms = |n: usize| (n + n / 10) as f64 * 1e3 / 60.0;
    let dt_ms = |n: usize| if n.is_multiple_of(10) && n > 0 { 1e3 / 30.0 } else { 1e3 / 60.0 };
    let of_day = |n: usize| format!("12:00:{:06.3}", t_ms(n) / 1e3);
    let (clock, size) = ("the times are those of a running clock", "by size");
    let frames = "55.8 a second";
    let clocks = "55.7 a second";
    for (text, told) in [
        (rows(&|n| format!("{:.7}", t_ms(n) / 1e3)), [clocks, clock, "in seconds, by size"]),
        (rows(&|n| format!("{:.3}", 105.0 + t_ms(n))), [clocks, clock, "in ms, by size"]),
        (rows(&|n| format!("{:.6}", 73e3 + t_ms(n) / 1e3)), [clocks, clock, size]),
        (rows(&|n| format!("{:.0}", 1e15 + 1e6 * t_ms(n))), [clocks, clock, "in ns, by size"]),
        (rows(&|n| of_day(n)), [clocks, clock, "by its form"]),
        (
            rows(&|n| format!("{:.0}", 1e6 * dt_ms(n))),
            [frames, "in ns, by size", "rows 1 to 40 of 40"],
        ),
        (rows(&|n| format!("{:.0}", 1e3 * dt_ms(n))), [frames, "in µs, by size", ""]),
        (
            format!("[{}]", rows(&|n| dt_ms(n).to_string()).trim_end().replace('\n', ",")),
            [frames, "in ms", ""],
        ),
        (
            format!("Frame Time (ns)\n{}", rows(&|n| format!("{:.0}", 1e6 * dt_ms(n)))),
            [frames, "in ns, by its heading", ""],
        ),
        (
            format!(
                "t_ms,frame_ms,fps,gpu\n{}",
                rows(&|n| format!("{},{},{},5", t_ms(n), dt_ms(n), 1e3 / dt_ms(n)))
            ),
            [frames, "left out: t_ms, gpu", "in ms, by its heading"],
        ),
        (
            format!("frame,ms\n{}", rows(&|n| format!("{n},{}", dt_ms(n)))),
            [frames, "in ms", "left out: frame"],
        ),
        (
            format!(
                "# n, end, frame time microseconds\n{}",
                rows(&|n| format!("{n},{},{}", t_ms(n), 1e3 * dt_ms(n)))
            ),
            [frames, "in µs, by its heading", "left out: n, end"],
        ),
        (
            format!("Frame,Timestamp\n{}", rows(&|n| format!("{n},{}", t_ms(n)))),
            [clocks, clock, "left out: Frame"],
        ),
        (rows(&|n| format!("{n} {}", t_ms(n))), [clocks, clock, "left out: 1"]),
        (
            format!(
                "Time (µs),Frame Interval (µs),Count\n{}",
                rows(&|n| format!("{},{},1", 1e3 * t_ms(n), 1e3 * dt_ms(n)))
            ),
            [frames, "in µs, by its heading", ""],
        ),
        (
            format!(
                "Time (µs),Frame Interval (µs),Count\n{}",
                rows(&|n| format!("{n},16667,{}", 9 + n % 2))
            ),
            ["a row is the mean of 9 to 10 frames (Count)", "", ""],
        ),
        (
            format!("Frame Time (jiffies)\n{}", rows(&|_| "16".into())),
            ["jiffies is no unit of time that is known", "--unit", ""],
        ),
        ("{\"traceEvents\": [{\"ph\": \"X\"}]}".into(), ["this is a trace of Chromium", "", ""]),
        ("{\"dt\": [16.7, 16.7, 33.4, 16.7]}".into(), ["4 frames in 0.0835 s", "in ms", ""]),
        ("{\"dt\": 16.7, \"at\": [1, 2]}\n\n{\"dt\": 16.7}".into(), ["2 frames", "at.0, at.1", ""]),
        (
            format!(
                "[{}]",
                rows(&|n| format!("{{\"dt\": {}}}", dt_ms(n))).trim_end().replace('\n', ",")
            ),
            [frames, "in ms", ""],
        ),
        (
            rows(&|n| format!("{{\"frame\": {{\"time_ms\": {}}}, \"n\": {n}}}", t_ms(n))),
            [clocks, clock, "left out: n"],
        ),
        (
            rows(&|n| format!("{:.3}", t_ms(n - n % 2))),
            ["27.8 a second", "20 rows have the time of the row before", clock],
        ),
    ] {
        let said = said_of(&text, &TableOptions::default());
        let first = text.lines().next().unwrap();
        assert!(told.iter().all(|part| said.contains(part)), "{first}: {said}");
    }
}

#[test]
fn a_caller_names_the_columns_the_unit_and_the_rows() {
    let row = |n: u32| {
        format!("{};{};{}\n", f64::from(n) * 0.02, if n.is_multiple_of(2) { "a" } else { "b" }, 20)
    };
    let text: String = (0..100).map(row).collect();
    let named = |name: &str| Some(name.to_owned());
    let usual = TableOptions { no_header: true, ..TableOptions::default() };
    for (options, told) in [
        (TableOptions { frame: named("3"), ..usual.clone() }, "read 100 frames in 2.00 s"),
        (TableOptions { clock: named("1"), ..usual.clone() }, "read 100 frames in 1.98 s"),
        (
            TableOptions { clock: named("1"), unit: Some(Unit::Milliseconds), ..usual.clone() },
            "in ms, as told",
        ),
        (
            TableOptions { frame: named("3"), rows: Some([11, 60]), ..usual.clone() },
            "rows 11 to 60 of 100",
        ),
        (
            TableOptions { clock: named("1"), window_s: [Some(0.5), Some(1.0)], ..usual.clone() },
            "rows 26 to 50 of 100",
        ),
        (
            TableOptions {
                clock: named("1"),
                filter: vec![("2".into(), "b".into())],
                ..usual.clone()
            },
            "read 50 frames in 1.96 s",
        ),
        (
            TableOptions { frame: named("gpu"), ..usual.clone() },
            "no column \"gpu\"; here are 1, 2, 3",
        ),
        (
            TableOptions { frame: named("3"), unit: Some(Unit::Ticks), ..usual },
            "frames are not counted in ticks",
        ),
    ] {
        let said = said_of(&text, &options);
        assert!(said.contains(told), "{options:?}: {said}");
    }
}

#[test]
fn records_of_android_are_read_by_both_of_their_clocks() {
    let at = |n: u64| 1_001_692_724_088_218 + n * 16_666_667;
    let row = |n: u64| format!("{},{},7,{},\n", u8::from(n == 3), at(n), at(n + 1));
    let rows: String = (0..50).map(row).collect();
    let mark = "---PROFILEDATA---";
    let header = "Flags,IntendedVsync,Other,FrameCompleted,";
    let stats =
        format!("Stats since: 1ns\n\n{mark}\n{header}\n{rows}{mark}\n{mark}\n{header}\n{mark}\n");
    let said = said_of(&stats, &TableOptions::default());
    assert!(
        said.starts_with("read 49 frames in 0.817 s: 58.8 a second, longest 33.3 ms (Android)"),
        "{said}"
    );
    let trace = &traces("a", &stats)[0];
    let late = frames(trace).iter().all(|it| it.displayed_ns == Some(it.began_ns + 16_666_667));
    assert!(late && trace.missing_display().is_none());
    let row = |n: u64| format!("{}\t{}\t{}\n", at(n), at(n + 1), at(n) + 5);
    let pending = "1001692724088218\t9223372036854775807\t0\n";
    let rows: String = (0..50).map(row).collect();
    let flinger = format!("16666666\n0\t0\t0\n{rows}{pending}");
    let said = said_of(&flinger, &TableOptions::default());
    assert!(said.starts_with("read 50 frames in 0.817 s: 60.0 a second"), "{said}");
}

#[test]
fn a_log_without_any_display_time_or_with_an_uptime_first_is_read() {
    let rows: String = (0..50).map(|n| format!("16.7,{},NA,NA\n", n)).collect();
    let text =
        format!("MsBetweenPresents,TimeInMs,MsBetweenDisplayChange,MsUntilDisplayed\n{rows}");
    let trace = &traces("a", &text)[0];
    assert!(trace.missing_display().is_some_and(|it| it.contains("no display times")));
    assert!(frames(trace).iter().all(|it| it.displayed_ns.is_some()));
    let row = |n: u64| format!("60,16.7,5,90,{}\n", n * 100_000_000);
    let rows: String = (1..50).map(row).collect();
    let text = format!(
        "os,cpu\nA,B\nfps,frametime,cpu_load,gpu_load,elapsed\n60,93000000.5,5,90,0\n{rows}"
    );
    let error = read("log", &text).err().unwrap().to_string();
    assert!(error.contains("samples every 100 ms (log_interval)"), "{error}");
}
