//! The printed code of the loops matches the loops of the tables, frame by frame, in each language.

use std::fmt::Write as _;
use std::fs;
use std::io::Write as _;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::sync::Arc;

use regatta::loops::{ENGINES, POLICIES, Pacer, PolicyCard, RefreshRate, TimeBase, own_loop};
use regatta::tools::source_code::{Language, loop_code};

use crate::compilers::{build_folder, compile, rustc};

/// The rates of a loop.
#[derive(Clone, Copy, Debug)]
struct Rates {
    tick_hz: u32,
    /// The display's as a fraction in Hz.
    refresh_hz: [u32; 2],
}

/// At 49 ticks and 59.94 Hz hardly a number is round.
const RATES: [Rates; 3] = [
    Rates { tick_hz: 60, refresh_hz: [60, 1] },
    Rates { tick_hz: 60, refresh_hz: [144, 1] },
    Rates { tick_hz: 49, refresh_hz: [2997, 50] },
];

impl Rates {
    fn refresh(self) -> RefreshRate {
        let [numerator, denominator] = self.refresh_hz;
        RefreshRate::new(numerator, denominator)
    }

    fn base(self) -> TimeBase {
        TimeBase::new(self.tick_hz, self.refresh())
    }
}

/// The result of a loop in a frame.
#[derive(Clone, Copy, Debug)]
struct Answer {
    steps: u32,
    /// The length of each step; 0 without one.
    step_s: f64,
    /// The moment that the picture shows.
    shown_s: f64,
}

/// The durations of three traces: a steady display with a noisy timer, one with hitches, and frames of any length.
fn traces(rates: Rates) -> [Vec<i64>; 3] {
    let refresh = rates.refresh();
    let mut seed = 0x9E37_79B9_7F4A_7C15_u64;
    let mut within = move |least: i64, most: i64| {
        seed ^= seed << 13;
        seed ^= seed >> 7;
        seed ^= seed << 17;
        least + ((seed >> 32) % (most - least + 1) as u64) as i64
    };
    let mut durations = |hitch: i64, noise: i64| {
        let (mut before, mut late) = (0, 0);
        let each = |n| {
            late += if n % 97 == 96 { hitch } else { 0 };
            let began = refresh.refresh_ns(n) + late + within(-noise, noise);
            let duration = began - before;
            before = began;
            duration
        };
        (1..=3000).map(each).collect::<Vec<_>>()
    };
    let (steady, hitches) = (durations(0, 300_000), durations(70_000_000, 100_000));
    let any = |i| match i % 83 {
        0 => 10_000_000_000,
        1..=20 => 0,
        21 => -5_000_000,
        22 => 251_000_000,
        23..=26 => within(120_000_000, 180_000_000),
        _ => within(0, 40_000_000),
    };
    [steady, hitches, (0..3000).map(any).collect()]
}

/// The results of the loop in the table.
fn known(card: &Arc<PolicyCard>, rates: Rates, trace: &[i64]) -> Vec<Answer> {
    let base = rates.base();
    let mut pacer = Pacer::new(card, base);
    let each = |&duration_ns: &i64| {
        let steps = pacer.frame(duration_ns);
        let step_s = base.seconds(steps.span) / f64::from(steps.count.max(1));
        // Of an engine, the time that it has made: its own tick is not that of the base.
        let shown = if card.engine.is_some() { pacer.simulated() } else { pacer.drawn_moment() };
        Answer { steps: steps.count, step_s, shown_s: base.seconds(shown) }
    };
    trace.iter().map(each).collect()
}

