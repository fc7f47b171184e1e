//! Jumps of the run, which are restarts, undo and redo. The clock, the plots, the hand and the selection follow them.
//!
//! A jump makes everything invalid that was measured on the way: the log of frames, a body in hand, the run beside. All
//! jumps end in [`follow`], so that none can forget one of these. A restart keeps the old run for undo only if that run
//! would not simply repeat itself.

use std::sync::Arc;

use super::Studio;
use super::deck::Deck;
use super::run_before::EndingRun;
use crate::run::race::{Author, JournalRow, Mode};
use crate::run::{Run, StartSettings};

/// Kind of a jump.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Jump {
    /// A jump to another tick.
    ToAnotherTick,
    /// A jump to the other side of an edit.
    OverAnEdit,
    /// A jump to the start of another run.
    ToAnotherRun,
}

/// Updates the clock, the plots, the hand and the selection after a jump of the run.
pub(super) fn follow(studio: &mut Studio, jump: Jump) {
    studio.deck.clock.set_tick_hz(studio.race().tick_hz());
    studio.viewer.live.jump();
    if jump != Jump::ToAnotherTick {
        studio.deck.let_go();
        (studio.deck.run_before, studio.deck.run_beside) = (None, None);
        record_chosen_coordinates(studio);
    }
    if jump == Jump::ToAnotherRun {
        studio.deck.select_entry_of_start();
        studio.deck.clock.restart();
        studio.deck.dropped = 0;
        (studio.viewer.notice, studio.deck.compared) = (None, None);
    }
    studio.deck.follow_with_compared(studio.race().t());
    studio.deck.run.show_present();
}

/// Whether a person has acted on the run, apart from changes of its files.
pub(super) fn is_by_hand(deck: &Deck) -> bool {
    let mut rows = deck.run.session().journal().rows().iter();
    let is_of_file = |row: &JournalRow| {
        deck.of_files.iter().any(|(tick, action)| (*tick, action) == (row.tick, &row.action))
    };
    rows.any(|row| row.author == Author::Person && !is_of_file(row))
}

/// Restarts the run after `set` has edited its settings. If `kept` has a description, an undo can bring back the run so
/// far. Otherwise that run is lost.
pub(super) fn restart(
    studio: &mut Studio,
    kept: Option<&str>,
    set: impl FnOnce(&mut StartSettings),
) {
    studio.deck.running = studio.deck.runs_or_rests(studio.viewer.motion());
    studio.deck.run.restart(kept, set);
    follow(studio, Jump::ToAnotherRun);
}

/// Restarts the run. An undo can bring back the old run if a person has acted on it, or if it began with other
/// settings. Any other run would only repeat itself. Returns whether the old run was kept.
pub(super) fn restart_keeping_run(studio: &mut Studio) -> bool {
    let is_edited = !Arc::ptr_eq(studio.deck.run.session().scene(), &studio.deck.run.next().scene);
    let keeps = is_by_hand(&studio.deck) || is_edited || !studio.deck.of_files.is_empty();
    let (earlier, ending) =
        (studio.deck.run_before.take(), EndingRun::of(&studio.deck.run, studio.selected()));
    let start = studio.deck.run.start().clone();
    restart(studio, keeps.then_some("the restart"), |_| ());
    if !is_edited {
        let beside =
            ending.as_ref().and_then(|it| it.beside(start, &studio.deck.run, studio.selected()));
        studio.deck.run_beside = beside.map(Box::new);
        studio.deck.run_before = ending
            .and_then(|ending| ending.before(&studio.deck.run, studio.selected()))
            .or(earlier);
    }
    keeps
}

/// Undoes the last edit.
pub(super) fn undo(studio: &mut Studio) {
    let what = studio.deck.run.undoes().map(str::to_owned);
    let undone = what.map(|what| format!("undid: {what}. Ctrl Shift Z redoes it"));
    exchange(studio, Run::undo, undone.as_deref().unwrap_or("nothing to undo"));
}

/// Redoes the edit that was undone last.
pub(super) fn redo(studio: &mut Studio) {
    let what = studio.deck.run.redoes().map(str::to_owned);
    let redone = what.map(|what| format!("redid: {what}. Ctrl Z takes it back"));
    exchange(studio, Run::redo, redone.as_deref().unwrap_or("nothing to redo"));
}

/// Calls `exchange`, which moves the run to the other side of an edit, and shows `notice`.
fn exchange(studio: &mut Studio, exchange: fn(&mut Run) -> bool, notice: &str) {
    let rested = studio.deck.comes_to_rest(studio.viewer.motion());
    let StartSettings { entry, ref opened, .. } = *studio.deck.run.next();
    let opened = Arc::clone(opened);
    if !exchange(&mut studio.deck.run) {
        return studio.viewer.set_notice(notice);
    }
    // The selection stays, because selecting a lane is not an edit.
    let is_there = studio.race().entrant(studio.deck.selected).is_some();
    if studio.mode() == Mode::Race && is_there {
        studio.deck.run.next_mut().entry = entry;
    } else {
        studio.deck.select_entry_of_start();
    }
    if !Arc::ptr_eq(&opened, &studio.deck.run.next().opened) {
        studio.viewer.findings = None;
    }
    follow(studio, Jump::OverAnEdit);
    studio.deck.running |= rested && !studio.deck.comes_to_rest(studio.viewer.motion());
    studio.viewer.set_notice(notice);
}

/// Shows this coordinate of a body in the plots. This may repeat the run. If that would take too long, the coordinate
/// is plotted only after the next restart.
pub(super) fn plot_coordinate(studio: &mut Studio, body: usize, coordinate: usize) {
    let Some(of) = studio.race().truth().bodies().get(body) else { return };
    let Some(chosen) = of.coordinates().get(coordinate) else { return };
    let name = chosen.name;
    studio.viewer.view.choose_coordinate(body, coordinate);
    if record_chosen_coordinates(studio) {
        return studio.deck.run.show_present();
    }
    studio.viewer.set_notice(format!("{name} is plotted from the next restart on: press Home"));
}

/// Records the chosen coordinates, and for other bodies the usual ones. Returns whether this was possible.
pub(super) fn record_chosen_coordinates(studio: &mut Studio) -> bool {
    let chosen = &studio.viewer.view.coordinates;
    let coordinate = |(index, usual): (usize, usize)| {
        let count = studio.race().truth().bodies()[index].coordinates().len();
        let chosen = chosen.get(index).copied().flatten();
        chosen.filter(|&index| index < count).unwrap_or(usual)
    };
    let bodies = studio.race().truth().bodies().iter();
    let usual = bodies.map(|body| body.plotted_coordinate()).enumerate();
    let coordinates: Vec<usize> = usual.map(coordinate).collect();
    studio.deck.run.record_coordinates(&coordinates)
}
