//! Edits one value of a body, with the checks and messages of a scene file with that value.

use super::fault::{FaultKind, SceneFault};
use super::wanted::Wanted;
use crate::sim::TickRate;
use crate::sim::bodies::{Fault, Kind, Parameter, Range};

/// The reason why a parameter of a body cannot be set, and the remedy, in one line.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(transparent)]
pub struct EditError(#[from] SceneFault);

impl EditError {
    /// Returns the fault of the values as a whole, if the fault is the reason.
    pub(super) fn fault(self) -> Option<Fault> {
        match self.0.kind {
            FaultKind::Values(fault) => Some(fault),
            _ => None,
        }
    }
}

/// Returns the `values` of a body of `kind`, in the form of [`SceneBody::values`](super::SceneBody::values), with
/// `value` for the parameter with this index.
///
/// # Errors
/// If the value is out of the parameter's range or does not go with the others, or if the parameter is a curve.
///
/// # Panics
/// If the kind has no parameter with this index.
pub fn edited_values(
    kind: &Kind,
    values: &[f64],
    index: usize,
    value: f64,
) -> Result<Vec<f64>, EditError> {
    let Parameter { key, range, list, .. } = &kind.parameters[index];
    let key = list.unwrap_or(key);
    let (wanted, written) = (Wanted::of(*range), typed_number(value));
    if let Range::Curve { .. } = range {
        let found = format!("the number {written}");
        return Err(SceneFault::wrong_type(&format!("`{key}`"), &found, &wanted).into());
    }
    if !range.contains(value) {
        return Err(SceneFault::out_of_range(&format!("`{key}`"), &written, &wanted).into());
    }
    let mut edited = values.to_vec();
    edited[index] = value;
    (kind.check)(&edited).map_err(SceneFault::from)?;
    Ok(edited)
}

/// Smallest positive and largest number that a person may enter. Products of several such numbers stay finite.
const ENTERED: [f64; 2] = [1e-12, 1e12];

/// Checks that a person may enter a number in this range. Files may hold more extreme numbers.
///
/// # Errors
/// Fails with a message that has the name and its valid range.
pub fn check_entered(name: &str, value: f64, range: Range) -> Result<(), String> {
    let [least, most] = ENTERED;
    let range = match range {
        Range::Positive(limit) => Range::Between(least, limit.min(most)),
        Range::NonNegative(limit) => Range::NonNegative(limit.min(most)),
        Range::Within(limit) => Range::Within(limit.min(most)),
        Range::Count(_) | Range::Curve { .. } | Range::Between(..) => range,
    };
    let short: f64 = format!("{value:.4e}").parse().unwrap_or(value);
    let is = match value {
        _ if value.is_nan() => "would be no number".to_owned(),
        _ if value.is_infinite() => "would be too large for a number".to_owned(),
        _ => format!("would be {}", typed_number(short)),
    };
    match range.contains(value) {
        true => Ok(()),
        false => Err(format!("{name} {is}; it must be {range}")),
    }
}

/// Returns the tick rate that a person enters in Hz, with up to nine digits after the point.
///
/// # Errors
/// Fails with a message that has the valid range.
pub fn entered_tick_rate(hz: f64) -> Result<TickRate, String> {
    let [least, most] = [TickRate::MIN, TickRate::MAX].map(TickRate::hz);
    check_entered("tick rate", hz, Range::Between(least, most))?;
    format!("{hz:.9}").parse()
}

/// Formats a number as a person would type it.
fn typed_number(value: f64) -> String {
    let exact = format!("{value:?}");
    exact.strip_suffix(".0").map_or(exact.clone(), str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Scene;
    use crate::sim::bodies::{BODIES, MAX_VALUE, by_key, kind};

    /// Returns the values of the only body of a scene with this table, or the error message.
    fn parsed(table: &str) -> Result<Vec<f64>, String> {
        let text = format!("title = 'one'\ntick_hz = 60\nseconds = 1\n{table}");
        let scene = Scene::parse("one.toml", &text).map_err(|errors| errors.to_string())?;
        Ok(scene.bodies[0].values.clone())
    }

    /// Returns a table with all required parameters, in which every number is 1, except that the parameter with the
    /// index in `edit` has the value there.
    fn table(kind: &Kind, edit: Option<(usize, f64)>) -> String {
        let mut index = 0;
        let row = |group: &[Parameter]| {
            let Parameter { key, default, range, list, .. } = &group[0];
            let first = index;
            index += group.len();
            if let Some(key) = list {
                let number = |(at, parameter): (usize, &Parameter)| match edit {
                    Some((edited, value)) if edited == at => typed_number(value),
                    _ => typed_number(parameter.default.unwrap_or(1.0)),
                };
                let numbers: Vec<_> = (first..).zip(group).map(number).collect();
                return format!("{key} = [{}]\n", numbers.join(", "));
            }
            let index = first;
            match (edit, range) {
                (Some((edited, value)), _) if edited == index => {
                    format!("{key} = {}\n", typed_number(value))
                }
                (_, Range::Curve { .. }) => format!("{key} = [[0, 1], [1, 1]]\n"),
                _ if default.is_some() => String::new(),
                _ => format!("{key} = 1\n"),
            }
        };
        let rows = by_key(&kind.parameters).map(row);
        format!("[[{}]]\n{}", kind.id, rows.collect::<String>())
    }

    #[test]
    fn an_entered_value_must_be_in_range_and_of_a_finite_size() {
        let told = |value, range| check_entered("length", value, range).err();
        let (count, between) = (Range::Count(1000), Range::Between(1e-4, 3e7));
        for (range, fine, refused) in [
            (Range::POSITIVE, [1e-12, 1e12], [0.0, 1e-13]),
            (Range::NON_NEGATIVE, [0.0, 1e12], [-1e-300, 2e12]),
            (Range::ANY, [-1e12, 1e12], [-2e12, f64::INFINITY]),
            (count, [1.0, 1000.0], [2.5, 1001.0]),
            (between, [1e-4, 3e7], [-1.0, f64::NAN]),
        ] {
            assert_eq!(fine.map(|value| told(value, range)), [None, None], "{range}");
            for value in refused {
                let words = told(value, range).expect("it is refused");
                assert!(
                    words.starts_with("length would be ") && words.contains("must be"),
                    "{words}"
                );
            }
        }
        let words = told(2.5, count).unwrap();
        assert_eq!(words, "length would be 2.5; it must be whole, from 1 to 1000");
        let words = told(-1.0 / 3.0, between).unwrap();
        assert_eq!(words, "length would be -0.33333; it must be from 0.0001 to 30000000");
    }

    #[test]
    fn an_edit_is_accepted_or_refused_like_a_value_in_a_scene_file() {
        let (mut taken, mut refused) = (0, 0);
        for kind in BODIES.iter() {
            let begun = parsed(&table(kind, None)).unwrap();
            for (index, parameter) in kind.parameters.iter().enumerate() {
                let values: &[f64] = match parameter.range {
                    Range::Curve { .. } => &[],
                    Range::Count(_) => &[-1.0, 0.0, 1.0, 2.0, 8.0, 9.0, 256.0, 257.0],
                    _ => &[-2e15, -1.0, 0.0, 1e-300, 0.1, 2.0, MAX_VALUE, 1.1 * MAX_VALUE, 1e300],
                };
                for &value in values {
                    let parsed = parsed(&table(kind, Some((index, value))));
                    match edited_values(kind, &begun, index, value) {
                        Ok(values) => {
                            taken += 1;
                            assert_eq!(Ok(values), parsed);
                        }
                        Err(error) => {
                            refused += 1;
                            let parsed = parsed.expect_err(&error.to_string());
                            assert!(parsed.ends_with(&format!(": {error}")), "{parsed} / {error}");
                        }
                    }
                }
            }
        }
        assert!(taken > 100 && refused > 50, "{taken} taken, {refused} refused");
    }

    #[test]
    fn a_refused_edit_names_its_key_and_a_remedy() {
        let refusal = |id: &str, index: usize, value: f64| {
            let kind = kind(id).unwrap();
            edited_values(kind, &parsed(&table(kind, None)).unwrap(), index, value)
                .unwrap_err()
                .to_string()
        };
        for (found, wanted) in [
            (
                refusal("spring", 0, -1.0),
                "`mass_kg` is -1, out of range; write a number greater than 0 and at most 1e15",
            ),
            (
                refusal("chain", 4, 2.5),
                "`plucked_mass` is 2.5, out of range; write a whole number from 1 to 256",
            ),
            (
                refusal("chain", 4, 9.0),
                "`plucked_mass` is 9, of 8 masses; write a whole number from 1 to 8, or more `masses`",
            ),
            (
                refusal("helm", 11, 3.0),
                "`thrust_curve` is the number 3, not a list; \
                 write a list of 2 to 64 points [m/s, N] in rising order",
            ),
        ] {
            assert_eq!(found, wanted);
        }
        assert!(refusal("spring", 0, f64::NAN).starts_with("`mass_kg` is NaN, out of range"));
    }
}
