//! Rules of up to two carried numbers. A frame of such a rule is a map, and a linear rule is the motion of a body.

use nalgebra::{Matrix2, Vector2};

use super::{Powers, StepRegisters, StepText};
use crate::TickRate;

/// If an eigenvalue is this close to 1, the rule stays wherever it is.
pub const NO_RETURN: f64 = 1e-13;
/// A rest this close to the target, relative to the target, is the target up to rounding.
pub const AT_TARGET: f64 = 1e-11;
/// A logarithmic decay per frame below this number is rounding.
const NO_DECAY: f64 = 1e-14;

/// One frame of up to two numbers. The new numbers are `map` times the old ones, plus `by_target` times the target,
/// plus `offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Factors of the old numbers.
    pub map: Matrix2<f64>,
    /// Factors of the target.
    pub by_target: Vector2<f64>,
    /// What is added in any case.
    pub offset: Vector2<f64>,
}

impl Frame {
    /// Returns a frame of `h` seconds of these lines as a map of up to two carried numbers, linearised about 0, on the
    /// piece with these modes of the switches. Returns `None` if there are more numbers, or if a coefficient is not
    /// finite.
    pub fn of(text: &StepText, modes: &[i64], state: &[usize], h: f64) -> Option<Self> {
        if state.len() > 2 {
            return None;
        }
        let rest = vec![0.0; text.carried().len()];
        let found = text.map_on(modes, h, &rest, 0.0);
        let of = |numbers: &[f64]| {
            let mut both = state.iter().map(|index| numbers[*index]);
            Vector2::new(both.next().unwrap_or(0.0), both.next().unwrap_or(0.0))
        };
        let column = |n: usize| state.get(n).map_or(Vector2::zeros(), |n| of(&found.columns[*n]));
        let frame = Self {
            map: Matrix2::from_columns(&[column(0), column(1)]),
            by_target: of(&found.columns[rest.len()]),
            offset: of(&found.values),
        };
        let mut numbers = frame.map.iter().chain(&frame.by_target).chain(&frame.offset);
        numbers.all(|number| number.is_finite()).then_some(frame)
    }

    /// Returns the values of the two numbers at rest, first per unit of the target, then for a target of 0. Returns
    /// `None` if the numbers have no rest.
    pub fn rests(&self) -> Option<[Vector2<f64>; 2]> {
        let inverse = (Matrix2::identity() - self.map).try_inverse()?;
        Some([inverse * self.by_target, inverse * self.offset])
    }

    /// Whether an eigenvalue is 1, so that the motion can end at any place.
    pub fn keeps_place(&self) -> bool {
        (1.0 - self.map.trace() + self.map.determinant()).abs() <= NO_RETURN
    }
}

/// Whether the second number of this map is the first number of the frame before.
pub fn remembers_place(map: &Matrix2<f64>) -> bool {
    (map.m21 - 1.0).abs() <= AT_TARGET && map.m22.abs() <= AT_TARGET
}

/// The body like which a linear rule moves, per kilogram.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RuleBody {
    /// A follower of first order.
    Follower {
        /// The rate of the follower, per second.
        rate: f64,
    },
    /// A mass on a spring.
    Spring {
        /// The stiffness, in N/m per kg.
        stiffness: f64,
        /// The damping, in N·s/m per kg; negative if the motion grows.
        damping: f64,
    },
    /// A mass that friction alone slows.
    Coasting {
        /// The drag, in N·s/m per kg; negative if the mass speeds up.
        drag: f64,
    },
}

/// A linear rule that steps a body.
///
/// At its author's frame rate, the places of the rule lie on one smooth motion, which is the exact motion of its
/// [body](LinearRule::body). The velocity of that motion is a linear combination of the rule's two numbers, and serves
/// as the velocity of the body at any frame rate. So the rule is exact at its author's rate, and needs no memory
/// besides the state.
#[derive(Debug)]
pub struct LinearRule {
    text: StepText,
    fps: TickRate,
    /// The carried number that decides the motion besides `x`.
    second: Option<usize>,
    /// Where `x` and the second number rest. Each rest is a part of the target plus a constant; that of `x` is relative
    /// to the target.
    rest: [[f64; 2]; 2],
    /// The velocity per unit of each number's distance from rest, per second.
    gains: [f64; 2],
    body: RuleBody,
    remembers_place: bool,
}

