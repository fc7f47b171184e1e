//! Computes verdicts and advice in small steps, so that they can be computed outside the race's thread. An
//! [`AnalysisRequest`] goes in, and [`Findings`] come back.

use std::sync::Arc;

use super::advice::{Adviser, MethodAdvice, criterion_to_take, recommended};
use super::judge::{Judge, horizon_s};
use super::judged_run::MAX_WORK;
use super::pace::Pace;
use super::slices::{Meter, Sliced};
use super::stability_map::{MapRequest, MapWork, StabilityMap};
use super::verdict::Verdict;
use crate::run::race::Interventions;
use crate::scene::{LaneId, LaneSpec, Scene};
use crate::sim::TickRate;

/// The bodies of a scene that advice covers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AdvisedBodies {
    /// All bodies of the scene, under one method.
    #[default]
    All,
    /// The body with this index in the scene, alone.
    One(usize),
}

impl AdvisedBodies {
    fn of(self, scene: Scene) -> Scene {
        match self {
            AdvisedBodies::All => scene,
            AdvisedBodies::One(body) => scene.of_one_body(body),
        }
    }
}

/// The verdicts and the advice that a studio requests. Two requests of one `Studio` are
/// equal if they have the same answer.
#[derive(Clone, Debug)]
pub struct AnalysisRequest {
    /// The scene.
    pub scene: Arc<Scene>,
    /// The methods to judge, each with the lane from whose state it is judged; `None` for the true state.
    pub entries: Vec<(LaneSpec, Option<LaneId>)>,
    /// Number of lanes, from the first, that share the work limit of a bounded worker. The other lanes get the rest.
    pub first: usize,
    /// Tick rate of the judged run.
    pub tick_hz: TickRate,
    /// Edits to the judged run.
    pub by_hand: Interventions,
    /// Edits to the run that advice is about.
    pub advised: Interventions,
    /// The bodies to give advice on, if advice is requested.
    pub advice: Option<AdvisedBodies>,
    /// The stability map, if a map is requested.
    pub map: Option<MapRequest>,
}

impl PartialEq for AnalysisRequest {
    fn eq(&self, other: &Self) -> bool {
        let are_judged_alike = self.entries == other.entries && self.first == other.first;
        are_judged_alike && self.is_alike(other)
    }
}

impl AnalysisRequest {
    /// Whether the request is about this instance of the scene. An equal copy counts as another scene.
    pub fn is_of(&self, scene: &Arc<Scene>) -> bool {
        Arc::ptr_eq(&self.scene, scene)
    }

    /// Whether both requests are alike, apart from the lanes to judge.
    fn is_alike(&self, other: &Self) -> bool {
        self.is_of(&other.scene)
            && self.tick_hz == other.tick_hz
            && self.by_hand == other.by_hand
            && self.advice == other.advice
            && (self.advice.is_none() || self.advised == other.advised)
            && self.map == other.map
    }
}

/// The verdicts and the advice found up to now.
#[derive(Clone, Debug)]
pub struct Findings {
    /// The request that is answered.
    pub request: AnalysisRequest,
    /// The last verdict on each method of the list. A verdict may answer an earlier request about the same scene.
    pub verdicts: Vec<Option<Verdict>>,
    /// Number of verdicts, from the first, that answer this request.
    pub judged: usize,
    /// The advice, if it is requested.
    pub advice: Option<Advice>,
    /// The stability map, if it is requested.
    pub map: Option<StabilityMap>,
    /// Whether the request is answered in full.
    pub(super) complete: bool,
}

impl Findings {
    /// Whether these findings answer `request` in full. They may cover more lanes.
    pub fn answer(&self, request: &AnalysisRequest) -> bool {
        let are_judged = self.request.entries.starts_with(&request.entries);
        self.complete && are_judged && self.request.is_alike(request)
    }
}

/// The advice on every method for a scene.
#[derive(Clone, Debug)]
pub struct Advice {
    /// The bodies that the advice covers.
    pub bodies: AdvisedBodies,
    /// The requested rate in Hz.
    pub tick_hz: TickRate,
    /// Number of methods to judge.
    pub wanted: usize,
    /// The advice on the methods judged up to now.
    pub advised: Vec<MethodAdvice>,
    /// Whether all margins that affect the recommendation are searched, so that it is final.
    pub is_decided: bool,
}