/// Checks printed code's answers against the table's loop.
fn same(card: &Arc<PolicyCard>, rates: Rates, trace: &[i64], found: &[Answer]) {
    // Seconds are rounded, and nanoseconds too where a step is divided or counted in them. The errors add up, except
    // for the debt that `median` repays.
    let (step_s, total_s) = match &*card.id {
        "median" => (2e-8, 2e-7),
        "clamped-variable" => (1e-9, 1e-9 * trace.len() as f64),
        _ if card.engine.is_some() => (1e-9, 1e-6),
        _ => (1e-12, 1e-9),
    };
    let known = known(card, rates, trace);
    assert_eq!(known.len(), found.len(), "{}", card.id);
    for (n, (known, found)) in known.iter().zip(found).enumerate() {
        let same = known.steps == found.steps
            && (known.step_s - found.step_s).abs() <= step_s
            && (known.shown_s - found.shown_s).abs() <= total_s;
        assert!(same, "{} at {rates:?}, frame {n}: {found:?}, not {known:?}", card.id);
    }
}

/// A language whose compiler or interpreter runs the printed loops.
struct Driver {
    language: Language,
    file: &'static str,
    /// A loop with its runs. `NAME` is a name for it, `CODE` its code, `NEW` what it is made for, `TIME` the duration
    /// of the last frame, `SHOWN` what takes the moment to draw, and `WHEN` whether it runs on every trace.
    each: &'static str,
    /// The program, with all loops at `LOOPS` and their calls at `CALLS`.
    whole: &'static str,
    call: &'static str,
    shown: &'static str,
}

/// The trace of the engines' loops, of which each sum of rounded steps is long.
const ENGINE_TRACE: [usize; 2] = [0, 1];

/// Lines of a person, with names that are words of the languages and of the code around the lines.
const ODD: &str = "# Falls and gets up.
memory frame = 0
memory self = 1
memory end = 0
memory past[3] = 1
const user = 10
let function = 3

frame += dt
if frame < 0 {
  # There is nothing to do.
  stay
}
if frame > 1000 {
  dropped = 5
}
while frame >= user {
  frame -= user * self
  tick 1 of user
}
past[end] = round(frame)
end += 0.5
if end >= function {
  end = 0
  if past[1] > 4 { stay } else { tick 1 of user }
}
tick floor(past[floor(end)] / 4) of user
if frame > 5 { show frame / user }
";

fn cards() -> impl Iterator<Item = Arc<PolicyCard>> {
    let odd = own_loop("odd", ODD).unwrap();
    POLICIES.iter().chain(ENGINES.iter()).cloned().chain([odd])
}

impl Driver {
    /// Returns a program that reads traces, and prints the ticks of a frame, the length of the last, the time of all so
    /// far and the moment to draw.
    fn program(&self) -> String {
        let (mut loops, mut calls) = (String::new(), String::new());
        for card in cards() {
            let code = loop_code(&card.id, card.lines().unwrap(), self.language).unwrap();
            let says = |words: &str| code.contains(words);
            let mut rates = Vec::new();
            if says(" tick_hz: ") {
                rates.push("tick_hz");
            }
            if says(" refreshes, seconds: ") {
                rates.extend(["refreshes", "seconds"]);
            }
            if says(" cost_ms: ") {
                rates.push("0.0");
            }
            let name = card.id.replace('-', "_");
            let time = if says("nanoseconds.") { "ns" } else { "ns / 1e6" };
            let when = if card.engine.is_some() { "engines" } else { "1" };
            let filled = |template: &str| {
                let shown = if says("The moment is") { self.shown } else { "" };
                let parts = [("NAME", &*name), ("NEW", &rates.join(", ")), ("TIME", time)];
                let parts = parts.into_iter().chain([("WHEN", when), ("SHOWN", shown)]);
                let filled =
                    parts.fold(template.to_owned(), |text, (part, with)| text.replace(part, with));
                filled.replace("CODE", &code)
            };
            writeln!(loops, "{}", filled(self.each)).unwrap();
            writeln!(calls, "{}", filled(self.call)).unwrap();
        }
        self.whole.replace("LOOPS", &loops).replace("CALLS", &calls)
    }

    fn written(&self, folder: &str) -> PathBuf {
        let path = build_folder(&format!("loops-{folder}")).join(self.file);
        fs::write(&path, self.program()).unwrap();
        path
    }

