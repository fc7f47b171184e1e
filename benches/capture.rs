//! What a capture does in a second, as the program is used, and how much of its time is its slowest
//! stage's.

use std::process::{Command, Stdio};
use std::time::Instant;

use regatta::commands::manifest::fingerprint;
use regatta::view::png;

const FRAMES: u32 = 300;
/// Nothing is drawn by then that the first second does not show.
const FEW: u32 = 2;
const SIZE_PX: [u32; 2] = [1280, 720];
/// The aims, in frames a second and as a ratio, on two cores with a software adapter.
const FEWEST_WITH_PANELS: f64 = 60.0;
const FEWEST_WITHOUT: f64 = 150.0;
const MOST_OF_SLOWEST_STAGE: f64 = 1.15;

fn main() {
    let folder = tempfile::tempdir().expect("a directory for frames");
    for (panels, fewest) in [("on", FEWEST_WITH_PANELS), ("off", FEWEST_WITHOUT)] {
        let run = |format: &str, frames: u32| {
            // Into a folder of its own: where files were just removed a file system makes new ones slowly.
            let folder_of_run = format!("{panels}-{frames}");
            let out = if format == "png" { &*folder_of_run } else { "-" };
            let start = Instant::now();
            let output = Command::new(env!("CARGO_BIN_EXE_regatta"))
                .args(["capture", "--scene", "harbour", "--race", "--size", "1280x720"])
                .args(["--panels", panels, "--format", format, "--out", out])
                .args(["--frames", &frames.to_string()])
                .current_dir(folder.path())
                .stdout(Stdio::null())
                .output()
                .expect("the program starts");
            let said = String::from_utf8_lossy(&output.stderr).into_owned();
            output.status.success().then(|| start.elapsed().as_secs_f64()).ok_or(said)
        };
        // Without the start of the program, which is not a frame's doing.
        let seconds_a_frame = |format: &str| -> Result<f64, String> {
            let more = run(format, FRAMES + FEW)? - run(format, FEW)?;
            Ok(more / f64::from(FRAMES))
        };
        let measured = seconds_a_frame("rgba").and_then(|drawing| {
            let whole = seconds_a_frame("png")?;
            Ok((drawing, whole))
        });
        let (drawing, whole) = match measured {
            Ok(measured) => measured,
            Err(said) => return println!("SKIPPED capture: {said}"),
        };
        let picture = folder.path().join(format!("{panels}-{FEW}/frame-000001.png"));
        let rgba = image::open(picture).expect("a frame of ours").into_rgba8().into_raw();
        let start = Instant::now();
        for _ in 0..FRAMES {
            std::hint::black_box((png::encode(SIZE_PX, &rgba), fingerprint(&rgba)));
        }
        let encoding = start.elapsed().as_secs_f64() / f64::from(FRAMES);

        let (fps, ratio) = (1.0 / whole, whole / drawing.max(encoding));
        println!(
            "harbour, race, 1280x720, panels {panels}: {fps:.0} frames a second; a frame takes \
             {:.2} ms, drawing alone {:.2} ms, encoding alone {:.2} ms",
            1e3 * whole,
            1e3 * drawing,
            1e3 * encoding
        );
        let holds = |held: bool| if held { "holds" } else { "MISSED" };
        println!(
            "aims: {fewest} frames a second {}; {ratio:.2} of the slowest stage, at most \
             {MOST_OF_SLOWEST_STAGE}, {}",
            holds(fps >= fewest),
            holds(ratio <= MOST_OF_SLOWEST_STAGE)
        );
    }
}
