//! The languages, and how each of them writes what methods are written with.

use std::fmt;

/// A language that methods are printed in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Language {
    /// Rust.
    #[default]
    Rust,
    /// C99, which is C++ too.
    C,
    /// C#, as of version 3.
    CSharp,
    /// GDScript of Godot 4.
    GdScript,
}

impl Language {
    /// All of them.
    pub const ALL: [Language; 4] =
        [Language::Rust, Language::C, Language::CSharp, Language::GdScript];

    /// The id: one lower-case word.
    pub fn id(self) -> &'static str {
        match self {
            Language::Rust => "rust",
            Language::C => "c",
            Language::CSharp => "csharp",
            Language::GdScript => "gdscript",
        }
    }

    /// The name for people.
    pub fn name(self) -> &'static str {
        match self {
            Language::Rust => "Rust",
            Language::C => "C",
            Language::CSharp => "C#",
            Language::GdScript => "GDScript",
        }
    }

    pub(super) fn dialect(self) -> &'static Dialect {
        match self {
            Language::Rust => &RUST,
            Language::C => &C,
            Language::CSharp => &C_SHARP,
            Language::GdScript => &GD_SCRIPT,
        }
    }
}

impl fmt::Display for Language {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// How a language writes a statement. In the templates `NAME` and `VALUE` are replaced.
pub(super) struct Dialect {
    pub(super) comment: &'static str,
    pub(super) indent: &'static str,
    pub(super) constant: &'static str,
    pub(super) number: &'static str,
    pub(super) variable: &'static str,
    pub(super) assignment: &'static str,
    pub(super) if_block: &'static str,
    pub(super) else_block: &'static str,
    pub(super) while_block: &'static str,
    /// Empty where indentation ends a block.
    pub(super) end: &'static str,
    /// What ends a line whose expression goes on in the next.
    pub(super) line_break: &'static str,
    pub(super) return_value: &'static str,
    /// The words that are not as in the sources, each with how they are written.
    pub(super) words: &'static [(&'static str, &'static str)],
}

const RUST: Dialect = Dialect {
    comment: "//",
    indent: "    ",
    constant: "const NAME: f64 = VALUE;",
    number: "let NAME = VALUE;",
    variable: "let mut NAME = VALUE;",
    assignment: "VALUE;",
    if_block: "if VALUE {",
    else_block: "} else {",
    while_block: "while VALUE {",
    end: "}",
    line_break: "",
    return_value: "return VALUE;",
    words: &[
        ("and", "&&"),
        ("or", "||"),
        ("nan", "f64::NAN"),
        ("is_nan", "f64::is_nan"),
        ("abs", "f64::abs"),
        ("min", "f64::min"),
        ("max", "f64::max"),
        ("sqrt", "f64::sqrt"),
        ("pow", "f64::powf"),
        ("exp", "f64::exp"),
        ("ceil", "f64::ceil"),
    ],
};

const C: Dialect = Dialect {
    constant: "const double NAME = VALUE;",
    number: "const double NAME = VALUE;",
    variable: "double NAME = VALUE;",
    if_block: "if (VALUE) {",
    while_block: "while (VALUE) {",
    words: &[
        ("and", "&&"),
        ("or", "||"),
        ("nan", "NAN"),
        ("is_nan", "isnan"),
        ("abs", "fabs"),
        ("min", "fmin"),
        ("max", "fmax"),
    ],
    ..RUST
};

const C_SHARP: Dialect = Dialect {
    number: "double NAME = VALUE;",
    words: &[
        ("and", "&&"),
        ("or", "||"),
        ("nan", "double.NaN"),
        ("is_nan", "double.IsNaN"),
        ("abs", "Math.Abs"),
        ("min", "Math.Min"),
        ("max", "Math.Max"),
        ("sqrt", "Math.Sqrt"),
        ("pow", "Math.Pow"),
        ("exp", "Math.Exp"),
        ("ceil", "Math.Ceiling"),
    ],
    ..C
};

const GD_SCRIPT: Dialect = Dialect {
    comment: "#",
    indent: "\t",
    constant: "const NAME: float = VALUE",
    number: "var NAME: float = VALUE",
    variable: "var NAME: float = VALUE",
    assignment: "VALUE",
    if_block: "if VALUE:",
    else_block: "else:",
    while_block: "while VALUE:",
    end: "",
    line_break: " \\",
    return_value: "return VALUE",
    words: &[("nan", "NAN"), ("abs", "absf"), ("min", "minf"), ("max", "maxf")],
};
