//! What happened in a run, as marks on its timeline: each with its sign, its colour and its words.

use egui::Color32;

use super::super::Ink;
use crate::lab::number::round;
use crate::lab::session::EventKind;
use crate::lab::{Action, Event, LaneId, LaneSpec, Mode, Race, Scene, Source, TimeScale};

/// The sign of a mark. Of several in one place the last of this list is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Sign {
    /// A stroke across the track: beyond it nothing was run.
    End,
    /// A stroke: throttle, rudder.
    Input,
    /// A square: a parameter, substeps, a tolerance.
    Edit,
    /// A triangle: the tick rate.
    Rate,
    /// A ring: a body put somewhere.
    Place,
    /// A diamond.
    Kick,
    /// A disc: another method.
    Switch,
    /// A flag: a body that halted.
    Halt,
}

/// Something that happened.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Mark {
    pub(super) tick: u64,
    pub(super) sign: Sign,
    pub(super) colour: Color32,
    /// When, what and by whom.
    pub(super) text: String,
}

/// Marks that are drawn as one.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Group {
    /// Where, in points.
    pub(super) x: f32,
    pub(super) marks: Vec<Mark>,
}

impl Group {
    /// The mark that is drawn for all.
    pub(super) fn shown(&self) -> &Mark {
        let shown = self.marks.iter().max_by_key(|mark| mark.sign);
        shown.expect("a group begins with a mark")
    }
}

/// What tells events in words.
pub(super) struct Context<'a> {
    pub(super) scene: &'a Scene,
    /// The race as it started.
    pub(super) start: &'a Race,
    pub(super) times: &'a TimeScale,
    pub(super) ink: &'static Ink,
}

impl Context<'_> {
    /// The marks of these events, by tick.
    pub(super) fn marks(&self, events: &[Event]) -> Vec<Mark> {
        let (mut mode, alarm) = (self.start.mode(), self.ink.bad);
        let mark = |event: &Event| {
            let (sign, colour, what) = match &event.kind {
                EventKind::Done(action, source) => {
                    if let Action::Solo { .. } = action {
                        mode = Mode::Solo;
                    }
                    let (sign, colour, what) = self.of_action(action, mode);
                    let whose = match source {
                        Source::Script => "by the script",
                        Source::Hand => "by hand",
                    };
                    (sign, colour, format!("{what}, {whose}"))
                }
                EventKind::Halted { lane, body, is_blow_up } => {
                    let what = self.of_halt(*lane, *body, *is_blow_up);
                    (Sign::Halt, alarm, what)
                }
            };
            let text = format!("{}: {what}", moment(event.tick, self.times));
            Mark { tick: event.tick, sign, colour, text }
        };
        events.iter().map(mark).collect()
    }

    /// The mark of the last tick that was reached.
    pub(super) fn end(&self, tick: u64) -> Mark {
        let text = format!("{}: the run has not gone further", moment(tick, self.times));
        Mark { tick, sign: Sign::End, colour: self.ink.text, text }
    }

    fn of_action(&self, action: &Action, mode: Mode) -> (Sign, Color32, String) {
        let of = |spec: &LaneSpec| self.ink.style(self.start.methods(), spec).0;
        let percent = |part: f64| format!("{} %", round(100.0 * part, 3));
        match *action {
            Action::Method(method) => {
                let what = match mode {
                    Mode::Solo => {
                        format!("{} in lane {}", method.id, self.start.entrants()[0].id)
                    }
                    Mode::Race => format!("{} is selected", method.id),
                };
                (Sign::Switch, of(&LaneSpec::plain(method)), what)
            }
            Action::Lane { lane, spec } => {
                let mut what = spec.method.id.to_owned();
                if spec.substeps > 1 {
                    what += &format!(" ×{}", spec.substeps);
                }
                if let Some(tolerance) = spec.tolerance {
                    what += &format!(" within {}", round(tolerance, 3));
                }
                (Sign::Switch, of(&spec), format!("{what} in lane {lane}"))
            }
            Action::Solo { lane } => {
                (Sign::Switch, self.ink.text, format!("lane {lane} goes on without the others"))
            }
            Action::Substeps { lane, substeps } => {
                let s = if substeps == 1 { "" } else { "s" };
                (Sign::Edit, self.ink.accent, format!("{substeps} substep{s} in lane {lane}"))
            }
            Action::Tolerance { lane, tolerance } => {
                let what = format!("tolerance {} in lane {lane}", round(tolerance, 3));
                (Sign::Edit, self.ink.accent, what)
            }
            Action::Set { body, parameter, value } => {
                let body = &self.scene.bodies[body];
                let parameter = &body.kind.parameters[parameter];
                let quantity = format!("{} of {}", parameter.quantity(), body.name);
                let value = format!("{} {}", round(value, 5), parameter.unit);
                (Sign::Edit, self.ink.accent, format!("{quantity} = {}", value.trim_end()))
            }
            Action::TickHz(tick_hz) => (Sign::Rate, self.ink.text, format!("{tick_hz} Hz")),
            Action::Throttle(part) => {
                (Sign::Input, self.ink.dim, format!("throttle {}", percent(part)))
            }
            Action::Rudder(part) => {
                (Sign::Input, self.ink.dim, format!("rudder {}", percent(part)))
            }
            Action::Kick(1.0) => (Sign::Kick, self.ink.warn, "kick".into()),
            Action::Kick(times) => {
                (Sign::Kick, self.ink.warn, format!("kick ×{}", round(times, 3)))
            }
            Action::Place { body, .. } => (
                Sign::Place,
                self.ink.good,
                format!("{} is moved by hand", self.scene.bodies[body].name),
            ),
        }
    }

    fn of_halt(&self, lane: Option<LaneId>, body: usize, is_blow_up: bool) -> String {
        let name = &self.scene.bodies[body].name;
        let fate = if is_blow_up { "blew up" } else { "halted: its solver gave up" };
        match lane {
            None => format!("the exact solution of {name} {fate}"),
            Some(lane) => format!("{name} in lane {lane} {fate}"),
        }
    }
}

