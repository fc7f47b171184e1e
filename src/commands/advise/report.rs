//! Advice as text for people, and as JSON for programs.

use serde_json::{Map, Value, json};

use super::impact::{ImpactAdvice, exact_code};
use super::judged::{Row, advised, best_rows, recommended_row};
use crate::commands::output::table::{self, Column};
use crate::measure::{
    Adviser, CRITERIA, CriterionMet, CriterionResult, MAX_ADVISED_SUBSTEPS, Recommendation,
    TAKEN_FOR, criterion_to_take,
};
use crate::scene::{LaneSpec, Scene};
use crate::tools::source_code;
use crate::tools::source_code::{CodeForm, Precision};

/// Maximum number of rows that are shown without `--all`.
const MOST_ROWS: usize = 8;

/// Returns the answer as text: the recommendations, then the code of the recommended method in `form`, if one is
/// given.
pub(super) fn answer(
    scene: &Scene,
    adviser: &Adviser,
    rows: &[Row],
    wanted: usize,
    form: Option<CodeForm>,
) -> String {
    let mut text = recommendations(scene, adviser, rows, wanted);
    if let Some(impact) = ImpactAdvice::of(scene, adviser, rows) {
        text += &impact.line();
    }
    let code = form.and_then(|form| match exact_code(scene, form) {
        Some(code) => Some(format!("In place of the step and the line after it:\n\n{code}")),
        None => code(scene, adviser, rows, form),
    });
    if let Some(code) = code {
        text += &format!("\n{code}");
    }
    text
}

/// Returns the best rows as text: how each method meets each criterion, and its verdict.
pub(super) fn best(rows: &[Row]) -> String {
    let best = best_rows(rows, MOST_ROWS);
    if best.is_empty() {
        return String::new();
    }
    let which = match best.len() < rows.len() {
        true => format!("The best {} of {} methods. ", best.len(), rows.len()),
        false => String::new(),
    };
    let mut text = format!(
        "\n{}\n{which}Under each criterion: substeps, and cost per simulated second. --all shows more.\n",
        table::text(BEST, best.iter().copied(), "")
    );
    if best.iter().any(|row| row.rates.is_some()) {
        text += &slowest_rates(best);
    }
    text
}

/// Returns all rows as text: the verdicts, and the methods that meet each criterion with their costs.
pub(super) fn all_tables(rows: &[Row]) -> String {
    if rows.is_empty() {
        return String::new();
    }
    let mut text = format!("\n{}", table::text(VERDICTS, rows, ""));
    for (i, criterion) in CRITERIA.iter().enumerate() {
        let met: Vec<MetRow> = rows.iter().filter_map(|row| MetRow::of(row, i)).collect();
        text += &format!("\n{}: {}\n", criterion.id(), criterion.about());
        if !met.is_empty() {
            text += &table::text(METS, &met, "  ");
        }
        for (meets, why) in [
            (CriterionResult::No, format!("not with up to {MAX_ADVISED_SUBSTEPS} substeps")),
            (CriterionResult::Unknown, "not known: no truth, or too much work".to_owned()),
        ] {
            let those = rows.iter().filter(|row| row.advised.met[i] == meets);
            let ids: Vec<&str> = those.map(|row| row.advised.spec.method.id).collect();
            if !ids.is_empty() {
                text += &format!("  {why}: {}\n", ids.join(", "));
            }
        }
    }
    if rows.iter().any(|row| row.rates.is_some()) {
        text += &slowest_rates(rows);
    }
    text
}

fn slowest_rates<'r>(rows: impl IntoIterator<Item = &'r Row>) -> String {
    format!("\nslowest tick rates in one step a tick, in Hz\n{}", table::text(RATES, rows, "  "))
}

