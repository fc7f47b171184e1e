//! The verdicts and the advice of a studio: which of them to compute, and which findings to accept.

use std::sync::Arc;

use super::deck::Deck;
use super::instrument::Instrument;
use super::viewer::Viewer;
use crate::measure::{AdvisedBodies, AnalysisRequest, AnalysisWorker, Findings, MapRequest};
use crate::run::race::{Entrant, Interventions, Mode};
use crate::scene::SceneBody;
use crate::sim::bodies::{Parameter, Range, TakesEffect};

/// Returns the request to an [`AnalysisWorker`] for the verdicts and the advice that the studio needs now. Each
/// [offered](Deck::offered) method is judged at the present tick rate. In a race the rest of the menu is judged too.
/// The advice is included while it is shown.
///
/// The findings apply to the scene from its start, with a person's settings and the parameters that the script has set
/// by the present tick. If a person has placed or kicked a body, the findings start at the true state right after that.
pub fn analysis_request(deck: &Deck, viewer: &Viewer) -> AnalysisRequest {
    let flown = deck.race().entrants().iter().map(|lane| deck.entry(lane) + 1);
    let first = flown.max().unwrap_or_default().max(deck.offered());
    let count = match deck.mode() {
        Mode::Solo => first,
        Mode::Race => deck.entries().len(),
    };
    AnalysisRequest {
        scene: Arc::clone(&deck.run.next().scene),
        by_hand: Interventions::in_race(deck.race(), deck.run().checkpoints()),
        entries: (0..count).map(|entry| deck.spec(entry)).collect(),
        first,
        tick_hz: deck.clock.tick_hz(),
        advice: (viewer.display().instrument == Instrument::Advice)
            .then(|| advised_bodies(deck, viewer)),
        map: (viewer.display().instrument == Instrument::StabilityMap)
            .then(|| map_request(deck, viewer))
            .flatten(),
    }
}

/// Returns the bodies that advice is about.
fn advised_bodies(deck: &Deck, viewer: &Viewer) -> AdvisedBodies {
    match viewer.display().advises_on_one_body && deck.scene().bodies.len() > 1 {
        true => AdvisedBodies::One(viewer.view.body),
        false => AdvisedBodies::All,
    }
}

/// Returns the request for a map of the scene's lanes, and of the selected method, at the present values.
fn map_request(deck: &Deck, viewer: &Viewer) -> Option<MapRequest> {
    let (body, parameter) = (viewer.view.body, mapped_parameter(deck, viewer)?);
    let lanes = 0..deck.scene().lanes.len();
    let other = Some(deck.active()).filter(|active| !lanes.contains(active));
    let specs = lanes.chain(other).map(|entry| (entry, deck.entries()[entry])).collect();
    let opened = &deck.scene_as_opened().bodies[body];
    let values = deck.race().values(body);
    Some(MapRequest::new((body, parameter), opened, values, deck.clock.tick_hz(), specs))
}

/// Returns the indices of the displayed body's parameters that a stability map can show. These parameters act at once.
/// They cannot be negative, so that their scale can be logarithmic.
pub fn mappable_parameters(deck: &Deck, viewer: &Viewer) -> impl Iterator<Item = usize> {
    let SceneBody { kind, values, .. } = &deck.scene().bodies[viewer.view.body];
    let parameters = kind.parameters.iter();
    let is_mappable = |(index, parameter): &(usize, &Parameter)| {
        // A constant of a law may have any sign.
        let is_constant = kind.law().is_some_and(|law| *index < law.text().constants.len());
        let is_signless = is_constant && values[*index] > 0.0
            || matches!(parameter.range, Range::Positive(_) | Range::NonNegative(_));
        parameter.acts == TakesEffect::AtOnce && is_signless
    };
    parameters.enumerate().filter(is_mappable).map(|(index, _)| index)
}

/// Returns the index of the parameter on the stability map. It is the one chosen for the displayed body, or else the
/// one that makes the body stiffer. Returns `None` if the body has neither.
pub fn mapped_parameter(deck: &Deck, viewer: &Viewer) -> Option<usize> {
    let body = viewer.view.body;
    let chosen = viewer.view.mapped_parameter.filter(|(of, _)| *of == body);
    let kind = &deck.scene().bodies[body].kind;
    let leading = kind.parameter(&kind.leading).map(|(index, _)| index);
    let mut indices = mappable_parameters(deck, viewer);
    let wanted = chosen.map(|(_, index)| index).or(leading);
    let first = indices.next()?;
    Some(
        wanted.filter(|&wanted| wanted == first || indices.any(|at| at == wanted)).unwrap_or(first),
    )
}

/// Accepts findings, unless they are about another scene.
pub fn accept_findings(deck: &mut Deck, viewer: &mut Viewer, findings: Findings) {
    if findings.request.is_of(&deck.run.next().scene) {
        viewer.findings = Some(findings);
        select_best(deck, viewer);
    }
}