impl LinearRule {
    /// Returns the rule of these lines, written for this many frames per second.
    ///
    /// # Errors
    /// The reason why no body moves like the rule, and the remedy.
    pub fn new(text: StepText, fps: TickRate) -> Result<Self, [String; 2]> {
        let refused = |why: &str, remedy: &str| Err([why.to_owned(), remedy.to_owned()]);
        let ask = "`regatta rule` says what it does, and prints code for any frame rate";
        if text.leaves_unchanged(0) {
            return refused("the rule leaves `x` where it is", "say how it moves: `x += v * dt`");
        }
        if !text.is_linear() {
            return refused("the rule is not linear, so it has no exact motion", ask);
        }
        let state = text.with_causes(vec![0]);
        let hz = fps.hz();
        let Some(frame) = Frame::of(&text, &[], &state, 1.0 / hz) else {
            return refused(
                "the rule carries more than two numbers, or one that is not finite",
                ask,
            );
        };
        let powers = match state.len() {
            1 if frame.map.m11 > 0.0 && (frame.map.m11 - 1.0).abs() > NO_RETURN => {
                let kept = frame.map.m11;
                Some(Powers { log_scale: libm::log(kept), apart: 0.0, swings: false })
            }
            1 => None,
            _ => Powers::of(frame.map.trace(), frame.map.determinant()),
        };
        let Some(powers) = powers else {
            let why = "a part of the motion is gone, changes sides or drifts off in one frame";
            return refused(why, ask);
        };
        let coasts = state.len() == 2 && frame.keeps_place();
        if coasts && (frame.by_target != Vector2::zeros() || frame.offset != Vector2::zeros()) {
            return refused("the rule has no rest, and is pushed", ask);
        }
        let body = match (state.len(), coasts) {
            (1, _) => RuleBody::Follower { rate: -powers.log_scale * hz },
            (_, true) => RuleBody::Coasting { drag: -2.0 * powers.log_scale * hz },
            (_, false) => powers.spring(hz),
        };
        let [stretch, turn] = powers.rates().map(|rate| rate * hz);
        let (map, half) = (frame.map, frame.map.trace() / 2.0);
        let root = libm::sqrt(map.determinant());
        let gains = match state.len() {
            1 => [stretch, 0.0],
            _ => [stretch + turn * (map.m11 - half) / root, turn * map.m12 / root],
        };
        if state.len() == 2 && (!gains[1].is_finite() || gains[1] == 0.0) {
            return refused("the second number of the rule does not move the first", ask);
        }
        let no_rest = [Vector2::zeros(); 2];
        let [by_target, offset] = if coasts { no_rest } else { frame.rests().unwrap_or(no_rest) };
        let at_target = |part: f64| if (part - 1.0).abs() <= AT_TARGET { 0.0 } else { part - 1.0 };
        Ok(Self {
            second: state.get(1).copied(),
            // The rest of `x` is relative to the target, which is where the body rests.
            rest: [[at_target(by_target.x), offset.x], [by_target.y, offset.y]],
            gains,
            body,
            remembers_place: remembers_place(&map),
            text,
            fps,
        })
    }

    /// Returns the text as it was written.
    pub fn text(&self) -> &StepText {
        &self.text
    }

    /// Returns the frame rate of the rule's author.
    pub fn fps(&self) -> TickRate {
        self.fps
    }

    /// Returns the body like which the rule moves at its author's frame rate.
    pub fn body(&self) -> RuleBody {
        self.body
    }

    /// Whether the target decides where the body rests.
    pub fn takes_target(&self) -> bool {
        self.text.takes_target()
    }

    /// Returns the velocity in m/s with which a body starts at distance `x` (m) from rest. The rule's second number
    /// starts at its declared value, or at `x` if it remembers the place of the previous frame.
    pub fn start_velocity(&self, x: f64) -> f64 {
        let second = match self.second {
            Some(_) if self.remembers_place => x,
            Some(index) => self.text.carried()[index].start - self.rest[1][1],
            None => 0.0,
        };
        self.gains[0] * x + self.gains[1] * second
    }

    /// Steps a body by a frame of `h` seconds. The body's place of rest is `target`. Never allocates.
    pub fn step(&self, registers: &mut StepRegisters, h: f64, target: f64, [q, v]: [&mut f64; 2]) {
        let [shift, rest] = self.rest.map(|[part, constant]| part * target + constant);
        let [by_place, by_second] = self.gains;
        self.text.set(registers, 0, *q + shift);
        if let Some(second) = self.second {
            let away = (*v - by_place * (*q - target)) / by_second;
            self.text.set(registers, second, rest + away);
        }
        self.text.step(registers, h, target);
        *q = self.text.value(registers, 0) - shift;
        *v = by_place * (*q - target);
        if let Some(second) = self.second {
            *v += by_second * (self.text.value(registers, second) - rest);
        }
    }
}

