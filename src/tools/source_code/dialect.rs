//! The languages of printed methods, and the templates of their statements.

use std::fmt;

/// A language in which methods are printed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Language {
    /// Rust.
    #[default]
    Rust,
    /// C99, which is also valid C++.
    C,
    /// C#, from version 3.
    CSharp,
    /// GDScript of Godot 4.
    GdScript,
    /// JavaScript, from version 2015.
    JavaScript,
    /// Lua from version 5.1, which is also valid Luau.
    Lua,
}

/// The form in which lines are printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CodeForm {
    /// A function in a language.
    Function(Language),
    /// The lines of a step, to change and give back.
    Step,
}

impl Default for CodeForm {
    fn default() -> Self {
        Self::Function(Language::default())
    }
}

impl From<Language> for CodeForm {
    fn from(language: Language) -> Self {
        Self::Function(language)
    }
}

impl Language {
    /// All languages.
    pub const ALL: [Language; 6] = [
        Language::Rust,
        Language::C,
        Language::CSharp,
        Language::GdScript,
        Language::JavaScript,
        Language::Lua,
    ];

    /// Returns the language's id, which is one lower-case word.
    pub fn id(self) -> &'static str {
        match self {
            Language::Rust => "rust",
            Language::C => "c",
            Language::CSharp => "csharp",
            Language::GdScript => "gdscript",
            Language::JavaScript => "javascript",
            Language::Lua => "lua",
        }
    }

    /// Returns the language's name for people.
    pub fn name(self) -> &'static str {
        match self {
            Language::Rust => "Rust",
            Language::C => "C",
            Language::CSharp => "C#",
            Language::GdScript => "GDScript",
            Language::JavaScript => "JavaScript",
            Language::Lua => "Lua",
        }
    }

    /// Returns the reason why the language cannot compute in this precision, if it cannot.
    pub(super) fn refusal(self, precision: Precision) -> Option<&'static str> {
        let is_double_only = self.dialect().types[0] == self.dialect().types[1];
        (is_double_only && precision == Precision::Single)
            .then_some("its numbers have double precision always")
    }

    pub(super) fn dialect(self) -> &'static Dialect {
        match self {
            Language::Rust => &RUST,
            Language::C => &C,
            Language::CSharp => &C_SHARP,
            Language::GdScript => &GD_SCRIPT,
            Language::JavaScript => &JAVA_SCRIPT,
            Language::Lua => &LUA,
        }
    }
}

impl Dialect {
    /// Returns the spelling of a word or a sign of the language of steps.
    pub(super) fn word(&self, word: &'static str) -> &'static str {
        self.words.iter().find(|(ours, _)| *ours == word).map_or(word, |(_, theirs)| theirs)
    }

    /// Whether the language lacks this function of the language of steps.
    pub(super) fn writes_out(&self, function: &str) -> bool {
        self.written_out.contains(&function)
    }

    /// Whether a name has a meaning of its own in the language.
    pub(super) fn is_reserved(&self, name: &str) -> bool {
        self.reserved.split_whitespace().any(|word| word == name)
            || self.words.iter().any(|(_, word)| word.trim_end_matches("SUFFIX") == name)
    }

    /// Returns a line break within an expression.
    pub(super) fn broken_line(&self) -> String {
        format!("{}\n{}", self.line_break, self.indent)
    }

    /// Returns the type of a number.
    pub(super) fn type_in(&self, precision: Precision) -> &'static str {
        self.types[precision as usize]
    }

    /// Fills in the parts of a template that depend on the precision.
    pub(super) fn fill_precision(&self, template: &str, precision: Precision) -> String {
        let type_name = self.type_in(precision);
        let (suffix, cast) = match precision {
            Precision::Double => ("", String::new()),
            Precision::Single => (self.single_suffix, format!("({type_name})")),
        };
        template.replace("TYPE", type_name).replace("SUFFIX", suffix).replace("CAST", &cast)
    }
}

impl fmt::Display for Language {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The precision of the numbers of a function.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// 64 bits.
    #[default]
    Double,
    /// 32 bits.
    Single,
}

