//! Starting, ending, and running while nobody looks.

use std::fs::File;
use std::io::Write;
use std::process::Command;
use std::time::{Duration, Instant};

use image::{Rgba, RgbaImage};
use regatta::look::palette::Theme;
use regatta::studio::ViewCommand;

use crate::desk::{Desk, Display, until};
use crate::widgets::paused_with;

/// Title of a window that opens with nothing asked for.
const OPENING: &str = "Regatta - two-springs - race: Explicit Euler - 60 Hz";

/// Opens a window that is drawn by this backend, pauses it, and looks at it.
fn opens(backend: &str, renderer: &str) {
    let arguments = format!("--renderer {renderer}");
    let desk = Desk::open_with(&arguments, &[("WGPU_BACKEND", backend)]);
    desk.titled(OPENING);
    desk.press("3");
    desk.titled("Regatta - two-springs - race: Improved Euler - 60 Hz");
    desk.press("space");
    desk.titled("Regatta - two-springs - race: Improved Euler - 60 Hz (paused)");
    desk.shows(&desk.screenshot().1, 1);
    desk.quit();
}

pub(crate) fn a_window_opens_under_vulkan() {
    opens("vulkan", "gpu");
}

pub(crate) fn a_window_opens_under_gl() {
    opens("gl", "gpu");
}

pub(crate) fn a_window_opens_by_the_processor() {
    // No system has an adapter of Metal beside Xvfb.
    opens("metal", "auto");
}

pub(crate) fn the_program_ends_after_its_seconds_or_with_its_window() {
    let desk = Desk::open("--scene spring --seconds 1");
    desk.ends();
    let desk = Desk::open("--scene spring");
    desk.close();
    desk.ends();
    let desk = Desk::open("--scene spring");
    // Not a request: the window is gone.
    desk.xdotool("windowclose WINDOW");
    desk.ends();
}

pub(crate) fn a_signal_ends_the_program_while_nothing_reads_its_recording() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    // As much as a pipe holds, which its reader leaves there.
    let mut reader = File::options().read(true).write(true).open(&pipe).unwrap();
    reader.write_all(&[b' '; 1 << 16]).unwrap();
    let arguments = format!("--scene spring --record {}", pipe.display());
    let mut desk = Desk::open(&arguments);
    desk.close();
    for _ in 0..100 {
        assert!(desk.program.ended().is_none(), "it waits");
        std::thread::sleep(Duration::from_millis(20));
    }
    desk.program.terminate();
    let status = until("the end", || desk.program.ended());
    let said = desk.program.said();
    assert_eq!(status.code(), Some(130), "{said}");
    assert!(said.contains("interrupted while nothing was reading"), "{said}");
}

pub(crate) fn without_the_requested_adapter_the_program_ends_with_a_message() {
    let display = Display::open();
    let mut program = display.start("--renderer gpu", &[("WGPU_BACKEND", "metal")]);
    let status = until("the end", || program.ended());
    let said = program.said();
    assert_eq!(status.code(), Some(1), "{said}");
    assert!(said.starts_with("error: no usable graphics adapter: "), "{said}");
    assert_eq!(said.lines().count(), 1, "{said}");
}

pub(crate) fn a_display_of_too_few_colours_ends_the_program_in_one_plain_line() {
    let display = Display::of_screen("1280x800x16");
    for (renderer, expected) in [
        ("cpu", "error: the window system takes no picture by the processor: "),
        ("gpu", "error: no usable graphics adapter: "),
    ] {
        let mut program = display.start(&format!("--renderer {renderer}"), &[]);
        let status = until("the end", || program.ended());
        let said = program.said();
        assert_eq!(status.code(), Some(1), "{said}");
        assert!(said.starts_with(expected) && said.lines().count() == 1, "{said}");
    }
}

pub(crate) fn a_window_opens_in_silence_beside_traces_of_wayland() {
    for variables in [[("WAYLAND_DISPLAY", "gone")], [("XDG_RUNTIME_DIR", "")]] {
        Desk::open_with("--scene spring --seconds 1", &variables).ends();
    }
}

