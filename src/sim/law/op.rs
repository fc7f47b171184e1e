//! The operations of expressions and tapes.

/// One operation. Logic is 0 for false and 1 for true.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) enum Op {
    Number,
    Input,
    Negate,
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    Sqrt,
    Exp,
    Ln,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Tanh,
    Atan2,
    Hypot,
    Abs,
    Sign,
    Floor,
    Step,
    Min,
    Max,
    Less,
    LessEqual,
    Equal,
    NotEqual,
    Table,
    And,
    Or,
    Not,
    If,
}

impl Op {
    /// Whether the operation is smooth only piece by piece.
    pub(super) fn is_switch(self) -> bool {
        use Op::{Abs, Equal, Floor, Less, LessEqual, Max, Min, NotEqual, Sign, Step, Table};
        matches!(
            self,
            Abs | Sign | Floor | Step | Min | Max | Less | LessEqual | Equal | NotEqual | Table
        )
    }

    /// Whether the value is true or false, not a number.
    pub(super) fn is_truth(self) -> bool {
        use Op::{And, Equal, Less, LessEqual, Not, NotEqual, Or};
        matches!(self, Less | LessEqual | Equal | NotEqual | And | Or | Not)
    }
}

/// A function that an expression can call.
pub(super) struct Function {
    pub(super) name: &'static str,
    /// What it takes, for messages.
    pub(super) usage: &'static str,
    pub(super) arguments: usize,
    pub(super) body: Body,
}

/// What a call becomes.
#[derive(Clone, Copy)]
pub(super) enum Body {
    Op(Op),
    /// `min(max(x, low), high)`.
    Clamp,
    /// `if(condition, a, b)`.
    If,
    /// `table(x, [[x0, y0], …])`.
    Table,
}

/// Every function.
pub(super) const FUNCTIONS: [Function; 21] = [
    function("sqrt", "sqrt(x)", 1, Body::Op(Op::Sqrt)),
    function("abs", "abs(x)", 1, Body::Op(Op::Abs)),
    function("sign", "sign(x)", 1, Body::Op(Op::Sign)),
    function("min", "min(a, b)", 2, Body::Op(Op::Min)),
    function("max", "max(a, b)", 2, Body::Op(Op::Max)),
    function("clamp", "clamp(x, low, high)", 3, Body::Clamp),
    function("floor", "floor(x)", 1, Body::Op(Op::Floor)),
    function("exp", "exp(x)", 1, Body::Op(Op::Exp)),
    function("ln", "ln(x)", 1, Body::Op(Op::Ln)),
    function("sin", "sin(x)", 1, Body::Op(Op::Sin)),
    function("cos", "cos(x)", 1, Body::Op(Op::Cos)),
    function("tan", "tan(x)", 1, Body::Op(Op::Tan)),
    function("asin", "asin(x)", 1, Body::Op(Op::Asin)),
    function("acos", "acos(x)", 1, Body::Op(Op::Acos)),
    function("atan", "atan(x)", 1, Body::Op(Op::Atan)),
    function("atan2", "atan2(y, x)", 2, Body::Op(Op::Atan2)),
    function("tanh", "tanh(x)", 1, Body::Op(Op::Tanh)),
    function("hypot", "hypot(x, y)", 2, Body::Op(Op::Hypot)),
    function("if", "if(condition, a, b)", 3, Body::If),
    function("step", "step(x)", 1, Body::Op(Op::Step)),
    function("table", "table(x, [[x0, y0], [x1, y1]])", 1, Body::Table),
];

const fn function(
    name: &'static str,
    usage: &'static str,
    arguments: usize,
    body: Body,
) -> Function {
    Function { name, usage, arguments, body }
}

/// The operators that are words.
pub(super) const OPERATOR_WORDS: [&str; 3] = ["and", "or", "not"];

/// The names that every law knows.
pub(super) const VALUE_WORDS: [&str; 4] = ["t", "throttle", "rudder", "pi"];

/// Whether the language takes this name for something else than a function.
pub(super) fn is_word(name: &str) -> bool {
    OPERATOR_WORDS.contains(&name) || VALUE_WORDS.contains(&name)
}