/// A language's templates for statements. `NAME` and `VALUE` are placeholders, and `TYPE` is the type of a number.
/// `SUFFIX` ends the name of a C function in the chosen precision; `CAST` converts a `double` to that precision.
pub(super) struct Dialect {
    pub(super) comment: &'static str,
    pub(super) indent: &'static str,
    /// Types of a number in double and in single precision.
    pub(super) types: [&'static str; 2],
    /// Suffix of a number in single precision.
    pub(super) single_suffix: &'static str,
    /// Template that converts a whole number to a number.
    pub(super) converted: &'static str,
    /// Type of a whole number.
    pub(super) whole: &'static str,
    pub(super) constant: &'static str,
    pub(super) number: &'static str,
    pub(super) variable: &'static str,
    pub(super) counter: &'static str,
    pub(super) assignment: &'static str,
    pub(super) if_block: &'static str,
    pub(super) else_block: &'static str,
    pub(super) while_block: &'static str,
    /// Line that ends a block; empty if indentation does this.
    pub(super) end: &'static str,
    /// Lines of a block without any.
    pub(super) nothing: &'static [&'static str],
    /// Text at the end of a line whose expression continues on the next line.
    pub(super) line_break: &'static str,
    pub(super) return_value: &'static str,
    /// Template for the value at the end of a function.
    pub(super) last_value: &'static str,
    /// The sign between the memory and a field of it.
    pub(super) member: &'static str,
    /// What stands before a number that a game loop keeps.
    pub(super) own: &'static str,
    /// Template for the index of an array, with `VALUE` for the number.
    pub(super) index: &'static str,
    /// The sign between a function that was handed over and its arguments.
    pub(super) call: &'static str,
    /// The last argument of such a call.
    pub(super) user: &'static str,
    /// The sign before a function that is handed on.
    pub(super) reference: &'static str,
    /// Whether the language has `+=` and the like.
    pub(super) is_compound: bool,
    /// Returns a name in the case of the language.
    pub(super) spelt: fn(&str) -> String,
    /// Returns the name of a function from that of the method and its own.
    pub(super) function_name: fn(&str, &str) -> String,
    /// Functions of the language of steps that the language lacks.
    pub(super) written_out: &'static [&'static str],
    /// Words that are spelt differently from the sources, each with its spelling. In an operator, `{a}`, `{b}` and
    /// `{c}` are the arguments of the function.
    pub(super) words: &'static [(&'static str, &'static str)],
    /// Names that mean something else in the language, or in the code around the lines, between blanks.
    pub(super) reserved: &'static str,
}

/// Functions that no language has, or not with these bits.
const ALL_LACK: [&str; 4] = ["sign", "step", "round", "hypot"];

/// Converts `adams_bashforth_2` to `AdamsBashforth2`.
pub(super) fn pascal(snake: &str) -> String {
    let capital = |word: &str| {
        let (first, rest) = word.split_at(word.len().min(1));
        first.to_uppercase() + &rest.to_lowercase()
    };
    snake.split('_').map(capital).collect()
}

/// Converts `last_h` to `lastH`, and keeps a name in capitals.
fn camel(snake: &str) -> String {
    if snake.starts_with('_') || !snake.chars().any(|c| c.is_ascii_lowercase()) {
        return snake.to_owned();
    }
    let pascal = pascal(snake);
    let (first, rest) = pascal.split_at(pascal.len().min(1));
    first.to_lowercase() + rest
}

/// Converts `last_h` to `lastH`, and a constant such as `MIN_H` to `MinH`.
fn c_sharp_name(snake: &str) -> String {
    let is_constant = !snake.starts_with('_') && !snake.chars().any(|c| c.is_ascii_lowercase());
    if is_constant { pascal(snake) } else { camel(snake) }
}

