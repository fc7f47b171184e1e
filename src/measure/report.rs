//! Advice on a custom body as a value, to print, test or write as JSON.

use std::fmt;

use super::advice::passed_over;
use super::{
    Adviser, CRITERIA, Criterion, CriterionMet, CriterionResult, MAX_ADVISED_SUBSTEPS,
    MethodAdvice, TAKEN_FOR, Verdict, recommended,
};
use crate::scene::Scene;
use crate::scene::custom::{Options, OptionsError};
use crate::sim::number::round;
use crate::sim::{State, System, TickRate, Vector};

/// One value for each [`Criterion`].
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub struct Criteria<T> {
    /// Value for [`Criterion::Bounded`].
    pub bounded: T,
    /// Value for [`Criterion::LooksRight`].
    pub looks_right: T,
    /// Value for [`Criterion::Accurate`].
    pub accurate: T,
}

impl<T> Criteria<T> {
    fn of(value: impl FnMut(Criterion) -> T) -> Self {
        let [bounded, looks_right, accurate] = CRITERIA.map(value);
        Self { bounded, looks_right, accurate }
    }

    /// Returns the value for a criterion.
    pub fn get(&self, criterion: Criterion) -> &T {
        match criterion {
            Criterion::Bounded => &self.bounded,
            Criterion::LooksRight => &self.looks_right,
            Criterion::Accurate => &self.accurate,
        }
    }
}

/// The advice on a body at a tick rate.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct Report {
    /// Name of the body.
    pub name: String,
    /// Tick rate in Hz.
    pub tick_hz: TickRate,
    /// Simulated seconds over which the methods were judged.
    pub horizon_s: f64,
    /// The results for every method, in the order of the table or as given.
    pub methods: Vec<MethodReport>,
    /// The method recommended for each criterion, in the order of [`ranked`](super::ranked); `None` if no method meets
    /// the criterion, or if this is unknown.
    pub recommended: Criteria<Option<Recommendation>>,
    /// Ids of methods with an unknown result, because there is no truth, or because the result takes too much work.
    pub not_known: Criteria<Vec<&'static str>>,
}

/// The results for one method.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct MethodReport {
    /// Id of the method.
    pub method: &'static str,
    /// The verdict, displayed as a sentence.
    pub verdict: Verdict,
    /// How the method meets each criterion with the fewest substeps; `None` if it does not, or if this is unknown.
    pub criteria: Criteria<Option<CriterionMet>>,
}

/// A cheaper method that is not recommended for lack of a reserve.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct PassedOver {
    /// Id of the method.
    pub method: &'static str,
    /// Number of steps per tick.
    pub substeps: u32,
    /// The method's [cost](CriterionMet::cost_per_s).
    pub cost_per_s: f64,
    /// The method's [reserve](CriterionMet::reserve); `None` if unknown.
    pub reserve: Option<f64>,
}

/// Writes the reason, as part of a sentence.
impl fmt::Display for PassedOver {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ×{} costs less, but its reserve is ", self.method, self.substeps)?;
        match self.reserve {
            Some(reserve) => write!(f, "only {} ×", round(reserve, 2)),
            None => write!(f, "not known"),
        }
    }
}

/// The method recommended for a criterion.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct Recommendation {
    /// Id of the method.
    pub method: &'static str,
    /// How the method meets the criterion.
    #[serde(flatten)]
    pub with: CriterionMet,
    /// The cheapest method, if it is passed over for its small reserve.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub instead_of: Option<PassedOver>,
}

impl Recommendation {
    /// Returns the recommendation for the criterion with this index; `None` if no method is known to meet it.
    pub fn of(advised: &[MethodAdvice], criterion: usize) -> Option<Self> {
        let found = |row: usize| {
            let MethodAdvice { spec, met, .. } = &advised[row];
            Some((spec.method.id, met[criterion].met()?))
        };
        let (method, with) = found(recommended(advised, criterion)?)?;
        let instead_of = passed_over(advised, criterion).and_then(found);
        Some(Self {
            method,
            with: with.clone(),
            instead_of: instead_of.map(|(method, met)| PassedOver {
                method,
                substeps: met.substeps,
                cost_per_s: met.cost_per_s,
                reserve: met.reserve(),
            }),
        })
    }
}

/// Writes one line for a design note.
impl fmt::Display for Recommendation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { method, with, instead_of } = self;
        let evaluations = with.evaluations_per_s.round();
        write!(f, "{method} ×{} ({evaluations} evaluations/s; {}", with.substeps, with.margins())?;
        match instead_of {
            Some(passed_over) => write!(f, "; {passed_over})"),
            None => write!(f, ")"),
        }
    }
}

