//! Actions on a run in order of ticks, by its scene's script or by a person.
//!
//! An action by a person begins another future. It drops that person's later actions, and takes its control from the
//! script until a restart. The script keeps its other controls, so that a person can steer one while the script sets
//! the rest. A script's actions keep their times in seconds, and move to other ticks with the rate.

use std::sync::Arc;

use crate::scene::{Action, Control, Piece, Scripted};
use crate::sim::TickRate;

/// The author of an action.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Author {
    /// The scene's script.
    Script,
    /// A person, or a program on behalf of a person.
    Person,
}

/// An action at a tick.
#[derive(Clone, Debug, PartialEq)]
pub struct JournalRow {
    /// The tick before which the run performs the action.
    pub tick: u64,
    /// Time of the action in seconds, which is the tick's time for a person, and the written time for a script.
    pub at_s: f64,
    /// The action.
    pub action: Action,
    /// The author of the action.
    pub author: Author,
}

/// The rows of one future of a run that come after those shared with another future.
pub(crate) struct JournalTail {
    pub(crate) kept: usize,
    pub(crate) rows: Vec<JournalRow>,
}

/// The performed and the pending actions of a run, in order. A journal is cheap to clone.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Journal {
    rows: Arc<Vec<JournalRow>>,
}

impl Journal {
    /// Creates the journal of a script, with all actions pending, for a run at this rate in Hz.
    pub fn of_script(script: &[Scripted], tick_hz: impl Into<TickRate>) -> Self {
        let row = |&Scripted { at_s, ref action }: &Scripted| JournalRow {
            tick: 0,
            at_s,
            action: action.clone(),
            author: Author::Script,
        };
        let mut journal = Self { rows: Arc::new(script.iter().map(row).collect()) };
        journal.put_on_ticks(0, Piece::first(tick_hz));
        journal
    }

    /// Moves the rows after the first `done`, which are all by a script, to the ticks now nearest to their times.
    pub(super) fn put_on_ticks(&mut self, done: usize, present: Piece) {
        let script = self.rows[done..].iter().map(|row| (row.at_s, &row.action));
        let ticks: Vec<u64> = present.put_on_ticks(script).map(|(tick, _)| tick).collect();
        if !ticks.is_empty() {
            let rows = &mut Arc::make_mut(&mut self.rows)[done..];
            rows.iter_mut().zip(ticks).for_each(|(row, tick)| row.tick = tick);
        }
    }

    /// Returns all rows in the order of performance, which is also the order of ticks.
    pub fn rows(&self) -> &[JournalRow] {
        &self.rows
    }

    /// Adds a person's action at `tick`, whose time is `at_s`, after the first `done` rows. Removes the person's
    /// later actions, and the script's later actions on the same control. Returns the number of rows up to and
    /// including the new one, and the control if the script lost it.
    pub(super) fn insert(
        &mut self,
        done: usize,
        (tick, at_s): (u64, f64),
        action: Action,
    ) -> (usize, Option<Control>) {
        let control = action.control();
        let rows = Arc::make_mut(&mut self.rows);
        let mut released = None;
        let later = rows.split_off(done);
        let row = JournalRow { tick, at_s, action, author: Author::Person };
        if is_intermediate(rows, &row) {
            rows.pop();
        }
        rows.push(row);
        let done = rows.len();
        for row in later {
            let of_script = row.author == Author::Script;
            let is_taken = control.is_some() && row.action.control() == control;
            match (of_script, is_taken) {
                (true, false) => rows.push(row),
                (true, true) => released = control,
                (false, _) => {}
            }
        }
        (done, released)
    }

    /// Returns the rows in which this journal differs from `other`, after at most `most` common rows.
    pub(crate) fn tail_beside(&self, other: &Self, most: usize) -> JournalTail {
        let alike =
            self.rows.iter().zip(&other.rows[..most]).take_while(|(own, other)| own == other);
        let kept = alike.count();
        JournalTail { kept, rows: self.rows[kept..].to_vec() }
    }

    /// Exchanges the last rows for those of another future.
    pub(crate) fn swap_tail(&mut self, tail: &mut JournalTail) {
        let rows = Arc::make_mut(&mut self.rows);
        let replaced = rows.split_off(tail.kept);
        rows.append(&mut tail.rows);
        tail.rows = replaced;
    }

    /// Whether the script acts on this control after the first `done` rows.
    pub(super) fn script_acts_on(&self, control: Option<Control>, done: usize) -> bool {
        let works = |row: &JournalRow| {
            row.author == Author::Script && control.is_some() && row.action.control() == control
        };
        self.rows[done..].iter().any(works)
    }
}

/// Whether the last row of `done` is an intermediate value of a parameter dragged within one tick, so that `next` can
/// replace that row. One real change must stay before `next`, because setting the present value again would not restart
/// the methods.
fn is_intermediate(done: &[JournalRow], next: &JournalRow) -> bool {
    let control = next.action.control();
    let is_alike = |row: &&JournalRow| {
        row.tick == next.tick && row.author == next.author && row.action.control() == control
    };
    if !matches!(control, Some(Control::Parameter { .. })) {
        return false;
    }
    let alike: Vec<&JournalRow> = done.iter().rev().take(3).take_while(is_alike).collect();
    match alike[..] {
        [_, before] => before.action != next.action,
        [_, before, first] => first.action != before.action || before.action != next.action,
        _ => false,
    }
}
