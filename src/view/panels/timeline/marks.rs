//! Marks of a run's events on its timeline. Each mark has a sign, a colour and words.

use egui::Color32;

use crate::run::race::{Race, TimeScale};
use crate::run::{Event, EventKind};
use crate::scene::{Action, LaneId, LaneSpec, Scene};
use crate::studio::Compared;
use crate::theme::PanelPalette;

/// The sign of a mark. If several marks are in one place, the sign that comes last in this order is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Sign {
    /// A stroke across the track, at the last tick that was run.
    End,
    /// A stroke, for the throttle or the rudder.
    Input,
    /// A square, for a parameter, substeps or a tolerance.
    Edit,
    /// A triangle, for the tick rate.
    Rate,
    /// A ring, for a body that was put somewhere.
    Place,
    /// A diamond, for a kick.
    Kick,
    /// A disc, for a switch of the method.
    Switch,
    /// A flag, for a body that halted.
    Halt,
    /// A cross, for the first difference from a recording.
    Parting,
}

/// A mark of an event.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TimelineMark {
    pub(super) tick: u64,
    pub(super) sign: Sign,
    pub(super) colour: Color32,
    /// Index of the event. It is `None` for the end of the run and for the difference from a recording.
    event: Option<usize>,
}

/// Marks that share a sign, because they lie close together.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct MarkGroup {
    /// The x at which the sign is drawn, in points.
    pub(super) x: f32,
    pub(super) marks: Vec<TimelineMark>,
}

impl MarkGroup {
    /// Returns the mark whose sign is drawn for the group.
    pub(super) fn drawn_mark(&self) -> &TimelineMark {
        let shown = self.marks.iter().max_by_key(|mark| mark.sign);
        shown.expect("a group begins with a mark")
    }
}

/// The inputs from which the marks are made.
pub(super) struct Context<'a> {
    pub(super) events: &'a [Event],
    pub(super) scene: &'a Scene,
    /// The race as it was at the start.
    pub(super) start: &'a Race,
    pub(super) times: &'a TimeScale,
    pub(super) palette: &'static PanelPalette,
    /// The comparison with a recording, if there is one.
    pub(super) compared: Option<&'a Compared>,
}

