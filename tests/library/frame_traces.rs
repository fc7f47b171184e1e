//! Logs of frame-time tools as traces: real ones against sums made here from their columns, and the formats one by one.

use std::collections::HashMap;
use std::time::Instant;

use regatta::loops::trace_file::read;
use regatta::loops::{Frame, FrameTrace, Pacer, TimeBase, policy};

mod bounds;
mod logs;

const FILES: [&str; 6] = [
    include_str!("../data/frame-traces/presentmon_test_case_0.csv"),
    include_str!("../data/frame-traces/presentmon_test_case_1.csv"),
    include_str!("../data/frame-traces/presentmon_test_case_2.csv"),
    include_str!("../data/frame-traces/presentmon_test_case_3.csv"),
    include_str!("../data/frame-traces/presentmon_test_case_4.csv"),
    include_str!("../data/frame-traces/presentmon_test_case_5.csv"),
];

const TICK_HZ: u32 = 60;

fn traces(name: &str, text: &str) -> Vec<FrameTrace> {
    read(name, text).unwrap_or_else(|error| panic!("{error}"))
}

fn frames(trace: &FrameTrace) -> Vec<Frame> {
    let mut frames = trace.frames();
    std::iter::from_fn(|| frames.next(0)).collect()
}

/// A row of one of the files, in milliseconds.
struct Row {
    process: String,
    between_presents: f64,
    display_change: Option<f64>,
    animation_time: Option<f64>,
    animation_error: Option<f64>,
}

/// The rows of each stream, read without the studio.
fn streams(text: &str) -> Vec<Vec<Row>> {
    let (mut streams, mut numbers) = (Vec::<Vec<Row>>::new(), HashMap::new());
    for line in text.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let row = Row {
            process: cells[1].into(),
            between_presents: cells[3].parse().unwrap(),
            display_change: cells[4].parse().ok(),
            animation_time: cells[5].parse().ok(),
            animation_error: cells[6].parse().ok(),
        };
        let number = *numbers.entry((cells[1], cells[2])).or_insert(streams.len());
        if number == streams.len() {
            streams.push(Vec::new());
        }
        streams[number].push(row);
    }
    streams
}

/// The animation error in milliseconds of every displayed frame but the first: the change of the moment shown minus the
/// change of the moment of display.
fn animation_errors(shown_and_displayed: &[(f64, f64)]) -> Vec<f64> {
    let change = |pair: &[(f64, f64)]| (pair[1].0 - pair[0].0) - (pair[1].1 - pair[0].1);
    shown_and_displayed.windows(2).map(change).collect()
}

/// The shown and the displayed times of a game with interpolated ticks, from the columns alone. Each frame shows one
/// tick before its start, less the ticks dropped beyond 250 ms.
fn by_the_columns(rows: &[Row]) -> Vec<(f64, f64)> {
    let tick = 1000.0 / f64::from(TICK_HZ);
    let (mut began, mut displayed, mut owed, mut given_up) = (0.0, 0.0, 0.0, 0.0);
    let mut pictures = Vec::new();
    for (n, row) in rows.iter().enumerate() {
        let duration = if n == 0 { 0.0 } else { row.between_presents };
        began += duration;
        owed += duration;
        let ticks = f64::floor(owed / tick);
        owed -= ticks * tick;
        given_up += f64::max(ticks - 15.0, 0.0) * tick;
        if let Some(change) = row.display_change {
            displayed += change;
            pictures.push((began - tick - given_up, displayed));
        }
    }
    pictures
}

/// The same from the studio.
fn by_the_lab(trace: &FrameTrace) -> Vec<(f64, f64)> {
    let base = TimeBase::new(TICK_HZ, trace.refresh());
    let mut pacer = Pacer::new(policy("fixed-linear").expect("in the table"), base);
    let (mut began_ns, mut pictures) = (0, Vec::new());
    for frame in frames(trace) {
        pacer.frame(frame.began_ns - began_ns);
        began_ns = frame.began_ns;
        if let Some(ns) = frame.displayed_ns {
            pictures.push((base.milliseconds(pacer.drawn_moment()), ns as f64 / 1e6));
        }
    }
    pictures
}

fn rms(values: &[f64]) -> f64 {
    (values.iter().map(|x| x * x).sum::<f64>() / values.len().max(1) as f64).sqrt()
}

