//! A concept is implemented in one file.

use super::paths::code;
use super::{Source, none, sources};

/// A concept and the one file that may implement it.
struct Concept {
    name: &'static str,
    file: &'static str,
    /// Code that only an implementation of it contains.
    marks: &'static [&'static str],
}

const CONCEPTS: [Concept; 11] = [
    Concept {
        name: "dispatch by the type of a method",
        file: "src/sim/integrators/mod.rs",
        marks: &["::CARD.id"],
    },
    Concept {
        name: "step of a follower",
        file: "src/sim/integrators/follower.rs",
        marks: &["R::step("],
    },
    Concept {
        name: "tick of an engine",
        file: "src/sim/integrators/engine/mod.rs",
        marks: &["R::tick("],
    },
    Concept {
        name: "speed limit",
        file: "src/sim/integrators/engine/mod.rs",
        marks: &["max_speed * max_speed"],
    },
    Concept {
        name: "factorisation of a matrix",
        file: "src/sim/integrators/shared/lu.rs",
        marks: &["column.swap("],
    },
    Concept {
        name: "slope of a force, by its formula or by a difference",
        file: "src/sim/integrators/shared/slopes.rs",
        marks: &["Question::Slope { state: y,"],
    },
    Concept {
        name: "convergence of the equations of a step",
        file: "src/sim/integrators/shared/newton.rs",
        marks: &["const SLOW_CONVERGENCE"],
    },
    Concept {
        name: "linear equations without a matrix",
        file: "src/sim/integrators/shared/krylov.rs",
        marks: &["rho *= -omega2"],
    },
    Concept {
        name: "exponential of a linear flow",
        file: "src/sim/integrators/shared/linear_flow.rs",
        marks: &["const DEGREE"],
    },
    Concept {
        name: "inverse of the tick of an engine",
        file: "src/lab/port/inverse.rs",
        marks: &["by_stiffness[0] * by_damping[1]"],
    },
    Concept {
        name: "hash of a state",
        file: "src/lab/race/hash.rs",
        marks: &["0x0000_0100_0000_01b3"],
    },
];

/// The files beside its own that implement the concept, and its own if it does not.
fn misplaced(concept: &Concept, files: &[Source]) -> Vec<String> {
    let implements = |file: &&Source| {
        let code = code(&file.text);
        concept.marks.iter().any(|mark| code.contains(mark))
    };
    let (own, others): (Vec<&Source>, Vec<&Source>) =
        files.iter().filter(implements).partition(|file| file.path == concept.file);
    let name = concept.name;
    let missing = own.is_empty().then(|| format!("{} does not implement {name}", concept.file));
    let again = |file: &Source| format!("{}: {name} is for {} alone", file.path, concept.file);
    missing.into_iter().chain(others.into_iter().map(again)).collect()
}

#[test]
fn every_concept_is_implemented_in_one_file() {
    let files = sources("src", &["rs"]);
    none(CONCEPTS.iter().flat_map(|concept| misplaced(concept, &files)).collect());
}

#[test]
fn a_second_and_a_lost_implementation_are_seen() {
    let concept = Concept { name: "tea", file: "src/tea.rs", marks: &["fn brew"] };
    let file = |path: &str, text: &str| Source { path: path.into(), text: text.into() };
    let tea = file("src/tea.rs", "fn brew() {}");
    assert_eq!(misplaced(&concept, &[]).len(), 1);
    assert_eq!(misplaced(&concept, &[file("src/pot.rs", "fn brew() {}")]).len(), 2);
    none(misplaced(&concept, &[tea, file("src/pot.rs", "// fn brew() {}")]));
}
