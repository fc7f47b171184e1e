//! The paths that a Rust source names, `use` groups spread out, comments and texts left out.

/// The source without comments and string literals.
pub(crate) fn code(text: &str) -> String {
    let mut code = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(next) = rest.chars().next() {
        let skipped = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            rest.find("*/").map_or(rest.len(), |end| end + 2)
        } else if let Some(raw) = rest.strip_prefix("r#\"") {
            raw.find("\"#").map_or(rest.len(), |end| end + 5)
        } else if rest.starts_with("'\"'") {
            3
        } else if next == '"' {
            let mut escaped = false;
            let end = rest[1..].find(|c| {
                let ends = c == '"' && !escaped;
                escaped = c == '\\' && !escaped;
                ends
            });
            end.map_or(rest.len(), |end| end + 2)
        } else {
            code.push(next);
            next.len_utf8()
        };
        rest = &rest[skipped..];
    }
    code
}

/// Every path of two or more parts, and every name that a `use` brings in, as lists of parts.
pub(crate) fn named(text: &str) -> Vec<Vec<String>> {
    let code = code(text);
    let mut named = Vec::new();
    for (at, _) in code.match_indices("use ") {
        let begins = code[..at].chars().next_back().is_none_or(|c| c.is_whitespace());
        if let (true, Some(end)) = (begins, code[at..].find(';')) {
            spread(&code[at + 4..at + end], &[], &mut named);
        }
    }
    let is_part = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    for piece in code.split_inclusive(|c| !is_part(c)) {
        let path = piece.trim_end_matches(|c| !is_part(c));
        // The prefix before a brace is expanded above and names nothing alone.
        if path.contains("::") && !piece.ends_with("::{") {
            named.push(parts(path));
        }
    }
    named
}

fn parts(path: &str) -> Vec<String> {
    let parts = path.split("::").map(str::trim).filter(|part| !part.is_empty());
    parts.map(String::from).collect()
}

/// Writes out a `use` tree: `a::{b, c::{d, e}}` is `a::b`, `a::c::d`, `a::c::e`.
fn spread(tree: &str, before: &[String], named: &mut Vec<Vec<String>>) {
    let Some(open) = tree.find('{') else {
        let path = tree.split(" as ").next().unwrap_or(tree);
        named.push([before, &parts(path)].concat());
        return;
    };
    let before = [before, &parts(&tree[..open])].concat();
    let close = tree.rfind('}').unwrap_or(tree.len());
    let (mut depth, mut from) = (0, open + 1);
    for (at, c) in tree[..close].char_indices().skip_while(|(at, _)| *at <= open) {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                spread(&tree[from..at], &before, named);
                from = at + 1;
            }
            _ => {}
        }
    }
    if !tree[from..close].trim().is_empty() {
        spread(&tree[from..close], &before, named);
    }
}

#[test]
fn grouped_paths_are_expanded() {
    let found = named("use a::{self, b as x, c::{d, e}};\npub use f::g;\nlet x = h::i(j);");
    let found: Vec<String> = found.into_iter().map(|path| path.join("::")).collect();
    for path in ["a::self", "a::b", "a::c::d", "a::c::e", "f::g", "h::i"] {
        assert!(found.iter().any(|f| f == path), "{path} in {found:?}");
    }
}

#[test]
fn comments_and_strings_name_no_paths() {
    let text = r##"
        // std::fs::read, use std::fs;
        /* std::fs */ /// [`std::fs`]
        let a = "std::fs \" std::fs"; let b = r#"std::"fs"#; let c = '"'; let d = real::path;
    "##;
    assert_eq!(named(text), [["real", "path"]]);
}
