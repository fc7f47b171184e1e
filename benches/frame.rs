//! What a frame costs, stage by stage: from events to picture, to pixels, to a file; and how long the
//! program takes from its start to the first frame.

use std::hint::black_box;
use std::time::{Duration, Instant};

use regatta::lab::{Command, Lab, Scene, picture};
use regatta::view::{
    AdapterPreference, FrameRenderer, Gpu, Offscreen, OffscreenRenderer, Panels, Readback, png,
};

/// A frame at 60 a second.
const FRAME_NS: i64 = 16_666_667;
/// Histories are full by then, so that a frame costs what it will cost for ever.
const WARM_UP: usize = 60 * 40;
const FRAMES: usize = 300;
const SIZE_PX: [u32; 2] = [1280, 720];
/// What the window of that size leaves for the stage, in points.
const STAGE_POINTS: [f32; 2] = [793.0, 532.0];
/// The aims, for `harbour` in race mode.
const MOST_FOR_A_PICTURE: Duration = Duration::from_micros(300);
const MOST_FOR_THE_FIRST_FRAME: Duration = Duration::from_secs(1);

fn main() {
    let start = Instant::now();
    let gpu = match Gpu::headless(AdapterPreference::CpuOnly) {
        Ok(gpu) => gpu,
        Err(error) => return println!("SKIPPED frame: {error}"),
    };
    let mut lab = Lab::new(Scene::built_in("harbour").expect("a built-in scene"));
    lab.apply(Command::ToggleRace);
    let mut renderer =
        OffscreenRenderer::new(gpu.clone(), SIZE_PX, 1.0).expect("1280x720 is within any limit");
    renderer.draw(&lab, &mut Vec::new()).expect("a fresh device gives its frame back");
    let first = start.elapsed();

    lab.analyse();
    for _ in 0..WARM_UP {
        lab.advance(FRAME_NS);
    }
    let shapes = picture::compose(&lab, STAGE_POINTS).shapes.len();
    let adapter = format!("{} ({})", gpu.info.name, gpu.info.backend);
    println!("harbour, race, {} lanes, {shapes} shapes, {adapter}", lab.entries().len());
    let aim = verdict(first < MOST_FOR_THE_FIRST_FRAME, "1000 ms");
    println!("start to first frame {:.0} ms{aim}", millis(first));
    for panels in [Panels::Shown, Panels::Off] {
        println!("\n1280x720, panels {panels:?}: a frame's stages, median and least ms");
        for (name, times) in stages(&gpu, panels, &mut lab) {
            let (median, least) = (times[FRAMES / 2], times[0]);
            let aim = match name {
                PICTURE => verdict(median < MOST_FOR_A_PICTURE, "0.3 ms"),
                _ => String::new(),
            };
            println!("{name:44} {:>8.3} {:>8.3}{aim}", millis(median), millis(least));
        }
    }
}

const PICTURE: &str = "events to picture";

/// The times of each stage of a frame, one after the other, least first.
fn stages(gpu: &Gpu, panels: Panels, lab: &mut Lab) -> [(&'static str, Vec<Duration>); 6] {
    let canvas = Offscreen::new(gpu, SIZE_PX).expect("1280x720 is within any limit");
    let mut renderer = FrameRenderer::new(gpu, Offscreen::FORMAT).with_panels(panels);
    let (mut readback, mut rgba) = (Readback::default(), Vec::new());
    let mut times = [const { Vec::new() }; 5];
    for _ in 0..FRAMES {
        let mut from = Instant::now();
        let mut lap = |stage: usize| {
            times[stage].push(from.elapsed());
            from = Instant::now();
        };
        lab.apply(Command::ThrottleDown);
        lab.apply(Command::ThrottleUp);
        lab.advance(FRAME_NS);
        black_box(picture::compose(lab, STAGE_POINTS));
        lap(0);
        let input = egui::RawInput { time: Some(lab.race().t()), ..Default::default() };
        let (_, output) = renderer.draw(gpu, &canvas.view, SIZE_PX, 1.0, input, lab);
        gpu.queue.submit(output.drawing);
        lap(1);
        let wait = wgpu::PollType::Wait { submission_index: None, timeout: None };
        gpu.device.poll(wait).expect("the device is there");
        lap(2);
        readback.read(gpu, None, &canvas.texture, &mut rgba).expect("the device is there");
        lap(3);
        black_box(png::encode(SIZE_PX, &rgba));
        lap(4);
    }
    let frames: Vec<Duration> =
        (0..FRAMES).map(|frame| times.iter().map(|stage| stage[frame]).sum()).collect();
    let [picture, layout, draw, read, encode] = times;
    let mut stages = [
        (PICTURE, picture),
        ("panels and picture to commands", layout),
        ("commands to pixels", draw),
        ("read back", read),
        ("pixels to PNG", encode),
        ("all of it", frames),
    ];
    stages.iter_mut().for_each(|(_, times)| times.sort());
    stages
}

fn verdict(holds: bool, aim: &str) -> String {
    format!("  aim {aim}: {}", if holds { "holds" } else { "MISSED" })
}

fn millis(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}
