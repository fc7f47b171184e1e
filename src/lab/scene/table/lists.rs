//! Values that are lists of numbers: curves and vectors.

use std::ops::Range as Span;

use toml::Spanned;
use toml::de::DeValue;

use super::{Field, Table, integer, number};
use crate::lab::scene::MAX_COORDINATE;
use crate::lab::scene::clip::clip;
use crate::lab::scene::fault::SceneFault;
use crate::lab::scene::wanted::Wanted;
use crate::sim::bodies::{LARGEST, MAX_NODES, MAX_POINTS, Range};

impl Table<'_> {
    /// The points of a curve, in rising order of their first numbers. At most [`MAX_POINTS`] are read.
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
        if !(2..=MAX_POINTS).contains(&found) {
            let what = format!("`{key}` has {found} point{}", if found == 1 { "" } else { "s" });
            self.complain(value.span(), what, wanted.remedy());
        }
        let mut points: Vec<[f64; 2]> = Vec::new();
        for entry in entries.iter().take(MAX_POINTS) {
            let point = self.point(field, entry)?;
            if let Some([before, _]) = points.last().filter(|last| last[0] >= point[0]) {
                let what = format!("`{key}` goes from {before} to {}", point[0]);
                let remedy =
                    "order the points by their first numbers, each greater than the one before";
                self.complain(entry.span(), what, remedy);
            }
            points.push(point);
        }
        (points.len() == found).then_some(points)
    }

    fn point(&mut self, field: Field, entry: &Spanned<DeValue<'_>>) -> Option<[f64; 2]> {
        let (pair, numbers) = self.pair(format!("a point of `{}`", field.key), entry)?;
        let range = Range::Within(LARGEST);
        for (value, number) in pair.iter().zip(numbers) {
            let number = range.contains(number).then_some(number);
            self.within(field, value, number, Wanted::Number(range))?;
        }
        Some(numbers)
    }

    /// The two numbers of a pair, with their places in the file.
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
        read.or_else(|| self.wrong_type(subject, entry, Wanted::Point))
    }

    /// A list of places in the plane. At most one more than [`MAX_NODES`] are read.
    pub(in crate::lab::scene) fn points(&mut self, field: Field) -> Option<Vec<[f64; 2]>> {
        let value = self.value(field, &Wanted::Places)?;
        let Some(entries) = value.get_ref().as_array() else {
            return self.wrong_type(format!("`{}`", field.key), value, Wanted::Places);
        };
        let read = entries.iter().take(MAX_NODES + 1).enumerate();
        read.map(|(node, entry)| self.place(node, entry)).collect()
    }

    /// The place of a node of this number.
    fn place(&mut self, node: usize, entry: &Spanned<DeValue<'_>>) -> Option<[f64; 2]> {
        let (pair, numbers) = self.pair(format!("the place of node {node}"), entry)?;
        let range = Range::Within(LARGEST);
        let far = pair.iter().zip(numbers).find(|(_, number)| !range.contains(*number));
        if let Some((value, _)) = far {
            let subject = format!("a coordinate of node {node}");
            let written = clip(&self.text[value.span()]);
            let fault = SceneFault::out_of_range(&subject, &written, &Wanted::Number(range));
            self.complain_of(value.span(), fault);
            return None;
        }
        Some(numbers)
    }

    /// The numbers of nodes in a list, with their bytes.
    pub(in crate::lab::scene) fn node_numbers(
        &mut self,
        field: Field,
        wanted: &Wanted,
    ) -> Option<Vec<(Span<usize>, usize)>> {
        let value = self.value(field, wanted)?;
        let Some(entries) = value.get_ref().as_array() else {
            return self.wrong_type(format!("`{}`", field.key), value, wanted.clone());
        };
        let mut numbers = Vec::new();
        for entry in entries {
            let number = integer(entry).and_then(|number| usize::try_from(number).ok());
            match number {
                Some(number) => numbers.push((entry.span(), number)),
                None => {
                    let subject = format!("an entry of `{}`", field.key);
                    self.wrong_type::<()>(subject, entry, Wanted::Node);
                }
            }
        }
        (numbers.len() == entries.len()).then_some(numbers)
    }

    /// The coordinates or the velocities of a body that has `count` of them, each of a magnitude of at most
    /// [`MAX_COORDINATE`].
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
            let (key, found) = (field.key, numbers.len());
            let what = format!("`{key}` has {found} number{}", if found == 1 { "" } else { "s" });
            self.complain(value.span(), what, wanted.remedy());
            return None;
        }
        let range = Range::Within(MAX_COORDINATE);
        for (entry, number) in entries.iter().zip(&numbers) {
            let number = range.contains(*number).then_some(());
            self.within(field, entry, number, Wanted::Number(range))?;
        }
        Some(numbers)
    }
}
