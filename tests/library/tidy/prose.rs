//! How comments read: few *what*s, short sentences, no worn words, lines that fit; and test names that fit too.

use std::collections::BTreeMap;

use super::{Source, none, sources};

/// Greatest share of comment lines with the word *what* in a room.
const WHATS: f64 = 0.02;
/// Words that stand in for a noun or a verb that the reader needs.
const WORN: [&str; 7] =
    ["told", "said", "anew", "so many", "takes in", "of those that", "that which"];
/// Greatest number of words in a sentence; a piece of code is one word.
const MAX_WORDS: usize = 30;
/// Greatest number of columns of a line.
const MAX_COLUMNS: usize = 120;
/// Greatest number of letters of a test's name.
const MAX_NAME: usize = 80;

/// A comment line: its number, and its text without slashes.
struct CommentLine<'a> {
    number: usize,
    text: &'a str,
}

/// The comment lines of a file, in blocks: without code, and split at empty lines, headings, tables and list items.
fn blocks(source: &Source) -> Vec<Vec<CommentLine<'_>>> {
    let mut blocks = vec![Vec::new()];
    let mut is_code = false;
    for (index, line) in source.text.lines().enumerate() {
        let Some(text) = line.trim_start().strip_prefix("//") else {
            is_code = false;
            blocks.push(Vec::new());
            continue;
        };
        let text = text.trim_start_matches(['/', '!']).trim();
        if text.starts_with("```") {
            is_code = !is_code;
            blocks.push(Vec::new());
            continue;
        }
        let is_item = text.starts_with(['-', '*', '|', '#']) || text.is_empty();
        if is_item {
            blocks.push(Vec::new());
        }
        if !is_code && !text.is_empty() {
            let block = blocks.last_mut().expect("there is a block");
            block.push(CommentLine { number: index + 1, text });
        }
    }
    blocks.retain(|block| !block.is_empty());
    blocks
}

/// A text with each piece of code between backticks as one word.
fn without_code(text: &str) -> String {
    let parts = text.split('`').enumerate();
    parts.map(|(index, part)| if index % 2 == 0 { part } else { "code" }).collect()
}

/// The words of a text in lower case.
fn words(text: &str) -> Vec<String> {
    let trim = |word: &str| word.trim_matches(|c: char| !c.is_alphanumeric()).to_lowercase();
    let words = without_code(text);
    words.split_whitespace().map(trim).filter(|word| !word.is_empty()).collect()
}

/// The number of words in the longest sentence of a text.
fn longest_sentence(text: &str) -> usize {
    let (mut longest, mut length) = (0, 0);
    for word in without_code(text).split_whitespace() {
        length += usize::from(word.contains(char::is_alphanumeric));
        longest = longest.max(length);
        if word.trim_end_matches([')', '*', '"', '_']).ends_with(['.', '?', '!', ':', ';']) {
            length = 0;
        }
    }
    longest
}

/// Worn words, long sentences and long lines in comments.
fn prose(source: &Source) -> Vec<String> {
    let mut complaints = Vec::new();
    for block in blocks(source) {
        let place = format!("{}:{}", source.path, block[0].number);
        let lines: Vec<&str> = block.iter().map(|line| line.text).collect();
        let text = lines.join(" ");
        let spaced = format!(" {} ", words(&text).join(" "));
        let worn = WORN.iter().filter(|worn| spaced.contains(&format!(" {worn} ")));
        complaints.extend(worn.map(|worn| format!("{place}: *{worn}*; name the thing instead")));
        // A row of a table is no sentence.
        let longest = longest_sentence(&text);
        if longest > MAX_WORDS && !text.starts_with('|') {
            complaints.push(format!("{place}: a sentence of {longest} words; cut it in two"));
        }
    }
    let lines = source.text.lines().enumerate();
    let long = lines.filter(|(_, line)| {
        let is_comment = line.trim_start().starts_with("//") && !line.starts_with("//! |");
        is_comment && line.chars().count() > MAX_COLUMNS
    });
    complaints.extend(long.map(|(index, line)| {
        let columns = line.chars().count();
        format!("{}:{}: a comment of {columns} columns; wrap it", source.path, index + 1)
    }));
    complaints
}

/// Comment lines of each room, and those with the word *what*.
fn whats(sources: &[Source]) -> BTreeMap<String, [usize; 2]> {
    let mut rooms = BTreeMap::<String, [usize; 2]>::new();
    for source in sources {
        // The files beside the rooms count as one.
        let folders = source.path.rsplit_once('/').map_or("", |(folders, _)| folders);
        let room: Vec<&str> = folders.split('/').take(2).collect();
        let counts = rooms.entry(room.join("/")).or_default();
        for line in blocks(source).iter().flatten() {
            counts[0] += 1;
            counts[1] += usize::from(words(line.text).iter().any(|word| word == "what"));
        }
    }
    rooms
}

#[test]
fn comments_are_short_sentences_without_worn_words() {
    let sources = sources("src", &["rs"]);
    none(sources.iter().flat_map(prose).collect());
    let rooms = whats(&sources).into_iter();
    let wordy = rooms.filter(|(_, [lines, whats])| *whats as f64 > WHATS * *lines as f64);
    none(
        wordy
            .map(|(room, counts)| format!("{room}: {counts:?} comment lines, and *what*s"))
            .collect(),
    );
}

#[test]
fn bad_comments_are_detected() {
    let source = |text: String| Source { path: "src/sim/clock.rs".into(), text };
    let found = |text: String| prose(&source(text)).len();
    let long = |words: usize| format!("{} end", "word ".repeat(words - 1));
    let half = MAX_WORDS / 2;
    assert_eq!(found(format!("/// {}\n/// {}.", long(half), long(MAX_WORDS - half))), 0);
    assert_eq!(found(format!("/// {}\n/// {}.", long(half + 1), long(MAX_WORDS - half))), 1);
    assert_eq!(found(format!("//! {}.\n//! {}.", long(16), long(16))), 0);
    assert_eq!(found(format!("/// {}.", "letters ".repeat(15))), 1, "a long line");
    assert_eq!(found(format!("//! `{}`.", "a + b ".repeat(15))), 0, "code is a word");
    assert_eq!(found(format!("//! ```\n//! {}\n//! ```", long(20))), 0);
    for worn in WORN {
        assert_eq!(found(format!("    // The rate is {worn} here.")), 1, "{worn}");
        assert_eq!(found(format!("    let {} = 1;", worn.replace(' ', "_"))), 0);
    }
    let rooms = whats(&[source("/// What it is.\n/// A rate.\nfn what() {}\n".into())]);
    assert_eq!(rooms["src/sim"], [2, 1]);
}

/// Names of tests that are too long.
fn long_names(source: &Source) -> Vec<String> {
    let functions = source.text.split("#[test]").skip(1).filter_map(|rest| {
        let name = rest.split_once("fn ")?.1;
        Some(&name[..name.find('(')?])
    });
    let long = functions.filter(|name| name.chars().count() > MAX_NAME);
    long.map(|name| format!("{}: {name}: more than {MAX_NAME} letters", source.path)).collect()
}

#[test]
fn names_of_tests_are_sentences_of_one_line() {
    let sources = ["src", "tests"].map(|folder| sources(folder, &["rs"]));
    none(sources.iter().flatten().flat_map(long_names).collect());
    let named = |letters: usize| {
        let text = format!("#[test]\nfn {}() {{}}", "a".repeat(letters));
        long_names(&Source { path: "src/sim/clock.rs".into(), text }).len()
    };
    assert_eq!([named(MAX_NAME), named(MAX_NAME + 1)], [0, 1]);
}