const RUST: Dialect = Dialect {
    comment: "//",
    indent: "    ",
    types: ["f64", "f32"],
    single_suffix: "",
    converted: "NAME as TYPE",
    whole: "u32",
    constant: "const NAME: TYPE = VALUE;",
    number: "let NAME = VALUE;",
    variable: "let mut NAME = VALUE;",
    counter: "let mut NAME = VALUE;",
    assignment: "VALUE;",
    if_block: "if VALUE {",
    else_block: "} else {",
    while_block: "while VALUE {",
    end: "}",
    nothing: &[],
    line_break: "",
    return_value: "return VALUE;",
    last_value: "VALUE",
    member: ".",
    own: "self.",
    index: "VALUE as usize",
    call: "",
    user: "",
    reference: "&",
    is_compound: true,
    spelt: str::to_owned,
    function_name: |method, name| format!("{method}_{name}"),
    written_out: &ALL_LACK,
    words: &[
        ("if", "(if {a} { {b} } else { {c} })"),
        ("and", "&&"),
        ("or", "||"),
        ("nan", "TYPE::NAN"),
        ("is_nan", "TYPE::is_nan"),
        ("abs", "TYPE::abs"),
        ("min", "TYPE::min"),
        ("max", "TYPE::max"),
        ("sqrt", "TYPE::sqrt"),
        ("pow", "TYPE::powf"),
        ("exp", "TYPE::exp"),
        ("ceil", "TYPE::ceil"),
        ("not", "!"),
        ("floor", "TYPE::floor"),
        ("ln", "TYPE::ln"),
        ("sin", "TYPE::sin"),
        ("cos", "TYPE::cos"),
        ("tan", "TYPE::tan"),
        ("asin", "TYPE::asin"),
        ("acos", "TYPE::acos"),
        ("atan", "TYPE::atan"),
        ("atan2", "TYPE::atan2"),
        ("sinh", "TYPE::sinh"),
        ("cosh", "TYPE::cosh"),
        ("tanh", "TYPE::tanh"),
    ],
    reserved: "_ abstract as async await become box break const continue crate do dyn else enum extern false final fn for gen if \
               impl in let loop macro match mod move mut override priv pub ref return self Self static struct super trait \
               true try type typeof unsafe unsized use virtual where while yield None Some Ok Err",
};

const C: Dialect = Dialect {
    types: ["double", "float"],
    single_suffix: "f",
    converted: "(TYPE)NAME",
    whole: "int",
    constant: "const TYPE NAME = VALUE;",
    number: "const TYPE NAME = VALUE;",
    variable: "TYPE NAME = VALUE;",
    counter: "int NAME = VALUE;",
    last_value: "return VALUE;",
    member: "->",
    own: "loop->",
    index: "(int)VALUE",
    user: ", user",
    reference: "",
    if_block: "if (VALUE) {",
    while_block: "while (VALUE) {",
    words: &[
        ("if", "({a} ? {b} : {c})"),
        ("and", "&&"),
        ("or", "||"),
        ("nan", "NAN"),
        ("is_nan", "isnan"),
        ("abs", "fabsSUFFIX"),
        ("min", "fminSUFFIX"),
        ("max", "fmaxSUFFIX"),
        ("sqrt", "sqrtSUFFIX"),
        ("pow", "powSUFFIX"),
        ("exp", "expSUFFIX"),
        ("ceil", "ceilSUFFIX"),
        ("not", "!"),
        ("floor", "floorSUFFIX"),
        ("ln", "logSUFFIX"),
        ("sin", "sinSUFFIX"),
        ("cos", "cosSUFFIX"),
        ("tan", "tanSUFFIX"),
        ("asin", "asinSUFFIX"),
        ("acos", "acosSUFFIX"),
        ("atan", "atanSUFFIX"),
        ("atan2", "atan2SUFFIX"),
        ("sinh", "sinhSUFFIX"),
        ("cosh", "coshSUFFIX"),
        ("tanh", "tanhSUFFIX"),
    ],
    reserved: "alignas alignof and and_eq asm auto bitand bitor bool break case catch char char8_t char16_t char32_t class \
               co_await co_return co_yield compl concept const const_cast consteval constexpr constinit continue decltype \
               default delete do double dynamic_cast else enum explicit export extern false float for friend goto if inline \
               int long mutable namespace new noexcept not not_eq nullptr operator or or_eq private protected public \
               register reinterpret_cast requires restrict return short signed sizeof static static_assert static_cast \
               struct switch template this thread_local throw true try typedef typeid typename typeof typeof_unqual union \
               unsigned using virtual void volatile wchar_t while xor xor_eq _Alignas _Alignof _Atomic _BitInt _Bool \
               _Complex _Decimal128 _Decimal32 _Decimal64 _Generic _Imaginary _Noreturn _Static_assert _Thread_local linux \
               unix NAN INFINITY HUGE_VAL HUGE_VALF HUGE_VALL M_E M_PI M_SQRT2 fpclassify isfinite isinf isnan isnormal \
               signbit acosh asinh atanh cbrt copysign drem erf erfc exp2 expm1 fdim fma fmod frexp gamma ilogb j0 j1 jn \
               ldexp lgamma llrint llround log log10 log1p log2 logb lrint lround modf nearbyint nextafter remainder remquo \
               rint round scalb scalbln scalbn significand tgamma trunc y0 y1 yn position velocity user",
    ..RUST
};