pub(crate) fn an_unmapped_window_runs_on_in_real_time() {
    let desk = Desk::open("--scene ship --tick-hz 2 --seconds 3");
    let start = Instant::now();
    desk.xdotool("windowunmap WINDOW");
    desk.ends();
    // A run that stands still never ends.
    assert!(start.elapsed() > Duration::from_secs(2), "{:?}", start.elapsed());
}

/// The keys that go back from *Motion* to the instrument *Loop*.
const TO_LOOP: &str = "shift+d shift+d";

/// Whether ticks were dropped: the instrument *Loop* says so above its plot, in this colour.
fn tells_of_dropped_ticks(picture: &RgbaImage) -> bool {
    let beside_the_stage = |x: u32, y: u32| x > 800 && (70..230).contains(&y);
    let alarm =
        |pixel: &Rgba<u8>| (0..3).all(|i| pixel[i].abs_diff(Theme::Dark.palette().bad[i]) < 40);
    let pixels = picture.enumerate_pixels();
    pixels.filter(|(x, y, pixel)| beside_the_stage(*x, *y) && alarm(pixel)).count() > 20
}

pub(crate) fn a_covered_window_runs_on_in_real_time_and_draws_nothing() {
    let desk = Desk::open("--scene spring --tick-hz 2");
    desk.press(TO_LOOP);
    let cover = desk.cover();
    // Forget the ticks dropped so far on a busy machine.
    let start = Instant::now();
    desk.press("Home 1");
    desk.titled("Regatta - spring - Explicit Euler - 2 Hz");
    // A picture is owed until it can be shown.
    desk.press("p");
    let load = desk.load_over(Duration::from_secs(2));
    drop(cover);
    let (ticks, picture) = desk.next_screenshot();
    let seconds = start.elapsed().as_secs_f64();
    // Four in those two seconds, if none is dropped.
    assert!(ticks >= 3 && ticks as f64 / 2.0 < seconds, "{ticks} ticks in {seconds} s");
    assert!(load < 0.1, "{load} of a core while covered");
    assert!(!tells_of_dropped_ticks(&picture));
    desk.quit();
}

pub(crate) fn a_hitch_drops_ticks_with_a_notice_and_a_pause_does_not() {
    // Ticks so long that a busy machine's own hitches hide in one of them.
    let desk = Desk::open("--scene spring --tick-hz 2");
    desk.press(TO_LOOP);
    assert!(!tells_of_dropped_ticks(&desk.screenshot().1));
    desk.program.stop_for(Duration::from_secs(2));
    assert!(tells_of_dropped_ticks(&desk.screenshot().1));
    desk.press("Home space");
    desk.titled("Regatta - spring - Explicit Euler - 2 Hz (paused)");
    std::thread::sleep(Duration::from_secs(2));
    desk.press("space");
    desk.titled("Regatta - spring - Explicit Euler - 2 Hz");
    assert!(!tells_of_dropped_ticks(&desk.screenshot().1));
    desk.quit();
}

pub(crate) fn a_paused_window_leaves_the_machine_alone() {
    let desk = Desk::open("--scene spring");
    desk.press("space");
    desk.titled("Regatta - spring - Explicit Euler - 60 Hz (paused)");
    desk.still();
    let load = desk.load_over(Duration::from_secs(2));
    assert!(load < 0.1, "{load} of a core");
    desk.quit();
}

pub(crate) fn the_last_open_scene_reopens_unless_another_is_given() {
    let config = tempfile::tempdir().unwrap();
    let variables = [("XDG_CONFIG_HOME", config.path().to_str().unwrap())];
    let desk = Desk::open_with("", &variables);
    desk.titled(OPENING);
    desk.press("b b b");
    desk.titled("Regatta - ship - Explicit Euler - 2 Hz");
    desk.resize(900, 640);
    desk.press("space");
    desk.titled("Regatta - ship - Explicit Euler - 2 Hz (paused)");
    desk.press_and_see("ctrl+plus");
    desk.quit();
    let remembered = config.path().join("regatta/window.toml");
    for (arguments, title) in [
        ("--scene spring", "Regatta - spring - Explicit Euler - 60 Hz"),
        ("--seconds 60", "Regatta - harbour - Explicit Euler - 60 Hz"),
        ("", "Regatta - ship - Explicit Euler - 2 Hz"),
    ] {
        let desk = Desk::open_with(arguments, &variables);
        desk.titled(title);
        assert_eq!(desk.sight().dimensions(), (900, 640), "{arguments}");
        desk.quit();
        let text = std::fs::read_to_string(&remembered).unwrap();
        assert!(text.contains("scale_percent = 110\n"), "{text}");
    }
    std::fs::write(&remembered, "theme = 5").unwrap();
    let mut desk = Desk::open_with("", &variables);
    desk.titled(OPENING);
    desk.program.says("window.toml is ignored: its theme cannot be understood").unwrap();
}