/// A tick and its time, in words.
pub(super) fn moment(tick: u64, times: &TimeScale) -> String {
    format!("tick {tick} ({:.3} s)", times.t(tick))
}

/// Marks in order, those less than `apart` points from the first of a group merged into it.
pub(super) fn grouped(marks: Vec<Mark>, x: impl Fn(&Mark) -> f32, apart: f32) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    for mark in marks {
        let x = x(&mark);
        match groups.last_mut() {
            Some(group) if x - group.x < apart => group.marks.push(mark),
            _ => groups.push(Group { x, marks: vec![mark] }),
        }
    }
    groups
}

/// The colours of the methods that a lane was under, each from a tick on; the first from the start.
pub(super) fn colours(
    lane: LaneId,
    events: &[Event],
    start: &Race,
    ink: &Ink,
) -> Vec<(u64, Color32)> {
    let of = |spec: &LaneSpec| ink.style(start.methods(), spec).0;
    let first = start.entrant(lane).map_or(ink.dim, |entrant| of(&entrant.spec));
    let mut mode = start.mode();
    let mut colours = vec![(0, first)];
    for event in events {
        match event.kind {
            EventKind::Done(Action::Lane { lane: switched, spec }, _) if switched == lane => {
                colours.push((event.tick, of(&spec)));
            }
            EventKind::Done(Action::Method(method), _) if mode == Mode::Solo => {
                colours.push((event.tick, of(&LaneSpec::plain(method))));
            }
            EventKind::Done(Action::Solo { .. }, _) => mode = Mode::Solo,
            _ => {}
        }
    }
    colours
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::{Lab, RunCommand, StageCommand};
    use crate::view::theme::ink_of;

    fn marks(lab: &Lab) -> Vec<Mark> {
        let timeline = lab.timeline();
        let (start, times) = (timeline.start(), &timeline.times());
        let ink = ink_of(lab.display().theme);
        Context { scene: lab.scene(), start, times, ink }.marks(&timeline.events())
    }

    fn texts(lab: &Lab) -> Vec<String> {
        marks(lab).into_iter().map(|mark| mark.text).collect()
    }

    fn run(lab: &mut Lab, ticks: u32) {
        (0..ticks).for_each(|_| lab.tick());
    }

    #[test]
    fn a_mark_says_when_where_what_and_by_whom() {
        let text = "title = 'x'\ntick_hz = 60\nseconds = 5\nmethods = ['explicit-euler']\n\
                    [[spring]]\nname = 'buoy'\nmass_kg = 1\nstiffness_n_per_m = 40\nkick_n_s = 1\n\
                    [[command]]\ntick = 12\nmethod = 'rk4'\n";
        let mut lab = Lab::new(Scene::parse("marked.toml", text).unwrap());
        run(&mut lab, 30);
        lab.apply(RunCommand::Act(Action::Kick(1.0)));
        lab.apply(RunCommand::Act(Action::Set { body: 0, parameter: 1, value: 90.0 }));
        lab.apply(StageCommand::TickHz(20));
        run(&mut lab, 10);
        lab.apply(RunCommand::Act(Action::Substeps { lane: LaneId(1), substeps: 4 }));
        lab.apply(RunCommand::Act(Action::Kick(-2.5)));
        run(&mut lab, 1);
        assert_eq!(
            texts(&lab),
            [
                "tick 12 (0.200 s): rk4 in lane 1, by the script",
                "tick 30 (0.500 s): kick, by hand",
                "tick 30 (0.500 s): stiffness of buoy = 90 N/m, by hand",
                "tick 30 (0.500 s): 20 Hz, by hand",
                "tick 40 (1.000 s): 4 substeps in lane 1, by hand",
                "tick 40 (1.000 s): kick ×\u{2212}2.5, by hand",
            ]
        );
        let signs: Vec<Sign> = marks(&lab).iter().map(|mark| mark.sign).collect();
        use Sign::*;
        assert_eq!(signs, [Switch, Kick, Edit, Rate, Edit, Kick]);
    }

    #[test]
    fn a_body_that_blows_up_is_marked_with_its_lane() {
        let mut lab = Lab::new(Scene::built_in("stiff").unwrap());
        lab.apply(StageCommand::ToggleRace);
        run(&mut lab, 300);
        let halts: Vec<Mark> =
            marks(&lab).into_iter().filter(|mark| mark.sign == Sign::Halt).collect();
        assert!(!halts.is_empty());
        assert!(halts[0].text.ends_with(" in lane 1 blew up"), "{}", halts[0].text);
    }

    #[test]
    fn marks_that_would_touch_are_one_with_the_sign_that_matters_most() {
        let mark = |tick, sign| Mark { tick, sign, colour: Color32::WHITE, text: tick.to_string() };
        let marks = vec![
            mark(0, Sign::Kick),
            mark(3, Sign::Halt),
            mark(9, Sign::Edit),
            mark(10, Sign::Edit),
            mark(30, Sign::Input),
        ];
        let groups = grouped(marks, |mark| mark.tick as f32, 10.0);
        let found: Vec<_> =
            groups.iter().map(|group| (group.x, group.marks.len(), group.shown().tick)).collect();
        assert_eq!(found, [(0.0, 3, 3), (10.0, 1, 10), (30.0, 1, 30)]);
        assert!(grouped(Vec::new(), |_| 0.0, 10.0).is_empty());
    }

    #[test]
    fn the_track_has_the_colours_of_the_methods_in_force() {
        let mut lab = Lab::new(Scene::built_in("spring").unwrap());
        let of = |lab: &Lab, entry: usize| {
            ink_of(lab.display().theme).style(lab.entries(), &lab.entries()[entry]).0
        };
        run(&mut lab, 20);
        lab.apply(StageCommand::Pick(3));
        run(&mut lab, 20);
        let timeline = lab.timeline();
        let found =
            colours(LaneId(1), &timeline.events(), timeline.start(), ink_of(lab.display().theme));
        assert_eq!(found, [(0, of(&lab, 0)), (20, of(&lab, 3))]);
    }
}
