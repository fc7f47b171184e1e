//! Programs that step every method as it is printed: each prints `id case x v` for every step, the numbers as bits.

use std::fmt::Write as _;

use regatta::sim::integrators::Method;
use regatta::tools::source_code::{Language, MethodInput, MethodSource, Precision, source_code};

use super::known::{CASES, FORCE, FORCES, RATE, SETTINGS, STEPS, SUBSTEPS, TARGET, sources};

/// The argument for each input of a method in a call. A number is written with `suffix`.
fn arguments(source: &MethodSource, function: &str, suffix: &str) -> String {
    let cast = |number: String| match suffix {
        "f" => format!(", (float)({number})"),
        _ => format!(", ({number}){suffix}"),
    };
    let each = |input: &MethodInput<'_>| match input.name {
        "a" => format!(", {function}"),
        "target" => cast(TARGET.to_owned()),
        "rate" => cast(format!("{RATE:?}")),
        "stiffness" => cast(format!("{:?}", SETTINGS[0])),
        "damping" => cast(format!("{:?}", SETTINGS[1])),
        "drag" => cast(format!("{:?}", SETTINGS[2])),
        "force" => cast(format!("{FORCE:?}")),
        "substeps" => format!(", {SUBSTEPS}"),
        other => panic!("{other} is not known here"),
    };
    source.inputs().iter().map(each).collect()
}

fn takes_function(source: &MethodSource) -> bool {
    source.inputs().iter().any(|input| !input.arguments.is_empty())
}

/// The cases as the elements of an array: force, start and lengths.
fn cases() -> String {
    let each = |case: &super::known::Case| {
        let ([x, v], [a, b, c, d]) = (case.start, case.lengths);
        format!("{x:?}, {v:?}, {a:?}, {b:?}, {c:?}, {d:?}")
    };
    CASES.iter().map(each).collect::<Vec<_>>().join(", ")
}

/// The index of the force of each case.
fn forces() -> String {
    CASES.map(|case| case.force.to_string()).join(", ")
}

/// The methods that this language has, each with its name in it.
fn in_language(
    language: Language,
    precision: Precision,
) -> impl Iterator<Item = (&'static Method, MethodSource, String, String)> {
    sources().filter_map(move |(method, source)| {
        let printed = source_code(method, language, precision).ok()?;
        Some((method, source, method.id.replace('-', "_"), printed))
    })
}

fn pascal(snake: &str) -> String {
    let capital = |word: &str| word[..1].to_uppercase() + &word[1..];
    snake.split('_').map(capital).collect()
}

pub(crate) fn rust(precision: Precision) -> String {
    let (mut text, mut calls) = (String::new(), String::new());
    let number = if precision == Precision::Single { "f32" } else { "f64" };
    for (method, source, name, printed) in in_language(Language::Rust, precision) {
        writeln!(text, "mod {name} {{\n{printed}}}").unwrap();
        let (memory, given) = match source.has_memory() {
            true => {
                (format!("let mut m = {name}::{}Memory::default();", pascal(&name)), "&mut m, ")
            }
            false => (String::new(), ""),
        };
        let function = format!("|x, v| a(FORCES[k], x as f64, v as f64) as {number}");
        let more = arguments(&source, &function, &format!(" as {number}"));
        writeln!(
            calls,
            "let (mut x, mut v) = (c[0] as {number}, c[1] as {number}); {memory} for n in 0..{STEPS} {{ let h = c[2 + 4 * n / \
             {STEPS}]; let t = n as f64 * h + h; (x, v) = {name}::{name}({given}x, v, h as {number}{more}); _ = t; \
             println!(\"{} {{k}} {{:016x}} {{:016x}}\", (x as f64).to_bits(), (v as f64).to_bits()); }}",
            method.id
        )
        .unwrap();
    }
    let [first, second, third] = FORCES.map(|force| force.text);
    let (cases, forces, count) = (cases(), forces(), CASES.len());
    format!(
        "#![allow(unused_parens)]\n{text}\nconst FORCES: [u32; {count}] = [{forces}];\nconst CASES: [f64; 6 * {count}] = [{cases}];\n\
         fn a(k: u32, x: f64, v: f64) -> f64 {{ match k {{ 0 => {first}, 1 => {second}, _ => {third} }} }}\n\
         fn main() {{ for k in 0..{count} {{\nlet c = &CASES[6 * k..6 * k + 6];\n{calls}}} }}\n"
    )
}

