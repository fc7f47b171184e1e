//! Edits of a run by hand: actions, choices of methods, and steps in time.

use super::deck::Deck;
use super::driving::make_tick;
use super::notice::Notice;
use super::restarting::{Jump, follow, restart};
use super::step::Step;
use super::viewer::Viewer;
use crate::run::race::{Entrant, Mode, equal_cost};
use crate::run::{MenuIndex, StartSettings};
use crate::scene::{Action, LaneId, LaneSpec};
use crate::sim::bodies::TakesEffect;
use crate::sim::integrators::Method;
use crate::sim::number::round;
use crate::sim::{IMPACTS, Impact};

/// Performs an action on the run by hand.
pub(super) fn act(deck: &mut Deck, viewer: &mut Viewer, action: Action) {
    if let Action::Set { body, parameter, value } = action
        && let Some(of) = deck.scene().bodies.get(body)
        && of.kind.parameters.get(parameter).is_some_and(|it| it.acts == TakesEffect::AtStart)
    {
        let set = |start: &mut StartSettings| start.set(body, parameter, value);
        return deck.set_start("the start value", set);
    }
    if action.clone().clamped_in_range().is_none() {
        return viewer.set_notice(out_of_range(action.noun()));
    }
    let was_past = deck.run.is_in_past();
    let replaces = deck.run.replaces_open_action(&action);
    let (is_input, rests) = (action.input().is_some(), deck.comes_to_rest(viewer.motion()));
    let before = matches!(action, Action::TickHz(_)).then(|| deck.race().clone());
    let (done, mut told) = deck.with_notices(|run, notices| run.act_within(action, notices));
    deck.edits -= u64::from(replaces);
    let Some(done) = done else {
        viewer.notice.take_if(|_| replaces);
        return viewer.set_notice_parts(told);
    };
    deck.edits += 1;
    match before {
        Some(before) => deck.keep_beside(before),
        None => deck.run_beside = None,
    }
    // The run starts, so that the person sees the effect of an input that was given at rest.
    deck.running |= is_input && rests;
    if let Action::Lane { .. } = done.action {
        deck.run.next_mut().entry = deck.active();
    }
    let discarded = was_past.then(|| {
        let tick = deck.race().tick();
        format!("you changed the past at tick {tick}: Ctrl Z takes it back")
    });
    let released = done.released.map(|control| {
        format!("you have the {} now: the script leaves it alone until a restart", control.name())
    });
    told.extend(released.into_iter().chain(discarded));
    viewer.set_notice_parts(told);
}

pub(super) fn pick(deck: &mut Deck, viewer: &mut Viewer, entry: MenuIndex) {
    let Some(lane) = deck.lane_to_pick(entry) else { return };
    deck.selected = lane;
    deck.is_selected = true;
    if deck.mode() == Mode::Solo {
        let spec = deck.entries()[entry];
        act(deck, viewer, Action::Lane { lane, spec });
    }
    deck.run.next_mut().entry = entry;
}

/// Returns the menu index of a method. If the method is not on the menu, a notice explains why.
pub(super) fn menu_index(
    deck: &mut Deck,
    viewer: &mut Viewer,
    method: &Method,
) -> Option<MenuIndex> {
    let listed = deck.entries().iter().position(|spec| spec.method == method);
    if listed.is_none() {
        let why = match deck.scene().refusal(method) {
            Some(refusal) => refusal.to_string(),
            None => {
                format!("{} is not on this scene's list: the scene does not name it", method.name)
            }
        };
        viewer.set_notice(why);
    }
    listed
}

/// Gives a menu method new substeps and a new tolerance, applies them to the method's lane, and picks the method. A
/// race that lacks the method restarts with it.
pub(super) fn set_lane(deck: &mut Deck, viewer: &mut Viewer, spec: LaneSpec) {
    let Some(entry) = menu_index(deck, viewer, spec.method) else { return };
    if !spec.is_in_range() {
        return viewer.set_notice(out_of_range("the switch"));
    }
    match (deck.mode(), deck.lane_of(entry)) {
        (Mode::Race, None) => {
            restart(deck, viewer, Some("the new race"), |next| {
                next.list[entry] = spec;
                next.entry = entry;
            });
            viewer.set_notice(format!("the race restarted with {} in it", spec.method.name));
        }
        (Mode::Race, Some(flown)) => {
            let lane = flown.id;
            act(deck, viewer, Action::Lane { lane, spec });
            pick(deck, viewer, entry);
        }
        (Mode::Solo, _) => {
            let lane = deck.race().entrants()[0].id;
            act(deck, viewer, Action::Lane { lane, spec });
        }
    }
}

