//! Jumps of the run: restarts, undo and redo, and their followers: clock, plots, hand and selection.

use std::sync::Arc;

use super::deck::Deck;
use super::viewer::Viewer;
use crate::run::race::{Author, Mode};
use crate::run::{Run, StartSettings};

/// Target of a jump.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Jump {
    /// Another tick.
    ToAnotherTick,
    /// The other side of an edit.
    OverAnEdit,
    /// The start of another run.
    ToAnotherRun,
}

/// Updates the clock, the plots, the hand and the selection after a jump of the run.
pub(super) fn follow(deck: &mut Deck, viewer: &mut Viewer, jump: Jump) {
    deck.clock.set_tick_hz(deck.race().tick_hz());
    viewer.live.jump();
    if jump != Jump::ToAnotherTick {
        deck.let_go();
        record_chosen_coordinates(deck, viewer);
    }
    if jump == Jump::ToAnotherRun {
        deck.select_entry_of_start();
        deck.clock.restart();
        deck.dropped = 0;
        (viewer.notice, deck.compared) = (None, None);
    }
    deck.follow_with_compared();
    deck.run.show_present();
}

/// Whether a person has acted on a run.
pub(super) fn is_by_hand(run: &Run) -> bool {
    run.session().journal().rows().iter().any(|row| row.author == Author::Person)
}

/// Restarts the run after `set` has edited its settings. With a description in `kept`, an undo can bring back the run
/// so far; otherwise it is lost.
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

/// Restarts. Keeps the run for an undo if a person has acted on it, or if it began with other settings; any other
/// would only repeat itself. Returns whether it was kept.
pub(super) fn restart_keeping_run(deck: &mut Deck, viewer: &mut Viewer) -> bool {
    let is_edited = !Arc::ptr_eq(deck.run.session().scene(), &deck.run.next().scene);
    let keeps = is_by_hand(&deck.run) || is_edited;
    restart(deck, viewer, keeps.then_some("the restart"), |_| ());
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

/// Calls `exchange` to move to the other side of an edit, and shows `notice`.
fn exchange(deck: &mut Deck, viewer: &mut Viewer, exchange: fn(&mut Run) -> bool, notice: &str) {
    let rested = deck.comes_to_rest(viewer.motion());
    let StartSettings { entry, ref opened, .. } = *deck.run.next();
    let opened = Arc::clone(opened);
    if !exchange(&mut deck.run) {
        return viewer.set_notice(notice);
    }
    // Selecting a lane is not an edit, so the selection stays.
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

/// Shows this coordinate of a body in the plots. If repeating the run for it would take too long, it is plotted only
/// after the next restart.
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

/// Records the chosen coordinates, and the usual ones of other bodies. Returns whether it could.
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
