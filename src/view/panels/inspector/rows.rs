//! The inspector's rows for a body. Each parameter has a row, and its slider has a range.

use crate::stage::{Parameter, Range, TakesEffect};
use crate::studio::Studio;

/// A logarithmic slider extends from the scene's value divided by this factor to the value multiplied by it.
const REACH: f64 = 100.0;
/// A linear slider extends to the scene's value multiplied by this factor.
const LINEAR_REACH: f64 = 4.0;
/// Range of a slider if the scene's value is 0, because 0 gives no scale.
const FROM_NOTHING: f64 = 10.0;
/// Minimum upper end of a slider for a count.
const MIN_REACH: f64 = 16.0;

/// A row of the inspector: a parameter of a body.
pub(super) struct Row<'l> {
    /// Index of the body in the scene.
    pub(super) body: usize,
    /// Index of the parameter among those of the body's kind.
    pub(super) index: usize,
    pub(super) parameter: &'l Parameter,
    /// The parameter's values at present and in the scene as opened. `None` for a curve, which is not a number.
    pub(super) values: Option<Values>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Values {
    pub(super) present: f64,
    pub(super) opened: f64,
}

impl Values {
    pub(super) fn differ(self) -> bool {
        self.present != self.opened
    }
}

/// Returns the parameters of a body. Those that act at once come before those that act from the next start.
pub(super) fn rows<'l>(studio: &'l Studio, body: usize) -> Vec<Row<'l>> {
    let opened = &studio.deck.scene_as_opened().bodies[body];
    let (present, next) = (studio.race().values(body), &studio.scene().bodies[body].values);
    let row = |(index, parameter): (usize, &'l Parameter)| {
        let is_number = !matches!(parameter.range, Range::Curve { .. });
        let values = is_number.then(|| Values {
            present: if parameter.acts == TakesEffect::AtStart {
                next[index]
            } else {
                present[index]
            },
            opened: opened.values[index],
        });
        Row { body, index, parameter, values }
    };
    let mut rows: Vec<Row<'l>> = opened.kind.parameters.iter().enumerate().map(row).collect();
    rows.sort_by_key(|row| row.parameter.acts == TakesEffect::AtStart);
    rows
}

/// Range of a slider.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SliderRange {
    pub(super) low: f64,
    pub(super) high: f64,
    pub(super) spacing: Spacing,
}

/// How the values are spaced along a slider.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Spacing {
    Linear,
    /// Logarithmic from this value up. A slider that reaches 0 has the 0 at its end.
    Logarithmic(f64),
    Whole,
}

impl SliderRange {
    /// Creates the range of the slider for a parameter, or returns `None` for a curve. The range surrounds the scene's
    /// value, so that it does not move with the value that the slider sets. It is extended if necessary to include the
    /// present value.
    pub(super) fn of(range: Range, Values { present, opened }: Values) -> Option<Self> {
        let size = if opened != 0.0 { opened.abs() } else { present.abs() };
        let (low, high, spacing) = match range {
            Range::Positive(most) => {
                let low = size / REACH;
                (low, most.min(size * REACH), Spacing::Logarithmic(low))
            }
            Range::NonNegative(most) if size > 0.0 => {
                (0.0, most.min(size * REACH), Spacing::Logarithmic(size / REACH))
            }
            Range::NonNegative(most) => {
                let least = FROM_NOTHING / (REACH * REACH);
                (0.0, most.min(FROM_NOTHING), Spacing::Logarithmic(least))
            }
            Range::Within(most) => {
                let reach = if size > 0.0 { LINEAR_REACH * size } else { FROM_NOTHING };
                let reach = most.min(reach);
                (-reach, reach, Spacing::Linear)
            }
            Range::Count(most) => {
                (1.0, f64::from(most).min(MIN_REACH.max(LINEAR_REACH * size)), Spacing::Whole)
            }
            Range::Between(least, most) => (least, most, Spacing::Linear),
            Range::Curve { .. } => return None,
        };
        Some(Self { low: low.min(present), high: high.max(present), spacing })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{SCENES, Scene};

    #[test]
    fn every_parameter_of_every_kind_of_body_has_one_row() {
        let mut kinds = Vec::new();
        for scene in SCENES {
            let studio = Studio::new(Scene::built_in(scene.name).unwrap());
            for (index, body) in studio.scene().bodies.iter().enumerate() {
                let rows = rows(&studio, index);
                let mut indices: Vec<usize> = rows.iter().map(|row| row.index).collect();
                indices.sort_unstable();
                assert_eq!(indices, (0..body.kind.parameters.len()).collect::<Vec<_>>());
                for row in &rows {
                    assert_eq!(row.parameter, &body.kind.parameters[row.index]);
                    let is_curve = matches!(row.parameter.range, Range::Curve { .. });
                    assert_eq!(row.values.is_none(), is_curve, "{}", row.parameter.key);
                    let Some(values) = row.values else { continue };
                    assert!(!values.differ() && values.present == body.values[row.index]);
                }
                let at_start = |row: &Row| row.parameter.acts == TakesEffect::AtStart;
                assert!(rows.is_sorted_by_key(at_start));
                kinds.push(body.kind.id);
            }
        }
        kinds.sort_unstable();
        kinds.dedup();
        assert_eq!(
            kinds,
            [
                "ball", "chain", "follow", "helm", "law", "net", "orbit", "pendulum", "ship",
                "spring", "tumble"
            ]
        );
    }

    #[test]
    fn a_slider_reaches_its_value_and_no_invalid_value() {
        let mut seen = 0;
        let positive = [1e-300, 1e-3, 1.0, 39.5, 255.0, 1e15];
        for scene in SCENES {
            for parameter in Scene::built_in(scene.name)
                .unwrap()
                .bodies
                .iter()
                .flat_map(|b| b.kind.parameters.clone())
            {
                let range = parameter.range;
                let signed = positive.iter().flat_map(|value| [*value, -value]).chain([0.0]);
                let possible: Vec<f64> =
                    signed.map(f64::trunc).chain(positive).filter(|v| range.contains(*v)).collect();
                for &present in &possible {
                    for &opened in &possible {
                        let Some(reach) = SliderRange::of(range, Values { present, opened }) else {
                            continue;
                        };
                        let SliderRange { low, high, .. } = reach;
                        let what = format!("{} at {present}, {opened}: {reach:?}", parameter.key);
                        assert!(low < high && low <= present && present <= high, "{what}");
                        assert!(range.contains(low) && range.contains(high), "{what}");
                        seen += 1;
                    }
                }
            }
        }
        assert!(seen > 1000, "{seen}");
    }

    #[test]
    fn a_slider_of_a_positive_value_is_logarithmic_and_keeps_its_range() {
        let reach = |present| {
            SliderRange::of(Range::POSITIVE, Values { present, opened: 40.0 })
                .expect("it is no curve")
        };
        let SliderRange { low, high, spacing } = reach(40.0);
        assert_eq!((low, high, spacing), (0.4, 4000.0, Spacing::Logarithmic(0.4)));
        for present in [0.4, 1.0, 4000.0] {
            assert_eq!(reach(present), reach(40.0));
        }
        assert_eq!(reach(9000.0).high, 9000.0);
        let reach = SliderRange::of(Range::ANY, Values { present: 0.0, opened: 0.0 });
        assert_eq!(reach, Some(SliderRange { low: -10.0, high: 10.0, spacing: Spacing::Linear }));
    }
}
