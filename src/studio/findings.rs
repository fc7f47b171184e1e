//! The verdicts and the advice of a studio: what it requests, and how it takes the findings in.

use std::sync::Arc;

use super::Studio;
use super::instrument::Instrument;
use crate::measure::{AdvisedBodies, AnalysisRequest, AnalysisWorker, Findings, MapRequest};
use crate::run::race::{Entrant, Interventions, Mode};
use crate::scene::SceneBody;
use crate::sim::bodies::{Acts, Parameter, Range};

impl Studio {
    /// The verdicts and the advice that the studio wants at present, for a [`AnalysisWorker`]: a verdict at the present tick
    /// rate on each method that is [offered](Self::offered), in a race also on all others of the menu, and advice while it is
    /// shown.
    ///
    /// They are of the scene from its start, with what a person has set since and the parameters that the script has set
    /// by the present tick. If a person has placed or kicked a body, they are of the run from there: from the true state
    /// right after it.
    pub fn analysis_request(&self) -> AnalysisRequest {
        let flown = self.race().entrants().iter().map(|lane| self.entry(lane) + 1);
        let first = flown.max().unwrap_or_default().max(self.offered());
        let entries = match self.mode() {
            Mode::Solo => &self.entries()[..first],
            Mode::Race => self.entries(),
        };
        AnalysisRequest {
            scene: Arc::clone(&self.run.next().scene),
            by_hand: Interventions::in_race(self.race(), self.run().starts()),
            entries: entries.to_vec(),
            first,
            tick_hz: self.clock.tick_hz(),
            advice: (self.display().instrument == Instrument::Advice)
                .then(|| self.advised_bodies()),
            map: (self.display().instrument == Instrument::StabilityMap)
                .then(|| self.map_request())
                .flatten(),
        }
    }

    /// The bodies that advice is about.
    fn advised_bodies(&self) -> AdvisedBodies {
        match self.display().advises_on_one_body && self.scene().bodies.len() > 1 {
            true => AdvisedBodies::One(self.view().body),
            false => AdvisedBodies::All,
        }
    }

    /// The map of the scene's lanes, and of the selected method, at the present values.
    fn map_request(&self) -> Option<MapRequest> {
        let (body, parameter) = (self.view().body, self.mapped_parameter()?);
        let lanes = 0..self.scene().lanes.len();
        let other = Some(self.active()).filter(|active| !lanes.contains(active));
        let specs = lanes.chain(other).map(|entry| (entry, self.entries()[entry])).collect();
        let opened = &self.scene_as_opened().bodies[body];
        let values = self.race().values(body);
        Some(MapRequest::new((body, parameter), opened, values, self.clock.tick_hz(), specs))
    }

    /// The parameters of the displayed body that a stability map can show, by their indices: those that act at once and
    /// are not negative, so that they have a logarithmic scale.
    pub fn mappable_parameters(&self) -> impl Iterator<Item = usize> {
        let SceneBody { kind, values, .. } = &self.scene().bodies[self.view().body];
        let parameters = kind.parameters.iter();
        let is_mappable = |(index, parameter): &(usize, &Parameter)| {
            // The constants of a law may have any sign.
            let is_constant = kind.law().is_some_and(|law| *index < law.text().constants.len());
            let is_signless = is_constant && values[*index] > 0.0
                || matches!(parameter.range, Range::Positive(_) | Range::NonNegative(_));
            parameter.acts == Acts::AtOnce && is_signless
        };
        parameters.enumerate().filter(is_mappable).map(|(index, _)| index)
    }

    /// The parameter that the stability map shows: the one chosen for the displayed body, or else the one that makes it
    /// stiffer. `None` if the body has none.
    pub fn mapped_parameter(&self) -> Option<usize> {
        let body = self.view().body;
        let chosen = self.view().mapped_parameter.filter(|(of, _)| *of == body);
        let kind = &self.scene().bodies[body].kind;
        let leading = kind.parameter(&kind.leading).map(|(index, _)| index);
        let mut indices = self.mappable_parameters();
        let wanted = chosen.map(|(_, index)| index).or(leading);
        let first = indices.next()?;
        Some(
            wanted
                .filter(|&wanted| wanted == first || indices.any(|at| at == wanted))
                .unwrap_or(first),
        )
    }

