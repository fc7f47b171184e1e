//! The lines of a step, as a game has them, such as `v += (target - x) * 40 * dt; x += v * dt`.
//!
//! The expressions are those of laws. All lines become one tape, so that a step has the same bits everywhere and
//! allocates nothing. Both blocks of an `if` are evaluated, and one of them gives the values. A name that is read
//! before the lines assign it is carried from step to step, like `x` and `v`. Lines that call the acceleration or take
//! the settings of a body are a method, which may also have loops and functions; see [`method`].

use std::ops::Range;

use super::expression::Expression;
use super::fault::{ExpressionFault, fault};
use super::form::is_linear;
use super::tape::SwitchKind;
use super::tape::Tape;
pub use frames::{FrameInput, FrameOutput, LoopText};
pub use loop_tree::LoopName;
pub use map::StepMap;
use method::{Array, Function, Machine, Taken};
pub use method::{General, Input, Request, StepCall};
use paths::of_one_component;
use plain::plain;
use reader::{Reader, SPIN_NAMES};
pub use statements::Declares;
use statements::{statements, with_floor_signs, without_heads};
pub use tree::MethodInput;
pub use tree::{Operation, StepBody, bracketed};

mod frames;
mod loop_tree;
mod map;
mod method;
mod names;
mod paths;
mod plain;
mod reader;
mod spin;
mod statements;
mod tree;

/// The maximum number of bytes of a text, which is a few screens of lines.
pub const MAX_STEP_BYTES: usize = 1 << 14;

/// The maximum number of substeps in a tick of a lane.
pub const MAX_SUBSTEPS: u32 = 1_000;

/// Indices of the inputs of the tape; the names that the lines assign follow.
const X: usize = 0;
const V: usize = 1;
const H: usize = 2;
const TARGET: usize = 3;
const BUILT_IN: [&str; 4] = ["x", "v", "h", "target"];

/// A line, with its names as indices among the inputs.
#[derive(Debug)]
pub enum Line {
    /// `name = value`, or with an operator in `joins` as in `name += value`.
    Assign {
        /// The name.
        name: usize,
        /// The operator before the sign, or nothing.
        joins: &'static str,
        /// The expression at the right.
        value: Expression,
        /// How the line declares the name, if it does.
        declares: Option<Declares>,
    },
    /// Begins lines for the case that the expression is not 0.
    If(Expression),
    /// Begins lines for the other case.
    Else,
    /// Begins lines that are repeated while the expression is not 0.
    While(Expression),
    /// Ends the lines of a case, a loop or a function.
    End,
    /// Ends a function with its value.
    Return(Expression),
    /// `array[index] = value`.
    Store {
        /// The array.
        array: usize,
        /// The place in the array.
        index: Expression,
        /// The new number.
        value: Expression,
    },
    /// Ends the step. If it fails, `x` and `v` become NaN.
    Stop {
        /// Whether it fails.
        fails: bool,
    },
    /// A remark on a line of its own.
    Remark(String),
    /// An empty line.
    Blank,
}

/// A number carried from one step to the next.
#[derive(Clone, Debug, PartialEq)]
pub struct Carried {
    /// The name of the number, which is `x`, `v`, or a name of the text.
    pub name: String,
    /// The value of the number before the first step.
    pub start: f64,
    input: usize,
}

impl Carried {
    /// Returns the index of the number among the names of the lines.
    pub fn input(&self) -> usize {
        self.input
    }
}

/// The lines of a step, parsed.
#[derive(Debug)]
pub struct StepText {
    source: String,
    names: Vec<String>,
    lines: Vec<Line>,
    carried: Vec<Carried>,
    /// The operations of a step. The outputs are the carried numbers after the step, in the order of `carried`.
    tape: Tape,
    /// The byte range of the first call of the acceleration, or of the first setting that only a method has. `None` in
    /// a rule.
    method_at: Option<Range<usize>>,
    /// The inputs that the text takes besides the acceleration and the target.
    inputs: Vec<Taken>,
    functions: Vec<Function>,
    arrays: Vec<Array>,
    /// The remarks above the inputs.
    notes: Vec<String>,
    /// Whether a step depends on the velocity before it.
    reads_velocity: bool,
    machine: Machine,
    left_out: Option<[char; 2]>,
}

