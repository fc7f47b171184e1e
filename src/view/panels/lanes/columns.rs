//! The columns of the table of lanes.

use super::row::{self, Row};
use crate::panels::table::{Column, SortKey, TableRow, show_words};
use crate::run::race::Mode;
use crate::run::{METRICS, Metric};
use crate::stage::number::{round, significant};
use crate::studio::Studio;

/// Minimum width of the verdict, and its minimum width beside extra columns, in points. Extra columns repeat the stage
/// or an instrument, and have priorities from `EXTRAS` on.
const MIN_VERDICT: f32 = 320.0;
const ROOMY_VERDICT: f32 = 820.0;
const EXTRAS: u8 = 5;

/// Returns the minimum width of the verdict beside columns up to this priority.
pub(super) fn min_verdict(priority: u8) -> f32 {
    if priority < EXTRAS { MIN_VERDICT } else { ROOMY_VERDICT }
}

/// Returns the columns of the table in a run.
pub(super) fn of<'a>(studio: &Studio) -> Vec<Column<Row<'a>>> {
    let is_solo = studio.mode() == Mode::Solo;
    let mut truths = studio.race().truth().bodies().iter();
    // The stage says once that there is no truth, so the table has no columns that compare with it.
    let has_truth = truths.clone().any(|body| body.halted().is_none());
    let mut columns: Vec<_> = marks().into();
    if is_solo {
        // The digit and the name of the method appear above the table in solo mode.
        columns.retain(|column| column.name == "line");
    }
    if is_solo && studio.scene().bodies.len() > 1 {
        columns.push(Column { priority: 1, ..body() });
    }
    columns.push(verdict(studio));
    if studio.viewer.is_asked() {
        return columns;
    }
    let attitude_error = METRICS[Metric::ATTITUDE_ERROR].measure;
    if truths.clone().all(|body| attitude_error(body, body).is_some()) {
        columns.push(attitude());
    } else {
        columns.push(position());
        if is_solo && has_truth {
            columns.push(exact());
        }
        if has_truth {
            columns.push(error());
        }
    }
    if truths.clone().any(|body| body.chase().is_some()) {
        columns.extend(chase());
    }
    if truths.any(|body| body.chase().is_none()) {
        columns.push(energy());
    }
    columns.push(evaluations());
    if !is_solo {
        columns.push(cost());
    }
    columns
}

/// Returns the columns of the key, the line and the method.
fn marks<'a>() -> [Column<Row<'a>>; 3] {
    let index = |row: &Row<'a>| row.is_first.then_some(row.entry);
    let about = "the key that switches to this method, or selects its lane in a race";
    let key = Column::key(about, index);
    let about = "the line of this method in the plots and on the stage";
    let line = Column::line(about, index);
    let about = "the integrator of this lane; × is its substeps, a small number its tolerance";
    let method = Column::shown(
        "Method",
        158.0,
        about,
        |ui, row: &Row<'a>, rect, _| {
            if row.is_first {
                let is_strong = row.entry == row.studio.active();
                show_words(ui, rect, &row.head(), is_strong, row.text(ui));
            }
        },
        |row| SortKey::Words(row.spec.method.name.into()),
    );
    [key, line, method]
}

fn body<'a>() -> Column<Row<'a>> {
    Column::shown(
        "Body",
        106.0,
        "the body of this row",
        |ui, row: &Row<'a>, rect, _| show_words(ui, rect, row.body_name(), false, row.text(ui)),
        |row| SortKey::Words(row.body_name().into()),
    )
}

/// Returns the column of verdicts. Its head names the judged body if all verdicts are about the same one. In a race,
/// the head also names the body whose numbers follow.
fn verdict<'a>(studio: &Studio) -> Column<Row<'a>> {
    let about = "what follows under this method at this tick rate: its worst body, from the last change of the run on; \
                 click to sort from best to worst";
    let bodies = &studio.scene().bodies;
    let whose = row::judged_body(studio).map(|body| format!(" ({})", bodies[body].name));
    let head = format!("Verdict{}", whose.unwrap_or_default());
    let has_numbers_of_one = studio.mode() == Mode::Race && bodies.len() > 1;
    let column = Column::verdict(about, Row::verdict_text);
    let beside_head = has_numbers_of_one.then(|| format!("{}:", bodies[studio.view().body].name));
    Column { beside_head, ..column.headed(head) }
}

fn position<'a>() -> Column<Row<'a>> {
    let about = "first coordinate of the body in this lane";
    let text = |row: &Row<'a>| row.in_unit(row.position()?);
    Column::number("position", (88.0, 5), about, text, Row::position)
}

fn exact<'a>() -> Column<Row<'a>> {
    let about = "the same coordinate of the exact solution";
    let text = |row: &Row<'a>| row.in_unit(row.exact()?);
    Column::number("exact", (88.0, 7), about, text, Row::exact)
}

fn error<'a>() -> Column<Row<'a>> {
    let text = |row: &Row<'a>| row.in_unit(row.largest_error()?);
    let about = "largest difference from the exact solution in a coordinate since the start";
    Column::number("error", (88.0, 2), about, text, Row::largest_error).headed("largest error")
}

/// Returns the error of a body that turns in space, whose coordinates mean nothing to a person.
fn attitude<'a>() -> Column<Row<'a>> {
    let about = "angle between the attitudes of the body in this lane and of the exact solution";
    let text =
        |row: &Row<'a>| Some(format!("{}°", significant(row.attitude_error()?.to_degrees(), 3)));
    Column::number("attitude error", (104.0, 2), about, text, Row::attitude_error)
}