/// Recommends one method. Before it come the criteria that no method is known to meet, with the reason.
fn recommendations(scene: &Scene, adviser: &Adviser, rows: &[Row], wanted: usize) -> String {
    let mut text = String::new();
    if rows.len() < wanted {
        text += &format!("interrupted: {} of {wanted} methods were judged\n", rows.len());
    }
    if rows.is_empty() {
        return text;
    }
    let line = |criterion: usize, words: &str| {
        format!("at {:.3} Hz: {}: {words}\n", adviser.tick_hz(), CRITERIA[criterion].id())
    };
    let take = criterion_to_take(&advised(rows));
    for criterion in TAKEN_FOR.into_iter().take_while(|&criterion| Some(criterion) != take) {
        text += &line(criterion, &why_none(scene, rows, criterion));
    }
    if let Some((criterion, (_, recommendation))) =
        take.and_then(|it| Some((it, recommended_row(rows, it)?)))
    {
        text += &line(criterion, &recommendation.to_string());
    }
    text
}

/// Returns the code of the recommended method, with the number of calls per tick.
fn code(scene: &Scene, adviser: &Adviser, rows: &[Row], form: CodeForm) -> Option<String> {
    let (row, Recommendation { with: met, .. }) =
        recommended_row(rows, criterion_to_take(&advised(rows))?)?;
    let code = source_code(row.advised.spec.method, form, Precision::Double).ok()?;
    let steps = met.substeps;
    let hz = adviser.tick_hz().scaled(steps, 1);
    let times = if steps == 1 { "once".into() } else { format!("{steps} times") };
    let has_walls = scene.bodies.iter().any(|body| body.kind.has_walls);
    let falls = "It has no line for a floor or a wall, and falls through without one: `regatta list impacts`.\n";
    let falls = if has_walls { falls } else { "" };
    Some(format!("Call this {times} a tick with h = 1/{hz:.6} s:\n{falls}\n{code}"))
}

/// Explains why no method is recommended for a criterion.
fn why_none(scene: &Scene, rows: &[Row], criterion: usize) -> String {
    if rows.iter().any(|row| row.advised.met[criterion] != CriterionResult::No) {
        return "not known: no exact motion to compare with, or too much work".into();
    }
    if scene.bodies.iter().all(|body| body.kind.has_walls) {
        return format!(
            "none of these with up to {MAX_ADVISED_SUBSTEPS} substeps; raise the tick rate, or take another rule \
             for impacts"
        );
    }
    let bodies = match &scene.bodies[..] {
        [body] => body.name.clone(),
        bodies => format!("the {} bodies", bodies.len()),
    };
    format!(
        "none of these with up to {MAX_ADVISED_SUBSTEPS} substeps; raise the tick rate, soften the stiffest of \
         {bodies}, or damp it"
    )
}

/// Returns the answer as JSON.
pub(super) fn object(scene: &Scene, adviser: &Adviser, rows: &[Row], wanted: usize) -> Value {
    let recommended = CRITERIA.iter().enumerate().map(|(i, criterion)| {
        let take = match recommended_row(rows, i) {
            Some((_, recommendation)) => json!(recommendation),
            None => json!({ "none": why_none(scene, rows, i) }),
        };
        (criterion.id().to_owned(), take)
    });
    let mut object = json!({
        "scene": scene.name,
        "tick_hz": adviser.tick_hz(),
        "horizon_s": adviser.judge().horizon_s(),
        "bodies": scene.bodies.iter().map(|body| &body.name).collect::<Vec<_>>(),
        "complete": rows.len() == wanted,
        "methods": rows.iter().map(method).collect::<Vec<_>>(),
        "recommended": recommended.collect::<Map<_, _>>(),
        "take": criterion_to_take(&advised(rows)).map(|criterion| CRITERIA[criterion].id()),
    });
    if let Some(impact) = ImpactAdvice::of(scene, adviser, rows) {
        object["impact"] = impact.object();
    }
    object
}

fn method(row: &Row) -> Value {
    let criteria = CRITERIA.iter().enumerate().map(|(i, criterion)| {
        let found = match &row.advised.met[i] {
            CriterionResult::With(met) => {
                let mut found = json!(met);
                found["met"] = true.into();
                found["ns_per_s"] = json!(row.ns_per_s(i).map(f64::round));
                found
            }
            CriterionResult::No => json!({ "met": false }),
            CriterionResult::Unknown => Value::Null,
        };
        (criterion.id().to_owned(), found)
    });
    let mut object = json!({
        "method": row.advised.spec.method.id,
        "verdict": row.advised.verdict,
        "criteria": criteria.collect::<Map<_, _>>(),
    });
    if let Some(impact) = row.advised.spec.own_impact() {
        object["impact"] = impact.id.into();
    }
    if let Some(rates) = &row.rates {
        let rates = CRITERIA.iter().zip(rates).map(|(c, hz)| (c.id().to_owned(), json!(hz)));
        object["rates"] = Value::Object(rates.collect());
    }
    object
}

