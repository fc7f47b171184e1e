//! The events of a law: walls of its coordinates, at which velocities turn.

use regatta_lines::{MAX_SWITCHES, Tape, is_linear};

use super::{Equations, FIRST_COORDINATE, LawFault, LawText, MAX_EVENTS, Part, Registers, T};
use crate::impact::Wall;

/// A time (s) at which a wall that turns or stretches with time is seen to differ from that at time 0: no period of
/// plain numbers divides it.
const OTHER_TIME_S: f64 = 1.375;

/// Returns the index of the coordinate that each event is about, or the faults of the events that are no walls.
pub(super) fn coordinates_of(text: &LawText, when: &[Tape]) -> Result<Vec<usize>, Vec<LawFault>> {
    let moves = FIRST_COORDINATE..FIRST_COORDINATE + text.coordinates.len();
    let (mut of, mut faults) = (Vec::new(), Vec::new());
    for (i, (event, tape)) in text.events.iter().zip(when).enumerate() {
        let read: Vec<usize> = moves.clone().filter(|&slot| tape.reads(slot)).collect();
        let is_wall = is_linear(tape, text.inputs(), usize::MAX, |slot| moves.contains(&slot));
        let what = match read[..] {
            [slot] if is_wall => {
                of.push(slot - FIRST_COORDINATE);
                continue;
            }
            [] => "`when` depends on no coordinate",
            _ => "`when` is no wall, which is one coordinate beside constants and `t`",
        };
        let name = &text.coordinates[0].name;
        let remedy =
            format!("write a coordinate minus the place of the wall, such as `{name} - 1`");
        faults.push(LawFault::new(Part::When(i), 0..event.when.len(), what, remedy));
    }
    if faults.is_empty() { Ok(of) } else { Err(faults) }
}

/// Refuses more events than pieces of the motion can tell apart.
pub(super) fn check_count(text: &LawText, motion: &Tape) -> Result<(), Vec<LawFault>> {
    let (events, most) = (text.events.len(), MAX_EVENTS.min(MAX_SWITCHES - motion.switches()));
    if events <= most {
        return Ok(());
    }
    let what = match most {
        MAX_EVENTS => format!("the law has {events} events"),
        _ => format!("the law has {events} events beside {} corners and jumps", motion.switches()),
    };
    let name = 0..text.events[most].name.len();
    Err(vec![LawFault::new(Part::Event(most), name, what, format!("keep at most {most}"))])
}

impl Equations {
    /// Returns the number of events.
    pub fn events(&self) -> usize {
        self.walls.len()
    }

    /// Returns how fast the expression of an event falls with its coordinate; below 0 if it rises.
    pub(super) fn slope(&self, registers: &mut Registers, index: usize, t: f64) -> f64 {
        let (tape, slots) = (&self.when[index], &mut registers.when[index]);
        let moving = FIRST_COORDINATE + self.walls[index];
        (slots[T], slots[moving]) = ([t, 0.0, 0.0], [0.0, 1.0, 0.0]);
        tape.evaluate_jets(slots);
        let slope = slots[tape.outputs[0] as usize][1];
        slots[moving] = [0.0; 3];
        slope
    }

    /// Returns the wall of an event at time `t` (s); `None` beyond the last. Never allocates.
    pub(crate) fn wall(&self, registers: &mut Registers, index: usize, t: f64) -> Option<Wall> {
        let event = self.text.events.get(index)?;
        let slope = self.slope(registers, index, t);
        let (tape, slots) = (&self.when[index], &mut registers.when[index]);
        slots[T] = [t, 1.0, 0.0];
        tape.evaluate_jets(slots);
        // The sum turns -0 into 0.
        let [at, velocity, acceleration] =
            slots[tape.outputs[0] as usize].map(|of| -of / slope + 0.0);
        let side = if (slope > 0.0) == event.falls { 1.0 } else { -1.0 };
        let coordinate = self.walls[index];
        Some(Wall { coordinate, side, at, velocity, acceleration, restitution: 1.0 })
    }

    /// Changes the velocities `v` as an event does. Never allocates.
    pub(crate) fn turn(
        &self,
        registers: &mut Registers,
        (index, t): (usize, f64),
        q: &[f64],
        v: &mut [f64],
    ) {
        let Some(tape) = &self.then else { return };
        let slots = &mut registers.then;
        slots[T] = t;
        slots[FIRST_COORDINATE..][..q.len()].copy_from_slice(q);
        slots[FIRST_COORDINATE + q.len()..][..v.len()].copy_from_slice(v);
        tape.evaluate(slots);
        let before: usize = self.text.events[..index].iter().map(|event| event.then.len()).sum();
        let changed = &self.text.events[index].then;
        for ((coordinate, _), &slot) in changed.iter().zip(&tape.outputs[before..]) {
            // The sum turns -0 into 0.
            v[*coordinate] = slots[slot as usize] + 0.0;
        }
    }

    /// Returns the fault of the first event that is no wall with the values of `registers`, or after which the law
    /// still goes into its wall. The law may not start beyond a wall, from coordinates `start`.
    pub(crate) fn event_fault(&self, registers: &mut Registers, start: &[f64]) -> Option<LawFault> {
        let n = self.text.coordinates.len();
        let fault = |part, what: String, remedy: String| {
            Some(LawFault::new(part, 0..self.part(part).len(), what, remedy))
        };
        for (i, event) in self.text.events.iter().enumerate() {
            let slopes = [0.0, OTHER_TIME_S].map(|t| self.slope(registers, i, t));
            let wall = self.wall(registers, i, 0.0).filter(|wall| wall.at.is_finite());
            let Some(wall) = wall.filter(|_| slopes[0] != 0.0 && slopes[0] == slopes[1]) else {
                let what = "`when` does not change evenly with its coordinate";
                return fault(Part::When(i), what.into(), "write `y - 1` for a wall at 1".into());
            };
            let name = &self.text.coordinates[wall.coordinate].name;
            if wall.height(start) < 0.0 {
                let other = if event.falls { "rises" } else { "falls" };
                let what = format!("the law starts beyond `{}`", event.name);
                let remedy = format!(
                    "start `{name}` on the other side of {}, or write `falling = {}` for an event where `when` {other}",
                    wall.at, !event.falls
                );
                return fault(Part::When(i), what, remedy);
            }
            for exponent in -3..5 {
                let (mut q, mut v) = (vec![0.0; n], vec![0.0; n]);
                q[wall.coordinate] = wall.at;
                v[wall.coordinate] = wall.velocity - wall.side * libm::exp2(f64::from(exponent));
                self.turn(registers, (i, 0.0), &q, &mut v);
                let speed = wall.speed(&v);
                if !speed.is_finite() || speed < 0.0 {
                    let of = event.then.iter().position(|(of, _)| *of == wall.coordinate);
                    let what = format!("`then` leaves `{}` still falling", event.name);
                    let remedy = format!("write `v{name} = \"-e*v{name}\"` with e from 0 to 1");
                    return fault(Part::Then(i, of.unwrap_or(0)), what, remedy);
                }
            }
        }
        None
    }
}
