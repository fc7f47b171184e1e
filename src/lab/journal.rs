//! What is done to a run, tick by tick: by its scene's script, by a person, or by a recording.

use std::sync::Arc;

use super::action::{Action, Control};
use super::scene::Scripted;

/// Who does something.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// The scene's script.
    Script,
    /// A person, or a program in a person's place.
    Hand,
}

/// Something that is done at a tick.
#[derive(Clone, Debug, PartialEq)]
pub struct JournalRow {
    /// The tick before which it is done.
    pub tick: u64,
    /// What is done.
    pub action: Action,
    /// By whom.
    pub source: Source,
}

/// What was done to a run and what is still to be done, in order. Cheap to copy.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Journal {
    rows: Arc<Vec<JournalRow>>,
}

impl Journal {
    /// The journal of a script that has not begun.
    pub fn of_script(script: &[Scripted]) -> Self {
        let row = |Scripted { tick, action }: &Scripted| JournalRow {
            tick: *tick,
            action: action.clone(),
            source: Source::Script,
        };
        Self { rows: Arc::new(script.iter().map(row).collect()) }
    }

    /// All rows: by tick, and within a tick in the order in which they are done.
    pub fn rows(&self) -> &[JournalRow] {
        &self.rows
    }

    /// Adds what a person does at `tick`, where `done` rows are done, and returns how many are done with it. What the
    /// person did later is taken back, and so is what the script has to come for the same control, which is returned.
    pub(super) fn insert(
        &mut self,
        done: usize,
        tick: u64,
        action: Action,
    ) -> (usize, Option<Control>) {
        let control = action.control();
        let rows = Arc::make_mut(&mut self.rows);
        let mut released = None;
        let later = rows.split_off(done);
        let row = JournalRow { tick, action, source: Source::Hand };
        if is_passed_over(rows, &row) {
            rows.pop();
        }
        rows.push(row);
        let done = rows.len();
        for row in later {
            let of_script = row.source == Source::Script;
            let is_taken = control.is_some() && row.action.control() == control;
            match (of_script, is_taken) {
                (true, false) => rows.push(row),
                (true, true) => released = control,
                (false, _) => {}
            }
        }
        (done, released)
    }

    /// Whether the script works this control after the first `done` rows.
    pub(super) fn script_works(&self, control: Option<Control>, done: usize) -> bool {
        let works = |row: &JournalRow| {
            row.source == Source::Script && control.is_some() && row.action.control() == control
        };
        self.rows[done..].iter().any(works)
    }
}

/// Whether the last of `done` is one of the many values that a parameter has while a person drags it at one tick, so
/// that `next` can take its place. A change to the value that is there already would make no method begin again, so
/// that one real change has to stay before it.
fn is_passed_over(done: &[JournalRow], next: &JournalRow) -> bool {
    let control = next.action.control();
    let is_alike = |row: &&JournalRow| {
        row.tick == next.tick && row.source == next.source && row.action.control() == control
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
