//! The functions of expressions. Each has a row with its name, arguments and value, and its derivatives or pieces.
//!
//! To add a smooth function of one argument, add a `unary!` row here, and a reference for it to the test below.

use std::hash::{Hash, Hasher};

use super::jet::{Jet, chain, constant, product, quotient, root, sum};
use super::switch::{ModeRule, Switch, SwitchValue};

/// A function that an expression can call.
pub struct Function {
    pub(super) name: &'static str,
    /// The names of its arguments, for messages.
    pub(super) arguments: &'static [&'static str],
    pub(super) meaning: Meaning,
}

/// The operation that a call compiles to.
pub(super) enum Meaning {
    Smooth(Smooth),
    Switch(Switch),
    /// `if(condition, a, b)`.
    If,
    /// `table(x, [[x0, y0], …])`.
    Table,
    /// `base ^ exponent`, computed by `pow` even for whole exponents.
    Power,
    /// An expression of the arguments and, in a step, of its length `dt`.
    Written(&'static str),
    /// `x != x`.
    IsNan,
}

/// A function of one or two arguments that is smooth wherever it is defined. Two functions are equal only if they are
/// the same row.
#[derive(Clone, Copy, Debug)]
pub(super) struct Smooth {
    /// The value. A function of one argument ignores the second.
    pub(super) value: fn(f64, f64) -> f64,
    /// The value with its first and second derivative along a curve.
    pub(super) jet: fn(Jet, Jet) -> Jet,
    /// Whether a full turn of the argument leaves the value unchanged.
    pub(super) is_periodic: bool,
    /// Whether the value is a whole number.
    pub(super) rounds: bool,
}

impl PartialEq for Smooth {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self, other)
    }
}

impl Eq for Smooth {}

impl Hash for Smooth {
    fn hash<H: Hasher>(&self, state: &mut H) {
        std::ptr::hash(self, state);
    }
}

/// Makes a smooth function of one argument from its value `f` at `x`, and its first and second derivative there.
macro_rules! unary {
    ($name:literal, |$x:ident| $f:ident = $value:expr, $derivatives:expr) => {
        smooth(
            $name,
            &["x"],
            |$x, _| $value,
            |a, _| {
                let $x = a[0];
                let $f = $value;
                let [first, second] = $derivatives;
                chain(a, [$f, first, second])
            },
        )
    };
}

/// Every function.
pub(super) static FUNCTIONS: [Function; 21] = [
    smooth("sqrt", &["x"], |x, _| x.sqrt(), |x, _| root(x)),
    switch("abs", &["x"], ModeRule::NotNegative, SwitchValue::Magnitude),
    switch("sign", &["x"], ModeRule::Sign, SwitchValue::Mode),
    switch("min", &["a", "b"], ModeRule::Less, SwitchValue::Choice),
    switch("max", &["a", "b"], ModeRule::Greater, SwitchValue::Choice),
    written("clamp", &["x", "low", "high"], "min(max(x, low), high)"),
    switch("floor", &["x"], ModeRule::Floor, SwitchValue::Mode),
    unary!("exp", |x| f = libm::exp(x), [f, f]),
    unary!("ln", |x| f = libm::log(x), [1.0 / x, -1.0 / (x * x)]),
    unary!("sin", |x| f = libm::sin(x), [libm::cos(x), -f]).periodic(),
    unary!("cos", |x| f = libm::cos(x), [-libm::sin(x), -f]).periodic(),
    unary!("tan", |x| f = libm::tan(x), {
        let slope = 1.0 + f * f;
        [slope, 2.0 * f * slope]
    })
    .periodic(),
    unary!("asin", |x| f = libm::asin(x), {
        let slope = 1.0 / (1.0 - x * x).sqrt();
        [slope, x * slope * slope * slope]
    }),
    unary!("acos", |x| f = libm::acos(x), {
        let slope = 1.0 / (1.0 - x * x).sqrt();
        [-slope, -(x * slope * slope * slope)]
    }),
    unary!("atan", |x| f = libm::atan(x), {
        let slope = 1.0 / (1.0 + x * x);
        [slope, -2.0 * x * slope * slope]
    }),
    smooth("atan2", &["y", "x"], libm::atan2, |y, x| {
        // `slope` has the first and the second derivative of the angle.
        let radius2 = sum(product(y, y), product(x, x));
        let numerator = [x[0] * y[1] - y[0] * x[1], x[0] * y[2] - y[0] * x[2], 0.0];
        let slope = quotient(numerator, [radius2[0], radius2[1], 0.0]);
        [libm::atan2(y[0], x[0]), slope[0], slope[1]]
    }),
    unary!("tanh", |x| f = libm::tanh(x), {
        let slope = 1.0 - f * f;
        [slope, -2.0 * f * slope]
    }),
    smooth("hypot", &["x", "y"], libm::hypot, |x, y| {
        let [_, first, second] = root(sum(product(x, x), product(y, y)));
        [libm::hypot(x[0], y[0]), first, second]
    }),
    function("if", &["condition", "a", "b"], Meaning::If),
    switch("step", &["x"], ModeRule::NotNegative, SwitchValue::Mode),
    function("table", &["x", "[[x0, y0], [x1, y1]]"], Meaning::Table),
];

