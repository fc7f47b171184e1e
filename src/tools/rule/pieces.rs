//! A rule in pieces, each of which is a linear rule where its condition holds.

use std::sync::Arc;

use super::rounded::{rounding, turns};
use super::{Motion, Rule, VisibleMotion};
use crate::sim::law::{AT_TARGET, Frame, SwitchKind};

/// Number of states that are tried to find the pieces, and the decades over which they spread.
const TRIED: u32 = 2000;
pub(super) const DECADES: [f64; 2] = [-5.0, 4.0];
/// The last decade if a switch has a piece for each whole number.
const MANY_DECADE: f64 = 1.5;

/// The maximum number of pieces, and of ways in which the switches of a rule are set.
const MAX_PIECES: usize = 6;
const MAX_MODES: usize = 128;
/// The largest difference of two numbers that are alike, relative to them.
const ALIKE: f64 = 1e-9;

/// The part of a rule in which all states move by one map.
#[derive(Debug)]
pub struct Piece {
    /// Where the rule moves by this map.
    pub condition: String,
    /// The rule by this map alone.
    pub rule: Rule,
    pub(super) modes: Vec<Vec<i64>>,
    stay: Stay,
}

/// How long a rule moves by the map of a piece.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Stay {
    /// As long as the condition holds.
    Lasts,
    /// As long, while the velocity loses its size.
    Brakes,
    /// For a frame, after which the condition does not hold.
    Once,
    /// Where two numbers are equal.
    Point,
}

/// The ways in which the switches of a rule are set where it moves by one map.
pub(super) struct Group {
    frame: Frame,
    pub(super) modes: Vec<Vec<i64>>,
    is_point: bool,
    /// Whether each frame pushes against the velocity before it.
    opposes: bool,
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
    /// The speed loses this much in a second, whatever its direction.
    Brakes(f64),
    /// It is left after the frame, which sets the numbers of [`Piece::sets`].
    Once,
    /// Its frame sets the numbers of [`Piece::sets`].
    Sets,
    /// Its steps are rounded, and no map describes them.
    Rounded,
}

impl Rule {
    /// Returns the pieces of a rule that is linear only piece by piece; empty for all other rules. A rule with rounded
    /// steps is one piece.
    pub fn pieces(&self) -> Vec<Piece> {
        let between = |source: &str| {
            format!(
                "between two steps of `{}`",
                source.split_whitespace().collect::<Vec<_>>().join(" ")
            )
        };
        if let Some(source) = rounding(&self.text, &self.state, 1.0 / self.fps) {
            return vec![self.piece(between(source), Vec::new(), Stay::Lasts)];
        }
        let many = self.text.switches().find(|(kind, _)| *kind == SwitchKind::Many);
        let find = |mirrored: &[SwitchKind]| self.find_pieces(mirrored).unwrap_or_default();
        let mut pieces = find(&[SwitchKind::Limit, SwitchKind::Sign]);
        if pieces.len() == 1 && many.is_none() {
            pieces = find(&[]);
        }
        match (&mut pieces[..], many) {
            ([one], Some((_, source))) => {
                one.condition = if turns(source) { "in each turn".into() } else { between(source) };
            }
            ([_], None) => return Vec::new(),
            _ => {}
        }
        pieces
    }

    /// Returns a piece with these modes.
    fn piece(&self, condition: String, modes: Vec<Vec<i64>>, stay: Stay) -> Piece {
        let mut rule = Rule::with_state(Arc::clone(&self.text), self.fps, self.state.clone());
        (rule.units, rule.within) = (self.units, self.within);
        rule.is_linear = !rule.is_rounded;
        let brakes = stay == Stay::Brakes;
        // Of two opposite motions, the one towards larger numbers.
        let rises = |modes: &&Vec<i64>| {
            let frame = Frame::of(&self.text, modes, &self.state, self.step_length(self.fps));
            frame.is_some_and(|frame| (frame.offset.sum() > 0.0) != brakes)
        };
        rule.modes = modes.iter().find(rises).or(modes.first()).cloned().unwrap_or_default();
        Piece { condition, rule: rule.settled(), modes, stay }
    }