#[test]
fn real_logs_have_the_known_rows_streams_and_lost_frames() {
    let known = [
        (357, 10, 9, 450.37),
        (50, 4, 4, 483.77),
        (93, 4, 3, 400.33),
        (115, 4, 3, 567.16),
        (186, 5, 3, 434.06),
        (647, 7, 87, 16.83),
    ];
    for (n, (text, (rows, count, lost, longest))) in FILES.iter().zip(known).enumerate() {
        let traces = traces("log", text);
        let all: Vec<Vec<Frame>> = traces.iter().map(frames).collect();
        assert_eq!(all.len(), count, "file {n}");
        assert_eq!(all.iter().map(Vec::len).sum::<usize>(), rows, "file {n}");
        let hidden = all.iter().flatten().filter(|frame| frame.displayed_ns.is_none());
        assert_eq!(hidden.count(), lost, "file {n}");
        let change = |frames: &Vec<Frame>| {
            let shown: Vec<i64> = frames.iter().filter_map(|frame| frame.displayed_ns).collect();
            shown.windows(2).map(|pair| pair[1] - pair[0]).max().unwrap_or(0)
        };
        let most_ms = all.iter().map(change).max().unwrap() as f64 / 1e6;
        assert!((most_ms - longest).abs() < 0.01, "file {n}: {most_ms} ms");
    }
}

#[test]
fn streams_are_named_by_program_then_process_then_number() {
    let traces = traces("log", FILES[5]);
    let names: Vec<&str> = traces.iter().map(FrameTrace::name).collect();
    assert_eq!(
        names,
        [
            "log:dwm.exe-2656",
            "log:PresentBench.exe-24892",
            "log:dwm.exe-2656-2",
            "log:steamwebhelper.exe",
            "log:dwm.exe-2656-3",
            "log:PresentBench.exe-24892-2",
            "log:dwm.exe-2656-4",
        ]
    );
    let windows = "SwapChainAddress,MsBetweenPresents,MsBetweenDisplayChange\n0x1,1,1\n0x2,1,1\n";
    let nameless: Vec<String> =
        self::traces("log", windows).iter().map(|trace| trace.name().into()).collect();
    assert_eq!(nameless, ["log:stream", "log:stream-2"]);
    let odd = "Application,MsBetweenPresents,MsBetweenDisplayChange\n\u{1b}[31mred,1,1\nb,1,1\n";
    assert_eq!(self::traces("log", odd)[0].name(), "log:\u{fffd}[31mred", "for a terminal");
    for name in ["log:dwm.exe-2656", "log:dwm.exe-2656-2"] {
        let trace = traces.iter().find(|trace| trace.name() == name).unwrap();
        assert!((trace.refresh().hz() - 59.94).abs() < 0.1, "{name}: {} Hz", trace.refresh());
    }
}

#[test]
fn the_animation_error_of_real_frames_matches_the_logged_columns() {
    let mut compared = 0;
    for (n, text) in FILES.iter().enumerate() {
        let (rows, traces) = (streams(text), traces("log", text));
        assert_eq!(rows.len(), traces.len());
        for (rows, trace) in rows.iter().zip(&traces) {
            let expected = animation_errors(&by_the_columns(rows));
            let found = animation_errors(&by_the_lab(trace));
            assert_eq!(found.len(), expected.len(), "file {n}, {}", trace.name());
            for (found, expected) in found.iter().zip(&expected) {
                assert!((found - expected).abs() < 0.01, "{found} ms, not {expected} ms");
            }
            let (found_rms, expected_rms) = (rms(&found), rms(&expected));
            println!("file {n}, {}: {found_rms:.4} ms RMS", trace.name());
            assert!((found_rms - expected_rms).abs() < 0.01, "file {n}, {}", trace.name());
            compared += found.len();
        }
    }
    // All displayed frames less the first of each stream.
    assert_eq!(compared, 1306);
}

#[test]
fn presentmons_animation_error_equals_ours_except_in_a_known_row() {
    let (mut checked, mut odd) = (0, Vec::new());
    for (n, text) in FILES.iter().enumerate() {
        for rows in streams(text) {
            let mut last = None;
            for row in rows {
                let (Some(change), Some(time)) = (row.display_change, row.animation_time) else {
                    continue;
                };
                if let (Some(last), Some(error)) = (last, row.animation_error) {
                    checked += 1;
                    let ours: f64 = time - last - change;
                    if (ours - error).abs() >= 0.01 {
                        odd.push((n, row.process, time, error, (ours * 1e4).round() / 1e4));
                    }
                }
                last = Some(time);
            }
        }
    }
    assert_eq!(checked, 1306);
    assert_eq!(odd, [(4, "5236".into(), 2297.4047, 3.2485, 18.8078)]);
}

