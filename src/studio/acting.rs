//! Edits of a run by hand: actions, choices of methods, and steps in time.

use super::Studio;
use super::driving::make_tick;
use super::notice::Notice;
use super::restarting::{Jump, follow, restart};
use super::step::Step;
use crate::run::race::{Entrant, Mode, equal_cost};
use crate::run::{MenuIndex, StartSettings};
use crate::scene::{Action, LaneId, LaneSpec};
use crate::sim::bodies::TakesEffect;
use crate::sim::integrators::Method;
use crate::sim::number::round;
use crate::sim::{IMPACTS, Impact};

/// Performs an action on the run by hand.
pub(super) fn act(studio: &mut Studio, action: Action) {
    if let Action::Set { body, parameter, value } = action
        && let Some(of) = studio.scene().bodies.get(body)
        && of.kind.parameters.get(parameter).is_some_and(|it| it.acts == TakesEffect::AtStart)
    {
        let set = |start: &mut StartSettings| start.set(body, parameter, value);
        return studio.deck.set_start("the start value", set);
    }
    if action.clone().clamped_in_range().is_none() {
        return studio.viewer.set_notice(out_of_range(action.noun()));
    }
    let was_past = studio.deck.run.is_in_past();
    let replaces = studio.deck.run.replaces_open_action(&action);
    let (is_input, rests) =
        (action.input().is_some(), studio.deck.comes_to_rest(studio.viewer.motion()));
    let before = matches!(action, Action::TickHz(_)).then(|| studio.race().clone());
    let (done, mut told) = studio.deck.with_notices(|run, notices| run.act_within(action, notices));
    studio.deck.edits -= u64::from(replaces);
    let Some(done) = done else {
        studio.viewer.notice.take_if(|_| replaces);
        return studio.viewer.set_notice_parts(told);
    };
    studio.deck.edits += 1;
    match before {
        Some(before) => studio.deck.keep_beside(before),
        None => studio.deck.run_beside = None,
    }
    // The run starts, so that the person sees the effect of an input that was given at rest.
    studio.deck.running |= is_input && rests;
    if let Action::Lane { .. } = done.action {
        studio.deck.run.next_mut().entry = studio.active();
    }
    let discarded = was_past.then(|| {
        let tick = studio.race().tick();
        format!("you changed the past at tick {tick}: Ctrl Z takes it back")
    });
    let released = done.released.map(|control| {
        format!("you have the {} now: the script leaves it alone until a restart", control.name())
    });
    told.extend(released.into_iter().chain(discarded));
    studio.viewer.set_notice_parts(told);
}

pub(super) fn pick(studio: &mut Studio, entry: MenuIndex) {
    let Some(lane) = studio.deck.lane_to_pick(entry) else { return };
    studio.deck.selected = lane;
    studio.deck.is_selected = true;
    if studio.mode() == Mode::Solo {
        let mut spec = studio.entries()[entry];
        // The lines of a person's own method may have changed since the run began.
        let own = studio.scene().own_methods.iter().find(|own| own.id == spec.method.id);
        spec.method = own.copied().unwrap_or(spec.method);
        act(studio, Action::Lane { lane, spec });
    }
    studio.deck.run.next_mut().entry = entry;
}

/// Returns the menu index of a method. If the method is not on the menu, a notice explains why.
pub(super) fn menu_index(studio: &mut Studio, method: &Method) -> Option<MenuIndex> {
    let listed = studio.entries().iter().position(|spec| spec.method == method);
    if listed.is_none() {
        let why = match studio.scene().refusal(method) {
            Some(refusal) => refusal.to_string(),
            None => {
                format!("{} is not on this scene's list: the scene does not name it", method.name)
            }
        };
        studio.viewer.set_notice(why);
    }
    listed
}

/// Gives a menu method new substeps and a new tolerance, applies them to the method's lane, and picks the method. A
/// race that lacks the method restarts with it.
pub(super) fn set_lane(studio: &mut Studio, spec: LaneSpec) {
    let Some(entry) = menu_index(studio, spec.method) else { return };
    if !spec.is_in_range() {
        return studio.viewer.set_notice(out_of_range("the switch"));
    }
    match (studio.mode(), studio.deck.lane_of(entry)) {
        (Mode::Race, None) => {
            restart(studio, Some("the new race"), |next| {
                next.list[entry] = spec;
                next.entry = entry;
            });
            studio.viewer.set_notice(format!("the race restarted with {} in it", spec.method.name));
        }
        (Mode::Race, Some(flown)) => {
            let lane = flown.id;
            act(studio, Action::Lane { lane, spec });
            pick(studio, entry);
        }
        (Mode::Solo, _) => {
            let lane = studio.race().entrants()[0].id;
            act(studio, Action::Lane { lane, spec });
        }
    }
}

