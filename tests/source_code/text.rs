//! The table of sources, and the text that is printed.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use regatta::lab::{Language, METHOD_SOURCES, source_code};
use regatta::sim::integrators::METHODS;

use crate::known::sources;

#[test]
fn every_method_has_a_source_and_every_file_is_one() {
    let listed: Vec<&str> = METHOD_SOURCES.iter().map(|source| source.method).collect();
    let methods: Vec<&str> = METHODS.iter().map(|method| method.id).collect();
    assert_eq!(listed, methods, "METHOD_SOURCES is in the order of METHODS");
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/methods");
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let files = files.filter(|path| path.is_file());
    let names = files.map(|path| path.file_name().unwrap().to_str().unwrap().to_owned());
    let names: BTreeSet<String> = names.collect();
    assert_eq!(names, methods.iter().map(|id| format!("{id}.step")).collect());
}

#[test]
fn every_method_is_printed_in_every_language_or_says_why_not() {
    for method in METHODS {
        for language in Language::ALL {
            match source_code(method, language) {
                Ok(text) => {
                    assert!(text.contains(method.name) && text.contains(method.id), "{text}");
                    let wide = text.lines().find(|line| line.chars().count() > 120);
                    assert_eq!(wide, None, "{} in {language}", method.id);
                    assert!(text.lines().all(|line| line.trim_end() == line), "{text}");
                    assert!(text.ends_with('\n') && !text.contains("\n\n\n"), "{text}");
                }
                Err(refused) => {
                    assert!(refused.reason.split(' ').count() > 3, "{refused}");
                    assert!(refused.to_string().starts_with(method.id), "{refused}");
                }
            }
        }
    }
}

#[test]
fn a_header_says_what_is_on_the_card() {
    for (method, source) in sources() {
        let text = source_code(method, Language::GdScript).unwrap();
        let header: Vec<&str> = text.lines().map_while(|line| line.strip_prefix('#')).collect();
        let header = header.iter().map(|line| line.trim()).collect::<Vec<_>>().join(" ");
        assert!(header.contains(method.about) && header.contains(method.source), "{header}");
        let order = format!("Order: {}", method.order);
        assert!(header.contains(&order), "{header}");
        let evaluations =
            method.evaluations.map_or("as many as it needs".into(), |count| count.to_string());
        assert!(header.contains(&format!("Evaluations per step: {evaluations}")), "{header}");
        let yes = |is| if is { "yes" } else { "no" };
        let conserves = format!(
            "Symplectic: {}. Reversible: {}.",
            yes(method.symplectic),
            yes(method.reversible)
        );
        assert!(header.contains(&conserves), "{header}");
        assert_eq!(header.contains("Memory: none"), !source.has_memory(), "{header}");
        assert!(!source.has_memory() || header.contains(method.restart.unwrap()), "{header}");
        assert_eq!(header.contains("Tolerance: "), method.tolerance.is_some(), "{header}");
        assert_eq!(header.contains("Time: "), !method.keeps_time, "{header}");
        let limit = method.stability_limit.filter(|limit| *limit > 0.0);
        assert_eq!(
            header.contains("h ω = ") || header.contains("h rate = "),
            limit.is_some(),
            "{header}"
        );
        for input in source.inputs() {
            assert!(header.contains(input.about), "{header}");
        }
    }
}
