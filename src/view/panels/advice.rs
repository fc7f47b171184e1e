//! Which method to take for the scene at its tick rate: what is known by now, as a table.

use egui::{Grid, Label, Response, RichText, ScrollArea, Ui};

use super::{ink, tone};
use crate::lab::number::significant;
use crate::lab::{
    Advice, CRITERIA, Command, CriterionMet, CriterionResult, Lab, LaneSpec, MOST_ADVISED_SUBSTEPS,
    MethodAdvice, recommended,
};

/// What is written in a cell.
const CELLS: &str = "in each cell: use ×substeps · evaluations/s";

pub(super) fn show(ui: &mut Ui, lab: &Lab, commands: &mut Vec<Command>) {
    let Some(advice) = lab.viewer().advice() else {
        ui.label(RichText::new("judging every method …").color(ink(ui).dim));
        return;
    };
    let best: Vec<Option<usize>> = (0..CRITERIA.len()).map(|i| best(advice, i)).collect();
    summary(ui, advice, &best);
    line(ui, RichText::new(CELLS).size(10.5).color(ink(ui).dim));
    ScrollArea::both().auto_shrink(false).show(ui, |ui| {
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

fn head(ui: &mut Ui, text: &str) -> Response {
    ui.label(RichText::new(text).size(10.5).color(ink(ui).dim))
}

/// A line above the table, which is cut off rather than to widen the panel.
fn line(ui: &mut Ui, text: RichText) {
    ui.add(Label::new(text).truncate());
}

fn row(
    ui: &mut Ui,
    advised: &MethodAdvice,
    best: &[Option<usize>],
    index: usize,
    commands: &mut Vec<Command>,
) {
    let MethodAdvice { spec, verdict, met } = advised;
    ui.label(RichText::new(spec.method.name).color(tone(ui, verdict.outcome)))
        .on_hover_text(verdict.to_string());
    for ((met, best), criterion) in met.iter().zip(best).zip(&CRITERIA) {
        let met = match met {
            CriterionResult::With(met) => met,
            CriterionResult::No => {
                let missed = format!("not with {MOST_ADVISED_SUBSTEPS} substeps");
                ui.label(RichText::new("-").color(ink(ui).dim)).on_hover_text(missed);
                continue;
            }
            CriterionResult::Unknown => {
                ui.label(RichText::new("?").color(ink(ui).dim))
                    .on_hover_text("not known: there is no truth, or it takes too much work");
                continue;
            }
        };
        let colour = if *best == Some(index) { ink(ui).good } else { ink(ui).text };
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
fn told(met: &CriterionMet) -> String {
    format!(
        "use this: {} substep{} a tick, {} evaluations per simulated second; {}",
        met.substeps,
        if met.substeps == 1 { "" } else { "s" },
        whole(met.evaluations_per_s),
        met.margins(),
    )
}

/// What to take, once all is known.
fn summary(ui: &mut Ui, advice: &Advice, best: &[Option<usize>]) {
    let done = advice.advised.len();
    if done < advice.wanted {
        let text = format!("judging every method: {done} of {} …", advice.wanted);
        line(ui, RichText::new(text).color(ink(ui).dim));
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
        line(ui, RichText::new(text).color(ink(ui).text));
    }
}

/// A count in as few figures as tell it.
fn whole(count: f64) -> String {
    if count < 1e5 { format!("{}", count.round()) } else { significant(count, 3) }
}

#[cfg(test)]
mod tests {
    use egui::{
        Context, Event, Modifiers, MouseWheelUnit, Pos2, RawInput, Rect, Shape, TouchPhase, vec2,
    };

    use super::*;
    use crate::lab::{Instrument, Scene};
    use crate::view::panels;
    use crate::view::theme;

    /// Shows a frame of this size. Returns the stage and every text that is seen whole.
    fn frame(
        context: &Context,
        lab: &Lab,
        size: [f32; 2],
        events: Vec<Event>,
    ) -> (Rect, Vec<String>) {
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, size.into()));
        let input = RawInput { screen_rect, events, ..RawInput::default() };
        let mut stage = Rect::NOTHING;
        let mut output = context.run_ui(input, |ui| stage = panels::show(ui, lab).1);
        output.textures_delta.clear();
        let texts = output.shapes.iter().filter_map(|shape| match &shape.shape {
            Shape::Text(text) => {
                let is_seen = shape.clip_rect.contains_rect(text.visual_bounding_rect());
                is_seen.then(|| text.galley.text().to_owned())
            }
            _ => None,
        });
        (stage, texts.collect())
    }

    #[test]
    fn the_table_keeps_off_the_stage_and_its_last_column_can_be_reached() {
        let mut lab = Lab::new(Scene::built_in("spring").unwrap());
        lab.apply(Command::Instrument(Instrument::Advice));
        lab.analyse();
        assert_eq!(
            lab.viewer().advice().map(|advice| advice.advised.len()),
            lab.viewer().advice().map(|a| a.wanted)
        );
        for size in [[800.0, 600.0], [900.0, 600.0], [1024.0, 640.0], [1280.0, 720.0]] {
            let context = Context::default();
            theme::dress(&context);
            let stage_to = size[0] * (1.0 - panels::INSTRUMENTS);
            for _ in 0..3 {
                let (stage, texts) = frame(&context, &lab, size, Vec::new());
                assert!((stage.right() - stage_to).abs() < 1.0, "{size:?}: {stage:?}");
                assert!(texts.iter().any(|text| text == CELLS), "{size:?}: {texts:?}");
            }
            let events = vec![
                Event::PointerMoved(Pos2::new(0.9 * size[0], 0.57 * size[1])),
                Event::MouseWheel {
                    unit: MouseWheelUnit::Point,
                    source: egui::MouseWheelSource::Unknown,
                    delta: vec2(-1000.0, 0.0),
                    phase: TouchPhase::Move,
                    modifiers: Modifiers::NONE,
                },
            ];
            frame(&context, &lab, size, events);
            let last = CRITERIA[CRITERIA.len() - 1].name();
            let mut frames = (0..60).map(|_| frame(&context, &lab, size, Vec::new()).1);
            assert!(frames.any(|texts| texts.iter().any(|text| text == last)), "{size:?}");
        }
    }
}