/// The carried numbers of one body, and the scratch of its steps.
#[derive(Clone, Debug)]
pub struct StepRegisters {
    /// The slots, coordinate after coordinate.
    slots: Vec<f64>,
    next: Vec<f64>,
    /// The answer to a request, with one number for each coordinate.
    answer: Vec<f64>,
    /// For each level of blocks, whether each coordinate runs it.
    masks: Vec<bool>,
}

impl StepText {
    /// Parses a text.
    ///
    /// # Errors
    /// The first fault, with its byte range in the text.
    pub fn read(text: &str) -> Result<Self, ExpressionFault> {
        Self::check_size(text)?;
        match Self::read_lines(text, None) {
            Err(other) if text.contains(SPIN_NAMES[0]) && Self::read_spin(text).is_ok() => fault(
                other.span,
                "these lines step a free spin in space",
                "write a step of `x` and `v`: a free spin takes the methods of the list",
            ),
            read => read,
        }
    }

    fn check_size(text: &str) -> Result<(), ExpressionFault> {
        if text.len() > MAX_STEP_BYTES {
            let end = text.floor_char_boundary(MAX_STEP_BYTES);
            let what = format!("the text has {} bytes", text.len());
            return fault(end..text.len(), what, format!("keep at most {MAX_STEP_BYTES}"));
        }
        Ok(())
    }

    /// Reads the lines of a printer, of which a rule may have loops.
    pub fn read_generated(text: &str) -> Result<Self, ExpressionFault> {
        Self::read_lines(text, Some(0..0))
    }

    fn read_lines(text: &str, method_at: Option<Range<usize>>) -> Result<Self, ExpressionFault> {
        let (mut plain, components) = plain(&with_floor_signs(text));
        let all = statements(&plain, text)?;
        let all = without_heads(&mut plain, all)?;
        let (statements, left_out) = of_one_component(&mut plain, all, &components)?;
        let read = Reader::read(&plain, method_at, &statements)?;
        Ok(Self { source: text.to_owned(), left_out, ..read }.timed())
    }

    /// Reads the text of a rule, which calls no acceleration. If the text does call the acceleration, the fault has
    /// this remedy.
    pub fn read_rule(text: &str, remedy: &str) -> Result<Self, ExpressionFault> {
        let read = Self::read(text)?;
        match read.method_at.clone() {
            Some(at) => fault(at, "a rule is the whole motion, and calls no acceleration", remedy),
            None => Ok(read),
        }
    }

    /// Returns the original text.
    pub fn source(&self) -> &str {
        &self.source
    }

    /// Returns the component of the vectors that the lines move, and the first other one, whose lines are left out.
    /// `None` if the lines name one component at most.
    pub fn left_out(&self) -> Option<[char; 2]> {
        self.left_out
    }

    /// Returns the carried numbers, which are `x`, `v`, and then those of the text.
    pub fn carried(&self) -> &[Carried] {
        &self.carried
    }

    /// Whether the motion depends on the target.
    pub fn takes_target(&self) -> bool {
        self.tape.reads(TARGET)
    }

    /// Whether the motion depends on the length of a step.
    pub fn takes_step(&self) -> bool {
        self.tape.reads(H)
    }

    /// Whether a step is an affine function of the carried numbers and the target.
    pub fn is_linear(&self) -> bool {
        // No input is a time.
        is_linear(&self.tape, self.names.len(), usize::MAX, |input| input != H)
    }

    /// Returns, for each carried number, the indices of the carried numbers on which its next value depends.
    pub fn dependencies(&self) -> Vec<Vec<usize>> {
        let sets = self.inputs_of_slots();
        let of = |slot: &u16| {
            let set = sets[*slot as usize];
            let inputs = self.carried.iter().map(|carried| carried.input).enumerate();
            inputs.filter(|(_, input)| set >> input & 1 == 1).map(|(index, _)| index).collect()
        };
        self.tape.outputs.iter().map(of).collect()
    }

    /// Returns the set of inputs on which each slot of the tape depends, as bits.
    fn inputs_of_slots(&self) -> Vec<u64> {
        let mut sets = vec![0_u64; self.tape.slots];
        (0..self.names.len()).for_each(|input| sets[input] = 1 << input);
        for (_, operands, to, _) in self.tape.operations() {
            sets[to as usize] = operands.iter().fold(0, |set, slot| set | sets[*slot as usize]);
        }
        sets
    }

