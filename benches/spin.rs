//! What the step of a body that turns in space costs beside that of a spring, and a frame of it beside one of a spring.
//!
//! `cargo bench --bench spin` prints each gyroscopic method in steps of Runge-Kutta on a spring, and the frame of the
//! scene `coin` at 1280×720 by the processor, as PNG, in frames of `spring`. The two take turns in one process.

mod beside_spring;

use std::hint::black_box;
use std::num::NonZero;
use std::time::Instant;

use beside_spring::{ROUNDS, SPRING, median, stepper, stretch_ns};
use regatta::scene::Scene;
use regatta::sim::Solver;
use regatta::sim::integrators::{METHODS, method};
use regatta::studio::Studio;
use regatta::view::{CpuExecutor, FrameRenderer, png};

const SIZE_PX: [u32; 2] = [1280, 720];
const FRAMES: usize = 120;
/// A frame at 60 a second.
const FRAME_NS: i64 = 16_666_667;

/// Moments, spin, attitude, mass and kick.
const COIN: [f64; 14] = [1.0, 2.0, 1.0, 0.3, 6.0, 0.2, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];

/// A run with panels, and its pictures.
struct Film {
    studio: Studio,
    renderer: FrameRenderer,
    executor: CpuExecutor,
    rgba: Vec<u8>,
}

impl Film {
    fn of(scene: &str) -> Self {
        let studio = Studio::new(Scene::built_in(scene).expect("a built-in scene"));
        let executor = CpuExecutor::new(NonZero::<usize>::MIN);
        Self { studio, renderer: FrameRenderer::new(4096), executor, rgba: Vec::new() }
    }

    fn frame_ms(&mut self) -> f64 {
        let start = Instant::now();
        self.studio.advance(FRAME_NS);
        let time = Some(self.studio.race().t());
        let input = egui::RawInput { time, ..Default::default() };
        let (_, layout) = self.renderer.lay_out(SIZE_PX, 1.0, input, &self.studio);
        let output = self.renderer.paint(SIZE_PX, layout);
        self.executor.execute(&output.drawing, &mut self.rgba);
        black_box(png::encode(SIZE_PX, &self.rgba));
        start.elapsed().as_secs_f64() * 1e3
    }
}

fn main() {
    let mut spring =
        stepper("spring", &SPRING, Solver::Method(method("rk4").expect("a built-in method")));
    let spring_start = [spring.q().to_vec(), spring.v().to_vec()];
    for card in METHODS.iter().filter(|card| card.is_for_spin()) {
        let mut coin = stepper("tumble", &COIN, Solver::Method(card));
        let start = [coin.q().to_vec(), coin.v().to_vec()];
        let rounds = (0..ROUNDS).map(|_| {
            let ns = stretch_ns(&mut *coin, &start);
            [ns, ns / stretch_ns(&mut *spring, &spring_start)]
        });
        let rounds: Vec<[f64; 2]> = rounds.collect();
        let of = |i: usize| median(rounds.iter().map(|round| round[i]).collect());
        println!("{:22} {:7.1} ns {:6.2} x a spring under rk4", card.id, of(0), of(1));
    }
    let [mut coin, mut spring] = ["coin", "spring"].map(Film::of);
    let rounds: Vec<[f64; 2]> = (0..FRAMES).map(|_| [coin.frame_ms(), spring.frame_ms()]).collect();
    let of = |i: usize| median(rounds.iter().map(|round| round[i]).collect());
    println!("a frame of coin {:.2} ms, of spring {:.2} ms", of(0), of(1));
    println!("frames of coin a second, in those of spring: {:.2}", of(1) / of(0));
}
