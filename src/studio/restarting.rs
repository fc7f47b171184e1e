//! Jumps of the run, which are restarts, undo and redo. The clock, the plots, the hand and the selection follow them.
//!
//! A jump makes everything invalid that was measured on the way: the log of frames, a body in hand, the run beside. All
//! jumps end in [`follow`], so that none can forget one of these. A restart keeps the old run for undo only if that run
//! would not simply repeat itself.

use std::sync::Arc;

use super::deck::Deck;
use super::run_before::EndingRun;
use super::viewer::Viewer;
use crate::run::race::{Author, Mode};
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
pub(super) fn follow(deck: &mut Deck, viewer: &mut Viewer, jump: Jump) {
    deck.clock.set_tick_hz(deck.race().tick_hz());
    viewer.live.jump();
    if jump != Jump::ToAnotherTick {
        deck.let_go();
        (deck.run_before, deck.run_beside) = (None, None);
        record_chosen_coordinates(deck, viewer);
    }
    if jump == Jump::ToAnotherRun {
        deck.select_entry_of_start();
        deck.clock.restart();
        deck.dropped = 0;
        (viewer.notice, deck.compared) = (None, None);
    }
    deck.follow_with_compared(deck.race().t());
    deck.run.show_present();
}

/// Whether a person has acted on the run.
pub(super) fn is_by_hand(run: &Run) -> bool {
    run.session().journal().rows().iter().any(|row| row.author == Author::Person)
}

/// Restarts the run after `set` has edited its settings. If `kept` has a description, an undo can bring back the run so
/// far. Otherwise that run is lost.
pub(super) fn restart(
    deck: &mut Deck,
    viewer: &mut Viewer,
    kept: Option<&str>,
    set: impl FnOnce(&mut StartSettings),
) {
    deck.running = deck.runs_or_rests(viewer.motion());
    deck.run.restart(kept, set);
    follow(deck, viewer, Jump::ToAnotherRun);
}

/// Restarts the run. An undo can bring back the old run if a person has acted on it, or if it began with other
/// settings. Any other run would only repeat itself. Returns whether the old run was kept.
pub(super) fn restart_keeping_run(deck: &mut Deck, viewer: &mut Viewer) -> bool {
    let is_edited = !Arc::ptr_eq(deck.run.session().scene(), &deck.run.next().scene);
    let keeps = is_by_hand(&deck.run) || is_edited;
    let (earlier, ending) = (deck.run_before.take(), EndingRun::of(&deck.run, deck.selected()));
    let start = deck.run.start().clone();
    restart(deck, viewer, keeps.then_some("the restart"), |_| ());
    if !is_edited {
        let beside = ending.as_ref().and_then(|it| it.beside(start, &deck.run, deck.selected()));
        deck.run_beside = beside.map(Box::new);
        deck.run_before =
            ending.and_then(|ending| ending.before(&deck.run, deck.selected())).or(earlier);
    }
    keeps
}

/// Undoes the last edit.
pub(super) fn undo(deck: &mut Deck, viewer: &mut Viewer) {
    let what = deck.run.undoes().map(str::to_owned);
    let undone = what.map(|what| format!("undid: {what}. Ctrl Shift Z redoes it"));
    exchange(deck, viewer, Run::undo, undone.as_deref().unwrap_or("nothing to undo"));
}

/// Redoes the edit that was undone last.
pub(super) fn redo(deck: &mut Deck, viewer: &mut Viewer) {
    let what = deck.run.redoes().map(str::to_owned);
    let redone = what.map(|what| format!("redid: {what}. Ctrl Z takes it back"));
    exchange(deck, viewer, Run::redo, redone.as_deref().unwrap_or("nothing to redo"));
}

/// Calls `exchange`, which moves the run to the other side of an edit, and shows `notice`.
fn exchange(deck: &mut Deck, viewer: &mut Viewer, exchange: fn(&mut Run) -> bool, notice: &str) {
    let rested = deck.comes_to_rest(viewer.motion());
    let StartSettings { entry, ref opened, .. } = *deck.run.next();
    let opened = Arc::clone(opened);
    if !exchange(&mut deck.run) {
        return viewer.set_notice(notice);
    }
    // The selection stays, because selecting a lane is not an edit.
    let is_there = deck.race().entrant(deck.selected).is_some();
    if deck.mode() == Mode::Race && is_there {
        deck.run.next_mut().entry = entry;
    } else {
        deck.select_entry_of_start();
    }
    if !Arc::ptr_eq(&opened, &deck.run.next().opened) {
        viewer.findings = None;
    }
    follow(deck, viewer, Jump::OverAnEdit);
    deck.running |= rested && !deck.comes_to_rest(viewer.motion());
    viewer.set_notice(notice);
}

/// Shows this coordinate of a body in the plots. This may repeat the run. If that would take too long, the coordinate
/// is plotted only after the next restart.
pub(super) fn plot_coordinate(
    deck: &mut Deck,
    viewer: &mut Viewer,
    body: usize,
    coordinate: usize,
) {
    let Some(of) = deck.race().truth().bodies().get(body) else { return };
    let Some(chosen) = of.coordinates().get(coordinate) else { return };
    let name = chosen.name;
    viewer.view.choose_coordinate(body, coordinate);
    if record_chosen_coordinates(deck, viewer) {
        return deck.run.show_present();
    }
    viewer.set_notice(format!("{name} is plotted from the next restart on: press Home"));
}

/// Records the chosen coordinates, and for other bodies the usual ones. Returns whether this was possible.
pub(super) fn record_chosen_coordinates(deck: &mut Deck, viewer: &mut Viewer) -> bool {
    let chosen = &viewer.view.coordinates;
    let coordinate = |(index, usual): (usize, usize)| {
        let count = deck.race().truth().bodies()[index].coordinates().len();
        let chosen = chosen.get(index).copied().flatten();
        chosen.filter(|&index| index < count).unwrap_or(usual)
    };
    let bodies = deck.race().truth().bodies().iter();
    let usual = bodies.map(|body| body.plotted_coordinate()).enumerate();
    let coordinates: Vec<usize> = usual.map(coordinate).collect();
    deck.run.record_coordinates(&coordinates)
}
