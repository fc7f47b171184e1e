//! Slingshot, a game with Bevy: fly a probe around a star to the beacons. The arrow keys fire its engines.
//!
//! The motion is stepped in `FixedUpdate` at 50 Hz, and drawn between ticks. A digit swaps the method in flight: with 2,
//! explicit Euler, the probe leaves the star by itself.

use bevy::color::palettes::css::{GOLD, GRAY, ORANGE, WHITE};
use bevy::prelude::*;
use regatta::glam::DVec2;
use regatta::prelude::beside::*;

const TICK_HZ: f64 = 50.0;
const METHODS: [&str; 4] = ["velocity-verlet", "explicit-euler", "rk4", "implicit-midpoint"];
const PIXELS_PER_M: f64 = 120.0;
const REACH_M: f64 = 0.2;
const LOST_M: f64 = 5.0;

/// A probe in the pull of a star of 4 m³/s², which is soft inside.
#[derive(Default)]
struct Pull {
    /// Acceleration by its engines, in m/s².
    thrust: DVec2,
    /// Number of changes of the thrust, by which methods with a memory know that the force has jumped.
    changes: u64,
}

impl MotionSystem for Pull {
    type Vector = DVec2;

    fn acceleration(&self, _t: f64, q: &DVec2, _v: &DVec2, a: &mut DVec2) {
        let square = q.length_squared() + 0.01;
        *a = self.thrust - *q * (4.0 / (square * square.sqrt()));
    }

    fn generation(&self) -> u64 {
        self.changes
    }
}

#[derive(Component)]
struct Probe {
    pull: Pull,
    motion: MotionState<DVec2>,
    previous: MotionState<DVec2>,
    chosen: usize,
    stepper: Box<dyn Integrator<Pull>>,
    tick: u32,
    beacon_m: DVec2,
    score: u32,
}

impl Probe {
    fn new(chosen: usize) -> Self {
        let motion = MotionState { q: DVec2::new(2.0, 0.0), v: DVec2::new(0.0, 1.4) };
        let (stepper, beacon_m) = (stepper_of(chosen, &motion), DVec2::new(0.0, 2.2));
        let pull = Pull::default();
        Self { pull, motion, previous: motion, chosen, stepper, tick: 0, beacon_m, score: 0 }
    }

    /// Puts another method under the probe, which goes on from its state.
    fn choose(&mut self, chosen: usize) {
        (self.chosen, self.stepper) = (chosen, stepper_of(chosen, &self.motion));
    }

    fn burn(&mut self, thrust: DVec2) {
        if thrust != self.pull.thrust {
            self.pull = Pull { thrust, changes: self.pull.changes + 1 };
        }
    }

    fn tick(&mut self, dt_s: f64) -> Result<(), StepFailure> {
        self.previous = self.motion;
        self.stepper.step(&self.pull, f64::from(self.tick) * dt_s, dt_s, &mut self.motion)?;
        self.tick += 1;
        if !self.motion.is_finite() || self.motion.q.length() > LOST_M {
            *self = Self { score: self.score, ..Self::new(self.chosen) };
        }
        if self.motion.q.distance(self.beacon_m) < REACH_M {
            self.score += 1;
            // The next beacon, from whole numbers, so that a replay has the same one.
            let (x, y) = (self.score * 37 % 50, self.score * 53 % 40);
            self.beacon_m = DVec2::new(f64::from(x) / 10.0 - 2.5, f64::from(y) / 10.0 - 2.0);
        }
        Ok(())
    }
}

fn stepper_of(chosen: usize, motion: &MotionState<DVec2>) -> Box<dyn Integrator<Pull>> {
    integrator(method(METHODS[chosen]).expect("a built-in method"), &motion.q)
}

/// A place in pixels. Only here doubles become floats.
fn px(place_m: DVec2) -> Vec2 {
    (place_m * PIXELS_PER_M).as_vec2().to_array().into()
}

fn fly(mut probe: Single<&mut Probe>, keys: Res<ButtonInput<KeyCode>>, time: Res<Time>) -> Result {
    let held = |key| f64::from(u8::from(keys.pressed(key)));
    let right = held(KeyCode::ArrowRight) - held(KeyCode::ArrowLeft);
    let up = held(KeyCode::ArrowUp) - held(KeyCode::ArrowDown);
    probe.burn(DVec2::new(right, up));
    Ok(probe.tick(time.delta_secs_f64())?)
}

fn swap(mut probe: Single<&mut Probe>, keys: Res<ButtonInput<KeyCode>>) {
    let digits = [KeyCode::Digit1, KeyCode::Digit2, KeyCode::Digit3, KeyCode::Digit4];
    if let Some(chosen) = digits.iter().position(|digit| keys.just_pressed(*digit)) {
        probe.choose(chosen);
    }
}

fn draw(
    probe: Single<&Probe>,
    time: Res<Time<Fixed>>,
    mut window: Single<&mut Window>,
    mut lines: Gizmos,
) {
    let place_m = probe.previous.lerp(&probe.motion, time.overstep_fraction_f64()).q;
    lines.circle_2d(Vec2::ZERO, 24.0, GOLD);
    lines.circle_2d(px(probe.beacon_m), 8.0, ORANGE);
    lines.circle_2d(px(place_m), (REACH_M * PIXELS_PER_M) as f32, WHITE);
    lines.line_2d(px(place_m), px(place_m - probe.pull.thrust / 2.0), GRAY);
    let told = format!("{} beacons. 1 to 4: {}", probe.score, METHODS[probe.chosen]);
    window.title = format!("Slingshot: {told}");
}

fn main() {
    App::new()
        .add_plugins(DefaultPlugins)
        .insert_resource(Time::<Fixed>::from_hz(TICK_HZ))
        .insert_resource(ClearColor(Color::srgb_u8(0x10, 0x1c, 0x2c)))
        .add_systems(Startup, |mut commands: Commands| {
            commands.spawn(Camera2d);
            commands.spawn(Probe::new(0));
        })
        .add_systems(FixedUpdate, fly)
        .add_systems(Update, (swap, draw))
        .run();
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every player, on every machine, flies this burn to the same bits: a replay and a lockstep depend on it.
    #[test]
    fn a_replay_of_a_burn_ends_in_the_same_bits_under_each_method() {
        let ends: Vec<u64> = (0..METHODS.len())
            .map(|chosen| {
                let mut probe = Probe::new(chosen);
                for tick in 0..500 {
                    probe.burn(if tick % 100 < 20 { DVec2::NEG_X } else { DVec2::ZERO });
                    probe.tick(1.0 / TICK_HZ).unwrap();
                }
                probe.motion.bits_hash()
            })
            .collect();
        let kept = [
            0x00bf_4c8e_1c23_f1e0,
            0x2250_22f4_9844_913e,
            0xe074_93b7_12be_4fe1,
            0xeeb9_02fe_1d07_e9a5,
        ];
        assert_eq!(ends, kept, "{ends:#x?}");
    }
}
