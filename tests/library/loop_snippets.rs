//! The code snippets of the loops match the loops of the table, frame by frame, in each language.
#![expect(unreachable_pub, reason = "the sources are compiled as they are given away")]

use std::collections::BTreeSet;
use std::fs;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::compilers::{build_folder, compiled_or_skip};
use regatta::loops::{POLICIES, Pacer, PolicyCard, RefreshRate, TimeBase, policy};

#[path = "../../assets/loops/clamped-variable.rs"]
pub mod clamped_variable;
#[path = "../../assets/loops/fixed.rs"]
pub mod fixed;
#[path = "../../assets/loops/fixed-extrapolated.rs"]
pub mod fixed_extrapolated;
#[path = "../../assets/loops/fixed-hermite.rs"]
pub mod fixed_hermite;
#[path = "../../assets/loops/fixed-linear.rs"]
pub mod fixed_linear;
#[path = "../../assets/loops/hysteresis.rs"]
pub mod hysteresis;
#[path = "../../assets/loops/lockstep.rs"]
pub mod lockstep;
#[path = "../../assets/loops/median.rs"]
pub mod median;
#[path = "../../assets/loops/render-tick.rs"]
pub mod render_tick;
#[path = "../../assets/loops/semi-fixed.rs"]
pub mod semi_fixed;
#[path = "../../assets/loops/slow-down.rs"]
pub mod slow_down;
#[path = "../../assets/loops/snapped.rs"]
pub mod snapped;
#[path = "../../assets/loops/variable.rs"]
pub mod variable;
#[path = "../../assets/loops/whole-refresh.rs"]
pub mod whole_refresh;

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

    fn tick_s(self) -> f64 {
        1.0 / f64::from(self.tick_hz)
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
fn known(card: &'static PolicyCard, rates: Rates, trace: &[i64]) -> Vec<Answer> {
    let base = rates.base();
    let mut pacer = Pacer::new(card, base);
    let each = |&duration_ns: &i64| {
        let steps = pacer.frame(duration_ns);
        let step_s = base.seconds(steps.span) / f64::from(steps.count.max(1));
        Answer { steps: steps.count, step_s, shown_s: base.seconds(pacer.drawn_moment()) }
    };
    trace.iter().map(each).collect()
}

/// The results of a snippet with ticks. `shown` draws a motion of one per second from the time of the last tick.
fn whole_ticks<L>(
    rates: Rates,
    trace: &[i64],
    mut game_loop: L,
    frame: fn(&mut L, i64) -> i64,
    shown: impl Fn(&L, f64) -> f64,
) -> Vec<Answer> {
    let tick_s = rates.tick_s();
    let mut ticks = 0;
    let each = |&duration_ns: &i64| {
        let steps = frame(&mut game_loop, duration_ns);
        ticks += steps;
        let shown_s = shown(&game_loop, ticks as f64 * tick_s);
        Answer { steps: steps as u32, step_s: if steps > 0 { tick_s } else { 0.0 }, shown_s }
    };
    trace.iter().map(each).collect()
}

/// The results of a snippet with steps of any length; `frame` gives their number and the length of each.
fn any_steps(trace: &[i64], mut frame: impl FnMut(i64) -> (i64, f64)) -> Vec<Answer> {
    let mut shown_s = 0.0;
    let each = |&duration_ns: &i64| {
        let (steps, step_s) = frame(duration_ns);
        shown_s += steps as f64 * step_s;
        Answer { steps: steps as u32, step_s, shown_s }
    };
    trace.iter().map(each).collect()
}

fn one_step(trace: &[i64], mut frame: impl FnMut(i64) -> f64) -> Vec<Answer> {
    any_steps(trace, |duration_ns| {
        let step_s = frame(duration_ns);
        (i64::from(step_s > 0.0), step_s)
    })
}

/// The results of the Rust snippet with this id.
fn in_rust(id: &str, rates: Rates, trace: &[i64]) -> Vec<Answer> {
    let Rates { tick_hz, refresh_hz } = rates;
    let tick_s = rates.tick_s();
    let refresh_ns = 1_000_000_000 * i64::from(refresh_hz[1]) / i64::from(refresh_hz[0]);
    match id {
        "variable" => one_step(trace, variable::frame),
        "lockstep" => one_step(trace, |_| lockstep::frame(tick_hz)),
        "clamped-variable" => one_step(trace, clamped_variable::frame),
        "semi-fixed" => any_steps(trace, |duration_ns| semi_fixed::frame(duration_ns, tick_hz)),
        "fixed" => whole_ticks(
            rates,
            trace,
            fixed::GameLoop::new(tick_hz),
            fixed::GameLoop::frame,
            |_, t| t,
        ),
        "fixed-linear" => {
            use fixed_linear::GameLoop;
            let shown = |game_loop: &GameLoop, t| game_loop.drawn(t - tick_s, t);
            whole_ticks(rates, trace, GameLoop::new(tick_hz), GameLoop::frame, shown)
        }
        "fixed-hermite" => {
            use fixed_hermite::GameLoop;
            let shown = |game_loop: &GameLoop, t| game_loop.drawn([t - tick_s, t], [1.0; 2]);
            whole_ticks(rates, trace, GameLoop::new(tick_hz), GameLoop::frame, shown)
        }
        "fixed-extrapolated" => {
            use fixed_extrapolated::GameLoop;
            let shown = |game_loop: &GameLoop, t| game_loop.drawn(t, 1.0);
            whole_ticks(rates, trace, GameLoop::new(tick_hz), GameLoop::frame, shown)
        }
        "render-tick" => {
            use render_tick::GameLoop;
            let shown = |game_loop: &GameLoop, t| t + game_loop.owed_s();
            whole_ticks(rates, trace, GameLoop::new(tick_hz), GameLoop::frame, shown)
        }
        "snapped" => {
            use snapped::GameLoop;
            let shown = |game_loop: &GameLoop, t| game_loop.drawn(t - tick_s, t);
            whole_ticks(rates, trace, GameLoop::new(tick_hz, refresh_hz), GameLoop::frame, shown)
        }
        "whole-refresh" => {
            use whole_refresh::GameLoop;
            let shown = |game_loop: &GameLoop, t| game_loop.drawn(t - tick_s, t);
            whole_ticks(rates, trace, GameLoop::new(tick_hz, refresh_hz), GameLoop::frame, shown)
        }
        "hysteresis" => {
            use hysteresis::GameLoop;
            whole_ticks(rates, trace, GameLoop::new(tick_hz), GameLoop::frame, |_, t| t)
        }
        "median" => {
            let mut game_loop = median::GameLoop::new(refresh_ns);
            one_step(trace, |duration_ns| game_loop.frame(duration_ns))
        }
        "slow-down" => {
            use slow_down::GameLoop;
            whole_ticks(rates, trace, GameLoop::new(tick_hz), GameLoop::frame, |_, t| t)
        }
        other => panic!("{other} has no Rust snippet here"),
    }
}

/// Checks a snippet's answers against the table's loop.
fn same(card: &'static PolicyCard, rates: Rates, trace: &[i64], found: &[Answer]) {
    // Seconds are rounded, and nanoseconds too where a step is divided. The errors add up, except for the debt that
    // `median` repays.
    let (step_s, total_s) = match card.id {
        "median" => (2e-8, 2e-7),
        "clamped-variable" => (1e-9, 1e-9 * trace.len() as f64),
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

#[test]
fn every_snippet_file_is_used_and_every_card_has_one_in_rust() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/loops");
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let files = files.filter(|path| path.extension().unwrap() != "loop");
    let files: BTreeSet<_> = files
        .map(|path| {
            let name = path.file_name().unwrap().to_str().unwrap().to_string();
            (name, fs::read_to_string(path).unwrap())
        })
        .collect();
    let mut listed = BTreeSet::new();
    for card in POLICIES.iter() {
        assert_eq!(card.snippets[0].language, "rust", "{}", card.id);
        for snippet in card.snippets {
            let ending = match snippet.language {
                "rust" => "rs",
                "c++" => "hpp",
                "c#" => "cs",
                other => panic!("{other} is not known here"),
            };
            listed.insert((format!("{}.{ending}", card.id), snippet.source.to_string()));
        }
    }
    assert_eq!(files, listed);
    for (name, text) in &files {
        assert!(text.lines().all(|line| line.chars().count() <= 120), "{name} is too wide");
    }
}

#[test]
fn the_rust_snippets_match_the_table() {
    for rates in RATES {
        for trace in traces(rates) {
            for card in POLICIES.iter() {
                same(card, rates, &trace, &in_rust(card.id, rates, &trace));
            }
        }
    }
}

/// Checks every snippet of a language by a driver that is given the rates and, a line each, the durations, and prints
/// `id steps step_s shown_s` for each loop and frame.
fn driven(language: &str, driver: &[&Path]) {
    let with_snippet = POLICIES
        .iter()
        .filter(|card| card.snippets.iter().any(|snippet| snippet.language == language));
    let with_snippet: BTreeSet<&str> = with_snippet.map(|card| card.id).collect();
    for rates in RATES {
        for trace in traces(rates) {
            let [numerator, denominator] = rates.refresh_hz;
            let numbers = [rates.tick_hz, numerator, denominator];
            let mut child = Command::new(driver[0])
                .args(&driver[1..])
                .args(numbers.map(|number| number.to_string()))
                .stdin(Stdio::piped())
                .stdout(Stdio::piped())
                .spawn()
                .unwrap();
            let durations: String = trace.iter().map(|ns| format!("{ns}\n")).collect();
            // Dropped after writing, which ends the driver's input.
            child.stdin.take().unwrap().write_all(durations.as_bytes()).unwrap();
            let output = child.wait_with_output().unwrap();
            assert!(output.status.success(), "{:?}", output.status);
            let text = String::from_utf8(output.stdout).unwrap();
            let lines = text.lines().map(|line| line.split_once(' ').unwrap());
            let driven: BTreeSet<&str> = lines.clone().map(|(id, _)| id).collect();
            assert_eq!(driven, with_snippet);
            for id in driven {
                let own = lines.clone().filter(|line| line.0 == id);
                let answers: Vec<_> = own.map(|(_, line)| answer(line)).collect();
                same(policy(id).unwrap(), rates, &trace, &answers);
            }
        }
    }
}

/// A driver's line after the id.
fn answer(line: &str) -> Answer {
    let mut words = line.split(' ');
    let mut number = || words.next().unwrap().parse::<f64>().unwrap();
    Answer { steps: number() as u32, step_s: number(), shown_s: number() }
}

#[test]
fn the_cpp_snippets_match_the_table() {
    let folder = build_folder("loops-cpp");
    let program = folder.join("driver");
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut compiler = Command::new("c++");
    compiler.args(["-std=c++14", "-Wall", "-Wextra", "-Wconversion", "-pedantic", "-Werror"]);
    compiler.arg("-I").arg(root.join("assets/loops")).arg("-o").arg(&program);
    compiler.arg(root.join("tests/loop_snippets/driver.cpp"));
    if compiled_or_skip("the_cpp_snippets_match_the_table", &mut compiler) {
        driven("c++", &[&program]);
    }
}

#[test]
fn the_c_sharp_snippets_match_the_table() {
    let folder = build_folder("loops-cs");
    let program = folder.join("driver.exe");
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut compiler = Command::new("mcs");
    compiler.args(["-warnaserror", &format!("-out:{}", program.display())]);
    compiler.arg(root.join("tests/loop_snippets/driver.cs"));
    for card in POLICIES.iter() {
        for snippet in card.snippets.iter().filter(|snippet| snippet.language == "c#") {
            // All of them have a class of one name.
            let inside =
                format!("namespace In_{}\n{{\n{}}}\n", card.id.replace('-', "_"), snippet.source);
            let path = folder.join(format!("{}.cs", card.id));
            fs::write(&path, inside).unwrap();
            compiler.arg(path);
        }
    }
    if compiled_or_skip("the_c_sharp_snippets_match_the_table", &mut compiler) {
        driven("c#", &[Path::new("mono"), &program]);
    }
}
