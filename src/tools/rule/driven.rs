//! The top speed, the acceleration and the jump of a rule that drives its velocity without looking at the place.

use super::{HALVINGS, MAX_WATCHED, Rule};
use crate::sim::law::SwitchKind;
use crate::sim::numerics::bisect;

/// Number of frames of the author in which gravity stops the speed of a jump.
const FRAMES_UP: f64 = 25.0;
/// A speed that changes by less than this fraction in a frame is the top speed.
const STEADY: f64 = 1e-13;
/// Number of frames over which a speed that goes up and down has its mean.
const MEAN_OF: u32 = 4096;
/// A height below this fraction of the top is 0 up to rounding.
const LANDED: f64 = 1e-9;
/// Number of states that are tried to find the speeds that branches set.
const SET_TRIED: u32 = 200;
/// Places at which a piece may have a speed.
const PLACES: [f64; 5] = [0.0, 1.0, -1.0, 1e3, -1e3];
/// Relative rounding error of the way of a frame.
const ROUNDING: f64 = 1e-9;

impl Rule {
    /// Returns the speed of `x` a second per `v`; `None` if the rule does not move `x` by `v` times the frame length.
    fn speed_of_v(&self) -> Option<f64> {
        let (h, rest) = (self.step_length(self.fps), vec![0.0; self.text.carried().len()]);
        // At a limit of the velocity, a piece moves the place alike, whatever the velocity before.
        let moves = |modes: &&[i64]| {
            let map = self.text.map_on(modes, h, &rest, 0.0);
            let [place, speed] = [map.columns[1][0], map.columns[1][1]];
            let is = |per_v: f64| per_v != 0.0 && (place / (per_v * h) - 1.0).abs() < ROUNDING;
            is(1.0) || is(speed)
        };
        [&self.modes[..], &[]].iter().any(moves).then_some(self.units)
    }

    /// Whether speeds are in the units of `v`, which the unit of the frame length does not relate to seconds.
    pub fn has_speeds_of_v(&self) -> bool {
        let moves_x = self.units != 1.0 || !self.text.leaves_unchanged(0);
        moves_x && !self.text.leaves_unchanged(1) && self.speed_of_v().is_none()
    }

    /// Returns the top speed and the acceleration from rest.
    pub(super) fn driven(&self, fps: f64) -> [Option<f64>; 2] {
        let per_v = self.speed_of_v().filter(|_| !self.text.leaves_unchanged(1)).unwrap_or(1.0);
        self.drive_of_v(fps).map(|speed| Some(speed? * per_v))
    }

