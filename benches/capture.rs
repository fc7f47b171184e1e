//! What a capture does in a second, as the program is used, and how much of its time is its slowest
//! stage's. Drawing alone and the whole take turns; the figures are medians over the rounds.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;

use regatta::commands::manifest::fingerprint;
use regatta::view::png;

const ROUNDS: usize = 5;
const FRAMES: u32 = 300;
/// Nothing is drawn by then that the first second does not show.
const FEW: u32 = 2;
const SIZE_PX: [u32; 2] = [1280, 720];
/// The aims, in frames a second and as a ratio, on two cores with a software adapter.
const FEWEST_WITH_PANELS: f64 = 60.0;
const FEWEST_WITHOUT: f64 = 150.0;
const MOST_OF_SLOWEST_STAGE: f64 = 1.15;

fn main() {
    for (panels, fewest) in [("on", FEWEST_WITH_PANELS), ("off", FEWEST_WITHOUT)] {
        let rounds: Result<Vec<[f64; 3]>, String> = (0..ROUNDS).map(|_| round(panels)).collect();
        let rounds = match rounds {
            Ok(rounds) => rounds,
            Err(said) => return println!("SKIPPED capture: {said}"),
        };
        let [whole, drawing, encoding] =
            [0, 1, 2].map(|part| median(rounds.iter().map(|round| round[part]).collect()));
        println!(
            "harbour, race, 1280x720, panels {panels}: {:.0} frames a second; a frame takes \
             {:.2} ms, drawing alone {:.2} ms, encoding alone {:.2} ms",
            1.0 / whole,
            1e3 * whole,
            1e3 * drawing,
            1e3 * encoding
        );
        let ratio = median(rounds.iter().map(|[a, b, c]| a / b.max(*c)).collect());
        let holds = |held: bool| if held { "holds" } else { "MISSED" };
        println!(
            "aims: {fewest} frames a second {}; {ratio:.2} of the slowest stage, at most \
             {MOST_OF_SLOWEST_STAGE}, {}",
            holds(1.0 / whole >= fewest),
            holds(ratio <= MOST_OF_SLOWEST_STAGE)
        );
    }
}

/// Seconds that a frame takes from start to file, drawing alone, and encoding alone.
fn round(panels: &str) -> Result<[f64; 3], String> {
    // A new one each time: where files were just removed a file system makes new ones slowly.
    let folder = tempfile::tempdir().expect("a directory for frames");
    // Without the start of the program, which is not a frame's doing.
    let seconds_a_frame = |format: &str| -> Result<f64, String> {
        let capture = |frames| capture(folder.path(), panels, format, frames);
        Ok((capture(FRAMES + FEW)? - capture(FEW)?) / f64::from(FRAMES))
    };
    let (drawing, whole) = (seconds_a_frame("rgba")?, seconds_a_frame("png")?);
    let picture = folder.path().join(format!("{FEW}/frame-000001.png"));
    let rgba = image::open(picture).expect("a frame of ours").into_rgba8().into_raw();
    let start = Instant::now();
    for _ in 0..FRAMES {
        std::hint::black_box((png::encode(SIZE_PX, &rgba), fingerprint(&rgba)));
    }
    Ok([whole, drawing, start.elapsed().as_secs_f64() / f64::from(FRAMES)])
}

/// How many seconds a run of the program takes, or what it said where it failed.
fn capture(folder: &Path, panels: &str, format: &str, frames: u32) -> Result<f64, String> {
    let frames = frames.to_string();
    let out = if format == "png" { &*frames } else { "-" };
    let start = Instant::now();
    let output = Command::new(env!("CARGO_BIN_EXE_regatta"))
        .args(["capture", "--scene", "harbour", "--race", "--size", "1280x720"])
        .args(["--panels", panels, "--format", format, "--out", out, "--frames", &frames])
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