    /// Returns the indices of these carried numbers and of all carried numbers on which they depend.
    pub fn with_causes(&self, mut state: Vec<usize>) -> Vec<usize> {
        let (reads, mut next) = (self.dependencies(), 0);
        while let Some(&index) = state.get(next) {
            for read in &reads[index] {
                if !state.contains(read) {
                    state.push(*read);
                }
            }
            next += 1;
        }
        state
    }

    /// Whether a step leaves this carried number unchanged.
    pub fn leaves_unchanged(&self, index: usize) -> bool {
        let output = self.tape.outputs.get(index);
        output.is_some_and(|output| usize::from(*output) == self.carried[index].input)
    }

    /// Returns the registers of a body before its first step, at 0 and at rest.
    pub fn registers(&self) -> StepRegisters {
        let mut registers = StepRegisters {
            slots: vec![0.0; self.tape.slots],
            next: vec![0.0; self.carried.len()],
            answer: Vec::new(),
            masks: Vec::new(),
        };
        for carried in &self.carried {
            registers.slots[carried.input] = carried.start;
        }
        registers
    }

    /// Steps a body by `h` seconds. Never allocates.
    #[inline]
    pub fn step(&self, registers: &mut StepRegisters, h: f64, target: f64) {
        let StepRegisters { slots, next, .. } = registers;
        if slots[H].to_bits() != h.to_bits() || h == 0.0 {
            slots[H] = h;
            self.tape.prepare::<1>(slots.as_chunks_mut().0);
        }
        slots[TARGET] = target;
        self.tape.evaluate(slots);
        for (next, output) in next.iter_mut().zip(&self.tape.outputs) {
            *next = slots[*output as usize];
        }
        for (next, carried) in next.iter().zip(&self.carried) {
            slots[carried.input] = *next;
        }
    }

    /// Returns the value of a carried number of a body.
    #[inline]
    pub fn value(&self, registers: &StepRegisters, index: usize) -> f64 {
        registers.slots[self.carried[index].input]
    }

    /// Sets a carried number of a body.
    #[inline]
    pub fn set(&self, registers: &mut StepRegisters, index: usize, value: f64) {
        registers.slots[self.carried[index].input] = value;
    }
}

#[cfg(test)]
mod tests {
    use std::ops::Range;

    use super::*;

    fn read(text: &str) -> StepText {
        StepText::read(text).unwrap_or_else(|fault| panic!("{text}: {fault:?}"))
    }

    /// Returns x and v after some steps of 1/60 s. They start at 0.25 and 0.5, and the target is at 1.
    fn run(text: &str, steps: u32) -> [f64; 2] {
        let text = read(text);
        let mut registers = text.registers();
        text.set(&mut registers, 0, 0.25);
        text.set(&mut registers, 1, 0.5);
        (0..steps).for_each(|_| text.step(&mut registers, 1.0 / 60.0, 1.0));
        [0, 1].map(|index| text.value(&registers, index))
    }

    fn fault_of(text: &str) -> (Range<usize>, String) {
        let fault = StepText::read(text).expect_err(text);
        (fault.span, fault.what)
    }

    #[test]
    fn lines_are_stepped_in_the_order_written_to_the_bit() {
        let (mut x, mut v, h) = (0.25_f64, 0.5_f64, 1.0 / 60.0);
        for _ in 0..50 {
            v = (v + (1.0 - x) * 0.2) * 0.85;
            x += v * h;
        }
        let text = "v = (v + (target - x) * 0.2) * 0.85; x += v * dt";
        assert_eq!(run(text, 50), [x, v]);
        let other = "x += v * dt\nv = (v + (target - x) * 0.2f) * 0.85F // the other order";
        assert_ne!(run(other, 50), [x, v]);
    }

    #[test]
    fn a_block_acts_only_if_its_condition_holds() {
        let text = "x += v\nif x > 1 {\n  let over = x - 1\n  x = 1 - over; v = -v\n} else if x < 0.5 { v *= 2 } else { v *= 3 }";
        assert_eq!(run(text, 1), [0.75, 1.5]);
        assert_eq!(run(text, 2), [2.0 - 2.25, -1.5]);
        assert_eq!(run("if x < 0 { x = 1/(v*0) } else { x = 2 }", 1), [2.0, 0.5]);
    }

