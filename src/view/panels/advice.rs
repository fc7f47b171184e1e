//! Which method and tick rate to take for the scene: what is known by now, as a table.

use egui::{Grid, RichText, ScrollArea, Ui};

use super::{QUIET, TEXT, WELL, tone};
use crate::lab::number::significant;
use crate::lab::{Advice, Advised, Lab, TOLERANCE, cheapest, duration};

pub(super) fn show(ui: &mut Ui, lab: &Lab) {
    let Some(advice) = lab.advice() else {
        ui.label(RichText::new("judging every method …").color(QUIET));
        return;
    };
    let best = cheapest(&advice.advised, |_, good| good.evaluations_per_s);
    summary(ui, advice, best);
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        Grid::new("advice").num_columns(5).spacing([12.0, 2.0]).min_row_height(15.0).show(
            ui,
            |ui| {
                let now = format!("at {} Hz", advice.tick_hz);
                for head in ["method", &now, "stable from", "accurate from", "evaluations/s"] {
                    ui.label(RichText::new(head).size(10.5).color(QUIET));
                }
                ui.end_row();
                for (i, advised) in advice.advised.iter().enumerate() {
                    row(ui, advised, Some(i) == best);
                    ui.end_row();
                }
            },
        );
    });
}

fn row(ui: &mut Ui, advised: &Advised, is_best: bool) {
    let Advised { spec, verdict, stable_hz, accurate_hz, good } = advised;
    ui.label(RichText::new(spec.method.name).color(if is_best { WELL } else { TEXT }));
    ui.label(RichText::new(verdict.word.text()).color(tone(verdict.word)))
        .on_hover_text(verdict.to_string());
    let rate = |hz: &Option<u32>| hz.map_or("-".into(), |hz| format!("{hz} Hz"));
    ui.label(rate(stable_hz));
    ui.label(rate(accurate_hz));
    let cost = good.as_ref().map(|good| significant(good.evaluations_per_s, 3));
    ui.label(cost.unwrap_or_else(|| "-".into()));
}

/// What to take, once all is known.
fn summary(ui: &mut Ui, advice: &Advice, best: Option<usize>) {
    let bounds = format!(
        "within {} % of the amplitude over {}",
        100.0 * TOLERANCE,
        duration(advice.horizon_s)
    );
    let done = advice.advised.len();
    let best = best.and_then(|i| {
        let advised = &advice.advised[i];
        Some((advised, advised.good.as_ref()?))
    });
    let text = match best {
        _ if done < advice.wanted => {
            format!("judging every method: {done} of {} …", advice.wanted)
        }
        Some((advised, good)) => format!(
            "take {} at {} Hz: the fewest evaluations of those stable and {bounds}",
            advised.spec.method.name, good.tick_hz
        ),
        None => format!("no method is stable and {bounds}"),
    };
    ui.label(RichText::new(text).color(if done < advice.wanted { QUIET } else { TEXT }));
}
