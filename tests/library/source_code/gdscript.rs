//! GDScript, for which there is no compiler at hand, by a small grammar of the part that is printed.

use std::collections::BTreeSet;
use std::path::Path;
use std::{env, fs};

use regatta::sim::integrators::{METHODS, method};
use regatta::tools::source_code::{Language, Precision, source_code};

/// The functions and words of GDScript that may be used without a declaration.
const KNOWN: [&str; 27] = [
    "static", "func", "class", "float", "int", "Callable", "Array", "call", "var", "const", "if",
    "else", "while", "return", "and", "or", "NAN", "is_nan", "absf", "minf", "maxf", "sqrt", "pow",
    "exp", "ceil", "sin", "cos",
];

/// The first fault of a file.
fn complaint(text: &str) -> Option<String> {
    let mut depths = vec![0];
    let mut opens = false;
    let mut continues = false;
    let mut open_parentheses = 0_i32;
    let mut declared: BTreeSet<String> = KNOWN.map(String::from).into_iter().collect();
    for line in text.lines() {
        let code = line.split('#').next().unwrap_or_default();
        let wrong = |what: &str| Some(format!("{what}: {line}"));
        if code.trim().is_empty() {
            continue;
        }
        let depth = code.chars().take_while(|c| *c == '\t').count();
        if code.trim_start_matches('\t').starts_with(' ') {
            return wrong("spaces indent");
        }
        if !continues && open_parentheses == 0 {
            if opens && depth != depths[depths.len() - 1] + 1 {
                return wrong("a block does not begin");
            }
            if opens {
                depths.push(depth);
            } else if !depths.contains(&depth) || depth > depths[depths.len() - 1] {
                return wrong("the indentation is of no block");
            }
            depths.retain(|open| *open <= depth);
            for word in ["var ", "const ", "class ", "static func "] {
                if let Some(rest) = code.trim().strip_prefix(word) {
                    let name = rest.split(|c: char| !is_part(c)).next().unwrap_or_default();
                    declared.insert(name.to_owned());
                }
            }
        }
        let code = code.trim();
        if code.replace("!=", "").chars().any(|c| "{};!&|?".contains(c)) {
            return wrong("another language");
        }
        let pieces: Vec<&str> = code.split_inclusive(|c| !is_part(c)).collect();
        for piece in &pieces {
            let word = piece.trim_end_matches(|c| !is_part(c));
            let is_word = word.starts_with(|c: char| c.is_alphabetic() || c == '_');
            // A parameter is declared by its type.
            if is_word && piece.ends_with(':') && !code.ends_with(piece) {
                declared.insert(word.to_owned());
            }
            if is_word && !declared.contains(word) && !piece.ends_with(':') {
                return wrong(&format!("{word} is not declared"));
            }
        }
        open_parentheses += code.matches('(').count() as i32 - code.matches(')').count() as i32;
        if open_parentheses < 0 {
            return wrong("a parenthesis too many");
        }
        continues = code.ends_with('\\');
        let begins = ["if ", "else", "while ", "static func ", "class ", ")"];
        let is_head = begins.iter().any(|word| code.starts_with(word)) || code.ends_with(':');
        opens = code.ends_with(':');
        if is_head && !continues && open_parentheses == 0 && !opens {
            return wrong("a head without a colon");
        }
    }
    (open_parentheses != 0 || opens).then(|| "the end is missing".into())
}

fn is_part(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

#[test]
fn every_function_in_gdscript_is_grammatical() {
    for method in METHODS {
        let Ok(text) = source_code(method, Language::GdScript, Precision::Double) else { continue };
        assert_eq!(complaint(&text), None, "{text}");
    }
}

#[test]
fn bad_gdscript_is_detected() {
    let good = "static func f(x: float) -> Array:\n\tif x < 0.0 \\\n\t\tor x > 1.0:\n\t\tx = -x\n\treturn [x]\n";
    assert_eq!(complaint(good), None);
    for (part, bad) in [
        ("\tif x < 0.0 \\\n\t\tor x > 1.0:\n", "\tif x < 0.0\n"),
        ("\t\tx = -x\n", "\tx = -x\n"),
        ("\t\tx = -x\n", "\t\tx = -y\n"),
        ("\t\tx = -x\n", "\t\tx = (-x\n"),
        ("\t\tx = -x\n", "\t\tx = -x)\n"),
        ("\treturn [x]", "    return [x]"),
        ("\treturn [x]", "\t\t\treturn [x]"),
        ("\treturn [x]", "\treturn [x];"),
        ("\t\tor", "\t\t||"),
        ("-> Array:\n", "-> Array\n"),
    ] {
        let text = good.replacen(part, bad, 1);
        assert_ne!(text, good);
        assert!(complaint(&text).is_some(), "{text}");
    }
}

#[test]
fn bdf2_in_gdscript_is_as_committed() {
    let text = source_code(method("bdf2").unwrap(), Language::GdScript, Precision::Double).unwrap();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/library/source_code/bdf2.gd");
    if env::var_os("BLESS").is_some() {
        fs::write(&path, &text).unwrap();
    }
    assert_eq!(
        text,
        fs::read_to_string(path).unwrap(),
        "BLESS=1 cargo test --test library gdscript writes bdf2.gd again"
    );
}