/// Selects the best lane of a race once all lanes are judged, because the first lane may be the first to leave the
/// stage. Does nothing if anybody has selected a lane, or if the scene opens as a race under a method of its own.
pub(super) fn select_best(deck: &mut Deck, viewer: &mut Viewer) {
    let lanes = deck.race().entrants();
    let scene = deck.scene();
    let is_of_scene = scene.opens_as_race && scene.opening_method.is_some();
    if deck.is_selected || is_of_scene || deck.mode() == Mode::Solo {
        return;
    }
    let judged = |lane: &Entrant| {
        let entry = deck.entry(lane);
        Some((viewer.judged(entry)?.badness(), (lane.id, entry)))
    };
    let Some(judged) = lanes.iter().map(judged).collect::<Option<Vec<_>>>() else { return };
    let best = judged.into_iter().reduce(|best, other| if other.0 < best.0 { other } else { best });
    let Some((_, (number, entry))) = best else { return };
    deck.selected = number;
    deck.run.next_mut().entry = entry;
    deck.is_selected = true;
}

/// Computes the findings for the present request, as a capture does before each frame. Verdicts that exceed a fixed
/// amount of work stay unjudged. `finish` runs the worker to its end. If it is interrupted it returns `None`, and this
/// function returns `false`.
pub fn analyse_bounded(
    deck: &mut Deck,
    viewer: &mut Viewer,
    finish: impl FnOnce(AnalysisWorker) -> Option<Findings>,
) -> bool {
    let Some(request) = unanswered_request(deck, viewer) else { return true };
    let found = finish(AnalysisWorker::new(request).bounded());
    found.map(|findings| accept_findings(deck, viewer, findings)).is_some()
}

/// Returns the present request for verdicts and advice, or `None` if the findings answer all of it.
pub fn unanswered_request(deck: &Deck, viewer: &Viewer) -> Option<AnalysisRequest> {
    let request = analysis_request(deck, viewer);
    let known = &viewer.findings;
    (!known.as_ref().is_some_and(|known| known.answer(&request))).then_some(request)
}

#[cfg(test)]
mod tests {
    use crate::scene::Scene;
    use crate::studio::{StageCommand, Studio};

    #[test]
    fn solo_judges_the_offered_methods_and_a_race_also_the_others() {
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        let wanted = |studio: &Studio| {
            let request = studio.analysis_request();
            (request.first, request.entries.len())
        };
        let (few, all) = (studio.scene().lanes.len(), studio.entries().len());
        assert_eq!(wanted(&studio), (few, few));
        studio.apply(StageCommand::Pick(few + 2));
        assert_eq!(wanted(&studio), (few + 3, few + 3));
        studio.apply(StageCommand::ToggleRace);
        assert_eq!(wanted(&studio), (few + 3, all));
    }

    #[test]
    fn a_race_selects_its_best_lane_unless_a_person_selected_one() {
        for (lanes, picks, is_best) in [(10, false, true), (10, true, false), (5, false, true)] {
            let scene = Scene { seconds: 2.0, ..Scene::built_in("spring").unwrap() };
            let all = Studio::new(scene.clone()).entries()[..lanes].to_vec();
            let mut studio = Studio::new(Scene { lanes: all, ..scene });
            studio.apply(StageCommand::ToggleRace);
            if picks {
                studio.apply(StageCommand::Pick(0));
            }
            let first = studio.active();
            studio.analyse();
            let outcome =
                |entry: usize| studio.viewer.verdict(entry).expect("it is judged").outcome();
            let best = (0..lanes).map(outcome).min().expect("there are lanes");
            assert_eq!(studio.active() != first, is_best, "{lanes} lanes, picked: {picks}");
            assert_eq!(outcome(studio.active()) == best, is_best, "{lanes} lanes, picked: {picks}");
            let selected = studio.active();
            studio.apply(StageCommand::Restart);
            assert_eq!(studio.active(), selected);
        }
    }

    #[test]
    fn race_from_solo_selects_the_best_lane_unless_the_scene_names_one() {
        let brief = |name| Scene { seconds: 2.0, ..Scene::built_in(name).unwrap() };
        let mut studio = Studio::new(brief("spring"));
        studio.analyse();
        assert_eq!(studio.active(), 0, "alone it is what is opened");
        studio.apply(StageCommand::ToggleRace);
        let verdict = studio.viewer.verdict(studio.active()).expect("it is judged");
        assert!(verdict.outcome() <= studio.viewer.verdict(1).unwrap().outcome());
        assert_ne!(studio.active(), 0, "explicit Euler leaves the stage");
        let mut studio = Studio::new(brief("lerp"));
        studio.apply(StageCommand::ToggleRace);
        studio.deck.is_selected = false;
        let named = studio.active();
        studio.analyse();
        assert_eq!(studio.active(), named);
    }
}
