//! The top speed, the acceleration and the jump of a rule that drives its velocity without looking at the place.

use super::{MAX_WATCHED, Rule};

/// Number of frames of the author in which gravity stops the speed of a jump.
const FRAMES_UP: f64 = 25.0;
/// A speed that changes by less than this fraction in a frame is the top speed.
const STEADY: f64 = 1e-13;
/// A height below this fraction of the top is 0 up to rounding.
const LANDED: f64 = 1e-9;

impl Rule {
    /// Returns the top speed and the acceleration from rest.
    pub(super) fn driven(&self, fps: f64) -> [Option<f64>; 2] {
        let h = self.step_length(fps);
        let some = |value: f64| Some(value).filter(|value| value.is_finite() && *value != 0.0);
        if self.text.leaves_unchanged(1) {
            let frame = self.frame(fps).filter(|_| self.state == [0]);
            let drifts = frame.filter(|it| it.map.m11 == 1.0 && it.by_target.x == 0.0);
            return [drifts.and_then(|it| some(it.offset.x * fps)), None];
        }
        if self.is_linear {
            let map = self.text.map_on(&self.modes, h, &vec![0.0; self.text.carried().len()], 0.0);
            let mut causes = map.columns[..self.text.carried().len()].iter().enumerate();
            if causes.all(|(index, column)| index == 1 || column[1] == 0.0) {
                let (kept, gained) = (map.columns[1][1], map.values[1]);
                let top = (kept.abs() < 1.0).then_some(gained / (1.0 - kept)).and_then(some);
                return [top, some(gained * fps).filter(|_| kept != 0.0)];
            }
        }
        if !self.modes.is_empty() || self.text.with_causes(vec![1]).contains(&0) {
            return [None; 2];
        }
        let mut registers = self.text.registers();
        self.text.set(&mut registers, 1, 0.0);
        let (mut first, mut before) = (None, 0.0);
        for _ in 0..MAX_WATCHED as u32 {
            self.text.step(&mut registers, h, 0.0);
            let speed = self.text.value(&registers, 1);
            let first = *first.get_or_insert(speed);
            if first == 0.0 || !speed.is_finite() {
                return [None; 2];
            }
            if (speed - before).abs() <= STEADY * speed.abs() {
                return [Some(speed), some(first * fps)];
            }
            before = speed;
        }
        [None, first.and_then(|first| some(first * fps))]
    }

    /// Returns the speed with which a jump starts; `None` if the rule has no steady fall.
    pub fn jump_speed(&self) -> Option<f64> {
        let [None, Some(acceleration)] = self.driven(self.fps) else { return None };
        let moves = self.text.with_causes(vec![0]).iter().all(|index| *index < 2);
        let is_moved = moves && !self.text.leaves_unchanged(0);
        let start = -FRAMES_UP * acceleration / self.fps;
        (is_moved && self.is_in_piece(start)).then_some(start)
    }

    /// Whether a jump with this speed rises and falls in the piece whose map this rule is.
    fn is_in_piece(&self, start: f64) -> bool {
        let h = self.step_length(self.fps);
        let half_height = FRAMES_UP / 4.0 * start * if self.takes_step() { h } else { 1.0 };
        let is_in = |speed: f64| {
            let mut at = vec![0.0; self.text.carried().len()];
            (at[0], at[1]) = (half_height, speed);
            self.text.modes(h, &at, 0.0) == self.modes
        };
        self.modes.is_empty() || is_in(start) && is_in(-start)
    }

    /// Returns the height of a jump and its time in seconds, until it is back where it began.
    pub(super) fn jump(&self, fps: f64) -> Option<[f64; 2]> {
        let start = self.jump_speed()?;
        let mut registers = self.text.registers();
        self.text.set(&mut registers, 0, 0.0);
        self.text.set(&mut registers, 1, start);
        let mut height = 0.0_f64;
        for frame in 1..MAX_WATCHED as u32 {
            self.text.step(&mut registers, self.step_length(fps), 0.0);
            let place = self.text.value(&registers, 0) * start.signum();
            if place.is_nan() || place <= LANDED * height {
                return (height > 0.0).then_some([height, f64::from(frame) / fps]);
            }
            height = height.max(place);
        }
        None
    }
}
