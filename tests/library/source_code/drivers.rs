//! Programs that step every method as it is printed: each prints `id force x v` for every step, the numbers as bits.

use std::fmt::Write as _;

use regatta::lab::{Language, MethodSource, source_code};
use regatta::sim::integrators::Method;

use super::known::{
    FORCE, FORCES, LENGTHS, RATE, SETTINGS, START, STEPS, SUBSTEPS, TARGET, sources,
};

/// What stands for each input of a method in a call.
fn arguments(source: &MethodSource, function: &str) -> String {
    let each = |input: regatta::lab::MethodInput<'_>| match input.name {
        "a" => format!(", {function}"),
        "target" => format!(", {TARGET}"),
        "rate" => format!(", {RATE:?}"),
        "stiffness" => format!(", {:?}", SETTINGS[0]),
        "damping" => format!(", {:?}", SETTINGS[1]),
        "drag" => format!(", {:?}", SETTINGS[2]),
        "force" => format!(", {FORCE:?}"),
        "substeps" => format!(", {SUBSTEPS}.0"),
        other => panic!("{other} is not known here"),
    };
    source.inputs().into_iter().map(each).collect()
}

fn takes_function(source: &MethodSource) -> bool {
    source.inputs().iter().any(|input| !input.arguments.is_empty())
}

fn printed(method: &Method, language: Language) -> String {
    source_code(method, language).unwrap()
}

/// The methods that this language has, each with its name in it.
fn in_language(
    language: Language,
) -> impl Iterator<Item = (&'static Method, &'static MethodSource, String)> {
    let has = move |(method, _): &(&Method, _)| source_code(method, language).is_ok();
    sources().filter(has).map(|(method, source)| (method, source, method.id.replace('-', "_")))
}

fn pascal(snake: &str) -> String {
    let capital = |word: &str| word[..1].to_uppercase() + &word[1..];
    snake.split('_').map(capital).collect()
}

pub(crate) fn rust() -> String {
    let mut text = String::new();
    let mut calls = String::new();
    for (method, source, name) in in_language(Language::Rust) {
        let printed = printed(method, Language::Rust);
        writeln!(text, "mod {name} {{\n{printed}}}").unwrap();
        let (memory, given) = match source.has_memory() {
            true => {
                (format!("let mut m = {name}::{}Memory::default();", pascal(&name)), "&mut m, ")
            }
            false => (String::new(), ""),
        };
        let more = arguments(source, "|x, v| a(k, x, v)");
        writeln!(
            calls,
            "let (mut x, mut v) = ({:?}, {:?}); {memory} for n in 0..{STEPS} {{ let h = {LENGTHS:?}[2 * n / {STEPS}]; \
             let t = n as f64 * h + h; (x, v) = {name}::{name}({given}x, v, h{more}); _ = t; println!(\"{} {{k}} \
             {{:016x}} {{:016x}}\", x.to_bits(), v.to_bits()); }}",
            START[0], START[1], method.id
        )
        .unwrap();
    }
    let forces = FORCES.map(|force| force.text);
    let [first, second, third] = forces;
    format!(
        "{text}\nfn a(k: u32, x: f64, v: f64) -> f64 {{ match k {{ 0 => {first}, 1 => {second}, _ => {third} }} }}\n\
         fn main() {{ for k in 0..3 {{\n{calls}}} }}\n"
    )
}

pub(crate) fn c() -> String {
    let mut text = String::from("#include <stdio.h>\n#include <string.h>\n");
    let mut calls = String::new();
    for (method, source, name) in in_language(Language::C) {
        text.push_str(&printed(method, Language::C));
        let (memory, given) = match source.has_memory() {
            true => (format!("{name}_memory m = {}_START;", name.to_uppercase()), "&m, "),
            false => (String::new(), ""),
        };
        let more = arguments(source, "a");
        let user = if takes_function(source) { ", &k" } else { "" };
        writeln!(
            calls,
            "{{ double x = {:?}, v = {:?}; {memory} for (int n = 0; n < {STEPS}; n++) {{ const double h = lengths[2 * n \
             / {STEPS}]; const double t = n * h + h; {name}({given}&x, &v, h{more}{user}); (void)t; show(\"{}\", k, x, \
             v); }} }}",
            START[0], START[1], method.id
        )
        .unwrap();
    }
    let [first, second, third] = FORCES.map(|force| force.text);
    let [long, short] = LENGTHS;
    format!(
        "{text}
static double a(double x, double v, void *user)
{{
    switch (*(int *)user) {{ case 0: return {first}; case 1: return {second}; default: return {third}; }}
}}
static void show(const char *id, int k, double x, double v)
{{
    unsigned long long bits[2];
    memcpy(&bits[0], &x, 8);
    memcpy(&bits[1], &v, 8);
    printf(\"%s %d %016llx %016llx\\n\", id, k, bits[0], bits[1]);
}}
int main(void)
{{
    const double lengths[2] = {{ {long:?}, {short:?} }};
    for (int k = 0; k < 3; k++) {{
{calls}    }}
    return 0;
}}
"
    )
}

pub(crate) fn c_sharp() -> String {
    let mut text = String::from("using System;\n");
    let mut calls = String::new();
    for (method, source, name) in in_language(Language::CSharp) {
        // The file has one `using` at its head.
        text.push_str(&printed(method, Language::CSharp).replace("using System;\n", ""));
        let class = pascal(&name);
        let (memory, given) = match source.has_memory() {
            true => (format!("var m = new {class}.Memory();"), "m, "),
            false => (String::new(), ""),
        };
        let more = arguments(source, "a");
        writeln!(
            calls,
            "{{ double x = {:?}, v = {:?}; {memory} for (int n = 0; n < {STEPS}; n++) {{ double h = lengths[2 * n / \
             {STEPS}]; double t = n * h + h; {class}.Step({given}ref x, ref v, h{more}); Show(\"{}\", k, x, v + 0.0 * t); }} \
             }}",
            START[0], START[1], method.id
        )
        .unwrap();
    }
    let [first, second, third] = FORCES.map(|force| force.text);
    let [long, short] = LENGTHS;
    format!(
        "{text}
public static class Driver
{{
    static void Show(string id, int k, double x, double v)
    {{
        Console.WriteLine(\"{{0}} {{1}} {{2:x16}} {{3:x16}}\", id, k, BitConverter.DoubleToInt64Bits(x),
            BitConverter.DoubleToInt64Bits(v));
    }}
    public static void Main()
    {{
        double[] lengths = {{ {long:?}, {short:?} }};
        for (int number = 0; number < 3; number++) {{
            int k = number;
            Func<double, double, double> a = (x, v) => k == 0 ? {first} : k == 1 ? {second} : {third};
            Run(k, a, lengths);
        }}
    }}
    static void Run(int k, Func<double, double, double> a, double[] lengths)
    {{
{calls}    }}
}}
"
    )
}