impl Context<'_> {
    /// Returns the marks of the events that changed a body, by tick. An edit that was undone in the same tick has no
    /// mark, and a pull has one at its start.
    pub(super) fn marks(&self) -> impl Iterator<Item = TimelineMark> {
        let events = self.events.iter().enumerate().zip(self.lasting_events());
        let shown = events.filter(|((i, event), lasts)| *lasts && !self.goes_on(*i, event));
        shown.map(|((i, Event { tick, kind }), _)| {
            let (sign, colour) = match kind {
                EventKind::Done { action, .. } => self.of_action(action),
                EventKind::Halted { .. } => (Sign::Halt, self.palette.bad),
            };
            TimelineMark { tick: *tick, sign, colour, event: Some(i) }
        })
    }

    /// Whether an event belongs to a pull that an earlier event began.
    fn goes_on(&self, index: usize, event: &Event) -> bool {
        let pulled = |event: &Event| match event.kind {
            EventKind::Done { action: Action::Push { body, .. }, .. } => Some(body),
            _ => None,
        };
        let body = pulled(event);
        let mut before = self.events[..index].iter().rev();
        body.is_some()
            && before
                .by_ref()
                .take_while(|it| it.tick + 1 >= event.tick)
                .any(|it| it.tick + 1 == event.tick && pulled(it) == body)
    }

    /// Whether each event affects a body beyond its tick. A lane that gets its old settings back moves on as before,
    /// unless the switch resumes halted bodies of the lane.
    fn lasting_events(&self) -> Vec<bool> {
        let lanes = self.start.entrants().iter();
        let mut specs: Vec<(LaneId, LaneSpec)> = lanes.map(|it| (it.id, it.spec)).collect();
        let mut halted: Vec<LaneId> = Vec::new();
        let mut lasting = Vec::with_capacity(self.events.len());
        for at_once in self.events.chunk_by(|a, b| a.tick == b.tick) {
            let before = specs.clone();
            for event in at_once {
                if let EventKind::Halted { lane: Some(lane), .. } = event.kind {
                    halted.push(lane);
                }
                let Some((lane, set)) = setting(event) else { continue };
                if let Some((_, spec)) = specs.iter_mut().find(|(id, _)| *id == lane) {
                    set(spec);
                }
            }
            let lasts = |event: &Event| match (&event.kind, setting(event)) {
                (EventKind::Done { action: Action::Solo { .. }, .. }, _) => false,
                (_, Some((lane, _))) => {
                    let of = |specs: &[(LaneId, LaneSpec)]| {
                        specs.iter().find(|(id, _)| *id == lane).map(|(_, spec)| *spec)
                    };
                    halted.contains(&lane) || of(&before) != of(&specs)
                }
                _ => true,
            };
            lasting.extend(at_once.iter().map(lasts));
        }
        lasting
    }

    /// Returns the mark of the last tick that the run reached.
    pub(super) fn end(&self, tick: u64) -> TimelineMark {
        TimelineMark { tick, sign: Sign::End, colour: self.palette.text, event: None }
    }

    /// Returns the mark of the first difference from a recording.
    pub(super) fn first_difference(&self) -> Option<TimelineMark> {
        let tick = self.compared?.tick();
        Some(TimelineMark { tick, sign: Sign::Parting, colour: self.palette.accent, event: None })
    }

    /// Returns the moment, description and author of a mark.
    pub(super) fn text(&self, mark: &TimelineMark) -> String {
        let what = match mark.event {
            Some(event) => self.events[event].kind.words(self.scene),
            None if mark.sign == Sign::End => "the run has not gone further".into(),
            None => self.compared.map_or(String::new(), |it| it.lines().join("; ")),
        };
        format!("{}: {what}", self.times.moment(mark.tick))
    }

    fn of_action(&self, action: &Action) -> (Sign, Color32) {
        let of = |spec: &LaneSpec| self.palette.style(self.start.methods(), spec).0;
        match action {
            Action::Method(method) => (Sign::Switch, of(&LaneSpec::plain(method))),
            Action::Lane { spec, .. } => (Sign::Switch, of(spec)),
            Action::Solo { .. } => (Sign::Switch, self.palette.text),
            Action::Substeps { .. } | Action::Tolerance { .. } | Action::Set { .. } => {
                (Sign::Edit, self.palette.accent)
            }
            Action::TickHz(_) => (Sign::Rate, self.palette.text),
            Action::Throttle(_) | Action::Rudder(_) => (Sign::Input, self.palette.dim),
            Action::Kick(_) | Action::Push { .. } => (Sign::Kick, self.palette.warn),
            Action::Place { .. } => (Sign::Place, self.palette.good),
        }
    }
}

/// Returns the lane whose settings an event changes, and the function that applies the change.
fn setting(event: &Event) -> Option<(LaneId, impl Fn(&mut LaneSpec) + use<>)> {
    let EventKind::Done { action, .. } = &event.kind else { return None };
    let (lane, whole, substeps, tolerance) = match *action {
        Action::Lane { lane, spec } => (lane, Some(spec), None, None),
        Action::Substeps { lane, substeps } => (lane, None, Some(substeps), None),
        Action::Tolerance { lane, tolerance } => (lane, None, None, Some(tolerance)),
        _ => return None,
    };
    let set = move |spec: &mut LaneSpec| {
        *spec = whole.unwrap_or(*spec);
        spec.substeps = substeps.unwrap_or(spec.substeps);
        spec.tolerance = tolerance.or(spec.tolerance);
    };
    Some((lane, set))
}

/// Groups the marks in their order. A mark joins a group if it lies less than `apart` points from the group's first
/// mark.
pub(super) fn grouped(
    marks: impl Iterator<Item = TimelineMark>,
    x: impl Fn(&TimelineMark) -> f32,
    apart: f32,
) -> Vec<MarkGroup> {
    let mut groups: Vec<MarkGroup> = Vec::new();
    for mark in marks {
        let x = x(&mark);
        match groups.last_mut() {
            Some(group) if x - group.x < apart => group.marks.push(mark),
            _ => groups.push(MarkGroup { x, marks: vec![mark] }),
        }
    }
    groups
}