    #[test]
    fn a_name_read_before_its_assignment_is_carried() {
        let text = read(
            "memory prev = 2*3; temp = x; x += (x - prev) * 0.5; prev = temp; count = count + 1",
        );
        let names: Vec<&str> = text.carried().iter().map(|carried| &*carried.name).collect();
        assert_eq!(names, ["x", "v", "prev", "count"]);
        assert_eq!(text.carried()[2].start, 6.0);
        assert_eq!(text.dependencies()[0], [0, 2]);
        assert!(text.leaves_unchanged(1) && !text.leaves_unchanged(0));
        let mut registers = text.registers();
        (0..2).for_each(|_| text.step(&mut registers, 1.0, 0.0));
        assert_eq!([0, 2, 3].map(|index| text.value(&registers, index)), [-4.5, -3.0, 2.0]);
    }

    #[test]
    fn linearity_is_recognised_from_the_text() {
        for (text, is_linear) in [
            ("v = (v + (target - x) * 0.2) * 0.85; x += v", true),
            ("let k = 1 - exp(-20 * dt); x = lerp(x, target, min(k, 1))", true),
            ("x += 3", true),
            ("v -= v * abs(v) * dt", false),
            ("v = clamp(v, -1, 1)", false),
            ("if x < 0 { x = 0 }", false),
        ] {
            assert_eq!(read(text).is_linear(), is_linear, "{text}");
        }
        let map = read("v = (v + (target - x) * 0.25) * 0.5; x += v * dt").map(0.5, &[0.0; 2], 0.0);
        assert_eq!(map.columns, [[0.9375, -0.125], [0.25, 0.5], [0.0625, 0.125]]);
    }

    #[test]
    fn a_declared_place_or_velocity_is_assigned_unless_it_is_a_constant() {
        for (declared, assigned) in [
            ("let x = x + (target - x) * 0.1", "x = x + (target - x) * 0.1"),
            ("float v = v * 0.9; x += v * dt", "v = v * 0.9; x += v * dt"),
            ("auto x = abs(target)", "x = abs(target)"),
            ("local velocity = velocity * 2; x += velocity", "v = v * 2; x += v"),
            (
                "let d = target - x; var v = (v + d * 0.2) * 0.85; x += v",
                "d = target - x; v = (v + d * 0.2) * 0.85; x += v",
            ),
            ("let v = 3; let v = v * 0.9; x += v", "v *= 0.9; x += v"),
        ] {
            assert_eq!(run(declared, 5), run(assigned, 5), "{declared}");
        }
        let start = read("let v = 3; let v = v * 0.9; x += v").carried()[1].start;
        assert_eq!(start, 3.0);
        let method = read("let v = v + h * a(x, v); x += h * v");
        assert!(method.acceleration_at().is_some() && !method.leaves_unchanged(1));
    }

