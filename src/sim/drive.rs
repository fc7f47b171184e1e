//! What carries a body forward, and what becomes of it when the body jumps.
//!
//! # When something jumps
//!
//! Whatever is carried from step to step holds only while the motion goes on smoothly. Each jump is noticed
//! in one place, by the one who cannot miss it:
//!
//! - The *state or the forces* jump when the body is placed, given an input or edited. A stepper owns its body
//!   and state, so that nobody else can change them, and it makes every change within [`Drive::jump`]. A method
//!   is [reset](Integrator::reset) there. The truth sees the body before and after: a closed form flows from
//!   the new state with the error of the old one, which only the old body can tell.
//! - The *length of the step* is an argument of every step. A method that carries something compares it with
//!   the last one's, so that nobody has to announce it.
//! - A state that is *not in a stepper* may be changed by anybody. There
//!   [`integrator`](super::integrators::integrator) compares the state with the one it left, and resets the
//!   method. A stepper does without the comparison, which would cost it at every tick.

use super::bodies::Body;
use super::integrators::{Integrator, StepFailure};
use super::system::{Counted, State};

/// What carries a body of one type forward.
pub(super) trait Drive<B: Body>: Clone + Send + 'static {
    /// Advances `state` from `t` to `t + h` (s), a method in `substeps` equal steps.
    fn advance(
        &mut self,
        body: &Counted<B>,
        t: f64,
        h: f64,
        substeps: u32,
        state: &mut State<B::Vector>,
    ) -> Result<(), StepFailure>;

    /// Lets `change` change the body or its state at time `t` (s) and begins again from what it makes of them.
    /// Where it returns `false` it has changed nothing, and all goes on as before. Returns the same.
    fn jump(
        &mut self,
        jump: Jump,
        t: f64,
        body: &mut B,
        state: &mut State<B::Vector>,
        change: impl FnOnce(&mut B, &mut State<B::Vector>) -> bool,
    ) -> bool;

    /// As [`Stepper::truth_error`](super::Stepper::truth_error), in the present `state`.
    fn truth_error(&self, _body: &Counted<B>, _state: &State<B::Vector>) -> Option<[f64; 2]> {
        None
    }

    /// The memory that it takes beyond its own size and that of its coordinate vectors, in bytes.
    fn heap_bytes(&self) -> usize {
        0
    }
}

/// What the state after a jump has to do with the state before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Jump {
    /// Nothing: the body is put into a state that is known exactly.
    Placed,
    /// An input or an edit acts on the present state: it is off afterwards by as much as before.
    Pushed,
}

/// A method from the table.
#[derive(Clone)]
pub(super) struct ByMethod<I>(pub(super) I);

impl<B: Body, I: Integrator<Counted<B>> + Clone + 'static> Drive<B> for ByMethod<I> {
    #[inline]
    fn advance(
        &mut self,
        body: &Counted<B>,
        t: f64,
        h: f64,
        substeps: u32,
        state: &mut State<B::Vector>,
    ) -> Result<(), StepFailure> {
        self.0.steps(body, t, h, substeps, state)
    }

    fn jump(
        &mut self,
        _jump: Jump,
        _t: f64,
        body: &mut B,
        state: &mut State<B::Vector>,
        change: impl FnOnce(&mut B, &mut State<B::Vector>) -> bool,
    ) -> bool {
        let is_changed = change(body, state);
        if is_changed {
            self.0.reset();
        }
        is_changed
    }

    fn heap_bytes(&self) -> usize {
        self.0.heap_bytes()
    }
}
