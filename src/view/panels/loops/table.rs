//! The table of loops: key, line, name and verdict, then numbers. A click selects a loop, and one on the eye takes it off
//! the stage or brings it on.

use egui::Ui;

use super::columns;
use super::row::Row;
use crate::loops::loop_lab::LoopLab;
use crate::studio::Command;
use crate::view::panels::lanes::{ROW, height_of};
use crate::view::panels::table::Table;
use crate::view::theme::TYPE;

/// Rows in sight: the stage and the instrument need the room. The rest is scrolled to.
const MAX_ROWS: usize = 6;

pub(in crate::view::panels) fn height(loops: &LoopLab) -> f32 {
    height_of(loops.lanes().len().min(MAX_ROWS))
}

pub(in crate::view::panels) fn show(ui: &mut Ui, loops: &LoopLab, commands: &mut Vec<Command>) {
    table(loops).show(ui, groups(loops), commands, |_, _, _| {});
}

fn table(loops: &LoopLab) -> Table<Row<'_>> {
    let (columns, min_rest) = (columns::of(loops), |_| columns::MIN_VERDICT);
    Table { id: "loops", columns, min_rest, row_height: ROW, head_type: TYPE }
}

fn groups(loops: &LoopLab) -> Vec<Vec<Row<'_>>> {
    loops.listed().into_iter().map(|index| vec![Row::of(loops, index)]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::loops::loop_lab::LoopCommand;
    use crate::scene::Scene;
    use crate::studio::Studio;

    #[test]
    fn rows_are_sorted_by_their_verdicts_and_back() {
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        studio.apply(Command::Loop(LoopCommand::ToggleLab));
        studio.run_loops();
        let loops = studio.loop_lab().unwrap();
        let ranks = |order| -> Vec<Option<f64>> {
            let rows = table(loops).sorted(groups(loops), order).into_iter().flatten();
            rows.map(|row| row.verdict.rank).collect()
        };
        let [best_first, worst_first] =
            [false, true].map(|is_reversed| ranks(Some(("Verdict", is_reversed))));
        assert!(best_first.is_sorted() && worst_first.iter().rev().is_sorted());
        assert_eq!(best_first.len(), loops.lanes().len());
        assert_ne!(ranks(None), best_first);
    }
}
