//! The serialized form of a verdict, which is a flat object, the same for every command and the library.

use serde::{Serialize, Serializer};

use super::{Finding, LongTerm, Verdict};

/// The fields of the object. Fields without a meaning for a kind of verdict are null.
#[derive(Serialize)]
struct Schema<'a> {
    /// Id of the outcome.
    word: &'static str,
    /// The number in the text, in `unit`.
    quantity: Option<String>,
    value: Option<f64>,
    unit: Option<&'static str>,
    body: &'a str,
    error: Option<f64>,
    error_at_s: Option<f64>,
    last_error: Option<f64>,
    energy_change: Option<f64>,
    energy_drift_percent: Option<f64>,
    frequency_error: Option<f64>,
    looks_right: Option<bool>,
    width: Option<f64>,
    early_s: Option<f64>,
    measure: &'static str,
    doubles_in_s: Option<f64>,
    halves_in_s: Option<f64>,
    parasite_doubles_in_s: Option<f64>,
    bounded: Option<bool>,
    spectral_radius: Option<f64>,
    failed_at_s: Option<f64>,
    /// The reason why the run failed, has no truth or is not judged.
    why: Option<String>,
    half_life_s: Option<f64>,
    true_half_life_s: Option<f64>,
    overshoot_percent: Option<f64>,
    starts_at_s: f64,
    horizon_s: f64,
    text: String,
    /// The verdicts on the bodies, if there are several.
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    bodies: &'a [Verdict],
}

impl Serialize for Verdict {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let compared = self.comparison();
        let LongTerm { doubles_in_s, halves_in_s, parasite_doubles_in_s, .. } = self.long_term;
        let number = self.number();
        Schema {
            word: self.outcome().id(),
            value: number.as_ref().map(|number| number.value),
            unit: number.as_ref().map(|number| number.unit),
            quantity: number.map(|number| number.quantity),
            body: &self.body_name,
            error: self.error(),
            error_at_s: compared.map(|found| found.error_at_s),
            last_error: compared.map(|found| found.last_error),
            energy_change: self.energy_change(),
            energy_drift_percent: self.energy_drift_percent(),
            frequency_error: compared.and_then(|found| found.frequency_error),
            looks_right: compared.and_then(|found| found.looks_right),
            width: compared.and_then(|found| found.width),
            early_s: compared.and_then(|found| found.early_s),
            measure: self.long_term.measure.name(),
            doubles_in_s,
            halves_in_s,
            parasite_doubles_in_s,
            bounded: self.long_term.is_bounded,
            spectral_radius: self.by_energy().and_then(|found| found.spectral_radius),
            failed_at_s: self.failure().map(|failure| failure.t),
            why: match &self.finding {
                Finding::Failed { failure, .. } => Some(failure.cause.to_string()),
                Finding::NoTruth(why) => Some(why.to_string()),
                Finding::NotJudged(why) => Some(why.to_string()),
                Finding::Compared(_)
                | Finding::Bounced(_)
                | Finding::Spun(_)
                | Finding::ByEnergy(_) => None,
            },
            half_life_s: self.chase.and_then(|chase| chase.half_life_s),
            true_half_life_s: self.chase.and_then(|chase| chase.true_half_life_s),
            overshoot_percent: self.chase.map(|chase| chase.overshoot_percent),
            starts_at_s: self.starts_at_s,
            horizon_s: self.horizon_s,
            text: self.to_string(),
            bodies: if self.of_bodies.len() > 1 { &self.of_bodies } else { &[] },
        }
        .serialize(serializer)
    }
}
