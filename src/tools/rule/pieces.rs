//! A rule in pieces, each of which is a linear rule where its condition holds.

use std::sync::Arc;

use super::{Motion, Rule};
use crate::sim::law::{Frame, SwitchKind, bracketed};

/// Number of states that are tried to find the pieces, and the decades over which they spread.
const TRIED: u32 = 2000;
const DECADES: [f64; 2] = [-5.0, 4.0];
/// The last decade if a switch has a piece for each whole number.
const MANY_DECADE: f64 = 1.5;
/// A distance at which a rule is at rest.
const REST: f64 = 1e-12;
/// The maximum number of pieces, and of ways in which the switches of a rule are set.
const MAX_PIECES: usize = 6;
const MAX_MODES: usize = 128;
/// The largest difference of two numbers that are alike, relative to them.
const ALIKE: f64 = 1e-9;
/// Spellings of the distance to the target.
const DISTANCES: [&str; 4] =
    ["abs(target-x)", "abs(x-target)", "fabs(target-x)", "(target-x).abs()"];

/// Words of functions that turn a number around.
const TURNS: [&str; 6] = ["mod", "%", "wrap", "repeat", "angle", "rotate"];

/// The part of a rule in which all states move by one map.
#[derive(Debug)]
pub struct Piece {
    /// Where the rule moves by this map.
    pub condition: String,
    /// The rule by this map alone.
    pub rule: Rule,
    modes: Vec<Vec<i64>>,
}

/// What a frame of a piece does, if it is no motion by itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Course {
    /// It is at its rest after the frame.
    Stops,
    /// It stays where it is.
    Stays,
    /// It moves at this speed, whatever the distance.
    Moves(f64),
    /// The target decides its speed.
    ByTarget,
}

impl Rule {
    /// Returns the pieces of a rule that is linear only piece by piece; empty for all other rules.
    pub fn pieces(&self) -> Vec<Piece> {
        let many = self.text.switches().find(|(kind, _)| *kind == SwitchKind::Many);
        let find = |mirrored: &[SwitchKind]| self.find_pieces(mirrored).unwrap_or_default();
        let mut pieces = find(&[SwitchKind::Limit, SwitchKind::Sign]);
        if pieces.len() == 1 && many.is_none() {
            pieces = find(&[]);
        }
        match (&mut pieces[..], many) {
            ([one], Some((_, source))) => {
                let turns = TURNS.iter().any(|word| source.to_ascii_lowercase().contains(word));
                one.condition = match turns {
                    true => "in each turn".into(),
                    false => format!("between two steps of `{source}`"),
                };
            }
            ([_], None) => return Vec::new(),
            _ => {}
        }
        pieces
    }

