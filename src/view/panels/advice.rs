//! Which method to take for the scene at its tick rate: what is known by now, as a table.

use egui::{Grid, RichText, ScrollArea, Ui};

use super::{QUIET, TEXT, WELL, tone};
use crate::lab::number::{round, significant};
use crate::lab::{
    Advice, Advised, CRITERIA, Command, Lab, LaneSpec, MOST_ADVISED_SUBSTEPS, Meets, Met,
    recommended,
};

pub(super) fn show(ui: &mut Ui, lab: &Lab, commands: &mut Vec<Command>) {
    let Some(advice) = lab.advice() else {
        ui.label(RichText::new("judging every method …").color(QUIET));
        return;
    };
    let best: Vec<Option<usize>> = (0..CRITERIA.len()).map(|i| best(advice, i)).collect();
    summary(ui, advice, &best);
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        let columns = 2 + CRITERIA.len();
        let grid = Grid::new("advice").num_columns(columns).spacing([10.0, 2.0]);
        grid.min_row_height(15.0).show(ui, |ui| {
            head(ui, "method").on_hover_text("the row's verdict is in its tooltip");
            for criterion in &CRITERIA {
                head(ui, criterion.name()).on_hover_text(criterion.about());
            }
            ui.end_row();
            for (i, advised) in advice.advised.iter().enumerate() {
                row(ui, advised, &best, i, commands);
                ui.end_row();
            }
        });
    });
}

/// The method to take for a criterion.
fn best(advice: &Advice, criterion: usize) -> Option<usize> {
    recommended(&advice.advised, criterion, 1.0, |_, met| met.evaluations_per_s)
}

fn head(ui: &mut Ui, text: &str) -> egui::Response {
    ui.label(RichText::new(text).size(10.5).color(QUIET))
}

fn row(
    ui: &mut Ui,
    advised: &Advised,
    best: &[Option<usize>],
    index: usize,
    commands: &mut Vec<Command>,
) {
    let Advised { spec, verdict, met } = advised;
    ui.label(RichText::new(spec.method.name).color(tone(verdict.word)))
        .on_hover_text(verdict.to_string());
    for ((met, best), criterion) in met.iter().zip(best).zip(&CRITERIA) {
        let met = match met {
            Meets::With(met) => met,
            Meets::No => {
                let missed = format!("not with {MOST_ADVISED_SUBSTEPS} substeps");
                ui.label(RichText::new("-").color(QUIET)).on_hover_text(missed);
                continue;
            }
            Meets::Unknown => {
                ui.label(RichText::new("?").color(QUIET))
                    .on_hover_text("not known: there is no truth, or it takes too much work");
                continue;
            }
        };
        let colour = if *best == Some(index) { WELL } else { TEXT };
        let rate = whole(met.evaluations_per_s);
        let text = format!("use ×{} · {rate}/s", met.substeps);
        let used = ui.button(RichText::new(text).color(colour).size(11.5));
        let name = format!("{}: {}", criterion.name(), spec.method.name);
        used.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &name));
        if used.on_hover_text(told(met)).clicked() {
            commands.push(Command::Fly(LaneSpec { substeps: met.substeps, ..*spec }));
        }
    }
}

/// What is behind a cell.
fn told(met: &Met) -> String {
    format!(
        "use this: {} substep{} a tick, {} evaluations per simulated second; holds down to {} Hz, or {} × {}",
        met.substeps,
        if met.substeps == 1 { "" } else { "s" },
        whole(met.evaluations_per_s),
        met.slowest_hz,
        round(met.stiffness_factor, 3),
        met.limited_by,
    )
}

/// What to take, once all is known.
fn summary(ui: &mut Ui, advice: &Advice, best: &[Option<usize>]) {
    let done = advice.advised.len();
    if done < advice.wanted {
        let text = format!("judging every method: {done} of {} …", advice.wanted);
        ui.label(RichText::new(text).color(QUIET));
        return;
    }
    for (i, (criterion, best)) in CRITERIA.iter().zip(best).enumerate() {
        let taken = best.and_then(|row| {
            let advised = &advice.advised[row];
            Some((advised, advised.met[i].met()?))
        });
        let what = match taken {
            Some((advised, met)) => format!("{} ×{}", advised.spec.method.name, met.substeps),
            None => format!("none with up to {MOST_ADVISED_SUBSTEPS} substeps"),
        };
        let text = format!("at {} Hz, {}: {what}", advice.tick_hz, criterion.name());
        ui.label(RichText::new(text).color(TEXT));
    }
}

/// A count in as few figures as tell it.
fn whole(count: f64) -> String {
    if count < 1e5 { format!("{}", count.round()) } else { significant(count, 3) }
}
