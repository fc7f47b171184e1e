//! The lines of a game loop, which run once a frame and decide on its ticks.
//!
//! Numbers are `f64`, and times are in milliseconds. A line `tick n of s` makes `n` ticks of `s` each, and `tick n`
//! makes ticks of `H`. A line `show a` shows the part `a` of the way from the last tick but one to the last.
//!
//! With a line `takes whole dt` times are whole numbers of a unit, and so are `H`, `refresh` and `second`. The unit is
//! as fine as a frame of tens of seconds allows. Sums, differences and whole multiples are then exact below
//! 2⁵³. So is `floor(a / b)`: a quotient that is not whole is at least 1 / b away from a whole number, which is more
//! than the division rounds. The number `owed` is then the time since the last tick.

use std::ops::Range;

use super::plain::plain;
use super::reader::{COST, FIRST, LENGTH, NOW, REFRESH, Reader, SECOND, SHOWN};
use super::statements::{Statement, statements};
use super::{Declares, Line, StepRegisters, StepText, TARGET};
use crate::fault::ExpressionFault;

/// A frame as a loop sees it. Times are in milliseconds, or whole numbers of a unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameInput {
    /// Duration of the frame, `dt`.
    pub dt: f64,
    /// Length of a tick, `H`.
    pub tick: f64,
    /// Time between two refreshes of the display, `refresh`.
    pub refresh: f64,
    /// A second, `second`.
    pub second: f64,
    /// Cost of the last tick, `cost`.
    pub cost: f64,
    /// Time of the clock, `now`.
    pub now: f64,
    /// Whether the frame starts the clock, `first`.
    pub is_first: bool,
}

/// The decision of a loop on a frame. Times are in the unit of the input.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FrameOutput {
    /// Number of ticks.
    pub ticks: f64,
    /// Time of all ticks together.
    pub stepped: f64,
    /// Length of the last tick.
    pub tick: f64,
    /// Position of the picture between the last two ticks; 1 at the last.
    pub shown: f64,
    /// The numbers `owed`, `dropped` and `returned` of the lines, if they have them.
    pub owed: Option<f64>,
    /// Real time that is given up in this frame.
    pub dropped: Option<f64>,
    /// Number of ticks that the engine reports, if it makes another number.
    pub returned: Option<f64>,
}

/// The lines of a game loop.
#[derive(Debug)]
pub struct LoopText {
    text: StepText,
    shows: bool,
    /// Slots of `owed`, `dropped` and `returned`.
    named: [Option<usize>; 3],
}

impl LoopText {
    /// Parses the lines.
    ///
    /// # Errors
    /// The first fault, with its byte range in the text.
    pub fn read(text: &str) -> Result<Self, ExpressionFault> {
        StepText::check_size(text)?;
        let (plain, _) = plain(text);
        let read = Reader::read_loop(&plain, &statements(&plain, text)?)?;
        let text = StepText { source: text.to_owned(), ..read };
        let shows = text.lines.iter().any(|line| matches!(line, Line::Assign { name: SHOWN, .. }));
        let slot = |name: &str| text.names.iter().position(|known| known == name);
        let named = ["owed", "dropped", "returned"].map(slot);
        Ok(Self { text, shows, named })
    }

    /// Returns the text with a constant set to a number. The error has the names of all constants.
    ///
    /// # Errors
    /// If no line declares the constant.
    pub fn set(text: &str, name: &str, value: f64) -> Result<String, Vec<String>> {
        let constants = Self::constants(text);
        let Some((_, at, _)) = constants.iter().find(|(known, ..)| known == name) else {
            return Err(constants.into_iter().map(|(name, ..)| name).collect());
        };
        Ok(format!("{} {value}{}", &text[..at.start], &text[at.end..]))
    }

    /// Returns the words of a remark `# key: words` of a text.
    pub fn claim<'t>(text: &'t str, key: &str) -> &'t str {
        let mut remarks = text.lines().filter_map(|line| line.strip_prefix("# "));
        remarks.find_map(|remark| remark.strip_prefix(key)?.strip_prefix(": ")).unwrap_or_default()
    }

    /// Returns the constants of a text, each with the byte range of its value and that value as text.
    pub fn constants(text: &str) -> Vec<(String, Range<usize>, String)> {
        let (plain, _) = plain(text);
        let constant = |statement: Statement| match statement {
            Statement::Assign { name, declares: Some(Declares::Constant), value, .. } => {
                Some((plain[name].to_owned(), value.clone(), plain[value].trim().to_owned()))
            }
            _ => None,
        };
        statements(&plain, text).unwrap_or_default().into_iter().filter_map(constant).collect()
    }

    /// Returns the original text.
    pub fn source(&self) -> &str {
        self.text.source()
    }

    /// Returns the lines as a printer reads them.
    pub fn text(&self) -> &StepText {
        &self.text
    }

    /// Whether the picture lies between two ticks.
    pub fn shows(&self) -> bool {
        self.shows
    }

    /// Whether times are whole numbers of a unit, in place of milliseconds.
    pub fn is_whole(&self) -> bool {
        !self.text.inputs.is_empty()
    }

    /// Whether a line has the time between two refreshes of the display.
    pub fn reads_refresh(&self) -> bool {
        self.text.lines.iter().any(|line| line.mentions(REFRESH))
    }

    /// Whether every tick has the length `H` or a constant one.
    pub fn has_fixed_tick(&self) -> bool {
        let lengths = self.text.lines.iter().filter_map(|line| match line {
            Line::Assign { name: LENGTH, value, .. } => Some(value),
            _ => None,
        });
        let is_constant = |name: usize| {
            let mut assigned = self.text.lines.iter().filter_map(|line| match line {
                Line::Assign { name: it, declares, .. } if *it == name => Some(*declares),
                _ => None,
            });
            name == TARGET || assigned.all(|it| it == Some(Declares::Constant)) && name > SHOWN
        };
        lengths.into_iter().all(|length| length.is_constant(is_constant))
    }

    /// Returns the memory before the first frame.
    pub fn registers(&self) -> StepRegisters {
        self.text.method_registers(1)
    }

    /// Sets a constant whose value is a number, if the lines have it.
    pub fn set_constant(&self, registers: &mut StepRegisters, name: &str, value: f64) {
        self.text.set_number(registers, name, value);
    }

    /// Runs the lines on a frame. Never allocates.
    pub fn frame(&self, registers: &mut StepRegisters, input: FrameInput) -> FrameOutput {
        let FrameInput { dt, tick, refresh, second, cost, now, is_first } = input;
        for (slot, value) in [
            (TARGET, tick),
            (REFRESH, refresh),
            (SECOND, second),
            (COST, cost),
            (NOW, now),
            (FIRST, f64::from(u8::from(is_first))),
            (SHOWN, 1.0),
        ] {
            registers.slots[slot] = value;
        }
        let (mut ticks, mut stepped) = ([0.0], [0.0]);
        self.text.step_method(registers, dt, [&mut ticks, &mut stepped], |_, _, _, _| {});
        let [owed, dropped, returned] =
            self.named.map(|slot| slot.map(|slot| registers.slots[slot]));
        FrameOutput {
            ticks: ticks[0],
            stepped: stepped[0],
            tick: registers.slots[LENGTH],
            shown: registers.slots[SHOWN],
            owed,
            dropped,
            returned,
        }
    }
}