    /// Returns the pieces. Two that move alike in opposite directions are one if only switches of these kinds differ.
    fn find_pieces(&self, mirrored: &[SwitchKind]) -> Option<Vec<Piece>> {
        let (text, h) = (&self.text, self.step_length(self.fps));
        let switches: Vec<(SwitchKind, &str)> = text.switches().collect();
        if self.is_linear || switches.is_empty() || self.state.len() > 2 {
            return None;
        }
        let has_many = switches.iter().any(|(kind, _)| *kind == SwitchKind::Many);
        let last_decade = if has_many { MANY_DECADE } else { DECADES[1] };
        let mut seed = 1_u64;
        let mut random = || {
            seed = seed
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        let rest: Vec<f64> = text.carried().iter().map(|_| REST).collect();
        let mut groups: Vec<(Frame, Vec<Vec<i64>>)> = Vec::new();
        for _ in 0..TRIED {
            let mut at = vec![0.0; rest.len()];
            for index in &self.state {
                let decade = DECADES[0] + (last_decade - DECADES[0]) * random();
                at[*index] = libm::exp10(decade) * if random() < 0.5 { -1.0 } else { 1.0 };
            }
            let modes = text.modes(h, &at, 0.0);
            if groups.iter().any(|(_, known)| known.contains(&modes)) {
                continue;
            }
            let frame = Frame::of(text, &modes, &self.state, h)?;
            if !self.is_affine(&modes, &at) {
                return None;
            }
            let are_mirrored = |known: &Vec<i64>| {
                let mut all = switches.iter().zip(known.iter().zip(&modes));
                all.all(|((kind, _), (a, b))| {
                    a == b || *kind == SwitchKind::Many || mirrored.contains(kind)
                })
            };
            let is_it = |(other, known): &&mut (Frame, Vec<Vec<i64>>)| {
                let offsets = match known.iter().any(are_mirrored) {
                    true if has_many => Offsets::Any,
                    true => Offsets::Opposite,
                    false => Offsets::Equal,
                };
                is_alike(other, &frame, offsets)
            };
            match groups.iter_mut().find(is_it) {
                Some((_, all)) => all.push(modes),
                None => groups.push((frame, vec![modes])),
            }
            let all: usize = groups.iter().map(|(_, modes)| modes.len()).sum();
            if groups.len() > MAX_PIECES || all > MAX_MODES {
                return None;
            }
        }
        let at_rest = text.modes(h, &rest, 0.0);
        let labels: Vec<String> =
            groups.iter().map(|(_, modes)| self.label(modes, &groups, &at_rest)).collect();
        let mut pieces: Vec<Piece> = groups
            .iter()
            .zip(labels)
            .map(|((_, modes), condition)| {
                let modes = modes.clone();
                let mut rule = Rule::with_state(Arc::clone(text), self.fps, self.state.clone());
                (rule.units, rule.within, rule.is_linear) = (self.units, self.within, true);
                // Of two opposite motions, the one towards larger numbers.
                let rises = |modes: &&Vec<i64>| {
                    let frame = Frame::of(text, modes, &self.state, h);
                    frame.is_some_and(|frame| frame.offset.sum() > 0.0)
                };
                rule.modes.clone_from(modes.iter().find(rises).unwrap_or(&modes[0]));
                Piece { condition, rule: rule.settled(), modes }
            })
            .collect();
        let truth = |piece: &Piece| {
            let mut all = piece.modes[0].iter().zip(&switches);
            all.find(|(_, (kind, _))| *kind == SwitchKind::Condition).map_or(0, |(mode, _)| -*mode)
        };
        // A motion comes before a stop.
        let ends = |piece: &Piece| matches!(piece.course(), Some(Course::Stops | Course::Stays));
        pieces.sort_by_key(|piece| (ends(piece), truth(piece)));
        let others: Vec<String> = pieces.iter().rev().map(|it| it.condition.clone()).collect();
        for (piece, other) in
            pieces.iter_mut().zip(&others).filter(|(it, _)| it.condition.is_empty())
        {
            piece.condition = match other.strip_prefix("within ") {
                Some(limits) if others.len() == 2 => format!("beyond {limits}"),
                _ => "elsewhere".into(),
            };
        }
        Some(pieces)
    }

    /// Whether a frame with these modes is an affine map up to rounding.
    fn is_affine(&self, modes: &[i64], at: &[f64]) -> bool {
        let (text, h) = (&self.text, self.step_length(self.fps));
        let zero = text.map_on(modes, h, &vec![0.0; at.len()], 0.0);
        let found = text.map_on(modes, h, at, 0.0);
        self.state.iter().all(|row| {
            let parts: Vec<f64> =
                at.iter().enumerate().map(|(column, x)| zero.columns[column][*row] * x).collect();
            let size = parts.iter().fold(zero.values[*row].abs(), |size, part| size + part.abs());
            let expected = zero.values[*row] + parts.iter().sum::<f64>();
            (found.values[*row] - expected).abs() <= ALIKE * size.max(f64::MIN_POSITIVE)
        })
    }

    /// Returns the condition that the modes of a piece have in common.
    fn label(
        &self,
        modes: &[Vec<i64>],
        groups: &[(Frame, Vec<Vec<i64>>)],
        at_rest: &[i64],
    ) -> String {
        let mut parts: Vec<String> = Vec::new();
        let switches: Vec<(SwitchKind, &str)> = self.text.switches().collect();
        let free = self.text.free_modes();
        for (index, (kind, source)) in switches.iter().enumerate() {
            // The two limits of a `clamp` are one switch, of mode 1 if both leave its number.
            let twins: Vec<usize> =
                (0..switches.len()).filter(|other| switches[*other] == switches[index]).collect();
            let is_clamp = *kind == SwitchKind::Limit && twins.len() == 2;
            let mode_of = |modes: &Vec<i64>| match is_clamp {
                true => i64::from(twins.iter().all(|index| modes[*index] == 1)),
                false => modes[index],
            };
            let mode = mode_of(&modes[0]);
            let is_common = modes.iter().all(|modes| mode_of(modes) == mode);
            let mut all = groups.iter().flat_map(|(_, modes)| modes);
            if !is_common || all.all(|modes| mode_of(modes) == mode) {
                continue;
            }
            let source = source.split_whitespace().collect::<Vec<_>>().join(" ");
            let within = if is_clamp { 1 } else { free[index].unwrap_or(at_rest[index]) };
            let part = match kind {
                SwitchKind::Condition => condition(&source, mode == 1),
                SwitchKind::Limit if mode == within => format!("within the limits of `{source}`"),
                SwitchKind::Limit if is_clamp => format!("beyond the limits of `{source}`"),
                SwitchKind::Limit => format!("at a limit of `{source}`"),
                SwitchKind::Sign if mode == 1 => format!("`{source}` of a number above 0"),
                SwitchKind::Sign => format!("`{source}` of a number below 0"),
                SwitchKind::Many => continue,
            };
            let follows = parts.iter().any(|part| part.starts_with("while "));
            let part = part.strip_prefix("while ").filter(|_| follows).unwrap_or(&part).to_owned();
            if !parts.contains(&part) {
                parts.push(part);
            }
        }
        parts.join(" and ")
    }
}

impl Piece {
    /// Returns what a frame does at the author's rate, unless it is a motion by itself.
    pub fn course(&self) -> Option<Course> {
        let rule = &self.rule;
        let frame = rule.frame(rule.fps)?;
        let is_0 = |number: f64| number.abs() <= ALIKE;
        let motion = rule.motion(rule.fps)?;
        let is_speed = rule.state == [1];
        let moved = |per_frame: f64, frames: f64| match per_frame {
            still if is_0(still) => None,
            moved => Some(Course::Moves(moved.abs() * frames)),
        };
        if motion.radius() <= ALIKE {
            // The velocity after a frame is the same after every frame, and moves the place.
            let [by_offset, by_target] = match motion {
                Motion::Coast { .. } => {
                    [frame.map * frame.offset, frame.map * frame.by_target].map(|it| it.x)
                }
                _ if is_speed => [frame.offset.x, frame.by_target.x],
                _ => [0.0; 2],
            };
            if !is_0(by_target) {
                return Some(Course::ByTarget);
            }
            let frames = if is_speed { 1.0 } else { rule.fps };
            return moved(by_offset, frames).or(Some(Course::Stops));
        }
        let keeps = is_0(frame.map.m11 - 1.0) && is_0(frame.map.m12) && is_0(frame.by_target.x);
        if !keeps || is_speed {
            return None;
        }
        moved(frame.offset.x, rule.fps).or(Some(Course::Stays))
    }

