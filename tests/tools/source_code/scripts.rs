//! The methods, rules and words in JavaScript and Lua, run as scripts and held to the bits of the methods.

use std::fmt::Write as _;
use std::fs;
use std::process::Command;

use regatta::tools::source_code::{Language, MethodInput, Precision, source_code};

use super::compiled::{printed, same};
use super::known::{CASES, FORCE, FORCES, RATE, SETTINGS, STEPS, SUBSTEPS, TARGET, sources};
use super::words;
use crate::compilers::build_folder;
use crate::rules::{self, FPS, FRAMES, LINEAR, PARTS, START, STEPPED};

/// A language without a compiler.
struct Script {
    language: Language,
    interpreter: &'static str,
    file: &'static str,
    /// Prints the words in a line, and the bits of two numbers after them.
    show: &'static str,
    /// A function of the case and its numbers, appended to `runs`, with `BODY` in it.
    run: &'static str,
    /// One step that replaces `x` and `v`.
    step: &'static str,
    variable: &'static str,
    /// A loop of `n` from 0 up to `COUNT`, with `BODY` in it.
    repeat: &'static str,
    list: [&'static str; 2],
    /// Calls every run for the numbers of `cases`, in pieces of `SIZE`.
    all: &'static str,
}

const JAVASCRIPT: Script = Script {
    language: Language::JavaScript,
    interpreter: "node",
    file: "driver.js",
    show: "'use strict';\nconst view = new DataView(new ArrayBuffer(8));\n\
           function bits(x) { view.setFloat64(0, x); return view.getBigUint64(0).toString(16).padStart(16, '0'); }\n\
           function show(words, x, v) { console.log(`${words}${bits(x)} ${bits(v)}`); }\n\
           const runs = [];\n",
    run: "{\nCODE\nruns.push((k, c) => {\nBODY\n});\n}\n",
    step: "[x, v] = CALL;",
    variable: "let NAME = VALUE;",
    repeat: "for (let n = 0; n < COUNT; n++) {\nBODY\n}",
    list: ["[", "]"],
    all: "for (let k = 0; k < cases.length / SIZE; k++) { for (const run of runs) run(k, cases.slice(SIZE * k, SIZE * k + SIZE)); }\n",
};

const LUA: Script = Script {
    language: Language::Lua,
    interpreter: "lua5.4",
    file: "driver.lua",
    show: "local function bits(x) return string.format('%016x', string.unpack('<i8', string.pack('<d', x))) end\n\
           local function show(words, x, v) print(words .. bits(x) .. ' ' .. bits(v)) end\n\
           local runs = {}\n",
    run: "do\nCODE\nruns[#runs + 1] = function(k, c)\nBODY\nend\nend\n",
    step: "x, v = CALL",
    variable: "local NAME = VALUE",
    repeat: "for n = 0, COUNT - 1 do\nBODY\nend",
    list: ["{", "}"],
    all: "for k = 0, #cases // SIZE - 1 do local c = {} for i = 1, SIZE do c[i - 1] = cases[SIZE * k + i] end \
          for _, run in ipairs(runs) do run(k, c) end end\n",
};

impl Script {
    /// Returns the name of a function whose name in lower case with underscores is `snake`.
    fn name(&self, snake: &str) -> String {
        let mut parts = snake.split('_');
        match self.language {
            Language::Lua => snake.to_owned(),
            _ => {
                let first = parts.next().unwrap_or_default().to_owned();
                let capital = |part: &str| part[..1].to_uppercase() + &part[1..];
                parts.fold(first, |name, part| name + &capital(part))
            }
        }
    }

    fn declared(&self, name: &str, value: &str) -> String {
        self.variable.replace("NAME", name).replace("VALUE", value) + "\n"
    }

    /// Returns `count` steps by a function of this name.
    fn steps(&self, count: &str, call: &str, shown: &str) -> String {
        let step = self.step.replace("CALL", call);
        self.repeat.replace("COUNT", count).replace("BODY", &format!("{step}\n{shown}"))
    }