    /// Compares every loop on every trace with the tables.
    fn matches(&self, program: &mut Command) {
        let mut given = String::new();
        for (n, rates) in RATES.into_iter().enumerate() {
            for (m, trace) in traces(rates).iter().enumerate() {
                let [refreshes, seconds] = rates.refresh_hz;
                let engines = u8::from([n, m] == ENGINE_TRACE);
                writeln!(
                    given,
                    "{} {refreshes} {seconds} {engines} {}",
                    rates.tick_hz,
                    trace.len()
                )
                .unwrap();
                trace.iter().for_each(|ns| writeln!(given, "{ns}").unwrap());
            }
        }
        let mut child = program.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
        let mut stdin = child.stdin.take().unwrap();
        let writer = std::thread::spawn(move || stdin.write_all(given.as_bytes()).unwrap());
        let output = child.wait_with_output().unwrap();
        writer.join().unwrap();
        assert!(output.status.success(), "{:?}", output.status);
        let text = String::from_utf8(output.stdout).unwrap();
        let mut lines = text.lines();
        for (n, rates) in RATES.into_iter().enumerate() {
            for (m, trace) in traces(rates).iter().enumerate() {
                for card in cards().filter(|card| card.engine.is_none() || [n, m] == ENGINE_TRACE) {
                    let tick_s = 1.0 / f64::from(rates.tick_hz);
                    let tick_s = if card.engine.is_some() { 0.0 } else { tick_s };
                    let answers = lines.by_ref().take(trace.len()).map(|line| answer(line, tick_s));
                    same(&card, rates, trace, &answers.collect::<Vec<_>>());
                }
            }
        }
        assert_eq!(lines.next(), None);
    }
}

/// The result on a line, which has the moment to draw as a part of a tick.
fn answer(line: &str, tick_s: f64) -> Answer {
    let mut words = line.split(' ');
    let mut number = || words.next().unwrap().parse::<f64>().unwrap();
    let (steps, step_s, made_s) = (number() as u32, number(), number());
    Answer { steps, step_s, shown_s: made_s + (number() - 1.0) * tick_s }
}

pub(crate) fn the_rust_loops_match_the_tables() {
    let driver = Driver {
        language: Language::Rust,
        file: "driver.rs",
        each: "pub mod NAME {\nCODE}\n",
        call: "if WHEN == 1 {\nlet mut game_loop = NAME::GameLoop::new(NEW);\nlet mut made = 0.0;\n\
               for &ns in &durations {\nlet (mut count, mut last, mut shown) = (0, 0.0, 1.0);\n\
               SHOWNgame_loop.frame(TIME, |s| { count += 1; last = s; made += s; });\n\
               let _ = writeln!(out, \"{count} {last:?} {made:?} {shown:?}\");\n}\n}",
        shown: "shown = ",
        whole: "use std::io::{Read, Write};\nLOOPS\n#[allow(unused_mut, unused_assignments)]\nfn main() {\n\
                let mut text = String::new();\nstd::io::stdin().read_to_string(&mut text).unwrap();\n\
                let mut out = std::io::BufWriter::new(std::io::stdout());\n\
                let mut numbers = text.split_whitespace().map(|word| word.parse::<f64>().unwrap());\n\
                while let Some(tick_hz) = numbers.next() {\n\
                let mut number = || numbers.next().unwrap();\n\
                let (refreshes, seconds, engines, frames) = (number(), number(), number() as u32, number() as usize);\n\
                let durations: Vec<f64> = (0..frames).map(|_| number()).collect();\nCALLS\n}\n}\n",
    };
    let source = driver.written("rust");
    let program = source.with_extension("");
    compile(rustc().args(["-Dwarnings", "-o"]).arg(&program).arg(&source));
    driver.matches(&mut Command::new(program));
}

