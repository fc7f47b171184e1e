//! The steps in which physics engines bounce a ball on a fixed wall, one for each [`EngineBounce`].
//!
//! They are held against logs of the engines (`tests/library/engines/bounces.rs`). Heights are those of the ball's
//! lowest point above the wall.

use std::f64::consts::PI;

use super::integrators::EngineBounce;

/// A ball near a wall at the start of a tick.
#[derive(Clone, Copy, Debug)]
pub(super) struct NearWall {
    /// Height above the wall, in metres, and speed away from it.
    pub(super) height: f64,
    pub(super) speed: f64,
    /// Acceleration away from the wall.
    pub(super) push: f64,
    pub(super) restitution: f64,
    /// Impulses that the engine keeps from the last tick; 0 at first.
    pub(super) kept: [f64; 2],
    /// Whether the wall pushed in the last tick.
    pub(super) touches: bool,
}

/// Height in metres below which Box2D, Rapier, Jolt and pybullet look for a contact at the start of a tick.
const MARGIN: f64 = 0.02;

impl NearWall {
    /// Advances the ball by a tick of `h` (s) with `n` substeps, by the rule of an engine.
    pub(super) fn tick(&mut self, rule: EngineBounce, h: f64, n: u32) {
        let part = h / f64::from(n);
        let step = match rule {
            EngineBounce::Soft { threshold, is_capped } => {
                return self.soft(part, n, threshold, is_capped);
            }
            EngineBounce::Chipmunk => Self::chipmunk,
            EngineBounce::Jolt => Self::jolt,
            EngineBounce::Pybullet => Self::pybullet,
            EngineBounce::Mujoco => Self::mujoco,
            EngineBounce::Cannon => Self::cannon,
            EngineBounce::P2 => Self::p2,
        };
        (0..n).for_each(|_| step(self, part));
    }

    fn chipmunk(&mut self, h: f64) {
        const ITERATIONS: u32 = 10;
        const SLOP: f64 = 0.1;
        let Self { speed: before, push, restitution, kept: [impulse, out], .. } = *self;
        self.height += h * (before + out);
        self.speed += h * push;
        (self.kept, self.touches) = ([0.0; 2], self.height < 0.0);
        if !self.touches {
            return;
        }
        let bias = -(1.0 - libm::pow(0.9, 60.0 * h)) * (self.height + SLOP).min(0.0) / h;
        let (mut sum, mut out) = (impulse, 0.0_f64);
        self.speed += sum;
        for _ in 0..ITERATIONS {
            out = bias.max(0.0).max(out);
            let next = (sum - restitution * before - self.speed).max(0.0);
            (self.speed, sum) = (self.speed + (next - sum), next);
        }
        self.kept = [sum, out];
    }

    fn jolt(&mut self, h: f64) {
        const SLOP: f64 = 0.02;
        const PART: f64 = 0.2;
        let is_near = self.height < MARGIN;
        let (before, free) = (self.speed, self.speed + h * self.push);
        let gap = self.height.max(0.0) / h;
        let bounces =
            free < -EngineBounce::Jolt.threshold() && -free > gap && self.restitution > 0.0;
        let least = if bounces { -self.restitution * before } else { -gap };
        self.touches = is_near && free < least;
        self.speed = if self.touches { least } else { free };
        self.height += h * self.speed;
        for _ in 0..2 {
            if is_near && self.height < -SLOP {
                self.height += PART * (-SLOP - self.height);
            }
        }
    }

    fn soft(&mut self, h: f64, n: u32, threshold: f64, is_capped: bool) {
        const HERTZ: f64 = 60.0;
        const DAMPING_RATIO: f64 = 10.0;
        const FASTEST_OUT: f64 = -3.0;
        let before = self.speed;
        let hertz = if is_capped { HERTZ.min(0.25 / h) } else { HERTZ };
        let omega = 2.0 * PI * hertz;
        let resistance = 2.0 * DAMPING_RATIO + h * omega;
        let (bias, stiff) = (omega / resistance, h * omega * resistance);
        let (mass, loss) = (stiff / (1.0 + stiff), 1.0 / (1.0 + stiff));
        let is_near = self.height < MARGIN;
        self.touches = false;
        if !is_near {
            self.kept[0] = 0.0;
        }
        for _ in 0..n {
            self.speed += h * self.push;
            if is_near {
                self.speed += self.kept[0];
                let soft = mass * (self.speed + (bias * self.height).max(FASTEST_OUT));
                let change = match self.height > 0.0 {
                    true => -(self.speed + self.height / h),
                    false => -soft - loss * self.kept[0],
                };
                self.solve(change);
            }
            self.height += h * self.speed;
            if is_near {
                self.solve(-(self.speed + self.height.max(0.0) / h));
            }
        }
        if self.touches && before < -threshold {
            self.solve(-(self.speed + self.restitution * before));
        }
    }

