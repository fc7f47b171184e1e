//! Advice on the method for a scene at its tick rate. It gives the fewest substeps that meet each of three criteria. It
//! also gives how much lower the rate or how much stiffer the bodies could be.

use std::sync::Arc;

pub use super::criterion::CriterionMet;
use super::criterion::{CRITERIA, Criterion};
use super::judge::{CriterionFinding, FULL_THROTTLE, Judge, horizon_s};
use super::judged_run::MAX_WORK;
use super::outcome::Outcome;
use super::pace::Pace;
use super::rank::Ranking;
use super::searches::{
    FACTORS, FINE_FACTORS, PARTS_OF_STRIDE, RatesDown, fine_factor, tried_substeps,
};
use super::slices::{Meter, Once, block_on};
use super::verdict::{Finding, NotJudged, Verdict};
use crate::scene::{LaneSpec, Scene, SceneBody, edited_values};
use crate::sim::TickRate;
use crate::sim::integrators::Method;
use crate::sim::stability::RateSearch;

/// Maximum number of substeps per tick that is tried.
pub const MAX_ADVISED_SUBSTEPS: u32 = 64;

/// Each number of substeps up to this one is tried before [`MAX_ADVISED_SUBSTEPS`].
const FEW_SUBSTEPS: u32 = 8;

/// Work limit for one run of a stiffer scene, in the unit of [`MAX_WORK`](super::MAX_WORK). There are many such runs.
const WORK_WHEN_STIFFER: u64 = 10_000_000;

/// An accurate scene is borderline if the fraction of the tolerance that it leaves is smaller than this. The error at
/// coarse ticks has bumps, so that the factors in between are tried, too.
const SPARE_WHEN_STIFFER: f64 = 0.2;

/// Maximum number of coordinates of a body at which the margins of all methods are searched. If there are more
/// coordinates, runs are expensive, and only cheap methods have their margins searched.
const MANY_COORDINATES: usize = 8;

/// Maximum cost of such a cheap method, as a multiple of the cheapest method's cost.
const MAX_TIMES_CHEAPEST: f64 = 4.0;

/// The advice on one method for a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct MethodAdvice {
    /// The method.
    pub spec: LaneSpec,
    /// The verdict at the requested rate.
    pub verdict: Verdict,
    /// For each of [`CRITERIA`], whether and how the method meets it.
    pub met: [CriterionResult; CRITERIA.len()],
}

impl MethodAdvice {
    /// Returns the outcome with this number of substeps per tick, by the hardest criterion that the method is known to
    /// meet with it.
    pub fn outcome_with(&self, substeps: u32) -> Outcome {
        let meets = |i: &usize| self.met[*i].met().is_some_and(|met| met.substeps <= substeps);
        let hardest = (0..CRITERIA.len()).rev().find(meets);
        hardest.map_or(self.verdict.outcome(), |i| CRITERIA[i].outcome())
    }

    /// Searches the margins for the criterion with this index, if the method meets it.
    pub fn search_margins(&mut self, adviser: &Adviser, criterion: usize) {
        block_on(adviser.search_margins(self, criterion));
    }
}

/// Whether a method meets a criterion.
#[derive(Clone, Debug, PartialEq)]
pub enum CriterionResult {
    /// The method meets the criterion in this way.
    With(CriterionMet),
    /// The method fails with up to 8 substeps and with [`MAX_ADVISED_SUBSTEPS`]. Numbers in between are not searched in
    /// this case.
    No,
    /// The result is unknown, because it takes too much work, or because there is no truth.
    Unknown,
}

impl CriterionResult {
    /// Returns how the method meets the criterion, if it does.
    pub fn met(&self) -> Option<&CriterionMet> {
        match self {
            CriterionResult::With(met) => Some(met),
            CriterionResult::No | CriterionResult::Unknown => None,
        }
    }
}

/// Judges methods on a scene at one tick rate. Shared results are computed once, and several threads may use the
/// adviser at the same time.
pub struct Adviser {
    scene: Scene,
    judge: Judge,
    tick_hz: TickRate,
    /// Judges of stiffer scenes, by the index of the scene's [factor](fine_factor); `None` if no scene can be that
    /// stiff.
    stiffer: [Once<Option<Judge>>; FINE_FACTORS],
}

impl Adviser {
    /// Creates an adviser for `scene` under full throttle at this rate.
    pub fn new(scene: &Scene, tick_hz: impl Into<TickRate>) -> Self {
        Self::within(u64::MAX, scene, tick_hz.into())
    }

