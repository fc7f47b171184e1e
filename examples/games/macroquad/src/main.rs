//! Lantern, a game with macroquad: a lantern hangs on an elastic from the mouse, and puts out the sparks that it meets.
//!
//! The motion is stepped at 60 Hz whatever the display does, and drawn between ticks. A digit swaps the method in flight:
//! with 2, explicit Euler, the lantern swings wider by itself.

use macroquad::prelude::*;
use regatta::glam::DVec2;
use regatta::prelude::{
    Clock, Integrator, State as Motion, StepFailure, System, integrator, method,
};

const TICK_HZ: u32 = 60;
const METHODS: [&str; 4] = ["velocity-verlet", "explicit-euler", "rk4", "implicit-midpoint"];
const PIXELS_PER_M: f64 = 200.0;
const REACH_M: f64 = 0.15;

/// A lantern of 1 kg on an elastic, which is slack below its length.
struct Lantern {
    hand_m: DVec2,
    /// Number of moves of the hand, by which methods with a memory know that the force has jumped.
    moves: u64,
}

impl System for Lantern {
    type Vector = DVec2;

    fn acceleration(&self, _t: f64, q: &DVec2, v: &DVec2, a: &mut DVec2) {
        let rope = self.hand_m - *q;
        let length = rope.length();
        let stretch = (length - 0.4).max(0.0);
        let pull = if length > 0.0 { rope / length * (90.0 * stretch) } else { DVec2::ZERO };
        *a = DVec2::new(0.0, 9.81) + pull - 0.3 * *v;
    }

    fn generation(&self) -> u64 {
        self.moves
    }
}

struct Game {
    lantern: Lantern,
    motion: Motion<DVec2>,
    previous: Motion<DVec2>,
    chosen: usize,
    stepper: Box<dyn Integrator<Lantern>>,
    tick: u64,
    spark_m: DVec2,
    score: u32,
}

impl Game {
    fn new() -> Self {
        let motion = Motion { q: DVec2::new(2.0, 1.5), v: DVec2::ZERO };
        let lantern = Lantern { hand_m: DVec2::new(2.0, 1.0), moves: 0 };
        let spark_m = DVec2::new(1.0, 2.0);
        let stepper = stepper_of(0, &motion);
        Self { lantern, motion, previous: motion, chosen: 0, stepper, tick: 0, spark_m, score: 0 }
    }

    /// Puts another method under the lantern, which goes on from its state.
    fn choose(&mut self, chosen: usize) {
        (self.chosen, self.stepper) = (chosen, stepper_of(chosen, &self.motion));
    }

    fn tick(&mut self, hand_m: DVec2, dt_s: f64) -> Result<(), StepFailure> {
        if hand_m != self.lantern.hand_m {
            (self.lantern.hand_m, self.lantern.moves) = (hand_m, self.lantern.moves + 1);
        }
        self.previous = self.motion;
        self.stepper.step(&self.lantern, self.tick as f64 * dt_s, dt_s, &mut self.motion)?;
        self.tick += 1;
        if !self.motion.is_finite() {
            let before = self.chosen;
            *self = Self { score: self.score, ..Self::new() };
            self.choose(before);
        }
        if self.motion.q.distance(self.spark_m) < REACH_M {
            self.score += 1;
            // The next spark, from whole numbers, so that a replay has the same one.
            let (x, y) = (self.score * 37 % 300, self.score * 53 % 200);
            self.spark_m = DVec2::new(0.5 + f64::from(x) / 100.0, 0.5 + f64::from(y) / 100.0);
        }
        Ok(())
    }
}

fn stepper_of(chosen: usize, motion: &Motion<DVec2>) -> Box<dyn Integrator<Lantern>> {
    integrator(method(METHODS[chosen]).expect("a built-in method"), &motion.q)
}

/// A place in pixels. Only here doubles become floats.
fn px(place_m: DVec2) -> Vec2 {
    let [x, y] = (place_m * PIXELS_PER_M).to_array();
    vec2(x as f32, y as f32)
}

#[macroquad::main("Lantern")]
async fn main() -> Result<(), StepFailure> {
    let (mut game, mut clock) = (Game::new(), Clock::new(TICK_HZ));
    loop {
        let keys = [KeyCode::Key1, KeyCode::Key2, KeyCode::Key3, KeyCode::Key4];
        if let Some(chosen) = keys.iter().position(|key| is_key_pressed(*key)) {
            game.choose(chosen);
        }
        let (x, y) = mouse_position();
        let hand_m = DVec2::new(f64::from(x), f64::from(y)) / PIXELS_PER_M;
        let frame_ns = (f64::from(get_frame_time()) * 1e9) as i64;
        for _ in 0..clock.advance(frame_ns).ticks {
            game.tick(hand_m, clock.dt_s())?;
        }
        let (hand, spark) = (px(game.lantern.hand_m), px(game.spark_m));
        let lantern = px(game.previous.lerp(&game.motion, clock.alpha()).q);
        clear_background(Color::from_hex(0x10_1c_2c));
        draw_line(hand.x, hand.y, lantern.x, lantern.y, 2.0, GRAY);
        draw_circle(spark.x, spark.y, 6.0, ORANGE);
        draw_circle(lantern.x, lantern.y, (REACH_M * PIXELS_PER_M) as f32, GOLD);
        let told = format!("{} sparks. 1 to 4: {}", game.score, METHODS[game.chosen]);
        draw_text(&told, 16.0, 32.0, 28.0, WHITE);
        next_frame().await;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every player, on every machine, reaches this state after these moves: a replay and a lockstep depend on it.
    #[test]
    fn a_replay_of_ten_seconds_ends_in_the_same_bits_under_each_method() {
        let ends: Vec<u64> = (0..METHODS.len())
            .map(|chosen| {
                let mut game = Game::new();
                game.choose(chosen);
                for tick in 0..600 {
                    let hand_m = DVec2::new(2.0 + f64::from(tick / 60 % 3) * 0.2, 1.0);
                    game.tick(hand_m, Clock::new(TICK_HZ).dt_s()).unwrap();
                }
                game.motion.bits_hash()
            })
            .collect();
        let kept = [
            0x04cd_31bf_0c35_d2a2,
            0x08ef_571a_b460_345c,
            0xfac2_3ab9_a3ff_047c,
            0xdb24_0c43_fe7f_3994,
        ];
        assert_eq!(ends, kept, "{ends:#x?}");
    }
}