/// Judges methods on a body that moves according to `system` from `start`, and recommends one. Costs and the [work
/// limit](Options::max_work) are counted in evaluations of the acceleration.
///
/// ```
/// use regatta_measure::advise;
/// use regatta_scene::Options;
/// use regatta_sim::prelude::*;
///
/// #[derive(Clone)]
/// struct Spring;
///
/// impl System for Spring {
///     type Vector = f64;
///     fn acceleration(&self, _t: f64, q: &f64, _v: &f64, a: &mut f64) {
///         *a = -40.0 * q;
///     }
/// }
///
/// let start = State { q: 1.0, v: 0.0 };
/// let methods = ["semi-implicit-euler", "velocity-verlet", "rk4"].map(|id| method(id).unwrap());
/// let options = Options { seconds: 5.0, methods: methods.to_vec(), ..Options::default() };
/// let report = advise(&Spring, start, options);
/// println!("{report}");
/// let bounded = report.recommended.bounded.expect("some method is bounded");
/// assert_eq!(bounded.with.substeps, 1);
/// ```
///
/// # Panics
/// If an option is invalid; [`try_advise`] returns an error instead.
#[track_caller]
pub fn advise<S>(system: &S, start: State<S::Vector>, options: Options<S>) -> Report
where
    S: System<Vector: Vector> + Clone + Send + 'static,
{
    match try_advise(system, start, options) {
        Ok(report) => report,
        Err(error) => panic!("{error}"),
    }
}

/// Like [`advise`], with an error instead of a panic.
///
/// # Errors
/// If an option is invalid, as for [`Scene::of`].
pub fn try_advise<S>(
    system: &S,
    start: State<S::Vector>,
    options: Options<S>,
) -> Result<Report, OptionsError>
where
    S: System<Vector: Vector> + Clone + Send + 'static,
{
    let max_work = options.max_work;
    Ok(Report::within(max_work, &Scene::of(system, start, options)?))
}

impl Report {
    /// Returns the advice on a scene at its tick rate, under full throttle, for the same [lanes](Scene::advised_lanes)
    /// that command and window judge.
    pub fn of_scene(scene: &Scene) -> Self {
        Self::within(u64::MAX, scene)
    }

    /// Like [`Self::of_scene`], with a limit of about `max_work` on the total [work](Options::max_work).
    pub fn within(max_work: u64, scene: &Scene) -> Self {
        let adviser = Adviser::within(max_work, scene, scene.tick_hz);
        let mut judged: Vec<MethodAdvice> =
            scene.advised_lanes().into_iter().map(|spec| adviser.judged(spec)).collect();
        adviser.search_until_decided(&mut judged);
        for (row, i) in adviser.worth_margins(&judged) {
            judged[row].search_margins(&adviser, i);
        }
        let index = |criterion| CRITERIA.iter().position(|one| *one == criterion).unwrap_or(0);
        Self {
            name: scene.name.clone(),
            tick_hz: adviser.tick_hz(),
            horizon_s: adviser.judge().horizon_s(),
            recommended: Criteria::of(|criterion| Recommendation::of(&judged, index(criterion))),
            not_known: Criteria::of(|criterion| {
                let is_open = |advice: &&MethodAdvice| {
                    advice.met[index(criterion)] == CriterionResult::Unknown
                };
                judged.iter().filter(is_open).map(|advice| advice.spec.method.id).collect()
            }),
            methods: judged.iter().map(|advice| method(advice, &index)).collect(),
        }
    }
}

fn method(advice: &MethodAdvice, index: &dyn Fn(Criterion) -> usize) -> MethodReport {
    MethodReport {
        method: advice.spec.method.id,
        verdict: advice.verdict.clone(),
        criteria: Criteria::of(|criterion| advice.met[index(criterion)].met().cloned()),
    }
}

/// Writes the verdicts, and then one recommendation. Before it come the criteria that no method is known to meet.
impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ids = self.methods.iter().map(|row| row.method.len());
        let width = ids.max().unwrap_or(0);
        for MethodReport { method, verdict, .. } in &self.methods {
            writeln!(f, "{method:width$}  {verdict}")?;
        }
        writeln!(f)?;
        for criterion in TAKEN_FOR.map(|index| CRITERIA[index]) {
            write!(f, "{} at {:.3} Hz: {}: ", self.name, self.tick_hz, criterion.id())?;
            match self.recommended.get(criterion) {
                Some(recommendation) => {
                    writeln!(f, "{recommendation}")?;
                    break;
                }
                None if self.not_known.get(criterion).is_empty() => {
                    writeln!(f, "none of these with up to {MAX_ADVISED_SUBSTEPS} substeps")?;
                }
                None => {
                    writeln!(f, "not known for {}", self.not_known.get(criterion).join(", "))?;
                }
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_reason_names_the_cheaper_method_and_its_reserve() {
        let mut passed_over = PassedOver {
            method: "explicit-euler",
            substeps: 2,
            cost_per_s: 60.0,
            reserve: Some(1.1),
        };
        let reason = "explicit-euler ×2 costs less, but its reserve is";
        assert_eq!(passed_over.to_string(), format!("{reason} only 1.1 ×"));
        passed_over.reserve = None;
        assert_eq!(passed_over.to_string(), format!("{reason} not known"));
    }
}