    /// Like [`Self::new`], with a limit on the total work in the unit of [`MAX_WORK`]. Results beyond the limit are
    /// unknown.
    pub(super) fn within(max_work: u64, scene: &Scene, tick_hz: TickRate) -> Self {
        let meter = Meter::within(max_work).into();
        block_on(Self::find(scene.clone(), FULL_THROTTLE, tick_hz, meter))
    }

    /// Returns a lane's method at the tick rate of the advice.
    fn pace(&self, spec: LaneSpec) -> Pace {
        Pace { spec, tick_hz: self.tick_hz }
    }

    /// Whether the work limit is reached.
    fn is_spent(&self) -> bool {
        self.judge.meter().budget_left() == 0
    }

    /// Like [`Self::new`], with `meter` as the counter of the adviser's work.
    pub(super) async fn find(
        scene: Scene,
        throttle: f64,
        tick_hz: TickRate,
        meter: Arc<Meter>,
    ) -> Self {
        let judge = Judge::find(&scene, throttle, horizon_s(&scene), meter).await;
        let stiffer = std::array::from_fn(|_| Once::default());
        Self { scene, judge, tick_hz, stiffer }
    }

    pub(super) fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Returns the judge of the scene.
    pub fn judge(&self) -> &Judge {
        &self.judge
    }

    /// Returns the requested rate in Hz.
    pub fn tick_hz(&self) -> TickRate {
        self.tick_hz
    }

    /// Returns the verdict on a lane at the requested rate.
    pub fn verdict(&self, spec: LaneSpec) -> Verdict {
        self.judge.verdict(spec, self.tick_hz)
    }

    /// Returns whether a method meets a criterion and, if it does, the fewest substeps and the margins. The substeps of
    /// `spec` are ignored.
    pub fn meets(&self, spec: LaneSpec, criterion: Criterion) -> CriterionResult {
        let mut result = block_on(self.fewest_substeps(spec, criterion));
        if let CriterionResult::With(met) = &mut result {
            block_on(self.add_margins(spec, criterion, met));
        }
        result
    }

    /// Returns the method recommended for a criterion, with its fewest substeps. The result is [`recommended`], found
    /// without judging more expensive methods.
    pub fn cheapest(
        &self,
        criterion: Criterion,
        methods: impl Iterator<Item = &'static Method>,
    ) -> Option<LaneSpec> {
        let least =
            |method: &Method| method.evaluations_per_tick(1).unwrap_or(1) * method.evaluation_cost;
        let mut methods: Vec<_> = methods.filter(|method| !method.is_as_printed()).collect();
        methods.sort_by_key(|method| std::cmp::Reverse(least(method)));
        let mut judged: Vec<(LaneSpec, CriterionMet)> = Vec::new();
        loop {
            let met = judged.iter().map(|(spec, met)| (spec.method, met)).enumerate();
            let ranking = Ranking::new(met);
            let (first, undecided) = (ranking.recommended_index(), ranking.undecided());
            let most = match undecided.is_empty() {
                true => ranking.most_cost_of_a_rival(),
                false => ranking.least_cost().unwrap_or(f64::INFINITY),
            };
            let at_least = |method: &&Method| {
                f64::from(least(method)) * f64::from(self.tick_hz) * self.scene.bodies.len() as f64
            };
            if let Some(method) = methods.pop_if(|method| at_least(&&**method) <= most) {
                let spec = LaneSpec::plain(method);
                if let CriterionResult::With(met) = block_on(self.fewest_substeps(spec, criterion))
                {
                    judged.push((spec, met));
                }
            } else if undecided.is_empty() || self.is_spent() {
                let (spec, met) = &judged[first?];
                return Some(LaneSpec { substeps: met.substeps, ..*spec });
            } else {
                for row in undecided {
                    let (spec, met) = &mut judged[row];
                    block_on(self.add_margins(*spec, criterion, met));
                }
            }
        }
    }

    /// Returns the verdict on a lane, and for each criterion the fewest substeps that meet it. Margins are not
    /// searched.
    pub fn judged(&self, spec: LaneSpec) -> MethodAdvice {
        block_on(self.advice_on(spec))
    }