/// Returns the measures of a body that follows a target.
fn chase<'a>() -> [Column<Row<'a>>; 2] {
    let half_life = Column::number(
        "half-life",
        (88.0, 1),
        "time in which the body covered half of the way to its target; for a method that does not run, the verdict's",
        |row: &Row<'a>| Some(format!("{} ms", significant(row.half_life_ms()?, 3))),
        Row::half_life_ms,
    );
    let overshoot = Column::number(
        "overshoot",
        (88.0, 1),
        "how far the body went beyond its target, in percent of the way",
        |row: &Row<'a>| Some(format!("{} %", significant(row.overshoot_percent()?, 3))),
        Row::overshoot_percent,
    );
    [half_life, overshoot]
}

fn energy<'a>() -> Column<Row<'a>> {
    let text = |row: &Row<'a>| {
        let (energy, unit) = row.energy()?;
        let sign = if energy > 0.0 && row.has_truth() { "+" } else { "" };
        Some(format!("{sign}{} {unit}", significant(energy, 3)))
    };
    let about = "energy gained or lost by now, in percent of the energy that the exact swing exchanges, or else of the most \
                 that the exact body had; in joules if neither is known; without a truth, all the energy of the \
                 body";
    Column::number("energy", (98.0, 3), about, text, |row| Some(row.energy()?.0))
}

fn evaluations<'a>() -> Column<Row<'a>> {
    Column::number(
        "evaluations",
        (84.0, 6),
        "evaluations of this body's acceleration since the start",
        |row: &Row<'a>| row.evaluations().map(|count| format!("{count}")),
        |row| row.evaluations().map(|count| count as f64),
    )
}

fn cost<'a>() -> Column<Row<'a>> {
    Column::number(
        "cost",
        (48.0, 4),
        "evaluations per tick; explicit Euler with one substep costs 1 ×",
        |row: &Row<'a>| Some(format!("{} ×", round(row.cost()?, 3))),
        Row::cost,
    )
}

#[cfg(test)]
mod tests {
    use crate::measure::Severity;
    use crate::panels::lanes;
    use crate::scene::Scene;
    use crate::studio::guide::STOPS;
    use crate::studio::{StageCommand, Studio, ViewCommand};
    use crate::tests::testing::TestWindow;

    #[test]
    fn a_missing_truth_is_reported_once_on_the_stage_and_in_no_cell() {
        let mut studio = Studio::new(Scene::built_in("cloth").unwrap());
        studio.apply(StageCommand::ToggleRace);
        studio.tick();
        assert!(studio.race().truth().bodies()[0].halted().is_some());
        let names: Vec<_> =
            lanes::table(&studio).fitting(1264.0).iter().map(|it| it.0.name).collect();
        assert!(!names.contains(&"error") && names.contains(&"Verdict"), "{names:?}");
        let (_, shown) = TestWindow::new([1280.0, 720.0]).panels(&studio, Vec::new());
        assert!(!shown.words().iter().any(|text| text == "no truth"));
        let picture = crate::stage::compose(&studio, [780.0, 440.0]);
        let said = picture.labels.iter().filter(|it| it.text.starts_with("Too many springs"));
        assert_eq!(said.count(), 1);
    }

    #[test]
    fn the_table_hides_numbers_and_signs_before_a_prediction_in_the_guide() {
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        let names = |studio: &Studio| {
            let table = lanes::table(studio);
            let columns = table.fitting(1904.0);
            columns.iter().map(|it| it.0.name).collect::<Vec<_>>()
        };
        for stop in 0..STOPS.len() {
            studio.apply(ViewCommand::GoToStop(stop));
            studio.analyse();
            let said = |studio: &Studio| lanes::verdict_on(studio, studio.active());
            let has_numbers = |name: &&str| !["line", "Body", "Verdict"].contains(name);
            let numbers: Vec<_> = names(&studio).into_iter().filter(has_numbers).collect();
            assert!(numbers.is_empty(), "stop {stop}: {numbers:?}");
            assert_eq!(said(&studio).whole(), "after your prediction");
            assert!(
                (0..studio.entries().len())
                    .all(|entry| lanes::verdict_on(&studio, entry).sign.is_none())
            );
            studio.apply(ViewCommand::Predict(0));
            assert!(names(&studio).len() > 4 && said(&studio).sign.is_some(), "stop {stop}");
        }
    }

    #[test]
    fn no_method_is_fine_beside_a_swing_that_has_grown_under_another() {
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        studio.analyse();
        let rk4 = studio.entries().iter().position(|entry| entry.method.id == "rk4").unwrap();
        let on = |studio: &Studio, entry| lanes::verdict_on(studio, entry);
        assert_eq!(on(&studio, rk4).sign.unwrap().1, Severity::Fine);
        let of_here = on(&studio, studio.active()).whole().to_owned();
        studio.tick();
        let rk4s = on(&studio, rk4);
        assert_eq!(rk4s.sign.unwrap().1, Severity::Unknown);
        assert!(rk4s.whole().starts_with("from the start: "), "{}", rk4s.whole());
        assert_eq!(on(&studio, studio.active()).whole(), of_here);
    }

    #[test]
    fn values_already_on_the_stage_have_a_column_only_if_there_is_room() {
        let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
        studio.apply(StageCommand::ToggleRace);
        let table = lanes::table(&studio);
        let names = |width: f32| -> Vec<&str> {
            table.fitting(width).iter().map(|(column, ..)| column.name).collect()
        };
        let narrow = ["Key", "line", "Method", "Verdict", "error", "energy", "cost"];
        assert_eq!(names(1264.0), narrow);
        let wide = ["position", "error", "energy", "evaluations", "cost"];
        assert_eq!(names(1904.0)[4..], wide);
    }
}