const C_SHARP: Dialect = Dialect {
    converted: "NAME",
    number: "TYPE NAME = VALUE;",
    if_block: "if (VALUE)\n{",
    else_block: "}\nelse\n{",
    while_block: "while (VALUE)\n{",
    member: ".",
    own: "",
    user: "",
    spelt: c_sharp_name,
    function_name: |_, name| pascal(name),
    words: &[
        ("if", "({a} ? {b} : {c})"),
        ("and", "&&"),
        ("or", "||"),
        ("nan", "TYPE.NaN"),
        ("is_nan", "TYPE.IsNaN"),
        ("abs", "Math.Abs"),
        ("min", "Math.Min"),
        ("max", "Math.Max"),
        ("sqrt", "CASTMath.Sqrt"),
        ("pow", "CASTMath.Pow"),
        ("exp", "CASTMath.Exp"),
        ("ceil", "CASTMath.Ceiling"),
        ("not", "!"),
        ("floor", "CASTMath.Floor"),
        ("ln", "CASTMath.Log"),
        ("sin", "CASTMath.Sin"),
        ("cos", "CASTMath.Cos"),
        ("tan", "CASTMath.Tan"),
        ("asin", "CASTMath.Asin"),
        ("acos", "CASTMath.Acos"),
        ("atan", "CASTMath.Atan"),
        ("atan2", "CASTMath.Atan2"),
        ("sinh", "CASTMath.Sinh"),
        ("cosh", "CASTMath.Cosh"),
        ("tanh", "CASTMath.Tanh"),
    ],
    reserved: "abstract as async await base bool break byte case catch char checked class const continue decimal default \
               delegate do double else enum event explicit extern false finally fixed float for foreach goto if implicit in \
               int interface internal is lock long namespace new null object operator out override params private protected \
               public readonly ref return sbyte sealed short sizeof stackalloc static string struct switch this throw true \
               try typeof uint ulong unchecked unsafe ushort using var virtual void volatile while yield Func Math Memory \
               Step",
    ..C
};

const GD_SCRIPT: Dialect = Dialect {
    comment: "#",
    indent: "\t",
    types: ["float"; 2],
    converted: "NAME",
    whole: "int",
    constant: "const NAME: float = VALUE",
    number: "var NAME: float = VALUE",
    variable: "var NAME: float = VALUE",
    counter: "var NAME: int = VALUE",
    assignment: "VALUE",
    if_block: "if VALUE:",
    else_block: "else:",
    while_block: "while VALUE:",
    end: "",
    nothing: &["pass"],
    line_break: " \\",
    return_value: "return VALUE",
    last_value: "return VALUE",
    own: "",
    index: "int(VALUE)",
    call: ".call",
    reference: "",
    words: &[
        ("if", "({b} if {a} else {c})"),
        ("nan", "NAN"),
        ("abs", "absf"),
        ("min", "minf"),
        ("max", "maxf"),
        ("ln", "log"),
    ],
    reserved: "and as assert await bool break breakpoint class class_name const continue elif else enum extends false float \
               for func if in int is match namespace not null or pass preload return self signal static super trait true \
               var void when while yield PI TAU INF NAN absf maxf minf log sqrt exp pow ceil floor sin cos tan asin acos \
               atan atan2 sinh cosh tanh is_nan call callv connect disconnect free get get_class get_meta get_script \
               has_method has_signal is_class new notification script set set_meta set_script tr tr_n",
    ..RUST
};