/// Returns the colours of a lane's methods, each with its first tick. The first colour starts at tick 0.
pub(super) fn colours(
    lane: LaneId,
    events: &[Event],
    start: &Race,
    palette: &PanelPalette,
) -> Vec<(u64, Color32)> {
    let of = |spec: &LaneSpec| palette.style(start.methods(), spec).0;
    let first = start.entrant(lane).map_or(palette.dim, |entrant| of(&entrant.spec));
    let mut colours = vec![(0, first)];
    for event in events {
        match event.kind {
            EventKind::Done { action: Action::Lane { lane: switched, spec }, .. }
                if switched == lane =>
            {
                colours.push((event.tick, of(&spec)));
            }
            EventKind::Done { action: Action::Method(method), solo: Some(_), .. } => {
                colours.push((event.tick, of(&LaneSpec::plain(method))));
            }
            _ => {}
        }
    }
    colours
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::studio::{RunCommand, StageCommand, Studio};
    use crate::theme::palette_of;

    fn marks(studio: &Studio) -> Vec<(Sign, String)> {
        let timeline = studio.run();
        let (events, start, times) = (&timeline.events(), timeline.start(), &timeline.times());
        let palette = palette_of(studio.display().theme);
        let context =
            Context { events, scene: studio.scene(), start, times, palette, compared: None };
        context.marks().map(|mark| (mark.sign, context.text(&mark))).collect()
    }

    fn texts(studio: &Studio) -> Vec<String> {
        marks(studio).into_iter().map(|(_, text)| text).collect()
    }

    fn found_colours(studio: &Studio, lane: LaneId) -> Vec<(u64, Color32)> {
        let timeline = studio.run();
        colours(lane, &timeline.events(), timeline.start(), palette_of(studio.display().theme))
    }

    fn run(studio: &mut Studio, ticks: u32) {
        (0..ticks).for_each(|_| studio.tick());
    }

    #[test]
    fn a_mark_names_its_time_lane_action_and_author() {
        let text = "title = 'x'\ntick_hz = 60\nseconds = 5\nmethods = ['explicit-euler']\n\
                    [[spring]]\nname = 'buoy'\nmass_kg = 1\nstiffness_n_per_m = 40\nkick_n_s = 1\n\
                    [[command]]\nat_s = 0.2\nmethod = 'rk4'\n";
        let mut studio = Studio::new(Scene::parse("marked.toml", text).unwrap());
        run(&mut studio, 30);
        studio.apply(RunCommand::Act(Action::Kick(1.0)));
        studio.apply(RunCommand::Act(Action::Set { body: 0, parameter: 1, value: 90.0 }));
        studio.apply(StageCommand::TickHz(20.into()));
        run(&mut studio, 10);
        studio.apply(RunCommand::Act(Action::Substeps { lane: LaneId(1), substeps: 4 }));
        studio.apply(RunCommand::Act(Action::Kick(-2.5)));
        run(&mut studio, 1);
        assert_eq!(
            texts(&studio),
            [
                "tick 12 (0.200 s): rk4 in lane 1, by the script",
                "tick 30 (0.500 s): kick, by hand",
                "tick 30 (0.500 s): stiffness of buoy = 90 N/m, by hand",
                "tick 30 (0.500 s): 20 Hz, by hand",
                "tick 40 (1.000 s): 4 substeps in lane 1, by hand",
                "tick 40 (1.000 s): kick ×\u{2212}2.5, by hand",
            ]
        );
        let signs: Vec<Sign> = marks(&studio).iter().map(|(sign, _)| *sign).collect();
        use Sign::*;
        assert_eq!(signs, [Switch, Kick, Edit, Rate, Edit, Kick]);
    }

    #[test]
    fn a_pull_of_many_ticks_has_one_mark() {
        let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
        run(&mut studio, 10);
        let push = |body: usize| Action::Push { body, by: [0.1].into() };
        let pulled = |studio: &mut Studio, ticks: u32| {
            for _ in 0..ticks {
                studio.apply(RunCommand::Act(push(0)));
                run(studio, 1);
            }
        };
        pulled(&mut studio, 30);
        assert_eq!(marks(&studio).len(), 1);
        run(&mut studio, 5);
        pulled(&mut studio, 3);
        studio.apply(RunCommand::Act(push(1)));
        let ticks = texts(&studio).into_iter().map(|text| text[..8].trim().to_owned());
        assert_eq!(ticks.collect::<Vec<_>>(), ["tick 10", "tick 45", "tick 48"]);
    }

    #[test]
    fn actions_undone_at_once_or_without_a_body_leave_no_mark() {
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        studio.apply(StageCommand::ToggleRace);
        run(&mut studio, 20);
        studio.apply(RunCommand::ToggleEqualCost);
        let on = marks(&studio).len();
        assert!((1..6).contains(&on), "{on} lanes have other substeps now");
        studio.apply(RunCommand::ToggleEqualCost);
        assert_eq!(texts(&studio), [""; 0]);
        run(&mut studio, 20);
        studio.apply(RunCommand::ToggleEqualCost);
        run(&mut studio, 5);
        studio.apply(RunCommand::ToggleEqualCost);
        assert_eq!(marks(&studio).len(), 2 * on, "each for some time");
        studio.apply(StageCommand::ToggleRace);
        assert_eq!(marks(&studio).len(), 2 * on, "that lanes leave is done to no body");
    }

    #[test]
    fn a_switch_after_the_race_is_marked_in_the_remaining_lane() {
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        studio.apply(StageCommand::ToggleRace);
        run(&mut studio, 20);
        studio.apply(RunCommand::Act(Action::Solo { lane: LaneId(3) }));
        studio.apply(StageCommand::Pick(0));
        let text = texts(&studio).pop().unwrap();
        assert!(text.ends_with("explicit-euler in lane 3, by hand"), "{text}");
        assert_eq!(found_colours(&studio, LaneId(3)).len(), 2);
    }

    #[test]
    fn a_body_that_blows_up_is_marked_with_its_lane() {
        let mut studio = Studio::new(Scene::built_in("stiff").unwrap());
        studio.apply(StageCommand::ToggleRace);
        run(&mut studio, 300);
        let (_, text) = marks(&studio).into_iter().find(|(sign, _)| *sign == Sign::Halt).unwrap();
        assert!(text.ends_with(" in lane 1 blew up"), "{text}");
    }

    #[test]
    fn touching_marks_merge_under_the_most_important_sign() {
        let mark = |tick, sign| TimelineMark { tick, sign, colour: Color32::WHITE, event: None };
        let marks = vec![
            mark(0, Sign::Kick),
            mark(3, Sign::Halt),
            mark(9, Sign::Edit),
            mark(10, Sign::Edit),
            mark(30, Sign::Input),
        ];
        let groups = grouped(marks.into_iter(), |mark| mark.tick as f32, 10.0);
        let found: Vec<_> = groups
            .iter()
            .map(|group| (group.x, group.marks.len(), group.drawn_mark().tick))
            .collect();
        assert_eq!(found, [(0.0, 3, 3), (10.0, 1, 10), (30.0, 1, 30)]);
        assert!(grouped(std::iter::empty(), |_| 0.0, 10.0).is_empty());
    }

    #[test]
    fn the_track_has_the_colours_of_the_methods_in_force() {
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        let of = |studio: &Studio, entry: usize| {
            palette_of(studio.display().theme).style(studio.entries(), &studio.entries()[entry]).0
        };
        run(&mut studio, 20);
        studio.apply(StageCommand::Pick(3));
        run(&mut studio, 20);
        assert_eq!(found_colours(&studio, LaneId(1)), [(0, of(&studio, 0)), (20, of(&studio, 3))]);
    }
}