    #[test]
    fn a_fault_has_its_byte_range() {
        for (text, at, what) in [
            ("x += k", 5..6, "unknown name `k`"),
            ("v = 1\nx += lrep(x, 1, 2)", 11..15, "unknown function `lrep`"),
            ("x += (1", 6..7, "the text ends where `)` is missing"),
            ("let k = 2", 0..9, "no line assigns `x` or `v`"),
            ("target = 1", 0..6, "`target` is the goal of `x`, and no line may change it"),
            ("let pi = 1; x = pi", 4..6, "`pi` has a meaning of its own in expressions"),
            ("x = k; let k = 1", 4..5, "unknown name `k`"),
            ("let k += 1; x = k", 4..5, "`k` has no value yet"),
            ("if x > 0 { x = 1", 15..16, "a block is not closed"),
            ("x = 1 }", 6..7, "`}` closes nothing"),
            ("if x > 0 { let y = 1 }; x = y", 28..29, "unknown name `y`"),
            ("if x { x = 1 }", 3..4, "`x` is a number, not a condition"),
            ("memory k = x; x = k", 10..12, "a memory starts as a finite number"),
            ("memory k = x + 1; x = k", 10..16, "a memory starts as a finite number"),
            ("x +=", 4..4, "the expression is empty"),
            ("x = 1\n/* v", 6..8, "the remark is not closed"),
            ("x = damped(1)", 4..10, "unknown function `damped`"),
            ("while x < 1 { x += v }", 0..5, "`while` cannot stand in a rule"),
            ("fail; x = 1", 0..4, "`fail` cannot stand in a rule"),
            ("qw = qw; let k = y", 17..18, "unknown name `y`"),
            ("use unit\nqw *= unit(qw, qx, qy, qz)", 4..8, "these lines step a free spin in space"),
            ("takes mass: of it\nx = 1", 6..10, "no body gives a step `mass`"),
            ("use glue; x = a(x, v)", 4..8, "nothing shared is called `glue`"),
            ("return x; x = a(x, v)", 0..6, "`return` cannot stand in a step"),
            ("fn f(x) { let y = x }; x = a(f(x), v)", 3..4, "the function can end without a value"),
            (
                "fn f(x) { return x }; x = a(f(x, v), v)",
                28..35,
                "the function takes 1 arguments, not 2",
            ),
            (
                "fn f(a(x, v), x) { return a(x, x) }; x = f(x, v)",
                43..44,
                "the function takes the acceleration here",
            ),
            (
                "if x < 0 { fn f(x) { return x } }; x = a(x, v)",
                14..15,
                "the function stands in a block, or is not closed",
            ),
            ("fn f(x) { fail; return x }; x = a(x, v)", 10..14, "a function cannot end the step"),
            ("takes rate: k\nrate = 2; x = 1", 14..18, "a step cannot change its setting"),
        ] {
            assert_eq!(fault_of(text), (at, what.to_owned()), "{text}");
        }
    }

    #[test]
    fn no_text_panics() {
        let mut seed = 1_u64;
        let mut next = || {
            seed = seed
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (seed >> 33) as usize
        };
        let pieces = [
            "x",
            "v",
            "dt",
            "target",
            "k",
            " ",
            "=",
            "+=",
            "-",
            "*",
            "/",
            "^",
            "(",
            ")",
            "{",
            "}",
            ";",
            "\n",
            "if ",
            "else ",
            "while ",
            "fn f(a(x, v), x) {",
            "return ",
            "f(a, x)",
            "a(x, v)",
            "use solve\n",
            "takes rate: k\n",
            "fail;",
            "count ",
            "is_nan(",
            "}",
            "let ",
            "memory ",
            "0.5f",
            "1e999",
            "9",
            "lerp(",
            "min(",
            ",",
            "<",
            "and ",
            "é",
            "\u{feff}",
            "//",
            "/*",
            "#",
            "\"",
            "Mathf.",
            "[",
            "table(x, [[0, 1], [1, 2]])",
            "x = ",
            "x += v;",
            "void f(",
            "function (x)",
            "class ",
            "=> {",
            "def f():\n ",
            "|0",
            " as f32",
            "(int)",
            "@x(",
        ];
        for _ in 0..20_000 {
            let text: String = (0..next() % 24).map(|_| pieces[next() % pieces.len()]).collect();
            match StepText::read(&text) {
                Ok(text) => {
                    let mut registers = text.registers();
                    (0..3).for_each(|_| text.step(&mut registers, 0.1, 1.0));
                    let mut registers = text.method_registers(2);
                    let moved = [&mut [0.5, 1.0][..], &mut [0.0; 2]];
                    text.step_method(&mut registers, 0.1, moved, |_, _, [x, _], a| {
                        a.copy_from_slice(x)
                    });
                    let _ =
                        (text.map(0.1, &vec![0.5; text.carried().len()], 1.0), text.unwritable());
                }
                Err(fault) => assert!(text.get(fault.span).is_some(), "{text}"),
            }
        }
        for text in [
            "x = ".to_owned() + &"(".repeat(3000),
            "if x > 0 {".repeat(1000),
            "x = x^16; ".repeat(600),
            "x += 1;".repeat(2000),
            "x = -".to_owned() + &"9".repeat(500),
            "if x > 0 { x = 1 } else ".repeat(300) + "{ x = 2 }",
            "x = 0".to_owned() + &" + x".repeat(1000),
            "é".repeat(9000),
            (0..100).map(|i| format!("y{i} = {i};")).collect(),
        ] {
            if let Err(fault) = StepText::read(&text) {
                assert!(text.get(fault.span.clone()).is_some(), "{fault:?}");
            }
        }
    }
}