    /// Returns the top speed and the acceleration in the units of `v`.
    fn drive_of_v(&self, fps: f64) -> [Option<f64>; 2] {
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
                let top = top.filter(|top| self.moves_so_at(*top, h));
                return [top, some(gained * fps).filter(|_| kept != 0.0)];
            }
        }
        if self.modes.is_empty() { self.drive_from_rest(fps) } else { [None; 2] }
    }

    /// Whether the piece whose map this rule is has states of this speed.
    fn moves_so_at(&self, speed: f64, h: f64) -> bool {
        let rest = vec![0.0; self.text.carried().len()];
        let map = |modes: &[i64]| {
            let map = self.text.map_on(modes, h, &rest, 0.0);
            (map.columns, map.values)
        };
        let is_own = |place: &f64| {
            let mut at = rest.clone();
            (at[0], at[1]) = (*place, speed);
            map(&self.text.modes(h, &at, 0.0)) == map(&self.modes)
        };
        self.modes.is_empty() || PLACES.iter().any(is_own)
    }

    /// Returns the top speed and the acceleration of a run through all pieces, if the place does not decide it.
    fn drive_from_rest(&self, fps: f64) -> [Option<f64>; 2] {
        let (h, causes) = (self.step_length(fps), self.text.with_causes(vec![1]));
        let first = self.speeds(h, 0.0).next().filter(|first| first.is_finite() && *first != 0.0);
        let Some(first) = first.filter(|_| !causes.contains(&0)) else { return [None; 2] };
        let (last, is_steady) = self.last_speed(h, 0.0);
        if !last.is_finite() {
            return [None; 2];
        }
        let limit = || if causes == [1] { self.speed_limit(h, first) } else { None };
        let top = if is_steady { Some(last) } else { limit() };
        [top, Some(first * fps).filter(|gain| gain.is_finite())]
    }

    /// Returns the speeds after each frame of a run that starts at rest, or with this speed.
    fn speeds(&self, h: f64, from: f64) -> impl Iterator<Item = f64> {
        let mut registers = self.text.registers();
        self.text.set(&mut registers, 1, from);
        std::iter::repeat_with(move || {
            self.text.step(&mut registers, h, 0.0);
            self.text.value(&registers, 1)
        })
    }

    /// Returns the speed at which a run stays, or its last one with `false`.
    fn last_speed(&self, h: f64, from: f64) -> (f64, bool) {
        let mut last = from;
        let is_steady = self.speeds(h, from).take(MAX_WATCHED as usize).any(|speed| {
            let before = std::mem::replace(&mut last, speed);
            (speed - before).abs() <= STEADY * speed.abs()
        });
        (last, is_steady)
    }

    /// Returns the speed at which frames gain no more, or the mean one if they gain and lose in turn. `None` if each
    /// frame gains. `first` is the gain of the first frame.
    fn speed_limit(&self, h: f64, first: f64) -> Option<f64> {
        let gains = |decade: f64| {
            let speed = first * libm::exp10(decade);
            self.speeds(h, speed).next().is_some_and(|after| (after - speed) * first > 0.0)
        };
        let mut decades = (-30..=90).map(|tenth| f64::from(tenth) / 10.0);
        let beyond = decades.find(|decade| !gains(*decade))?;
        let [_, limit] = bisect([beyond - 0.1, beyond], HALVINGS, gains);
        let from = first * libm::exp10(limit);
        let (last, is_steady) = self.last_speed(h, from);
        let (frames, count) = (MAX_WATCHED as usize, MEAN_OF as usize);
        // A run from rest tells where it goes up and down, unless it takes too long to come there.
        let comes = self.speeds(h, 0.0).take(frames).any(|speed| speed / from >= 1.0);
        let from = if comes { 0.0 } else { from };
        let sum: f64 = self.speeds(h, from).skip(frames).take(count).sum();
        let top = if is_steady { last } else { sum / f64::from(MEAN_OF) };
        Some(top).filter(|top| top.is_finite())
    }

    /// Returns the speed with which a jump starts; `None` if the rule has no steady fall.
    pub fn jump_speed(&self) -> Option<f64> {
        let [None, Some(acceleration)] = self.drive_of_v(self.fps) else { return None };
        let moves = self.text.with_causes(vec![0]).iter().all(|index| *index < 2);
        let is_moved = moves && !self.text.leaves_unchanged(0);
        // A piece of a rule that ends at a top speed drives a body up to it, and lets none fall.
        let has_top = || self.drive_from_rest(self.fps)[0].is_some();
        if !self.modes.is_empty() && has_top() {
            return None;
        }
        let opposes = |start: &f64| start * acceleration < 0.0;
        let given = Some(self.text.carried()[1].start).filter(opposes);
        let given = given.or_else(|| self.set_speeds().into_iter().find(opposes));
        let start = given.unwrap_or(-FRAMES_UP * acceleration / self.fps);
        (is_moved && self.is_in_piece(start)).then_some(start)
    }

    /// Returns the speeds that branches set to numbers.
    fn set_speeds(&self) -> Vec<f64> {
        let (text, h) = (&self.text, self.step_length(self.fps));
        let mut tried: Vec<Vec<i64>> = Vec::new();
        // A clamp of the velocity sets none.
        let free = text.free_modes();
        let is_free = |modes: &Vec<i64>| {
            let mut kinds = text.switches().map(|(kind, _)| kind).zip(free.iter().zip(modes));
            kinds.all(|(kind, (free, mode))| {
                kind != SwitchKind::Limit || free.is_none_or(|free| free == *mode)
            })
        };
        for at in self.whole().tried(self.last_decade(), SET_TRIED) {
            let modes = text.modes(h, &at, 0.0);
            if is_free(&modes) && !tried.contains(&modes) {
                tried.push(modes);
            }
        }
        let rest = vec![0.0; text.carried().len()];
        let maps = tried.iter().map(|modes| text.map_on(modes, h, &rest, 0.0));
        let set = maps.filter(|map| map.columns.iter().all(|column| column[1] == 0.0));
        set.map(|map| map.values[1]).collect()
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

    /// Returns the height of a jump and its time in seconds, until it is back where it began. A piece jumps by its own
    /// map.
    pub(super) fn jump(&self, fps: f64) -> Option<[f64; 2]> {
        let start = self.jump_speed()?;
        let h = self.step_length(fps);
        let mut at = vec![0.0; self.text.carried().len()];
        (at[0], at[1]) = (0.0, start);
        let mut height = 0.0_f64;
        for frame in 1..MAX_WATCHED as u32 {
            at = self.text.map_on(&self.modes, h, &at, 0.0).values;
            let place = at[0] * start.signum();
            if place.is_nan() || place <= LANDED * height {
                return (height > 0.0).then_some([height, f64::from(frame) / fps]);
            }
            height = height.max(place);
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::super::Course;
    use super::*;

    #[test]
    fn a_friction_brakes_and_a_push_does_not() {
        for (lines, wanted) in [
            ("v = move_toward(v, 0, 500*dt); x += v*dt", Some(500.0)),
            ("v -= sign(v)*min(abs(v), 3*dt); x += v*dt", Some(3.0)),
            ("v = max(v - 5*dt, 0); x += v*dt", Some(5.0)),
            ("v = move_toward(v, 300, 900*dt); x += v*dt", None),
            ("v = move_toward(v, target, 900*dt); x += v*dt", None),
            ("if x > 0 { v -= 9*dt } else { v += 9*dt } x += v*dt", None),
        ] {
            let pieces = Rule::read(lines, 60.0).unwrap().pieces();
            let brakes = pieces.iter().find_map(|piece| match piece.course() {
                Some(Course::Brakes(gain)) => Some((gain, piece.motions())),
                _ => None,
            });
            let Some((gain, motions)) = brakes else {
                assert_eq!(wanted, None, "{lines}");
                continue;
            };
            assert!((gain - wanted.unwrap()).abs() < 1e-9, "{lines}: {gain}");
            let slows = |seen: f64| (seen + gain).abs() < 1e-9;
            assert!(motions.iter().all(|seen| seen.accelerates.is_some_and(slows)), "{lines}");
        }
    }

    #[test]
    fn a_piece_has_a_jump_only_if_the_rule_falls() {
        for (lines, jumps) in [
            ("v += 400*dt; v = clamp(v, -200, 200); x += v*dt", false),
            ("v = move_toward(v, 300, 400*dt); x += v*dt", false),
            ("v -= 20*dt; x += v*dt; if x < 0 { x = 0; v = 10 }", true),
        ] {
            let pieces = Rule::read(lines, 60.0).unwrap().pieces();
            let found = pieces.iter().any(|it| it.motions()[0].jump.is_some());
            assert_eq!(found, jumps, "{lines}");
        }
    }

    #[test]
    fn a_speed_per_millisecond_is_shown_per_second() {
        let near = |found: Option<f64>, wanted: f64| {
            found.is_some_and(|found| (found / wanted - 1.0).abs() < 1e-3)
        };
        for (lines, units) in [
            ("v += 2000*dt; v *= 0.92; x += v*dt", 1.0),
            ("v += 0.002*dt; v *= 0.92; x += v*dt", 1e3),
            ("x += v*dt; v += 0.002*dt; v *= 0.92", 1e3),
            ("v += 0.002*dt; v *= 0.92", 1e3),
        ] {
            let rule = Rule::read(lines, 60.0).unwrap().in_units(units);
            let seen = rule.motion_at(60.0);
            let per_v = if lines.contains('x') { 1.0 } else { 1e-3 };
            assert!(near(seen.top_speed, 383.333 * per_v), "{lines}: {seen:?}");
            assert!(near(seen.accelerates, 1840.0 * per_v), "{lines}: {seen:?}");
        }
        let fall = Rule::read("v -= 0.00002*dt; x += v*dt", 60.0).unwrap().in_units(1e3);
        assert!(near(fall.jump_speed(), 0.008333) && near(fall.motion_at(60.0).accelerates, -20.0));
        let limit = Rule::read("v = min(v + 0.01*dt, 0.3); x += v*dt", 60.0).unwrap().in_units(1e3);
        let all = limit.pieces();
        let [_, top] = &all[..] else { panic!("{all:?}") };
        let Some(Course::Moves(speed)) = top.course() else { panic!("{all:?}") };
        assert!(near(Some(speed), 300.0) && near(top.motions()[0].top_speed, 300.0), "{speed}");
    }

    #[test]
    fn a_spring_that_swings_no_more_rests_at_its_target() {
        for (target, is_there) in [("target", true), ("target + 1", false)] {
            let lines = format!("x = smoothDamp(x, {target}, ref v, 0.3, 2, dt)");
            let pieces = Rule::read(&lines, 60.0).unwrap().pieces();
            let near = pieces.iter().find(|it| it.condition.starts_with("within")).unwrap();
            assert_eq!(near.rests_at_target(), is_there, "{lines}");
        }
    }

    #[test]
    fn a_limit_is_the_top_speed_at_every_rate_and_a_set_speed_starts_the_jump() {
        let drop = "v += 60*dt; if v > 20 { v = v*0.95 } x += v*dt";
        for (lines, fps, top) in [
            ("v -= 1*dt; x += v*dt; if v < -500 { v = -500 }", 30.0, Some(-500.0)),
            ("v -= 1*dt; x += v*dt; if v < -500 { v = -500 }", 240.0, Some(-500.0)),
            ("v += 1*dt; if v > 8 { v = 8 } x += v*dt", 60.0, Some(8.0)),
            (drop, 30.0, Some(38.0)),
            (drop, 60.0, Some(19.0)),
            ("v += if(v > 0, -30, 30)*dt; x += v*dt", 60.0, Some(0.25)),
            ("if v < 9 { v += 1*dt } else { v += 2*dt } x += v*dt", 60.0, None),
        ] {
            let seen = Rule::read(lines, 60.0).unwrap().motion_at(fps);
            let is_near = seen.top_speed.zip(top).map(|(a, b)| (a / b - 1.0).abs() < 1e-9);
            assert_eq!(is_near, top.map(|_| true), "{lines} at {fps}: {seen:?}");
            assert!(seen.top_speed.is_none() || seen.jump.is_none(), "{lines}: {seen:?}");
        }
        // Between the highest speed that a frame reaches and the lowest to which the limit drops it.
        let mean = Rule::read(drop, 60.0).unwrap().motion_at(240.0).top_speed.unwrap();
        assert!((19.0..20.25).contains(&mean), "{mean}");
        let lines = "v -= 30*dt; v = clamp(v, -20, 20); x += v*dt; if x < 0 { x = 0; v = 12 }";
        let pieces = Rule::read(lines, 60.0).unwrap().pieces();
        assert_eq!(pieces[0].rule.jump_speed(), Some(12.0));
        let lines = "v += 900*dt; x += v*dt; if x > 0 { x = 0; v = -400 }";
        let pieces = Rule::read(lines, 60.0).unwrap().pieces();
        assert_eq!(pieces[0].rule.jump_speed(), Some(-400.0));
        // The sum over the frames of a symplectic flight that begins at the floor.
        let [height, _] = pieces[0].motions()[2].jump.unwrap();
        assert!((height - 85.583).abs() < 1e-2, "{height}");
    }
}