    /// Keeps findings, unless they are about another scene.
    pub fn accept_findings(&mut self, findings: Findings) {
        if findings.request.is_of(&self.run.next().scene) {
            self.viewer.findings = Some(findings);
            self.select_best();
        }
    }

    /// Leaves the selection in a race to the verdicts, as if nobody had selected one: for a driver that has set up
    /// the studio by commands.
    pub fn leave_selection(&mut self) {
        self.viewer.is_selected = false;
    }

    /// Selects the best lane of a race once all are judged, if nobody has selected one, nor the scene that opens as a race:
    /// the first may be the first that leaves the stage.
    pub(super) fn select_best(&mut self) {
        let lanes = self.race().entrants();
        let scene = self.scene();
        let is_of_scene = scene.opens_as_race && scene.opening_method.is_some();
        if self.viewer.is_selected || is_of_scene || self.mode() == Mode::Solo {
            return;
        }
        let judged = |lane: &Entrant| {
            let entry = self.entry(lane);
            Some((self.viewer.verdict(entry)?.badness(), (lane.id, entry)))
        };
        let Some(judged) = lanes.iter().map(judged).collect::<Option<Vec<_>>>() else { return };
        let best =
            judged.into_iter().reduce(|best, other| if other.0 < best.0 { other } else { best });
        let Some((_, (number, entry))) = best else { return };
        self.viewer.selected = number;
        self.run.next_mut().entry = entry;
        self.viewer.is_selected = true;
    }

    /// Computes all requested verdicts and advice now.
    pub fn analyse(&mut self) {
        if let Some(request) = self.unanswered_request() {
            self.accept_findings(AnalysisWorker::new(request).finish());
        }
    }

    /// Computes what is requested, the verdicts within a stated amount of work, beyond which they are not judged: what a
    /// capture waits for before each frame. `finish` has the worker do all its steps; it returns `None` if it was
    /// interrupted, and this returns `false` then.
    pub fn analyse_bounded(
        &mut self,
        finish: impl FnOnce(AnalysisWorker) -> Option<Findings>,
    ) -> bool {
        let Some(request) = self.unanswered_request() else { return true };
        let found = finish(AnalysisWorker::new(request).bounded());
        found.map(|findings| self.accept_findings(findings)).is_some()
    }

    /// The verdicts and advice that are wanted, unless the findings answer them in full.
    pub fn unanswered_request(&self) -> Option<AnalysisRequest> {
        let request = self.analysis_request();
        let known = &self.viewer.findings;
        (!known.as_ref().is_some_and(|known| known.answer(&request))).then_some(request)
    }
}

#[cfg(test)]
mod tests {
    use crate::scene::Scene;
    use crate::studio::{StageCommand, Studio};

    #[test]
    fn solo_the_methods_that_are_offered_are_judged_and_in_a_race_the_others_after_them() {
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
    fn of_a_race_the_best_lane_is_selected_unless_somebody_has_selected_one() {
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
                |entry: usize| studio.viewer().verdict(entry).expect("it is judged").outcome();
            let best = (0..lanes).map(outcome).min().expect("there are lanes");
            assert_eq!(studio.active() != first, is_best, "{lanes} lanes, picked: {picks}");
            assert_eq!(outcome(studio.active()) == best, is_best, "{lanes} lanes, picked: {picks}");
            let selected = studio.active();
            studio.apply(StageCommand::Restart);
            assert_eq!(studio.active(), selected);
        }
    }

    #[test]
    fn a_race_that_is_entered_from_solo_has_a_lane_that_stays_in_front_and_one_that_a_scene_names_its_own()
     {
        let brief = |name| Scene { seconds: 2.0, ..Scene::built_in(name).unwrap() };
        let mut studio = Studio::new(brief("spring"));
        studio.analyse();
        assert_eq!(studio.active(), 0, "alone it is what is opened");
        studio.apply(StageCommand::ToggleRace);
        let verdict = studio.viewer().verdict(studio.active()).expect("it is judged");
        assert!(verdict.outcome() <= studio.viewer().verdict(1).unwrap().outcome());
        assert_ne!(studio.active(), 0, "explicit Euler leaves the stage");
        let mut studio = Studio::new(brief("lerp"));
        studio.apply(StageCommand::ToggleRace);
        studio.leave_selection();
        let named = studio.active();
        studio.analyse();
        assert_eq!(studio.active(), named);
    }
}