/// Frames that begin and are displayed at these milliseconds.
const EXPECTED: [(f64, Option<f64>); 4] =
    [(0.0, Some(0.0)), (10.0, None), (30.0, Some(33.4)), (45.5, Some(50.1))];

#[track_caller]
fn assert_reads_as_expected(text: &str) {
    let traces = traces("log", text);
    assert_eq!(traces.iter().map(FrameTrace::name).collect::<Vec<_>>(), ["log"]);
    let ns = |ms: f64| (ms * 1e6).round() as i64;
    let expected = EXPECTED.map(|(b, d)| Frame { began_ns: ns(b), displayed_ns: d.map(ns) });
    assert_eq!(frames(&traces[0]), expected);
}

const PLAIN: &str = "\
Application,ProcessID,SwapChainAddress,MsBetweenPresents,MsBetweenDisplayChange
a.exe,1,0x1,7,99
a.exe,1,0x1,10,NA
a.exe,1,0x1,20,33.4
a.exe,1,0x1,15.5,16.7
";

#[test]
fn presentmon_1_is_read_with_zeros_for_dropped_frames() {
    assert_reads_as_expected(
        "\
Application,ProcessID,SwapChainAddress,Runtime,Dropped,TimeInSeconds,msInPresentAPI,msBetweenPresents,msBetweenDisplayChange
a.exe,1,0x1,DXGI,0,1.0,0.1,0.000000,0.000000
a.exe,1,0x1,DXGI,1,1.0,0.1,10.000000,0.000000
a.exe,1,0x1,DXGI,0,1.0,0.1,20.000000,33.400000
a.exe,1,0x1,DXGI,0,1.0,0.1,15.500000,16.700000
",
    );
}

#[test]
fn presentmon_2_is_read_with_and_without_ms() {
    assert_reads_as_expected(PLAIN);
    assert_reads_as_expected(&PLAIN.replace("Ms", ""));
}

#[test]
fn times_relative_to_a_frame_count_from_that_frame() {
    let text = "\
Application,ProcessID,SwapChainAddress,FrameType,CPUStartTime,FrameTime,CPUBusy,DisplayLatency,DisplayedTime
a.exe,1,0x1,Application,100,10,1,20,33.4
a.exe,1,0x1,Application,110,20,1,NA,NA
a.exe,1,0x1,Application,130,15.5,1,20,16.7
a.exe,1,0x1,Application,145.5,NA,1,20,16.7
";
    assert_reads_as_expected(text);
    assert_reads_as_expected(&text.replace("DisplayedTime", "MsDisplayedTime"));
}

#[test]
fn ocat_capframex_and_frameview_are_read() {
    let ocat = "\
Application,ProcessID,SwapChainAddress,Runtime,SyncInterval,PresentFlags,AllowsTearing,PresentMode,WasBatched,DwmNotified,Dropped,TimeInSeconds,MsBetweenPresents,MsBetweenDisplayChange
a.exe,1,0x1,DXGI,0,0,0,Hardware: Legacy Flip,0,0,0,1.0,0,0
a.exe,1,0x1,DXGI,0,0,0,Hardware: Legacy Flip,0,0,1,1.0,10,0
a.exe,1,0x1,DXGI,0,0,0,Hardware: Legacy Flip,0,0,0,1.0,20,33.4
a.exe,1,0x1,DXGI,0,0,0,Hardware: Legacy Flip,0,0,0,1.0,15.5,16.7
";
    assert_reads_as_expected(ocat);
    assert_reads_as_expected(&format!("//GameName=A game, by name\n//Comment=\n{ocat}"));
    assert_reads_as_expected(
        "\
Application,GPU,CPU,Resolution,Runtime,ProcessID,SwapChainAddress,Dropped,TimeInSeconds,MsBetweenPresents,MsBetweenDisplayChange
a.exe,G,C,1x1,DX12,1,0x1,0,1.0,16.7,16.7
a.exe,G,C,1x1,DX12,1,0x1,1,1.0,10,NA
a.exe,G,C,1x1,DX12,1,0x1,0,1.0,20,33.4
a.exe,G,C,1x1,DX12,1,0x1,0,1.0,15.5,16.7
",
    );
}