pub(crate) fn c(precision: Precision) -> String {
    let mut text = String::from("#include <stdio.h>\n#include <string.h>\n");
    let mut calls = String::new();
    let (number, suffix) = match precision {
        Precision::Double => ("double", ""),
        Precision::Single => ("float", "f"),
    };
    for (method, source, name, printed) in in_language(Language::C, precision) {
        text.push_str(&printed);
        let (memory, given) = match source.has_memory() {
            true => (format!("{name}_memory m = {}_START;", name.to_uppercase()), "&m, "),
            false => (String::new(), ""),
        };
        let more = arguments(&source, "a", suffix);
        let user = if takes_function(&source) { ", &forces[k]" } else { "" };
        writeln!(
            calls,
            "{{ {number} x = ({number})c[0], v = ({number})c[1]; {memory} for (int n = 0; n < {STEPS}; n++) {{ const double h = c[2 \
             + 4 * n / {STEPS}]; const double t = n * h + h; {name}({given}&x, &v, ({number})h{more}{user}); (void)t; \
             show(\"{}\", k, (double)x, (double)v); }} }}",
            method.id
        )
        .unwrap();
    }
    let [first, second, third] = FORCES.map(|force| force.text);
    let (cases, forces, count) = (cases(), forces(), CASES.len());
    format!(
        "{text}
static double force(int k, double x, double v)
{{
    switch (k) {{ case 0: return {first}; case 1: return {second}; default: return {third}; }}
}}
static {number} a({number} x, {number} v, void *user)
{{
    return ({number})force(*(int *)user, (double)x, (double)v);
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
    const double cases[] = {{ {cases} }};
    int forces[] = {{ {forces} }};
    for (int k = 0; k < {count}; k++) {{
        const double *c = &cases[6 * k];
{calls}    }}
    return 0;
}}
"
    )
}

pub(crate) fn c_sharp(precision: Precision) -> String {
    let mut text = String::from("using System;\n");
    let mut calls = String::new();
    let (number, suffix) = match precision {
        Precision::Double => ("double", ""),
        Precision::Single => ("float", "f"),
    };
    for (method, source, name, printed) in in_language(Language::CSharp, precision) {
        // The file has one `using` at its head.
        text.push_str(&printed.replace("using System;\n", ""));
        let class = pascal(&name);
        let (memory, given) = match source.has_memory() {
            true => (format!("var m = new {class}.Memory();"), "m, "),
            false => (String::new(), ""),
        };
        let more = arguments(&source, "a", suffix);
        writeln!(
            calls,
            "{{ {number} x = ({number})c[0], v = ({number})c[1]; {memory} for (int n = 0; n < {STEPS}; n++) {{ double h = c[2 + 4 * \
             n / {STEPS}]; double t = n * h + h; {class}.Step({given}ref x, ref v, ({number})h{more}); Show(\"{}\", k, x, v + \
             0.0 * t); }} }}",
            method.id
        )
        .unwrap();
    }
    let [first, second, third] = FORCES.map(|force| force.text);
    let (cases, forces, count) = (cases(), forces(), CASES.len());
    format!(
        "{text}
public static class Driver
{{
    static void Show(string id, int k, double x, double v)
    {{
        Console.WriteLine(\"{{0}} {{1}} {{2:x16}} {{3:x16}}\", id, k, BitConverter.DoubleToInt64Bits(x),
            BitConverter.DoubleToInt64Bits(v));
    }}
    static double Force(int k, double x, double v)
    {{
        return k == 0 ? {first} : k == 1 ? {second} : {third};
    }}
    public static void Main()
    {{
        double[] cases = {{ {cases} }};
        int[] forces = {{ {forces} }};
        for (int number = 0; number < {count}; number++) {{
            int k = number;
            Func<{number}, {number}, {number}> a = (x, v) => ({number})Force(forces[k], x, v);
            double[] c = new double[6];
            Array.Copy(cases, 6 * k, c, 0, 6);
            Run(k, a, c);
        }}
    }}
    static void Run(int k, Func<{number}, {number}, {number}> a, double[] c)
    {{
{calls}    }}
}}
"
    )
}