/// The functions of step lines that laws do not have.
pub(super) static STEP_FUNCTIONS: [Function; 43] = [
    written("lerp", &["a", "b", "part"], "a + (b - a) * part"),
    function("pow", &["base", "exponent"], Meaning::Power),
    // Halves go away from 0.
    smooth("round", &["x"], |x, _| libm::round(x), |x, _| constant(libm::round(x[0]))).rounding(),
    // Unity's.
    written("lerp01", &["a", "b", "part"], "lerp(a, b, clamp01(part))"),
    written("inverseLerp01", &["a", "b", "x"], "clamp01(inverse_lerp(a, b, x))"),
    // JavaScript's and Java's halves go up, those of C# to the even number.
    written("roundUp", &["x"], "floor(x + 0.5)"),
    written("roundEven", &["x"], "if(x - floor(x) == 0.5, 2 * floor(x / 2 + 0.5), floor(x + 0.5))"),
    unary!("sinh", |x| f = libm::sinh(x), [libm::cosh(x), f]),
    unary!("cosh", |x| f = libm::cosh(x), [libm::sinh(x), f]),
    written("ceil", &["x"], "-floor(-x)"),
    written("trunc", &["x"], "sign(x) * floor(abs(x))"),
    written("fract", &["x"], "x - floor(x)"),
    written("fmod", &["a", "b"], "a - b * trunc(a / b)"),
    written("mod", &["a", "b"], "a - b * floor(a / b)"),
    written("wrap", &["x", "low", "high"], "low + mod(x - low, high - low)"),
    written("min", &["a", "b", "c"], "min(min(a, b), c)"),
    written("max", &["a", "b", "c"], "max(max(a, b), c)"),
    written("floor_divide", &["a", "b"], "floor(a / b)"),
    // A number of another type, and a copy.
    written("float", &["x"], "x"),
    // three.js'.
    written("add", &["a", "b"], "a + b"),
    written("sub", &["a", "b"], "a - b"),
    written("add_scaled_vector", &["a", "b", "part"], "a + b * part"),
    written("multiply_scalar", &["a", "b"], "a * b"),
    written("divide_scalar", &["a", "b"], "a / b"),
    written("clamp01", &["x"], "clamp(x, 0, 1)"),
    written("step", &["edge", "x"], "step(x - edge)"),
    written("smoothstep", &["low", "high", "x"], "eased(clamp01((x - low) / (high - low)))"),
    // Unity's, which goes from one value to another.
    written("smoothStep", &["from", "to", "part"], "lerp(from, to, eased(clamp01(part)))"),
    written("inverse_lerp", &["a", "b", "x"], "(x - a) / (b - a)"),
    written("move_toward", &["from", "to", "by"], "clamp(to, from - by, from + by)"),
    written("lerp_angle", &["from", "to", "part"], "from + angle_to(from, to, pi) * part"),
    // Unity's are in degrees.
    written("lerpAngle", &["from", "to", "part"], "from + angle_to(from, to, 180) * part"),
    written("deltaAngle", &["from", "to"], "angle_to(from, to, 180)"),
    // Godot's and Phaser's are in radians.
    written("angle_difference", &["from", "to"], "angle_to(from, to, pi)"),
    written(
        "rotate_toward",
        &["from", "to", "by"],
        "from + clamp(angle_to(from, to, pi), -by, by)",
    ),
    written("wrap", &["x"], "wrap(x, -pi, pi)"),
    // three.js'.
    written("damp", &["x", "to", "rate", "dt"], "lerp(x, to, 1 - exp(-rate * dt))"),
    // Unreal's.
    written("fInterpTo", &["x", "to", "dt", "speed"], "x + (to - x) * clamp(dt * speed, 0, 1)"),
    written("fInterpConstantTo", &["x", "to", "dt", "speed"], "move_toward(x, to, dt * speed)"),
    // Unity's critically damped spring, without the stop at the target, and the velocity that it leaves.
    written("smoothDamp", &["x", "to", "v", "time"], "dampedTo(x, to, v, time, dt)"),
    written(
        "smoothDamp",
        &["x", "to", "v", "time", "most"],
        "smoothDamp(x, to, v, time, most, dt)",
    ),
    written(
        "smoothDamp",
        &["x", "to", "v", "time", "most", "dt"],
        "dampedTo(x, x - clamp((x - to) / time, -most, most) * time, v, time, dt)",
    ),
    function("is_nan", &["x"], Meaning::IsNan),
];