/// Gives the selected lane the next rule for impacts, in flight.
pub(super) fn next_impact(studio: &mut Studio) {
    if !studio.scene().bodies.iter().any(|body| body.kind.has_walls) {
        return studio.viewer.set_notice("J changes how a ball bounces: open the scene ball");
    }
    let Entrant { id: lane, spec, .. } = *studio.selected();
    let mut around = IMPACTS.iter().cycle().skip_while(|&it| it != spec.impact).skip(1);
    let bodies = &studio.deck.scene().bodies;
    let follow = |it: &Impact| bodies.iter().all(|body| body.kind.impact_refusal(it).is_none());
    let Some(impact) =
        around.find(|it| it.fits(spec.method) && follow(it)).filter(|it| *it != spec.impact)
    else {
        let name = spec.method.name;
        return studio
            .viewer
            .set_notice(format!("{name} has a rule of its own for bounces, and no other"));
    };
    act(studio, Action::Lane { lane, spec: LaneSpec { impact, ..spec } });
    studio.viewer.set_notice(format!("{}: {}", impact.id, impact.about));
}

/// Picks the next available menu entry in this direction, cyclically.
pub(super) fn pick_beside(studio: &mut Studio, step: Step) {
    let count = studio.entries().len();
    let beside = |entry: &usize| Some(step.cyclic_index(*entry, count));
    let mut around = std::iter::successors(Some(studio.active()), beside).skip(1).take(count);
    if let Some(entry) = around.find(|&entry| studio.deck.lane_to_pick(entry).is_some()) {
        pick(studio, entry);
    }
}

/// Switches equal cost on or off.
pub(super) fn toggle_equal_cost(studio: &mut Studio) {
    if studio.mode() == Mode::Solo {
        return studio.viewer.set_notice("equal cost needs a race: press C");
    }
    let lanes: Vec<(LaneId, LaneSpec)> =
        studio.race().entrants().iter().map(|entrant| (entrant.id, entrant.spec)).collect();
    let (wanted, before, notice) = match &studio.deck.run.next().lanes_before_equal_cost {
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
            let equal = equal_cost(studio.scene(), &specs, studio.race().tick_hz());
            (
                equal,
                Some(lanes.clone()),
                "equal cost is on: each lane has as many substeps as match the dearest lane's cost",
            )
        }
    };
    for ((lane, _), spec) in lanes.into_iter().zip(wanted) {
        act(studio, Action::Lane { lane, spec });
    }
    studio.deck.run.next_mut().lanes_before_equal_cost = before;
    studio.viewer.set_notice(notice);
}

/// Pauses and moves by `ticks` ticks of the run, or frames of the loop lab: forward if the number is positive, back if
/// it is negative.
pub(super) fn step_by(studio: &mut Studio, ticks: i64) {
    studio.deck.running = false;
    if let Some(loops) = studio.loop_lab_mut() {
        return loops.step(ticks);
    }
    let tick = studio.race().tick().saturating_add_signed(ticks);
    seek(studio, tick);
    while studio.race().tick() < tick {
        make_tick(studio, &mut ());
    }
    studio.deck.follow_with_compared(studio.race().t());
    studio.deck.run.show_present();
}

/// Reports how far the run has come, if it has not yet come to this tick.
pub(super) fn tell_of_the_future(studio: &mut Studio, tick: u64) {
    let (end, times) = (studio.deck.run.end(), studio.deck.run.times());
    if tick > end {
        let end = format!("{} s", round(times.t(end), 3));
        let parts = vec![format!("The run has only reached {end}"), "Space continues".into()];
        studio.viewer.set_notice(Notice::of_tick(parts));
    }
}

pub(super) fn seek(studio: &mut Studio, tick: u64) {
    studio.deck.run.seek(tick);
    follow(studio, Jump::ToAnotherTick);
}

/// Returns the notice for an action whose number is out of range.
fn out_of_range(noun: &str) -> String {
    format!("out of range, so nothing changed: {noun}")
}