const C: Driver = Driver {
    language: Language::C,
    file: "driver.c",
    each: "#define game_loop NAME_type\n#define game_loop_new NAME_new\n#define game_loop_frame NAME_frame\n\
           #define loop_sign NAME_sign\n#define loop_remainder NAME_remainder\n#define loop_single NAME_single\n\
           CODE\n\
           static void NAME(double tick_hz, double refreshes, double seconds) {\n\
           (void)tick_hz; (void)refreshes; (void)seconds;\n\
           game_loop it = game_loop_new(NEW);\nstruct answer a = { 0, 0.0, 0.0 };\n\
           for (int n = 0; n < frames; n++) {\nconst double ns = durations[n];\ndouble shown = 1.0;\n\
           a.count = 0;\na.last = 0.0;\nSHOWNgame_loop_frame(&it, TIME, made, &a);\n\
           printf(\"%d %.17g %.17g %.17g\\n\", a.count, a.last, a.made, shown);\n}\n}\n\
           #undef game_loop\n#undef game_loop_new\n#undef game_loop_frame\n#undef loop_sign\n\
           #undef loop_remainder\n#undef loop_single\n",
    call: "if (WHEN == 1) NAME(tick_hz, refreshes, seconds);",
    shown: "shown = ",
    whole: "#include <stdio.h>\n#include <math.h>\nstruct answer { int count; double last, made; };\n\
            static double durations[10000];\nstatic int frames;\n\
            static void made(double seconds, void *user) {\nstruct answer *a = (struct answer *)user;\n\
            a->count++;\na->last = seconds;\na->made += seconds;\n}\nLOOPS\nint main(void) {\n\
            double tick_hz, refreshes, seconds;\nint engines;\n\
            while (scanf(\"%lf %lf %lf %d %d\", &tick_hz, &refreshes, &seconds, &engines, &frames) == 5) {\n\
            for (int n = 0; n < frames; n++) if (scanf(\"%lf\", &durations[n]) != 1) return 1;\nCALLS\n}\n\
            return 0;\n}\n",
};

const WARNINGS: [&str; 4] = ["-Wall", "-Wextra", "-pedantic", "-Werror"];

pub(crate) fn the_c_loops_match_the_tables() {
    let source = C.written("c");
    let program = source.with_extension("");
    let mut compiler = Command::new("cc");
    compiler.arg("-std=c99").args(WARNINGS).arg("-o").arg(&program).arg(&source).arg("-lm");
    compile(&mut compiler);
    C.matches(&mut Command::new(&program));
}

pub(crate) fn the_c_loops_are_valid_cpp() {
    let mut compiler = Command::new("c++");
    compiler.args(["-std=c++14", "-x", "c++", "-fsyntax-only"]).args(WARNINGS);
    compile(compiler.arg(C.written("cpp")));
}

pub(crate) fn the_c_sharp_loops_match_the_tables() {
    let driver = Driver {
        language: Language::CSharp,
        file: "driver.cs",
        each: "namespace In_NAME\n{\nCODE}\n",
        call: "if (WHEN == 1)\n{\nvar it = new In_NAME.GameLoop(NEW);\nmade = 0.0;\n\
               foreach (double ns in durations)\n{\nshown = 1.0;\ncount = 0;\nlast = 0.0;\n\
               SHOWNit.Frame(TIME, step);\nPrint();\n}\n}",
        shown: "shown = ",
        whole: "LOOPS\nstatic class Driver\n{\nstatic int count;\nstatic double last, made, shown;\n\
                static string Text(double number) { return number.ToString(\"R\", System.Globalization.CultureInfo.InvariantCulture); }\n\
                static void Print() { System.Console.Write(\"{0} {1} {2} {3}\\n\", count, Text(last), Text(made), Text(shown)); }\n\
                static void Main()\n{\n\
                var output = new System.IO.StreamWriter(System.Console.OpenStandardOutput());\n\
                System.Console.SetOut(output);\n\
                System.Action<double> step = s => { count += 1; last = s; made += s; };\nstring line;\n\
                while ((line = System.Console.ReadLine()) != null)\n{\nvar words = line.Split(' ');\n\
                double tick_hz = int.Parse(words[0]), refreshes = int.Parse(words[1]), seconds = int.Parse(words[2]);\n\
                int engines = int.Parse(words[3]);\nvar durations = new double[int.Parse(words[4])];\n\
                for (int n = 0; n < durations.Length; n++) durations[n] = long.Parse(System.Console.ReadLine());\n\
                CALLS\n}\noutput.Flush();\n}\n}\n",
    };
    let source = driver.written("cs");
    let program = source.with_extension("exe");
    let mut compiler = Command::new("mcs");
    compile(compiler.args(["-warnaserror", &format!("-out:{}", program.display())]).arg(&source));
    driver.matches(Command::new("mono").arg(&program));
}