    /// Like [`Self::judged`], as work in slices.
    pub(super) async fn advice_on(&self, spec: LaneSpec) -> MethodAdvice {
        let verdict = self.judge.verdict_within(MAX_WORK, self.pace(spec)).await;
        let mut met = [const { CriterionResult::Unknown }; CRITERIA.len()];
        // A method that takes too much work with one step per tick also does with more substeps, and in each run for
        // a criterion.
        if spec.substeps > 1 || verdict.finding != Finding::NotJudged(NotJudged::TooMuchWork) {
            for (met, criterion) in met.iter_mut().zip(CRITERIA) {
                *met = self.fewest_substeps(spec, criterion).await;
            }
        }
        MethodAdvice { spec, verdict, met }
    }

    /// Returns the unsearched margins that affect which method is [`recommended`], as indices of a method in `advised`
    /// and of a criterion that this method meets. Searching them may make further margins relevant.
    pub fn undecided_margins(&self, advised: &[MethodAdvice]) -> Vec<(usize, usize)> {
        if self.is_spent() {
            return Vec::new();
        }
        let of = |i: usize| ranking(advised, i).undecided().into_iter().map(move |row| (row, i));
        (0..CRITERIA.len()).flat_map(of).collect()
    }

    /// Searches margins until the recommendation is certain.
    pub fn search_until_decided(&self, advised: &mut [MethodAdvice]) {
        loop {
            let undecided = self.undecided_margins(advised);
            if undecided.is_empty() {
                return;
            }
            for (row, criterion) in undecided {
                advised[row].search_margins(self, criterion);
            }
        }
    }

    /// Returns the unsearched margins that are worth a search, as indices like those of [`Self::undecided_margins`].
    /// For a body with more than eight coordinates, only methods that cost at most four times the minimum are included.
    pub fn worth_margins(&self, advised: &[MethodAdvice]) -> Vec<(usize, usize)> {
        if self.is_spent() {
            return Vec::new();
        }
        let is_dear =
            |body: &SceneBody| body.kind.coordinates(&body.values).len() > MANY_COORDINATES;
        let has_dear = self.scene.bodies.iter().any(is_dear);
        let most = [0, 1, 2].map(|i| {
            let least = ranking(advised, i).least_cost().filter(|_| has_dear);
            least.map_or(f64::INFINITY, |least| MAX_TIMES_CHEAPEST * least)
        });
        let is_worth = |&(row, i): &(usize, usize)| {
            let met = advised[row].met[i].met();
            met.is_some_and(|met| met.cost_per_s <= most[i] && !met.are_margins_searched)
        };
        let margins = (0..advised.len()).flat_map(|row| (0..CRITERIA.len()).map(move |i| (row, i)));
        margins.filter(is_worth).collect()
    }

    /// Like [`MethodAdvice::search_margins`], as work in slices.
    pub(super) async fn search_margins(&self, advice: &mut MethodAdvice, criterion: usize) {
        if let CriterionResult::With(met) = &mut advice.met[criterion] {
            self.add_margins(advice.spec, CRITERIA[criterion], met).await;
        }
    }

    /// Searches the margins of a method that meets a criterion.
    async fn add_margins(&self, spec: LaneSpec, criterion: Criterion, met: &mut CriterionMet) {
        let spec = LaneSpec { substeps: met.substeps, ..spec };
        if self.is_spent() {
            return;
        }
        (met.stiffness_factor, met.limited_by) = self.stiffest(spec, criterion).await.unzip();
        met.slowest_hz = self.slowest_down(spec, criterion).await;
        met.are_margins_searched = true;
    }

