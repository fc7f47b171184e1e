//! What a frame costs, stage by stage: from events to picture, to pixels, to a file; how long the program takes from its
//! start to the first frame; and how long the parts of a frame take that differ from the frame before, as in a window.

use std::hint::black_box;
use std::num::NonZero;
use std::time::{Duration, Instant};

use regatta::scene::{LaneSpec, Scene};
use regatta::sim::integrators::GENERAL_METHODS;
use regatta::stage;
use regatta::studio::{RunCommand, StageCommand, Studio};
use regatta::view::{CpuExecutor, FrameRenderer, KeptFrame, OffscreenRenderer, Panels, png};

/// A frame at 60 a second.
const FRAME_NS: i64 = 16_666_667;
/// Histories are full by then, so that a frame costs what it will cost for ever.
const WARM_UP: usize = 60 * 40;
const FRAMES: usize = 300;
const SIZE_PX: [u32; 2] = [1280, 720];
/// What the window of that size leaves for the stage, in points.
const STAGE_POINTS: [f32; 2] = [793.0, 532.0];
const MAX_FIRST_FRAME: Duration = Duration::from_secs(1);

fn main() {
    let start = Instant::now();
    let harbour = Scene::built_in("harbour").expect("a built-in scene");
    let mut renderer = OffscreenRenderer::new(SIZE_PX, 1.0).expect("1280x720 is within any limit");
    let first_lab = racing(harbour.clone());
    renderer.draw(&first_lab, &mut Vec::new()).expect("the processor never fails");
    let first = start.elapsed();
    let aim = verdict(first < MAX_FIRST_FRAME, "1000 ms");
    println!("start to first frame {:.0} ms{aim}", millis(first));
    measure(harbour.clone());
    let mut all = harbour;
    all.lanes = GENERAL_METHODS.iter().map(LaneSpec::plain).collect();
    measure(all);
    println!(
        "\nin a window of 1920x1080 with panels, in ms: a frame drawn whole, and where it differs"
    );
    for id in ["spring", "harbour"] {
        let scene = Scene::built_in(id).expect("a built-in scene");
        window(&format!("{id}, running"), Studio::new(scene.clone()), FRAME_NS);
        window(&format!("{id}, racing"), racing(scene.clone()), FRAME_NS);
        window(&format!("{id}, paused"), Studio::new(scene), 0);
    }
}

/// Prints how long the frames of a window take, drawn whole and drawn only where they differ.
fn window(name: &str, mut studio: Studio, frame_ns: i64) {
    const SIZE_PX: [u32; 2] = [1920, 1080];
    let mut renderer = FrameRenderer::new(4096);
    let mut executor = CpuExecutor::new(NonZero::<usize>::MIN);
    let mut kept = KeptFrame::new(NonZero::<usize>::MIN);
    let mut rgba = Vec::new();
    for _ in 0..WARM_UP {
        studio.advance(FRAME_NS);
    }
    let (mut times, mut drawn_px) = ([const { Vec::new() }; 2], 0);
    for frame in 0..2 * FRAMES {
        studio.advance(frame_ns);
        let input = egui::RawInput { time: Some(studio.race().t()), ..Default::default() };
        let (_, output) = renderer.draw(SIZE_PX, 1.0, input, &studio);
        let start = Instant::now();
        executor.execute(&output.drawing, &mut rgba);
        let whole = start.elapsed();
        kept.draw(&output.drawing);
        let differing = start.elapsed() - whole;
        assert!(*kept.pixels().as_flattened() == *rgba, "other pixels");
        // The first frames find the backdrop and the letters.
        if frame >= FRAMES {
            times[0].push(whole);
            times[1].push(differing);
            drawn_px +=
                kept.changed().map(|[.., columns, rows]| columns * rows).sum::<u32>() as usize;
        }
    }
    let [whole, differing] = times.map(|mut times| {
        times.sort();
        millis(times[FRAMES / 2])
    });
    let part = drawn_px as f64 / (FRAMES * kept.pixels().len()) as f64;
    println!(
        "{name:44} {whole:>8.3} {differing:>8.3}  {:.2} times, {:.0} % of the pixels",
        differing / whole,
        100.0 * part,
    );
}