    fn whole(&self, code: &str, cases: &[f64], size: usize) -> String {
        let [open, close] = self.list;
        let cases: Vec<String> = cases.iter().map(|number| format!("{number:?}")).collect();
        let cases = self.declared("cases", &format!("{open}{}{close}", cases.join(", ")));
        format!("{}{code}{cases}{}", self.show, self.all.replace("SIZE", &size.to_string()))
    }

    /// Writes the driver to a file, and returns the command that runs it.
    fn command(&self, folder: &str, driver: &str) -> Command {
        let file = build_folder(&format!("{folder}-{}", self.language.id())).join(self.file);
        fs::write(&file, driver).unwrap();
        let mut command = Command::new(self.interpreter);
        command.arg(file);
        command
    }
}

/// Returns runs of every method in a language, of which each line is `id case x v`.
fn methods(script: &Script) -> String {
    let mut code = String::new();
    for (method, source) in sources() {
        let Ok(text) = source_code(method, script.language, Precision::Double) else { continue };
        let snake = method.id.replace('-', "_");
        let argument = |input: &MethodInput<'_>| match input.name {
            "a" => ", a".to_owned(),
            "target" => format!(", {TARGET}"),
            "rate" => format!(", {RATE:?}"),
            "stiffness" => format!(", {:?}", SETTINGS[0]),
            "damping" => format!(", {:?}", SETTINGS[1]),
            "drag" => format!(", {:?}", SETTINGS[2]),
            "force" => format!(", {FORCE:?}"),
            "substeps" => format!(", {SUBSTEPS}"),
            other => panic!("{other} is not known here"),
        };
        let more: String = source.inputs().iter().map(argument).collect();
        let mut body = script.declared("x", "c[0]") + &script.declared("v", "c[1]");
        let memory = if source.has_memory() { "m, " } else { "" };
        if source.has_memory() {
            body +=
                &script.declared("m", &format!("{}()", script.name(&format!("{snake}_memory"))));
        }
        let forces = FORCES.map(|force| force.text);
        let (floor, t) = match script.language {
            Language::Lua => ("(4 * n // STEPS)".to_owned(), "local t = n * h + h"),
            _ => ("Math.floor(4 * n / STEPS)".to_owned(), "const t = n * h + h;"),
        };
        let floor = floor.replace("STEPS", &STEPS.to_string());
        let name = script.name(&snake);
        let call = format!("{name}({memory}x, v, h{more})");
        let words = match script.language {
            Language::Lua => format!("'{} ' .. k .. ' '", method.id),
            _ => format!("`{} ${{k}} `", method.id),
        };
        let [h, step] =
            [script.declared("h", &format!("c[2 + {floor}]")), script.step.replace("CALL", &call)];
        let inner = format!("{h}{t}\n{step}\nshow({words}, x, v)");
        let force = match script.language {
            Language::Lua => format!(
                "local function a(x, v) if forces[k + 1] == 0 then return {} elseif forces[k + 1] == 1 then return {} end return {} end\n",
                forces[0], forces[1], forces[2]
            ),
            _ => format!(
                "const a = (x, v) => forces[k] === 0 ? {} : forces[k] === 1 ? {} : {};\n",
                forces[0], forces[1], forces[2]
            ),
        };
        let uses = if more.contains(", a") { force } else { String::new() };
        body += &uses;
        body += &script.repeat.replace("COUNT", &STEPS.to_string()).replace("BODY", &inner);
        code += &script.run.replace("CODE", &text).replace("BODY", &body);
    }
    let [open, close] = script.list;
    let forces = CASES.map(|case| case.force.to_string()).join(", ");
    let forces = script.declared("forces", &format!("{open}{forces}{close}"));
    let numbers: Vec<f64> =
        CASES.iter().flat_map(|case| case.start.into_iter().chain(case.lengths)).collect();
    script.whole(&(forces + &code), &numbers, 6)
}

fn match_the_methods(script: &Script) {
    let mut command = script.command("methods", &methods(script));
    same(script.language, Precision::Double, &printed(&mut command));
}

pub(crate) fn printed_javascript_matches_the_methods() {
    match_the_methods(&JAVASCRIPT);
}

