//! Names and remarks of a person's lines in printed code: words of a language are renamed there, and no remark becomes
//! code.

use std::fmt::Write as _;
use std::fs;
use std::process::Command;

use regatta::sim::law::StepText;
use regatta::sim::own_method;
use regatta::tools::Rule;
use regatta::tools::source_code::{Language, Precision, source_code};

use crate::compilers::{build_folder, compile, rustc};

/// Words of Rust, C, C++, C# and GDScript, names of their libraries, and names that a change of case makes equal.
const WORDS: &str = "abstract alignas and_eq as asm async auto await base become bitand bool box break byte case catch \
    char checked class class_name compl complex concept const constexpr continue crate debug decimal default delegate \
    delete do double dyn elif else enum event explicit export extends extern fabs final finally fixed float fmax fn \
    foreach foreign friend func gamma gen get goto impl implicit in INFINITY inline int interface internal is isnan j0 \
    let linux lock log logf long loop macro match Math MATH Memory minf mod module move mut NAN namespace nan new null \
    None object on out override pass PI params position preload priv private protected pub public readonly ref \
    refused register requires restrict return sbyte script sealed self Self set short signal signed sizeof Some \
    stackalloc static step_s string struct super switch TAU template this thread_local throw trait typedef typeid \
    typename typeof uint ulong unchecked union unix unsafe unsigned unsized user ushort using var velocity virtual void \
    volatile wchar_t when where while xor yield y0 _ __ _x x_ X x_own foo_bar fooBar foobar FooBar box_own boxOwn";

/// Rules that declare the words as `let`, as `var` and as `memory`, some words each.
pub(super) fn rules() -> Vec<String> {
    let declared: [fn(&str) -> String; 3] = [
        |word: &str| format!("let {word} = x * 0.5\nx += {word} * 0.001\n"),
        |word: &str| format!("{word} = x * 0.5\n{word} += 1\nx += {word} * 0.001\n"),
        |word: &str| format!("memory {word} = 0.5\n{word} += x\nx += {word} * 0.001\n"),
    ];
    // A word that begins a statement of our own language is none of a person's names.
    let is_read = |word: &&str| {
        let read =
            |declare: &fn(&str) -> String| StepText::read(&format!("x += 1\n{}", declare(word)));
        declared.iter().all(|declare| read(declare).is_ok())
    };
    let words: Vec<&str> = WORDS.split_whitespace().filter(is_read).collect();
    assert!(words.len() > 120, "{words:?}");
    let rule = |words: &[&str], declare: fn(&str) -> String| {
        let lines: String = words.iter().map(|word| declare(word)).collect();
        format!("{lines}x += clamp(target - x, -3, 3) * 0.2")
    };
    declared
        .into_iter()
        .flat_map(|declare| words.chunks(40).map(move |some| rule(some, declare)))
        .collect()
}

pub(super) fn code(rule: &str, language: Language) -> String {
    Rule::read(rule, 60.0).unwrap().code(rule, language).unwrap().text
}

/// Checks the rules in C by a compiler of this standard.
fn compile_c(compiler: &str, ending: &str, standard: &str) {
    let folder = build_folder(&format!("words-{ending}"));
    for (n, rule) in rules().iter().enumerate() {
        let file = folder.join(format!("{n}.{ending}"));
        fs::write(&file, code(rule, Language::C)).unwrap();
        let mut command = Command::new(compiler);
        compile(command.args([standard, "-Wall", "-Wextra", "-Werror", "-fsyntax-only"]).arg(file));
    }
}

pub(crate) fn words_of_c_are_renamed_in_it_and_compile() {
    compile_c("cc", "c", "-std=gnu11");
}

pub(crate) fn words_of_cpp_are_renamed_in_it_and_compile() {
    compile_c("c++", "cpp", "-std=c++20");
}

pub(crate) fn words_of_rust_are_renamed_in_it_and_compile() {
    let folder = build_folder("words-rust");
    let mut rust = "#![deny(unused_mut)]\n".to_owned();
    for (n, rule) in rules().iter().enumerate() {
        let names = "#[allow(non_snake_case, non_upper_case_globals, dead_code)]";
        writeln!(rust, "{names}\nmod rule_{n} {{\n{}}}", code(rule, Language::Rust)).unwrap();
    }
    // The memory is read from another module, as a game does.
    rust += "fn main() {\n    let mut m = rule_0::RuleMemory::default();\n    \
             let (x, v) = rule_0::rule(&mut m, 0.0, 0.0, 0.02, 1.0);\n    println!(\"{x} {v} {}\", m.shown);\n}\n";
    let file = folder.join("words.rs");
    fs::write(&file, rust).unwrap();
    compile(rustc().args(["--crate-type=bin", "-o"]).arg(folder.join("words")).arg(file));
}

pub(crate) fn words_of_c_sharp_are_renamed_in_it_and_compile() {
    let folder = build_folder("words-cs");
    let mut c_sharp = String::new();
    for (n, rule) in rules().iter().enumerate() {
        writeln!(c_sharp, "namespace Rule{n} {{\n{}}}", code(rule, Language::CSharp)).unwrap();
    }
    let file = folder.join("words.cs");
    fs::write(&file, c_sharp).unwrap();
    let mut mcs = Command::new("mcs");
    mcs.arg("-target:library").arg(format!("-out:{}", folder.join("words.dll").display()));
    compile(mcs.arg(file));
}

pub(crate) fn words_of_gdscript_are_renamed_in_it() {
    for rule in rules() {
        let gd_script = code(&rule, Language::GdScript);
        for line in gd_script.lines().map(str::trim_start) {
            let name = line.strip_prefix("var ").and_then(|line| line.split_once(':'));
            let words = "class self in is match pass func signal yield await PI TAU NAN get set script minf log";
            assert!(
                name.is_none_or(|(name, _)| !words.split(' ').any(|word| word == name)),
                "{line}"
            );
        }
    }
}

pub(crate) fn names_that_a_language_cannot_tell_apart_stay_two() {
    let rule = "let foo_bar = x * 2\nlet fooBar = x * 3\nlet _x = 1\nx += clamp(target - x, foo_bar, fooBar + _x)";
    let printed = code(rule, Language::CSharp);
    for declared in ["double fooBar = x * 2.0;", "double foobar = x * 3.0;", "double _x = 1.0;"] {
        assert!(printed.contains(declared), "{declared}: {printed}");
    }
    let method = own_method("box", "let in = a(x, v)\nv += h * in\nx += h * v").unwrap();
    let printed = |language| source_code(method, language, Precision::Double).unwrap();
    let rust = printed(Language::Rust);
    assert!(rust.contains("pub fn box_own(") && rust.contains("let in_own = a(x, v);"), "{rust}");
    let c = printed(Language::C);
    assert!(c.contains("void box(") && c.contains("const double in = a(x, v, user);"), "{c}");
}

pub(crate) fn no_remark_becomes_code_in_any_language() {
    for end in ["\u{2028}", "\u{2029}", "\u{85}", "\u{b}", "\u{c}", "\r", "\u{202e}"] {
        let rule = format!("x += (target - x) * 0.1 // a remark{end}using Math = Evil; \\");
        for language in Language::ALL {
            let printed = code(&rule, language);
            assert!(
                printed.contains("a remark using Math = Evil;\n"),
                "{end:?} {language}: {printed}"
            );
            assert!(!printed.contains(end), "{end:?} {language}");
        }
    }
}