fn racing(scene: Scene) -> Studio {
    let mut studio = Studio::new(scene);
    studio.apply(StageCommand::ToggleRace);
    studio
}

fn measure(scene: Scene) {
    let mut studio = racing(scene);
    studio.analyse();
    for _ in 0..WARM_UP {
        studio.advance(FRAME_NS);
    }
    let shapes = stage::compose(&studio, STAGE_POINTS).shapes.len();
    let lanes = studio.race().entrants().len();
    for panels in [Panels::Shown, Panels::Off] {
        println!("\nharbour, {lanes} lanes, {shapes} shapes, 1280x720, panels {panels:?}");
        println!("{:44} {:>8} {:>8}", "stages of a frame, in ms", "median", "least");
        let frames: Vec<_> = frames(panels, &mut studio).collect();
        let of = |stages: &[usize]| {
            let sums = frames.iter().map(|frame| stages.iter().map(|&stage| frame[stage]).sum());
            let mut sums: Vec<Duration> = sums.collect();
            sums.sort();
            [sums[FRAMES / 2], sums[0]].map(millis)
        };
        let [floor, _] = of(&[ENCODING]);
        for Row { name, stages, aim } in &ROWS {
            let [median, least] = of(stages);
            let aim = aim.map_or(String::new(), |aim| {
                let [ratio, aim] = [median / floor, aim(lanes as f64)];
                verdict(ratio < aim, &format!("{aim:.2} of the PNG, has {ratio:.2}"))
            });
            println!("{name:44} {median:>8.3} {least:>8.3}{aim}");
        }
    }
}

/// The stages of a frame, one after the other.
const STAGES: usize = 6;

/// The stage that all others are held against, for it does the same work whatever we draw.
const ENCODING: usize = 5;

/// A line of the table: the sum of some stages.
struct Row {
    name: &'static str,
    stages: &'static [usize],
    /// The most that is aimed at for so many lanes, in times of [`ENCODING`].
    aim: Option<fn(f64) -> f64>,
}

const ROWS: [Row; 8] = [
    Row { name: "simulation", stages: &[0], aim: None },
    Row { name: "events to picture", stages: &[0, 1], aim: Some(|lanes| 0.06 * lanes) },
    Row { name: "panels and picture laid out", stages: &[2], aim: None },
    Row { name: "simulation, and all laid out", stages: &[0, 2], aim: Some(|_| 2.5) },
    Row { name: "layout to drawing", stages: &[3], aim: None },
    Row { name: "drawing to pixels", stages: &[4], aim: None },
    Row { name: "pixels to PNG", stages: &[ENCODING], aim: None },
    Row { name: "all, the picture once", stages: &[0, 2, 3, 4, ENCODING], aim: None },
];

/// The times that the stages of some frames take.
fn frames(panels: Panels, studio: &mut Studio) -> impl Iterator<Item = [Duration; STAGES]> {
    let mut renderer = FrameRenderer::new(4096).with_panels(panels);
    let mut executor = CpuExecutor::new(NonZero::<usize>::MIN);
    let mut rgba = Vec::new();
    (0..FRAMES).map(move |_| {
        let mut ends = vec![Instant::now()];
        let mut lap = || ends.push(Instant::now());
        studio.apply(RunCommand::ThrottleDown);
        studio.apply(RunCommand::ThrottleUp);
        studio.advance(FRAME_NS);
        lap();
        black_box(stage::compose(studio, STAGE_POINTS));
        lap();
        let input = egui::RawInput { time: Some(studio.race().t()), ..Default::default() };
        let (_, layout) = renderer.lay_out(SIZE_PX, 1.0, input, studio);
        lap();
        let output = renderer.paint(SIZE_PX, layout);
        lap();
        executor.execute(&output.drawing, &mut rgba);
        lap();
        black_box(png::encode(SIZE_PX, &rgba));
        lap();
        std::array::from_fn(|stage| ends[stage + 1] - ends[stage])
    })
}

fn verdict(holds: bool, aim: &str) -> String {
    format!("  aim {aim}: {}", if holds { "holds" } else { "MISSED" })
}

fn millis(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}
