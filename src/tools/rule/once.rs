//! Pieces of a rule that it leaves after a frame, and the numbers that such a frame sets.

use super::pieces::{DECADES, Group};
use super::{Piece, Rule};
use crate::sim::number::round;
use crate::sim::numerics::bisect;

/// Number of runs that come to the pieces of a rule, and of their frames.
const RUNS: u32 = 800;
const FRAMES: u32 = 16;
/// Number of halvings of the way to the border of a piece.
const HALVINGS: u32 = 40;
/// The targets of the runs: at a limit of the place, one may hold the body there.
const TARGETS: [f64; 3] = [0.0, 1e5, -1e5];
/// Digits of the numbers that a frame sets, and a factor that is no more than rounding.
const DIGITS: usize = 4;
const ROUNDING: f64 = 1e-9;
/// A term of a sum in words after its sign.
type Term = (char, String);
/// The sign of a term that some frames add and some take away.
const EITHER: char = '\u{b1}';

/// A piece lasts if more than one in this many runs stays in it, for one that comes to it, or for a while.
const FEW: u32 = 5;
/// Maximum number of frames in a row after which a run has not stayed for a while.
const MOST: u32 = 2;

/// A run comes again soon within this number of frames, as one that jitters about a target does.
const SOON: u32 = 4;

/// The runs that begin in a group, and those of them that stay for a frame or for a while. The frames that come to it
/// from another group, and those of them that come again soon, or after which it still holds.
#[derive(Clone, Default)]
struct Frames {
    begun: u32,
    begun_stay: u32,
    last: u32,
    again: u32,
    come: u32,
    come_stay: u32,
}

impl Rule {
    /// Returns for each group whether the rule leaves it after one frame: from nearly all states that meet its
    /// condition, or from nearly all to which the rule comes from another group that lasts.
    pub(super) fn leaves(&self, groups: &[Group]) -> Vec<bool> {
        let all = TARGETS.iter().filter(|target| **target == 0.0 || self.text.takes_target());
        let all: Vec<Vec<bool>> = all.map(|target| self.leaves_to(groups, *target)).collect();
        (0..groups.len()).map(|group| all.iter().all(|leaves| leaves[group])).collect()
    }

    /// Returns for each group whether the rule leaves it, as a chase of this target.
    fn leaves_to(&self, groups: &[Group], target: f64) -> Vec<bool> {
        let (text, h) = (&self.text, self.step_length(self.fps));
        let mut registers = text.registers();
        let mut seen = vec![Frames::default(); groups.len()];
        let group_at = |at: &[f64]| {
            let modes = text.modes(h, at, target);
            groups.iter().position(|group| group.modes.contains(&modes))
        };
        // Near rest a ball lies on the floor from which it bounced.
        let last_decade = self.last_decade();
        let least = libm::exp10((DECADES[0] + last_decade) / 2.0);
        let is_far = |at: &Vec<f64>| self.state.iter().all(|index| at[*index].abs() >= least);
        let tried: Vec<Vec<f64>> = self.tried(last_decade, RUNS).filter(is_far).collect();
        let borders = tried.windows(2).filter_map(|ends| border(ends, group_at));
        for mut at in tried.iter().cloned().chain(borders) {
            let (mut before, mut now, mut is_first) = (None, group_at(&at), true);
            let mut left_at = vec![None; groups.len()];
            for frame in 0..FRAMES {
                for (index, value) in at.iter().enumerate() {
                    text.set(&mut registers, index, *value);
                }
                text.step(&mut registers, h, target);
                (0..at.len()).for_each(|index| at[index] = text.value(&registers, index));
                let next = group_at(&at);
                // A state of no group may be one of this.
                if let Some(frames) = now.map(|group| &mut seen[group]) {
                    let stays = u32::from(next.is_none() || next == now);
                    let begins = u32::from(frame == 0);
                    let comes = u32::from(before.is_some() && before != now);
                    frames.begun += begins;
                    frames.begun_stay += begins * stays;
                    is_first &= next == now;
                    frames.last += u32::from(is_first && frame == MOST);
                    frames.come += comes;
                    let left_at = now.and_then(|group| left_at[group]);
                    frames.again +=
                        comes * u32::from(left_at.is_some_and(|left| frame - left <= SOON));
                    frames.come_stay += comes * stays;
                }
                if let Some(group) = now.filter(|_| next != now) {
                    left_at[group] = Some(frame);
                }
                (before, now) = (now, next);
            }
        }
        let leaves = |frames: &Frames| {
            let is_few = |part: u32, all: u32| part * FEW <= all;
            (is_few(frames.last, frames.begun) || is_few(frames.again, frames.come))
                && is_few(frames.come_stay, frames.come)
                && (frames.come > 0 || frames.begun > 0 && frames.begun_stay == 0)
        };
        seen.iter().map(leaves).collect()
    }
}

