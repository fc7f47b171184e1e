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

const CONCEPTS: [Concept; 32] = [
    Concept {
        name: "dispatch by the type of a method",
        file: "src/sim/integrators/mod.rs",
        marks: &["::CARD.id"],
    },
    Concept {
        name: "methods for systems of any type with one coordinate",
        file: "src/sim/integrators/problem.rs",
        marks: &["integrator(method, &0.0)"],
    },
    Concept {
        name: "tick of an adaptive method",
        file: "src/sim/integrators/shared/embedded_pair.rs",
        marks: &["step_size.begin_tick("],
    },
    Concept {
        name: "stability of a method on a motion",
        file: "src/sim/stability/comparison.rs",
        marks: &["linear_maps(stepper,"],
    },
    Concept {
        name: "step of a follower",
        file: "src/sim/integrators/follower.rs",
        marks: &["R::step("],
    },
    Concept {
        name: "tick of an engine",
        file: "src/sim/integrators/engine.rs",
        marks: &["R::tick("],
    },
    Concept {
        name: "speed limit",
        file: "src/sim/integrators/engine.rs",
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
        name: "difference quotient",
        file: "src/sim/difference.rs",
        marks: &["(*ahead - behind) / distance", "8.0 * (ahead - behind)"],
    },
    Concept {
        name: "copies of a body of the table, stepped at once",
        file: "src/sim/batch/mod.rs",
        marks: &["Alike(body.clone())"],
    },
    Concept {
        name: "largest magnitude",
        file: "src/sim/state.rs",
        marks: &["component.abs().to_bits()"],
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
        name: "times at several tick rates",
        file: "src/lab/time_scale.rs",
        marks: &["(tick - self.tick) as f64 /"],
    },
    Concept {
        name: "cubic between two states",
        file: "src/lab/race/interpolation.rs",
        marks: &["b * b * (1.0 + 2.0 * a)"],
    },
    Concept {
        name: "round marks along an axis",
        file: "src/view/chart/axis.rs",
        marks: &["digit * libm::pow(10.0, f64::from(decade))"],
    },
    Concept {
        name: "plane on the screen",
        file: "src/view/chart/area.rs",
        marks: &["clamp(-FAR_OUTSIDE"],
    },
    Concept { name: "legend", file: "src/view/chart/legend.rs", marks: &["SWATCH"] },
    Concept { name: "file of a chart", file: "src/view/chart/svg.rs", marks: &["struct Svg"] },
    Concept { name: "table", file: "src/view/panels/table.rs", marks: &["enum SortKey"] },
    Concept {
        name: "sign of a verdict",
        file: "src/view/panels/verdict.rs",
        marks: &["(1.15, 0.0)"],
    },
    Concept {
        name: "hash of a state",
        file: "src/lab/race/hash.rs",
        marks: &["0x0000_0100_0000_01b3"],
    },
    Concept {
        name: "file that appears whole",
        file: "src/atomic_file.rs",
        marks: &[".persist(", ".persist_noclobber("],
    },
    Concept {
        name: "exit code of an error",
        file: "src/commands/error.rs",
        marks: &["fn exit_code"],
    },
    Concept {
        name: "row of comma-separated values",
        file: "src/lab/csv_row.rs",
        marks: &["fn csv_row"],
    },
    Concept { name: "stroke", file: "src/view/strokes.rs", marks: &["fn mitre", "fn round_end"] },
    Concept {
        name: "table for programs",
        file: "src/commands/output/table.rs",
        marks: &["struct RowWriter"],
    },
    Concept {
        name: "report of a verification",
        file: "src/commands/verify/report.rs",
        marks: &["fn to_junit"],
    },
    Concept {
        name: "painter of a plot's curves",
        file: "src/view/chart/curves.rs",
        marks: &["PaintCallback {"],
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

/// Who steps a body or a lane of the lab by a length of time. A loop of ticks is [`Follow`](regatta::lab::Follow)'s, or
/// that of the run.
const STEPPERS: [(&str, &str); 11] = [
    ("src/lab/race/lane.rs", "a tick of a body, which may fail"),
    ("src/lab/race/follow.rs", "the loop of ticks outside the run"),
    ("src/lab/race.rs", "the tick of the run"),
    ("src/lab/pacing/paced_lane.rs", "the steps of a game loop"),
    ("src/lab/pacing/scripted_truth.rs", "the truth at the moments of display"),
    ("src/lab/past/truth_curve.rs", "the true curve between ticks"),
    ("src/lab/analysis/modes.rs", "the first step of a normal mode"),
    ("src/lab/analysis/survey.rs", "a step of the true motion"),
    ("src/lab/analysis/truth.rs", "the truth from input to input"),
    ("src/lab/studio/one_step.rs", "the anatomy of the next tick"),
    ("src/lab/analysis/chase_finding.rs", "the truth at the half-life"),
];

/// The lines of a source that call [`Stepper::advance`](regatta::sim::Stepper::advance) or
/// [`Lane::tick`](regatta::lab::Lane::tick): the methods of these names with three arguments.
fn steps(source: &Source) -> Vec<String> {
    let code = code(&source.text);
    let code = code.split("#[cfg(test)]").next().unwrap_or_default();
    let calls = [".advance(", ".tick("].map(|call| code.match_indices(call)).into_iter().flatten();
    let others = ["schedule", "accumulator"];
    let with_three = calls.filter(|(at, call)| {
        if others.iter().any(|other| code[..*at].ends_with(other)) {
            return false;
        }
        let (mut depth, mut commas) = (1, 0);
        for c in code[at + call.len()..].chars().take_while(|c| *c != ';') {
            match c {
                '(' | '[' | '{' => depth += 1,
                ')' | ']' | '}' => depth -= 1,
                ',' if depth == 1 => commas += 1,
                _ => {}
            }
            if depth == 0 {
                break;
            }
        }
        commas == 2
    });
    with_three.map(|(_, call)| format!("{} calls `{call}…)`", source.path)).collect()
}

#[test]
fn a_body_of_the_lab_is_ticked_by_one_loop_outside_the_run() {
    let is_own = |source: &Source| STEPPERS.iter().any(|(file, _)| *file == source.path);
    let is_watched = |source: &&Source| {
        let path = source.path.as_str();
        !path.starts_with("src/sim/") && !path.ends_with("tests.rs") && !is_own(source)
    };
    none(sources("src", &["rs"]).iter().filter(is_watched).flat_map(steps).collect());
    for (file, _) in STEPPERS {
        let source = sources("src/lab", &["rs"]).into_iter().find(|source| source.path == file);
        assert!(source.is_some_and(|source| !steps(&source).is_empty()), "{file} steps nothing");
    }
}

#[test]
fn a_second_loop_of_ticks_is_seen() {
    let source = |text: &str| Source { path: "src/lab/x.rs".into(), text: text.into() };
    let bad = "stepper.advance((tick - 1) as f64 / hz, 1.0 / hz, spec.substeps)?;";
    assert_eq!(steps(&source(bad)).len(), 1);
    assert_eq!(steps(&source("lane.tick(tick, t, h);")).len(), 1);
    none(steps(&source("lab.tick(); lab.advance(16_666_667); clock.advance(f(a, b, c));")));
}
