//! Reads lists of numbers, such as curves and vectors.

use std::ops::Range as Span;

use toml::Spanned;
use toml::de::DeValue;

use super::{Table, integer, number};
use crate::MAX_COORDINATE;
use crate::sim::bodies::{MAX_NODES, MAX_POINTS, MAX_VALUE, Range};
use crate::sim::number::counted;
use crate::wanted::{Field, Wanted};

impl Table<'_> {
    /// Reads the points of a curve, in rising order of their first numbers. At most [`MAX_POINTS`] are read.
    pub(crate) fn curve(&mut self, field: &Field) -> Option<Vec<[f64; 2]>> {
        let (value, entries) = self.list(field)?;
        let Field { key, wanted, .. } = field;
        let found = entries.len();
        if !(2..=MAX_POINTS).contains(&found) {
            let what = format!("`{key}` has {}", counted(found, "point"));
            self.report_fault(value.span(), what, wanted.remedy());
        }
        let mut points: Vec<[f64; 2]> = Vec::new();
        for entry in entries.iter().take(MAX_POINTS) {
            let point = self.point(field, entry)?;
            if let Some([before, _]) = points.last().filter(|last| last[0] >= point[0]) {
                let what = format!("`{key}` goes from {before} to {}", point[0]);
                let remedy =
                    "order the points by their first numbers, each greater than the one before";
                self.report_fault(entry.span(), what, remedy);
            }
            points.push(point);
        }
        (points.len() == found).then_some(points)
    }

    fn point(&mut self, field: &Field, entry: &Spanned<DeValue<'_>>) -> Option<[f64; 2]> {
        let (pair, numbers) = self.pair(format!("a point of `{}`", field.key), entry)?;
        self.pair_within(&format!("`{}`", field.key), pair, numbers)
    }

    /// Returns the numbers of a pair, unless one is too large.
    fn pair_within(
        &mut self,
        subject: &str,
        pair: [&Spanned<DeValue<'_>>; 2],
        numbers: [f64; 2],
    ) -> Option<[f64; 2]> {
        let range = Range::Within(MAX_VALUE);
        match pair.into_iter().zip(numbers).find(|(_, number)| !range.contains(*number)) {
            Some((value, _)) => self.out_of_range(subject, value, &Wanted::Number(range)),
            None => Some(numbers),
        }
    }

    /// Reads the two numbers of a pair, with their places in the file.
    fn pair<'e>(
        &mut self,
        subject: String,
        entry: &'e Spanned<DeValue<'e>>,
    ) -> Option<([&'e Spanned<DeValue<'e>>; 2], [f64; 2])> {
        let pair = match entry.get_ref().as_array() {
            Some(pair) if pair.len() == 2 => Some([&pair[0], &pair[1]]),
            _ => None,
        };
        let read = pair.and_then(|pair| Some((pair, [number(pair[0])?, number(pair[1])?])));
        read.or_else(|| self.wrong_type_of(subject, entry, &Wanted::Point))
    }

    /// Reads a list of places in the plane. At most one more than [`MAX_NODES`] are read.
    pub(crate) fn points(&mut self, field: &Field) -> Option<Vec<[f64; 2]>> {
        let (_, entries) = self.list(field)?;
        let read = entries.iter().take(MAX_NODES + 1).enumerate();
        read.map(|(node, entry)| self.place(node, entry)).collect()
    }

    /// Reads the place of the node with this index.
    fn place(&mut self, node: usize, entry: &Spanned<DeValue<'_>>) -> Option<[f64; 2]> {
        let (pair, numbers) = self.pair(format!("the place of node {node}"), entry)?;
        self.pair_within(&format!("a coordinate of node {node}"), pair, numbers)
    }

    /// Reads the indices of nodes in a list, with their bytes.
    pub(crate) fn node_numbers(&mut self, field: &Field) -> Option<Vec<(Span<usize>, usize)>> {
        let (_, entries) = self.list(field)?;
        let mut numbers = Vec::new();
        for entry in entries {
            let number = integer(entry).and_then(|number| usize::try_from(number).ok());
            match number {
                Some(number) => numbers.push((entry.span(), number)),
                None => {
                    let subject = format!("an entry of `{}`", field.key);
                    self.wrong_type_of::<()>(subject, entry, &Wanted::Node);
                }
            }
        }
        (numbers.len() == entries.len()).then_some(numbers)
    }

    /// Reads as many numbers as [`Wanted::Numbers`] demands, each of a magnitude of at most [`MAX_COORDINATE`].
    pub(crate) fn coordinates(&mut self, field: &Field) -> Option<Vec<f64>> {
        self.numbers(field, Range::Within(MAX_COORDINATE))
    }

    /// Reads as many numbers as [`Wanted::Numbers`] demands, each in this range.
    pub(crate) fn numbers(&mut self, field: &Field, range: Range) -> Option<Vec<f64>> {
        let value = self.value(field)?;
        let entries = value.get_ref().as_array();
        let numbers: Option<Vec<f64>> =
            entries.and_then(|entries| entries.iter().map(number).collect());
        let (Some(entries), Some(numbers)) = (entries, numbers) else {
            return self.wrong_type(field, value);
        };
        if field.wanted != Wanted::Numbers(numbers.len()) {
            let (key, found) = (field.key, numbers.len());
            let what = format!("`{key}` has {}", counted(found, "number"));
            self.report_fault(value.span(), what, field.wanted.remedy());
            return None;
        }
        let mut each = entries.iter().zip(&numbers);
        match each.find(|(_, number)| !range.contains(**number)) {
            Some((entry, _)) => {
                self.out_of_range(&format!("`{}`", field.key), entry, &Wanted::Number(range))
            }
            None => Some(numbers),
        }
    }
}