/// Returns a state of the first group at its border, on the way between two states; `None` for one group.
fn border(ends: &[Vec<f64>], group_at: impl Fn(&[f64]) -> Option<usize>) -> Option<Vec<f64>> {
    let [first, last] = ends else { return None };
    let group = group_at(first);
    let between = |part: f64| -> Vec<f64> {
        first.iter().zip(last).map(|(first, last)| first + (last - first) * part).collect()
    };
    let is_first = |part: f64| group_at(&between(part)) == group;
    (!is_first(1.0)).then(|| between(bisect([0.0, 1.0], HALVINGS, is_first)[0]))
}

impl Piece {
    /// Returns the names of the numbers that a frame changes, each with its value after the frame in words. `None` if
    /// the value is no one sum of the numbers before the frame.
    pub fn sets(&self) -> Vec<(&str, Option<String>)> {
        let text = &self.rule.text;
        let all = text.carried().iter().enumerate().filter_map(|(index, carried)| {
            let values = self.modes.iter().map(|modes| self.terms_after(modes, index));
            let value = values.reduce(either).flatten().map(written);
            (value.as_ref() != Some(&carried.name)).then_some((&*carried.name, value))
        });
        all.collect()
    }

    /// Returns a carried number after a frame with these modes as a sum; `None` if the frame is not linear.
    fn terms_after(&self, modes: &[i64], index: usize) -> Option<Vec<Term>> {
        let (rule, text) = (&self.rule, &self.rule.text);
        let h = rule.step_length(rule.fps);
        let count = text.carried().len();
        let at = |value: f64| text.map_on(modes, h, &vec![value; count], 0.0);
        let [zero, one] = [0.0, 1.0].map(at);
        let names = text.carried().iter().map(|carried| &*carried.name).chain(["target"]);
        let factors = zero.columns.iter().map(|column| column[index]);
        let sum: f64 = factors.clone().take(count).sum::<f64>() + zero.values[index];
        if (one.values[index] - sum).abs() > ROUNDING * (1.0 + sum.abs()) {
            return None;
        }
        let number = |factor: f64| round(factor.abs(), DIGITS);
        let sign = |factor: f64| if factor < 0.0 { '\u{2212}' } else { '+' };
        let mut terms: Vec<Term> = Vec::new();
        for (factor, name) in factors.zip(names).filter(|(factor, _)| factor.abs() > ROUNDING) {
            let is_one = (factor.abs() - 1.0).abs() <= ROUNDING;
            let words =
                if is_one { name.to_owned() } else { format!("{} times {name}", number(factor)) };
            terms.push((sign(factor), words));
        }
        if zero.values[index].abs() > ROUNDING {
            terms.push((sign(zero.values[index]), number(zero.values[index])));
        }
        Some(terms)
    }
}

/// Returns a sum that is one or the other, if no more than the sign of one term differs.
fn either(one: Option<Vec<Term>>, other: Option<Vec<Term>>) -> Option<Vec<Term>> {
    let (mut one, other) = (one?, other?);
    let mut differs = 0;
    for (term, other) in one.iter_mut().zip(&other) {
        let is_other = term.0 != other.0;
        differs += u32::from(is_other || term.0 == EITHER);
        term.0 = if is_other { EITHER } else { term.0 };
    }
    let is_same = one.iter().map(|it| &it.1).eq(other.iter().map(|it| &it.1));
    (is_same && differs < 2).then_some(one)
}

/// Writes a sum, with a positive term first.
fn written(mut terms: Vec<Term>) -> String {
    terms.sort_by_key(|(sign, _)| *sign != '+');
    let mut written = String::new();
    for (sign, words) in terms {
        let sign = match (written.is_empty(), sign) {
            (true, '+') => String::new(),
            (true, sign) => sign.into(),
            (false, sign) => format!(" {sign} "),
        };
        written += &format!("{sign}{words}");
    }
    if written.is_empty() { "0".into() } else { written }
}

#[cfg(test)]
mod tests {
    use super::super::{Course, VisibleMotion};
    use super::*;

    fn pieces(lines: &str) -> Vec<Piece> {
        Rule::read(lines, 60.0).unwrap().pieces()
    }

