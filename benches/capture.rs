//! Frames per second of a capture, as the program is used, and the processor time that a frame takes, against that of its
//! stages alone: drawing and encoding. All take turns; the figures are medians over the rounds. How many frames that is in
//! a second, and how the stages share two processors, is the machine's doing, and no aim.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;

use regatta::commands::manifest::fingerprint;
use regatta::scene::Scene;
use regatta::studio::{StageCommand, Studio};
use regatta::view::{OffscreenRenderer, Panels, png};

const ROUNDS: usize = 5;
const FRAMES: u32 = 300;
/// Nothing is drawn by then that the first second does not show.
const FEW: u32 = 2;
const SIZE_PX: [u32; 2] = [1280, 720];
/// Frames in a second of the run, for the program and for its stages alone: a later moment has more to draw.
const FPS: u32 = 30;
/// The aims: drawing with panels and without, in times of encoding, and the whole in times of its stages. The first two are
/// a sixth above what was measured.
const MAX_WITH_PANELS: f64 = 7.0;
const MAX_WITHOUT: f64 = 5.5;
const MAX_OF_STAGES: f64 = 1.2;

fn main() {
    for (panels, most) in [(Panels::Shown, MAX_WITH_PANELS), (Panels::Off, MAX_WITHOUT)] {
        let rounds: Vec<Round> = (0..ROUNDS).map(|_| round(panels)).collect();
        let of = |part: fn(&Round) -> f64| median(rounds.iter().map(part).collect());
        let (fps, work) = (1.0 / of(|round| round.whole.wall_s), of(|round| round.whole.cpu_s));
        println!(
            "harbour, race, 1280x720, panels {panels:?}: {fps:.0} frames per second; processor time per \
             frame {:.2} ms: drawing alone {:.2} ms, encoding alone {:.2} ms",
            1e3 * work,
            1e3 * of(|round| round.drawing_cpu_s),
            1e3 * of(|round| round.encoding_cpu_s),
        );
        let ratio = of(|round| round.whole.cpu_s / (round.drawing_cpu_s + round.encoding_cpu_s));
        let drawing = of(|round| round.drawing_cpu_s / round.encoding_cpu_s);
        let holds = |held: bool| if held { "holds" } else { "MISSED" };
        println!(
            "aims: drawing takes {drawing:.1} times encoding, at most {most}, {}; processor time {ratio:.2} of the \
             stages' together, at most {MAX_OF_STAGES}, {}",
            holds(drawing <= most),
            holds(ratio <= MAX_OF_STAGES)
        );
    }
}

/// What a frame takes, in seconds of the clock and of all processors together.
#[derive(Clone, Copy)]
struct Spent {
    wall_s: f64,
    cpu_s: f64,
}

struct Round {
    whole: Spent,
    drawing_cpu_s: f64,
    encoding_cpu_s: f64,
}

fn round(panels: Panels) -> Round {
    // A new one each time: where files were just removed a file system makes new ones slowly.
    let folder = tempfile::tempdir().expect("a directory for frames");
    let capture = |frames| capture(folder.path(), panels, frames);
    let (all, start_up) = (capture(FRAMES + FEW), capture(FEW));
    // Without the start of the program, which is not a frame's doing.
    let of_frame = |all: f64, start_up: f64| (all - start_up) / f64::from(FRAMES);
    let whole = Spent {
        wall_s: of_frame(all.wall_s, start_up.wall_s),
        cpu_s: of_frame(all.cpu_s, start_up.cpu_s),
    };
    let (drawing_cpu_s, encoding_cpu_s) = stages(panels);
    Round { whole, drawing_cpu_s, encoding_cpu_s }
}

/// Processor time, in seconds, that it takes to draw a frame of the run, and to encode one.
fn stages(panels: Panels) -> (f64, f64) {
    let renderer = OffscreenRenderer::new(SIZE_PX, 1.0).expect("a small frame");
    let mut renderer = renderer.with_panels(panels);
    let mut studio = Studio::new(Scene::built_in("harbour").expect("a built-in scene"));
    studio.apply(StageCommand::ToggleRace);
    studio.analyse();
    // All frames first drawn and then encoded: the system counts processor time too coarsely for one frame.
    let mut frames = Vec::new();
    let start = processor_s(Whose::Own);
    for _ in 0..FRAMES {
        studio.advance(1_000_000_000 / i64::from(FPS));
        let mut rgba = Vec::new();
        renderer.draw(&studio, &mut rgba).expect("the processor never fails");
        frames.push(rgba);
    }
    let drawn = processor_s(Whose::Own);
    for rgba in &frames {
        std::hint::black_box((png::encode(SIZE_PX, rgba), fingerprint(rgba)));
    }
    let encoded = processor_s(Whose::Own);
    let of_frame = |seconds: f64| seconds / f64::from(FRAMES);
    (of_frame(drawn - start), of_frame(encoded - drawn))
}

#[derive(Clone, Copy)]
enum Whose {
    Own,
    Children,
}

/// The processor time taken by now, in seconds, by the user's code and by the system for it; 0 where the system does not
/// tell as Linux does.
fn processor_s(whose: Whose) -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    // After the program's name, which may hold blanks; the fields are numbered in proc(5).
    let fields: Vec<&str> =
        stat.rsplit(')').next().unwrap_or_default().split_whitespace().collect();
    let field = |number: usize| fields.get(number - 3).and_then(|x| x.parse::<f64>().ok());
    let [user, system] = match whose {
        Whose::Own => [14, 15],
        Whose::Children => [16, 17],
    };
    let ticks = field(user).unwrap_or(0.0) + field(system).unwrap_or(0.0);
    ticks / TICKS_PER_S
}

/// In which Linux counts it.
const TICKS_PER_S: f64 = 100.0;

/// What a run of the program takes.
fn capture(folder: &Path, panels: Panels, frames: u32) -> Spent {
    let (frames, fps) = (frames.to_string(), FPS.to_string());
    let panels = if panels == Panels::Off { "off" } else { "on" };
    let (start, before) = (Instant::now(), processor_s(Whose::Children));
    let output = Command::new(env!("CARGO_BIN_EXE_regatta"))
        .args(["capture", "--scene", "harbour", "--race", "--size", "1280x720"])
        .args(["--panels", panels, "--format", "png", "--out", &frames])
        .args(["--frames", &frames, "--fps", &fps])
        .current_dir(folder)
        .stdout(Stdio::null())
        .output()
        .expect("the program starts");
    let spent = Spent {
        wall_s: start.elapsed().as_secs_f64(),
        cpu_s: processor_s(Whose::Children) - before,
    };
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    spent
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
