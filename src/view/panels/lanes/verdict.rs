//! Verdicts in the rows of the table of lanes.

use crate::measure::{Outcome, Severity};
use crate::panels::verdict::VerdictText;
use crate::run::MenuIndex;
use crate::run::race::{Entrant, Mode};
use crate::studio::Studio;

/// Returns the verdict on the method at this index of the list, and on its lane if there is one. The verdict names the
/// judged body, unless the row is about that body alone or `named_above` is that body.
pub(super) fn text_of(
    studio: &Studio,
    entry: MenuIndex,
    entrant: Option<&Entrant>,
    (body, named_above): (Option<usize>, Option<usize>),
) -> VerdictText {
    if studio.viewer.is_asked() {
        let waits = vec!["after your prediction".into()];
        return VerdictText { sign: None, is_current: true, wordings: waits, rank: None };
    }
    let halts = entrant.into_iter().flat_map(|entrant| entrant.lane.halts());
    let mut halts: Vec<_> = halts.filter(|halt| body.is_none_or(|b| b == halt.body)).collect();
    // The displayed body comes first, because there may not be room for all halts.
    halts.sort_by_key(|halt| halt.body != studio.view().body);
    if let Some(first) = halts.first() {
        let did = first.ending();
        let several = studio.scene().bodies.len() > 1 && body.is_none();
        let name = |body: usize| match several && named_above != Some(body) {
            true => format!(" ({})", studio.scene().bodies[body].name),
            false => String::new(),
        };
        let bodies = entrant.map_or(&[][..], |entrant| entrant.lane.bodies());
        let all = halts.iter().map(|halt| {
            let name = &studio.scene().bodies[halt.body].name;
            format!("{name} {}", bodies[halt.body].fate().unwrap_or_default())
        });
        let short = format!("{}{}", first.fate(), name(first.body));
        let all: Vec<String> = all.collect();
        let wordings = vec![all.join("; "), short, did.into()];
        return text(Outcome::of_halt(first), wordings);
    }
    let verdict = studio.viewer.verdict_from_here(&studio.deck, entry);
    let verdict = match body {
        Some(body) => verdict.and_then(|verdict| verdict.of_bodies.get(body)),
        None => verdict,
    };
    let Some(verdict) = verdict else {
        return VerdictText {
            sign: None,
            is_current: true,
            wordings: vec!["judging…".into()],
            rank: None,
        };
    };
    let is_named = body.is_none() && named_above != Some(verdict.body);
    let is_current = studio.viewer.is_judged_now(&studio.deck, entry);
    let text = VerdictText { is_current, ..text(verdict.outcome(), verdict.wordings(is_named)) };
    if entrant.is_none() && has_strayed(studio) { from_the_start(text) } else { text }
}

/// Whether the only lane has gone on with a visible error. A method that took over now would begin with that error,
/// which its own verdict lacks.
fn has_strayed(studio: &Studio) -> bool {
    let lane = &studio.selected().lane;
    let halted = || lane.halts().next().map(Outcome::of_halt);
    let judged = || studio.viewer.verdict_from_here(&studio.deck, studio.active());
    let outcome = || halted().or_else(|| Some(judged()?.outcome()));
    studio.mode() == Mode::Solo
        && studio.race().t() > studio.run().checkpoints().verdicts_start_at_s()
        && matches!(outcome().map(Outcome::severity), Some(Severity::Doubtful | Severity::Bad))
}

/// Says that a verdict holds only if its method had run from the start. Its sign has no colour.
fn from_the_start(text: VerdictText) -> VerdictText {
    let sign = text.sign.map(|(sign, _)| (sign, Severity::Unknown));
    let wordings = text.wordings.iter().map(|words| format!("from the start: {words}")).collect();
    VerdictText { sign, wordings, ..text }
}

fn text(outcome: Outcome, wordings: Vec<String>) -> VerdictText {
    let rank = Outcome::ALL.iter().position(|known| *known == outcome).map(|index| index as f64);
    let sign = Some((outcome.sign(), outcome.severity()));
    VerdictText { sign, is_current: true, wordings, rank }
}