/// Functions of which those of step lines are made, and which no line calls.
static PARTS: [Function; 8] = [
    written("eased", &["x"], "x * x * (3 - 2 * x)"),
    written("angle_to", &["from", "to", "half"], "mod(to - from + half, 2 * half) - half"),
    written(
        "dampedTo",
        &["x", "to", "v", "time", "dt"],
        "to + (x - to + (v + 2 / time * (x - to)) * dt) * damped(2 / time * dt)",
    ),
    written("damped", &["k"], "1 / (1 + k + 0.48 * k * k + 0.235 * k * k * k)"),
    written("smoothDampVelocity", &["x", "to", "v", "time"], "dampedVelocity(x, to, v, time, dt)"),
    written(
        "smoothDampVelocity",
        &["x", "to", "v", "time", "most"],
        "smoothDampVelocity(x, to, v, time, most, dt)",
    ),
    written(
        "smoothDampVelocity",
        &["x", "to", "v", "time", "most", "dt"],
        "dampedVelocity(x, x - clamp((x - to) / time, -most, most) * time, v, time, dt)",
    ),
    written(
        "dampedVelocity",
        &["x", "to", "v", "time", "dt"],
        "(v - 2 / time * (v + 2 / time * (x - to)) * dt) * damped(2 / time * dt)",
    ),
];

/// Names from other languages, each with our name. Capitals and underscores in a call do not matter.
const ALIASES: [(&str, &str); 58] = [
    ("mix", "lerp"),
    ("lerpf", "lerp"),
    ("linear", "lerp"),
    ("lerpUnclamped", "lerp"),
    ("lerpClamped", "lerp"),
    ("powf", "pow"),
    ("powi", "pow"),
    ("power", "pow"),
    ("log", "ln"),
    ("fabs", "abs"),
    ("fabsf", "abs"),
    ("absf", "abs"),
    ("length", "abs"),
    ("signf", "sign"),
    ("signum", "sign"),
    ("sgn", "sign"),
    ("fmin", "min"),
    ("fminf", "min"),
    ("minf", "min"),
    ("fmax", "max"),
    ("fmaxf", "max"),
    ("maxf", "max"),
    ("clampf", "clamp"),
    ("constrain", "clamp"),
    ("saturate", "clamp01"),
    ("expf", "exp"),
    ("sqrtf", "sqrt"),
    ("roundf", "round"),
    ("floorf", "floor"),
    ("ceilf", "ceil"),
    ("fmodf", "fmod"),
    ("fposmod", "mod"),
    ("repeat", "mod"),
    ("frac", "fract"),
    ("wrapf", "wrap"),
    ("moveTowards", "move_toward"),
    ("rotateTo", "rotate_toward"),
    ("vInterpTo", "fInterpTo"),
    ("approach", "move_toward"),
    ("inverseLerpf", "inverse_lerp"),
    ("double", "float"),
    ("real", "float"),
    ("number", "float"),
    ("parseFloat", "float"),
    ("f32", "float"),
    ("f64", "float"),
    ("clone", "float"),
    ("int", "trunc"),
    ("long", "trunc"),
    ("i32", "trunc"),
    ("i64", "trunc"),
    ("u32", "trunc"),
    ("usize", "trunc"),
    ("parseInt", "trunc"),
    ("truncf", "trunc"),
    ("floorToInt", "floor"),
    ("roundToInt", "round"),
    ("ceilToInt", "ceil"),
];