#[test]
fn a_log_resaved_by_a_spreadsheet_is_read() {
    assert_reads_as_expected(&format!("\u{feff}{}", PLAIN.replace('\n', "\r\n")));
    assert_reads_as_expected(&PLAIN.replace(',', ";").replace('.', ","));
    assert_reads_as_expected(&PLAIN.replace(',', "\t"));
    assert_reads_as_expected(&PLAIN.to_uppercase().replace("33.4", "\"33,4\""));
    assert_reads_as_expected(&PLAIN.replace("a.exe", "\"a, b \"\"c\"\".exe\""));
    assert_reads_as_expected(&PLAIN.replace("NA", ""));
    assert_reads_as_expected(PLAIN.trim_end());
}

#[test]
fn a_log_without_programs_is_one_stream_and_zero_means_not_displayed() {
    let text = "MsBetweenPresents,MsBetweenDisplayChange\n0,0\n10,0\n20,33.4\n15.5,16.7\n";
    assert_reads_as_expected(text);
}

#[test]
fn a_stream_with_lost_first_frames_starts_at_its_first_displayed_frame() {
    let text = "MsBetweenPresents,MsBetweenDisplayChange\n5,NA\n10,16\n10,16\n";
    let displayed: Vec<_> =
        frames(&traces("log", text)[0]).iter().map(|f| f.displayed_ns).collect();
    assert_eq!(displayed, [None, Some(10_000_000), Some(26_000_000)]);
}

#[test]
fn every_fault_is_named_with_its_line_and_a_remedy() {
    let row = |cells: &str| format!("MsBetweenPresents,MsBetweenDisplayChange\n1,1\n{cells}\n");
    let capture = "capture some frames";
    for (text, message) in [
        (String::new(), format!("log:1: there is nothing here; {capture} with PresentMon, OCAT, CapFrameX, FrameView, MangoHud, Unreal or FRAPS")),
        ("\u{feff}\r\n".into(), format!("log:1: there is nothing here; {capture} with PresentMon, OCAT, CapFrameX, FrameView, MangoHud, Unreal or FRAPS")),
        (
            "//a\nMsBetweenPresents,MsBetweenDisplayChange\n".into(),
            format!("log:2: there is a header and no frame of a program below it; {capture}"),
        ),
        (
            "Application,msBetweenDisplayChange\na,1\n".into(),
            "log:1: the columns MsBetweenPresents, alone or with MsBetweenDisplayChange, FrameTime and DisplayedTime, MangoHud's fps and frametime, Unreal's FrameTime, or FRAPS's Time (ms) are needed, and here are Application, msBetweenDisplayChange; name the column of frame times with --frame-column or that of a running clock with --clock-column, or write frame times in milliseconds alone, one a line".into(),
        ),
        (row("1"), "log:3: the row has 1 of the header's first 2 cells; take it out if it was cut off".into()),
        (
            row("16,683,16,683"),
            "log:3: the row has 4 cells and the header 2; if its numbers have decimal commas, write points, or separate the cells with semicolons".into(),
        ),
        (
            row("1,nan"),
            "log:3: column MsBetweenDisplayChange: expected a time, found \"nan\"; write a number such as 16.683, or NA".into(),
        ),
        (
            row("inf,1"),
            "log:3: column MsBetweenPresents: expected a time, found \"inf\"; write a number such as 16.683, or NA".into(),
        ),
        (
            row("-1.5,1"),
            "log:3: column MsBetweenPresents: -1.5 is negative; time does not run backwards: take the row out".into(),
        ),
        (row("1,1e12"), "log:3: column MsBetweenDisplayChange: 1e12 is more than a day; take the row out".into()),
        (row("NA,1"), "log:3: column MsBetweenPresents: the time of this frame is missing; take the row out".into()),
        (
            "Dropped,MsBetweenPresents,MsBetweenDisplayChange\nyes,1,1\n".into(),
            "log:2: column Dropped: expected 0 or 1, found \"yes\"; write 1 for a frame that was not displayed".into(),
        ),
        (
            row("1,1").replace("\n1,1", "\n0,1"),
            "log:2: no time passes from here to the last of these 2 frames; capture them again".into(),
        ),
        (
            row(&["86000000,1"; 367].join("\n")),
            "log:369: from here on the frames last more than a year in all; split the log".into(),
        ),
    ] {
        let error = read("log", &text).err().unwrap_or_else(|| panic!("read: {message}"));
        assert_eq!(error.to_string(), message);
    }
}

