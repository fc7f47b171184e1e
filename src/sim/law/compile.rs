//! Compiles the text of a law to its tapes, and decides which names each part may use.

use regatta_lines::{
    Expression, MAX_OPERATIONS, MAX_SWITCHES, Scope, Tape, is_name, is_reserved, parse, quoted,
};

use super::{ExpressionFault, LawFault, LawText, Part, T};

/// The maximum number of characters of a name. It is small because a name labels a marker.
const MAX_NAME_CHARS: usize = 24;

/// A tape, or all faults of its text.
pub(super) type Compiled = Result<Tape, Vec<LawFault>>;

/// Compiles the parts of one text.
pub(super) struct Compiler<'t> {
    pub(super) text: &'t LawText,
}

/// The names that one part may use.
pub(super) struct PartScope<'t> {
    pub(super) text: &'t LawText,
    pub(super) part: Part,
}

impl PartScope<'_> {
    /// Returns all names with the slots of their inputs, in the order of lookup. A constant comes before a start of the
    /// same name.
    fn all(&self) -> impl Iterator<Item = (String, usize)> {
        let names = self.text.coordinates.iter().map(|coordinate| &coordinate.name);
        ["t", "throttle", "rudder"]
            .into_iter()
            .map(String::from)
            .chain(names.clone().cloned())
            .chain(names.clone().map(|name| format!("v{name}")))
            .chain(self.text.constants.iter().cloned())
            .chain(names.clone().map(|name| format!("{name}0")))
            .chain(names.map(|name| format!("v{name}0")))
            .zip(T..)
    }

    fn may_use(&self, slot: usize) -> bool {
        let (moves, constants) = (self.text.slots_of_motion(), self.text.slots_of_constants());
        match self.part {
            Part::Acceleration(_) => slot < constants.end,
            Part::Energy => moves.contains(&slot) || constants.contains(&slot),
            Part::When(_) => {
                let n = self.text.coordinates.len();
                slot == T
                    || (moves.start..moves.start + n).contains(&slot)
                    || constants.contains(&slot)
            }
            Part::Then(..) => slot == T || moves.contains(&slot) || constants.contains(&slot),
            Part::Place(..) => {
                moves.contains(&slot) && slot - moves.start < self.text.coordinates.len()
                    || constants.contains(&slot)
            }
            _ => slot == T || slot >= constants.start,
        }
    }
}

impl Scope for PartScope<'_> {
    fn input(&self, name: &str) -> Option<usize> {
        let mut rows = self.all().filter(|(known, slot)| known == name && self.may_use(*slot));
        rows.next().map(|(_, slot)| slot)
    }

    fn names(&self) -> Vec<String> {
        self.all().filter(|(_, slot)| self.may_use(*slot)).map(|(name, _)| name).collect()
    }

    fn why_not(&self, name: &str) -> Option<String> {
        let (_, slot) = self.all().find(|(known, _)| known == name)?;
        Some(match self.part {
            Part::Acceleration(_) => {
                format!("`{name}` is the start of a coordinate, which only `exact` knows")
            }
            Part::Energy => {
                format!("a conserved energy does not depend on `{name}`")
            }
            Part::Place(..) => {
                format!("a place depends on coordinates and constants alone, not on `{name}`")
            }
            Part::When(_) => {
                format!("a wall is where a coordinate is, and does not depend on `{name}`")
            }
            Part::Then(..) => format!("an impact does not depend on `{name}`"),
            _ if self.text.slots_of_motion().contains(&slot) => {
                format!("`exact` gives `{name}`, by `t`, constants and starts such as `{name}0`")
            }
            _ => format!("an exact solution does not depend on `{name}`"),
        })
    }
}

