//! Fenced blocks of the README and of the manual's chapters, and the output that they print. `BLESS=1` replaces output that
//! has changed.

use std::path::{Path, PathBuf};
use std::{env, fs};

use regatta::manual::CHAPTERS;

/// The README or a chapter, as the file is now.
pub(crate) struct Text {
    /// `README`, `SKILL`, or the chapter's id.
    pub(crate) name: &'static str,
    path: PathBuf,
    pub(crate) text: String,
}

/// A fenced block.
pub(crate) struct Block<'t> {
    pub(crate) language: &'t str,
    /// Its lines, with the indentation of the fence.
    pub(crate) body: &'t str,
    /// The text above it.
    #[allow(dead_code, reason = "tests/library finds a program by it; tests/program needs none")]
    pub(crate) above: &'t str,
}

/// Every chapter, the README, then the text for assistants.
pub(crate) fn texts() -> Vec<Text> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let chapters = CHAPTERS
        .iter()
        .map(|chapter| (chapter.id, root.join("src/manual").join(chapter.id).with_extension("md")));
    let others = [("README", root.join("README.md")), ("SKILL", root.join("assets/SKILL.md"))];
    let all = chapters.chain(others);
    all.map(|(name, path)| {
        let text = fs::read_to_string(&path).expect("it is a file of the package");
        Text { name, path, text }
    })
    .collect()
}

impl Text {
    /// Its blocks, from top to bottom.
    pub(crate) fn blocks(&self) -> Vec<Block<'_>> {
        let mut blocks = Vec::new();
        let mut rest = &*self.text;
        while let Some((above, after)) = rest.split_once("```") {
            let (language, after) = after.split_once('\n').expect("a block has lines");
            let (body, after) = after.split_once("```").expect("a block ends");
            // Up to the line of the fence at its end, which is indented as that above is.
            let body = &body[..body.rfind('\n').map_or(0, |end| end + 1)];
            let above = &self.text[..self.text.len() - rest.len() + above.len()];
            blocks.push(Block { language, body, above });
            rest = after;
        }
        blocks
    }

    /// Asserts that a block prints this output, with ellipses as in [`has_lines`]. With `BLESS=1` the file gets the output
    /// instead.
    #[track_caller]
    pub(crate) fn hold(&self, printed: &str, said: &str) {
        let Err(wrong) = has_lines(said, printed) else { return };
        let is_blessed = env::var_os("BLESS").is_some_and(|value| value == "1");
        let name = self.name;
        assert!(is_blessed, "{name}: {wrong}\n{said}\nBLESS=1 with this test replaces the block");
        let written = blessed(said, printed);
        has_lines(said, &written).unwrap_or_else(|wrong| panic!("{name}: {wrong}"));
        // An earlier block of this text may have been replaced.
        let text = fs::read_to_string(&self.path).expect("it was read before");
        assert!(text.contains(printed), "{name}: {printed}");
        fs::write(&self.path, text.replace(printed, &written)).expect("a text that is written");
    }
}

/// Whether a line of output is the printed one, whose end may be left out.
fn is_line(said: &str, printed: &str) -> bool {
    match printed.trim().strip_suffix('…') {
        Some(begin) => said.trim().starts_with(begin),
        None => said.trim() == printed.trim(),
    }
}

fn lines(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter(|line| !line.trim().is_empty())
}

/// Whether output has exactly the printed lines, in this order. An ellipsis matches any lines, or the end of one.
/// Indentation and empty lines do not count.
pub(crate) fn has_lines(said: &str, printed: &str) -> Result<(), String> {
    let mut said = lines(said);
    let mut may_skip = false;
    for line in lines(printed) {
        if line.trim() == "…" {
            may_skip = true;
            continue;
        }
        let found = match may_skip {
            true => said.any(|said| is_line(said, line)),
            false => said.next().is_some_and(|said| is_line(said, line)),
        };
        if !found {
            return Err(format!("the output lacks the line: {line}"));
        }
        may_skip = false;
    }
    match said.next().filter(|_| !may_skip) {
        Some(more) => Err(format!("the text lacks the line: {more}")),
        None => Ok(()),
    }
}

/// The printed lines, each replaced by the line of the output in its place. Below an ellipsis that is the next equal line,
/// or else the one with the most words in common.
fn blessed(said: &str, printed: &str) -> String {
    let indent = &printed[..printed.len() - printed.trim_start_matches(' ').len()];
    let line_of = |said: &str, printed: Option<&str>| match printed {
        Some(printed) if is_line(said, printed) => format!("{printed}\n"),
        Some(printed) if printed.ends_with('…') => {
            let length = printed.trim().chars().count() - 1;
            let begin: String = said.trim().chars().take(length).collect();
            format!("{indent}{begin}…\n")
        }
        _ if said.trim().is_empty() => "\n".into(),
        _ => format!("{indent}{said}\n"),
    };
    if lines(printed).all(|line| line.trim() != "…") {
        let mut old = lines(printed);
        let lines = said.lines().map(|said| {
            let old = if said.trim().is_empty() { None } else { old.next() };
            line_of(said, old)
        });
        return lines.collect();
    }
    let all: Vec<&str> = lines(said).collect();
    let (mut at, mut may_skip, mut written) = (0, false, String::new());
    for line in printed.lines() {
        if line.trim() == "…" || line.trim().is_empty() {
            written += &format!("{line}\n");
            may_skip |= line.trim() == "…";
            continue;
        }
        let common = |index: &usize| {
            let words: Vec<&str> = all[*index].split_whitespace().collect();
            let count = line.split_whitespace().filter(|word| words.contains(word)).count();
            (is_line(all[*index], line), count)
        };
        // The first among equals.
        let nearest = (at..all.len()).rev().max_by_key(common).filter(|index| common(index).1 > 0);
        let found = if may_skip { nearest } else { Some(at) };
        let found = found.filter(|index| *index < all.len());
        let found = found.unwrap_or_else(|| {
            panic!("no line of the output resembles {line}; edit the block by hand")
        });
        written += &line_of(all[found], Some(line));
        (at, may_skip) = (found + 1, false);
    }
    written
}

#[test]
fn a_missing_or_extra_line_is_detected() {
    assert!(has_lines("a\nb\nc 1\n", "a\n…\nc…\n").is_ok());
    assert!(has_lines("a\nb\nc 1\n", "a\nc…\n").is_err());
    assert!(has_lines("a\n", "a\nb\n").is_err());
    assert!(has_lines("a\nb\n", "a\n").is_err() && has_lines("a\nb\n", "a\n…\n").is_ok());
}

#[test]
fn blessing_rewrites_only_the_changed_lines() {
    let said = "one 1\ntwo two\n\n  three 3 4 5\nfour\n";
    let whole = "  one 1\n  two two\n\n    three 3 4 5\n  four\n";
    assert_eq!(blessed(said, "  one 2\n  two\n"), whole);
    assert_eq!(blessed(said, "…\nthree 4…\n…\n"), "…\nthree 3…\n…\n");
    assert_eq!(blessed(said, "one 1\n…\nfour\n"), "one 1\n…\nfour\n");
}