impl Advice {
    /// Returns the indices of the method to take and of the criterion that it meets; `None` until this is final, or if
    /// no method is known to meet one.
    pub fn to_take(&self) -> Option<(usize, usize)> {
        let criterion = criterion_to_take(&self.advised).filter(|_| self.is_decided)?;
        Some((recommended(&self.advised, criterion)?, criterion))
    }
}

/// Work limit of a bounded worker for all verdicts together, including the truth, which is a second or two.
const MAX_WORK_OF_ALL: u64 = MAX_WORK;

/// Approximate work of one step, which takes some milliseconds.
const WORK_OF_STEP: u64 = 1_000_000;

/// Answers one [`AnalysisRequest`] at a time, in the background.
pub struct AnalysisWorker {
    /// Work limit for all verdicts.
    max_work: u64,
    request: AnalysisRequest,
    judge: Option<Arc<Judge>>,
    /// Judges of the true motions from the states of lanes.
    of_lanes: Vec<(LaneId, Arc<Judge>)>,
    verdicts: Vec<Option<Verdict>>,
    /// Number of leading verdicts that answer the current request.
    judged: usize,
    advising: Option<AdviceInProgress>,
    /// The last requested map.
    mapping: Option<MapWork>,
    /// The part of the answer in progress.
    part: Option<Sliced<AnswerPart>>,
}

/// A part of the answer, computed in slices.
enum AnswerPart {
    Judge(Arc<Judge>),
    JudgeOfLane(LaneId, Arc<Judge>),
    Verdict(Box<Verdict>),
    Adviser(AdvisedBodies, Arc<Adviser>),
    /// The advice in this row, which is new or has more searched margins.
    Advised(usize, Box<MethodAdvice>),
}

/// Advice in progress. First the methods are judged one by one, then margins are searched one by one.
struct AdviceInProgress {
    bodies: AdvisedBodies,
    adviser: Arc<Adviser>,
    /// The lanes to advise on.
    lanes: Vec<LaneSpec>,
    advised: Vec<MethodAdvice>,
    /// Margins that remain to be searched, with the first one last; `None` until all methods are judged.
    margins: Option<Vec<(usize, usize)>>,
    is_decided: bool,
}

impl AdviceInProgress {
    fn new(bodies: AdvisedBodies, adviser: Arc<Adviser>) -> Self {
        let scene = adviser.scene();
        let place = |spec: &LaneSpec| scene.lanes.iter().position(|l| l.method == spec.method);
        let mut lanes = scene.advised_lanes();
        // Racing methods come first, because a person sees them.
        lanes.sort_by_key(|spec| place(spec).unwrap_or(usize::MAX));
        let (advised, margins) = (Vec::new(), None);
        Self { bodies, adviser, lanes, advised, margins, is_decided: false }
    }

    /// Returns the next method to judge or, if all are judged, the next margin to search.
    fn next(&mut self) -> Option<Sliced<AnswerPart>> {
        let adviser = self.adviser.clone();
        let meter = adviser.judge().meter().clone();
        let row = self.advised.len();
        if let Some(&spec) = self.lanes.get(row) {
            return Some(Sliced::new(meter, async move {
                AnswerPart::Advised(row, adviser.advice_on(spec).await.into())
            }));
        }
        let (row, criterion) = *self.margins.as_ref()?.last()?;
        let mut advice = self.advised[row].clone();
        Some(Sliced::new(meter, async move {
            adviser.search_margins(&mut advice, criterion).await;
            AnswerPart::Advised(row, advice.into())
        }))
    }

    fn accept(&mut self, row: usize, advice: MethodAdvice) {
        if let Some(margins) = &mut self.margins {
            self.advised[row] = advice;
            margins.pop();
            if !margins.is_empty() {
                return;
            }
        } else {
            self.advised.push(advice);
        }
        if self.advised.len() == self.lanes.len() {
            self.margins = Some(self.next_margins());
        }
    }