const fn function(
    name: &'static str,
    arguments: &'static [&'static str],
    meaning: Meaning,
) -> Function {
    Function { name, arguments, meaning }
}

const fn written(
    name: &'static str,
    arguments: &'static [&'static str],
    expression: &'static str,
) -> Function {
    function(name, arguments, Meaning::Written(expression))
}

const fn smooth(
    name: &'static str,
    arguments: &'static [&'static str],
    value: fn(f64, f64) -> f64,
    jet: fn(Jet, Jet) -> Jet,
) -> Function {
    let smooth = Smooth { value, jet, is_periodic: false, rounds: false };
    function(name, arguments, Meaning::Smooth(smooth))
}

const fn switch(
    name: &'static str,
    arguments: &'static [&'static str],
    pieces: ModeRule,
    value: SwitchValue,
) -> Function {
    function(name, arguments, Meaning::Switch(Switch { pieces, value }))
}

impl Function {
    const fn periodic(mut self) -> Self {
        if let Meaning::Smooth(smooth) = &mut self.meaning {
            smooth.is_periodic = true;
        }
        self
    }

    const fn rounding(mut self) -> Self {
        if let Meaning::Smooth(smooth) = &mut self.meaning {
            smooth.rounds = true;
        }
        self
    }

    /// Returns a call of the function with named arguments, such as `min(a, b)`.
    pub(super) fn usage(&self) -> String {
        format!("{}({})", self.name, self.arguments.join(", "))
    }

