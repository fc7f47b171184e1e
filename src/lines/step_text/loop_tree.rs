//! The tree of the lines of a game loop, as a printer reads it.

use super::reader::{
    COST, COUNT, FIRST, FRAME_NAMES, LENGTH, NOW, REFRESH, SECOND, SHOWN, SPIN_NAMES,
};
use super::{H, Line, StepBody, StepText, TARGET};
use crate::expression::Expression;

/// A number that a loop is given, or the moment that it shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoopName {
    /// Duration of the frame, `dt`.
    Duration,
    /// Length of a tick, `H`.
    Tick,
    /// Duration of a refresh of the display, `refresh`.
    Refresh,
    /// Units of time in a second, `second`.
    Second,
    /// Work of a tick, `cost`.
    Cost,
    /// Time at which the frame began, `now`.
    Now,
    /// Whether the frame is the first, `first`.
    First,
    /// The moment that is shown.
    Shown,
    /// A name that no line has, for a counter of ticks.
    Made,
}

impl LoopName {
    /// All of them.
    pub const ALL: [Self; 9] = [
        Self::Duration,
        Self::Tick,
        Self::Refresh,
        Self::Second,
        Self::Cost,
        Self::Now,
        Self::First,
        Self::Shown,
        Self::Made,
    ];

    fn index(self) -> usize {
        match self {
            Self::Duration => H,
            Self::Tick => TARGET,
            Self::Refresh => REFRESH,
            Self::Second => SECOND,
            Self::Cost => COST,
            Self::Now => NOW,
            Self::First => FIRST,
            Self::Shown => SHOWN,
            Self::Made => 0,
        }
    }

    /// Returns the name among those of the lines.
    pub fn name(self) -> &'static str {
        FRAME_NAMES[self.index()]
    }

    /// Whether the loop keeps the number from frame to frame.
    fn is_kept(self) -> bool {
        matches!(self, Self::Tick | Self::Refresh | Self::Second | Self::Cost | Self::Now)
    }
}

impl StepText {
    /// Whether the lines are those of a game loop.
    pub fn is_loop(&self) -> bool {
        self.names.first().is_some_and(|name| name == FRAME_NAMES[0])
    }

    /// Whether times are whole numbers of a unit, in place of milliseconds.
    pub fn is_whole_loop(&self) -> bool {
        self.is_loop() && !self.inputs.is_empty()
    }

    /// Returns the names of the arrays, each with its size and the number with which it starts.
    pub fn arrays(&self) -> impl Iterator<Item = (&str, usize, f64)> {
        self.arrays.iter().map(|array| (&*array.name, array.size, array.start))
    }
}

impl<'t> StepBody<'t> {
    /// Whether the lines are those of a game loop.
    pub fn is_loop(self) -> bool {
        self.function.is_none() && self.text.is_loop()
    }

    /// The last name that has a value before any line.
    pub(super) fn last_told(self) -> usize {
        match (self.is_loop(), self.text.is_spin()) {
            (true, _) => SHOWN,
            (_, true) => SPIN_NAMES.len() - 1,
            _ => TARGET,
        }
    }

    /// Whether a game loop keeps this name from frame to frame, though it is no memory of the lines.
    pub fn is_kept(self, name: usize) -> bool {
        self.is_loop() && LoopName::ALL.iter().any(|it| it.is_kept() && it.index() == name)
    }

    /// Returns the name of an array.
    pub fn array(self, index: usize) -> &'t str {
        &self.text.arrays[index].name
    }

    /// Returns the number and the length of the ticks that a line of a loop makes.
    pub fn ticks(self, at: usize) -> Option<[&'t Expression; 2]> {
        match self.lines().get(at..at + 2)? {
            [
                Line::Assign { name: COUNT, value: count, .. },
                Line::Assign { name: LENGTH, value: length, .. },
            ] if self.is_loop() => Some([count, length]),
            _ => None,
        }
    }

    /// Whether a line of a loop sets the moment to show.
    pub fn shows(self, at: usize) -> bool {
        self.is_loop() && matches!(self.lines()[at], Line::Assign { name: SHOWN, .. })
    }

    /// Whether what a loop does depends on this number.
    pub fn depends_on(self, name: LoopName) -> bool {
        self.live_names()[name.index()]
    }

    /// For each name of a loop, whether a tick, the picture or a later frame depends on it.
    fn live_names(self) -> Vec<bool> {
        let is_root = |name| self.is_field(name) || [COUNT, LENGTH, SHOWN].contains(&name);
        let mut live: Vec<bool> = (0..self.names().len()).map(is_root).collect();
        loop {
            let before = live.clone();
            for line in self.lines() {
                if matches!(line, Line::Assign { name, .. } if !live[*name]) {
                    continue;
                }
                for (name, is_live) in live.iter_mut().enumerate() {
                    *is_live |= line.values().any(|value| value.reads(name));
                }
            }
            if live == before {
                return live;
            }
        }
    }

    /// For each line, whether it is one of a loop that a printer leaves out: an output of the lab alone, the sums of
    /// ticks, or a claim of the card.
    pub fn left_out(self) -> Vec<bool> {
        let lines = self.lines();
        if !self.is_loop() {
            return vec![false; lines.len()];
        }
        let live = self.live_names();
        let is_remark = |line: &str| line.starts_with('#') || line.starts_with("//");
        let claims = match self.text.notes.is_empty() {
            true => self.text.source.lines().take_while(|line| is_remark(line)).count(),
            false => 0,
        };
        let is_out = |(n, line): (usize, &Line)| match line {
            Line::Assign { name, .. } => !live[*name] || *name == LENGTH,
            Line::Remark(_) => n < claims,
            _ => false,
        };
        lines.iter().enumerate().map(is_out).collect()
    }
}