    /// Returns states that spread over the decades up to the last one, which are the same in each call.
    pub(super) fn tried(&self, last_decade: f64, count: u32) -> impl Iterator<Item = Vec<f64>> {
        let mut seed = 1_u64;
        let mut random = move || {
            seed = seed
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        (0..count).map(move |_| {
            let mut at = vec![0.0; self.text.carried().len()];
            for index in &self.state {
                let decade = DECADES[0] + (last_decade - DECADES[0]) * random();
                at[*index] = libm::exp10(decade) * if random() < 0.5 { -1.0 } else { 1.0 };
            }
            at
        })
    }

    /// Returns the last decade of the states that are tried.
    pub(super) fn last_decade(&self) -> f64 {
        let has_many = self.text.switches().any(|(kind, _)| kind == SwitchKind::Many);
        if has_many { MANY_DECADE } else { DECADES[1] }
    }

    /// Returns the pieces. Two that move alike in opposite directions are one if only switches of these kinds differ.
    fn find_pieces(&self, mirrored: &[SwitchKind]) -> Option<Vec<Piece>> {
        let mut groups = self.groups(mirrored)?;
        groups.extend(self.points(&groups));
        if groups.len() > MAX_PIECES {
            return None;
        }
        let leaves = self.leaves(&groups);
        let labels = self.labels(&groups);
        let mut pieces: Vec<Piece> = Vec::new();
        for ((group, leaves), label) in groups.iter().zip(leaves).zip(labels) {
            let (stay, word) = match leaves {
                _ if group.is_point => (Stay::Point, "at "),
                true => (Stay::Once, "when "),
                false if self.brakes(group) => (Stay::Brakes, "while "),
                false => (Stay::Lasts, "while "),
            };
            let label = match label.strip_prefix("while ") {
                Some(holds) => format!("{word}{holds}"),
                None => label,
            };
            pieces.push(self.piece(label, group.modes.clone(), stay));
        }
        let condition = self.text.switches().position(|(kind, _)| kind == SwitchKind::Condition);
        let truth = |piece: &Piece| condition.map_or(0, |index| -piece.modes[0][index]);
        // A motion comes before a stop, and a condition before its opposite.
        let ends = |piece: &Piece| match piece.course() {
            _ if piece.stay == Stay::Point => 3,
            Some(Course::Stops | Course::Stays) => 2,
            Some(Course::Once) => 1,
            _ => 0,
        };
        pieces.sort_by_key(|piece| (ends(piece), truth(piece)));
        Some(pieces)
    }

    /// Returns the groups of states that move by one map each.
    fn groups(&self, mirrored: &[SwitchKind]) -> Option<Vec<Group>> {
        let (text, h) = (&self.text, self.step_length(self.fps));
        let kinds: Vec<SwitchKind> = text.switches().map(|(kind, _)| kind).collect();
        if self.is_linear || kinds.is_empty() || self.state.len() > 2 {
            return None;
        }
        let has_many = kinds.contains(&SwitchKind::Many);
        let mut groups: Vec<Group> = Vec::new();
        let mut registers = text.registers();
        for at in self.tried(self.last_decade(), TRIED) {
            // A velocity that follows the target is pushed to it from both sides.
            let opposes = [0.0, 2.0 * at[1]].into_iter().all(|target| {
                (0..at.len()).for_each(|index| text.set(&mut registers, index, at[index]));
                text.step(&mut registers, h, target);
                (text.value(&registers, 1) - at[1]) * at[1] < 0.0
            });
            let modes = text.modes(h, &at, 0.0);
            if let Some(known) = groups.iter_mut().find(|group| group.modes.contains(&modes)) {
                known.opposes &= opposes;
                continue;
            }
            let frame = Frame::of(text, &modes, &self.state, h)?;
            if !self.is_affine(&modes, &at) {
                return None;
            }
            let are_mirrored = |known: &Vec<i64>| {
                let mut all = kinds.iter().zip(known.iter().zip(&modes));
                all.all(|(kind, (a, b))| {
                    a == b || *kind == SwitchKind::Many || mirrored.contains(kind)
                })
            };
            let is_it = |group: &&mut Group| {
                let offsets = match group.modes.iter().any(are_mirrored) {
                    true if has_many => Offsets::Any,
                    true => Offsets::Opposite,
                    false => Offsets::Equal,
                };
                is_alike(&group.frame, &frame, offsets)
            };
            match groups.iter_mut().find(is_it) {
                Some(group) => {
                    group.modes.push(modes);
                    group.opposes &= opposes;
                }
                None => {
                    groups.push(Group { frame, modes: vec![modes], is_point: false, opposes });
                }
            }
            let all: usize = groups.iter().map(|group| group.modes.len()).sum();
            if groups.len() > MAX_PIECES || all > MAX_MODES {
                return None;
            }
        }
        Some(groups)
    }

    /// Returns the groups of states that none of the tried ones is in, for two of their numbers are equal.
    fn points(&self, groups: &[Group]) -> Vec<Group> {
        let mut points: Vec<Group> = Vec::new();
        let equalities = (0..self.text.switches().count()).filter(|it| self.text.is_equality(*it));
        let equalities: Vec<usize> = equalities.collect();
        for known in groups.iter().flat_map(|group| &group.modes) {
            for index in equalities.iter().filter(|index| known[**index] != 0) {
                let mut modes = known.clone();
                modes[*index] = 0;
                let h = self.step_length(self.fps);
                let Some(frame) = Frame::of(&self.text, &modes, &self.state, h) else { continue };
                let all = groups.iter().chain(&points);
                if all.flat_map(|group| &group.modes).any(|other| *other == modes) {
                    continue;
                }
                let is_it = |point: &&mut Group| is_alike(&point.frame, &frame, Offsets::Equal);
                match points.iter_mut().find(is_it) {
                    Some(point) => point.modes.push(modes),
                    None => {
                        let modes = vec![modes];
                        points.push(Group { frame, modes, is_point: true, opposes: false });
                    }
                }
            }
        }
        points
    }

    /// Whether a constant push takes from the velocity, whatever its direction.
    fn brakes(&self, group: &Group) -> bool {
        let Some(row) = self.state.iter().position(|index| *index == 1) else { return false };
        let Frame { map, by_target, offset } = &group.frame;
        let kept = (0..2).all(|column| map[(row, column)] == f64::from(u8::from(row == column)));
        group.opposes && kept && by_target[row] == 0.0 && offset[row] != 0.0
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
}

impl Piece {
    /// Returns what a frame does at the author's rate, unless it is a motion by itself.
    pub fn course(&self) -> Option<Course> {
        let rule = &self.rule;
        match self.stay {
            _ if rule.is_rounded => return Some(Course::Rounded),
            Stay::Once => return Some(Course::Once),
            Stay::Point if self.sets().is_empty() => return Some(Course::Stays),
            Stay::Point => return Some(Course::Sets),
            Stay::Brakes => {
                let [_, gain] = rule.driven(rule.fps);
                return gain.map(|gain| Course::Brakes(gain.abs()));
            }
            Stay::Lasts => {}
        }
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

    /// Returns the visible motion at each frame rate, which has no numbers where a frame is no motion.
    pub fn motions(&self) -> Vec<VisibleMotion> {
        let motions = self.rule.motions().into_iter();
        match self.stay {
            Stay::Lasts | Stay::Brakes => motions.collect(),
            Stay::Once | Stay::Point => motions.map(|seen| VisibleMotion::none(seen.fps)).collect(),
        }
    }

    /// Whether the motion ends at the target.
    pub fn rests_at_target(&self) -> bool {
        let rests = self.rule.frame(self.rule.fps).and_then(|frame| frame.rests());
        rests.is_some_and(|[by_target, offset]| {
            (by_target.x - 1.0).abs() <= AT_TARGET && offset.x.abs() <= AT_TARGET
        })
    }

    /// Whether nothing draws the body to a place, so that it stops by its speed alone.
    pub fn coasts(&self) -> bool {
        let changes = !self.rule.text.leaves_unchanged(1);
        changes && matches!(self.rule.motion(self.rule.fps), Some(Motion::Coast { .. }))
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
