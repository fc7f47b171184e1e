//! The table of sources, and the text that is printed.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use regatta::sim::integrators::METHODS;
use regatta::tools::source_code::{Language, Precision, source_code};

use super::known::sources;

#[test]
fn every_method_has_a_source_file_and_every_file_a_method() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/methods");
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let files = files.filter(|path| path.is_file());
    let read = |path: PathBuf| {
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        (name, fs::read_to_string(&path).unwrap())
    };
    let files: BTreeMap<String, String> = files.map(read).collect();
    let module = |id: &str| id.trim_start_matches("engine-").replace('-', "_");
    let cards = METHODS.iter().map(|method| (module(method.id), method.code.to_owned()));
    assert_eq!(files, cards.collect());
}

#[test]
fn every_method_is_printed_or_refused_with_a_reason_in_every_language() {
    for method in METHODS {
        for language in Language::ALL {
            match source_code(method, language, Precision::Double) {
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
fn a_header_agrees_with_the_card() {
    for (method, source) in sources() {
        let text = source_code(method, Language::GdScript, Precision::Double).unwrap();
        let header: Vec<&str> = text.lines().map_while(|line| line.strip_prefix('#')).collect();
        let header = header.iter().map(|line| line.trim()).collect::<Vec<_>>().join(" ");
        assert!(header.contains(method.about) && header.contains(method.source), "{header}");
        // An engine's source may word a claim itself.
        let own = |claim: &str| source.claim(claim).map(|words| words.to_owned());
        let order = format!("Order: {}", method.order);
        assert!(header.contains(&order), "{header}");
        let evaluations =
            method.evaluations.map_or("as many as it needs".into(), |count| count.to_string());
        assert!(header.contains(&format!("Evaluations per step: {evaluations}")), "{header}");
        let yes = |is| if is { "yes" } else { "no" };
        let has_joint = method.engine.is_some_and(|engine| engine.damping_ratio.is_some());
        let on_a_joint =
            if method.symplectic && has_joint { ", on a spring as a joint" } else { "" };
        let symplectic = format!("{}{on_a_joint}", yes(method.symplectic));
        let symplectic = own("symplectic").unwrap_or(symplectic);
        let conserves =
            format!("Symplectic: {symplectic}. Reversible: {}.", yes(method.reversible));
        assert!(header.contains(&conserves), "{header}");
        assert_eq!(header.contains("Memory: none"), !source.has_memory(), "{header}");
        assert!(!source.has_memory() || header.contains(method.restart.unwrap()), "{header}");
        assert_eq!(header.contains("Tolerance: "), method.tolerance.is_some(), "{header}");
        assert_eq!(header.contains("Time: "), !method.keeps_time, "{header}");
        assert_eq!(header.contains("Beware: "), !method.caveat.is_empty(), "{header}");
        assert!(header.contains(method.caveat), "{header}");
        match own("stability") {
            Some(words) => assert!(header.contains(&format!("Stability: {words}.")), "{header}"),
            None => assert_eq!(
                header.contains("h ω = ") || header.contains("h rate = "),
                method.stability_limit.is_some_and(|limit| limit > 0.0),
                "{header}"
            ),
        }
        for input in source.inputs() {
            assert!(header.contains(input.about), "{header}");
        }
    }
}

/// The header of a method, on one line.
fn header(id: &str) -> String {
    let method = regatta::sim::integrators::method(id).unwrap();
    let text = source_code(method, Language::C, Precision::Double).unwrap();
    let lines: Vec<&str> = text.lines().map_while(|line| line.strip_prefix("//")).collect();
    lines.iter().map(|line| line.trim()).collect::<Vec<_>>().join(" ")
}

#[test]
fn an_engines_header_is_right_for_joints_and_all_substeps() {
    for (method, source) in sources().filter(|(method, _)| method.is_engine()) {
        let header = header(method.id);
        let has_substeps = source.inputs().iter().any(|input| input.name == "substeps");
        let evaluations = match has_substeps {
            true => "Evaluations per step: 1, whatever the substeps.",
            false => "Evaluations per step: 1.",
        };
        assert!(header.contains(evaluations), "{header}");
        assert!(!header.contains("one more at the first"), "{header}");
        let takes_joint = source.inputs().iter().any(|input| input.name == "stiffness");
        assert_eq!(
            header.contains("an undamped spring, as a joint,") || header.contains("ω, as a joint,"),
            takes_joint,
            "{header}"
        );
        // The limit is that of a substep.
        let limits_a_substep = has_substeps && takes_joint && method.stability_limit.is_some();
        assert_eq!(header.contains(" times the substeps"), limits_a_substep, "{header}");
    }
}

#[test]
fn a_source_that_compares_coordinates_explains_the_case_of_several() {
    for (method, source) in sources() {
        let text = method.code;
        let compares = ["if error", "abs(v1", "end > target", "abs(r1", "x = aim"];
        let compares = compares.iter().any(|comparison| text.contains(comparison));
        assert_eq!(compares, source.claim("several").is_some(), "{}", method.id);
        let header = header(method.id);
        assert!(!compares || !header.contains("each other, make them vectors."), "{header}");
    }
}

#[test]
fn generated_code_follows_the_style_of_its_language() {
    for method in METHODS {
        if let Ok(text) = source_code(method, Language::Rust, Precision::Double) {
            let lines: Vec<&str> = text.lines().collect();
            let ends = |pair: &[&str]| pair[0].starts_with("    return") && pair[1] == "}";
            assert!(!lines.windows(2).any(ends), "{text}");
        }
        if let Ok(text) = source_code(method, Language::C, Precision::Double) {
            assert!(!text.lines().any(|line| line.trim() == "{"), "{text}");
        }
        if let Ok(text) = source_code(method, Language::CSharp, Precision::Double) {
            let opens = |line: &str| line.ends_with('{') && line.trim() != "{";
            assert!(!text.lines().any(opens), "{text}");
        }
    }
}

#[test]
fn single_precision_code_has_no_double_or_is_refused() {
    for method in METHODS {
        for language in Language::ALL {
            let found = source_code(method, language, Precision::Single);
            let Ok(text) = found else {
                let is_refused = source_code(method, language, Precision::Double).is_err();
                let doubles = [Language::GdScript, Language::JavaScript, Language::Lua];
                assert!(is_refused || doubles.contains(&language), "{found:?}");
                continue;
            };
            let code = text.lines().filter(|line| !line.trim().starts_with("//"));
            for double in ["f64", "double"] {
                assert!(!code.clone().any(|line| line.contains(double)), "{text}");
            }
        }
    }
}

#[test]
fn smooth_damp_describes_its_rate_in_unitys_terms() {
    let header = header("smooth-damp");
    assert!(header.contains("rate = 2 / smoothTime"), "{header}");
    assert!(header.contains("maxSpeed is left out"), "{header}");
}

#[test]
fn headers_of_engines_mention_their_peculiarities() {
    for (id, said) in [
        (
            "held-force",
            "with 1 substep an undamped spring of angular frequency ω stays bounded up to h ω = 2;",
        ),
        ("held-force", "Symplectic: with 1 substep only."),
        ("engine-pybullet", "Stability: there is no joint with a spring;"),
        ("engine-pybullet", "Order: 1 for the force; the drag is a law of its own"),
        ("engine-pybullet", "C = -ln(1 - d) of pybullet's own number d"),
        (
            "engine-avian-motor",
            "Memory: one for each coordinate, 0 at the start: without corrections of the tick before. No step restarts it;",
        ),
        ("engine-godot", "Order: 1; a joint with damping does not converge."),
        (
            "engine-mujoco-rk4",
            "Order: 4 on a joint, with drag too; 1 for a force of yours that changes.",
        ),
        ("engine-mujoco", "h ω = 2 times the substeps."),
        ("engine-chipmunk", "up to h ω = 2."),
        ("engine-chipmunk", "C = -ln d of Chipmunk's own number d"),
        ("engine-bullet", "C = -ln(1 - d) of Bullet's own number d"),
    ] {
        let header = header(id);
        assert!(header.contains(said), "{said}: {header}");
    }
}