    /// Returns the function of this name in laws.
    pub(super) fn named(name: &str) -> Option<&'static Self> {
        FUNCTIONS.iter().find(|function| function.name == name)
    }

    /// Returns the function of this name in step lines. The name may also be that of another language.
    pub(super) fn named_in_steps(name: &str) -> Option<&'static Self> {
        Self::rows_in_steps(name).next()
    }

    /// Returns the function of this name in the functions of step lines.
    pub(super) fn named_in_functions(name: &str) -> Option<&'static Self> {
        let part = PARTS.iter().find(|function| function.name == name);
        part.or_else(|| Self::named_in_steps(name))
    }

    /// Returns the function of this name in step lines that takes this number of arguments.
    pub(super) fn with_arguments(name: &str, count: usize) -> Option<&'static Self> {
        let parts = PARTS.iter().filter(|function| function.name == name);
        parts.chain(Self::rows_in_steps(name)).find(|function| function.arguments.len() == count)
    }

    /// Whether printed code may call the function of this name.
    pub(super) fn is_printed(name: &str) -> bool {
        FUNCTIONS.iter().chain(&STEP_FUNCTIONS[..2]).any(|function| function.name == name)
    }

    fn rows_in_steps(name: &str) -> impl Iterator<Item = &'static Self> {
        let plain = |name: &str| name.replace('_', "").to_ascii_lowercase();
        let rows = || FUNCTIONS.iter().chain(&STEP_FUNCTIONS);
        let (mut first, written) = (name.to_owned(), plain(name));
        first[..name.ceil_char_boundary(name.len().min(1))].make_ascii_lowercase();
        let alias = ALIASES.iter().find(|(alias, _)| plain(alias) == written);
        let found = rows().find(|function| function.name == first).map(|function| function.name);
        let found = found.or(alias.map(|(_, name)| *name)).or_else(|| {
            let mut rows = rows();
            rows.find(|function| plain(function.name) == written).map(|function| function.name)
        });
        rows().filter(move |function| Some(function.name) == found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expression::{Scope, parse};
    use crate::tape::Tape;

    struct Plane;

    impl Scope for Plane {
        fn input(&self, name: &str) -> Option<usize> {
            ["x", "y"].iter().position(|known| *known == name)
        }
        fn names(&self) -> Vec<String> {
            vec![]
        }
        fn why_not(&self, _: &str) -> Option<String> {
            None
        }
    }

    type Reference = fn(f64, f64) -> f64;

    /// A call of every function, with the value by the standard library.
    const REFERENCES: &[(&str, Reference)] = &[
        ("sqrt(x)", |x, _| x.sqrt()),
        ("abs(x)", |x, _| x.abs()),
        ("sign(x)", |x, _| x.signum()),
        ("min(x, y)", |x, y| x.min(y)),
        ("max(x, y)", |x, y| x.max(y)),
        ("clamp(x, -0.25, y)", |x, y| x.max(-0.25).min(y)),
        ("floor(x)", |x, _| x.floor()),
        ("exp(x)", |x, _| x.exp()),
        ("ln(x)", |x, _| x.ln()),
        ("sin(x)", |x, _| x.sin()),
        ("cos(x)", |x, _| x.cos()),
        ("tan(x)", |x, _| x.tan()),
        ("asin(x)", |x, _| x.asin()),
        ("acos(x)", |x, _| x.acos()),
        ("atan(x)", |x, _| x.atan()),
        ("atan2(x, y)", |x, y| x.atan2(y)),
        ("tanh(x)", |x, _| x.tanh()),
        ("hypot(x, y)", |x, y| x.hypot(y)),
        ("if(x < y, x*x, y)", |x, y| if x < y { x * x } else { y }),
        ("step(x)", |x, _| f64::from(u8::from(x >= 0.0))),
        ("table(x, [[-1, 2], [0.1, 3], [1, -4]])", |x, _| {
            if x < 0.1 { 2.0 + (x + 1.0) / 1.1 } else { 3.0 - 7.0 * (x - 0.1) / 0.9 }
        }),
    ];

    /// Whether `a` and `b` are equal to within `most`, or both are NaN.
    fn is_near(a: f64, b: f64, most: f64) -> bool {
        a.is_nan() && b.is_nan() || (a - b).abs() <= most * (1.0 + b.abs())
    }

    #[test]
    fn every_function_matches_the_standard_library_and_its_finite_differences() {
        for function in &FUNCTIONS {
            let is_call = |(call, _): &&(&str, _)| call.starts_with(&format!("{}(", function.name));
            let (call, reference) =
                REFERENCES.iter().find(is_call).unwrap_or_else(|| panic!("{}", function.usage()));
            let expression = parse(call, &Plane).unwrap_or_else(|fault| panic!("{fault:?}"));
            let Ok(tape) = Tape::new(2, |_| false, &[expression]) else {
                panic!("{call} is too long")
            };
            let output = usize::from(tape.outputs[0]);
            let mut numbers = 0;
            for [x, y] in [[0.4, 0.7], [0.6, 0.2], [-0.3, 0.9], [-0.7, -0.5], [0.9, -0.8]] {
                let mut slots = vec![0.0; tape.slots];
                slots[..2].copy_from_slice(&[x, y]);
                tape.prepare::<1>(slots.as_chunks_mut().0);
                tape.evaluate(&mut slots);
                let value = slots[output];
                assert!(is_near(value, reference(x, y), 1e-15), "{call} at {x}, {y}: {value}");
                if value.is_nan() {
                    continue;
                }
                numbers += 1;

                let curve = [[x, 1.0, 0.7], [y, -0.3, 0.4]];
                let mut jets = vec![[0.0; 3]; tape.slots];
                jets[..2].copy_from_slice(&curve);
                tape.evaluate_jets(&mut jets);
                let [by_jet, first, second] = jets[output];
                assert!(is_near(by_jet, value, 0.0), "{call} at {x}, {y}: {by_jet}");
                let h = 1e-4;
                let [before, after] = [-h, h].map(|s| {
                    let [x, y] = curve.map(|[q, v, a]| q + v * s + a * s * s / 2.0);
                    reference(x, y)
                });
                let slope = (after - before) / (2.0 * h);
                let bend = (after - 2.0 * value + before) / (h * h);
                assert!(is_near(first, slope, 1e-6), "{call} at {x}, {y}: {first} for {slope}");
                assert!(is_near(second, bend, 1e-6), "{call} at {x}, {y}: {second} for {bend}");
            }
            assert!(numbers >= 2, "{call}");
        }
        assert_eq!(REFERENCES.len(), FUNCTIONS.len());
    }
}
