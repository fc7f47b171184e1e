//! What a frame costs: from events to picture, and with panels and pixels on top; and how long the
//! program takes from its start to the first frame.

use std::hint::black_box;
use std::time::{Duration, Instant};

use regatta::lab::{Command, Lab, Scene, picture};
use regatta::view::{AdapterPreference, Artist, Gpu};

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
    let mut rgba = Vec::new();
    let adapter = format!("{} ({})", gpu.info.name, gpu.info.backend);
    let mut artist = Artist::new(gpu, SIZE_PX, 1.0).expect("1280x720 is within any limit");
    artist.draw(&lab, &mut rgba).expect("a fresh device gives its frame back");
    let first = start.elapsed();

    lab.think();
    for _ in 0..WARM_UP {
        lab.advance(FRAME_NS);
    }
    let picture = median(|| {
        lab.apply(Command::ThrottleDown);
        lab.apply(Command::ThrottleUp);
        lab.advance(FRAME_NS);
        black_box(picture::compose(&lab, STAGE_POINTS));
    });
    let strokes = picture::compose(&lab, STAGE_POINTS).strokes.len();
    let whole = median(|| {
        lab.advance(FRAME_NS);
        artist.draw(&lab, &mut rgba).expect("the device is there");
    });

    println!("harbour, race, {} lanes, {strokes} strokes, {adapter}", lab.entries().len());
    println!("{:44} {:>10.3} ms", "events to picture", millis(picture));
    println!("{:44} {:>10.3} ms", "events to pixels, 1280x720, read back", millis(whole));
    println!("{:44} {:>10.3} ms", "start to first frame", millis(first));
    let holds = |held: bool| if held { "holds" } else { "MISSED" };
    println!(
        "aims: picture below {} ms {}; first frame below {} ms {}",
        millis(MOST_FOR_A_PICTURE),
        holds(picture < MOST_FOR_A_PICTURE),
        millis(MOST_FOR_THE_FIRST_FRAME),
        holds(first < MOST_FOR_THE_FIRST_FRAME),
    );
}

/// The median time of [`FRAMES`] calls.
fn median(mut frame: impl FnMut()) -> Duration {
    let mut times: Vec<Duration> = (0..FRAMES)
        .map(|_| {
            let start = Instant::now();
            frame();
            start.elapsed()
        })
        .collect();
    times.sort();
    times[FRAMES / 2]
}

fn millis(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}