    /// Whether nothing draws the body to a place, so that it stops by its speed alone.
    pub fn coasts(&self) -> bool {
        matches!(self.rule.motion(self.rule.fps), Some(Motion::Coast { .. }))
    }

    /// Returns when the whole `rule` first is in this piece at the author's rate, in seconds, from rest at 1, or from a
    /// speed of 1 if the piece [coasts](Self::coasts).
    pub fn reached_s(&self, rule: &Rule) -> Option<f64> {
        let (text, h) = (&rule.text, rule.step_length(rule.fps));
        let mut registers = text.registers();
        text.set(&mut registers, if self.coasts() { 1 } else { rule.state[0] }, 1.0);
        let frames = (super::WATCHED_S * rule.fps).min(super::MAX_WATCHED) as u32;
        let at_frame = |_: &u32| {
            let at: Vec<f64> =
                (0..text.carried().len()).map(|index| text.value(&registers, index)).collect();
            text.step(&mut registers, h, 0.0);
            self.modes.contains(&text.modes(h, &at, 0.0))
        };
        (1..=frames).find(at_frame).map(|frame| f64::from(frame) / rule.fps)
    }
}

/// The offsets of two pieces that move alike.
#[derive(Clone, Copy)]
enum Offsets {
    Equal,
    Opposite,
    Any,
}

fn is_alike(a: &Frame, b: &Frame, offsets: Offsets) -> bool {
    let near = |a: f64, b: f64| (a - b).abs() <= ALIKE * (1.0 + a.abs().max(b.abs()));
    let mut numbers = a.map.iter().chain(&a.by_target).zip(b.map.iter().chain(&b.by_target));
    let mut both = a.offset.iter().zip(&b.offset);
    numbers.all(|(a, b)| near(*a, *b))
        && both.all(|(a, b)| match offsets {
            Offsets::Equal => near(*a, *b),
            Offsets::Opposite => near(a.abs(), b.abs()),
            Offsets::Any => true,
        })
}

/// Writes a comparison of the lines that is true or false.
fn condition(source: &str, is_true: bool) -> String {
    const OPPOSITES: [(&str, &str); 6] =
        [("<=", ">"), (">=", "<"), ("==", "!="), ("!=", "=="), ("<", ">="), (">", "<=")];
    if let Some(inside) = bracketed(source) {
        return condition(inside.trim(), is_true);
    }
    let (mut depth, mut found) = (0, None);
    for (at, sign) in source.char_indices() {
        depth += i32::from(sign == '(') - i32::from(sign == ')');
        let operator = OPPOSITES.iter().find(|(operator, _)| source[at..].starts_with(operator));
        if depth == 0 && found.is_none() {
            found = operator.map(|(operator, opposite)| (at, *operator, *opposite));
        }
    }
    let Some((at, operator, opposite)) = found else {
        return format!("{} {source}", if is_true { "while" } else { "while not" });
    };
    let sign = if is_true { operator } else { opposite };
    let [left, right] = [&source[..at], &source[at + operator.len()..]].map(str::trim);
    let is_distance = |side: &str| DISTANCES.contains(&&*side.replace(' ', ""));
    match (is_distance(left), is_distance(right), sign.as_bytes()[0]) {
        (true, false, b'<') => format!("within {right} of the target"),
        (true, false, b'>') => format!("beyond {right} of the target"),
        (false, true, b'<') => format!("beyond {left} of the target"),
        (false, true, b'>') => format!("within {left} of the target"),
        _ => format!("while {left} {sign} {right}"),
    }
}