#[test]
fn without_display_times_frame_times_are_taken_as_display_times() {
    let list = "16.7\n10\n20,25\n\n15.5\n";
    let presents = "Application,Dropped,MsBetweenPresents\na,0,16.7\na,0,10\na,0,20.25\na,0,15.5\n";
    for text in [list, &format!("\u{feff}// mine\r\n{list}"), presents] {
        let found = traces("log", text);
        let [trace] = &found[..] else { panic!("{} traces", found.len()) };
        let times = [0, 10_000_000, 30_250_000, 45_750_000];
        let expected = times.map(|ns| Frame { began_ns: ns, displayed_ns: Some(ns) });
        assert_eq!(frames(trace), expected, "{text}");
        assert!(trace.has_one_clock() && trace.missing_display().is_some());
    }
    let both = &traces("log", PLAIN)[0];
    assert!(!both.has_one_clock() && both.missing_display().is_none());
    let error = read("log", "16.7\n16.6\nfast\n").err().unwrap().to_string();
    assert!(error.starts_with("log:3: column 1: expected a time, found \"fast\""), "{error}");
}

#[test]
fn a_million_rows_of_a_thousand_streams_are_read() {
    let mut text = String::from(PLAIN.lines().next().unwrap());
    for n in 0..1_000_000 {
        text +=
            &format!("\na.exe,{},0x{:X},16.6{:03},16.6{:03}", n % 10, n % 1000, n % 999, n % 998);
    }
    let start = Instant::now();
    let traces = traces("log", &text);
    println!("{} MB in {:?}", text.len() / 1_000_000, start.elapsed());
    assert_eq!(traces.len(), 1000);
    assert!(traces.iter().all(|trace| frames(trace).len() == 1000));
}

#[test]
fn a_mangohud_log_is_read_below_its_machine_description() {
    let rows = "60,16.5,3\n59.9,17.25,3\n60,16,4\n";
    let machine =
        "os,cpu,gpu,ram,kernel,driver,cpuscheduler\nLinux,A CPU,\"A GPU, big\",32,6.1,1,none\n";
    let versioned = format!("v1\n0.8\n-----SYSTEM INFO-----\n{machine}-----FRAME METRICS-----\n");
    for before in ["", machine, &versioned] {
        let text = format!("{before}fps,frametime,cpu_load\n{rows}");
        let [trace] = &traces("hud", &text)[..] else { panic!("one trace") };
        let ms = 1_000_000;
        // Missing display times are replaced by the times of the frames.
        let expected = [0, 17_250 * ms / 1000, 33_250 * ms / 1000];
        let expected = expected.map(|ns| Frame { began_ns: ns, displayed_ns: Some(ns) });
        assert_eq!(frames(trace), expected, "{text}");
    }
    // PresentMon 2 has no display times when it is set to track none.
    let [trace] = &traces("log", "FrameTime,CPUBusy\n16,3\n17,3\n")[..] else { panic!("one") };
    assert!(trace.summary().unwrap().contains("(PresentMon 2)") && trace.has_one_clock());
    let far = format!("{}fps,frametime\n60,16\n", "a remark\n".repeat(17));
    assert!(read("log", &far).err().unwrap().to_string().starts_with("log:1: the columns"));
}

#[test]
fn generated_frames_pass_time_but_do_not_count_as_frames() {
    let ms = |ms: i64| ms * 1_000_000;
    let at = |began, shown| Frame { began_ns: ms(began), displayed_ns: Some(ms(shown)) };
    let before = "Application,MsBetweenPresents,MsBetweenDisplayChange,FrameType\n\
                  a,16,16,Application\na,1,8,AMD_AFMF\na,15,8,Application\na,2,9,Repeated\na,14,7,NotSet\n";
    let [trace] = &traces("log", before)[..] else { panic!("one trace") };
    assert_eq!(frames(trace), [at(0, 0), at(16, 16), at(32, 32)]);
    let after = "Application,FrameTime,DisplayedTime,FrameType\n\
                 a,16,8,Application\na,NA,9,Intel_XEFG\na,17,8,Application\na,NA,8,Intel_XEFG\na,16,8,Application\n";
    let [trace] = &traces("log", after)[..] else { panic!("one trace") };
    assert_eq!(frames(trace), [at(0, 0), at(16, 17), at(33, 33)]);
    let none = "Application,FrameTime,DisplayedTime,FrameType\na,NA,8,Intel_XEFG\n";
    assert!(read("log", none).err().unwrap().to_string().contains("no frame of a program"));
}
