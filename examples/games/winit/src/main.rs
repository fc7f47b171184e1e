//! Lander, a game with winit and softbuffer: land on the pad, slower than 2 m/s. The arrow keys fire its engines.
//!
//! The motion is stepped at 30 Hz, drawn between ticks at the rate of the display. M swaps the method in flight: with
//! explicit Euler the same burns land elsewhere.

use std::num::NonZeroU32;
use std::rc::Rc;
use std::time::Instant;

use regatta::glam::DVec2;
use regatta::prelude::{Clock, Integrator, State as Motion, System, integrator, method};
use softbuffer::{Context, Surface};
use winit::application::ApplicationHandler;
use winit::event::{ElementState, WindowEvent};
use winit::event_loop::{ActiveEventLoop, EventLoop};
use winit::keyboard::{KeyCode, PhysicalKey};
use winit::window::{Window, WindowId};

const TICK_HZ: u32 = 30;
const METHODS: [&str; 3] = ["rk4", "velocity-verlet", "explicit-euler"];
const PIXELS_PER_M: f64 = 8.0;
const WIDTH_M: f64 = 100.0;

/// A lander in thin air.
#[derive(Default)]
struct Lander {
    /// Acceleration by its engines, in m/s².
    thrust: DVec2,
    /// Number of changes of the thrust, by which methods with a memory know that the force has jumped.
    changes: u64,
}

impl System for Lander {
    type Vector = DVec2;

    fn acceleration(&self, _t: f64, _q: &DVec2, v: &DVec2, a: &mut DVec2) {
        *a = DVec2::new(0.0, -1.62) + self.thrust - 0.002 * v.length() * *v;
    }

    fn generation(&self) -> u64 {
        self.changes
    }
}

struct Game {
    lander: Lander,
    motion: Motion<DVec2>,
    previous: Motion<DVec2>,
    chosen: usize,
    stepper: Box<dyn Integrator<Lander>>,
    tick: u64,
    told: String,
}

impl Game {
    fn new(chosen: usize) -> Self {
        let motion = Motion { q: DVec2::new(20.0, 70.0), v: DVec2::new(8.0, 0.0) };
        let stepper = integrator(method(METHODS[chosen]).expect("a built-in method"), &motion.q);
        let told = "land on the pad in the middle".into();
        Self { lander: Lander::default(), motion, previous: motion, chosen, stepper, tick: 0, told }
    }

    /// Puts the next method under the lander, which goes on from its state.
    fn next_method(&mut self) {
        let next = Self::new((self.chosen + 1) % METHODS.len());
        (self.chosen, self.stepper) = (next.chosen, next.stepper);
    }

    fn burn(&mut self, thrust: DVec2) {
        if thrust != self.lander.thrust {
            self.lander = Lander { thrust, changes: self.lander.changes + 1 };
        }
    }

    fn tick(&mut self, dt_s: f64) {
        self.previous = self.motion;
        let stepped =
            self.stepper.step(&self.lander, self.tick as f64 * dt_s, dt_s, &mut self.motion);
        self.tick += 1;
        let Motion { q, v } = self.motion;
        if stepped.is_err() || !self.motion.is_finite() || q.y <= 0.0 {
            let is_soft = v.length() < 2.0 && (q.x - WIDTH_M / 2.0).abs() < 6.0;
            let told = if is_soft { "landed" } else { "crashed" };
            *self =
                Self { told: format!("{told} at {:.1} m/s", v.length()), ..Self::new(self.chosen) };
        }
    }
}

#[derive(Default)]
struct App {
    screen: Option<(Rc<Window>, Surface<Rc<Window>, Rc<Window>>)>,
    play: Option<(Game, Clock, Instant)>,
    held: [bool; 3],
}

