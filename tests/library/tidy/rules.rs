//! What each layer may not name, and how files are to be called and cut.

use std::collections::BTreeSet;

use super::paths::{code, named};
use super::{Source, none, root, sources};

/// The most lines of a file. With more it holds more than one thing; with a much lower limit one thing is split into
/// several files that mean nothing alone.
const MAX_LINES: usize = 600;
/// Names for "did not think".
const NO_NAMES: [&str; 6] = ["utils", "util", "common", "helpers", "helper", "misc"];

/// A layer: who is above it, what it may use of the crates the package names, and what it may not use
/// of the standard library.
pub(crate) struct Layer {
    pub(crate) name: &'static str,
    above: &'static [&'static str],
    crates: Crates,
    std: &'static [&'static str],
}

pub(crate) enum Crates {
    /// These and no others.
    Only(&'static [&'static str]),
    /// Any but these.
    Not(&'static [&'static str]),
}

pub(crate) const LAYERS: [Layer; 5] = [
    Layer {
        name: "sim",
        above: &["lab", "view", "window", "commands"],
        crates: Crates::Only(&["glam", "libm", "nalgebra", "thiserror"]),
        std: &["fs", "time", "thread", "env", "io", "net", "process", "path"],
    },
    Layer {
        name: "lab",
        above: &["view", "window", "commands"],
        crates: Crates::Only(&[
            "csv",
            "glam",
            "libm",
            "nalgebra",
            "thiserror",
            "toml",
            "toml_edit",
            "serde",
            "strsim",
        ]),
        std: &["fs", "time", "thread", "env", "io", "net", "process"],
    },
    Layer {
        name: "view",
        // Of the mathematics it sees what the lab hands on.
        above: &["sim", "window", "commands"],
        crates: Crates::Not(&["winit", "egui_winit", "clap", "anyhow", "toml", "ctrlc"]),
        std: &["fs", "env", "net", "process", "time::Instant", "time::SystemTime"],
    },
    Layer {
        name: "window",
        above: &["commands"],
        crates: Crates::Not(&["clap", "anyhow", "toml"]),
        std: &[],
    },
    Layer { name: "commands", above: &[], crates: Crates::Not(&["winit", "egui_winit"]), std: &[] },
];

/// The crates in `Cargo.toml`, as sources name them.
fn crates() -> BTreeSet<String> {
    let manifest = std::fs::read_to_string(root().join("Cargo.toml")).expect("a manifest");
    let (_, after) = manifest.split_once("[dependencies]\n").expect("a table of dependencies");
    let entries = after.lines().take_while(|line| !line.starts_with('['));
    let names = entries.filter_map(|line| line.split_once(" = "));
    names.map(|(name, _)| name.replace('-', "_")).collect()
}

/// What this source names that its layer may not.
fn trespasses(source: &Source, crates: &BTreeSet<String>) -> Vec<String> {
    let inside = source.path.strip_prefix("src/").unwrap_or_default();
    let layer = inside.split(['/', '.']).next().unwrap_or_default();
    let Some(layer) = LAYERS.iter().find(|known| known.name == layer) else {
        return Vec::new();
    };
    // Batches share their work between threads, and choose an instruction set. Large bodies and the counts of a picture are
    // shared too. None of it changes a bit.
    let allowed: &[&str] = match inside {
        "sim/cores.rs" | "lab/cloud/density.rs" => &["rayon"],
        _ if inside.starts_with("sim/batch/") => &["rayon", "multiversion"],
        _ => &[],
    };
    let forbids = |path: &[String]| {
        let inner = path.iter().skip_while(|part| ["crate", "super", "self"].contains(&&***part));
        let inner: Vec<&str> = inner.map(String::as_str).collect();
        let Some(first) = inner.first() else { return false };
        if path.len() > inner.len() {
            return layer.above.contains(first);
        }
        match &layer.crates {
            _ if ["std", "core"].contains(first) => {
                let rest = inner[1..].join("::");
                let within = |part: &&str| rest == **part || rest.starts_with(&format!("{part}::"));
                layer.std.iter().any(within)
            }
            Crates::Only(only) => {
                crates.contains(*first) && !only.contains(first) && !allowed.contains(first)
            }
            Crates::Not(not) => not.contains(first),
        }
    };
    let found = named(&source.text).into_iter().filter(|path| forbids(path));
    let found: BTreeSet<String> = found.map(|path| path.join("::")).collect();
    let complain = |path| format!("{}: {} may not name {path}", source.path, layer.name);
    found.into_iter().map(complain).collect()
}

/// Exits and error output outside `main`; a print in the layers that hand everything back.
fn voices(source: &Source) -> Vec<String> {
    if !source.path.starts_with("src/") || source.path == "src/main.rs" {
        return Vec::new();
    }
    let quiet = ["src/sim/", "src/lab/", "src/view/"].iter().any(|f| source.path.starts_with(f));
    let (code, mut complaints) = (code(&source.text), Vec::new());
    for (word, forbidden) in [
        ("eprintln!", true),
        ("eprint!", true),
        ("process::exit", true),
        ("process::abort", true),
        ("println!", quiet),
        ("print!", quiet),
    ] {
        let mut places = code.match_indices(word).map(|(at, _)| code[..at].chars().next_back());
        let whole = |before: Option<char>| before.is_none_or(|c| !c.is_alphanumeric() && c != '_');
        if forbidden && places.any(whole) {
            complaints.push(format!("{}: {word} is for main alone", source.path));
        }
    }
    complaints
}

