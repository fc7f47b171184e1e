//! How files are to be called and cut.

use super::paths::code;
use super::{Source, none, sources};

/// The most lines of a file. With more it holds more than one thing; with a much lower limit one thing is split into
/// several files that mean nothing alone.
const MAX_LINES: usize = 600;
/// Names for "did not think".
const NO_NAMES: [&str; 6] = ["utils", "util", "common", "helpers", "helper", "misc"];

/// The files that name a standard stream: those that print, with signs for control characters.
const PRINTERS: [&str; 4] = [
    "src/commands/output/destination.rs",
    "src/commands/pipeline.rs",
    "src/commands/terminal.rs",
    "src/main.rs",
];
const STREAMS: [&str; 6] =
    ["io::stdout()", "io::stderr()", "println!", "print!", "eprintln!", "eprint!"];

/// Standard streams that are written past the functions that print.
fn streams(source: &Source) -> Vec<String> {
    let code = code(&source.text);
    let found = STREAMS.iter().find(|stream| code.contains(*stream));
    let is_printer = PRINTERS.contains(&&*source.path);
    let complaint = |stream| format!("{}: {stream}, which a printer is for", source.path);
    found.filter(|_| !is_printer).map(complaint).into_iter().collect()
}

#[test]
fn only_the_printers_write_to_the_standard_streams() {
    none(sources("src", &["rs"]).iter().flat_map(streams).collect());
    let bad = |path| streams(&source(path, "fn f() { writeln!(io::stderr(), x); }"));
    assert_eq!((bad("src/commands/trace.rs").len(), bad(PRINTERS[2]).len()), (1, 0));
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
fn files_are_short_and_named_for_their_content() {
    let folders = ["src", "tests", "benches", "shaders"];
    let sources: Vec<Source> =
        folders.iter().flat_map(|folder| sources(folder, &["rs", "wgsl"])).collect();
    assert!(sources.iter().any(|source| source.path == "tests/library/tidy/rules.rs"));
    none(sources.iter().flat_map(shapes).collect());
}

/// The one file that makes an editor of text: there it gets its bound.
const TEXT_FIELD: &str = "src/view/panels/text_field.rs";

/// Editors of text of any length.
fn unbounded_editors(source: &Source) -> Vec<String> {
    let is_elsewhere = source.path != TEXT_FIELD && code(&source.text).contains("TextEdit::");
    let complaint = format!("{}: an editor without a bound; take text_field", source.path);
    is_elsewhere.then_some(complaint).into_iter().collect()
}

#[test]
fn every_text_field_has_a_bound() {
    let sources = sources("src/view", &["rs"]);
    assert!(sources.iter().any(|source| source.path == TEXT_FIELD));
    none(sources.iter().flat_map(unbounded_editors).collect());
    let editor = "TextEdit::singleline(&mut text)";
    assert_eq!(unbounded_editors(&source("src/view/panels/guide.rs", editor)).len(), 1);
}

fn source(path: &str, text: &str) -> Source {
    Source { path: path.into(), text: text.into() }
}

#[test]
fn bad_shapes_are_detected() {
    let lines = |number: usize| "\n".repeat(number);
    let bad = [
        ("tests/common/mod.rs", lines(1)),
        ("src/run/utils.rs", lines(1)),
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