impl Compiler<'_> {
    /// Returns the tape of the accelerations.
    pub(super) fn motion(&self) -> Compiled {
        let rows = self.text.coordinates.iter().enumerate();
        self.tape(rows.map(|(i, row)| (Part::Acceleration(i), &*row.acceleration)).collect())
    }

    pub(super) fn energy(&self) -> Compiled {
        self.tape(self.text.energy.iter().map(|text| (Part::Energy, &**text)).collect())
    }

    /// Returns the tape of the exact solution. If one coordinate has an exact solution, all must have one.
    pub(super) fn exact(&self) -> Compiled {
        let rows = self.text.coordinates.iter().enumerate();
        let missing = rows.clone().filter(|(_, row)| row.exact.is_none());
        let missing: Vec<LawFault> = missing
            .map(|(i, row)| {
                let what = format!("`{}` has no `exact`, and another coordinate has", row.name);
                let remedy = "give it one, or remove the others";
                LawFault::new(Part::Coordinate(i), 0..row.name.len(), what, remedy)
            })
            .collect();
        let given = rows.filter_map(|(i, row)| Some((Part::Exact(i), row.exact.as_deref()?)));
        let tape = self.tape(given.collect());
        if missing.is_empty() {
            return tape;
        }
        Err(missing.into_iter().chain(tape.err().into_iter().flatten()).collect())
    }

    /// Returns the tape of the drawing positions, which are x and y of each coordinate that has a position.
    pub(super) fn places(&self) -> Compiled {
        let rows = self.text.coordinates.iter().enumerate();
        let placed = rows.filter_map(|(i, row)| Some((i, row.at.as_ref()?)));
        let parts =
            placed.flat_map(|(i, at)| [0, 1].map(|axis| (Part::Place(i, axis), &*at[axis])));
        self.tape(parts.collect())
    }

    /// Returns the tape of the place of an event.
    pub(super) fn when(&self, event: usize) -> Compiled {
        self.tape(vec![(Part::When(event), &*self.text.events[event].when)])
    }

    /// Returns the tape of the new velocities, event by event.
    pub(super) fn then(&self) -> Compiled {
        let rows = self.text.events.iter().enumerate();
        let then =
            rows.flat_map(|(i, event)| (0..).zip(&event.then).map(move |(n, it)| (i, n, it)));
        self.tape(then.map(|(i, n, (_, text))| (Part::Then(i, n), &**text)).collect())
    }

    fn tape(&self, parts: Vec<(Part, &str)>) -> Compiled {
        let mut faults = Vec::new();
        let mut expressions: Vec<Expression> = Vec::new();
        for (part, text) in &parts {
            match parse(text, &PartScope { text: self.text, part: *part }) {
                Ok(expression) => expressions.push(expression),
                Err(ExpressionFault { span, what, remedy }) => {
                    faults.push(LawFault { part: *part, span, what, remedy });
                }
            }
        }
        if !faults.is_empty() {
            return Err(faults);
        }
        let first_constant = self.text.slots_of_constants().start;
        let tape = Tape::new(self.text.inputs(), |input| input >= first_constant, &expressions);
        tape.map_err(|long| {
            let (part, text) = parts[long.expression];
            let (what, most) = if long.are_switches {
                ("corners and jumps", MAX_SWITCHES)
            } else {
                ("operations", MAX_OPERATIONS)
            };
            let what = format!("the law has more than {most} {what}");
            vec![LawFault::new(part, 0..text.len(), what, format!("keep at most {most}"))]
        })
    }
}

/// Returns the faults of the names of constants and coordinates.
pub(super) fn check_names(text: &LawText) -> Vec<LawFault> {
    let constants = text.constants.iter().enumerate().map(|(i, name)| (Part::Constant(i), name));
    let coordinates = text.coordinates.iter().map(|coordinate| &coordinate.name);
    let coordinates = coordinates.enumerate().map(|(i, name)| (Part::Coordinate(i), name));
    let mut taken: Vec<(String, String)> = Vec::new();
    let mut faults = Vec::new();
    for (part, name) in coordinates.chain(constants) {
        let mut refuse = |what: String, remedy: &str| {
            faults.push(LawFault::new(part, 0..name.len(), what, remedy));
        };
        let mut meanings = vec![(name.clone(), format!("`{name}`"))];
        if let Part::Coordinate(_) = part {
            meanings.push((format!("v{name}"), format!("the velocity of `{name}`")));
        }
        let shown = quoted(name);
        if !is_name(name) {
            let remedy = "write letters, digits and `_`, beginning with a letter";
            refuse(format!("`{}` cannot be a name", shown.escape_debug()), remedy);
        } else if name.chars().count() > MAX_NAME_CHARS {
            refuse(format!("the name `{shown}` has {} characters", name.len()), "keep at most 24");
        } else if is_reserved(name) {
            refuse(
                format!("`{name}` has a meaning of its own in expressions"),
                "give it another name",
            );
        } else if let Some((known, owner)) =
            taken.iter().find(|(known, _)| meanings.iter().any(|(meaning, _)| meaning == known))
        {
            refuse(
                format!("the name `{known}` is that of {owner} already"),
                "give it another name",
            );
        }
        taken.extend(meanings);
    }
    faults
}