    /// Returns whether a method meets a criterion, and with how many substeps. With one substep fewer it fails.
    async fn fewest_substeps(&self, spec: LaneSpec, criterion: Criterion) -> CriterionResult {
        let with = |substeps: u32| LaneSpec { substeps, ..spec };
        let tried = |substeps| self.judge.meets(criterion, self.pace(with(substeps)));
        let (mut fails, mut holds, mut with_most) = (0, None, None);
        for substeps in (0..).map(tried_substeps).take_while(|&n| n <= MAX_ADVISED_SUBSTEPS) {
            // If even the maximum number of substeps fails, the numbers in between are not searched.
            if substeps > FEW_SUBSTEPS && with_most.is_none() {
                with_most = Some(tried(MAX_ADVISED_SUBSTEPS).await);
                if matches!(with_most, Some(CriterionFinding::Fails { .. })) {
                    return CriterionResult::No;
                }
            }
            let finding = with_most.filter(|_| substeps == MAX_ADVISED_SUBSTEPS);
            let finding = match finding {
                Some(finding) => finding,
                None => tried(substeps).await,
            };
            match finding {
                CriterionFinding::Holds { evaluations_per_s } => {
                    holds = Some((substeps, evaluations_per_s));
                    break;
                }
                CriterionFinding::Fails { .. } => fails = substeps,
                CriterionFinding::Unknown => return CriterionResult::Unknown,
            }
        }
        let Some((mut substeps, mut evaluations_per_s)) = holds else { return CriterionResult::No };
        while substeps - fails > 1 {
            let middle = fails.midpoint(substeps);
            match tried(middle).await {
                CriterionFinding::Holds { evaluations_per_s: found } => {
                    (substeps, evaluations_per_s) = (middle, found);
                }
                _ => fails = middle,
            }
        }
        CriterionResult::With(CriterionMet {
            tick_hz: self.tick_hz,
            substeps,
            evaluations_per_s,
            cost_per_s: evaluations_per_s * f64::from(spec.method.evaluation_cost),
            are_margins_searched: false,
            slowest_hz: None,
            stiffness_factor: None,
            limited_by: None,
        })
    }

    /// Returns the lowest of [`RATES_HZ`](crate::sim::stability::RATES_HZ) at which a lane meets a criterion, in Hz;
    /// `None` if the lane meets it at no rate.
    pub fn slowest(&self, spec: LaneSpec, criterion: Criterion) -> Option<u32> {
        RateSearch::run(|hz| {
            block_on(self.judge.meets(criterion, Pace { spec, tick_hz: hz.into() })).holds()
        })
    }

    /// Returns the lowest whole rate that a search down from the requested rate finds to meet the criterion. One hertz
    /// lower, the lane fails, or no tick fits into the horizon. `None` if the result is unknown.
    async fn slowest_down(&self, spec: LaneSpec, criterion: Criterion) -> Option<u32> {
        // Runs of a net are expensive, and so are the modes of a method with memory.
        let is_dear = spec.method.restart.is_some()
            || self.scene.bodies.iter().any(|body| body.kind.net().is_some());
        let strides = if is_dear { 6 } else { 60 };
        // The last miss of the search is adjacent to the result of the search.
        let mut is_known = true;
        let mut search = RatesDown::from(self.tick_hz.hz().ceil() as u32, strides);
        while let Some(hz) = search.next() {
            let miss = self.judge.misses(criterion, Pace { spec, tick_hz: hz.into() }).await;
            if miss.is_some() {
                is_known =
                    miss != Some(CriterionFinding::Unknown) || !self.judge.has_ticks(hz.into());
            }
            search.note(hz, miss.is_none());
        }
        is_known.then_some(search.held_hz)
    }

    /// Returns the largest of [`FACTORS`] by which every body may be stiffer, if this factor and all smaller ones meet
    /// the criterion. Also returns the name of the parameter that limits the factor. `None` if the result for the next
    /// factor is unknown.
    async fn stiffest(&self, spec: LaneSpec, criterion: Criterion) -> Option<(f64, String)> {
        let (mut held, mut last_miss) = (0, None);
        let has_hairs = criterion == Criterion::Accurate && self.judge.has_bumps();
        let mut is_by_a_hair = has_hairs && !self.is_accurate_with_margin(spec, 0).await;
        while held + 1 < FACTORS.len() && last_miss.is_none() && !self.is_spent() {
            let next = (held + 1) * PARTS_OF_STRIDE;
            let Some(judge) = self.stiffer(next).await else { break };
            let was_by_a_hair = is_by_a_hair;
            is_by_a_hair = has_hairs && !self.is_accurate_with_margin(spec, next).await;
            if is_by_a_hair || !has_hairs {
                last_miss = judge.misses(criterion, self.pace(spec)).await;
            }
            let mut between = held * PARTS_OF_STRIDE + 1..next;
            while (was_by_a_hair || is_by_a_hair)
                && last_miss.is_none()
                && !self.is_spent()
                && let Some(index) = between.next()
                && let Some(judge) = self.stiffer(index).await
            {
                last_miss = judge.misses(criterion, self.pace(spec)).await;
            }
            held += usize::from(last_miss.is_none() && !self.is_spent());
        }
        let culprit = match last_miss {
            Some(CriterionFinding::Unknown) => return None,
            None if self.is_spent() => return None,
            Some(CriterionFinding::Fails { body }) => Some(body),
            _ => self.stiff_bodies().next().map(|(body, _)| body),
        };
        Some((FACTORS[held], self.stiffness_name(culprit.unwrap_or(0))))
    }