    /// Changes the impulse of the wall, which can only push.
    fn solve(&mut self, change: f64) {
        let next = (self.kept[0] + change).max(0.0);
        self.speed += next - self.kept[0];
        self.touches |= next > 0.0;
        self.kept[0] = next;
    }

    fn pybullet(&mut self, h: f64) {
        const SLOP: f64 = 1e-5;
        const PART: f64 = 0.08;
        let is_near = self.height < MARGIN;
        let free = self.speed + h * self.push;
        let bounces = free.abs() >= EngineBounce::Pybullet.threshold();
        let rebound = if bounces { self.restitution * free.abs() } else { 0.0 };
        let gap = self.height + SLOP;
        let closed = if gap > 0.0 { gap } else { PART * gap };
        let least = rebound - closed / h;
        self.touches = is_near && free < least;
        self.speed = if self.touches { least } else { free };
        self.height += h * self.speed;
    }

    fn mujoco(&mut self, h: f64) {
        const STIFFNESS: f64 = 1000.0;
        const IMPEDANCES: [f64; 2] = [0.9, 0.95];
        const WIDTH: f64 = 0.001;
        let [low, high] = IMPEDANCES;
        let part = (-self.height / WIDTH).clamp(0.0, 1.0);
        let rest = 1.0 - part;
        let bend = if part < 0.5 { 2.0 * part * part } else { 1.0 - 2.0 * rest * rest };
        let impedance = low + (high - low) * bend;
        let loss = -libm::log(self.restitution.max(1e-300));
        let damping = 2.0 * STIFFNESS.sqrt() * loss / (PI * PI + loss * loss).sqrt();
        let spring = STIFFNESS * impedance * self.height / (high * high);
        let wanted = -damping * self.speed / high - spring;
        let pushed = (1.0 - impedance) * self.push + impedance * wanted;
        self.touches = self.height < 0.0 && pushed > self.push;
        self.speed += h * if self.touches { pushed } else { self.push };
        self.height += h * self.speed;
    }

    fn cannon(&mut self, h: f64) {
        let [pull, kept, give] = spook(h, 3.0, 1e7);
        let rebound = kept * (1.0 + self.restitution) * self.speed;
        self.overlap(h, -pull * self.height - rebound, give);
    }

    fn p2(&mut self, h: f64) {
        const SKIN: f64 = 0.005;
        let [pull, kept, give] = spook(h, 4.0, 1e6);
        let wanted = match self.touches {
            true => -pull * (self.height + SKIN) - kept * self.speed,
            false => -(1.0 + self.restitution) * self.speed,
        };
        self.overlap(h, wanted, give);
    }

    /// Makes a tick in which a wall that overlaps the ball changes its speed by `wanted`, less what it gives way.
    fn overlap(&mut self, h: f64, wanted: f64, give: f64) {
        self.touches = self.height < 0.0;
        if self.touches {
            self.speed += ((wanted - h * self.push) / (1.0 + give)).max(0.0);
        }
        self.speed += h * self.push;
        self.height += h * self.speed;
    }
}

/// Returns how a contact of the SPOOK solver pulls on the depth, which part of the speed it stops, and how far it gives
/// way. The relaxation is in ticks, the stiffness in N/m.
fn spook(h: f64, relaxation: f64, stiffness: f64) -> [f64; 3] {
    let whole = 1.0 + 4.0 * relaxation;
    [4.0 / (whole * h), 4.0 * relaxation / whole, 4.0 / (whole * h * h * stiffness)]
}