/// Names and lengths.
fn shapes(source: &Source) -> Vec<String> {
    let mut complaints = Vec::new();
    let lines = source.text.lines().count();
    if lines > MAX_LINES {
        complaints.push(format!("{}: {lines} lines, at most {MAX_LINES}", source.path));
    }
    let of_path = source.path.split(['/', '.']).map(String::from);
    let code = code(&source.text);
    let words: Vec<&str> = code.split(|c: char| !c.is_alphanumeric() && c != '_').collect();
    let declared = words.windows(2).filter(|pair| pair[0] == "mod").map(|pair| pair[1].into());
    for name in of_path.chain(declared) {
        if NO_NAMES.contains(&&*name) {
            complaints.push(format!("{}: {name} names nothing", source.path));
        }
    }
    complaints
}

#[test]
fn layers_name_only_what_is_below_them() {
    let (sources, crates) = (sources("src", &["rs"]), crates());
    assert!(sources.iter().any(|source| source.path == "src/sim/system.rs"));
    assert!(crates.contains("glam") && crates.contains("egui_winit"));
    none(sources.iter().flat_map(|source| trespasses(source, &crates)).collect());
}

#[test]
fn only_main_exits_and_prints_errors() {
    none(sources("src", &["rs"]).iter().flat_map(voices).collect());
}

#[test]
fn files_are_short_and_named_for_what_they_hold() {
    let folders = ["src", "tests", "benches", "shaders"];
    let sources: Vec<Source> =
        folders.iter().flat_map(|folder| sources(folder, &["rs", "wgsl"])).collect();
    assert!(sources.iter().any(|source| source.path == "tests/library/tidy/rules.rs"));
    none(sources.iter().flat_map(shapes).collect());
}

fn source(path: &str, text: &str) -> Source {
    Source { path: path.into(), text: text.into() }
}

#[test]
fn trespasses_are_seen() {
    let crates = crates();
    let bad = [
        ("src/sim/rk5.rs", "use std::fs;"),
        ("src/sim/rk5.rs", "use std::{cell::Cell, time::Instant};"),
        ("src/sim/rk5.rs", "fn f() { std::thread::spawn(g); }"),
        ("src/sim/rk5.rs", "use toml::Table;"),
        ("src/sim/rk5.rs", "use crate::lab::Studio;"),
        ("src/sim/bodies/raft.rs", "use super::super::super::lab::{Scene, Studio};"),
        ("src/lab/studio.rs", "use wgpu::Device;"),
        ("src/lab/studio.rs", "fn f() -> std::time::Duration { g() }"),
        ("src/lab/studio.rs", "use std::{fs, mem};"),
        ("src/lab/studio.rs", "use crate::{lab, view};"),
        ("src/view/sea.rs", "use crate::sim::Stepper;"),
        ("src/view/sea.rs", "use winit::window::Window;"),
        ("src/view/sea.rs", "let now = std::time::Instant::now();"),
        ("src/view/sea.rs", "use std::time::{Duration, SystemTime};"),
        ("src/window.rs", "use crate::commands::play;"),
        ("src/commands/list.rs", "use winit::window::Window;"),
    ];
    for (path, text) in bad {
        assert!(!trespasses(&source(path, text), &crates).is_empty(), "{path}: {text}");
    }
    let good = [
        ("src/sim/rk5.rs", "use std::cell::Cell; use glam::DVec2; use super::{State, System};"),
        ("src/sim/rk5.rs", "//! See [`crate::lab::race::ESCAPE`].\nlet text = \"std::fs\";"),
        ("src/lab/scene.rs", "use crate::sim::State; use toml::Table; use serde::Deserialize;"),
        ("src/view/sea.rs", "use std::time::Duration; use crate::lab::picture::Sea;"),
        ("src/window.rs", "use std::time::Instant; use crate::view::Gpu;"),
        ("src/commands/trace.rs", "use std::fs::File; use crate::lab::Studio;"),
        ("src/main.rs", "use crate::commands; use anyhow::Result;"),
    ];
    for (path, text) in good {
        none(trespasses(&source(path, text), &crates));
    }
}

#[test]
fn voices_are_heard() {
    for text in ["eprintln!(\"oh\");", "std::process::exit(1);", "use std::process::exit;"] {
        assert_eq!(voices(&source("src/commands/list.rs", text)).len(), 1, "{text}");
        assert_eq!(voices(&source("src/main.rs", text)).len(), 0, "{text}");
    }
    assert_eq!(voices(&source("src/lab/studio.rs", "println!();")).len(), 1);
    none(voices(&source("src/commands/list.rs", "println!(); // not eprintln!")));
}

#[test]
fn bad_shapes_are_seen() {
    let lines = |number: usize| "\n".repeat(number);
    let bad = [
        ("tests/common/mod.rs", lines(1)),
        ("src/lab/utils.rs", lines(1)),
        ("src/sim/clock.rs", format!("pub(crate) mod {};", NO_NAMES[3])),
        ("src/sim/clock.rs", lines(MAX_LINES + 1)),
        ("tests/words.rs", lines(MAX_LINES + 1)),
    ];
    for (path, text) in bad {
        assert_eq!(shapes(&source(path, &text)).len(), 1, "{path}");
    }
    for path in ["src/sim/clock.rs", "tests/words.rs"] {
        none(shapes(&source(path, &lines(MAX_LINES))));
    }
}