impl ApplicationHandler for App {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        let window = event_loop.create_window(Window::default_attributes().with_title("Lander"));
        let window = Rc::new(window.expect("a window"));
        let context = Context::new(Rc::clone(&window)).expect("a display");
        let surface = Surface::new(&context, Rc::clone(&window)).expect("a surface");
        self.screen = Some((window, surface));
        self.play = Some((Game::new(0), Clock::new(TICK_HZ), Instant::now()));
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let (Some((window, surface)), Some((game, clock, drawn))) =
            (&mut self.screen, &mut self.play)
        else {
            return;
        };
        match event {
            WindowEvent::CloseRequested => event_loop.exit(),
            WindowEvent::KeyboardInput { event, .. } if !event.repeat => {
                let is_down = event.state == ElementState::Pressed;
                match event.physical_key {
                    PhysicalKey::Code(KeyCode::ArrowLeft) => self.held[0] = is_down,
                    PhysicalKey::Code(KeyCode::ArrowUp) => self.held[1] = is_down,
                    PhysicalKey::Code(KeyCode::ArrowRight) => self.held[2] = is_down,
                    PhysicalKey::Code(KeyCode::KeyM) if is_down => game.next_method(),
                    _ => {}
                }
                let [left, up, right] = self.held.map(|is_held| f64::from(u8::from(is_held)));
                game.burn(DVec2::new(2.0 * (right - left), 4.0 * up));
            }
            WindowEvent::RedrawRequested => {
                for _ in
                    0..clock.advance_by(std::mem::replace(drawn, Instant::now()).elapsed()).ticks
                {
                    game.tick(clock.dt_s());
                }
                window.set_title(&format!("Lander by {} (M): {}", METHODS[game.chosen], game.told));
                let place_m = game.previous.lerp(&game.motion, clock.alpha()).q;
                draw(surface, window.inner_size().into(), place_m);
                window.request_redraw();
            }
            _ => {}
        }
    }
}

/// Fills the sky, the ground with its pad, and the lander.
fn draw(surface: &mut Surface<Rc<Window>, Rc<Window>>, [width, height]: [u32; 2], place_m: DVec2) {
    let (Some(w), Some(h)) = (NonZeroU32::new(width), NonZeroU32::new(height)) else { return };
    surface.resize(w, h).expect("a size");
    let mut pixels = surface.buffer_mut().expect("pixels");
    for (at, pixel) in (0..).zip(pixels.iter_mut()) {
        let right_m = f64::from(at % width) / PIXELS_PER_M;
        let up_m = (f64::from(height) - 20.0 - f64::from(at / width)) / PIXELS_PER_M;
        let is_pad = up_m < 0.0 && (right_m - WIDTH_M / 2.0).abs() < 6.0;
        *pixel = match DVec2::new(right_m, up_m).distance(place_m + DVec2::Y) {
            distance if distance < 1.0 => 0x00f0_c040,
            _ if is_pad => 0x0040_c080,
            _ if up_m < 0.0 => 0x0050_5860,
            _ => 0x0010_1c2c,
        };
    }
    pixels.present().expect("a screen");
}

fn main() -> Result<(), winit::error::EventLoopError> {
    EventLoop::new()?.run_app(&mut App::default())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every player, on every machine, flies this burn to the same bits: a replay and a lockstep depend on it.
    #[test]
    fn a_replay_of_a_burn_ends_in_the_same_bits_under_each_method() {
        let ends: Vec<u64> = (0..METHODS.len())
            .map(|chosen| {
                let mut game = Game::new(chosen);
                for tick in 0..240 {
                    game.burn(DVec2::new(-1.0, if tick > 90 { 4.0 } else { 0.0 }));
                    game.tick(Clock::new(TICK_HZ).dt_s());
                }
                game.motion.bits_hash()
            })
            .collect();
        let kept = [0xeb87_9cae_fee9_d5bc, 0xe30a_9f60_e797_1ddf, 0x9f42_2d67_3964_f440];
        assert_eq!(ends, kept, "{ends:#x?}");
    }
}