/// Returns the method of a row, with its rule for impacts if that does not go without saying.
fn named(row: &Row) -> String {
    let LaneSpec { method, .. } = row.advised.spec;
    row.advised.spec.own_impact().map_or(method.id.into(), |it| format!("{}, {}", method.id, it.id))
}

const VERDICTS: &[Column<Row>] = &[
    Column::shown("method", "METHOD", |row| json!(named(row))),
    Column::shown("verdict", "VERDICT", |row| json!(row.advised.verdict.to_string())),
];

const BEST: &[Column<Row>] = &[
    Column::shown("method", "METHOD", |row| json!(named(row))),
    Column::shown("bounded", "BOUNDED", |row| cost(row, 0)),
    Column::shown("looks-right", "LOOKS-RIGHT", |row| cost(row, 1)),
    Column::shown("accurate", "ACCURATE", |row| cost(row, 2)),
    Column::shown("verdict", "VERDICT", |row| json!(row.advised.verdict.to_string())),
];

fn cost(row: &Row, criterion: usize) -> Value {
    json!(match &row.advised.met[criterion] {
        CriterionResult::With(met) => format!("×{} {}", met.substeps, met.cost_per_s.round()),
        CriterionResult::No => "no".into(),
        CriterionResult::Unknown => "not known".into(),
    })
}

const RATES: &[Column<Row>] = &[
    Column::shown("method", "METHOD", |row| json!(named(row))),
    Column::shown("bounded", "BOUNDED", |row| rate(row, 0)),
    Column::shown("looks-right", "LOOKS-RIGHT", |row| rate(row, 1)),
    Column::shown("accurate", "ACCURATE", |row| rate(row, 2)),
];

fn rate(row: &Row, criterion: usize) -> Value {
    json!(row.rates.and_then(|rates| rates[criterion]))
}

/// A method that meets a criterion.
struct MetRow {
    id: &'static str,
    met: CriterionMet,
    ns_per_s: Option<f64>,
}

impl MetRow {
    fn of(row: &Row, criterion: usize) -> Option<Self> {
        let met = row.advised.met[criterion].met()?.clone();
        Some(Self { id: row.advised.spec.method.id, met, ns_per_s: row.ns_per_s(criterion) })
    }
}

/// Returns the text for an unknown margin. Either nobody searched the margin, or the search came to a run that has no
/// truth or takes too much work.
fn unknown(met: &CriterionMet) -> &'static str {
    if met.are_margins_searched { "not known" } else { "not searched" }
}

const METS: &[Column<MetRow>] = &[
    Column::shown("method", "METHOD", |row| json!(row.id)),
    Column::shown("substeps", "SUBSTEPS", |row| json!(format!("×{}", row.met.substeps))),
    Column::shown("evaluations_per_s", "EVALS/S", |row| {
        json!(row.met.evaluations_per_s.round() as u64)
    }),
    Column::shown("cost_per_s", "COST/S", |row| json!(row.met.cost_per_s.round() as u64)),
    Column::shown("ns_per_s", "NS/S MEASURED NOW", |row| {
        json!(row.ns_per_s.map(|ns| ns.round() as u64))
    }),
    Column::shown("reserve", "RESERVE", |row| json!(row.met.reserve())),
    Column::shown("slowest_hz", "HOLDS DOWN TO", |row| {
        json!(row.met.slower().unwrap_or_else(|| unknown(&row.met).into()))
    }),
    Column::shown("stiffness_factor", "HOLDS UP TO", |row| {
        json!(row.met.stiffer().unwrap_or_else(|| unknown(&row.met).into()))
    }),
];