impl Powers {
    /// Returns the spring whose motion has these powers at `hz` steps per second.
    fn spring(&self, hz: f64) -> RuleBody {
        let Self { log_scale, apart, swings } = *self;
        let decay = if log_scale.abs() <= NO_DECAY { 0.0 } else { log_scale };
        let square = if swings { apart * apart } else { -apart * apart };
        RuleBody::Spring {
            stiffness: (decay * decay + square) * hz * hz,
            damping: -2.0 * decay * hz,
        }
    }

    /// Returns the derivatives of the two numbers of [`Powers::at`] at 0 steps.
    fn rates(&self) -> [f64; 2] {
        let Self { log_scale, apart, swings } = *self;
        let turn = match apart {
            0.0 => 1.0,
            apart if swings => apart / libm::sin(apart),
            apart => apart / libm::sinh(apart),
        };
        [log_scale, turn]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rule(text: &str, fps: u32) -> Result<LinearRule, [String; 2]> {
        LinearRule::new(StepText::read(text).unwrap(), TickRate::whole(fps))
    }

    /// Returns the places of the lines by themselves and of the body that they step. Both start 1 m from rest.
    fn both(text: &str, fps: u32, target: f64) -> Vec<[f64; 2]> {
        let (rule, lines) = (rule(text, fps).unwrap(), StepText::read(text).unwrap());
        let [mut alone, mut registers] = [(); 2].map(|()| lines.registers());
        let shift = rule.rest[0][0] * target + rule.rest[0][1];
        let mut q = target + 1.0;
        let mut v = rule.start_velocity(1.0);
        lines.set(&mut alone, 0, q + shift);
        if rule.remembers_place {
            lines.set(&mut alone, rule.second.unwrap(), q + shift);
        }
        let h = 1.0 / f64::from(fps);
        (0..100)
            .map(|_| {
                lines.step(&mut alone, h, target);
                rule.step(&mut registers, h, target, [&mut q, &mut v]);
                [lines.value(&alone, 0) - shift, q]
            })
            .collect()
    }

    #[test]
    fn a_body_under_a_rule_follows_its_lines() {
        for (text, fps, target) in [
            ("v = (v + (target - x) * 0.2) * 0.85; x += v", 60, 0.0),
            ("v += ((target - x) * 100 - 5 * v - 9.8) * dt; x += v * dt", 60, 0.0),
            ("old = x; x += (x - prev) * 0.98 - x * 0.01; prev = old", 50, 0.0),
            ("x += (target - x) * 20 * dt", 30, 3.5),
            ("x = lerp(x, target, 0.1) + 0.05", 144, -2.0),
            ("v *= 0.9; x += v * dt", 60, 0.0),
        ] {
            for [alone, q] in both(text, fps, target) {
                assert!(q.is_finite() && (alone - q).abs() < 1e-12, "{text}: {alone} {q}");
            }
        }
    }

    #[test]
    fn a_rule_is_recognised_as_the_body_it_moves_like() {
        // Semi-implicit Euler of ω² = 100 at 60 Hz has cos(θ) = 1 - ω²h²/2.
        let theta = f64::acos(1.0 - 100.0 / 7200.0) * 60.0;
        let RuleBody::Spring { stiffness, damping } =
            rule("v += (target - x) * 100 * dt; x += v * dt", 60).unwrap().body()
        else {
            panic!("a spring")
        };
        assert!((stiffness / (theta * theta) - 1.0).abs() < 1e-12 && damping == 0.0);
        let RuleBody::Coasting { drag } = rule("v *= 0.9; x += v", 60).unwrap().body() else {
            panic!("it coasts")
        };
        assert!((drag + 60.0 * f64::ln(0.9)).abs() < 1e-11, "{drag}");
        let RuleBody::Follower { rate } = rule("x += (target - x) * 0.5", 30).unwrap().body()
        else {
            panic!("a follower")
        };
        assert!((rate - 30.0 * f64::ln(2.0)).abs() < 1e-12, "{rate}");
    }

    #[test]
    fn a_rule_like_no_body_is_refused_with_the_reason() {
        for (text, why) in [
            ("v *= 0.9", "leaves `x`"),
            ("v -= v * abs(v) * dt; x += v", "not linear"),
            ("x = target", "in one frame"),
            ("x += 3", "in one frame"),
            ("x = -x", "in one frame"),
            (
                "in += (target - x) * dt; v += in * 0.1 + (target - x) * 2 - v; x += v * dt",
                "more than two",
            ),
            ("v += (target - 0.5) * dt; v *= 0.9; x += v", "no rest"),
        ] {
            let [found, _] = rule(text, 60).unwrap_err();
            assert!(found.contains(why), "{text}: {found}");
        }
    }
}