    /// Returns the margins to search next, with the first one last. Margins that affect the recommendation precede the
    /// others.
    fn next_margins(&mut self) -> Vec<(usize, usize)> {
        let mut margins = self.adviser.undecided_margins(&self.advised);
        if margins.is_empty() {
            self.is_decided = true;
            margins = self.adviser.worth_margins(&self.advised);
        }
        margins.reverse();
        margins
    }

    fn is_done(&self) -> bool {
        self.margins.as_ref().is_some_and(Vec::is_empty)
    }
}

impl AnalysisWorker {
    /// Creates a worker on `request`.
    pub fn new(request: AnalysisRequest) -> Self {
        let verdicts = vec![None; request.entries.len()];
        Self {
            max_work: u64::MAX,
            request,
            judge: None,
            of_lanes: Vec::new(),
            verdicts,
            judged: 0,
            advising: None,
            mapping: None,
            part: None,
        }
    }

    /// Returns the same worker with a work limit. It does not judge the lanes beyond the limit.
    pub fn bounded(self) -> Self {
        Self { max_work: MAX_WORK_OF_ALL, ..self }
    }

    /// Replaces the request. Results that also answer the new request are kept, but a part in progress is dropped.
    pub fn set_request(&mut self, request: AnalysisRequest) {
        self.set_map(&request);
        self.part = None;
        if !request.is_of(&self.request.scene) {
            let mapping = self.mapping.take();
            *self = Self { max_work: self.max_work, mapping, ..Self::new(request) };
            return;
        }
        let is_same_run = request.by_hand == self.request.by_hand;
        if !is_same_run {
            self.judge = None;
            self.of_lanes.clear();
        }
        let is_at_same_rate = is_same_run && request.tick_hz == self.request.tick_hz;
        if request.advised != self.request.advised || request.tick_hz != self.request.tick_hz {
            self.advising = None;
        }
        let pairs = request.entries.iter().zip(&self.request.entries);
        let unchanged = pairs.take_while(|(new, old)| new == old).count();
        self.judged = if is_at_same_rate { self.judged.min(unchanged) } else { 0 };
        self.verdicts.resize(request.entries.len(), None);
        if let Some(bodies) = request.advice {
            self.advising.take_if(|advising| advising.bodies != bodies);
        }
        self.request = request;
    }

    /// Updates the map's request. A map of another body is dropped.
    fn set_map(&mut self, request: &AnalysisRequest) {
        let Some(wanted) = &request.map else { return };
        let kind = &request.scene.bodies[wanted.body].kind;
        self.mapping = self.mapping.take().filter(|work| work.is_of(kind, wanted));
        if let Some(work) = &mut self.mapping {
            work.set_request(wanted.clone());
        }
    }

    /// Does one slice of work, on the map first and then on the next part of the answer. The parts are the truths, a
    /// missing verdict or, if none is missing, a method or a margin of the advice. Returns whether work remains.
    pub fn work(&mut self) -> bool {
        if let Some(wanted) = &self.request.map
            && !self.is_mapped()
        {
            // The map precedes the verdicts, because each verdict may take longer.
            let kind = &self.request.scene.bodies[wanted.body].kind;
            let new = || MapWork::new(kind.clone(), wanted.clone());
            self.mapping.get_or_insert_with(new).advance(WORK_OF_STEP);
        } else if let Some(mut part) = self.part.take().or_else(|| self.next_part()) {
            match part.resume(WORK_OF_STEP) {
                Some(found) => self.accept(found),
                None => self.part = Some(part),
            }
        }
        !self.is_done()
    }