pub(crate) fn the_javascript_loops_match_the_tables() {
    let driver = Driver {
        language: Language::JavaScript,
        file: "driver.js",
        each: "{\nCODE\nruns.push((out, tick_hz, refreshes, seconds, engines, durations) => {\n\
               if (WHEN !== 1) return;\nconst it = new GameLoop(NEW);\nlet made = 0;\n\
               for (const ns of durations) {\nlet count = 0, last = 0, shown = 1;\n\
               SHOWNit.frame(TIME, (s) => { count += 1; last = s; made += s; });\n\
               out.push(`${count} ${last} ${made} ${shown}`);\n}\n});\n}\n",
        call: "",
        shown: "shown = ",
        whole: "'use strict';\nconst runs = [];\nLOOPS\n\
                const words = require('fs').readFileSync(0, 'utf8').split(/\\s+/).map(Number);\n\
                let at = 0;\nconst out = [];\nwhile (at + 5 < words.length) {\n\
                const [tick_hz, refreshes, seconds, engines, frames] = words.slice(at, at + 5);\nat += 5;\n\
                const durations = words.slice(at, at + frames);\nat += frames;\n\
                for (const run of runs) run(out, tick_hz, refreshes, seconds, engines, durations);\n}\n\
                process.stdout.write(out.join('\\n') + '\\n');\n",
    };
    driver.matches(Command::new("node").arg(driver.written("js")));
}

pub(crate) fn the_lua_loops_match_the_tables() {
    let driver = Driver {
        language: Language::Lua,
        file: "driver.lua",
        each: "do\nCODE\nruns[#runs + 1] = function(tick_hz, refreshes, seconds, engines, durations)\n\
               if WHEN ~= 1 then return end\nlocal it, made = GameLoop.new(NEW), 0.0\n\
               for _, ns in ipairs(durations) do\nlocal count, last, shown = 0, 0.0, 1.0\n\
               SHOWNit:frame(TIME, function(s) count = count + 1 last = s made = made + s end)\n\
               io.write(string.format('%d %.17g %.17g %.17g\\n', count, last, made, shown))\nend\nend\nend\n",
        call: "",
        shown: "shown = ",
        whole: "local runs = {}\nLOOPS\nwhile true do\n\
                local tick_hz, refreshes, seconds, engines, frames = io.read('n', 'n', 'n', 'n', 'n')\n\
                if not frames then break end\nlocal durations = {}\n\
                for n = 1, frames do durations[n] = io.read('n') end\n\
                for _, run in ipairs(runs) do run(tick_hz, refreshes, seconds, engines, durations) end\nend\n",
    };
    driver.matches(Command::new("lua5.4").arg(driver.written("lua")));
}

pub(crate) fn every_loop_is_printed_in_gdscript_with_indented_blocks() {
    for card in cards() {
        let code = loop_code(&card.id, card.lines().unwrap(), Language::GdScript).unwrap();
        let lines: Vec<&str> = code.lines().filter(|line| !line.trim().is_empty()).collect();
        let depth = |line: &str| line.len() - line.trim_start_matches('\t').len();
        for pair in lines.windows(2).filter(|pair| !pair[0].trim_start().starts_with('#')) {
            let deeper = depth(pair[1]) > depth(pair[0]);
            assert_eq!(pair[0].ends_with(':'), deeper, "{}: {pair:?}", card.id);
        }
        assert!(code.contains("step.call("), "{code}");
        assert_eq!(code.matches("# Falls and gets up.").count(), usize::from(card.id == "odd"));
    }
}