/// Gives the selected lane the next rule for impacts, in flight.
pub(super) fn next_impact(deck: &mut Deck, viewer: &mut Viewer) {
    if !deck.scene().bodies.iter().any(|body| body.kind.has_walls) {
        return viewer.set_notice("J changes how a ball bounces: open the scene ball");
    }
    let Entrant { id: lane, spec, .. } = *deck.selected();
    let mut around = IMPACTS.iter().cycle().skip_while(|&it| it != spec.impact).skip(1);
    let bodies = &deck.scene().bodies;
    let follow = |it: &Impact| bodies.iter().all(|body| body.kind.impact_refusal(it).is_none());
    let Some(impact) =
        around.find(|it| it.fits(spec.method) && follow(it)).filter(|it| *it != spec.impact)
    else {
        let name = spec.method.name;
        return viewer
            .set_notice(format!("{name} has a rule of its own for bounces, and no other"));
    };
    act(deck, viewer, Action::Lane { lane, spec: LaneSpec { impact, ..spec } });
    viewer.set_notice(format!("{}: {}", impact.id, impact.about));
}

/// Picks the next available menu entry in this direction, cyclically.
pub(super) fn pick_beside(deck: &mut Deck, viewer: &mut Viewer, step: Step) {
    let count = deck.entries().len();
    let beside = |entry: &usize| Some(step.cyclic_index(*entry, count));
    let mut around = std::iter::successors(Some(deck.active()), beside).skip(1).take(count);
    if let Some(entry) = around.find(|&entry| deck.lane_to_pick(entry).is_some()) {
        pick(deck, viewer, entry);
    }
}

/// Switches equal cost on or off.
pub(super) fn toggle_equal_cost(deck: &mut Deck, viewer: &mut Viewer) {
    if deck.mode() == Mode::Solo {
        return viewer.set_notice("equal cost needs a race: press C");
    }
    let lanes: Vec<(LaneId, LaneSpec)> =
        deck.race().entrants().iter().map(|entrant| (entrant.id, entrant.spec)).collect();
    let (wanted, before, notice) = match &deck.run.next().before_equal_cost {
        Some(before) => {
            let of = |(lane, spec): &(LaneId, LaneSpec)| {
                let own = before.iter().find(|(known, _)| known == lane);
                let substeps = own.map_or(spec.method.default_substeps, |(_, own)| own.substeps);
                LaneSpec { substeps, ..*spec }
            };
            let wanted: Vec<LaneSpec> = lanes.iter().map(of).collect();
            (wanted, None, "equal cost is off: lanes have their own substeps again")
        }
        None => {
            let specs: Vec<LaneSpec> = lanes.iter().map(|(_, spec)| *spec).collect();
            let equal = equal_cost(deck.scene(), &specs, deck.race().tick_hz());
            (
                equal,
                Some(lanes.clone()),
                "equal cost is on: each lane has as many substeps as match the dearest lane's cost",
            )
        }
    };
    for ((lane, _), spec) in lanes.into_iter().zip(wanted) {
        act(deck, viewer, Action::Lane { lane, spec });
    }
    deck.run.next_mut().before_equal_cost = before;
    viewer.set_notice(notice);
}

/// Pauses and moves by `ticks` ticks, forward if the number is positive, back if it is negative.
pub(super) fn step_by(deck: &mut Deck, viewer: &mut Viewer, ticks: i64) {
    deck.running = false;
    let tick = deck.race().tick().saturating_add_signed(ticks);
    seek(deck, viewer, tick);
    while deck.race().tick() < tick {
        make_tick(deck, viewer, &mut ());
    }
    deck.follow_with_compared(deck.race().t());
    deck.run.show_present();
}

/// Reports how far the run has come, if it has not yet come to this tick.
pub(super) fn tell_of_the_future(deck: &mut Deck, viewer: &mut Viewer, tick: u64) {
    let (end, times) = (deck.run.end(), deck.run.times());
    if tick > end {
        let end = format!("{} s", round(times.t(end), 3));
        let parts = vec![format!("The run has only reached {end}"), "Space continues".into()];
        viewer.set_notice(Notice::of_tick(parts));
    }
}

pub(super) fn seek(deck: &mut Deck, viewer: &mut Viewer, tick: u64) {
    deck.run.seek(tick);
    follow(deck, viewer, Jump::ToAnotherTick);
}

/// Returns the notice for an action whose number is out of range.
fn out_of_range(noun: &str) -> String {
    format!("out of range, so nothing changed: {noun}")
}