    /// Returns the next part of the answer, if one is missing.
    fn next_part(&mut self) -> Option<Sliced<AnswerPart>> {
        let AnalysisRequest { scene, by_hand, advised, entries, first, tick_hz, advice, .. } =
            &self.request;
        let (tick_hz, meter) = (*tick_hz, Arc::<Meter>::default());
        if let Some(&(spec, lane)) = entries.get(self.judged) {
            let begins_later = by_hand.starts_at_s() > 0.0;
            let Some(judge) = self.judge.clone() else {
                let scene = by_hand.applied_to(scene);
                return Some(Sliced::new(meter.clone(), async move {
                    let horizon_s = horizon_s(&scene);
                    let judge = Judge::find(&scene, 1.0, horizon_s, meter).await;
                    AnswerPart::Judge(judge.beginning_later(begins_later).into())
                }));
            };
            let known = self.of_lanes.iter().find(|(id, _)| Some(*id) == lane);
            let of_lane = known.map(|(_, judge)| judge.clone());
            if let Some(lane) = lane.filter(|_| of_lane.is_none()) {
                let scene = by_hand.applied_to_lane(scene, lane);
                let meter = judge.meter().clone();
                return Some(Sliced::new(meter.clone(), async move {
                    let judge = Judge::find(&scene, 1.0, judge.horizon_s(), meter).await;
                    AnswerPart::JudgeOfLane(lane, judge.beginning_later(begins_later).into())
                }));
            }
            // Work that earlier verdicts did not use is left for later ones.
            let left = self.max_work.saturating_sub(judge.meter().counted());
            let sharers = if self.judged < *first { *first } else { entries.len() };
            let pace = Pace { spec, tick_hz };
            let share = (left / (sharers - self.judged) as u64).min(MAX_WORK);
            return Some(Sliced::new(judge.meter().clone(), async move {
                let Some(of_lane) = of_lane else {
                    return AnswerPart::Verdict(judge.verdict_within(share, pace).await.into());
                };
                let verdict = of_lane.verdict_within(share, pace).await;
                AnswerPart::Verdict(verdict.beside(&of_lane, &judge, tick_hz).await.into())
            }));
        }
        let bodies = (*advice)?;
        if let Some(advising) = &mut self.advising {
            return advising.next();
        }
        let scene = bodies.of(advised.applied_to(scene));
        Some(Sliced::new(meter.clone(), async move {
            AnswerPart::Adviser(bodies, Adviser::find(scene, 1.0, tick_hz, meter).await.into())
        }))
    }

    fn accept(&mut self, found: AnswerPart) {
        match found {
            AnswerPart::Judge(judge) => self.judge = Some(judge),
            AnswerPart::JudgeOfLane(lane, judge) => self.of_lanes.push((lane, judge)),
            AnswerPart::Verdict(verdict) => {
                let starts_at_s = self.request.by_hand.starts_at_s();
                self.verdicts[self.judged] = Some(verdict.starting_at(starts_at_s));
                self.judged += 1;
            }
            AnswerPart::Adviser(bodies, adviser) => {
                self.advising = Some(AdviceInProgress::new(bodies, adviser));
            }
            AnswerPart::Advised(row, advice) => {
                if let Some(advising) = &mut self.advising {
                    advising.accept(row, *advice);
                }
            }
        }
    }

    /// Whether a part of the answer is in progress, so that the findings are some steps old.
    pub fn is_within_a_part(&self) -> bool {
        let mapping = self.mapping.as_ref().filter(|_| self.request.map.is_some());
        self.part.is_some() || mapping.is_some_and(MapWork::is_within_a_part)
    }

    /// Works until the request is answered in full.
    pub fn finish(mut self) -> Findings {
        while self.work() {}
        self.findings()
    }

    /// Whether the map is complete, if one is requested.
    fn is_mapped(&self) -> bool {
        self.request.map.is_none() || self.mapping.as_ref().is_some_and(MapWork::is_done)
    }

    fn is_done(&self) -> bool {
        let advised = self.advising.as_ref().is_some_and(AdviceInProgress::is_done);
        let judged = self.judged == self.request.entries.len();
        judged && self.is_mapped() && (advised || self.request.advice.is_none())
    }

    /// Returns the findings up to now.
    pub fn findings(&self) -> Findings {
        let advice = self.advising.as_ref().filter(|_| self.request.advice.is_some());
        let advice = advice.map(
            |AdviceInProgress { bodies, adviser, lanes, advised, is_decided, .. }| Advice {
                bodies: *bodies,
                is_decided: *is_decided,
                tick_hz: adviser.tick_hz(),
                wanted: lanes.len(),
                advised: advised.clone(),
            },
        );
        Findings {
            request: self.request.clone(),
            verdicts: self.verdicts.clone(),
            judged: self.judged,
            advice,
            map: self.mapping.as_ref().filter(|_| self.request.map.is_some()).map(MapWork::map),
            complete: self.is_done(),
        }
    }
}

#[cfg(test)]
mod tests;