pub(crate) fn printed_lua_matches_the_methods() {
    match_the_methods(&LUA);
}

fn match_their_rule(script: &Script) {
    let mut code = String::new();
    for rule in LINEAR.iter().chain(&STEPPED) {
        let text = rules::code(rule, script.language).text;
        let maker = format!("{}()", script.name("rule_memory"));
        let has_memory = text.contains(&maker);
        let target = if text.contains("target)") { ", TARGET" } else { "" };
        let given = if has_memory { "m, " } else { "" };
        let mut body: String = [("x", START[0]), ("v", START[1])]
            .map(|(name, start)| script.declared(name, &format!("{start:?}")))
            .concat();
        if has_memory {
            body += &script.declared("m", &maker);
        }
        let call = format!("rule({given}x, v, c[0]{target})");
        body += &script.steps("c[1]", &call, "show('', x, v)");
        code += &script.run.replace("CODE", &text).replace("BODY", &body);
    }
    let numbers = PARTS.map(|part| [part / FPS, (FRAMES as f64 / part).floor()]).concat();
    let target = script.declared("TARGET", &format!("{:?}", rules::TARGET));
    let driver = script.whole(&(target + &code), &numbers, 2);
    rules::hold(&mut script.command("rules", &driver));
}

pub(crate) fn printed_javascript_matches_its_rule_at_every_frame_rate() {
    match_their_rule(&JAVASCRIPT);
}

pub(crate) fn printed_lua_matches_its_rule_at_every_frame_rate() {
    match_their_rule(&LUA);
}

fn rename_words(script: &Script) {
    let mut code = String::new();
    for rule in words::rules() {
        let text = words::code(&rule, script.language);
        let has_memory = text.contains(&format!("{}()", script.name("rule_memory")));
        let given =
            if has_memory { format!("{}(), ", script.name("rule_memory")) } else { String::new() };
        let mut body = script.declared("x", "0.5") + &script.declared("v", "0.0");
        body += &script.steps("3", &format!("rule({given}x, v, 0.02, 1.0)"), "");
        writeln!(body, "\nshow('', x, v)").unwrap();
        code += &script.run.replace("CODE", &text).replace("BODY", &body);
    }
    let driver = script.whole(&code, &[0.0], 1);
    let lines = printed(&mut script.command("words", &driver));
    assert_eq!(lines.lines().count(), words::rules().len(), "{lines}");
}

pub(crate) fn words_of_javascript_are_renamed_in_it_and_run() {
    rename_words(&JAVASCRIPT);
}

pub(crate) fn words_of_lua_are_renamed_in_it_and_run() {
    rename_words(&LUA);
}

pub(crate) fn functions_that_lua_lacks_are_written_out_exactly() {
    let script = &LUA;
    let rule = "v = tanh(x) + sinh(x) * 0.1 + cosh(x) * 0.1\nx += 0.37 * v * abs(v)";
    let text = rules::code(rule, Language::Lua).text;
    let mut body = String::new();
    for x in [-30.0, -2.0, -0.51, -0.49, -1e-9, 0.0, 1e-9, 0.3, 0.5, 5.0] {
        writeln!(body, "show('', rule_sinh({x:?}), rule_tanh({x:?}))").unwrap();
    }
    let code = script.run.replace("CODE", &text).replace("BODY", &body);
    let driver = script.whole(&code, &[0.0], 1);
    let lines = printed(&mut script.command("hyperbolic", &driver));
    let number = |word: &str| f64::from_bits(u64::from_str_radix(word, 16).unwrap());
    for (line, x) in
        lines.lines().zip([-30.0, -2.0, -0.51, -0.49, -1e-9, 0.0, 1e-9, 0.3, 0.5, 5.0_f64])
    {
        let (sinh, tanh) = line.split_once(' ').unwrap();
        for (found, exact) in [(number(sinh), x.sinh()), (number(tanh), x.tanh())] {
            assert!((found - exact).abs() <= 1e-15 * exact.abs(), "{x}: {found} for {exact}");
        }
    }
    assert_eq!(lines.lines().count(), 10);
}
