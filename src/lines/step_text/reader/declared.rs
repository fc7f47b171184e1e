//! The names of the lines, and those that they declare.

use std::ops::Range;

use super::{FIELD, FRAME_NAMES, MAX_STEP_NAMES, Reader};
use crate::fault::{Parsed, fault, quoted};
use crate::op::OPERATOR_WORDS;
use crate::step_text::names::STEP_NAMES;
use crate::step_text::{BUILT_IN, H, TARGET};

/// The spelling of a number that the lines call as printed code calls the length of a step.
const OWN_LENGTH: &str = "own_h";

impl Reader<'_> {
    pub(super) fn index(&self, name: &str) -> Option<usize> {
        if self.is_function || self.is_loop {
            return self.names.iter().position(|known| known == name);
        }
        if STEP_NAMES.contains(&name) && !self.other_lengths.contains(&name) {
            return Some(H);
        }
        let meant = self.meant.iter().find(|(_, word)| word == name);
        let name = self.spelled(name);
        let known = || self.names.iter().position(|known| known == name);
        meant.map(|(index, _)| *index).or_else(known)
    }

    /// Returns the name that a statement declares. If the lines read a memory as `memory.name`, the name includes that
    /// prefix.
    pub(super) fn declared(&self, span: Range<usize>, is_memory: bool) -> String {
        let name = &self.text[span];
        let field = format!("{FIELD}{name}");
        if is_memory && self.text.contains(&field) { field } else { name.to_owned() }
    }

    pub(super) fn declare(
        &mut self,
        span: Range<usize>,
        is_carried: bool,
        is_memory: bool,
    ) -> Parsed<()> {
        let name = &*self.declared(span.clone(), is_memory);
        if OPERATOR_WORDS.contains(&name) || name == "pi" {
            let what = format!("`{}` has a meaning of its own in expressions", quoted(name));
            return fault(span, what, "give it another name");
        }
        match self.index(name) {
            Some(index) if self.is_loop && index < FRAME_NAMES.len() => {
                let what = format!("`{name}` is told to the loop, and no line may change it");
                return fault(span, what, "give the number another name");
            }
            Some(TARGET) if !self.is_function => {
                let remedy = "give the number another name, such as `goal`";
                return fault(
                    span,
                    "`target` is the goal of `x`, and no line may change it",
                    remedy,
                );
            }
            Some(index) => self.is_carried[index] |= is_carried,
            None if self.names.len() == MAX_STEP_NAMES => {
                let what = format!("the lines have more than {} names", MAX_STEP_NAMES - 4);
                return fault(span, what, "use fewer");
            }
            None => self.add_name(self.spelled(name), is_carried),
        }
        Ok(())
    }

    pub(super) fn add_name(&mut self, name: &str, is_carried: bool) {
        self.names.push(name.to_owned());
        self.is_carried.push(is_carried);
        self.starts.push(0.0);
        self.values.push(None);
    }

    /// Returns a name as printed code spells it.
    fn spelled<'n>(&self, name: &'n str) -> &'n str {
        if name == BUILT_IN[H] && self.other_lengths.contains(&name) { OWN_LENGTH } else { name }
    }
}