    #[test]
    fn a_piece_that_is_left_after_a_frame_is_described_by_what_it_sets() {
        for (lines, condition, sets) in [
            (
                "x += v*dt; if x > 10 { x = 10; v = -v*0.5 }",
                "when x > 10",
                &[("x", "10"), ("v", "\u{2212}0.5 times v")][..],
            ),
            ("if x > 10 { x = 10; v = -v }", "when x > 10", &[("x", "10"), ("v", "\u{2212}v")]),
            ("if x < 0 { x = 0; v = 10 }", "when x < 0", &[("x", "0"), ("v", "10")]),
            (
                "v -= 20*dt; x += v*dt; if x < 0 { x = 0; v = 10 }",
                "when x < 0",
                &[("x", "0"), ("v", "10")],
            ),
            (
                "v += 0.5; x += v; if x > 400 { x = 400; v *= -0.8 }",
                "when x > 400",
                &[("x", "400"), ("v", "\u{2212}0.8 times v \u{2212} 0.4")],
            ),
            ("x += 3*dt; if x > 20 { x = x - 20 }", "when x > 20", &[("x", "x \u{2212} 19.95")]),
            (
                "x += v; if x > 100 { x = 200 - x; v = -v }",
                "when x > 100",
                &[("x", "200 \u{2212} x \u{2212} v"), ("v", "\u{2212}v")],
            ),
            (
                "if abs(target - x) > 50 { x = target + 1 }",
                "beyond 50 of the target",
                &[("x", "target + 1")],
            ),
            (
                "if abs(v) > 300 { v = 300*sign(v) } x += v",
                "when abs(v) > 300",
                &[("x", "x \u{b1} 300"), ("v", "\u{b1}300")],
            ),
        ] {
            let all = pieces(lines);
            let piece = all.iter().find(|piece| piece.condition == condition);
            let piece = piece.unwrap_or_else(|| panic!("{lines}: {all:?}"));
            assert_eq!(piece.course(), Some(Course::Once), "{lines}");
            let sets: Vec<_> =
                sets.iter().map(|(name, value)| (*name, Some((*value).to_owned()))).collect();
            assert_eq!(piece.sets(), sets, "{lines}");
            let none = piece.motions().into_iter().all(|it| it == VisibleMotion::none(it.fps));
            assert!(none, "{lines}");
        }
    }

    #[test]
    fn a_piece_that_lasts_keeps_its_course() {
        for lines in [
            "v -= 9*dt; x += v*dt; if x < 0 { x = 0; v = 0 }",
            "v += (target - x)*0.1; v *= 0.8; x += v; if abs(target - x) < 0.01 { x = target; v = 0 }",
            "if target > x { x += (target - x)*0.9 } else { x += (target - x)*0.05 }",
            "x += v*dt; if x > 10 { x = 10 }",
            "x += (target - x)*0.1; if x > 100 { x = 100 }",
            "v *= 0.9; if v < 0.3 { v = 0.3 } x += v*dt",
            "if v > 0 { v -= 0.2 } else { v += 0.2 } x += v",
            "if target > x { x += 100*dt } else if target < x { x -= 50*dt }",
        ] {
            let all = pieces(lines);
            let is_once = all.iter().any(|piece| piece.course() == Some(Course::Once));
            assert!(all.len() == 2 && !is_once, "{lines}: {all:?}");
        }
    }

    #[test]
    fn the_side_of_an_inequality_is_the_rule_and_the_other_a_point() {
        for (lines, course) in [
            ("if x == target { v = 0 } else { x += (target - x)*0.1 }", Course::Sets),
            ("if target != x { x += (target - x)*0.1 }", Course::Stays),
            ("if not (x == target) { x += (target - x)*0.1 }", Course::Stays),
        ] {
            let (rule, all) = (Rule::read(lines, 60.0).unwrap(), pieces(lines));
            let [chase, point] = &all[..] else { panic!("{lines}: {all:?}") };
            assert!(chase.condition.contains("!="), "{lines}: {all:?}");
            assert!(chase.condition.starts_with("while ") && point.condition.starts_with("at "));
            assert!(point.condition.contains("=="), "{lines}: {all:?}");
            assert_eq!((chase.course(), point.course()), (None, Some(course)), "{lines}");
            for seen in [chase.rule.motion_at(60.0), rule.motion_at(60.0)] {
                assert!(seen.halves_s.is_some_and(|s| (s - 0.1096).abs() < 1e-3), "{seen:?}");
            }
        }
        let lines = "if x != target { v = (v + (target - x)*0.2)*0.85 } x += v";
        let wish = Rule::read(lines, 60.0).unwrap().spring().unwrap();
        assert!((wish.frequency_hz - 4.130).abs() < 1e-3, "{wish:?}");
    }
}