    /// Returns each body's index, with the index of the body's leading parameter, or of the first number of its list.
    fn stiff_bodies(&self) -> impl Iterator<Item = (usize, usize)> {
        self.scene.bodies.iter().enumerate().filter_map(|(body, of)| {
            let (leads, _) = of.kind.parameter(&of.kind.leading)?;
            Some((body, leads))
        })
    }

    /// Returns the name of the parameter that makes a body stiffer.
    fn stiffness_name(&self, body: usize) -> String {
        let body = &self.scene.bodies[body];
        let (_, leading) =
            body.kind.parameter(&body.kind.leading).expect("a card leads by a key of its own");
        let quantity = leading.whole_quantity();
        match self.scene.bodies.len() {
            1 => quantity,
            _ => format!("{quantity} ({})", body.name),
        }
    }

    /// Returns the judge of the scene in which every body is stiffer by the factor with this index.
    async fn stiffer(&self, index: usize) -> Option<&Judge> {
        let find = async {
            let scene = self.stiffen(fine_factor(index))?;
            let (throttle, horizon_s) = (self.judge.throttle(), self.judge.horizon_s());
            let judge = Judge::find(&scene, throttle, horizon_s, self.judge.meter().clone()).await;
            Some(judge.within(WORK_WHEN_STIFFER))
        };
        self.stiffer[index].get(find).await.as_ref()
    }

    /// Whether a lane is accurate on the scene with this factor, with a margin.
    async fn is_accurate_with_margin(&self, spec: LaneSpec, factor: usize) -> bool {
        match self.stiffer(factor).await {
            Some(judge) => judge.is_accurate_sparing(SPARE_WHEN_STIFFER, self.pace(spec)).await,
            None => false,
        }
    }

    fn stiffen(&self, factor: f64) -> Option<Scene> {
        let mut scene = self.scene.clone();
        for (body, leads) in self.stiff_bodies() {
            let body = &mut scene.bodies[body];
            let list = body.kind.parameters[leads].list;
            let others = body.kind.parameters[leads..].iter();
            let count = others.take_while(|it| list.is_some() && it.list == list).count();
            for index in leads..leads + count.max(1) {
                let stiffer = body.values[index] * factor;
                body.values = edited_values(&body.kind, &body.values, index, stiffer).ok()?;
            }
        }
        Some(scene)
    }
}

/// Returns the ranking for the criterion with this index.
fn ranking(advised: &[MethodAdvice], criterion: usize) -> Ranking<'_> {
    Ranking::new(
        advised.iter().enumerate().filter_map(|(i, advice)| {
            Some((i, (advice.spec.method, advice.met[criterion].met()?)))
        }),
    )
}

/// Returns the index in `advised` of the method recommended for a criterion. A margin that is not searched counts as no
/// reserve.
pub fn recommended(advised: &[MethodAdvice], criterion: usize) -> Option<usize> {
    ranking(advised, criterion).recommended_index()
}

/// Indices of the criteria by which the one recommendation is chosen, with the preferred first: that the motion looks
/// right, that it is bounded, and that it is accurate.
pub const TAKEN_FOR: [usize; CRITERIA.len()] = [1, 0, 2];

/// Returns the index of the criterion whose [`recommended`] method to take, which is the first of [`TAKEN_FOR`] that a
/// method is known to meet.
pub fn criterion_to_take(advised: &[MethodAdvice]) -> Option<usize> {
    TAKEN_FOR.into_iter().find(|&criterion| recommended(advised, criterion).is_some())
}

/// Returns the indices in `advised` of the methods that meet a criterion. The [`recommended`] one comes first, then the
/// others by increasing cost. The order of `advised` does not matter. Listings as printed are left out.
pub fn ranked(advised: &[MethodAdvice], criterion: usize) -> Vec<usize> {
    ranking(advised, criterion).indices()
}

/// Returns the index in `advised` of the cheapest method, if the [`recommended`] one is preferred because the cheapest
/// lacks a reserve.
pub(super) fn passed_over(advised: &[MethodAdvice], criterion: usize) -> Option<usize> {
    ranking(advised, criterion).passed_over()
}

#[cfg(test)]
mod tests;
