//! What a capture does in a second, as the program is used, and how much of its time is its slowest
//! stage's: drawing, each frame read back before the next is begun, or encoding. Beside it stands what a
//! capture takes that only draws, its frames overlapped as in the whole. All take turns; the figures are
//! medians over the rounds.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use regatta::commands::manifest::fingerprint;
use regatta::lab::{self, Lab, Scene};
use regatta::view::{AdapterPreference, Artist, Gpu, Panels, png};

const ROUNDS: usize = 5;
const FRAMES: u32 = 300;
/// Nothing is drawn by then that the first second does not show.
const FEW: u32 = 2;
const SIZE_PX: [u32; 2] = [1280, 720];
/// Frames in a second of the run, for the program and for its stages alone: a later moment has more to draw.
const FPS: u32 = 30;
/// The aims, in frames a second and as a ratio, on two cores with a software adapter.
const FEWEST_WITH_PANELS: f64 = 60.0;
const FEWEST_WITHOUT: f64 = 150.0;
const MOST_OF_SLOWEST_STAGE: f64 = 1.15;

fn main() {
    for (panels, fewest) in [(Panels::Shown, FEWEST_WITH_PANELS), (Panels::Off, FEWEST_WITHOUT)] {
        let rounds: Result<Vec<[f64; 4]>, String> = (0..ROUNDS).map(|_| round(panels)).collect();
        let rounds = match rounds {
            Ok(rounds) => rounds,
            Err(said) => return println!("SKIPPED capture: {said}"),
        };
        let [whole, drawing, encoding, overlapped] =
            [0, 1, 2, 3].map(|part| median(rounds.iter().map(|round| round[part]).collect()));
        println!(
            "harbour, race, 1280x720, panels {panels:?}: {:.0} frames a second; a frame takes {:.2} ms; \
             drawing alone {:.2} ms, or {:.2} ms overlapped; encoding alone {:.2} ms",
            1.0 / whole,
            1e3 * whole,
            1e3 * drawing,
            1e3 * overlapped,
            1e3 * encoding
        );
        let of_slowest = |[whole, drawing, encoding, _]: &[f64; 4]| whole / drawing.max(*encoding);
        let ratio = median(rounds.iter().map(of_slowest).collect());
        let holds = |held: bool| if held { "holds" } else { "MISSED" };
        println!(
            "aims: {fewest} frames a second {}; {ratio:.2} of the slowest stage, at most \
             {MOST_OF_SLOWEST_STAGE}, {}",
            holds(1.0 / whole >= fewest),
            holds(ratio <= MOST_OF_SLOWEST_STAGE)
        );
    }
}

/// Seconds that a frame takes from start to file, drawing alone, encoding alone, and all but encoding.
fn round(panels: Panels) -> Result<[f64; 4], String> {
    // A new one each time: where files were just removed a file system makes new ones slowly.
    let folder = tempfile::tempdir().expect("a directory for frames");
    // Without the start of the program, which is not a frame's doing.
    let seconds_a_frame = |format: &str| -> Result<f64, String> {
        let capture = |frames| capture(folder.path(), panels, format, frames);
        Ok((capture(FRAMES + FEW)? - capture(FEW)?) / f64::from(FRAMES))
    };
    let (overlapped, whole) = (seconds_a_frame("rgba")?, seconds_a_frame("png")?);
    let (drawing, encoding) = stages(panels)?;
    Ok([whole, drawing, encoding, overlapped])
}

/// Seconds that it takes to draw a frame of the run and have it read back, and to encode one.
fn stages(panels: Panels) -> Result<(f64, f64), String> {
    let gpu = Gpu::headless(AdapterPreference::Any).map_err(|error| error.to_string())?;
    let artist = Artist::new(gpu, SIZE_PX, 1.0).map_err(|error| error.to_string())?;
    let mut artist = artist.with_panels(panels);
    let mut lab = Lab::new(Scene::built_in("harbour").expect("a built-in scene"));
    lab.apply(lab::Command::ToggleRace);
    lab.think();
    let (mut rgba, mut drawing, mut encoding) = (Vec::new(), Duration::ZERO, Duration::ZERO);
    for frame in 0..FRAMES + FEW {
        lab.advance(1_000_000_000 / i64::from(FPS));
        let start = Instant::now();
        artist.draw(&lab, &mut rgba).map_err(|error| error.to_string())?;
        let drawn = Instant::now();
        std::hint::black_box((png::encode(SIZE_PX, &rgba), fingerprint(&rgba)));
        if frame >= FEW {
            drawing += drawn - start;
            encoding += drawn.elapsed();
        }
    }
    let of_frame = |time: Duration| time.as_secs_f64() / f64::from(FRAMES);
    Ok((of_frame(drawing), of_frame(encoding)))
}

/// How many seconds a run of the program takes, or what it said where it failed.
fn capture(folder: &Path, panels: Panels, format: &str, frames: u32) -> Result<f64, String> {
    let (frames, fps) = (frames.to_string(), FPS.to_string());
    let out = if format == "png" { &*frames } else { "-" };
    let panels = if panels == Panels::Off { "off" } else { "on" };
    let start = Instant::now();
    let output = Command::new(env!("CARGO_BIN_EXE_regatta"))
        .args(["capture", "--scene", "harbour", "--race", "--size", "1280x720"])
        .args(["--panels", panels, "--format", format, "--out", out])
        .args(["--frames", &frames, "--fps", &fps])
        .current_dir(folder)
        .stdout(Stdio::null())
        .output()
        .expect("the program starts");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    output.status.success().then(|| start.elapsed().as_secs_f64()).ok_or(said)
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
