//! Values that are lists of numbers: curves and vectors.

use std::ops::Range as Span;

use toml::Spanned;
use toml::de::DeValue;

use super::{Field, Table, integer, number};
use crate::lab::scene::LARGEST_COORDINATE;
use crate::lab::scene::cause::{Cause, Wanted};
use crate::sim::bodies::{LARGEST, MOST_NODES, MOST_POINTS, Range};

impl Table<'_> {
    /// The points of a curve, in rising order of their first numbers. At most [`MOST_POINTS`] are read.
    pub(in crate::lab::scene) fn curve(
        &mut self,
        field: Field,
        range: Range,
    ) -> Option<Vec<[f64; 2]>> {
        let key = field.key;
        let wanted = Wanted::Curve(range);
        let value = self.value(field, &wanted)?;
        let Some(entries) = value.get_ref().as_array() else {
            return self.wrong_type(format!("`{key}`"), value, wanted);
        };
        let found = entries.len();
        if !(2..=MOST_POINTS).contains(&found) {
            self.complain(value.span(), Cause::PointCount { key, found, wanted });
        }
        let mut points: Vec<[f64; 2]> = Vec::new();
        for entry in entries.iter().take(MOST_POINTS) {
            let point = self.point(field, entry)?;
            if let Some([before, _]) = points.last().filter(|last| last[0] >= point[0]) {
                let cause = Cause::NotRising { key, value: point[0], before: *before };
                self.complain(entry.span(), cause);
            }
            points.push(point);
        }
        (points.len() == found).then_some(points)
    }

    fn point(&mut self, field: Field, entry: &Spanned<DeValue<'_>>) -> Option<[f64; 2]> {
        let pair = entry.get_ref().as_array().filter(|pair| pair.len() == 2);
        let numbers = pair.and_then(|pair| Some([number(&pair[0])?, number(&pair[1])?]));
        let (Some(pair), Some(numbers)) = (pair, numbers) else {
            return self.wrong_type(format!("a point of `{}`", field.key), entry, Wanted::Point);
        };
        let range = Range::Within(LARGEST);
        for (value, number) in pair.iter().zip(numbers) {
            let number = range.contains(number).then_some(number);
            self.within(field, value, number, Wanted::Number(range))?;
        }
        Some(numbers)
    }

    /// A list of places in the plane. At most one more than [`MOST_NODES`] are read.
    pub(in crate::lab::scene) fn points(&mut self, field: Field) -> Option<Vec<[f64; 2]>> {
        let value = self.value(field, &Wanted::Places)?;
        let Some(entries) = value.get_ref().as_array() else {
            return self.wrong_type(format!("`{}`", field.key), value, Wanted::Places);
        };
        entries.iter().take(MOST_NODES + 1).map(|entry| self.point(field, entry)).collect()
    }

    /// The whole numbers from 0 in a list, with their bytes.
    pub(in crate::lab::scene) fn wholes(
        &mut self,
        field: Field,
        wanted: &Wanted,
    ) -> Option<Vec<(Span<usize>, usize)>> {
        let value = self.value(field, wanted)?;
        let entries = value.get_ref().as_array();
        let whole = |entry: &Spanned<DeValue<'_>>| {
            let number = integer(entry).filter(|_| entry.get_ref().is_integer())?;
            Some((entry.span(), usize::try_from(number).ok()?))
        };
        let wholes = entries.and_then(|entries| entries.iter().map(whole).collect());
        wholes.or_else(|| self.wrong_type(format!("`{}`", field.key), value, wanted.clone()))
    }

    /// The coordinates or the velocities of a body that has `count` of them, each of a magnitude of at most
    /// [`LARGEST_COORDINATE`].
    pub(in crate::lab::scene) fn coordinates(
        &mut self,
        field: Field,
        count: usize,
    ) -> Option<Vec<f64>> {
        let wanted = Wanted::Numbers(count);
        let value = self.value(field, &wanted)?;
        let entries = value.get_ref().as_array();
        let numbers: Option<Vec<f64>> =
            entries.and_then(|entries| entries.iter().map(number).collect());
        let (Some(entries), Some(numbers)) = (entries, numbers) else {
            return self.wrong_type(format!("`{}`", field.key), value, wanted);
        };
        if numbers.len() != count {
            let cause = Cause::NumberCount { key: field.key, found: numbers.len(), wanted };
            self.complain(value.span(), cause);
            return None;
        }
        let range = Range::Within(LARGEST_COORDINATE);
        for (entry, number) in entries.iter().zip(&numbers) {
            let number = range.contains(*number).then_some(());
            self.within(field, entry, number, Wanted::Number(range))?;
        }
        Some(numbers)
    }
}