const JAVA_SCRIPT: Dialect = Dialect {
    indent: "  ",
    types: [""; 2],
    converted: "NAME",
    whole: "",
    constant: "const NAME = VALUE;",
    number: "const NAME = VALUE;",
    variable: "let NAME = VALUE;",
    counter: "let NAME = VALUE;",
    last_value: "return VALUE;",
    if_block: "if (VALUE) {",
    while_block: "while (VALUE) {",
    own: "this.",
    index: "VALUE | 0",
    reference: "",
    spelt: camel,
    function_name: |method, name| camel(&format!("{method}_{name}")),
    words: &[
        ("if", "({a} ? {b} : {c})"),
        ("and", "&&"),
        ("or", "||"),
        ("not", "!"),
        ("==", "==="),
        ("!=", "!=="),
        ("nan", "NaN"),
        ("is_nan", "Number.isNaN"),
        ("abs", "Math.abs"),
        ("min", "Math.min"),
        ("max", "Math.max"),
        ("sqrt", "Math.sqrt"),
        ("pow", "Math.pow"),
        ("exp", "Math.exp"),
        ("ceil", "Math.ceil"),
        ("floor", "Math.floor"),
        ("ln", "Math.log"),
        ("sin", "Math.sin"),
        ("cos", "Math.cos"),
        ("tan", "Math.tan"),
        ("asin", "Math.asin"),
        ("acos", "Math.acos"),
        ("atan", "Math.atan"),
        ("atan2", "Math.atan2"),
        ("sinh", "Math.sinh"),
        ("cosh", "Math.cosh"),
        ("tanh", "Math.tanh"),
    ],
    reserved: "arguments await break case catch class const continue debugger default delete do else enum eval export extends \
               false finally for function if implements import in instanceof interface let new null package private \
               protected public return static super switch this throw true try typeof undefined var void while with yield \
               Infinity Math NaN Number",
    ..RUST
};

const LUA: Dialect = Dialect {
    comment: "--",
    indent: "    ",
    types: [""; 2],
    converted: "NAME",
    whole: "",
    constant: "local NAME = VALUE",
    number: "local NAME = VALUE",
    variable: "local NAME = VALUE",
    counter: "local NAME = VALUE",
    assignment: "VALUE",
    if_block: "if VALUE then",
    else_block: "else",
    while_block: "while VALUE do",
    end: "end",
    return_value: "return VALUE",
    last_value: "return VALUE",
    index: "math.floor(VALUE)",
    reference: "",
    is_compound: false,
    written_out: &["sign", "step", "round", "hypot", "sinh", "cosh", "tanh"],
    words: &[
        ("if", "(({a}) and {b} or {c})"),
        ("!=", "~="),
        ("nan", "(0 / 0)"),
        ("is_nan", "({a} ~= {a})"),
        ("abs", "math.abs"),
        ("min", "math.min"),
        ("max", "math.max"),
        ("sqrt", "math.sqrt"),
        ("pow", "({a} ^ {b})"),
        ("exp", "math.exp"),
        ("ceil", "math.ceil"),
        ("floor", "math.floor"),
        ("ln", "math.log"),
        ("sin", "math.sin"),
        ("cos", "math.cos"),
        ("tan", "math.tan"),
        ("asin", "math.asin"),
        ("acos", "math.acos"),
        ("atan", "math.atan"),
        // `atan2` went with version 5.3, in which `atan` has two arguments.
        ("atan2", "(math.atan2 or math.atan)"),
    ],
    reserved: "and break continue do else elseif end export false for function goto if in local nil not or repeat return self \
               then true type until while math",
    ..RUST
};

/// The language of steps itself, with the names of the code around the lines of a rule.
pub(super) const STEP: Dialect = Dialect {
    comment: "#",
    types: [""; 2],
    converted: "NAME",
    constant: "const NAME = VALUE",
    number: "let NAME = VALUE",
    variable: "var NAME = VALUE",
    counter: "count NAME = VALUE",
    assignment: "VALUE",
    if_block: "if VALUE {",
    while_block: "while VALUE {",
    return_value: "return VALUE",
    last_value: "return VALUE",
    reference: "",
    written_out: &[],
    words: &[],
    reserved: "FRAME_S before const count else fail fn if is_nan let memory nan refused return shown stay step_s takes unspent \
               use var while",
    ..RUST
};