pub(crate) fn the_window_first_shows_the_stage_alone_and_remembers_the_instruments() {
    let config = tempfile::tempdir().unwrap();
    let variables = [("XDG_CONFIG_HOME", config.path().to_str().unwrap())];
    for (measures, is_by_key) in [(false, true), (true, true), (false, false)] {
        let (desk, mut twin) = paused_with("harbour", &variables, measures);
        twin.looks_alike(&desk);
        if is_by_key {
            desk.press("t");
            twin.apply(ViewCommand::ToggleMeasure);
        } else {
            twin.click(&desk, "measure: plots");
        }
        assert_eq!(twin.studio.display().measure, !measures);
        twin.looks_alike(&desk);
        desk.quit();
        let text = std::fs::read_to_string(config.path().join("regatta/window.toml")).unwrap();
        assert!(text.contains(&format!("measure = {}\n", !measures)), "{text}");
    }
}

pub(crate) fn a_killed_program_leaves_its_recording_for_the_next_start_to_report() {
    let desk = Desk::open("--scene spring --record run.toml");
    desk.press("2");
    desk.press("space");
    let file = desk.folder().join("run.unfinished.toml");
    let is_kept = || std::fs::read_to_string(&file).is_ok_and(|text| text.contains("[[command]]"));
    // The last action is saved even while paused.
    until("the recording", || is_kept().then_some(()));
    let settings = desk.folder().join("config/regatta");
    let notes = || settings.join(".unfinished-notes").read_dir().unwrap().count();
    assert_eq!(notes(), 1);
    // A person's recordings in the folder of the settings.
    let kept = [("run.toml", "mine"), (".tmpaB3dE6", "/home/me/recordings/run.toml")];
    std::fs::create_dir(settings.join("recordings")).unwrap();
    for (name, text) in kept {
        std::fs::write(settings.join("recordings").join(name), text).unwrap();
    }
    let display = desk.kill();
    let mut verified = display.start("verify run.unfinished.toml", &[]);
    let status = until("the end", || verified.ended());
    assert_eq!(status.code(), Some(0), "{}", verified.said());

    let mut again = display.start("--scene spring --seconds 0.1 --record run.toml", &[]);
    until("the end", || again.ended());
    let said = again.said();
    let told = said.lines().next().unwrap_or_default();
    assert!(told.starts_with("a recording was not finished when its window ended"), "{said}");
    assert!(told.ends_with("/run.unfinished.toml has it so far"), "{said}");
    assert!(said.contains("recorded 6 ticks in run.toml"), "{said}");
    let mut once = display.start("--scene spring --seconds 0.1", &[]);
    until("the end", || once.ended());
    assert_eq!(once.said(), "", "told once");
    for (name, text) in kept {
        let left = std::fs::read_to_string(settings.join("recordings").join(name)).unwrap();
        assert_eq!(left, text, "{name}");
    }
    assert_eq!(notes(), 0);
    let folder = display.folder();
    let left: Vec<_> = folder.read_dir().unwrap().map(|file| file.unwrap().file_name()).collect();
    let is_unfinished = |name: &&std::ffi::OsString| name.to_string_lossy().contains("unfinished");
    assert_eq!(left.iter().filter(is_unfinished).count(), 1, "of the killed one: {left:?}");
    let is_part = |name: &std::ffi::OsString| name.to_string_lossy().ends_with(".part");
    assert!(!left.iter().any(is_part), "{left:?}");
}
