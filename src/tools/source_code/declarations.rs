//! Finds where and how a printed step declares its numbers.

use crate::sim::law::{Declares, Line, StepBody};

/// How a line declares a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Declaration {
    Constant,
    /// A number that no later line changes.
    Number,
    Variable,
    Counter,
}

/// The declarations of a body.
pub(super) struct Declarations {
    /// For each line, the declaration that it is.
    pub(super) lines: Vec<Option<Declaration>>,
    /// The numbers that outlive the block in which they first get a value, and stand above all lines.
    pub(super) above: Vec<(usize, Declaration)>,
}

/// Returns the declarations of a body. A number is declared where it first gets a value.
pub(super) fn declarations(body: StepBody<'_>) -> Declarations {
    let all = body.lines();
    let ends = block_ends(all);
    // For each name, the line before which it is known.
    let mut known: Vec<usize> = (0..body.names().len())
        .map(|name| if body.is_given(name) { all.len() } else { 0 })
        .collect();
    let mut constants = vec![false; known.len()];
    let mut found = Declarations { lines: vec![None; all.len()], above: Vec::new() };
    let left_out = body.left_out();
    for (at, line) in all.iter().enumerate() {
        let Line::Assign { name, value, declares, .. } = line else { continue };
        let (name, is_whole) = (*name, body.is_whole(*name));
        if at < known[name] || left_out[at] || body.ticks(at).is_some() {
            continue;
        }
        if !is_local(all, &ends, name, at) {
            known[name] = all.len();
            let kind = if is_whole { Declaration::Counter } else { Declaration::Variable };
            found.above.push((name, kind));
            continue;
        }
        known[name] = ends[at];
        let assigns = |line: &Line| matches!(line, Line::Assign { name: it, .. } if *it == name);
        let changes = all[at + 1..ends[at]].iter().any(assigns);
        let is_constant = *declares == Some(Declares::Constant)
            && !changes
            && value.is_constant(|name| constants[name]);
        constants[name] = is_constant;
        found.lines[at] = Some(match () {
            () if is_constant => Declaration::Constant,
            () if is_whole => Declaration::Counter,
            () if changes => Declaration::Variable,
            () => Declaration::Number,
        });
    }
    found
}

/// Returns for each line the index of the line that ends its block.
fn block_ends(all: &[Line]) -> Vec<usize> {
    let mut ends = vec![all.len(); all.len()];
    let mut open = vec![all.len()];
    for (at, line) in all.iter().enumerate().rev() {
        if matches!(line, Line::If(_) | Line::While(_) | Line::Else) {
            open.pop();
        }
        ends[at] = open.last().copied().unwrap_or(all.len());
        if matches!(line, Line::End | Line::Else) {
            open.push(at);
        }
    }
    ends
}

/// Whether a name that gets its value at a line is not read after the block of that line, but for blocks that give it
/// a value of their own.
fn is_local(all: &[Line], ends: &[usize], name: usize, at: usize) -> bool {
    let end = ends[at];
    let next = all[end..].iter().position(|line| line.mentions(name)).map(|after| end + after);
    next.is_none_or(|next| match &all[next] {
        Line::Assign { name: assigned, joins: "", value, declares: Some(_) } => {
            *assigned == name && !value.reads(name) && is_local(all, ends, name, next)
        }
        _ => false,
    })
}
